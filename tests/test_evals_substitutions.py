"""Other words for the same: which sentences change, how, and what is said to have changed."""

import pytest

from evals.paper_metric import request_of
from evals.substitutions import about, attempt, changes
from translator.corpus.load import Pair, load
from translator.translate import PRODUCT, Translator

PAIRS = {pair.id: pair for kind in ("arrange", "manipulate") for pair in load(kind)}
TEST = [pair for pair in PAIRS.values() if pair.split == "test"]


def said(pair: Pair, test: str) -> list[tuple[str, str]]:
    return [(one.before.say, one.after.say) for one in changes([pair]) if one.test == test]


@pytest.mark.parametrize("verb", ["keep", "place", "put down"])
def test_a_verb_of_placing_is_put_and_then_another(verb):
    assert said(PAIRS["m136"], f"put: {verb}") == [
        ("put the lemon beside the plate", f"{verb} the lemon beside the plate")
    ]


def test_a_sentence_without_such_a_verb_is_not_counted():
    assert said(PAIRS["m138"], "put: keep") == []


def test_every_the_is_dropped():
    assert said(PAIRS["m136"], "the: dropped") == [(PAIRS["m136"].say, "leave lemon beside plate")]


def test_the_words_of_a_corner_change_places():
    assert said(PAIRS["m137"], "top right: right-top") == [
        (PAIRS["m137"].say, "how about the plate in the left-bottom corner")
    ]


def test_a_pair_without_a_bottle_gets_one_in_sentence_and_program():
    bottle = about(PAIRS["m138"], "bottle")
    assert bottle.say == "bulldoze the bottle over the left hand edge"
    assert "bottle.x" in bottle.program
    assert "sponge" not in bottle.program
    assert about(PAIRS["m142"], "bottle") is PAIRS["m142"]


def test_another_word_that_is_linked_is_the_slot_that_the_bottle_was():
    before, after = (request_of(pair, words={"flask": "bottle"})
                     for pair in (PAIRS["m143"], _renamed(PAIRS["m143"])))  # fmt: skip
    assert before[1] == after[1]
    assert [one.slot for one in before[0].mentions] == [one.slot for one in after[0].mentions]


def _renamed(pair: Pair) -> Pair:
    return next(one.after for one in changes([pair]) if one.test == "bottle: flask, linked")


def test_every_test_sentence_is_tried_with_every_object_word():
    tests = [one.test for one in changes(TEST)]
    for word in ("bottle: flask", "bottle: pitcher", "cup: chalice"):
        assert tests.count(f"{word}, read") == tests.count(f"{word}, linked") == len(TEST) == 23


def test_the_product_never_reads_names_so_a_linked_one_changes_nothing(executor):
    product = Translator(PRODUCT)
    linked = [one for one in changes([PAIRS["m142"]]) if one.test.endswith("linked")]
    assert len(linked) == 3
    for change in linked:
        trial = attempt(change, product, executor, 3)
        assert (trial.changed, trial.otherwise) == (False, False)
        assert trial.before == trial.after
