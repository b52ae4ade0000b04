"""The reference page of the little language: every construct, each with an example that runs.

``python -m agent.language.reference > docs/language.md`` writes it; a test runs each example,
checks that together they use everything there is, and that the page is the one in docs/.
"""

from __future__ import annotations

import ast
import tomllib
from collections.abc import Iterator
from importlib.resources import files

import msgspec

from agent import program
from agent.language import allowed, arrange, functions, guards, run
from agent.language.builtin import HANDLES, INSTEAD, MATH_CALLS, MATH_CONSTANTS
from agent.language.prelude import Function, prelude
from agent.messages import Kind


class Entry(msgspec.Struct, frozen=True):
    """One construct: how it is written, what it does, and a program that uses it."""

    usage: str
    text: str
    example: str
    kind: Kind = "manipulate"


class Section(msgspec.Struct, frozen=True):
    """A heading of the page and what stands below it."""

    title: str
    entry: tuple[Entry, ...]


_ARGUMENTS = {1: "0.5", 2: "0.5, 0.25", 3: "0.5, 0.25, 0.1"}

LIMITS = (
    (f"{program.MAX_CHARACTERS:,} characters", "of text"),
    (f"{program.MAX_LINES} lines, {program.MAX_LINE} characters each", "of text"),
    (f"{program.MAX_BRACKETS} nested brackets", "of text"),
    (f"{program.MAX_IDENTIFIER} characters", "a name"),
    (f"{run.MAX_STEPS:,} steps", "a run"),
    (f"{run.MAX_COMMANDS} moves and grips", "a run"),
    (f"{arrange.MAX_CONSTRAINTS} constraints, {arrange.MAX_UNKNOWNS} unknowns", "a run"),
    (f"{guards.MAX_LIST:,} elements", "a list"),
    (f"{functions.MAX_RANGE:,} numbers", "a range"),
)


def sections() -> tuple[Section, ...]:
    """Everything there is, as the page has it."""
    text = (files("agent.language") / "reference.toml").read_text(encoding="utf-8")
    *host, solver = msgspec.convert(tomllib.loads(text)["section"], list[Section])
    own, skills, layouts = (
        tuple(_own(function) for function in prelude() if function.kind == kind)
        for kind in (None, "manipulate", "arrange")
    )
    return (
        *host,
        Section("`math`", tuple(_mathematics())),
        Section("Which objects, and places", own),
        Section("Skills (manipulate programs)", skills),
        solver,
        Section("Layouts (arrange programs)", layouts),
    )


def _own(function: Function) -> Entry:
    kind = function.kind or "manipulate"
    return Entry(f"`{function.usage}`", function.text, function.example, kind)


def _mathematics() -> Iterator[Entry]:
    yield Entry("`math.pi`, `math.tau`, `math.e`", "Constants.", "\n".join(
        f"robot.move(math.{name} / 10, 0, 1, 0)" for name in MATH_CONSTANTS))  # fmt: skip
    for name, (_, least, most) in MATH_CALLS.items():
        calls = [f"math.{name}({_ARGUMENTS[count]})" for count in range(least, most + 1)]
        text = "As Python's; of a number that has no real, finite result it is an error."
        example = "\n".join(f"robot.move(float({call}) / 60, 0, 1, 0)" for call in calls)
        yield Entry(", ".join(f"`{call}`" for call in calls), text, example)


def page() -> str:
    """The whole page."""
    return "\n".join([_HEAD, *_body(), *_refused(), *_tail()]) + "\n"


_HEAD = f"""# The little language

Written by `python -m agent.language.reference`; do not edit. Every example runs in a test on the
table that `armchat check` has by default (an apple, a banana, a cup, a plate, a box, a bottle).

A program is the body of a Python function. A **manipulate** program drives the arm:
{HANDLES["robot"][2]}. An **arrange** program states where things that
wait in the tray go: {HANDLES["solver"][2]}.
Both read the objects of the scene.

The table is the square -1 <= x <= 1, -1 <= y <= 1: x to the right, y away from the person, z up
from the table's surface. A unit is half a table side. Angles are radians, anticlockwise from
above. Objects keep the numbers that they had when the program started.

Functions of the prelude (places, skills) are written in the language themselves
(`agent/language/prelude.txt`): whatever a program calls, the arm gets `robot.move` and
`robot.grip` only, and `armchat check --explain` shows them."""


def _body() -> Iterator[str]:
    for section in sections():
        yield from ("", f"## {section.title}")
        for entry in section.entry:
            kind = "" if entry.kind == "manipulate" else f" ({entry.kind})"
            yield from ("", f"### {entry.usage}{kind}", "", entry.text, "", "```python")
            yield from entry.example.split("\n")
            yield "```"


def _refused() -> Iterator[str]:
    yield from ("", "## What is refused, and what to write instead", "", "| construct | answer |",
                "|---|---|")  # fmt: skip
    for node, text in INSTEAD.items():
        yield f"| {node.__name__} | {text.replace('|', chr(92) + '|')} |"
    others = sorted(
        kind.__name__ for kind in _all_nodes() if kind not in INSTEAD and not _listed(kind)
    )
    yield from ("", f"Nor are there: {', '.join(others)}.")


def _all_nodes() -> Iterator[type[ast.AST]]:
    for base in (ast.stmt, ast.expr, ast.operator, ast.unaryop, ast.cmpop, ast.boolop):
        yield from base.__subclasses__()


def _listed(kind: type[ast.AST]) -> bool:

    operators = (
        *allowed.BINARY,
        *allowed.UNARY,
        *allowed.BOOLEAN,
        *allowed.ORDER,
        *allowed.IDENTITY,
    )
    return kind in allowed.STATEMENTS or kind in allowed.EXPRESSIONS or kind in operators


def _tail() -> Iterator[str]:
    yield from ("", "## Limits", "", "| at most | in |", "|---|---|")
    for most, where in LIMITS:
        yield f"| {most} | {where} |"


if __name__ == "__main__":
    print(page(), end="")
