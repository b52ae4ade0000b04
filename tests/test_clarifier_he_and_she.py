"""Things spoken of as if they were alive, and people who are none."""

import pytest
from clarifier_table import LEXICON, TABLE

from clarifier.he_and_she import as_it, without_question
from clarifier.preamble import to_the_point


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("My bottle looks lonely, set him beside the bowl",
         "My bottle looks lonely, set it beside the bowl"),
        ("The sponge is done, push her to the left", "The sponge is done, push it to the left"),
        ("the bottle is tired, she has to lie in the bowl",
         "the bottle is tired, it has to lie in the bowl"),
    ],
)  # fmt: skip
def test_who_was_named_before_is_it(text, plain):
    assert as_it(text, TABLE, (), LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "push him to the left", "take the bottle and poke him", "bring the sponge to her",
        "The bottle is hard, hit him with it", "My brother wants the sponge, push him a bit",
        "put the mug next to her plate", "the sponge is wet, give her the mug",
        "my daughter came, he has to sit down",
    ],
)  # fmt: skip
def test_people_stay_people(text):
    assert as_it(text, TABLE, (), LEXICON) == text


@pytest.mark.parametrize(
    ("text", "deed"),
    [
        ("where's the sponge? put it in the bowl", "put the sponge in the bowl"),
        ("hey, do you see the bottle?? Lift it", "Lift the bottle"),
    ],
)
def test_a_question_before_a_deed_names_what_it_is_done_to(text, deed):
    assert without_question(text, TABLE, (), LEXICON) == deed


@pytest.mark.parametrize(
    "text",
    [
        "where is the bottle? and where is the sponge?", "where's the sponge?",
        "where is the apple? put the bottle on it", "where's the unicorn? put it in the bowl",
    ],
)  # fmt: skip
def test_other_questions_stay(text):
    assert without_question(text, TABLE, (), LEXICON) == text


def test_what_a_thing_does_is_only_told():
    assert to_the_point("That bottle leaks. Put it in the bowl", TABLE, (), LEXICON) == (
        "Put That bottle in the bowl"
    )
    kept = "the sponge goes in the bowl. Put it there"
    assert to_the_point(kept, TABLE, (), LEXICON) == kept
