"""Random scenes: real-world sizes by noun, colours, and places well apart. Seeded, no physics."""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

import msgspec

from agent.errors import SceneError
from scene.kinds import color_in, head_noun, is_container
from scene.types import Scene, SceneObject, slug

Rect = tuple[float, float, float, float]
"""Footprint: centre x, y, half width, half height (table units)."""


class Kind(msgspec.Struct, frozen=True):
    """Mean size of a noun's things (table units, 1 unit = 0.20 m) and the colours they come in."""

    width: float
    height: float
    tall: float
    colors: tuple[str, ...] = ()


CLASSES: Mapping[str, Kind] = MappingProxyType(
    {
        "apple": Kind(0.36, 0.36, 0.36, ("red", "green", "yellow")),
        "orange": Kind(0.35, 0.35, 0.335, ("orange",)),
        "lemon": Kind(0.36, 0.25, 0.25, ("yellow",)),
        "pear": Kind(0.385, 0.31, 0.31, ("green", "yellow")),
        "peach": Kind(0.33, 0.33, 0.31, ("orange", "pink")),
        "plum": Kind(0.22, 0.22, 0.22, ("purple", "red")),
        "strawberry": Kind(0.16, 0.16, 0.18, ("red",)),
        "banana": Kind(0.70, 0.25, 0.165, ("yellow",)),
        "tomato": Kind(0.32, 0.32, 0.27, ("red",)),
        "potato": Kind(0.42, 0.28, 0.25, ("brown",)),
        "egg": Kind(0.22, 0.22, 0.28, ("white", "brown")),
        "cup": Kind(0.40, 0.34, 0.38, ("white", "blue", "red")),
        "mug": Kind(0.42, 0.34, 0.40, ("white", "black", "green")),
        "bowl": Kind(0.62, 0.62, 0.26, ("white", "brown", "blue")),
        "plate": Kind(0.66, 0.66, 0.08, ("white", "blue")),
        "glass": Kind(0.32, 0.32, 0.42),
        "bottle": Kind(0.26, 0.26, 0.48, ("green", "brown", "blue")),
        "can": Kind(0.265, 0.265, 0.42, ("red", "silver")),
        "jar": Kind(0.34, 0.34, 0.40),
        "vase": Kind(0.28, 0.28, 0.46, ("white", "blue")),
        "spoon": Kind(0.70, 0.16, 0.08, ("silver",)),
        "fork": Kind(0.70, 0.13, 0.08, ("silver",)),
        "knife": Kind(0.75, 0.12, 0.07, ("silver",)),
        "box": Kind(0.60, 0.48, 0.30, ("brown", "white", "red")),
        "basket": Kind(0.66, 0.52, 0.28, ("brown",)),
        "tray": Kind(0.80, 0.56, 0.12, ("gray", "brown")),
        "pan": Kind(0.66, 0.66, 0.16, ("black",)),
        "block": Kind(0.20, 0.20, 0.20, ("red", "green", "blue", "yellow")),
        "cube": Kind(0.20, 0.20, 0.20, ("red", "green", "blue", "yellow")),
        "ball": Kind(0.30, 0.30, 0.30, ("red", "white", "blue")),
        "brick": Kind(0.42, 0.20, 0.13, ("red",)),
        "cylinder": Kind(0.22, 0.22, 0.30, ("red", "green", "blue")),
        "star": Kind(0.28, 0.28, 0.10, ("yellow", "red")),
        "padlock": Kind(0.21, 0.16, 0.325, ("gold", "silver")),
        "magnet": Kind(0.245, 0.125, 0.10, ("red",)),
        "matchbox": Kind(0.26, 0.175, 0.10, ("blue", "red")),
        "sponge": Kind(0.45, 0.30, 0.15, ("yellow", "green")),
        "book": Kind(0.62, 0.44, 0.12, ("blue", "red", "green", "brown")),
        "phone": Kind(0.36, 0.70, 0.07, ("black", "white")),
        "pen": Kind(0.68, 0.10, 0.07, ("blue", "black", "red")),
        "pencil": Kind(0.72, 0.09, 0.07, ("yellow",)),
        "eraser": Kind(0.24, 0.12, 0.09, ("white", "pink")),
        "scissors": Kind(0.66, 0.30, 0.07, ("black", "red")),
        "key": Kind(0.28, 0.13, 0.05, ("silver", "gold")),
        "coin": Kind(0.14, 0.14, 0.05, ("silver", "gold")),
        "candle": Kind(0.20, 0.20, 0.36, ("white", "red")),
        "toy": Kind(0.30, 0.24, 0.28),
        "car": Kind(0.42, 0.20, 0.16, ("red", "blue", "black")),
        "duck": Kind(0.32, 0.26, 0.28, ("yellow",)),
        "shoe": Kind(0.75, 0.30, 0.28, ("black", "brown", "white")),
    }
)
"""Mean size of each known noun: household things of a size that a small arm can carry."""

