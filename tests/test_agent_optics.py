"""`calibrate camera`, `table`, `print` and what doctor says of the eye, from the shell."""

import re
import shlex
import threading
import tomllib
from pathlib import Path

import msgspec
import numpy as np
import pytest

from agent.cli import parser
from agent.config import CameraConfig
from agent.doctor import findings
from agent.errors import CalibrationError
from agent.optics import calibrate_camera, calibrate_table
from evals import optics_world as world
from scene import calibration, lens, markers, opencv, sheets, touched
from scene.calibration import Lens, Table
from scene.camera import Ended
from scene.sight import Picture

pytestmark = pytest.mark.usefixtures("kept")

SIZE = (640, 480)
CONFIG = CameraConfig(source="pictures")
EYE = world.camera(SIZE, seed=2)
LAID = [
    world.Marker(number, *four.mean(axis=0), 50.0)
    for number, four in markers.layout(CONFIG).places().items()
]
SHOT = world.over_table(580.0, 8.0, 250.0)


@pytest.fixture(scope="module")
def boards(tmp_path_factory):
    """A folder of board pictures, of which one is blurred and one comes twice."""
    folder = tmp_path_factory.mktemp("boards")
    looks = list(world.board_shots(EYE, 12, seed=4, noise=1.0))
    for number, look in enumerate(looks):
        (folder / f"{number:02}.png").write_bytes(opencv.png(world.picture_of_board(EYE, look)))
    (folder / "13.png").write_bytes((folder / "03.png").read_bytes())
    soft = world.picture_of_board(EYE, looks[4]._replace(blur=6.0))
    (folder / "14.png").write_bytes(opencv.png(soft))
    return folder


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """A folder of pictures of one table: two good ones, one with a marker hidden."""
    folder = tmp_path_factory.mktemp("tables")
    for number, laid in enumerate((LAID, LAID[1:], LAID)):
        look = SHOT._replace(seed=number)
        (folder / f"{number}.png").write_bytes(opencv.png(world.picture_of_table(EYE, look, laid)))
    return folder


class Shown:
    """A camera that shows these pictures, once."""

    def __init__(self, *pixels):
        self.coming = list(pixels)

    def look(self):
        if not self.coming:
            raise Ended("over")
        return Picture(self.coming.pop(0), 0.0)

    def close(self):
        pass


# --- camera and table ----------------------------------------------------------------------------


def test_from_pictures_to_a_calibrated_table(armchat, kept, boards, tables):
    status, out, err = armchat("calibrate", "camera", "--source", str(boards))
    assert status == 0 and out.startswith("The lens: ") and str(kept / "camera.json") in out
    for told in ("1 of 15", "everything is shown", "seen like this before", "blurred"):
        assert told in err
    found = calibration.load(Lens, kept)
    assert found.pictures == 12 and found.size == SIZE and found.source == str(boards)
    assert found.matrix[0][0] == pytest.approx(EYE.matrix[0, 0], rel=0.01)

    status, out, err = armchat("calibrate", "table", "--source", str(tables), "--json")
    assert status == 0 and "picture 2 is left out: the near left marker is not seen" in err
    table = msgspec.json.decode(out, type=Table)
    assert table == calibration.load(Table, kept) and table.frames == 2
    grid = np.stack(np.meshgrid(*2 * [np.linspace(-1, 1, 11)]), axis=-1).reshape(-1, 2)
    seen = found.flat(SHOT.seen(EYE, grid * 200))
    off = np.linalg.norm(table.view.points(seen) - grid, axis=1) * 200
    assert off.mean() <= 0.5 and off.max() <= 1.0


def test_a_video_of_the_table_does_as_well(armchat, kept, tmp_path):
    calibration.save(a_lens(), kept)
    cv = opencv.loaded()
    writer = cv.VideoWriter(str(tmp_path / "t.avi"), cv.VideoWriter.fourcc(*"MJPG"), 10, SIZE)
    for seed in range(4):
        writer.write(world.picture_of_table(EYE, SHOT._replace(seed=seed), LAID))
    writer.release()
    status, out, err = armchat("calibrate", "table", "--source", "t.avi")
    assert status == 0, err
    table = calibration.load(Table, kept)
    assert table.frames == 4 and table.mm_max < 0.5 and "in 4 pictures" in out


