"""Which translator speaks in this process: chosen by configuration, changed while it runs."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

from agent.config import TranslatorConfig
from agent.errors import TranslatorError
from agent.messages import Attention, TranslateRequest, Translation

MODELS = ("seq2seq", "pretrained", "cascade")
"""The translators by name; a path names the folder of a seq2seq model."""
Say = Callable[[str], None]


def unsaid(line: str) -> None:
    """Progress that nobody is told of."""


class Translates(Protocol):
    """A translator: a request in, scored programs out."""

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; best first."""
        ...

    def attend(self, request: TranslateRequest) -> Sequence[Attention]:
        """What was looked at for each candidate; none where that is not known."""
        ...


class Speakers:
    """The translators of this process, each loaded when it is first chosen; safe from any thread.

    Sentences are translated whole or phrase by phrase (`translator.phrases`).
    """

    def __init__(self, config: TranslatorConfig) -> None:
        self._config = config
        self._loading = threading.Lock()
        self._loaded: dict[str, Translates] = {}
        self.model = config.model or "seq2seq"

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate with the model that is chosen."""
        from translator.phrases import PhraseTranslator

        return PhraseTranslator(self.whole())(request)

    def attend(self, request: TranslateRequest) -> tuple[Attention, ...]:
        """What the model that is chosen looks at for each candidate of a request."""
        from translator import phrases

        return phrases.attend(request, self.whole().attend)

    def whole(self, say: Say = unsaid) -> Translates:
        """The model that is chosen, which takes sentences whole. Raises TranslatorError."""
        return self._ready(self.model, say)

    def prepare(self, say: Say) -> None:
        """Load a model that the person chose before the first sentence, saying so.

        The one that comes with armchat is there in a moment and loads with the first sentence.
        Raises TranslatorError that says what to type where the model is not here.
        """
        if self.model != MODELS[0]:
            self.whole(say)

    def choose(self, model: str, say: Say = unsaid) -> None:
        """Load a model and speak with it from the next sentence on; the old one speaks meanwhile.

        Raises TranslatorError that says what to type where it is not here.
        """
        self._ready(model, say)
        self.model = model

    def _ready(self, model: str, say: Say) -> Translates:
        with self._loading:
            if model not in self._loaded:
                began = time.perf_counter()
                say(f"loading the model {model} ...")
                self._loaded[model] = self._load(model, say)
                say(f"{model} is ready ({time.perf_counter() - began:.1f} s)")
            return self._loaded[model]

    def _load(self, model: str, say: Say) -> Translates:
        if model == "pretrained":
            return self._pretrained(say)
        if model == "cascade":
            from translator.cascade import Cascade

            fast = self._loaded.get("seq2seq") or self._load("seq2seq", say)
            slow = self._loaded.get("pretrained") or self._load("pretrained", say)
            self._loaded |= {"seq2seq": fast, "pretrained": slow}
            return Cascade(fast, slow)
        from translator.translate import Translator

        if model == "seq2seq":
            return Translator()
        if not Path(model).is_dir():
            raise TranslatorError(
                f"no model {model!r}: {', '.join(MODELS)}, or the folder of a trained one"
            )
        return Translator(Path(model))

    def _pretrained(self, say: Say) -> Translates:
        from translator.models import located, need_libraries

        need_libraries()
        base = located(self._config.base)
        from translator.pretrained import PRODUCT_ADAPTER, PretrainedTranslator

        say(f"reading {base} ...")
        if self._config.adapter == "none":
            # a long prompt has activations so unlike that one scale for all spoils the others
            return PretrainedTranslator(base, quantised=False)
        return PretrainedTranslator(base, Path(self._config.adapter or PRODUCT_ADAPTER))
