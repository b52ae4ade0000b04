"""The scene service over a camera: stream, snapshot, pictures, names, and a camera that goes."""

import queue
import threading
import time

import msgspec
import numpy as np
import pytest

from agent.bus import MemoryBus, wait_for
from agent.client import Client
from agent.errors import CameraError, Declined
from agent.messages import (
    PictureInfo,
    RobotEvent,
    RobotState,
    SceneCall,
    SceneSnapshot,
    StepReport,
    Waypoint,
)
from robot_bridge.api import PARK
from robot_bridge.service import RobotService
from scene.bus_camera import BusCamera, unpacked
from scene.eye import Eye
from scene.live import EyeService, Pace
from scene.robot_word import RobotWord
from scene.sight import Detection, Picture, View
from scene.types import Scene

PATIENCE = 10.0
PLAIN = np.zeros(0, dtype=np.float32)
VIEW = View(np.eye(3), (0.0, 0.0, 6.0))
QUICK = Pace(looks=200.0, pictures=50.0, patience=PATIENCE)


class Table:
    """What stands there, and a camera over it: its pictures are blank, `detect` knows the table."""

    def __init__(self, **things):
        self.things, self.plugged, self.closed = things, True, False

    def look(self):
        if not self.plugged:
            raise CameraError("the camera is not there: plug it in")
        return Picture(np.full((6, 8, 3), 7, np.uint8), time.time())

    def close(self):
        self.closed = True

    def detect(self, picture, view, expected=()):
        return tuple(
            Detection(name, 0.9, x, y, 0.01, 0.36, 0.36, 0.36, 0.0, "red", PLAIN)
            for name, (x, y) in self.things.items()
        )


def jpeg(pixels):
    return b"jpeg" + pixels.tobytes()


@pytest.fixture
def table():
    return Table(apple=(0.1, 0.2), other=(-0.4, 0.3))


@pytest.fixture
def bus():
    bus = MemoryBus()
    yield bus
    bus.close()


@pytest.fixture
def service(bus, table):
    made = EyeService(bus, table, Eye(table, VIEW), jpeg, pace=QUICK)
    made.start()
    wait_for(bus, bus.keys.alive("scene", "main"), PATIENCE)
    yield made
    made.close()


def ask(bus):
    return bus.ask(bus.keys.snapshot(), None, SceneSnapshot, PATIENCE)


def first(bus, wanted):
    """The first snapshot of the stream that is as wanted."""
    found = queue.Queue()
    with bus.subscribe(bus.keys.objects(), lambda key, message: found.put(message)):
        while not wanted(message := found.get(timeout=PATIENCE)):
            pass
    return message


def test_a_snapshot_shows_what_is_there_with_its_uncertainty(bus, service):
    told = ask(bus)
    assert {item.name for item in told.scene} == {"apple", "thing"}
    assert told.scene.get("apple_1").position == pytest.approx((0.1, 0.2))
    assert 0 < told.sd["apple_1"] < 0.02
    assert told.camera == "ok"


def test_who_moves_something_and_asks_sees_it_moved(bus, service, table):
    ask(bus)
    table.things["apple"] = (0.6, -0.5)
    assert ask(bus).scene.get("apple_1").position == pytest.approx((0.6, -0.5), abs=0.02)


def test_the_client_looks_through_it(bus, service):
    client = Client(bus, "ann")
    assert isinstance(client.scene(), Scene)
    client.close()


def test_events_are_told_once_in_the_stream(bus, table):
    made, told = EyeService(bus, table, Eye(table, VIEW), jpeg, pace=QUICK), queue.Queue()
    with bus.subscribe(bus.keys.objects(), lambda key, message: told.put(message)):
        made.start()
        ask(bus)
        ask(bus)
        made.close()
    events = [event for _ in range(told.qsize()) for event in told.get().events]
    assert sorted((event.kind, event.id) for event in events) == [
        ("entered", "apple_1"), ("entered", "thing_1"),
    ]  # fmt: skip


def test_what_a_picture_leaves_to_be_done_waits_until_its_scene_is_told(bus, table):
    told, began, go_on = queue.Queue(), threading.Event(), threading.Event()

    def settle():
        began.set()
        go_on.wait(PATIENCE)

    made = EyeService(bus, table, Eye(table, VIEW, settle=settle), jpeg, pace=QUICK)
    with bus.subscribe(bus.keys.objects(), lambda key, message: told.put(message)):
        made.start()
        assert told.get(timeout=PATIENCE)
        assert began.wait(PATIENCE)
        assert told.empty()
        go_on.set()
        assert told.get(timeout=PATIENCE)
        made.close()


