"""Episodes: the same seed gives the same, V is as its sort says, and what is meant can be done."""

import random

import pytest

from evals.episodes import episodes
from evals.intents import Intent, Table, fitting
from scene.generate import random_scene
from scene.types import identifiers


@pytest.fixture(scope="module")
def drawn(executor):
    return list(episodes(60, 4, executor))


def test_the_same_seed_gives_the_same_episodes(drawn, executor):
    again = list(episodes(5, 4, executor))
    assert again == drawn[:5]
    assert [one.text for one in episodes(5, 5, executor)] != [one.text for one in again]


def test_v_has_as_many_outcomes_as_its_sort_says(drawn):
    for one in drawn:
        if one.sort in ("absent", "infeasible"):
            assert (one.meanings, one.meant) == ((), -1)
        elif one.sort in ("clear", "any"):
            assert one.clear
        else:
            assert one.ambiguous
        assert one.sort not in ("absent", "infeasible") or not one.ambiguous
    assert {"clear", "which", "any"} <= {one.sort for one in drawn}
    assert {"none", "one", "two", "spatial", "numeric", "follow-up"} == {o.group for o in drawn}


def test_each_meaning_fits_its_own_end_and_no_other_of_v(drawn):
    for one in drawn:
        before = one.scene if one.opening is None else one.opening[1].variants[0].after
        for number, meaning in enumerate(one.meanings):
            end = meaning.variants[0]
            assert fitting(one.meanings, before, end.after, end.commands) == [number], one.text


def test_only_some_sorts_may_be_asked_for(executor):
    found = list(episodes(8, 1, executor, ("which", "missing")))
    assert {one.sort for one in found} <= {"which", "missing"}


def test_a_meaning_that_may_not_run_has_no_variant_and_says_why(executor):
    scene = random_scene(random.Random(2), ["book", "egg"])
    book, egg = identifiers(scene)
    put = Intent("put_on(a, b)", ("on a b",), ())
    table = Table(executor)
    refused = table.meaning(put, [{"a": book, "b": egg}], scene, "manipulate", book, "")
    assert refused.variants == ()
    assert refused.refused == ("unsafe",)
    assert refused.picked == ("book_1",)
    touch = Intent("touch(a)", ("touches a", "only"), ())
    allowed = table.meaning(touch, [{"a": egg}], scene, "manipulate", egg, "")
    assert len(allowed.variants) == 1
    assert not allowed.fits(scene, scene, ())
