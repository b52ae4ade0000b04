"""A marker's corners by its sides: true where cornerSubPix is drawn inwards."""

import numpy as np
import pytest

from evals import optics_world as world
from scene import edges, opencv

EYE = world.camera((640, 480), seed=5)


def flat(pixels):
    return opencv.undistort_points(pixels, EYE.matrix, EYE.distortion)


def drawn(blur, side=50.0, noise=2.0):
    """Brightness, the marker's rough corners, and where they truly are (undistorted)."""
    marker = world.Marker(41, 60.0, -40.0, side, 20.0)
    shot = world.over_table(620.0, 15.0, 100.0, blur=blur, noise=noise)
    bright = opencv.gray(world.picture_of_table(EYE, shot, [marker]))
    return bright, opencv.find_markers(bright)[41], flat(shot.seen(EYE, marker.corners()))


@pytest.mark.parametrize("blur", [0.4, 0.8, 1.4])
def test_corners_are_where_they_are_however_soft_the_picture(blur):
    bright, rough, truth = drawn(blur)
    off = np.linalg.norm(edges.corners(bright, rough, flat) - truth, axis=1)
    by_corner = np.linalg.norm(flat(rough) - truth, axis=1)
    assert off.mean() < 0.13 and off.max() < 0.3
    assert off.mean() < by_corner.mean() / 2


def test_the_size_is_kept_where_corners_alone_would_shrink_it():
    bright, rough, truth = drawn(1.2)

    def wide(four):
        return np.mean(np.linalg.norm(four - np.roll(four, 1, axis=0), axis=1))

    assert wide(edges.corners(bright, rough, flat)) == pytest.approx(wide(truth), rel=0.004)
    assert wide(flat(rough)) < 0.99 * wide(truth)


def test_a_side_that_is_not_there_keeps_its_rough_corners():
    bright, rough, _ = drawn(0.8)
    empty = np.full_like(bright, 150)
    assert edges.corners(empty, rough, flat) == pytest.approx(flat(rough))


def test_something_small_on_a_side_does_not_bend_it():
    bright, rough, truth = drawn(0.8)
    middle = np.rint(rough[:2].mean(axis=0)).astype(int)
    bright[middle[1] - 3 : middle[1] + 4, middle[0] - 3 : middle[0] + 4] = 230
    off = np.linalg.norm(edges.corners(bright, rough, flat) - truth, axis=1)
    assert off.max() < 0.6
