"""A sentence's frame: its words, what they name left out, so that its shape can be looked at.

"Put the red mug on the tray, it is fine there" is "put #0 on #1 , @2 is fine there".
"""

from __future__ import annotations

import re
from typing import NamedTuple

from clarifier.spoken import Linked, Spoken

_NUMBER = re.compile(r"[#@](\d+)")


class Frame(NamedTuple):
    """``text``: tokens joined by spaces, "#n" for what is named, "@n" for a pronoun; ``named``:
    the mentions by that number; ``tokens``: the sentence's token that begins at a place of
    ``text``."""

    text: str
    named: tuple[Spoken, ...]
    tokens: dict[int, int]

    def token(self, at: int) -> int:
        """The sentence's first token at or behind a place of ``text``."""
        return next(self.tokens[place] for place in sorted(self.tokens) if place >= at)

    def among(self, said: str | None) -> tuple[Spoken, ...]:
        """The mentions in a part of the frame, in order."""
        return tuple(self.named[int(number)] for number in _NUMBER.findall(said or ""))


def _means_nothing(one: Spoken) -> bool:
    """Whether a mention is no thing of the table: "your paws", "no other object", "the only thing
    that"."""
    if one.phrase is None:
        return False
    vague = one.phrase.det == "no" or (
        "only" in one.phrase.modifiers and one.phrase.head[-1:] in (("thing",), ("object",))
    )
    return vague or not one.mention.objects


def _is_everything(one: Spoken, at: int, linked: Linked) -> bool:
    """Whether a mention is "everything", or "everything else"."""
    said = [token.text for token in linked.tokens[at : one.last]]
    return said in (["everything"], ["everything", "else"])


def frame(linked: Linked) -> Frame:
    """The frame of a sentence. "Everything" alone stays a word, as does what names nothing."""
    opened = {one.opened: one for one in linked.spoken if one.last > one.opened}
    words, tokens, named = list[str](), dict[int, int](), list[Spoken]()
    at, length = 0, 0
    while at < len(linked.tokens):
        one, text = opened.get(at), linked.tokens[at].text
        tokens[length] = at
        if one is None or _means_nothing(one) or _is_everything(one, at, linked):
            words.append(text)
            at += 1
        else:
            words.append(f"{'@' if one.phrase is None else '#'}{len(named)}")
            named.append(one)
            at = one.last
        length += len(words[-1]) + 1
    tokens[length] = len(linked.tokens)
    return Frame(" ".join(words), tuple(named), tokens)
