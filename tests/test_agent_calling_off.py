"""A second try over the bus: what is left of the first plan is called off, not stopped."""

import threading
from contextlib import ExitStack

import pytest
from bridge_world import APPLE, PATIENCE, ByHand, bridge, client, wait_state

from agent.arm import BusArm
from agent.messages import Command, Decision, RobotState
from agent.service import AgentService
from robot_bridge.api import approve
from robot_bridge.ideal import IdealRobot, predict
from robot_bridge.mishaps import Mishaps
from robot_bridge.stepping import Gate
from scene.service import SceneService
from scene.types import Scene

pytestmark = pytest.mark.live

PUT = "put(apple, [-0.5, 0.3])"


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


class FirstGripFails(Mishaps):
    grips = 0

    def seals(self):
        self.grips += 1
        return self.grips > 1


def act(request):
    return Decision(
        "act", "w", request.dialog, program=PUT, kind="manipulate", touched=("a1",)
    )  # fmt: skip


def test_a_client_sees_both_plans_and_the_turn_says_it_took_two(stack, executor):
    robot = IdealRobot(Scene(objects=(APPLE,)), mishaps=FirstGripFails())
    bus = bridge(stack, robot=robot)
    for service in (SceneService(bus), AgentService(bus, act, executor, predict)):
        service.start()
        stack.callback(service.close)
    ann = client(stack, bus)
    events = list(ann.say("put it there"))
    assert [event.stage for event in events].count("program") == 2
    turn = events[-1].turn
    assert (turn.status, turn.reply.startswith("It took me 2 tries.")) == ("done", True)
    assert robot.scene().get("a1").position == pytest.approx((-0.5, 0.3), abs=1e-6)
    assert bus.ask(bus.keys.state("r1"), None, RobotState).safety == "normal"


def test_who_stops_listening_ends_the_run_after_the_motion_under_way(stack, monkeypatch):
    paused, pause = threading.Event(), Gate.pause
    monkeypatch.setattr(Gate, "pause", lambda gate: (pause(gate), paused.set()))
    robot = ByHand()
    bus = bridge(stack, robot=robot)
    ann = client(stack, bus)
    ann.acquire()
    moves = tuple(Command("move", x, 0.5, 0.9, 0, False, n) for n, x in enumerate((-1, 1, 0), 1))
    arm = BusArm(bus, "ann")
    steps = arm.run(approve(moves, arm.start(), arm.workspace))
    robot.motions.release()
    assert next(steps).line == 1
    for _ in range(2):
        assert robot.begun.acquire(timeout=PATIENCE)
    closing = threading.Thread(target=steps.close)
    closing.start()
    assert paused.wait(PATIENCE)
    robot.motions.release()  # the second motion, under way, ends; the third one does not begin
    closing.join(PATIENCE)
    state = wait_state(bus, lambda state: state.program == "idle")
    assert (state.safety, round(state.pose.x, 6)) == ("normal", 1.0)


def test_a_run_that_is_over_is_not_called_off(stack):
    bus = bridge(stack)
    client(stack, bus).acquire()
    arm = BusArm(bus, "ann")
    moves = (Command("move", 0.5, 0.5, 0.9, 0, False, 1),)
    steps = arm.run(approve(moves, arm.start(), arm.workspace))
    assert next(steps).line == 1
    steps.close()
    assert wait_state(bus, lambda state: state.program == "idle").safety == "normal"
