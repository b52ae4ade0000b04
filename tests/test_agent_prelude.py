"""Groups, places and skills of the little language: what each does, on the ideal table.

The prelude is written in the language; here it is held against what its own words promise, and
run natively as the Python that it also is.
"""

import ast
import math
from importlib.resources import files
from types import SimpleNamespace

import msgspec
import pytest

from agent.compose import table
from agent.errors import NotAllowed, ProgramFailed
from agent.language.allowed import Checker
from agent.language.naming import Names
from agent.language.prelude import prelude
from agent.primitives import primitives
from agent.programs import laid_out
from robot_bridge.ideal import predict
from scene.types import Scene, SceneObject

CHECK = table("check")


def thing(identity, name, x, y, size=0.1, color=None):
    return SceneObject(
        id=identity, name=name, x=x, y=y, width=size, height=size, tall=size, color=color
    )


BLOCKS = Scene(
    objects=(
        thing("b1", "block", 0.4, 0.1, 0.10, "red"),
        thing("b2", "block", -0.5, 0.5, 0.14, "blue"),
        thing("b3", "block", -0.1, -0.6, 0.12, "green"),
        thing("s1", "red star", 0.7, -0.7, 0.08, "red"),
    )
)


@pytest.fixture
def after(run):
    """The scene once the program has run on the ideal table."""

    def after(source, scene=CHECK):
        return predict(primitives(run(source, scene), scene), scene)

    return after


@pytest.fixture
def chosen(run):
    """The ids of the objects in a list, in order: each is hovered over."""

    def chosen(group, scene=BLOCKS):
        draft = run(f"for one in {group}:\n    robot.move(one.x, one.y, 1, 0)", scene)
        places = {(item.x, item.y): item.id for item in scene.objects}
        return [places[command.x, command.y] for command in draft.commands]

    return chosen


# --- groups and which of them --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("group", "ids"),
    [
        ("group()", ["b1", "b2", "b3", "s1"]),
        ('group("block")', ["b1", "b2", "b3"]),
        ('group("red")', ["b1", "s1"]),
        ('group("red block")', ["b1"]),
        ('group("Star")', ["s1"]),
        ('group("apple")', []),
        ('without(group(), group("red"))', ["b2", "b3"]),
        ('without(group("block"), [b2])', ["b1", "b3"]),
        ("from_left(group())", ["b2", "b3", "b1", "s1"]),
        ("[from_left(group())[1]]", ["b3"]),
        ("from_front(group())", ["s1", "b3", "b1", "b2"]),
        ("by_size(group())", ["s1", "b1", "b3", "b2"]),
        ("by_distance(group(), [0.7, -0.7])", ["s1", "b3", "b1", "b2"]),
        ("by_distance(group(), b2)", ["b2", "b1", "b3", "s1"]),
        ("[leftmost(group()), rightmost(group())]", ["b2", "s1"]),
        ("[largest(group()), smallest(group())]", ["b2", "s1"]),
        ("[nearest(without(group(), [b3]), b3), farthest(group(), b3)]", ["s1", "b2"]),
        ("ordered([b1, b2, b3], [3, 1, 2])", ["b2", "b3", "b1"]),
        ("[one for one in group() if one != b1 and one.x > 0]", ["s1"]),
    ],
)
def test_groups_and_which_of_them(chosen, group, ids):
    assert chosen(group) == ids


def test_equal_things_keep_the_order_of_the_scene(chosen):
    twins = Scene(objects=(thing("a", "cube", 0.2, 0.1), thing("b", "cube", 0.2, 0.4)))
    assert chosen("from_left(group())", twins) == ["a", "b"]
    assert chosen("by_size(group())", twins) == ["a", "b"]


def test_a_group_of_an_arrange_program_waits_in_the_tray(run):
    waiting = tuple(
        SceneObject(id=f"c{n}", name="cube", width=0.1 * n, height=0.1, tall=0.1, on="tray")
        for n in (2, 1, 3)
    )
    scene = Scene(objects=BLOCKS.objects, tray=waiting)
    source = (
        'row = by_size(group("cube"))\n'
        "for i in range(len(row) - 1):\n"
        "    one = row[i]\n"
        "    two = row[i + 1]\n"
        "    solver.addConstraint(one.x + (one.width + two.width) / 2 + 0.05 == two.x)\n"
        "    solver.addConstraint(one.y == two.y)"
    )
    places = {place.object: place.x for place in run(source, scene, "arrange").placements}
    assert places["c1"] < places["c2"] < places["c3"]


