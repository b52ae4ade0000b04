"""Frozen MiniLM in the place of the paper's frozen BERT, served by onnxruntime.

all-MiniLM-L6-v2 (Apache-2.0, sentence-transformers), its word embeddings and lower layers, int8.
Training and serving use this one graph, so that both see the same embeddings.
"""

from __future__ import annotations

import gzip
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import onnxruntime
from numpy.typing import NDArray
from tokenizers import Tokenizer

from agent.errors import TranslatorError
from translator.marked import Mark, slot_ids

LONGEST = 128
"""Word pieces of a sentence at most."""


def session(path: Path) -> onnxruntime.InferenceSession:
    """An onnxruntime session on one thread (two on two busy cores are ten times slower).

    ``path`` may be there as it is, or packed by gzip with ``.gz`` behind its name. Raises
    TranslatorError naming the missing file.
    """
    packed = path.with_name(f"{path.name}.gz")
    if not path.is_file() and not packed.is_file():
        raise TranslatorError(f"no weights at {path}; give --model or set ARMCHAT_MODEL_DIR")
    graph = str(path) if path.is_file() else gzip.decompress(packed.read_bytes())
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    options.inter_op_num_threads = 1
    options.log_severity_level = 3
    return onnxruntime.InferenceSession(graph, options, providers=["CPUExecutionProvider"])


def sentence_tokenizer(folder: Path) -> Tokenizer:
    """MiniLM's own tokenizer, from ``tokenizer.json``; sentences are cut at `LONGEST` pieces."""
    tokenizer = Tokenizer.from_file(str(folder / "tokenizer.json"))
    tokenizer.no_padding()
    tokenizer.enable_truncation(LONGEST)
    return tokenizer


class SentenceEncoder:
    """Text to contextual word-piece embeddings."""

    size = 384

    def __init__(self, folder: Path) -> None:
        self._session = session(folder / "encoder.onnx")
        self._tokenizer = sentence_tokenizer(folder)

    def pieces(self, text: str) -> list[str]:
        """The word pieces of a text, [CLS] and [SEP] included."""
        return list(self._tokenizer.encode(text).tokens)

    def places(self, text: str) -> list[tuple[int, int]]:
        """Where in the text each of its word pieces is: (start, end)."""
        return list(self._tokenizer.encode(text).offsets)

    def __call__(self, text: str) -> NDArray[np.float32]:
        """Embeddings of a sentence, shape (word pieces, 384)."""
        return self.marked(text, ())[0]

    def marked(
        self, text: str, marks: Sequence[Mark]
    ) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
        """Embeddings (word pieces, 384), and the number of each piece's slot (0: none)."""
        pieces = self._tokenizer.encode(text)
        slots = np.array(slot_ids(pieces.offsets, marks), dtype=np.int64)
        return self.states(np.array(pieces.ids, dtype=np.int64)), slots

    def states(self, ids: NDArray[np.int64]) -> NDArray[np.float32]:
        """Embeddings (T, 384) of the word pieces ``ids`` (T,) of one sentence."""
        states: NDArray[np.float32] = self._session.run(None, {"ids": ids[None]})[0][0]
        return states


@cache
def sentence_encoder(folder: Path) -> SentenceEncoder:
    """The encoder of a folder, one for all who use it in this process. Raises TranslatorError that
    names the missing file."""
    return SentenceEncoder(folder)
