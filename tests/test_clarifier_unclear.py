"""A sentence that is not understood: what of it is, what is not, and what the person can change."""

import pytest
from clarifier_table import TABLE, SmallTranslator, linked, talk

from agent.messages import Translation
from clarifier.phrases import phrases_of


class Doubtful(SmallTranslator):
    """Understands no sentence that holds one of these words, and nothing longer than a phrase."""

    def __init__(self, *words, longest=9):
        super().__init__()
        self._words, self._longest = words, longest

    def __call__(self, request):
        said = request.text.split()
        if len(said) > self._longest or set(said) & set(self._words):
            return Translation((), 0.0, 1.0)
        return super().__call__(request)


@pytest.fixture
def reply(clarifier_over):
    """What is replied to a sentence that is not understood."""

    def reply(translator, text, scene=TABLE):
        (decision,) = talk(clarifier_over(translator), text, scene=scene)
        assert (decision.do, decision.reason) == ("refuse", "not_understood")
        return decision.reply

    return reply


@pytest.mark.parametrize(
    ("text", "phrases"),
    [
        ("lift the bowl and then push the sponge left",
         ("lift the bowl", "push the sponge left")),
        ("put the sponge on the plate, the bottle in the bowl and after that tap the bowl",
         ("put the sponge on the plate", "the bottle in the bowl", "tap the bowl")),
        ("sponge in bowl. bottle on plate", ("sponge in bowl", "bottle on plate")),
        ("put the sponge and the bottle on the plate",
         ("put the sponge and the bottle on the plate",)),
        ("put the sponge between the bowl and the plate",
         ("put the sponge between the bowl and the plate",)),
        ("if the bowl is empty, put the sponge in and lift it",
         ("if the bowl is empty, put the sponge in and lift it",)),
        ("don't lift the bowl, push it left", ("don't lift the bowl, push it left",)),
    ],
)  # fmt: skip
def test_phrases_that_each_ask_for_something(text, phrases):
    assert phrases_of(linked(text)) == phrases


def test_the_phrase_that_is_not_understood_is_named(reply):
    said = reply(Doubtful("whirl"), "put the sponge on the plate and whirl the bottle about")
    assert "understand “put the sponge on the plate”" in said
    assert "not “whirl the bottle about”" in said


def test_phrases_that_are_each_sure_are_done_one_after_the_other(clarifier_over):
    text = "put the sponge on the plate and put the bottle in the bowl"
    (decision,) = talk(clarifier_over(Doubtful()), text)
    assert decision.do == "act"
    assert set(decision.touched) == {"sponge_1", "bottle_1", "plate_1", "bowl_1"}
    assert decision.program is not None
    assert [line for line in decision.program.splitlines() if "grip(True)" in line] == [
        "robot.grip(True)", "robot.grip(True)",
    ]  # fmt: skip


def test_where_no_phrase_is_understood_all_are_named(reply):
    said = reply(
        Doubtful("slide", "put"), "slide the sponge to the left and put the bowl on the plate"
    )
    assert said.startswith("I don't understand “slide the sponge to the left” or “put the bowl")


def test_one_phrase_is_not_taken_apart(reply):
    said = reply(Doubtful("put"), "put the sponge on the plate")
    assert "not sure" in said and "“" not in said


def test_an_unknown_deed_is_asked_about_however_sure_the_translator_is(clarifier):
    asked, done = talk(clarifier, "glimp the bottle", "push it to the left")
    assert asked.do == "ask" and "“glimp”" in asked.question.text
    assert (done.do, done.touched) == ("act", ("bottle_1",))


@pytest.mark.parametrize(
    "text",
    [
        "stack the blocks with the heaviest at the bottom",
        "line up the blocks, the most valuable one on the left",
        "stack the blocks, lightest on top",
        "line up the blocks from the oldest to the newest",
    ],
)
def test_what_no_scene_shows_is_not_guessed(text, reply):
    said = reply(SmallTranslator(), text)
    assert "I can't tell what is" in said and "Please name the things" in said


# --- is this what you mean? ----------------------------------------------------------------------


@pytest.fixture
def told(clarifier_over):
    """What is decided on each of these turns, the translator being so sure."""
    return lambda sure, *turns: talk(clarifier_over(SmallTranslator(sure)), *turns)


def test_a_likely_reading_is_asked_about_by_what_it_would_come_to(told):
    (asked,) = told(0.5, "push the sponge to the right")
    assert (asked.do, asked.question.kind) == ("ask", "confirm")
    assert "The sponge" in asked.question.text
    assert [option.label for option in asked.question.options] == ["yes"]


@pytest.mark.parametrize("answer", ["yes", "Yes please", "yep", "1", "sure"])
def test_a_yes_runs_what_was_shown(answer, told):
    asked, done = told(0.5, "push the sponge to the right", answer)
    assert done.do == "act"
    assert done.program == asked.question.options[0].program


@pytest.mark.parametrize(
    "answer", ["fine, just the mug then", "okay, only that one mug", "great, the red mug alone"]
)
def test_a_yes_may_name_what_was_shown_in_fewer_words(answer, told):
    asked, done = told(0.5, "push the red mug to the left", answer)
    assert (asked.question.kind, done.do) == ("confirm", "act")


@pytest.mark.parametrize("answer", ["no", "nope", "never mind", "none of them"])
def test_a_no_moves_nothing(answer, told):
    _, left = told(0.5, "push the sponge to the right", answer)
    assert (left.do, left.dialog.pending) == ("answer", None)


def test_another_command_is_taken_instead(told):
    _, other = told(0.5, "push the sponge to the right", "push the bottle to the left")
    assert other.do == "ask" and "bottle" in other.question.text


def test_an_unlikely_reading_is_not_offered(told):
    (decision,) = told(0.3, "push the sponge to the right")
    assert (decision.do, decision.reason) == ("refuse", "not_understood")


def test_what_ends_just_as_the_sentence_says_needs_no_asking(told):
    (decision,) = told(0.5, "put the sponge on the plate")
    assert (decision.do, set(decision.touched)) == ("act", {"sponge_1", "plate_1"})


def test_a_place_about_a_thing_that_is_not_understood_is_asked_for_by_side(clarifier_over):
    clarifier = clarifier_over(Doubtful("near"))
    asked, done = talk(clarifier, "put the sponge near the plate", "behind it")
    assert (asked.do, asked.question.kind) == ("ask", "where")
    assert "On which side of the plate" in asked.question.text
    assert (done.do, set(done.touched)) == ("act", {"sponge_1", "plate_1"})


@pytest.mark.parametrize(
    "text", ["put the sponge glorply in the bowl", "glorp the sponge and the bowl adjoining"]
)
def test_no_side_is_asked_for_where_the_place_is_said_or_nothing_is_to_be_put(clarifier_over, text):
    (decision,) = talk(clarifier_over(Doubtful("glorply", "adjoining")), text)
    assert decision.question is None or decision.question.kind != "where"
