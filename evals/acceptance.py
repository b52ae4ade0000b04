"""The acceptance list: what a dialogue must get right, each thing said in many ways on many tables.

    python -m evals.acceptance [ITEM ...] [--scenes 5] [--failures] [--json]

An item of ``dialogues/*.toml`` is a conversation in several wordings, what may become of each of
its turns, and what must hold at its end (`evals.postconditions`). It is played on random tables of
the standard things, and again on twin tables: what made the item unclear is taken away, or what
makes it unclear is added, so that a clarifier that always asks, or never, fails one of the two.

    [[item]]
    id = "A1"
    about = "the apple, and there are two: which one"
    say = [["push the apple to the left"], ["slide the apple leftwards"]]
    want = [{status = ["asked"], kind = ["which"], options = ["apple_1", "apple_2"]}]
    [item.twin]
    without = ["apple_2"]
    want = [{status = ["done"]}]
    after = ["moved apple left", "only apple"]

``given`` are lines that the table must fulfil before; ``add`` puts more things on it ``{id, name,
color}``; ``without`` takes some away; ``tray`` are ids that wait in the tray. In a twin ``say`` may
be other words, and what it does not mention is as in the item.
"""

from __future__ import annotations

import argparse
import random
import sys
import tomllib
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from evals.cases import Case, Score, Want
from evals.outcomes import failures, play
from evals.postconditions import Malformed, holds
from evals.tally import summary, table
from evals.world import World
from scene.types import Scene, SceneObject

ITEMS = Path(__file__).parent / "dialogues"
DRAWS = 4000
"""Tables to draw at most until one is as given."""
APART = 0.14
"""Least gap between two footprints, along x or along y (table units)."""


