"""OpenCV behind typed functions: the only file of the product that imports it, and only when used.

Pictures go in and come out as RGB, points as (n, 2) float64 in pixels by the convention of
`scene.sight`, which is OpenCV's own: the centre of the first pixel is (0, 0). One thread, since
several on a busy machine wait for each other. Source: OpenCV 5, `cv2/__init__.pyi`.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agent.errors import CalibrationError, CameraError, ConfigError
from scene.sight import Pixels, Points

if TYPE_CHECKING:
    import cv2

Gray = NDArray[np.uint8]
Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]


class Board(NamedTuple):
    """A ChArUco board: squares across and down, the sides of a square and of a marker (mm)."""

    across: int
    down: int
    square: float
    marker: float


class LensFit(NamedTuple):
    """What `calibrate` found; errors in pixels.

    ``matrix`` (3, 3), ``distortion`` (5,): k1 k2 p1 p2 k3. ``errors`` (n,): each picture's
    root-mean-square. ``distances`` (n,): from the camera to the board's middle, in its own unit.
    ``spread`` (4,): the standard deviations of fx, fy, cx, cy.
    """

    matrix: Points
    distortion: Points
    errors: Points
    distances: Points
    spread: Points


class Pose(NamedTuple):
    """Where a plane stands before the camera: ``x_camera = rotation @ x_plane + translation``."""

    rotation: Points
    translation: Points

    @property
    def centre(self) -> Points:
        """The camera's own place in the plane's frame (3,)."""
        return np.asarray(-self.rotation.T @ self.translation, np.float64)


@lru_cache(maxsize=1)
def loaded() -> ModuleType:
    """OpenCV, one-threaded and silent. Raises ConfigError where it is not installed."""
    try:
        import cv2
    except ImportError as error:
        raise ConfigError(
            "cameras need: pip install 'armchat[camera]' (opencv-python-headless)"
        ) from error
    cv2.setNumThreads(1)
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    return cv2


@contextlib.contextmanager
def _calibrating(what: str) -> Iterator[ModuleType]:
    """OpenCV, whose own exceptions become a CalibrationError that says what could not be done."""
    cv = loaded()
    try:
        yield cv
    except cv.error as error:
        raise CalibrationError(f"{what}: {error.err or error}") from error


# --- pictures in and out ---------------------------------------------------------------------


class Capture:
    """An open device or video file."""

    def __init__(self, source: int | str, size: tuple[int, int] | None = None) -> None:
        """Open it. A device (number, or path below /dev) is asked for ``size`` (width, height), and
        to keep its focus, by which the lens is calibrated. Raises CameraError."""
        cv = loaded()
        device = isinstance(source, int) or source.startswith("/dev/")
        self._capture: cv2.VideoCapture = cv.VideoCapture(
            source, cv.CAP_V4L2 if device else cv.CAP_FFMPEG
        )
        if not self._capture.isOpened():
            raise CameraError(f"{source} does not open")
        if device:
            self._capture.set(cv.CAP_PROP_BUFFERSIZE, 1)
            self._capture.set(cv.CAP_PROP_AUTOFOCUS, 0)
            self._capture.set(cv.CAP_PROP_FOURCC, cv.VideoWriter.fourcc(*"MJPG"))
        if size is not None:
            self._capture.set(cv.CAP_PROP_FRAME_WIDTH, size[0])
            self._capture.set(cv.CAP_PROP_FRAME_HEIGHT, size[1])

    def read(self) -> Pixels | None:
        """The next frame, or None where there is none any more."""
        try:
            got, pixels = self._capture.read()
        except loaded().error:  # what some devices answer with when they are pulled out
            return None
        return _swapped(np.asarray(pixels, np.uint8)) if got else None

    def release(self) -> None:
        """Give the device back."""
        self._capture.release()


def read_picture(path: Path) -> Pixels:
    """A picture file as RGB. Raises CameraError."""
    try:
        return decode(path.read_bytes())
    except OSError as error:
        raise CameraError(f"{path}: {error.strerror or error}") from error
    except CameraError as error:
        raise CameraError(f"{path}: {error}") from error


def decode(data: bytes) -> Pixels:
    """A JPEG or PNG file's bytes as RGB. Raises CameraError where it is no picture."""
    cv = loaded()
    try:
        pixels = cv.imdecode(np.frombuffer(data, np.uint8), cv.IMREAD_COLOR_RGB)
    except cv.error:  # what it says of an empty buffer
        pixels = None
    if pixels is None:
        raise CameraError("not a picture that can be read")
    return np.asarray(pixels, np.uint8)


def jpeg(pixels: Pixels, quality: int = 85) -> bytes:
    """An RGB picture as a JPEG file."""
    cv = loaded()
    return bytes(cv.imencode(".jpg", _swapped(pixels), [cv.IMWRITE_JPEG_QUALITY, quality])[1])


def png(pixels: Pixels | Gray) -> bytes:
    """An RGB picture, or a grey one (height, width), as a PNG file."""
    return bytes(loaded().imencode(".png", _swapped(pixels) if pixels.ndim == 3 else pixels)[1])


