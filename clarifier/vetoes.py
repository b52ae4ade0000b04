"""Why a program that was tried is not acted on: a problem forbids it and is said; a mistake, where
it does something else than the sentence means, leaves it no probability.

The rules are told only what they need and live elsewhere; here are the two tables of them. A new
one is a line.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from agent.check import Checked
from agent.messages import Command, Problem
from clarifier.binding import Binding
from clarifier.denied_places import stands_there
from clarifier.mistaken import (
    chooses_the_edge,
    ends_uncorrected,
    goes_all_the_way,
    goes_too_far,
    leaves_the_subject,
    moves_for_a_motion,
    moves_the_arm_alone,
    moves_what_stays,
    parts_a_figure,
    parts_the_group,
    sets_upon,
    shifted,
    takes_the_goal,
    too_few_for_a_figure,
    turns_for_a_swap,
)
from clarifier.placed import leaves_a_part
from clarifier.roomy import too_large
from clarifier.set_upon import not_set_upon
from clarifier.spoken import Linked
from clarifier.unasked import (
    disturbed,
    does_nothing,
    draws_another,
    drops_condition,
    falls_elsewhere,
    keeps_to_one_axis,
    moved_by_the_tool,
    moves_the_landmark,
    names_two_axes,
    says_topple,
    still_stands,
    touched,
    touches_untold,
    unasked_fall,
    unasked_topple,
)
from clarifier.waiting import left_waiting
from scene.types import Scene


@dataclass(frozen=True)
class Tried:
    """A program that was tried for a sentence: its ``body`` over slots, the ``program`` over the
    names of the scene ``before`` that a ``binding`` makes of it, and what the check says of it."""

    linked: Linked
    body: str
    program: str
    binding: Binding
    before: Scene
    checked: Checked

    @property
    def text(self) -> str:
        """The sentence."""
        return self.linked.text

    @property
    def ends(self) -> bool:
        """Whether it comes to an end at all."""
        return self.checked.after is not None

    @property
    def after(self) -> Scene:
        """How things stand at its end; only of a program that ``ends``."""
        assert self.checked.after is not None
        return self.checked.after

    @property
    def commands(self) -> Sequence[Command]:
        """What it tells the robot."""
        return self.checked.commands

    @cached_property
    def shifted(self) -> set[str]:
        """What it moves, takes or lets go."""
        return shifted(self.before, self.after)

    @property
    def unfallen(self) -> Problem | None:
        """What it is to knock over and would not."""
        return still_stands(self.body, self.binding, self.before, self.after)


def problem_of(tried: Tried) -> Problem | None:
    """Why a program may not run, None if it may: what is too large to go where it is to, else the
    first of `PROBLEMS`."""
    large = too_large(tried.body, tried.linked, tried.binding, tried.before)
    return large or _problem_at_its_end(tried)


def mistaken(tried: Tried) -> bool:
    """Whether a program does something else than the sentence means, however sure it is."""
    return tried.ends and any(differs(tried) for differs in MISTAKES)


def _found(tried: Tried) -> Problem | None:
    """What the check finds first."""
    return next(iter(tried.checked.problems), None)


def _problem_at_its_end(tried: Tried) -> Problem | None:
    said = PROBLEMS if tried.ends else (_found,)
    return next(filter(None, (forbids(tried) for forbids in said)), None)


PROBLEMS: tuple[Callable[[Tried], Problem | None], ...] = (
    lambda t: left_waiting(t.linked, t.binding, t.before, t.after),
    lambda t: touched(t.linked.untouchable, t.before, t.commands),
    lambda t: stands_there(t.linked.denied, t.before, t.after),
    lambda t: disturbed(t.linked.spared, t.before, t.after),
    _found,
    lambda t: unasked_fall(t.text, t.before, t.after),
    lambda t: falls_elsewhere(t.text, t.before, t.after),
    lambda t: unasked_topple(t.text, t.before, t.after),
    lambda t: moved_by_the_tool(t.linked, t.before, t.after),
    lambda t: t.unfallen if says_topple(t.text) else None,
)
"""What forbids a program that comes to an end: the first is said. What waits and what the sentence
rules out come before what the check finds, and that before what nobody asked for."""

MISTAKES: tuple[Callable[[Tried], bool], ...] = (
    lambda t: parts_a_figure(t.linked, t.body),
    lambda t: too_few_for_a_figure(t.body, t.binding),
    lambda t: leaves_a_part(t.linked, t.shifted, t.before, t.after),
    lambda t: not says_topple(t.text) and t.unfallen is not None,
    lambda t: moves_the_landmark(t.linked, t.binding, t.shifted),
    lambda t: names_two_axes(t.text) and keeps_to_one_axis(t.before, t.after),
    lambda t: does_nothing(t.program, t.before, t.after, t.commands),
    lambda t: draws_another(t.linked, t.program, t.commands),
    lambda t: drops_condition(t.text, t.body),
    lambda t: touches_untold(t.text, t.body),
    lambda t: moves_the_arm_alone(t.linked, t.body, t.shifted),
    lambda t: moves_for_a_motion(t.linked, t.shifted),
    lambda t: turns_for_a_swap(t.linked, t.body),
    lambda t: leaves_the_subject(t.linked, t.binding, t.shifted),
    lambda t: moves_what_stays(t.linked, t.binding, t.shifted),
    lambda t: takes_the_goal(t.linked, t.body, t.binding, t.before, t.shifted),
    lambda t: sets_upon(t.linked, t.binding, t.before, t.after),
    lambda t: ends_uncorrected(t.linked, t.binding, t.after, t.shifted),
    lambda t: goes_all_the_way(t.linked, t.body),
    lambda t: chooses_the_edge(t.linked, t.body),
    lambda t: goes_too_far(t.linked, t.body),
    lambda t: parts_the_group(t.linked, t.body),
    # Where a problem keeps it from ending there, that is what is to be said.
    lambda t: not_set_upon(t.linked, t.body, t.binding, t.after) and not _problem_at_its_end(t),
)
"""What makes a program that comes to an end another than the one meant."""
