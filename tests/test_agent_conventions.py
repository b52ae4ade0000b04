"""Where things go, and how the arm goes, when a sentence leaves it open: one convention each."""

import math

import pytest

from agent.primitives import primitives
from robot_bridge.ideal import predict
from scene.types import Scene, SceneObject


def waiting(name, size):
    return SceneObject(id=name, name=name, width=size, height=size, tall=0.2, on="tray")


def standing(name, x, y, size=0.2, tall=0.2):
    return SceneObject(id=name, name=name, x=x, y=y, width=size, height=size, tall=tall)


TRAY = Scene(tray=(waiting("apple", 0.36), waiting("cup", 0.4), waiting("can", 0.26)))
TABLE = Scene(
    objects=(
        standing("apple", -0.6, 0.1),
        standing("cup", 0.3, 0.5),
        standing("can", 0.5, -0.5, tall=0.4),
    )
)  # fmt: skip


@pytest.fixture
def placed(run):
    """Where things of the tray go: name → (x, y)."""

    def placed(source):
        draft = run(source, TRAY, "arrange")
        return {place.object: pytest.approx((place.x, place.y)) for place in draft.placements}

    return placed


@pytest.fixture
def path(run):
    """The tool's way on the table: (x, y, z) a move."""

    def path(source, scene=TABLE):
        commands = run(source, scene).commands
        return [pytest.approx((c.x, c.y, c.z)) for c in commands if c.op == "move"]

    return path


# --- what waits in the tray ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("source", "places"),
    [
        ("put(apple, left_of(apple, cup))", {"cup": (0, 0), "apple": (-0.43, 0)}),
        ("put(can, between(apple, cup))", {"can": (0, 0), "apple": (-0.7, 0), "cup": (0.7, 0)}),
        (
            'put(apple, mid_edge(apple, "far"))\nput(cup, mid_edge(cup, "near"))\n'
            "put(can, between(apple, cup))",
            {"apple": (0, 0.77), "cup": (0, -0.75), "can": (0, 0.01)},
        ),
        (
            "put(apple, [0.6, 0])\nput(can, between(apple, cup))",
            {"cup": (-0.7, 0), "can": (-0.05, 0)},
        ),
        ("put(apple, next_to(apple, cup))", {"cup": (0, 0), "apple": (0.43, 0)}),
        ('put(cup, edge(cup, "right"))\nput(apple, next_to(apple, cup))', {"apple": (0.32, 0)}),
        ('put(cup, edge(cup, "right"))\nput(apple, touching(apple, cup))', {"apple": (0.36, 0)}),
        ("put(apple, level_with(apple, cup))", {"apple": (-0.5, 0), "cup": (0.5, 0)}),
        ("put(apple, in_column_with(apple, cup))", {"apple": (0, 0.5), "cup": (0, -0.5)}),
        ("put(cup, [0.2, 0.3])\nput(apple, level_with(apple, cup))", {"apple": (-0.5, 0.3)}),
        ("row([apple, cup])", {"apple": (-0.215, 0), "cup": (0.215, 0)}),
        (
            "spread_down([apple, can, cup])",
            {"apple": (0, 0.77), "cup": (0, -0.75), "can": (0, 0.02)},
        ),
    ],
)  # fmt: skip
def test_what_is_left_open_has_a_place_of_its_own(placed, source, places):
    found = placed(source)
    assert {name: found[name] for name in places} == places


def test_a_side_is_kept_as_far_as_the_table_lets_it(placed):
    """A low thing in a corner and a high one to its left: not quite level, but on the table."""
    found = placed('put(can, corner(can, "right", "near"))\nput(cup, left_of(cup, can))')
    assert found == {"can": (0.82, -0.82), "cup": (0.44, -0.8)}


def test_of_what_goes_by_another_the_last_one_is_in_the_middle(placed):
    found = placed("put(apple, left_of(apple, can))\nput(can, left_of(can, cup))")
    assert found["cup"] == (0, 0) and found["can"] == (-0.38, 0)


def test_what_is_put_between_two_moves_them_apart(placed):
    found = placed(
        "put(apple, [0, 0])\nput(cup, right_of(cup, apple))\nput(can, between(apple, cup))"
    )
    assert found["cup"].expected[0] > 0.36 / 2 + 0.26 + 0.4 / 2


# --- the arm's way -------------------------------------------------------------------------------


def test_tapped_twice_it_stays_above_the_thing(path):
    above, on = (-0.6, 0.1, 1.2), (-0.6, 0.1, 0.2)
    assert path("for n in range(2):\n    touch(apple)") == [above, on, above, on, above]


def test_pointed_at_it_goes_up_again_and_hovering_it_stays(path):
    above, near = (-0.6, 0.1, 1.2), (-0.6, 0.1, 0.3)
    assert path("point_at(apple)") == [above, near, above]
    assert path("hover(apple)") == [above, near]


def test_over_a_place_it_is_higher_than_anything_on_the_table(path):
    assert path("hover([0.1, 0.2])") == [(0.1, 0.2, 1.2), (0.1, 0.2, 0.5)]


@pytest.mark.parametrize(("scene", "height"), [(TABLE, 0.04), (TABLE.replace(
    standing("apple", 0.3, 0.15)), 0.5)])  # fmt: skip
def test_round_a_thing_it_goes_low_where_nothing_is_in_the_way(path, scene, height):
    way = path("go_around(cup, 2)", scene)
    radius = math.hypot(0.2, 0.2) / 2 + 0.08
    assert len(way) == 1 + 49 + 1
    turns = [n * math.tau / 24 for n in range(49)]
    assert way[1:-1] == [
        (0.3 + radius * math.cos(turn), 0.5 + radius * math.sin(turn), height) for turn in turns
    ]


@pytest.mark.parametrize("size", [0.2, 0.6])
def test_what_falls_off_the_table_is_pushed_to_the_edge_at_least(path, size):
    way = path("push(cup, [1.2, cup.y])", Scene(objects=(standing("cup", 0.2, 0.1, size),)))
    assert way[-1].expected[0] == pytest.approx(1.2 - min(size / 2 + 0.04, 0.2))


def test_what_changes_places_waits_in_a_corner_away_from_both(path):
    assert (0.7, -0.7, 0.2) in path("swap(apple, cup)", Scene(objects=TABLE.objects[:2]))
    assert (0.7, -0.7, 0.2) not in path("swap(apple, cup)")  # something stands there


def test_in_a_row_the_first_one_stays(run):
    draft = run("row([apple, cup, can])", TABLE)
    after = predict(primitives(draft, TABLE), TABLE)
    assert [after.get(one).position for one in ("apple", "cup", "can")] == [
        pytest.approx(place) for place in ((-0.6, 0.1), (-0.35, 0.1), (-0.1, 0.1))
    ]


def test_a_row_that_has_no_room_beside_the_first_one_goes_elsewhere(run):
    draft = run("row([can, cup, apple])", TABLE)
    after = predict(primitives(draft, TABLE), TABLE)
    xs = [after.get(one).x for one in ("can", "cup", "apple")]
    assert xs == sorted(xs) and max(xs) < 0.9
