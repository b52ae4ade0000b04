"""Groups of the little language and the language around them; the prelude itself.

The prelude is run natively, too, as the Python that it also is.
"""

import ast
import math
from importlib.resources import files
from types import SimpleNamespace

import pytest
from prelude_world import BLOCKS, CHECK, thing

from agent.errors import NotAllowed, ProgramFailed
from agent.language.allowed import Checker
from agent.language.naming import Names
from agent.language.prelude import prelude
from scene.types import Scene, SceneObject


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


def test_swap_waits_where_the_other_will_not_come(after):
    box, can = thing("box_1", "box", -0.5, -0.3, 0.5), thing("can_1", "can", 0.5, 0.2, 0.33)
    sponge = thing("sponge_1", "sponge", -0.7, 0.7, 0.3)
    scene = after("swap(can, box)", Scene(objects=(box, can, sponge)))
    assert scene.get("can_1").position == pytest.approx((-0.5, -0.3))
    assert scene.get("box_1").position == pytest.approx((0.5, 0.2))
    assert (scene.get("can_1").on, scene.get("box_1").on) == ("table", "table")
