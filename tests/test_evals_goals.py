"""Goals as calls: what each says of the scene before, the scene after and the path."""

from __future__ import annotations

import math

import msgspec
import pytest

from agent.messages import Command
from evals.goals import Goal, holds
from evals.world import World
from scene.types import Scene, SceneObject


def thing(name: str, x: float, y: float, **other) -> SceneObject:
    sizes = {"width": 0.2, "height": 0.2, "tall": 0.1}
    return SceneObject(id=name, name=name, x=x, y=y, **{**sizes, **other})


def world(before, after=None, path=(), statuses=("done",)) -> World:
    scenes = (Scene(objects=tuple(things)) for things in (before, after or before))
    return World(*scenes, tuple(path), statuses)


def true(world: World, p: str, **call) -> bool:
    return holds(msgspec.convert({"p": p, **call}, Goal), world)


ROW = world([thing("cup", -0.6, 0), thing("box", 0, 0), thing("jar", 0.5, 0.06)])
STACK = world(
    [thing("tray", 0.8, 0.8), thing("cup", 0.8, 0.8, z=0.1, on="tray"),
     thing("lid", 0.8, 0.8, z=0.2, on="cup"), thing("jar", 1.3, 0, on="floor")]
)  # fmt: skip


@pytest.mark.parametrize(
    ("call", "truth"),
    [
        ({"p": "left_of", "a": "cup", "b": "box"}, True),
        ({"p": "right_of", "a": "cup", "b": "box"}, False),
        ({"p": "left_of", "a": "cup", "b": "box", "min_gap": 0.39, "max_gap": 0.41}, True),
        ({"p": "left_of", "a": "cup", "b": "box", "max_gap": 0.3}, False),
        ({"p": "behind", "a": "jar", "b": "box"}, False),
        ({"p": "behind", "a": "jar", "b": "box", "cone": None}, True),
        ({"p": "behind", "a": "jar", "b": "box", "cone": 3.0}, False),
        ({"p": "near", "a": "jar", "b": "box", "max": 0.3}, True),
        ({"p": "near", "a": "cup", "b": "box", "max": 0.3}, False),
        ({"p": "far", "a": "cup", "b": "box", "min": 0.3}, True),
        ({"p": "at", "id": "jar", "x": 0.5, "y": None, "tol": 0.01}, True),
        ({"p": "at", "id": "jar", "x": 0.5, "y": 0.3, "tol": 0.1}, False),
        ({"p": "in_region", "id": "cup", "region": "left_edge"}, True),
        ({"p": "in_region", "id": "cup", "region": "left_edge", "margin": 0.2}, False),
        ({"p": "in_region", "id": "cup", "region": "top_left"}, False),
        ({"p": "in_region", "id": "box", "region": "centre"}, True),
        ({"p": "aligned", "ids": ["cup", "box", "jar"], "axis": "row"}, True),
        ({"p": "aligned", "ids": ["cup", "box", "jar"], "axis": "row", "tol": 0.05}, False),
        ({"p": "aligned", "ids": ["cup", "box", "jar"], "axis": "column"}, False),
        ({"p": "aligned", "ids": ["cup", "box", "jar"], "tol": 0.03}, True),
        ({"p": "triangle", "ids": ["cup", "box", "jar"], "min_area": 0.017}, True),
        ({"p": "triangle", "ids": ["cup", "box", "jar"], "min_area": 0.019}, False),
        ({"p": "grouped", "groups": [["box", "jar"], ["cup"]]}, True),
        ({"p": "grouped", "groups": [["box", "cup"], ["jar"]]}, False),
        ({"p": "no_overlap"}, True),
        ({"p": "nothing_moved"}, True),
    ],
)
def test_where_things_are(call, truth):
    assert true(ROW, **call) is truth


def test_a_slope_is_a_line_too():
    slope = world([thing(name, x, x / 2) for name, x in (("a", -0.8), ("b", 0.1), ("c", 0.7))])
    assert true(slope, "aligned", ids=["a", "b", "c"], tol=0.001)
    assert not true(slope, "aligned", ids=["a", "b", "c"], axis="row")


