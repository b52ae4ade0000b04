"""Things learnt by being shown: nearest in feature space, or none; kept and forgotten."""

import numpy as np
import pytest

from agent.errors import ConfigError, SceneError
from scene.shown import MOST, NEAR, ShownStore, forgotten, learnt, named, nearest
from scene.sight import Detection


def view(*feature, name="other"):
    unit = np.array(feature, np.float32)
    return Detection(name, 0.9, 0.1, 0.2, 0.01, 0.3, 0.3, 0.3, 0.0, "red",
                     unit / np.linalg.norm(unit))  # fmt: skip


def test_what_looks_like_something_shown_goes_by_its_name():
    known = learnt(learnt((), "my mug", [view(1, 0, 0)]), "the duck", [view(0, 1, 0.1)])
    assert nearest(known, view(0.98, 0.05, 0).feature)[0] == "my mug"
    seen = named(known, [view(0.05, 1, 0), view(0, 0, 1), view(1, 0.01, 0, name="cup")])
    assert [one.name for one in seen] == ["the duck", "other", "my mug"]
    assert seen[0].x == 0.1


def test_what_is_further_than_the_rejection_distance_keeps_its_name():
    known = learnt((), "mug", [view(1, 0)])
    angle = 2 * np.arcsin(NEAR / 2)
    inside, outside = (view(np.cos(a), np.sin(a)) for a in (angle - 0.01, angle + 0.01))
    assert nearest(known, inside.feature)[1] == pytest.approx(NEAR, abs=0.02)
    assert nearest(known, outside.feature) is None


def test_more_views_of_a_thing_are_added_and_the_oldest_go():
    known = learnt((), "mug", [view(1, n) for n in range(MOST)])
    known = learnt(known, "mug", [view(-1, 0)])
    assert len(known) == 1
    assert len(known[0].features) == MOST
    assert known[0].features[-1] == (-1.0, 0.0)


@pytest.mark.parametrize(("name", "views"), [("", [view(1, 0)]), ("mug", []), ("a", [view(1)])])
def test_what_cannot_be_learnt_is_said(name, views):
    known = learnt((), "old", [view(1, 0)])
    with pytest.raises(SceneError):
        learnt(known, name, views)


def test_a_store_keeps_what_it_learnt_and_forgets_by_one_call(tmp_path):
    store = ShownStore(tmp_path / "data")
    assert store.load() == ()
    store.learn("mug", [view(1, 0)])
    store.learn("duck", [view(0, 1)])
    assert [one.name for one in ShownStore(tmp_path / "data").load()] == ["mug", "duck"]
    store.forget("mug")
    assert [one.name for one in store.load()] == ["duck"]
    with pytest.raises(SceneError, match="mug"):
        store.forget("mug")
    with pytest.raises(SceneError):
        forgotten((), "x")


def test_a_damaged_store_names_its_file(tmp_path):
    store = ShownStore(tmp_path)
    store.path.write_text("[{")
    with pytest.raises(ConfigError, match=r"shown\.json"):
        store.load()


def test_features_of_other_weights_match_nothing():
    known = learnt((), "mug", [view(1, 0)])
    assert nearest(known, view(1, 0, 0).feature) is None
