"""Run a plan that passed the check, look at what came of it, and try again what went wrong.

"Done" is said only of what was seen, and seen well enough (`agent.vouch`). A thing that the gripper
lost, or that stands elsewhere than meant, is taken again, within a budget, by what is left of the
plan (`agent.recover`): aimed at where the thing is seen now, gripped at another point, and checked
like any other plan. What stands where it was meant but for a little is brought nearer where that
can be done, and where the eye can see so little. Success stays what the forecast of the first plan
says.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Generator, Iterator, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from agent.again import what_next
from agent.arm import Arm
from agent.check import Checked, check_commands
from agent.descent import arrived, unfelt
from agent.doubt import Doubt
from agent.errors import Cancelled, LinkDown, NotReady, RobotError, Stopped, Unreachable
from agent.forecast import Forecast, Predict
from agent.glance import aside, back, hides
from agent.messages import Command, Kind, StepReport, Turn, Waypoint
from agent.recover import Carry, Look, carries, freed, left, lost, mendings
from agent.report import changed, describe, differences, strays, title
from agent.stirred import stirred
from agent.vouch import LOOKS_AFTER, Looked, longer
from robot_bridge.api import ApprovedPlan
from scene.types import Scene, SceneObject

RETRIES = 2
"""Further tries of what went wrong, in one turn; none where no camera sees what went wrong."""

UNSEEN = "(Computed from the arm's motion: no camera sees the table.)"

OnPlan = Callable[[ApprovedPlan, Kind, Scene], None]
"""Told of a plan before it runs, of its program's kind, and of the scene it should lead to."""
OnStep = Callable[[StepReport], None]


class Watch(NamedTuple):
    """Who is told while a turn goes on: each plan that passed the check, then each step of it."""

    plan: OnPlan = lambda plan, kind, after: None
    step: OnStep = lambda step: None


class Manner(NamedTuple):
    """How a program that passed the check is to run; ``asks``: whether anybody can be asked."""

    dry_run: bool
    hold: bool
    watch: Watch
    asks: bool = True


class Tried(NamedTuple):
    """What one plan came to: its forecast and carries, the one that was lost, what is seen now.

    ``untouched``: what was to be touched and was not felt; ``last``: the last step.
    """

    forecast: Forecast
    plan: tuple[Carry, ...]
    missed: Carry | None
    looked: Looked
    untouched: tuple[str, ...] = ()
    last: StepReport | None = None

    @property
    def seen(self) -> Scene:
        """The scene as it is seen now."""
        return self.looked.seen


def attempt(
    checked: Checked,
    scene: Scene,
    touched: Sequence[str] | None,
    predict: Predict,
    arm: Arm,
    manner: Manner,
    turn: Turn,
    retries: int = RETRIES,
) -> Turn:
    """Carry a checked plan out, with at most so many further tries; the turn that came of it.

    ``scene``: as it was checked on; ``turn``: the turn so far.
    """
    assert checked.after is not None
    goal, told, tries, now = checked.after, list[Waypoint](), 1, scene
    unseen = ""
    if not arm.workspace.limits.simulated:  # its scene is computed: nothing to try again by
        unseen, retries = f" {UNSEEN}", 0
    current, refused, meant = checked, "", _meant(scene, goal, arm)
    untouched = tuple[str, ...]()
    while True:
        following = None
        try:
            tried = _run(current, now, predict, arm, manner, told, meant)
            looked = tried.looked
            meant = meant._replace(stirred=looked.stirred)
            wrong = differences(looked.goal, looked.seen, looked.doubt, looked.still)
            nearly = () if wrong or tried.missed else _nearly(looked, touched)
            if tries <= retries and (wrong or tried.missed or nearly):
                following, refused = _following(
                    tried, nearly, predict, arm, touched, checked, tries
                )
        except RobotError as error:
            return _broken_off(turn, error, tuple(told))
        turn = replace(turn, trajectory=tuple(told))
        untouched = untouched or tried.untouched
        if tried.missed is None and not wrong and following is None and not untouched:
            named = touched or ()
            happened = describe(scene, looked.seen, checked.commands, named, looked.doubt)
            return _ended(turn, f"{_again(tries)}{happened}{unseen}", looked)
        if following is None or following.plan is None:
            reply = f"{_failure(tried, wrong, tries, refused, untouched)}{unseen}"
            turn = replace(turn, status="failed", reply=reply)
            if manner.asks and not unseen:
                turn = _asking(turn, tried, goal, touched)
            return _withdrawn(turn, tried, predict, arm, touched, told)
        current, now, tries = following, tried.seen, tries + 1
        manner.watch.plan(following.plan, checked.kind, goal)


