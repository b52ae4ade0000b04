"""Write the detector's network for onnxruntime: weights int8 or float16, sums float32 (torch).

Weights of large convolutions are int8 with a scale for each output channel; all others are
float16, as it costs 0.7 points of mAP50 to have them int8. onnxruntime turns them back into float32
when it loads them, once. What the detector must know besides (scale, names, how sure an error is)
is in the file's metadata.
"""

from __future__ import annotations

import tempfile
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import onnx
import torch
from onnx import numpy_helper
from onnx.helper import make_node, set_model_props

from scene.detector_net import Net, Served
from scene.rectify import Grid

OUTPUTS = ("heat", "place", "shape", "color", "feature")
FEW = 64
"""Weights of fewer numbers stay as they are."""
MANY = 30_000
"""Convolutions of more numbers are int8."""


def export(net: Net, path: Path, grid: Grid, names: Sequence[str], colors: Sequence[str]) -> Path:
    """Write the file that `scene.detector.NetDetector` loads."""
    served = Served(net).eval().to(memory_format=torch.contiguous_format)
    example = torch.zeros((1, 5, grid.size, grid.size))
    with tempfile.TemporaryDirectory() as scratch, warnings.catch_warnings():
        # the exporter warns that it is the older one of two
        warnings.simplefilter("ignore")
        plain = Path(scratch) / "plain.onnx"
        torch.onnx.export(
            served, (example,), str(plain), input_names=["planes"], output_names=list(OUTPUTS),
            opset_version=17, dynamo=False,
        )  # fmt: skip
        model = onnx.load(plain)
    _shrink(model)
    write(model, path, {
        "size": str(grid.size), "mm": str(grid.mm), "names": " ".join(names),
        "colors": " ".join(colors), "spread": "1.0",
    })  # fmt: skip
    return path


def state(path: Path, facts: Mapping[str, str]) -> None:
    """Change facts in the metadata of a file that `export` wrote."""
    write(onnx.load(path), path, facts)


def write(model: onnx.ModelProto, path: Path, facts: Mapping[str, str]) -> None:
    """Save a model with these facts added to its metadata."""
    known = {entry.key: entry.value for entry in model.metadata_props}
    set_model_props(model, {**known, **facts})
    onnx.checker.check_model(model)
    onnx.save(model, path)


def _shrink(model: onnx.ModelProto) -> None:
    """Keep large weights as int8 or float16, with the nodes that turn them back."""
    graph, before = model.graph, list[onnx.NodeProto]()
    for tensor in list(graph.initializer):
        weights = numpy_helper.to_array(tensor)
        if weights.dtype != np.float32 or weights.size < FEW:
            continue
        graph.initializer.remove(tensor)
        kept = f"{tensor.name}_kept"
        if weights.ndim == 4 and weights.size > MANY:
            most = np.abs(weights).reshape(len(weights), -1).max(1)
            scale = (np.maximum(most, 1e-8) / 127).astype(np.float32)
            whole = np.round(weights / scale.reshape(-1, 1, 1, 1)).astype(np.int8)
            # not DequantizeLinear, which onnxruntime computes anew for each picture
            each = scale.reshape(-1, 1, 1, 1)
            graph.initializer.append(numpy_helper.from_array(each, f"{tensor.name}_scale"))
            graph.initializer.append(numpy_helper.from_array(whole, kept))
            before += [
                make_node("Cast", [kept], [f"{tensor.name}_whole"], to=onnx.TensorProto.FLOAT),
                make_node("Mul", [f"{tensor.name}_whole", f"{tensor.name}_scale"], [tensor.name]),
            ]
        else:
            graph.initializer.append(numpy_helper.from_array(weights.astype(np.float16), kept))
            before.append(make_node("Cast", [kept], [tensor.name], to=onnx.TensorProto.FLOAT))
    nodes = [*before, *graph.node]
    del graph.node[:]
    graph.node.extend(nodes)
