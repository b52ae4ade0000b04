"""Programs one after the other: what a later one says of a thing means it where it is by then."""

from __future__ import annotations

import re
from collections.abc import Sequence

_MOVES = re.compile(r"^(?:(\w+) = )?((?:put|put_on|push|set_down)\(([mw]\d+), )")


def remembered(programs: Sequence[str]) -> str:
    """The programs one after the other, each meaning things where they are by then.

    ``put(m1, ...)`` becomes ``w1 = put(m1, ...)`` where a later program speaks of ``m1``, and that
    one speaks of ``w1``. Names that a program chose for the same purpose become the same ones.
    What a program says of its own things stays as it is.
    """
    done: list[str] = []
    moved: dict[str, str] = {}
    for number, program in enumerate(programs):
        later = "\n".join(programs[number + 1 :])
        for thing, place in moved.items():
            program = _renamed(program, thing, place)
        lines = program.split("\n")
        for at in range(len(lines)):
            found = _MOVES.match(lines[at])
            if found is None:
                continue
            given, thing = found.group(1), found.group(3)
            new = f"w{thing[1:]}"
            if given is not None and program.count(f"{given} = ") == 1:
                lines = _renamed("\n".join(lines), given, new).split("\n")
            elif given is None and re.search(rf"\b{_origin(thing)}\b", later):
                lines[at] = f"{new} = {lines[at]}"
            else:
                continue
            moved[_origin(thing)] = new
        done += lines
    return "\n".join(done)


def _origin(thing: str) -> str:
    """The slot whose thing this is: itself, or the one that ``w1`` remembers."""
    return f"m{thing[1:]}" if thing[0] == "w" else thing


def _renamed(program: str, old: str, new: str) -> str:
    """The program with another name for a name; not in texts."""
    return re.sub(rf"""(?<!["'\w.]){old}(?!["'\w])""", new, program)
