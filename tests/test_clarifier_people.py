"""Nothing is brought to bear on a person; handing something over or pushing it nearer is."""

import pytest
from clarifier_table import LEXICON, SmallTranslator, linked, talk, thing

from clarifier.people import reaches_someone
from scene.types import Scene

SCENE = Scene(
    objects=(thing("fork", 0.0, 0.0), thing("cup", 0.4, 0.0), thing("white king", -0.4, 0))
)


@pytest.mark.parametrize(
    "text",
    [
        "jab him with the fork", "tap my shoulder with the fork", "hit somebody with the cup",
        "cut my finger with the fork", "shove her", "prick the dog with the fork",
        "ram the fork into my leg and push it", "gently push his face with the cup",
        "put the cup on my head", "drop the fork on her foot", "scratch yourself",
        "take the fork and give her a good poke",
        "lift the cup and then knock my brother over", "press the fork against our neighbour's arm",
    ],
)  # fmt: skip
def test_a_person_is_reached(text):
    assert reaches_someone(linked(text, SCENE), LEXICON) is not None


@pytest.mark.parametrize(
    "text",
    [
        "hand me the fork", "push me the cup", "slide the cup towards me", "show me the fork",
        "push the cup away from her", "put the cup on my left hand side", "tap the white king",
        "put the cup on the right hand side", "put the fork in your hand", "bring her the cup",
        "touch the cup with the fork", "put the cup in front of me", "put the fork on my side",
        "hold the fork for me", "push the cup back", "give her a cup", "give the cup a poke",
        "take the fork and the cup and tap them", "lift both and knock them over",
    ],
)  # fmt: skip
def test_only_things_are_spoken_of(text):
    assert reaches_someone(linked(text, SCENE), LEXICON) is None


@pytest.mark.parametrize("text", ["jab me with the fork", "slice my thumb with the fork"])
def test_it_is_refused_as_unsafe_however_sure_the_translator_is(clarifier_over, text):
    (decision,) = talk(clarifier_over(SmallTranslator(1.0)), text, scene=SCENE)
    assert (decision.do, decision.reason) == ("refuse", "unsafe")
    assert "people" in decision.reply
