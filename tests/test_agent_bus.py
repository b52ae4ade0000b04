"""One contract, two buses: whatever holds in memory holds over Zenoh."""

import queue
import socket
import threading
from contextlib import ExitStack

import pytest

from agent.bus import MemoryBus, wait_for
from agent.config import BusConfig
from agent.errors import BusError, Declined, NoAnswer, NoService, SceneError
from agent.messages import Ack, Event, RobotState, SceneSnapshot, StopRequest, Submit, Waypoint
from agent.wire import ANY
from scene.types import Scene

pytestmark = pytest.mark.live

PATIENCE = 5.0


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture(scope="module")
def hub_endpoint():
    from agent.bus_zenoh import Hub

    endpoint = f"tcp/127.0.0.1:{free_port()}"
    with Hub((endpoint,)):
        yield endpoint


@pytest.fixture(params=["memory", "zenoh"])
def buses(request):
    """Two buses that are connected, each with a link of its own."""
    if request.param == "memory":
        one = MemoryBus()
        two = one.sibling()
    else:
        from agent.bus_zenoh import ZenohBus

        config = BusConfig(connect=(request.getfixturevalue("hub_endpoint"),))
        one = ZenohBus(config)
        two = one.sibling()
    with ExitStack() as stack:
        stack.callback(one.close)
        stack.callback(two.close)
        yield one, two


def ready(there, here, name="x"):
    """Declare a token there, last, and wait for it here."""
    there.token(there.keys.alive("test", name))
    wait_for(here, here.keys.alive("test", name), PATIENCE)


def collector():
    got = queue.Queue()
    return got, lambda key, message: got.put((key, message))


def state(seq):
    return RobotState(seq, 0.0, "r1", "normal", "idle", Waypoint(0, 0, 0, 0, False))


def event(seq, stage="step"):
    return Event("q1", seq, stage)


def test_events_arrive_complete_and_in_order(buses):
    here, there = buses
    got, collect = collector()
    there.subscribe(there.keys.event(ANY), collect)
    ready(there, here)
    for seq in range(30):
        here.publish(here.keys.event("ann"), event(seq))
    received = [got.get(timeout=PATIENCE) for _ in range(30)]
    assert [message.seq for _, message in received] == list(range(30))
    assert {key for key, _ in received} == {here.keys.event("ann")}


def test_who_joins_late_gets_the_latched_state(buses):
    here, there = buses
    here.publish(here.keys.state("r1"), state(1))
    here.publish(here.keys.state("r1"), state(2))
    got, collect = collector()
    there.subscribe(there.keys.state(ANY), collect, latest=True)
    while got.get(timeout=PATIENCE)[1].seq != 2:
        pass


def test_of_a_flood_of_pictures_only_what_is_handled_is_copied(hub_endpoint, monkeypatch):
    """What nobody will look at costs zenoh's threads, which carry a STOP too, no copy."""
    from agent import bus_zenoh

    copied, handled = [], queue.Queue()
    take = bus_zenoh._sample
    monkeypatch.setattr(bus_zenoh, "_sample", lambda one: copied.append(one) or take(one))
    held, go = threading.Event(), threading.Event()

    def slow(key, data, attachment):
        held.set()
        assert go.wait(PATIENCE)
        handled.put(data)

    with ExitStack() as stack:
        bus = bus_zenoh.ZenohBus(BusConfig(connect=(hub_endpoint,)))
        stack.callback(bus.close)
        stack.callback(go.set)
        arrived, collect = collector()
        bus.subscribe_raw(bus.keys.camera(), slow)
        bus.publish_raw(bus.keys.camera(), b"0")
        assert held.wait(PATIENCE)
        for number in range(1, 50):
            bus.publish_raw(bus.keys.camera(), b"%d" % number)
        bus.subscribe(bus.keys.stop("r1"), collect)
        bus.publish(bus.keys.stop("r1"), StopRequest("ann"))  # all pictures have arrived before it
        arrived.get(timeout=PATIENCE)
        go.set()
        assert [handled.get(timeout=PATIENCE) for _ in range(2)] == [b"0", b"49"]
    assert len(copied) == 3  # two pictures and the stop


