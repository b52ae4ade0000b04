"""Sentences of the generator as requests: held-out wordings, for calibration and a sanity row."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from itertools import islice

from agent.messages import Mention, Quantity, TranslateRequest
from translator.corpus.generate import Generator, Sample
from translator.corpus.seed import kept, load_seeds


def held_out(count: int, seed: int) -> Iterator[tuple[TranslateRequest, str]]:
    """Requests from wordings that training never saw, each with its true program over its slots."""
    generator = Generator(kept(load_seeds(), held_out=True), random.Random(seed))
    return ((request(sample), program(sample)) for sample in islice(generator, count))


def request(sample: Sample) -> TranslateRequest:
    """The sample as the linker would hand it over."""
    text = sample.sentence.text
    mentions, measures = [], []
    for start, end, slot in sample.sentence.marks:
        if slot[0] in "mg":
            mentions.append(
                Mention(f"m{slot[1:]}", start, end, text[start:end], (), slot[0] == "g")
            )
        else:
            measures.append(Quantity(slot, start, end, text[start:end], 0.5))
    return TranslateRequest(text, tuple(mentions), sample.kind, 4, tuple(measures))


def program(sample: Sample) -> str:
    """Its program over the request's slots: groups are mentions too."""
    return re.sub(r"\bg(\d+)\b", r"m\1", sample.program)
