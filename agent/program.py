"""The little language: what a program may say; source -> Program or NotAllowed.

A program is the body of a Python function in one of two forms: ``manipulate`` drives
``robot.move(x, y, z, r)`` and ``robot.grip(on)``; ``arrange`` states constraints for the
``solver``. Three passes, none of which runs anything: a text scan (length, characters, depth),
Python's own parser, and an allow-list by exact node type (`agent.language.allowed`).

Protects against: constructs, names and attributes outside the language, source tricks
(control characters, line continuation, non-ASCII look-alikes), inputs that exhaust the parser.
Does not protect against: long computations (the budgets of `agent.language.interpret`), faults of
the solver (the process of `agent.language.worker`), motions that do harm (`agent.check`).
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from agent.errors import NotAllowed
from agent.language.allowed import Checker
from agent.language.naming import Names
from agent.messages import Kind

MAX_CHARACTERS = 8192
MAX_LINES = 200
MAX_LINE = 300
MAX_BRACKETS = 20
MAX_DIGITS = 30
MAX_IDENTIFIER = 40
MAX_DEPTH = 80
"""Levels of the syntax tree, so that no later pass runs out of stack."""
MAX_OPERATOR_RUN = 60
"""Prefix operators in a row (``- - - x``): Python's parser recurses over them."""

_OPENING, _CLOSING = "([{", ")]}"
_TOKEN = re.compile(
    r"""((?:\b[A-Za-z]{1,2})?(?:"[^"\n]*"|'[^'\n]*')|\#[^\n]*)|(?<![\w.])(?<!\.[ ])([A-Za-z_]\w*)"""
)
_PREFIX_RUN = re.compile(rf"(?:(?:not\b|lambda\b|await\b|[-+~:*])\s*){{{MAX_OPERATOR_RUN}}}")


@dataclass(frozen=True)
class Program:
    """A program that passed the allow-list, for scenes with one set of names.

    ``objects`` are the scene's names it uses, ``absent`` names it tests for None that the scene
    does not have, ``variables`` the names it assigns. ``body`` is its tree: never changed.
    """

    source: str
    kind: Kind
    body: tuple[ast.stmt, ...]
    objects: frozenset[str]
    absent: frozenset[str]
    variables: frozenset[str]


def parse(source: str, kind: Kind, names: Collection[str]) -> Program:
    """Source of a program over a scene with these object names -> Program.

    A name outside ``names`` is taken for an object that is not there (None) only where the
    program itself asks (``apple is None``, ``if apple:``). Raises NotAllowed with line, column
    and what to write instead. Pure.
    """
    return resolve(read_tree(source), source, kind, names)


class Tree(NamedTuple):
    """What Python's parser made of a source: its statements, and all nodes of a walk over them."""

    body: tuple[ast.stmt, ...]
    nodes: tuple[ast.AST, ...]


def resolve(tree: Tree, source: str, kind: Kind, names: Collection[str]) -> Program:
    """The part of `parse` that depends on the scene's names: the allow-list."""
    scope = Names.of(tree.nodes, names)
    checker = Checker(kind, scope)
    checker.block(tree.body)
    return Program(source, kind, tree.body, frozenset(checker.used), scope.absent, scope.variables)


def read_tree(source: str) -> Tree:
    """Text scan, then Python's parser. Raises NotAllowed."""
    scan(source)
    try:
        tree = ast.parse(source)
    except SyntaxError as error:
        text = f"this is not valid Python ({error.msg})"
        raise NotAllowed(text, error.lineno or 0, error.offset or 0) from None
    except (RecursionError, MemoryError, ValueError):
        raise NotAllowed("the program is nested too deeply: write shorter expressions") from None
    if not tree.body:
        raise NotAllowed("the program is empty: write at least one statement")
    return Tree(tuple(tree.body), _nodes(tree))


def scan(source: str) -> None:
    """Refuse, without parsing, a text that is too long or holds anything but plain text.

    Raises NotAllowed.
    """
    if len(source) > MAX_CHARACTERS:
        raise NotAllowed(f"the program is longer than {MAX_CHARACTERS} characters: shorten it")
    lines = source.split("\n")
    if len(lines) > MAX_LINES:
        raise NotAllowed(f"the program has more than {MAX_LINES} lines: use a loop")
    for number, line in enumerate(lines, 1):
        _scan_line(line, number)
    _scan_brackets(lines)
    if _PREFIX_RUN.search(source):
        raise NotAllowed("too many operators in a row: write shorter expressions")


def _scan_line(line: str, number: int) -> None:
    if len(line) > MAX_LINE:
        raise NotAllowed(f"the line is longer than {MAX_LINE} characters: split it", number)
    for column, character in enumerate(line, 1):
        if not " " <= character <= "~":
            text = f"the character U+{ord(character):04X} is not allowed: write plain ASCII"
            if character == "\t":
                text = "a tab is not allowed: indent with four spaces"
            raise NotAllowed(text, number, column)
    for pattern, text in _FORBIDDEN:
        found = pattern.search(line)
        if found:
            raise NotAllowed(text, number, found.start() + 1)


_FORBIDDEN = (
    (re.compile(r"\\"), "a backslash is not allowed: put long expressions in brackets"),
    (re.compile(r"__"), "two underscores in a row are not allowed: choose another name"),
    (
        re.compile(rf"[0-9_]{{{MAX_DIGITS + 1}}}"),
        f"a number with more than {MAX_DIGITS} digits is not allowed: round it",
    ),
    (
        re.compile(rf"\w{{{MAX_IDENTIFIER + 1}}}"),
        f"a name longer than {MAX_IDENTIFIER} characters is not allowed: shorten it",
    ),
)


def _scan_brackets(lines: list[str]) -> None:
    """Brackets inside strings and comments count too: the cap is far above honest programs."""
    depth = 0
    for number, line in enumerate(lines, 1):
        for column, character in enumerate(line, 1):
            if character in _OPENING:
                depth += 1
            elif character in _CLOSING:
                depth = max(0, depth - 1)
            if depth > MAX_BRACKETS:
                text = f"more than {MAX_BRACKETS} nested brackets: use variables for the parts"
                raise NotAllowed(text, number, column)


def _nodes(tree: ast.Module) -> tuple[ast.AST, ...]:
    """All nodes, level by level. Raises NotAllowed below MAX_DEPTH levels."""
    found: list[ast.AST] = []
    level: list[ast.AST] = [tree]
    for _ in range(MAX_DEPTH):
        found += level
        level = [child for node in level for child in ast.iter_child_nodes(node)]
        if not level:
            return tuple(found)
    line, column = getattr(level[0], "lineno", 0), getattr(level[0], "col_offset", -1) + 1
    raise NotAllowed("the program is nested too deeply: use variables for the parts", line, column)


def instantiate(body: str, binding: Mapping[str, str]) -> str:
    """Replace whole identifiers at once (``{"m1": "apple"}``): not in strings, comments, ``.m1``.

    Pure text; works on any body, valid or not.
    """

    def swap(found: re.Match[str]) -> str:
        name = found.group(2)
        return found.group(0) if name is None else binding.get(name, name)

    return _TOKEN.sub(swap, body)
