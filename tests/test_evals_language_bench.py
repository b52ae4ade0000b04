"""How many sentences `armchat bench language` takes."""

import pytest

from evals import language_bench
from evals.cases import some
from evals.figures import at_most
from evals.language_bench import SENTENCES, SLOW_SENTENCES, language_figures


@pytest.mark.parametrize(
    ("model", "size", "most"),
    [("seq2seq", None, SENTENCES), ("pretrained", None, SLOW_SENTENCES), ("pretrained", 7, 7)],
)
def test_a_model_that_takes_long_gets_fewer_sentences(monkeypatch, model, size, most):
    class Speaking:
        def whole(self):
            return None

    Speaking.model = model
    asked = []

    def played(cases, most, what):
        asked.append((what, most))
        raise InterruptedError

    monkeypatch.setattr(language_bench, "speakers", Speaking)
    monkeypatch.setattr(language_bench, "_played", played)
    with pytest.raises(InterruptedError):
        language_figures(size)
    assert asked == [("wild", most)]


def test_at_most_so_many_are_drawn_from_all_parts_alike():
    assert some(range(100), 30) == range(0, 100, 4)
    assert list(some(range(5), 30)) == [0, 1, 2, 3, 4]
    assert some(range(100), None) == range(100)
    assert not some([], 30)


def test_a_share_has_its_standard_error():
    assert language_bench._spread(at_most(20.0, 3.0, "%", 100)).stderr == pytest.approx(4.0)
