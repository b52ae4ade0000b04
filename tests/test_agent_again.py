"""What is asked where the tries are spent, and that the answer is carried out."""

import math

import msgspec
import pytest

from agent.again import TRY_AGAIN, what_next
from agent.arm import LocalArm
from agent.attempt import Watch
from agent.compose import table
from agent.errors import LinkDown
from agent.messages import BY_HAND, LEAVE, Decision, Dialog
from agent.turn import Parts, run_program, run_turn
from clarifier.decide import Clarifier
from robot_bridge.ideal import IdealRobot, predict
from robot_bridge.mishaps import Mishaps
from scene.types import Scene, SceneObject

KITCHEN = table("kitchen")
PUT, NAMED = "put_on(apple, plate)", ("apple_1", "plate_1")


class Unsealed(Mishaps):
    """The first so many grips do not seal."""

    def __init__(self, grips):
        super().__init__()
        self.left = grips

    def seals(self):
        self.left -= 1
        return self.left < 0


class Talk:
    """A conversation on the ideal table: the first sentence is a given program, answers are read by
    the clarifier, which has no translator here."""

    def __init__(self, executor, program, mishaps, scene=KITCHEN, touched=NAMED):
        self.robot = IdealRobot(scene, mishaps=mishaps)
        self.dialog, self._first = Dialog(), (program, touched)
        self.parts = Parts(self._decide, executor, predict, LocalArm(self.robot))
        self._clarifier = Clarifier(self._translate, executor, predict, self.robot)

    def _translate(self, *args):
        raise AssertionError("an answer needs no translation")

    def _decide(self, request):
        if request.dialog.pending is not None:
            return self._clarifier.decide(request)
        program, touched = self._first
        dialog = Dialog(last_text=request.text)
        return Decision("act", "w", dialog, program=program, kind="manipulate", touched=touched)

    def say(self, text):
        turn, self.dialog = run_turn(text, self.dialog, self.parts)
        return turn

    def put_by_hand(self, id_, **changes):
        scene = self.robot.scene()
        self.robot.load(scene.replace(msgspec.structs.replace(scene.get(id_), **changes)))


def test_after_the_last_try_it_is_asked_who_is_to_do_the_rest(executor):
    talk = Talk(executor, PUT, Unsealed(3))
    turn = talk.say("put the apple on the plate")
    assert (turn.status, turn.question.kind) == ("failed", "confirm")
    assert turn.reply.startswith("I could not keep hold of the apple in 3 tries.")
    assert turn.question.text == "Shall I try again?"
    assert turn.reply.endswith(" Shall I try again?")
    assert [one.label for one in turn.question.options] == [TRY_AGAIN, BY_HAND, LEAVE]
    assert talk.dialog.pending.question == turn.question


@pytest.mark.parametrize("answer", ["yes", "try again", "Try again, please!", "1", "the first"])
def test_yes_tries_again(executor, answer):
    talk = Talk(executor, PUT, Unsealed(3))
    talk.say("put the apple on the plate")
    assert talk.say(answer).status == "done"
    assert talk.robot.scene().get("apple_1").on == "plate_1"
    assert talk.dialog.pending is None


@pytest.mark.parametrize("answer", ["no", "leave it", "3", "no, leave it"])
def test_no_leaves_it(executor, answer):
    talk = Talk(executor, PUT, Unsealed(3))
    talk.say("put the apple on the plate")
    turn = talk.say(answer)
    assert (turn.status, turn.trajectory) == ("answered", ())
    assert talk.robot.scene() == KITCHEN
    assert talk.dialog.pending is None


@pytest.mark.parametrize("answer", [BY_HAND, "I put it there myself", "done", "I've moved it"])
def test_what_a_person_has_done_meanwhile_is_not_done_again(executor, answer):
    talk = Talk(executor, PUT, Unsealed(3))
    talk.say("put the apple on the plate")
    plate = KITCHEN.get("plate_1")
    talk.put_by_hand("apple_1", x=plate.x, y=plate.y, z=plate.top, on="plate_1")
    turn = talk.say(answer)
    assert (turn.status, turn.trajectory) == ("done", ())
    assert turn.reply == "There was nothing to move."


def test_what_a_person_only_brought_nearer_is_carried_the_rest_of_the_way(executor):
    talk = Talk(executor, PUT, Unsealed(3))
    talk.say("put the apple on the plate")
    talk.put_by_hand("apple_1", x=0.0, y=-0.85)
    assert talk.say(BY_HAND).status == "done"
    assert talk.robot.scene().get("apple_1").on == "plate_1"


def test_a_program_that_nobody_said_ends_without_a_question(executor):
    robot = IdealRobot(KITCHEN, mishaps=Unsealed(3))
    turn = run_program(PUT, "manipulate", Parts(None, executor, predict, LocalArm(robot)))
    assert (turn.status, turn.question) == ("failed", None)


def test_a_second_failure_asks_again(executor):
    talk = Talk(executor, PUT, Unsealed(6))
    first = talk.say("put the apple on the plate")
    second = talk.say("yes")
    assert (second.status, second.question) == ("failed", first.question)
    assert talk.say("yes").status == "done"


