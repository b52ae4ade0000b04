"""Words about several things: what each says of two scenes, and what it does not."""

from __future__ import annotations

import pytest

from evals.postconditions import holds
from evals.world import World
from scene.types import Scene, SceneObject


def thing(name: str, x: float, y: float, **other) -> SceneObject:
    sizes = {"width": 0.2, "height": 0.2, "tall": 0.1}
    return SceneObject(id=f"{name}_1", name=name, x=x, y=y, **{**sizes, **other})


def world(before: list[SceneObject], after: list[SceneObject]) -> World:
    return World(Scene(objects=tuple(before)), Scene(objects=tuple(after)), ())


SPREAD = [
    thing("egg", -0.6, 0, color="red"), thing("cup", 0, 0, color="blue", tall=0.2, width=0.3),
    thing("box", 0.6, 0, color="red", height=0.3, width=0.3), thing("lid", 0, 0.6, color="green"),
]  # fmt: skip
STILL = world(SPREAD, SPREAD)
ON_BOX = world(SPREAD, [thing("egg", 0.6, 0, color="red", z=0.1, on="box_1"), *SPREAD[1:]])
BRIDGED = world(
    SPREAD,
    [thing("egg", 0, 0), thing("cup", 0.21, 0), thing("lid", 0.1, 0, z=0.1, on="egg_1")],
)
CROSS = world(
    SPREAD,
    [thing("egg", 0, 0), thing("cup", -0.3, 0), thing("box", 0.3, 0), thing("lid", 0, 0.3)],
)
V = world(SPREAD, [thing("egg", 0, 0), thing("cup", -0.3, 0.3), thing("box", 0.3, 0.3)])
L = world(SPREAD, [thing("egg", 0, 0.3), thing("cup", 0, 0), thing("box", 0.3, 0)])


@pytest.mark.parametrize(
    ("scene", "line", "truth"),
    [
        (STILL, "at_least 3 egg cup box", True),
        (STILL, "at_least 3 egg cup", False),
        (STILL, "level egg lid", True),
        (STILL, "level egg cup", False),
        (STILL, "solid egg lid", True),
        (STILL, "solid egg cup", False),
        (STILL, "broader box egg", True),
        (STILL, "broader cup egg", False),
        (ON_BOX, "matched on same egg : cup box", True),
        (STILL, "matched on same egg : cup box", False),
        (STILL, "matched on same lid : cup box", True),
        (ON_BOX, "matched on same lid egg : cup", False),
        (ON_BOX, "matched on other egg : box cup", False),
        (BRIDGED, "spans lid egg cup", True),
        (ON_BOX, "spans egg box cup", False),
        (BRIDGED, "towers 2 egg cup lid", True),
        (BRIDGED, "towers 3 egg cup lid", False),
        (STILL, "gaps 0.35 egg cup box", False),
        (CROSS, "gaps 0.1 egg box", True),
        (CROSS, "drawn_apart egg cup -0.3", True),
        (CROSS, "drawn_apart egg cup 0.3", False),
        (CROSS, "sorted_along right width cup box", True),
        (STILL, "sorted_along right tall egg cup", True),
        (STILL, "sorted_along left tall egg cup", False),
        (STILL, "sorted_along right size egg cup", True),
        (STILL, "past_middle egg left", True),
        (STILL, "past_middle egg right", False),
        (CROSS, "figure cross egg cup box lid", True),
        (V, "figure v egg cup box", True),
        (V, "figure l egg cup box", False),
        (L, "figure l egg cup box", True),
        (L, "figure cross egg cup box", False),
        (CROSS, "encircled egg cup box lid", True),
        (CROSS, "encircled cup egg box lid", False),
        (STILL, "some 3 still it : egg cup box", True),
        (ON_BOX, "some 3 still it : egg cup box", False),
        (ON_BOX, "but 1 still it : egg cup box", True),
    ],
)
def test_what_a_word_about_several_things_says(scene, line, truth):
    assert holds(line, scene) is truth
