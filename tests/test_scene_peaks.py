"""Rectifying and decoding: one convention from the picture's pixels to the table."""

import math

import numpy as np
import pytest

from scene.peaks import folded, peaks, turn_of
from scene.pictured import camera_view, level_view
from scene.rectify import Grid, planes, rectified
from scene.sight import View

GRID = Grid(size=96, mm=5.0)
CAMERA = (0.4, -0.3, 3.0)
UNIT = 4 * GRID.pixel


def said(heat, right=1.0):
    """Maps with this heat, and places of which so much is right."""
    place = np.zeros((4, 12, 12), np.float32)
    place[3] = right
    return {"heat": heat, "place": place, "shape": np.zeros((7, 12, 12), np.float32)}


def test_peaks_are_told_apart_and_ties_are_one():
    heat = np.zeros((3, 12, 12), np.float32)
    heat[0, 3, 3], heat[0, 3, 4] = 0.9, 0.9
    heat[1, 3, 6], heat[1, 8, 8] = 0.8, 0.2
    found = peaks(said(heat), UNIT, 2)
    assert [(one.u, one.v, one.kind) for one in found] == [(3, 3, 0), (6, 3, 1)]
    assert found[0].score == pytest.approx(0.9)


def test_a_thing_that_no_kind_claims_is_other():
    heat = np.zeros((3, 12, 12), np.float32)
    heat[:, 5, 5] = 0.35, 0.33, 0.22
    (one,) = peaks(said(heat), UNIT, 2)
    assert one.kind == 2
    assert one.score == pytest.approx(0.55)


def test_what_is_likely_told_wrong_is_less_sure_but_is_there():
    heat = np.zeros((3, 12, 12), np.float32)
    heat[0, 5, 5] = 0.8
    (one,) = peaks(said(heat, 0.25), UNIT, 2)
    assert one.score == pytest.approx(0.2)


def test_round_things_are_not_turned_and_long_ones_by_their_long_side():
    assert turn_of(0.05, 0.02, 0.1, -0.1) == 0.0
    for turn in np.linspace(-1.5, 1.5, 9).tolist():
        vectors = (math.cos(2 * turn), math.sin(2 * turn), math.cos(4 * turn), math.sin(4 * turn))
        assert math.tan(turn_of(*vectors)) == pytest.approx(math.tan(turn))
        rough = (math.cos(2 * turn + 0.6), math.sin(2 * turn + 0.6), *vectors[2:])
        assert math.tan(turn_of(*rough)) == pytest.approx(math.tan(turn))
        unclear = (*vectors[:2], 0.1 * vectors[2], 0.1 * vectors[3])
        assert math.tan(turn_of(*unclear)) == pytest.approx(math.tan(turn))


def test_rectifying_a_level_picture_of_that_scale_changes_nothing():
    level = np.random.default_rng(0).integers(0, 255, (96, 96, 3)).astype(np.uint8)
    half = GRID.size * GRID.pixel / 2
    assert np.array_equal(rectified(level, level_view(CAMERA, half, 96), GRID), level)


def test_a_point_of_the_table_is_found_where_the_grid_says():
    view = camera_view(CAMERA, (0.0, 0.0), 0.3, 260.0, 320, 240)
    picture = np.zeros((240, 320, 3), np.uint8)
    u, v = view.pixels(np.array([[0.35, -0.55]]))[0]
    picture[round(v) - 2 : round(v) + 3, round(u) - 2 : round(u) + 3] = 200
    rows, columns = np.nonzero(rectified(picture, view, GRID)[..., 0] > 100)
    at = GRID.at(np.array([columns.mean()]), np.array([rows.mean()]))[0]
    assert at == pytest.approx((0.35, -0.55), abs=GRID.pixel)


def test_what_the_picture_does_not_show_is_black():
    far = View(np.array([[40.0, 0, 200.0], [0, -40.0, 50.0], [0, 0, 1.0]]), CAMERA)
    level = rectified(np.full((100, 100, 3), 255, np.uint8), far, GRID)
    assert (level == 0).all()


def test_half_the_light_looks_the_same():
    bright = np.random.default_rng(0).integers(20, 240, (96, 96, 3)).astype(np.uint8)
    one, other = (planes(level, CAMERA, GRID) for level in (bright, bright // 2))
    assert np.abs(one - other).max() < 0.02


def test_the_same_table_of_another_size_in_metres_covers_more_units():
    small = Grid(size=96, mm=5.0, table_m=0.2)
    assert small.pixel == pytest.approx(2 * GRID.pixel)
    assert small.points()[0] == pytest.approx([-47.5 * small.pixel, 47.5 * small.pixel])
    assert folded(1.0, 2.0, math.pi / 2) == pytest.approx((2.0, 1.0, 0.0))
