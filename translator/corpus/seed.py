"""Read the seeds of ``seeds/*.toml``: a program over slots, and the ways people ask for it.

    [[seed]]
    id = "put_left_of"
    family = "place_relation"
    kind = "manipulate"                 # or "arrange", or "both": the same text is right in either
    program = "put(a, left_of(a, b))"
    after = ["left_of a b", "next_to a b", "only a"]
    given = ["room"]
    say = ["put {a} to the left of {b}", "{a} goes left of {b}"]

Slots: ``a b c d e f`` are one object each, ``A B`` several (a list in the program), ``L M`` lengths
(table units), ``T`` an angle (radians), ``N`` a whole number. In a sentence ``{a}`` stands for the
whole phrase that names the object, article included; ``{A}`` likewise ("all the blocks"), ``{L}``
for the whole measure ("10 cm"), ``{N}`` for the number alone ("two"). A postcondition of the form
``each A LINE`` holds for every object of A, with ``it`` standing for the object. The words of
``after`` are those of ``evals/postconditions.py``. Files of ``wordings/`` add wordings that other
hands wrote for these meanings: ``put_left_of = ["{a} over by {b}, on its left", ...]``.
"""

from __future__ import annotations

import hashlib
import re
import tomllib
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Literal

import msgspec

from agent.errors import ConfigError

SEEDS = Path(__file__).parent / "seeds"
WORDINGS = "wordings"
"""The folder beside that of the seeds, with what other hands added."""
CONDITIONS = Path(__file__).parent / "conditions.toml"
OBJECTS, GROUPS, LENGTHS, ANGLES, COUNTS = "abcdef", "AB", "LM", "T", "N"
NAME = re.compile(r"\b[a-fABLMTN]\b(?!['\"])")
"""A slot in a program."""
SLOT = re.compile(r"\{([a-fABLMTN])\}")


class Seed(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One meaning with its wordings; ``program`` ends without a newline."""

    id: str
    family: str
    kind: Literal["manipulate", "arrange", "both"] = "manipulate"
    program: str
    after: tuple[str, ...]
    given: tuple[str, ...] = ()
    say: tuple[str, ...]

    @property
    def slots(self) -> tuple[str, ...]:
        """The slots that every wording names, in alphabetical order."""
        return tuple(sorted(set(SLOT.findall(self.say[0]))))


class Condition(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a deed may depend on: a test over slots, and the ways people say it."""

    test: str
    say: tuple[str, ...]


def load_conditions(path: Path = CONDITIONS) -> tuple[Condition, ...]:
    """The conditions of the file. Raises ConfigError naming file and fault."""
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        return tuple(msgspec.convert(data, dict[str, list[Condition]])["condition"])
    except (OSError, KeyError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ConfigError(f"{path}: {error}") from error


@cache
def load_seeds(folder: Path = SEEDS) -> tuple[Seed, ...]:
    """All seeds, file by file, with the wordings beside them; read once (it takes seconds). Raises
    ConfigError that names file, seed and fault."""
    seeds: list[Seed] = []
    for path in sorted(folder.glob("*.toml")):
        try:
            data = tomllib.loads(path.read_text(encoding="utf-8"))
            seeds += msgspec.convert(data, dict[str, list[Seed]])["seed"]
        except (OSError, KeyError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
            raise ConfigError(f"{path}: {error}") from error
    seeds = _with_wordings(seeds, folder.with_name(WORDINGS))
    _refuse_faults(seeds)
    return tuple(msgspec.structs.replace(seed, program=seed.program.strip("\n")) for seed in seeds)


def _with_wordings(seeds: Sequence[Seed], folder: Path) -> list[Seed]:
    """Each seed with its own wordings first."""
    added: dict[str, list[str]] = {}
    known = {seed.id for seed in seeds}
    for path in sorted(folder.glob("*.toml")):
        try:
            data = tomllib.loads(path.read_text(encoding="utf-8"))
            more = msgspec.convert(data, dict[str, list[str]])
        except (OSError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
            raise ConfigError(f"{path}: {error}") from error
        for name, say in more.items():
            if name not in known:
                raise ConfigError(f"{path}: there is no seed {name}")
            added.setdefault(name, []).extend(say)
    return [
        msgspec.structs.replace(seed, say=(*seed.say, *added.get(seed.id, ()))) for seed in seeds
    ]


def _refuse_faults(seeds: list[Seed]) -> None:
    """Raise ConfigError where an id comes twice, a wording misses a slot, or means two things."""
    means: dict[tuple[str, str], tuple[str, str]] = {}
    names: set[str] = set()
    for seed in seeds:
        if seed.id in names:
            raise ConfigError(f"seed {seed.id}: the id is used twice")
        names.add(seed.id)
        if not seed.say or not seed.after:
            raise ConfigError(f"seed {seed.id}: say and after must not be empty")
        for say in seed.say:
            if set(SLOT.findall(say)) != set(seed.slots) or re.search(r"[{}]", SLOT.sub("", say)):
                raise ConfigError(f"seed {seed.id}: {say!r} does not name exactly {seed.slots}")
            if not set(NAME.findall(seed.program)) <= set(seed.slots):
                raise ConfigError(f"seed {seed.id}: no wording says what the program speaks of")
            text, program = canonical(say, seed.program)
            for kind in ("manipulate", "arrange") if seed.kind == "both" else (seed.kind,):
                other = means.setdefault((kind, text), (program, seed.id))
                if other[0] != program:
                    raise ConfigError(f"seed {seed.id}: {say!r} means another thing in {other[1]}")


def kept(seeds: Sequence[Seed], held_out: bool) -> tuple[Seed, ...]:
    """The seeds with the wordings for training, or with those held out: one in twenty, by its text.

    Every seed keeps its first wording for training.
    """

    def wanted(seed: Seed, number: int, say: str) -> bool:
        digest = hashlib.sha256(f"{seed.id} {say}".encode()).digest()
        return (number > 0 and digest[0] % 20 == 0) is held_out

    chosen = [
        msgspec.structs.replace(
            seed, say=tuple(say for n, say in enumerate(seed.say) if wanted(seed, n, say))
        )
        for seed in seeds
    ]
    return tuple(seed for seed in chosen if seed.say)


def share_of(seeds: Sequence[Seed], share: float) -> tuple[Seed, ...]:
    """The seeds with a share of their wordings, drawn by their text; each keeps its first one."""

    def wanted(seed: Seed, say: str) -> bool:
        digest = hashlib.sha256(f"share {seed.id} {say}".encode()).digest()
        return int.from_bytes(digest[:4]) < share * 2**32

    return tuple(
        msgspec.structs.replace(
            seed, say=(seed.say[0], *(say for say in seed.say[1:] if wanted(seed, say)))
        )
        for seed in seeds
    )


def canonical(say: str, program: str) -> tuple[str, str]:
    """A wording and its program with slots numbered in order of mention: what the model learns."""
    names: dict[str, str] = {}
    for slot in SLOT.findall(say):
        names.setdefault(slot, f"{kind_of(slot)}{len(names) + 1}")
    text = SLOT.sub(lambda match: f"<{names[match.group(1)]}>", say).lower()
    return text, NAME.sub(lambda match: names.get(match.group(), match.group()), program)


def kind_of(slot: str) -> str:
    """What a slot stands for: ``object``, ``group``, ``length``, ``angle`` or ``count``."""
    for kind, letters in (("object", OBJECTS), ("group", GROUPS), ("length", LENGTHS),
                          ("angle", ANGLES), ("count", COUNTS)):  # fmt: skip
        if slot in letters:
            return kind
    raise ValueError(f"no slot {slot!r}")
