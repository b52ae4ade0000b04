"""Lens, table, arm: fitted to a truth that is known, in the stated millimetres, or refused."""

import math
from functools import lru_cache

import msgspec
import numpy as np
import pytest

from agent.config import CameraConfig
from agent.errors import CalibrationError
from evals import optics_world as world
from scene import calibration, lens, markers, opencv, touched
from scene.calibration import Lens, Standing, Table

LIMITS = CameraConfig()
PLAN = markers.layout(LIMITS)
SIZE = (1280, 960)
GRID = np.stack(np.meshgrid(*2 * [np.linspace(-1, 1, 21)]), axis=-1).reshape(-1, 2)
HALF = LIMITS.table / 2


def boards(eye, count=15, noise=0.1, seed=0, bend=0.0):
    """What a detector sees of boards before a camera: true corners, with noise (pixels)."""
    chance = np.random.default_rng(seed)
    steps = np.stack(np.meshgrid(np.arange(1, 7), np.arange(1, 5)), axis=-1).reshape(-1, 2) * 38.0
    found = []
    for shot in world.board_shots(eye, count, seed):
        pixels = shot.seen(eye, steps * [1 + bend, 1]) + chance.normal(0, noise, (len(steps), 2))
        inside = ((pixels > 5) & (pixels < np.array(eye.size) - 5)).all(axis=1)
        found.append(lens.shown(steps[inside], pixels[inside], eye.size))
    return found


@lru_cache
def eye():
    return world.camera(SIZE, seed=3)


@lru_cache
def good_lens():
    return lens.fit(boards(eye()), SIZE, "0", "2031-01-01")


def laid(**changes):
    """The four markers where they belong, some of them changed: near_left=(x, y, turn) added."""
    places = {number: four.mean(axis=0) for number, four in PLAN.places().items()}
    result = []
    for number, where in markers.CORNERS.items():
        x, y, turn = changes.get(where.replace(" ", "_"), (0, 0, 0))
        result.append(world.Marker(number, *(places[number] + [x, y]), 50.0, turn))
    return result


def shot(seed=0, **how):
    return world.over_table(560.0, 14.0, 250.0, (10, -15), seed=seed, **how)


def corners(there=None, look=None, noise=0.05, seed=1):
    """What is seen of markers, without drawing them."""
    chance = np.random.default_rng(seed)
    look = look or shot()
    return {
        one.number: good_lens().flat(look.seen(eye(), one.corners()))
        + chance.normal(0, noise, (4, 2))
        for one in there or laid()
    }


def table(*pictures, plan=PLAN):
    return markers.fit(pictures, good_lens(), plan, "0", "2031-01-02")


def refused(call, *arguments):
    with pytest.raises(CalibrationError) as caught:
        call(*arguments)
    return str(caught.value)


def errors_mm(made: Table, through: Lens, look):
    """How far off (mm) every point of the table is, from where it truly appears."""
    seen = through.flat(look.seen(eye(), GRID * HALF))
    return np.linalg.norm(made.view.points(seen) - GRID, axis=1) * HALF


# --- the lens ------------------------------------------------------------------------------------


def test_the_lens_is_found_from_fifteen_boards():
    found, truth = good_lens(), eye()
    assert found.matrix[0][0] == pytest.approx(truth.matrix[0, 0], rel=0.005)
    assert found.matrix[0][2] == pytest.approx(truth.matrix[0, 2], abs=3)
    assert found.distortion[0] == pytest.approx(truth.distortion[0], abs=0.02)
    assert 0.05 < found.px < 0.2 and 0.02 < found.mm < 0.1 and found.pictures == 15
    assert 0 < found.focal_sd < 0.005 * found.matrix[0][0]


def test_it_straightens_the_whole_picture():
    pixels = np.stack(np.meshgrid(np.arange(0, 1280, 79), np.arange(0, 960, 73)), -1)
    pixels = pixels.reshape(-1, 2).astype(float)
    rays = eye().rays(pixels)
    found = good_lens()
    ours = (found.flat(pixels) - [found.matrix[0][2], found.matrix[1][2]]) / found.matrix[0][0]
    assert np.abs(ours - rays).max() * 560 < 3  # mm at the table, even in the picture's corners


