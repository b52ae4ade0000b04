"""The words that make a deed depend on something: "if", "unless", "otherwise", "if it isn't"."""

from __future__ import annotations

import re

_MARK = re.compile(
    r"(?:^|(?<=[\s,;.:!?(]))(?P<lead>(?:(?:and|but|so|or|also)[\s,]+)*)(?:(?P<ask>(?:please |"
    r"kindly |first |could you |can you )*(?:check|see|look|find out|verify|have a look|"
    r"take a look|tell me)(?: first| please)?,? (?:if|whether))|(?P<other>otherwise|or else|else|"
    r"in (?:any |every |all |the )?other cases?|failing that)|(?P<unless>unless)|"
    r"(?P<should>should)|(?P<cond>(?:only |but only |just )?(?:if and only if|if|whenever|when|"
    r"in case|provided(?: that)?|providing(?: that)?|as long as|so long as|assuming(?: that)?|"
    r"supposing(?: that)?|suppose|on (?:the )?condition that|in the event that)))\b[\s,:]*",
    re.IGNORECASE,
)
_NOT_MARK = re.compile(
    r"\b(?:as|even|what|see|know|wonder|wondering|sure|grateful|glad|happy|nice|good|better|best|"
    r"great|lovely|mind|fine|ok|okay|helpful|kind|delighted|pleased|obliged|wonderful|perfect|"
    r"ideal|thankful|cool|matter|care|(?:appreciate|love|like|prefer|appreciated)(?: it)?)\s+$",
    re.IGNORECASE,
)
"""Behind these "if" opens a wish, or a question."""
_SOME_ELSE = re.compile(r"(?:where|thing|body|one|what|who)$", re.IGNORECASE)
_YES = re.compile(
    r"^(?:so|yes|yeah|yep|true|(?:that|this|it)(?:'s| is)(?: indeed)? (?:so|true|the case)|indeed)$"
)
_NO = re.compile(
    r"^(?:not|no|nope|none|false|not so|(?:that|this|it)(?:'s| is) not (?:so|true|the case)|"
    r"(?:that|this|it) isn't (?:so|true|the case))$"
)
PLAINLY = re.compile(r"^(?:(?P<yes>so|yes|yep|yeah)\b|no(?:t|pe)?(?=\s*[,;:.]))[\s,;:.]*", re.I)
_IS = re.compile(
    r"^(?:(?:it|that|he|she) (?:is|does|has|was)(?: so)?|it's so|they (?:are|do|have)|there (?:is|"
    r"are)(?: one| any| some)?|(?:you|we|i) (?:do|can|have))$"
)
_IS_NOT = re.compile(
    r"^(?:(?:it|that|this|he|she)(?:'s|s)? (?:(?:is|does|has) )?not|(?:it|that|this|he|"
    r"she) ?(?:isn't|doesn't|hasn't|isnt)|(?:they|you|we|i)(?:'re| are| do| have| can)? ?(?:not|"
    r"aren't|don't|haven't|can't|arent)|(?:there|their)(?:'s|s| is| are)? ?(?:not|isn't|aren't|"
    r"isnt|none|no)(?: one| any| one there)?|isn't|(?:it|they|that|this|he|she)(?:'s| is|'re| are|"
    r" be| was)? (?:in |on |at |of |lying |standing )*(?:any(?:thing|where)? (?:else|"
    r"other(?: \w+)?)|anywhere else|elsewhere|some(?:where|thing) else|(?:a|some) (?:different|"
    r"other) \w+|another \w+|different|the other way (?:a?round|about)|the opposite|"
    r"any other \w+))$"
)
OTHERWISE_LAST = re.compile(r"^(?P<one>.+)(?:,\s*(?:and |or )?|\s+and )(?P<other>[^,;.]+?),? "
                             r"(?:otherwise|if not)[\s.!]*$", re.IGNORECASE)  # fmt: skip
ANSWERS = re.compile(r"\?|[-=]+>|→")


def depends(text: str) -> bool:
    """Whether a sentence can be a condition at all."""
    return _MARK.search(text) is not None or ANSWERS.search(text.rstrip(" ?!.")) is not None


def marks_of(text: str) -> list[re.Match[str]]:
    """What opens the conditions of a sentence and their other branches, in order. Groups: ``ask``
    ("check whether"), ``other`` ("otherwise"), ``unless``, ``should``, ``cond``."""
    return [mark for mark in _MARK.finditer(text) if _opens(mark, text[: mark.start()])]


def _opens(mark: re.Match[str], before: str) -> bool:
    """Whether a mark opens a condition: "should" only where a clause begins."""
    if mark["should"]:
        return not before.strip() or before.rstrip()[-1] in ",.;:!?"
    if mark["other"]:
        return not _SOME_ELSE.search(before.rstrip())
    return mark["cond"] is None or not _NOT_MARK.search(before)


def answered(said: str, negative: bool) -> bool | None:
    """Whether "so", "it isn't" and their like hold where the clause before them does, which may be
    a ``negative`` one; None for other words."""
    if _YES.match(said) or _NO.match(said):
        return _YES.match(said) is not None
    if _IS.match(said) or _IS_NOT.match(said):
        return (_IS.match(said) is not None) is not negative
    return None


_COURTESY = re.compile(
    r"[^,.;]*\b(?:were|could|would|might)\b|(?:you|u|ya|poss|possible|need|needed|necessary|i|we|"
    r"not|so)\b|(?:it|that)(?:'s| is)(?: not| no)? (?:ok|okay|fine|possible|convenient|handy|too|"
    r"all right|alright|easier|trouble|bother|a )|(?:it|that) (?:helps|suits|pleases|fits)|"
    r"there(?:'s| is) (?:still )?(?:enough )?(?:room|space)",
    re.IGNORECASE,
)
"""Conditions of courtesy; whether there is room the check finds out."""


def depends_on_more(text: str) -> bool:
    """Whether a sentence makes its deed depend on something that is not courtesy."""
    return any(
        (mark["cond"] or mark["unless"])
        and not mark.group().lower().strip(" ,:").endswith(("when", "whenever"))
        and _COURTESY.match(text, mark.end()) is None
        for mark in marks_of(text)
    )
