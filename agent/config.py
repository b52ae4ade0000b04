"""Configuration: one TOML section into one frozen struct, from five places.

Precedence: command line > environment (``ARMCHAT_BUS__PREFIX``) > ``./armchat.toml`` > the user's
file > the defaults below. A bad key names its file, itself and the nearest key that exists.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec
from platformdirs import user_config_path

from agent.errors import ConfigError
from agent.messages import KeepOut

ENV_PREFIX = "ARMCHAT_"
PROJECT_FILE = "armchat.toml"
LOCAL_ENDPOINT = "tcp/127.0.0.1:7447"
"""Where a chat listens, and where `stop`, `reset` and `say --connect` look first."""


class BusConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[bus]``: how services find each other.

    ``connect``: endpoints of a hub ("tcp/127.0.0.1:7447"). ``listen``: endpoints at which a daemon
    is that hub. Neither: peers find each other on this machine's loopback if ``scout``.
    """

    prefix: str = "armchat"
    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    scout: bool = True


class RobotConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[robot]``: which arm a chat or daemon moves (None: PyBullet where it is installed).

    ``pace`` 1 is real time, 0 as fast as possible. ``speed``: the share of the arm's full speeds
    that it may go at. ``retries``: further tries of what went wrong, in one turn. ``gui``: PyBullet
    in a window. ``keep_outs`` are boxes (table units) that
    no arm enters, whatever the program: ``[{name = "post", x = [0.9, 1.1], y = ..., z = ...}]``.
    """

    kind: Literal["ideal", "bullet", "dobot"] | None = None
    seed: int = 0
    pace: float = 1.0
    speed: Annotated[float, msgspec.Meta(gt=0, le=1)] = 1.0
    retries: Annotated[int, msgspec.Meta(ge=0, le=10)] = 2
    gui: bool = False
    keep_outs: tuple[KeepOut, ...] = ()


class DobotConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[dobot]``: a Dobot Magician and how it stands at the table (millimetres, seconds).

    ``port``: its serial port (None: the only one that looks like a Dobot's). ``scale``: mm per
    table unit. ``offset``: x and y that the arm reads over the table's middle, ``floor`` its z when
    the cup touches the table, ``turn`` how far the table is turned against the arm (degrees,
    counter-clockwise; 0: the arm looks along the table's y). ``calibration``: the file of
    `armchat calibrate robot`, which outranks these four (None: that in the data folder, if any;
    "none": no file). ``tool``: from the wrist's axis to the tool's (59.7 for the suction
    cup). ``speed`` at most 300 mm/s, ``acceleration`` at most 400 mm/s².
    """

    port: str | None = None
    scale: float = 75.0
    offset: tuple[float, float] = (240.0, 0.0)
    floor: float = -68.0
    turn: float = 0.0
    calibration: str | None = None
    tool: float = 59.7
    speed: float = 100.0
    acceleration: float = 80.0

    def __post_init__(self) -> None:
        ranges = {
            "scale": (10.0, 300.0), "floor": (-150.0, 100.0), "tool": (0.0, 150.0),
            "turn": (-180.0, 180.0), "speed": (1.0, 300.0), "acceleration": (1.0, 400.0),
        }  # fmt: skip
        for name, (low, high) in ranges.items():
            if not low <= getattr(self, name) <= high:
                raise ValueError(f"{name} must be in [{low:g}, {high:g}]")
        if not all(-400.0 <= value <= 400.0 for value in self.offset):
            raise ValueError("offset must lie within 400 mm of the arm's axis")

    def slowed(self, share: float) -> DobotConfig:
        """This arm at a share of its configured speed. Raises ConfigError below 1 mm/s."""
        try:
            return msgspec.structs.replace(self, speed=self.speed * share)
        except ValueError as error:
            raise ConfigError(f"{100 * share:g} % of {self.speed:g} mm/s: {error}") from error


class CameraConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[camera]``: the camera over the table, the table's size, and what is good enough.

    ``source``: "0" or "/dev/video0" (a device), "clip.mp4", "pictures/". ``size``: width and height
    that a device is asked for. ``table``: the table's side (mm); ``marker`` that of the four in its
    corners, whose outer corners lie ``inset`` mm inside the table's (negative: outside).
    ``burnt``, ``black``: shares of a picture that may be so; its mean brightness lies between
    ``darkest`` and ``brightest`` (of 255). ``blurred``: pixels an edge may be wide. ``folder``:
    where calibrations are kept (None: the user's data folder).
    """

    source: str | int = "0"
    size: tuple[int, int] = (1280, 960)
    table: float = 400.0
    marker: float = 50.0
    inset: float = 0.0
    burnt: float = 0.05
    black: float = 0.5
    darkest: float = 35.0
    brightest: float = 225.0
    blurred: float = 7.0
    folder: str | None = None

    def __post_init__(self) -> None:
        ranges = {
            "table": (50.0, 3000.0), "marker": (10.0, 500.0), "inset": (-1000.0, 1000.0),
            "burnt": (0.0, 1.0), "black": (0.0, 1.0), "darkest": (0.0, 255.0),
            "brightest": (0.0, 255.0), "blurred": (2.0, 50.0),
        }  # fmt: skip
        for name, (low, high) in ranges.items():
            if not low <= getattr(self, name) <= high:
                raise ValueError(f"{name} must be in [{low:g}, {high:g}]")
        if not all(16 <= side <= 10000 for side in self.size):
            raise ValueError("size must be [width, height] in pixels")
        if 2 * (self.inset + self.marker) > self.table:
            raise ValueError("four markers of this size do not fit on the table")


class SceneConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[scene]``: the file of what stands on a simulated table (None: the kitchen table), and how
    the table is seen.

    ``source``: "world" (a simulated arm's own table, without error), "sim" (its overhead camera's
    pictures, ``size`` pixels) or "camera" (`CameraConfig`). ``looks``: pictures a second that are
    looked at; ``pictures``: that are told on the bus.
    """

    file: str | None = None
    source: Literal["world", "sim", "camera"] = "world"
    size: tuple[int, int] = (480, 360)
    looks: Annotated[float, msgspec.Meta(gt=0, le=100)] = 10.0
    pictures: Annotated[float, msgspec.Meta(gt=0, le=100)] = 2.0

    def __post_init__(self) -> None:
        if not all(16 <= side <= 4096 for side in self.size):
            raise ValueError("size must be [width, height], 16 to 4096 pixels each")


class TranslatorConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[translator]``: what turns sentences into programs.

    ``model``: "seq2seq" (None: this), "pretrained", "cascade" (both: the second where the first is
    unsure), or the folder of a seq2seq model. ``base``: the pretrained model, by its name
    (`armchat models ls`) or folder; ``adapter``: the folder of what it learnt (None: ours for
    gemma3-270m; "none": it is shown examples instead).
    """

    model: str | None = None
    base: str = "gemma3-270m"
    adapter: str | None = None


class TuiConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """``[tui]``: the theme's name; None: by NO_COLOR and the terminal.

    ``preview``: show and hold each program before it runs; None: where the arm is real.
    """

    theme: str | None = None
    preview: bool | None = None


class Config(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All sections."""

    bus: BusConfig = BusConfig()
    robot: RobotConfig = RobotConfig()
    dobot: DobotConfig = DobotConfig()
    camera: CameraConfig = CameraConfig()
    scene: SceneConfig = SceneConfig()
    translator: TranslatorConfig = TranslatorConfig()
    tui: TuiConfig = TuiConfig()


Tree = dict[str, dict[str, Any]]


def load(
    command_line: Mapping[str, Any] | None = None,
    environ: Mapping[str, str] | None = None,
    project: Path | None = None,
    user: Path | None = None,
) -> Config:
    """The configuration in force; ``command_line`` maps "bus.prefix" to a value (None: not given).

    Raises ConfigError that names where, which key, and the nearest key.
    """
    merged: Tree = {}
    for where, tree in _sources(
        command_line or {},
        os.environ if environ is None else environ,
        project or Path(PROJECT_FILE),
        user or user_config_path("armchat") / "config.toml",
    ):
        _check_names(where, tree)
        _convert(where, tree)
        for section, values in tree.items():
            merged.setdefault(section, {}).update(values)
    return _convert("configuration", merged)


def _sources(
    command_line: Mapping[str, Any], environ: Mapping[str, str], project: Path, user: Path
) -> Iterator[tuple[str, Tree]]:
    """Weakest first."""
    for path in (user, project):
        if path.is_file():
            yield str(path), read(path)
    yield "environment", from_environ(environ)
    given = {key: value for key, value in command_line.items() if value is not None}
    yield "command line", _nested(given)


def read(path: Path) -> Tree:
    """The sections of a TOML file. Raises ConfigError with the file's name."""
    try:
        tree = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ConfigError(f"{path}: {error}") from error
    for section, values in tree.items():
        if not isinstance(values, dict):
            raise ConfigError(f"{path}: {section!r} must stand in a [section]")
    return tree


def from_environ(environ: Mapping[str, str]) -> Tree:
    """``ARMCHAT_BUS__CONNECT=tcp/…`` as bus.connect; values are TOML, else text."""
    found = {
        name.removeprefix(ENV_PREFIX).lower().replace("__", ".", 1): _value(text)
        for name, text in environ.items()
        if name.startswith(ENV_PREFIX) and "__" in name
    }
    return _nested(found)


def _value(text: str) -> Any:  # noqa: ANN401 - whatever TOML says
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def _nested(flat: Mapping[str, Any]) -> Tree:
    tree: Tree = {}
    for name, value in flat.items():
        section, _, key = name.partition(".")
        tree.setdefault(section, {})[key] = value
    return tree


def _check_names(where: str, tree: Tree) -> None:
    sections = {field.name: field.type for field in msgspec.structs.fields(Config)}
    for section, values in tree.items():
        if section not in sections:
            raise ConfigError(f"{where}: no section [{section}]{_nearest(section, sections)}")
        known = [field.name for field in msgspec.structs.fields(sections[section])]
        for key in values:
            if key not in known:
                near = _nearest(key, known, f"{section}.")
                raise ConfigError(f"{where}: no key {section}.{key}{near}")


def _nearest(name: str, known: Mapping[str, Any] | list[str], prefix: str = "") -> str:
    close = get_close_matches(name, list(known), n=1, cutoff=0.4)
    return f"; did you mean {prefix}{close[0]}?" if close else f"; known: {', '.join(known)}"


def _convert(where: str, tree: Tree) -> Config:
    lists = {"listen", "connect"}
    ready = {
        section: {
            key: [value] if key in lists and isinstance(value, str) else value
            for key, value in values.items()
        }
        for section, values in tree.items()
    }
    try:
        return msgspec.convert(ready, Config)
    except msgspec.ValidationError as error:
        raise ConfigError(f"{where}: {error}") from error
