"""Pairs of a docstring and its function's body, mined from the Python code that is installed here.

The standard library and installed packages of permissive licence (`PERMISSIVE`), for a model to
learn from what code for a sentence looks like, before it learns programs. What a docstring names of
its function's parameters and variables becomes the slots that sentences have
(`translator.marked`), so that copying from sentence to program is learnt; other variables are
numbered, texts and uncommon numbers and names are one symbol each. Mined anew wherever it is
wanted: nothing of it is kept. `python -m translator.mined` tells what there is.
"""

from __future__ import annotations

import ast
import re
import sys
import sysconfig
import warnings
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from importlib.metadata import Distribution, distributions
from itertools import chain
from keyword import iskeyword
from pathlib import Path
from typing import NamedTuple

from agent.errors import TranslatorError
from translator.marked import MOST, SLOTS, Mark, Marked, apart, marked
from translator.vocabulary import detokenize, tokenize

PERMISSIVE = frozenset({
    "MIT", "MIT-0", "BSD", "BSD-2-Clause", "BSD-3-Clause", "0BSD", "Apache-2.0", "PSF-2.0",
    "Python-2.0", "CNRI-Python",
})  # fmt: skip
"""Licences (SPDX) of packages that are read; of an expression all must be among them."""
_SPOKEN = {
    "mit license": "MIT", "bsd license": "BSD", "apache software license": "Apache-2.0",
    "python software foundation license": "PSF-2.0", "apache 2.0": "Apache-2.0",
    "apache license 2.0": "Apache-2.0", "apache license, version 2.0": "Apache-2.0",
    "bsd 3-clause": "BSD-3-Clause", "3-clause bsd license": "BSD-3-Clause",
    "new bsd": "BSD-3-Clause", "apache": "Apache-2.0", "psf": "PSF-2.0",
    "apache 2.0 license": "Apache-2.0", "the mit license": "MIT", "the mit license (mit)": "MIT",
}  # fmt: skip
"""Licences as older packages name them."""
OWN = "armchat"
ELSEWHERE = re.compile(
    r"(?:^|[/\\])(?:tests?|testing|idle_test|lib2to3|site-packages|dist-packages|_?vendor\w*|"
    r"externals?|extern|_distutils|third_?party)[/\\]"
)
"""Folders that are not read: tests, and copies of what others wrote under their own licences."""
WORDS = range(3, 31)
"""Words of a docstring's first paragraph."""
TOKENS = range(3, 49)
"""Tokens of a body."""
COMMON = 10
"""A name that stands in fewer bodies than that becomes `OTHER`."""
OTHER, TEXT, NUMBER = "other", "text", "number"
"""What stands for uncommon names, for texts, for uncommon numbers."""
MOST_UNKNOWN = 0.15
"""The share of a body's tokens that may be `OTHER`."""
MOST_VARIABLES = 12
_ROLE = re.compile(r":[\w:]+:`~?([^`<]*)[^`]*`|[`*]+")
_ORDINARY = frozenset({"a", "an", "and", "as", "at", "be", "i", "if", "in", "is", "it", "not", "of",
                       "on", "or", "the", "to"})  # fmt: skip
"""Names that are most often mere words in a sentence."""


class Pair(NamedTuple):
    """A docstring's first paragraph with its slots, and the body that it stands above."""

    said: Marked
    body: str


class Source(NamedTuple):
    """Python files under one licence."""

    name: str
    licence: str
    files: tuple[Path, ...]


def sources() -> list[Source]:
    """The standard library and the packages that may be read, by name."""
    root = Path(sysconfig.get_path("stdlib"))
    library = tuple(sorted(path for path in root.rglob("*.py")
                           if not ELSEWHERE.search(str(path.relative_to(root)))))  # fmt: skip
    found = {"python": Source("python", "PSF-2.0", library)}
    for package in distributions():
        name, licence = package.metadata["Name"], licence_of(package)
        if licence and name and name.lower() != OWN:
            found.setdefault(name.lower(), Source(name, licence, tuple(_files(package))))
    return [found[name] for name in sorted(found) if found[name].files]