def test_the_table_needs_the_lens_and_pictures_of_its_size(armchat, kept, tables):
    status, out, err = armchat("calibrate", "table", "--source", str(tables))
    assert (status, out) == (1, "") and "armchat calibrate camera" in err
    calibration.save(a_lens(size=(1280, 960)), kept)
    status, _, err = armchat("calibrate", "table", "--source", str(tables))
    assert status == 1 and "calibrated at 1280x960" in err
    assert not (kept / "table.json").exists()


def test_a_bad_series_is_refused_and_nothing_is_kept(armchat, kept, boards, tables):
    status, out, err = armchat("calibrate", "camera", "--source", str(boards / "03.png"))
    assert (status, out) == (1, "") and "1 usable pictures" in err
    assert "still missing" in err and not kept.exists()
    status, _, err = armchat("calibrate", "camera", "--source", "none.mp4")
    assert status == 1 and "no such file" in err
    status, _, err = armchat("calibrate", "camera", "--source", str(tables))
    assert status == 1 and "0 usable pictures" in err and "of the board's 24 corners" in err


def test_pictures_of_two_sizes_are_refused():
    eye = Shown(np.full((48, 64, 3), 120, np.uint8), np.full((96, 128, 3), 120, np.uint8))
    with pytest.raises(CalibrationError, match="picture 2 is 128x96"):
        calibrate_camera(eye, CONFIG, lambda line: None)


def test_a_live_camera_is_done_when_all_is_shown(monkeypatch):
    """After fifteen boards, each held still, and full coverage nothing more is looked at."""
    steps = np.stack(np.meshgrid(np.arange(1, 7), np.arange(1, 5)), axis=-1).reshape(-1, 2) * 38.0
    coming = []
    for look in world.board_shots(EYE, 20, seed=4):
        pixels = look.seen(EYE, steps) + np.random.default_rng(look.seed).normal(0, 0.1, (24, 2))
        inside = ((pixels > 3) & (pixels < np.array(SIZE) - 3)).all(axis=1)
        coming += 2 * [lens.shown(steps[inside], pixels[inside], SIZE)]
    seen = iter(coming)
    monkeypatch.setattr("scene.lens.find", lambda pixels, limits: next(seen))
    eye, said = Shown(*[np.zeros((480, 640, 3), np.uint8)] * 40), []
    found = calibrate_camera(eye, CameraConfig(source="0"), said.append, live=True)
    assert found.pictures == 15 and len(eye.coming) == 10
    assert "15 of 15; everything is shown" in said[-1]
    assert sum("hold still" in line for line in said) == 15


def test_the_table_is_tried_for_a_while_only(kept, boards):
    calibration.save(a_lens(), kept)
    config = CameraConfig(folder=str(kept))
    blank, said = np.full((480, 640, 3), 120, np.uint8), []
    eye = Shown(*[blank] * 130)
    with pytest.raises(CalibrationError, match="none of the four markers"):
        calibrate_table(eye, config, said.append)
    assert len(eye.coming) == 30
    assert sum("none of the four" in line for line in said) == 1


def a_lens(**changes):
    plain = Lens(
        date="2031-01-01T10:00:00+00:00", source="0", size=SIZE,
        matrix=calibration.rows(EYE.matrix), distortion=tuple(map(float, EYE.distortion)),
        pictures=15, px=0.1, mm=0.05, focal_sd=0.5,
    )  # fmt: skip
    return msgspec.structs.replace(plain, **changes)


# --- print ---------------------------------------------------------------------------------------


def test_print_writes_pdf_or_png(armchat, tmp_path):
    status, out, err = armchat("calibrate", "print", "--out", "sheets.pdf")
    assert (status, out) == (0, "sheets.pdf\n") and "100 %" in err
    assert (tmp_path / "sheets.pdf").read_bytes() == sheets.pdf(sheets.sheets(50.0))
    status, out, _ = armchat("calibrate", "print", "--out", "s.png")
    assert status == 0 and out.split() == ["s-board.png", "s-markers.png"]
    assert (
        len(opencv.find_markers(opencv.gray(opencv.read_picture(tmp_path / "s-markers.png")))) == 4
    )
    assert armchat("calibrate", "print", "--out", "s.doc")[0] == 2
    assert armchat("calibrate", "print", "--out", "none/s.pdf")[0] == 2


