"""What is known and the detector misses is looked for where it should be."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("cv2")

from test_scene_rest import LIGHT, MM, NOISE, POINTS, VIEW, Says, pictured
from watching import UP, Watch, seen, tip

from scene.closer import Closer
from scene.expected import expected
from scene.kept import alike
from scene.lean import Bar, seen_at, shade
from scene.pictured import standing
from scene.render import Paint, Standing, draw
from scene.shapes import of_kind
from scene.sight import Detection, Picture
from scene.solids import Solid, upright
from scene.support import FLOOR_OF
from scene.surroundings import developed
from scene.track import call

EYE = (0.0, 0.0, 6.0)
CAN, BLOCK = ("can", "blue", 0.4, 0.35, 0.0), ("block", "red", -0.4, 0.0, 0.2)


def away(one, x, y):
    return math.dist((one.x, one.y), (x, y))


def looks(eye, says, found, expected=(), *, things=(CAN, BLOCK), pictures=3):
    """What is told after some pictures in which the detector says that."""
    says.found = tuple(found)
    for seed in range(pictures):
        pixels, _ = pictured(*things, seed=20 + seed)
        told = eye.detect(Picture(pixels, float(seed)), VIEW, expected)
    return told


def test_what_is_expected_and_missed_is_found_by_its_outline():
    _, (can, block) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()))
    near = replace(block, x=block.x + 0.02, y=block.y - 0.02, sd=0.01)
    told = looks(eye, says, [can], [can, near])
    assert len(told) == 2
    assert away(told[1], *BLOCK[2:4]) < 1.5 * MM
    assert told[1].stand > 0


def test_what_is_not_there_any_more_is_not_found_however_much_it_is_expected():
    _, (can, block) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()))
    assert len(looks(eye, says, [can], [can, block], things=(CAN,))) == 1


def test_what_rests_is_told_while_the_detector_misses_it_and_somebody_expects_it():
    _, (can, block) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()))
    before = looks(eye, says, [can, block], pictures=6)
    assert len(looks(eye, says, [can])) == 1
    now = looks(eye, says, [can], [can, block])
    assert now[1].stand == before[1].stand


def test_two_things_that_are_taken_for_one_are_told_apart():
    """Side by side, of one colour: the detector says one large thing."""
    pair = ("block", "red", 0.0, 0.0, 0.0), ("block", "red", 0.26, 0.0, 0.0)
    _, (one, other) = pictured(*pair)
    eye = Closer(says := Says(()))
    blob = replace(one, x=0.13, width=0.46, height=0.2)
    told = looks(eye, says, [blob], [one, other], things=pair)
    assert sorted(round(it.x, 2) for it in told) == [0.0, 0.26]


def test_what_is_new_stays_though_something_known_stands_beside_it():
    _, (can, block) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()))
    assert len(looks(eye, says, [can, block], [can])) == 2


BESIDE = ("block", "red", 0.15, 0.33, 0.0)
"""Pushed up to the can."""


def pushed_up_to(can, off=0.0):
    """What a detector says of the block beside the can, with a part of that, and where it is
    expected, so far off."""
    _, (_, block) = pictured(CAN, BESIDE)
    blob = replace(block, x=block.x + 0.065, width=block.width + 0.14, tall=0.3)
    return block, blob, [can, replace(block, x=block.x - off, sd=0.03)]


@pytest.mark.parametrize("off", [0.0, 0.012])
def test_what_is_seen_as_one_with_what_rests_beside_it_is_told_where_it_is(off):
    _, (can, _) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()))
    looks(eye, says, [can], things=(CAN,), pictures=4)
    block, blob, known = pushed_up_to(can, off)
    told = looks(eye, says, [can, blob], known, things=(CAN, BESIDE), pictures=8)
    assert len(told) == 2
    assert away(told[1], block.x, block.y) < 1.5 * MM


def test_until_it_is_looked_at_it_is_told_where_it_is_expected_but_vaguely():
    _, (can, _) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()), later=True)
    looks(eye, says, [can], things=(CAN,), pictures=4)
    _, blob, known = pushed_up_to(can, 0.015)
    told = looks(eye, says, [can, blob], known, things=(CAN, BESIDE), pictures=1)
    assert (told[1].x, told[1].width) == (known[1].x, known[1].width)
    assert told[1].sd > 10 * MM
    assert away(told[0], can.x, can.y) < 1.5 * MM


def test_what_is_missed_is_remembered_once_however_often_it_is_looked_at_again():
    _, (can, block) = pictured(CAN, BLOCK)
    eye = Closer(says := Says(()), every=1)
    looks(eye, says, [can], [can, block], pictures=12)
    assert sorted(one.made.name for one in eye._kept) == ["block", "can"]


def test_what_was_half_seen_is_looked_at_again_while_it_rests():
    """Something covered a part of it when it was first seen there."""
    _, (can, block) = pictured(CAN, BLOCK)
    cover = ("matchbox", "green", -0.52, 0.02, 1.6)
    eye = Closer(says := Says(()))
    looks(eye, says, [can], [can, block], things=(CAN, BLOCK, cover), pictures=3)
    told = looks(eye, says, [can], [can, block], pictures=8)
    assert away(told[1], block.x, block.y) < 1.5 * MM


def test_what_was_half_seen_and_is_said_to_be_elsewhere_now_is_looked_at_again_while_it_rests():
    """Something of its own colour touched it, so that its outline was not clear."""
    _, (can, block) = pictured(CAN, BLOCK)
    beside = ("block", "red", -0.6, 0.0, 0.2)
    half = replace(block, x=block.x + 0.03, sd=0.012)
    eye = Closer(says := Says(()))
    before = looks(eye, says, [can, half], things=(CAN, BLOCK, beside), pictures=3)
    assert before[1].sd == half.sd
    told = looks(eye, says, [can, block], pictures=12)
    assert away(told[1], block.x, block.y) < 1.5 * MM
    assert told[1].sd < half.sd / 2


# --- what is expected -------------------------------------------------------------------------


def test_what_stands_in_the_open_is_expected_where_it_is():
    watch = Watch().look(seen("can", 0.3, 0.2), seen("cup", -0.4, 0), frames=5)
    told = {one.name: (one.x, one.y) for one in expected(watch.tracks, tip(0, -1, UP, eye=EYE))}
    assert told["can"] == pytest.approx((0.3, 0.2), abs=0.01)
    assert told["cup"] == pytest.approx((-0.4, 0), abs=0.01)


def test_what_a_person_calls_a_thing_tells_its_shape_and_how_tall_it_is():
    watch = Watch().look(seen("other", 0.3, 0.2, size=0.2), frames=5)
    (nameless,) = expected(watch.tracks, tip(0, -1, UP, eye=EYE))
    assert (nameless.noun, nameless.tall_sd) == ("", math.inf)
    watch.tracks = call(watch.tracks, "thing_1", "red candle")
    (candle,) = expected(watch.tracks, tip(0, -1, UP, eye=EYE))
    assert candle.noun == "candle"
    assert candle.tall_sd < 0.12 * candle.tall


def test_a_word_of_unknown_meaning_tells_neither():
    watch = Watch().look(seen("apple", 0.3, 0.2), frames=5)
    watch.tracks = call(watch.tracks, "apple_1", "widget")
    (widget,) = expected(watch.tracks, tip(0, -1, UP, eye=EYE))
    assert (widget.noun, widget.tall_sd) == ("", math.inf)


def test_nothing_is_expected_of_what_is_held_or_hidden():
    watch = Watch().look(
        seen("can", 0.3, 0.2, size=0.2), seen("cup", 0.6, -0.6), seen("pear", -0.5, 0.5), frames=8
    )
    watch.look(
        seen("cup", 0.6, -0.6), seen("pear", -0.5, 0.5),
        hint=tip(0.3, 0.2, 0.36, grip=True, felt=True),
    )  # fmt: skip
    arm = shade(Bar((0.6, -2, 0.5), (0.6, -0.6, 0.5), 0.2), EYE)
    hint = tip(0.3, 0.2, UP, grip=True, felt=True, eye=EYE, shades=(arm,))
    assert [one.name for one in expected(watch.tracks, hint)] == ["pear"]


@pytest.mark.parametrize(("x", "there"), [(-0.2, True), (-0.05, False)])
@pytest.mark.parametrize(("below", "high"), [("board", 0.1), ("bowl", FLOOR_OF)])
def test_what_lies_wholly_on_or_in_a_thing_is_expected_as_high_as_it_lies(x, there, below, high):
    watch = Watch().look(
        seen(below, -0.4, 0, size=0.8, tall=0.1), seen("apple", x, 0, size=0.2, tall=0.2),
        frames=8,
    )  # fmt: skip
    told = {one.name: one for one in expected(watch.tracks, tip(0, -1, UP, eye=EYE))}
    assert ("apple" in told) == there
    assert told[below].base == 0.0
    if there:
        assert told["apple"].base == pytest.approx(high, abs=0.01)
        assert told["apple"].x == pytest.approx(x, abs=0.01)  # as it seems to be


def test_the_expected_place_is_known_no_better_than_a_millimetre():
    watch = Watch().look(seen("can", 0.3, 0.2, sd=0.0001), frames=50)
    (one,) = expected(watch.tracks, tip(0, -1, UP, eye=EYE))
    assert one.sd == pytest.approx(MM)
    assert one.feature is watch["can_1"].look.feature or np.size(one.feature) == 0


def test_a_height_that_is_known_puts_the_place_right():
    """Far from below the camera a thing that is taken for lower than it is seems farther away."""
    high = ("can", "blue", 0.75, 0.7, 0.0)
    _, (can,) = pictured(high)
    unknown = replace(can, name="other", tall=0.6 * can.tall, x=0.78, y=0.73, sd=0.015)
    (plain,) = looks(Closer(says := Says(())), says, [unknown], things=(high,))
    felt = replace(can, name="other", tall_sd=0.01)
    (told,) = looks(Closer(says := Says(())), says, [unknown], [felt], things=(high,))
    assert away(told, 0.75, 0.7) < 2 * MM
    assert away(plain, 0.75, 0.7) > 10 * MM
    assert told.tall == pytest.approx(can.tall, rel=0.1)


def test_what_fell_over_is_as_tall_as_it_looks():
    lying = ("matchbox", "yellow", 0.4, 0.35, 0.0)
    _, (box,) = pictured(lying)
    stood = replace(box, width=box.tall, tall=box.width, tall_sd=0.01)
    eye = Closer(says := Says(()))
    (told,) = looks(eye, says, [box], [stood], things=(lying,))
    assert told.tall < 1.5 * box.tall


def test_what_is_seen_apart_from_what_it_lies_on_is_where_it_is_seen():
    """Without that word a thing on another is seen as one with it, and no place told by it."""
    below = {"size": 0.8, "tall": 0.1, "sd": 0.002}
    both = seen("board", -0.4, 0, **below), seen("apple", -0.38, 0, size=0.2, sd=0.002)
    sds = []
    for base in (0.0, 0.1):
        told = both[0], replace(both[1], base=base)
        watch = Watch().look(*told, frames=20)
        sds.append((watch["apple_1"].at.sd, watch["board_1"].at.sd))
    (vague, vague_below), (exact, exact_below) = sds
    assert exact < 0.8 * vague
    assert exact_below < 0.8 * vague_below


# --- what lies on something -------------------------------------------------------------------

HIGH = 0.12
"""How tall the board is that things lie on (table units)."""


def on_a_board(*things, seed=4, bare=False, sides=(0.9, 0.8)):
    """A picture of a blue board with things of (kind, colour, x, y, yaw) on it, by a noisy camera,
    and what a detector that never errs says of board and things."""
    wide, deep = sides
    kinds = [of_kind(random.Random(7), kind, 1.0, color) for kind, color, *_ in things]
    blue = Paint(np.array((0.05, 0.1, 0.5), np.float32), np.array((0.05, 0.1, 0.5), np.float32))
    half = (wide / 2, deep / 2, HIGH / 2)
    board = Standing(
        (Solid("box", half, (0.5, -0.4, HIGH / 2), upright()),), (blue,), 0.5, -0.4, 0.0,
        (wide, deep, HIGH),
    )  # fmt: skip
    stood = [standing(one, *at) for one, (_, _, *at) in zip(kinds, things, strict=True)]
    lifted = [
        one._replace(solids=tuple(
            it._replace(at=(it.at[0], it.at[1], it.at[2] + HIGH)) for it in one.solids
        ))
        for one in stood
    ]  # fmt: skip
    empty = np.broadcast_to(np.array((0.2, 0.21, 0.22), np.float32), (480, 640, 3)).copy()
    drawn = draw([board, *([] if bare else lifted)], VIEW, POINTS, empty, LIGHT)
    sharp = developed(random.Random(0), drawn.pixels, 0.0)
    rough = sharp + np.random.default_rng(seed).normal(0, NOISE, sharp.shape)
    feature = np.ones(4, np.float32)
    below = Detection(
        "other", 0.9, 0.5, -0.4, 0.01, wide, deep, HIGH, 0.0, "blue", feature
    )  # fmt: skip
    told = [
        Detection(one.name, 0.9, *seen_at((x, y), HIGH, VIEW.camera), 0.01, *one.size, yaw, color,
                  feature, base=HIGH)
        for one, (_, color, x, y, yaw) in zip(kinds, things, strict=True)
    ]  # fmt: skip
    return Picture(rough.clip(0, 255).astype(np.uint8), float(seed)), below, told


@pytest.mark.parametrize("point", [(0.3, 0.2), (-0.9, 0.7)])
def test_a_raised_surface_shows_where_its_points_seem_to_be(point):
    seen = VIEW.pixels(np.array([seen_at(point, HIGH, VIEW.camera)]))
    raised = VIEW.raised(HIGH)
    assert raised.pixels(np.array([point])) == pytest.approx(seen)
    assert raised.camera[2] == pytest.approx(VIEW.camera[2] - HIGH)


@pytest.mark.parametrize(
    "thing",
    [("magnet", "red", 0.4, -0.3, 0.3), ("block", "yellow", 0.6, -0.5, 0.1),
     ("can", "white", 0.7, -0.25, 0.0)],
)  # fmt: skip
def test_what_lies_on_something_is_found_by_its_outline_against_that(thing):
    _, board, (one,) = on_a_board(thing)
    near = replace(one, x=one.x + 0.015, y=one.y - 0.01, sd=0.01)
    eye = Closer(says := Says((board,)))
    for seed in range(4):
        picture, *_ = on_a_board(thing, seed=30 + seed)
        told = eye.detect(picture, VIEW, [board, near])
    assert says.found == (board,)
    assert len(told) == 2
    assert away(told[1], one.x, one.y) < 1.5 * MM
    assert told[1].stand > 0


def test_what_nearly_covers_what_it_lies_on_is_found_beside_it():
    """One found thing of that place and size is one known thing, not two."""
    thing, sides = ("matchbox", "yellow", 0.5, -0.4, 0.0), (0.32, 0.25)
    _, board, (box,) = on_a_board(thing, sides=sides)
    assert alike(box, board)
    eye = Closer(Says((board,)))
    for seed in range(4):
        picture, *_ = on_a_board(thing, seed=seed, sides=sides)
        told = eye.detect(picture, VIEW, [box, board])
    assert sorted(it.name for it in told) == ["matchbox", "other"]
    found = next(it for it in told if it.name == "matchbox")
    assert away(found, box.x, box.y) < 1.5 * MM


def test_what_fell_from_something_is_not_found_there():
    _, board, (one,) = on_a_board(("magnet", "red", 0.4, -0.3, 0.3))
    eye = Closer(Says((board,)))
    for seed in range(4):
        picture, *_ = on_a_board(("magnet", "red", 0.4, -0.3, 0.3), seed=seed, bare=True)
        assert len(eye.detect(picture, VIEW, [board, one])) == 1


def test_two_things_on_one_are_each_found():
    pair = ("magnet", "red", 0.3, -0.35, 0.3), ("block", "yellow", 0.68, -0.45, 0.0)
    _, board, both = on_a_board(*pair)
    eye = Closer(Says((board,)))
    for seed in range(5):
        picture, *_ = on_a_board(*pair, seed=seed)
        told = eye.detect(picture, VIEW, [board, *both])
    assert len(told) == 3
    for found, true in zip(told[1:], both, strict=True):
        assert away(found, true.x, true.y) < 1.5 * MM


def test_what_is_made_of_a_thing_and_of_what_it_lies_on_is_no_third_one():
    thing = ("magnet", "red", 0.4, -0.3, 0.3)
    _, board, (one,) = on_a_board(thing)
    mixed = replace(one, name="other", base=0.0, width=0.35, height=0.3, x=one.x + 0.03)
    eye = Closer(Says((board, mixed)))
    for seed in range(4):
        picture, *_ = on_a_board(thing, seed=seed)
        told = eye.detect(picture, VIEW, [board, one])
    assert sorted(it.name for it in told) == ["magnet", "other"]
