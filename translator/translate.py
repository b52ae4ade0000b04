"""The translator as it is served: sentence with linked mentions in, scored programs out.

What the sentence names is taken out before the model reads it and put back into what it writes
(argument identification), so any object name works and one translation serves every object that
a slot may be bound to. The product's model reads slots (`translator.marked`); the paper's model,
kept for its table, reads each mention as one of the nouns that it knows.
"""

from __future__ import annotations

import math
import os
import re
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from agent.messages import Candidate, Mention, TranslateRequest, Translation
from translator.data import nouns_of, with_articles
from translator.decode import Decoder
from translator.embed import SentenceEncoder
from translator.marked import read
from translator.vocabulary import NOUNS, Vocabulary, detokenize, words_of

WEIGHTS = Path(os.environ.get("ARMCHAT_MODEL_DIR") or Path(__file__).parent / "weights")
"""Where the weights are: ``ARMCHAT_MODEL_DIR`` or the package's own."""
PAPER, PRODUCT = WEIGHTS / "paper", WEIGHTS / "skills"
"""The paper's model, and the one that is served."""


class Calibration(msgspec.Struct, frozen=True):
    """Maps a log-probability to a probability of being right (fit on held-out parts)."""

    temperature: float = 1.0


class Said(NamedTuple):
    """A request as the model gets it: embeddings (T, 384), slot numbers (T,) or None, the tokens
    for things that its program may hold, and what each of them is in the request."""

    text: str
    states: NDArray[np.float32]
    slots: NDArray[np.int64] | None
    names: Mapping[str, str]


class Translator:
    """MiniLM, a seq2seq model and its vocabulary; a call is thread-safe."""

    def __init__(self, model: Path = PRODUCT, folder: Path = WEIGHTS) -> None:
        """``model``: folder of the trained model; ``folder``: that of the frozen encoder.

        Raises TranslatorError naming a missing or broken file.
        """
        self._vocabulary = Vocabulary.load(model / "vocabulary.json")
        self._encoder = SentenceEncoder(folder)
        self._decoder = Decoder(model, self._vocabulary)
        card = model / "calibration.json"
        self._calibration = (
            msgspec.json.decode(card.read_bytes(), type=Calibration)
            if card.is_file()
            else Calibration()
        )

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; candidates are programs over the request's slots, best first."""
        began = time.perf_counter()
        over_nouns = self._vocabulary.dialect == "paper"
        said = self._over_nouns(request) if over_nouns else self._over_slots(request)
        found = self._decoder.search(
            said.states, request.kind, set(said.names), request.k, said.slots
        )
        candidates = tuple(
            Candidate(
                renamed(detokenize(self._vocabulary.decode(one.tokens[:-1])), said.names),
                one.logprob,
                len(one.tokens),
            )
            for one in found
        )
        unknown = [word for word in words_of(said.text) if word not in self._vocabulary.words]
        return Translation(
            candidates,
            self._confidence(candidates),
            1000 * (time.perf_counter() - began),
            tuple(unknown) if over_nouns else (),
        )

    def _over_slots(self, request: TranslateRequest) -> Said:
        sentence, names = read(request)
        states, slots = self._encoder.marked(*sentence)
        return Said(sentence.text, states, slots, names)

    def _over_nouns(self, request: TranslateRequest) -> Said:
        nouns = choose_nouns(request.mentions)
        text = write_nouns(request.text, request.mentions, nouns)
        names = {noun: slot for slot, noun in nouns.items()}
        return Said(text, self._encoder(text), None, names)

    def _confidence(self, candidates: Sequence[Candidate]) -> float:
        if not candidates:
            return 0.0
        return math.exp(candidates[0].logprob / self._calibration.temperature)


def renamed(program: str, names: Mapping[str, str]) -> str:
    """The program with whole identifiers replaced, all at once."""
    return re.sub(r"\b[a-z]\w*\b", lambda match: names.get(match.group(), match.group()), program)


def choose_nouns(mentions: Sequence[Mention]) -> dict[str, str]:
    """A noun of the model for each slot: its own word where it is one, else one not in use.

    Slots beyond the model's nouns are left out, so the sentence cannot be translated as a whole.
    """
    nouns: dict[str, str] = {}
    for mention in mentions:
        own = [noun for noun in nouns_of(mention.text.lower()) if noun not in nouns.values()]
        if mention.slot not in nouns and own:
            nouns[mention.slot] = own[-1]
    for mention in mentions:
        free = [noun for noun in NOUNS if noun not in nouns.values()]
        if mention.slot not in nouns and free:
            nouns[mention.slot] = free[0]
    return nouns


def write_nouns(text: str, mentions: Sequence[Mention], nouns: dict[str, str]) -> str:
    """The sentence with each mention replaced by its slot's noun, articles in agreement."""
    result = text
    for mention in sorted(mentions, key=lambda one: -one.start):
        noun = nouns.get(mention.slot, mention.text)
        result = result[: mention.start] + noun + result[mention.end :]
    return with_articles(result)