# --- places --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("place", "way"),
    [("left_of", (-1, 0)), ("right_of", (1, 0)), ("behind", (0, 1)), ("in_front_of", (0, -1))],
)
def test_a_thing_is_put_beside_another_with_a_gap(after, place, way):
    scene = after(f"put(apple, {place}(apple, cup))")
    apple, cup = scene.get("apple_1"), scene.get("cup_1")
    apart = (apple.width + cup.width) / 2 + 0.05
    assert apple.x - cup.x == pytest.approx(way[0] * apart)
    assert apple.y - cup.y == pytest.approx(way[1] * apart)


def test_between_two_things_is_the_middle(after):
    apple = after("put(apple, between(plate, cup))").get("apple_1")
    assert apple.position == pytest.approx((0.025, 0.0))


def test_a_free_place_is_free_and_near(after):
    for name in ("apple", "plate", "bottle"):
        scene = after(f"put({name}, free_place({name}))")
        moved = scene.get(f"{name}_1")
        for other in scene.objects:
            if other.id != moved.id:
                assert other == CHECK.get(other.id)
                across = abs(other.x - moved.x) - (other.width + moved.width) / 2
                along = abs(other.y - moved.y) - (other.height + moved.height) / 2
                assert max(across, along) >= 0.05 - 1e-9
        assert math.dist(moved.position, CHECK.get(moved.id).position) < 0.7


def test_what_is_taken_is_not_free_nor_is_the_edge(after):
    assert after("if is_free(apple, [0, 0]):\n    pick(apple)").get("apple_1").held
    for place in ("cup", "[0.99, 0]", "[2, 2]", "[0.05, -0.6]"):
        assert not after(f"if is_free(apple, {place}):\n    pick(apple)").get("apple_1").held


def test_corners_and_edges_leave_no_more_than_a_margin(after):
    for across, x in (("left", -1), ("right", 1)):
        for along, y in (("near", -1), ("far", 1)):
            apple = after(f'put(apple, corner(apple, "{across}", "{along}"))').get("apple_1")
            assert (apple.x, apple.y) == pytest.approx((0.88 * x, 0.88 * y))
    edge = after('put(apple, edge(apple, "near"))').get("apple_1")
    assert edge.position == pytest.approx((-0.6, -0.88))
    middle = after('put(apple, mid_edge(apple, "right"))').get("apple_1")
    assert middle.position == pytest.approx((0.88, 0))


def test_next_to_takes_a_side_that_is_free(after):
    crowd = CHECK.replace(msgspec.structs.replace(CHECK.get("banana_1"), x=0.85, y=0.5, r=1.57))
    apple = after("put(apple, next_to(apple, cup))", crowd).get("apple_1")
    assert apple.x == pytest.approx(0.6 - 0.15 - 0.05)
    plate = after("put(apple, next_to(apple, plate))").get("apple_1")
    assert plate.x == pytest.approx(-0.55 + 0.25 + 0.05), "towards the middle of the table"


def test_next_to_what_has_no_place_yet_is_to_its_right(run):
    scene = laid_out(CHECK, "arrange")
    found = run("put(cup, [0, 0])\nput(apple, next_to(apple, cup))", scene, "arrange").placements
    assert {p.object: p.x for p in found}["apple_1"] == pytest.approx(0.2)


# --- skills --------------------------------------------------------------------------------------


def test_pick_holds_it(after):
    assert after("pick(apple)").get("apple_1").held


def test_touch_and_hover_move_nothing_and_end_above(run):
    for source, height in (("touch(apple)", 1.2), ("hover(apple)", 0.24)):
        draft = run(source)
        assert predict(draft.commands, CHECK).objects == CHECK.objects
        last = draft.commands[-1]
        assert (last.x, last.y, last.z) == pytest.approx((-0.6, 0.5, height))


def test_put_says_where_the_thing_is_then(after):
    scene = after("moved = put(apple, [0, 0])\nput_on(banana, moved)")
    assert scene.get("banana_1").on == "apple_1"
    assert scene.get("apple_1").position == pytest.approx((0, 0))


