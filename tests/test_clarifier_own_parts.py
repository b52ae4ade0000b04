"""The arm's own parts are no things of the table, unless a thing there is called so."""

import pytest

from clarifier.own_parts import without_own_parts


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Kindly hover the suction cup over the dish without touching it",
         "Kindly hover over the dish without touching it"),
        ("position the gripper directly above the lid", "hover directly above the lid"),
        ("bring your suction pad above the dish and stay there",
         "hover above the dish and stay there"),
        ("lower the tool onto the lid", "touch the lid"),
        ("put the tip of your finger on the lid", "touch the lid"),
        ("tap the dish with the end of your arm", "tap the dish"),
        ("use the suction cup to touch the lid", "touch the lid"),
        ("touch the lid using the gripper, please", "touch the lid, please"),
        ("move the arm to the left", "move the arm to the left"),
        ("put the tool on the left side", "put the tool on the left side"),
        ("move your arm to the left of the dish", "hover to the left of the dish"),
        ("position the gripper behind the lid", "hover behind the lid"),
        ("move the end effector towards the lid", "hover over the lid"),
        ("get a bit closer to the lid", "hover over the lid"),
        ("approach the dish", "hover over the dish"),
        ("the cup must go next to the lid", "the cup must go next to the lid"),
        ("move next to the lid the cup", "move next to the lid the cup"),
        ("get the cup closer to the lid", "get the cup closer to the lid"),
        ("put the cup on the dish", "put the cup on the dish"),
    ],
)  # fmt: skip
def test_a_part_of_the_arm_is_left_out(text, plain):
    assert without_own_parts(text, {"petri dish", "lid", "clear"}) == plain


def test_a_thing_of_that_name_is_meant():
    text = "put the tool on the tray"
    assert without_own_parts(text, {"tool", "tray"}) == text
    assert without_own_parts("touch the lid with the suction cup", {"suction cup"}) == (
        "touch the lid with the suction cup"
    )
