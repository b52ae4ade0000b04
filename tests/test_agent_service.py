"""The agent on the bus: sentences in order, one turn each, questions included; stop overtakes."""

import queue
import threading
from contextlib import ExitStack

import msgspec
import pytest

from agent.bus import MemoryBus
from agent.client import Client
from agent.errors import Declined, NoService, RobotError
from agent.messages import (
    Ack,
    ClarifyRequest,
    Command,
    Decision,
    Dialog,
    Option,
    Pending,
    Question,
    Submit,
    Turn,
)
from agent.service import AgentService
from agent.service import broken as ended_by
from agent.turn import Watch
from agent.workers import Workers
from clarifier.service import ClarifierService, decide_over
from robot_bridge.api import approve
from robot_bridge.ideal import IdealRobot, predict
from robot_bridge.service import RobotService
from scene.service import SceneService
from scene.types import Scene, SceneObject
from translator.service import TranslatorService, translate_over

pytestmark = pytest.mark.live

PATIENCE = 10.0
APPLE = SceneObject(id="a1", name="apple", x=0.2, y=0.0, width=0.1, height=0.1, tall=0.1)
WAVE = tuple(
    Command("move", x, 0.5, 0.9, 0, False, i) for i, x in enumerate((-1.0, 1.0) * 40, start=1)
)
WHICH = Question("which", "Which one?", (Option("the left one"), Option("the right one")))


class Wave:
    """A turn in small: "wave" moves the arm, "which" asks, "look" looks, "fail" has a bug."""

    def __init__(self):
        self.said = []
        self.hold = threading.Event()
        self.hold.set()

    def __call__(self, say, dialog, parts, *, task=None, dry_run=False, hold=False, watch=None):
        watch = watch or Watch()
        self.said.append(say)
        self.hold.wait(PATIENCE)
        if dialog.pending:
            text = f"{dialog.pending.text} -> {say}"
            return Turn(say=say, status="answered", reply=text), Dialog()
        if say == "which":
            pending = Dialog(pending=Pending(say, WHICH))
            return Turn(say=say, status="asked", reply=WHICH.text, question=WHICH), pending
        if say == "look":
            reply = " ".join(item.name for item in parts.arm.scene())
            return Turn(say=say, status="answered", reply=reply), dialog
        if say == "fail":
            raise ZeroDivisionError("a bug")
        return self._wave(say, dialog, parts, hold, watch)

    def _wave(self, say, dialog, parts, hold, watch):
        count = 2 if say == "wave" else len(WAVE)
        told = []
        try:
            arm = parts.arm
            plan = approve(WAVE[:count], arm.start(), arm.workspace, "robot.move(...)")
            watch.plan(plan, "manipulate", arm.scene())
            for step in parts.arm.run(plan, hold=hold):
                told.append(step.told)
                watch.step(step)
        except RobotError as error:
            status = "failed" if told else "refused"
            return Turn(say=say, status=status, reply=str(error), reason="unsafe"), dialog
        return Turn(say=say, status="done", reply="Waved.", trajectory=tuple(told)), dialog


@pytest.fixture
def stack():
    with ExitStack() as stack:
        yield stack


@pytest.fixture
def turn():
    return Wave()


def start(stack, service):
    service.start()
    stack.callback(service.close)


def services(stack, turn, pace=0.0):
    """Bridge, eye and agent on one bus in this process; the bus."""
    bus = MemoryBus()
    stack.callback(bus.close)
    robot = IdealRobot(Scene(objects=(APPLE,)), pace=pace)
    stack.callback(robot.close)
    start(stack, RobotService(bus, robot))
    start(stack, SceneService(bus))
    start(stack, AgentService(bus, None, None, predict, turn=turn))
    return bus


def person(stack, bus, name="ann"):
    link = bus.sibling()
    stack.callback(link.close)
    client = Client(link, name)
    stack.callback(client.close)
    return client


def test_a_sentence_is_heard_shown_run_step_by_step_and_ends_in_a_turn(stack, turn):
    ann = person(stack, services(stack, turn))
    events = list(ann.say("wave"))
    assert [event.stage for event in events] == ["heard", "program", "step", "step", "turn"]
    assert [event.seq for event in events] == [1, 2, 3, 4, 5]
    assert events[0].text == "wave"
    assert events[1].program == "robot.move(...)"
    assert events[-1].turn.status == "done"
    assert len(events[-1].turn.trajectory) == 2


