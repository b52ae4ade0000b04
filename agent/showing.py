"""`armchat scene learn NAME` and `forget NAME`: things that the eye was shown by a person."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, TextIO

from agent.errors import CameraError, SceneError

if TYPE_CHECKING:
    from scene.eye import Eye
    from scene.shown import ShownStore
    from scene.sight import Camera, Detection

VIEWS = 6
"""Pictures of a thing, by default."""
BETWEEN = 1.5
"""Seconds between two of them, in which the thing is turned or moved by hand."""


def add_showing(whats: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """`learn` and `forget` of `armchat scene`."""
    learn_ = whats.add_parser("learn", help="show the eye a thing, alone on the table, and name it")
    learn_.add_argument("name", help='e.g. "widget"')
    learn_.add_argument("--source", metavar="SOURCE", help="a calibrated camera, video, pictures/")
    learn_.add_argument("--views", type=int, default=VIEWS, metavar="N", help=f"default: {VIEWS}")
    learn_.set_defaults(act=_learn)
    forget = whats.add_parser("forget", help="forget what was shown under a name")
    forget.add_argument("name")
    forget.set_defaults(act=_forget)


def _learn(arguments: argparse.Namespace) -> int:
    from agent.config import load
    from agent.eyes import calibrated
    from scene.shown import ShownStore

    config = load({"camera.source": arguments.source}).camera
    camera, eye = calibrated(config)
    try:
        learn(camera, eye, arguments.name, arguments.views, ShownStore(), sys.stderr)
    finally:
        camera.close()
    sys.stdout.write(f"The eye knows {arguments.name} now.\n")
    return 0


def _forget(arguments: argparse.Namespace) -> int:
    from scene.shown import ShownStore

    ShownStore().forget(arguments.name)
    sys.stdout.write(f"The eye has forgotten {arguments.name}.\n")
    return 0


def learn(
    camera: Camera, eye: Eye, name: str, views: int, store: ShownStore, out: TextIO,
    wait: Callable[[float], None] = time.sleep,
) -> None:  # fmt: skip
    """Keep so many views of the one thing on the table under a name; told to ``out``.

    Nothing is kept unless all pictures show one thing. Raises SceneError where one shows none or
    several, or fewer than one is asked for; CameraError without a picture.
    """
    if views < 1:
        raise SceneError(f"to learn a thing, at least one view is needed, not {views}")
    seen: list[Detection] = []
    for number in range(1, views + 1):
        try:
            picture = camera.look()
        except CameraError:
            if not seen:
                raise
            break  # a folder or a video has ended: what it showed has to do
        seen.append(_alone(eye.detect(picture), number))
        out.write(f"picture {number} of {views}: turn it a little, or move it\n")
        if number < views:
            wait(BETWEEN)
    store.learn(name, seen)


def _alone(found: tuple[Detection, ...], number: int) -> Detection:
    """The one thing in a picture."""
    if len(found) != 1:
        many = "nothing" if not found else f"{len(found)} things"
        raise SceneError(f"picture {number} shows {many}: put the one thing alone on the table")
    return found[0]
