"""What one turn leaves for the next: questions and their answers, what was spoken of."""

import pytest
from clarifier_table import TABLE, talk, thing

from agent.messages import Dialog, Pending, Question


@pytest.mark.parametrize(
    ("answer", "touched"),
    [
        ("the green one", ("apple_2",)), ("left", ("apple_1",)), ("2", ("apple_2",)),
        ("either", ("apple_1",)), ("the one by the bowl", ("apple_2",)),
        ("no wait, the sponge", ("sponge_1",)), ("push the bottle left", ("bottle_1",)),
    ],
)  # fmt: skip
def test_an_answer_goes_on(clarifier, answer, touched):
    _, decision = talk(clarifier, "push the apple to the left", answer)
    assert (decision.do, decision.touched) == ("act", touched)
    assert decision.dialog.pending is None


def test_a_picked_option_is_not_translated_again(clarifier, translator):
    talk(clarifier, "push the apple to the left", "the red one")
    assert len(translator.requests) == 1


def test_a_picked_option_is_checked_on_the_live_scene(clarifier):
    (asked,) = talk(clarifier, "put the mug on the plate")
    moved = TABLE.replace(thing("plate", 1.9, 0.0, size=0.3, tall=0.02))
    (decision,) = talk(clarifier, "the red one", scene=moved, dialog=asked.dialog)
    assert decision.do == "refuse" and decision.reason == "unreachable"


def test_a_new_command_drops_the_question_and_says_so(clarifier):
    _, decision = talk(clarifier, "push the apple left", "lift the bottle")
    assert decision.touched == ("bottle_1",) and "drop" in decision.echo


def test_a_question_back_keeps_the_question(clarifier):
    _, answered, decision = talk(
        clarifier, "push the apple left", "what colour are they?", "the red one"
    )
    assert answered.do == "answer" and "green" in answered.reply
    assert decision.touched == ("apple_1",)


def test_two_strikes_and_it_stops_politely(clarifier):
    _, again, end = talk(clarifier, "push the apple left", "flurb", "")
    assert again.do == "ask" and "1 the red apple" in again.reply
    assert (end.do, end.reason, end.dialog.pending) == ("refuse", "cancelled", None)


def test_neither_drops_the_question(clarifier):
    _, decision = talk(clarifier, "push the apple left", "neither of them")
    assert decision.do == "answer" and decision.dialog.pending is None


def test_never_mind_drops_the_question(clarifier):
    _, decision = talk(clarifier, "push the apple left", "never mind")
    assert decision.do == "answer" and decision.dialog.pending is None


def test_two_questions_in_a_row(clarifier):
    which, where, decision = talk(clarifier, "put the apple", "the green one", "in the middle")
    assert (which.question.kind, where.question.kind) == ("which", "where")
    assert decision.touched == ("apple_2",)


def test_a_free_place_completes_the_sentence(clarifier, translator):
    _, decision = talk(clarifier, "move the bottle", "next to the sponge")
    assert decision.touched == ("bottle_1", "sponge_1")
    assert translator.requests[-1].text == "move the bottle next to the sponge"


def test_it_and_one_follow_the_conversation(clarifier):
    _, onto, other = talk(
        clarifier, "pick up the red mug", "put it on the plate", "now the blue one"
    )
    assert onto.touched == ("mug_1", "plate_1")
    assert other.touched == ("mug_2", "plate_1")


def test_focus_decays(clarifier):
    _, decision = talk(clarifier, "lift the sponge", "put the bottle on the plate")
    focus = {one.object: one.salience for one in decision.dialog.focus}
    assert focus == {"bottle_1": 1.0, "plate_1": 0.8, "sponge_1": 0.7}


def test_a_command_is_asked_about_only_so_often(clarifier):
    pending = Pending("move the sponge", Question("open", "What?"))
    dialog = Dialog(pending=pending, questions_asked=4)
    (decision,) = talk(clarifier, "to", dialog=dialog)
    assert decision.do in ("ask", "refuse")
    asked = Dialog(pending=Pending("put the apple", Question("which", "?")), questions_asked=4)
    (decision,) = talk(clarifier, "the green apple", dialog=asked)
    assert (decision.do, decision.reason) == ("refuse", "not_understood")


@pytest.mark.parametrize(
    "text",
    ["the", "of", "and and", "put put put", "to the", "1 2 3", "it", "the the the", "'",
     "between and", "a of the", "😀 push 😀"],
)  # fmt: skip
def test_fragments_never_raise_and_never_move(clarifier, text):
    (decision,) = talk(clarifier, text)
    assert decision.do != "act"
