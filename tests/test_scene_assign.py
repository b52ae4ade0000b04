"""The assignment is the cheapest there is, by comparison with all there are."""

import itertools

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from scene.assign import assign

COSTS = st.floats(0, 10).map(lambda cost: round(cost, 3)) | st.just(float("inf"))
SHAPES = st.tuples(st.integers(0, 5), st.integers(0, 5))


def total(costs, alone, columns):
    pairs = enumerate(columns)
    return sum(alone if column is None else costs[row, column] for row, column in pairs)


def every(rows, columns):
    for chosen in itertools.product([None, *range(columns)], repeat=rows):
        taken = [column for column in chosen if column is not None]
        if len(set(taken)) == len(taken):
            yield chosen


@given(SHAPES.flatmap(lambda shape: arrays(np.float64, shape, elements=COSTS)), st.floats(0.1, 9))
def test_nothing_is_cheaper(costs, alone):
    got = assign(costs, alone)
    taken = [column for column in got if column is not None]
    assert len(set(taken)) == len(taken)
    best = min(total(costs, alone, chosen) for chosen in every(*costs.shape))
    assert abs(total(costs, alone, got) - best) < 1e-9


def test_a_forbidden_pair_is_never_made():
    assert assign(np.array([[np.inf]]), alone=1e6) == [None]


def test_a_row_gives_way_where_that_helps_another():
    assert assign(np.array([[1.0, 2.0], [1.5, 9.0]]), alone=20.0) == [1, 0]
