"""`armchat bench language`: the figures of understanding, on what was held out."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from agent.compose import speakers
from agent.execute import Executor
from agent.messages import Kind, Mention, Quantity, TranslateRequest
from agent.speaking import Translates
from evals.cases import Case, Score, some
from evals.figures import Figure, at_least, at_most
from evals.grown import held_out
from evals.models_table import is_malformed
from evals.outcomes import WILD, play, read_cases
from evals.paper_metric import score, seq2seq
from evals.watched import watched
from translator.corpus.load import load

SENTENCES = 2_500
"""Held-out sentences translated for the malformed rate: four candidates each."""
GRAMMAR, TIMED, RENAMED = 600, 300, 200
"""Sentences of the grammar test, for the times, and with strange names."""
SLOW = ("pretrained", "cascade")
SLOW_SENTENCES = 30
"""Models that take a second for a sentence, and how many of each set they get."""
SCENES = 20
TASKS: tuple[Kind, ...] = ("arrange", "manipulate")
STRANGE = (
    "flurble", "zorbnik", "quextil", "wimpleton", "gadrooble", "snorkblat", "trindle", "ooblet",
)  # fmt: skip
"""Object words that no training sentence and no lexicon knows."""


def language_figures(size: int | None = None) -> dict[str, Figure]:
    """Every figure of the model that is chosen, measured now; ``size``: on at most so many of each
    set, drawn evenly. Without it a model that takes long for a sentence gets `SLOW_SENTENCES`."""
    speaking = speakers()
    translator = speaking.whole()
    usual = SLOW_SENTENCES if speaking.model in SLOW else SENTENCES
    most = usual if size is None else size
    cases = [case for path in sorted(WILD.glob("wild_*.jsonl")) for case in read_cases(path)]
    wild = _played(cases, most, "wild")
    nonsense = _played(read_cases(WILD / "nonsense.jsonl"), most, "nonsense")
    grammar = _grammar(translator, min(GRAMMAR, most))
    right = _share(wild, "right")
    return {
        **_paper(translator),
        **_times(translator, min(TIMED, most)),
        "malformed_of_all_candidates": _malformed(translator, most),
        "grammar_test_right": grammar,
        "wild_right_or_rightly_asked": _percent(right, len(wild), 90.0),
        "wild_wrong": _spread(at_most(100 * _share(wild, "wrong"), 3.0, "%", len(wild))),
        "grammar_less_wild": at_most(
            (grammar.value or 0.0) - 100 * right, 6.0, "points", len(wild)
        ),
        "strange_names_translated_alike": _strange(translator, min(RENAMED, most)),
        "nonsense_left_alone": _percent(_still(nonsense), len(nonsense), 99.0),
    }


def _played(cases: Sequence[Case], most: int, what: str) -> list[Score]:
    drawn = some(cases, most)
    return play(watched(drawn, what, len(drawn)))


def _share(scores: Sequence[Score], outcome: str) -> float:
    return sum(one.outcome == outcome for one in scores) / len(scores)


def _still(scores: Sequence[Score]) -> float:
    return sum(not any(turn.trajectory for turn in one.turns) for one in scores) / len(scores)


def _percent(share: float, n: int, goal: float) -> Figure:
    return _spread(at_least(100 * share, goal, "%", n))


def _spread(figure: Figure) -> Figure:
    """A percentage with its standard error."""
    share = (figure.value or 0.0) / 100
    return replace(figure, stderr=100 * math.sqrt(share * (1 - share) / figure.n))


def _paper(translator: Translates) -> dict[str, Figure]:
    """The paper's metric on its split, with the product's model (which never saw its sentences)."""
    found = {}
    goals = {"arrange": 95.0, "manipulate": 97.0}
    with Executor() as executor:
        for task in TASKS:
            pairs = [pair for pair in load(task) if pair.split == "test"]
            result = score(pairs, seq2seq(translator, executor), executor, SCENES)
            found[f"paper_{task}"] = Figure(
                value=100 * result.accuracy, unit="%", n=len(pairs),
                stderr=100 * result.standard_error, goal=f">= {goals[task]:g}",
                met=100 * result.accuracy >= goals[task],
            )  # fmt: skip
    return found


def _times(translator: Translates, count: int) -> dict[str, Figure]:
    spent = sorted(translator(asked).ms for asked, _ in _held_out(count, 21, "times"))
    p50, p95 = (spent[int(share * (len(spent) - 1))] for share in (0.5, 0.95))
    return {
        "translate_p50": at_most(p50, 30.0, "ms", len(spent)),
        "translate_p95": at_most(p95, 100.0, "ms", len(spent)),
    }


def _malformed(translator: Translates, count: int) -> Figure:
    """Candidates that the parser or the allow-list refuses, of all that the beam holds."""
    bad = total = 0
    for asked, _ in _held_out(count, 22, "malformed"):
        for candidate in translator(asked).candidates:
            total += 1
            bad += is_malformed(candidate.body, asked)
    return at_most(bad, 0, "candidates", total)


def _grammar(translator: Translates, count: int) -> Figure:
    """Unseen combinations of held-out wordings: the very program that is meant. The easy number."""
    right = sum(
        bool(found := translator(request).candidates) and found[0].body == meant
        for request, meant in _held_out(count, 23, "grammar")
    )
    return _percent(right / count, count, 90.0)


def _strange(translator: Translates, count: int) -> Figure:
    """Sentences whose things bear names that nobody has heard of, against the same with "block"."""
    alike = 0
    for request, _ in _held_out(count, 24, "strange names"):
        alike += translator(request).candidates[:1] == translator(_renamed(request)).candidates[:1]
    return _percent(alike / count, count, 99.0)


def _held_out(count: int, seed: int, what: str) -> Iterator[tuple[TranslateRequest, str]]:
    return watched(held_out(count, seed), what, count)


def _renamed(request: TranslateRequest) -> TranslateRequest:
    """The request with a strange word in the place of each mention."""
    both: list[Mention | Quantity] = [*request.mentions, *request.measures]
    spans = sorted(both, key=lambda one: one.start)
    text, at = "", 0
    moved: list[tuple[object, int, int]] = []
    for number, span in enumerate(spans):
        text += request.text[at : span.start]
        strange = isinstance(span, Mention)
        word = STRANGE[number % len(STRANGE)] if strange else span.text
        moved.append((span, len(text), len(text) + len(word)))
        text += word
        at = span.end
    text += request.text[at:]
    places = {id(span): (start, end) for span, start, end in moved}

    def shifted(span: object) -> dict[str, object]:
        start, end = places[id(span)]
        return {"start": start, "end": end, "text": text[start:end]}

    mentions = tuple(replace(one, **shifted(one)) for one in request.mentions)
    measures = tuple(replace(one, **shifted(one)) for one in request.measures)
    return replace(request, text=text, mentions=mentions, measures=measures)
