"""Heights by name: what a thing is called corrects what is seen from above."""

import numpy as np
import pytest

from scene import look
from scene.generate import CLASSES
from scene.sight import Detection
from scene.stature import spread, stature

NOTHING = np.zeros(0, np.float32)


def seen(tall, width=0.2, height=0.2):
    return look.first(Detection("other", 0.9, 0, 0, 0.01, width, height, tall, 0.0, None, NOTHING))


def test_a_candle_of_another_size_has_a_candles_proportions():
    kind = CLASSES["candle"]
    half = seen(0.3, kind.width / 2, kind.height / 2)
    told = stature("red candle", half)
    assert kind.tall / 2 < told < kind.tall / 2 * 1.1
    assert told == stature("candle", half)


@pytest.mark.parametrize("name", ["thing", "widget", "apple"])
def test_what_no_name_says_is_as_it_was_seen(name):
    assert stature(name, seen(0.3)) == 0.3


def test_a_wrong_height_is_mostly_corrected_and_a_right_one_stays():
    kind = CLASSES["egg"]
    for off in (0.7, 1.0, 1.4):
        told = stature("egg", seen(off * kind.tall, kind.width, kind.height))
        assert told == pytest.approx(kind.tall, rel=0.06)
    exact = stature("egg", seen(kind.tall, kind.width, kind.height))
    assert exact == pytest.approx(kind.tall)


def test_a_height_is_the_surer_the_more_is_known_of_the_kind():
    apple = look.first(Detection("apple", 0.9, 0, 0, 0.01, 0.36, 0.36, 0.36, 0.0, None, NOTHING))
    kind = CLASSES["egg"]
    egg = seen(kind.tall, kind.width, kind.height)
    assert spread("apple", apple) < spread("egg", egg) < spread("widget", egg)
    assert spread("egg", egg) == pytest.approx(0.1 * kind.tall, rel=0.05)
    assert spread("apple", seen(0.36)) > 10 * spread("apple", apple)
