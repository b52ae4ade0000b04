"""A scripted conversation, played for real: every sentence goes through the whole product.

`make run` without a terminal ends here. Nothing is hard-coded but what the person says.
"""

from __future__ import annotations

from typing import TextIO

from agent.commands import show
from agent.compose import RobotKind, default_robot, parts_on, table, thinking
from agent.messages import Dialog
from agent.turn import run_turn

SCRIPT = (
    "what is on the table?",
    "put the sponge in the top left corner",
    "put the apple to the left of the orange",
    "push the lemon off the table",
    "pick up the fruit",
    "the yellow one",
    "put it on the plate",
    "put the flask next to the cup",
    "never mind",
    "put the apple a metre off the table",
    "what is left of the plate?",
    "stop",
)
"""What the person says: arrange, manipulate, a question back and its answer, a missing object, a
refusal, questions about the scene, stop."""


def play_demo(robot: RobotKind | None, seed: int, out: TextIO) -> int:
    """Play the conversation on a simulated arm; 0 if every sentence came to an end, else 1."""
    failed = 0
    with (
        thinking() as mind,
        parts_on(mind, table("kitchen"), robot or default_robot(), seed=seed) as parts,
    ):
        dialog = Dialog()
        for say in SCRIPT:
            out.write(f"> {say}\n")
            turn, dialog = run_turn(say, dialog, parts)
            show(turn, False, out)
            out.write("\n")
            failed += turn.status == "failed"
    out.write("Type `make run` in a terminal to talk to the arm yourself.\n")
    return int(failed > 0)
