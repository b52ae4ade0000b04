"""Training, small: a run leaves everything behind that serving and a later reader need."""

import json
from pathlib import Path

import msgspec
import pytest

from agent.errors import ConfigError, TranslatorError
from agent.messages import Mention, TranslateRequest
from translator.embed import SentenceEncoder, sentence_tokenizer

torch = pytest.importorskip("torch")

from translator.course import TrainConfig, read_config  # noqa: E402
from translator.learner import Batch, Learner  # noqa: E402
from translator.lessons import Lesson  # noqa: E402
from translator.marked import Mark, Marked  # noqa: E402
from translator.mined import Pair  # noqa: E402
from translator.minilm import minilm  # noqa: E402
from translator.model import Seq2Seq  # noqa: E402
from translator.train import carried, lessons_of, train  # noqa: E402
from translator.transformer import Transformer  # noqa: E402
from translator.translate import WEIGHTS, Translator  # noqa: E402
from translator.vocabulary import Vocabulary  # noqa: E402

CONFIGS = Path(__file__).parents[1] / "configs"
SMALL = TrainConfig(width=12, token_size=5, epochs=2, copies=1, joined=0.2, threads=1)
B, T, L, H, E, V = 3, 7, 5, 12, 11, 17
"""Sentences, word pieces, program symbols, width, embedding size, vocabulary: all different."""


def model() -> Seq2Seq:
    torch.manual_seed(1)
    return Seq2Seq(V, H, E, token_size=5).eval()


def transformer() -> Transformer:
    torch.manual_seed(1)
    return Transformer(V, H, E, slots=4, heads=3).eval()


@pytest.mark.parametrize("model", [model, transformer])
def test_teacher_forcing_gives_logits_for_every_symbol(model):
    logits = model()(torch.randn(B, T, E), torch.tensor([7, 4, 2]), torch.randint(0, V, (B, L)))
    assert logits.shape == (B, L, V)


@pytest.mark.parametrize("model", [model, transformer])
def test_what_lies_beyond_a_sentence_does_not_change_its_logits(model):
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


def test_the_transformer_decodes_step_by_step_as_it_is_taught():
    net = transformer()
    words, tokens = torch.randn(1, T, E), torch.randint(0, V, (1, L))
    slots = torch.tensor([[0, 1, 0, 4, 4, 0, 0]])
    whole = net(words, torch.tensor([T]), tokens, slots)[0]
    began = net.encoder_graph()(words, slots)
    state, read = began[: -2 * len(net.decoder)], began[-2 * len(net.decoder) :]
    for position in range(L):
        logits, *state, attention = net.step_graph()(tokens[:, position], *state, *read)
        assert torch.allclose(logits[0], whole[position], atol=1e-5)
        assert attention.shape == (1, T)
        assert attention.sum().item() == pytest.approx(1.0, abs=1e-5)


def test_what_marks_a_slot_is_read_by_the_slot_alone():
    net = transformer()
    words, tokens = torch.randn(1, T, E), torch.randint(0, V, (1, L))
    slots = torch.tensor([[0, 1, 1, 0, 0, 0, 0]])
    other = words.clone()
    other[0, 1:3] = 7.0
    one, two = (net(it, torch.tensor([T]), tokens, slots) for it in (words, other))
    assert torch.equal(one, two)


def test_no_symbol_sees_those_after_it():
    net = transformer()
    words, tokens = torch.randn(1, T, E), torch.randint(0, V, (1, L))
    longer = torch.cat([tokens, torch.randint(0, V, (1, 3))], 1)
    short, long = (net(words, torch.tensor([T]), it) for it in (tokens, longer))
    assert torch.allclose(short, long[:, :L], atol=1e-5)


def test_two_replicas_learn_what_one_learns_from_the_whole_batch():
    """The gradient is the mean of the halves', to the exactness of bfloat16."""
    torch.manual_seed(2)
    batch = Batch(
        torch.randn(4, T, E), torch.zeros(4, T, dtype=torch.long), torch.full((4,), T),
        torch.randint(0, V, (4, L)), torch.randint(0, V, (4, L)),
    )  # fmt: skip
    gradients = []
    for threads in (1, 2):
        net = transformer()
        Learner(net, msgspec.structs.replace(SMALL, threads=threads)).epoch(1, [batch])
        assert not torch.equal(net.output.weight, transformer().output.weight)
        gradients.append(net.output.weight.grad)
    one, two = gradients
    assert (one - two).norm() < 0.02 * one.norm()


def test_the_rate_rises_over_the_first_batches_and_falls_by_the_epoch():
    config = msgspec.structs.replace(SMALL, warmup=4, epochs=3, learning_rate=1e-2, final_rate=1e-4)
    learner = Learner(transformer(), config)
    rates = [learner.next_rate(epoch) for epoch in (1, 1, 1, 1, 2, 3)]
    assert rates == pytest.approx([2.5e-3, 5e-3, 7.5e-3, 1e-2, 1e-3, 1e-4])


def test_when_the_minutes_are_over_the_rate_has_fallen_and_training_ends(tmp_path):
    config = msgspec.structs.replace(SMALL, epochs=1000, learning_rate=1e-2, final_rate=1e-4)
    learner = Learner(transformer(), msgspec.structs.replace(config, minutes=1e-6))
    assert learner.out_of_time
    assert learner.next_rate(1) == pytest.approx(1e-4)
    train(msgspec.structs.replace(config, minutes=0.01), tmp_path)
    assert (tmp_path / "log.jsonl").read_text().count("epoch") < 1000
    assert (tmp_path / "step.onnx").is_file()


