"""Augmentation: nouns change places in sentence and program together, and nothing else does."""

import random

from translator.data import Sample, epoch, nouns_of, swap_nouns, with_articles
from translator.vocabulary import NOUNS

SAMPLE = Sample(
    "put an apple on the plate", "robot.move(apple.x, plate.y, apple.tall, 0)", "manipulate"
)


def test_nouns_are_listed_in_the_order_of_first_mention():
    assert nouns_of("the plate, an apple and the plate again") == ["plate", "apple"]


def test_a_noun_inside_another_word_is_not_a_noun():
    assert nouns_of("a pineapple in the cupboard") == []


def test_sentence_and_program_are_renamed_together():
    for seed in range(50):
        say, program, _ = swap_nouns(SAMPLE, random.Random(seed))
        first, second = nouns_of(say)
        assert program == f"robot.move({first}.x, {second}.y, {first}.tall, 0)"


def test_every_noun_turns_up_in_every_place():
    firsts = {nouns_of(swap_nouns(SAMPLE, random.Random(seed)).say)[0] for seed in range(300)}
    assert firsts == set(NOUNS)


def test_articles_agree_with_the_noun_behind_them():
    assert with_articles("A orange, an cup and a box") == "An orange, a cup and a box"


def test_an_epoch_holds_each_pair_as_often_as_asked():
    other = Sample("hover above the cup", "robot.move(cup.x, cup.y, 0.9, 0)", "manipulate")
    samples = epoch([SAMPLE, other], 5, random.Random(1))
    assert len(samples) == 10
    assert sum("hover" in one.say for one in samples) == 5


def test_the_same_seed_gives_the_same_epoch():
    assert epoch([SAMPLE], 9, random.Random(3)) == epoch([SAMPLE], 9, random.Random(3))
