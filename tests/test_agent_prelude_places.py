"""Places with room: where the prelude puts one thing or many when the table is not empty."""

import itertools
import math

import pytest

from agent.errors import ProgramError
from agent.execute import Executor
from agent.primitives import primitives
from agent.programs import laid_out
from robot_bridge.ideal import predict
from scene.relations import at_edge, beside, centred, gap, in_corner, next_to
from scene.types import Scene, SceneObject


def thing(identity, x, y, size=0.2):
    name = identity.rsplit("_", 1)[0]
    return SceneObject(id=identity, name=name, x=x, y=y, width=size, height=size, tall=0.1)


LINED_UP = Scene(
    objects=(
        thing("block_1", -0.2, 0.3),
        thing("block_2", 0.2, 0.3),
        thing("block_3", 0.6, 0.3),
        thing("cup_1", -0.6, -0.4),
        thing("vase_1", -0.85, 0.3),
    )
)
"""Three blocks one behind the other on the way to the left edge, where the vase stands."""
BLOCKS = ("block_1", "block_2", "block_3")


@pytest.fixture(scope="module")
def executor():
    with Executor() as executor:
        yield executor


@pytest.fixture
def after(executor):
    """The scene once the program has run on the ideal table."""

    def after(source, scene=LINED_UP):
        (draft,) = executor.run(source, "manipulate", [scene])
        if isinstance(draft, ProgramError):
            raise draft
        return predict(primitives(draft, scene), scene)

    return after


def apart(scene, *ids):
    return all(gap(scene.get(a), scene.get(b)) > 0 for a, b in itertools.combinations(ids, 2))


# --- one thing ------------------------------------------------------------------------------------


def test_an_edge_that_is_taken_straight_ahead_is_taken_beside_it(after):
    scene = after('put(block_1, edge(block_1, "left"))')
    assert at_edge(scene, scene.get("block_1"), "left")
    assert apart(scene, "block_1", "vase_1")
    assert abs(scene.get("block_1").y - 0.3) < 0.35, "as near to straight as there is room"


def test_a_corner_that_is_taken_leaves_room_beside_it_in_the_corner(after):
    scene = LINED_UP.replace(thing("vase_1", -0.85, 0.85))
    scene = after('put(cup, corner(cup, "left", "far"))', scene)
    assert in_corner(scene, scene.get("cup_1"), "left", "above")
    assert apart(scene, "cup_1", "vase_1")


def test_a_side_that_is_half_taken_is_taken_askew(after):
    scene = LINED_UP.replace(thing("vase_1", -0.85, -0.28))
    scene = after("put(block_1, left_of(block_1, cup))", scene)
    assert beside(scene, scene.get("block_1"), scene.get("cup_1"), "left")
    assert apart(scene, "block_1", "cup_1", "vase_1")


def test_where_nothing_is_free_the_straight_place_is_kept(after):
    walls = tuple(thing(f"wall_{n}", -0.8 + 0.2 * n, 0.9, 0.19) for n in range(9))
    source = 'put(block_1, edge(block_1, "far"))\nrobot.move(0, 0, 1, 0)'
    scene = after(source, Scene(objects=(*LINED_UP.objects, *walls)))
    assert scene.get("block_1").x == pytest.approx(-0.2)


def test_up_to_is_contact_on_the_straight_way(after):
    scene = after("push(block_1, up_to(block_1, block_2))")
    assert gap(scene.get("block_1"), scene.get("block_2")) == pytest.approx(0.02)
    assert scene.get("block_1").y == pytest.approx(0.3)
    slanted = after("put(cup, up_to(cup, block_3))")
    assert 0 < gap(slanted.get("cup_1"), slanted.get("block_3")) < 0.04


