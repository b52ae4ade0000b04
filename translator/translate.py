"""The translator as it is served: sentence with linked mentions in, scored programs out.

Each mention is written as one of the nouns that the model knows, the sentence is translated, and
the nouns become slots again (argument identification). So any object name works, and one
translation serves every object that a slot may be bound to.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Sequence
from pathlib import Path

import msgspec

from agent.messages import Candidate, Mention, TranslateRequest, Translation
from translator.data import nouns_of, rename, with_articles
from translator.decode import Decoder
from translator.embed import SentenceEncoder
from translator.vocabulary import NOUNS, Vocabulary, detokenize, words_of

WEIGHTS = Path(os.environ.get("ARMCHAT_MODEL_DIR") or Path(__file__).parent / "weights")
"""Where the weights are: ``ARMCHAT_MODEL_DIR`` or the package's own."""


class Calibration(msgspec.Struct, frozen=True):
    """Maps a candidate's log-probability to a probability of being right (fit on valid)."""

    temperature: float = 1.0


class Translator:
    """MiniLM, the seq2seq model and its vocabulary; a call is thread-safe."""

    def __init__(self, folder: Path = WEIGHTS, model: Path | None = None) -> None:
        trained = model or folder
        self._vocabulary = Vocabulary.load(trained / "vocabulary.json")
        self._encoder = SentenceEncoder(folder)
        self._decoder = Decoder(trained, self._vocabulary)
        card = trained / "calibration.json"
        self._calibration = (
            msgspec.json.decode(card.read_bytes(), type=Calibration)
            if card.is_file()
            else Calibration()
        )

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; candidates are programs over the request's slots, best first."""
        began = time.perf_counter()
        nouns = choose_nouns(request.mentions)
        sentence = write_nouns(request.text, request.mentions, nouns)
        found = self._decoder.search(
            self._encoder(sentence), request.kind, set(nouns.values()), request.k
        )
        slots = {noun: slot for slot, noun in nouns.items()}
        candidates = tuple(
            Candidate(
                rename(detokenize(self._vocabulary.decode(one.tokens[:-1])), slots),
                one.logprob,
                len(one.tokens),
            )
            for one in found
        )
        return Translation(
            candidates,
            self._confidence(candidates),
            1000 * (time.perf_counter() - began),
            tuple(word for word in words_of(sentence) if word not in self._vocabulary.words),
        )

    def _confidence(self, candidates: Sequence[Candidate]) -> float:
        if not candidates:
            return 0.0
        return math.exp(candidates[0].logprob / self._calibration.temperature)


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
