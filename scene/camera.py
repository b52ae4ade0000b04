"""Cameras behind `scene.sight.Camera`: a USB device, a video file, a folder of pictures.

A device is read on a thread of its own, begun by `start` (or ``with``), so that `look` gives the
newest frame and not the oldest of a queue. A device that is pulled out is looked for until it is
back. Files are read as they are looked at; a frame's time is when it was read, as if a camera had
shown it then.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Protocol, Self

from agent.errors import CameraError
from scene import opencv
from scene.sight import Camera, Picture, Pixels

PICTURES = frozenset({".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".webp"})
PATIENCE = 5.0
"""Seconds in which a device that was just opened must show something."""
STALE = 2.0
"""Seconds after which a frame is no longer what the camera sees."""
RETRY = 0.5
"""Seconds between two looks for a device that is away."""


class Frames(Protocol):
    """An open source of frames (`scene.opencv.Capture`)."""

    def read(self) -> Pixels | None:
        """The next frame, waited for; None where there is none any more."""
        ...

    def release(self) -> None:
        """Give it back."""
        ...


class Ended(CameraError):
    """A file or folder has been shown to its end."""


class UsbCamera:
    """A device by number or path. Thread-safe. ``make`` opens it, and raises CameraError."""

    def __init__(
        self, device: int | str, size: tuple[int, int] | None = None, *,
        make: Callable[[], Frames] | None = None, clock: Callable[[], float] = time.time,
        patience: float = PATIENCE, retry: float = RETRY,
    ) -> None:  # fmt: skip
        self._device = device
        self._make = make or (lambda: open_device(device, size))
        self._clock = clock
        self._patience, self._retry = patience, retry
        self._over = threading.Event()
        self._news = threading.Condition()
        self._newest: Picture | None = None
        self._trouble: str | None = None
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Begin to read the device, once; returns at once."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._read, name="camera", daemon=True)
            self._thread.start()

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def look(self) -> Picture:
        """The newest frame; waits for the first one. Raises CameraError while the device is away,
        or shows nothing."""
        if self._thread is None:
            raise CameraError(f"camera {self._device} is not started")
        with self._news:
            self._news.wait_for(self._settled, self._patience)
            if self._over.is_set():
                raise CameraError(f"camera {self._device} is closed")
            if self._trouble is not None:
                raise CameraError(self._trouble)
            if self._newest is None or self._clock() - self._newest.t > STALE:
                raise CameraError(
                    f"camera {self._device} shows nothing: unplug it and plug it in again"
                )
            return self._newest

    def fresh(self, after: float) -> Picture:
        """The first frame later than a time; waits for it. Raises as `look` does."""
        with self._news:
            self._news.wait_for(
                lambda: self._settled() and not (self._newest and self._newest.t <= after),
                self._patience,
            )
        return self.look()

    def _settled(self) -> bool:
        return self._over.is_set() or self._trouble is not None or self._newest is not None

    def close(self) -> None:
        """Stop reading; the thread gives the device back as soon as its frame is read."""
        self._over.set()
        with self._news:
            self._news.notify_all()

    def _read(self) -> None:
        while not self._over.is_set():
            try:
                frames = self._make()
            except CameraError as error:
                self._tell(None, str(error))
            else:
                try:
                    self._follow(frames)
                finally:
                    frames.release()
            self._over.wait(self._retry)

    def _follow(self, frames: Frames) -> None:
        """Every frame until there is none any more."""
        while not self._over.is_set():
            pixels = frames.read()
            if pixels is None:
                self._tell(
                    None, f"camera {self._device} is gone: plug it in again, it is looked for"
                )
                return
            self._tell(Picture(pixels, self._clock()), None)

    def _tell(self, picture: Picture | None, trouble: str | None) -> None:
        with self._news:
            self._newest, self._trouble = picture, trouble
            self._news.notify_all()


def open_device(device: int | str, size: tuple[int, int] | None) -> opencv.Capture:
    """Raises CameraError that says whether it is missing, forbidden or used by another."""
    path = Path(f"/dev/video{device}" if isinstance(device, int) else device)
    if not path.exists():
        raise CameraError(f"no camera at {path}: plug it in; `ls /dev/video*` lists what is there")
    if not os.access(path, os.R_OK | os.W_OK):
        raise CameraError(
            f"{path} may not be opened: `sudo usermod -aG video $USER`, then log in again"
        )
    try:
        return opencv.Capture(device, size)
    except CameraError as error:
        raise CameraError(
            f"{path} gives no pictures: another program may use it, or it is no camera but the "
            "second device of one (try the next number)"
        ) from error


class VideoCamera:
    """A video file: each look is its next frame. ``loop``: from the start again, else `Ended`."""

    def __init__(
        self, path: Path, loop: bool = False, clock: Callable[[], float] = time.time
    ) -> None:
        self._path, self._loop, self._clock = path, loop, clock
        self._shown = 0
        self._frames: opencv.Capture | None = self._opened()

    def _opened(self) -> opencv.Capture:
        if not self._path.is_file():
            raise CameraError(f"no such file: {self._path}")
        try:
            return opencv.Capture(str(self._path.absolute()))
        except CameraError as error:
            raise CameraError(f"{self._path} is not a video that can be read") from error

    def look(self) -> Picture:
        """The next frame. Raises CameraError; Ended at the end."""
        if self._frames is None:
            raise CameraError(f"{self._path} is closed")
        pixels = self._frames.read()
        if pixels is None and self._loop and self._shown:
            self._frames.release()
            self._frames = self._opened()
            pixels = self._frames.read()
        if pixels is None:
            raise Ended(f"{self._path} has ended after {self._shown} frames")
        self._shown += 1
        return Picture(pixels, self._clock())

    def close(self) -> None:
        """Give the file back."""
        if self._frames is not None:
            self._frames.release()
        self._frames = None


class FolderCamera:
    """A folder's pictures by name, or one picture. ``loop``: from the start again, else `Ended`."""

    def __init__(
        self, path: Path, loop: bool = False, clock: Callable[[], float] = time.time
    ) -> None:
        self._path, self._loop, self._clock = path, loop, clock
        self._files = pictures_in(path)
        self._next = 0

    def look(self) -> Picture:
        """The next picture. Raises CameraError with the name of one that cannot be read."""
        if self._next == len(self._files):
            if not self._loop:
                raise Ended(f"{self._path} has ended after {len(self._files)} pictures")
            self._next = 0
        self._next += 1
        return Picture(opencv.read_picture(self._files[self._next - 1]), self._clock())

    def close(self) -> None:
        """Nothing is open between two looks."""


