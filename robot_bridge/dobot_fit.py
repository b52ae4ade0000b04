"""Where a Dobot stands by its calibration, which outranks what is configured."""

from __future__ import annotations

from pathlib import Path

import msgspec

from agent.config import DobotConfig
from agent.errors import CalibrationError
from scene import calibration

CONFIGURED = "none"
"""The name of no file: the arm stands as configured."""


def fitted(config: DobotConfig, folder: str | None = None) -> DobotConfig:
    """The arm as `armchat calibrate robot` found it to stand; as configured where it did not.

    ``folder``: that of [camera]. Raises CalibrationError where a file that is named, or is there,
    cannot be used.
    """
    if config.calibration == CONFIGURED:
        return config
    where = Path(config.calibration).expanduser() if config.calibration else None
    file = calibration.path(calibration.Standing, where or calibration.folder(folder))
    if where is None and not file.exists():
        return config
    stands = calibration.load(calibration.Standing, file)
    try:
        return msgspec.structs.replace(
            config, scale=stands.scale, offset=stands.offset, floor=stands.floor,
            turn=stands.turn, calibration=CONFIGURED,
        )  # fmt: skip
    except ValueError as error:
        raise CalibrationError(f"{file}: {error}: run `armchat calibrate robot` again") from error
