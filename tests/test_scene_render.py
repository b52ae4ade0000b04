"""Solids, the renderer, and whether its labels are true."""

import math
import random

import numpy as np
import pytest

from scene.peaks import OTHER, folded
from scene.pictured import (
    Terms,
    camera_sight,
    camera_view,
    level_sight,
    level_view,
    standing,
    thirds,
)
from scene.render import Light, draw, looked_at
from scene.shapes import KINDS, of_kind
from scene.solids import MISS, Solid, hit, upright
from scene.strange import SEEN, UNSEEN, strange

OVERHEAD = Light((0.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.2, 0.2, 0.2), 0.0)


def down(x, y):
    """A ray from height 5 straight down: origin and way (3, 1)."""
    return np.array([[x], [y], [5.0]], np.float32), np.array([[0], [0], [-1.0]], np.float32)


@pytest.mark.parametrize(
    ("shape", "x", "reach", "up"),
    [
        ("ball", 0.0, 5 - 3.0, 1.0),
        ("ball", 0.999, 5 - 2 - math.sqrt(1 - 0.999**2), None),
        ("box", 0.9, 5 - 3.0, 1.0),
        ("cone", 0.2, 5 - 3.0, 1.0),
        ("cup", 0.0, 5 - 2 + 0.84, 1.0),
        ("cup", 0.95, 5 - 3.0, 1.0),
    ],
)
def test_a_ray_from_above_meets_a_solid_where_it_should(shape, x, reach, up):
    solid = Solid(shape, (1.0, 1.0, 1.0), (0.0, 0.0, 2.0), upright(0.0))
    t, normal = hit(solid, *down(x, 0.0))
    assert t[0] == pytest.approx(reach, abs=2e-3)
    if up is not None:
        assert normal[2, 0] == pytest.approx(up, abs=1e-3)
    assert hit(solid, *down(1.01, 0.0))[0][0] == MISS


def test_a_cone_is_met_on_its_slope_at_the_right_height():
    solid = Solid("cone", (1.0, 1.0, 1.0), (0.0, 0.0, 1.0), upright(), low=1.0, high=0.5)
    t, normal = hit(solid, *down(0.75, 0.0))
    assert t[0] == pytest.approx(4.0, abs=1e-3)
    assert normal[0, 0] == pytest.approx(4 * normal[2, 0], rel=1e-3)


def test_a_turned_box_is_met_where_it_lies():
    solid = Solid("box", (1.0, 0.1, 0.5), (0.0, 0.0, 0.5), upright(math.pi / 2))
    assert hit(solid, *down(0.0, 0.9))[0][0] < MISS
    assert hit(solid, *down(0.9, 0.0))[0][0] == MISS


def test_views_agree_with_a_pinhole_camera_and_the_pixel_convention():
    view = camera_view((0.3, -0.4, 3.0), (0.1, 0.0), 0.2, 500.0, 320, 240)
    assert view.pixels(np.array([[0.1, 0.0]]))[0] == pytest.approx([159.5, 119.5])
    level = level_view((0.0, 0.0, 3.0), 1.2, 240)
    assert level.pixels(np.array([[-1.2, 1.2]]))[0] == pytest.approx([-0.5, -0.5])
    points = looked_at(view, 320, 240)
    assert view.pixels(points[:, 17, 200][None].astype(float))[0] == pytest.approx(
        [200, 17], abs=1e-2
    )


def test_a_thing_is_drawn_where_a_projected_point_says():
    """A can's top appears where its height leans it to; the label's box surrounds all of it."""
    camera = (0.5, 0.2, 3.0)
    view = camera_view(camera, (0.0, 0.0), 0.0, 500.0, 640, 480)
    design = of_kind(random.Random(1), "can", 1.0, "red")
    x, y, tall = -0.4, 0.3, design.size[2]
    thing = standing(design, x, y, 0.7)
    drawn = draw([thing], view, looked_at(view, 640, 480), np.ones((480, 640, 3), np.float32),
                 OVERHEAD)  # fmt: skip
    spread = camera[2] / (camera[2] - tall)
    top = [camera[i] + ((x, y)[i] - camera[i]) * spread for i in (0, 1)]
    u, v = view.pixels(np.array([top]))[0]
    assert drawn.owners[round(v), round(u)] == 0
    rows, columns = np.nonzero(drawn.owners == 0)
    assert drawn.boxes[0] == pytest.approx(
        [columns.min() - 0.5, rows.min() - 0.5, columns.max() + 0.5, rows.max() + 0.5]
    )
    assert drawn.shares[0] == 1.0