def test_put_on_stacks_and_fills(after):
    stacked = after("put_on(apple, plate)").get("apple_1")
    assert stacked.on == "plate_1" and stacked.z == pytest.approx(0.04)
    filled = after("put_on(apple, box)").get("apple_1")
    assert filled.on == "box_1" and filled.z < 0.1


def test_put_all_on_spreads_them_over_what_carries(after):
    scene = after("put_all_on([apple, bottle], plate)")
    assert (scene.get("apple_1").on, scene.get("bottle_1").on) == ("plate_1", "plate_1")


@pytest.mark.parametrize(("layout", "axis"), [("row", "y"), ("column", "x")])
def test_a_row_is_free_straight_and_in_order(after, layout, axis):
    scene = after(f"{layout}([b3, b1, b2])", BLOCKS)
    row = [scene.get(name) for name in ("b3", "b1", "b2")]
    assert len({round(getattr(one, axis), 6) for one in row}) == 1
    along = [one.x for one in row] if layout == "row" else [-one.y for one in row]
    assert along == sorted(along) and scene.get("s1") == BLOCKS.get("s1")


def test_layouts_place_what_waits_in_the_tray(run):
    scene = laid_out(CHECK, "arrange")

    def places(source):
        return {p.object: (p.x, p.y) for p in run(source, scene, "arrange").placements}

    found = places('put(apple, corner(apple, "left", "near"))\nput(cup, right_of(cup, apple))')
    assert found["apple_1"] == pytest.approx((-0.88, -0.88))
    assert found["cup_1"] == pytest.approx((-0.68, -0.88))
    found = places("row([apple, cup, bottle])\nput(cup, [0, 0])")
    assert found["apple_1"][0] < found["cup_1"][0] == 0 < found["bottle_1"][0]
    found = places("column([apple, cup])\nput(cup, [0, 0])")
    assert found["apple_1"] == pytest.approx((0, 0.08 + 0.07 + 0.05)) or found["apple_1"][1] > 0
    found = places("spread([apple, banana, bottle])\nput(banana, edge(banana, 'far'))")
    gaps = (found["banana_1"][0] - 0.12 - found["apple_1"][0] - 0.07,
            found["bottle_1"][0] - 0.06 - found["banana_1"][0] - 0.12)  # fmt: skip
    assert gaps[0] == pytest.approx(gaps[1]) and {y for _, y in found.values()} == {0.9}


def test_stack_puts_each_onto_the_one_before(after):
    scene = after("stack([b2, b3, b1])", BLOCKS)
    assert (scene.get("b3").on, scene.get("b1").on) == ("b2", "b3")


def test_swap_changes_places(after):
    scene = after("swap(apple, cup)")
    for one, other in (("apple_1", "cup_1"), ("cup_1", "apple_1")):
        assert scene.get(one).position == pytest.approx(CHECK.get(other).position)


@pytest.mark.parametrize("angle", [-2.0, 0.5, 1.5])
def test_turn_turns_where_it_stands(after, angle):
    before, banana = CHECK.get("banana_1"), after(f"turn(banana, {angle})").get("banana_1")
    assert math.remainder(banana.r - angle, math.tau) == pytest.approx(0)
    assert banana.position == pytest.approx(before.position)


@pytest.mark.parametrize(
    ("angle", "goal"),
    [(math.pi / 2, (0.0, -0.3)), (math.pi / 2, (-0.3, 0.0)), (math.pi / 4, (0.3, 0.0)),
     (-1.2, (0.0, 0.3))],
)  # fmt: skip
def test_what_was_turned_is_pushed_by_the_side_that_it_has_then(after, angle, goal):
    ruler = SceneObject(id="ruler", name="ruler", x=0.0, y=0.0, width=0.6, height=0.1, tall=0.1)
    pushed = after(f"turn(ruler, {angle})\npush(ruler, {list(goal)})", Scene(objects=(ruler,)))
    assert math.dist(pushed.get("ruler").position, goal) < 0.03
    assert math.remainder(pushed.get("ruler").r - angle, math.pi) == pytest.approx(0, abs=0.01)


