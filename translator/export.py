"""Export to onnxruntime: the frozen MiniLM encoder and a trained seq2seq model, int8 weights.

Needs the ``[train]`` extra; nothing that serves imports it. Quantisation is dynamic (weights
int8, activations measured at run time), by onnxruntime's own tool.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import warnings
from pathlib import Path

import torch
from onnxruntime.quantization import QuantType, quantize_dynamic
from onnxruntime.quantization.shape_inference import quant_pre_process
from torch import Tensor, nn

from translator.attention import Memory
from translator.minilm import folder as minilm_folder
from translator.minilm import minilm
from translator.model import Seq2Seq
from translator.transformer import Transformer


def export_encoder(folder: Path) -> None:
    """Write ``encoder.onnx`` (MiniLM, int8) and ``tokenizer.json`` from the weights package."""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(minilm_folder() / "tokenizer.json", folder / "tokenizer.json")
    ids = torch.zeros((1, 7), dtype=torch.long)
    export_graph(minilm(), (ids,), folder / "encoder.onnx", ["ids"], ["states"], {"ids": {1: "T"}})


def export_model(model: Seq2Seq | Transformer, folder: Path) -> None:
    """Write ``sentence.onnx`` (the sentence's encoder) and ``step.onnx`` (one decoder step).

    The first gives what the second starts from: what stays as it is for the sentence, and a state
    that each step hands on (its outputs ``..._next``); `translator.decode` goes by these names.
    """
    model = model.eval()
    folder.mkdir(parents=True, exist_ok=True)
    words: tuple[Tensor, ...] = (torch.zeros((1, 7, model.embedding_size)),)
    names, axes = ["words"], {"words": {1: "T"}}
    if model.slots is not None:
        words += (torch.zeros((1, 7), dtype=torch.long),)
        names, axes = ["words", "slots"], {"words": {1: "T"}, "slots": {1: "T"}}
    token = torch.zeros((2,), dtype=torch.long)
    if isinstance(model, Seq2Seq):
        fixed, state = {"memory": {1: "T"}}, {"h": {0: "B"}, "c": {0: "B"}}
        first = [*fixed, *state]
        fed = [torch.zeros((2, model.width)) for _ in state] + [torch.zeros((1, 7, model.width))]
    else:
        heads, size = model.heads, model.width // model.heads
        kept = [f"{what}_{n}" for n in range(len(model.decoder)) for what in Memory._fields]
        state = {"place": {0: "B"}} | {name: {0: "B", 2: "P"} for name in kept}
        fixed = {f"{name}_words": {2: "T"} for name in kept}
        first = [*state, *fixed]
        fed = [torch.zeros((2,), dtype=torch.long)]
        fed += [torch.zeros((2, heads, 3, size)) for _ in kept]
        fed += [torch.zeros((1, heads, 7, size)) for _ in kept]
    export_graph(model.encoder_graph(), words, folder / "sentence.onnx", names, first, axes | fixed)
    behind = {
        f"{one}_next": {axis: "Q" if length == "P" else length for axis, length in axes.items()}
        for one, axes in state.items()
    }
    export_graph(
        model.step_graph(), (token, *fed), folder / "step.onnx",
        ["token", *state, *fixed], ["logits", *behind, "attention"],
        {"token": {0: "B"}, "logits": {0: "B"}, "attention": {0: "B", 1: "T"}}
        | state | fixed | behind,
    )  # fmt: skip


def export_graph(
    module: nn.Module,
    inputs: tuple[Tensor, ...],
    path: Path,
    names: list[str],
    outputs: list[str],
    axes: dict[str, dict[int, str]],
) -> None:
    with tempfile.TemporaryDirectory() as scratch, warnings.catch_warnings():
        # the exporter warns of sizes that are fixed on purpose, and that it is the older one of two
        warnings.simplefilter("ignore")
        plain, prepared = Path(scratch) / "plain.onnx", Path(scratch) / "prepared.onnx"
        torch.onnx.export(
            module, inputs, str(plain), input_names=names, output_names=outputs,
            dynamic_axes=axes, opset_version=17, dynamo=False,
        )  # fmt: skip
        quant_pre_process(str(plain), str(prepared), skip_symbolic_shape=True)
        quantize_dynamic(prepared, path, weight_type=QuantType.QInt8, per_channel=True)


if __name__ == "__main__":  # `python -m translator.export FOLDER`: encoder.onnx and tokenizer.json
    export_encoder(Path(sys.argv[1]))
