"""The optics' bench: it measures what it says, and a bad lens or a careless hand shows in it."""

import msgspec
import numpy as np
import pytest

from evals import optics_bench, optics_world
from scene.calibration import Lens, rows


def case(number=1, zoom=1.0):
    """A small camera whose lens is known, or known wrongly, instead of fitted."""
    eye = optics_world.camera((640, 480), seed=number)
    matrix = eye.matrix * [[zoom, 1, 1], [1, zoom, 1], [1, 1, 1]]
    lens = Lens(
        date="", source="", size=eye.size, matrix=rows(matrix),
        distortion=tuple(map(float, eye.distortion)), pictures=15, px=0.1, mm=0.1, focal_sd=0.1,
    )  # fmt: skip
    return optics_bench.Case(eye, lens, 0.0)


def test_a_true_lens_gives_a_true_table_and_a_careless_hand_shows():
    exact = optics_bench._errors([case()], 4, 0.0)
    laid = optics_bench._errors([case()], 4, optics_bench.LAID_MM)
    assert len(exact.means) == 4 and exact.refused == 0
    assert max(exact.worst) < 0.5 and min(exact.centres) > 0
    assert np.mean(laid.means) > 2 * np.mean(exact.means)
    assert len(laid.means) + laid.refused == 4


def test_a_wrong_lens_is_refused_or_shows():
    wrong = optics_bench._errors([case(zoom=1.03)], 3, 0.0)
    exact = optics_bench._errors([case()], 3, 0.0)
    assert wrong.refused or np.mean(wrong.centres) > 3 * np.mean(exact.centres)


def test_the_whole_table_is_in_every_picture():
    eye = case().eye
    for seed in range(20):
        shot = optics_bench._shot(eye, np.random.default_rng(seed))
        seen = shot.seen(eye, optics_bench.GRID * 200)
        assert (seen > 0).all() and (seen < [639, 479]).all()


def test_the_arms_figures_count_all_and_grow_with_the_touch(monkeypatch):
    monkeypatch.setattr(optics_bench, "TOUCHED", 40)
    careless = optics_bench._arm([case()])
    refused = careless["arm_refused"]
    assert careless["arm_mean_mm"].n + round(refused.value * 40 / 100) == 40 == refused.n
    monkeypatch.setattr(optics_bench, "TOUCH_MM", 0.05)
    monkeypatch.setattr(optics_bench, "LAID_MM", 0.05)
    careful = optics_bench._arm([case()])
    for name in ("arm_mean_mm", "camera_to_arm_median_mm"):
        assert 0 < careful[name].value < careless[name].value / 2


def test_the_world_is_a_pinhole_with_browns_distortion():
    """The truth itself, against numbers worked out by hand."""
    eye = optics_world.Eye(
        (100, 80), np.array([[100.0, 0, 50], [0, 100, 40], [0, 0, 1]]), np.array([0.1, 0, 0, 0, 0])
    )
    assert eye.project(np.array([[0.0, 0, 2], [1, 0, 2]])) == pytest.approx(
        np.array([[50.0, 40], [50 + 50 * (1 + 0.1 * 0.25), 40]])
    )
    back = eye.rays(np.array([[50 + 50 * 1.025, 40.0]]))
    assert back == pytest.approx(np.array([[0.5, 0]]), abs=1e-6)


def test_figures_are_of_the_form_of_all_benches(monkeypatch):
    monkeypatch.setattr(optics_bench, "TOUCHED", 20)
    monkeypatch.setattr(optics_bench, "_case", lambda number, size=None: case(number))
    figures = optics_bench.figures(poses=4)
    assert figures["table_mean_mm"].goal == "<= 0.5" and figures["table_mean_mm"].n == 4
    assert figures["table_max_mm"].goal == "<= 1"
    assert all(figure.value is not None and figure.n > 0 for figure in figures.values())
    assert msgspec.json.encode(figures)