def test_the_frozen_encoder_in_torch_says_what_the_served_one_says():
    served, text = SentenceEncoder(WEIGHTS), "put the cup to the left of the plate"
    ids = torch.tensor([sentence_tokenizer(WEIGHTS).encode(text).ids])
    ours, theirs = minilm()(ids)[0], torch.from_numpy(served(text))
    assert torch.nn.functional.cosine_similarity(ours, theirs).mean() > 0.95  # theirs is int8


def test_padding_does_not_change_what_the_frozen_encoder_says():
    frozen, ids = minilm(), torch.tensor([[101, 2404, 1996, 3796, 102]])
    padded = torch.cat([ids, torch.zeros(1, 3, dtype=torch.long)], 1)
    assert torch.allclose(frozen(ids), frozen(padded, torch.tensor([5]))[:, :5], atol=1e-5)


def test_a_run_can_be_served_and_read_again(tmp_path):
    train(SMALL, tmp_path)
    log = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    assert [entry["epoch"] for entry in log] == [1, 2]
    assert log[1]["train"] < log[0]["train"]
    assert json.loads((tmp_path / "config.json").read_text())["width"] == 12
    apple = Mention("m1", 12, 17, "apple", ("apple_1",))
    served = Translator(tmp_path)
    served(TranslateRequest("pick up the apple", (apple,), "manipulate"))


def test_a_model_learns_new_symbols_without_forgetting_the_old():
    before, now = (Vocabulary(tuple((piece,) for piece in pieces), (), "skills")
                   for pieces in ("abc", "cxab"))  # fmt: skip
    old, fresh = Transformer(3, H, E, heads=3), Transformer(4, H, E, heads=3)
    weights = carried(old.state_dict(), before, fresh.state_dict(), now)
    for name in ("tokens.weight", "output.weight", "output.bias"):
        assert torch.equal(weights[name][[2, 3, 0]], old.state_dict()[name])
        assert torch.equal(weights[name][1], fresh.state_dict()[name][1])
    assert torch.equal(weights["inward.weight"], old.inward.weight)


def test_of_slots_no_more_are_carried_than_there_are():
    vocabulary = Vocabulary((("a",), ("b",), ("c",)), (), "paper")
    old, fresh = (Transformer(3, H, E, slots=slots, heads=3) for slots in (4, 0))
    weights = carried(old.state_dict(), vocabulary, fresh.state_dict(), vocabulary)
    assert torch.equal(weights["slots.weight"], old.slots.weight[:1])
    fresh.load_state_dict(weights)


def test_docstrings_are_learnt_first_and_programs_from_there(tmp_path, monkeypatch):
    said = [Marked("return the block", (Mark(11, 16, "m1"),)), Marked("count up", ())]
    pairs = [Pair(one, body) for one, body in zip(said, ("return m1", "v1 = 1"), strict=True)]
    lessons = tuple(Lesson(*pair.said, pair.body, "arrange") for pair in pairs)
    monkeypatch.setattr("translator.lessons._docstrings", lambda *, held_out: lessons)
    small = msgspec.structs.replace(SMALL, model="transformer", width=16, epochs=1, samples=10)
    before, after = tmp_path / "before", tmp_path / "after"
    learnt = train(msgspec.structs.replace(small, corpus="docstrings"), before)
    known = Vocabulary.load(before / "vocabulary.json")
    assert known.dialect == "python"
    with pytest.raises(TranslatorError, match="docstrings"):
        Translator(before)
    begun = msgspec.structs.replace(small, start=str(before), learning_rate=1e-9, final_rate=1e-9)
    now = train(begun, after).state_dict()
    spoken = Vocabulary.load(after / "vocabulary.json")
    assert spoken.dialect == "paper"
    rows = [one.symbol("=") for one in (spoken, known)]
    old = learnt.state_dict()
    assert torch.allclose(now["tokens.weight"][rows[0]], old["tokens.weight"][rows[1]], atol=1e-5)
    assert torch.allclose(now["inward.weight"], old["inward.weight"], atol=1e-5)
    Translator(after)


def test_the_same_seed_trains_the_same_weights(tmp_path):
    one, other = (train(SMALL, tmp_path / name).state_dict() for name in ("a", "b"))
    assert all(torch.equal(one[name], other[name]) for name in one)


def test_a_share_of_the_pairs_is_what_is_learnt_from():
    config = msgspec.structs.replace(SMALL, wordings=0.1)
    assert len(lessons_of(config).chunk(0)) == 22


@pytest.mark.parametrize("path", sorted(CONFIGS.glob("*.toml")), ids=lambda path: path.stem)
def test_every_configuration_can_be_read(path):
    if path.stem != "pretrained":  # that of `translator.finetune`
        assert read_config(path).epochs > 0


def test_docstrings_are_learnt_at_the_sizes_of_what_goes_on_from_them():
    first, then = (read_config(CONFIGS / f"{name}.toml") for name in ("docstrings", "skills"))
    assert first.corpus == "docstrings"
    assert (first.model, first.width) == (then.model, then.width)


def test_a_wrong_key_names_file_and_key(tmp_path):
    path = tmp_path / "c.toml"
    path.write_text("widht = 12")
    with pytest.raises(ConfigError, match=r"c\.toml.*widht"):
        read_config(path)