def test_a_slow_reader_of_the_latest_skips_what_is_old(buses):
    here, there = buses
    seen, busy, go_on = [], threading.Event(), threading.Event()
    done = threading.Event()

    def slow(key, message):
        seen.append(message.seq)
        busy.set()
        go_on.wait(PATIENCE)
        if message.seq == 99:
            done.set()

    there.subscribe(there.keys.objects(), slow, latest=True)
    other, collect = collector()
    there.subscribe(there.keys.objects(), collect)
    ready(there, here)
    here.publish(here.keys.objects(), SceneSnapshot(0, 0.0, Scene()))
    assert busy.wait(PATIENCE)
    for seq in range(1, 100):
        here.publish(here.keys.objects(), SceneSnapshot(seq, 0.0, Scene()))
    while other.get(timeout=PATIENCE)[1].seq != 99:
        pass  # a fast reader is not held up by the slow one
    go_on.set()
    assert done.wait(PATIENCE)
    assert len(seen) < 50


def test_a_handler_that_raises_does_not_end_the_subscription(buses, caplog):
    here, there = buses
    got = queue.Queue()

    def fragile(key, message):
        got.put(message.seq)
        raise ValueError("a bug in a handler")

    there.subscribe(there.keys.event("ann"), fragile)
    ready(there, here)
    here.publish(here.keys.event("ann"), event(0))
    here.publish(here.keys.event("ann"), event(1))
    assert [got.get(timeout=PATIENCE), got.get(timeout=PATIENCE)] == [0, 1]
    assert "a bug in a handler" in caplog.text


@pytest.mark.parametrize(
    ("data", "encoding"),
    [
        (b'{"type":"nobody.knows/1"}', "application/json"),
        (b'{"type":"robot.stop/1","by":7}', "application/json"),
        (b"\xff\xfe", "application/json"),
        (b'{"type":"robot.stop/1","by":"ann"}', "text/plain"),
    ],
)
def test_what_is_no_message_is_refused_and_logged(buses, caplog, data, encoding):
    here, there = buses
    got, collect = collector()
    there.subscribe(there.keys.stop("r1"), collect)
    ready(there, here)
    here.publish_raw(here.keys.stop("r1"), data, encoding=encoding)
    here.publish(here.keys.stop("r1"), StopRequest("ann"))
    assert got.get(timeout=PATIENCE)[1] == StopRequest("ann")
    assert got.empty()
    assert "refused" in caplog.text


def test_pictures_travel_with_their_metadata(buses):
    here, there = buses
    got = queue.Queue()
    there.subscribe_raw(there.keys.camera(), lambda *sample: got.put(sample))
    ready(there, here)
    here.publish_raw(here.keys.camera(), b"\xff\xd8jpeg", attachment=b'{"t":1}')
    assert got.get(timeout=PATIENCE) == (here.keys.camera(), b"\xff\xd8jpeg", b'{"t":1}')


def test_a_query_is_answered(buses):
    here, there = buses
    there.serve(there.keys.submit("ann"), lambda key, request: Ack(request.request_id))
    ready(there, here)
    assert here.ask(here.keys.submit("ann"), Submit("r7", "hello"), Ack) == Ack("r7")


def test_one_service_answers_for_many_clients(buses):
    here, there = buses
    there.serve(there.keys.submit(ANY), lambda key, request: Ack(key.split("/")[-2]))
    ready(there, here)
    assert here.ask(here.keys.submit("bob"), Submit("r7", "hello"), Ack) == Ack("bob")


def test_nobody_there_is_an_error_at_once(buses):
    here, _ = buses
    with pytest.raises(NoService, match="submit"):
        here.ask(here.keys.submit("ann"), Submit("r7", "hello"), Ack)


def test_every_exception_of_a_service_becomes_an_answer(buses):
    here, there = buses
    errors = {
        "busy": Declined("busy", "come back later"),
        "SceneError": SceneError("no such object"),
        "internal": KeyError("a bug"),
    }

    def serve(key, request):
        raise errors[request.text]

    there.serve(there.keys.submit("ann"), serve)
    ready(there, here)
    for code, error in errors.items():
        with pytest.raises(Declined) as caught:
            here.ask(here.keys.submit("ann"), Submit("r", code), Ack)
        assert caught.value.code == code
        assert str(error).strip("'") in str(caught.value)


def test_a_query_that_is_no_message_is_declined(buses):
    here, there = buses
    there.serve(there.keys.submit("ann"), lambda key, request: state(1))
    ready(there, here)
    with pytest.raises(Exception, match="RobotState, not Ack"):
        here.ask(here.keys.submit("ann"), None, Ack)


def test_a_service_that_takes_too_long_is_told_apart_from_none(buses):
    here, there = buses
    release = threading.Event()

    def hang(key, request):
        release.wait(PATIENCE)
        return Ack("late")

    there.serve(there.keys.submit("ann"), hang)
    ready(there, here)
    with pytest.raises(NoAnswer):
        here.ask(here.keys.submit("ann"), Submit("r", "x"), Ack, timeout=0.05)
    release.set()


