"""A run is held, stepped line by line, goes on, is given up or stopped; the line is always told."""

import queue
import threading
from contextlib import ExitStack

import pytest
from bridge_world import PATIENCE, PICK, ByHand, Run, Sender, bridge, client, wait_state

from agent.arm import BusArm
from agent.errors import Declined, MoveTimeout, Stopped
from agent.messages import Command, RobotState, WorldSnapshot
from robot_bridge.api import PARK
from robot_bridge.stepping import Gate, Place
from scene.types import Scene

pytestmark = pytest.mark.live


def move(x, line):
    return Command("move", x, 0.5, 0.9, 0, False, line)


TWO_A_LINE = tuple(move(line / 10 + half / 20, line) for line in (1, 2, 3) for half in (0, 1))
"""Three lines with two motions each."""
LOOP = tuple(move((turn + line / 10) / 5, line) for turn in (0, 1) for line in (2, 3))
"""A loop whose body is lines 2 and 3, twice."""


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


def by_hand(stack):
    """A bridge over an arm that is moved by hand, and its owner ann."""
    robot = ByHand()
    bus = bridge(stack, robot=robot)
    ann = client(stack, bus)
    ann.acquire()
    return robot, bus, ann


def owned(stack, pace=0.0):
    bus = bridge(stack, pace)
    ann = client(stack, bus)
    ann.acquire()
    return bus, ann


def paused(bus, line=None):
    """The state once the run is held (before this line)."""
    return wait_state(bus, lambda state: state.program == "paused" and line in (None, state.line))


def now(bus):
    return bus.ask(bus.keys.state("r1"), None, RobotState)


def wait_for_lines(run, lines):
    assert [run.steps.get(timeout=PATIENCE).line for _ in lines] == lines


def at_park(state):
    return (state.pose.x, state.pose.y, state.pose.z) == (PARK.x, PARK.y, PARK.z)


# --- held before the first line -----------------------------------------------------------------


def test_a_held_run_is_acknowledged_paused_and_has_not_moved(stack):
    bus = bridge(stack)
    ann = Sender(stack, bus)
    ann.own()
    assert ann.send("run", PICK, hold=True).ok
    state = now(bus)
    assert (state.program, state.line) == ("paused", 1)
    assert at_park(state)
    assert ann.events.empty()


def test_a_held_run_is_told_on_the_state_topic_at_once(stack):
    bus, ann = owned(stack)
    seen = queue.Queue()
    with bus.subscribe(bus.keys.state("r1"), lambda key, state: seen.put(state)):
        Run(bus, PICK, hold=True)
        while (state := seen.get(timeout=PATIENCE)).program == "idle":
            pass
        assert (state.program, state.line, state.owner) == ("paused", 1, ann.name)


def test_a_plan_that_is_not_approved_is_never_held(stack):
    ann = Sender(stack, bridge(stack))
    ann.own()
    assert ann.send("run", PICK, hold=True, digest="").code == "NotReady"
    assert now(ann.bus).program == "idle"


# --- step ---------------------------------------------------------------------------------------


def test_a_step_is_one_line_with_all_that_it_does(stack):
    bus, ann = owned(stack)
    run = Run(bus, TWO_A_LINE, hold=True)
    paused(bus, 1)
    for line in (1, 2):
        assert ann.step().ok
        paused(bus, line + 1)
        wait_for_lines(run, [line, line])
    assert ann.step().ok
    assert run.ended() is None
    assert run.lines(2) == [3, 3]
    state = now(bus)
    assert (state.program, state.line) == ("idle", 0)


def test_each_pass_of_a_loop_is_stepped(stack):
    bus, ann = owned(stack)
    run = Run(bus, LOOP, hold=True)
    for line in (2, 3, 2, 3):
        paused(bus, line)
        ann.step()
        wait_for_lines(run, [line])
    assert run.ended() is None


def test_a_step_of_a_running_program_holds_at_the_end_of_the_line(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE)
    assert robot.begun.acquire(timeout=PATIENCE)
    assert ann.step().ok
    robot.motions.release(2)
    paused(bus, 2)
    wait_for_lines(run, [1, 1])
    assert run.steps.empty()


def test_a_second_step_while_a_line_runs_is_not_kept_for_the_next(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE, hold=True)
    paused(bus, 1)
    ann.step()
    assert robot.begun.acquire(timeout=PATIENCE)
    ann.step()
    robot.motions.release(20)
    paused(bus, 2)
    wait_for_lines(run, [1, 1])