@pytest.fixture(scope="module")
def small_eye():
    return world.camera((640, 480), seed=1)


def test_a_drawn_board_is_found_where_it_is(small_eye):
    for look in list(world.board_shots(small_eye, 5))[3:]:
        seen = lens.find(world.picture_of_board(small_eye, look), LIMITS)
        off = np.linalg.norm(seen.pixels - look.seen(small_eye, seen.places), axis=1)
        assert len(off) >= 16 and off.mean() < 0.15 and off.max() < 0.6


def test_what_was_not_shown_yet_is_said():
    everything = boards(eye())
    assert lens.missing(everything, SIZE) == ()
    assert lens.missing([], SIZE) == ("any picture of the board",)
    left = [one for one in everything if one.pixels[:, 0].max() < 860]
    assert "the upper right of the picture" in lens.missing(left, SIZE)
    straight = [one for one in everything if lens.tilt(one) in (None, "left", "right")]
    said = lens.missing(straight, SIZE)
    assert "tilted to face up" in said and "tilted to face down" in said
    assert "tilted to face left" not in said
    assert "lower right of the picture" in refused(lens.fit, left * 3, SIZE, "0", "")


@pytest.mark.parametrize(
    ("axis", "way"),
    [((0, 0.5), "left"), ((0, -0.5), "right"), ((0.5, 0), "down"), ((-0.5, 0), "up")],
)
def test_a_tilt_is_told_as_the_camera_sees_it(axis, way):
    turn = world._rotation(np.array([*axis, 0.0]))
    steps = np.stack(np.meshgrid(np.arange(1, 7), np.arange(1, 5)), axis=-1).reshape(-1, 2) * 38.0
    one = world.Shot(turn, np.array([0, 0, 500.0]) - turn @ np.array([133, 95, 0.0]))
    near = {"left": steps[:, 0] > 200, "right": steps[:, 0] < 60,
            "up": steps[:, 1] > 140, "down": steps[:, 1] < 60}[way]  # fmt: skip
    depth = np.column_stack((steps, 0 * steps[:, 0])) @ turn.T + one.translation
    # facing left: its left side is farther from the camera than its right one
    assert depth[near, 2].mean() < depth[~near, 2].mean()
    assert lens.tilt(lens.shown(steps, one.seen(eye(), steps), SIZE)) == way


def test_the_same_view_again_is_not_new():
    first, second, *_ = boards(eye())
    assert not lens.is_new(first, [first], SIZE) and lens.is_new(second, [first], SIZE)


def test_too_few_bad_or_stretched_boards_are_refused():
    assert "4 usable pictures" in refused(lens.fit, boards(eye(), 4), SIZE, "0", "")
    assert "deviate by" in refused(lens.fit, boards(eye(), noise=1.5), SIZE, "0", "")
    said = refused(lens.fit, boards(eye(), bend=0.03), SIZE, "0", "")
    assert "stretched" in said and "100 %" in said


def test_one_bad_board_among_many_is_left_out():
    several = boards(eye())
    chance = np.random.default_rng(8)
    wrong = several[3]._replace(
        pixels=several[3].pixels + chance.normal(0, 8, several[3].pixels.shape)
    )
    found = lens.fit([*several[:3], wrong, *several[4:]], SIZE, "0", "")
    assert found.pictures == 14 and found.px < 0.2


