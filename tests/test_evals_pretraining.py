"""Pre-training, with and without: both arms learn alike, and the table says what the logs say."""

import msgspec
import pytest

pytest.importorskip("torch")

from evals import pretraining
from evals.pretraining import Line, course, measured, table, trained
from evals.tally import share
from translator.train import LOG, Epoch
from translator.vocabulary import build_vocabulary

LOGGED = [Epoch(1, 1.5, 0.6, 0.25, 9.0), Epoch(2, 0.5, 0.4, 0.5, 9.0), Epoch(3, 0.2, 0.1, 1.0, 9.0)]


def logged(folder, count=3):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / LOG).write_bytes(b"".join(msgspec.json.encode(one) + b"\n" for one in LOGGED[:count]))


@pytest.fixture
def fake(monkeypatch):
    """Training that writes a log alone; what it was asked for."""
    asked = {}

    def train(config, folder):
        asked[folder.name] = config
        logged(folder, config.epochs)
        build_vocabulary(["move(m1)"], [], 0, "skills").save(folder / "vocabulary.json")

    monkeypatch.setattr(pretraining, "train", train)
    return asked


def test_the_rate_halves_from_epoch_to_epoch():
    for epochs in (1, 3):
        config = course("seeds", 4, epochs)
        assert config.final_rate * 2 ** (epochs - 1) == pytest.approx(config.learning_rate)
        assert (config.seed, config.epochs) == (4, epochs)
    assert course("paper", 0, 2).corpus == "paper"


def test_both_arms_learn_the_same_but_for_where_they_start(tmp_path, fake):
    list(measured(tmp_path, "paper", 5, 2))
    plain, after = fake["paper-plain-5"], fake["paper-docstrings-5"]
    assert after.start == str(tmp_path / "docstrings")
    assert after.vocabulary == str(tmp_path / "paper-plain-5")
    assert plain == msgspec.structs.replace(after, start=None, vocabulary=None)
    assert fake["docstrings"].corpus == "docstrings"


def test_what_is_trained_already_is_not_trained_again(tmp_path, fake):
    config = course("paper", 0, 2)
    logged(tmp_path, count=1)
    assert len(trained(config, tmp_path)) == 2
    assert fake.pop(tmp_path.name) == config
    logged(tmp_path, count=3)
    assert trained(config, tmp_path) == LOGGED[:2]
    assert not fake


def test_the_table_has_a_row_for_each_line():
    line = Line("seeds", 1, 24000, (0.6, 0.25), (share(100, 400), share(200, 400)))
    row = table([line]).splitlines()[-1]
    assert row == "| seeds | 1 | 24,000 | 400 | 0.600 | 25.0 ± 2.2 | 0.250 | 50.0 ± 2.5 |"
