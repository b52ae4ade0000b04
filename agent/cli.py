"""The `armchat` command: parse arguments, hand over to the part that does the work, map errors.

stdout is data, stderr narration; exit statuses are an interface: 0 done or answered, 1 refused or
failed, 2 usage or configuration, 3 robot or agent unreachable, 4 asked, 5 stopped, 6 program
rejected as unsafe, 124 timeout, 130 interrupted.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from agent.turn import Parts

ROBOTS = ("ideal", "bullet", "dobot")
SERVICES = ("all", "scene", "translator", "clarifier", "robot", "agent")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    from agent.errors import ArmchatError, BusError, ConfigError, Declined, LinkDown, SceneError

    arguments = parser().parse_args(argv)
    try:
        status: int = arguments.act(arguments)
        return status
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    except TimeoutError as error:
        print(f"armchat: timed out: {error}", file=sys.stderr)
        return 124
    except Declined as error:
        print(f"armchat: refused ({error.code}): {error}", file=sys.stderr)
        return 1
    except (BusError, LinkDown) as error:
        print(f"armchat: {error}", file=sys.stderr)
        return 3
    except (ConfigError, SceneError) as error:
        print(f"armchat: {error}", file=sys.stderr)
        return 2
    except ArmchatError as error:
        print(f"armchat: {error}", file=sys.stderr)
        return 1


def parser() -> argparse.ArgumentParser:
    """Every command with its options; help texts are the manual."""
    from agent.hardware import add_commands, port_options
    from agent.models import add_models
    from agent.optics import add_calibrations
    from agent.shows import add_scene
    from agent.training import add_trainings
    from evals.reproduce import add_options

    top = argparse.ArgumentParser(prog="armchat", description="Talk to a robot arm at a table.")
    top.add_argument("--version", action="version", version=f"armchat {version('armchat')}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND")
    top.set_defaults(act=_chat, **_defaults())

    chat = commands.add_parser("chat", help="open the terminal interface (the default)")
    _scene_options(chat)
    chat.add_argument(
        "--connect", metavar="ENDPOINT", help="a running agent, e.g. tcp/127.0.0.1:7447"
    )
    chat.add_argument("--theme", help="colour theme of the terminal interface")
    chat.set_defaults(act=_chat)

    say = commands.add_parser("say", help="one sentence from the shell")
    say.add_argument("text", help="the sentence; - reads it from standard input")
    _scene_options(say)
    say.add_argument(
        "--connect", metavar="ENDPOINT", help="a running agent instead of this process"
    )
    say.add_argument("--task", choices=("arrange", "manipulate"))
    say.add_argument(
        "--answer", action="append", default=[], help="answer to a question (repeatable)"
    )
    say.add_argument("--dry-run", action="store_true", help="check and preview, move nothing")
    say.add_argument("--json", action="store_true", help="print the turn object")
    say.add_argument("--svg", metavar="FILE", help="draw the plan before it runs")
    say.add_argument(
        "--timeout", type=float, default=60.0, help="seconds to wait for a running agent"
    )
    say.set_defaults(act=_say)

    run = commands.add_parser("run", help="run a program file through check and execution")
    run.add_argument("file", help="the program's body; - reads standard input")
    _scene_options(run)
    run.add_argument("--kind", choices=("arrange", "manipulate"), default="manipulate")
    run.add_argument("--dry-run", action="store_true", help="check and preview, move nothing")
    run.add_argument("--json", action="store_true", help="print the turn object")
    _preview_options(run)
    run.set_defaults(act=_run)

    check = commands.add_parser("check", help="check a program file, or many as JSON Lines")
    check.add_argument("file", nargs="?", help="the program's body; - reads standard input")
    check.add_argument("--kind", choices=("arrange", "manipulate"), default="manipulate")
    check.add_argument("--scene", metavar="FILE")
    check.add_argument("--json", action="store_true", help="print the report as JSON")
    _preview_options(check)
    check.add_argument("--jsonl", action="store_true", help="read {id, kind, body} lines on stdin")
    check.add_argument(
        "--execute", action="store_true", help="with --jsonl: run accepted bodies too"
    )
    check.set_defaults(act=_check)

    batch = commands.add_parser("batch", help="play JSON Lines of scenes and sentences")
    batch.add_argument("--robot", choices=ROBOTS, default="ideal")
    batch.add_argument("--port", metavar="PORT", help="of a Dobot")
    batch.add_argument("--seed", type=int, default=0)
    batch.add_argument("--jobs", type=int, default=1)
    batch.set_defaults(act=_batch)

    demo = commands.add_parser("demo", help="play a scripted conversation for real")
    demo.add_argument("--robot", choices=("ideal", "bullet"))
    demo.add_argument("--seed", type=int, default=0)
    demo.set_defaults(act=_demo)

    daemon = commands.add_parser("daemon", help="run one service, or all, until interrupted")
    daemon.add_argument("service", nargs="?", choices=SERVICES, default="all")
    _scene_options(daemon)
    daemon.add_argument("--listen", metavar="ENDPOINT", help="e.g. tcp/127.0.0.1:7447")
    daemon.add_argument("--connect", metavar="ENDPOINT", help="another armchat process")
    daemon.set_defaults(act=_daemon)

    add_scene(commands, _scene_options)

    for name, text, act in (
        ("stop", "STOP the arm: needs no lease and no model", _stop),
        ("reset", "clear a stop; never moves the arm", _reset),
        ("pause", "hold a program before its next motion; for who holds the arm", _tell),
        ("resume", "let a program that is held go on; for who holds the arm", _tell),
        ("step", "let a held program run one line; for who holds the arm", _tell),
    ):
        verb = commands.add_parser(name, help=text)
        verb.add_argument("--connect", metavar="ENDPOINT", help="a running agent")
        if act in (_stop, _reset):
            port_options(verb)
        verb.set_defaults(act=act)

    add_commands(commands)
    add_models(commands)
    doctor = commands.add_parser("doctor", help="what armchat needs, and what to do where it lacks")
    port_options(doctor)
    doctor.set_defaults(act=_doctor)

    add_trainings(commands.add_parser("train", help="train a network (needs the train extra)"))
    add_options(commands.add_parser("reproduce", help="the paper's tables on our corpus"))

    calibrate = commands.add_parser("calibrate", help="fit what armchat asks, sees and moves by")
    parts = calibrate.add_subparsers(dest="part", metavar="PART", required=True)
    clarifier = parts.add_parser("clarifier", help="fit what the clarifier asks and acts by")
    clarifier.add_argument("--episodes", type=int, metavar="N", help="default: 1,600 and some")
    clarifier.add_argument("--seed", type=int, metavar="S", default=1)
    clarifier.set_defaults(act=_calibrate)
    add_calibrations(parts)

    bench = commands.add_parser(
        "bench", help="measure figures: program, language, clarifier, robot, scene, cold"
    )
    benches = ("program", "language", "clarifier", "robot", "scene", "cold")
    bench.add_argument("name", choices=benches)
    bench.add_argument("--json", action="store_true")
    bench.add_argument(
        "--episodes", type=int, metavar="N", help="clarifier: play so many, and less of all else"
    )
    bench.add_argument("--model", metavar="MODEL", help="language: seq2seq, pretrained, cascade")
    bench.add_argument(
        "--sentences", type=int, metavar="N",
        help="language: at most N of each set, drawn evenly (all; pretrained, cascade: 30)",
    )  # fmt: skip
    bench.add_argument("--trials", type=int, metavar="N", help="robot: N trials instead of 525")
    bench.set_defaults(act=_bench)
    return top


def _defaults() -> dict[str, object]:
    """What `armchat` without a command means: chat on the default table."""
    names = ("scene", "robot", "seed", "port", "speed", "gui", "connect", "theme")
    return dict.fromkeys(names)


def _preview_options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--explain", action="store_true",
        help="print the primitives with lengths, times and the room left to each limit",
    )  # fmt: skip
    command.add_argument("--svg", metavar="FILE", help="draw the plan before it runs")


def _scene_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--scene", metavar="FILE", help="the scene object as JSON")
    at_once = command.prog.endswith((" say", " run"))
    command.add_argument(
        "--robot", choices=ROBOTS, default="ideal" if at_once else None,
        help="default: ideal" if at_once else "default: bullet where PyBullet is installed",
    )  # fmt: skip
    command.add_argument("--port", metavar="PORT", help="of a Dobot (`armchat ports`)")
    command.add_argument("--seed", type=int, default=0 if at_once else None)
    command.add_argument(
        "--speed", type=_share, metavar="SHARE", help="share of the arm's full speed, e.g. 30%%"
    )
    command.add_argument(
        "--gui", action="store_true", default=None, help="PyBullet in a window (needs a display)"
    )


def _share(text: str) -> float:
    """A share such as 30% or 0.3, above 0 and at most 1."""
    share = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    if not 0 < share <= 1:
        raise argparse.ArgumentTypeError(f"{text} is not above 0 and at most 100%")
    return share


def _local(arguments: argparse.Namespace) -> AbstractContextManager[Parts]:
    """The parts of one turn on the table and arm of a command with `_scene_options`."""
    from agent.commands import local

    return local(
        arguments.scene, arguments.robot, arguments.seed, _port(arguments),
        speed=arguments.speed, gui=bool(arguments.gui),
    )  # fmt: skip


def _say(arguments: argparse.Namespace) -> int:
    text = sys.stdin.read().strip() if arguments.text == "-" else arguments.text
    if arguments.connect:
        from agent.errors import ConfigError
        from agent.remote import say_remotely

        if arguments.svg:
            raise ConfigError("--svg draws plans made in this process: leave out --connect")

        return say_remotely(
            arguments.connect, text, arguments.answer, task=arguments.task,
            dry_run=arguments.dry_run, as_json=arguments.json, timeout=arguments.timeout,
            out=sys.stdout,
        )  # fmt: skip
    from agent.commands import say

    with _local(arguments) as parts:
        return say(
            text, arguments.answer, parts, task=arguments.task, dry_run=arguments.dry_run,
            as_json=arguments.json, svg=arguments.svg, out=sys.stdout,
        )  # fmt: skip


def _run(arguments: argparse.Namespace) -> int:
    from agent.preview import Preview
    from agent.programs import run

    with _local(arguments) as parts:
        return run(
            arguments.file, arguments.kind, parts, dry_run=arguments.dry_run,
            as_json=arguments.json, preview=Preview(arguments.explain, arguments.svg),
            out=sys.stdout,
        )  # fmt: skip


def _port(arguments: argparse.Namespace) -> str | None:
    from agent.errors import ConfigError

    if arguments.port and arguments.robot != "dobot":
        raise ConfigError("--port goes with --robot dobot")
    port: str | None = arguments.port
    return port


def _check(arguments: argparse.Namespace) -> int:
    from agent.compose import scene_from
    from agent.errors import ConfigError
    from agent.preview import Preview
    from agent.programs import check_file, check_lines

    scene = scene_from(arguments.scene, default="check")
    if arguments.jsonl:
        return check_lines(sys.stdin.buffer, scene, arguments.execute, sys.stdout.buffer)
    if arguments.file is None:
        raise ConfigError("check needs a FILE (- for standard input), or --jsonl")
    preview = Preview(arguments.explain, arguments.svg)
    return check_file(
        arguments.file, arguments.kind, scene, preview, as_json=arguments.json, out=sys.stdout
    )


def _batch(arguments: argparse.Namespace) -> int:
    from agent.batch import batch
    from agent.compose import parts_on, thinking
    from agent.config import load
    from agent.errors import ConfigError

    if arguments.robot == "dobot" and arguments.jobs != 1:
        raise ConfigError("one arm does one job at a time: leave out --jobs")
    dobot = load({"dobot.port": _port(arguments)}).dobot
    with thinking(robot=arguments.robot) as mind:
        return batch(
            sys.stdin.buffer,
            sys.stdout.buffer,
            lambda scene: parts_on(mind, scene, arguments.robot, seed=arguments.seed, dobot=dobot),
            arguments.jobs,
        )


def _demo(arguments: argparse.Namespace) -> int:
    from agent.demo import play_demo

    return play_demo(arguments.robot, arguments.seed or 0, sys.stdout)


def _chat(arguments: argparse.Namespace) -> int:
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        from agent.demo import play_demo

        return play_demo(arguments.robot, arguments.seed or 0, sys.stdout)
    from agent.chat import chat

    return chat(arguments)


def _daemon(arguments: argparse.Namespace) -> int:
    from agent.chat import daemon

    return daemon(arguments)


def _stop(arguments: argparse.Namespace) -> int:
    from agent.hardware import opens_port, stop_port

    if opens_port(arguments):
        return stop_port(arguments.port, sys.stdout)
    from agent.remote import stop_remotely

    return stop_remotely(arguments.connect, sys.stdout)


def _reset(arguments: argparse.Namespace) -> int:
    from agent.hardware import opens_port, reset_port

    if opens_port(arguments):
        return reset_port(arguments.port, sys.stdout)
    from agent.remote import reset_remotely

    return reset_remotely(arguments.connect, sys.stdout)


def _doctor(arguments: argparse.Namespace) -> int:
    from agent.doctor import doctor
    from agent.hardware import opens_port

    return doctor(opens_port(arguments), arguments.port, sys.stdout)


def _tell(arguments: argparse.Namespace) -> int:
    from agent.remote import tell_remotely

    return tell_remotely(arguments.connect, arguments.command, sys.stdout)


def _calibrate(arguments: argparse.Namespace) -> int:
    from evals.conformal import CARD, EPISODES, calibrate

    return calibrate(arguments.episodes or EPISODES, arguments.seed, 2, CARD, sys.stdout)


def _bench(arguments: argparse.Namespace) -> int:
    from evals.bench import bench

    if arguments.model is not None:
        from agent.compose import speakers
        from agent.errors import ConfigError

        if arguments.name != "language":
            raise ConfigError("--model goes with armchat bench language")
        speakers().choose(arguments.model, lambda line: print(f"armchat: {line}", file=sys.stderr))
    size = arguments.episodes or arguments.trials or arguments.sentences
    return bench(arguments.name, arguments.json, sys.stdout, size)


if __name__ == "__main__":
    sys.exit(main())
