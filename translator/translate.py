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

from agent.messages import Attention, Candidate, Kind, Mention, TranslateRequest, Translation
from agent.program import MAX_LINE
from translator.data import nouns_of, with_articles
from translator.decode import Decoder, Hypothesis
from translator.embed import sentence_encoder
from translator.marked import apart, marks_of, read
from translator.vocabulary import NOUNS, Vocabulary, detokenize, legible, words_of

WEIGHTS = Path(os.environ.get("ARMCHAT_MODEL_DIR") or Path(__file__).parent / "weights")
"""Where the weights are: ``ARMCHAT_MODEL_DIR`` or the package's own."""
PAPER, PRODUCT = WEIGHTS / "paper", WEIGHTS / "skills"
"""The paper's model, and the one that is served."""


class Calibration(msgspec.Struct, frozen=True):
    """Maps a log-probability to a probability of being right (fit on held-out parts)."""

    temperature: float = 1.0


class Said(NamedTuple):
    """A request as the model gets it: embeddings (T, 384), slot numbers (T,) or None, the tokens
    for things that its program may hold, and what each of them is in the request. ``taken`` are
    the parts of the text (start, end) that stand for something, and what was said there."""

    text: str
    states: NDArray[np.float32]
    slots: NDArray[np.int64] | None
    names: Mapping[str, str]
    taken: Sequence[tuple[int, int, str]] = ()


class Translator:
    """MiniLM, a seq2seq model and its vocabulary; a call is thread-safe."""

    def __init__(self, model: Path = PRODUCT, folder: Path = WEIGHTS) -> None:
        """``model``: folder of the trained model; ``folder``: that of the frozen encoder.

        Raises TranslatorError naming a missing or broken file.
        """
        self._vocabulary = Vocabulary.load(model / "vocabulary.json")
        self._encoder = sentence_encoder(folder)
        self._decoder = Decoder(model, self._vocabulary)
        card = model / "calibration.json"
        self._calibration = (
            msgspec.json.decode(card.read_bytes(), type=Calibration)
            if card.is_file()
            else Calibration()
        )

    @property
    def reads_names(self) -> bool:
        """Whether what things are called reaches the model (the paper's), or only slots do."""
        return self._vocabulary.dialect == "paper"

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; candidates are programs over the request's slots, best first."""
        began = time.perf_counter()
        said = self._said(request)
        candidates = self._candidates(said, request.kind, request.k)
        unknown = [word for word in words_of(said.text) if word not in self._vocabulary.words]
        return Translation(
            candidates,
            self._confidence(candidates),
            1000 * (time.perf_counter() - began),
            tuple(unknown) if self.reads_names else (),
        )

    def as_written(self, text: str, kind: Kind, nouns: Sequence[str]) -> tuple[Candidate, ...]:
        """Candidates for a sentence that is read as it stands, about things of these nouns.

        For a model over nouns: whatever the sentence calls them, its words reach the model.
        """
        said = Said(text, self._encoder(text), None, {noun: noun for noun in nouns})
        return self._candidates(said, kind, 4)

    def attend(self, request: TranslateRequest) -> tuple[Attention, ...]:
        """What was looked at for each candidate of a request, best first."""
        said = self._said(request)
        pieces, columns = self._columns(said)
        return tuple(
            Attention(
                self._body(one, said),
                tuple(renamed(legible(self._vocabulary.pieces[i]), said.names) for i in one.tokens),
                tuple(pieces),
                tuple(
                    tuple(float(row[list(column)].sum()) for column in columns)
                    for row in one.attention
                ),
            )
            for one in self._search(said, request.kind, request.k)
        )

    def _columns(self, said: Said) -> tuple[list[str], list[list[int]]]:
        """The sentence's pieces by name and number; those that stand for one thing are one."""
        names, columns, before = list[str](), list[list[int]](), None
        read = zip(self._encoder.pieces(said.text), self._encoder.places(said.text), strict=True)
        for number, (piece, (start, end)) in enumerate(read):
            inside = next((one for one in said.taken if one[0] <= start < end <= one[1]), None)
            if inside is not None and inside == before:
                columns[-1].append(number)
            else:
                names.append(piece if inside is None else inside[2])
                columns.append([number])
            before = inside
        return names, columns

    def _candidates(self, said: Said, kind: Kind, k: int) -> tuple[Candidate, ...]:
        found = [(self._body(one, said), one) for one in self._search(said, kind, k)]
        return tuple(
            Candidate(body, one.logprob, len(one.tokens))
            for body, one in found
            if all(len(line) <= MAX_LINE for line in body.split("\n"))
        )

    def _search(self, said: Said, kind: Kind, k: int) -> list[Hypothesis]:
        return self._decoder.search(said.states, kind, set(said.names), k, said.slots)

    def _body(self, one: Hypothesis, said: Said) -> str:
        return renamed(detokenize(self._vocabulary.decode(one.tokens[:-1])), said.names)

    def _said(self, request: TranslateRequest) -> Said:
        return self._over_nouns(request) if self.reads_names else self._over_slots(request)

    def _over_slots(self, request: TranslateRequest) -> Said:
        sentence, names = read(request)
        states, slots = self._encoder.marked(*sentence)
        spoken = [request.text[one.start : one.end] for one in apart(marks_of(request)[0])]
        taken = [(one.start, one.end, words)
                 for one, words in zip(sentence.marks, spoken, strict=True)]  # fmt: skip
        return Said(sentence.text, states, slots, names, taken)

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