def test_what_is_carried_is_where_its_carrier_is_and_what_fell_is_nowhere():
    assert true(STACK, "on", a="lid", b="tray")
    assert not true(STACK, "on", a="lid", b="tray", direct=True)
    assert true(STACK, "on", a="lid", b=["jar", "cup"], direct=True)
    assert true(STACK, "in_region", id="lid", region="top_right")
    assert not true(STACK, "on_table", id="lid")
    assert not true(STACK, "right_of", a="jar", b="tray", cone=None)
    assert not true(STACK, "near", a="cup", b="tray", max=1.0)


def test_calls_of_calls():
    left, right = ({"p": f"{side}_of", "a": "cup", "b": "box"} for side in ("left", "right"))
    assert true(ROW, "any_of", of=[right, left])
    assert not true(ROW, "all_of", of=[right, left])
    assert true(ROW, "count_of", of=[right, left], n=1)
    assert true(ROW, "count_of", of=[right, left], max=1)
    assert not true(ROW, "count_of", of=[right, left], min=2)


def test_a_call_binds_only_after_the_statuses_it_names():
    call = {"p": "moved", "id": "cup", "when": [0, ["done"]]}
    assert not true(ROW, **call)
    assert true(world(ROW.before.objects, statuses=("asked",)), **call)


def test_what_moved_and_what_did_not():
    box = thing("box", 0.5, 0)
    pushed = world([thing("cup", 0, 0), box], [thing("cup", 0.3, 0.05), box])
    for call in (
        {"p": "moved", "id": "cup"},
        {"p": "others_still", "except": ["cup"]},
        {"p": "still", "ids": ["cup"], "tol": 0.4},
        {"p": "moved_dir", "id": "cup", "dir": "right", "max": 0.4},
        {"p": "moved_dist", "id": "cup", "dist": 0.3, "tol": 0.05},
        {"p": "moved_toward", "id": "cup", "to": {"x": 0.5, "y": 0}, "angle": 20},
        {"p": "closer", "a": "cup", "b": "box", "min": 0.2},
    ):
        assert true(pushed, **call), call
    for call in (
        {"p": "moved", "id": "box"},
        {"p": "nothing_moved"},
        {"p": "moved_dir", "id": "cup", "dir": "back"},
        {"p": "moved_dir", "id": "cup", "dir": "right", "max": 0.2},
        {"p": "moved_toward", "id": "cup", "to": {"x": 0, "y": 0.5}},
        {"p": "farther", "a": "cup", "b": "box"},
    ):
        assert not true(pushed, **call), call


def test_what_turns_on_the_spot_is_not_still():
    turned = world([thing("cup", 0, 0)], [thing("cup", 0, 0, r=math.radians(20))])
    assert not true(turned, "still", ids=["cup"])


def test_things_share_ground_only_if_they_did():
    cup, close, off = thing("cup", 0, 0), thing("box", 0.1, 0), thing("box", 0.5, 0)
    assert not true(world([cup, off], [cup, close]), "no_overlap")
    assert true(world([cup, close]), "no_overlap")
    assert not true(world([cup, close]), "left_of", a="cup", b="box")
    assert not true(world([cup, close]), "near", a="cup", b="box")


def test_the_tool_stopped_at_a_thing():
    stop = Command("move", 0.15, 0, 0.2, 0.0, False)
    seen = world([thing("cup", 0, 0), thing("box", 0.5, 0)], path=[stop])
    assert true(seen, "visited", points=[{"id": "cup"}], where="waypoints")
    assert not true(seen, "visited", points=[{"id": "box"}], where="waypoints", tol=0.2)


@pytest.mark.parametrize(
    "call",
    [
        {"p": "inside", "a": "cup", "b": "box"},
        {"p": "near", "a": "cup"},
        {"p": "near", "a": "cup", "b": "box", "least": 0.1},
        {"p": "in_region", "id": "cup", "region": "middle"},
        {"p": "any_of", "of": [{"p": "inside"}]},
    ],
)
def test_a_call_that_nobody_judges_cannot_be_read(call):
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert(call, Goal)