def test_queries_to_one_service_run_side_by_side(buses):
    here, there = buses
    both = threading.Barrier(2, timeout=PATIENCE)

    def serve(key, request):
        both.wait()
        return Ack(request.request_id)

    there.serve(there.keys.submit(ANY), serve, workers=2)
    ready(there, here)
    threading.Thread(
        target=lambda: here.ask(here.keys.submit("bob"), Submit("r", "x"), Ack), daemon=True
    ).start()
    assert here.ask(here.keys.submit("ann"), Submit("s", "x"), Ack) == Ack("s")


def test_a_service_may_ask_another_one(buses):
    here, there = buses
    there.serve(there.keys.state("r1"), lambda key, request: state(5))

    def nested(key, request):
        return Ack(str(there.ask(there.keys.state("r1"), None, RobotState).seq))

    there.serve(there.keys.submit("ann"), nested)
    ready(there, here)
    assert here.ask(here.keys.submit("ann"), Submit("r", "x"), Ack) == Ack("5")


def test_a_query_for_all_services_at_once_is_declined(buses):
    here, there = buses
    there.serve(there.keys.command("r1", "run"), lambda key, request: Ack("moved"))
    ready(there, here)
    with pytest.raises(Declined) as caught:
        here.ask(here.keys.command(ANY, "run"), Submit("r", "x"), Ack)
    assert caught.value.code == "wildcard"


def test_tokens_come_go_and_are_seen_by_who_joins_late(buses):
    here, there = buses
    key = here.keys.alive("translate", "t1")
    token = here.token(key)
    got = queue.Queue()
    there.watch(there.keys.alive("translate", ANY), lambda *change: got.put(change))
    assert got.get(timeout=PATIENCE) == (key, True)
    assert there.alive(there.keys.alive(ANY, ANY)) == (key,)
    token.close()
    assert got.get(timeout=PATIENCE) == (key, False)
    assert there.alive(there.keys.alive(ANY, ANY)) == ()


def test_closing_a_bus_takes_its_tokens_along(buses):
    here, there = buses
    third = here.sibling()
    key = here.keys.alive("agent", "a1")
    third.token(key)
    got = queue.Queue()
    there.watch(key, lambda *change: got.put(change))
    assert got.get(timeout=PATIENCE) == (key, True)
    third.close()
    third.close()
    assert got.get(timeout=PATIENCE) == (key, False)


def test_waiting_for_nobody_ends_with_an_error(buses):
    here, _ = buses
    with pytest.raises(NoService):
        wait_for(here, here.keys.alive("agent", "nobody"), timeout=0.05)


def test_what_is_closed_is_not_called_any_more(buses):
    here, there = buses
    got, collect = collector()
    there.subscribe(there.keys.event("ann"), collect).close()
    served = there.serve(there.keys.submit("ann"), lambda key, request: Ack("x"))
    served.close()
    kept, keep = collector()
    there.subscribe(there.keys.event("ann"), keep)
    ready(there, here)
    here.publish(here.keys.event("ann"), event(1))
    assert kept.get(timeout=PATIENCE)
    assert got.empty()
    with pytest.raises(NoService):
        here.ask(here.keys.submit("ann"), Submit("r", "x"), Ack)


def test_bytes_are_asked_for_with_their_metadata(buses):
    here, there = buses
    key = there.keys.picture("r1")
    there.serve_raw(key, lambda key: (b"\x00\xff" * 5000, b'{"t": 1}'))
    ready(there, here)
    assert here.ask_raw(key, PATIENCE) == (b"\x00\xff" * 5000, b'{"t": 1}')


def test_who_has_no_bytes_says_why(buses):
    here, there = buses

    def none(key):
        raise Declined("no_view", "unplugged")

    there.serve_raw(there.keys.picture("r1"), none)
    ready(there, here)
    with pytest.raises(Declined, match="unplugged"):
        here.ask_raw(here.keys.picture("r1"), PATIENCE)
    with pytest.raises(NoService):
        here.ask_raw(here.keys.picture("r2"), 1.0)


def test_a_message_is_no_bytes_and_bytes_are_no_message(buses):
    here, there = buses
    there.serve(there.keys.limits("r1"), lambda key, request: Ack("x"))
    there.serve_raw(there.keys.picture("r1"), lambda key: (b"\xff", b""))
    ready(there, here)
    with pytest.raises(BusError):
        here.ask_raw(here.keys.limits("r1"), PATIENCE)
    with pytest.raises(BusError):
        here.ask(here.keys.picture("r1"), None, Ack, PATIENCE)
