"""The client: lease, keepalives, typed errors; and everything across real processes."""

import json
import queue
import signal
import socket
import subprocess
import sys
import threading
from contextlib import ExitStack
from pathlib import Path

import pytest
from bridge_world import client as person

from agent.bus import MemoryBus, wait_for
from agent.client import Client, is_stop
from agent.config import BusConfig
from agent.daemon import chosen, running
from agent.errors import ConfigError, Declined, LinkDown, NoAnswer, NoService
from agent.messages import Ack, Event, RobotReply, Turn
from robot_bridge.ideal import IdealRobot
from robot_bridge.service import RobotService
from scene.types import Scene

pytestmark = pytest.mark.live

PATIENCE = 20.0
ROOT = Path(__file__).parent.parent


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


@pytest.fixture
def bus(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    return bus


def first(items, wanted):
    """The first of the next 200 items of a queue that is wanted."""
    return next(item for item in (items.get(timeout=PATIENCE) for _ in range(200)) if wanted(item))


def bridge(stack, bus):
    service = RobotService(bus, IdealRobot(Scene()))
    service.start()
    stack.callback(service.close)


class Script:
    """An agent that answers every submit with events written beforehand."""

    def __init__(self, stack, bus, *events):
        self.events, self.bus, self.submits = events, bus, []
        stack.enter_context(bus.serve(bus.keys.submit("*"), self._on_submit))
        stack.enter_context(bus.token(bus.keys.alive("agent", "script")))

    def _on_submit(self, key, submit):
        self.submits.append(submit)
        client = key.split("/")[-2]
        for seq, stage, turn in self.events:
            event = Event(submit.request_id, seq, stage, turn=turn)
            self.bus.publish(self.bus.keys.event(client), event)
        return Ack(submit.request_id)


DONE = Turn(say="x", status="done", reply="Done.")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("stop", True),
        ("Stop!", True),
        ("STOP STOP STOP", True),
        ("please stop.", True),
        ("stop the apple from rolling", False),
        ("don't stop", False),
        ("move the stop sign", False),
        ("", False),
    ],
)
def test_stop_is_told_by_its_words_alone(text, expected):
    assert is_stop(text) is expected


def test_events_come_once_each_and_end_with_the_turn(stack, bus):
    Script(stack, bus, (1, "heard", None), (1, "heard", None), (2, "turn", DONE), (3, "step", None))
    assert [event.seq for event in person(stack, bus).say("x")] == [1, 2]


def test_a_program_is_submitted_as_one(stack, bus):
    agent = Script(stack, bus, (1, "turn", DONE))
    list(person(stack, bus).run_program("robot.grip(True)", "manipulate"))
    list(person(stack, bus).run_program("robot.grip(True)", "manipulate", hold=True))
    plain, held = agent.submits
    assert (plain.program, plain.task, plain.hold) == ("robot.grip(True)", "manipulate", False)
    assert held.hold


def test_without_an_agent_saying_raises_at_once(stack, bus):
    with pytest.raises(NoService):
        person(stack, bus).say("hello")


def test_a_turn_that_never_ends_times_out_with_a_typed_error(stack, bus):
    Script(stack, bus, (1, "heard", None))
    events = person(stack, bus).say("hello", timeout=0.05)
    assert next(events).stage == "heard"
    with pytest.raises(NoAnswer):
        next(events)


def test_saying_takes_the_lease_when_it_is_free_and_previewing_does_not(stack, bus):
    bridge(stack, bus)
    Script(stack, bus, (1, "turn", DONE))
    ann, bob = person(stack, bus), person(stack, bus, "bob")
    list(ann.say("look", dry_run=True))
    assert not ann.holds_lease
    list(ann.say("push it"))
    assert ann.holds_lease
    assert ann.state().owner == "ann"
    list(bob.say("push it"))
    assert not bob.holds_lease
    with pytest.raises(Declined) as caught:
        bob.acquire()
    assert caught.value.code == "busy"


def test_a_verb_that_overtakes_a_keepalive_does_not_make_it_stale(stack, bus):
    sessions = {}

    def take(key, command):
        sessions.setdefault(key.rsplit("/", 1)[1], set()).add(command.session)
        return RobotReply(True, epoch=1)

    stack.enter_context(bus.serve(bus.keys.command("r1", "*"), take))
    ann = person(stack, bus)
    ann.acquire()
    ann.step()
    ann.release()
    assert sessions["acquire"] == sessions["release"] == {ann.session}
    assert ann.session not in sessions["step"]


