"""The bench of STOP: what it times, what it refuses to count, and the quantiles it reports."""

from contextlib import ExitStack

import pytest
from bridge_world import APPLE, PICK, bridge, client

from agent.bus import MemoryBus
from agent.messages import RobotReply, RobotState, Waypoint
from evals.stop_bench import _moving, _p99, _ready, _resting, _timed
from robot_bridge.ideal import IdealRobot
from scene.types import Scene

pytestmark = pytest.mark.live


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


def test_the_99th_percentile_leaves_out_one_of_a_hundred_and_none_of_fewer():
    assert _p99([float(n) for n in range(100, 0, -1)]) == 99.0
    assert _p99([3.0, 1.0, 2.0]) == 3.0


def test_stops_of_an_arm_at_rest_are_timed_and_the_arm_is_ready_again(stack):
    bus = bridge(stack)
    ann = client(stack, bus)
    ann.acquire()
    times = _resting(ann, 3)
    assert len(times) == 3 and min(times) > 0
    assert ann.state().safety == "normal"


def test_each_stop_of_a_moving_arm_ends_a_run_on_its_way(stack):
    robot = IdealRobot(Scene(objects=(APPLE,)), pace=1.0)
    bus = bridge(stack, robot=robot)
    ann = client(stack, bus)
    ann.acquire()
    assert len(_moving(ann, bus, 2)) == 2
    state = ann.state()
    assert (state.safety, state.program) == ("normal", "idle")


def test_an_owner_who_was_silent_for_too_long_takes_the_arm_anew(stack):
    bus = bridge(stack)
    ann = client(stack, bus)
    ann.acquire()
    ann.stop()
    ann._command("release")  # as the bridge does with one who is silent: ann does not know
    _ready(ann)
    state = ann.state()
    assert (state.owner, state.safety) == ("ann", "normal")


def test_a_stop_that_leaves_no_latch_is_no_figure(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    here = Waypoint(0, 0, PICK[0].z, 0, False)
    state = RobotState(1, 0.0, "r1", "normal", "idle", here, None, 0, "", 0)
    stack.enter_context(
        bus.serve(bus.keys.stop("r1"), lambda key, request: RobotReply(True, 0, "stopped"))
    )
    stack.enter_context(bus.serve(bus.keys.state("r1"), lambda key, request: state))
    with pytest.raises(RuntimeError, match="left no latch"):
        _timed(client(stack, bus))
