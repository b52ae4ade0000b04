"""`run` and `check`: programs that somebody wrote, from the shell.

Both go through the one check; what is shown of a plan before it runs is a `Preview`.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import BinaryIO, TextIO

import msgspec

from agent.check import Checked, check
from agent.commands import EXIT_DONE, EXIT_REFUSED, EXIT_UNSAFE, exit_status, previewing, show
from agent.compose import make_robot
from agent.config import load
from agent.errors import ConfigError, LimitReached, NotAllowed, ProgramError
from agent.execute import Executor
from agent.explain import Explanation, explain
from agent.messages import Kind, Problem
from agent.plain import plain
from agent.preview import Preview
from agent.turn import Parts, run_program
from robot_bridge.ideal import predict
from scene.types import Scene


def read_program(path: str) -> str:
    """The program body of a file, ``-`` for standard input. Raises ConfigError."""
    try:
        data = sys.stdin.buffer.read() if path == "-" else Path(path).read_bytes()
        return data.decode("utf-8").rstrip("\n")
    except OSError as error:
        raise ConfigError(f"cannot read the program {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ConfigError(f"the program {path} is not UTF-8 text: {error}") from error


def run(
    path: str, kind: Kind, parts: Parts, *, dry_run: bool, as_json: bool, preview: Preview,
    out: TextIO,
) -> int:  # fmt: skip
    """Run a program file through check, preview and execution; a dry run shows the plan as text."""
    shown = preview._replace(explain=preview.explain or (dry_run and not as_json))
    watch = previewing(shown, parts, sys.stderr if as_json else out)
    turn = run_program(read_program(path), kind, parts, dry_run=dry_run, watch=watch)
    show(turn, as_json, out)
    return EXIT_UNSAFE if turn.status == "refused" else exit_status(turn)


class Report(msgspec.Struct, frozen=True, kw_only=True):
    """What `armchat check --json` prints; ``explanation`` is null where there is no plan."""

    verdict: str
    kind: Kind
    problems: tuple[Problem, ...]
    hardened: bool
    explanation: Explanation | None = None


def check_file(
    path: str, kind: Kind, scene: Scene, preview: Preview, *, as_json: bool, out: TextIO
) -> int:
    """Check a program file on a scene and say what is wrong with it; nothing moves."""
    program = read_program(path)
    scene = laid_out(scene, kind)
    robot = make_robot("ideal", scene, keep_outs=load().robot.keep_outs)
    with Executor() as executor:
        checked = check(
            program, kind, scene, executor=executor, predict=predict, workspace=robot,
            start=robot.pose(), touched=None,
        )  # fmt: skip
        hardened = executor.hardened
    plan, after = checked.plan, checked.after
    if as_json:
        numbers = None if plan is None else explain(plan, robot.limits)
        report = Report(
            verdict="rejected" if plan is None else "accepted", kind=kind,
            problems=checked.problems, hardened=hardened, explanation=numbers,
        )  # fmt: skip
        out.write(json.dumps(_named(report)) + "\n")
    else:
        out.write(_verdict_text(checked))
        if not hardened:
            out.write("note: no system-call filter on this machine: simulated arms only\n")
    if plan is None or after is None:
        return EXIT_UNSAFE
    preview._replace(explain=preview.explain and not as_json).show(plan, after, robot.limits, out)
    return EXIT_DONE


def _named(value: object) -> object:
    """Structs and named tuples as plain JSON objects."""
    if isinstance(value, msgspec.Struct):
        return {key: _named(part) for key, part in msgspec.structs.asdict(value).items()}
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return {key: _named(part) for key, part in value._asdict().items()}
    return [_named(part) for part in value] if isinstance(value, tuple) else value


def _verdict_text(checked: Checked) -> str:
    if checked.plan is not None:
        seconds = sum(checked.plan.durations)
        return f"accepted: {len(checked.commands)} motions, {seconds:.1f} s\n"
    return plain("".join(_problem_text(problem, checked) for problem in checked.problems))


def _problem_text(problem: Problem, checked: Checked) -> str:
    """The problem, and the line it is about with a mark under the place."""
    lines = checked.program.split("\n")
    if not 0 < problem.line <= len(lines):
        return f"rejected ({problem.reason}): {problem.text}\n"
    column = f", column {problem.column}" if problem.column else ""
    number = f"{problem.line:5} | "
    mark = " " * (len(number) + problem.column - 1) + "^\n" if problem.column else ""
    where = f"rejected ({problem.reason}): line {problem.line}{column}: {problem.text}\n"
    return f"{where}{number}{lines[problem.line - 1]}\n{mark}"


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
            verdict = _verdict(raw, scene, executor, execute)
            if verdict is None:
                verdict, status = _unreadable(raw), EXIT_REFUSED
            out.write(msgspec.json.encode(verdict) + b"\n")
            out.flush()
    return status


def _verdict(raw: bytes, scene: Scene, executor: Executor, execute: bool) -> Verdict | None:
    """What becomes of the program of a line; None if it is not such a line."""
    began = time.perf_counter()
    try:
        body = msgspec.json.decode(raw, type=Body)
    except msgspec.DecodeError:
        return None
    (result,) = executor.run(body.body, body.kind, [laid_out(scene, body.kind)])
    ms = 1000 * (time.perf_counter() - began)
    if not isinstance(result, ProgramError if execute else NotAllowed):
        return Verdict(id=body.id, verdict="accepted", ms=ms)
    verdict = "limited" if isinstance(result, LimitReached) else "rejected"
    line = result.line or None
    return Verdict(id=body.id, verdict=verdict, line=line, reason=result.reason, ms=ms)


def _unreadable(raw: bytes) -> Verdict:
    """The answer to a line that is not {id, kind, body}, with its id if it has one all the same."""
    reason, data = 'not a valid line: write {"id": ..., "kind": ..., "body": ...}', None
    try:
        data = json.loads(raw)
        msgspec.json.decode(raw, type=Body)
    except ValueError as error:  # msgspec's own errors are ValueErrors too
        reason = f"not a valid line: {error}"
    identity = data.get("id") if isinstance(data, dict) else None
    known = identity if isinstance(identity, str | int) else None
    return Verdict(id=known, verdict="rejected", reason=reason)


def laid_out(scene: Scene, kind: Kind) -> Scene:
    """For an arrange program the objects of a table without a tray wait in the tray."""
    if kind == "manipulate" or scene.tray:
        return scene
    tray = tuple(msgspec.structs.replace(item, x=None, y=None, on="tray") for item in scene.objects)
    return msgspec.structs.replace(scene, objects=(), tray=tray)
