"""A pretrained code or language model in the translator's place: same request, same answer.

With an adapter of ours (`translator.finetune`) it reads slots and writes pieces; as it came it is
shown examples (`translator.prompt`) and writes sub-words. Either way grammar and scope say what may
come next, so nothing malformed can be written. Needs the ``[pretrained]`` extra.
"""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Protocol

import msgspec

from agent.messages import Attention, Candidate, Kind, TranslateRequest, Translation
from agent.program import MAX_LINE
from translator.causal import Causal, Reading
from translator.finetune import OURS
from translator.marked import Marked, read
from translator.prompt import Prompts
from translator.speech import Speech, Words
from translator.spelling import InPieces, InWords
from translator.subwords import LONGEST, Found, Writer
from translator.translate import Calibration, renamed
from translator.vocabulary import Vocabulary, detokenize

PRODUCT_ADAPTER = Path(__file__).parent / "weights" / "pretrained"
"""What was learnt for gemma3-270m (its card: CARD.md there)."""
LONGER = 1.5
"""Times the longest program shown that one written by examples may be. Of grown held-out sentences
5 in 100 mean a longer one; a model as it came often repeats a line without an end."""


class Way(Protocol):
    """How a model is asked."""

    vocabulary: Vocabulary

    def found(self, said: Marked, kind: Kind, things: set[str], width: int) -> list[Found]:
        """The best programs for a sentence, best first."""
        ...


class Tuned:
    """Asked by an adapter's pieces."""

    def __init__(self, base: Path, adapter: Path, quantised: bool) -> None:
        self.vocabulary = Vocabulary.load(adapter / "vocabulary.json")
        self._speech = Speech(Words(base), self.vocabulary)
        self._causal = Causal(base, adapter=adapter / "adapter.safetensors", quantised=quantised)
        self._writer = Writer(self.vocabulary, InPieces(self.vocabulary))

    def found(self, said: Marked, kind: Kind, things: set[str], width: int) -> list[Found]:
        """The best programs for a sentence, best first."""
        prompt = self._speech.sentence(said, kind)
        return self._writer.search(self._causal.reading(), prompt, kind, things, width)


class FewShot:
    """Asked by examples; what is the same for all sentences is read once."""

    def __init__(self, base: Path, quantised: bool) -> None:
        self.vocabulary = Vocabulary.load(OURS)
        words = Words(base)
        self._prompts = Prompts(words, self.vocabulary)
        written = InWords(self.vocabulary, words)
        self._causal = Causal(base, rows=written.rows, quantised=quantised)
        self._writer = Writer(self.vocabulary, written)
        self._pages: dict[Kind, Reading] = {}

    def found(self, said: Marked, kind: Kind, things: set[str], width: int) -> list[Found]:
        """The best programs for a sentence, best first."""
        if kind not in self._pages:
            page = self._causal.reading()
            page.begin(self._prompts.page(kind))
            self._pages[kind] = page
        examples = self._prompts.examples(said, kind)
        reading = self._causal.reading(self._pages[kind])
        longest = min(LONGEST, int(LONGER * examples.longest))
        return self._writer.search(reading, examples.numbers, kind, things, width, longest)


class PretrainedTranslator:
    """A pretrained model that translates; a call is thread-safe."""

    reads_names = False

    def __init__(self, base: Path, adapter: Path | None = None, quantised: bool = True) -> None:
        """``base``: folder of the model; ``adapter``: folder of what was learnt, None: by examples.

        Raises TranslatorError naming what is missing.
        """
        self._way: Way = (
            FewShot(base, quantised) if adapter is None else Tuned(base, adapter, quantised)
        )
        card = None if adapter is None else adapter / "calibration.json"
        self._calibration = (
            msgspec.json.decode(card.read_bytes(), type=Calibration)
            if card is not None and card.is_file()
            else Calibration()
        )

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; candidates are programs over the request's slots, best first."""
        began = time.perf_counter()
        said, names = read(request)
        found = self._way.found(said, request.kind, set(names), request.k)
        every = (self._candidate(one, names) for one in found)
        candidates = tuple(
            one for one in every if all(len(line) <= MAX_LINE for line in one.body.split("\n"))
        )
        confidence = 0.0
        if candidates:
            confidence = math.exp(candidates[0].logprob / self._calibration.temperature)
        return Translation(candidates, confidence, 1000 * (time.perf_counter() - began))

    def attend(self, request: TranslateRequest) -> tuple[Attention, ...]:
        """Nothing: what a model of many layers looked at is not one row of weights a symbol."""
        return ()

    def _candidate(self, one: Found, names: dict[str, str]) -> Candidate:
        tokens = self._way.vocabulary.decode(one.pieces[:-1])
        return Candidate(renamed(detokenize(tokens), names), one.logprob, len(one.pieces))
