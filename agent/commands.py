"""`say`: one turn from the shell, and what every command shares: printing, exit statuses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TextIO

import msgspec

from agent.compose import RobotKind, parts_on, scene_from, thinking
from agent.config import load
from agent.messages import Dialog, Kind, Turn
from agent.plain import one_line, plain
from agent.preview import Preview
from agent.turn import Parts, Watch, run_turn

EXIT_DONE, EXIT_REFUSED, EXIT_ASKED, EXIT_STOPPED, EXIT_UNSAFE = 0, 1, 4, 5, 6


def exit_status(turn: Turn) -> int:
    """The exit status that tells a script how a turn ended."""
    if turn.status in ("done", "answered"):
        return EXIT_DONE
    if turn.status == "asked":
        return EXIT_ASKED
    stopped = turn.status == "failed" and turn.reason == "cancelled"
    return EXIT_STOPPED if stopped else EXIT_REFUSED


def show(turn: Turn, as_json: bool, out: TextIO) -> None:
    """Print a turn: the whole object on one line, or the program and the reply."""
    if as_json:
        out.write(msgspec.json.encode(turn).decode() + "\n")
    else:
        if turn.program is not None:
            out.write("".join(f"    {line}\n" for line in plain(turn.program).split("\n")))
        out.write(plain(turn.reply) + "\n")
        if turn.question is not None:
            for number, option in enumerate(turn.question.options, start=1):
                out.write(f"  {number} {one_line(option.label)}\n")
    out.flush()


@contextmanager
def local(
    scene: str | None, robot: RobotKind, seed: int, port: str | None = None, *,
    speed: float | None = None, gui: bool = False,
) -> Iterator[Parts]:  # fmt: skip
    """The parts of one turn on a table of its own, with the words of the person who types.

    ``port``: a Dobot's; ``speed`` and ``gui`` as in `parts_on`. Raises LinkDown also where the arm
    was lost on the way.
    """
    from clarifier.taught import Taught, default_path

    taught, dobot = Taught(default_path()), load({"dobot.port": port}).dobot
    table = scene_from(scene)
    with (
        thinking(taught, robot) as mind,
        parts_on(mind, table, robot, seed=seed, speed=speed, gui=gui, dobot=dobot) as parts,
    ):
        yield parts
        parts.arm.start()  # a turn says what it knows; that nobody is there is an error besides


def previewing(preview: Preview, parts: Parts, out: TextIO) -> Watch:
    """Shows each plan before it runs."""
    limits = parts.arm.workspace.limits
    return Watch(plan=lambda plan, kind, after: preview.show(plan, after, limits, out))


def say(
    text: str, answers: Sequence[str], parts: Parts, *, task: Kind | None, dry_run: bool,
    as_json: bool, svg: str | None = None, out: TextIO,
) -> int:  # fmt: skip
    """One sentence and the answers to the questions that come; each turn is printed.

    A dry run shows the plan as text; ``svg`` is a file to draw it into.
    """
    dialog = Dialog()
    watch = previewing(Preview(explain=dry_run and not as_json, svg=svg), parts, out)
    turn, dialog = run_turn(text, dialog, parts, task=task, dry_run=dry_run, watch=watch)
    for answer in answers:
        if turn.question is None:
            break
        show(turn, as_json, out)
        turn, dialog = run_turn(answer, dialog, parts, task=task, dry_run=dry_run, watch=watch)
    show(turn, as_json, out)
    return exit_status(turn)
