"""What a turn does when the arm does not: it looks, tries again within a budget, and says so."""

import math
from itertools import pairwise

import msgspec
import pytest

from agent.arm import LocalArm
from agent.attempt import UNSEEN
from agent.check import check_commands
from agent.compose import table
from agent.errors import Cancelled
from agent.forecast import Forecast
from agent.messages import Command, Decision, Dialog
from agent.recover import Look, carries, mendings
from agent.turn import Parts, Watch, run_program, run_turn
from robot_bridge.ideal import IdealRobot, predict
from robot_bridge.mishaps import Mishaps
from scene.types import Scene, SceneObject

PUT = "put_on(apple, plate)"
NAMED = ("apple_1", "plate_1")


class Unlucky(Mishaps):
    """The first so many grips do not seal; it slips on the carrying motions of these numbers."""

    def __init__(self, unsealed=0, slips=()):
        super().__init__()
        self.left, self.slippery, self.motions = unsealed, slips, 0

    def seals(self):
        self.left -= 1
        return self.left < 0

    def slips(self):
        self.motions += 1
        return 0.5 if self.motions in self.slippery else None


def attempted(executor, program, mishaps, scene=None, retries=2, touched=None, eye=LocalArm):
    """The turn, the scene after it, and the plans that ran."""
    robot = IdealRobot(scene or table("kitchen"), mishaps=mishaps)
    plans = []
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))

    def decide(request):
        return Decision(
            "act", "w", Dialog(), program=program, kind="manipulate", touched=touched
        )  # fmt: skip

    parts = Parts(decide, executor, predict, eye(robot), retries)
    turn, _ = run_turn("…", Dialog(), parts, watch=watch)
    return turn, robot.scene(), plans


def test_a_grip_that_did_not_seal_is_tried_again_elsewhere_and_said(executor):
    turn, scene, plans = attempted(executor, PUT, Unlucky(unsealed=1), touched=NAMED)
    assert (turn.status, turn.reply) == ("done", "It took me 2 tries. The apple is on the plate.")
    assert scene.get("apple_1").on == "plate_1"
    first, second = (next(c for c in plan.told if c.op == "grip" and c.grip) for plan in plans)
    assert (first.x, first.y) != (second.x, second.y)


def test_it_ends_where_the_first_plan_meant_it_whatever_the_grip(executor):
    _, lucky, _ = attempted(executor, PUT, Unlucky())
    _, scene, _ = attempted(executor, PUT, Unlucky(unsealed=2))
    assert scene.get("apple_1").position == pytest.approx(lucky.get("apple_1").position)


def test_after_the_budget_it_says_that_it_failed_and_what_is_seen(executor):
    turn, scene, plans = attempted(executor, PUT, Unlucky(unsealed=3), touched=NAMED)
    assert (turn.status, len(plans)) == ("failed", 3)
    assert turn.reply.startswith("I could not keep hold of the apple in 3 tries. The apple is")
    assert turn.reply.endswith("I meant it to be on the plate. Shall I try again?")
    assert scene == table("kitchen")


def test_without_a_budget_there_is_one_try(executor):
    turn, _, plans = attempted(executor, PUT, Unlucky(unsealed=1), retries=0)
    assert (turn.status, len(plans)) == ("failed", 1)


def test_an_empty_gripper_carries_nothing_and_withdraws_straight_up(executor):
    turn, _, plans = attempted(executor, PUT, Unlucky(unsealed=3), retries=0)
    grip = next(i for i, c in enumerate(plans[0].told) if c.op == "grip" and c.grip)
    gripped, *away = turn.trajectory[grip:]
    assert [(point.x, point.y, point.grip) for point in away] == [(gripped.x, gripped.y, False)] * 2
    assert away[-1].z >= 1.2


def test_what_is_turned_with_a_grip_aside_turns_where_it_stands(executor):
    scene = Scene(objects=(
        SceneObject(id="b", name="brick", x=0.2, y=0.1, width=0.4, height=0.2, tall=0.1),
    ))  # fmt: skip
    turn, after, _ = attempted(executor, "turn(brick, 2.0)", Unlucky(unsealed=1), scene)
    assert turn.status == "done"
    assert after.get("b").position == pytest.approx((0.2, 0.1), abs=1e-6)
    assert math.remainder(after.get("b").r - 2.0, math.pi) == pytest.approx(0, abs=1e-6)


