"""The Dobot behind the Robot protocol: start-up, refusals without a byte, stop, faults, close."""

import threading
import time

import pytest
from dobot_world import until

from agent.config import DobotConfig
from agent.errors import (
    AlarmError,
    LinkDown,
    MoveTimeout,
    NoReply,
    NotAtTarget,
    NotReady,
    RobotError,
    Stopped,
    Unreachable,
)
from agent.messages import Command
from evals.fault_matrix import COMING, LASTING, SUDDEN, arm, play, settled, there_and_back
from robot_bridge import dobot_frames as ids
from robot_bridge.api import PARK, approve
from robot_bridge.dobot_arm import DobotRobot, open_dobot
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults
from robot_bridge.ideal import IdealRobot
from robot_bridge.moves import go_home, step
from scene.types import Scene, SceneObject

SETTINGS = {ids.TOOL, ids.PTP_COORDINATE, ids.PTP_COMMON}
SUCTION = [Command("grip", 0, 0, 0, 0, on) for on in (True, False)]


@pytest.fixture
def bench():
    with arm(Faults()) as made:
        yield made


def seen(emulator):
    with emulator.lock:
        return [frame.id for frame in emulator.controller.seen]


def begun(bench, plan=None):
    """A plan on its way, on a thread of its own; where it ended up."""
    ended = []

    def run():
        try:
            list(bench.robot.run(plan or there_and_back(bench.robot)))
            ended.append(None)
        except RobotError as error:
            ended.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    until(lambda: ids.PTP in seen(bench.emulator) and bench.emulator.controller.moving)
    return thread, ended


# --- start-up and home -------------------------------------------------------------------------


def test_start_up_is_in_the_order_of_the_docs_and_moves_nothing():
    with Emulator() as emulator:
        robot = DobotRobot(DobotConfig(port=emulator.port))
        robot.reset()
        order = [one for one in seen(emulator) if one not in (ids.POSE, ids.PTP_JUMP, ids.STOP)]
        assert order == [2, 20, 245, 20, 240, 60, 81, 83]
        assert emulator.controller.settings[ids.TOOL] == ids.floats(59.7, 0, 0)
        assert not ids.MOTIONS & set(order)
        robot.close()


def test_alarms_of_before_are_cleared_only_after_the_queue_they_held():
    with Emulator(Faults(under_alarm="holds"), 40.0) as emulator:
        emulator.controller.alarms.add(0x30)
        motion = ids.Frame(ids.PTP, ids.QUEUED, bytes((2,)) + ids.floats(250, 0, 0, 0))
        emulator.controller.receive(motion, emulator.now())
        open_dobot(DobotConfig(port=emulator.port)).close()
        assert emulator.controller.alarms == set() and not emulator.controller.made


def test_a_motion_that_a_dead_program_left_behind_is_no_place_to_begin():
    with Emulator(speed=10.0) as emulator:
        settled(emulator)
        left = ids.Frame(ids.PTP, ids.QUEUED, bytes((2,)) + ids.floats(250, 60, 40, 0))
        emulator.controller.receive(left, emulator.now())
        robot = DobotRobot(DobotConfig(port=emulator.port), pace=10.0)
        robot.reset()
        with pytest.raises(NotReady, match="plan again"):
            list(robot.run(approve([Command("move", 0, 0, 0.9, 0, False)], robot.pose(), robot)))
        assert seen(emulator).count(ids.PTP) == 1
        robot.close()


def test_programs_wait_for_home_and_power_on_asks_for_it_again():
    with Emulator(speed=40.0) as emulator:
        robot = DobotRobot(DobotConfig(port=emulator.port), pace=40.0)
        robot.reset()
        plan = approve([Command("move", 0, 0, 0.9, 0, False)], robot.pose(), robot)
        with pytest.raises(NotReady, match="not homed"):
            robot.run(plan)
        assert ids.PTP not in seen(emulator)
        pose = go_home(robot)
        assert (pose.x, pose.y, pose.z) == pytest.approx((PARK.x, PARK.y, PARK.z), abs=1e-4)
        assert emulator.controller.homed
        list(robot.run(there_and_back(robot)))
        robot.close()
        again = DobotRobot(DobotConfig(port=emulator.port), pace=40.0)
        again.reset()
        list(again.run(approve(SUCTION, again.pose(), again)))  # still homed for the next program
        with emulator.lock:
            emulator.controller.switch_on(emulator.now())
        with pytest.raises(NotReady, match="not homed"):
            again.run(approve(SUCTION, again.pose(), again))
        again.close()