def test_what_stands_before_another_hides_it_and_shadows_fall_away_from_the_sun():
    view = level_view((0.0, -2.0, 2.0), 1.2, 120)
    bottle = standing(of_kind(random.Random(1), "bottle", 1.5), 0.0, 0.0, 0.0)
    block = standing(of_kind(random.Random(2), "block", 0.8), 0.0, 0.28, 0.0)
    light = OVERHEAD._replace(sun=(-0.6, 0.0, 0.8))
    ground = np.ones((120, 120, 3), np.float32)
    drawn = draw([bottle, block], view, looked_at(view, 120, 120), ground, light)
    assert drawn.shares[0] == 1.0
    assert drawn.shares[1] < 0.7
    empty = drawn.owners == -1
    row = round(view.pixels(np.array([[0.0, 0.0]]))[0][1])
    left, right = drawn.pixels[row, :60].mean(1), drawn.pixels[row, 60:].mean(1)
    assert left[empty[row, :60]].min() > 0.9
    assert right[empty[row, 60:]].min() < 0.4


@pytest.mark.parametrize("name", sorted(KINDS))
def test_a_kind_fills_its_size(name):
    """From straight above and far away, a thing's outline is as large as its label says."""
    design = of_kind(random.Random(3), name, 1.0)
    view = level_view((0.0, 0.0, 30.0), 0.6, 240)
    drawn = draw([standing(design, 0.0, 0.0, 0.0)], view, looked_at(view, 240, 240),
                 np.ones((240, 240, 3), np.float32), OVERHEAD)  # fmt: skip
    left, top, right, bottom = drawn.boxes[0] * 1.2 / 240
    assert right - left == pytest.approx(design.size[0], rel=0.06, abs=0.012)
    assert bottom - top == pytest.approx(design.size[1], rel=0.06, abs=0.012)


def test_things_of_no_kind_are_other_and_tests_have_families_of_their_own():
    assert not set(SEEN) & set(UNSEEN)
    design = strange(random.Random(4), tuple(UNSEEN))
    assert design.name == OTHER
    assert design.family in UNSEEN
    assert OTHER not in KINDS


@pytest.mark.parametrize("r", np.linspace(-3.1, 3.1, 13).tolist())
def test_a_folded_rectangle_is_the_same_one(r):
    width, height, turn = folded(0.5, 0.2, r)
    assert -math.pi / 4 < turn <= math.pi / 4
    assert {width, height} == {0.5, 0.2}
    long_side = turn if width == 0.5 else turn + math.pi / 2
    assert math.sin(long_side - r) == pytest.approx(0.0, abs=1e-9)


def test_a_table_is_the_same_for_the_same_seed_only():
    one, same, other = (level_sight(seed, Terms(), 1.2, 80) for seed in (5, 5, 6))
    assert np.array_equal(one.picture.pixels, same.picture.pixels)
    assert one.labels == same.labels
    assert not np.array_equal(one.picture.pixels, other.picture.pixels)


def test_a_camera_s_picture_shows_the_whole_table():
    sight = camera_sight(7, Terms(height=(3.0, 4.0), tilt=(10.0, 10.0)), 160, 120)
    u, v = sight.view.pixels(np.array([(a, b) for a in (-1, 1) for b in (-1, 1)])).T
    assert ((u > 0) & (u < 159) & (v > 0) & (v < 119)).all()
    assert sight.picture.pixels.shape == (120, 160, 3)


def test_shrinking_by_thirds_keeps_the_mean():
    plane = np.random.default_rng(0).random((9, 6, 3)).astype(np.float32)
    shrunk = thirds(plane)
    assert shrunk.shape == (6, 4, 3)
    assert shrunk.mean() == pytest.approx(plane.mean(), rel=1e-5)
    assert shrunk[0, 0] == pytest.approx(
        (4 * plane[0, 0] + 2 * plane[0, 1] + 2 * plane[1, 0] + plane[1, 1]) / 9, rel=1e-5
    )