# --- what is left, as a program ------------------------------------------------------------------

SIZES = {"width": 0.2, "height": 0.2, "tall": 0.2}
APPLE = SceneObject(id="a", name="apple", x=0.0, y=0.0, **SIZES)
CUP = SceneObject(id="c", name="cup", x=0.6, y=0.0, **SIZES)
SEEN = Scene(objects=(APPLE, CUP))


def moved(item, **changes):
    return SEEN.replace(msgspec.structs.replace(item, **changes))


@pytest.mark.parametrize(
    ("goal", "carried", "program"),
    [
        (moved(APPLE, x=-0.5), {"a"}, "    put(apple, [-0.5, 0])"),
        (moved(APPLE, x=-0.5), (), "    push(apple, [-0.5, 0])"),
        (moved(APPLE, x=-1.3, on="floor"), {"a"}, "    push(apple, [-1.3, 0])"),
        (moved(APPLE, on="gripper", z=0.8, held=True), {"a"}, "pick(apple)"),
        (moved(APPLE, x=0.6, z=0.02, on="c"), {"a"}, "    put_on(apple, cup)"),
    ],
)
def test_the_rest_goes_to_where_the_first_plan_meant_it(executor, goal, carried, program):
    question = what_next(goal, SEEN, ("a",), carried)
    again = question.options[0]
    assert again.program.splitlines()[-1] == program
    robot = IdealRobot(SEEN)
    turn = run_program(
        again.program, again.kind, Parts(None, executor, predict, LocalArm(robot), retries=0)
    )
    assert turn.status == "done"
    want, got = goal.get("a"), robot.scene().get("a")
    assert (got.on, got.held) == (want.on, want.held)
    if want.on == "table":
        assert math.dist(want.position, got.position) < 1e-6


def test_what_should_lie_and_still_stands_is_knocked_over_again(executor):
    bottle = SceneObject(id="b", name="bottle", x=0.0, y=0.0, width=0.1, height=0.1, tall=0.3)
    lying = {"y": 0.2, "height": 0.3, "tall": 0.1, "upright": False}
    stands = Scene(objects=(bottle,))
    lies = stands.replace(msgspec.structs.replace(bottle, **lying))
    again = what_next(lies, stands, ("b",), ()).options[0]
    for seen, moves in ((stands, True), (lies, False)):
        robot = IdealRobot(seen)
        parts = Parts(None, executor, predict, LocalArm(robot), retries=0)
        turn = run_program(again.program, again.kind, parts)
        assert (turn.status, bool(turn.trajectory)) == ("done", moves)
        assert robot.scene().get("b").position == pytest.approx((0.0, 0.2), abs=1e-6)


@pytest.mark.parametrize("lost", [{"x": 1.3, "on": "floor"}, {"upright": False}])
def test_what_the_gripper_cannot_take_a_person_is_asked_to_put_right(lost):
    question = what_next(moved(APPLE, x=-0.5), moved(APPLE, **lost), ("a",), {"a"})
    assert question.text.startswith("I can't take the apple from there.")
    assert [one.label for one in question.options] == [BY_HAND, LEAVE]


def test_nothing_is_asked_about_what_nobody_named():
    assert what_next(moved(CUP, x=0.8), SEEN, ("a",), ()) is None
    assert what_next(SEEN, SEEN, ("a",), ()) is None


# --- the link between two tries -----------------------------------------------------------------


class Lost(LocalArm):
    """The link goes down when the arm is asked where it is for the so-manieth time."""

    def __init__(self, robot, at):
        super().__init__(robot)
        self.asked, self.at = 0, at

    def start(self):
        self.asked += 1
        if self.asked == self.at:
            raise LinkDown("the cable is out")
        return super().start()


def lost(executor, at, retries):
    plans = []
    arm = Lost(IdealRobot(KITCHEN, mishaps=Unsealed(3)), at)
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))
    decision = Decision("act", "w", Dialog(), program=PUT, kind="manipulate", touched=NAMED)
    parts = Parts(lambda request: decision, executor, predict, arm, retries)
    turn, dialog = run_turn("put the apple on the plate", Dialog(), parts, watch=watch)
    assert (turn.question, dialog.pending) == (None, None)
    return turn, plans


def test_a_link_that_goes_down_between_two_tries_is_a_failure_that_says_so(executor):
    turn, plans = lost(executor, at=2, retries=2)
    assert (turn.status, len(plans)) == ("failed", 1)
    assert turn.reply == "I had to break off: the cable is out."
    assert turn.trajectory


def test_a_link_that_goes_down_before_the_gripper_is_free_is_said_and_nothing_is_asked(executor):
    turn, _ = lost(executor, at=2, retries=0)
    assert turn.status == "failed"
    assert turn.reply.startswith("I could not keep hold of the apple.")
    assert turn.reply.endswith("Then I had to break off: the cable is out.")
    assert "try again" not in turn.reply
