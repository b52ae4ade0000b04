"""A closer look at things in drawn pictures whose truth is known."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("cv2")

from scene.closer import Closer
from scene.contour import Contour, Room, contours
from scene.fit import closer
from scene.outline import BLOCK, SHAPES, WAYS, Body, sloped, supports
from scene.peaks import OTHER
from scene.pictured import camera_view, standing
from scene.render import Light, draw, looked_at
from scene.shapes import KINDS, of_kind
from scene.sight import Detection, Picture
from scene.surroundings import developed
from scene.tint import tint

EYE = (0.15, -0.2, 3.5)
VIEW = camera_view(EYE, (0.0, 0.0), 0.05, 700.0, 640, 480)
POINTS = looked_at(VIEW, 640, 480)
LIGHT = Light((0.5, 0.3, 0.81), (0.7, 0.7, 0.7), (0.4, 0.4, 0.4), 2.0)
GRAY = (0.20, 0.21, 0.22)
MM = 0.005


def pictured(*things, ground=GRAY, noise=1.0, seed=4):
    """A picture of (kind, colour, x, y, yaw) on a plain table, and the designs."""
    chance = random.Random(seed)
    designs = [of_kind(chance, kind, 1.0, color) for kind, color, *_ in things]
    stood = [
        standing(design, x, y, yaw)
        for design, (_, _, x, y, yaw) in zip(designs, things, strict=True)
    ]
    bare = np.broadcast_to(np.array(ground, np.float32), (480, 640, 3)).copy()
    drawn = draw(stood, VIEW, POINTS, bare, LIGHT)
    return Picture(developed(chance, drawn.pixels, noise), 0.0), designs


def said(design, x, y, r, off=(0.0, 0.0), sd=0.015, name=None, tall=1.0):
    """What a detector says that errs by ``off`` in its place."""
    width, height, high = design.size
    return Detection(
        name or design.name, 0.9, x + off[0], y + off[1], sd, width, height, tall * high, r,
        design.color, np.ones(4, np.float32) / 2,
    )  # fmt: skip


def away(one, x, y):
    return math.dist((one.x, one.y), (x, y))


@pytest.mark.parametrize(
    ("kind", "color", "r", "most"),
    [("block", "red", 0.4, 1.0), ("can", "blue", 0.0, 1.5), ("apple", "green", 0.0, 1.5),
     ("bottle", "brown", 0.0, 2.5), ("matchbox", "yellow", -0.3, 1.0),
     ("banana", "yellow", 0.5, 3.5), ("lemon", "yellow", 0.2, 1.5)],
)  # fmt: skip
def test_a_place_that_the_network_has_wrong_is_put_right(kind, color, r, most):
    picture, (design,) = pictured((kind, color, 0.4, 0.35, r))
    wrong = said(design, 0.4, 0.35, r, off=(0.018, -0.016))
    right = closer(picture, VIEW, [wrong], 0)
    assert away(wrong, 0.4, 0.35) > 4.5 * MM
    assert away(right, 0.4, 0.35) < most * MM
    assert away(right, 0.4, 0.35) < 3 * right.sd
    assert right.sd < wrong.sd
    assert (right.name, right.score, right.color) == (wrong.name, wrong.score, wrong.color)


def test_the_outline_tells_the_height_of_a_thing_of_no_kind():
    picture, (design,) = pictured(("block", "red", 0.6, 0.5, 0.3))
    low = said(design, 0.6, 0.5, 0.3, name=OTHER, tall=0.5, sd=0.02, off=(0.02, 0.015))
    told = closer(picture, VIEW, [low], 0)
    assert abs(told.tall - design.size[2]) < 0.2 * design.size[2]
    assert away(told, 0.6, 0.5) < 1.5 * MM


@pytest.mark.parametrize("tall", [0.6, 1.0])
def test_a_persons_word_tells_what_shape_a_thing_has(tall):
    """From above, a tin's outline is nearly that of a ball, or of a dish, that stands elsewhere."""
    at = (-0.6, 0.4)
    picture, (can,) = pictured(("can", "red", *at, 0.0))
    nameless = said(can, *at, 0.0, name=OTHER, tall=tall)
    told = {noun: closer(picture, VIEW, [replace(nameless, noun=noun)], 0) for noun in ("", "tin")}
    assert away(told["tin"], *at) < 1.0 * MM < away(told[""], *at)
    assert told["tin"].sd < told[""].sd / 2
    assert {one.name for one in told.values()} == {OTHER}


