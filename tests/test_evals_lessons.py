"""Lessons: the same whenever they are drawn, by however many; like PyBullet's where they should."""

import numpy as np
import pytest

from agent.errors import ConfigError
from evals.bullet_like import LIGHT, Item, Place, bullet_like, pictured
from evals.lessons import FRAME, SHARD, Drawing, lesson, shard_path, write_shard
from scene.peaks import OTHER
from scene.pictured import SHOWN
from scene.shapes import KINDS
from scene.truth import COLUMNS, EMPTY, GRID, MOST, NAMES, truth
from scene.types import Scene, SceneObject

SEEN = COLUMNS.index("seen")


def test_a_lesson_is_the_same_whenever_it_is_drawn():
    one, again, other = lesson(3, 5), lesson(3, 5), lesson(4, 5)
    assert np.array_equal(one.level, again.level)
    assert one.sight.labels == again.sight.labels
    assert one.level.shape == (GRID.size, GRID.size, 3)
    assert not np.array_equal(one.level, other.level)


def test_a_shard_holds_what_its_lessons_are(tmp_path):
    path = shard_path(tmp_path, 1, 0)
    write_shard(path, 1, range(4))
    made = [lesson(1, number) for number in range(4)]
    with np.load(path) as shard:
        assert np.array_equal(shard["levels"], np.stack([one.level for one in made]))
        assert np.array_equal(shard["rows"][2], truth(made[2].sight.labels))
        framed = [one for one in made if one.frame is not None]
        assert shard["frames"].shape == (len(framed), FRAME[1], FRAME[0], 3)
        for boxes, one in zip(shard["boxes"], framed, strict=True):
            width = one.sight.picture.pixels.shape[1]
            for box, label in zip(boxes, one.sight.labels, strict=False):
                assert box[0] * width - 0.5 == pytest.approx(label.box[0], abs=1e-3)


def test_processes_draw_and_what_is_new_is_told_once(tmp_path):
    with Drawing(tmp_path, 2 * SHARD, seed=2, workers=2) as drawing:
        found = []
        while len(found) < 2:
            found += drawing.fresh()
    assert drawing.fresh() == []
    assert {len(one.levels) for one in found} == {SHARD}
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "seed2_00000.npz", "seed2_00001.npz",
    ]  # fmt: skip


def test_to_be_left_is_no_failure(tmp_path):
    with Drawing(tmp_path, 100 * SHARD, seed=2, workers=2) as drawing:
        assert drawing.fresh() == []
    assert drawing.fresh() == []


def test_where_all_processes_fail_it_is_said(tmp_path):
    (tmp_path / "no folder").write_text("a file")
    with Drawing(tmp_path / "no folder", SHARD, seed=2, workers=1) as drawing:
        drawing._processes[0].wait()
        with pytest.raises(ConfigError, match="ended with an error"):
            drawing.fresh()


def test_rows_tell_things_from_nothing():
    sight = bullet_like("rows 1")
    rows = truth(sight.labels)
    assert rows.shape == (MOST, len(COLUMNS))
    assert (rows[:, SEEN] != EMPTY).sum() == len(sight.labels) > 0
    for row, label in zip(rows, sight.labels, strict=False):
        assert row[:2] == pytest.approx((label.x, label.y), abs=1e-6)
        kind = int(row[COLUMNS.index("kind")])
        assert label.name == ("" if kind < 0 else NAMES[kind])


def test_tables_like_the_simulators_hold_kinds_things_of_none_and_things_on_things():
    sights = [bullet_like(f"many {n}") for n in range(30)]
    named = {label.name for sight in sights for label in sight.labels}
    assert named == {*KINDS, OTHER, ""}
    assert min(label.seen for sight in sights for label in sight.labels) < SHOWN


def test_it_looks_like_the_simulators_picture():
    pytest.importorskip("pybullet")
    from robot_bridge.bullet import BulletRobot

    items = [
        Item("apple", "apple", (0.36, 0.36, 0.36), "red"),
        Item("cup", "cup", (0.4, 0.34, 0.38), "white"),
        Item("bottle", "bottle", (0.26, 0.26, 0.48), "green"),
        Item("padlock", "padlock", (0.21, 0.16, 0.325), "gold"),
        Item("thing", OTHER, (0.4, 0.2, 0.2), "blue"),
    ]
    spots = [
        (-0.6, 0.5, 0.3),
        (0.3, -0.6, 1.0),
        (-0.6, -0.6, 0.0),
        (0.0, 0.1, 0.7),
        (0.6, 0.4, 0.5),
    ]
    places = [Place(item, *spot) for item, spot in zip(items, spots, strict=True)]
    robot = BulletRobot()
    try:
        robot.load(Scene(objects=tuple(
            SceneObject(id=f"{one.item.noun}_{n}", name=one.item.noun, x=one.x, y=one.y, r=one.r,
                        width=one.item.size[0], height=one.item.size[1], tall=one.item.size[2],
                        color=one.item.color)
            for n, one in enumerate(places)
        )))  # fmt: skip
        real = robot.picture(320, 240).astype(float)
        drawn = pictured(places, robot.pose(), 320, 240).picture.pixels.astype(float)
    finally:
        robot.close()
    away = np.abs(real - drawn)
    assert away.mean() < 2.0
    assert np.quantile(away, 0.99) < 45
    assert LIGHT.casts is False