class Untwisted(LocalArm):
    """An eye that never sees how a thing is turned."""

    def scene(self):
        return Scene(
            objects=tuple(msgspec.structs.replace(one, r=0.0) for one in super().scene().objects)
        )


@pytest.mark.parametrize("slips", [(3,), ()])
def test_what_was_lost_on_its_way_down_was_turned_before_and_is_not_turned_again(executor, slips):
    """By how much the tool turned a thing is better known than what the eye makes of it."""
    scene = Scene(objects=(
        SceneObject(id="b", name="brick", x=0.2, y=0.1, width=0.4, height=0.2, tall=0.1),
    ))  # fmt: skip
    turn, after, plans = attempted(
        executor, "turn(brick, 0.5)", Unlucky(slips=slips), scene, eye=Untwisted
    )
    assert turn.status == "done"
    assert len(plans) == 1 + len(slips)
    assert math.remainder(after.get("b").r - 0.5, math.pi) == pytest.approx(0, abs=1e-6)


class CalledOff(LocalArm):
    """Somebody calls the second try off while it is held."""

    plans = 0

    def run(self, plan, *, hold=False):
        self.plans += 1
        if self.plans == 2:
            raise Cancelled("you, before anything moved")
        return super().run(plan, hold=hold)


def test_a_second_try_called_off_is_a_failure_for_something_has_moved(executor):
    robot = IdealRobot(table("kitchen"), mishaps=Unlucky(unsealed=1))
    parts = Parts(lambda request: None, executor, predict, CalledOff(robot))
    turn = run_program(PUT, "manipulate", parts)
    assert (turn.status, turn.reason) == ("failed", "cancelled")
    assert turn.reply == "Called off: I did not try again."


def test_what_slipped_off_on_the_way_is_taken_from_where_it_lies(executor):
    scene = Scene(objects=(
        SceneObject(id="a", name="apple", x=-0.6, y=0.0, width=0.2, height=0.2, tall=0.2),
        SceneObject(id="p", name="plate", x=0.6, y=0.0, width=0.6, height=0.6, tall=0.1),
    ))  # fmt: skip
    turn, after, plans = attempted(executor, PUT, Unlucky(slips=(2,)), scene, touched=("a", "p"))
    assert (turn.status, after.get("a").on) == ("done", "p")
    took = [next((c.x, c.y) for c in p.told if c.op == "grip" and c.grip) for p in plans]
    assert math.dist(took[0], took[-1]) > 0.1


def test_what_follows_a_failed_carry_is_done_after_it(executor):
    program = "put(apple, [-0.5, 0.5])\nput(cup, [0.5, 0.5])"
    sizes = {"width": 0.2, "height": 0.2, "tall": 0.2}
    things = (("apple", -0.5), ("cup", 0.5))
    scene = Scene(objects=tuple(SceneObject(id=n, name=n, x=x, y=-0.5, **sizes) for n, x in things))
    turn, scene, _ = attempted(executor, program, Unlucky(unsealed=1), scene)
    assert turn.status == "done"
    assert scene.get("apple").position == pytest.approx((-0.5, 0.5), abs=1e-6)
    assert scene.get("cup").position == pytest.approx((0.5, 0.5), abs=1e-6)


def test_the_tray_has_closed_up_when_the_rest_is_taken_from_it(executor):
    sizes = {"width": 0.2, "height": 0.2, "tall": 0.2}
    names = ("apple", "cup", "lemon")
    tray = tuple(SceneObject(id=name, name=name, on="tray", **sizes) for name in names)
    robot = IdealRobot(Scene(tray=tray), mishaps=Second())
    parts = Parts(lambda request: None, executor, predict, LocalArm(robot))
    program = "put(apple, [0, 0])\nput(cup, [0.5, 0])\nput(lemon, [-0.5, 0])"
    turn = run_program(program, "arrange", parts)
    assert (turn.status, turn.reply[:19]) == ("done", "It took me 2 tries.")
    assert robot.scene().get("lemon").position == pytest.approx((-0.5, 0), abs=1e-6)


def test_what_is_carried_passes_over_what_still_waits_in_the_tray(executor):
    sizes = {"width": 0.2, "height": 0.2}
    talls = (("apple", 0.3), ("bottle", 0.7))
    tray = tuple(SceneObject(id=n, name=n, on="tray", tall=tall, **sizes) for n, tall in talls)
    robot = IdealRobot(Scene(tray=tray))
    plans = []
    parts = Parts(lambda request: None, executor, predict, LocalArm(robot))
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))
    run_program("put(apple, [0, 0])", "arrange", parts, watch=watch)
    assert max(one.z for one in plans[0].told) - 0.3 > 0.7


