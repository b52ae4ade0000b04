"""Dialogue episodes: a live scene, what a person wants there, and words that say it or not quite.

    python -m evals.episodes [--episodes 20] [--seed 0]       # prints some

An episode is drawn from a seed (`translator.corpus.seed`) in one of its held-out wordings, over a
random scene. Its references are clear, or fit several things, or leave something out, or name what
is not there (`Sort`). What the words allow, the set V, is found by executing the seed's program for
everything that they may mean; the one that is meant is uniform in V (clarifier design, "Conformal
calibration"). Nothing of the clarifier is asked.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tomllib
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Literal, NamedTuple

import msgspec

from agent.execute import Executor
from agent.messages import Kind
from evals.intents import Intent, Meaning, Table, distinct
from evals.naming import Described, descriptions, namesakes, pick
from evals.seed_proof import Value, cast
from scene.generate import CLASSES, random_scene
from scene.types import Scene, identifiers
from translator.corpus.seed import (
    ANGLES,
    COUNTS,
    GROUPS,
    LENGTHS,
    OBJECTS,
    SLOT,
    Seed,
    kept,
    load_seeds,
)

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
DRAWS = 200
"""Draws of one episode's content before another wording is taken."""
STRANGE = ("glorp", "snorfle", "quibbet", "wumple", "trindle")
"""Nouns that nobody knows."""
UNSEEN = ("purple", "turquoise", "beige", "maroon")
"""Colours in which no kind of thing of `scene.generate` comes."""
FIRST = ("touch", "place", "push")
"""Families with which a conversation opens: what they begin with."""
_WHOLE = re.compile(
    r"^(?:(?:put_all\w*|row|column|stack|put_in_line|in_shape|put_each)\(A[,)]|for one in A:)", re.M
)
"""A program that does the same with all of a group, however many they are."""
_WORDS = ("zero", "one", "two", "three", "four", "five")
_SPATIAL = ("side", "landmark", "order")


class Episode(NamedTuple):
    """One dialogue to come. ``opening``: what is said and done before ``text``, if anything.

    ``meanings`` is V, ``meant`` the index of v*; both are empty (-1) where nothing may be done.
    """

    name: str
    group: Group
    sort: Sort
    scene: Scene
    kind: Kind
    text: str
    meanings: tuple[Meaning, ...]
    meant: int
    opening: tuple[str, Meaning] | None = None

    @property
    def clear(self) -> bool:
        """Whether a question would be one too many: one outcome, or any of several will do."""
        return len(self.meanings) == 1

    @property
    def ambiguous(self) -> bool:
        """Whether the words allow several outcomes."""
        return len(self.meanings) > 1


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


def episodes(
    count: int, seed: int, executor: Executor, wanted: Sequence[Sort] = ()
) -> Iterator[Episode]:
    """So many episodes, of the ``wanted`` sorts alone if any are named; the same seed gives the
    same."""
    chance = random.Random(seed)
    draw = _Draw(Table(executor), chance)
    mix = {group: {sort: share for sort, share in sorts.items() if not wanted or sort in wanted}
           for group, sorts in SORTS.items()}  # fmt: skip
    groups = [group for group, sorts in mix.items() if sorts]
    shares = [SHARES[group] for group in groups]
    for number in range(count):
        group = chance.choices(groups, shares)[0]
        sorts = mix[group]
        sort = chance.choices(list(sorts), list(sorts.values()))[0]
        found = None
        while found is None:
            found = draw.episode(f"{seed}.{number}", group, sort)
        yield found


@cache
def _seeds() -> tuple[Seed, ...]:
    return load_seeds()


@cache
def _wordings() -> Mapping[Group, tuple[tuple[Seed, str], ...]]:
    """Held-out wordings of seeds for one arm on the table, by the group that they may serve."""
    found: dict[Group, list[tuple[Seed, str]]] = defaultdict(list)
    for seed in kept(_seeds(), held_out=True):
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
def _usual() -> Mapping[str, str]:
    """The first wording of every seed."""
    return {seed.id: seed.say[0] for seed in _seeds()}


@cache
def _missing() -> tuple[Missing, ...]:
    data = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return msgspec.convert(data["missing"], tuple[Missing, ...])


