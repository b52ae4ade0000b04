"""Cameras: newest frame only, unplugged and back, files to their end, texts that name them."""

import threading
import time

import numpy as np
import pytest

from agent.config import CameraConfig
from agent.errors import CameraError
from scene import opencv
from scene.camera import Ended, FolderCamera, UsbCamera, VideoCamera, camera, frames, open_device
from scene.exposure import blur, exposure


class Device:
    """A camera on a cable: gives the frames it is fed, each once; may be pulled out."""

    def __init__(self):
        self.plugged = True
        self.opened = self.released = 0
        self.news = threading.Condition()
        self.fed: list[int] = []
        self.read_so_far = 0

    def make(self):
        if not self.plugged:
            raise CameraError("no camera at /dev/video7: plug it in")
        self.opened += 1
        return self

    def read(self):
        with self.news:
            self.news.wait_for(lambda: self.fed or not self.plugged, 10)
            if not self.plugged or not self.fed:
                return None
            self.read_so_far += 1
            return np.full((4, 6, 3), self.fed.pop(0), np.uint8)

    def release(self):
        self.released += 1

    def feed(self, *values):
        with self.news:
            self.fed.extend(values)
            self.news.notify_all()

    def pull(self):
        with self.news:
            self.plugged, self.fed = False, []
            self.news.notify_all()


def eventually(so, patience=10.0):
    """Look again and again, with a breath between."""
    end = time.monotonic() + patience
    pause = threading.Event()
    while not so():
        assert time.monotonic() < end, "it never came to pass"
        pause.wait(0.002)


def value(eye):
    return int(eye.look().pixels[0, 0, 0])


def looks(eye):
    try:
        return value(eye)
    except CameraError as error:
        return str(error)


@pytest.fixture
def device():
    made = Device()
    yield made
    made.pull()


def watched(device, **more):
    return UsbCamera(7, make=device.make, retry=0.002, **more)


def test_only_the_newest_frame_is_shown(device):
    with watched(device) as eye:
        device.feed(1, 2, 3)
        eventually(lambda: device.read_so_far == 3 and value(eye) == 3)
        device.feed(9)
        eventually(lambda: value(eye) == 9)
        assert value(eye) == 9


def test_each_frame_of_a_device_comes_once(device):
    times = iter(range(100, 200))
    with watched(device, clock=lambda: next(times)) as eye:
        device.feed(1)
        coming = frames(eye)
        seen = [int(next(coming).pixels[0, 0, 0])]
        threading.Timer(0.02, device.feed, (2,)).start()
        seen.append(int(next(coming).pixels[0, 0, 0]))
    assert seen == [1, 2]


def test_the_first_look_waits_for_the_first_frame(device):
    with watched(device) as eye:
        threading.Timer(0.05, device.feed, (5,)).start()
        assert value(eye) == 5


def test_a_camera_that_is_pulled_out_comes_back_by_itself(device):
    with watched(device) as eye:
        device.feed(1)
        assert value(eye) == 1
        device.pull()
        eventually(lambda: "plug it in" in str(looks(eye)))
        device.plugged = True
        device.feed(2)
        eventually(lambda: looks(eye) == 2)
        assert device.opened == 2 and device.released == 1


def test_a_camera_that_is_not_there_says_so_at_once_and_may_come_later(device):
    device.plugged = False
    with watched(device) as eye:
        assert "no camera at /dev/video7" in str(looks(eye))
        device.plugged = True
        device.feed(3)
        eventually(lambda: looks(eye) == 3)


def test_an_old_frame_is_no_picture(device):
    now = [100.0]
    with watched(device, clock=lambda: now[0]) as eye:
        device.feed(1)
        assert eye.look().t == 100.0
        now[0] = 103.0
        with pytest.raises(CameraError, match="shows nothing"):
            eye.look()


def test_a_camera_that_shows_nothing_is_said_after_its_time(device):
    with (
        watched(device, patience=0.02) as eye,
        pytest.raises(CameraError, match="shows nothing"),
    ):
        eye.look()


def test_it_must_be_started_and_closing_gives_the_device_back(device):
    eye = watched(device)
    with pytest.raises(CameraError, match="not started"):
        eye.look()
    eye.start()
    device.feed(1)
    assert value(eye) == 1
    began = time.monotonic()
    eye.close()
    assert time.monotonic() - began < 0.1
    with pytest.raises(CameraError, match="closed"):
        eye.look()
    device.feed(2)
    eventually(lambda: device.released == 1)