SPREAD = (0.90, 1.08)
"""Factor by which one thing's size differs from its noun's mean."""
_ROUND = 3
_TRIES = 60


def random_scene(
    rng: random.Random,
    names: Sequence[str],
    tray: Sequence[str] = (),
    *,
    room: float = 0.2,
    span: float = 0.7,
) -> Scene:
    """A scene of things with these names, in random places; same ``rng`` state, same scene.

    Footprints on the table lie at least ``room`` apart, centres within +-``span`` (table units).
    Names may repeat; objects in the tray have sizes only. A crowd that does not fit is made of
    smaller things. Raises SceneError when even tiny ones find no room.
    """
    ids = _ids([*names, *tray])
    things = [
        _thing(rng, name, object_id) for name, object_id in zip([*names, *tray], ids, strict=True)
    ]
    waiting = tuple(msgspec.structs.replace(item, on="tray") for item in things[len(names) :])
    shrink = 1.0
    while shrink > 0.1:
        sized = [_scaled(item, shrink) for item in things[: len(names)]]
        placed = _place(rng, sized, room, span)
        if placed is not None:
            return Scene(objects=placed, tray=waiting)
        shrink *= 0.85
    raise SceneError(f"no room for {len(names)} things with {room} between them")


def size_of(rng: random.Random, name: str) -> Kind:
    """Size and colours for any noun phrase; an unknown noun gets a plausible size from ``rng``.

    "small", "big" and their like in the name scale it.
    """
    kind = CLASSES.get(head_noun(name)) or _invented(rng, name)
    factor = rng.uniform(*SPREAD) * _adjective(name)
    width, height, tall = (
        round(side * factor, _ROUND) for side in (kind.width, kind.height, kind.tall)
    )
    return Kind(width, height, tall, kind.colors)


def _invented(rng: random.Random, name: str) -> Kind:
    if is_container(name):
        side = rng.uniform(0.45, 0.7)
        return Kind(side, side, rng.uniform(0.2, 0.4))
    long = rng.uniform(0.2, 0.45)
    return Kind(long, long * rng.uniform(0.5, 1.0), rng.uniform(0.1, 0.4))


def _adjective(name: str) -> float:
    said = set(name.lower().split())
    if said & {"small", "little", "tiny", "mini"}:
        return 0.7
    return 1.25 if said & {"big", "large", "huge", "giant"} else 1.0


def _ids(names: Iterable[str]) -> list[str]:
    counts: dict[str, int] = {}
    ids = []
    for name in names:
        stem = slug(name)
        counts[stem] = counts.get(stem, 0) + 1
        ids.append(f"{stem}_{counts[stem]}")
    return ids


def _thing(rng: random.Random, name: str, object_id: str) -> SceneObject:
    kind = size_of(rng, name)
    offered = rng.choice(kind.colors) if kind.colors else None
    return SceneObject(
        id=object_id,
        name=name,
        width=kind.width,
        height=kind.height,
        tall=kind.tall,
        color=color_in(name) or offered,
    )


def _scaled(item: SceneObject, factor: float) -> SceneObject:
    if factor == 1.0:
        return item
    sizes = {side: round(getattr(item, side) * factor, 4) for side in ("width", "height", "tall")}
    return msgspec.structs.replace(item, **sizes)


def _place(
    rng: random.Random, things: Sequence[SceneObject], room: float, span: float
) -> tuple[SceneObject, ...] | None:
    """Every thing with a place, the largest first to find one; None when one finds no room."""
    order = sorted(
        range(len(things)), key=lambda index: -things[index].width * things[index].height
    )
    taken: list[Rect] = []
    placed: dict[int, SceneObject] = {}
    for index in order:
        spot = _spot(rng, things[index], taken, room, span)
        if spot is None:
            return None
        taken.append((*spot, things[index].width / 2, things[index].height / 2))
        placed[index] = msgspec.structs.replace(things[index], x=spot[0], y=spot[1])
    return tuple(placed[index] for index in range(len(things)))


def _spot(
    rng: random.Random, item: SceneObject, taken: Sequence[Rect], room: float, span: float
) -> tuple[float, float] | None:
    half_w, half_h = item.width / 2, item.height / 2
    reach_x, reach_y = min(span, 1.0 - half_w), min(span, 1.0 - half_h)
    for _ in range(_TRIES):
        x = round(rng.uniform(-reach_x, reach_x), _ROUND)
        y = round(rng.uniform(-reach_y, reach_y), _ROUND)
        if all(_apart((x, y, half_w, half_h), other) >= room for other in taken):
            return x, y
    return None


def _apart(one: Rect, other: Rect) -> float:
    """Gap between two axis-aligned footprints along the axis on which they lie further apart."""
    along_x = abs(one[0] - other[0]) - one[2] - other[2]
    along_y = abs(one[1] - other[1]) - one[3] - other[3]
    return max(along_x, along_y)