def test_a_port_without_a_dobot_says_so(tmp_path):
    with pytest.raises(LinkDown, match="no such port"):
        open_dobot(DobotConfig(port=str(tmp_path / "none")))
    with Emulator(Faults(dropped=10**6)) as emulator, pytest.raises(NoReply, match="3 times"):
        open_dobot(DobotConfig(port=emulator.port))


# --- nothing is sent that cannot be done ---------------------------------------------------------


def test_an_unreachable_plan_sends_not_a_byte(bench):
    elsewhere = IdealRobot()
    far = [Command("move", 0, 0, 0.9, 0, False, 1), Command("move", 0, 1.7, 0.1, 0, False, 2)]
    plan = approve(far, bench.robot.pose(), elsewhere)
    with bench.emulator.lock:
        before = len(bench.emulator.controller.seen)
    with pytest.raises(Unreachable, match="out of reach") as caught:
        bench.robot.run(plan)
    assert caught.value.line == 2
    assert len(seen(bench.emulator)) == before


def test_a_keep_out_of_this_arm_counts_whoever_approved(bench):
    fast = approve([Command("move", 0, 0, 0.9, 0, False)], bench.robot.pose(), IdealRobot())
    assert fast.limits.speed > 0
    steps = list(bench.robot.run(fast))  # durations and speed are this arm's own
    assert steps[0].reached.y == pytest.approx(0.0, abs=1e-4)
    assert bench.emulator.controller.settings[ids.PTP_COORDINATE] == ids.floats(100, 100, 80, 80)


def test_a_small_step_goes_through_the_check_like_any_motion(bench):
    robot = bench.robot
    (done,) = robot.run(step(robot.pose(), robot, "x", 0.2))
    assert done.reached.x == pytest.approx(0.2, abs=1e-4)
    before = seen(bench.emulator).count(ids.PTP)
    with pytest.raises(Unreachable):
        step(robot.pose(), robot, "y", -0.8)
    assert seen(bench.emulator).count(ids.PTP) == before


# --- what it reports -----------------------------------------------------------------------------


def test_what_is_held_is_not_sensed_and_the_table_follows_the_arm(bench):
    apple = SceneObject(id="a", name="apple", x=0.3, y=0.2, width=0.12, height=0.12, tall=0.1)
    robot = bench.robot
    robot.load(Scene(objects=(apple,)))
    told = [Command("move", 0.3, 0.2, z, 0, False) for z in (0.9, 0.1)]
    told += [SUCTION[0], Command("move", -0.3, 0.2, 0.9, 0, True)]
    steps = list(robot.run(approve(told, robot.pose(), robot)))
    assert [step.held for step in steps] == [None] * 4
    assert robot.scene().get("a").held
    assert robot.scene().get("a").x == pytest.approx(-0.3, abs=1e-4)
    with pytest.raises(NotReady, match="let go"):
        robot.load(Scene())


def test_the_pump_is_off_after_a_release_and_after_close(bench):
    controller = bench.emulator.controller
    list(bench.robot.run(approve(SUCTION[:1], bench.robot.pose(), bench.robot)))
    assert controller.pump
    list(bench.robot.run(approve(SUCTION[1:], bench.robot.pose(), bench.robot)))
    assert not controller.pump
    list(bench.robot.run(approve(SUCTION[:1], bench.robot.pose(), bench.robot)))
    bench.robot.close()
    until(lambda: not controller.pump)


# --- stop, reset, close --------------------------------------------------------------------------


