"""What a program finds ready, with its arity, and what to write instead of what it does not.

Names only: `agent.language.functions` computes, `agent.language.evaluate` calls.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable

from agent.messages import Kind

OBJECT_NUMBERS = ("x", "y", "z", "r", "width", "height", "tall")
"""Attributes of an object; in an arrange program x and y of a tray object are unknowns."""
STRENGTHS = ("required", "strong", "medium", "weak")
MATH_CONSTANTS = {"pi": math.pi, "tau": math.tau, "e": math.e}
MATH_CALLS: dict[str, tuple[Callable[..., float | bool], int, int]] = {
    "sin": (math.sin, 1, 1),
    "cos": (math.cos, 1, 1),
    "tan": (math.tan, 1, 1),
    "asin": (math.asin, 1, 1),
    "acos": (math.acos, 1, 1),
    "atan": (math.atan, 1, 1),
    "atan2": (math.atan2, 2, 2),
    "sqrt": (math.sqrt, 1, 1),
    "hypot": (math.hypot, 1, 3),
    "floor": (math.floor, 1, 1),
    "ceil": (math.ceil, 1, 1),
    "trunc": (math.trunc, 1, 1),
    "radians": (math.radians, 1, 1),
    "degrees": (math.degrees, 1, 1),
    "fabs": (math.fabs, 1, 1),
    "fmod": (math.fmod, 2, 2),
    "copysign": (math.copysign, 2, 2),
    "exp": (math.exp, 1, 1),
    "log": (math.log, 1, 1),
    "pow": (math.pow, 2, 2),
    "isclose": (math.isclose, 2, 2),
}
"""Name -> function, fewest and most arguments."""
BUILTINS: dict[str, tuple[int, int]] = {
    "abs": (1, 1),
    "min": (1, 20),
    "max": (1, 20),
    "round": (1, 2),
    "len": (1, 1),
    "range": (1, 3),
    "sum": (1, 1),
    "sorted": (1, 1),
    "int": (1, 1),
    "float": (1, 1),
    "bool": (1, 1),
    "list": (0, 1),
    "tuple": (0, 1),
}
NUMBER_CALLS = frozenset({"abs", "min", "max", "round", "range", "int", "float"})
"""Those of them that take numbers, never objects."""
OBJECT_CALLS: dict[str, tuple[int, int]] = {
    "group": (0, 1),
    "where": (1, 1),
    "known": (1, 1),
    "at": (4, 4),
    "placed": (4, 4),
    "turned": (2, 2),
    "present": (0, 0),
    "by_now": (1, 1),
    "same_color": (2, 2),
    "open_box": (1, 1),
    "either": (1, 1),
    "choices": (1, 1),
    "about": (1, 1),
    "no_less": (1, 1),
    "wish": (2, 2),
    "so_far": (1, 1),
    "tool_at": (3, 3),
}
"""Functions over objects; `agent.language.prelude` has those written in the language itself."""
METHODS: dict[str, tuple[str, int, Kind | None]] = {
    "append": ("a list", 1, None),
    "value": ("an unknown", 0, "arrange"),
}
HANDLES: dict[str, tuple[Kind | None, dict[str, tuple[int, int]], str]] = {
    "robot": (
        "manipulate",
        {"move": (4, 4), "grip": (1, 1)},
        "robot.move(x, y, z, r) or robot.grip(True)",
    ),
    "solver": (
        "arrange",
        {"addConstraint": (1, 1), "solve": (0, 0)},
        "solver.addConstraint(apple.x <= 0) or solver.solve()",
    ),
    "math": (None, {name: entry[1:] for name, entry in MATH_CALLS.items()}, "math.sin(angle)"),
}
"""Handle -> the kind of program that has it (None: both), its methods, how to use it."""
RESERVED = frozenset({*HANDLES, *BUILTINS, "Variable"})

INSTEAD: dict[type[ast.AST], str] = {
    ast.FunctionDef: "a function definition is not allowed: write only its body",
    ast.AsyncFunctionDef: "a function definition is not allowed: write only its body",
    ast.ClassDef: "a class is not allowed: use numbers and lists",
    ast.Import: "an import is not allowed: math is already there",
    ast.ImportFrom: "an import is not allowed: math is already there",
    ast.Lambda: "a lambda is not allowed: write the computation where it is needed",
    ast.Try: "try is not allowed: test with if before",
    ast.With: "with is not allowed: write the statements one after another",
    ast.Raise: "raise is not allowed: use return to end the program",
    ast.Assert: "assert is not allowed: use if",
    ast.Delete: "del is not allowed: leave the variable alone",
    ast.Global: "global is not allowed: all variables belong to the program",
    ast.Nonlocal: "nonlocal is not allowed: all variables belong to the program",
    ast.AnnAssign: "an annotation is not allowed: write name = value",
    ast.NamedExpr: "':=' is not allowed: assign on a line of its own",
    ast.Yield: "yield is not allowed: append to a list",
    ast.YieldFrom: "yield is not allowed: append to a list",
    ast.Await: "await is not allowed: commands run one after another",
    ast.AsyncFor: "async is not allowed: write for",
    ast.AsyncWith: "async is not allowed: write the statements one after another",
    ast.Match: "match is not allowed: use if and elif",
    ast.JoinedStr: "an f-string is not allowed: programs only need numbers",
    ast.Dict: "a dictionary is not allowed: use variables or lists",
    ast.DictComp: "a dictionary is not allowed: use variables or lists",
    ast.Set: "a set is not allowed: use a list",
    ast.SetComp: "a set is not allowed: use a list",
    ast.GeneratorExp: "a generator is not allowed: put the comprehension in [ ]",
    ast.Starred: "'*' before a value is not allowed: write the values out",
    ast.Slice: "a slice is not allowed: index one element or use a loop",
    ast.BitAnd: "'&' is not allowed: use and, or add two constraints",
    ast.BitXor: "'^' is not allowed: a power is written **",
    ast.LShift: "'<<' is not allowed: use arithmetic",
    ast.RShift: "'>>' is not allowed: use arithmetic",
    ast.Invert: "'~' is not allowed: use not",
    ast.MatMult: "'@' is not allowed: use *",
    ast.BitOr: "'|' joins a constraint and its strength only: use or",
}
"""What the writer should do instead, for constructs that people try."""
