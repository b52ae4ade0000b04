"""What the picture of a plan shows, read back from the SVG: things, ways, marks, numbers."""

import itertools
import math
import re
from xml.etree import ElementTree

import pytest

from agent.compose import table
from agent.messages import Command, KeepOut
from agent.picture import svg
from robot_bridge.api import PARK, Limits, approve
from robot_bridge.ideal import predict
from scene.tray import tray_positions
from scene.types import Pose, Scene, SceneObject

SVG = "{http://www.w3.org/2000/svg}"


class Space:
    """A workspace without an arm."""

    def __init__(self, **limits):
        self.limits = Limits(**limits)

    def reach(self, pose):
        return None


def move(x, y, z, line=0, grip=False, r=0.0):
    return Command("move", x, y, z, r, grip, line)


def suck(on, line=0):
    return Command("grip", 0.0, 0.0, 0.0, 0.0, on, line)


def thing(name, x, y, **more):
    sizes = {"id": f"{name}_1", "width": 0.2, "height": 0.1, "tall": 0.1}
    return SceneObject(name=name, x=x, y=y, **{**sizes, **more})


APPLE = thing("apple", -0.6, 0.3, width=0.14, height=0.14, tall=0.14, color="red")
BOX = thing("box", 0.5, -0.5, r=0.5, tall=0.3)
PICK = (
    move(-0.6, 0.3, 1.2, 1), move(-0.6, 0.3, 0.14, 2), suck(True, 3), move(-0.6, 0.3, 1.2, 4, True),
    move(0.4, 0.1, 1.2, 5, True), move(0.4, 0.1, 0.14, 6, True), suck(False, 7),
    move(0.4, 0.1, 0.9, 8),
)  # fmt: skip


class Drawing:
    """An SVG read back: its elements by class, and pixels as table units."""

    def __init__(self, commands=(), scene=None, after=None, program="", start=PARK, **limits):
        space = Space(**{"length": 1e6, **limits})
        plan = approve(commands, start, space, program, scene)
        self.plan, self.text = plan, svg(plan, space.limits, after)
        self.root = ElementTree.fromstring(self.text)
        self.above, self.side, self.beside = (
            next(node for node in self.root if node.get("class") == name)
            for name in ("above", "side", "beside")
        )
        (board,) = self.find("table")
        self.scale = float(board.get("width")) / 2
        self.zero = float(board.get("x")) + self.scale, float(board.get("y")) + self.scale

    def find(self, *names, within=None):
        nodes = (self.above if within is None else within).iter()
        return [node for node in nodes if set(names) <= set(node.get("class", "").split())]

    def words(self, *names, within=None):
        return [node.text for node in self.find(*names, within=within) if node.tag == f"{SVG}text"]

    def units(self, node, x="x", y="y"):
        """A point of the view from above in table units."""
        across = (float(node.get(x)) - self.zero[0]) / self.scale
        return across, (self.zero[1] - float(node.get(y))) / self.scale

    def discs(self, name):
        return [self.units(node, "cx", "cy") for node in self.find(name)]

    def lines(self, *names):
        found = [node for node in self.find(*names) if node.tag == f"{SVG}line"]
        return [(self.units(node, "x1", "y1"), self.units(node, "x2", "y2")) for node in found]

    def footprint(self, name, kind="thing"):
        (node,) = [item for item in self.find(kind) if item.get("data-id") == name]
        return node

    def middle(self, node):
        x, y = self.units(node)
        width, height = (float(node.get(key)) / self.scale for key in ("width", "height"))
        return x + width / 2, y - height / 2

    def height(self, pixel):
        """A height in the side view, read between the two limits."""
        top, bottom = sorted(float(n.get("y1")) for n in self.find("limit", within=self.side))
        return 1.5 * (bottom - pixel) / (bottom - top)

    def path(self, pixel):
        """A length of path in the side view, read between two ticks of its axis."""
        texts = self.find("text", within=self.side)
        ticks = [node for node in texts if node.get("text-anchor") == "middle"]
        one, other = ticks[0], ticks[-1]
        share = (pixel - float(one.get("x"))) / (float(other.get("x")) - float(one.get("x")))
        return float(one.text) + share * (float(other.text) - float(one.text))


def near(*expected):
    return pytest.approx(expected if len(expected) > 1 else expected[0], abs=2e-3)


def pairs(found, expected):
    assert len(found) == len(expected)
    for (one, other), (start, goal) in zip(found, expected, strict=True):
        assert one == near(*start) and other == near(*goal)


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


# --- limits, keep-outs, axes, totals --------------------------------------------------------------