def test_what_was_turned_takes_the_room_that_it_has_then(after):
    ruler = SceneObject(id="ruler", name="ruler", x=-0.5, y=0.0, width=0.6, height=0.1, tall=0.1)
    scene = Scene(objects=(ruler, thing("b", "block", 0.5, 0.0, 0.2)))
    moved = after("turn(ruler, math.pi / 2)\nput(ruler, left_of(ruler, block))", scene)
    assert moved.get("ruler").x == pytest.approx(0.5 - 0.1 - 0.05 - 0.05, abs=0.02)


@pytest.mark.parametrize("way", range(8))
def test_push_slides_it_to_the_place(after, way):
    goal = 0.3 * math.cos(way * math.tau / 8), 0.3 * math.sin(way * math.tau / 8)
    block = Scene(objects=(thing("b", "block", 0.0, 0.0, 0.12),))
    pushed = after(f"push(block, [{goal[0]}, {goal[1]}])", block).get("b")
    assert math.dist(pushed.position, goal) < 0.03
    assert pushed.upright and pushed.on == "table"


def full_box(*more):
    """A box with an apple in it that looks out of it; what else stands there."""
    box = SceneObject(id="box", name="box", x=0.0, y=0.0, width=0.4, height=0.4, tall=0.2)
    apple = SceneObject(id="apple", name="apple", x=0.0, y=0.0, z=0.03, width=0.18, height=0.18,
                        tall=0.2, on="box")  # fmt: skip
    return Scene(objects=(box, apple, *more))


def test_what_is_full_is_slid_and_what_is_in_it_goes_along(after):
    scene = after("put(box, [0.5, 0])\ntouch(upon(box)[0])", full_box())
    assert scene.get("box").position == pytest.approx((0.5, 0), abs=0.02)
    assert scene.get("apple").on == "box"
    assert scene.get("apple").position == pytest.approx((0.5, 0), abs=0.02)


def test_what_is_full_is_not_slid_through_what_stands_in_its_way(after):
    scene = after("put(box, [0.6, 0])", full_box(thing("cup", "cup", 0.35, 0.0, 0.12)))
    assert scene.get("cup").position == (0.35, 0.0)


def test_what_stands_on_a_thing_is_known_as_it_comes_and_goes(run):
    assert run("put_on(apple, plate)\nhover(upon(plate)[0])").commands
    with pytest.raises(ProgramFailed):
        run("hover(upon(plate)[0])")


def test_push_beyond_the_edge_is_off_the_table(after):
    assert after("push(apple, [-1.2, apple.y])").get("apple_1").on == "floor"


def test_push_to_where_it_is_does_nothing(run):
    assert run("push(apple, apple)").commands == ()


@pytest.mark.parametrize("angle", [0.0, 2.0, -1.5])
def test_topple_lays_it_down_that_way(after, angle):
    bottle = after(f"topple(bottle, {angle})").get("bottle_1")
    assert not bottle.upright


def test_trace_goes_through_the_places_and_up(run):
    draft = run("trace(circle(0, 0, 0.3), 0.5)")
    assert len(draft.commands) == 27 and draft.commands[-1].z == 1.2
    for command in draft.commands:
        assert math.hypot(command.x, command.y) == pytest.approx(0.3)


# --- the language around them --------------------------------------------------------------------


def test_primitives_carry_the_line_of_the_call(run):
    draft = run("x = 0\nput(apple, [x, x])\npick(apple)")
    assert [command.line for command in draft.commands] == [2] * 8 + [3] * 4


def test_a_function_has_variables_of_its_own(run):
    draft = run("length = 7\nx = 9\npush(apple, [0, 0])\nrobot.move(length / 10, x / 10, 1, 0)")
    assert (draft.commands[-1].x, draft.commands[-1].y) == (0.7, 0.9)
    with pytest.raises(ProgramFailed, match="dx has no value"):
        run("push(apple, [0, 0])\nif False:\n    dx = 1\nrobot.move(dx, 0, 1, 0)")


def test_a_variable_may_bear_the_name_of_a_function(run):
    draft = run("distance = distance(apple, cup)\nrobot.move(distance / 2, 0, 1, 0)")
    assert draft.commands[0].x == pytest.approx(0.6)