class Thing(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A thing of the tables: its size (width, height, tall) in table units varies by 8 %."""

    id: str
    name: str
    size: tuple[float, float, float] = (0.16, 0.16, 0.16)
    color: str | None = None


STANDARD = (
    Thing("apple_1", "apple", (0.18, 0.18, 0.18), "red"),
    Thing("apple_2", "apple", (0.18, 0.18, 0.18), "green"),
    Thing("mug_1", "mug", (0.2, 0.18, 0.2), "red"),
    Thing("mug_2", "mug", (0.2, 0.18, 0.2), "blue"),
    Thing("bottle_1", "bottle", (0.14, 0.14, 0.34)),
    Thing("bowl_1", "bowl", (0.46, 0.46, 0.18)),
    Thing("plate_1", "plate", (0.46, 0.46, 0.06)),
    Thing("block_1", "block", (0.14, 0.14, 0.14), "red"),
    Thing("block_2", "block", (0.14, 0.14, 0.14), "green"),
    Thing("block_3", "block", (0.14, 0.14, 0.14), "yellow"),
    Thing("sponge_1", "sponge", (0.26, 0.18, 0.08)),
)
"""Two apples, the red one to the left of the green one; two mugs; three blocks; and four more."""


class Twin(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The item on another table; None: as in the item."""

    say: tuple[tuple[str, ...], ...] | None = None
    want: tuple[Want, ...]
    after: tuple[str, ...] = ()
    given: tuple[str, ...] | None = None
    without: tuple[str, ...] = ()
    add: tuple[Thing, ...] = ()
    tray: tuple[str, ...] | None = None


class Item(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One thing that a dialogue must get right."""

    id: str
    about: str
    say: tuple[tuple[str, ...], ...]
    want: tuple[Want, ...]
    after: tuple[str, ...] = ()
    given: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    add: tuple[Thing, ...] = ()
    tray: tuple[str, ...] = ()
    twin: Twin


def load_items(folder: Path = ITEMS) -> tuple[Item, ...]:
    """All items. Raises Malformed naming file and fault."""
    items: list[Item] = []
    for path in sorted(folder.glob("*.toml")):
        try:
            data = tomllib.loads(path.read_text(encoding="utf-8"))
            found = msgspec.convert(data, dict[str, list[Item]])["item"]
        except (ValueError, KeyError, msgspec.ValidationError) as error:
            raise Malformed(f"{path}: {error}") from error
        for item in found:
            _refuse_faults(item, path)
        items += found
    return tuple(items)


def _refuse_faults(item: Item, path: Path) -> None:
    for say, want in ((item.say, item.want), (item.twin.say or item.say, item.twin.want)):
        if any(len(turns) != len(want) for turns in say):
            raise Malformed(f"{path}: {item.id}: a wording has not one turn for each want")


def cases_of(item: Item, scenes: int) -> Iterator[Case]:
    """The item's cases and its twin's, each wording on each of so many tables."""
    twin = item.twin
    other = msgspec.structs.replace(
        item, say=twin.say or item.say, want=twin.want, after=twin.after,
        given=item.given if twin.given is None else twin.given,
        without=(*item.without, *twin.without), add=(*item.add, *twin.add),
        tray=item.tray if twin.tray is None else twin.tray,
    )  # fmt: skip
    for family, played in ((item.id, item), (f"{item.id} twin", other)):
        for number in range(scenes):
            scene = draw(played, random.Random(f"{family} {number}"))
            for wording, turns in enumerate(played.say):
                yield Case(
                    f"{family} {wording}.{number}", family, "", msgspec.to_builtins(scene), turns,
                    played.want, played.after,
                )  # fmt: skip


def draw(item: Item, chance: random.Random) -> Scene:
    """A table as the item wants it. Raises Malformed if none of many is."""
    things = [one for one in (*STANDARD, *item.add) if one.id not in item.without]
    for _ in range(DRAWS):
        scene = _laid_out(things, item.tray, chance)
        if scene is not None:
            world = World(scene, scene, ())
            if all(holds(line, world) for line in item.given):
                return scene
    raise Malformed(f"{item.id}: no table is as given: {', '.join(item.given)}")


def _laid_out(things: Sequence[Thing], tray: Sequence[str], chance: random.Random) -> Scene | None:
    placed: list[SceneObject] = []
    waiting: list[SceneObject] = []
    for one in sorted(things, key=lambda thing: -thing.size[0]):
        width, height, tall = (round(side * chance.uniform(0.92, 1.08), 3) for side in one.size)
        sized = SceneObject(
            id=one.id, name=one.name, width=width, height=height, tall=tall, color=one.color,
            x=None, y=None, on="tray",
        )  # fmt: skip
        if one.id in tray:
            waiting.append(sized)
            continue
        low, high = {"apple_1": (-0.8, -0.2), "apple_2": (0.2, 0.8)}.get(one.id, (-0.8, 0.8))
        for _ in range(80):
            x, y = chance.uniform(low, high), chance.uniform(-0.75, 0.75)
            if max(abs(x) + width / 2, abs(y) + height / 2) < 0.93 and all(
                max(abs(x - o.position[0]) - (width + o.width) / 2,
                    abs(y - o.position[1]) - (height + o.height) / 2) >= APART for o in placed
            ):  # fmt: skip
                put = msgspec.structs.replace(sized, x=round(x, 3), y=round(y, 3), on="table")
                placed.append(put)
                break
        else:
            return None
    order = [one.id for one in things]
    return Scene(
        objects=tuple(sorted(placed, key=lambda item: order.index(item.id))),
        tray=tuple(sorted(waiting, key=lambda item: order.index(item.id))),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Play the items and print how many runs of each went right."""
    parser = argparse.ArgumentParser(prog="python -m evals.acceptance", description=__doc__)
    parser.add_argument("items", nargs="*", help="ids, sections (A) or none for all")
    parser.add_argument("--scenes", type=int, default=5, help="tables for each wording")
    parser.add_argument("--failures", action="store_true", help="list what did not go right")
    parser.add_argument("--json", action="store_true", help="the counts as one object")
    options = parser.parse_args(arguments)
    try:
        items = [item for item in load_items()
                 if not options.items or {item.id, item.id[0]} & set(options.items)]  # fmt: skip
        cases = [case for item in items for case in cases_of(item, options.scenes)]
    except (OSError, Malformed) as error:
        parser.error(str(error))
    groups: dict[str, list[Score]] = defaultdict(list)
    for score in play(cases):
        groups[score.case.family].append(score)
    counted = summary(groups)
    if options.json:
        print(msgspec.json.encode(counted).decode())
        return 0
    print(table(counted))
    if options.failures:
        print(failures(score for scores in groups.values() for score in scores))
    return 0


if __name__ == "__main__":
    sys.exit(main())