class Second(Mishaps):
    """The second grip does not seal."""

    grips = 0

    def seals(self):
        self.grips += 1
        return self.grips != 2


class Skewed(LocalArm):
    """Pushes end a little beside: what the plan moved lies elsewhere after the first look."""

    def __init__(self, robot, by):
        super().__init__(robot)
        self.by, self.robot = by, robot

    def run(self, plan, *, hold=False):
        yield from super().run(plan, hold=hold)
        if self.by:
            scene, dx, self.by = self.robot.scene(), self.by, None
            apple = scene.get("apple_1")
            moved = msgspec.structs.replace(apple, x=apple.x + dx[0], y=apple.y + dx[1])
            self.robot.load(scene.replace(moved))


def test_what_was_pushed_beside_its_place_is_pushed_there(executor):
    apple = SceneObject(id="apple_1", name="apple", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(apple,)))
    parts = Parts(lambda request: None, executor, predict, Skewed(robot, (-0.1, 0.05)))
    turn = run_program("push(apple, [0.4, 0])", "manipulate", parts)
    assert turn.reply.startswith("It took me 2 tries.")
    assert robot.scene().get("apple_1").position == pytest.approx((0.4, 0.0), abs=1e-3)


def pushed_beside(executor, by, brick_y, riders=()):
    """The turn that pushes the apple, and what stands on it, to (0.4, 0), beside a brick that
    nobody named; and the apple then."""
    apple = SceneObject(id="apple_1", name="apple", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    brick = SceneObject(id="c", name="brick", x=0.4, y=brick_y, width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(apple, brick, *riders)))
    parts = Parts(lambda request: None, executor, predict, Skewed(robot, by))
    decision = Decision(
        "act", "w", Dialog(), program="push(apple, [0.4, 0])", kind="manipulate",
        touched=("apple_1",),
    )  # fmt: skip
    turn, _ = run_turn("…", Dialog(), parts._replace(decide=lambda request: decision))
    assert robot.scene().get("c") == brick
    return turn, robot.scene().get("apple_1")


def test_where_there_is_no_room_to_push_it_back_it_is_slid_by_its_top(executor):
    turn, apple = pushed_beside(executor, by=(0.0, 0.1), brick_y=0.38)
    assert (turn.status, turn.reply[:19]) == ("done", "It took me 2 tries.")
    assert apple.position == pytest.approx((0.4, 0.0), abs=1e-6)
    assert [point.z for point in turn.trajectory if point.grip] == pytest.approx([0.2, 0.2])


def test_a_try_that_would_touch_what_nobody_named_is_not_made_and_said(executor):
    turn, apple = pushed_beside(executor, by=(0.0, 0.6), brick_y=0.3)
    assert turn.status == "failed"
    assert "I did not try again: the brick would be moved, and nobody asked" in turn.reply
    assert apple.position == pytest.approx((0.4, 0.6), abs=1e-6)


class Unsteady(Skewed):
    """Every push of the thing ends beside its place, and turns it."""

    def run(self, plan, *, hold=False):
        self.by = None if any(one.grip for one in plan.told) else (0.0, 0.06)
        yield from super().run(plan, hold=hold)
        scene = self.robot.scene()
        if not any(one.grip for one in plan.told):
            apple = scene.get("apple_1")
            self.robot.load(scene.replace(msgspec.structs.replace(apple, r=0.3)))


def test_what_two_pushes_left_beside_its_place_is_slid_there_and_turned_back(executor):
    apple = SceneObject(id="apple_1", name="brick", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(apple,)))
    parts = Parts(lambda request: None, executor, predict, Unsteady(robot, None))
    turn = run_program("push(brick, [0.4, 0])", "manipulate", parts)
    assert (turn.status, turn.reply[:19]) == ("done", "It took me 3 tries.")
    assert robot.scene().get("apple_1").position == pytest.approx((0.4, 0.0), abs=1e-6)
    assert robot.scene().get("apple_1").r == pytest.approx(0.0, abs=1e-6)


