"""The overhead camera of a simulated robot, looked through over the bus (`scene.sight.Camera`)."""

from __future__ import annotations

import msgspec
import numpy as np

from agent.bus import Bus
from agent.errors import BusError, CameraError
from agent.messages import PictureInfo
from scene.sight import Picture

TIMEOUT = 10.0
"""Seconds that a picture may take: it is drawn when it is asked for."""


class BusCamera:
    """Asks the bridge of ``robot`` for each picture."""

    def __init__(self, bus: Bus, robot: str = "r1", timeout: float = TIMEOUT) -> None:
        self._bus, self._robot, self._timeout = bus, robot, timeout

    def look(self) -> Picture:
        """See `scene.sight.Camera`."""
        try:
            key = self._bus.keys.picture(self._robot)
            data, metadata = self._bus.ask_raw(key, self._timeout)
            return unpacked(data, msgspec.json.decode(metadata, type=PictureInfo))
        except (BusError, msgspec.DecodeError) as error:
            raise CameraError(
                f"robot {self._robot!r} shows no picture ({error}): only the PyBullet arm has a "
                "camera; start `armchat daemon robot --robot bullet`"
            ) from error

    def close(self) -> None:
        """See `scene.sight.Camera`: the bus is closed by who opened it."""


def unpacked(data: bytes, info: PictureInfo) -> Picture:
    """A raw picture of the bus as a Picture. Raises CameraError where the sizes do not fit."""
    if info.format != "rgb" or len(data) != 3 * info.width * info.height:
        raise CameraError(f"{len(data)} bytes are no {info.width} x {info.height} RGB picture")
    pixels = np.frombuffer(data, np.uint8).reshape(info.height, info.width, 3)
    return Picture(pixels, info.t)
