"""The main path: what a turn returns for each decision, and what it does to the arm."""

from collections.abc import Iterator

import msgspec
import pytest

from agent.arm import LocalArm
from agent.compose import table
from agent.errors import LinkDown, Stopped
from agent.execute import Executor
from agent.messages import (
    ClarifyRequest,
    Decision,
    Dialog,
    Option,
    Question,
    StepReport,
)
from agent.turn import Parts, Watch, run_program, run_turn
from robot_bridge.api import ApprovedPlan
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene

LIFT = """robot.move(apple.x, apple.y, 0.9, 0)
robot.move(apple.x, apple.y, apple.z + apple.tall, 0)
robot.grip(True)
robot.move(apple.x, apple.y, 0.9, 0)"""
ACT = Decision(
    "act", "one program", Dialog(), program=LIFT, kind="manipulate", touched=("apple_1",)
)


def parts(executor: Executor, decision: Decision, arm: LocalArm | None = None) -> Parts:
    """Real parts around a clarifier that has already decided."""

    def decide(request: ClarifyRequest) -> Decision:
        return decision

    return Parts(decide, executor, predict, arm or LocalArm(IdealRobot(table("kitchen"))))


class FaultyArm(LocalArm):
    """An arm that breaks off after some steps."""

    def __init__(self, steps: int, error: Exception) -> None:
        super().__init__(IdealRobot(table("kitchen")))
        self._steps = steps
        self._error = error

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        for count, step in enumerate(super().run(plan, hold=hold)):
            if count == self._steps:
                raise self._error
            yield step


class BlindArm(LocalArm):
    """An arm whose eye shows the table as it was at the beginning."""

    def scene(self) -> Scene:
        return table("kitchen")


def test_an_approved_program_runs_and_says_what_was_seen(executor):
    turn, _ = run_turn("pick up the apple", Dialog(), parts(executor, ACT))
    assert (turn.status, turn.reply, turn.kind) == ("done", "I hold the apple.", "manipulate")
    assert turn.program == LIFT
    assert [step.grip for step in turn.trajectory] == [False, False, True, True]


def test_the_times_of_a_turn_add_up(executor):
    turn, _ = run_turn("pick up the apple", Dialog(), parts(executor, ACT))
    assert turn.ms.total >= turn.ms.decide + turn.ms.execute > 0


def test_who_watches_sees_the_plan_before_the_first_step(executor):
    seen: list[str] = []
    watch = Watch(
        plan=lambda plan, kind, after: seen.append(f"{kind} plan of {len(plan.told)}"),
        step=lambda step: seen.append(f"step {step.index}"),
    )
    run_turn("pick up the apple", Dialog(), parts(executor, ACT), watch=watch)
    assert seen[0] == "manipulate plan of 4"
    assert len(seen) == 5


def test_a_dry_run_moves_nothing_and_shows_the_plan(executor):
    arm = LocalArm(IdealRobot(table("kitchen")))
    turn, _ = run_turn("pick up the apple", Dialog(), parts(executor, ACT, arm), dry_run=True)
    assert turn.status == "answered"
    assert len(turn.trajectory) == 4
    assert arm.scene() == table("kitchen")


@pytest.mark.parametrize(
    ("decision", "status", "reply"),
    [
        (Decision("answer", "w", Dialog(), reply="Two apples."), "answered", "Two apples."),
        (Decision("refuse", "w", Dialog(), reply="No.", reason="unsafe"), "refused", "No."),
        (
            Decision("ask", "w", Dialog(), question=Question("which", "Which?", (Option("a"),))),
            "asked",
            "Which?",
        ),
    ],
)
def test_every_other_decision_moves_nothing(executor, decision, status, reply):
    turn, _ = run_turn("…", Dialog(), parts(executor, decision))
    assert (turn.status, turn.reply, turn.trajectory) == (status, reply, ())
    assert turn.question == decision.question
    assert turn.reason == decision.reason


def test_the_dialog_of_the_decision_goes_on(executor):
    after = Dialog(last_text="hello")
    decision = msgspec.structs.replace(ACT, dialog=after)
    assert run_turn("pick it up", Dialog(), parts(executor, decision))[1] == after


def test_a_program_that_would_move_what_nobody_named_is_refused(executor):
    decision = msgspec.structs.replace(ACT, touched=("cup_1",))
    arm = LocalArm(IdealRobot(table("kitchen")))
    turn, _ = run_turn("pick up the cup", Dialog(), parts(executor, decision, arm))
    assert (turn.status, turn.reason) == ("refused", "unsafe")
    assert "the apple" in turn.reply
    assert arm.scene() == table("kitchen")


def test_a_bad_program_is_refused_with_its_line(executor):
    turn = run_program("robot.move(0, 0, 0.5, 0)\nimport os", "manipulate", parts(executor, ACT))
    assert (turn.say, turn.status, turn.reason) == (None, "refused", "bad_program")
    assert "line 2" in turn.reply


def test_a_point_outside_the_workspace_is_refused_before_anything_moves(executor):
    body = "robot.move(0, 0, 0.5, 0)\nrobot.move(9, 0, 0.5, 0)"
    turn = run_program(body, "manipulate", parts(executor, ACT))
    assert (turn.status, turn.reason, turn.trajectory) == ("refused", "unreachable", ())


def test_success_is_not_reported_when_it_was_not_seen(executor):
    arm = BlindArm(IdealRobot(table("kitchen")))
    turn, _ = run_turn("pick up the apple", Dialog(), parts(executor, ACT, arm))
    assert turn.status == "failed"
    assert "I should hold the apple but do not" in turn.reply


def test_a_stop_in_motion_is_a_failure_that_says_by_whom(executor):
    arm = FaultyArm(2, Stopped("F8"))
    turn, _ = run_turn("pick up the apple", Dialog(), parts(executor, ACT, arm))
    assert (turn.status, turn.reason, len(turn.trajectory)) == ("failed", "cancelled", 2)
    assert "stopped by F8" in turn.reply


def test_a_lost_link_is_a_refusal_before_and_a_failure_after_the_first_step(executor):
    for steps, status in ((0, "refused"), (1, "failed")):
        arm = FaultyArm(steps, LinkDown("connection lost, motion state unknown"))
        turn, _ = run_turn("pick up the apple", Dialog(), parts(executor, ACT, arm))
        assert turn.status == status
        assert "motion state unknown" in turn.reply


def test_stop_halts_the_arm_until_a_reset(executor):
    arm = LocalArm(IdealRobot(table("kitchen")))
    stop = parts(executor, Decision("stop", "stop", Dialog()), arm)
    assert run_turn("stop", Dialog(), stop)[0].status == "answered"
    moving = parts(executor, ACT, arm)
    assert run_turn("pick up the apple", Dialog(), moving)[0].status in ("refused", "failed")
    assert run_turn("reset", Dialog(), moving)[0].status == "answered"
    assert run_turn("pick up the apple", Dialog(), moving)[0].status == "done"