@pytest.mark.parametrize("now", [False, True])
def test_a_stop_halts_short_of_the_target_keeps_the_grip_and_latches(now):
    with arm(Faults(), speed=30.0) as bench:
        list(bench.robot.run(approve(SUCTION[:1], bench.robot.pose(), bench.robot)))
        thread, ended = begun(bench)
        bench.robot.stop(now)
        thread.join()
        assert isinstance(ended[0], Stopped)
        controller = bench.emulator.controller
        assert controller.pump and controller.force_stops and not controller.moving
        stood = controller.pose
        with pytest.raises(NotReady, match="reset"):
            bench.robot.run(there_and_back(bench.robot))
        bench.robot.reset()
        assert controller.pose == stood and stood.y != pytest.approx(-67.5, abs=1)
        list(bench.robot.run(there_and_back(bench.robot)))


def test_a_reset_right_after_a_stop_does_not_let_the_plan_go_on():
    with arm(Faults(), speed=30.0) as bench:
        thread, ended = begun(bench)
        bench.robot.stop()
        with pytest.raises(NotReady, match="still ending"):
            bench.robot.reset()
        thread.join()
        assert isinstance(ended[0], Stopped) and seen(bench.emulator).count(ids.PTP) == 1
        bench.robot.reset()


def test_force_stop_is_sent_at_once_though_a_reply_is_waited_for(bench):
    thread, _ = begun(bench)
    bench.emulator.faults.dropped = 10**6
    until(lambda: bench.emulator.faults.dropped < 10**6)
    asked = time.monotonic()
    bench.robot.stop(now=True)
    until(lambda: bench.emulator.controller.force_stops)
    with bench.emulator.lock:
        at = next(when for when, one in bench.emulator.arrived if one == ids.FORCE_STOP)
    assert at - asked <= 0.2  # a reply is waited for twice as long; `armchat bench robot` measures
    bench.emulator.faults.dropped = 0
    thread.join()


def test_a_stop_while_it_homes_ends_the_homing():
    with Emulator(speed=4.0) as emulator:
        robot = DobotRobot(DobotConfig(port=emulator.port), pace=4.0)
        robot.reset()
        ended = []

        def home():
            try:
                robot.home()
            except RobotError as error:
                ended.append(error)

        thread = threading.Thread(target=home)
        thread.start()
        until(lambda: ids.HOME in seen(emulator))
        robot.stop()
        thread.join()
        assert isinstance(ended[0], Stopped) and not emulator.controller.homed
        robot.close()


def test_close_does_not_wait_and_ends_what_runs(bench):
    thread, ended = begun(bench)
    began = time.monotonic()
    bench.robot.close()
    assert time.monotonic() - began <= 0.3
    thread.join(5.0)
    assert not thread.is_alive() and isinstance(ended[0], Stopped | LinkDown)
    until(lambda: bench.emulator.controller.force_stops)
    with pytest.raises(NotReady, match="closed"):
        bench.robot.run(there_and_back_of(bench))
    with pytest.raises(LinkDown):
        bench.robot.pose()
    bench.robot.close()


def there_and_back_of(bench):
    return approve([Command("move", 0, 0, 0.9, 0, False)], PARK, bench.robot)


def test_a_plan_that_nobody_takes_to_its_end_leaves_nothing_behind(bench):
    steps = bench.robot.run(there_and_back(bench.robot))
    next(steps)
    steps.close()
    assert bench.emulator.controller.force_stops == 1 and not bench.emulator.controller.moving
    list(bench.robot.run(there_and_back(bench.robot)))


# --- faults: what each is called, and how soon it is seen ----------------------------------------


@pytest.mark.parametrize(
    ("fault", "error", "words"),
    [
        ({"alarm_at": 0.5, "alarm": 0x30}, AlarmError, "too fast"),
        ({"alarm_at": 0.5, "alarm": 0x50}, AlarmError, "home it"),
        ({"alarm_at": 0.5, "alarm": 0x41, "reassert": True}, AlarmError, "cannot be cleared"),
        ({"frozen": True}, MoveTimeout, "3 s"),
        ({"lost_reply": 1}, NoReply, "outcome unknown"),
        ({"power_at": 0.5}, MoveTimeout, "not moved"),
        ({"capacity": 0}, NotReady, "full"),
        ({"under_alarm": "holds", "alarm_at": 0.5, "alarm": 0x22}, AlarmError, "unlock"),
    ],
)
def test_what_goes_wrong_on_the_way_has_a_name(fault, error, words):
    with arm(Faults()) as bench:
        plan = there_and_back(bench.robot)
        for name, value in fault.items():
            setattr(bench.emulator.faults, name, value)
        with pytest.raises(error, match=words) as caught:
            list(bench.robot.run(plan))
        if isinstance(caught.value, AlarmError):
            assert caught.value.codes == (fault["alarm"],) and caught.value.remedy
        assert not bench.emulator.controller.moving or bench.emulator.faults.frozen


