"""A moment of training: what is written is served, and a longer course goes on with it."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from agent.errors import ConfigError  # noqa: E402
from scene.detector import NetDetector  # noqa: E402
from scene.peaks import OTHER  # noqa: E402
from scene.pictured import Terms, level_sight  # noqa: E402
from scene.shapes import KINDS  # noqa: E402
from scene.train_detector import Course, train  # noqa: E402
from scene.truth import GRID, Lessons, truth  # noqa: E402

MOMENT = 0.0001
"""Minutes: time for one step."""


def lessons():
    half = GRID.size * GRID.pixel / 2
    sights = [level_sight(f"small {n}", Terms(), half, GRID.size) for n in range(4)]
    return Lessons(
        np.stack([one.picture.pixels for one in sights]),
        np.array([one.view.camera for one in sights], np.float32),
        np.stack([truth(one.labels) for one in sights]),
    )


def once(*given):
    """Lessons that come once."""
    left = [list(given)]
    return lambda: left.pop() if left else []


def test_a_course_is_gone_on_with_and_its_weights_are_served(tmp_path):
    shown = lessons()
    course = Course(minutes=MOMENT, first=4, pictures=6, batch=2)
    train(once(shown), course, tmp_path)
    first = torch.load(tmp_path / "checkpoint.pt", weights_only=True)
    assert first["steps"] == 1
    assert first["spent"] >= 60 * MOMENT
    longer = Course(minutes=first["spent"] / 60 + MOMENT, first=4, pictures=6, batch=2)
    path = train(once(shown), longer, tmp_path)
    again = torch.load(tmp_path / "checkpoint.pt", weights_only=True)
    assert again["steps"] > first["steps"]
    assert again["spent"] > first["spent"]
    changed = [not torch.equal(first["net"][key], again["net"][key]) for key in first["net"]]
    assert any(changed)
    detector = NetDetector(weights=path)
    assert detector.names == (*KINDS, OTHER)
    assert detector.grid == GRID
    maps = detector.maps(shown.levels[0], tuple(shown.cameras[0].tolist()))
    assert maps["heat"].shape == (13, 60, 60)
    assert 0 <= maps["heat"].min() <= maps["heat"].sum(0).max() <= 1
    assert 0 <= maps["place"][3].min() <= maps["place"][3].max() <= 1


def test_more_pictures_than_there_is_room_for_are_left(tmp_path):
    course = Course(minutes=MOMENT, first=3, pictures=3, batch=2)
    assert train(once(lessons(), lessons()), course, tmp_path).exists()


def test_where_no_pictures_come_it_is_said(tmp_path):
    with pytest.raises(ConfigError, match="no pictures"):
        train(list, Course(minutes=MOMENT, batch=2, pictures=4), tmp_path)
