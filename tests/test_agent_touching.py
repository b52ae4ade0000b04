"""`calibrate robot`, from the shell: pairs from a file, and points that the arm is brought to."""

import io
import json

import msgspec
import pytest

from agent.config import DobotConfig
from agent.errors import CalibrationError
from agent.touching import touch_all
from evals.fault_matrix import settled
from robot_bridge.dobot_cell import Cell
from robot_bridge.dobot_fit import fitted
from robot_bridge.emulator import Emulator
from scene import calibration
from scene.calibration import Standing
from scene.types import Pose

pytestmark = pytest.mark.usefixtures("kept")


def truth(turn=4.0, scale=74.0):
    """An arm that stands otherwise than configured."""
    return Cell(DobotConfig(scale=scale, turn=turn, offset=(236.0, 3.0), floor=-66.0))


MIDDLES = [(-2 / 3, -2 / 3), (2 / 3, -2 / 3), (2 / 3, 2 / 3), (-2 / 3, 2 / 3)]


def pairs(points=MIDDLES):
    return [
        {"table": [x, y], "arm": list(truth().millimetres(Pose(x, y, 0))[:3])} for x, y in points
    ]


@pytest.fixture
def points(tmp_path, monkeypatch):
    monkeypatch.setenv("ARMCHAT_CAMERA__TABLE", "150")
    path = tmp_path / "points.json"
    path.write_text(json.dumps(pairs()))
    return path


def test_measured_pairs_give_the_arms_place_and_it_is_used(armchat, kept, points):
    status, out, _ = armchat("calibrate", "robot", "--points", str(points))
    assert status == 0 and "74.00 mm per table unit, turned by 4.00°" in out
    used = fitted(DobotConfig())
    assert (used.scale, used.turn, used.floor) == pytest.approx((74, 4, -66))
    assert used.offset == pytest.approx((236, 3))
    at = Cell(used).millimetres(Pose(0.3, -0.4, 0.2, 0.5))
    assert at == pytest.approx(truth().millimetres(Pose(0.3, -0.4, 0.2, 0.5)))
    assert fitted(DobotConfig(calibration="none")) == DobotConfig(calibration="none")
    assert fitted(used) == used


def test_the_json_of_the_arms_place_has_its_residuals(armchat, points):
    status, out, _ = armchat("calibrate", "robot", "--points", str(points), "--json")
    assert status == 0
    assert max(msgspec.json.decode(out, type=Standing).residuals) < 1e-6


def test_bad_pairs_are_refused_and_the_old_place_stays(armchat, kept, points):
    armchat("calibrate", "robot", "--points", str(points))
    before = (kept / "robot.json").read_bytes()
    wrong = pairs()
    wrong[1]["arm"][0] += 4
    points.write_text(json.dumps(wrong))
    status, out, err = armchat("calibrate", "robot", "--points", str(points))
    assert (status, out) == (1, "") and "deviate by up to" in err
    assert (kept / "robot.json").read_bytes() == before
    for text in ("{", '[{"table": [1], "arm": [1, 2, 3]}]', '[{"tabel": [1, 2]}]'):
        points.write_text(text)
        assert armchat("calibrate", "robot", "--points", str(points))[0] == 2
    assert armchat("calibrate", "robot", "--points", "none.json")[0] == 2


def test_a_named_file_must_be_there_and_a_damaged_one_is_not_passed_over(armchat, kept, tmp_path):
    with pytest.raises(CalibrationError, match="armchat calibrate robot"):
        fitted(DobotConfig(calibration=str(tmp_path / "none.json")))
    kept.mkdir(parents=True)
    (kept / "robot.json").write_text("{}")
    with pytest.raises(CalibrationError, match="damaged"):
        fitted(DobotConfig())
    assert armchat("jog", "z", "1", "--port", "/dev/none")[0] == 1
    stands = calibration.load(Standing, calibration.save(a_standing(scale=900.0), tmp_path))
    assert stands.scale == 900
    with pytest.raises(CalibrationError, match=r"scale must be in \[10, 300\]"):
        fitted(DobotConfig(), str(tmp_path))


def a_standing(**changes):
    plain = Standing(
        date="2031-01-01T10:00:00+00:00", source="p", scale=74.0, offset=(236.0, 3.0), floor=-66.0,
        turn=4.0, residuals=(0.1, 0.2, 0.1, 0.1), floor_mm=0.1,
    )  # fmt: skip
    return msgspec.structs.replace(plain, **changes)


@pytest.fixture
def emulator():
    with Emulator(speed=40.0) as made:
        settled(made)
        yield made


class Hands(io.StringIO):
    """Types lines; before an empty one the arm is brought, by hand, to the next point."""

    def __init__(self, emulator, places, lines):
        super().__init__()
        self.emulator, self.places, self.lines = emulator, iter(places), iter(lines)

    def readline(self, *_):
        line = next(self.lines, "")
        if line == "\n":
            with self.emulator.lock:
                self.emulator.controller.pose = next(self.places)
        return line


def touch(monkeypatch, armchat, emulator, places, lines, *more):
    hands = Hands(emulator, places, lines)
    real = touch_all
    monkeypatch.setattr(
        "agent.touching.touch_all",
        lambda points, robot, _, say, wait: real(points, robot, hands, say, lambda s: None),
    )
    return armchat("calibrate", "robot", "--port", emulator.port, *more)


def test_touching_the_markers_on_the_arm(monkeypatch, armchat, kept, emulator):
    monkeypatch.setenv("ARMCHAT_CAMERA__TABLE", "150")
    places = [truth().millimetres(Pose(x, y, 0)) for x, y in MIDDLES]
    status, out, err = touch(monkeypatch, armchat, emulator, places, ["\n"] * 4)
    assert status == 0, err
    assert "point 4 of 4: the middle of the far left marker (x -0.67, y 0.67)" in err
    found = calibration.load(Standing, kept)
    assert (found.scale, found.turn) == pytest.approx((74, 4), abs=0.01)
    assert "turned by 4.00°" in out and found.source == emulator.port
    # from now on a place of the table is where the calibration has it
    status, out, _ = armchat("doctor", "--port", emulator.port)
    assert "(-0.67, 0.67, 0.00) in table units" in out


def test_own_points_steps_and_skips(monkeypatch, armchat, kept, emulator):
    monkeypatch.setenv("ARMCHAT_CAMERA__TABLE", "150")
    own = [(0.0, 0.0), (-0.5, 0.5), *MIDDLES[:3]]
    places = [truth().millimetres(Pose(x, y, 0)) for x, y in [*own[:1], *own[2:]]]
    lines = ["z -5\n", "x 900\n", "up\n", "\n", "s\n", "\n", "\n", "\n"]
    at = [f"--at={x},{y}" for x, y in own]
    status, _, err = touch(monkeypatch, armchat, emulator, places, lines, *at)
    assert status == 0, err
    assert "armchat: z " in err and err.count("a step is x, y or z") == 2
    assert "point 2 of 5: your point 2" in err
    assert len(calibration.load(Standing, kept).residuals) == 4


def test_giving_up_leaves_nothing(monkeypatch, armchat, kept, emulator):
    places = [truth().millimetres(Pose(x, y, 0)) for x, y in MIDDLES]
    for lines in (["\n", "q\n"], ["\n"]):
        status, _, err = touch(monkeypatch, armchat, emulator, places, lines)
        assert status == 1 and "1 points were touched" in err
    assert not kept.exists()
