"""The mix that episodes are drawn from: groups, sorts, their shares, and the wordings of each."""

from __future__ import annotations

import tomllib
from collections import defaultdict
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Literal

import msgspec

from translator.corpus.seed import OBJECTS, Seed, kept, load_seeds

SAID = Path(__file__).with_name("episodes.toml")
Group = Literal["none", "one", "two", "spatial", "numeric", "follow-up"]
Sort = Literal["clear", "any", "which", "missing", "how_many", "absent", "infeasible"]
"""``any``: "an apple"; ``which``: "the apple" of several; ``missing``: no destination or direction;
``how_many``: "a few apples"; ``absent``: a noun that nothing bears; ``infeasible``: every reading
is refused by the check."""

SHARES: Mapping[Group, float] = {
    "none": 0.13, "one": 0.18, "two": 0.18, "spatial": 0.17, "numeric": 0.17, "follow-up": 0.17,
}  # fmt: skip
"""How often each group is drawn."""
SORTS: Mapping[Group, Mapping[Sort, float]] = {
    "none": {"clear": 1.0},
    "one": {"clear": 0.42, "which": 0.2, "any": 0.1, "missing": 0.16, "absent": 0.07,
            "infeasible": 0.05},
    "two": {"clear": 0.56, "which": 0.22, "any": 0.1, "absent": 0.07, "infeasible": 0.05},
    "spatial": {"clear": 0.7, "which": 0.15, "any": 0.1, "infeasible": 0.05},
    "numeric": {"clear": 0.6, "which": 0.12, "any": 0.1, "how_many": 0.13, "infeasible": 0.05},
    "follow-up": {"clear": 0.8, "which": 0.2},
}  # fmt: skip
FIRST = ("touch", "place", "push")
"""Families with which a conversation opens: what they begin with."""


class Missing(msgspec.Struct, frozen=True):
    """Commands that leave something out, and what it may be."""

    id: str
    say: tuple[str, ...]
    meant: tuple[Filled, ...]


class Filled(msgspec.Struct, frozen=True):
    """What a command leaves out, in words, and the intent that it then has."""

    words: str
    short: str
    program: str
    after: tuple[str, ...]


@cache
def wordings() -> Mapping[Group, tuple[tuple[Seed, str], ...]]:
    """Held-out wordings of seeds for one arm on the table, by the group that they may serve."""
    found: dict[Group, list[tuple[Seed, str]]] = defaultdict(list)
    for seed in kept(load_seeds(), held_out=True):
        things = sum(slot in OBJECTS for slot in seed.slots)
        counted = [slot for slot in seed.slots if slot not in OBJECTS]
        group: Group = "numeric"
        if not counted and things < 4:
            group = "none" if things == 0 else "one" if things == 1 else "two"
        elif len(counted) > 2 or things > 2:
            continue
        found[group] += [(seed, say) for say in seed.say]
    return {group: tuple(pairs) for group, pairs in found.items()}


@cache
def usual() -> Mapping[str, str]:
    """The first wording of every seed."""
    return {seed.id: seed.say[0] for seed in load_seeds()}


@cache
def missing() -> tuple[Missing, ...]:
    data = tomllib.loads(SAID.read_text(encoding="utf-8"))
    return msgspec.convert(data["missing"], tuple[Missing, ...])


@cache
def openers() -> tuple[Seed, ...]:
    """Seeds about one thing in their usual wording, after which it is still at hand."""
    return tuple(
        seed for seed in load_seeds()
        if seed.slots == ("a",) and seed.kind != "arrange" and seed.family.startswith(FIRST)
        and "off" not in seed.id and "->" not in seed.say[0]
    )  # fmt: skip
