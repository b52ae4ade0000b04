"""A thing is shown to the eye, alone on the table, known from then on, and forgotten."""

import io

import numpy as np
import pytest

from agent.cli import main
from agent.errors import CameraError, SceneError
from agent.showing import learn
from scene.eye import Eye
from scene.shown import ShownStore, named
from scene.sight import Detection, Picture, View

VIEW = View(np.eye(3), (0.0, 0.0, 4.0))


def thing(*feature):
    unit = np.array(feature, np.float32)
    return Detection("other", 0.9, 0.1, 0.2, 0.01, 0.3, 0.3, 0.3, 0.0, "red",
                     unit / np.linalg.norm(unit))  # fmt: skip


class Shows:
    """A camera of so many frames, and a detector of what stands in each of them."""

    def __init__(self, *frames):
        self._frames, self._at = frames, -1

    def look(self):
        self._at += 1
        if self._at >= len(self._frames):
            raise CameraError("pictures/ has ended")
        return Picture(np.zeros((2, 2, 3), np.uint8), float(self._at))

    def close(self):
        pass

    def detect(self, picture, view, expected=()):
        return self._frames[int(picture.t)]


def shown(tmp_path, *frames, views=3):
    both, waits, out = Shows(*frames), [], io.StringIO()
    learn(both, Eye(both, VIEW), "widget", views, ShownStore(tmp_path), out, waits.append)
    return waits, out.getvalue()


def test_what_was_shown_goes_by_its_name_from_then_on(tmp_path):
    waits, told = shown(tmp_path, [thing(1, 0)], [thing(1, 0.1)], [thing(1, 0.2)])
    assert len(waits) == 2, "none behind the last picture"
    assert [line.split(":")[0] for line in told.splitlines()] == [
        "picture 1 of 3", "picture 2 of 3", "picture 3 of 3",
    ]  # fmt: skip
    known = ShownStore(tmp_path).load()
    assert [one.name for one in named(known, [thing(1, 0.05), thing(0, 1)])] == ["widget", "other"]


def test_a_folder_that_ends_early_has_to_do(tmp_path):
    shown(tmp_path, [thing(1, 0)], [thing(1, 0.1)], views=6)
    assert len(ShownStore(tmp_path).load()[0].features) == 2


@pytest.mark.parametrize(
    ("frames", "views", "why"),
    [
        (([thing(1, 0)], []), 2, "picture 2 shows nothing: put the one thing alone"),
        (([thing(1, 0), thing(0, 1)],), 1, "picture 1 shows 2 things"),
        (([thing(1, 0)],), 0, "at least one view"),
    ],
)
def test_nothing_is_kept_of_what_was_not_shown_alone(tmp_path, frames, views, why):
    with pytest.raises(SceneError, match=why):
        shown(tmp_path, *frames, views=views)
    assert ShownStore(tmp_path).load() == ()


def test_a_camera_without_a_picture_is_told_as_it_is(tmp_path):
    with pytest.raises(CameraError, match="has ended"):
        shown(tmp_path)


def test_a_name_is_forgotten_by_one_command(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("scene.shown.user_data_path", lambda name: tmp_path)
    shown(tmp_path, [thing(1, 0)], views=1)
    assert main(["scene", "forget", "widget"]) == 0
    assert capsys.readouterr().out == "The eye has forgotten widget.\n"
    assert ShownStore(tmp_path).load() == ()
    assert main(["scene", "forget", "widget"]) == 2
    assert "no thing was shown under the name 'widget'" in capsys.readouterr().err