def test_pictures_are_streamed_and_served_with_their_metadata(bus, service):
    found = queue.Queue()
    key = bus.keys.camera()
    with bus.subscribe_raw(key, lambda key, data, metadata: found.put((data, metadata))):
        streamed, metadata = found.get(timeout=PATIENCE)
    info = msgspec.json.decode(metadata, type=PictureInfo)
    assert streamed == jpeg(np.full((6, 8, 3), 7, np.uint8))
    assert (info.width, info.height, info.format) == (8, 6, "jpeg")
    assert info.homography == tuple(np.eye(3).ravel()) and info.camera == VIEW.camera
    assert bus.ask_raw(key, PATIENCE)[0] == streamed


def test_a_camera_that_goes_is_said_and_comes_back_by_itself(bus, service, table):
    ask(bus)
    table.plugged = False
    lost = first(bus, lambda told: told.camera == "lost")
    assert lost.scene.get("apple_1").on == "table"
    with pytest.raises(Declined, match="plug it in"):
        bus.ask_raw(bus.keys.camera(), PATIENCE)
    table.plugged = True
    first(bus, lambda told: told.camera == "ok")
    assert ask(bus).camera == "ok"


def test_nothing_is_made_up_where_there_is_no_picture(bus, table):
    table.plugged = False
    made = EyeService(bus, table, Eye(table, VIEW), jpeg, pace=Pace(200.0, 50.0, 0.05))
    made.start()
    with pytest.raises(Declined, match="plug it in"):
        ask(bus)
    made.close()


def test_a_name_that_a_person_gives_is_kept(bus, service):
    ask(bus)
    told = bus.ask(bus.keys.call(), SceneCall("thing_1", "widget"), SceneSnapshot, PATIENCE)
    assert told.scene.get("thing_1").name == "widget"
    assert ask(bus).scene.get("thing_1").name == "widget"
    with pytest.raises(Declined, match="thing_9"):
        bus.ask(bus.keys.call(), SceneCall("thing_9", "widget"), SceneSnapshot, PATIENCE)
    with pytest.raises(Declined):
        bus.ask(bus.keys.call(), SceneCall("thing_1", " "), SceneSnapshot, PATIENCE)


def test_what_the_robot_holds_is_known_from_its_steps(bus, table):
    word = RobotWord()
    made = EyeService(bus, table, Eye(table, VIEW), jpeg, word=word, pace=QUICK)
    made.start()
    ask(bus)
    at = Waypoint(0.1, 0.2, 0.36, 0.0, True)
    state = RobotState(1, 0.0, "r1", "normal", "running", at)
    bus.publish(bus.keys.state("r1"), state)
    bus.publish(bus.keys.steps("r1"), RobotEvent(1, "s", StepReport(0, 1, 1, at, at, True)))
    assert (
        first(bus, lambda told: told.scene.get("apple_1").held).scene.get("apple_1").on == "gripper"
    )
    made.close()


# --- a simulated robot's picture over the bus -----------------------------------------------------


class Pictured:
    """An arm that stands still over a table that can be looked at."""

    def __init__(self):
        from robot_bridge.ideal import IdealRobot

        self._arm = IdealRobot(Scene())
        self.taken = threading.Event()

    def __getattr__(self, name):
        return getattr(self._arm, name)

    def picture(self, width, height):
        self.taken.set()
        return np.arange(width * height * 3, dtype=np.uint8).reshape(height, width, 3)

    def view(self, width, height):
        return VIEW


def test_a_bridge_shows_its_picture_over_the_bus(bus):
    robot = Pictured()
    assert robot.pose() == PARK
    service = RobotService(bus, robot, picture=(5, 4))
    service.start()
    picture = BusCamera(bus).look()
    assert picture.pixels.tolist() == robot.picture(5, 4).tolist()
    assert abs(picture.t - time.time()) < PATIENCE
    service.close()


def test_a_robot_without_a_camera_says_so(bus):
    with pytest.raises(CameraError, match="PyBullet"):
        BusCamera(bus).look()


def test_bytes_that_are_no_picture_are_refused():
    with pytest.raises(CameraError):
        unpacked(b"123", PictureInfo(0.0, 2, 2, "rgb"))
