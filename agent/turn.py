"""THE MAIN PATH: one sentence to one motion, and a look at what came of it.

    say -> decide (mentions, translation, ladder) -> check -> arm -> look again -> Turn
                                                       ^------- try again ----'

What is slow, physical or random comes in with `Parts`, so the same turn runs in tests, evals,
the terminal and on an arm. A question is a return value too: the answer is the next sentence.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

import msgspec

from agent.arm import Arm
from agent.attempt import RETRIES, Manner, attempt
from agent.attempt import Watch as Watch
from agent.called import CalledArm
from agent.check import Checked, Predict, check
from agent.execute import Executor
from agent.forecast import Forecast
from agent.messages import (
    ClarifyRequest,
    Decision,
    Dialog,
    Kind,
    Pending,
    Problem,
    Timing,
    Turn,
)
from agent.report import changed, describe
from agent.stirred import stirred
from agent.vouch import steady
from robot_bridge.api import waypoint
from scene.types import Scene

Decide = Callable[[ClarifyRequest], Decision]
_RESET_WORDS = frozenset({"reset", "resume"})


class Parts(NamedTuple):
    """What a turn needs: the clarifier, the program worker, the ideal table's forecast, the arm."""

    decide: Decide
    executor: Executor
    predict: Predict
    arm: Arm
    retries: int = RETRIES


def run_turn(
    say: str,
    dialog: Dialog,
    parts: Parts,
    *,
    task: Kind | None = None,
    dry_run: bool = False,
    hold: bool = False,
    watch: Watch = Watch(),  # noqa: B008 - an immutable default
) -> tuple[Turn, Dialog]:
    """Take a sentence as far as it goes and return what happened, and the conversation after it.

    ``dry_run``: nothing moves. ``hold``: the arm waits before the program's first line.
    """
    clock = Clock()
    if say.strip().lower().rstrip(".!") in _RESET_WORDS:
        return _reset(say, parts, clock), dialog
    parts = parts._replace(arm=CalledArm(parts.arm, dict(dialog.called)))
    scene = parts.arm.scene()
    sd = dict(parts.arm.doubt())
    decision = parts.decide(ClarifyRequest(say, scene, dialog, task, sd))
    clock.decided(decision.ms_translate)
    for id_, name in decision.dialog.called[len(dialog.called) :]:
        parts.arm.call(id_, name)
    turn = _carry_out(decision, scene, parts, Manner(dry_run, hold, watch), clock)
    after = _waiting(decision.dialog, say, turn)
    return msgspec.structs.replace(turn, say=say, ms=clock.stop()), after


def _waiting(dialog: Dialog, say: str, turn: Turn) -> Dialog:
    """The conversation, which waits for an answer where a motion failed and something was asked."""
    if turn.status != "failed" or turn.question is None:
        return dialog
    pending = Pending(dialog.last_text or say, turn.question)
    return msgspec.structs.replace(dialog, pending=pending)


def run_program(
    program: str,
    kind: Kind,
    parts: Parts,
    *,
    dry_run: bool = False,
    hold: bool = False,
    watch: Watch = Watch(),  # noqa: B008 - an immutable default
) -> Turn:
    """Run a program that somebody wrote through the same check and execution; ``say`` is None."""
    clock = Clock()
    scene = parts.arm.scene()
    manner = Manner(dry_run, hold, watch, asks=False)
    turn = _act(program, kind, None, scene, parts, manner, clock)
    return msgspec.structs.replace(turn, ms=clock.stop())


def _carry_out(
    decision: Decision, scene: Scene, parts: Parts, manner: Manner, clock: Clock
) -> Turn:
    say = None
    if decision.do == "stop":
        parts.arm.stop()
        return Turn(say=say, status="answered", reply="Stopped. Say “reset” to go on.")
    if decision.do == "answer":
        return Turn(say=say, status="answered", reply=decision.reply)
    if decision.do == "refuse":
        return Turn(say=say, status="refused", reply=decision.reply, reason=decision.reason)
    if decision.do == "ask":
        assert decision.question is not None
        return Turn(
            say=say, status="asked", reply=decision.reply or decision.question.text,
            question=decision.question, kind=decision.kind, confidence=decision.confidence,
        )  # fmt: skip
    assert decision.program is not None and decision.kind is not None
    turn = _act(decision.program, decision.kind, decision.touched, scene, parts, manner, clock)
    reply = f"{decision.echo} {turn.reply}".strip()
    return msgspec.structs.replace(turn, reply=reply, confidence=decision.confidence)