def test_what_is_flat_is_pushed_back_by_its_side_and_not_over_its_top(executor):
    coin = SceneObject(id="apple_1", name="coin", x=0, y=0, width=0.2, height=0.2, tall=0.03)
    robot = IdealRobot(Scene(objects=(coin,)))
    parts = Parts(lambda request: None, executor, predict, Skewed(robot, (-0.1, 0.0)))
    turn = run_program("push(coin, [0.4, 0])", "manipulate", parts)
    assert turn.reply.startswith("It took me 2 tries.")
    assert robot.scene().get("apple_1").position == pytest.approx((0.4, 0.0), abs=1e-6)
    assert not any(point.grip for point in turn.trajectory)


def test_a_try_whose_forecast_is_not_what_was_meant_is_not_made(executor):
    """What the arm holds as it should would be let go for what was pushed beside its place."""
    sizes = {"width": 0.2, "height": 0.2, "tall": 0.2}
    objects = (
        SceneObject(id="apple_1", name="apple", x=0, y=0, **sizes),
        SceneObject(id="l", name="lemon", x=-0.6, y=-0.6, **sizes),
    )
    robot = IdealRobot(Scene(objects=objects))
    plans = []
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))
    parts = Parts(lambda request: None, executor, predict, Shifted(robot))
    program = "push(apple, [0.4, 0])\npick(lemon)"
    turn = run_program(program, "manipulate", parts, watch=watch)
    assert (turn.status, len(plans)) == ("failed", 1)
    assert "I did not try again: it would not come to what was meant." in turn.reply
    assert robot.scene().get("l").held


@pytest.mark.parametrize(("off", "tries"), [(0.008, 1), (0.015, 2)])
def test_what_is_nearly_where_it_was_meant_is_brought_nearer(executor, off, tries):
    apple = SceneObject(id="apple_1", name="apple", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(apple,)))
    plans = []
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))
    parts = Parts(lambda request: None, executor, predict, Skewed(robot, (0.0, off)))
    turn = run_program("push(apple, [0.4, 0])", "manipulate", parts, watch=watch)
    assert (turn.status, len(plans)) == ("done", tries)
    left = off if tries == 1 else 0.0
    assert robot.scene().get("apple_1").y == pytest.approx(left, abs=1e-6)


def test_what_cannot_be_brought_nearer_is_near_enough(executor):
    egg = SceneObject(id="e", name="egg", x=0, y=0, z=0.2, width=0.1, height=0.1, tall=0.1,
                      on="apple_1")  # fmt: skip
    turn, apple = pushed_beside(executor, by=(0.0, 0.015), brick_y=0.23, riders=(egg,))
    assert (turn.status, turn.reply[:5]) == ("done", "The a")
    assert apple.y == pytest.approx(0.015)


def test_what_rolled_where_it_was_dropped_is_let_down_the_second_time(executor):
    apple = SceneObject(id="apple_1", name="apple", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(apple,)))
    parts = Parts(lambda request: None, executor, predict, Skewed(robot, (0.06, 0.0)))
    turn = run_program("pick(apple)\nset_down(apple, apple, 0.25)", "manipulate", parts)
    assert turn.reply.startswith("It took me 2 tries.")
    released = [a for a, b in pairwise(turn.trajectory) if a.grip and not b.grip]
    assert [point.z for point in released] == pytest.approx([0.45, 0.2])
    assert robot.scene().get("apple_1").x == pytest.approx(0.0, abs=1e-6)


def test_a_tool_that_is_taller_than_it_looked_pushes_again_clear_of_the_table():
    low, high = 0.4, 0.45
    bottle = SceneObject(id="b", name="bottle", x=-0.5, y=0, width=0.2, height=0.2, tall=low)
    lemon = SceneObject(id="l", name="lemon", x=0.2, y=0, width=0.3, height=0.3, tall=0.25)
    scene = Scene(objects=(bottle, lemon))
    way = [(-0.5, 1.2), (-0.5, low), (-0.5, 1.2), (-0.2, 1.2), (-0.2, low + 0.02)]
    moves = [Command("move", x, 0, z, 0, n >= 2) for n, (x, z) in enumerate(way)]
    moves.insert(2, Command("grip", -0.5, 0, low, 0, True))
    moves.append(Command("move", 0.1, 0, low + 0.02, 0, True))
    moves.append(Command("grip", 0.1, 0, low + 0.02, 0, False))
    moves.append(Command("move", 0.1, 0, 1.2, 0, False))
    robot = IdealRobot(scene)
    checked = check_commands(
        tuple(moves), "", "manipulate", scene, predict=predict, workspace=robot, start=robot.pose(),
        touched=["b", "l"],
    )  # fmt: skip
    forecast = Forecast(checked.meant, scene, predict)
    assert forecast.after(len(moves)).get("l").x == pytest.approx(0.35)  # pushed along
    # it was pressed on the table at the start of the push
    stuck = msgspec.structs.replace(bottle, x=-0.18, tall=high)
    look = Look(Scene(objects=(stuck, lemon)), checked.after, ["b", "l"], robot.pose())
    again = next(mendings(forecast, carries(forecast), look, 1))
    held = [one for one in again if one.op == "move" and one.grip]
    assert min(one.z for one in held) >= high
    assert max(one.x for one in again) == pytest.approx(0.1, abs=0.03)  # no push of its own
    checked = check_commands(
        again, "", "manipulate", look.seen, predict=predict, workspace=robot, start=robot.pose(),
        touched=["b", "l"],
    )  # fmt: skip
    assert checked.after.get("l").x == pytest.approx(0.35)