def test_limits_table_and_tray_are_drawn():
    drawing = Drawing(x=(-1.5, 1.6), y=(-1.4, 1.7))
    (limit,) = drawing.find("limit")
    assert drawing.units(limit) == near(-1.5, 1.7)
    assert float(limit.get("width")) / drawing.scale == near(3.1)
    assert float(limit.get("height")) / drawing.scale == near(3.1)
    assert "limits: x -1.5 to 1.6, y -1.4 to 1.7 units" in drawing.words(
        "text", within=drawing.beside
    )
    (board,) = drawing.find("table")
    assert board.get("width") == board.get("height")
    (tray,) = (node for node in drawing.find("tray") if node.tag == f"{SVG}rect")
    assert drawing.units(tray)[0] > 1.0


def test_keep_outs_are_hatched_and_named():
    zone = KeepOut("camera mast", (0.5, 0.9), (0.6, 1.2), (0.0, 1.5))
    drawing = Drawing(keep_outs=(zone,))
    (node,) = drawing.find("keep-out")
    assert drawing.middle(node) == near(0.7, 0.9)
    assert float(node.get("width")) / drawing.scale == near(0.4)
    assert "fill:url(#hatch)" in node.get("style")
    assert drawing.root.find(f"{SVG}defs/{SVG}pattern").get("id") == "hatch"
    assert "camera mast: z 0 to 1.5 units" in drawing.words("text")


def test_the_axes_have_ticks_in_units_and_millimetres():
    drawing = Drawing(scene=Scene(table_m=0.6))
    assert {"-1.5", "-1", "0", "0.5", "1"} <= set(drawing.words("text"))
    assert {"-300 mm", "0 mm", "150 mm"} <= set(drawing.words("faint"))
    assert {"x → (units)", "y ↑ (units)", "▲ you"} <= set(drawing.words("text"))
    (tick,) = [n for n in drawing.find("text") if n.text == "1" and n.get("text-anchor") == "end"]
    assert drawing.units(tick)[1] == pytest.approx(1.0, abs=0.02)


def test_the_caption_counts_motions_way_and_time():
    drawing = Drawing(PICK, Scene(table_m=0.5))
    (caption,) = drawing.words("caption", within=drawing.root)
    poses = [(0, -1.2, 0.9), *((told.x, told.y, told.z) for told in drawing.plan.told)]
    way = sum(itertools.starmap(math.dist, itertools.pairwise(poses)))
    assert caption == (
        f"8 motions · path {way:.2f} units = {way * 250:.0f} mm · "
        f"{sum(drawing.plan.durations):.1f} s · 1 unit = 250 mm"
    )
    assert drawing.root.find(f"{SVG}title").text.endswith(caption)


def test_without_a_scene_the_scale_is_said_to_be_assumed():
    drawing = Drawing((move(0, 0, 1),))
    (caption,) = drawing.words("caption", within=drawing.root)
    assert caption.startswith("1 motion ·") and caption.endswith("1 unit = 200 mm (assumed)")
    assert not drawing.find("thing")


# --- from the side --------------------------------------------------------------------------------


def test_the_side_view_shows_the_height_over_the_path():
    drawing = Drawing(PICK)
    ways = [
        node for name in ("high", "vertical") for node in drawing.find(name, within=drawing.side)
    ]
    ways.sort(key=lambda node: float(node.get("x1")))
    heights = [(0.9, 1.2), (1.2, 0.14), (0.14, 1.2), (1.2, 1.2), (1.2, 0.14), (0.14, 0.9)]
    assert [tuple(drawing.height(float(n.get(y))) for y in ("y1", "y2")) for n in ways] == [
        pytest.approx(pair, abs=0.01) for pair in heights
    ]
    lengths = [drawing.path(float(n.get("x2"))) - drawing.path(float(n.get("x1"))) for n in ways]
    first, across = math.dist((0, -1.2, 0.9), (-0.6, 0.3, 1.2)), math.hypot(1.0, 0.2)
    assert lengths == pytest.approx([first, 1.06, 1.06, across, 1.06, 0.76], abs=0.01)


def test_the_side_view_marks_start_grips_releases_and_program_lines():
    drawing = Drawing(PICK)
    for name, height in (("start", 0.9), ("grip", 0.14), ("release", 0.14)):
        (node,) = drawing.find(name, within=drawing.side)
        assert drawing.height(float(node.get("cy"))) == pytest.approx(height, abs=0.01)
    numbers = " ".join(drawing.words("number", within=drawing.side)).split()
    assert sorted(numbers) == list("12345678")
    assert {"↓0.14", "↑1.2", "↑0.9"} <= set(drawing.words("text", within=drawing.side))


def test_the_side_view_has_the_table_at_zero_and_the_limit():
    drawing = Drawing(PICK)
    (board,) = drawing.find("table", within=drawing.side)
    assert drawing.height(float(board.get("y"))) == pytest.approx(0, abs=1e-6)
    assert "limit z 1.5 units" in drawing.words("text", within=drawing.side)
    assert "100 mm" in drawing.words("faint", within=drawing.side)


# --- data is data ---------------------------------------------------------------------------------

