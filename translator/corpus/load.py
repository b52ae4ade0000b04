"""Read the expert pairs of ``paper/*.toml``: a sentence, its program, what must hold after it.

    [[pair]]
    id = "a001"
    split = "train"            # train | valid | test
    family = "corner"
    say = "put the apple in the top left corner"
    after = ["in_corner apple above left"]
    program = '''
    solver.addConstraint(...)
    '''

The words of ``after`` are those of ``evals/postconditions.py``.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import msgspec

from agent.errors import ConfigError
from agent.messages import Kind

Split = Literal["train", "valid", "test"]
PAPER = Path(__file__).parent / "paper"


class Pair(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One expert pair. ``after`` are postconditions, ``program`` ends without a newline.

    ``given`` are conditions: the pair speaks of scenes only in which they hold (room, say).
    """

    id: str
    split: Split
    family: str
    say: str
    program: str
    after: tuple[str, ...]
    given: tuple[str, ...] = ()
    kind: Kind = "arrange"


def load(kind: Kind, folder: Path = PAPER) -> tuple[Pair, ...]:
    """The expert pairs of a task, in file order.

    Raises ConfigError that names the file, the pair and what is wrong with it.
    """
    path = folder / f"{kind}.toml"
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise ConfigError(f"{path}: {error}") from error
    entries = data.pop("pair", None)
    if data or not isinstance(entries, list):
        raise ConfigError(f"{path}: nothing but [[pair]] tables is expected")
    pairs = tuple(_pair(path, number, entry, kind) for number, entry in enumerate(entries, 1))
    _refuse_twins(path, pairs)
    return pairs


def share_of_pairs(pairs: Sequence[Pair], share: float) -> tuple[Pair, ...]:
    """A share of these pairs, in their order: drawn by id and sentence, to the nearest whole number
    (there are few), at least one. A smaller share lies within a larger one."""

    def drawn(pair: Pair) -> bytes:
        return hashlib.sha256(f"share {pair.id} {pair.say}".encode()).digest()

    chosen = set(sorted(pairs, key=drawn)[: max(1, round(share * len(pairs)))])
    return tuple(pair for pair in pairs if pair in chosen)


def _pair(path: Path, number: int, entry: object, kind: Kind) -> Pair:
    name = entry.get("id", "no id") if isinstance(entry, dict) else "no table"
    where = f"{path}: pair {number} ({name})"
    try:
        pair = msgspec.convert(entry, Pair)
    except msgspec.ValidationError as error:
        raise ConfigError(f"{where}: {error}") from error
    pair = msgspec.structs.replace(pair, kind=kind, program=pair.program.strip("\n"))
    for field in ("id", "family", "say", "program", "after"):
        if not getattr(pair, field):
            raise ConfigError(f"{where}: {field} must not be empty")
    return pair


def _refuse_twins(path: Path, pairs: tuple[Pair, ...]) -> None:
    for field in ("id", "say", "program"):
        seen: dict[str, Pair] = {}
        for pair in pairs:
            first = seen.setdefault(getattr(pair, field), pair)
            if first is not pair:
                raise ConfigError(f"{path}: {pair.id} has the {field} of {first.id}")