# --- pause and resume ---------------------------------------------------------------------------


def test_the_line_is_told_as_it_begins_and_not_when_it_is_over(stack):
    robot, bus, _ = by_hand(stack)
    run = Run(bus, TWO_A_LINE)
    for line in (1, 2, 3):
        wait_state(bus, lambda state, line=line: (state.program, state.line) == ("running", line))
        assert run.steps.empty()
        robot.motions.release(2)
        wait_for_lines(run, [line, line])
    assert run.ended() is None


def test_a_pause_ends_the_motion_under_way_and_says_paused_only_then(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE)
    assert robot.begun.acquire(timeout=PATIENCE)
    assert ann.pause().ok
    assert now(bus).program == "running"
    robot.motions.release(20)
    state = paused(bus)
    assert state.line == 1
    wait_for_lines(run, [1])
    assert (state.pose.x, state.pose.y) == (TWO_A_LINE[0].x, TWO_A_LINE[0].y)
    assert ann.resume().ok
    assert run.ended() is None
    assert run.lines(5) == [1, 2, 2, 3, 3]


def test_a_paused_line_is_stepped_to_its_end(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE)
    assert robot.begun.acquire(timeout=PATIENCE)
    ann.pause()
    robot.motions.release(20)
    paused(bus, 1)
    ann.step()
    paused(bus, 2)
    wait_for_lines(run, [1, 1])


def test_a_held_run_that_is_resumed_goes_to_its_end(stack):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    assert ann.resume().ok
    assert run.ended() is None
    assert run.lines(4) == [1, 2, 3, 4]


def test_a_pause_in_the_last_motion_changes_nothing(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE[:1])
    assert robot.begun.acquire(timeout=PATIENCE)
    ann.pause()
    robot.motions.release()
    assert run.ended() is None


# --- stop, lease, cancel ------------------------------------------------------------------------


def test_a_stop_ends_a_paused_run_at_once_and_latches(stack):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    ann.step()
    before = paused(bus, 2).pose
    client(stack, bus, "viewer").stop()
    error = run.ended()
    assert isinstance(error, Stopped)
    assert error.by == "viewer"
    state = now(bus)
    assert (state.safety, state.program, state.line) == ("stopped", "idle", 0)
    assert state.pose == before
    for verb in (ann.step, ann.pause, ann.cancel):
        with pytest.raises(Declined, match="no program is running"):
            verb()
    with pytest.raises(Declined, match="reset, then resume"):
        ann.resume()
    ann.reset()
    ann.resume()
    assert Run(bus, PICK).ended() is None


def test_a_stop_ends_a_step_in_mid_line(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE, hold=True)
    paused(bus, 1)
    ann.step()
    assert robot.begun.acquire(timeout=PATIENCE)
    ann.stop()
    assert isinstance(run.ended(), Stopped)
    assert at_park(now(bus))


def test_a_paused_run_stops_when_its_owner_is_gone(stack):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    ann.release()
    assert isinstance(run.ended(), Stopped)
    state = now(bus)
    assert (state.safety, state.owner) == ("stopped", None)
    assert at_park(state)


def test_a_held_run_is_cancelled_without_a_latch_and_the_next_one_runs(stack):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    assert ann.cancel().ok
    error = run.ended()
    assert isinstance(error, Stopped)
    assert error.by == "you, before anything moved"
    state = wait_state(bus, lambda state: state.program == "idle")
    assert state.safety == "normal"
    assert at_park(state)
    assert Run(bus, PICK).ended() is None


def test_a_run_is_cancelled_half_way_too_and_the_arm_stays_where_it_is(stack):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True)
    for line in (1, 2, 3):
        paused(bus, line)
        ann.step()
    before = paused(bus, 4).pose
    ann.cancel()
    assert run.ended().by == "you"
    assert now(bus).pose == before
    assert bus.ask(bus.keys.world("r1"), None, WorldSnapshot).scene.get("a1").held
    ann.load(Scene())  # the driver is free again


def test_what_moves_is_not_cancelled_but_paused_or_stopped(stack):
    robot, bus, ann = by_hand(stack)
    run = Run(bus, TWO_A_LINE)
    assert robot.begun.acquire(timeout=PATIENCE)
    with pytest.raises(Declined) as caught:
        ann.cancel()
    assert caught.value.code == "running"
    robot.motions.release(20)
    assert run.ended() is None


