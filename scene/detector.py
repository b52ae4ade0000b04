"""What stands on the table, found in a picture by a small network (onnxruntime, one thread).

The picture is rectified to the table at the scale stored with the weights, so one set of weights
serves any camera; the network gives the footprint's centre on the table, not the middle of a box
in the picture (design: robot.md section 6). Weights: ``weights/CARD.md``.
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from agent.errors import ConfigError
from scene.peaks import OTHER, Peak, peaks
from scene.rectify import Grid, planes, rectified
from scene.sight import Detection, Picture, Pixels, View

STRIDE = 4
"""Pixels a side of a cell of the network's maps."""
WEIGHTS = "weights/detector.onnx"


class NetDetector:
    """A `scene.sight.Detector`. ``table_m``: the side of the table in metres (two table units).

    Raises ConfigError where the weights cannot be read.
    """

    def __init__(self, table_m: float = 0.40, weights: Path | None = None) -> None:
        path = weights or Path(str(files("scene") / WEIGHTS))
        self._session, facts = _loaded(path)
        self.grid = Grid(int(facts["size"]), float(facts["mm"]), table_m)
        self.names = tuple(facts["names"].split())
        self.colors = tuple(facts["colors"].split())
        self.spread = float(facts["spread"])

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """All things seen in an undistorted picture, surest first."""
        level = rectified(picture.pixels, view, self.grid)
        return self.read(level, view.camera)

    def read(self, level: Pixels, camera: tuple[float, float, float]) -> tuple[Detection, ...]:
        """All things in a picture that is rectified to `grid` already, surest first."""
        maps = self.maps(level, camera)
        found = peaks(maps, STRIDE * self.grid.pixel, self.names.index(OTHER))
        return tuple(self._detection(peak, maps, level) for peak in found)

    def maps(
        self, level: Pixels, camera: tuple[float, float, float]
    ) -> dict[str, NDArray[np.float32]]:
        """What the network says of each cell, by output: (channels, size / 4, size / 4)."""
        outputs = [one.name for one in self._session.get_outputs()]
        given = self._session.run(outputs, {"planes": planes(level, camera, self.grid)[None]})
        return {name: value[0] for name, value in zip(outputs, given, strict=True)}

    def _detection(
        self, peak: Peak, maps: dict[str, NDArray[np.float32]], level: Pixels
    ) -> Detection:
        feature = maps["feature"][:, peak.v, peak.u]
        return Detection(
            name=self.names[peak.kind],
            score=peak.score,
            x=peak.x,
            y=peak.y,
            sd=self.spread * peak.error,
            width=peak.width,
            height=peak.height,
            tall=peak.tall,
            r=peak.r,
            color=self.colors[int(maps["color"][:, peak.v, peak.u].argmax())],
            feature=feature / max(float(np.linalg.norm(feature)), 1e-9),
        )


@functools.lru_cache(maxsize=2)
def _loaded(path: Path) -> tuple[Any, dict[str, str]]:
    """A session with one thread (more are slower on busy cores), and the file's metadata."""
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 3
    try:
        session = onnxruntime.InferenceSession(str(path), options, ["CPUExecutionProvider"])
    except Exception as error:
        raise ConfigError(f"the detector's weights: {path}: {error}") from error
    return session, dict(session.get_modelmeta().custom_metadata_map)
