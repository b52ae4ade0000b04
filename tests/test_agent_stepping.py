"""A client has a program held, sees the line that comes next, and steps it over the agent."""

import queue
import threading
from contextlib import ExitStack

import pytest
from bridge_world import APPLE, PATIENCE, bridge, client, wait_state

from agent.bus import MemoryBus
from agent.errors import Declined, NoAnswer
from agent.messages import Ack, Decision, Event, RobotState, Turn, Waypoint
from agent.service import AgentService
from robot_bridge.ideal import predict
from scene.service import SceneService

pytestmark = pytest.mark.live

SIX = """\
robot.move(apple.x, apple.y, 0.9, 0)
robot.move(apple.x, apple.y, apple.z + apple.tall, 0)
robot.grip(True)
robot.move(apple.x, apple.y, 0.9, 0)
robot.move(-0.5, 0.3, 0.9, 0)
robot.grip(False)"""
HERE = Waypoint(0, 0, 0.9, 0, False)


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


def act(request):
    """A clarifier that knows one program."""
    return Decision("act", "because", request.dialog, program=SIX, kind="manipulate",
                    touched=("a1",))  # fmt: skip


@pytest.fixture
def bus(stack, executor):
    """Bridge, eye and agent on one bus in this process."""
    bus = bridge(stack)
    for service in (SceneService(bus), AgentService(bus, act, executor, predict)):
        service.start()
        stack.callback(service.close)
    return bus


@pytest.fixture
def ann(stack, bus):
    return client(stack, bus)


class Said:
    """A sentence or program whose events are gathered on a thread."""

    def __init__(self, events):
        self.stages, self.turns = queue.Queue(), queue.Queue()
        threading.Thread(target=self._follow, args=(events,), daemon=True).start()

    def _follow(self, events):
        for event in events:
            self.stages.put(event.stage)
            if event.turn is not None:
                self.turns.put(event.turn)

    def turn(self):
        return self.turns.get(timeout=PATIENCE)


def held_before(bus, line):
    return wait_state(bus, lambda state: (state.program, state.line) == ("paused", line))


def test_a_client_steps_a_program_to_its_end_and_sees_each_line_marked_in_order(bus, ann):
    states, held = queue.Queue(), []
    ann.on_state(states.put)

    def seen_held(line):
        """Wait for the client's own sight of the line: it is called back with the newest state."""
        while not held or held[-1] != line:
            state = states.get(timeout=PATIENCE)
            if state.program == "paused":
                held.append(state.line)

    said = Said(ann.run_program(SIX, "manipulate", hold=True))
    for line in range(1, 7):
        seen_held(line)
        assert ann.step().ok
    turn = said.turn()
    assert (turn.status, len(turn.trajectory)) == ("done", 6)
    assert list(dict.fromkeys(held)) == [1, 2, 3, 4, 5, 6]
    assert [said.stages.get() for _ in range(said.stages.qsize())] == [
        "heard", "program", *["step"] * 6, "turn",
    ]  # fmt: skip


def test_a_sentence_is_held_shown_and_run_when_the_person_wants_it(bus, ann):
    said = Said(ann.say("move the apple", hold=True))
    held_before(bus, 1)
    assert [said.stages.get(timeout=PATIENCE) for _ in range(2)] == ["heard", "program"]
    assert ann.scene().get("a1").x == APPLE.x
    ann.resume()
    assert said.turn().status == "done"
    assert ann.scene().get("a1").x == pytest.approx(-0.5)


def test_a_held_sentence_is_cancelled_and_the_next_one_runs_without_a_reset(bus, ann):
    said = Said(ann.say("move the apple", hold=True))
    held_before(bus, 1)
    ann.cancel()
    turn = said.turn()
    assert (turn.reason, turn.trajectory) == ("cancelled", ())
    assert "nothing moved" in turn.reply
    assert Said(ann.say("move the apple")).turn().status == "done"


def test_a_held_sentence_is_stopped_by_anybody_and_needs_a_reset_then(stack, bus, ann):
    said = Said(ann.say("move the apple", hold=True))
    held_before(bus, 1)
    client(stack, bus, "viewer").stop()
    turn = said.turn()
    assert (turn.status, turn.reason) == ("failed", "cancelled")
    assert "viewer" in turn.reply
    assert Said(ann.say("move the apple")).turn().status == "refused"


def test_a_dry_run_is_never_held(bus, ann):
    assert Said(ann.say("move the apple", dry_run=True, hold=True)).turn().status == "answered"
    assert ann.state().program == "idle"


def test_who_may_not_move_the_arm_may_not_hold_it_either(stack, bus, ann):
    ann.acquire()
    bob = client(stack, bus, "bob")
    assert Said(bob.say("move the apple", hold=True)).turn().status == "refused"
    with pytest.raises(Declined, match="held by ann"):
        bob.step()


# --- a client's patience ------------------------------------------------------------------------


class Paused:
    """A bridge and an agent that take a sentence, and say that its program is paused."""

    def __init__(self, stack, owner="ann"):
        self.bus = MemoryBus()
        stack.callback(self.bus.close)
        self.owner = owner
        stack.enter_context(self.bus.serve(self.bus.keys.submit("*"), self._take))
        stack.enter_context(self.bus.token(self.bus.keys.alive("agent", "a1")))
        self.tell("paused")

    def _take(self, key, submit):
        self.submit = submit
        self.event(1, "heard")
        return Ack(submit.request_id)

    def event(self, seq, stage, turn=None):
        event = Event(self.submit.request_id, seq, stage, turn=turn)
        self.bus.publish(self.bus.keys.event("ann"), event)

    def tell(self, program):
        state = RobotState(1, 0.0, "r1", "normal", program, HERE, self.owner)
        self.bus.publish(self.bus.keys.state("r1"), state)


def test_a_paused_program_does_not_count_against_the_clients_patience(stack):
    world = Paused(stack)
    said = Said(client(stack, world.bus).say("x", timeout=0.3))
    with pytest.raises(queue.Empty):
        said.turns.get(timeout=0.6)
    world.event(2, "turn", Turn(say="x", status="done", reply="Done."))
    assert said.turn().status == "done"


def test_once_it_goes_on_the_time_counts_again(stack):
    world = Paused(stack)
    events = client(stack, world.bus).say("x", timeout=0.3)
    assert next(events).stage == "heard"
    world.tell("running")
    with pytest.raises(NoAnswer):
        next(events)


def test_the_pause_of_somebody_elses_program_does_not(stack):
    world = Paused(stack, owner="bob")
    events = client(stack, world.bus).say("x", timeout=0.3)
    assert next(events).stage == "heard"
    with pytest.raises(NoAnswer):
        next(events)
