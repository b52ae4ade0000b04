"""The map: what stands where, on the right cells, at any size."""

from __future__ import annotations

import msgspec
import pytest
from tui_pilot import held, map_rows, say, shown, talking, wait_until
from tui_world import PLAN, SCENE, thing

from agent.messages import Target, Waypoint
from scene.types import Scene
from tui.canvas import Canvas, View
from tui.drawing import COLORS, DARK, LIGHT, Picture, color_of, draw
from tui.map import aside, title
from tui.plain import one_line, plain

pytestmark = pytest.mark.live


def cells_of(rows, color):
    """(column, row) of the cells that show a colour."""
    return {
        (column, row)
        for row, cells in enumerate(rows)
        for column, cell in enumerate(cells)
        if color in (cell.bg, cell.fg if cell.char in "▘▝▀▖▌▞▛▗▚▐▜▄▙▟█" else None)
    }


def view_of(width, height, along=1.12):
    return View(width, height - 1, along * width / 2 / (height - 1), along)


@pytest.mark.parametrize("size", [(36, 13), (56, 25), (100, 41)])
def test_an_object_covers_the_cells_of_its_footprint(size):
    width, height = size
    item = thing("box_1", 0.5, -0.4, 0.4, color="red")
    found = cells_of(draw(Picture(Scene(objects=(item,))), width, height, DARK), COLORS["red"])
    view = view_of(width, height)
    assert {column for column, _ in found} <= set(range(view.column(0.3), view.column(0.7) + 1))
    assert {row for _, row in found} <= set(range(view.row(-0.2), view.row(-0.6) + 1))
    assert (view.column(0.5), view.row(-0.45)) in found


def test_x_grows_to_the_right_and_y_upwards_and_you_sit_below():
    scene = Scene(objects=(thing("nut_1", -0.6, -0.6, color="red"),
                           thing("pin_1", 0.6, 0.6, color="blue")))  # fmt: skip
    rows = draw(Picture(scene), 60, 26, DARK)
    red, blue = cells_of(rows, COLORS["red"]), cells_of(rows, COLORS["blue"])
    assert max(c for c, _ in red) < min(c for c, _ in blue)
    assert min(r for _, r in red) > max(r for _, r in blue)
    assert "you" in "".join(cell.char for cell in rows[-1])


@pytest.mark.parametrize("size", [(2, 2), (10, 5), (36, 13), (37, 12), (200, 60)])
def test_every_size_is_filled_exactly(size):
    rows = draw(Picture(SCENE, PLAN), *size, DARK)
    assert [len(row) for row in rows] == [size[0]] * size[1]


def test_small_things_are_never_lost():
    scene = Scene(objects=(thing("pea_1", 0.123, 0.321, 0.01, color="red"),))
    assert cells_of(draw(Picture(scene), 36, 13, DARK), COLORS["red"])


def test_a_turned_object_reaches_farther_along_the_diagonal():
    square = thing("box_1", 0.0, 0.0, 0.6, color="red")
    turned = msgspec.structs.replace(square, r=0.785)
    flat = cells_of(draw(Picture(Scene(objects=(square,))), 80, 41, DARK), COLORS["red"])
    tilted = cells_of(draw(Picture(Scene(objects=(turned,))), 80, 41, DARK), COLORS["red"])
    assert max(c for c, _ in tilted) > max(c for c, _ in flat)


def test_what_stands_on_something_covers_it():
    plate = thing("plate_1", 0.0, 0.0, 0.8, color="white")
    cup = thing("cup_1", 0.0, 0.0, 0.4, color="blue", z=0.1, on="plate_1")
    rows = draw(Picture(Scene(objects=(cup, plate))), 80, 41, DARK)
    view = view_of(80, 41)
    assert (view.column(0.1), view.row(0.1)) in cells_of(rows, COLORS["blue"])


def test_two_of_a_name_are_told_apart_by_their_ids():
    text = "\n".join("".join(cell.char for cell in row) for row in draw(
        Picture(SCENE), 80, 30, DARK))  # fmt: skip
    assert "apple" in text
    assert "apple_1" not in text
    assert "cup_1" in text
    assert "cup_2" in text


def test_the_plan_is_dotted_and_the_tool_is_a_cross():
    plan = (Waypoint(-0.5, 0.0, 0.9, 0, False), Waypoint(0.5, 0.0, 0.9, 0, False))
    rows = draw(Picture(Scene(), plan, tool=plan[1]), 60, 26, DARK)
    view = view_of(60, 26)
    row = rows[view.row(0.0)]
    assert all("\u2800" < row[c].char <= "\u28ff"
               for c in range(view.column(-0.4), view.column(0.4)))  # fmt: skip
    assert row[view.column(0.5)].char == "┼"


def test_grips_are_marked_where_they_will_happen():
    plan = tuple(
        Waypoint(x, 0.0, 0.1, 0, grip) for x, grip in ((-0.5, False), (-0.5, True), (0.5, True),
                                                       (0.5, False))
    )  # fmt: skip
    text = "".join("".join(cell.char for cell in row) for row in draw(
        Picture(Scene(), plan), 60, 26, DARK))  # fmt: skip
    assert text.count("○") == 1
    assert text.count("●") == 1

    assert aside(Picture(Scene(), plan)) == "○ grips  ● lets go"