def test_keepalives_hold_the_lease_for_as_long_as_wanted(stack, bus):
    bridge(stack, bus)
    ann = person(stack, bus)
    ann.acquire()
    beats = queue.Queue()
    ann.on_state(beats.put)
    first = beats.get(timeout=PATIENCE)
    while (state := beats.get(timeout=PATIENCE)).t < first.t + 1.3:
        assert state.owner == "ann"
    ann.release()
    assert ann.state().owner is None
    ann.release()


def test_saying_stop_stops_the_robot_even_if_there_is_no_agent(stack, bus):
    bridge(stack, bus)
    ann = person(stack, bus)
    with pytest.raises(NoService):
        ann.say("stop")
    assert ann.state().safety == "stopped"
    ann.reset()
    assert ann.state().safety == "stopped"
    ann.resume()
    assert ann.state().safety == "normal"


def test_services_are_seen_coming_and_going(stack, bus):
    ann = person(stack, bus)
    seen = queue.Queue()
    ann.on_services(lambda name, alive: seen.put((name, alive)))
    token = bus.token(bus.keys.alive("robot", "r1"))
    assert seen.get(timeout=PATIENCE) == ("robot/r1", True)
    token.close()
    assert seen.get(timeout=PATIENCE) == ("robot/r1", False)


def test_a_closed_client_leaves_no_thread_behind(bus):
    with ExitStack() as stack:
        bridge(stack, bus)
        client = Client(bus, "ann")
        client.acquire()
        client.on_state(lambda state: None)
        client.close()
    bus.close()
    names = [thread.name for thread in threading.enumerate()]
    assert not [name for name in names if "keepalive" in name or "inbox" in name]


# --- the daemon -------------------------------------------------------------------------------


class Part:
    def __init__(self, log, name, fails=False):
        self.log, self.name, self.fails = log, name, fails

    def start(self):
        if self.fails:
            raise LinkDown("no such port")
        self.log.append(f"+{self.name}")

    def close(self):
        self.log.append(f"-{self.name}")


def test_services_close_in_reverse_even_if_one_cannot_start(bus):
    log = []
    factories = {
        name: (lambda bus, stack, name=name: Part(log, name, fails=name == "c")) for name in "abc"
    }
    with running(bus, ["a", "b"], factories):
        assert log == ["+a", "+b"]
    assert log == ["+a", "+b", "-b", "-a"]
    log.clear()
    with pytest.raises(LinkDown), running(bus, [], factories):
        pass
    assert log == ["+a", "+b", "-c", "-b", "-a"]


def test_services_are_chosen_by_name():
    factories = dict.fromkeys(("robot", "scene", "agent"))
    assert chosen([], factories) == chosen(["all"], factories) == ["robot", "scene", "agent"]
    assert chosen(["agent", "robot"], factories) == ["robot", "agent"]
    with pytest.raises(ConfigError, match="known: robot, scene, agent, all"):
        chosen(["robots"], factories)


# --- two processes ----------------------------------------------------------------------------

DAEMON = """
import sys
from agent.config import BusConfig
from agent.daemon import open_bus, serve
from robot_bridge.ideal import IdealRobot, predict
from robot_bridge.service import RobotService
from scene.service import SceneService
from agent.service import AgentService
from scene.types import Scene, SceneObject
from tests.test_agent_service import Wave

apple = SceneObject(id="a1", name="apple", x=0.2, y=0.0, width=0.1, height=0.1, tall=0.1)
factories = {
    "robot": lambda bus, stack: RobotService(bus, IdealRobot(Scene(objects=(apple,)), pace=0.1)),
    "scene": lambda bus, stack: SceneService(bus),
    "agent": lambda bus, stack: AgentService(bus, None, None, predict, turn=Wave()),
}
with open_bus(BusConfig(listen=(sys.argv[1],))) as bus:
    serve(bus, sys.argv[2:], factories)
"""


