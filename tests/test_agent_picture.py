"""What the picture of a plan shows, read back from the SVG: things, and the ways of the tool."""

import itertools
import math
import re

import pytest
from picture_world import APPLE, BOX, PICK, SVG, Drawing, move, near, pairs, thing

from agent.compose import table
from robot_bridge.ideal import predict
from scene.tray import tray_positions
from scene.types import Pose, Scene

# --- things ---------------------------------------------------------------------------------------


def test_each_thing_is_drawn_where_it_stands_as_large_as_it_is_and_named():
    scene = table("kitchen")
    drawing = Drawing(scene=scene)
    for item in scene.objects:
        node = drawing.footprint(item.id)
        assert drawing.middle(node) == near(item.x, item.y)
        assert float(node.get("width")) / drawing.scale == near(item.width)
        assert float(node.get("height")) / drawing.scale == near(item.height)
        assert item.name in drawing.words("text")


def test_things_of_the_tray_are_drawn_where_they_wait():
    scene = table("kitchen")
    drawing = Drawing(scene=scene)
    for name, place in tray_positions(scene).items():
        node = drawing.footprint(name)
        assert drawing.middle(node) == near(*place) and "on-tray" in node.get("class")


def test_a_turned_thing_turns_anticlockwise_about_its_middle():
    drawing = Drawing(scene=Scene(objects=(BOX,)))
    node = drawing.footprint("box_1")
    angle, x, y = map(float, re.findall(r"-?[\d.]+", node.get("transform")))
    assert angle == pytest.approx(-math.degrees(0.5), abs=0.01)
    assert (x, y) == pytest.approx(
        (drawing.zero[0] + 0.5 * drawing.scale, drawing.zero[1] + 0.5 * drawing.scale), abs=0.01
    )


@pytest.mark.parametrize(
    ("color", "name", "fill"),
    [
        ("red", "mug", "red"),
        ("Light Blue", "mug", "blue"),
        (None, "green mug", "green"),
        (None, "mug", "#b4bac6"),
        ("url(#x);evil", "mug", "#b4bac6"),
    ],
)
def test_a_thing_is_filled_by_a_colour_that_is_known_or_a_neutral_one(color, name, fill):
    drawing = Drawing(scene=Scene(objects=(thing(name, 0, 0, id="it", color=color),)))
    assert drawing.footprint("it").get("fill") == fill


def test_what_is_as_wide_as_high_is_round_but_for_blocks():
    ball, block = APPLE, thing("block", 0.3, 0, width=0.1, height=0.1)
    drawing = Drawing(scene=Scene(objects=(ball, block, BOX)))
    round_node = drawing.footprint("apple_1")
    assert float(round_node.get("rx")) == near(float(round_node.get("width")) / 2)
    assert drawing.footprint("block_1").get("rx") == drawing.footprint("box_1").get("rx") == "1"


def test_what_lies_on_the_floor_or_is_held_says_so_and_looks_different():
    fallen = thing("cup", -1.2, 0.2, on="floor", z=-0.7)
    held = thing("pen", 0.0, -1.2, on="gripper", held=True, z=0.8)
    drawing = Drawing(scene=Scene(objects=(fallen, held, BOX)))
    assert {"cup (floor)", "pen (held)", "box"} <= set(drawing.words("text"))
    looks = {drawing.footprint(f"{name}_1").get("style") for name in ("cup", "pen", "box")}
    assert len(looks) == 3


def test_things_that_share_a_name_are_told_apart_by_their_ids():
    two = (thing("cup", -0.5, 0, id="cup_1"), thing("cup", 0.5, 0, id="cup_2"))
    words = Drawing(scene=Scene(objects=two)).words("text")
    assert {"cup_1", "cup_2"} <= set(words) and "cup" not in words


def test_a_thing_far_away_is_shown_at_the_rim_with_where_it_is():
    drawing = Drawing(scene=Scene(objects=(thing("cup", 50, -3, on="floor"),)))
    x, y = drawing.middle(drawing.footprint("cup_1"))
    assert 1.7 < x < 2 and -2 < y < -1.7
    assert "cup (floor) at 50, -3" in drawing.words("text")


def test_where_things_end_is_dashed_with_an_arrow_from_where_they_were():
    scene = Scene(objects=(APPLE, BOX))
    drawing = Drawing(PICK, scene, predict(PICK, scene))
    (end,) = drawing.find("end")
    assert end.get("data-id") == "apple_1" and "stroke-dasharray:4 3" in end.get("style")
    assert drawing.middle(end) == near(0.4, 0.1)
    ((tail, tip),) = drawing.lines("carry")
    assert math.dist(tail, (-0.6, 0.3)) < 0.04 and math.dist(tip, (0.4, 0.1)) < 0.04
    assert len(drawing.find("carry", "head")) == 1


