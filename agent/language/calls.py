"""What the calls of a program do: functions, methods of values, ``robot`` and ``solver``."""

from __future__ import annotations

from collections.abc import Callable

from agent.errors import LimitReached, ProgramFailed
from agent.language import expression as linear
from agent.language import functions, guards
from agent.language.expression import Constraint, Expression, Relation, Strength
from agent.language.guards import Number, Value
from agent.language.run import MAX_COMMANDS, SOLVE_STEPS, Evaluate, Run
from agent.language.things import Choice, Thing, choose
from agent.messages import Command


def call_function(function: Callable[..., Value], arguments: list[Evaluate]) -> Evaluate:
    """A call of a guarded function; it counts one step and one for each element given."""

    def compute(run: Run) -> Value:
        values = [argument(run) for argument in arguments]
        run.step(1 + sum(_size(value) for value in values))
        return function(*values)

    return compute


def _size(value: Value) -> int:
    """Elements of a list, and of the lists in it: what putting them in order has to look at."""
    if not isinstance(value, list | tuple):
        return 0
    return len(value) + sum(len(part) for part in value if isinstance(part, list | tuple))


def value_of(run: Run, owner: Value) -> Value:
    """``owner.value()``: an unknown's value in the last solution; a number is its own value."""
    if isinstance(owner, Expression):
        run.step()
        return run.solver.value(owner)
    return guards.number(owner, ".value()")


def append(run: Run, owner: Value, item: Value) -> None:
    """``owner.append(item)``."""
    run.step()
    if not isinstance(owner, list):
        raise ProgramFailed(f".append() belongs to a list, not to {guards.describe(owner)}")
    owner.append(item)
    guards.sized(owner)


def variable(run: Run, name: Value) -> Value:
    """``Variable(name)``: a free unknown; the name is for the reader."""
    if not isinstance(name, str):
        raise ProgramFailed('Variable needs a name: write Variable("gap")')
    return run.solver.variable()


def group(run: Run, words: Value = "") -> Value:
    """``group(words)``: the objects that have all the words; without words, all there are."""
    if not isinstance(words, str):
        raise ProgramFailed('group needs words: write group("red block")')
    there = [item for item in run.objects.values() if item is not None]
    chosen = choose(there, words, waiting=run.arrangement is not None)
    run.step(1 + len(there))
    return guards.sized([Thing(item) for item in chosen])


def where(run: Run, place: Value) -> Value:
    """``where(place)``: the x and y of an object, unknown in the tray, or of a list of the two."""
    if isinstance(place, Thing):
        item = place.item
        run.step()
        return [
            run.unknown(item, axis) if value is None else value
            for axis, value in (("x", item.x), ("y", item.y))
        ]
    parts = guards.items(place, "a place")
    if len(parts) != 2:
        raise ProgramFailed("a place is an object, or a list [x, y]")
    return list(parts)


def known(run: Run, place: Value) -> Value:
    """``known(place)``: whether both its numbers are there: nothing is left to the solver."""
    return not any(
        isinstance(part, Expression) for part in guards.items(where(run, place), "known")
    )


def either(run: Run, places: Value) -> Value:
    """``either(places)``: the first of the places, which remembers that the others do as well."""
    spots = [where(run, place) for place in guards.items(places, "either")]
    if not spots:
        raise ProgramFailed("either needs at least one place")
    return Choice(guards.items(spots[0], "either"), guards.sized(spots))


def choices(run: Run, place: Value) -> Value:
    """``choices(place)``: the places that do as well, best first; of any other place itself."""
    spots = list(place.places) if isinstance(place, Choice) else [where(run, place)]
    run.step(1 + len(spots))
    return spots


def about(run: Run, number: Value) -> Value:
    """``about(number)``: the number; to the solver one that is strongly wished to be it."""
    return _free(run, guards.number(number, "about"), ("==", "strong"))


def no_less(run: Run, number: Value) -> Value:
    """``no_less(number)``: the number; to the solver one no less, and no more than need be."""
    return _free(run, guards.number(number, "no_less"), (">=", "required"), ("==", "medium"))


def _free(run: Run, wanted: Number, *ties: tuple[Relation, Strength]) -> Value:
    """The number itself, or in an arrangement an unknown tied to it: (relation, strength) each."""
    run.step()
    if run.arrangement is None:
        return wanted
    unknown = run.arrangement.variable()
    for relation, strength in ties:
        run.arrangement.add(linear.relate(unknown, relation, wanted, strength), run.line)
    return unknown


def wish(run: Run, number: Value, wanted: Value) -> Value:
    """``wish(number, wanted)``: the number, which the solver makes what is wanted where nothing
    else decides it."""
    run.step()
    if isinstance(number, Expression):
        value = guards.number(wanted, "wish")
        run.solver.wish(number, value, run.line)
        return number
    return guards.number(number, "wish")


def so_far(run: Run, place: Value) -> Value:
    """``so_far(place)``: its numbers by the constraints that were stated so far; None where nothing
    speaks of any of them."""
    parts = guards.items(where(run, place), "so_far")
    if run.arrangement is None or known(run, place):
        return list(parts)
    run.step(SOLVE_STEPS)
    numbers = [part if isinstance(part, Expression) else float(guards.number(part, "so_far"))
               for part in parts]  # fmt: skip
    found = run.arrangement.so_far(numbers)
    return None if found is None else list(found)


