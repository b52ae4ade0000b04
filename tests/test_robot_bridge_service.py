"""The bridge: who may move the robot, what it is told, and a STOP that never waits."""

import queue
import threading
import time
from contextlib import ExitStack

import pytest
from bridge_world import BACK_AND_FORTH, PATIENCE, PICK, Sender, bridge, client, wait_state

from agent.bus import MemoryBus
from agent.errors import BusError, Declined, NoService
from agent.messages import (
    Command,
    RobotCommand,
    RobotLimits,
    RobotReply,
    RobotState,
    StopRequest,
    WorldSnapshot,
)
from robot_bridge import service
from robot_bridge.ideal import IdealRobot
from robot_bridge.lease import Lease
from robot_bridge.service import RobotService
from scene.types import Scene, SceneObject

pytestmark = pytest.mark.live


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


def test_the_owner_runs_a_plan_and_sees_each_step_and_the_world_after_it(stack):
    bus = bridge(stack)
    ann = Sender(stack, bus)
    ann.own()
    steps, end = ann.run_to_end(PICK)
    assert [step.line for step in steps] == [1, 2, 3, 4]
    assert end.error is None
    world = bus.ask(bus.keys.world("r1"), None, WorldSnapshot).scene
    assert world.get("a1").held
    assert bus.ask(bus.keys.state("r1"), None, RobotState).program == "idle"


def test_nothing_moves_without_passing_the_bridges_own_check(stack):
    bus = bridge(stack)
    ann = Sender(stack, bus)
    ann.own()
    reply = ann.send("run", PICK, commands=(Command("move", 9.0, 0, 0.9, 0, False, 3),))
    assert (reply.ok, reply.code) == (False, "Unreachable")
    reply = ann.send("run", PICK, scene=Scene())
    assert (reply.ok, reply.code) == (False, "NotReady")
    assert "another program, scene or robot" in reply.text
    assert bus.ask(bus.keys.state("r1"), None, RobotState).program == "idle"


def test_without_a_token_there_is_no_lease(stack):
    ann = Sender(stack, bridge(stack))
    assert ann.send("acquire").code == "no_lease_token"


def test_one_owner_at_a_time(stack):
    bus = bridge(stack)
    ann, bob = Sender(stack, bus), Sender(stack, bus, "bob", "s2")
    ann.own()
    bob.token()
    assert bob.send("acquire").code == "busy"
    assert bob.send("run", PICK).code == "not_owner"
    assert bob.send("run", PICK, epoch=ann.epoch).code == "not_owner"
    assert ann.send("release").ok
    assert bob.send("acquire").epoch == ann.epoch + 1
    assert ann.send("run", PICK).code == "not_owner"


def test_strangers_without_a_token_do_not_hold_up_the_owners_commands(stack, monkeypatch):
    bus = bridge(stack)
    ann = Sender(stack, bus)
    ann.own()
    monkeypatch.setattr(service, "TOKEN_DELAY", 3600.0)  # whoever waits for a token waits for ever
    strangers = [Sender(stack, bus, f"stranger{n}") for n in range(5)]
    assert {one.send("acquire").code for one in strangers} == {"busy"}
    assert ann.send("keepalive").ok


def test_a_command_is_obeyed_once_and_in_time(stack):
    ann = Sender(stack, bridge(stack))
    ann.own()
    assert ann.send("resume").ok
    assert ann.send("resume", seq=ann.seq - 1).code == "stale_seq"
    assert ann.send("run", PICK, deadline=time.time() - 1).code == "late"
    assert ann.send("run", PICK, epoch=ann.epoch + 1).code == "not_owner"
    assert ann.send("run").code == "bad_payload"


def test_a_verb_that_nobody_knows_and_one_for_all_robots_are_declined(stack):
    bus = bridge(stack)
    ann = Sender(stack, bus)
    ann.own()
    with pytest.raises(Declined, match="known: "):
        ann.send("dance")
    with pytest.raises(Declined) as caught:
        bus.ask(bus.keys.command("*", "run"), StopRequest("ann"), RobotReply)
    assert caught.value.code == "wildcard"
    with pytest.raises(Declined) as caught:
        bus.ask(bus.keys.command("r1", "run"), StopRequest("ann"), RobotReply)
    assert caught.value.code == "bad_payload"


def test_stop_halts_a_plan_that_runs_and_stays_until_reset_and_resume(stack):
    bus = bridge(stack, pace=1.0)
    ann, viewer = Sender(stack, bus), client(stack, bus, "viewer")
    ann.own()
    assert ann.send("run", BACK_AND_FORTH).ok
    assert ann.send("run", PICK).code == "running"
    viewer.stop()
    _, end = ann.until_end()
    assert (end.error, end.text) == ("Stopped", "viewer")
    assert "viewer" in bus.ask(bus.keys.state("r1"), None, RobotState).text
    assert ann.send("run", PICK).code == "stopped"
    assert ann.send("resume").code == "stopped"
    assert ann.send("reset").ok
    assert ann.send("run", PICK).code == "stopped"
    assert ann.send("resume").ok
    assert bus.ask(bus.keys.state("r1"), None, RobotState).safety == "normal"


def test_stop_works_while_every_other_thread_of_the_bridge_is_busy(stack):
    bus = bridge(stack, pace=1.0)
    ann = Sender(stack, bus)
    ann.own()
    assert ann.send("run", BACK_AND_FORTH).ok
    ann.send("pause")
    threads = [
        threading.Thread(target=lambda: bus.ask(bus.keys.state("r1"), None, RobotState))
        for _ in range(20)
    ]
    for thread in threads:
        thread.start()
    assert client(stack, bus, "bob").stop(now=True).ok
    _, end = ann.until_end()
    assert end.error == "Stopped"
    for thread in threads:
        thread.join()


