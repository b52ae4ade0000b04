"""Words that the person teaches: kept in a file, read anew, put in place of what they stand for."""

import pytest
from clarifier_table import SmallTranslator, talk

from agent.errors import ConfigError
from agent.messages import Dialog, Lesson
from clarifier.decide import Clarifier
from clarifier.taught import MOST, Taught, Words
from robot_bridge.ideal import IdealRobot, predict


@pytest.fixture
def path(tmp_path):
    return tmp_path / "words" / "words.toml"


@pytest.fixture
def clarifier(executor, path):
    return Clarifier(SmallTranslator(), executor, predict, IdealRobot(), Taught(path))


def last(clarifier, *turns):
    return talk(clarifier, *turns)[-1]


# --- things --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "lesson",
    [
        "the glorp is the sponge", "a glorp is the sponge", "“glorp” means the sponge",
        "glorp means sponge", "by glorp I mean the sponge", "when I say glorp, I mean the sponge",
        "let's call the sponge the glorp", "call the sponge glorp",
        "remember that the glorp is the sponge",
        "glorp stands for the sponge.", "please remember: the glorp is the sponge",
        "a glorp is a sponge in our house", "glorp means the sponge, in my language",
    ],
)  # fmt: skip
def test_a_word_for_a_thing_is_learnt_and_used(clarifier, lesson):
    taught, used = talk(clarifier, lesson, "pick up the glorp")
    assert taught.do == "answer" and "glorp" in taught.reply
    assert (used.do, used.touched) == ("act", ("sponge_1",))


def test_what_was_taught_is_known_in_a_later_conversation_and_in_the_plural(
    executor, clarifier, path
):
    last(clarifier, "a glorp is a block")
    other = Clarifier(SmallTranslator(), executor, predict, IdealRobot(), Taught(path))
    assert set(last(other, "touch all the glorps").touched) == {
        "red_block_1", "green_block_1", "yellow_block_1",
    }  # fmt: skip


def test_a_meaning_is_found_on_the_scene_as_it_is_when_the_word_is_used(clarifier):
    decision = last(clarifier, "the glorp is the apple", "push the glorp to the left")
    assert (decision.do, decision.question.kind) == ("ask", "which")


@pytest.mark.parametrize(
    "answer", ["the sponge", "the sponge one please", "the glorp is the sponge"]
)
def test_an_unknown_word_is_asked_for_and_learnt_from_the_answer(clarifier, path, answer):
    asked, done = talk(clarifier, "pick up the glorp", answer)
    assert (asked.do, asked.question.kind) == ("ask", "unknown_word")
    assert (done.do, done.touched) == ("act", ("sponge_1",))
    assert "glorp" in done.echo
    assert Taught(path).words(Dialog()).things == {"glorp": "the sponge"}
    assert last(clarifier, "pick up the glorp").touched == ("sponge_1",)


def test_what_is_said_of_known_things_teaches_nothing(clarifier, path):
    for said in ("the apple is the sponge", "the bowl is red", "is the glorp the sponge?"):
        last(clarifier, said)
    assert Taught(path).words(Dialog()) == Words()


def test_a_meaning_that_names_nothing_here_is_not_learnt(clarifier, path):
    decision = last(clarifier, "glorp means the purple elephant")
    assert (decision.do, decision.reason) == ("refuse", "missing_object")
    assert Taught(path).words(Dialog()) == Words()


@pytest.mark.parametrize("word", ["put", "left", "red", "stop", "the", "push", "no"])
def test_words_of_the_language_keep_their_meaning(clarifier, path, word):
    decision = last(clarifier, f"{word} means the sponge")
    assert decision.do in ("refuse", "stop", "ask", "answer")
    assert Taught(path).words(Dialog()) == Words()


# --- deeds ---------------------------------------------------------------------------------------


def test_a_word_for_a_deed_stands_for_its_command(clarifier, path):
    taught, used = talk(clarifier, "a blorb means touch all the blocks", "do a blorb")
    assert taught.do == "answer"
    assert (used.do, len(used.touched)) == ("act", 3)
    assert last(clarifier, "blorb please").do == "act"
    assert Taught(path).words(Dialog()).deeds == {"blorb": "touch all the blocks"}


