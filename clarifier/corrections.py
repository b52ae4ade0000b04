"""What opens a correction and what it denies: "no wait, not the apple at all, the sponge"."""

from __future__ import annotations

import re
from functools import lru_cache

from clarifier.lexicon import load_lexicon

_SOUNDS = r"(?:hmm+|um+|er+m?)"
_MEANT = re.compile(r"(?<=\w),? i (?:meant|mean)[\s.!]*$", re.IGNORECASE)
"""What may stand behind a correction that nothing opens."""
_DENIED = (
    r"(?:not |it's not |it was not |it wasn't |scrap |forget |skip )(?:the |that |this |a )?"
    r"[^,.;!?]*?(?: at all)?"
)


def behind(text: str) -> str | None:
    """What a correction says instead ("the sponge"); None if the sentence does not open as one."""
    opens, closes = _patterns()
    said = text.strip()
    rest = opens.sub("", said, count=1)
    if rest == said and not _MEANT.search(said):
        return None
    return closes.sub("", rest).strip(" .!") or None


@lru_cache(maxsize=1)
def _patterns() -> tuple[re.Pattern[str], re.Pattern[str]]:
    """What a correction opens with, and what it closes with."""
    lexicon = load_lexicon()
    strong, weak = lexicon.either("correcting"), f"(?:{lexicon.either('hesitating')}|{_SOUNDS})"
    denied = rf"{_DENIED}\s*[,.;!-]+\s*"
    opens = (
        rf"^(?:{weak}\b[\s,.:;!-]*)*?(?:{strong}\b[\s,.:;!-]+|{denied}|but )"
        rf"(?:(?:{strong}|{weak})\b[\s,.:;!-]*|{denied})*(?=\S)"
    )
    closes = rf"[\s,]*\b{lexicon.either('closing')}[\s.!,]*$"
    return re.compile(opens, re.IGNORECASE), re.compile(closes, re.IGNORECASE)
