"""Training samples: expert pairs, with nouns swapped at random in sentence and program together.

Source: the paper's augmentation (arXiv 2012.13695, section IV-A).
"""

from __future__ import annotations

import random
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from agent.messages import Kind
from translator.vocabulary import NOUNS

_NOUN = re.compile(rf"\b({'|'.join(NOUNS)})\b")
_ARTICLE = re.compile(rf"\b(an?) (?=({'|'.join(NOUNS)})\b)", re.IGNORECASE)


class Sample(NamedTuple):
    """A sentence over `NOUNS`, its program over the same, and its task."""

    say: str
    program: str
    kind: Kind


def nouns_of(text: str) -> list[str]:
    """The model's nouns in a text, in order of first appearance."""
    return list(dict.fromkeys(_NOUN.findall(text)))


def rename(text: str, names: Mapping[str, str]) -> str:
    """Replace whole nouns by others, all at once."""
    return _NOUN.sub(lambda match: names.get(match.group(), match.group()), text)


def with_articles(sentence: str) -> str:
    """The sentence with "a" and "an" in agreement with the nouns behind them."""

    def agree(match: re.Match[str]) -> str:
        article = "an" if match.group(2)[0] in "aeiou" else "a"
        return (article.capitalize() if match.group(1)[0] == "A" else article) + " "

    return _ARTICLE.sub(agree, sentence)


def swap_nouns(sample: Sample, rng: random.Random) -> Sample:
    """The sample with other nouns, drawn without replacement."""
    old = nouns_of(f"{sample.say} {sample.program}")
    names = dict(zip(old, rng.sample(NOUNS, len(old)), strict=True))
    say = with_articles(rename(sample.say, names))
    return Sample(say, rename(sample.program, names), sample.kind)


def epoch(samples: Sequence[Sample], copies: int, rng: random.Random) -> list[Sample]:
    """One epoch's samples: each pair ``copies`` times with other nouns, shuffled."""
    result = [swap_nouns(sample, rng) for sample in samples for _ in range(copies)]
    rng.shuffle(result)
    return result
