"""What opens a correction and what it denies: "no wait, not the apple at all, the sponge"."""

from __future__ import annotations

import re

_STRONG = (
    r"(?:no|nope|nah|wait|hang on|hold on|oops|whoops|sorry|i(?:'m| am) sorry|never ?mind|"
    r"wrong(?: one| colou?r| thing)?|my mistake|i beg your pardon|pardon(?: me)?|"
    r"that(?:'s| is| was) wrong|i say wrong|i said wrong|i (?:meant|mean)|it should have been|"
    r"on second thoughts?|that(?:'s| is) not it)"
)
_WEAK = (
    r"(?:oh|ah|hmm+|um+|uh|er+m?|well|actually|shoot|damn|sorry|please|rather|but|thing is|"
    r"i (?:meant|mean|said|wanted|want|would like)|i'd like|it should (?:have been|be)|it was|"
    r"take|do)"
)
_DENIED = r"(?:not |it's not |it was not |it wasn't )(?:the |that |this |a )?(?P<denied>[^,.;!?]*?)"
_OPENS = re.compile(
    rf"^(?:(?:{_WEAK})\b[\s,.:;!-]*)*?"
    rf"(?:(?:{_STRONG})\b[\s,.:;!-]+|{_DENIED}(?: at all)?\s*[,.;!-]+\s*|but )"
    rf"(?:(?:{_STRONG}|{_WEAK})\b[\s,.:;!-]*|{_DENIED.replace('?P<denied>', '?:')}(?: at all)?"
    rf"\s*[,.;!-]+\s*)*(?=\S)",
    re.IGNORECASE,
)
_CLOSES = re.compile(
    r"[\s,]*\b(?:instead|rather|i want|i mean|i meant|please|of course|thanks?(?: you)?)[\s.!,]*$",
    re.IGNORECASE,
)


def behind(text: str) -> str | None:
    """What a correction says instead ("the sponge"); None if the sentence does not open as one."""
    said = text.strip()
    rest = _OPENS.sub("", said, count=1)
    if rest == said:
        return None
    return _CLOSES.sub("", rest).strip(" .!") or None
