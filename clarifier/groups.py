"""Noun phrases without a noun that speak of several things ("everything", "the rest", "all of
them"), and how something is left out of a group ("all blocks except ...").
"""

from __future__ import annotations

from collections.abc import Sequence

from clarifier.lexicon import Lexicon
from clarifier.pieces import ARTICLES, DETERMINERS, FREE, JOINTS, Chunk, Group, Phrase
from clarifier.words import number

_RUNS: tuple[tuple[str, Group], ...] = (
    ("every single one of the others", "others"), ("every single one of them", "them"),
    ("every one of the others", "others"), ("every one of them", "them"),
    ("each and every one of them", "them"), ("each and every one", "them"),
    ("every single one", "them"), ("every single thing", "all"), ("each and every thing", "all"),
    ("all of the others", "others"), ("all of the rest", "rest"), ("each of the others", "others"),
    ("all the other ones", "others"), ("all other ones", "others"),
    ("the remaining ones", "others"),
    ("all the others", "others"), ("all the rest", "rest"), ("all the remaining", "rest"),
    ("the other ones", "others"), ("all others", "others"), ("the others", "others"),
    ("those others", "others"), ("these others", "others"), ("every other one", "others"),
    ("the rest of them", "others"), ("the rest of it", "rest"), ("the rest", "rest"),
    ("the remainder", "rest"), ("everything else", "rest"), ("all else", "rest"),
    ("whatever else is there", "rest"), ("the whole lot", "all"),
    ("the lot", "all"), ("the lot of them", "them"), ("everything", "all"), ("all of it", "all"),
    ("all of them", "them"), ("all of these", "them"), ("all of those", "them"),
    ("each of them", "them"), ("each of these", "them"), ("each of those", "them"),
    ("them all", "them"), ("these all", "them"), ("each one", "them"), ("every one", "them"),
    ("both of them", "them"), ("both of these", "them"), ("both of those", "them"),
    ("them both", "them"), ("both ones", "them"),
)  # fmt: skip
_GROUPS = tuple(
    (tuple(run.split()), group) for run, group in sorted(_RUNS, key=lambda one: -len(one[0]))
)
_WHATEVER = tuple(
    tuple(run.split())
    for run in (
        "whatever is", "whatever's", "whatever stands", "whatever lies", "whatever sits",
        "whatever", "what is", "what's", "what stands", "what lies", "what sits",
        "anything that is", "anything",
        "all that is", "all that's", "all that stands", "all that lies", "everything that is",
        "everything that's", "everything that stands", "everything that lies",
    )
)  # fmt: skip
"""Behind these a relation must follow: "whatever is on the plate"."""
_EXCEPTIONS = tuple(
    tuple(run.split())
    for run in (
        "with the exception of", "with exception of", "except for", "apart from", "aside from",
        "other than", "but not", "and not", "just not", "save for", "but for", "excepting",
        "excluding", "not including", "leaving out", "not counting", "rather not", "except",
        "minus", "save", "bar", "though not", "only not",
    )
)  # fmt: skip
_SOME_ONE = tuple(
    (*one.split(), "of", them)
    for one in ("one", "any one", "any", "either", "either one", "just one", "a single one")
    for them in ("them", "these", "those")
)
_LEANING = frozenset({"on", "in", "left", "right", "behind", "near", "next", "by", "at", "over"}
                     | {"under", "inside", "between", "beside", "above", "below"})  # fmt: skip
_NOT_BEHIND_ALL = frozenset({"together", "straight", "round", "around"})
_BUT = frozenset({"but", "except", "bar", "save"})
_OF_THEM = (("of", "them"), ("of", "these"), ("of", "those"))


def group_phrase(words: Sequence[str], at: int, lexicon: Lexicon) -> Phrase | None:
    """The phrase of several unnamed things that starts at a word, or None."""
    for run, group in _GROUPS:
        if _match(words, at, run):
            if _word(words, at + len(run)) in ("of", "out"):
                continue
            return _group(words, at, at + len(run), group)
    for run in _SOME_ONE:
        if _match(words, at, run):
            return Phrase(at, at, at + len(run), "any", None, (), (), group="them")
    for run in _WHATEVER:
        behind = _word(words, at + len(run))
        told = behind in _LEANING or behind in lexicon.colors or bool(lexicon.material(behind)[0])
        if _match(words, at, run) and (told or (behind == "made" and len(run) > 1)):
            return Phrase(at, at, at + len(run), "all", None, (), (), True, group="all")
    return _alone(words, at, lexicon)


def _group(words: Sequence[str], at: int, last: int, group: Group) -> Phrase:
    both = "both" in words[at:last]
    first = at
    while first < last - 1 and words[first] in ("the", "all", "both", "these", "those", "of"):
        first += 1
    whole = words[first] in ("them", "it")
    det = "both" if both else "others" if group in ("rest", "others") else "all"
    return Phrase(at, at if whole else first, last, det, None, (), (), True, group=group)


def _alone(words: Sequence[str], at: int, lexicon: Lexicon) -> Phrase | None:
    """ "push all to the left", "touch both", "lift each": the word alone behind its verb."""
    if words[at] not in ("all", "both", "each") or not at:
        return None
    before, after = words[at - 1], _word(words, at + 1)
    said = lexicon.verb(before) is not None or before in ("up", "down", "over", "of", "with")
    over = after in ("", "to", "onto", "into", "into", "from") or after in JOINTS | _LEANING
    over = over or after in lexicon.words("directions") - {
        "together",
        "straight",
        "round",
        "around",
    }
    if not said or not over or _match(words, at + 1, ("the", "way")):
        return None
    if after in _BUT and number(_word(words, at + 2)) is not None:
        return None  # "all but two of the pegs" are pegs
    group: Group = "all" if words[at] == "all" else "them"
    return Phrase(at, at, at + 1, words[at], None, (), (), True, group=group)


def counted(words: Sequence[str], opened: int, at: int, count: float | None) -> Phrase | None:
    """ "the two", "all three of them", "two of them": a number in place of a noun, up to ``at``."""
    if count is None:
        return None
    following = tuple(words[at : at + 2])
    partly = following in _OF_THEM or (words[at - 1] == "of" and _word(words, at) == "them")
    last = at + (2 if following in _OF_THEM else 1) if partly else at
    det = words[opened] if words[opened] in DETERMINERS - FREE else ""
    if det == "no" or not (det or partly) or (not partly and count < 2):
        return None
    if not partly and number(words[at - 1]) is None and words[at - 1] not in ("pair", "couple"):
        return None
    whole = det in ("all", "the", "these", "those", "both") or det in ARTICLES
    return Phrase(opened, opened, last, "all" if whole else "", count, (), (), count != 1,
                  group="them")  # fmt: skip


def exception(words: Sequence[str], at: int) -> Chunk | None:
    """ "except for", "other than": what follows is left out of a group."""
    for run in _EXCEPTIONS:
        if _match(words, at, run):
            return Chunk("except", at, at + len(run))
    return None


def _match(words: Sequence[str], at: int, run: Sequence[str]) -> bool:
    return tuple(words[at : at + len(run)]) == tuple(run)


def _word(words: Sequence[str], at: int) -> str:
    return words[at] if at < len(words) else ""