@pytest.fixture(scope="module")
def daemon():
    """A daemon in a process of its own; its endpoint."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    process = subprocess.Popen([sys.executable, "-c", DAEMON, endpoint, "all"], cwd=ROOT)
    try:
        yield endpoint, process
    finally:
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE) == 0


@pytest.fixture
def remote(daemon, stack):
    from agent.bus_zenoh import ZenohBus

    bus = ZenohBus(BusConfig(connect=(daemon[0],)))
    stack.callback(bus.close)
    wait_for(bus, bus.keys.alive("agent", "*"), PATIENCE)
    return bus


def test_a_remote_client_says_looks_and_stops(stack, remote):
    ann, viewer = person(stack, remote), person(stack, remote, "viewer")
    ann.wait_ready(PATIENCE)
    assert [item.id for item in ann.scene()] == ["a1"]
    assert list(ann.say("which"))[-1].turn.status == "asked"
    assert list(ann.say("the left one"))[-1].turn.reply == "which -> the left one"
    events = ann.say("wave long")
    assert any(event.stage == "step" for event in events)
    assert viewer.stop().ok
    assert [*events][-1].turn.status == "failed"
    assert ann.state().safety == "stopped"
    ann.reset()
    ann.resume()
    assert [event.stage for event in ann.say("wave")] == [
        "heard",
        "program",
        "step",
        "step",
        "turn",
    ]
    ann.release()


def test_a_remote_client_steps_a_held_sentence_to_its_end(stack, remote):
    ann = person(stack, remote)
    ann.wait_ready(PATIENCE)
    states = queue.Queue()
    ann.on_state(states.put)
    events = ann.say("wave", hold=True)
    for line in (1, 2):
        first(states, lambda state, line=line: (state.program, state.line) == ("paused", line))
        assert ann.step().ok
    assert [event.stage for event in events] == ["heard", "program", "step", "step", "turn"]
    ann.release()


def test_a_remote_client_joins_late_and_sees_scene_and_state(stack, remote):
    seen = queue.Queue()
    viewer = person(stack, remote, "viewer")
    viewer.on_scene(lambda snapshot: seen.put("scene"))
    viewer.on_state(lambda state: seen.put("state"))
    found = set()
    while found != {"scene", "state"}:
        found.add(seen.get(timeout=PATIENCE))


@pytest.mark.usefixtures("remote")
def test_the_example_speaks_plain_zenoh_and_answers_a_question(daemon):
    script = ROOT / "examples" / "remote_client.py"
    assert "from agent" not in script.read_text(encoding="utf-8")
    command = [sys.executable, str(script), daemon[0]]
    done = subprocess.run([*command, "wave"], capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout.splitlines()[-1])["turn"]["status"] == "done"
    asked = subprocess.run(
        [*command, "which", "the left one"], capture_output=True, text=True, timeout=PATIENCE
    )
    turns = [line["turn"] for line in map(json.loads, asked.stdout.splitlines()) if line["turn"]]
    assert [turn["status"] for turn in turns] == ["asked", "answered"]
    assert asked.returncode == 0


def test_a_client_killed_in_mid_motion_stops_the_robot(stack, remote, daemon):
    script = ROOT / "examples" / "remote_client.py"
    victim = subprocess.Popen(
        [sys.executable, str(script), daemon[0], "wave long"], stdout=subprocess.PIPE, text=True
    )
    for line in victim.stdout:
        if json.loads(line)["stage"] == "step":
            break
    victim.kill()
    victim.wait(PATIENCE)
    states = queue.Queue()
    ann = person(stack, remote)
    ann.on_state(states.put)
    assert first(states, lambda state: state.safety == "stopped" and state.program == "idle")
    assert "gone" in ann.state().text
    ann.reset()
    ann.resume()
    ann.release()


def test_a_client_frozen_in_mid_motion_stops_the_robot_though_its_token_is_there(
    stack, remote, daemon
):
    script = ROOT / "examples" / "remote_client.py"
    victim = subprocess.Popen(
        [sys.executable, str(script), daemon[0], "wave long"], stdout=subprocess.PIPE, text=True
    )
    stack.callback(victim.wait, PATIENCE)
    stack.callback(victim.kill)
    for line in victim.stdout:
        if json.loads(line)["stage"] == "step":
            break
    victim.send_signal(signal.SIGSTOP)
    states = queue.Queue()
    ann = person(stack, remote)
    ann.on_state(states.put)
    assert first(states, lambda state: state.safety == "stopped" and state.program == "idle")
    assert "silent" in ann.state().text
    ann.reset()
    ann.resume()
    ann.release()