def test_why_a_board_cannot_be_used(small_eye):
    look = list(world.board_shots(small_eye, 5))[4]
    good = world.picture_of_board(small_eye, look)
    assert "mirrored" in refused(lens.find, good[:, ::-1], LIMITS)
    assert "0 of the board's 24" in refused(lens.find, np.full_like(good, 120), LIMITS)
    assert "too dark" in refused(lens.find, good // 12, LIMITS)
    soft = world.picture_of_board(small_eye, look._replace(blur=5.0))
    assert "blurred" in refused(lens.find, soft, LIMITS)


# --- the table -----------------------------------------------------------------------------------


def test_drawn_markers_give_the_whole_table_in_millimetres():
    looks = [shot(seed) for seed in range(2)]
    seen = [
        markers.find(world.picture_of_table(eye(), one, laid()), LIMITS, good_lens())
        for one in looks
    ]
    found = table(*seen)
    off = errors_mm(found, good_lens(), looks[0])
    assert off.mean() <= 0.5 and off.max() <= 1.0
    assert found.frames == 2 and 0 < found.mm_mean <= found.mm_max < 0.5 and found.px_max < 1
    assert np.array(found.camera) * HALF == pytest.approx(looks[0].centre, abs=6)


def test_the_pixel_convention_holds_from_the_raw_picture_to_the_table():
    """Half a pixel is 0.2 mm here: white discs must be found nearer than that."""
    places = ((0.0, 0.0), (-110.0, 90.0), (120.0, 60.0), (60.0, -120.0))
    look = shot(noise=0.0)
    raw = world.picture_of_table(eye(), look, laid(), places)
    found = table(markers.find(raw, LIMITS, good_lens()))
    flat = good_lens().flattener()(calibration.Picture(raw, 0.0)).pixels[:, :, 0].astype(float)
    for place in places:
        u, v = found.view.pixels(np.array([place]) / HALF)[0]
        left, top = round(u) - 30, round(v) - 30
        light = np.clip(flat[top : top + 61, left : left + 61] - 155, 0, None)
        rows, columns = np.mgrid[top : top + 61, left : left + 61]
        middle = np.array([[(columns * light).sum(), (rows * light).sum()]]) / light.sum()
        assert found.view.points(middle)[0] * HALF == pytest.approx(place, abs=0.15)


def test_with_realistic_noise_the_table_stays_within_its_figures():
    worst, means = [], []
    for seed in range(20):
        found = table(*(corners(noise=0.25, seed=10 * seed + n) for n in range(3)))
        off = errors_mm(found, good_lens(), shot())
        worst.append(off.max())
        means.append(off.mean())
    assert max(worst) <= 1.0 and max(means) <= 0.5


def test_a_hidden_marker_is_named():
    for hidden, where in list(markers.CORNERS.items())[1:2]:
        there = [one for one in laid() if one.number != hidden]
        said = refused(
            markers.find, world.picture_of_table(eye(), shot(), there), LIMITS, good_lens()
        )
        assert said.startswith(f"the {where} marker is not seen")
    two = [one for one in laid() if one.number in (40, 42)]
    said = refused(markers.find, world.picture_of_table(eye(), shot(), two), LIMITS, good_lens())
    assert "near right and far left markers are not seen" in said
    nothing = world.picture_of_table(eye(), shot(), [])
    assert "none of the four" in refused(markers.find, nothing, LIMITS, good_lens())


@pytest.mark.parametrize("where", ["near_left", "far_right"])
@pytest.mark.parametrize("away", [(2.0, 0.0), (-3.0, 4.0)])
def test_a_moved_marker_is_named_with_its_millimetres(where, away):
    said = refused(table, corners(laid(**{where: (*away, 0)})))
    assert f"the {where.replace('_', ' ')} marker lies" in said
    assert float(said.split("lies ")[1].split(" mm")[0]) == pytest.approx(
        math.hypot(*away), abs=0.4
    )
    assert ("to the right" if away[0] > 0 else "to the left") in said


def test_a_turned_marker_and_swapped_ones_are_named():
    said = refused(table, corners(laid(far_left=(0, 0, 90))))
    assert "the far left marker is turned by 90°" in said
    seen = corners()
    said = refused(table, {**seen, 40: seen[43], 43: seen[40]})
    assert "near left and far left markers are swapped" in said


def test_a_wrong_print_is_noticed():
    small = [
        one._replace(side=48.0, x=math.copysign(176, one.x), y=math.copysign(176, one.y))
        for one in laid()
    ]
    said = refused(table, corners(small))
    assert "48.0 mm wide, not 50" in said and "100 %" in said


def test_a_wrong_side_in_the_configuration_is_noticed():
    said = refused(lambda: table(corners(), plan=PLAN._replace(side=380.0)))
    assert "the markers" in said and ("table in [camera]" in said or "mm wide" in said)


def test_another_lens_is_noticed():
    zoomed = eye()._replace(matrix=eye().matrix * [[1.06, 1, 1], [1, 1.06, 1], [1, 1, 1]])
    look = world.over_table(560.0, 30.0, 250.0)
    seen = {one.number: good_lens().flat(look.seen(zoomed, one.corners())) for one in laid()}
    assert "not those that were calibrated" in refused(table, seen)


def test_a_camera_that_moves_is_noticed():
    moved = shot()._replace(translation=shot().translation + np.array([2.0, 0, 0]))
    assert "wanders by" in refused(table, corners(), corners(look=moved))


def test_a_bad_picture_is_refused_with_its_reason():
    drawn = world.picture_of_table(eye(), shot(), laid())
    assert "mirrored" in refused(markers.find, drawn[:, ::-1], LIMITS, good_lens())
    assert "too dark" in refused(markers.find, drawn // 15, LIMITS, good_lens())
    burnt = np.clip(drawn.astype(int) * 4, 0, 255).astype(np.uint8)
    assert "burnt out" in refused(
        markers.find, np.maximum(burnt, 245), CameraConfig(burnt=0.01), good_lens()
    )
    soft = world.picture_of_table(eye(), shot(blur=6.0), laid())
    assert "blurred" in refused(markers.find, soft, LIMITS, good_lens())


def test_what_is_out_of_focus_beside_the_markers_does_not_matter():
    drawn = world.picture_of_table(eye(), shot(), laid()).copy()
    soft = np.rint(128 + 120 * np.sin(np.arange(440) / 7)).astype(np.uint8)
    drawn[330:630, 420:860] = soft[None, :, None]
    assert opencv.edge_width(opencv.gray(drawn)) > LIMITS.blurred
    assert len(markers.find(drawn, LIMITS, good_lens())) == 4


def test_an_inset_moves_the_table_and_not_the_view():
    inset = PLAN._replace(inset=-50.0, side=300.0)
    found = table(corners(), plan=inset)
    near_left = found.view.points(
        good_lens().flat(shot().seen(eye(), np.array([[-150.0, -150.0]])))
    )
    assert near_left[0] == pytest.approx([-1, -1], abs=0.002)


# --- the arm -------------------------------------------------------------------------------------


def touches(count=5, scale=75.0, turn=3.0, noise=0.0, mirror=False, seed=0):
    spots = [(-0.75, -0.75), (0.75, -0.75), (0.75, 0.75), (-0.75, 0.75), (0, 0.2), (0.3, -0.5)][
        :count
    ]
    chance, angle = np.random.default_rng(seed), math.radians(turn)
    result = []
    for x, y in spots:
        a, b = scale * y, -scale * (-x if mirror else x)
        at = (
            240 + a * math.cos(angle) - b * math.sin(angle),
            5 + a * math.sin(angle) + b * math.cos(angle), -66.0,
        )  # fmt: skip
        noisy = np.array(at) + chance.normal(0, noise, 3)
        result.append(touched.Touch((x, y), tuple(map(float, noisy))))
    return result


def standing(points, side=150.0):
    return touched.fit(points, side, "/dev/ttyUSB0", "2031-01-03")


def test_rotation_scale_and_place_are_found():
    found = standing(touches())
    assert (found.scale, found.turn, found.floor) == pytest.approx((75, 3, -66))
    assert found.offset == pytest.approx((240, 5)) and found.mm_max < 1e-9
    noisy = standing(touches(6, noise=0.3))
    assert noisy.scale == pytest.approx(75, abs=0.5) and 0.05 < noisy.mm_max <= 1


def test_bad_touches_are_refused_with_the_reason():
    assert "3 points" in refused(standing, touches(3))
    assert "left and right are swapped" in refused(standing, touches(mirror=True))
    assert "near to one line" in refused(
        standing, [touched.Touch((n / 4, 0), (240, 60.0 * n, -66)) for n in range(5)]
    )
    assert "[camera] says 400" in refused(standing, touches(), 400.0)
    wrong = touches()
    x, y, z = wrong[2].arm
    wrong[2] = touched.Touch(wrong[2].table, (x + 5, y, z))
    said = refused(standing, wrong)
    assert "point 3 does not fit" in said and "residuals" in said
    assert "home the arm" in refused(standing, wrong[:4])
    wrong[2] = touched.Touch(wrong[2].table, (x, y, z + 6))
    assert "point 3 lies 4.8 mm above or below" in refused(standing, wrong)
    shear = [
        touched.Touch(t.table, (t.arm[0] + 0.05 * t.arm[1], t.arm[1], t.arm[2])) for t in touches()
    ]
    assert "deviate by up to" in refused(standing, shear)
    assert "not a number" in refused(
        standing, [*touches(), touched.Touch((0, 0), (math.nan, 0, 0))]
    )


def test_ten_readings_are_one_touch_only_if_the_arm_rests():
    assert touched.mean([(1.0, 2.0, 3.0), (1.1, 2.0, 3.0)]) == pytest.approx((1.05, 2, 3))
    assert "moved by 1.0 mm" in refused(touched.mean, [(1.0, 2.0, 3.0), (2.0, 2.0, 3.0)])


# --- kept ----------------------------------------------------------------------------------------


@pytest.fixture
def kept(tmp_path):
    """A folder with all three."""
    for value in (good_lens(), table(corners()), standing(touches())):
        calibration.save(value, tmp_path)
    return tmp_path


def test_what_is_saved_is_loaded(kept):
    assert calibration.load(Lens, kept) == good_lens()
    assert calibration.load(Standing, kept) == standing(touches())
    through, made = calibration.eye(kept, SIZE, 400.0)
    assert through == good_lens() and made == table(corners())
    assert sorted(file.name for file in kept.iterdir()) == [
        "camera.json",
        "robot.json",
        "table.json",
    ]


def test_what_does_not_fit_is_refused_when_it_is_loaded(kept, tmp_path):
    def eye_of(size=SIZE, side=400.0):
        return refused(calibration.eye, kept, size, side)

    assert "1280x960" in eye_of((640, 480)) and "armchat calibrate camera" in eye_of((640, 480))
    assert "a table of 400 mm" in eye_of(side=300.0)
    calibration.save(msgspec.structs.replace(good_lens(), date="later"), kept)
    assert "armchat calibrate table" in eye_of()
    assert "armchat calibrate robot" in refused(calibration.load, Standing, tmp_path / "none")


@pytest.mark.parametrize("text", ["", "{}", '{"date": 1}', "[1, 2"])
def test_a_damaged_file_is_said(kept, text):
    (kept / "camera.json").write_text(text)
    assert "damaged" in refused(calibration.load, Lens, kept)


def test_a_picture_of_another_size_is_not_flattened():
    flatten = good_lens().flattener()
    assert "640x480" in refused(
        flatten, calibration.Picture(np.zeros((480, 640, 3), np.uint8), 0.0)
    )


def test_a_folder_that_cannot_be_written_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    assert "cannot be written" in refused(calibration.save, good_lens(), tmp_path / "file" / "sub")


def test_opencv_draws_what_it_finds():
    board = opencv.draw_board(lens.BOARD, 60)
    places, seen = opencv.find_board(np.pad(board, 40, constant_values=255), lens.BOARD)
    assert len(places) == lens.CORNERS
    assert seen == pytest.approx(places / 38 * 60 + 40 - 0.5, abs=0.05)
