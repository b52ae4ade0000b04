"""Python itself runs bodies of the language, on plain stand-ins: robot, solver and objects.

An independent second opinion for `test_agent_differential`: nothing here is shared with the
interpreter but the text of its prelude.
"""

import ast
import math
from dataclasses import dataclass
from functools import cache

from program_texts import called, free_names, prelude

from agent.language.builtin import OBJECT_NUMBERS, STRENGTHS
from scene.kinds import CONTAINERS, FOUR_WALLED, head_noun
from scene.relations import extents
from scene.types import EDGE, identifiers

RAISED = (
    ZeroDivisionError, TypeError, IndexError, ValueError, OverflowError, AttributeError, NameError,
)  # fmt: skip
"""What Python raises where the language reports a ProgramError."""


@cache
def python_code(program, kind):
    """The prelude of the language and a function ``body`` of its objects, compiled by Python."""
    tree = ast.parse(f"def body({', '.join(free_names(program))}):\n    pass")
    tree.body[0].body = ast.parse(program).body
    if called(tree) & {*prelude(kind)}:
        tree.body[:0] = prelude(kind).values()
    return compile(tree, "<body>", "exec")


def run_in_python(program, kind, objects, ready):
    """Run a body on these objects. ``ready``: what a body finds ready, beyond Python's own."""
    namespace = {"math": math, "where": where, "known": known, "at": at, "open_box": open_box,
                 "same_color": same_color, "either": either, "choices": choices,
                 "about": number, "no_less": number, "wish": number, "so_far": where,
                 "tool_at": lambda *place: False,
                  **present_of(objects.values()), **ready}  # fmt: skip
    exec(python_code(program, kind), namespace)
    namespace["body"](**{name: objects.get(name) for name in free_names(program)})


class PlainObject:
    """What an object on the table is when Python runs a body."""

    __hash__ = None

    def __init__(self, item, **changed):
        self.item = item
        self.words = {*item.name.split(), item.color}
        self.__dict__ |= {name: getattr(item, name) for name in OBJECT_NUMBERS} | changed

    def __eq__(self, other):
        return isinstance(other, PlainObject) and other.item.id == self.item.id


def group_of(objects):
    """What ``group`` is when Python runs a body on these objects."""
    return lambda words="": [thing for thing in objects if {*words.split()} <= thing.words]


def present_of(objects):
    """What ``present`` and ``placed`` are when Python runs a body on these objects."""
    now = {thing.item.id: thing for thing in objects if thing and thing.item.on != "floor"}

    def placed(thing, x, y, z):
        now[thing.item.id] = at(thing, x, y, z)
        return now[thing.item.id]

    def turned(thing, angle):
        here = by_now(thing)
        now[thing.item.id] = PlainObject(thing.item, x=here.x, y=here.y, z=here.z,
                                         r=math.remainder(here.r + angle, math.tau))  # fmt: skip
        return now[thing.item.id]

    def by_now(thing):
        if not hasattr(thing, "item") or thing.item.on == "tray":
            return thing  # what waits has no place that it could have left
        began = {one.item.id: one for one in objects if one}.get(thing.item.id)
        where_it_was = began is not None and (thing.x, thing.y, thing.z) == (
            began.x,
            began.y,
            began.z,
        )
        return now.get(thing.item.id, thing) if where_it_was else thing

    return {
        "placed": placed,
        "turned": turned,
        "present": lambda: list(now.values()),
        "by_now": by_now,
    }


def same_color(one, other):
    """What ``same_color`` is when Python runs a body."""
    return (one.item.color or one.item.name) == (other.item.color or other.item.name)


def open_box(one):
    """What ``open_box`` is when Python runs a body."""
    return one.item.upright and head_noun(one.item.name) in CONTAINERS & FOUR_WALLED


def where(place):
    return [place.x, place.y] if isinstance(place, PlainObject) else [place[0], place[1]]


class Choice(list):
    """What ``either`` gives: the first of the places, with all of them."""


