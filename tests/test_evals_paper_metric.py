"""The paper's metric: what counts as right, and how shares become a score."""

import math

import pytest

from agent.messages import Candidate, TranslateRequest, Translation
from evals.paper_metric import Score, alike, request_of, score, seq2seq
from translator.corpus.load import Pair, load

LIFT = next(pair for pair in load("manipulate") if pair.say == "pick up the apple")
CORNER = load("arrange")[0]


def speaks(body: str):
    """A translator that always answers with one program."""

    def translate(request: TranslateRequest) -> Translation:
        return Translation((Candidate(body, 0.0, 1),), 1.0, 0.0)

    return translate


def slotted(pair: Pair, noun: str) -> str:
    return pair.program.replace(noun, "m1")


@pytest.mark.parametrize(
    ("predicted", "true", "right"),
    [
        (((0.0, 0.0),), ((0.19, -0.19),), True),
        (((0.0, 0.0),), ((0.21, 0.0),), False),
        (((0.0, 0.0), (1.0, 1.0)), ((0.0, 0.0),), False),
        (((0.0, 0.0, 0.5, 4.0),), ((0.0, 0.0, 0.5, 0.0),), False),
        (((math.inf, math.inf),), ((math.inf, math.inf),), True),
        (((math.inf, math.inf),), ((0.0, 0.0),), False),
    ],
)
def test_right_is_within_a_tenth_of_the_table_at_every_step_on_every_axis(predicted, true, right):
    assert alike(predicted, true) is right


@pytest.mark.parametrize(("pair", "noun"), [(LIFT, "apple"), (CORNER, "apple")])
def test_the_true_program_scores_one(executor, pair, noun):
    found = score([pair], seq2seq(speaks(slotted(pair, noun)), executor), executor, 5)
    assert (found.accuracy, found.malformed) == (1.0, 0.0)


def test_another_program_scores_nothing(executor):
    other = "robot.move(m1.x, m1.y, m1.z + m1.tall, 0)"
    assert score([LIFT], seq2seq(speaks(other), executor), executor, 5).accuracy == 0.0


@pytest.mark.parametrize("body", ["robot.move(", "x = 1 / 0", "robot.move(m9.x, 0, 0, 0)"])
def test_a_program_that_does_not_run_is_malformed(executor, body):
    assert score([LIFT], seq2seq(speaks(body), executor), executor, 5).malformed == 1.0


def test_the_standard_error_is_over_sentences():
    found = Score((1.0, 0.0, 1.0, 0.0), 0.0)
    assert found.accuracy == 0.5
    assert found.standard_error == pytest.approx(math.sqrt(1 / 3 / 4))


def test_every_mention_of_a_noun_is_linked_to_one_slot():
    pair = next(p for p in load("manipulate") if p.say.count("cup") > 1)
    request, nouns = request_of(pair)
    for mention in request.mentions:
        assert pair.say[mention.start : mention.end] == nouns[mention.slot]
