"""Sentences of several phrases: how they are made, and the ways in which they are read."""

import random

from agent.messages import Candidate, TranslateRequest, Translation
from evals.phrases import crowded, measure, program_of, right_alone, sentences, together
from translator.corpus.load import Pair, load
from translator.data import nouns_of

TEST = {kind: [pair for pair in load(kind) if pair.split == "test"]
        for kind in ("arrange", "manipulate")}  # fmt: skip
SIMPLE = TEST["manipulate"][2:5]


class Echo:
    """A translator that keeps the sentences it gets, and always writes the same line."""

    def __init__(self) -> None:
        self.heard: list[str] = []

    def __call__(self, request: TranslateRequest) -> Translation:
        self.heard.append(request.text)
        body = f"robot.move(0, 0, 1.{len(self.heard)}, 0)"
        return Translation((Candidate(body, 0.0, 1),), 1.0, 0.0)


def pair(say: str, program: str = "robot.move(0, 0, 1, 0)") -> Pair:
    return Pair(id=say, split="test", family="", say=say, program=program, after=(),
                kind="manipulate")  # fmt: skip


def test_joined_pairs_speak_of_different_things_and_their_programs_follow_each_other():
    whole, clauses = together(SIMPLE, random.Random(1))
    nouns = [noun for one in clauses for noun in nouns_of(f"{one.say} {one.program}")]
    assert len(nouns) == len(set(nouns)) == 3
    assert whole.say == ", ".join(one.say for one in clauses)
    assert whole.program == "\n".join(one.program for one in clauses)


def test_a_single_pair_is_the_test_sentence_itself():
    assert together(SIMPLE[:1], random.Random(1)) == (SIMPLE[0], (SIMPLE[0],))


def test_every_pair_leads_one_sentence_and_the_sentences_are_always_the_same(executor):
    made = sentences(SIMPLE, 2, executor, 2)
    assert len(made) == len(SIMPLE)
    assert all(lead.id in one.pair.id for lead, one in zip(SIMPLE, made, strict=True))
    assert [one.pair for one in made] == [one.pair for one in sentences(SIMPLE, 2, executor, 2)]


def test_two_pairs_that_want_one_place_are_not_joined(executor):
    middle = [one for one in TEST["arrange"] if one.id in ("a117", "a123")]
    assert sentences(middle, 2, executor, 2) == []


def test_what_one_pair_puts_into_one_place_is_its_own_affair(executor):
    alone = sentences([TEST["arrange"][5]], 1, executor, 2)[0]
    assert not crowded(alone)


def test_whole_split_and_at_every_comma(executor):
    one, other = pair("take the cup, then the box"), pair("touch the can")
    joined = next(iter(sentences([one, other], 2, executor, 1)))
    heard = {}
    for way in ("whole", "split", "commas"):
        echo = Echo()
        program_of(joined, way, echo)
        heard[way] = [text.split()[0] for text in echo.heard]
    assert heard["whole"] == [joined.pair.say.split()[0]]
    assert sorted(heard["split"]) == ["take", "touch"]
    assert sorted(heard["commas"]) == ["take", "then", "touch"]


def test_split_programs_stand_one_after_the_other_in_the_order_of_the_clauses(executor):
    joined = sentences(SIMPLE, 2, executor, 1)[0]
    lines = ["robot.move(0, 0, 1.1, 0)", "robot.move(0, 0, 1.2, 0)"]
    assert program_of(joined, "split", Echo()) == "\n".join(lines)


def test_a_clause_without_a_program_leaves_the_sentence_without_one(executor):
    joined = sentences(SIMPLE, 2, executor, 1)[0]
    silent = Translation((), 0.0, 0.0)
    assert program_of(joined, "split", lambda request: silent) is None
    assert measure([joined], "split", lambda request: silent, executor).accuracy == 0.0


def test_there_is_no_sentence_of_more_phrases_than_there_are_pairs(executor):
    assert sentences(SIMPLE, len(SIMPLE) + 1, executor, 1) == []


def test_known_pairs_are_those_that_a_model_does_right_alone(executor):
    one = pair("touch the cup", "robot.move(0, 0, 1.1, 0)")
    other = pair("take the box", "robot.move(0, 0, 0.5, 0)")
    assert right_alone([one, other], Echo(), executor, 2) == [one]
