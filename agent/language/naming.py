"""What the names in a program can mean: objects of the scene, objects it lacks, own variables."""

from __future__ import annotations

import ast
import difflib
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from agent.language.builtin import RESERVED


@dataclass(frozen=True)
class Names:
    """The names a program can mean: of the scene, absent from it, and its own variables."""

    scene: frozenset[str]
    absent: frozenset[str]
    variables: frozenset[str]

    @staticmethod
    def of(nodes: Iterable[ast.AST], scene: Collection[str]) -> Names:
        """Sort the names of a tree, given all its nodes.

        One only tested for truth is absent unless it looks misspelt.
        """
        known = frozenset(scene)
        stored: set[str] = set()
        tests: list[ast.AST] = []
        for node in nodes:
            if type(node) is ast.Name:
                if type(node.ctx) is ast.Store:
                    stored.add(node.id)
            elif type(node) in _TESTING:
                tests.append(node)
        compared, tested = _tested(tests)
        likely = {name for name in tested if not nearest(name, {*known, *stored}, 0.8)}
        absent = {
            name
            for name in compared | likely
            if name not in known | stored | RESERVED and not _numbered(name, known)
        }
        return Names(known, frozenset(absent), frozenset(stored))


_TESTING = frozenset({ast.If, ast.While, ast.IfExp, ast.UnaryOp, ast.Compare})


def _tested(nodes: Iterable[ast.AST]) -> tuple[set[str], set[str]]:
    """Names compared to None, and names whose truth is tested."""
    compared: set[str] = set()
    tested: set[str] = set()

    def truth(node: ast.expr) -> None:
        if type(node) is ast.Name:
            tested.add(node.id)
        elif type(node) is ast.BoolOp:
            for value in node.values:
                truth(value)

    for node in nodes:
        if isinstance(node, ast.If | ast.While | ast.IfExp):
            truth(node.test)
        elif isinstance(node, ast.UnaryOp) and type(node.op) is ast.Not:
            truth(node.operand)
        elif isinstance(node, ast.Compare) and none_test(node) and type(node.left) is ast.Name:
            compared.add(node.left.id)
    return compared, tested


def _numbered(name: str, known: Iterable[str]) -> bool:
    """Whether the scene has several of these (``apple_1``, ``apple_2``): then none is absent."""
    return any(other.rpartition("_")[0] == name and other[-1].isdigit() for other in known)


def none_test(node: ast.Compare) -> bool:
    """Whether this is ``X is None``, ``X is not None``, ``X == None`` or ``X != None``."""
    right = node.comparators[0]
    return (
        len(node.ops) == 1
        and type(node.ops[0]) in (ast.Is, ast.IsNot, ast.Eq, ast.NotEq)
        and type(right) is ast.Constant
        and right.value is None
    )


def nearest(name: str, known: Iterable[str], cutoff: float = 0.6) -> str | None:
    """The most similar known name, if any is similar."""
    found = difflib.get_close_matches(name, sorted(known), 1, cutoff)
    return found[0] if found else None