class Sluggish(IdealRobot):
    """A robot whose pose cannot be read just now."""

    def __init__(self):
        super().__init__(Scene())
        self.asked, self.readable, self.stopped = (threading.Event() for _ in range(3))
        self.readable.set()

    def pose(self):
        self.asked.set()
        assert self.readable.wait(PATIENCE)
        return super().pose()

    def stop(self, now=False):
        self.stopped.set()
        super().stop(now)


def test_stop_does_not_wait_for_a_driver_that_is_busy(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    robot = Sluggish()
    service = RobotService(bus, robot)
    service.start()
    stack.callback(service.close)
    ann = client(stack, bus)
    robot.readable.clear()
    robot.asked.clear()
    assert robot.asked.wait(PATIENCE)
    stack.callback(robot.readable.set)
    assert ann.stop().ok
    assert robot.stopped.is_set()


def test_stop_to_a_robot_that_is_not_there_says_so(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    with pytest.raises(NoService):
        client(stack, bus).stop(timeout=0.01)


def test_when_the_owners_token_goes_the_motion_stops_and_the_lease_is_free(stack):
    bus = bridge(stack, pace=1.0)
    ann = Sender(stack, bus)
    token = ann.own()
    assert ann.send("run", BACK_AND_FORTH).ok
    token.close()
    _, end = ann.until_end()
    assert end.error == "Stopped"
    state = wait_state(bus, lambda state: state.owner is None)
    assert state.safety == "stopped"
    bob = client(stack, bus, "bob")
    bob.acquire()
    assert bus.ask(bus.keys.state("r1"), None, RobotState).epoch == ann.epoch + 1


def test_an_owner_that_falls_silent_loses_the_lease_though_its_token_is_there(stack):
    bus = bridge(stack, pace=1.0)
    ann = Sender(stack, bus)
    ann.own()
    assert ann.send("run", BACK_AND_FORTH).ok
    _, end = ann.until_end()
    assert "silent" in end.text
    assert bus.ask(bus.keys.state("r1"), None, RobotState).owner is None


def test_an_owner_that_goes_while_nothing_moves_latches_nothing(stack):
    bus = bridge(stack)
    ann = client(stack, bus)
    ann.acquire()
    ann.release()
    state = wait_state(bus, lambda state: state.owner is None)
    assert state.safety == "normal"


def test_a_simulated_world_is_loaded_by_the_owner_only(stack):
    bus = bridge(stack)
    ann, bob = client(stack, bus), client(stack, bus, "bob")
    pear = SceneObject(id="p1", name="pear", x=0, y=0, width=0.1, height=0.1, tall=0.1)
    ann.load(Scene(objects=(pear,)))
    world = bus.ask(bus.keys.world("r1"), None, WorldSnapshot).scene
    assert [item.id for item in world] == ["p1"]
    with pytest.raises(Declined) as caught:
        bob.load(Scene())
    assert caught.value.code == "busy"


def test_home_limits_and_the_state_on_joining(stack):
    bus = bridge(stack)
    ann = client(stack, bus)
    assert ann.home().ok
    limits = bus.ask(bus.keys.limits("r1"), None, RobotLimits)
    assert limits.commands == 500
    seen = queue.Queue()
    ann.on_state(seen.put)
    assert seen.get(timeout=PATIENCE).owner == "ann"


def test_closing_the_bridge_stops_the_motion_and_takes_its_token_along(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    robot = IdealRobot(Scene(), pace=1.0)
    service = RobotService(bus, robot)
    service.start()
    ann = Sender(stack, bus)
    ann.own()
    assert ann.send("run", BACK_AND_FORTH).ok
    service.close()
    assert ann.until_end()[1].error == "Stopped"
    assert bus.alive(bus.keys.alive("robot", "*")) == ()


def test_two_bridges_cannot_serve_one_robot(stack):
    bus = bridge(stack)
    with pytest.raises(BusError, match="another bridge"):
        RobotService(bus.sibling(), IdealRobot()).start()


# --- the lease alone --------------------------------------------------------------------------


def order(session="s1", seq=1, client="ann", epoch=1):
    return RobotCommand(client, session, epoch, seq, deadline=100.0)


def test_only_the_owners_own_session_keeps_the_lease_alive():
    lease = Lease()
    assert lease.acquire(order(), has_token=True, wall=0.0, now=0.0) == ""
    assert lease.check(order("agent", 1), wall=0.0) == ""
    assert lease.keepalive(order("agent", 2), wall=0.0, now=0.9) == "not_owner"
    assert not lease.silent(1.0)
    assert lease.silent(1.1)
    assert lease.keepalive(order("s1", 2), wall=0.0, now=1.1) == ""
    assert not lease.silent(2.0)


def test_a_second_program_of_the_same_name_does_not_share_the_lease():
    lease = Lease()
    lease.acquire(order(), has_token=True, wall=0.0, now=0.0)
    assert lease.acquire(order("other"), has_token=True, wall=0.0, now=0.0) == "busy"


def test_the_epoch_counts_owners():
    lease = Lease()
    for epoch in (1, 2, 3):
        assert lease.acquire(order(seq=epoch), has_token=True, wall=0.0, now=0.0) == ""
        assert lease.epoch == epoch
        lease.drop()
