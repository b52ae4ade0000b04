"""Programs as texts: hand-written bodies, soups of tokens, bodies with changes; chance from bytes.

All chance comes from the ``random.Random`` passed in: hypothesis passes one that it can shrink,
the coverage-guided targets one that reads bytes (`Chances`).
"""

import ast
import builtins
import keyword
import random
import re
import tomllib
from functools import cache
from pathlib import Path

import agent.language
from agent.language import builtin
from agent.program import instantiate
from scene.types import Scene, SceneObject, identifiers


def _thing(name, number, x=None, y=None):
    return SceneObject(
        id=f"{name}_{number}", name=name, x=x, y=y, width=0.2, height=0.15, tall=0.1 * number,
        on="tray" if x is None else "table",
    )  # fmt: skip


SCENES = {
    "manipulate": Scene(
        objects=(
            _thing("apple", 1, -0.5, 0.3), _thing("plate", 1, 0.4, -0.2),
            _thing("block", 1, 0.0, 0.6), _thing("block", 2, 0.5, 0.5),
        )
    ),
    "arrange": Scene(
        objects=(_thing("plate", 1, 0.4, -0.2),),
        tray=(_thing("apple", 1), _thing("block", 1), _thing("block", 2)),
    ),
}  # fmt: skip
"""What the bodies are about, for each kind of program."""
NAMES = tuple(identifiers(SCENES["manipulate"]))
ABSENT = "kiwi"

NUMBERS, LISTS, THINGS, UNKNOWNS = ("a", "b", "n"), ("xs", "ys"), ("t", "u"), ("v", "w")
"""Variables, by what they mostly hold."""


def benign(kind):
    """The hand-written bodies of this kind, turned so that they are about the things of NAMES."""
    path = Path(__file__).parent / "data" / "benign.toml"
    sources = [e["program"] for e in tomllib.loads(path.read_text(encoding="utf-8"))[kind]]
    return [instantiate(s, dict(zip(free_names(s), NAMES * 9, strict=False))) for s in sources]


@cache
def prelude(kind):
    """The functions that are written in the language, for this kind of program: name -> tree.

    What uses the handle of one kind, or a function above it that does, belongs to that kind.
    """
    path = Path(agent.language.__file__).with_name("prelude.txt")
    kinds, found = {"robot": "manipulate", "solver": "arrange"}, {}
    for tree in ast.parse(path.read_text(encoding="ascii")).body:
        used = {kinds.get(name) for name in _names(tree)} - {None}
        kinds[tree.name] = min(used, default=None)
        if used <= {kind}:
            found[tree.name] = tree
    return found


def _names(tree):
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}


def free_names(source):
    """The names a body reads that neither it nor the language gives a meaning: its objects."""
    tree = ast.parse(source)
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    stored = {node.id for node in names if isinstance(node.ctx, ast.Store)}
    ready = {*builtin.RESERVED, *dir(builtins)}
    return sorted({node.id for node in names} - stored - called(tree) - ready)


def called(tree):
    """The names of the functions that a body calls."""
    functions = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return {function.id for function in functions if isinstance(function, ast.Name)}


# --- texts ---------------------------------------------------------------------------------------

TOKENS = (
    *keyword.kwlist, *NAMES, *NUMBERS, *builtin.RESERVED, *builtin.OBJECT_NUMBERS, "append",
    "kiwi", *"()[]{}.,:;=<>+-*/%|&^~@!#'\"", "**", "//", "==", "<=", "+=", ":=", "->", "0", "1.5",
    "1e9", "0x", "9" * 31, "1_0", "'strong'", '"""', "\n", "\n    ", "\n        ", " ", " ",
    "\t", "\r", "\x0c", "\0", "\\", "\\\n", "__", "é", "\u2028", "\ufeff", "\ud800",
)  # fmt: skip


def soup(rng):
    """Tokens of Python and of the language, one after another."""
    tokens = sorted(TOKENS)
    return "".join(
        rng.choice(tokens) + rng.choice((" ", " ", "")) for _ in range(rng.randint(1, 60))
    )


def mutated(rng, source):
    """The source with a few pieces left out, doubled, swapped or replaced."""
    pieces = re.findall(r"\w+|\s+|.", source)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(pieces))
        change = rng.choice(("drop", "double", "move", "replace"))
        if change == "drop" and len(pieces) > 1:
            del pieces[at]
        elif change == "double":
            pieces.insert(at, pieces[at])
        elif change == "move":
            pieces.insert(rng.randrange(len(pieces)), pieces[at])
        else:
            pieces[at] = rng.choice(sorted(TOKENS))
    return "".join(pieces)


# --- chance --------------------------------------------------------------------------------------


class Chances(random.Random):
    """Chance that is read from bytes, so that the fuzzer can steer it; even odds beyond them."""

    def __init__(self, data):
        super().__init__()
        self.data = iter(data)

    def random(self):
        return next(self.data, 128) / 256

    def getrandbits(self, count):
        drawn = [next(self.data, 0) for _ in range((count + 7) // 8)]
        return int.from_bytes(drawn, "big") % 2**count