def test_an_earlier_stop_is_not_named_for_a_later_cancel(stack):
    bus, ann = owned(stack)
    client(stack, bus, "viewer").stop()
    ann.reset()
    ann.resume()
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    ann.cancel()
    assert "viewer" not in str(run.ended())


# --- refusals -----------------------------------------------------------------------------------


@pytest.mark.parametrize("verb", ["pause", "step", "cancel"])
def test_where_no_program_runs_there_is_nothing_to_hold(stack, verb):
    bus, ann = owned(stack)
    with pytest.raises(Declined) as caught:
        getattr(ann, verb)()
    assert caught.value.code == "not_running"
    assert now(bus).program == "idle"


def test_going_home_is_no_program_and_cannot_be_held(stack):
    robot, bus, ann = by_hand(stack)
    going = threading.Thread(target=ann.home)
    going.start()
    assert robot.begun.acquire(timeout=PATIENCE)
    with pytest.raises(Declined) as caught:
        ann.pause()
    assert caught.value.code == "not_running"
    robot.motions.release(20)
    going.join(PATIENCE)
    assert now(bus).program == "idle"


@pytest.mark.parametrize("verb", ["pause", "resume", "step", "cancel"])
def test_only_the_owner_may_and_a_stranger_is_told_who_it_is(stack, verb):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    bob = client(stack, bus, "bob")
    with pytest.raises(Declined, match="held by ann: only it can move, pause or step"):
        getattr(bob, verb)()
    by_epoch = Sender(stack, bus, "bob", "s2").send(verb, epoch=now(bus).epoch)
    assert by_epoch.code == "not_owner"
    assert "held by ann" in by_epoch.text
    state = now(bus)
    assert (state.program, state.line) == ("paused", 1)
    ann.cancel()
    run.ended()


@pytest.mark.parametrize("verb", ["pause", "resume", "step", "cancel"])
def test_late_and_repeated_commands_change_nothing(stack, verb):
    bus, _ = owned(stack)
    run = Run(bus, PICK, hold=True)
    paused(bus, 1)
    other = Sender(stack, bus, "ann", "s2")
    other.epoch = now(bus).epoch
    assert other.send(verb, deadline=0.0).code == "late"
    assert other.send(verb, seq=0).code == "stale_seq"
    state = now(bus)
    assert (state.program, state.line) == ("paused", 1)
    assert run.steps.empty()


# --- nobody loses patience ----------------------------------------------------------------------


def test_a_paused_run_does_not_time_out_for_whoever_follows_it(stack):
    bus, ann = owned(stack)
    run = Run(bus, PICK, hold=True, arm=BusArm(bus, "ann", silence=0.4))
    paused(bus, 1)
    with pytest.raises(queue.Empty):
        run.ended(patience=0.6)
    ann.resume()
    assert run.ended() is None


def test_a_run_that_falls_silent_while_it_should_move_does(stack):
    _, bus, _ = by_hand(stack)
    run = Run(bus, TWO_A_LINE, arm=BusArm(bus, "ann", silence=0.01))
    assert isinstance(run.ended(), MoveTimeout)


# --- the gate alone -----------------------------------------------------------------------------


def test_a_gate_that_nobody_holds_lets_everything_pass():
    told = []
    gate = Gate(Place(1), False, told.append)
    gate.begin()
    for line in (1, 1, 2):
        gate.arrive(Place(line))
    assert told == [False, False], "as each line begins"
    assert not gate.held


def test_a_step_ends_with_the_pass_of_a_loop_over_one_line():
    told, passed = queue.Queue(), []
    gate = Gate(Place(2, 2), True, told.put)

    def run():
        gate.begin()
        for place in (Place(2, 2), Place(2, 2), Place(2, 4), Place(3, 5)):
            gate.arrive(place)
            passed.append(place)

    thread = threading.Thread(target=run)
    thread.start()
    for expected in (0, 2, 3):
        while not told.get(timeout=PATIENCE):
            pass  # a line began
        assert len(passed) == expected
        gate.step()
    thread.join(PATIENCE)
    assert len(passed) == 4


def test_a_gate_that_was_ended_lets_nothing_pass():
    gate = Gate(Place(1), True, lambda held: None)
    gate.end("ann")
    gate.end("bob")
    gate.begin()
    gate.resume()
    with pytest.raises(Stopped) as caught:
        gate.arrive(Place(1))
    assert caught.value.by == "ann"
    assert not gate.held