def licence_of(package: Distribution) -> str | None:
    """The package's licence where it is permissive, as its metadata states it."""
    said = package.metadata
    stated = said.get_all("License-Expression", [])
    if not stated:
        stated = [one.rpartition("::")[2] for one in said.get_all("Classifier", [])
                  if one.startswith("License ::")] or said.get_all("License", [])  # fmt: skip
    names = [_SPOKEN.get(one.strip().lower(), one.strip()) for one in stated]
    parts = [part for name in names for part in re.split(r"\s+(?:AND|OR)\s+|[()]", name) if part]
    known = bool(parts) and all(part.strip() in PERMISSIVE for part in parts)
    return " AND ".join(names) if known else None


def _files(package: Distribution) -> list[Path]:
    return sorted(Path(str(file.locate())) for file in package.files or ()
                  if file.suffix == ".py" and not ELSEWHERE.search(str(file)))  # fmt: skip


def mine(files: Iterable[Path]) -> list[Pair]:
    """The pairs of these files, each once, in their order; uncommon names are `OTHER`."""
    bodies: dict[Marked, dict[str, list[str]]] = {}
    for said, body in chain.from_iterable(map(_pairs, files)):
        try:
            tokens = tokenize(body)
        except TranslatorError:
            continue  # braces, bits, matrices: what programs have no token for
        if len(tokens) in TOKENS:
            bodies.setdefault(said, {}).setdefault(body, tokens)
    every = [(said, tokens) for said, told in bodies.items() for tokens in told.values()]
    count = Counter(token for _, tokens in every for token in set(tokens))
    plain = [(said, [_common(token, count) for token in tokens]) for said, tokens in every]
    kept = (Pair(said, detokenize(tokens)) for said, tokens in plain
            if sum(map(_unknown, tokens)) <= MOST_UNKNOWN * len(tokens))  # fmt: skip
    return list(dict.fromkeys(kept))


def _common(token: str, count: Counter[str]) -> str:
    own = iskeyword(token) or token in SLOTS or not token.lstrip(".").isidentifier()
    if own or count[token] >= COMMON:
        return token
    return f".{OTHER}" if token.startswith(".") else OTHER


def _unknown(token: str) -> bool:
    return token.lstrip(".") == OTHER


def _pairs(path: Path) -> Iterator[tuple[Marked, str]]:
    """Every function of a file that says what it does; nothing where it cannot be read."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of escapes in strings
            tree = ast.parse(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, SyntaxError, RecursionError):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and (summary := summary_of(node)) is not None:
            pair = paired(summary, node)
            if pair is not None:
                yield pair


def summary_of(function: ast.FunctionDef) -> str | None:
    """The docstring's first paragraph as a sentence; None where it is none."""
    docstring = ast.get_docstring(function)
    if docstring is None or len(function.body) < 2:
        return None
    first = re.split(r"\n\s*\n|>>>|\n\s*:\w+|\n\s*-{3}", docstring.strip())[0]
    text = " ".join(_ROLE.sub(lambda match: match.group(1) or "", first).split())
    readable = text.isascii() and text[:1].isalpha() and len(text.split()) in WORDS
    return text if readable else None


def paired(summary: str, function: ast.FunctionDef) -> tuple[Marked, str] | None:
    """A summary with slots and the body over them; None where the body only refuses, holds
    a function of its own or more variables than `MOST_VARIABLES`. Imports are left out."""
    body = [part for part in function.body[1:] if not isinstance(part, _IMPORTS)]
    inner = [node for part in body for node in ast.walk(part)]
    if not body or isinstance(body[0], ast.Raise) or any(isinstance(x, _APART) for x in inner):
        return None
    names = _variables(function.args, inner)
    marks = _mentions(summary, names)
    slots = {summary[mark.start : mark.end].replace(" ", "_"): mark.slot for mark in marks}
    others = [name for name in names if name not in slots]
    if len(others) > MOST_VARIABLES:
        return None
    names_now = slots | {name: f"v{number}" for number, name in enumerate(others, start=1)}
    plain = _Plain(names_now)
    lines = [ast.unparse(ast.fix_missing_locations(plain.visit(part))) for part in body]
    return marked(summary, marks), "\n".join(lines)


