"""What wants nothing done: "leave it as it is", "hands off", "they may stay where they are"."""

from __future__ import annotations

import re

_NO_PLACE = (r"(?!(?:on|in|by|at|next|near|beside|to|behind|under|left|right|into|onto|from|"
             r"between|and)\b)")  # fmt: skip
_STAY = (r"(?:exactly |just )?(?:as (?:it|they|everything)(?:'s| is|'re| are)|where (?:it|they|"
         r"everything)(?:'s| is|'re| are| stands?| lies?)|alone|be|there|put|in (?:its|"
         r"their) places?|untouched|like that|as is|that way)")  # fmt: skip
_WHAT = (r"(?:it|them|they|that|this|everything|things|all|the whole lot|all of it|all of them|"
         rf"both|(?:the|my|that) (?:{_NO_PLACE}\w+ ){{0,3}}{_NO_PLACE}\w+)")  # fmt: skip
_NOTHING = re.compile(
    rf"^(?:please |kindly |just |simply |you (?:can |may |should )?|we |"
    rf"i )*(?:do nothing(?: at all)?|nothing(?: at all)?(?: to do| needs doing| happens)?|"
    rf"do not do anything|don't do anything|don't (?:bother|move|touch|disturb|do|"
    rf"shift)(?: {_WHAT})?|do not (?:bother|move|touch|disturb|shift)(?: {_WHAT})?|(?:leave|let|"
    rf"keep)(?: {_WHAT})?(?: (?:stay|remain|stand|lie|sit))?(?: {_STAY})*|{_WHAT} (?:can |may |"
    rf"should |must |will |could )?(?:just |simply )?(?:stays?|remains?)(?: {_STAY})*|(?:they|it|"
    rf"that)(?:'s| is|'re| are) (?:fine|ok|okay|good|all right|alright)(?: {_STAY})*|stay put|"
    rf"hands off|(?:never mind|forget (?:it|about it)|no action|no need|wait|skip it|hold off|"
    rf"stop|stay still))[\s.!]*$",
    re.IGNORECASE,
)  # fmt: skip


def wants_nothing(deed: str) -> bool:
    """Whether a deed is to leave things as they are, and nothing else."""
    return _NOTHING.match(deed) is not None
