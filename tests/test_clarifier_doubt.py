"""What the eye is unsure of, the clarifier does not promise."""

import pytest
from clarifier_table import TABLE, thing

from agent.messages import ClarifyRequest, Dialog
from scene.types import Scene

EDGE = Scene(objects=(*TABLE.objects, thing("lemon", 0.98, 0.0)))


@pytest.mark.parametrize(("sd", "do"), [({}, "act"), ({"lemon_1": 0.02}, "refuse")])
def test_a_thing_that_may_be_beyond_the_edge_is_not_taken(clarifier, sd, do):
    request = ClarifyRequest("pick up the lemon", EDGE, Dialog(), None, sd)
    decision = clarifier.decide(request)
    assert decision.do == do
    if sd:
        assert "may not be on the table" in decision.reply


def test_the_doubt_about_what_is_well_inside_changes_nothing(clarifier):
    sd = dict.fromkeys((item.id for item in TABLE.objects), 0.005)
    asked = [ClarifyRequest("pick up the sponge", TABLE, Dialog(), None, one) for one in ({}, sd)]
    one, other = (clarifier.decide(request) for request in asked)
    assert (one.do, one.program) == (other.do, other.program) == ("act", one.program)
