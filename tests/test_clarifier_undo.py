"""Taking motions back, in a conversation whose scene goes on with what was decided."""

import pytest
from clarifier_table import TABLE, thing

from agent.errors import ProgramError
from agent.messages import ClarifyRequest, Dialog, Done
from agent.primitives import primitives
from clarifier.lexicon import load_lexicon
from clarifier.rewrite import restate
from clarifier.undo import REMEMBERED, WayBack, remembered, way_back
from robot_bridge.ideal import predict
from scene.types import Scene


class Conversation:
    """Sentences said to a clarifier; what it decides to do is done on the ideal table."""

    def __init__(self, clarifier, executor, scene=TABLE):
        self._clarifier, self._executor = clarifier, executor
        self.scene, self.dialog = scene, Dialog()

    def say(self, text, *, moves=True):
        decision = self._clarifier.decide(ClarifyRequest(text, self.scene, self.dialog))
        self.dialog = decision.dialog
        if decision.do == "act" and moves:
            (draft,) = self._executor.run(decision.program, decision.kind, [self.scene])
            assert not isinstance(draft, ProgramError), draft
            self.scene = predict(primitives(draft, self.scene), self.scene)
        return decision

    def place(self, identity):
        item = self.scene.get(identity)
        return (round(item.x, 3), round(item.y, 3), item.on)


@pytest.fixture
def talk(clarifier, executor):
    return Conversation(clarifier, executor)


def home(identity):
    item = TABLE.get(identity)
    return (item.x, item.y, item.on)


# --- undo ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("words", ["undo that", "undo", "put it back", "take that back", "go back"])
def test_undo_puts_back_what_was_put_elsewhere(talk, words):
    talk.say("put the red mug on the plate")
    assert talk.place("mug_1")[2] == "plate_1"
    decision = talk.say(words)
    assert (decision.do, decision.touched) == ("act", ("mug_1",))
    assert talk.place("mug_1") == home("mug_1")


def test_undo_goes_on_motion_by_motion_until_nothing_is_left(talk):
    talk.say("put the red mug on the plate")
    talk.say("push the sponge to the right")
    talk.say("undo")
    assert talk.place("sponge_1") == home("sponge_1")
    assert talk.place("mug_1")[2] == "plate_1"
    talk.say("undo")
    assert talk.place("mug_1") == home("mug_1")
    nothing = talk.say("undo")
    assert (nothing.do, nothing.program) == ("refuse", None)
    assert "nothing" in nothing.reply.lower()


def test_a_motion_that_was_decided_on_but_not_made_is_passed_over(talk):
    talk.say("put the red mug on the plate")
    talk.say("push the sponge to the right", moves=False)
    assert talk.say("undo that").touched == ("mug_1",)


def test_what_was_picked_up_is_set_down_where_it_stood(talk):
    talk.say("pick up the sponge")
    assert talk.scene.get("sponge_1").held
    talk.say("undo that")
    assert talk.place("sponge_1") == home("sponge_1")


def test_what_lies_on_the_floor_stays_there_and_that_is_said(talk):
    talk.say("put the red mug on the plate")
    fallen = talk.scene.get("mug_1")
    floor = thing("mug", 1.3, -0.6, "red", size=0.1, on="floor")
    talk.scene = talk.scene.replace(floor)
    decision = talk.say("undo that")
    assert (decision.do, decision.reason) == ("refuse", "impossible")
    assert "floor" in decision.reply and fallen.on == "plate_1"


def test_the_way_back_is_refused_where_something_stands_there_now(talk):
    talk.say("put the red mug on the plate")
    talk.scene = talk.scene.replace(thing("sponge", -0.3, -0.6, size=0.14, tall=0.05))
    decision = talk.say("undo that")
    assert (decision.do, decision.reason) == ("refuse", "unsafe")


# --- by name -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        "put the red mug back", "put the red mug back where it was", "move the red mug back",
        "return the red mug to its old place", "put the red mug where it was before, please",
    ],
)  # fmt: skip
def test_a_thing_goes_back_by_name_whatever_was_done_since(talk, words):
    talk.say("put the red mug on the plate")
    talk.say("push the sponge to the right")
    talk.say(words)
    assert talk.place("mug_1") == home("mug_1")
    assert talk.place("sponge_1") != home("sponge_1")
    talk.say("undo")
    assert talk.place("sponge_1") == home("sponge_1"), "the other motion can still be taken back"


def test_a_place_behind_something_is_not_a_way_back(talk):
    talk.say("put the red mug on the plate")
    assert talk.say("put the sponge in back of the bowl").touched != ("mug_1",)


# --- corrections ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        "no, the blue one", "No, the blue mug!", "not that one, the blue one",
        "I meant the blue one",
        "wrong one, the blue one", "no, I meant the blue mug", "oops, the blue one",
    ],
)  # fmt: skip
def test_a_correction_puts_the_first_back_and_takes_the_one_meant(talk, words):
    talk.say("put the red mug on the plate")
    decision = talk.say(words)
    assert decision.do == "act"
    assert "back" in decision.echo
    assert talk.place("mug_1") == home("mug_1")
    assert talk.place("mug_2")[2] == "plate_1"


def test_a_correction_can_itself_be_taken_back(talk):
    talk.say("put the red mug on the plate")
    talk.say("no, the blue one")
    talk.say("undo that")
    assert talk.place("mug_2") == home("mug_2")