class Shifted(LocalArm):
    """An eye that sees the apple beside where it is."""

    looks = 0

    def scene(self):
        self.looks += 1
        scene = super().scene()
        if self.looks == 1:
            return scene
        apple = scene.get("apple_1")
        return scene.replace(msgspec.structs.replace(apple, y=apple.y + 0.05))


def test_after_what_was_put_right_the_tool_waits_where_the_program_said(executor):
    apple = SceneObject(id="apple_1", name="apple", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(apple,)))
    parts = Parts(lambda request: None, executor, predict, Skewed(robot, (-0.1, 0.0)))
    program = "push(apple, [0.4, 0])\nrobot.move(-0.5, 0.3, 0.6, 0)"
    turn = run_program(program, "manipulate", parts)
    assert turn.reply.startswith("It took me 2 tries.")
    end = robot.pose()
    assert (end.x, end.y, end.z) == pytest.approx((-0.5, 0.3, 0.6))


def test_what_stays_held_by_another_point_is_held_where_the_program_took_the_tool(executor):
    plum = SceneObject(id="p", name="plum", x=0.5, y=0, width=0.3, height=0.3, tall=0.2)
    robot = IdealRobot(Scene(objects=(plum,)), mishaps=Unlucky(unsealed=1))
    parts = Parts(lambda request: None, executor, predict, LocalArm(robot))
    turn = run_program("pick(plum)\nrobot.move(0, 0, 1.2, 0)", "manipulate", parts)
    assert (turn.status, turn.reply[:19]) == ("done", "It took me 2 tries.")
    assert (robot.pose().x, robot.pose().y) == pytest.approx((0.0, 0.0))
    assert robot.scene().get("p").x == pytest.approx(-0.03)


class Stops(Mishaps):
    """Somebody stops the arm while it tries again."""

    def __init__(self):
        super().__init__()
        self.robot = None
        self.grips = 0

    def seals(self):
        self.grips += 1
        if self.grips == 2:
            self.robot.stop()
        return self.grips > 1


def test_a_stop_in_a_second_try_ends_it(executor):
    mishaps = Stops()
    robot = mishaps.robot = IdealRobot(table("kitchen"), mishaps=mishaps)
    parts = Parts(lambda request: None, executor, predict, LocalArm(robot))
    turn = run_program(PUT, "manipulate", parts)
    assert (turn.status, turn.reason) == ("failed", "cancelled")


class Unseen(IdealRobot):
    """An arm like a real one that no camera looks after: its gripper feels nothing either."""

    def __init__(self, scene):
        super().__init__(scene)
        self._limits = msgspec.structs.replace(self._limits, simulated=False)

    def run(self, plan):
        return (msgspec.structs.replace(step, held=None) for step in super().run(plan))


@pytest.mark.parametrize(("by", "status"), [((-0.1, 0.05), "failed"), (None, "done")])
def test_where_the_table_is_only_computed_nothing_is_tried_again_and_that_is_said(
    executor, by, status
):
    apple = SceneObject(id="apple_1", name="apple", x=0, y=0, width=0.2, height=0.2, tall=0.2)
    plans = []
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))
    arm = Skewed(Unseen(Scene(objects=(apple,))), by)
    parts = Parts(lambda request: None, executor, predict, arm)
    turn = run_program("push(apple, [0.4, 0])", "manipulate", parts, watch=watch)
    assert (turn.status, len(plans)) == (status, 1)
    assert turn.reply.endswith(UNSEEN) and turn.trajectory
