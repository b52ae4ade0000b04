"""Things stand on their base, and are set down on it again."""

import msgspec
import pytest
from clarifier_table import linked, thing

from agent.messages import Dialog
from clarifier.lexicon import load_lexicon
from clarifier.refusals import State, stood_up, upside_down
from scene.types import Scene

BOTTLE = thing("bottle", 0.0, 0.0, tall=0.3)
STANDS = Scene(objects=(BOTTLE, thing("plate", 0.5, 0.5)))
LIES = Scene(objects=(msgspec.structs.replace(BOTTLE, upright=False), STANDS.objects[1]))


def refused(rule, text, scene=STANDS):
    decision = rule(linked(text, scene), State(scene, Dialog()), load_lexicon())
    return "" if decision is None else decision.reply


@pytest.mark.parametrize(
    ("text", "is_refused"),
    [
        ("turn the bottle upside down", True), ("put the plate face down", True),
        ("flip the plate over", True), ("turn the plate over to the left", False),
        ("stack them in an upside-down pyramid", False), ("push the plate over there", False),
    ],
)  # fmt: skip
def test_nothing_is_turned_upside_down(text, is_refused):
    assert ("upside down" in refused(upside_down, text)) is is_refused


def test_what_stands_is_not_raised_and_what_lies_cannot_be():
    assert refused(stood_up, "stand the bottle up") == "The bottle stands upright."
    assert "can't stand the bottle up" in refused(stood_up, "stand the bottle up again", LIES)
    assert not refused(stood_up, "put the bottle up on the plate")
