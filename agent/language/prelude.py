"""The functions of the little language that are written in it: groups, places, skills.

`prelude.txt` holds them. They pass the same allow-list as any program, may call only those above
them (so nothing recurs), and all that moves in them is ``robot.move`` and ``robot.grip``. A
function that moves belongs to manipulate programs, one that states constraints to arrange
programs; the others to both.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from agent.messages import Kind

HANDLE_KINDS: Mapping[str, Kind] = {"robot": "manipulate", "solver": "arrange"}


@dataclass(frozen=True)
class Function:
    """One function: what it says of itself, a program that uses it, its statements, whose it is."""

    name: str
    parameters: tuple[str, ...]
    text: str
    example: str
    body: tuple[ast.stmt, ...]
    kind: Kind | None

    @property
    def usage(self) -> str:
        """How it is called."""
        return f"{self.name}({', '.join(self.parameters)})"


@cache
def prelude() -> tuple[Function, ...]:
    """All functions in the order of the file; read once a process."""
    source = (files("agent.language") / "prelude.txt").read_text(encoding="ascii")
    found: list[Function] = []
    for node in ast.parse(source).body:
        assert isinstance(node, ast.FunctionDef), "the prelude holds functions only"
        text, _, example = (ast.get_docstring(node) or "").partition("\n\n")
        body = tuple(node.body[1:])
        used = {name.id for part in body for name in ast.walk(part) if isinstance(name, ast.Name)}
        kinds = [one.kind for one in reversed(found) if one.name in used and one.kind is not None]
        if used & HANDLE_KINDS.keys():
            kinds.insert(0, next(HANDLE_KINDS[name] for name in used & HANDLE_KINDS.keys()))
        parameters = tuple(argument.arg for argument in node.args.args)
        found.append(
            Function(node.name, parameters, text, example, body, kinds[0] if kinds else None)
        )
    return tuple(found)


@cache
def functions(kind: Kind) -> Mapping[str, Function]:
    """What a program of this kind may call. One name can mean one thing in either kind."""
    return {one.name: one for one in prelude() if one.kind in (None, kind)}
