"""The simulated person answers truthfully, in each style, and says no to what is not meant."""

import random

import pytest
from clarifier_table import thing

from agent.messages import Option, Pending, Question, Turn
from clarifier.answer import read_answer
from clarifier.lexicon import load_lexicon
from evals.episodes import Episode
from evals.intents import Intent, Table
from evals.simulated_user import NO, STYLES, USELESS, YES, Person
from scene.types import Scene

SCENE = Scene(
    objects=(
        thing("apple", -0.6, 0.1, "red"),
        thing("apple", 0.5, 0.1, "green", number=2),
        thing("plate", 0.75, 0.4, size=0.2),
    )
)
WHICH = Question(
    "which", "Which apple do you mean?",
    tuple(Option(f"the {color} apple", (f"apple_{n}",), None, f"touch(apple_{n})", "manipulate",
                 (f"apple_{n}",)) for n, color in ((1, "red"), (2, "green"))),
)  # fmt: skip


@pytest.fixture(scope="module")
def table(executor):
    return Table(executor)


def person(table, style="full", noise=0.0, seed=1) -> Person:
    """Somebody who wants the green apple touched."""
    touch = Intent("touch(a)", ("touches a", "only"), ())
    meanings = tuple(
        table.meaning(touch, [{"a": name}], SCENE, "manipulate", name, f"touch the {color} apple")
        for name, color in (("apple_1", "red"), ("apple_2", "green"))
    )
    episode = Episode(
        "x", "one", "which", SCENE, "manipulate", "touch the apple", meanings, 1
    )  # fmt: skip
    return Person(episode, table, random.Random(seed), style, noise)


def asked(question: Question) -> Turn:
    return Turn(say="touch the apple", status="asked", reply=question.text, question=question)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_every_style_means_the_thing_that_is_meant(table, style, seed):
    answer = person(table, style, seed=seed).answer(asked(WHICH), SCENE)
    read = read_answer(answer.replace("aplpe", "apple"), Pending("x", WHICH), SCENE, load_lexicon())
    assert (style == "typo") or (read.kind, read.index) == ("pick", 1), answer


def test_there_are_ten_styles_and_they_differ(table):
    said = {person(table, style).answer(asked(WHICH), SCENE) for style in STYLES}
    assert len(STYLES) == 10
    assert len(said) >= 8


def test_a_single_option_is_agreed_to_only_if_it_is_meant(table):
    for number, words in ((1, YES), (0, NO)):
        one = WHICH.options[number]
        question = Question("confirm", "Shall I?", (one,))
        assert person(table).answer(asked(question), SCENE) in words


def test_an_open_question_and_a_refusal_are_answered_by_the_whole_command(table):
    lost = Turn(say="x", status="refused", reply="What?", reason="not_understood")
    unsafe = Turn(say="x", status="refused", reply="No.", reason="unsafe")
    assert person(table).answer(asked(Question("open", "What?")), SCENE) == "touch the green apple"
    assert person(table).answer(lost, SCENE) == "touch the green apple"
    assert person(table).answer(unsafe, SCENE) is None


def test_noise_is_said_once(table):
    somebody = person(table, noise=1.0)
    assert somebody.answer(asked(WHICH), SCENE) in USELESS
    assert somebody.answer(asked(WHICH), SCENE) not in USELESS


def test_of_two_that_meet_what_must_hold_the_one_that_ends_as_meant_is_taken(table):
    """ "Put the biggest apple on the plate" holds of both plates; only one of them is meant."""
    scene = Scene(objects=(*SCENE.objects[:2], thing("plate", 0.7, 0.5, size=0.2),
                           thing("plate", -0.7, 0.6, size=0.2, number=2)))  # fmt: skip
    put = Intent("put_on(b, a)", ("touches b",), ())
    meanings = tuple(
        table.meaning(
            put, [{"a": name, "b": "apple_1"}], scene, "manipulate", name, f"put it on {name}"
        )
        for name in ("plate_1", "plate_2")
    )
    episode = Episode("x", "one", "which", scene, "manipulate", "put it there", meanings, 1)
    someone = Person(episode, table, random.Random(1), "number")
    options = tuple(
        Option(f"the {side} plate", (name,), None, f"put_on(apple_1, {name})", "manipulate",
               ("apple_1", name)) for side, name in (("right", "plate_1"), ("left", "plate_2"))
    )  # fmt: skip
    assert meanings[1].fits(scene, meanings[0].variants[0].after, meanings[0].variants[0].commands)
    assert someone.chosen(Question("which", "Which plate?", options), scene) == 1
    assert [someone.comes_to(option, scene) for option in options] == [[0], [1]]