_IMPORTS = (ast.Import, ast.ImportFrom)
_APART = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Global, ast.Nonlocal, *_IMPORTS)


def _variables(arguments: ast.arguments, inner: Sequence[ast.AST]) -> list[str]:
    """Parameters and variables that the body speaks of, in its order; not ``self``."""
    given = {node.arg for node in ast.walk(arguments) if isinstance(node, ast.arg)}
    given |= {node.arg for node in inner if isinstance(node, ast.arg)}
    given |= {node.name for node in inner if isinstance(node, ast.ExceptHandler) and node.name}
    named = [node for node in inner if isinstance(node, ast.Name)]
    given |= {node.id for node in named if isinstance(node.ctx, ast.Store)}
    named.sort(key=lambda node: (node.lineno, node.col_offset))
    return [name for name in dict.fromkeys(node.id for node in named)
            if name in given and name not in ("self", "cls")]  # fmt: skip


def _mentions(summary: str, names: Sequence[str]) -> list[Mark]:
    """Where a summary names variables, numbered as they come: plural ones are groups."""
    able = [name for name in names if name.lower() not in _ORDINARY]
    if not able:
        return []
    spoken = "|".join(re.escape(name).replace("_", "[_ ]")
                      for name in sorted(able, key=len, reverse=True))  # fmt: skip
    slots: dict[str, str] = {}
    marks = []
    for match in re.finditer(rf"\b(?:{spoken})\b", summary):
        name = match.group().replace(" ", "_")
        if name not in slots and len(slots) < MOST:
            letter = "g" if re.search(r"[^s]s$", name) else "m"
            slots[name] = f"{letter}{sum(one[0] == letter for one in slots.values()) + 1}"
        if name in slots:
            marks.append(Mark(match.start(), match.end(), slots[name]))
    return apart(marks)


class _Plain(ast.NodeTransformer):
    """A body over slots and numbered variables, without texts, large numbers and annotations."""

    def __init__(self, names: dict[str, str]) -> None:
        self._names = names

    def visit_Name(self, node: ast.Name) -> ast.Name:
        return ast.Name(self._names.get(node.id, node.id), node.ctx)

    def visit_arg(self, node: ast.arg) -> ast.arg:
        return ast.arg(self._names.get(node.arg, node.arg))

    def visit_ExceptHandler(self, node: ast.ExceptHandler) -> ast.AST:
        self.generic_visit(node)
        return ast.ExceptHandler(node.type, self._names.get(node.name or "", node.name), node.body)

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        if isinstance(node.value, (str, bytes)):
            return ast.Name(TEXT, ast.Load())
        if node.value is ...:
            return ast.Name("Ellipsis", ast.Load())
        plain = node.value in (None, True, False) or node.value in range(11) or node.value == 0.5
        return node if plain else ast.Name(NUMBER, ast.Load())

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.expr:
        return ast.Name(TEXT, ast.Load())

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.stmt:
        if node.value is None:
            return ast.Pass()
        return ast.Assign([self.visit(node.target)], self.visit(node.value), lineno=node.lineno)


def main() -> int:
    """Print what is read, and how many pairs that gives."""
    read = sources()
    for source in read:
        print(f"{source.name}: {source.licence}, {len(source.files)} files")
    pairs = mine(chain.from_iterable(source.files for source in read))
    slots = sum(bool(pair.said.marks) for pair in pairs)
    print(f"{len(pairs)} pairs, {slots} of them with slots")
    return 0


if __name__ == "__main__":
    sys.exit(main())