def test_an_object_may_bear_the_name_of_a_function(run):
    scene = Scene(objects=(thing("p", "pick", 0.3, 0.0), thing("g", "group", -0.3, 0.0)))
    assert run("pick(pick)\nput(group, between(pick, group))", scene).commands[0].x == 0.3


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("pick(3)", "pick: .x belongs to an object, not to a number"),
        ("pick([apple])", "belongs to an object, not to a list"),
        ("leftmost([])", "leftmost: the list is empty"),
        ("put(apple, [1])", "a list \\[x, y\\]"),
        ("put(apple, 1)", "a place needs a list"),
        ("group(1)", "group needs words"),
        ("at(apple, cup, 0, 0)", "at needs a number, not an object"),
        ("from_left([apple, 1])", "belongs to an object"),
        ("x = sorted([apple, cup])", "not an object"),
        ("x = [apple, 1]\ny = x[0] + 1", "not an object"),
        ("trace([], 1)", "the list is empty"),
        ("if melon is None:\n    pick(melon)", "not to None"),
    ],
)
def test_what_does_not_fit_is_said_in_the_callers_line(run, source, words):
    with pytest.raises(ProgramFailed, match=words) as failure:
        run(source)
    assert failure.value.line == source.count("\n") + 1


def test_skills_belong_to_manipulate_programs(run):
    with pytest.raises(NotAllowed, match="in manipulate programs only"):
        run("pick(apple)", CHECK, "arrange")


# --- the prelude itself --------------------------------------------------------------------------


