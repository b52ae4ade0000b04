"""STOP from the client's side: what is acknowledged late is acknowledged."""

import threading
from contextlib import ExitStack

import pytest
from bridge_world import PATIENCE, bridge, client

from agent.bus import MemoryBus
from agent.client import Client
from agent.errors import Declined, NoAnswer, NoService
from agent.messages import RobotReply, StopRequest
from agent.stopping import ask_to_stop

pytestmark = pytest.mark.live

STOP = StopRequest("ann")


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


class SlowBridge:
    """Acknowledges a stop only after so many further requests were put on the bus."""

    def __init__(self, stack, bus, further):
        self._further, self._changed = further, threading.Condition()
        self.puts, self.over = 0, False
        key = bus.keys.stop("r1")
        stack.enter_context(bus.subscribe(key, self._put))
        stack.enter_context(bus.serve(key, self._asked, workers=32))
        stack.callback(self._end)

    def _end(self):
        with self._changed:
            self.over = True
            self._changed.notify_all()

    def _put(self, key, message):
        with self._changed:
            self.puts += 1
            self._changed.notify_all()

    def _asked(self, key, request):
        with self._changed:
            until = self.puts + self._further
            assert self._changed.wait_for(lambda: self.over or self.puts >= until, PATIENCE)
        return RobotReply(True, 0, "stopped", f"stopped by {request.by}")


@pytest.fixture
def bus(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    return bus


def test_an_acknowledgement_that_takes_longer_than_the_pause_between_requests_counts(stack, bus):
    SlowBridge(stack, bus, further=4)
    assert ask_to_stop(bus, "r1", STOP, PATIENCE).text == "stopped by ann"


def test_it_is_said_again_for_as_long_as_nobody_acknowledges_it(stack, bus):
    slow = SlowBridge(stack, bus, further=1000)
    with pytest.raises(NoAnswer, match=r"did not acknowledge the stop within 0\.5 s"):
        ask_to_stop(bus, "r1", STOP, timeout=0.5)
    assert slow.puts > 1


def test_a_bridge_that_comes_later_is_still_reached(stack, bus):
    asked, found = threading.Event(), []
    stack.enter_context(bus.subscribe(bus.keys.stop("r1"), lambda key, message: asked.set()))
    ask = threading.Thread(target=lambda: found.append(ask_to_stop(bus, "r1", STOP, PATIENCE)))
    ask.start()
    assert asked.wait(PATIENCE)
    answer = RobotReply(True, 0, "stopped")
    stack.enter_context(bus.serve(bus.keys.stop("r1"), lambda key, request: answer))
    ask.join(PATIENCE)
    assert found == [answer]


def test_where_nobody_serves_the_robot_the_stop_says_so(bus):
    with pytest.raises(NoService, match="nobody serves"):
        ask_to_stop(bus, "r1", STOP, timeout=0.1)


def test_an_arm_that_could_not_be_told_is_not_passed_off_as_stopped(stack, bus):
    def broken(key, request):
        raise Declined("LinkDown", "the cable is out")

    stack.enter_context(bus.serve(bus.keys.stop("r1"), broken))
    with pytest.raises(Declined, match="the cable is out"):
        ask_to_stop(bus, "r1", STOP, PATIENCE)


class Counting(MemoryBus):
    """Counts the links that are opened from it."""

    opened = 0

    def sibling(self):
        self.opened += 1
        return super().sibling()


def test_who_takes_the_arm_has_the_link_for_a_stop_before_anything_moves(stack):
    hub = bridge(stack)._hub
    link = Counting(hub=hub)
    stack.callback(link.close)
    ann = Client(link, "ann")
    stack.callback(ann.close)
    ann.acquire()
    assert link.opened == 1
    ann.stop()
    assert link.opened == 1


def test_a_stop_needs_no_lease(stack):
    bus = bridge(stack)
    client(stack, bus, "ann").acquire()
    assert client(stack, bus, "bob").stop().text == "stopped by bob"