# --- doctor --------------------------------------------------------------------------------------


def eye_lines():
    """What doctor says from the camera on, without the serial ports."""
    lines = list(findings(False, None))
    start = next(
        n for n, line in enumerate(lines) if "camera" in line.text and "opencv" not in line.text
    )
    return lines[start:-1]


def configured(monkeypatch, source, **more):
    for name, value in {"source": source, **more}.items():
        monkeypatch.setenv(f"ARMCHAT_CAMERA__{name.upper()}", str(value))


def test_doctor_without_a_camera_warns_and_says_what_for(armchat, monkeypatch):
    configured(monkeypatch, "/dev/video999")
    (line,) = eye_lines()
    assert line.verdict == "warn" and "plug it in" in line.fix


def test_doctor_says_where_a_device_does_not_give_the_size_it_was_asked_for(armchat, monkeypatch):
    good = world.picture_of_table(EYE, SHOT, LAID)

    class Device:
        """A camera that goes on for ever, a hundred pictures a second."""

        def read(self):
            threading.Event().wait(0.01)
            return good

        def release(self):
            pass

    monkeypatch.setattr("scene.camera.open_device", lambda *_: Device())
    configured(monkeypatch, 0)
    said = eye_lines()
    assert [line.verdict for line in said] == ["ok", "warn", "warn"]
    assert "1280x960" in said[1].text and "size = [640, 480]" in said[1].fix


def test_doctor_follows_the_calibration(armchat, monkeypatch, kept, tables, tmp_path):
    configured(monkeypatch, tables)
    said = eye_lines()
    assert [line.verdict for line in said] == ["ok", "warn"]
    assert "armchat calibrate camera" in said[1].fix
    calibration.save(a_lens(), kept)
    said = eye_lines()
    assert [line.verdict for line in said] == ["ok", "ok", "warn"]
    assert "armchat calibrate table" in said[2].fix
    assert armchat("calibrate", "table", "--source", str(tables))[0] == 0
    said = eye_lines()
    assert [line.verdict for line in said] == ["ok"] * 4, said
    assert "markers are where they were" in said[3].text
    moved = world.over_table(580.0, 8.0, 250.0, (12, 0))
    path = tmp_path / "moved.png"
    path.write_bytes(opencv.png(world.picture_of_table(EYE, moved, LAID)))
    configured(monkeypatch, path)
    last = eye_lines()[-1]
    assert last.verdict == "fail" and "moved by" in last.text
    assert float(last.text.split("by ")[1].split()[0]) == pytest.approx(12, abs=2)


def test_doctor_says_what_is_wrong_with_light_size_and_files(armchat, monkeypatch, kept, tmp_path):
    dark = tmp_path / "dark.png"
    dark.write_bytes(opencv.png(np.full((480, 640, 3), 9, np.uint8)))
    configured(monkeypatch, dark)
    calibration.save(a_lens(size=(1280, 960)), kept)
    said = eye_lines()
    assert [line.verdict for line in said] == ["ok", "warn", "fail"]
    assert "too dark" in said[1].text and "more light" in said[1].fix
    assert "640x480" in said[2].fix
    (kept / "camera.json").write_text("nothing")
    assert "damaged" in eye_lines()[-1].fix


# --- the documentation ---------------------------------------------------------------------------

DOCS = (Path(__file__).parent.parent / "docs" / "camera.md").read_text(encoding="utf-8")


def test_every_command_of_the_docs_is_one():
    lines = re.findall(r"^(?:```)?armchat ([^#\n]+)", DOCS, re.MULTILINE)
    assert len(lines) >= 6
    for line in lines:
        assert parser().parse_args(shlex.split(line)).act


def test_the_configuration_of_the_docs_is_the_default():
    block = DOCS.split("```toml\n")[1].split("```")[0]
    told = tomllib.loads(block)["camera"]
    assert msgspec.convert(told, CameraConfig) == CameraConfig()


def test_the_limits_of_the_docs_are_those_that_hold():
    assert f"more than {lens.MOST_PX:g} pixels" in DOCS
    assert f"more than {lens.MOST_STRETCH:.0%}".replace("%", " %") in DOCS
    assert f"worse than {lens.MOST_SPREAD:.0%}".replace("%", " %") in DOCS
    assert f"more than {touched.MOST_MM:g} mm off is refused" in DOCS
