"""The prelude and the expert pairs mean the same by a sentence."""

import pytest

from evals.conventions import known_pairs, meanings, rows


@pytest.mark.parametrize(("kind", "least"), [("arrange", 0.99), ("manipulate", 0.96)])
def test_what_is_meant_is_done_as_the_experts_do_it(executor, kind, least):
    found = rows(kind, executor, scenes=8)
    assert sum(one.agree for one in found) / len(found) >= least, [
        (one.pair.id, one.agree) for one in found if one.agree < 1
    ]


@pytest.mark.parametrize("kind", ["arrange", "manipulate"])
def test_no_sentence_of_the_test_split_is_among_them(kind):
    assert {pair.split for pair in known_pairs(kind)} == {"train", "valid"}
    assert len(meanings(kind)) == len(known_pairs(kind))
