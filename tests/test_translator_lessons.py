"""What a model learns from: chunks that are the same every time, and batches as numbers."""

from itertools import islice

import msgspec
import numpy as np
import pytest

from translator.corpus.load import load, share_of_pairs
from translator.corpus.seed import kept, load_seeds, share_of
from translator.embed import sentence_tokenizer
from translator.lessons import (
    PADDING,
    Growth,
    Lesson,
    Packer,
    PaperLessons,
    grown,
    stream,
)
from translator.marked import SLOTS, Mark
from translator.translate import PAPER, PRODUCT, WEIGHTS
from translator.vocabulary import END, STARTS, Vocabulary

SEEDS = Vocabulary.load(PRODUCT / "vocabulary.json")
NOUNS = Vocabulary.load(PAPER / "vocabulary.json")
PAIRS = PaperLessons(("arrange", "manipulate"), copies=1, joined=0.3, seed=5)
GROWTH = Growth(PAIRS, NOUNS, WEIGHTS, 16)


def packer(size: int = 2) -> Packer:
    return Packer(sentence_tokenizer(WEIGHTS), SEEDS, size)


def test_a_chunk_is_the_same_every_time_and_unlike_the_next():
    assert PAIRS.chunk(3) == PAIRS.chunk(3) != PAIRS.chunk(4)


def test_other_processes_grow_what_a_thread_grows():
    beside, here = (list(islice(stream(GROWTH, growers), 2)) for growers in (1, 0))
    for one, other in zip(beside, here, strict=True):
        assert all(
            np.array_equal(mine, theirs)
            for a, b in zip(one, other, strict=True)
            for mine, theirs in zip(a, b, strict=True)
        )


def test_a_chunk_of_pairs_holds_every_one_of_the_training_split():
    assert sum(len(batch.ids) for batch in grown(GROWTH, 0)) == 102 + 122


def test_a_batch_says_words_slots_and_program_in_numbers():
    say = "put the block on the block"
    marks = (Mark(8, 13, "m1"), Mark(21, 26, "m2"))
    (batch,) = packer()([Lesson(say, marks, "put_on(m1, m2)", "manipulate")])
    assert batch.ids.shape == batch.slots.shape == (1, 8)
    assert batch.slots[0].tolist() == [0, 0, 0, SLOTS.index("m1") + 1, 0, 0,
                                       SLOTS.index("m2") + 1, 0]  # fmt: skip
    assert batch.lengths.tolist() == [8]
    inputs, targets = batch.inputs[0], batch.targets[0]
    assert inputs[0] == SEEDS.symbol(STARTS["manipulate"])
    assert targets[-1] == SEEDS.symbol(END)
    assert inputs[1:].tolist() == targets[:-1].tolist()
    assert "".join(SEEDS.decode(inputs[1:].tolist())).startswith("put_on(m1,m2)")


def test_shorter_lessons_are_padded_where_the_loss_does_not_look():
    short = Lesson("lift the block", (Mark(9, 14, "m1"),), "pick(m1)", "manipulate")
    long = Lesson("put the block on the block", (Mark(8, 13, "m1"), Mark(21, 26, "m2")),
                  "put_on(m1, m2)", "manipulate")  # fmt: skip
    (batch,) = packer()([long, short])
    row = int(batch.lengths.argmin())
    beyond = batch.lengths[row]
    assert not batch.ids[row, beyond:].any()
    assert (batch.targets[row] == PADDING).any()
    assert not (batch.targets[1 - row] == PADDING).any()


def test_a_program_that_the_vocabulary_cannot_say_is_left_out():
    strange = Lesson("sing", (), "sing_aloud()", "manipulate")
    plain = Lesson("lift the block", (Mark(9, 14, "m1"),), "pick(m1)", "manipulate")
    (batch,) = packer()([strange, plain])
    assert len(batch.ids) == 1


@pytest.mark.parametrize("share", [0.1, 0.5])
def test_a_share_of_the_wordings_keeps_the_first_of_each_seed(share):
    seeds = kept(load_seeds(), held_out=False)
    some = share_of(seeds, share)
    assert [one.say[0] for one in some] == [one.say[0] for one in seeds]
    rest, all_of_it = (sum(len(one.say) - 1 for one in them) for them in (some, seeds))
    assert rest / all_of_it == pytest.approx(share, abs=0.02)
    assert share_of(seeds, 1.0) == seeds


@pytest.mark.parametrize(("share", "arrange", "manipulate"), [(0.1, 10, 12), (0.3, 31, 37)])
def test_a_share_of_the_pairs_takes_it_of_each_task_and_every_valid_one(share, arrange, manipulate):
    few = msgspec.structs.replace(PAIRS, wordings=share)
    kinds = [lesson.kind for lesson in few.chunk(0)]
    assert (kinds.count("arrange"), kinds.count("manipulate")) == (arrange, manipulate)
    assert few.valid() == PAIRS.valid()


def test_a_smaller_share_of_the_pairs_lies_within_a_larger_one():
    pairs = [pair for pair in load("manipulate") if pair.split == "train"]
    tenth, third = share_of_pairs(pairs, 0.1), share_of_pairs(pairs, 0.3)
    assert set(tenth) < set(third) < set(pairs)
    assert [pair for pair in pairs if pair in third] == list(third)
    assert share_of_pairs(pairs, 1.0) == tuple(pairs)


def test_one_pair_alone_is_joined_with_nothing_that_is_not_there():
    few = msgspec.structs.replace(PAIRS, tasks=("arrange",), copies=9, joined=1.0, wordings=0.001)
    assert len(few.chunk(0)) == 9


def test_valid_wordings_are_never_learnt():
    held, learnt = ({(seed.id, say) for seed in kept(load_seeds(), held_out=which)
                     for say in seed.say} for which in (True, False))  # fmt: skip
    assert len(held) > 1000
    assert not held & learnt
