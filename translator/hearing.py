"""What of a sentence is talk: courtesies, asides, reasons, stories, and the wrong halves of
corrections. A small tagger over the frozen embeddings says so word by word (disfluency detection,
Zayats et al., arXiv 1604.03209, over `translator.embed`); it learns from `translator.corpus.talk`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from translator.embed import SentenceEncoder, sentence_encoder, session
from translator.translate import WEIGHTS

FOLDER = "hearing"
"""Its folder under the weights."""
GRAPH = "talk.onnx"
SURE = (0.9, 0.6)
"""Mean probabilities from which a run of words is passed over, the surest first."""
NOTHING_ELSE = 0.99
"""How likely every word must be talk for the whole sentence to be nothing else."""
_WORD = re.compile(r"\S+")
_SENTENCE_END = re.compile(r"[.!?;:]$")


class Word(NamedTuple):
    """A word of a sentence with its place, and the probability that it is talk."""

    start: int
    end: int
    talk: float


class Hearing:
    """The tagger, served by onnxruntime."""

    def __init__(self, weights: Path, encoder: SentenceEncoder | None = None) -> None:
        """``weights``: the folder of the encoder. Raises TranslatorError where a file lacks."""
        self._encoder = encoder or sentence_encoder(weights)
        self._session = session(weights / FOLDER / GRAPH)

    def words(self, text: str) -> list[Word]:
        """Each word of the text and how likely it is talk; those beyond `embed.LONGEST` pieces
        are not."""
        places = self._encoder.places(text)
        logits: NDArray[np.float32] = self._session.run(None, {"words": self._encoder(text)[None]})[
            0
        ]
        likely = 1 / (1 + np.exp(-logits[0]))
        return [
            Word(at.start(), at.end(), _mean([
                float(p) for (start, end), p in zip(places, likely, strict=True)
                if at.start() <= start < end <= at.end()
            ]))
            for at in _WORD.finditer(text)
        ]  # fmt: skip

    def __call__(self, text: str) -> list[str]:
        """The text without what is surely talk, then without what is likely talk; only what
        differs from the text and from one another. Just "" where all of it is surely talk."""
        words = self.words(text)
        if words and all(word.talk > NOTHING_ELSE for word in words):
            return [""]
        heard: list[str] = []
        for sure in SURE:
            kept = [word for run in _runs(words) for word in run if not _is_talk(run, sure)]
            if 0 < len(kept) < len(words) and (plain := _tidy(text, kept)) not in heard:
                heard.append(plain)
        return heard


def hear(text: str) -> list[str]:
    """`Hearing`, by the committed tagger, which is loaded when first needed."""
    return _committed()(text)


@lru_cache(maxsize=1)
def _committed() -> Hearing:
    return Hearing(WEIGHTS)


def _is_talk(run: Sequence[Word], sure: float) -> bool:
    return run[0].talk > 0.5 and _mean([word.talk for word in run]) >= sure


def _runs(words: Sequence[Word]) -> list[list[Word]]:
    """Neighbours that are likelier talk than not, and the others between them."""
    runs: list[list[Word]] = []
    for word in words:
        if runs and (runs[-1][-1].talk > 0.5) == (word.talk > 0.5):
            runs[-1].append(word)
        else:
            runs.append([word])
    return runs


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else 0.0


def _tidy(text: str, kept: Sequence[Word]) -> str:
    """The words left over, without the punctuation that set off what stood between them."""
    said: list[str] = []
    for before, word in zip([None, *kept], kept, strict=False):
        written = text[word.start : word.end]
        skipped = before is not None and text[before.end : word.start].strip() != ""
        if skipped and said and not _SENTENCE_END.search(said[-1]):
            said[-1] = said[-1].rstrip(",–—-(")
        said.append(written)
    return re.sub(r"\s+", " ", " ".join(said)).strip(" ,;–—-()").strip()
