"""What rests is known by its borders: in noise, in other light, hidden in part."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("cv2")

from scene.closer import Closer
from scene.fit import outlines
from scene.pictured import camera_view, standing
from scene.render import Light, draw, looked_at
from scene.rest import FEWEST, borders, gone
from scene.shapes import of_kind
from scene.sight import Detection, Picture
from scene.surroundings import developed

EYE = (0.15, -0.2, 3.5)
VIEW = camera_view(EYE, (0.0, 0.0), 0.05, 700.0, 640, 480)
POINTS = looked_at(VIEW, 640, 480)
LIGHT = Light((0.5, 0.3, 0.81), (0.7, 0.7, 0.7), (0.4, 0.4, 0.4), 2.0)
MM = 0.005
PIXEL = 3.5 / 700
NOISE = 3.0


def pictured(*things, seed=4, light=1.0):
    """A picture of (kind, colour, x, y, yaw) by a camera whose noise is new in each, and what a
    detector that never errs says of them."""
    designs = [of_kind(random.Random(7), kind, 1.0, color) for kind, color, *_ in things]
    stood = [standing(one, *at) for one, (_, _, *at) in zip(designs, things, strict=True)]
    bare = np.broadcast_to(np.array((0.2, 0.21, 0.22), np.float32), (480, 640, 3)).copy()
    drawn = draw(stood, VIEW, POINTS, bare, LIGHT)
    sharp = developed(random.Random(0), drawn.pixels * light, 0.0)
    rough = sharp + np.random.default_rng(seed).normal(0, NOISE, sharp.shape)
    pixels = rough.clip(0, 255).astype(np.uint8)
    found = tuple(
        Detection(design.name, 0.9, x, y, 0.01, *design.size, yaw, color, np.ones(4, np.float32))
        for design, (_, color, x, y, yaw) in zip(designs, things, strict=True)
    )
    return pixels, found


def of_first(pixels, found):
    own, *others = outlines(found, EYE)
    edges = borders(pixels, VIEW, own, others)
    assert edges is not None and len(edges.value) >= FEWEST
    return edges


@pytest.mark.parametrize("kind", ["block", "can", "bottle", "banana", "cup", "magnet"])
def test_what_rests_has_not_gone_in_noise_and_in_other_light(kind):
    edges = of_first(*pictured((kind, "red", 0.4, 0.35, 0.3)))
    for seed, light in ((5, 1.0), (6, 0.85), (7, 1.15)):
        again, _ = pictured((kind, "red", 0.4, 0.35, 0.3), seed=seed, light=light)
        way = gone(edges, again)
        assert way is not None
        assert math.hypot(*way) * PIXEL < 0.3 * MM


@pytest.mark.parametrize("way", [(0.003, 0.0), (0.0, -0.004), (-0.003, 0.003)])
def test_a_way_of_a_part_of_a_pixel_is_measured(way):
    edges = of_first(*pictured(("block", "red", 0.4, 0.35, 0.3)))
    moved, _ = pictured(("block", "red", 0.4 + way[0], 0.35 + way[1], 0.3), seed=5)
    right, down = gone(edges, moved)
    assert (right * PIXEL, -down * PIXEL) == pytest.approx(way, abs=0.3 * MM)


@pytest.mark.parametrize("way", [(0.03, 0.0), (0.0, 0.05), (-0.3, 0.2)])
@pytest.mark.parametrize("kind", ["block", "bottle", "magnet"])
def test_what_went_farther_is_not_seen_there_any_more(kind, way):
    edges = of_first(*pictured((kind, "red", 0.4, 0.35, 0.0)))
    moved, _ = pictured((kind, "red", 0.4 + way[0], 0.35 + way[1], 0.0), seed=5)
    found = gone(edges, moved)
    assert found is None or math.hypot(*found) * PIXEL > 4 * MM


def test_what_slid_along_its_long_sides_does_not_rest():
    """Its long sides look the same; its ends, that alone tell of this way, do not."""
    edges = of_first(*pictured(("magnet", "red", 0.4, 0.35, 0.0)))
    slid, _ = pictured(("magnet", "red", 0.44, 0.35, 0.0), seed=5)
    found = gone(edges, slid)
    assert found is None or math.hypot(*found) * PIXEL > 4 * MM


def test_what_is_turned_does_not_rest():
    edges = of_first(*pictured(("block", "red", 0.4, 0.35, 0.0)))
    turned, _ = pictured(("block", "red", 0.4, 0.35, 0.4), seed=5)
    assert gone(edges, turned) is None


def test_what_was_taken_away_does_not_rest():
    edges = of_first(*pictured(("can", "blue", 0.4, 0.35, 0.0)))
    bare, _ = pictured(("block", "red", -0.4, -0.35, 0.0), seed=5)
    assert gone(edges, bare) is None


def test_what_is_hidden_in_part_is_known_and_what_is_hidden_mostly_is_not():
    pixels, found = pictured(("can", "blue", 0.4, 0.35, 0.0))
    edges = of_first(pixels, found)
    again, _ = pictured(("can", "blue", 0.4, 0.35, 0.0), seed=5)
    u, v = VIEW.pixels(np.array([(0.4, 0.35)]))[0]
    part, most = again.copy(), again.copy()
    part[int(v) + 14 :] = 200
    most[:, int(u) :] = 200
    assert gone(edges, part) is not None
    assert gone(edges, most) is None


def test_the_borders_of_a_neighbour_are_not_its_own():
    alone, found = pictured(("block", "red", 0.4, 0.35, 0.0))
    beside, both = pictured(("block", "red", 0.4, 0.35, 0.0), ("block", "blue", 0.61, 0.35, 0.0))
    edges = of_first(beside, both)
    assert gone(edges, alone) is not None
    assert gone(of_first(alone, found), beside) is not None


def test_a_thing_of_the_tables_colour_has_no_borders():
    _, found = pictured(("can", "blue", 0.4, 0.35, 0.0))
    blank = np.full((480, 640, 3), 120, np.uint8)
    assert borders(blank, VIEW, outlines(found, EYE)[0], []) is None


# --- the detector that knows again what rests -------------------------------------------------


class Says:
    """A detector that says what it is told to."""

    def __init__(self, found):
        self.found = found

    def detect(self, picture, view, expected=()):
        return self.found


def watched(*things):
    """A closer look that has seen things rest, its detector, and what was told last."""
    pixels, found = pictured(*things)
    says = Says(found)
    eye = Closer(says)
    for seed in range(4 + len(things)):
        pixels, _ = pictured(*things, seed=seed)
        told = eye.detect(Picture(pixels, float(seed)), VIEW)
    return eye, says, told


def test_what_rests_keeps_its_number_and_what_moved_gets_another():
    can, block = ("can", "blue", 0.4, 0.35, 0.0), ("block", "red", -0.4, 0.0, 0.2)
    eye, says, told = watched(can, block)
    assert 0 < told[0].stand != told[1].stand > 0
    pixels, says.found = pictured(can, ("block", "red", -0.3, 0.0, 0.2), seed=9)
    for _ in range(3):
        now = eye.detect(Picture(pixels, 9.0), VIEW)
    assert now[0].stand == told[0].stand
    assert now[1].stand not in (0, told[0].stand, told[1].stand)


def test_what_rests_is_where_it_was_whatever_the_detector_makes_of_it():
    cup = ("cup", "red", 0.4, 0.35, 0.3)
    eye, says, (before,) = watched(cup)
    pixels, (found,) = pictured(cup, seed=9)
    says.found = (replace(found, x=found.x + 0.04, width=1.2 * found.width, r=0.9),)
    (now,) = eye.detect(Picture(pixels, 9.0), VIEW)
    assert now.stand == before.stand
    assert math.dist((now.x, now.y), (before.x, before.y)) < MM
    assert (now.width, now.r) == (before.width, before.r)


def test_what_something_comes_before_is_not_looked_at_anew():
    block = ("block", "red", 0.4, 0.35, 0.0)
    eye, _, (before,) = watched(block)
    for seed in range(9, 21):
        pixels, _ = pictured(block, seed=seed)
        u, v = VIEW.pixels(np.array([(0.4, 0.35)]))[0]
        pixels[int(v) + 12 :, : int(u)] = 230
        (now,) = eye.detect(Picture(pixels, float(seed)), VIEW)
        assert math.dist((now.x, now.y), (before.x, before.y)) < 2 * MM
