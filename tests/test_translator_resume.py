"""A training run that was cut short goes on, and ends as if it had not been."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import pytest

from agent.errors import ConfigError
from translator.course import TrainConfig

torch = pytest.importorskip("torch")

from safetensors import safe_open  # noqa: E402
from safetensors.torch import load_file, save_file  # noqa: E402

from translator import train as training  # noqa: E402
from translator.resume import FILE  # noqa: E402
from translator.train import train  # noqa: E402

SMALL = TrainConfig(
    width=12, token_size=5, epochs=3, copies=1, joined=0.2, dropout=0.3, threads=1, warmup=20
)  # fmt: skip


class Cut(Exception):
    """What ends a run."""


def cut_short(monkeypatch: pytest.MonkeyPatch, out: Path, epoch: int) -> None:
    """Train until an epoch is learnt but not yet written down."""
    evaluate, calls = training.evaluate, iter(range(1, 100))

    def stops(*given):
        if next(calls) == epoch:
            raise Cut
        return evaluate(*given)

    with monkeypatch.context() as patched, pytest.raises(Cut):
        patched.setattr(training, "evaluate", stops)
        train(SMALL, out)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A run that was not cut short."""
    return train(SMALL, tmp_path_factory.mktemp("whole")).state_dict()


@pytest.mark.parametrize("epoch", [1, 2, 3])
def test_it_ends_with_the_same_weights(whole, monkeypatch, tmp_path, epoch):
    cut_short(monkeypatch, tmp_path, epoch)
    assert (tmp_path / FILE).is_file() == (epoch > 1)
    again = train(SMALL, tmp_path).state_dict()
    assert all(torch.equal(whole[name], again[name]) for name in whole)
    log = [json.loads(line)["epoch"] for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    assert log == [1, 2, 3]
    assert not (tmp_path / FILE).exists()


def test_a_run_of_another_configuration_is_not_touched(monkeypatch, tmp_path):
    cut_short(monkeypatch, tmp_path, 2)
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir()}
    with pytest.raises(ConfigError, match=rf"cut short after epoch 1; .*delete .*{FILE}"):
        train(msgspec.structs.replace(SMALL, seed=1), tmp_path)
    assert before == {file.name: file.read_bytes() for file in tmp_path.iterdir()}


def test_what_cannot_be_read_is_named(tmp_path):
    (tmp_path / FILE).write_bytes(b"nothing of the kind")
    with pytest.raises(ConfigError, match=f"{FILE}: cannot be read"):
        train(SMALL, tmp_path)


def test_the_time_that_was_used_counts(monkeypatch, tmp_path):
    """What may take so many minutes takes no more for having been cut short."""
    cut_short(monkeypatch, tmp_path, 3)
    timed = msgspec.structs.replace(SMALL, minutes=1.0)
    with safe_open(tmp_path / FILE, "pt") as opened:
        told = opened.metadata()
    told |= {"config": msgspec.json.encode(timed).decode(), "seconds": "61.0"}
    save_file(load_file(tmp_path / FILE), tmp_path / FILE, told)
    train(timed, tmp_path)
    assert (tmp_path / "log.jsonl").read_text().count("epoch") == 2
    assert (tmp_path / "step.onnx").is_file()
