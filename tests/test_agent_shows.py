"""`armchat scene show` and `call`: what is printed, drawn and asked."""

import io
import json
import time
from dataclasses import replace

import numpy as np
import pytest

from agent.bus import MemoryBus
from agent.cli import main
from agent.errors import CameraError, Declined
from agent.messages import SceneCall, SceneSnapshot
from agent.shows import Found, asked, give_name, lines, look, show
from scene.annotate import LINE, annotated, footprint
from scene.eye import Eye
from scene.sight import Detection, Picture, View
from scene.types import Scene, SceneObject

VIEW = View(np.array([[100.0, 0, 150], [0, -100, 150], [0, 0, 1]]), (0.0, 0.0, 6.0))
APPLE = SceneObject(
    id="apple_1", name="apple", x=0.5, y=-0.25, width=0.3, height=0.2, tall=0.3, color="red"
)
SCENE = Scene(
    objects=(APPLE,),
    tray=(SceneObject(id="cup_1", name="cup", width=0.4, height=0.4, tall=0.3, on="tray"),),
)
FOUND = Found(SCENE, {"apple_1": 0.01}, {"apple_1": 3.2})


class Camera:
    """A number of pictures, and then none."""

    def __init__(self, count):
        self.left = count

    def look(self):
        if not self.left:
            raise CameraError("the end")
        self.left -= 1
        return Picture(np.zeros((300, 300, 3), np.uint8), time.time())

    def close(self):
        pass

    def detect(self, picture, view, expected=()):
        feature = np.zeros(0, np.float32)
        return (Detection("apple", 0.9, 0.5, -0.25, 0.02, 0.3, 0.3, 0.3, 0.0, "red", feature),)


def test_a_table_for_people_says_where_and_how_surely_in_millimetres():
    head, apple, cup = lines(FOUND)
    assert head.split() == [
        "id",
        "name",
        "colour",
        "x",
        "mm",
        "y",
        "mm",
        "±",
        "mm",
        "size",
        "mm",
        "on",
    ]
    told = "apple_1 apple red 100 -50 2.0 60x40x60 table unseen for 3 s"
    assert apple.split() == told.split()
    assert cup.split() == ["cup_1", "cup", "-", "80x80x60", "tray"]


def test_json_is_the_scene_object_and_what_is_unsure():
    out = io.StringIO()
    show(FOUND, True, out)
    told = json.loads(out.getvalue())
    assert told["objects"][0]["id"] == "apple_1"
    assert told["sd"] == {"apple_1": 0.01} and told["unseen"] == {"apple_1": 3.2}


@pytest.mark.parametrize("count", [1, 4, 50])
def test_one_picture_is_enough_and_more_make_it_surer(count):
    camera = Camera(count)
    found = look(camera, Eye(camera, VIEW), 0.4)
    assert found.scene.get("apple_1").position == pytest.approx((0.5, -0.25))
    assert (found.sd["apple_1"] < 0.018) == (count > 1)
    assert found.picture is not None and found.picture[1] is VIEW


def test_of_one_picture_is_told_what_a_closer_look_at_it_shows():
    class Patient(Camera):
        """Knows better once it had time."""

        settled = 0

        def detect(self, picture, view, expected=()):
            (one,) = super().detect(picture, view)
            return (replace(one, x=0.6 if self.settled else one.x),)

        def settle(self):
            self.settled += 1

    camera = Patient(1)
    found = look(camera, Eye(camera, VIEW, settle=camera.settle), 0.4)
    assert found.scene.get("apple_1").x == pytest.approx(0.6)


def test_no_picture_is_an_error():
    camera = Camera(0)
    with pytest.raises(CameraError):
        look(camera, Eye(camera, VIEW), 0.4)


def test_a_footprint_is_drawn_where_the_thing_stands():
    blank = np.zeros((300, 300, 3), np.uint8)
    drawn = annotated(blank, SCENE, VIEW)
    assert not blank.any()
    rows, columns = np.nonzero((drawn == LINE).all(axis=2))
    assert (columns.min(), columns.max()) == pytest.approx((185, 216), abs=1)
    assert (rows.min(), rows.max()) == pytest.approx((165, 186), abs=1)
    assert footprint(APPLE, VIEW)[0] == pytest.approx((185, 185))


def test_an_id_is_written_above_its_footprint_by_the_function_passed_in():
    told = []

    def write(sheet, text, at, high):
        told.append((text, at))
        sheet[at[1] - 3 : at[1], at[0] : at[0] + 5] = 0

    drawn = annotated(np.zeros((300, 300, 3), np.uint8), SCENE, VIEW, write)
    assert told == [("apple_1", (184, 160))] or told == [("apple_1", (185, 161))]
    ((_, (u, v)),) = told
    assert tuple(drawn[v - 1, u]) == LINE


def test_what_is_half_outside_the_picture_is_drawn_as_far_as_it_goes():
    scene = SCENE.replace(
        SceneObject(id="apple_1", name="apple", x=1.5, y=0, width=0.4, height=0.4, tall=0.3)
    )
    assert (annotated(np.zeros((300, 300, 3), np.uint8), scene, VIEW) == LINE).all(axis=2).any()


def test_the_eye_of_a_running_agent_is_asked_over_the_bus():
    bus = MemoryBus()
    told = SceneSnapshot(1, 0.0, SCENE, {"apple_1": 0.01}, camera="ok")
    bus.serve(bus.keys.snapshot(), lambda key, request: told)
    found = asked(bus, with_picture=False)
    assert found.scene == SCENE and found.sd == {"apple_1": 0.01}
    bus.close()


def test_a_name_is_given_over_the_bus():
    bus, heard = MemoryBus(), []

    def call(key, request):
        heard.append(request)
        if request.id != "apple_1":
            raise Declined("SceneError", f"no object {request.id!r}")
        return SceneSnapshot(
            1,
            0.0,
            SCENE.replace(
                SceneObject(id="apple_1", name="widget", x=0, y=0, width=0.1, height=0.1, tall=0.1)
            ),
        )

    bus.serve(bus.keys.call(), call)
    out = io.StringIO()
    give_name(bus, "apple_1", "widget", out)
    assert out.getvalue() == "apple_1 is called widget now.\n"
    assert heard == [SceneCall("apple_1", "widget")]
    with pytest.raises(Declined):
        give_name(bus, "pear_1", "widget", out)
    bus.close()


def test_two_eyes_at_once_are_refused(capsys):
    assert main(["scene", "show", "--connect", "tcp/127.0.0.1:1", "--source", "0"]) == 2
    assert "--source" in capsys.readouterr().err


def test_a_camera_that_is_not_calibrated_says_so(capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("ARMCHAT_CAMERA__FOLDER", str(tmp_path))
    assert main(["scene", "show", "--source", str(tmp_path)]) == 1
    assert "calibrate" in capsys.readouterr().err
