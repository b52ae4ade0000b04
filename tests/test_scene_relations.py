"""What spatial words mean: each relation just inside and just outside its bounds.

Numbers are table units on the 0.40 m table: 1 cm is 0.05, 6 cm are 0.30, 8 cm are 0.40.
"""

import math

import pytest

from scene import relations
from scene.types import Scene, SceneObject


def thing(name, x, y, width=0.1, height=0.1, **more):
    return SceneObject(id=name, name=name, x=x, y=y, width=width, height=height, tall=0.1, **more)


TABLE = Scene()
MIDDLE = thing("middle", 0.0, 0.0)


@pytest.mark.parametrize(
    ("x", "y", "direction"),
    [(-0.5, 0.0, "left"), (0.5, 0.1, "right"), (0.2, 0.5, "above"), (-0.3, -0.4, "below")],
)
def test_a_direction_holds_within_45_degrees_of_its_axis(x, y, direction):
    other = thing("other", x, y)
    held = [d for d in relations.ALONG if relations.beside(TABLE, other, MIDDLE, d)]
    assert held == [direction]


def test_on_the_diagonal_both_directions_hold():
    other = thing("other", -0.4, 0.4)
    held = {d for d in relations.ALONG if relations.beside(TABLE, other, MIDDLE, d)}
    assert held == {"left", "above"}


def test_a_thing_in_the_same_place_is_in_no_direction():
    assert not any(relations.beside(TABLE, MIDDLE, MIDDLE, d) for d in relations.ALONG)


@pytest.mark.parametrize(("gap", "near"), [(0.0, True), (0.30, True), (0.31, False)])
def test_next_to_is_a_gap_of_at_most_6_cm(gap, near):
    assert relations.next_to(TABLE, thing("other", 0.1 + gap, 0.0), MIDDLE) is near


def test_6_cm_are_measured_by_the_table():
    other = thing("other", 0.1 + 0.2, 0.0)
    assert relations.next_to(Scene(table_m=0.4), other, MIDDLE)
    assert not relations.next_to(Scene(table_m=0.8), other, MIDDLE)


def test_what_stands_on_a_thing_is_not_next_to_it():
    upper = thing("upper", 0.0, 0.0, z=0.1, on="middle")
    assert not relations.next_to(TABLE, upper, MIDDLE)
    assert not relations.next_to(TABLE, MIDDLE, upper)


def test_gaps_are_measured_between_edges():
    assert relations.gap(thing("other", 0.4, 0.0, width=0.3), MIDDLE) == pytest.approx(0.2)
    assert relations.gap(thing("other", 0.4, 0.5), MIDDLE) == pytest.approx(math.hypot(0.3, 0.4))
    assert relations.gap(thing("other", 0.02, 0.0), MIDDLE) == 0.0


def test_a_turned_thing_takes_up_its_turned_extent():
    bar = thing("bar", 0.0, 0.0, width=0.6, height=0.2, r=math.pi / 2)
    assert relations.extents(bar) == pytest.approx((0.1, 0.3))


@pytest.mark.parametrize(
    ("x", "y", "between"),
    [(0.0, 0.0, True), (0.25, 0.0, True), (0.3, 0.0, False), (0.0, 0.05, True), (0.0, 0.1, False)],
)
def test_between_is_well_between_and_on_the_line(x, y, between):
    first, second = thing("first", -0.5, 0.0), thing("second", 0.5, 0.0)
    assert relations.between(thing("one", x, y), first, second) is between


def test_nothing_is_between_two_things_in_one_place():
    assert not relations.between(thing("one", 0.0, 0.0), MIDDLE, MIDDLE)


@pytest.mark.parametrize(("x", "at"), [(-0.95, True), (-0.55, True), (-0.54, False)])
def test_at_an_edge_is_within_8_cm_of_it(x, at):
    assert relations.at_edge(TABLE, thing("one", x, 0.0), "left") is at


def test_a_corner_is_two_edges():
    far_left = thing("one", -0.8, 0.8)
    assert relations.in_corner(TABLE, far_left, "left", "above")
    assert not relations.in_corner(TABLE, far_left, "left", "below")
    assert not relations.in_corner(TABLE, thing("one", -0.8, 0.0), "left", "above")


def test_what_lies_on_the_floor_is_at_no_edge():
    assert not relations.at_edge(TABLE, thing("one", -1.1, 0.0, on="floor"), "left")


@pytest.mark.parametrize(("x", "centred"), [(0.0, True), (0.4, True), (0.41, False)])
def test_the_centre_is_within_8_cm_of_the_middle(x, centred):
    assert relations.centred(TABLE, thing("one", x, 0.0)) is centred


def test_off_the_table_knows_the_side():
    fell = thing("one", 0.2, 1.2, on="floor")
    assert relations.off_table(fell) and not relations.on_table(fell)
    assert [side for side in relations.ALONG if relations.off_side(fell, side)] == ["above"]


def test_rows_share_y_and_columns_share_x():
    row = [thing(str(i), i / 4, 0.02 * i) for i in range(3)]
    column = [thing(str(i), 0.02 * i, i / 4) for i in range(3)]
    assert relations.in_row(row) and not relations.in_column(row)
    assert relations.in_column(column) and not relations.in_row(column)


def test_moved_is_how_far_and_nothing_within_the_tolerance():
    assert relations.moved(MIDDLE, thing("middle", 0.3, 0.4)) == pytest.approx(0.5)
    assert relations.moved(MIDDLE, thing("middle", 0.005, 0.0)) == 0.0
    assert relations.moved(MIDDLE, thing("middle", 0.0, 0.0, z=0.3)) == pytest.approx(0.3)


def test_out_of_the_tray_is_moved():
    waiting = thing("one", None, None, on="tray")
    assert relations.moved(waiting, waiting) == 0.0
    assert relations.moved(waiting, thing("one", 0.0, 0.0)) == math.inf


def test_what_a_thing_stands_on_is_told_nearest_first_and_is_what_it_stands_upon():
    heap = Scene(objects=(
        thing("tray", 0.0, 0.0), thing("cup", 0.0, 0.0, on="tray"),
        thing("egg", 0.0, 0.0, on="cup"), thing("plate", 0.1, 0.0, on="tray"),
        thing("book", 0.5, 0.5),
    ))  # fmt: skip
    found = {item.id: relations.beneath(heap, item) for item in heap.objects}
    assert found == {
        "tray": (), "cup": ("tray",), "egg": ("cup", "tray"), "plate": ("tray",), "book": (),
    }  # fmt: skip
    for carrier in found:
        carried = {name for name, below in found.items() if carrier in below}
        assert relations.upon(heap, carrier) == carried


def test_two_things_that_are_said_to_stand_on_each_other_are_no_endless_heap():
    heap = Scene(objects=(thing("cup", 0.0, 0.0, on="egg"), thing("egg", 0.0, 0.0, on="cup")))
    assert relations.beneath(heap, heap.get("cup")) == ("egg", "cup")
