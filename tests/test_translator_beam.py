"""How far a beam search follows what is not the best so far, and that it loses nothing by it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from translator.beam import FAR, worth_following
from translator.grammar import REMEMBERED, Grammar
from translator.networks import Ensemble
from translator.translate import PRODUCT
from translator.vocabulary import Vocabulary


def test_before_anything_is_finished_everything_is_followed():
    assert worth_following([], 4) == -math.inf


def test_what_may_still_come_near_the_best_is_followed_while_there_is_room():
    assert worth_following([-1.0], 2) == -1.0 - FAR
    assert worth_following([-3.0, -1.0], 4) == -1.0 - FAR


def test_what_cannot_enter_the_best_is_not_followed():
    assert worth_following([-3.0, -1.0], 2) == -3.0
    assert worth_following([-3.0, -1.0, -30.0], 3) == -1.0 - FAR


@pytest.fixture(scope="module")
def grammar() -> Grammar:
    return Grammar(Vocabulary.load(PRODUCT / "vocabulary.json"))


def test_what_is_remembered_of_a_prefix_is_what_the_grammar_says(grammar):
    fresh = Grammar(Vocabulary.load(PRODUCT / "vocabulary.json"))
    prefix = grammar.start()
    pieces = np.flatnonzero(grammar.usable("manipulate", {"m1", "m2"}))
    for _ in range(12):
        first = [grammar.extend(prefix, int(piece)) for piece in pieces]
        assert first == [grammar.extend(prefix, int(piece)) for piece in pieces]
        assert first == [fresh.extend(prefix, int(piece)) for piece in pieces]
        prefix = [one for one in first if one is not None][-1]


def test_no_more_prefixes_are_remembered_than_said(grammar):
    prefix = grammar.start()
    for number in range(REMEMBERED + 10):
        grammar.extend(prefix._replace(lists=number), 0)
    assert len(grammar._ways) <= REMEMBERED


def test_networks_side_by_side_say_the_mean_of_what_each_says():
    both = Ensemble(PRODUCT)
    alone = [Ensemble(PRODUCT / name) for name in ("lstm", "transformer")]
    rng = np.random.default_rng(0)
    words, slots = rng.normal(size=(9, 384)).astype(np.float32), np.zeros(9, np.int64)
    token = np.array([5])
    mixed, _, states = both.step(token, both.begin(words, slots))
    each = [np.exp(one.step(token, one.begin(words, slots))[0]) for one in alone]
    assert np.exp(mixed) == pytest.approx(np.mean(each, axis=0), abs=1e-6)
    kept = both.kept(states, [0, 0, 0])
    again, _, _ = both.step(np.array([7, 7, 7]), kept)
    assert again.shape[0] == 3
    assert np.array_equal(again[0], again[2])
