"""What a sentence tells before it comes to what is wanted: "there are two mugs, take the big one".

That something is there, where it is, what one is at: no part of the deed. It is cut off, and the
words behind it that point at it ("it", "them", "the big one") name what they mean.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from agent.messages import Focus
from clarifier.act import imperative, strip_courtesy
from clarifier.gaps import in_the_gap
from clarifier.he_and_she import without_question
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.pieces import ARTICLES, Chunk
from clarifier.reading import COPULAS
from clarifier.spoken import Linked, Spoken
from clarifier.words import plural, singular
from scene.types import Scene

_ENDS = frozenset({",", ".", ";", ":", "!", "?"})
_LEADING = frozenset({"and", "so", "then", "now", "please", "but", "well"}) | _ENDS
_OPENERS = frozenset({"so", "and", "well", "ok", "okay", "oh", "hey", "now", "robot", "right"})
_SEEMING = COPULAS | {"looks", "look", "seems", "seem"}
_POSED = frozenset({"form", "stand", "lie", "sit", "make"})
"""How several things are told to be: "the four coins form a row"."""
_OURS = frozenset({"i", "we", "you", "he", "she", "they"})
"""Behind a noun these begin what tells it apart: "the bottle I left here"."""
_WISHED = frozenset({"not", "never", "should", "must", "supposed", "if", "when", "where"})
_BEYOND = frozenset({"there", "both", "each", "either", "same", "other", "others", "rest", "where"})
"""Words that point at what is told in ways that are not put into others."""
_LEFT = frozenset({"other", "others", "rest"})
_NO_DEED = frozenset({"goes", "gets", "belongs", "needs", "wants", "yours", "hers", "ours", "less",
                     "perhaps", "always", "besides", "towards", "this", "as"})  # fmt: skip
"""Words in "s" by which something is wanted, or that are no verbs."""
_COMING = frozenset({"goes", "go", "belongs", "belong", "should", "must", "needs", "wants"})


def to_the_point(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence from where it says what is wanted; as it is where that leaves something out."""
    text = without_question(text, scene, focus, lexicon)
    linked = link(text, scene, focus, lexicon)
    for at in _bounds(linked):
        if _begin(at, linked) == at or not _asks(at, linked, lexicon):
            continue
        told = [one for one in linked.spoken if one.last <= at]
        if not _only_tells(at, told, linked, lexicon):
            return text
        groups = tuple(one for one in told if one.mention.plural)
        start = linked.tokens[at].start
        filled = in_the_gap(text[:start], text[start:], groups, scene)
        return filled or _named(at, told, linked, lexicon) or text
    return text


def _bounds(linked: Linked) -> Iterator[int]:
    """The tokens with which a clause can begin."""
    inside = {i for one in linked.spoken for i in range(one.opened, one.last)}
    for i, token in enumerate(linked.tokens):
        if token.text in _ENDS and i not in inside:
            at = i
            while at < len(linked.tokens) and linked.tokens[at].text in _LEADING:
                at += 1
            if at < len(linked.tokens):
                yield at