def _swapped(pixels: Pixels) -> Pixels:
    return np.ascontiguousarray(pixels[:, :, ::-1])


def gray(pixels: Pixels) -> Gray:
    """Brightness (height, width)."""
    cv = loaded()
    return np.asarray(cv.cvtColor(pixels, cv.COLOR_RGB2GRAY), np.uint8)


def write(picture: Gray, text: str, at: tuple[int, int], high: int) -> None:
    """Write black text into a grey picture: its lower left corner (pixels), ``high`` pixels."""
    cv = loaded()
    font, bold = cv.FONT_HERSHEY_SIMPLEX, max(1, high // 10)
    cv.putText(picture, text, at, font, high / 22, 0, bold, cv.LINE_AA)


# --- geometry of pictures --------------------------------------------------------------------


def undistorter(
    matrix: Points, distortion: Points, size: tuple[int, int]
) -> Callable[[Pixels], Pixels]:
    """What takes a lens's curvature out of pictures of ``size`` (width, height); the matrix stays.

    The maps are made once, here. What the lens did not see is black.
    """
    cv = loaded()
    maps = cv.initUndistortRectifyMap(matrix, distortion, None, matrix, size, cv.CV_16SC2)

    def undistort(pixels: Pixels) -> Pixels:
        return np.asarray(cv.remap(pixels, *maps, cv.INTER_LINEAR), np.uint8)

    return undistort


def undistort_points(points: Points, matrix: Points, distortion: Points) -> Points:
    """Pixels (n, 2) of a picture as pixels of the undistorted one."""
    cv = loaded()
    done = (cv.TERM_CRITERIA_EPS | cv.TERM_CRITERIA_COUNT, 50, 1e-9)
    flat = cv.undistortPoints(
        np.asarray(points, np.float64).reshape(-1, 1, 2), matrix, distortion, P=matrix,
        criteria=done,
    )  # fmt: skip
    return np.asarray(flat, np.float64).reshape(-1, 2)


def warp(pixels: Pixels, homography: Points, size: tuple[int, int]) -> Pixels:
    """The picture of ``size`` (width, height) whose pixel p shows ``pixels`` at the mapped p."""
    cv = loaded()
    flags = cv.INTER_LINEAR | cv.WARP_INVERSE_MAP
    return np.asarray(cv.warpPerspective(pixels, homography, size, flags=flags), np.uint8)


def resize(pixels: Pixels, size: tuple[int, int]) -> Pixels:
    """The whole picture at another size (width, height): outer borders meet, so a point at u lies
    at ``(u + 0.5) * new / old - 0.5``. Shrunk by area."""
    cv = loaded()
    shrinks = size[0] < pixels.shape[1]
    way = cv.INTER_AREA if shrinks else cv.INTER_LINEAR
    return np.asarray(cv.resize(pixels, size, interpolation=way), np.uint8)


def edge_width(brightness: Gray) -> float:
    """How many pixels the strongest edges take from dark to bright: about 2 where sharp.

    A Gaussian blur of s pixels makes it 2.5 s. 0 where the picture has no edge at all.
    """
    cv = loaded()
    smooth = cv.GaussianBlur(brightness, (3, 3), 0).astype(np.float32)  # noise is no edge
    steep = cv.magnitude(*(cv.Sobel(smooth, cv.CV_32F, x, 1 - x, scale=0.125) for x in (1, 0)))
    near = np.ones((21, 21), np.uint8)
    contrast = cv.dilate(smooth, near) - cv.erode(smooth, near)
    strong = contrast >= max(30.0, 0.7 * float(contrast.max()))
    if not strong.any():
        return 0.0
    return float(np.median(contrast[strong] / cv.dilate(steep, near)[strong]))


def boxed(plane: Floats, side: int) -> Floats:
    """The sums of a plane (height, width, ...; float32) over squares of ``side`` pixels, odd."""
    cv = loaded()
    return np.asarray(cv.boxFilter(plane, -1, (side, side), normalize=False), np.float32)


def blurred(plane: Floats, sigma: float) -> Floats:
    """A plane (height, width, ...; float32) blurred by a Gaussian of that deviation (pixels)."""
    return np.asarray(loaded().GaussianBlur(plane, (0, 0), sigma), np.float32)


def blobs(mask: Mask) -> NDArray[np.int32]:
    """For each pixel of a mask the number of the connected piece that it is of, from 1; else 0."""
    return np.asarray(loaded().connectedComponents(mask.astype(np.uint8), connectivity=4)[1])


def filled(mask: Mask) -> Mask:
    """The largest connected piece of a mask, without holes."""
    cv = loaded()
    found, _ = cv.findContours(mask.astype(np.uint8), cv.RETR_EXTERNAL, cv.CHAIN_APPROX_NONE)
    whole = np.zeros(mask.shape, np.uint8)
    if found:
        cv.drawContours(whole, [max(found, key=len)], -1, 1, cv.FILLED)
    return whole > 0


# --- markers and boards ----------------------------------------------------------------------


def _dictionary() -> cv2.aruco.Dictionary:
    cv = loaded()
    dictionary: cv2.aruco.Dictionary = cv.aruco.getPredefinedDictionary(cv.aruco.DICT_4X4_50)
    return dictionary


def _charuco(board: Board) -> cv2.aruco.CharucoBoard:
    size = (board.across, board.down)
    made: cv2.aruco.CharucoBoard = loaded().aruco.CharucoBoard(
        size, board.square, board.marker, _dictionary()
    )
    return made


def draw_marker(number: int, side: int) -> Gray:
    """A marker of 4x4 (DICT_4X4_50) with its black border, ``side`` pixels, a multiple of 6."""
    return np.asarray(loaded().aruco.generateImageMarker(_dictionary(), number, side), np.uint8)


def draw_board(board: Board, square: int) -> Gray:
    """A board without margin, its squares ``square`` pixels."""
    size = (board.across * square, board.down * square)
    return np.asarray(_charuco(board).generateImage(size), np.uint8)


def find_markers(brightness: Gray) -> dict[int, Points]:
    """The corners (4, 2) of each marker seen, by number: clockwise as it was printed, from its
    upper left one. A number that is seen twice is left out."""
    cv = loaded()
    parameters = cv.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv.aruco.CORNER_REFINE_SUBPIX
    detector = cv.aruco.ArucoDetector(_dictionary(), parameters)
    corners, numbers, _ = detector.detectMarkers(brightness)
    seen = [] if numbers is None else [int(number) for number in np.ravel(numbers)]
    return {
        number: np.asarray(four, np.float64).reshape(4, 2)
        for number, four in zip(seen, corners, strict=True)
        if seen.count(number) == 1
    }


def find_board(brightness: Gray, board: Board) -> tuple[Points, Points]:
    """The inner corners seen of a board: their places on it (n, 2; mm, from its upper left corner
    right and down) and in the picture (n, 2)."""
    made = _charuco(board)
    corners, numbers, _, _ = loaded().aruco.CharucoDetector(made).detectBoard(brightness)
    if numbers is None or len(numbers) == 0:
        return np.empty((0, 2)), np.empty((0, 2))
    places = np.asarray(made.getChessboardCorners(), np.float64)[np.ravel(numbers), :2]
    return places, np.asarray(corners, np.float64).reshape(-1, 2)


# --- fits ------------------------------------------------------------------------------------


def calibrate(places: Sequence[Points], seen: Sequence[Points], size: tuple[int, int]) -> LensFit:
    """A lens from flat targets: their points (n, 2) and where each picture shows them (n, 2).

    Raises CalibrationError where they do not determine one.
    """
    flat = [_on_plane(one).astype(np.float32) for one in places]
    shown = [one.astype(np.float32) for one in seen]
    with _calibrating("the lens cannot be computed") as cv:
        start = np.eye(3)
        found: Any = cv.calibrateCameraExtended(
            flat, shown, size, start, np.zeros(5), flags=cv.CALIB_FIX_K3
        )
    _, matrix, distortion, turns, moves, spread, _, errors = found
    middles = [
        cv.Rodrigues(turn)[0] @ target.mean(axis=0) + move.ravel()
        for turn, move, target in zip(turns, moves, flat, strict=True)
    ]
    return LensFit(
        np.asarray(matrix, np.float64), np.ravel(distortion)[:5].astype(np.float64),
        np.ravel(errors).astype(np.float64), np.linalg.norm(middles, axis=1).astype(np.float64),
        np.ravel(spread)[:4].astype(np.float64),
    )  # fmt: skip


def homography(places: Points, pixels: Points, within: float | None = None) -> Points:
    """The (3, 3) that takes places (n, 2) to pixels (n, 2): least squares, or, with ``within``
    pixels, by RANSAC without what lies farther off. Raises CalibrationError."""
    with _calibrating("the table's plane cannot be computed") as cv:
        if within is None:
            found, _ = cv.findHomography(places, pixels, 0)
        else:
            found, _ = cv.findHomography(places, pixels, cv.RANSAC, within, maxIters=5000)
    if found is None:
        raise CalibrationError("the table's plane cannot be computed: the points lie on a line")
    return np.asarray(found, np.float64)


def pose(places: Points, pixels: Points, matrix: Points) -> Pose:
    """Where a plane with the points (n, 2) stands, of which undistorted pixels (n, 2) are seen.

    Raises CalibrationError.
    """
    with _calibrating("the camera's place cannot be computed") as cv:
        good, turn, move = cv.solvePnP(_on_plane(places), pixels, matrix, None)
        if not good:
            raise CalibrationError("the camera's place cannot be computed")
        rotation = cv.Rodrigues(turn)[0]
    return Pose(np.asarray(rotation, np.float64), np.ravel(move).astype(np.float64))


def _on_plane(places: Points) -> Points:
    return np.column_stack((places, np.zeros(len(places)))).astype(np.float64)