# --- many -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("part", "lies"),
    [
        ("left", lambda scene, one: at_edge(scene, one, "left")),
        ("right", lambda scene, one: at_edge(scene, one, "right")),
        ("far", lambda scene, one: at_edge(scene, one, "above")),
        ("near", lambda scene, one: at_edge(scene, one, "below")),
        ("left half", lambda _, one: one.x + one.width / 2 < 0),
        ("right half", lambda _, one: one.x - one.width / 2 > 0),
        ("far half", lambda _, one: one.y - one.height / 2 > 0),
        ("near half", lambda _, one: one.y + one.height / 2 < 0),
        ("middle", centred),
        ("near right", lambda _, one: math.dist(one.position, (1, -1)) < 0.7),
    ],
)
def test_put_all_finds_room_for_each_in_a_part_of_the_table(after, part, lies):
    scene = after(f'put_all([block_1, block_2, block_3], "{part}")')
    assert all(lies(scene, scene.get(one)) for one in BLOCKS)
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")
    assert scene.get("cup_1") == LINED_UP.get("cup_1")


def test_put_all_by_stands_them_round_what_they_go_with(after):
    scene = after("put_all_by([block_1, block_2, block_3], cup)")
    assert all(next_to(scene, scene.get(one), scene.get("cup_1")) for one in BLOCKS)
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


@pytest.mark.parametrize(
    ("side", "way"), [("left", "left"), ("right", "right"), ("far", "above"), ("near", "below")]
)
def test_put_all_beside_keeps_to_the_side(after, side, way):
    middle = LINED_UP.replace(thing("cup_1", 0, -0.1))
    scene = after(f'put_all_beside([block_1, block_2], cup, "{side}")', middle)
    cup = scene.get("cup_1")
    assert all(beside(scene, scene.get(one), cup, way) for one in ("block_1", "block_2"))
    assert apart(scene, *BLOCKS, "cup_1")


def test_put_all_around_turns_the_ring_until_it_is_free(after):
    middle = LINED_UP.replace(thing("cup_1", 0, -0.1)).replace(thing("vase_1", 0.45, -0.1))
    scene = after("put_all_around([block_1, block_2, block_3], cup)", middle)
    cup = scene.get("cup_1")
    assert all(0.25 < math.dist(scene.get(one).position, cup.position) < 0.55 for one in BLOCKS)
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


def test_a_row_avoids_what_stands_and_its_own_members(after):
    scene = after("row([block_3, block_1, block_2])")
    placed = [scene.get(one) for one in ("block_3", "block_1", "block_2")]
    assert [one.x for one in placed] == sorted(one.x for one in placed)
    assert max(one.y for one in placed) - min(one.y for one in placed) < 1e-9
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


def test_first_takes_no_more_than_there_are(after):
    scene = after('put_all(first([block_1, block_2], 1), "near")\nput_all(first([cup], 5), "far")')
    assert at_edge(scene, scene.get("block_1"), "below")
    assert scene.get("block_2") == LINED_UP.get("block_2")
    assert at_edge(scene, scene.get("cup_1"), "above")


def test_an_outline_runs_along_the_sides_of_a_polygon(executor):
    source = "trace(outline([0.1, 0.2], 0.5, 4, 8), 0.3)"
    (draft,) = executor.run(source, "manipulate", [LINED_UP])
    spots = [(c.x - 0.1, c.y - 0.2) for c in draft.commands if c.z == 0.3]
    assert len(spots) == 8
    assert spots[0] == pytest.approx((0, 0.5)), "from its far corner"
    assert spots[2] == pytest.approx((-0.5, 0)), "anticlockwise"
    assert all(abs(x) + abs(y) == pytest.approx(0.5) for x, y in spots), "on a square's sides"


def test_what_waits_in_the_tray_is_laid_out_without_overlap(executor):
    scene = laid_out(LINED_UP, "arrange")
    source = 'put_all(group("block"), "left")\nput_all_beside(group("cup"), vase, "right")'
    (draft,) = executor.run(source, "arrange", [scene])
    places = {place.object: (place.x, place.y) for place in draft.placements}
    assert all(places[one][0] == pytest.approx(-0.85) for one in BLOCKS)
    along = sorted(places[one][1] for one in BLOCKS)
    assert min(b - a for a, b in itertools.pairwise(along)) >= 0.2