class _Draw:
    """Draws the content of episodes; None where what was drawn is not as wanted."""

    def __init__(self, table: Table, chance: random.Random) -> None:
        self._table = table
        self._chance = chance

    def episode(self, name: str, group: Group, sort: Sort) -> Episode | None:
        """One episode of this group and sort."""
        draw = self._follow_up if group == "follow-up" else self._single
        if sort == "missing":
            draw = self._left_out
        for _ in range(DRAWS):
            found = draw(name, group, sort)
            if found is not None:
                return found
        return None

    # --- one command ------------------------------------------------------------------------------

    def _single(self, name: str, group: Group, sort: Sort) -> Episode | None:
        chance = self._chance
        pool = _wordings()[chance.choice(("one", "two")) if group == "spatial" else group]
        seed, say = chance.choice(pool)
        intent = Intent(seed.program, seed.after, seed.given)
        open_slot = self._open_slot(seed, say, group, sort)
        if open_slot is None:
            return None
        names, values, spare = cast(seed, chance)
        doubled = self._doubled(seed, values, open_slot, group, sort)
        scene, kind = self._scene(seed, [*names, *doubled, spare], group)
        bound = {slot: self._renamed(value, scene) for slot, value in values.items()}
        phrases = self._phrases(seed, bound, scene, open_slot if sort != "clear" else "", group)
        if phrases is None:
            return None
        choices = self._choices(bound, open_slot, scene, sort, phrases)
        if choices is None:
            return None
        said = [Described(_usual()[seed.id], "") for _ in choices]
        meanings = self._meanings(intent, bound, choices, scene, kind, said, phrases, open_slot)
        text = self._dressed(SLOT.sub(lambda match: phrases[match.group(1)], say))
        return self._finished(name, group, sort, scene, kind, text, meanings)

    def _open_slot(self, seed: Seed, say: str, group: Group, sort: Sort) -> str | None:
        """The slot whose reference is not simply clear; empty where all are; None: no such slot."""
        every = [slot for slot in seed.slots if slot in OBJECTS]
        things = every
        several = [slot for slot in seed.slots if slot in GROUPS]
        once = [slot for slot in things if say.count(f"{{{slot}}}") == 1]
        if sort == "any":
            # of two things that "an apple ... an apple" may be, neither is told by the program
            things = [] if "if " in seed.program else once
        if sort in ("clear", "infeasible"):
            return "" if group != "spatial" or every else None
        if sort == "how_many" or (several and group == "numeric" and self._chance.random() < 0.5):
            things = several if _WHOLE.search(seed.program) and "one of" not in say else []
        return self._chance.choice(things) if things else None

    def _doubled(
        self, seed: Seed, values: Mapping[str, Value], open_slot: str, group: Group, sort: Sort
    ) -> list[str]:
        """More things of the names in the sentence, so that a reference is unclear or needs words
        that single it out."""
        chance, more = self._chance, list[str]()
        for slot, value in values.items():
            if isinstance(value, float):
                continue
            noun = value if isinstance(value, str) else value[0].rpartition("_")[0]
            if slot == open_slot:
                few = 1 if slot in GROUPS else chance.choices((1, 2, 3), (5, 3, 1))[0]
                more += [] if sort in ("absent", "how_many") else [noun] * few
            elif slot in OBJECTS and chance.random() < (0.7 if group == "spatial" else 0.2):
                more += [noun] * chance.choice((1, 1, 2))
        return more

    def _scene(self, seed: Seed, names: Sequence[str], group: Group) -> tuple[Scene, Kind]:
        """A table with these things, in random order, or a tray where the seed can be for one."""
        chance = self._chance
        if seed.kind == "arrange" or (seed.kind == "both" and group in ("one", "two", "numeric")
                                      and chance.random() < 0.15):  # fmt: skip
            return random_scene(chance, [], names), "arrange"
        return random_scene(chance, names, room=0.15), "manipulate"

    def _renamed(self, value: Value, scene: Scene) -> Value:
        """The identifiers on the scene of what `cast` named: its first thing, or first few."""
        if isinstance(value, float):
            return value
        known = {item.id: name for name, item in identifiers(scene).items()}
        if isinstance(value, str):
            return known[f"{value}_1"]
        return [known[one] for one in value]

    # --- references -------------------------------------------------------------------------------

    def _phrases(
        self, seed: Seed, bound: dict[str, Value], scene: Scene, open_slot: str, group: Group
    ) -> dict[str, str] | None:
        """Words for every slot but the open one; measures are changed to what they say."""
        phrases: dict[str, str] = {}
        spatial = False
        for slot, value in bound.items():
            if slot == open_slot:
                continue
            if slot in LENGTHS + ANGLES + COUNTS:
                phrases[slot], bound[slot] = self._measure(slot, value)
            elif isinstance(value, list):
                phrases[slot] = self._group(value, scene)
            else:
                item = identifiers(scene)[str(value)]
                found = pick(scene, item, self._chance, _SPATIAL) if group == "spatial" else None
                spatial = spatial or found is not None
                found = found or pick(scene, item, self._chance)
                if found is None:
                    return None
                phrases[slot] = f"the {found.text}"
        wants_spatial = group == "spatial" and len(phrases) > 0
        return None if wants_spatial and not spatial else phrases

    def _measure(self, slot: str, value: Value) -> tuple[str, Value]:
        chance = self._chance
        if slot in LENGTHS:
            cm = chance.choice((3, 4, 5, 6, 7, 8, 10))
            said = chance.choice((f"{cm} cm", f"{cm} centimetres", f"{cm}cm", f"{10 * cm} mm"))
            return said, cm / 20
        if slot in ANGLES:
            degrees = chance.choice((30, 45, 60, 90, 120))
            return chance.choice((f"{degrees} degrees", f"{degrees}°")), degrees * 3.14159265 / 180
        assert isinstance(value, float)
        return chance.choice((_WORDS[int(value)], str(int(value)))), value

    def _group(self, members: Sequence[str], scene: Scene) -> str:
        """ "all the apples": every one of that name there is."""
        noun, count = _plural(members, scene), len(members)
        ways = [f"the {noun}", f"all the {noun}", f"the {_WORDS[count]} {noun}"]
        return self._chance.choice([*ways, f"both {noun}"] if count == 2 else ways)

    def _choices(
        self, bound: Mapping[str, Value], open_slot: str, scene: Scene, sort: Sort,
        phrases: dict[str, str],
    ) -> list[list[Value]] | None:  # fmt: skip
        """What the open slot may stand for: a list for each meaning of those that are all right.
        Its phrase goes into ``phrases``."""
        if not open_slot or sort in ("clear", "infeasible"):
            return [[]]
        value, chance = bound[open_slot], self._chance
        if isinstance(value, list):
            return self._grouped(value, open_slot, scene, sort, phrases)
        item = identifiers(scene)[str(value)]
        names = {other.id: name for name, other in identifiers(scene).items()}
        same = [names[other.id] for other in namesakes(scene, item)]
        if sort == "absent":
            phrases[open_slot] = f"the {self._absent(item.name, scene)}"
            return []
        if sort == "any":
            ways = (_article(item.name), f"any {item.name}", f"one of the {_plural(same, scene)}")
            phrases[open_slot] = chance.choice(ways)
            return [list(same)]
        phrases[open_slot] = f"the {item.name}"
        return [[one] for one in same]

    def _grouped(
        self, value: list[str], open_slot: str, scene: Scene, sort: Sort, phrases: dict[str, str]
    ) -> list[list[Value]] | None:
        """The same for a slot that stands for several things."""
        item = identifiers(scene)[value[0]]
        names = {other.id: name for name, other in identifiers(scene).items()}
        same = [names[other.id] for other in namesakes(scene, item)]
        noun = _plural(same, scene)
        some = [[one for one in same if one != left] for left in same]
        if sort == "how_many":
            phrases[open_slot] = self._chance.choice((f"a few {noun}", f"several {noun}"))
            if len(same) < 3:
                return None
            return [[list(few) for few in _subsets(same, n)] for n in range(2, len(same) + 1)]
        if sort == "absent" or len(same) < 3:
            return None
        count = _WORDS[len(same) - 1]
        phrases[open_slot] = f"{count} {noun}" if sort == "any" else f"the {count} {noun}"
        every: list[Value] = list(some)
        return [every] if sort == "any" else [[few] for few in some]

    def _absent(self, noun: str, scene: Scene) -> str:
        """A noun, or a noun with a colour, that nothing on the table bears."""
        chance, way = self._chance, self._chance.random()
        there = {word for item in scene for word in item.name.split()}
        if way < 0.2:
            return chance.choice(STRANGE)
        if way < 0.5:
            return f"{chance.choice(UNSEEN)} {noun}"
        return chance.choice([word for word in CLASSES if word not in there])

    # --- meanings ---------------------------------------------------------------------------------

    def _meanings(
        self, intent: Intent, bound: Mapping[str, Value], choices: Sequence[Sequence[Value]],
        scene: Scene, kind: Kind, said: Sequence[Described], phrases: Mapping[str, str],
        open_slot: str,
    ) -> list[Meaning] | None:  # fmt: skip
        """A meaning for each choice; None where the scene is not as the intent takes for given."""
        found = []
        for choice, usual in zip(choices, said, strict=True):
            bindings = [{**bound, open_slot: one} for one in choice] if choice else [dict(bound)]
            if not all(self._table.given(intent, one, scene) for one in bindings):
                return None
            words = dict(phrases)
            if open_slot and choice:
                described = self._described(choice[0], scene)
                if described is None:
                    return None
                words[open_slot] = described
            sentence = SLOT.sub(lambda match, words=words: words[match.group(1)], usual.text)
            picked = choice[0] if open_slot and choice else []
            found.append(self._table.meaning(intent, bindings, scene, kind, picked, sentence))
        return found

    def _described(self, value: Value, scene: Scene) -> str | None:
        """What was chosen, in words that leave nothing open."""
        known = identifiers(scene)
        every = [descriptions(scene, known[one]) for one in
                 ([value] if isinstance(value, str) else value if isinstance(value, list) else [])]
        if not all(every):
            return None
        return " and ".join(f"the {found[0].text}" for found in every)

    def _finished(
        self, name: str, group: Group, sort: Sort, scene: Scene, kind: Kind, text: str,
        meanings: list[Meaning] | None, opening: tuple[str, Meaning] | None = None,
    ) -> Episode | None:  # fmt: skip
        """The episode, if what may be done is what its sort promises."""
        if meanings is None:
            return None
        able = distinct([one for one in meanings if one.variants], scene if opening is None
                        else opening[1].variants[0].after)  # fmt: skip
        if sort in ("absent", "infeasible"):
            refused = not able and all(one.refused for one in meanings)
            return Episode(name, group, sort, scene, kind, text, (), -1) if refused else None
        least = 2 if sort in ("which", "missing", "how_many") else 1
        if len(able) < least or (sort in ("clear", "any") and len(able) > 1):
            return None
        meant = self._chance.randrange(len(able))
        return Episode(name, group, sort, scene, kind, text, able, meant, opening)

    def _dressed(self, text: str) -> str:
        """A capital and a full stop, as often as people write them."""
        style = self._chance.random()
        if style < 0.4:
            text = text[:1].upper() + text[1:]
            return text.rstrip(" .!") + ("" if text[-1] == "?" else self._chance.choice((".", "")))
        return text

    # --- what is left out, and what follows -------------------------------------------------------

    def _left_out(self, name: str, group: Group, sort: Sort) -> Episode | None:
        """A command without its destination or direction."""
        chance = self._chance
        form = chance.choice(_missing())
        nouns = chance.sample([noun for noun in CLASSES if CLASSES[noun].width < 0.5], 3)
        scene = random_scene(chance, nouns + nouns[:1] * (chance.random() < 0.3), room=0.15)
        item = scene.objects[0]
        found = pick(scene, item, chance)
        if found is None:
            return None
        ident = next(one for one, other in identifiers(scene).items() if other.id == item.id)
        meanings = []
        for filled in form.meant:
            intent = Intent(filled.program, filled.after, ())
            verb = "put" if form.id == "where" else "push"
            said = f"{verb} the {found.text} {filled.words}"
            one = self._table.meaning(intent, [{"a": ident}], scene, "manipulate", [], said)
            meanings.append(one._replace(words=filled.words, short=filled.short))
        text = self._dressed(chance.choice(form.say).replace("{a}", f"the {found.text}"))
        return self._finished(name, group, sort, scene, "manipulate", text, meanings)

    def _follow_up(self, name: str, group: Group, sort: Sort) -> Episode | None:
        """A first command, and one that speaks of its thing, or of the other one."""
        chance = self._chance
        opening = chance.choice(_openers())
        seed, say = chance.choice([*_wordings()["one"], *_wordings()["two"]])
        if SLOT.search(say) is None or SLOT.findall(say)[0] != "a":
            return None  # "it" is what was done before, not what the sentence names first
        if "{a}'" in say or " it" in say.replace("{a}", ""):
            return None
        names, values, spare = cast(seed, chance)
        theme = str(values["a"])
        others = chance.choice((0, 1, 1)) if sort == "clear" else 2
        scene = random_scene(chance, [*names, *[theme] * others, spare], room=0.15)
        same = namesakes(scene, scene.get(f"{theme}_1"))
        known = {item.id: ident for ident, item in identifiers(scene).items()}
        first = pick(scene, same[0], chance, ("type", "color"))
        if first is None:
            return None
        begun = self._table.meaning(
            Intent(opening.program, opening.after, opening.given), [{"a": known[same[0].id]}],
            scene, "manipulate", [], "",
        )  # fmt: skip
        if len(begun.variants) != 1:
            return None
        after = begun.variants[0].after
        bound = {slot: self._renamed(value, scene) for slot, value in values.items()}
        phrases = self._phrases(seed, bound, after, "a", "two")
        if phrases is None:
            return None
        rest = [known[item.id] for item in same[1:]]
        if others and (sort == "which" or chance.random() < 0.5):
            phrases["a"] = chance.choice((f"the other {theme}", "the other one"))
            choices: list[list[Value]] = [[one] for one in rest]
        else:
            phrases["a"], choices = "it", [[known[same[0].id]]]
        said = [Described(_usual()[seed.id], "") for _ in choices]
        intent = Intent(seed.program, seed.after, seed.given)
        meanings = self._meanings(intent, bound, choices, after, "manipulate", said, phrases, "a")
        text = self._dressed(SLOT.sub(lambda match: phrases[match.group(1)], say))
        told = opening.say[0].replace("{a}", f"the {first.text}")
        return self._finished(
            name, group, sort, scene, "manipulate", text, meanings, (told, begun)
        )


