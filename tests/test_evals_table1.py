"""Table 1 over several training runs: means over seeds, errors over sentences, spread between."""

import pytest

from agent.cli import main
from agent.errors import ConfigError
from evals.paper_metric import Score, deviation
from evals.seeds import LAST_FILE, train_seeds
from evals.table1 import MODEL_FILE, Row, _table, folders, over_seeds


def test_seeds_are_averaged_sentence_by_sentence_so_that_the_error_is_over_sentences():
    mean = over_seeds([Score((1.0, 0.0), 0.0), Score((0.5, 0.5), 0.5)])
    assert mean.per_sentence == (0.75, 0.25)
    assert (mean.accuracy, mean.malformed) == (0.5, 0.25)
    assert mean.standard_error == pytest.approx(0.25)


def test_the_spread_is_that_of_a_sample():
    assert deviation([1.0, 2.0, 3.0]) == pytest.approx(1.0)
    assert deviation([1.0]) == 0.0


def test_a_folder_is_a_run_or_holds_one_for_each_seed(tmp_path):
    for name in ("one", "many/seed0", "many/seed1"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / MODEL_FILE).touch()
    given = [str(tmp_path / "one"), str(tmp_path / "many"), "bundled"]
    bundled = tmp_path / "one"
    found = [str(one.relative_to(tmp_path)) for one in folders(given, bundled, MODEL_FILE)]
    assert found == ["one", "many/seed0", "many/seed1", "one"]


def test_a_folder_without_a_model_is_a_usage_error_that_names_it(tmp_path, capsys):
    with pytest.raises(ConfigError, match=str(tmp_path)):
        folders([str(tmp_path)], tmp_path, MODEL_FILE)
    assert main(["reproduce", "table1", "--weights", str(tmp_path)]) == 2
    assert str(tmp_path) in capsys.readouterr().err


def test_what_was_not_measured_is_not_a_number():
    one_seed = Row(task="arrange", model="seq2seq", paper=80.8, ours=50.0, stderr=9.0, n=11,
                   seeds=1, scenes=20)  # fmt: skip
    untold = Row(task="arrange", model="baseline", paper=14.2, n=11, seeds=1, scenes=20, why="no")
    lines = _table([one_seed, untold]).splitlines()
    assert lines[1].split()[2:] == ["80.8", "50.0", "9.0", "-", "-", "11", "1", "20"]
    assert "not measured: no" in lines[2]


def test_outcomes_are_said_in_words():
    row = Row(task="wild", model="product", paper=None, ours=61.8, wrong=3.6, stderr=2.7, n=330,
              seeds=1, scenes=1)  # fmt: skip
    assert "61.8 % right or rightly asked, 3.6 % wrong" in _table([row])


class Trainer:
    """Writes the files that a training leaves behind, and keeps who was trained."""

    def __init__(self, *files: str) -> None:
        self.files = files
        self.trained: list[tuple[str, int]] = []

    def __call__(self, folder, seed):
        self.trained.append((folder.name, seed))
        for name in self.files:
            (folder / name).touch()


def trainers():
    baselines = ("baseline_arrange.safetensors", "baseline_manipulate.safetensors")
    return Trainer(MODEL_FILE, LAST_FILE), Trainer(*baselines)


def test_every_seed_trains_the_model_and_the_baselines_in_a_folder_of_its_own(tmp_path):
    model, baselines = trainers()
    assert train_seeds(tmp_path, 2, model, baselines) == [tmp_path / "seed0", tmp_path / "seed1"]
    assert model.trained == baselines.trained == [("seed0", 0), ("seed1", 1)]


def test_what_is_trained_already_is_not_trained_again(tmp_path):
    train_seeds(tmp_path, 1, *trainers())
    model, baselines = trainers()
    (tmp_path / "seed0" / "baseline_manipulate.safetensors").unlink()
    train_seeds(tmp_path, 2, model, baselines)
    assert model.trained == [("seed1", 1)]
    assert baselines.trained == [("seed0", 0), ("seed1", 1)]


def test_a_model_whose_training_was_cut_short_is_trained_again(tmp_path):
    train_seeds(tmp_path, 1, *trainers())
    (tmp_path / "seed0" / LAST_FILE).unlink()
    model, baselines = trainers()
    train_seeds(tmp_path, 1, model, baselines)
    assert (model.trained, baselines.trained) == ([("seed0", 0)], [])
