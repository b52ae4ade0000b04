"""Training, small: a run leaves everything behind that serving and a later reader need."""

import json

import pytest

from agent.errors import ConfigError
from agent.messages import Mention, TranslateRequest

torch = pytest.importorskip("torch")

from translator.model import Seq2Seq  # noqa: E402
from translator.train import TrainConfig, read_config, train  # noqa: E402
from translator.translate import Translator  # noqa: E402

SMALL = TrainConfig(width=12, token_size=5, epochs=2, copies=1, joined=0.2, threads=1)
B, T, L, H, E, V = 3, 7, 5, 12, 11, 17
"""Sentences, word pieces, program symbols, width, embedding size, vocabulary: all different."""


def model() -> Seq2Seq:
    torch.manual_seed(1)
    return Seq2Seq(V, H, E, token_size=5).eval()


def test_teacher_forcing_gives_logits_for_every_symbol():
    logits = model()(torch.randn(B, T, E), torch.tensor([7, 4, 2]), torch.randint(0, V, (B, L)))
    assert logits.shape == (B, L, V)


def test_what_lies_beyond_a_sentence_does_not_change_its_logits():
    words = torch.randn(1, T, E)
    padded = torch.cat([words, torch.full((1, 4, E), 9.0)], 1)
    tokens = torch.randint(0, V, (1, L))
    alone = model()(words, torch.tensor([T]), tokens)
    beside = model()(padded, torch.tensor([T]), tokens)
    assert torch.allclose(alone, beside, atol=1e-5)


def test_step_by_step_decoding_is_teacher_forcing():
    net = model()
    words, tokens = torch.randn(1, T, E), torch.randint(0, V, (1, L))
    whole = net(words, torch.tensor([T]), tokens)[0]
    memory, h, c = net.encoder_graph()(words)
    for position in range(L):
        logits, h, c, attention = net.step_graph()(tokens[:, position], h, c, memory)
        assert torch.allclose(logits[0], whole[position], atol=1e-5)
        assert attention.shape == (1, T)
        assert attention.sum().item() == pytest.approx(1.0, abs=1e-5)


def test_a_run_can_be_served_and_read_again(tmp_path):
    train(SMALL, tmp_path)
    log = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    assert [entry["epoch"] for entry in log] == [1, 2]
    assert log[1]["train"] < log[0]["train"]
    assert json.loads((tmp_path / "config.json").read_text())["width"] == 12
    apple = Mention("m1", 12, 17, "apple", ("apple_1",))
    served = Translator(tmp_path)
    served(TranslateRequest("pick up the apple", (apple,), "manipulate"))


def test_the_same_seed_trains_the_same_weights(tmp_path):
    one, other = (train(SMALL, tmp_path / name).state_dict() for name in ("a", "b"))
    assert all(torch.equal(one[name], other[name]) for name in one)


def test_a_wrong_key_names_file_and_key(tmp_path):
    path = tmp_path / "c.toml"
    path.write_text("widht = 12")
    with pytest.raises(ConfigError, match=r"c\.toml.*widht"):
        read_config(path)
