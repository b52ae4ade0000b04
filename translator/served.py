"""Weights of a network that serves, to go on learning from: `export_model` the other way round.

What is committed are onnxruntime's graphs with int8 weights; a run that names such a folder as its
``start`` goes on from them without a checkpoint. What quantisation took away is not given back.
Needs the ``[train]`` extra.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import onnx
import torch
from google.protobuf.message import DecodeError
from numpy.typing import NDArray
from onnx import numpy_helper
from torch import Tensor

from agent.errors import ConfigError

GRAPHS = ("sentence.onnx", "step.onnx")
"""What `translator.export.export_model` writes."""
OWNER = "model."
"""Before the name of each parameter: an exported graph holds its model by this name."""
GATES = (0, 2, 3, 1)
"""Where torch's gates (input, forget, cell, output) stand among ONNX's (input, output, forget,
cell): operator LSTM of the ONNX specification."""
Array = NDArray[np.generic]


def served(folder: Path) -> bool:
    """Whether a folder holds a network that serves and no checkpoint."""
    return all((folder / name).is_file() for name in GRAPHS)


def served_weights(folder: Path) -> dict[str, Tensor]:
    """The parameters of the network in a folder, by their names in the model.

    Raises ConfigError naming the folder where its graphs are not such a network's.
    """
    weights: dict[str, Tensor] = {}
    try:
        for name in GRAPHS:
            graph = onnx.load(str(folder / name)).graph
            weights |= {key: torch.from_numpy(array.copy()) for key, array in _parameters(graph)}
    except (DecodeError, KeyError, IndexError, ValueError) as error:
        raise ConfigError(
            f"{folder}: its graphs are not those of a network that armchat trained ({error!r}); "
            "name the folder of a run instead"
        ) from error
    return weights


def _parameters(graph: onnx.GraphProto) -> Iterator[tuple[str, Array]]:
    held = {one.name: numpy_helper.to_array(one) for one in graph.initializer}
    for name, array in held.items():
        if not name.startswith(OWNER):
            continue
        if name.endswith("_quantized"):  # a table of embeddings
            whole = name.removesuffix("_quantized")
            yield whole.removeprefix(OWNER), _whole(held, whole)
        elif not name.endswith(("_scale", "_zero_point")):
            yield name.removeprefix(OWNER), array
    readers = {source: node for node in graph.node for source in node.input}
    for node in graph.node:
        if node.op_type == "MatMulInteger":
            weight = node.input[1].removesuffix("_quantized")
            yield f"{_owner(node, readers, held)}.weight", _whole(held, weight).T
        elif node.op_type == "DynamicQuantizeLSTM":
            yield from _recurrent(node, held)


def _owner(
    product: onnx.NodeProto, readers: dict[str, onnx.NodeProto], held: dict[str, Array]
) -> str:
    """The layer that a product belongs to: the one whose bias is added to it, or, where none is,
    the one that its node is named after."""
    node = product
    while (node := readers[node.output[0]]).op_type in ("Cast", "Mul"):
        pass
    biases = [one for one in node.input if one in held and node.op_type == "Add"]
    if biases:
        return str(biases[0]).removeprefix(OWNER).removesuffix(".bias")
    return str(product.name).removesuffix("/MatMul_quant").strip("/").replace("/", ".")


def _whole(held: dict[str, Array], name: str) -> NDArray[np.float32]:
    """A tensor without its quantisation."""
    points, scale, zero = (
        held[f"{name}_{part}"].astype(np.float32) for part in ("quantized", "scale", "zero_point")
    )
    # one scale for all or one a column; in a stack (an LSTM's directions) so for each of it
    turned = (len(points), 1, -1) if points.ndim == 3 else (-1,)
    return np.asarray((points - zero.reshape(turned)) * scale.reshape(turned), np.float32)


def _recurrent(node: onnx.NodeProto, held: dict[str, Array]) -> Iterator[tuple[str, Array]]:
    """An LSTM's parameters: (directions, inputs, 4 x width) and (directions, 8 x width) in ONNX."""
    layer = node.name.removesuffix("/LSTM_quant").strip("/").replace("/", ".")
    inward, across = (_whole(held, node.input[i].removesuffix("_quantized")) for i in (1, 2))
    biases = held[node.input[3]]
    for direction, ending in zip(range(len(inward)), ("l0", "l0_reverse"), strict=False):
        of_inward, of_across = np.split(biases[direction], 2)
        for name, array in (
            ("weight_ih", inward[direction].T), ("weight_hh", across[direction].T),
            ("bias_ih", of_inward), ("bias_hh", of_across),
        ):  # fmt: skip
            gates = np.split(array, 4)
            yield f"{layer}.{name}_{ending}", np.concatenate([gates[gate] for gate in GATES])