def _asks(at: int, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether something is asked for from a token on."""
    core = imperative(strip_courtesy(linked.text[linked.tokens[at].start :]), lexicon).lower()
    first = core.removeprefix("you ").partition(" ")[0].strip(" ,.!")
    if first in lexicon.base_verbs and lexicon.verb(first) not in ("cannot", "harmful"):
        return True
    thing = next((c for c in linked.chunks if c.first == at and c.phrase is not None), None)
    if thing is None:
        return False
    return _text(thing.last, linked) in _COMING or _goes(thing, linked)


def _goes(thing: Chunk, linked: Linked) -> bool:
    """ "The middle one into the bowl": a thing and where it goes, and nothing more said of it."""
    where = next((c for c in linked.chunks if c.first == thing.last), None)
    rest = {token.text for token in linked.tokens[thing.last :]}
    return where is not None and where.kind == "relation" and not rest & (_SEEMING | _WISHED)


def _begin(at: int, linked: Linked) -> int:
    """The first token that says something, or the one given."""
    return next((i for i in range(at) if _text(i, linked) not in _OPENERS | _ENDS), at)


def _only_tells(at: int, told: Sequence[Spoken], linked: Linked, lexicon: Lexicon) -> bool:
    """Whether what stands before a token wants nothing."""
    begin = _begin(at, linked)
    said = [token.text for token in linked.tokens[begin:at] if token.text[0].isalnum()]
    opening = " ".join(said)
    if any(opening.startswith(f"{run} ") for run in lexicon.words("wishing")):
        return not any(one.mention.objects for one in told)
    if any(opening.startswith(f"{run} ") for run in lexicon.words("telling")):
        return not _wishes(said)
    busy = opening.startswith(("i am ", "i'm ", "we are ", "we're "))
    if busy and any(word.endswith("ing") for word in said[1:4]):
        return True
    if not told or told[0].phrase is None:
        return False
    if any(opening.startswith(f"{run} ") for run in lexicon.words("setting_out")):
        return told[0].mention.plural and not any(one.relation for one in told)
    if told[0].opened != begin:
        return False
    alone = told[-1].mention.end == linked.tokens[_last(at, linked)].end
    posed = _POSED if told[0].mention.plural else frozenset()
    stands = _text(told[0].last, linked) in _SEEMING | _OURS | posed
    return (alone or stands or _does(told[0].last, at, linked, lexicon)) and not _wishes(said)


def _does(behind: int, at: int, linked: Linked, lexicon: Lexicon) -> bool:
    """ "The vase catches the glare", "that tin leaks": what a thing does, where nothing else that
    is on the table is named and nobody is told anything."""
    word = _text(behind, linked)
    does = word.endswith("s") and lexicon.verb(word) is None and not lexicon.is_noun(word)
    others = any(behind <= one.first < at and one.mention.objects for one in linked.spoken)
    bids = any(behind <= c.first < at and c.kind in ("verb", "relation") for c in linked.chunks)
    return does and word.isalpha() and not others and not bids and word not in _NO_DEED


def _wishes(said: Sequence[str]) -> bool:
    """Whether more is told of a thing than how it stands: what is to become of it."""
    due = any(one in COPULAS and two == "to" for one, two in pairwise(said))
    return due or bool(_WISHED & set(said))


def _last(at: int, linked: Linked) -> int:
    """The last token before one that is a word."""
    return next(i for i in range(at - 1, -1, -1) if _text(i, linked) not in _LEADING or i == 0)


def _named(at: int, told: Sequence[Spoken], linked: Linked, lexicon: Lexicon) -> str | None:
    """The sentence from a token on, what it points at named; None where that cannot be done."""
    rest = {_text(chunk.last - 1, linked) for chunk in linked.chunks
            if chunk.first >= at and chunk.value != "idiom"}  # fmt: skip
    start, text = linked.tokens[at].start, linked.text
    if rest & (_BEYOND - _LEFT if _counts_off(at, linked) else _BEYOND):
        return None
    every = [one for one in told if one.phrase is not None and one.phrase.head]
    for chunk in (chunk for chunk in linked.chunks if chunk.first >= at):
        said = _instead(chunk, at, every, linked)
        if said is not None:
            a, b = linked.tokens[chunk.first].start, linked.tokens[chunk.last - 1].end
            return _request(text[start:a] + said + text[b:])
    vague = [one for one in every if one.phrase and lexicon.is_anything(" ".join(one.phrase.head))]
    return _request(text[start:]) if len(vague) == len(told) else None


def _counts_off(at: int, linked: Linked) -> bool:
    """ "There are four pegs: one of them goes left, the others right": the others of these."""
    every = (chunk.phrase for chunk in linked.chunks if chunk.first >= at)
    first = next((phrase for phrase in every if phrase is not None), None)
    some = first is not None and (first.det == "any" or bool(first.count))
    return first is not None and first.group == "them" and some


def _instead(chunk: Chunk, at: int, told: Sequence[Spoken], linked: Linked) -> str | None:
    """What a chunk that points at what is told stands for; None for any other."""
    if not told:
        return None
    several = len(told) > 1 or told[0].mention.plural
    if chunk.kind == "pronoun" or (chunk.phrase is not None and chunk.phrase.group == "them"):
        if several != (_text(chunk.last - 1, linked) in ("them", "they")):
            return None
        words = linked.text[linked.tokens[chunk.first].start : linked.tokens[chunk.last - 1].end]
        led = words.lower().removesuffix("them").removesuffix("they").removesuffix("it")
        counts = chunk.phrase is not None and chunk.phrase.count is not None
        whole = _uncounted(told) if counts else _whole(told, linked)
        return f"{led}{whole}" if _is_free(chunk, at, linked) else None
    phrase = chunk.phrase
    if phrase is None or phrase.head or phrase.group or not phrase.modifiers or len(told) > 1:
        return None
    assert told[0].phrase is not None
    last = told[0].phrase.head[-1]
    noun = plural(singular(last)) if phrase.plural else singular(last)
    end = next(
        (i for i in range(chunk.first, chunk.last) if _text(i, linked) == "from"), chunk.last
    )
    bare = _text(end - 1, linked) in ("one", "ones")
    a, b = linked.tokens[chunk.first].start, linked.tokens[end - 1 - bare].end
    head = " ".join((*told[0].phrase.head[:-1], noun))
    behind = linked.text[linked.tokens[end - 1].end : linked.tokens[chunk.last - 1].end]
    return f"{linked.text[a:b]} {head}{behind}" if several else None


def _is_free(chunk: Chunk, at: int, linked: Linked) -> bool:
    """Whether a pronoun means what was told: nothing else is named before it, or one thing, which
    goes to it."""
    before = [one for one in linked.spoken if at <= one.first and one.last <= chunk.first]
    if not before:
        return True
    ahead = next((c for c in linked.chunks if c.last == chunk.first), None)
    return len(before) == 1 and ahead is not None and ahead.kind == "relation"


def _uncounted(told: Sequence[Spoken]) -> str:
    """What was told of, without its number: "three of them", once four eggs were told of."""
    every = (one.phrase for one in told if one.phrase is not None)
    return " and ".join(f"the {' '.join((*one.modifiers, *one.head))}" for one in every)


def _whole(told: Sequence[Spoken], linked: Linked) -> str:
    """What was told of, as a definite phrase."""
    first = linked.text[linked.tokens[told[0].opened].start : told[-1].mention.end]
    det = _text(told[0].opened, linked)
    alone = all(_text(i, linked) in _OPENERS | _ENDS for i in range(told[0].opened))
    if alone and _text(told[-1].last, linked) in _ENDS:
        return first  # "any cup, lift it": nothing is told of it
    if det in ARTICLES | {"these", "those", "all", "both"}:
        return first
    return f"the {first.partition(' ')[2] if det in ('a', 'an', 'some') else first}"


def _request(text: str) -> str:
    core = strip_courtesy(text)
    return core[4:] if core.lower().startswith("you ") else core


def _text(at: int, linked: Linked) -> str:
    return linked.tokens[at].text if 0 <= at < len(linked.tokens) else ""