def test_without_a_motion_no_is_no_correction(talk):
    assert not talk.say("no, the blue one").why.startswith("a correction")


def test_a_correction_that_is_unclear_asks_and_moves_nothing(talk):
    talk.say("put the red mug on the plate")
    decision = talk.say("no, the apple")
    assert decision.do == "ask"
    assert talk.place("mug_1")[2] == "plate_1"


# --- the way back itself -------------------------------------------------------------------------


def scene_of(*things):
    return Scene(objects=things)


A, B = thing("cup", 0.0, 0.0), thing("cup", 0.5, 0.0, number=2)


def test_two_that_changed_places_change_back(executor):
    then = scene_of(A, B)
    now = scene_of(thing("cup", 0.5, 0.0), thing("cup", 0.0, 0.0, number=2))
    way = way_back(Done("swap the cups", tuple(then)), now)
    assert isinstance(way, WayBack)
    (draft,) = executor.run(way.program, "manipulate", [now])
    after = predict(primitives(draft, now), now)
    assert [item.position for item in after] == [pytest.approx(item.position) for item in then]


def test_a_stack_comes_down_from_the_top(executor):
    cups = [thing("cup", x, 0.0, number=n) for n, x in enumerate((0.0, 0.4, 0.8), 1)]
    now = scene_of(
        cups[0], thing("cup", 0.0, 0.0, number=2, z=0.1, on="cup_1"),
        thing("cup", 0.0, 0.0, number=3, z=0.2, on="cup_2"),
    )  # fmt: skip
    way = way_back(Done("stack the cups", tuple(cups[1:])), now)
    (draft,) = executor.run(way.program, "manipulate", [now])
    after = predict(primitives(draft, now), now)
    assert [item.position for item in after] == [pytest.approx(cup.position) for cup in cups]
    assert {item.on for item in after} == {"table"}


def test_what_stood_on_something_goes_back_onto_it(executor):
    plate = thing("plate", 0.5, 0.5, size=0.3, tall=0.02)
    then = thing("cup", 0.5, 0.5, z=0.02, on="plate_1")
    now = scene_of(plate, thing("cup", 0.0, 0.0))
    way = way_back(Done("put the cup in the middle", (then,)), now)
    (draft,) = executor.run(way.program, "manipulate", [now])
    assert predict(primitives(draft, now), now).get("cup_1").on == "plate_1"


def test_what_was_turned_is_turned_back(executor):
    now = scene_of(thing("cup", 0.0, 0.0, r=0.5))
    way = way_back(Done("turn the cup", (A,)), now)
    (draft,) = executor.run(way.program, "manipulate", [now])
    assert predict(primitives(draft, now), now).get("cup_1").r == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize(
    ("now", "said"),
    [
        (scene_of(B), "can't see"),
        (scene_of(thing("cup", 0.0, 0.0, upright=False)), "upright"),
        (scene_of(thing("cup", 1.3, 0.0, on="floor")), "floor"),
    ],
)
def test_what_this_arm_cannot_put_back_is_said(now, said):
    why = way_back(Done("…", (A,)), now)
    assert isinstance(why, str) and said in why


def test_where_all_is_there_already_there_is_no_way_to_go():
    assert way_back(Done("…", (A,)), scene_of(A, B)) is None


def test_only_so_many_motions_are_remembered_and_none_that_moves_nothing():
    done = ()
    for number in range(REMEMBERED + 3):
        done = remembered(done, str(number), scene_of(A), scene_of(thing("cup", 0.3, 0.0)))
    assert [one.text for one in done] == [str(n) for n in range(3, REMEMBERED + 3)]
    assert remembered(done, "touch it", scene_of(A), scene_of(A)) == done


# --- the same again ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        "same with the blue mug", "now do the same with the blue mug", "and the blue one too",
        "do the same thing again but with the blue mug", "do that with the blue one too",
        "now the blue one", "the same for the blue mug, please", "once again with the blue mug",
    ],
)  # fmt: skip
def test_the_last_deed_is_done_with_another_thing(talk, words):
    talk.say("put the red mug in the bowl")
    decision = talk.say(words)
    assert (decision.do, set(decision.touched)) == ("act", {"mug_2", "bowl_1"})


@pytest.mark.parametrize(
    "words", ["now the blue mug on the plate", "and the blue one on the plate"]
)
def test_a_thing_with_a_place_of_its_own_goes_there(talk, words):
    talk.say("put the red mug in the bowl")
    decision = talk.say(words)
    assert (decision.do, set(decision.touched)) == ("act", {"mug_2", "plate_1"})


def test_a_place_said_instead_takes_the_thing_there(talk):
    talk.say("put the sponge on the plate")
    decision = talk.say("no wait, in the bowl")
    assert decision.do == "act" and talk.place("sponge_1")[2] == "bowl_1"


def test_a_thing_named_twice_is_replaced_wherever_it_is_named():
    last = Dialog(last_text="the red mug is too low, lift the red mug")
    again = restate("you do also the blue one", last, TABLE, load_lexicon())
    assert again == "the blue mug is too low, lift the blue mug"


def test_a_place_alone_is_for_what_was_spoken_of(talk):
    talk.say("pick up the red mug")
    decision = talk.say("on the plate")
    assert (decision.do, set(decision.touched)) == ("act", {"mug_1", "plate_1"})
