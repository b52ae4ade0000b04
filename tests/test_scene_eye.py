"""From detections to the scene: what stands where and on what, what waits, what fell."""

import math

import numpy as np
import pytest
from msgspec.structs import replace

from scene.eye import Eye, Seen, look_at, noticed
from scene.lean import seen_at
from scene.sight import Detection, Picture, View
from scene.track import ONCE
from scene.tracks import Hint
from scene.tray import tray_positions
from scene.types import Pose, Scene, SceneObject

PLAIN = np.zeros(0, dtype=np.float32)
CAMERA = (0.0, 0.0, 6.0)
VIEW = View(np.diag([100.0, -100.0, 1.0]), CAMERA)
HINT = Hint(eye=CAMERA)
ORANGE = SceneObject(
    id="orange_1", name="orange", width=0.35, height=0.35, tall=0.34, on="tray", color="orange"
)


def seen(name, x, y, size=0.36, tall=0.36, color="red", sd=0.01, z=0.0):
    x, y = seen_at((x, y), z, CAMERA)
    return Detection(name, 0.9, x, y, sd, size, size, tall, 0.0, color, PLAIN)


class Watcher:
    def __init__(self, known=None):
        self.known, self.t = known or Seen(), 10.0

    def look(self, *detections, hint=HINT, frames=1):
        for _ in range(frames):
            self.t += 0.1
            self.known, sight = noticed(self.known, detections, self.t, hint)
        return sight


class Fake:
    """A detector that knows the table, and keeps what it was shown."""

    def __init__(self, *found):
        self.found, self.shown = found, []

    def detect(self, picture, view, expected=()):
        self.shown.append((picture, view))
        return self.found


def test_a_picture_is_undistorted_and_becomes_a_scene():
    fake = Fake(seen("apple", 0.2, 0.3), seen("cup", -0.5, 0.0, color="white"))
    eye = Eye(fake, VIEW, undistort=lambda one: Picture(one.pixels + 1, one.t))
    picture = Picture(np.zeros((4, 5, 3), np.uint8), 7.0)
    _, sight = look_at(Seen(), picture, eye, Hint(), ONCE)
    shown, view = fake.shown[0]
    assert shown.pixels.tolist() == np.ones((4, 5, 3)).tolist() and shown.t == 7.0 and view is VIEW
    assert {item.id for item in sight.scene.objects} == {"apple_1", "cup_1"}
    apple = sight.scene.get("apple_1")
    assert apple.position == pytest.approx((0.2, 0.3))
    assert (apple.on, apple.z, apple.color, apple.held) == ("table", 0.0, "red", False)
    assert sight.sd["apple_1"] == pytest.approx(0.01 * math.sqrt(1.25))
    assert [event.kind for event in sight.events] == ["entered", "entered"]


def test_what_stands_on_a_larger_thing_is_on_it_and_its_place_is_brought_back():
    box = seen("book", 0.6, 0.4, size=0.6, tall=0.3)
    sight = Watcher().look(box, seen("apple", 0.6, 0.4, z=0.3), frames=3)
    apple = sight.scene.get("apple_1")
    assert apple.on == "book_1"
    assert apple.z == pytest.approx(0.3)
    assert apple.position == pytest.approx((0.6, 0.4), abs=1e-6)


def test_what_lies_in_a_container_is_in_it_near_its_floor():
    box = seen("box", 0.2, 0.4, size=0.6, tall=0.3)
    sight = Watcher().look(box, seen("block", 0.25, 0.4, size=0.2, tall=0.2), frames=3)
    block = sight.scene.get("block_1")
    assert block.on == "box_1" and block.z < 0.05


def test_things_side_by_side_are_on_the_table():
    sight = Watcher().look(seen("apple", 0, 0), seen("book", 0.5, 0, size=0.6), frames=3)
    assert {item.on for item in sight.scene.objects} == {"table"}


def test_the_held_thing_hangs_from_the_tool():
    watcher = Watcher()
    watcher.look(seen("apple", 0.2, 0), frames=3)
    watcher.look(seen("apple", 0.2, 0), hint=Hint(Pose(0.2, 0, 0.36), True, True, eye=CAMERA))
    sight = watcher.look(hint=Hint(Pose(-0.3, 0.1, 0.9), True, True, eye=CAMERA))
    apple = sight.scene.get("apple_1")
    assert (apple.on, apple.held) == ("gripper", True)
    assert apple.position == pytest.approx((-0.3, 0.1), abs=0.02)
    assert apple.z == pytest.approx(0.54, abs=0.02)


def test_what_fell_over_the_edge_lies_on_the_floor_beside_it():
    watcher = Watcher()
    for x in np.arange(0.5, 1.0, 0.05):
        watcher.look(seen("apple", float(x), 0.3))
    sight = watcher.look(frames=30)
    apple = sight.scene.get("apple_1")
    assert apple.on == "floor" and apple.x > 1.15
    assert sight.unseen["apple_1"] > 2.0


def test_what_left_the_table_otherwise_is_no_longer_in_the_scene():
    watcher = Watcher()
    watcher.look(seen("apple", 0.1, 0.3), frames=5)
    assert watcher.look(frames=30).scene.objects == ()


def test_what_waits_in_the_tray_is_taken_from_it_by_the_tool():
    watcher = Watcher(Seen(tray=(ORANGE, replace(ORANGE, id="orange_2"))))
    sight = watcher.look()
    assert [item.id for item in sight.scene.tray] == ["orange_1", "orange_2"]
    x, y = tray_positions(Scene(tray=(ORANGE,)))["orange_1"]
    sight = watcher.look(hint=Hint(Pose(x, y, 0.34), True, True, eye=CAMERA))
    assert [item.id for item in sight.scene.tray] == ["orange_2"]
    assert sight.scene.get("orange_1").held
    watcher.look(hint=Hint(Pose(0.1, 0.2, 0.34), True, True, eye=CAMERA))
    sight = watcher.look(hint=Hint(Pose(0.1, 0.2, 0.34), False, False, eye=CAMERA))
    sight = watcher.look(seen("orange", 0.1, 0.2, size=0.3, color="orange"), frames=4)
    orange = sight.scene.get("orange_1")
    assert orange.on == "table" and orange.position == pytest.approx((0.1, 0.2), abs=0.03)
    assert orange.width == pytest.approx(ORANGE.width, rel=0.05)  # its size was told, not seen
    assert len(sight.scene.objects) == 1


def test_how_long_a_thing_has_not_been_seen_is_told():
    watcher = Watcher()
    watcher.look(seen("apple", 0, 0), frames=3)
    assert watcher.look(frames=5).unseen["apple_1"] == pytest.approx(0.5)
    assert watcher.look(seen("apple", 0, 0)).unseen == {}


def test_the_tray_closes_up_between_plans_and_not_within_one():
    first, second = ORANGE, replace(ORANGE, id="orange_2")
    places = tray_positions(Scene(tray=(first, second)))

    def grip(at, on, idle):
        return Hint(Pose(*at, 0.34), on, on, eye=CAMERA, idle=idle)

    for idle, at in ((False, places["orange_2"]), (True, places["orange_1"])):
        watcher = Watcher(Seen(tray=(first, second)))
        watcher.look()
        watcher.look(hint=grip(places["orange_1"], True, False))
        watcher.look(hint=grip((0.0, 0.0), True, False))
        watcher.look(hint=grip((0.0, 0.0), False, False))
        watcher.look(hint=grip((0.0, 0.5), False, idle))
        sight = watcher.look(hint=grip(at, True, False))
        assert sight.scene.get("orange_2").held
