"""`armchat batch`: JSON Lines in, one JSON object a line out, in order, nothing lost."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import AbstractContextManager
from typing import Any, BinaryIO

import msgspec

from agent.errors import ArmchatError, SceneError
from agent.messages import Dialog, Kind, Turn
from agent.turn import Parts, run_turn
from scene.types import Scene, SceneObject, read_scene

PartsFor = Callable[[Scene], AbstractContextManager[Parts]]


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """One line in: a scene, and the person's sentences in order."""

    id: str | int | float | None = None
    scene: Any
    turns: tuple[str, ...]
    task: Kind | None = None


class SceneOut(msgspec.Struct, frozen=True):
    """The scene at the end, as the machine interface prints it."""

    objects: tuple[SceneObject, ...]
    tray: tuple[SceneObject, ...]


class Result(msgspec.Struct, frozen=True, kw_only=True):
    """One line out; ``error`` says why a line could not be played (to its end)."""

    id: str | int | float | None
    turns: tuple[Turn, ...]
    scene: SceneOut | None
    error: str | None


def batch(lines: BinaryIO, out: BinaryIO, parts_for: PartsFor, jobs: int = 1) -> int:
    """Play every line; the exit status: 0 if every line was answered, 1 if any had an error."""
    status = 0
    with ThreadPoolExecutor(max_workers=max(1, jobs)) as pool:
        for result in _in_order(pool, (line for line in lines if line.strip()), parts_for, jobs):
            status |= int(result.error is not None)
            out.write(msgspec.json.encode(result) + b"\n")
            out.flush()
    return status


def _in_order(
    pool: ThreadPoolExecutor, lines: Iterable[bytes], parts_for: PartsFor, jobs: int
) -> Iterator[Result]:
    """Results in the order of the lines, with at most ``2 * jobs`` lines read ahead."""
    waiting: list[Future[Result]] = []
    for line in lines:
        waiting.append(pool.submit(play, line, parts_for))
        # one job answers each line before it reads the next, as a dialogue partner needs
        while waiting and (jobs == 1 or len(waiting) >= 2 * jobs):
            yield waiting.pop(0).result()
    for future in waiting:
        yield future.result()


def play(raw: bytes, parts_for: PartsFor) -> Result:
    """One line from text to result; what goes wrong is in ``error``, and what was done stays."""
    identity: str | int | float | None = None
    turns: list[Turn] = []
    scene: Scene | None = None
    try:
        data = msgspec.json.decode(raw)
        if isinstance(data, dict) and isinstance(data.get("id"), str | int | float):
            identity = data["id"]
        line = msgspec.convert(data, Line)
        scene = read_scene(line.scene)
        with parts_for(scene) as parts:
            dialog = Dialog()
            for say in line.turns:
                turn, dialog = run_turn(say, dialog, parts, task=line.task)
                turns.append(turn)
                scene = parts.arm.scene()
    except msgspec.DecodeError as error:
        return _result(identity, turns, scene, f"not a valid line: {error}")
    except SceneError as error:
        return _result(identity, turns, scene, str(error))
    except ArmchatError as error:
        return _result(identity, turns, scene, f"{type(error).__name__}: {error}")
    except Exception as error:  # the run goes on: one line's fault must not lose the others
        traceback.print_exc(file=sys.stderr)
        return _result(identity, turns, scene, f"internal error: {type(error).__name__}: {error}")
    return _result(identity, turns, scene, None)


def _result(
    identity: str | int | float | None, turns: list[Turn], scene: Scene | None, error: str | None
) -> Result:
    seen = None if scene is None else SceneOut(scene.objects, scene.tray)
    return Result(id=identity, turns=tuple(turns), scene=seen, error=error)