def test_a_cup_is_turned_to_where_its_handle_is():
    for yaw in (0.3, 0.3 + math.pi):
        picture, (design,) = pictured(("cup", "red", -0.2, 0.3, yaw), seed=3)
        assert design.size[0] > 1.2 * design.size[1]
        looked = closer(picture, VIEW, [said(design, -0.2, 0.3, 0.3, off=(0.02, 0.01))], 0)
        assert away(looked, -0.2, 0.3) < 2 * MM


@pytest.mark.parametrize(
    ("kind", "color", "called", "told"),
    [("can", "green", "blue", "green"), ("can", "blue", "green", "blue"),
     ("block", "red", "blue", "red"), ("apple", "yellow", "green", "yellow"),
     ("bottle", "brown", "blue", "brown"), ("block", "pink", "red", "red"),
     ("block", "gold", "yellow", "yellow"),
     ("magnet", "red", "blue", "blue"), ("block", "red", None, None)],
)  # fmt: skip
def test_a_colour_word_is_put_right_by_what_is_inside_of_the_outline(kind, color, called, told):
    picture, (design,) = pictured((kind, color, 0.4, 0.35, 0.2))
    wrong = replace(said(design, 0.4, 0.35, 0.2), color=called)
    looked = closer(picture, VIEW, [wrong], 0)
    assert looked is not wrong
    assert looked.color == told


def test_black_is_told_from_blue_and_what_is_in_pieces_is_left():
    body = Body(0.0, 0.0, 0.3, 0.3, 0.0, 0.3)
    points, dark, blue = np.zeros((60, 2)), (18, 18, 20), (35, 71, 191)

    def told(*colors):
        seen = Contour(np.zeros(48), MM, points, np.array(colors, np.uint8).repeat(20, 0))
        return tint(seen, "blue", "other", body, EYE)

    assert told(dark, dark, dark) == "black"
    assert told(dark, dark, blue) == "blue"
    assert told(blue, blue, blue) == "blue"


def test_no_colour_that_is_right_is_lost_to_light():
    for kind, of in KINDS.items():
        for color in of.colors:
            picture, (design,) = pictured((kind, color, -0.3, 0.4, 0.5))
            looked = closer(picture, VIEW, [said(design, -0.3, 0.4, 0.5)], 0)
            assert looked.color == color, (kind, color)


def test_what_has_the_tables_colour_is_left_to_the_network():
    picture, (design,) = pictured(("can", "silver", 0.3, 0.2, 0.0), ground=(0.5, 0.5, 0.5))
    blank = Picture(np.full_like(picture.pixels, 120), 0.0)
    one = said(design, 0.3, 0.2, 0.0)
    assert closer(blank, VIEW, [one], 0) is one


def test_what_the_picture_or_another_thing_cuts_off_is_left_to_the_network():
    picture, (red, blue) = pictured(
        ("block", "red", 0.0, 0.0, 0.0), ("block", "red", 0.21, 0.0, 0.0)
    )
    pair = [said(red, 0.0, 0.0, 0.0), said(blue, 0.21, 0.0, 0.0)]
    for n in (0, 1):
        seen = closer(picture, VIEW, pair, n)
        assert seen is pair[n] or away(seen, pair[n].x, 0.0) < MM
    cut = Picture(picture.pixels[:, :320], 0.0)
    assert closer(cut, VIEW, pair[:1], 0) is pair[0]


@pytest.mark.parametrize("off", [(0.0, 0.0), (-0.02, 0.015)])
def test_a_thing_that_touches_another_is_placed_by_the_ends_that_are_seen(off):
    """Of different colours, side by side; where one ends is known but roughly."""
    at = (("block", "red", 0.0, 0.0, 0.0), ("matchbox", "blue", 0.232, 0.0, 0.0))
    picture, (red, blue) = pictured(*at)
    pair = [said(red, 0.0, 0.0, 0.0, off=off), said(blue, 0.235, 0.004, 0.0)]
    seen = closer(picture, VIEW, pair, 0)
    assert seen is not pair[0]
    assert away(seen, 0.0, 0.0) < 1.2 * MM
    assert seen.sd > closer(pictured(at[0])[0], VIEW, pair[:1], 0).sd


def test_a_shadow_is_no_part_of_a_thing():
    hard = [seen.reach for seen in _contours(LIGHT)]
    none = [seen.reach for seen in _contours(LIGHT._replace(casts=False))]
    assert hard
    assert none
    assert min(np.abs(one - none[0]).max() for one in hard) < 3 * MM


