"""What may be passed over when a sentence is heard again without its talk: nothing that is to be
done.

A tagger that takes a wish for talk leaves half a deed behind it, and half a deed is another one. A
hearing that passes over a wish of its own, the thing behind its verb, one of two things that go
together, or what comes behind a correction is no hearing at all.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from difflib import SequenceMatcher
from typing import NamedTuple

from clarifier.lexicon import Lexicon, load_lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked
from scene.types import Scene

_WORD = re.compile(r"\S+")
_ENDS = re.compile(r"[.!?;:,…—–]+$|\.{2,}$")
_OBJECTS = frozenset({"it", "them", "him", "her", "er", "em"})
_DETERMINED = _OBJECTS | {"the", "that", "this", "those", "these", "all", "both", "every"}
_LIGHT = frozenset(
    {"please", "just", "and", "then", "so", "now", "you", "but", "or", "to", "do", "well", "ok"}
    | {"okay", "could", "can", "would", "will", "go", "also"}
)
"""Words that may come before what is to be done."""
_BANS = frozenset({"don't", "dont", "not", "never"})
_CORRECTS = re.compile(
    r"\b(?:no|nope|nah|wait|hang on|hold on|actually|sorry|i mean(?:t)?|scratch that|rather|oops|"
    r"make that|on second thoughts?|instead|never ?mind|nvm)\b",
    re.IGNORECASE,
)


class _Run(NamedTuple):
    """Words of a sentence that a hearing passed over: where in the text, and their numbers."""

    text: str
    first: int
    last: int


def whole(hears: Callable[[str], Sequence[str]], scene: Scene) -> Callable[[str], Sequence[str]]:
    """The hearings without those that pass over what a deed needs; "" (nothing but talk) stays."""
    lexicon = load_lexicon()
    return lambda text: [
        one for one in hears(text) if not one or not loses_a_deed(text, one, scene, lexicon)
    ]


def loses_a_deed(text: str, heard: str, scene: Scene, lexicon: Lexicon) -> bool:
    """Whether a hearing of a text passes over what the text asks for."""
    words = _WORD.findall(text)
    kept = {o for one in link(heard, scene, (), lexicon).spoken for o in one.mention.objects}
    runs = list(_passed_over(words, _WORD.findall(heard)))
    return any(
        _breaks_off(run, words, lexicon)
        or _parts_a_pair(run, words, scene, lexicon)
        or any(_wants(part, kept, scene, lexicon) for part in _standing(run, words))
        for run in runs
    )


def _passed_over(words: Sequence[str], heard: Sequence[str]) -> Iterator[_Run]:
    plain, again = [_plain(word) for word in words], [_plain(word) for word in heard]
    same = SequenceMatcher(a=plain, b=again, autojunk=False)
    for how, first, last, _, _ in same.get_opcodes():
        if how in ("delete", "replace"):
            yield _Run(" ".join(words[first:last]), first, last)


def _standing(run: _Run, words: Sequence[str]) -> Iterator[str]:
    """The clauses of a run that no correction takes back: what stands before "no, wait" is."""
    *taken_back, standing = _CORRECTS.split(run.text)
    behind = " ".join(words[run.last : run.last + 2])
    if not taken_back and _CORRECTS.match(behind):
        return
    yield from (part.strip() for part in re.split(r"[.,;:!?…—–]+", standing) if part.strip())


def _breaks_off(run: _Run, words: Sequence[str], lexicon: Lexicon) -> bool:
    """Whether what is passed over belongs to a word that is kept: "spin [her] round", "don't
    [touch] it"."""
    ahead = words[run.first - 1] if run.first else ""
    if _ENDS.search(ahead):
        return False
    first = _plain(words[run.first])
    acts = lexicon.verb(_plain(ahead)) is not None
    return _plain(ahead) in _BANS or (acts and first in _OBJECTS)


def _parts_a_pair(run: _Run, words: Sequence[str], scene: Scene, lexicon: Lexicon) -> bool:
    """Whether one of two things that are named together is passed over: "between the cup [and the
    jug]"."""
    within = run.first > 0 and not _ENDS.search(words[run.first - 1])
    joined = re.match(r"and (?:the|that|this|my|a)\b(?P<rest>.*)", run.text, re.IGNORECASE)
    if not within or joined is None:
        return False
    pair = link(re.split(r"[.,;:!?…—–]", run.text)[0].replace("'ll", ""), scene, (), lexicon)
    first = next(iter(pair.spoken), None)
    return (
        first is not None
        and first.opened == 1
        and bool(first.same_type or _named(first.mention.text, scene))
    )


def _named(text: str, scene: Scene) -> bool:
    """Whether a word of the text is part of something's name."""
    own = {word for item in scene for word in item.name.lower().split()}
    return bool(own & set(text.lower().split()))


def _wants(part: str, kept: set[str], scene: Scene, lexicon: Lexicon) -> bool:
    """Whether a clause asks for something that the rest does not name: a verb with a thing, a place
    or a measure behind it, or things and where they go, and not a word more."""
    linked = link(part, scene, (), lexicon)
    begin = next((i for i, t in enumerate(linked.tokens)
                  if t.text.isalnum() and t.text not in _LIGHT), 0)  # fmt: skip
    named = {o for one in linked.spoken for o in one.mention.objects}
    more = bool(named - kept) or any(c.kind in ("place", "measure") for c in linked.chunks)
    return (more and _bids(begin, linked, lexicon)) or _only_names(linked, named - kept)


def _bids(begin: int, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether a clause opens with what is to be done: a verb as one commands, or any word with an
    object right behind it ("tuck her in the pail")."""
    said = [token.text for token in linked.tokens if token.text[0].isalnum()]
    first = linked.tokens[begin].text if linked.tokens else ""
    at = said.index(first) if first in said else 0
    second = said[at + 1] if at + 1 < len(said) else ""
    if first in _DETERMINED or _is_named(begin, linked):
        return False
    known = first in lexicon.base_verbs and lexicon.verb(first) not in ("cannot", "harmful")
    led = any(c.first == begin and c.kind == "relation" for c in linked.chunks)
    return (known or second in _OBJECTS) and not led


def _is_named(at: int, linked: Linked) -> bool:
    return any(one.opened <= at < one.last for one in linked.spoken)


def _only_names(linked: Linked, named: set[str]) -> bool:
    """Whether a clause is made of things and places alone: "nails", "behind it"."""
    alone = all(c.kind in ("np", "pronoun", "relation", "place", "joint") for c in linked.chunks)
    leads = bool(linked.chunks) and linked.chunks[0].kind == "relation" and len(linked.chunks) > 1
    return alone and (bool(named) or leads)


def _plain(word: str) -> str:
    return re.sub(r"^\W+|\W+$", "", word.lower())