@pytest.mark.parametrize("function", prelude(), ids=lambda one: f"{one.name}-{one.kind}")
def test_each_function_passes_the_allow_list_and_says_what_it_does(function):
    nodes = [node for part in function.body for node in ast.walk(part)]
    stored = {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    scope = Names(frozenset(), frozenset(), frozenset({*function.parameters, *stored}))
    for kind in ("manipulate", "arrange"):
        if function.kind in (None, kind):
            Checker(kind, scope).block(function.body)
    assert function.text[0].isupper() and function.text.endswith(".")


def test_no_function_can_recur():
    """Each calls only those above it in the file."""
    above: set[str] = set()
    for function in prelude():
        nodes = [node for part in function.body for node in ast.walk(part)]
        called = {
            node.func.id
            for node in nodes
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        }
        assert called & {one.name for one in prelude()} <= above
        above.add(function.name)


def test_one_name_has_one_meaning_in_either_kind():
    names = [(one.name, one.kind) for one in prelude()]
    assert len(set(names)) == len(names)
    both = {one.name for one in prelude() if one.kind is None}
    assert not both & {one.name for one in prelude() if one.kind is not None}


def test_natively_the_prelude_moves_the_robot_alike(run):
    """The prelude is Python too: the same text, executed natively, gives the same motions."""
    for source in (
        "put(apple, left_of(apple, cup))", "push(cup, [0.1, -0.2])", "turn(banana, 1)",
        "swap(apple, box)", "topple(bottle, 1)", "stack([plate, apple])",
        "trace(circle(0.1, 0.2, 0.3), 0.2)", "for one in from_left(group()):\n    touch(one)",
        "pick(nearest(without(group(), [plate]), plate))",
    ):  # fmt: skip
        ours = [(c.op, c.x, c.y, c.z, c.r, c.grip) for c in run(source).commands]
        assert native(source) == ours


def native(source):
    told = []

    def move(x, y, z, r):
        told.append(("move", x, y, z, r, told[-1][5] if told else False))

    def grip(on):
        told.append(("grip", *told[-1][1:5], on))

    class Thing(SimpleNamespace):
        def __eq__(self, other):
            return isinstance(other, Thing) and self.id == other.id

    def at(thing, x, y, z):
        return Thing(**{**vars(thing), "x": x, "y": y, "z": z})

    def placed(thing, x, y, z):
        now[thing.id] = at(thing, x, y, z)
        return now[thing.id]

    def turned(thing, angle):
        now[thing.id] = Thing(**{**vars(now[thing.id]), "r": now[thing.id].r + angle})
        return now[thing.id]

    things = {i.name: Thing(id=i.id, x=i.x, y=i.y, z=i.z, width=i.width, height=i.height,
                            tall=i.tall, r=i.r) for i in CHECK.objects}  # fmt: skip
    now = {thing.id: thing for thing in things.values()}
    scope = {
        "math": math, "robot": SimpleNamespace(move=move, grip=grip), **things,
        "group": lambda words="": [t for n, t in things.items() if words in n],
        "known": lambda p: True,
        "where": lambda p: [p.x, p.y] if isinstance(p, SimpleNamespace) else p,
        "at": at, "placed": placed, "turned": turned, "present": lambda: list(now.values()),
        "by_now": lambda t: now[t.id], "choices": lambda p: [scope["where"](p)],
        "either": lambda places: scope["where"](places[0]),
        "open_box": lambda thing: thing.id.startswith("box"), "about": lambda n: n,
        "no_less": lambda n: n, "wish": lambda n, wanted: n, "so_far": lambda p: scope["where"](p),
        "tool_at": lambda x, y, z: bool(told) and told[-1][1:5] == (x, y, z, 0),
    }  # fmt: skip
    text = (files("agent.language") / "prelude.txt").read_text()
    exec(text.partition("# --- layouts")[0], scope)
    exec(source, scope)
    return told


CRATE = SceneObject(id="c", name="crate", x=0.4, y=0.1, width=0.6, height=0.5, tall=0.3)
APPLE = SceneObject(id="a", name="apple", x=-0.5, y=0.0, width=0.36, height=0.36, tall=0.36)


@pytest.mark.parametrize(
    ("crate", "apple", "base"),
    [
        ({}, {}, 0.12),  # its top is above the rim, and it goes in by three fifths at most
        ({}, {"tall": 0.1, "width": 0.1, "height": 0.1}, 0.22),  # its top is 0.02 above it
        ({}, {"width": 0.45}, 0.12),
        ({}, {"width": 0.51}, 0.3),  # too wide to be let down between the walls
        ({}, {"height": 0.41}, 0.3),
        ({"r": 0.5}, {}, 0.3),  # turned beside it, it takes more room
        ({"r": 0.5}, {"r": 0.5}, 0.12),
        ({"name": "bowl"}, {}, 0.3),  # round: its walls are nearer at the corners
        ({"name": "brick"}, {}, 0.3),
        ({"upright": False}, {}, 0.3),
    ],
)
def test_into_an_open_box_it_is_let_down_between_the_walls_where_there_is_room(
    executor, crate, apple, base
):
    holder = msgspec.structs.replace(CRATE, **crate)
    scene = Scene(objects=(holder, msgspec.structs.replace(APPLE, **apple)))
    (draft,) = executor.run(f"put_on(apple, {holder.name})", "manipulate", [scene])
    let_go = [one for one in draft.commands if one.op == "grip"][-1]
    assert let_go.z - scene.get("a").tall == pytest.approx(base)
    over = [one.z for one in draft.commands if (one.x, one.y) == (let_go.x, let_go.y)]
    assert over[0] - scene.get("a").tall > holder.top
    assert predict(primitives(draft, scene), scene).get("a").on == "c"


def test_beside_what_lies_in_a_box_already_it_is_let_go_over_the_rim(executor):
    egg = SceneObject(id="e", name="egg", x=0.4, y=0.1, z=0.03, width=0.2, height=0.2, tall=0.2,
                      on="c")  # fmt: skip
    scene = Scene(objects=(CRATE, APPLE, egg))
    (draft,) = executor.run("put_on(apple, crate)", "manipulate", [scene])
    let_go = [one for one in draft.commands if one.op == "grip"][-1]
    assert let_go.z == pytest.approx(CRATE.top + APPLE.tall)


def test_swap_waits_where_the_other_will_not_come(after):
    box, can = thing("box_1", "box", -0.5, -0.3, 0.5), thing("can_1", "can", 0.5, 0.2, 0.33)
    sponge = thing("sponge_1", "sponge", -0.7, 0.7, 0.3)
    scene = after("swap(can, box)", Scene(objects=(box, can, sponge)))
    assert scene.get("can_1").position == pytest.approx((-0.5, -0.3))
    assert scene.get("box_1").position == pytest.approx((0.5, 0.2))
    assert (scene.get("can_1").on, scene.get("box_1").on) == ("table", "table")