def test_what_falls_ends_on_the_floor_and_what_leaves_the_tray_on_the_table():
    scene = Scene(objects=(APPLE,), tray=(thing("can", None, None, on="tray"),))
    fallen = thing("apple", -1.2, 0.3, on="floor", z=-0.7)
    drawing = Drawing(scene=scene, after=Scene(objects=(fallen, thing("can", 0.2, 0.2))))
    assert drawing.middle(drawing.footprint("apple_1", "end")) == near(-1.2, 0.3)
    assert drawing.middle(drawing.footprint("can_1", "end")) == near(0.2, 0.2)
    assert "apple (floor)" in drawing.words("text")


# --- the path -------------------------------------------------------------------------------------


def test_each_way_over_the_table_is_a_line_high_or_low():
    commands = (
        move(0.5, 0.5, 1.2),
        move(0.5, -0.5, 0.1),
        move(-0.5, -0.5, 0.1),
        move(-0.5, 0, 0.6),
    )
    drawing = Drawing(commands, Scene(objects=(BOX,)))
    pairs(drawing.lines("high"), [((0.0, -1.2), (0.5, 0.5))])
    corners = [(0.5, 0.5), (0.5, -0.5), (-0.5, -0.5), (-0.5, 0.0)]
    pairs(drawing.lines("low"), list(itertools.pairwise(corners)))


def test_low_is_below_the_tallest_thing():
    commands = (move(0.5, 0.5, 1.0), move(-0.5, 0.5, 0.29), move(-0.5, -0.5, 0.3))
    drawing = Drawing(commands, Scene(objects=(BOX, thing("sky", 0, 0, on="floor", tall=2))))
    assert (len(drawing.lines("high")), len(drawing.lines("low"))) == (1, 2)
    assert "moves among them: z < 0.3 units" in drawing.words("text", within=drawing.beside)


def test_arrowheads_lie_on_the_way_and_point_along_it():
    drawing = Drawing((move(0.0, 0.8, 0.9), move(-1.0, 0.8, 0.9)))
    north, west = drawing.find("high", "head")
    x, y, angle = map(float, re.findall(r"-?[\d.]+", north.get("transform")))
    assert (x, angle) == pytest.approx((drawing.zero[0], -90), abs=0.01)
    assert -1.2 < (drawing.zero[1] - y) / drawing.scale < 0.8
    assert float(re.findall(r"-?[\d.]+", west.get("transform"))[2]) == near(180)


def test_what_goes_with_suction_on_is_thick():
    drawing = Drawing(PICK)
    pairs(drawing.lines("high", "on"), [((-0.6, 0.3), (0.4, 0.1))])
    (carried,) = [n for n in drawing.find("high", "on") if n.tag == f"{SVG}line"]
    assert carried.get("style").endswith("stroke-width:3.4")


def test_ways_straight_up_and_down_are_marks_with_their_height():
    drawing = Drawing(PICK)
    expected = [(-0.6, 0.3)] * 2 + [(0.4, 0.1)] * 2
    assert sorted(drawing.discs("vertical")) == [near(*place) for place in expected]
    assert {"↓0.14 ↑1.2", "↓0.14 ↑0.9"} <= set(drawing.words("text"))


def test_a_turn_on_the_spot_is_told():
    drawing = Drawing((move(0, 0, 0.9), move(0, 0, 0.9, r=math.pi / 2)))
    assert "r+90°" in drawing.words("text")


def test_the_start_the_grips_and_the_releases_are_marked():
    drawing = Drawing(PICK, start=Pose(0.1, -0.9, 0.7))
    assert drawing.discs("start") == [near(0.1, -0.9)]
    assert drawing.discs("grip") == [near(-0.6, 0.3)]
    assert drawing.discs("release") == [near(0.4, 0.1)]
    assert "start, z 0.7 units" in drawing.words("text")
    (grip,), (release,) = drawing.find("grip"), drawing.find("release")
    assert "fill:none" in grip.get("style") and "fill:none" not in release.get("style")


def test_the_first_point_of_each_program_line_bears_its_number():
    loop = (move(0.6, 0.6, 1, 2), move(-0.6, 0.6, 1, 3), move(0.6, -0.6, 1, 2), move(0.8, 0, 1, 5))
    drawing = Drawing(loop)
    chips = {node.text: drawing.units(node) for node in drawing.find("number")}
    assert set(chips) == {"2", "3", "5"}
    for line, point in (("2", (0.6, 0.6)), ("3", (-0.6, 0.6)), ("5", (0.8, 0.0))):
        assert math.dist(chips[line], point) < 0.2


def test_lines_that_lead_to_one_point_share_its_label():
    assert Drawing(PICK).words("number") == ["1 2 3 4", "5 6 7 8"]
