"""A run may go on from the networks that serve, without a checkpoint."""

from pathlib import Path

import pytest

from agent.errors import ConfigError
from translator.vocabulary import Vocabulary

torch = pytest.importorskip("torch")

from safetensors.torch import save_file  # noqa: E402

from translator.blend import blend  # noqa: E402
from translator.course import TrainConfig  # noqa: E402
from translator.embed import SentenceEncoder  # noqa: E402
from translator.export import export_model  # noqa: E402
from translator.model import Seq2Seq  # noqa: E402
from translator.served import served, served_weights  # noqa: E402
from translator.train import learnt_in, train  # noqa: E402
from translator.transformer import Transformer  # noqa: E402

V, H, E = 17, 12, 11
"""Vocabulary, width, embedding size."""
STEP = 1 / 100
"""What a weight may lose, as a share of the largest of its tensor: int8 has 127 steps a side."""


def known(model):
    """Every parameter drawn, so that no two tensors are alike."""
    torch.manual_seed(3)
    for parameter in model.parameters():
        parameter.data.normal_()
    return model.eval()


MODELS = {
    "transformer": lambda: Transformer(V, H, E, slots=4, heads=3),
    "lstm": lambda: Seq2Seq(V, H, E, token_size=5, slots=4),
    "both ways": lambda: Seq2Seq(V, H, E, token_size=5, slots=4, bidirectional=True),
    "the paper's": lambda: Seq2Seq(V, H, E, token_size=5),
}


@pytest.mark.parametrize("name", MODELS)
def test_a_served_network_gives_back_every_weight_but_for_its_quantisation(name, tmp_path):
    model = known(MODELS[name]())
    export_model(model, tmp_path)
    found = served_weights(tmp_path)
    assert found.keys() == model.state_dict().keys()
    for key, weight in model.state_dict().items():
        assert found[key].shape == weight.shape, key
        assert (found[key] - weight).abs().max() <= STEP * weight.abs().max(), key


def test_a_run_goes_on_from_a_served_network_and_a_vocabulary_a_folder_above(tmp_path):
    small = TrainConfig(
        tasks=("arrange",), width=12, token_size=5, epochs=1, copies=1, threads=1
    )  # fmt: skip
    before = train(small, tmp_path / "first")
    spoken = Vocabulary.load(tmp_path / "first" / "vocabulary.json")
    start = tmp_path / "weights" / "net"
    export_model(before, start)
    Vocabulary(spoken.pieces[::-1], spoken.words).save(start.parent / "vocabulary.json")
    still = TrainConfig(
        tasks=("arrange",), width=12, token_size=5, epochs=1, copies=1, threads=1, start=str(start),
        learning_rate=1e-9, final_rate=1e-9,
    )  # fmt: skip
    after = train(still, tmp_path / "second").state_dict()
    assert Vocabulary.load(tmp_path / "second" / "vocabulary.json").pieces == spoken.pieces[::-1]
    for key, weight in before.state_dict().items():
        assert torch.allclose(after[key], weight, atol=STEP * float(weight.abs().max())), key


def test_two_networks_blend_halfway_and_new_symbols_stay_as_the_later_one_has_them(tmp_path):
    config = TrainConfig(width=H, token_size=5)
    first, second = tmp_path / "first", tmp_path / "second"
    for number, (folder, pieces) in enumerate(((first, V), (second, V + 2))):
        model = Seq2Seq(pieces, H, SentenceEncoder.size, token_size=5)
        torch.manual_seed(number)
        for parameter in model.parameters():
            parameter.data.normal_()
        folder.mkdir()
        save_file(model.state_dict(), folder / "model.safetensors")
        Vocabulary(tuple((f"t{n}",) for n in range(pieces)), ()).save(folder / "vocabulary.json")
    blend(config, first, second, tmp_path / "both")
    old, new, both = (learnt_in(tmp_path / name) for name in ("first", "second", "both"))
    for name, weight in new.items():
        lost = STEP * float(weight.abs().max())
        known = slice(0, V if name.startswith(("tokens.", "output.")) else None)
        assert torch.allclose(both[name][known], (old[name] + weight[known]) / 2, atol=lost), name
    assert torch.allclose(both["tokens.weight"][V:], new["tokens.weight"][V:], atol=0.05)


def test_graphs_of_something_else_are_refused_by_the_name_of_their_folder(tmp_path):
    export_model(known(MODELS["lstm"]()), tmp_path)
    (tmp_path / "step.onnx").write_bytes(Path("translator/weights/tokenizer.json").read_bytes())
    assert served(tmp_path)
    with pytest.raises(ConfigError, match=tmp_path.name):
        served_weights(tmp_path)


def test_new_programs_put_their_tokens_behind_those_of_the_run_before():
    spoken = Vocabulary((("<pad>",), ("put",), ("put", "(")), ("cup",), "skills")
    grown = spoken.with_tokens_of(["put(m1, corner(m1))"])
    assert grown.pieces[:3] == spoken.pieces
    assert set(grown.pieces[3:]) >= {("corner",), ("m1",)}
    assert grown.with_tokens_of(["put(m1)"]) == grown
