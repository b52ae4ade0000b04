"""docs/language.md: every construct stands on it, with an example that runs."""

import ast
from pathlib import Path

import pytest

from agent.compose import table
from agent.errors import ProgramError
from agent.language import allowed
from agent.language.builtin import (
    BUILTINS,
    HANDLES,
    MATH_CALLS,
    MATH_CONSTANTS,
    METHODS,
    OBJECT_CALLS,
    OBJECT_NUMBERS,
    STRENGTHS,
)
from agent.language.prelude import prelude
from agent.language.reference import page, sections
from agent.programs import laid_out

EXAMPLES = [entry for section in sections() for entry in section.entry]


@pytest.mark.parametrize("entry", EXAMPLES, ids=lambda entry: entry.usage)
def test_each_example_runs(executor, entry):
    (draft,) = executor.run(entry.example, entry.kind, [laid_out(table("check"), entry.kind)])
    assert not isinstance(draft, ProgramError), draft
    assert draft.commands or draft.placements or entry.example == "pass"


def used() -> tuple[set[type[ast.AST]], set[str], set[str]]:
    """Node types, names that are called or asked for, and texts of all examples together."""
    kinds: set[type[ast.AST]] = set()
    names: set[str] = set()
    texts: set[str] = set()
    for entry in EXAMPLES:
        for node in ast.walk(ast.parse(entry.example)):
            kinds.add(type(node))
            if isinstance(node, ast.Attribute):
                names.add(node.attr)
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                names.add(node.func.id)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                texts.add(node.value)
    return kinds, names, texts


def test_the_examples_use_everything_there_is():
    kinds, names, texts = used()
    operators = {*allowed.BINARY, *allowed.UNARY, *allowed.BOOLEAN, *allowed.ORDER}
    assert {*allowed.STATEMENTS, *allowed.EXPRESSIONS, *operators, *allowed.IDENTITY} <= kinds
    methods = {name for _, calls, _ in HANDLES.values() for name in calls}
    assert {*BUILTINS, *MATH_CALLS, *MATH_CONSTANTS, *METHODS, *OBJECT_CALLS, *methods} <= names
    assert {*OBJECT_NUMBERS, *(one.name for one in prelude()), "Variable"} <= names
    assert {*STRENGTHS} <= texts


def test_the_page_in_docs_is_the_one_written_now():
    written = Path(__file__).parent.parent / "docs" / "language.md"
    assert written.read_text(encoding="utf-8") == page(), (
        "write it anew: python -m agent.language.reference > docs/language.md"
    )
