"""Training samples: expert pairs, augmented.

Nouns are swapped at random in sentence and program together (arXiv 2012.13695, section IV-A).
Beyond the paper, pairs of one task are joined into sentences of several phrases, programs one
after the other, so that the model sees that phrases are carried out in turn.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from agent.messages import Kind
from translator.vocabulary import NOUNS

_NOUN = re.compile(rf"\b({'|'.join(NOUNS)})\b")
_ARTICLE = re.compile(rf"\b(an?) (?=({'|'.join(NOUNS)})\b)", re.IGNORECASE)


CONNECTIVES = (", ", " and ", ", and ", ", then ", " and then ", ", and then ", ". ", ". Then ")
"""What stands between two phrases of a joined sentence."""
LONGEST_JOINED = 900
"""Characters of a joined program at most: longer ones cost more time than they teach."""


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


def swap_nouns(sample: Sample, rng: random.Random, nouns: Sequence[str] = NOUNS) -> Sample:
    """The sample with other nouns, drawn without replacement from ``nouns``."""
    old = nouns_of(f"{sample.say} {sample.program}")
    names = dict(zip(old, rng.sample(nouns, len(old)), strict=True))
    say = with_articles(rename(sample.say, names))
    return Sample(say, rename(sample.program, names), sample.kind)


def set_apart(parts: Sequence[Sample], rng: random.Random) -> Iterator[Sample]:
    """The samples one by one, nouns swapped so that no two speak of the same.

    Raises ValueError when they need more nouns than there are.
    """
    order = rng.sample(NOUNS, len(NOUNS))
    used = 0
    for part in parts:
        count = len(nouns_of(f"{part.say} {part.program}"))
        yield swap_nouns(part, rng, order[used : used + count])
        used += count


def join(parts: Sequence[Sample], rng: random.Random) -> Sample:
    """Several samples of one task, about different objects, as one sentence and one program.

    Raises ValueError when they need more nouns than there are.
    """
    say, programs = "", []
    for mine in set_apart(parts, rng):
        say += (rng.choice(CONNECTIVES) if say else "") + mine.say.rstrip(".!? ")
        programs.append(mine.program)
    return Sample(say, "\n".join(programs), parts[0].kind)


def epoch(
    samples: Sequence[Sample], copies: int, rng: random.Random, joined: float = 0.0
) -> list[Sample]:
    """One epoch's samples: each pair ``copies`` times with other nouns, shuffled.

    A share ``joined`` of them is followed by one or two short other pairs of the same task.
    """
    result = []
    for sample in samples:
        others = [one for one in samples if one.kind == sample.kind]
        for _ in range(copies):
            parts = [sample]
            if rng.random() < joined:
                parts += rng.sample(others, min(len(others), rng.choice((1, 1, 2))))
                rng.shuffle(parts)
            short = sum(len(part.program) for part in parts) <= LONGEST_JOINED
            fits = sum(len(nouns_of(f"{p.say} {p.program}")) for p in parts) <= len(NOUNS)
            joins = len(parts) > 1 and short and fits
            result.append(join(parts, rng) if joins else swap_nouns(sample, rng))
    rng.shuffle(result)
    return result
