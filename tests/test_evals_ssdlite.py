"""The baseline of boxes: what it is shown, and how what it says is measured."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from evals.detector_bench import USUAL  # noqa: E402
from evals.lessons import shard_path, write_shard  # noqa: E402
from evals.ssdlite import FRAME, _Shelf, measured  # noqa: E402
from scene.pictured import SHOWN, camera_sight  # noqa: E402
from scene.truth import NAMES  # noqa: E402


class Perfect(torch.nn.Module):
    """Says the boxes of these sights, one after the other, moved by so many pixels."""

    def __init__(self, sights, off=0.0):
        super().__init__()
        self.left, self.off = list(sights), off

    def forward(self, pictures):
        labels = self.left.pop(0).labels
        boxes = torch.tensor([one.box for one in labels]).reshape(-1, 4) + 0.5 + self.off
        kinds = torch.tensor([1 + NAMES.index(one.name) for one in labels])
        return [{"boxes": boxes, "labels": kinds, "scores": torch.ones(len(labels))}]


def sights():
    return [camera_sight(f"perfect {n}", USUAL, 320, 240) for n in range(6)]


def test_perfect_boxes_are_all_found_though_their_middles_are_not_the_places():
    row = measured(Perfect(sights()), iter(sights()))
    assert row.map50 == row.map50_95 == pytest.approx(1.0)
    assert row.asked > 10
    assert row.found > 0.9 * row.asked
    assert 2.0 < row.median_mm < row.p95_mm


def test_boxes_that_are_a_little_off_lose_the_higher_overlaps():
    row = measured(Perfect(sights(), off=3.0), iter(sights()))
    assert row.map50_95 < 0.7


def test_a_batch_holds_pictures_and_boxes_of_what_is_seen(tmp_path):
    write_shard(shard_path(tmp_path, 5, 0), 5, range(8))
    shelf = _Shelf(tmp_path, torch.device("cpu"))
    shelf.take()
    with np.load(shard_path(tmp_path, 5, 0)) as shard:
        assert shelf.count == len(shard["frames"]) > 0
        most = int(((shard["named"][..., 7] >= SHOWN) & (shard["named"][..., 8] >= 0)).sum(1).max())
    pictures, wanted = shelf.batch(12)
    assert len(pictures) == len(wanted) == 12
    width, height = FRAME
    for picture, one in zip(pictures, wanted, strict=True):
        assert picture.shape == (3, height, width)
        assert 0 <= picture.min() <= picture.max() <= 1
        assert len(one["boxes"]) == len(one["labels"]) <= most
        if len(one["boxes"]):
            assert (one["boxes"][:, 2:] - one["boxes"][:, :2] > 1).all()
            assert one["boxes"].max() <= width
            assert 1 <= one["labels"].min() <= one["labels"].max() <= len(NAMES)
