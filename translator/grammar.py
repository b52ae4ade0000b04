"""Which tokens may come next: the program grammar and the names in scope, as a mask.

A `Prefix` is an unfinished program. Its LALR stack (lark's tables for the dialect's grammar) says
which terminals may follow; scope says which names: objects that the sentence mentions, variables
that the prefix has assigned, calls of the task at hand. So no malformed program can be written.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import numpy as np
from lark import Lark, Token
from lark.lexer import Lexer, LexerState
from lark.parsers.lalr_analysis import Shift
from numpy.typing import NDArray

from agent.errors import TranslatorError
from agent.language.builtin import BUILTINS, OBJECT_CALLS
from agent.language.prelude import functions, prelude
from agent.messages import Kind
from translator.marked import SLOTS
from translator.vocabulary import DEDENT, END, INDENT, NEWLINE, NOUNS, Dialect, Vocabulary

_FIXED = {
    NEWLINE: "NEWLINE", INDENT: "INDENT", DEDENT: "DEDENT", END: "$END",
    "if": "IF", "elif": "ELIF", "else": "ELSE", "for": "FOR", "in": "IN", "while": "WHILE",
    ":": "COLON", ",": "COMMA", "=": "ASSIGN", "(": "LPAR", ")": "RPAR", "[": "LBRACKET",
    "]": "RBRACKET", "|": "BAR", "or": "OR", "and": "AND", "not": "NOT", "is": "IS",
    "+": "PLUS", "-": "MINUS", "*": "STAR", "/": "SLASH", "%": "PERCENT", "**": "POWER",
    "robot.move": "MOVE", "robot.grip": "GRIP", "solver.addConstraint": "CONSTRAIN",
    "solver.solve": "SOLVE", ".append": "APPEND", "pass": "PASS", "break": "BREAK",
    "continue": "CONTINUE", "range": "RANGE", "return": "RETURN", "None": "NONE", "True": "TRUE",
    "False": "FALSE",
    ".value": "VALUE", "Variable": "VARIABLE", "math.pi": "CONSTANT", "math.tau": "CONSTANT",
    "//": "PERCENT",  # binds alike
}  # fmt: skip
EACH = "one"
"""The variable of a comprehension, which is read before it is named."""
REMEMBERED = 2000
"""Prefixes whose next pieces are remembered; programs begin alike and go on alike."""
_STRENGTHS = {'"required"', '"strong"', '"medium"', '"weak"'}
_FUNCTIONS = {"abs", "min", "max", "round", "len", "sum", "sorted"}
_TASK_OF = {"MOVE": "manipulate", "GRIP": "manipulate", "CONSTRAIN": "arrange", "SOLVE": "arrange"}
_BEFORE_TARGET = {"NEWLINE", "INDENT", "DEDENT", "FOR"}


def terminal(token: str, dialect: Dialect = "paper") -> str | None:
    """The grammar's terminal for a vocabulary token; None for <pad> and the task symbols."""
    if token in _FIXED:
        return _FIXED[token]
    if dialect == "skills" and (own := _skill_terminal(token)) is not None:
        return own
    if dialect == "paper" and token in NOUNS:
        return "OBJECT"
    if token in {"==", "!=", "<", ">", "<=", ">="}:
        return "RELATION"
    if token in {"+=", "-=", "*=", "/="}:
        return "AUGMENT"
    if token in _STRENGTHS:
        return "STRENGTH"
    if token.startswith('"'):
        return "STRING"
    if token in _FUNCTIONS or token.startswith("math."):
        return "FUNCTION"
    if token.startswith("."):
        return "FIELD"
    if re.fullmatch(r"[\d.]+(e[-+]?\d+)?", token):
        return "NUMBER"
    return "NAME" if token.isidentifier() else None


def _skill_terminal(token: str) -> str | None:
    """The terminals that only programs over slots have: slots by kind, calls by arity, texts."""
    if token in SLOTS:
        return {"m": "OBJECT", "g": "GROUP"}.get(token[0], "MEASURE")
    if token in _ARITY:
        return f"CALL{_ARITY[token]}"
    if token in _UNARY:
        return "UNARY"
    if token in ("==", "!="):
        return "SAME"
    if token in _RECKONED or (token.startswith("math.") and token not in _FIXED):
        return "RECKON"
    return "STRING" if token.startswith('"') else None


_RECKONED = {"abs", "min", "max", "round"}
"""Functions of numbers, to which no thing can be given."""
_UNARY = {name for name, arity in BUILTINS.items() if arity == (1, 1)}
"""Functions of one argument, and no more."""
_ARITY = {
    **{name: most for name, (_, most) in OBJECT_CALLS.items() if name != "group"},
    **{one.name: len(one.parameters) for one in prelude()},
}  # fmt: skip
_CALLS: dict[Kind, frozenset[str]] = {
    kind: frozenset({*OBJECT_CALLS, *functions(kind)} - {"group"})
    for kind in ("manipulate", "arrange")
}


class _NoLexer(Lexer):
    """The decoder hands tokens over itself, so there is nothing to scan."""

    def __init__(self, conf: object) -> None: ...

    def lex(self, lexer_state: LexerState, parser_state: object) -> Iterator[Token]:
        """No tokens: none are asked for."""
        yield from ()


Stack = tuple[int, ...]


