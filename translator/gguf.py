"""A model of a GGUF file as a folder of transformers' own form: unpacked once, read quickly."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import torch
from transformers import AutoModelForCausalLM, AutoTokenizer, GgufConfig


def unpack(file: Path, home: Path, say: Callable[[str], None]) -> None:
    """Write weights (bfloat16, safetensors), configuration and tokenizer of the file into ``home``.

    Raises ValueError or OSError where transformers does not know the file's architecture.
    """
    say("reading the tokenizer ...")
    tokenizer = AutoTokenizer.from_pretrained(file.parent, gguf_file=file.name)
    tokenizer.save_pretrained(home)
    say("unpacking the weights ...")
    model = AutoModelForCausalLM.from_pretrained(
        file.parent, gguf_file=file.name, dtype=torch.bfloat16,
        quantization_config=GgufConfig(dequantize=True),
    )  # fmt: skip
    model.save_pretrained(home)
