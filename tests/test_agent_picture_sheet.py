"""What stands around the ways in the picture of a plan: limits, axes, totals, the view from the
side, the program; whatever the names, at any size."""

import itertools
import math
import re

import pytest
from picture_world import PICK, SVG, Drawing, move, near, pairs, thing

from agent.compose import table
from agent.messages import KeepOut
from robot_bridge.ideal import predict
from scene.types import Scene

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
