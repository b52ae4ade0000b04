"""Hold, step, pause, resume, stop and reset of the arm with physics, over the bridge."""

from contextlib import ExitStack

import pytest
from bridge_world import PICK, Run, bridge, client, wait_state

from agent.errors import Stopped
from agent.messages import Command, WorldSnapshot
from scene.types import Scene, SceneObject

pytestmark = pytest.mark.live

pytest.importorskip("pybullet")
APPLE = SceneObject(id="a1", name="block", x=0.2, y=0.0, width=0.1, height=0.1, tall=0.1)
LONG = tuple(
    Command("move", x, 0.5, 0.9, 0, False, line) for line, x in enumerate((-1.0, 1.0) * 10, 1)
)


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


@pytest.fixture
def bus(stack):
    from robot_bridge.bullet import BulletRobot

    return bridge(stack, robot=BulletRobot(Scene(objects=(APPLE,)), pace=0.2))


@pytest.fixture
def ann(stack, bus):
    made = client(stack, bus)
    made.acquire()
    return made


def held_before(bus, line):
    return wait_state(bus, lambda state: (state.program, state.line) == ("paused", line))


def test_a_held_plan_is_stepped_line_by_line_and_then_let_go(bus, ann):
    run = Run(bus, PICK, hold=True)
    for line in (1, 2, 3):
        held_before(bus, line)
        assert ann.step().ok
    held_before(bus, 4)
    assert run.lines(3) == [1, 2, 3]
    assert ann.resume().ok
    assert run.ended() is None
    assert bus.ask(bus.keys.world("r1"), None, WorldSnapshot).scene.get("a1").held


def test_a_pause_holds_after_the_motion_under_way_and_a_stop_ends_it_latched(bus, ann):
    run = Run(bus, LONG)
    assert run.steps.get(timeout=10).line == 1
    assert ann.pause().ok
    state = wait_state(bus, lambda state: state.program == "paused")
    assert ann.stop().ok
    assert isinstance(run.ended(), Stopped)
    stopped = wait_state(bus, lambda now: now.safety == "stopped")
    assert stopped.pose.x == pytest.approx(state.pose.x, abs=0.01)


def test_after_a_stop_in_motion_a_reset_moves_nothing_and_the_next_plan_runs(bus, ann):
    run = Run(bus, LONG)
    assert run.steps.get(timeout=10).line == 1
    assert ann.stop().ok
    assert isinstance(run.ended(), Stopped)
    rest = wait_state(bus, lambda state: state.program == "idle").pose
    assert ann.reset().ok and ann.resume().ok
    ready = wait_state(bus, lambda state: state.safety == "normal").pose
    assert (ready.x, ready.y, ready.z) == pytest.approx((rest.x, rest.y, rest.z), abs=0.005)
    assert Run(bus, PICK).ended() is None


def test_a_held_plan_that_is_called_off_moves_nothing(bus, ann):
    run = Run(bus, PICK, hold=True)
    held_before(bus, 1)
    assert ann.cancel().ok
    assert type(run.ended()).__name__ == "Cancelled"
    assert not bus.ask(bus.keys.world("r1"), None, WorldSnapshot).scene.get("a1").held