def tool_at(run: Run, *arguments: Value) -> Value:
    """``tool_at(x, y, z)``: whether the program took the tool there last, unturned."""
    numbers = [float(guards.number(part, "tool_at")) for part in arguments]
    run.step()
    if not run.commands:
        return False
    last = run.commands[-1]
    return [last.x, last.y, last.z, last.r] == [*numbers, 0.0]


def placed(run: Run, *arguments: Value) -> Value:
    """``placed(thing, x, y, z)``: the object as it stands there from now on, `present` says so."""
    thing = functions.standing(*arguments)
    run.step()
    run.placed[thing.item.id] = thing.item
    return thing


def turned(run: Run, thing: Value, angle: Value) -> Value:
    """``turned(thing, angle)``: the object turned so much further (radians) from now on, where it
    stands by now."""
    now = by_now(run, guards.thing(thing, "turned"))
    assert isinstance(now, Thing)
    moved = now.turned(float(guards.number(angle, "turned")))
    run.placed[moved.item.id] = moved.item
    return moved


def present(run: Run) -> Value:
    """``present()``: all that stands on the table where it stands by now; in an arrange program
    also what waits in the tray."""
    gone = {"floor"} if run.arrangement is not None else {"floor", "tray"}
    there = [item for item in run.objects.values() if item is not None and item.on not in gone]
    run.step(1 + len(there))
    return guards.sized([Thing(run.placed.get(item.id, item)) for item in there])


def by_now(run: Run, thing: Value) -> Value:
    """``by_now(thing)``: the object where it stands by now; as given where the program says itself
    where that is."""
    run.step()
    if not isinstance(thing, Thing):
        return thing  # what uses it says what it needs
    began = next((one for one in run.objects.values() if one and one.id == thing.item.id), None)
    moved = run.placed.get(thing.item.id)
    return Thing(moved) if moved is not None and thing.item == began else thing


def same_color(run: Run, one: Value, other: Value) -> Value:
    """``same_color(one, other)``: whether both have one colour, or no colour and one name."""
    run.step()
    if not isinstance(one, Thing) or not isinstance(other, Thing):
        raise ProgramFailed("same_color needs two objects")
    return one.look == other.look


def open_box(run: Run, thing: Value) -> Value:
    """``open_box(thing)``: whether it is a container with four walls that stands open."""
    run.step()
    return guards.thing(thing, "open_box").open_box


def call_own(name: str, arguments: list[Evaluate]) -> Evaluate:
    """A call of a function written in the language: variables of its own, the caller's line."""

    def call(run: Run) -> Value:
        values = [argument(run) for argument in arguments]
        run.step()
        parameters, body = run.own(name)
        outer, run.variables = run.variables, dict(zip(parameters, values, strict=True))
        run.within += 1
        try:
            returned = body(run)
        except ProgramFailed as error:
            if run.within > 1:
                raise
            raise type(error)(f"{name}: {error.reason}") from None
        finally:
            run.variables = outer
            run.within -= 1
        return run.result if returned else None

    return call


def _move(arguments: list[Evaluate]) -> Evaluate:
    def move(run: Run) -> None:
        x, y, z, r = [float(guards.number(part(run), "robot.move")) for part in arguments]
        _command(run, Command("move", x, y, z, r, run.gripping, run.line, run.statement))

    return move


def _grip(arguments: list[Evaluate]) -> Evaluate:
    def grip(run: Run) -> None:
        on = guards.number(arguments[0](run), "robot.grip")
        if on not in (0, 1):
            raise ProgramFailed("robot.grip takes True or False")
        run.gripping = bool(on)
        # Before any move the position is the robot's own: the check fills it in.
        last = run.commands[-1] if run.commands else Command("grip", 0.0, 0.0, 0.0, 0.0, False)
        _command(
            run,
            Command("grip", last.x, last.y, last.z, last.r, run.gripping, run.line, run.statement),
        )

    return grip


def _command(run: Run, command: Command) -> None:
    if len(run.commands) >= MAX_COMMANDS:
        raise LimitReached(f"a program moves and grips at most {MAX_COMMANDS} times")
    run.step()
    run.commands.append(command)


def _add_constraint(arguments: list[Evaluate]) -> Evaluate:
    def add(run: Run) -> None:
        run.step()
        given = arguments[0](run)
        if not isinstance(given, bool | Constraint):
            text = "solver.addConstraint needs a comparison, such as apple.x <= 0, not "
            raise ProgramFailed(text + guards.describe(given))
        run.solver.add(given, run.line)

    return add


def _solve(arguments: list[Evaluate]) -> Evaluate:
    def solve(run: Run) -> None:
        run.step(SOLVE_STEPS)
        run.solver.solve()

    return solve


HANDLE_CALLS: dict[tuple[str, str], Callable[[list[Evaluate]], Evaluate]] = {
    ("robot", "move"): _move,
    ("robot", "grip"): _grip,
    ("solver", "addConstraint"): _add_constraint,
    ("solver", "solve"): _solve,
}
