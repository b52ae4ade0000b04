"""`say`, `run` and `check`: one turn, one program, from the shell."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, TextIO

import msgspec

from agent.check import check
from agent.compose import RobotKind, make_robot, parts_on, scene_from, table, thinking
from agent.errors import ConfigError, LimitReached, NotAllowed, ProgramError
from agent.execute import Executor
from agent.messages import Dialog, Kind, Turn
from agent.program import parse
from agent.turn import Parts, run_program, run_turn
from robot_bridge.ideal import predict
from scene.types import Scene, identifiers

EXIT_DONE, EXIT_REFUSED, EXIT_ASKED, EXIT_STOPPED, EXIT_UNSAFE = 0, 1, 4, 5, 6


def exit_status(turn: Turn) -> int:
    """The exit status that tells a script how a turn ended."""
    if turn.status in ("done", "answered"):
        return EXIT_DONE
    if turn.status == "asked":
        return EXIT_ASKED
    return EXIT_STOPPED if turn.reason == "cancelled" and turn.trajectory else EXIT_REFUSED


def show(turn: Turn, as_json: bool, out: TextIO) -> None:
    """Print a turn: the whole object on one line, or the program and the reply."""
    if as_json:
        out.write(msgspec.json.encode(turn).decode() + "\n")
    else:
        if turn.program is not None:
            out.write("".join(f"    {line}\n" for line in turn.program.splitlines()))
        out.write(turn.reply + "\n")
        if turn.question is not None:
            for number, option in enumerate(turn.question.options, start=1):
                out.write(f"  {number} {option.label}\n")
    out.flush()


@contextmanager
def local(scene: str | None, robot: RobotKind, seed: int) -> Iterator[Parts]:
    """The parts of one turn on a table of its own."""
    with thinking() as mind, parts_on(mind, scene_from(scene), robot, seed=seed) as parts:
        yield parts


def say(
    text: str, answers: Sequence[str], parts: Parts, *, task: Kind | None, dry_run: bool,
    as_json: bool, out: TextIO,
) -> int:  # fmt: skip
    """One sentence and the answers to the questions that come; each turn is printed."""
    dialog = Dialog()
    turn, dialog = run_turn(text, dialog, parts, task=task, dry_run=dry_run)
    for answer in answers:
        if turn.status != "asked":
            break
        show(turn, as_json, out)
        turn, dialog = run_turn(answer, dialog, parts, task=task, dry_run=dry_run)
    show(turn, as_json, out)
    return exit_status(turn)


def read_program(path: str) -> str:
    """The program body of a file, ``-`` for standard input. Raises ConfigError."""
    try:
        data = sys.stdin.buffer.read() if path == "-" else Path(path).read_bytes()
        return data.decode("utf-8").rstrip("\n")
    except OSError as error:
        raise ConfigError(f"cannot read the program {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ConfigError(f"the program {path} is not UTF-8 text: {error}") from error


def run(path: str, kind: Kind, parts: Parts, *, dry_run: bool, as_json: bool, out: TextIO) -> int:
    """Run a program file through check, preview and execution."""
    turn = run_program(read_program(path), kind, parts, dry_run=dry_run)
    show(turn, as_json, out)
    if turn.status == "refused":
        return EXIT_UNSAFE
    return exit_status(turn)


def check_file(path: str, kind: Kind, scene: Scene, as_json: bool, out: TextIO) -> int:
    """Check a program file on a scene and say what is wrong with it; nothing moves."""
    program = read_program(path)
    with Executor() as executor:
        robot = make_robot("ideal", scene)
        checked = check(
            program, kind, scene, executor=executor, predict=predict, workspace=robot,
            start=robot.pose(), touched=None,
        )  # fmt: skip
    if as_json:
        out.write(msgspec.json.encode(checked).decode() + "\n")
    elif checked.problems:
        for problem in checked.problems:
            where = f"line {problem.line}: " if problem.line else ""
            out.write(f"rejected ({problem.reason}): {where}{problem.text}\n")
    else:
        out.write(f"accepted: {len(checked.commands)} motions\n")
    return EXIT_UNSAFE if checked.problems else EXIT_DONE


class Body(msgspec.Struct, frozen=True, kw_only=True):
    """One line of `armchat check --jsonl`."""

    id: str | int
    kind: Kind
    body: str


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """One line of its answer; ``line`` and ``reason`` are null where there is nothing to say."""

    id: str | int | None
    verdict: str
    line: int | None = None
    reason: str | None = None
    ms: float = 0.0


def check_lines(lines: Iterable[bytes], scene: Scene, execute: bool, out: BinaryIO) -> int:
    """Check many programs; with ``execute`` each accepted one runs under the limits."""
    status = EXIT_DONE
    with Executor() as executor:
        for raw in lines:
            if not raw.strip():
                continue
            verdict = _verdict(raw, scene, executor if execute else None)
            status = max(status, int(verdict.id is None))
            out.write(msgspec.json.encode(verdict) + b"\n")
            out.flush()
    return status


def _verdict(raw: bytes, scene: Scene, executor: Executor | None) -> Verdict:
    began = time.perf_counter()
    try:
        body = msgspec.json.decode(raw, type=Body)
    except msgspec.DecodeError as error:
        return Verdict(id=None, verdict="rejected", reason=f"not a valid line: {error}")
    fault = _fault(body, _laid_out(scene, body.kind), executor)
    ms = 1000 * (time.perf_counter() - began)
    if fault is None:
        return Verdict(id=body.id, verdict="accepted", ms=ms)
    verdict = "limited" if isinstance(fault, LimitReached) else "rejected"
    return Verdict(id=body.id, verdict=verdict, line=fault.line or None, reason=fault.reason, ms=ms)


def _fault(body: Body, scene: Scene, executor: Executor | None) -> ProgramError | None:
    if executor is not None:
        result = executor.run(body.body, body.kind, [scene])[0]
        return result if isinstance(result, ProgramError) else None
    try:
        parse(body.body, body.kind, identifiers(scene))
    except NotAllowed as error:
        return error
    return None


def _laid_out(scene: Scene, kind: Kind) -> Scene:
    """For an arrange program the objects of a table without a tray wait in the tray."""
    if kind == "manipulate" or scene.tray:
        return scene
    tray = tuple(msgspec.structs.replace(item, x=None, y=None, on="tray") for item in scene.objects)
    return msgspec.structs.replace(scene, objects=(), tray=tray)


def default_check_scene(path: str | None) -> Scene:
    """The scene of a file, or an apple, a banana, a cup, a plate, a box and a bottle."""
    return scene_from(path) if path is not None else table("check")
