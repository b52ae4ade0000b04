"""What a program finds ready: attributes of objects, functions, handles and their arity.

Names only: `agent.guards` computes, `agent.evaluate` calls.
"""

from __future__ import annotations

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