def test_the_way_at_hand_stands_out_from_what_is_done_and_what_is_to_come():
    plan = tuple(Waypoint(x, y, 0.9, 0, False) for x, y in ((-0.9, 0.9), (0.0, 0.9), (0.9, 0.9)))
    start = Waypoint(-0.9, -0.9, 0.9, 0, False)
    picture = Picture(Scene(), plan, start=start, done=1, ahead=True)
    rows, view = draw(picture, 80, 41, DARK), view_of(80, 41)
    assert rows[view.row(0.0)][view.column(-0.9)].fg == DARK.done
    assert rows[view.row(0.9)][view.column(-0.5)].fg == DARK.tool
    assert rows[view.row(0.9)][view.column(0.0)].char == "◇"
    assert rows[view.row(0.9)][view.column(0.5)].fg == DARK.plan
    assert aside(picture) == "◇ next: 0, 180, 180 mm"
    assert picture._replace(ahead=False).next is None
    assert picture._replace(done=3).next is None


def test_a_grip_that_comes_next_is_told_in_words():
    open_, shut = (Waypoint(0.5, 0.0, 0.1, 0, grip) for grip in (False, True))
    for done, words in ((1, "grip"), (2, "let go")):
        picture = Picture(Scene(), (open_, shut, open_), done=done, ahead=True)
        assert aside(picture).startswith(f"◇ next: {words}")


def test_white_things_are_seen_on_a_white_table():
    assert color_of(thing("a_1", 0, 0, color="white"), LIGHT) != COLORS["white"]
    assert color_of(thing("a_1", 0, 0, color="white"), DARK) == COLORS["white"]


def test_a_place_that_is_offered_is_marked():
    rows = draw(Picture(SCENE, targets=(Target(-0.5, -0.5),)), 60, 26, DARK)
    view = view_of(60, 26)
    assert rows[view.row(-0.5)][view.column(-0.5)].char == "◎"


def test_a_thing_far_off_the_table_stays_on_the_rim():
    scene = Scene(objects=(thing("ball_1", 9.0, 0.0, 0.2, color="red", on="floor"),))
    found = cells_of(draw(Picture(scene), 60, 26, DARK), COLORS["red"])
    assert max(column for column, _ in found) == 59


def test_tray_floor_and_gripper_are_told_below_the_map():
    scene = Scene(
        objects=(thing("ball_1", 2.0, 0.0, on="floor"),
                 thing("nut_1", 0.0, 0.0, on="gripper", held=True)),
        tray=SCENE.tray,
    )  # fmt: skip
    assert aside(Picture(scene)) == "held: nut  floor: ball  tray: orange"


def test_positions_are_told_in_millimetres_of_this_table():
    picture = Picture(Scene(table_m=0.4), tool=Waypoint(-0.5, 1.0, 0.25, 0, False))
    assert str(title(picture)) == "table 400 mm  tip -100, 200, 50 mm"


def test_a_colour_nobody_knows_is_grey():
    assert color_of(thing("a_1", 0, 0, color="octarine"), DARK) == DARK.thing
    assert color_of(thing("a_1", 0, 0, color="dark red"), DARK) != DARK.thing
    assert color_of(thing("a_1", 0, 0), DARK) == DARK.thing


def test_a_cell_keeps_two_colours_of_its_four_pixels():
    canvas = Canvas(View(1, 1, 1.0, 1.0), lambda column, row: (0, 0, 0))
    canvas.line(-1, 1, -1, 1, (1, 1, 1))
    assert canvas.cells()[0][0].char == "⠁"


def test_names_cannot_steer_the_terminal():
    assert plain("a\x1b[2Jb\u202ec") == "a\ufffd[2Jb\ufffdc"
    assert one_line("two\n lines") == "two lines"


async def test_the_application_shows_the_scene_and_its_changes():
    async with talking((120, 40)) as (world, app, pilot):
        await wait_until(pilot, lambda: any("apple" in row for row in map_rows(app)))
        assert "tray: orange" in shown(app, "#map-aside")
        world.agent.look(Scene(objects=(thing("melon_1", 0.0, 0.0, 0.9),)))
        await wait_until(pilot, lambda: any("melon" in row for row in map_rows(app)))
        assert not any("apple" in row for row in map_rows(app))


async def test_the_application_shows_the_plan_and_the_tip():
    async with talking((120, 40)) as (world, app, pilot):
        with held(world):
            await say(app, pilot, "push the apple")
            await wait_until(pilot, lambda: app.map.picture.plan == PLAN)
            world.agent.steps.release()
            await wait_until(pilot, lambda: app.map.picture.done == 1)
            await wait_until(pilot, lambda: "tip -60, 40, 180 mm" in shown(app, "#map-title"))


async def test_an_unchanged_scene_is_not_drawn_again():
    async with talking() as (world, app, pilot):
        await wait_until(pilot, lambda: not app.map._waiting)
        before = app.map._drawn_at
        seen = app.seen
        world.agent.look()
        await wait_until(pilot, lambda: app.seen is not seen)
        assert app.map._drawn_at == before
        assert not app.map._waiting
