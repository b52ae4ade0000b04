"""What is known and the detector misses is looked for where it should be."""

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("cv2")

from test_scene_rest import MM, VIEW, Says, pictured
from watching import UP, Watch, seen, tip

from scene.closer import Closer
from scene.expected import expected
from scene.lean import Bar, shade
from scene.sight import Picture

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


# --- what is expected -------------------------------------------------------------------------


def test_what_stands_in_the_open_is_expected_where_it_is():
    watch = Watch().look(seen("can", 0.3, 0.2), seen("cup", -0.4, 0), frames=5)
    told = {one.name: (one.x, one.y) for one in expected(watch.tracks, tip(0, -1, UP, eye=EYE))}
    assert told["can"] == pytest.approx((0.3, 0.2), abs=0.01)
    assert told["cup"] == pytest.approx((-0.4, 0), abs=0.01)


def test_nothing_is_expected_of_what_is_held_hidden_gone_or_in_another_thing():
    plate = {"size": 0.8, "tall": 0.06}
    watch = Watch().look(
        seen("plate", -0.4, 0, **plate), seen("can", 0.3, 0.2, size=0.2), seen("cup", 0.6, -0.6),
        seen("apple", -0.4, 0, size=0.2, tall=0.2), frames=8,
    )  # fmt: skip
    watch.look(
        seen("plate", -0.4, 0, **plate), seen("cup", 0.6, -0.6),
        hint=tip(0.3, 0.2, 0.36, grip=True, felt=True),
    )  # fmt: skip
    arm = shade(Bar((0.6, -2, 0.5), (0.6, -0.6, 0.5), 0.2), EYE)
    hint = tip(0.3, 0.2, UP, grip=True, felt=True, eye=EYE, shades=(arm,))
    assert [one.name for one in expected(watch.tracks, hint)] == ["plate"]


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