def either(places):
    first = Choice(where(places[0]))
    first.places = [where(place) for place in places]
    return first


def choices(place):
    return list(place.places) if isinstance(place, Choice) else [where(place)]


def known(place):
    return all(isinstance(part, int | float) for part in where(place))


def number(value, wanted=None):
    """What ``about``, ``no_less`` and ``wish`` are where no solver is asked."""
    return value


def at(thing, x, y, z):
    return PlainObject(thing.item, x=float(x), y=float(y), z=float(z), r=thing.r)


class RecordingRobot:
    """What ``robot`` is when Python runs a body."""

    def __init__(self):
        self.commands = []
        self.pose = (0.0, 0.0, 0.0, 0.0)
        self.gripping = False

    def move(self, x, y, z, r):
        self.pose = (float(x), float(y), float(z), float(r))
        self.commands.append(("move", *self.pose, self.gripping))

    def at(self, x, y, z):
        """What ``tool_at`` is when Python runs a body."""
        return bool(self.commands) and self.pose == (x, y, z, 0.0)

    def grip(self, on):
        self.gripping = bool(on)
        self.commands.append(("grip", *self.pose, self.gripping))


def python_commands(program, scene):
    """The commands that Python records, or what it raised."""
    robot = RecordingRobot()
    objects = {name: PlainObject(item) for name, item in identifiers(scene).items()}
    try:
        ready = {"robot": robot, "tool_at": robot.at, "group": group_of(objects.values())}
        run_in_python(program, "manipulate", objects, ready)
    except RAISED as error:
        return error
    return robot.commands


# --- constraints -----------------------------------------------------------------------------


class NoSolution(Exception):
    """A constraint that cannot hold."""


@dataclass(frozen=True)
class Stated:
    """``sum(coefficient * unknown) + constant relation 0``, as a body states it."""

    terms: dict
    constant: float
    relation: str
    strength: str = "required"

    def __or__(self, strength):
        assert strength in STRENGTHS
        return Stated(self.terms, self.constant, self.relation, strength)

    def __bool__(self):
        raise TypeError("a constraint has no truth value")


class Sum:
    """A linear expression of unknowns; a second, independent implementation."""

    __hash__ = None

    def __init__(self, layout, terms, constant=0.0):
        self.layout, self.terms, self.constant = layout, terms, constant

    def _plus(self, other, factor):
        terms, constant = (other.terms, other.constant) if isinstance(other, Sum) else ({}, other)
        merged = dict(self.terms)
        for key, coefficient in terms.items():
            merged[key] = merged.get(key, 0.0) + factor * coefficient
        kept = {key: value for key, value in merged.items() if abs(value) > 1e-12}
        return Sum(self.layout, kept, self.constant + factor * constant)

    def _times(self, factor):
        terms = {key: value * factor for key, value in self.terms.items() if value * factor}
        return Sum(self.layout, terms, self.constant * factor)

    def _compared(self, other, relation):
        difference = self._plus(other, -1)
        return Stated(difference.terms, difference.constant, relation)

    def __add__(self, other):
        return self._plus(other, 1)

    def __radd__(self, other):
        return self._plus(other, 1)

    def __sub__(self, other):
        return self._plus(other, -1)

    def __rsub__(self, other):
        return self._times(-1)._plus(other, 1)

    def __mul__(self, factor):
        return self._times(factor)

    def __rmul__(self, factor):
        return self._times(factor)

    def __truediv__(self, divisor):
        return self._times(1 / divisor)

    def __neg__(self):
        return self._times(-1)

    def __pos__(self):
        return self

    def __le__(self, other):
        return self._compared(other, "<=")

    def __ge__(self, other):
        return self._compared(other, ">=")

    def __eq__(self, other):
        return self._compared(other, "==")

    def __bool__(self):
        raise TypeError("an unknown has no truth value")

    def value(self):
        return self.constant + sum(c * self.layout.solution[key] for key, c in self.terms.items())


