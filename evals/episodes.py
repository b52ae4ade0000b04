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
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from agent.execute import Executor
from agent.messages import Kind
from evals.intents import Intent, Meaning, Table, distinct, fitting
from evals.naming import descriptions, namesakes, pick
from evals.referring import References
from evals.seed_proof import Value, cast
from evals.wordings import SHARES, SORTS, Group, Sort, missing, openers, usual, wordings
from scene.generate import CLASSES, random_scene
from scene.types import Scene, identifiers
from translator.corpus.seed import GROUPS, OBJECTS, SLOT, Seed

DRAWS = 200
"""Draws of one episode's content before another wording is taken."""


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
        while found is None or not told_apart(found):
            found = draw.episode(f"{seed}.{number}", group, sort)
        yield found


def told_apart(episode: Episode) -> bool:
    """Whether each meaning's own end fits that meaning alone."""
    opening = episode.opening
    before = episode.scene if opening is None else opening[1].variants[0].after
    return all(
        fitting(episode.meanings, before, meaning.variants[0].after, meaning.variants[0].commands)
        == [number]
        for number, meaning in enumerate(episode.meanings)
        if meaning.variants
    )


class _Draw:
    """Draws the content of episodes; None where what was drawn is not as wanted."""

    def __init__(self, table: Table, chance: random.Random) -> None:
        self._table = table
        self._chance = chance
        self._refer = References(chance)

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
        pool = wordings()[chance.choice(("one", "two")) if group == "spatial" else group]
        seed, say = chance.choice(pool)
        intent = Intent(seed.program, seed.after, seed.given)
        open_slot = self._refer.open_slot(seed, say, group, sort)
        if open_slot is None:
            return None
        names, values, spare = cast(seed, chance)
        doubled = self._doubled(seed, values, open_slot, group, sort)
        scene, kind = self._scene(seed, [*names, *doubled, spare], group)
        bound = {slot: self._renamed(value, scene) for slot, value in values.items()}
        unsaid = open_slot if sort != "clear" else ""
        phrases = self._refer.phrases(seed, bound, scene, unsaid, group)
        if phrases is None:
            return None
        choices = self._refer.choices(bound, open_slot, scene, sort, phrases)
        if choices is None:
            return None
        say_all = usual()[seed.id]
        meanings = self._meanings(intent, bound, choices, scene, kind, say_all, phrases, open_slot)
        text = self._dressed(_said(say, phrases))
        return self._finished(name, group, sort, scene, kind, text, meanings)

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

    # --- meanings ---------------------------------------------------------------------------------

    def _meanings(
        self, intent: Intent, bound: Mapping[str, Value], choices: Sequence[Sequence[Value]],
        scene: Scene, kind: Kind, say: str, phrases: Mapping[str, str], open_slot: str,
    ) -> list[Meaning] | None:  # fmt: skip
        """A meaning for each choice, which ``say`` says in full; None where the scene is not as the
        intent takes for given."""
        found = []
        for choice in choices:
            bindings = [{**bound, open_slot: one} for one in choice] if choice else [dict(bound)]
            if not all(self._table.given(intent, one, scene) for one in bindings):
                return None
            words = dict(phrases)
            if open_slot and choice:
                described = self._described(choice[0], scene)
                if described is None:
                    return None
                words[open_slot] = described
            sentence = _said(say, words)
            picked = choice[0] if open_slot and choice else []
            found.append(self._table.meaning(intent, bindings, scene, kind, picked, sentence))
        return found

    def _described(self, value: Value, scene: Scene) -> str | None:
        """What was chosen, in words that leave nothing open."""
        known = identifiers(scene)
        every = [
            descriptions(scene, known[one])
            for one in (
                [value] if isinstance(value, str) else value if isinstance(value, list) else []
            )
        ]
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
        form = chance.choice(missing())
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
        opening = chance.choice(openers())
        seed, say = chance.choice([*wordings()["one"], *wordings()["two"]])
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
        phrases = self._refer.phrases(seed, bound, after, "a", "two")
        if phrases is None:
            return None
        rest = [known[item.id] for item in same[1:]]
        if others and (sort == "which" or chance.random() < 0.5):
            phrases["a"] = chance.choice((f"the other {theme}", "the other one"))
            choices: list[list[Value]] = [[one] for one in rest]
        else:
            phrases["a"], choices = "it", [[known[same[0].id]]]
        intent = Intent(seed.program, seed.after, seed.given)
        meanings = self._meanings(
            intent, bound, choices, after, "manipulate", usual()[seed.id], phrases, "a"
        )
        text = self._dressed(_said(say, phrases))
        told = opening.say[0].replace("{a}", f"the {first.text}")
        return self._finished(name, group, sort, scene, "manipulate", text, meanings, (told, begun))


def _said(say: str, words: Mapping[str, str]) -> str:
    """A wording with words in the place of its slots."""
    return SLOT.sub(lambda match: words[match.group(1)], say)


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
