"""One small round of training: what is written is served, and a longer course goes on with it."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from scene.detector import NetDetector  # noqa: E402
from scene.peaks import OTHER  # noqa: E402
from scene.pictured import Terms, level_sight  # noqa: E402
from scene.shapes import KINDS  # noqa: E402
from scene.train_detector import GRID, Course, Lessons, train  # noqa: E402


def test_a_course_is_gone_on_with_and_its_weights_are_served(tmp_path):
    half = GRID.size * GRID.pixel / 2
    sights = [level_sight(f"small {n}", Terms(), half, GRID.size) for n in range(4)]
    lessons = Lessons(
        np.stack([one.picture.pixels for one in sights]),
        np.array([one.view.camera for one in sights]),
        tuple(one.labels for one in sights),
    )
    course = Course(pictures=4, rounds=1, batch=2)
    train(lessons, course, tmp_path)
    first = torch.load(tmp_path / "checkpoint.pt", weights_only=True)
    assert first["round"] == 1
    path = train(lessons, Course(pictures=4, rounds=2, batch=2), tmp_path)
    again = torch.load(tmp_path / "checkpoint.pt", weights_only=True)
    assert again["round"] == 2
    changed = [not torch.equal(first["net"][key], again["net"][key]) for key in first["net"]]
    assert any(changed)
    detector = NetDetector(weights=path)
    assert detector.names == (*KINDS, OTHER)
    assert detector.grid == GRID
    maps = detector.maps(lessons.levels[0], sights[0].view.camera)
    assert maps["heat"].shape == (13, 60, 60)
    assert 0 <= maps["heat"].min() <= maps["heat"].sum(0).max() <= 1