def test_the_answer_to_a_question_is_the_next_sentence_of_the_same_client(stack, turn):
    bus = services(stack, turn)
    ann, bob = person(stack, bus), person(stack, bus, "bob")
    asked = list(ann.say("which"))[-1].turn
    assert asked.status == "asked"
    assert [option.label for option in asked.question.options] == ["the left one", "the right one"]
    assert list(bob.say("look"))[-1].turn.reply == "apple"
    assert list(ann.say("the left one"))[-1].turn.reply == "which -> the left one"


def test_a_client_without_the_lease_is_answered_but_moves_nothing(stack, turn):
    bus = services(stack, turn)
    ann, bob = person(stack, bus), person(stack, bus, "bob")
    ann.acquire()
    assert list(bob.say("look"))[-1].turn.status == "answered"
    refused = list(bob.say("wave"))[-1].turn
    assert refused.status == "refused"
    assert "'ann' holds the arm" in refused.reply
    assert not bob.holds_lease
    ann.release()
    assert list(bob.say("wave"))[-1].turn.status == "done"


def test_a_repeated_submit_is_acknowledged_and_not_taken_again(stack, turn):
    bus = services(stack, turn)
    key = bus.keys.submit("ann")
    assert bus.ask(key, Submit("r1", "look"), Ack) == Ack("r1")
    assert bus.ask(key, Submit("r1", "look"), Ack) == Ack("r1", duplicate=True)
    list(person(stack, bus).say("which"))
    assert turn.said == ["look", "which"]


def test_sentences_of_one_client_are_taken_in_order_and_clients_do_not_wait_for_each_other(
    stack, turn
):
    bus = services(stack, turn)
    ann, bob = person(stack, bus), person(stack, bus, "bob")
    turn.hold.clear()
    told = queue.Queue()
    ann.on_event(told.put, "*")
    for client, text in (("ann", "look"), ("ann", "which"), ("bob", "look")):
        bus.ask(bus.keys.submit(client), Submit(f"{client}-{text}", text), Ack)
    heard = {told.get(timeout=PATIENCE).request_id for _ in range(2)}
    assert heard == {"ann-look", "bob-look"}
    turn.hold.set()
    ends = []
    while len(ends) < 3:
        event = told.get(timeout=PATIENCE)
        if event.stage == "turn" and event.request_id.startswith(("ann", "bob")):
            ends.append(event.request_id)
    assert ends.index("ann-look") < ends.index("ann-which")
    assert bob.name == "bob"


@pytest.mark.parametrize("words", ["stop", "STOP!", "Stop now.", "halt"])
def test_stop_as_a_sentence_halts_at_once_while_another_turn_of_that_client_runs(
    stack, turn, words
):
    bus = services(stack, turn, pace=1.0)
    ann = person(stack, bus)
    ann.acquire()
    told = queue.Queue()
    ann.on_event(told.put)
    key = bus.keys.submit("ann")
    bus.ask(key, Submit("r1", "wave long"), Ack)
    bus.ask(key, Submit("r2", "look"), Ack)
    while told.get(timeout=PATIENCE).stage != "program":
        pass
    bus.ask(key, Submit("r3", words), Ack)
    ends = {}
    while len(ends) < 3:
        event = told.get(timeout=PATIENCE)
        if event.turn is not None:
            ends[event.request_id] = event.turn
    assert ends["r1"].status in ("failed", "refused")
    assert ends["r2"].reason == "cancelled"
    assert ends["r3"].reply.startswith("Stopped")
    assert "look" not in turn.said


def test_stop_said_by_somebody_without_the_lease_halts_too(stack, turn):
    bus = services(stack, turn, pace=1.0)
    ann, bob = person(stack, bus), person(stack, bus, "bob")
    events = ann.say("wave long")
    while next(events).stage != "program":
        pass
    assert list(bob.say("stop"))[-1].turn.reply.startswith("Stopped")
    assert [*events][-1].turn.status in ("failed", "refused")
    assert ann.state().safety == "stopped"


@pytest.mark.parametrize(("moved", "status"), [(False, "refused"), (True, "failed")])
def test_a_bug_is_logged_whether_or_not_something_moved(moved, status, caplog):
    cut_short = ended_by(Submit("r1", "wave"), ValueError("a bug"), moved)
    assert cut_short.status == status and "a bug" in cut_short.reply
    assert "ValueError: a bug" in caplog.text