class _Automaton:
    """The LALR tables that lark makes of a dialect's grammar, run on state stacks alone."""

    def __init__(self, dialect: Dialect) -> None:
        text = (files("translator") / f"{dialect}.lark").read_text()
        lark = Lark(text, parser="lalr", lexer=_NoLexer, start="start")
        table = lark.parse_interactive().parser_state.parse_conf.parse_table
        self._states = table.states
        self.start: Stack = (table.start_states["start"],)
        self.advance = cache(self._advance)

    def _advance(self, stack: Stack, name: str) -> Stack | None:
        """The stack after one more terminal, or None where it may not come."""
        while True:
            action = self._states[stack[-1]].get(name)
            if action is None:
                return None
            kind, goal = action
            if kind is Shift:
                return (*stack, goal)
            if name == "$END" and len(stack) == 2 and stack[0] == self.start[0]:
                return stack
            stack = stack[: len(stack) - len(goal.expansion)]
            stack = (*stack, self._states[stack[-1]][goal.origin.name][1])


@cache
def _automaton(dialect: Dialect) -> _Automaton:
    if dialect == "python":
        raise TranslatorError("a model of docstrings writes no programs: train on from it first")
    return _Automaton(dialect)


class Prefix(NamedTuple):
    """An unfinished program. ``fresh`` are names whose assignment is not complete yet; ``before``
    are the two tokens in front of the last one, ``lists`` the open square brackets, ``each`` says
    that a comprehension's variable was read and has yet to be named.
    """

    stack: Stack
    last: str | None = None
    before: tuple[str, ...] = ()
    assigned: frozenset[str] = frozenset()
    fresh: tuple[str, ...] = ()
    naming: bool = True
    lists: int = 0
    each: bool = False


class Grammar:
    """The rules for one vocabulary."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._pieces = vocabulary.pieces
        dialect = vocabulary.dialect
        self._terminals = {t: terminal(t, dialect) for piece in self._pieces for t in piece}
        self._automaton = _automaton(dialect)
        self._of_task = {
            kind: np.array([all(self._fits(t, kind) for t in piece) for piece in self._pieces])
            for kind in _CALLS
        }
        self._things_in = [
            {t for t in piece if self._terminals[t] in ("OBJECT", "GROUP", "MEASURE")}
            for piece in self._pieces
        ]
        self._ways: dict[Prefix, dict[int, Prefix | None]] = {}

    def _fits(self, token: str, kind: Kind) -> bool:
        """Whether a program of this task may hold a token, whatever it is about."""
        own = self._terminals[token]
        if own is None or own.startswith("CALL"):
            return token in _CALLS[kind]
        return _TASK_OF.get(own, kind) == kind

    def usable(self, kind: Kind, nouns: Collection[str]) -> NDArray[np.bool_]:
        """Pieces that a program of this task over these objects may hold; shape (vocabulary,)."""
        things = set(nouns)
        about = np.array([held <= things for held in self._things_in])
        usable: NDArray[np.bool_] = self._of_task[kind] & about
        return usable

    def start(self) -> Prefix:
        """The empty program."""
        return Prefix(self._automaton.start)

    def extend(self, prefix: Prefix, index: int) -> Prefix | None:
        """The prefix with one more piece, or None where grammar or scope forbid it."""
        ways = self._ways.get(prefix)
        if ways is None:
            if len(self._ways) >= REMEMBERED:
                self._ways.clear()
            ways = self._ways.setdefault(prefix, {})
        if index not in ways:
            longer: Prefix | None = prefix
            for token in self._pieces[index]:
                longer = None if longer is None else self._append(longer, token)
            ways[index] = longer
        return ways[index]

    def _append(self, prefix: Prefix, token: str) -> Prefix | None:
        own = self._terminals[token]
        if own is None or not _in_scope(prefix, token, own):
            return None
        if token == ")" and self._brackets_a_thing(prefix):
            return None
        lists = prefix.lists + (token == "[") - (token == "]")
        each = prefix.each and token != "for"
        each = each or (token == EACH and not prefix.naming and EACH not in prefix.assigned)
        if each and prefix.lists and not lists:
            return None
        stack = self._automaton.advance(prefix.stack, own)
        if stack is None:
            return None
        assigned, fresh, naming = prefix.assigned, prefix.fresh, prefix.naming
        if own == "NAME" and naming:
            fresh = (*fresh, token)
        elif own == "NEWLINE" or (own == "IN" and fresh):
            # a name is in scope once the statement that assigns it is complete
            assigned, fresh = assigned | set(fresh), ()
        naming = own in _BEFORE_TARGET or (naming and own in ("NAME", "COMMA"))
        before = (*prefix.before, prefix.last or "")[-2:]
        return Prefix(stack, token, before, assigned, fresh, naming, lists, each)

    def _brackets_a_thing(self, prefix: Prefix) -> bool:
        """Whether ")" would close a bracket around one thing, which could then be reckoned with."""
        if self._terminals.get(prefix.last or "") != "OBJECT" or prefix.before[-1:] != ("(",):
            return False
        opener = self._terminals.get(prefix.before[0], "") or ""
        return not opener.startswith(("CALL", "FUNCTION", "APPEND"))


def _in_scope(prefix: Prefix, token: str, own: str) -> bool:
    """Whether a name is read only after it was assigned."""
    if own == "NAME":
        return prefix.naming or token in prefix.assigned or (token == EACH and prefix.lists > 0)
    if own in ("AUGMENT", "APPEND"):
        return prefix.last in prefix.assigned
    return True
