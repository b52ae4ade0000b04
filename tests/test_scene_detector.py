"""The served detector on tables of fixed seeds: what it finds, where, and how it is loaded."""

import hashlib
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from agent.errors import ConfigError
from evals.detector_bench import USUAL, away_mm, seen_by
from scene.detector import NetDetector
from scene.peaks import OTHER
from scene.pictured import Terms, camera_sight, camera_view
from scene.shapes import KINDS
from scene.sight import Picture
from scene.strange import UNSEEN

WEIGHTS = Path(__file__).parent.parent / "scene" / "weights"
KNOWN = USUAL._replace(strange=0.0)


@pytest.fixture(scope="module")
def detector():
    return NetDetector()


def test_known_things_are_found_named_and_placed(detector):
    seen = seen_by(detector, (camera_sight(f"seen {n}", KNOWN, 640, 480) for n in range(12)))
    found = [pair for pair in seen.pairs if pair.seen]
    assert len(found) >= 0.95 * len(seen.pairs) > 30
    assert sum(pair.seen.name == pair.label.name for pair in found) >= 0.75 * len(found)
    assert np.median([away_mm(pair) for pair in found]) < 4.0
    wrong = [abs(pair.seen.tall / pair.label.tall - 1) for pair in found]
    assert np.median(wrong) < 0.15


def test_what_it_has_never_seen_is_there_and_is_other(detector):
    strange = Terms(height=(3.0, 4.0), tilt=(0.0, 10.0), families=tuple(UNSEEN), strange=1.0,
                    wide=0.0, most=6)  # fmt: skip
    seen = seen_by(detector, (camera_sight(f"strange {n}", strange, 640, 480) for n in range(12)))
    found = [pair for pair in seen.pairs if pair.seen]
    assert len(found) >= 0.9 * len(seen.pairs) > 15
    assert sum(pair.seen.name == OTHER for pair in found) >= 0.7 * len(found)


def test_the_same_picture_gives_the_same_and_half_the_light_nearly(detector):
    sight = camera_sight("light", KNOWN._replace(gain=(0.9, 0.9)), 640, 480)
    one, same = (detector.detect(sight.picture, sight.view) for _ in range(2))
    assert [(d.name, d.x, d.y, d.score) for d in one] == [(d.name, d.x, d.y, d.score) for d in same]
    assert all(np.array_equal(a.feature, b.feature) for a, b in zip(one, same, strict=True))
    darker = Picture((0.73 * sight.picture.pixels).astype(np.uint8), 0.0)
    dim = detector.detect(darker, sight.view)
    assert sorted(d.name for d in dim) == sorted(d.name for d in one)


def test_detections_are_values_as_the_protocol_says(detector):
    sight = camera_sight("values", KNOWN, 640, 480)
    found = detector.detect(sight.picture, sight.view)
    assert found
    assert [one.score for one in found] == sorted((one.score for one in found), reverse=True)
    for one in found:
        assert one.name in {*KINDS, OTHER}
        assert 0 < one.score <= 1
        assert 0 < one.sd < 0.2
        assert -math.pi / 4 <= one.r <= math.pi / 4
        assert np.linalg.norm(one.feature) == pytest.approx(1.0, abs=1e-5)


def test_an_empty_table_shows_nothing(detector):
    view = camera_view((0.2, -0.3, 3.5), (0.0, 0.0), 0.0, 560.0, 640, 480)
    grain = np.random.default_rng(0).normal(150, 3, (480, 640, 1))
    plain = np.clip(np.broadcast_to(grain, (480, 640, 3)), 0, 255).astype(np.uint8)
    assert detector.detect(Picture(plain, 0.0), view) == ()


def test_weights_that_cannot_be_read_are_named(tmp_path):
    broken = tmp_path / "broken.onnx"
    broken.write_bytes(b"nothing")
    with pytest.raises(ConfigError, match=r"broken\.onnx"):
        NetDetector(weights=broken)


def test_the_card_speaks_of_these_weights_and_they_are_small():
    data = (WEIGHTS / "detector.onnx").read_bytes()
    card = (WEIGHTS / "CARD.md").read_text(encoding="utf-8")
    assert re.findall(r"SHA-256: `([0-9a-f]{64})`", card) == [hashlib.sha256(data).hexdigest()]
    assert len(data) <= 1_200_000


def test_importing_the_detector_loads_neither_torch_nor_onnxruntime():
    code = (
        "import sys, scene.detector\n"
        "heavy = {'torch', 'onnxruntime', 'cv2', 'pybullet'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