def _act(
    program: str,
    kind: Kind,
    touched: Sequence[str] | None,
    scene: Scene,
    parts: Parts,
    manner: Manner,
    clock: Clock,
) -> Turn:
    """Check the program on the scene as it is now, run it, look again."""
    arm = parts.arm
    checked = _checked(program, kind, touched, scene, parts)
    if not manner.dry_run and (closer := _closer(checked, scene, parts)) is not None:
        scene = closer
        checked = _checked(program, kind, touched, scene, parts)
    clock.checked()
    if checked.plan is None:
        return _refused(checked)
    points = tuple(waypoint(command) for command in checked.commands)
    assert checked.after is not None
    manner.watch.plan(checked.plan, kind, checked.after)
    if manner.dry_run:
        expected = describe(scene, checked.after, checked.commands, touched or ())
        reply = f"Checked, nothing moved. {expected}"
        return Turn(say=None, status="answered", reply=reply, program=program, kind=kind,
                    trajectory=points)  # fmt: skip
    turn = Turn(say=None, status="done", reply="", program=program, kind=kind)
    return attempt(checked, scene, touched, parts.predict, arm, manner, turn, parts.retries)


def _checked(
    program: str, kind: Kind, touched: Sequence[str] | None, scene: Scene, parts: Parts
) -> Checked:
    arm = parts.arm
    return check(
        program, kind, scene, executor=parts.executor, predict=parts.predict,
        workspace=arm.workspace, start=arm.start(), touched=touched, doubt=arm.doubt(),
        heights=arm.heights(),
    )  # fmt: skip


def _closer(checked: Checked, scene: Scene, parts: Parts) -> Scene | None:
    """The scene looked at longer, where a plan comes so close to what must stay that the eye could
    not tell afterwards whether it did; None where it could, or does not see better by it."""
    if checked.plan is None or checked.after is None or not parts.arm.doubt():
        return None
    near = stirred(Forecast(checked.plan, scene, parts.predict))
    still = near - {now.id for _, now in changed(scene, checked.after)}
    return steady(parts.arm, still)


def _refused(checked: Checked) -> Turn:
    first: Problem = checked.problems[0]
    where = f" (line {first.line})" if first.line and first.reason == "bad_program" else ""
    return Turn(
        say=None, status="refused", reply=f"I won't run that: {first.text}{where}.",
        program=checked.program, kind=checked.kind, reason=first.reason,
    )  # fmt: skip


def _reset(say: str, parts: Parts, clock: Clock) -> Turn:
    parts.arm.reset()
    reply = "Ready again. Nothing moved."
    return Turn(say=say, status="answered", reply=reply, ms=clock.stop())


class Clock:
    """Milliseconds of a turn's parts: translate, decide (the rest before the check), execute."""

    def __init__(self) -> None:
        self._began = self._mark = time.perf_counter()
        self._translate = self._decide = 0.0
        self._execute_from = self._began

    def decided(self, translate: float) -> None:
        """The decision is made, of which ``translate`` ms were the translator's."""
        now = time.perf_counter()
        self._translate = translate
        self._decide = 1000 * (now - self._mark) - translate
        self._mark = now

    def checked(self) -> None:
        """The check is over: it counts as deciding."""
        now = time.perf_counter()
        self._decide += 1000 * (now - self._mark)
        self._mark = self._execute_from = now

    def stop(self) -> Timing:
        """The whole turn is over."""
        now = time.perf_counter()
        execute = 1000 * (now - self._execute_from) if self._execute_from > self._began else 0.0
        return Timing(self._translate, self._decide, execute, 1000 * (now - self._began))
