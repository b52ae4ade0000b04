"""How sure a reading must be before it is acted on."""

from dataclasses import replace

import pytest
from clarifier_table import SmallTranslator, linked, talk

from clarifier.branches import needed
from clarifier.candidates import Planner
from clarifier.conformal import PRODUCT
from clarifier.decide import Manner


@pytest.mark.parametrize(
    "text",
    [
        "push the bottle to the left",
        "if the bottle is tall, push it to the left",
        "the bowl is in the way, put the sponge next to it",
        "do push the bottle away",
        "I'd like the bottle in the middle",
        "it would be nice to have the sponge next to the bowl",
    ],
)
def test_a_command_says_itself_what_to_do(text):
    assert needed(linked(text), PRODUCT) == PRODUCT.act


@pytest.mark.parametrize("text", ["the bottle to the left", "sponge next to the bowl"])
def test_where_no_verb_opens_a_phrase_more_is_needed(text):
    assert needed(linked(text), PRODUCT) == PRODUCT.stated
    assert PRODUCT.stated > PRODUCT.act


class Doubting(Planner):
    """Not sure of what is done with the green apple."""

    def outcome(self, reading, binding, scene):
        found = super().outcome(reading, binding, scene)
        unsure = ("apple_2",) in binding.values()
        return replace(found, confidence=0.5) if unsure else found


def test_what_is_understood_less_well_is_offered_all_the_same(clarifier_over):
    """Else the other one would be taken, as if nothing else could be meant."""
    clarifier = clarifier_over(SmallTranslator(), Manner(planner=Doubting))
    asked, picked = talk(clarifier, "lift the apple", "the green one")
    assert asked.do == "ask"
    assert [option.objects for option in asked.question.options] == [("apple_1",), ("apple_2",)]
    assert picked.touched == ("apple_2",)