def _run(
    checked: Checked,
    scene: Scene,
    predict: Predict,
    arm: Arm,
    manner: Manner,
    told: list[Waypoint],
    meant: Looked,
) -> Tried:
    """Run one plan, to its end or until the gripper lost something, and look, longer where the eye
    cannot tell at once; ``meant``: what should be, and how uncertain that is. Raises RobotError."""
    assert checked.plan is not None and checked.meant is not None
    forecast, heights = Forecast(checked.meant, scene, predict), arm.heights()
    felt = dict[int, StepReport]()
    plan, missed, step = carries(forecast), None, None
    steps = arm.run(checked.plan, hold=manner.hold)
    try:
        for step in steps:
            told.append(step.told)
            felt[step.index] = step
            manner.watch.step(step)
            missed = None if arrived(step, checked.plan.told) else lost(step, plan)
            if missed is not None:
                break
    finally:
        if isinstance(steps, Generator):
            steps.close()
    meant = meant._replace(stirred=meant.stirred | stirred(forecast))

    def looked(seen: Scene, doubt: Doubt) -> Looked:
        return meant.seeing(seen, doubt, arm.stands(), arm.unseen())

    cleared = False

    def undecided(seen: Scene, doubt: Doubt) -> bool:
        hidden = not cleared and hides(arm, meant.stirred, step)
        return missed is None and not hidden and looked(seen, doubt).undecided()

    now = looked(*longer(arm, undecided, LOOKS_AFTER))
    if hides(arm, meant.stirred, step):
        end, away = arm.start(), aside(checked, now.seen, predict, arm)
        if away.plan is not None:
            told += [step.told for step in arm.run(away.plan)]
            cleared = True  # what is hidden now is so by other things: of the rest more looks tell
            now = looked(*longer(arm, undecided, LOOKS_AFTER))
            again = back(end, checked, now.seen, predict, arm)
            if missed is None and again.plan is not None:
                told += [step.told for step in arm.run(again.plan)]
    yields = arm.workspace.limits.yields
    untouched = () if missed else unfelt(forecast, meant.doubt, heights, felt, yields)
    return Tried(forecast, plan, missed, now, untouched, step)


def _meant(scene: Scene, goal: Scene, arm: Arm) -> Looked:
    """What a plan is to come to, as uncertain as the scene that it was made on."""
    moved = frozenset(now.id for _, now in changed(scene, goal))
    return Looked(goal, scene, arm.doubt(), moved=moved, stands=arm.stands())


def _nearly(looked: Looked, touched: Sequence[str] | None) -> tuple[str, ...]:
    """Ids of what stands where it should but for a little that the eye can see."""
    return tuple(one.id for one in looked.nearly() if touched is None or one.id in touched)


def _ended(turn: Turn, reply: str, looked: Looked) -> Turn:
    """A plan at whose end nothing is seen beside its place: done, if all is seen to be in it."""
    unsure, blur = looked.unsure(), looked.blur()
    if unsure:
        names, far = _named(unsure, looked.goal)
        text = f"{names} may be up to {far} from where I meant"
        reply = f"{reply} As far as I can see that is done, but I am not sure: {text}."
        return replace(turn, status="failed", reply=reply)
    if blur:
        names, far = _named(blur, looked.goal)
        reply = f"{reply} I see {names} only roughly, though: up to {far} off is possible."
    return replace(turn, reply=reply)


def _named(rough: Sequence[tuple[SceneObject, float]], scene: Scene) -> tuple[str, str]:
    """What is seen so roughly, and how far off the worst of it may be."""
    far = max(off for _, off in rough)
    return " and ".join(title(one, scene) for one, _ in rough), _mm(far, scene)


def _mm(units: float, scene: Scene) -> str:
    return f"{math.ceil(500 * scene.table_m * units)} mm"


def _following(
    tried: Tried,
    nearly: Collection[str],
    predict: Predict,
    arm: Arm,
    touched: Sequence[str] | None,
    first: Checked,
    tries: int,
) -> tuple[Checked | None, str]:
    """What to do next, checked, and where a plan ran to its end what its forecast says will put it
    right; None, and why not, where nothing can be done."""
    looked = tried.looked
    goal, doubt, still = looked.goal, looked.doubt, looked.still
    look = Look(looked.seen, goal, touched, arm.start(), doubt, still, nearly)
    refused = ""
    for commands in _ways(tried, look, tries):
        checked = check_commands(
            commands, first.program, first.kind, tried.seen,
            predict=predict, workspace=arm.workspace, start=look.here, touched=touched,
            doubt=arm.doubt(), heights=arm.heights(),
        )  # fmt: skip
        if checked.plan is None:
            refused = refused or checked.problems[0].text
        elif tried.missed is None and strays(goal, checked.after or goal, doubt, still):
            refused = refused or "it would not come to what was meant"
        else:
            return checked, ""
    return None, refused