def test_a_bug_inside_a_turn_is_told_and_the_next_sentence_works(stack, turn, caplog):
    ann = person(stack, services(stack, turn))
    broken = list(ann.say("fail"))[-1].turn
    assert broken.status == "refused"
    assert "ZeroDivisionError" in broken.reply
    assert list(ann.say("look"))[-1].turn.reply == "apple"


def test_what_says_nothing_is_declined(stack, turn):
    bus = services(stack, turn)
    with pytest.raises(Declined) as caught:
        bus.ask(bus.keys.submit("ann"), Submit("r1", "  "), Ack)
    assert caught.value.code == "bad_payload"


def test_without_a_robot_a_sentence_still_gets_its_turn(stack, turn):
    bus = MemoryBus()
    stack.callback(bus.close)
    start(stack, AgentService(bus, None, None, predict, turn=turn))
    ann = person(stack, bus)
    assert "does not answer" in list(ann.say("look"))[-1].turn.reply


def test_when_the_agent_goes_the_client_is_told(stack, turn):
    bus = MemoryBus()
    stack.callback(bus.close)
    agent = AgentService(bus, None, None, predict, turn=turn)
    agent.start()
    turn.hold.clear()
    events = person(stack, bus).say("look")
    assert next(events).stage == "heard"
    closing = threading.Thread(target=agent.close)
    closing.start()
    with pytest.raises(NoService, match="gone"):
        list(events)
    turn.hold.set()
    closing.join()


# --- the scene --------------------------------------------------------------------------------


def test_the_scene_is_told_on_change_and_whoever_joins_late_gets_it(stack, turn):
    bus = services(stack, turn)
    ann = person(stack, bus)
    seen = queue.Queue()
    ann.on_scene(seen.put)
    first = seen.get(timeout=PATIENCE)
    assert [item.id for item in first.scene] == ["a1"]
    moved = msgspec.structs.replace(APPLE, x=-0.5)
    ann.load(Scene(objects=(moved,)))
    assert ann.scene().get("a1").x == -0.5
    while seen.get(timeout=PATIENCE).scene.get("a1").x != -0.5:
        pass


# --- workers ------------------------------------------------------------------------------------


def decision(text):
    return Decision("answer", "because", Dialog(), reply=text)


def request(text="hello"):
    return ClarifyRequest(text, Scene(), Dialog())


def test_deciding_over_the_bus_asks_a_live_worker(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    decide = decide_over(bus)
    with pytest.raises(NoService, match="no clarify worker"):
        decide(request())
    start(stack, ClarifierService(bus, lambda request: decision(request.text), "c1"))
    assert decide(request("hello")).reply == "hello"


def test_a_worker_that_fails_is_passed_over_for_the_next(stack):
    bus = MemoryBus()
    stack.callback(bus.close)

    def broken(request):
        raise RuntimeError("out of memory")

    start(stack, ClarifierService(bus, broken, "c1"))
    start(stack, ClarifierService(bus, lambda request: decision("from c2"), "c2"))
    assert {decide_over(bus)(request()).reply for _ in range(10)} == {"from c2"}


def test_requests_spread_over_the_workers_that_are_free(stack):
    bus = MemoryBus()
    stack.callback(bus.close)
    everybody = threading.Barrier(3, timeout=PATIENCE)

    def decide(name):
        def wait(request):
            everybody.wait()
            return decision(name)

        return wait

    for name in ("c1", "c2", "c3"):
        start(stack, ClarifierService(bus, decide(name), name))
    got = queue.Queue()

    def ask(workers):
        got.put(workers.ask(request(), Decision, PATIENCE).reply)

    for _ in range(200):
        workers = Workers(bus, "clarify", bus.keys.clarify)
        for _ in range(3):
            threading.Thread(target=ask, args=(workers,)).start()
        assert {got.get(timeout=PATIENCE) for _ in range(3)} == {"c1", "c2", "c3"}


def test_a_clarifier_may_ask_a_translator_on_the_same_bus(stack):
    from agent.messages import Candidate, TranslateRequest, Translation

    bus = MemoryBus()
    stack.callback(bus.close)
    start(
        stack,
        TranslatorService(bus, lambda r: Translation((Candidate("pass", -1.0, 1),), 0.9, 1.0)),
    )
    translate = translate_over(bus)

    def decide(request):
        found = translate(TranslateRequest(request.text, (), "manipulate"))
        return decision(found.candidates[0].body)

    start(stack, ClarifierService(bus, decide))
    assert decide_over(bus)(request()).reply == "pass"