HOSTILE = [
    "<script>alert(1)</script>",
    "\"'><rect/>&amp;",
    "]]>\x00\x1b[31m\r\nred\u202e\ufffe",
    "&#60;!--",
    "long " * 500,
]


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_and_programs_are_harmless(name):
    scene = Scene(objects=(thing(name, 0, 0, id=name, color=name), thing("box", 0.5, 0.5)))
    zone = KeepOut(name, (1.1, 1.2), (0, 1), (0, 1))
    drawing = Drawing(program=name, keep_outs=(zone,), scene=scene)
    tags = {node.tag.removeprefix(SVG) for node in drawing.root.iter()}
    shapes = {"rect", "line", "circle", "path", "text"}
    assert tags <= {"svg", "title", "defs", "clipPath", "pattern", "g"} | shapes
    texts = [text for node in drawing.root.iter() for text in (node.text, *node.attrib.values())]
    assert all(len(text or "") < 200 and (text or "").isprintable() for text in texts)
    drawing.text.encode("utf-8")


def test_a_name_is_shown_as_it_is_written():
    drawing = Drawing(scene=Scene(objects=(thing('a<b> & "c"', 0, 0),)))
    assert 'a<b> & "c"' in drawing.words("text")


def test_the_program_stands_beside_with_its_numbers_and_indents():
    drawing = Drawing(program="for i in range(3):\n    robot.grip(i < 2)")
    lines = drawing.words("program", within=drawing.beside)
    assert lines == ["for i in range(3):", "\xa0\xa0\xa0\xa0robot.grip(i < 2)"]
    assert drawing.words("faint", within=drawing.beside) == ["1", "2"]


def test_a_long_program_is_cut_and_says_so():
    drawing = Drawing(program="\n".join(f"x = {n}" for n in range(500)))
    assert len(drawing.words("program", within=drawing.beside)) == 30
    assert "and 470 more lines" in drawing.words("faint", within=drawing.beside)


def test_nothing_is_fetched_and_the_background_is_the_pictures_own():
    drawing = Drawing(PICK, table("kitchen"))
    assert "href" not in drawing.text and drawing.text.count("http") == 1
    paper = next(node for node in drawing.root if node.tag == f"{SVG}rect")
    assert drawing.root.get("viewBox") == f"0 0 {paper.get('width')} {paper.get('height')}"


# --- any size -------------------------------------------------------------------------------------


def boxes(drawing, group):
    found = drawing.find("back", within=group)
    return [tuple(float(n.get(k)) for k in ("x", "y", "width", "height")) for n in found]


def test_labels_do_not_overlap():
    crowd = tuple(
        thing(f"thing {n}", -0.8 + 0.23 * (n % 8), -0.8 + 0.4 * (n // 8), id=f"t{n}", width=0.1)
        for n in range(40)
    )
    drawing = Drawing(PICK, Scene(objects=crowd))
    assert all(f"thing {n}" in drawing.words("text") for n in range(40))
    for group in (drawing.above, drawing.side):
        for (x, y, w, h), (x2, y2, w2, h2) in itertools.combinations(boxes(drawing, group), 2):
            assert x + w <= x2 or x2 + w2 <= x or y + h <= y2 or y2 + h2 <= y


def test_labels_that_find_no_room_are_counted():
    zigzag = [
        move(0.3 * math.sin(n * 1.7), 0.3 * math.cos(n * 2.3), 0.5 + n % 7 / 10, n + 1)
        for n in range(500)
    ]
    drawing = Drawing(zigzag)
    assert len(drawing.lines("high")) + len(drawing.lines("low")) == 500
    shown = sum(len(text.split()) for text in drawing.words("number"))
    (left_out,) = [text for text in drawing.words("faint") if "no room" in text]
    assert shown < 500 <= shown + 2 * int(left_out.split()[0])


def test_nothing_to_draw_is_drawn():
    drawing = Drawing()
    assert not drawing.lines("high") and not drawing.find("number") and not drawing.find("thing")
    assert len(drawing.find("start", within=drawing.side)) == 1


def test_wide_limits_do_not_shrink_the_table_but_the_path_is_always_in_view():
    wide = {"x": (-50.0, 50.0), "y": (-50.0, 50.0), "z": (0.0, 50.0)}
    near_by, far_off = Drawing(**wide), Drawing((move(20, 20, 20),), **wide)
    assert near_by.scale > 150 > 40 > far_off.scale
    pairs(far_off.lines("high"), [((0.0, -1.2), (20, 20))])
    assert "limit z 50 units" in near_by.words("text", within=near_by.side)


def test_the_same_plan_gives_the_same_bytes_with_few_digits():
    scene = table("kitchen")
    first, second = (Drawing(PICK, scene, predict(PICK, scene)).text for _ in range(2))
    assert first == second
    assert not re.search(r"\d\.\d{3}", re.sub(r"<text.*?</text>", "", first))
