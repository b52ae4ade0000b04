"""A sentence that was not understood is heard again without its talk; one that was is not."""

import msgspec
import pytest

from agent.messages import ClarifyRequest, Decision, Dialog, Pending, Question
from clarifier.hearing import decided

TALK = "my cousin says hello, put the cup away"
PLAIN = "put the cup away"


def hears(text):
    return [PLAIN] if text == TALK else []


def request(text=TALK):
    return ClarifyRequest(text=text, scene=(), dialog=Dialog())


def act(sure=0.95):
    return Decision(
        "act", "clear", Dialog(), program="put(cup, [0, 0])", confidence=sure, ms_translate=3.0
    )


def ask(kind):
    return Decision(
        "ask", "unsure", Dialog(), question=Question(kind, "Which?", ()), ms_translate=2.0
    )


def ask_for_half():
    return msgspec.structs.replace(ask("confirm"), why="'sing' is beyond the arm")


def refuse(reason="not_understood"):
    return Decision("refuse", "unclear", Dialog(), reason=reason, ms_translate=2.0)


def deciding(first, second):
    heard = []

    def decide(asked):
        heard.append(asked.text)
        return first if asked.text == TALK else second

    return decide, heard


@pytest.mark.parametrize("first", [refuse(), ask("unknown_word"), ask("confirm"), ask("open")])
def test_what_was_not_understood_acts_once_its_talk_is_left_out(first):
    decide, heard = deciding(first, act())
    found = decided(decide, hears, request())
    assert found.do == "act"
    assert heard == [TALK, PLAIN]
    assert found.ms_translate == 5.0


@pytest.mark.parametrize("first", [
    ask("which"), ask("where"), ask_for_half(), refuse("unsafe"), refuse("impossible"),
    Decision("answer", "chat", Dialog(), reply="..."), Decision("stop", "halt", Dialog()),
])  # fmt: skip
def test_what_was_settled_is_not_heard_again(first):
    decide, heard = deciding(first, act())
    assert decided(decide, hears, request()) == first
    assert heard == [TALK]


def test_what_is_understood_is_done_as_it_was_said():
    decide, heard = deciding(act(), refuse())
    assert decided(decide, hears, request()) == act()
    assert heard == [TALK]


def test_what_is_nothing_but_talk_is_not_acted_on():
    decide, _ = deciding(act(), act())
    found = decided(decide, lambda text: [""], request())
    assert found.do == "answer"
    assert found.program is None
    assert found.dialog == Dialog()


def test_an_answer_to_a_question_is_never_taken_for_talk():
    pending = Pending(TALK, Question("which", "Which?", ()))
    decide, _ = deciding(act(), refuse())
    asked = msgspec.structs.replace(request(), dialog=Dialog(pending=pending))
    assert decided(decide, lambda text: [""], asked).do == "act"


@pytest.mark.parametrize("sure", [0.89, None])
def test_what_leaves_words_out_must_be_surer_than_what_does_not(sure):
    decide, heard = deciding(refuse(), act(sure))
    assert decided(decide, hears, request()).do == "refuse"
    assert heard == [TALK, PLAIN]


def test_a_question_about_one_thing_is_better_than_not_understanding():
    decide, _ = deciding(refuse(), ask("which"))
    assert decided(decide, hears, request()).do == "ask"


@pytest.mark.parametrize("second", [refuse(), ask("confirm"), refuse("unsafe")])
def test_a_second_hearing_that_is_no_better_leaves_the_first(second):
    first = ask("unknown_word")
    decide, _ = deciding(first, second)
    found = decided(decide, hears, request())
    assert msgspec.structs.replace(found, ms_translate=first.ms_translate) == first


def test_without_talk_or_a_tagger_there_is_one_hearing():
    decide, heard = deciding(refuse(), act())
    assert decided(decide, None, request()).do == "refuse"
    assert decided(decide, lambda text: [], request()).do == "refuse"
    assert heard == [TALK, TALK]


def test_the_first_hearing_that_acts_is_taken():
    heard = []

    def decide(asked):
        heard.append(asked.text)
        return act() if asked.text == PLAIN else refuse()

    found = decided(decide, lambda text: ["put the cup, she says", PLAIN, "put"], request())
    assert found.do == "act"
    assert heard == [TALK, "put the cup, she says", PLAIN]