def test_the_side_of_a_thing_that_is_in_its_own_shade_is_of_the_thing():
    """A white disc that is darker at one end, its side dark grey, on a table of sand."""
    x, y = POINTS
    top = np.hypot(x - 0.5, y - 0.5) < 0.2
    side = np.hypot(x - 0.45, y - 0.45) < 0.2
    pixels = np.full((480, 640, 3), (191.0, 181.0, 167.0))
    pixels[side] = (148, 148, 145)
    pixels[top] = (172 + 90 * x).clip(190, 235)[top][:, None]
    noisy = pixels + np.random.default_rng(3).normal(0, 3, pixels.shape)
    picture = np.rint(noisy).clip(0, 255).astype(np.uint8)
    body = Body(0.475, 0.475, 0.4, 0.4, 0.0, 0.01)
    expected = supports(BLOCK, body.vector()[None], EYE)[0]
    way = int(np.argmin(WAYS.sum(0)))
    ends = [
        (seen.reach[way] - (0.2 - 0.45 * math.sqrt(2))) / seen.pixel
        for seen in contours(picture, VIEW, expected, [], Room(0.09, 0.2, 0.05))
    ]
    assert min(map(abs, ends)) < 1.0


def _contours(light):
    chance = random.Random(1)
    design = of_kind(chance, "apple", 1.0, "red")
    bare = np.full((480, 640, 3), 0.3, np.float32)
    drawn = draw([standing(design, 0.0, 0.0, 0.0)], VIEW, POINTS, bare, light)
    picture = developed(chance, drawn.pixels, 0.0)
    body = Body(0.0, 0.0, *design.size[:2], 0.0, design.size[2])
    expected = supports(BLOCK, body.vector()[None], EYE)[0]
    return list(contours(picture, VIEW, expected, [], Room(0.09, 0.2, 0.05)))


def test_outlines_are_those_of_the_drawn_things():
    for kind in KINDS:
        design = of_kind(random.Random(2), kind, 1.0)
        thing = standing(design, -0.4, 0.5, 0.7)
        drawn = draw([thing], VIEW, POINTS, np.zeros((480, 640, 3), np.float32), LIGHT)
        rows, columns = np.nonzero(drawn.owners == 0)
        seen = VIEW.points(np.column_stack([columns, rows]).astype(float)) @ WAYS
        body = Body(-0.4, 0.5, *design.size[:2], 0.7, design.size[2])
        told = [supports(shape, body.vector()[None], EYE)[0] for shape in SHAPES[kind]]
        off = min(float(np.abs(one - seen.max(0)).mean()) for one in told)
        assert off < 1.2 * MM, kind


@pytest.mark.parametrize("kind", [*KINDS, OTHER])
def test_slopes_of_an_outline_are_its_differences(kind):
    vector = Body(0.5, -0.4, 0.35, 0.2, 0.6, 0.4).vector()
    small = 1e-6 * np.eye(6)
    for shape in SHAPES[kind]:
        reach, slope = sloped(shape, vector, EYE)
        assert reach == pytest.approx(supports(shape, vector[None], EYE)[0])
        more, less = supports(shape, vector + small, EYE), supports(shape, vector - small, EYE)
        off = np.abs((more - less) / 2e-6 - slope)
        assert (off < 1e-6).mean() > 0.97  # but where two slices reach as far


def test_a_body_comes_back_from_its_vector():
    body = Body(0.1, -0.2, 0.3, 0.4, 0.5, 0.6)
    assert Body.of(body.vector()) == pytest.approx(body)


class _Says:
    """A detector that says what it is told to."""

    def __init__(self, *found):
        self.found = found

    def detect(self, picture, view, expected=()):
        return self.found


BLANK = Picture(np.zeros((4, 4, 3), np.uint8), 0.0)


def watched(monkeypatch, *names):
    """Things side by side that a detector says, and the names of those that were looked at: each
    is then 0.02 further, sure, and of a tallness of 9."""
    looks = []

    def look(picture, view, found, which):
        looks.append(found[which].name)
        return replace(found[which], x=found[which].x + 0.02, sd=0.001, tall=9.0)

    monkeypatch.setattr("scene.closer.closer", look)
    here = [
        Detection(name, 0.9, 0.3 * n, 0.0, 0.01, 0.2, 0.2, 0.2, 0.0, None, np.ones(1, np.float32))
        for n, name in enumerate(names)
    ]
    return _Says(*here), looks