class TrayObject(PlainObject):
    """What an object that waits in the tray is when Python runs a body: its x, y are unknowns."""

    def __init__(self, item, layout):
        super().__init__(item)
        self.layout = layout
        del self.x, self.y

    def __getattr__(self, name):
        return self.layout.coordinate(self.item, "xy".index(name))


class RecordingSolver:
    """What ``solver`` is when Python runs a body: it records, and solves by looking answers up.

    Unknowns are numbered as they come up. An object that is constrained for the first time has
    both its coordinates numbered, and bounds that keep it on the table.
    """

    def __init__(self, solutions):
        self.stated = []
        self.solution = None
        self._solutions = iter(solutions)
        self._coordinates = {}
        self._owners = {}
        self._placed = set()
        self._unknowns = 0
        self._spoken_of = set()

    def variable(self, name):
        self._unknowns += 1
        return Sum(self, {self._unknowns - 1: 1.0})

    def coordinate(self, item, axis):
        if (item.id, axis) not in self._coordinates:
            unknown = self._coordinates[item.id, axis] = self.variable(item.id)
            self._owners.update(dict.fromkeys(unknown.terms, item))
        return self._coordinates[item.id, axis]

    def addConstraint(self, constraint):  # noqa: N802
        if not constraint_has_terms(constraint):
            if constraint is False:
                raise NoSolution
            return
        self._place(constraint)
        self.stated.append(constraint)

    def _place(self, constraint):
        self._spoken_of |= constraint.terms.keys()
        for item in [self._owners.get(key) for key in constraint.terms]:
            if item is not None and item.id not in self._placed:
                self._placed.add(item.id)
                self.stated += self._bounds(item)

    def about(self, wanted):
        """What ``about`` is in an arrange program."""
        unknown = self.variable("about")
        self.addConstraint((unknown == wanted) | "strong")
        return unknown

    def no_less(self, least):
        """What ``no_less`` is in an arrange program."""
        unknown = self.variable("no_less")
        self.addConstraint(unknown >= least)
        self.addConstraint((unknown == least) | "medium")
        return unknown

    def wish(self, number, wanted):
        """What ``wish`` is: it states nothing, but from now on the solver knows the thing."""
        if isinstance(number, Sum) and not self._spoken_of & number.terms.keys():
            self._place(number == wanted)
        return number

    def so_far(self, place):
        """What ``so_far`` is in an arrange program."""
        parts = where(place)
        unknown = [part for part in parts if isinstance(part, Sum)]
        if not unknown:
            return parts
        if not any(self._spoken_of & part.terms.keys() for part in unknown):
            return None
        self.solve()
        return [part.value() if isinstance(part, Sum) else part for part in parts]

    def _bounds(self, item):
        for axis, half in enumerate(extents(item)):
            unknown = self.coordinate(item, axis)
            yield unknown >= half - EDGE
            yield unknown <= EDGE - half

    def solve(self):
        self.solution = next(self._solutions, None)
        if self.solution is None:
            raise NoSolution


def constraint_has_terms(constraint):
    assert isinstance(constraint, bool | Stated)
    return isinstance(constraint, Stated) and bool(constraint.terms)


def python_constraints(program, scene, solutions):
    """What a body states when Python runs it, and whether it got to its end."""
    solver = RecordingSolver(solutions)
    objects = {
        name: TrayObject(item, solver) if item in scene.tray else PlainObject(item)
        for name, item in identifiers(scene).items()
    }
    group = group_of([thing for thing in objects.values() if isinstance(thing, TrayObject)])
    ready = {"solver": solver, "Variable": solver.variable, "group": group, "about": solver.about,
             "no_less": solver.no_less, "wish": solver.wish, "so_far": solver.so_far}  # fmt: skip
    try:
        run_in_python(program, "arrange", objects, ready)
    except NoSolution:
        return solver.stated, False
    return solver.stated, True