def test_a_motion_that_is_skipped_and_called_done_is_not_at_its_target(bench):
    controller = bench.emulator.controller
    made = controller._planned
    controller._planned = lambda frame: made(frame)._replace(until=0.0)
    with pytest.raises(NotAtTarget):
        list(bench.robot.run(there_and_back(bench.robot)))


def test_after_a_lost_step_it_must_be_homed_and_after_an_alarm_that_stays_reset(bench):
    bench.emulator.faults.alarm_at, bench.emulator.faults.alarm = 0.5, 0x52
    with pytest.raises(AlarmError):
        list(bench.robot.run(there_and_back(bench.robot)))
    bench.robot.reset()
    with pytest.raises(NotReady, match="not homed"):
        bench.robot.run(there_and_back(bench.robot))
    bench.robot.home()
    bench.emulator.faults.alarm_at, bench.emulator.faults.alarm = 0.5, 0x41
    bench.emulator.faults.reassert = True
    plan = there_and_back(bench.robot)
    with pytest.raises(AlarmError):
        list(bench.robot.run(plan))
    with pytest.raises(NotReady, match="unlock"):
        bench.robot.run(plan)
    with pytest.raises(AlarmError, match="cannot be cleared"):
        bench.robot.reset()
    bench.emulator.faults.reassert = False
    bench.robot.reset()
    list(bench.robot.run(there_and_back(bench.robot)))


def test_an_unplugged_cable_is_seen_within_a_second_and_plugged_in_again_after_a_reset():
    with arm(Faults(), pace=1.0) as bench:
        thread, ended = begun(bench)
        began = time.monotonic()
        bench.emulator.unplug()
        thread.join(5.0)
        assert time.monotonic() - began <= 1.0
        assert isinstance(ended[0], LinkDown) and "motion state unknown" in str(ended[0])
        with pytest.raises(LinkDown):
            bench.robot.pose()
        with pytest.raises(LinkDown):
            bench.robot.reset()
        bench.emulator.plug()
        bench.robot.reset()
        assert bench.robot.pose()


def test_a_frozen_arm_is_seen_within_three_and_a_half_seconds():
    with arm(Faults(), pace=1.0) as bench:
        plan = approve([Command("move", 0.3, -0.9, 0.9, 0, False)], PARK, bench.robot)
        steps = bench.robot.run(plan)
        bench.emulator.faults.frozen = True
        began = time.monotonic()
        with pytest.raises(MoveTimeout):
            next(steps)
        assert time.monotonic() - began <= 3.5


FAULTS = (*LASTING, *COMING, *SUDDEN)


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_on_the_way_ends_well_or_by_its_name_and_the_next_plan_runs(fault):
    assert play(fault, "move", True).why == ""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_at_rest_ends_well_or_by_its_name_and_the_next_plan_runs(fault):
    assert play(fault, "move", False).why == ""


@pytest.mark.parametrize("command", ["pose", "reset", "grip", "home", "stop", "stop now", "close"])
@pytest.mark.parametrize("fault", ["unplugged", "lost reply to a queued command", "bad sum"])
@pytest.mark.parametrize("moving", [False, True])
def test_every_command_bears_the_worst_faults(fault, command, moving):
    assert play(fault, command, moving).why == ""


def test_settled_is_what_homing_comes_to():
    """The short cut of these tests leads where the long way does."""
    with Emulator(speed=100.0) as homed, Emulator(speed=100.0) as short:
        robot = DobotRobot(DobotConfig(port=homed.port), pace=100.0)
        robot.reset()
        robot.home()
        settled(short)
        one, other = homed.controller, short.controller
        assert one.pose == pytest.approx(other.pose, abs=1e-4) and one.homed and other.homed
        assert one.settings[ids.PTP_JUMP] == other.settings[ids.PTP_JUMP]
        robot.close()