def _ways(tried: Tried, look: Look, tries: int) -> Iterator[tuple[Command, ...]]:
    """What may be tried next, the first to be tried first."""
    if tried.missed is None:
        yield from mendings(tried.forecast, tried.plan, look, tries)
    elif (commands := left(tried.forecast, tried.missed, look, tries, tried.last)) is not None:
        yield commands


def _asking(turn: Turn, tried: Tried, goal: Scene, touched: Sequence[str] | None) -> Turn:
    """The turn with the question who is to do what is left."""
    carried = {carry.id for carry in tried.plan}
    question = what_next(goal, tried.seen, touched, carried)
    if question is None:
        return turn
    return replace(turn, reply=f"{turn.reply} {question.text}", question=question)


def _withdrawn(
    turn: Turn,
    tried: Tried,
    predict: Predict,
    arm: Arm,
    touched: Sequence[str] | None,
    told: list[Waypoint],
) -> Turn:
    """The turn, the tool taken up from what it could not hold, suction off."""
    if tried.missed is None:
        return turn
    assert turn.program is not None and turn.kind is not None
    try:
        here = arm.start()
        away = check_commands(
            freed((), here), turn.program, turn.kind, tried.seen,
            predict=predict, workspace=arm.workspace, start=here, touched=touched,
        )  # fmt: skip
        if away.plan is not None:
            told += [step.told for step in arm.run(away.plan)]
    except RobotError as error:  # who cannot move asks for no further try
        reply = turn.reply.removesuffix(f" {turn.question.text}") if turn.question else turn.reply
        reply = f"{reply} Then I had to break off: {error}."
        turn = replace(turn, reply=reply, question=None)
    return replace(turn, trajectory=tuple(told))


def _again(tries: int) -> str:
    return f"It took me {tries} tries. " if tries > 1 else ""


def _failure(tried: Tried, wrong: str, tries: int, refused: str, untouched: Collection[str]) -> str:
    """What is known of a motion that did not come to what was meant, in plain words."""
    text = f"That did not go as planned: {wrong}"
    if untouched and not wrong and tried.missed is None:
        names = " and ".join(title(tried.forecast.scene.get(id_), tried.forecast.scene)
                             for id_ in untouched)  # fmt: skip
        return f"I cannot say that I touched {names}: I did not feel it, and cannot see it so well."
    if tried.missed is not None:
        count = f" in {tries} tries" if tries > 1 else ""
        name = _name(tried)
        text = f"I could not keep hold of {name}{count}. {wrong}"
    if refused:
        text += f" I did not try again: {refused}."
    elif tries > 1 and tried.missed is None:
        text += f" I tried {tries} times."
    return text.strip()


def _name(tried: Tried) -> str:
    """What was lost, by the scene where it can be seen no more."""
    assert tried.missed is not None
    shown = tried.seen if any(item.id == tried.missed.id for item in tried.seen) else None
    scene = shown or tried.forecast.scene
    return title(scene.get(tried.missed.id), scene)


def _broken_off(turn: Turn, error: RobotError, told: tuple[Waypoint, ...]) -> Turn:
    """A robot error is a refusal while nothing has moved, and a failure after that."""
    if isinstance(error, Cancelled) and told:
        reply = "Called off: I did not try again."
        return replace(turn, status="failed", reply=reply, reason="cancelled", trajectory=told)
    if isinstance(error, Cancelled):
        reply = "Called off: nothing moved."
        return replace(turn, status="refused", reply=reply, reason="cancelled")
    if isinstance(error, Stopped):
        return replace(
            turn, status="failed", reply=f"I was {error}.", reason="cancelled", trajectory=told
        )
    begun = bool(told) or (isinstance(error, LinkDown) and error.moving)
    if not begun and isinstance(error, Unreachable | NotReady | LinkDown):
        reason = "unreachable" if isinstance(error, Unreachable) else "unsafe"
        return replace(turn, status="refused", reply=f"I can't: {error}.", reason=reason)
    return replace(turn, status="failed", reply=f"I had to break off: {error}.", trajectory=told)