def test_new_things_are_looked_at_one_a_picture_and_are_as_the_detector_says_until_then(
    monkeypatch,
):
    says, looks = watched(monkeypatch, "a", "b", "c")
    eye = Closer(says)
    first = eye.detect(BLANK, VIEW)
    assert looks == ["a"]
    assert [one.x for one in first] == pytest.approx([0.02, 0.3, 0.6])
    assert [one.sd for one in first] == [0.001, 0.01, 0.01]
    says.found = says.found[::-1]
    eye.detect(BLANK, VIEW)
    last = eye.detect(BLANK, VIEW)
    assert sorted(looks) == ["a", "b", "c"]
    assert sorted(one.x for one in last) == pytest.approx([0.02, 0.32, 0.62])
    assert [one.tall for one in last] == [9.0] * 3


def test_a_look_may_be_left_to_when_the_scene_is_told_and_tells_with_the_next_picture(monkeypatch):
    says, looks = watched(monkeypatch, "a", "b")
    eye = Closer(says, later=True)
    first = eye.detect(BLANK, VIEW)
    assert (looks, [one.x for one in first]) == ([], [0.0, 0.3])
    eye.settle()
    eye.settle()
    assert looks == ["a"]
    assert [one.x for one in eye.detect(BLANK, VIEW)] == pytest.approx([0.02, 0.3])
    last = eye.detect(BLANK, VIEW)  # nobody settled: done before the next picture
    assert looks == ["a", "b"]
    assert [one.x for one in last] == pytest.approx([0.02, 0.32])


def test_a_look_that_fails_does_not_fail_the_pictures_behind_it(monkeypatch):
    says, _ = watched(monkeypatch, "a")
    eye = Closer(says, later=True)
    eye.detect(BLANK, VIEW)
    with monkeypatch.context() as broken, pytest.raises(ZeroDivisionError):
        broken.setattr("scene.closer.closer", lambda *given: 1 / 0)
        eye.settle()
    assert len(eye.detect(BLANK, VIEW)) == 1


def test_what_rests_is_looked_at_in_turn_now_and_then(monkeypatch):
    says, looks = watched(monkeypatch, "a", "b", "c")
    eye = Closer(says, looks=3, every=4)
    eye.detect(BLANK, VIEW)
    looks.clear()
    for _ in range(12):
        seen = eye.detect(BLANK, VIEW)
        assert [one.x for one in seen] == pytest.approx([0.02, 0.32, 0.62])
    assert looks == ["a", "b", "c"]


def test_what_moves_goes_before_what_rests_and_waits_no_longer_than_others(monkeypatch):
    says, looks = watched(monkeypatch, "a", "b", "c")
    eye = Closer(says, every=1)
    for _ in says.found:
        eye.detect(BLANK, VIEW)
    a, b, c = says.found
    looks.clear()
    for step in range(1, 7):  # one is pushed on and on, another moved but once
        says.found = (replace(a, x=0.03 * step), b, replace(c, y=0.1))
        eye.detect(BLANK, VIEW)
    assert looks[:2] == ["a", "c"]
    assert looks.count("c") == 1
    assert "b" not in looks
    says.found = (replace(a, x=0.18), b, replace(c, y=0.1))
    looks.clear()
    eye.detect(BLANK, VIEW)
    eye.detect(BLANK, VIEW)
    assert "b" in looks


def test_what_is_called_otherwise_keeps_what_was_seen_until_its_turn(monkeypatch):
    says, looks = watched(monkeypatch, "a", "b")
    eye = Closer(says)
    for _ in says.found:
        eye.detect(BLANK, VIEW)
    looks.clear()
    says.found = tuple(replace(one, name=one.name.upper(), x=one.x + 0.003) for one in says.found)
    seen = eye.detect(BLANK, VIEW)
    assert looks == ["A"]
    assert [one.x for one in seen] == pytest.approx([0.023, 0.323])
    assert [one.name for one in seen] == ["A", "B"]
    eye.detect(BLANK, VIEW)
    assert looks == ["A", "B"]


def test_a_contour_says_how_fine_it_is():
    picture, (design,) = pictured(("block", "red", 0.0, 0.0, 0.0))
    body = Body(0.0, 0.0, *design.size[:2], 0.0, design.size[2])
    expected = supports(BLOCK, body.vector()[None], EYE)[0]
    seen = next(contours(picture.pixels, VIEW, expected, [], Room(0.05, 0.15, 0.03)))
    assert isinstance(seen, Contour)
    assert seen.pixel == pytest.approx(3.5 / 700, rel=0.1)
    assert np.abs(seen.reach - expected).max() < 2 * MM
