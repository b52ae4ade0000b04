"""OpenCV's place: colours, the pixel convention, what is said where it is missing."""

import subprocess
import sys

import numpy as np
import pytest

from agent.errors import CalibrationError, CameraError
from scene import opencv


def gradient(height=60, width=80):
    """Red grows to the right, green downwards; blue is 40."""
    v, u = np.mgrid[0:height, 0:width]
    return np.stack((2 * u, 3 * v, np.full_like(u, 40)), axis=-1).astype(np.uint8)


def centroid(pixels):
    """Where the light in a picture (height, width, 3) is, in pixels (u, v)."""
    light = pixels[:, :, 0].astype(float)
    v, u = np.mgrid[0 : light.shape[0], 0 : light.shape[1]]
    return np.array([(u * light).sum(), (v * light).sum()]) / light.sum()


def spot(u, v, size=(80, 60)):
    """One white pixel in black."""
    pixels = np.zeros((size[1], size[0], 3), np.uint8)
    pixels[v, u] = 255
    return pixels


def test_a_png_keeps_every_pixel_and_its_colours(tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(opencv.png(gradient()))
    assert (opencv.read_picture(path) == gradient()).all()


def test_a_jpeg_keeps_the_colours():
    back = opencv.decode(opencv.jpeg(gradient(), 95)).astype(int)
    assert np.abs(back - gradient()).mean() < 4


@pytest.mark.parametrize("data", [b"", b"no picture", opencv.png(gradient())[:30]])
def test_what_is_no_picture_is_said_with_its_file(tmp_path, data):
    path = tmp_path / "a.png"
    path.write_bytes(data)
    with pytest.raises(CameraError, match=r"a\.png: not a picture"):
        opencv.read_picture(path)
    with pytest.raises(CameraError, match="No such file"):
        opencv.read_picture(tmp_path / "none.png")


def test_the_centre_of_the_first_pixel_is_zero_when_a_picture_is_resized():
    small = opencv.resize(spot(40, 20), (20, 15))
    assert centroid(small) == pytest.approx([(40.5 / 4) - 0.5, (20.5 / 4) - 0.5], abs=0.4)
    block = np.zeros((60, 80, 3), np.uint8)
    block[20:24, 40:44] = 255  # its middle: 41.5, 21.5
    assert centroid(opencv.resize(block, (20, 15))) == pytest.approx([42 / 4 - 0.5, 22 / 4 - 0.5])
    assert centroid(opencv.resize(spot(4, 3, (8, 6)), (80, 60))) == pytest.approx([44.5, 34.5])


def test_a_warped_pixel_shows_what_the_homography_says():
    shift = np.array([[1, 0, 7.0], [0, 1, -3.0], [0, 0, 1]])
    assert centroid(opencv.warp(spot(40, 20), shift, (80, 60))) == pytest.approx([33, 23])
    double = np.diag([0.5, 0.5, 1.0])
    assert centroid(opencv.warp(spot(20, 10), double, (80, 60))) == pytest.approx([40, 20], abs=0.1)


def test_undistorted_pictures_and_undistorted_points_agree():
    matrix = np.array([[70.0, 0, 40], [0, 70, 30], [0, 0, 1]])
    curve = np.array([-0.25, 0.05, 0.001, -0.001, 0])
    picture = np.zeros((60, 80, 3), np.uint8)
    picture[8:11, 65:68] = 255  # centred on (66, 9)
    flat = opencv.undistorter(matrix, curve, (80, 60))(picture)
    told = opencv.undistort_points(np.array([[66.0, 9.0]]), matrix, curve)[0]
    assert np.hypot(*(told - [66, 9])) > 1.5
    assert centroid(flat) == pytest.approx(told, abs=0.1)


def test_edges_are_as_wide_as_they_are_blurred():
    widths = []
    for sigma in (0.0, 1.0, 2.0, 4.0):
        u = np.arange(200) - 99.5
        row = np.clip(u * 1e9, 0, 1) if sigma == 0 else 0.5 * (1 + np.tanh(u / sigma / 1.25))
        widths.append(opencv.edge_width(np.tile((40 + 170 * row).astype(np.uint8), (200, 1))))
    assert widths[0] < 3.5 and widths == sorted(widths) and widths[-1] > 8
    assert opencv.edge_width(np.full((50, 50), 90, np.uint8)) == 0


def test_a_number_seen_twice_is_left_out():
    sheet = np.full((200, 400), 255, np.uint8)
    for number, left in ((3, 30), (3, 150), (5, 280)):
        sheet[60:132, left : left + 72] = opencv.draw_marker(number, 72)
    assert set(opencv.find_markers(sheet)) == {5}


def test_fits_that_cannot_be_are_calibration_errors():
    line = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0]])
    with pytest.raises(CalibrationError):
        opencv.calibrate([line], [line], (80, 60))
    with pytest.raises(CalibrationError):
        opencv.homography(line[:3], line[:3])


def test_a_missing_package_is_named_with_how_to_get_it():
    code = (
        "import sys; sys.modules['cv2'] = None\n"
        "from agent.errors import ConfigError\n"
        "from scene import camera, lens, markers, opencv, sheets\n"
        "for call in (opencv.loaded, lambda: camera.camera('0')):\n"
        "    try:\n        call()\n"
        "    except ConfigError as error:\n        print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.count("pip install 'armchat[camera]'") == 2


def test_opencv_is_loaded_only_when_it_is_used():
    code = (
        "import sys\n"
        "from scene import camera, calibration, lens, markers, opencv, sheets, touched\n"
        "print('cv2' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
