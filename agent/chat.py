"""`chat` and `daemon`: all services in this process or one, on a bus, until the person leaves.

A chat listens on the loopback, so that `armchat stop` and `armchat say --connect` reach it from
any terminal of this machine; where another armchat listens already, it keeps to itself.
"""

from __future__ import annotations

import argparse
import logging
import os
import socket
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

from platformdirs import user_state_path

from agent.attending import Attending
from agent.bus import Bus, MemoryBus
from agent.client import Client
from agent.compose import (
    attend,
    default_robot,
    make_robot,
    scene_from,
    speakers,
    translate,
    workspace,
)
from agent.config import LOCAL_ENDPOINT, BusConfig, Config, DobotConfig, RobotConfig, load
from agent.daemon import Factory, Service, open_bus, running, serve
from agent.messages import TranslateRequest, Translation
from scene.types import Scene


def chat(arguments: argparse.Namespace) -> int:
    """The terminal interface over all services, or over a running agent with ``--connect``."""
    config = _config(arguments, {"tui.theme": arguments.theme})
    logging.basicConfig(filename=_log_file(), level=logging.INFO, force=True)
    if config.bus.connect:
        with open_bus(config.bus) as bus:
            return _terminal(bus, config, None)
    speakers().prepare(_told)
    translator = Attending(translate, attend)
    services = factories(
        scene_from(config.scene.file), config.robot, translator, dobot=config.dobot,
        seeing=config,
    )  # fmt: skip
    with _own_bus(config) as bus, running(bus, [], services):
        return _terminal(bus, config, translator)


def _terminal(bus: Bus, config: Config, translator: Attending | None) -> int:
    """``translator``: the one of this process; None where another process translates."""
    from tui.app import run

    client = Client(bus, f"tui-{os.getpid()}")
    try:
        return run(
            client, theme=config.tui.theme, preview=config.tui.preview,
            attend=None if translator is None else translator.of,
            models=None if translator is None else speakers(),
        )  # fmt: skip
    finally:
        client.close()


def _told(line: str) -> None:
    """How far the loading of a model is."""
    print(f"armchat: {line}", file=sys.stderr, flush=True)


@contextmanager
def _own_bus(config: Config) -> Iterator[Bus]:
    """A bus that others on this machine can reach, or one for this process alone."""
    listen = config.bus.listen or (LOCAL_ENDPOINT,)
    if config.bus.listen or _is_free(LOCAL_ENDPOINT):
        with open_bus(BusConfig(prefix=config.bus.prefix, listen=listen)) as bus:
            yield bus
        return
    print(
        f"armchat: another armchat listens on {LOCAL_ENDPOINT}; join it with "
        f"--connect {LOCAL_ENDPOINT}. This one keeps to itself.",
        file=sys.stderr,
    )
    bus = MemoryBus()
    try:
        yield bus
    finally:
        bus.close()


def _is_free(endpoint: str) -> bool:
    host, _, port = endpoint.removeprefix("tcp/").rpartition(":")
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, int(port)))
        except OSError:
            return False
    return True


def daemon(arguments: argparse.Namespace) -> int:
    """One service, or all, until SIGTERM or Ctrl-C."""
    logging.basicConfig(
        stream=sys.stderr,
        level=logging.INFO,
        format="%(asctime)s %(name)s: %(message)s",
        force=True,
    )
    config = _config(arguments, {"bus.listen": arguments.listen})
    if arguments.service in ("all", "translator"):
        speakers().prepare(_told)
    scene = scene_from(config.scene.file)
    services = factories(scene, config.robot, dobot=config.dobot, seeing=config)
    with open_bus(config.bus) as bus:
        serve(bus, [arguments.service], services)
    return 0


def _config(arguments: argparse.Namespace, more: Mapping[str, str | None]) -> Config:
    """The configuration in force, what the command line says first."""
    given = {
        "bus.connect": arguments.connect, "scene.file": arguments.scene,
        "robot.kind": arguments.robot, "robot.seed": arguments.seed,
        "robot.speed": arguments.speed, "robot.gui": arguments.gui, "dobot.port": arguments.port,
    }  # fmt: skip
    return load({**given, **more})


def factories(
    scene: Scene, robot: RobotConfig,
    translate: Callable[[TranslateRequest], Translation] = translate, *,
    dobot: DobotConfig | None = None, seeing: Config = Config(),  # noqa: B008 - a value
) -> Mapping[str, Factory]:  # fmt: skip
    """How each service is made, in the order in which they start. ``seeing``: by what eye."""

    def bridge(bus: Bus, stack: ExitStack) -> Service:
        from robot_bridge.service import RobotService

        kind = robot.kind or default_robot()
        arm = make_robot(
            kind, scene, seed=robot.seed, pace=robot.pace, keep_outs=robot.keep_outs,
            speed=robot.speed, gui=robot.gui, dobot=dobot,
        )  # fmt: skip
        stack.callback(arm.close)
        return RobotService(bus, arm, picture=seeing.scene.size)

    def eye(bus: Bus, stack: ExitStack) -> Service:
        from agent.eyes import scene_service

        return scene_service(bus, stack, scene, seeing)

    def translator(bus: Bus, stack: ExitStack) -> Service:
        from translator.service import TranslatorService

        return TranslatorService(bus, translate)

    def clarifier(bus: Bus, stack: ExitStack) -> Service:
        from agent.execute import Executor
        from clarifier.decide import Clarifier
        from clarifier.service import ClarifierService
        from clarifier.taught import Taught, default_path
        from robot_bridge.ideal import predict
        from translator.hearing import hear
        from translator.service import translate_over

        executor = stack.enter_context(Executor())
        reach = workspace(robot.kind or "ideal", robot.keep_outs, dobot)
        taught = Taught(default_path())
        mind = Clarifier(translate_over(bus), executor, predict, reach, taught, hears=hear)
        return ClarifierService(bus, mind.decide)

    def agent(bus: Bus, stack: ExitStack) -> Service:
        from agent.execute import Executor
        from agent.service import AgentService
        from clarifier.service import decide_over
        from robot_bridge.ideal import predict

        executor = stack.enter_context(Executor())
        return AgentService(bus, decide_over(bus), executor, predict, retries=robot.retries)

    return {
        "robot": bridge, "scene": eye, "translator": translator, "clarifier": clarifier,
        "agent": agent,
    }  # fmt: skip


def _log_file() -> Path:
    """Where a chat logs: the terminal belongs to the interface."""
    folder = user_state_path("armchat", ensure_exists=True)
    return folder / "chat.log"
