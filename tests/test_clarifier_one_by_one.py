"""A sentence whose phrases are each sure is done where they come to the same, one by one."""

import pytest
from clarifier_table import talk

from agent.messages import Candidate, Translation
from clarifier.act import strip_courtesy

SURE, UNSURE = 0.99, 0.3
APPLE = "put the red apple on the plate"
BOTTLE = "move the bottle to the left edge"
BODIES = {
    APPLE: ("put_on(m1, m2)", SURE),
    BOTTLE: ('put(m1, edge(m1, "left"))', SURE),
    "touch the sponge": ("touch(m1)", SURE),
    "lift the sponge": ("pick(m1)", SURE),
    "shake the bowl": ("touch(m1)", UNSURE),
}


def translate(request):
    body, sure = BODIES.get(request.text, ("pick(m1)", 0.1))
    return Translation((Candidate(body, -0.01, 9),), sure, 1.0)


@pytest.fixture
def decided(clarifier_over):
    """What is decided on a sentence; `likely`: what the translator makes of it as a whole."""

    def decided(text, likely=None):
        def whole(request):
            if likely is not None and request.text not in BODIES:
                return Translation((Candidate(likely, -0.6, 9),), 0.5, 1.0)
            return translate(request)

        return talk(clarifier_over(whole), text)[0]

    return decided


@pytest.mark.parametrize(
    "text", [f"{APPLE}, {BOTTLE}", f"{APPLE}, touch the sponge and {BOTTLE}",
             f"{BOTTLE}, then lift the sponge"]
)  # fmt: skip
def test_phrases_that_are_sure_are_done_one_after_the_other(text, decided):
    decision = decided(text)
    assert decision.do == "act" and decision.program is not None
    assert decision.program.count("\n") == text.count(",") + text.count(" and ")


@pytest.mark.parametrize(
    "text",
    [
        f"{APPLE} and shake the bowl",
        f"lift the sponge and {BOTTLE}",  # the gripper is full
        "put the apple on the plate and touch the sponge",  # there are two apples
    ],
)
def test_what_is_not_sure_or_does_not_go_together_is_not_done(text, decided):
    assert decided(text).do != "act"


def test_a_likely_reading_that_ends_otherwise_is_asked_about(decided):
    text = f"{APPLE}, {BOTTLE}"
    other = 'put_on(m1, m2)\nput(m3, edge(m3, "right"))'
    same = 'put_on(m1, m2)\nput(m3, edge(m3, "left"))'
    assert decided(text, other).do == "ask"
    assert decided(text, same).do == "act"


@pytest.mark.parametrize(
    ("text", "core"),
    [
        ("put the pen behind the robot", "put the pen behind the robot"),
        ("put the pen down, robot", "put the pen down"),
        ("lift the pen please, robot!", "lift the pen"),
    ],
)
def test_a_robot_that_is_a_thing_is_not_spoken_to(text, core):
    assert strip_courtesy(text) == core