@cache
def _openers() -> tuple[Seed, ...]:
    """Seeds about one thing in their usual wording, after which it is still at hand."""
    return tuple(
        seed for seed in _seeds()
        if seed.slots == ("a",) and seed.kind != "arrange" and seed.family.startswith(FIRST)
        and "off" not in seed.id and "->" not in seed.say[0]
    )  # fmt: skip


def _plural(members: Sequence[str], scene: Scene) -> str:
    name = identifiers(scene)[members[0]].name
    return f"{name[:-1]}ies" if name.endswith("ry") else (
        f"{name}es" if name.endswith(("x", "ss", "h", "ato")) else f"{name}s")  # fmt: skip


def _article(name: str) -> str:
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def _subsets(members: Sequence[str], count: int) -> list[list[str]]:
    """Some ways to take so many of them: runs of neighbours, around the end."""
    doubled = [*members, *members]
    return [doubled[at : at + count] for at in range(len(members))][: 1 if count == len(members)
                                                                    else None]  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Print some episodes."""
    parser = argparse.ArgumentParser(prog="python -m evals.episodes", description=__doc__)
    parser.add_argument("--episodes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    with Executor() as executor:
        for one in episodes(options.episodes, options.seed, executor):
            before = f"[{one.opening[0]}] " if one.opening else ""
            print(f"{one.group:9} {one.sort:10} |V| {len(one.meanings)}  {before}{one.text}")
            for number, meaning in enumerate(one.meanings):
                mark = "*" if number == one.meant else " "
                print(f"    {mark} {meaning.variants[0].program!r} | {meaning.said}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