# --- files ---------------------------------------------------------------------------------------


@pytest.fixture
def pictures(tmp_path):
    for name, shade in (("b.png", 20), ("a.png", 10), ("c.jpg", 30)):
        pixels = np.full((8, 8, 3), shade, np.uint8)
        write = opencv.png if name.endswith("png") else opencv.jpeg
        (tmp_path / name).write_bytes(write(pixels))
    (tmp_path / "notes.txt").write_text("no picture")
    return tmp_path


def shades(eye):
    return [int(picture.pixels[0, 0, 0]) for picture in frames(eye)]


def test_a_folder_is_shown_by_name_to_its_end_or_for_ever(pictures):
    assert shades(FolderCamera(pictures)) == [10, 20, 30]
    again = FolderCamera(pictures, loop=True)
    assert [value(again) for _ in range(5)] == [10, 20, 30, 10, 20]
    ended = FolderCamera(pictures)
    shades(ended)
    with pytest.raises(Ended, match="after 3 pictures"):
        ended.look()


def test_a_picture_that_cannot_be_read_is_named(pictures):
    (pictures / "b.png").write_bytes(b"broken")
    with pytest.raises(CameraError, match=r"b\.png: not a picture"):
        shades(FolderCamera(pictures))


@pytest.fixture
def clip(tmp_path):
    """Four frames, each brighter."""
    path = tmp_path / "clip.avi"
    cv = opencv.loaded()
    writer = cv.VideoWriter(str(path), cv.VideoWriter.fourcc(*"MJPG"), 10, (64, 48))
    for shade in (20, 80, 140, 200):
        writer.write(np.full((48, 64, 3), shade, np.uint8))
    writer.release()
    return path


def test_a_video_is_shown_to_its_end_or_for_ever(clip):
    assert np.abs(np.array(shades(VideoCamera(clip))) - [20, 80, 140, 200]).max() <= 3
    again = VideoCamera(clip, loop=True)
    assert [round(value(again), -1) for _ in range(5)] == [20, 80, 140, 200, 20]
    again.close()
    with pytest.raises(CameraError, match="closed"):
        again.look()


def test_a_text_names_a_camera(pictures, clip):
    assert isinstance(camera("0"), UsbCamera) and isinstance(camera("/dev/video0"), UsbCamera)
    assert isinstance(camera(str(pictures)), FolderCamera)
    assert shades(camera(str(pictures / "a.png"))) == [10]
    assert isinstance(camera(str(clip)), VideoCamera)


@pytest.mark.parametrize(
    ("text", "said"),
    [("none.mp4", "no such file"), ("none.png", "no such file"), ("{}/notes.txt", "not a video")],
)
def test_what_is_no_camera_is_said(pictures, text, said):
    with pytest.raises(CameraError, match=said):
        camera(text.format(pictures))


def test_a_folder_without_pictures_is_said(tmp_path):
    with pytest.raises(CameraError, match="no pictures in"):
        camera(str(tmp_path))


def test_a_device_that_is_missing_forbidden_or_no_camera_is_told_apart(tmp_path, monkeypatch):
    with pytest.raises(CameraError, match=r"no camera at /dev/video999.*plug it in"):
        open_device(999, None)
    other = tmp_path / "video3"
    other.write_text("")
    with pytest.raises(CameraError, match="another program may use it"):
        open_device(str(other), None)
    monkeypatch.setattr("os.access", lambda *_: False)
    with pytest.raises(CameraError, match="usermod -aG video"):
        open_device(str(other), None)


# --- light and edges -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("shade", "said"), [(255, "burnt out"), (10, "too dark"), (0, "too dark"), (235, "too bright")]
)
def test_bad_light_is_one_plain_sentence(shade, said):
    assert said in exposure(np.full((40, 40, 3), shade, np.uint8), CameraConfig())


def test_good_light_is_none_and_its_limits_are_configuration():
    half = np.full((40, 40, 3), 120, np.uint8)
    half[:4] = 255
    assert "10% of the picture is burnt out" in exposure(half, CameraConfig())
    assert exposure(half, CameraConfig(burnt=0.2)) is None
    half[:4] = 120
    assert exposure(half, CameraConfig()) is None


def test_a_blurred_picture_is_told():
    u = np.arange(200) - 99.5
    soft = np.tile((40 + 85 * (1 + np.tanh(u / 6))).astype(np.uint8)[:, None], (200, 1, 3))
    assert "focus the lens" in blur(soft, CameraConfig())
    assert blur(soft, CameraConfig(blurred=40)) is None