@pytest.mark.parametrize(
    ("said", "means"),
    [
        ("make a tower", "stack them by size"),
        ("Build me a tower of the blocks", "stack the blocks by size"),
        ("make a tower out of all cups, then push it", "stack all cups by size, then push it"),
        ("make the twin towers", "make the twin towers"),
        ("a glorp on the plate", "a red block on the plate"),
        ("GLORPS on the plate", "red blocks on the plate"),
    ],
)  # fmt: skip
def test_words_are_spelled_out(said, means):
    known = Words({"glorp": "the red block"}, {"tower": "stack them by size"})
    assert known.spelled_out(said) == means


# --- forgetting, asking --------------------------------------------------------------------------


@pytest.mark.parametrize("words", ["forget glorp", "forget the glorp", "Forget what glorp means!"])
def test_forgetting_is_one_sentence(clarifier, path, words):
    _, forgotten, asked = talk(clarifier, "the glorp is the sponge", words, "pick up the glorp")
    assert (forgotten.do, asked.do) == ("answer", "ask")
    assert Taught(path).words(Dialog()) == Words()


def test_forget_it_calls_off_and_forgets_no_word(clarifier):
    decision = last(clarifier, "push the apple left", "forget it")
    assert decision.do == "answer" and decision.dialog.pending is None


def test_words_are_told(clarifier):
    nothing, _, one, all_ = talk(
        clarifier, "what words have I taught you?", "the glorp is the sponge",
        "what is a glorp?", "what words do you know?",
    )  # fmt: skip
    assert "no words" in nothing.reply
    assert "the sponge" in one.reply and "glorp" in all_.reply


# --- the file ------------------------------------------------------------------------------------


def test_the_file_can_be_edited_meanwhile(clarifier, path):
    last(clarifier, "the glorp is the sponge")
    path.write_text(path.read_text().replace("the sponge", "the bottle"))
    assert last(clarifier, "pick up the glorp").touched == ("bottle_1",)


def test_a_broken_file_is_said_and_left_alone_and_nothing_else_suffers(clarifier, path):
    path.parent.mkdir()
    path.write_text("glorp = sponge")
    moved, taught = talk(clarifier, "pick up the sponge", "the glorp is the sponge")
    assert (moved.do, moved.touched) == ("act", ("sponge_1",))
    assert str(path) in moved.echo and str(path) in taught.reply
    assert path.read_text() == "glorp = sponge"


def test_a_full_book_says_so():
    taught = Taught()
    full = Dialog(taught=tuple(Lesson(f"w{number}", "the sponge") for number in range(MOST)))
    with pytest.raises(ConfigError, match="forget"):
        taught.learn(full, Lesson("one more", "the sponge"))
    changed = taught.learn(full, Lesson("w0", "the apple"))
    assert taught.words(changed).things["w0"] == "the apple"


def test_without_a_file_a_word_lives_in_its_conversation_alone(clarifier_over):
    clarifier = clarifier_over(SmallTranslator())
    assert last(clarifier, "the glorp is the sponge", "pick up the glorp").do == "act"
    assert last(clarifier, "pick up the glorp").do == "ask"


def test_quotes_and_strange_signs_survive_the_file(path):
    Taught(path).learn(Dialog(), Lesson("glorp", 'the "big" \\ block é'))
    assert Taught(path).words(Dialog()).things == {"glorp": 'the "big" \\ block é'}


def test_a_folder_that_cannot_be_written_is_an_error_that_names_it(tmp_path):
    (tmp_path / "taken").write_text("")
    with pytest.raises(ConfigError, match="taken"):
        Taught(tmp_path / "taken" / "words.toml").learn(Dialog(), Lesson("a", "the b"))


# --- reasons, and both ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words", ["why do you ask?", "Why?", "why did you ask that", "but why", "how come you ask?"]
)
def test_the_reason_of_a_question_can_be_asked_for(clarifier, words):
    asked, told, done = talk(clarifier, "push the apple left", words, "the red one")
    assert told.do == "answer" and told.reply.startswith("Because ")
    assert asked.why in told.reply
    assert done.do == "act", "the question is still open"


def test_a_reason_is_given_for_a_refusal_too(clarifier):
    refused, told = talk(clarifier, "throw the mug at me", "why not?")
    assert refused.why in told.reply


@pytest.mark.parametrize("words", ["both", "both of them", "all of them please"])
def test_both_is_an_answer(clarifier, words):
    _, decision = talk(clarifier, "lift the apple", words)
    assert set(decision.touched) == {"apple_1", "apple_2"} or decision.do == "refuse"