def pictures_in(path: Path) -> list[Path]:
    """The picture files of a folder, by name; or the one file. Raises CameraError if none."""
    if path.is_file():
        return [path]
    found = sorted(one for one in path.glob("*") if one.suffix.lower() in PICTURES)
    if not found:
        raise CameraError(f"no pictures in {path} ({', '.join(sorted(PICTURES))})")
    return found


def camera(
    source: str, size: tuple[int, int] | None = None, *, loop: bool = False
) -> UsbCamera | VideoCamera | FolderCamera:
    """The camera that a configuration's text names; a device has still to be started.

    "0" and "/dev/video0" are devices, "clip.mp4" a video, "pictures/" a folder (or one picture
    file). ``size``: what a device is asked for. ``loop``: files begin again. Raises CameraError,
    and ConfigError where OpenCV is not installed.
    """
    opencv.loaded()  # a device's thread could not say that it is missing
    if source.isdecimal():
        return UsbCamera(int(source), size)
    if source.startswith("/dev/"):
        return UsbCamera(source, size)
    path = Path(source).expanduser()
    if path.is_dir() or path.suffix.lower() in PICTURES:
        if not path.exists():
            raise CameraError(f"no such file: {path}")
        return FolderCamera(path, loop)
    return VideoCamera(path, loop)


def frames(source: Camera) -> Iterator[Picture]:
    """Picture after picture, each once, to the end of a file; a device has none.

    Raises CameraError.
    """
    with suppress(Ended):
        picture = source.look()
        while True:
            yield picture
            after = picture.t
            picture = source.fresh(after) if isinstance(source, UsbCamera) else source.look()
