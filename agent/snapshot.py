"""`armchat scene snapshot`: a scene at rest on the table with physics, as JSON and as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TextIO

import msgspec

from agent.compose import scene_from
from agent.errors import ConfigError


def snapshot(
    scene: str | None, seed: int, picture: str | None, size: tuple[int, int], out: TextIO
) -> int:
    """Print the scene object; with ``picture`` write what the overhead camera sees, W x H pixels.

    Raises ConfigError where PyBullet is not installed or the file cannot be written.
    """
    from robot_bridge.bullet import BulletRobot
    from robot_bridge.png import png

    if min(size) < 16 or max(size) > 4096:
        raise ConfigError(f"--size must be 16 to 4096 pixels each way, not {size[0]} x {size[1]}")
    robot = BulletRobot(scene_from(scene), seed)
    try:
        if picture is not None:
            Path(picture).write_bytes(png(robot.picture(*size)))
        out.write(msgspec.json.encode(robot.scene()).decode() + "\n")
    except OSError as error:
        raise ConfigError(f"cannot write {picture}: {error.strerror}") from error
    finally:
        robot.close()
    return 0
