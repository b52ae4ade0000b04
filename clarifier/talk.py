"""Sentences that want nothing done: small talk, and statements of fact about what is there."""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon
from clarifier.spoken import Linked
from clarifier.words import words

OFF_TOPIC = "I can only talk about what is on the table and move it."
_WISH = re.compile(
    r"\b(?:want|wants|wanted|wish|like|love|need|needs|should|shouldn't|must|ought|shall|let|let's|"
    r"would|wouldn't|could|couldn't|can|may|might|please|pls|better|prefer|hope|supposed|to be|"
    r"has to|have to|goes|go|belongs?|make|see|ensure|if|is to|are to|time|its place)\b",
    re.IGNORECASE,
)
_LIKING = re.compile(
    r"^(?:i|we|he|she|they|you|my \w+|everybody|everyone|nobody|people)\s+"
    r"(?:really |always |never |also |just |once |already |still |do |don't |didn't )*"
    r"(?:like|love|hate|adore|own|know|remember|think|believe|see|enjoy|dislike|admire|"
    r"bought|got|had|made|ate|saw|found|lost|broke|liked|loved|hated|gave|used|washed|painted|"
    r"forgot|knew|thought|remembered|drank|borrowed|inherited|stole|sold|dropped|received|kept|"
    r"cleaned|baked|picked|grew|have|heard|met|told|said|went|came|was|were|am|took)\b",
    re.IGNORECASE,
)
_PERSON = (
    r"(?:some(?:one|body)|every(?:one|body)|nobody|no one|people|they|she|he|"
    r"(?:(?:my|our|his|her) )?"
    r"(?:dad|daddy|father|mum|mom|mummy|mother|grandma|grandpa|granny|son|daughter|brother|sister|"
    r"wife|husband|uncle|aunt|friend|boss|kids?|cat|dog|neighbou?rs?|colleague|teacher|doctor|"
    r"girlfriend|boyfriend|partner|roommate|flatmate))"
)
_TOLD = re.compile(
    rf"^(?:and |but |so |then |you know,? |well,? )*{_PERSON}\s+"
    r"(?:really |always |never |also |just |once |already |still |often |has |have |had )*"
    r"(?:\w+ed|put|say|says|said|told|think|thinks|thought|took|takes|made|makes|gave|gives|went|"
    r"got|left|kept|keeps|broke|threw|stole|hid|set|lost|found|brought|is|was|are|were)\b",
    re.IGNORECASE,
)
"""What somebody did or says: nobody is told to do it."""
_BREAKS_OFF = re.compile(
    r"\b(?:but|because|although|unless|sort of|kind of|kinda|whereas|like)[\s.,…]*$",
    re.IGNORECASE,
)
_CALLED = re.compile(r"\b(?:is|are) (?:called|named)\b", re.IGNORECASE)
_WAS = re.compile(r"\b(?:was|were|has been|have been|had|used to|comes from|came)\b", re.IGNORECASE)
_IS = re.compile(
    r"\b(?:is|are|isn't|aren't|'s|looks?|smells?|tastes?|seems?|feels?|costs?|weighs?)\b", re.I
)


def is_talk(linked: Linked, lexicon: Lexicon) -> bool:
    """Whether a sentence that is no question asks for no deed either."""
    text = linked.text
    if _TOLD.match(text) or _BREAKS_OFF.search(text) or _CALLED.search(text):
        return True
    if any(chunk.kind in ("verb", "measure") for chunk in linked.chunks):
        return _recounts(linked)
    if _says_where(linked, lexicon):
        return False
    if any(spoken.mention.objects for spoken in linked.spoken):
        return _states(linked)
    bare = len(linked.spoken) == 1 and linked.spoken[0].opened <= 1
    return not (bare and linked.spoken[0].last >= len(words(linked.text)))


def _recounts(linked: Linked) -> bool:
    """ "I got the cup for my birthday": a verb of the past, and nobody is told to do anything."""
    if not _LIKING.match(linked.text) or _WISH.search(linked.text):
        return False
    verbs = [chunk for chunk in linked.chunks if chunk.kind == "verb"]
    return len(verbs) == 1 and verbs[0].first <= 3 and linked.tokens[verbs[0].first].text in _PAST


_PAST = frozenset({"got", "gave", "took", "dropped", "picked", "washed", "painted", "broke", "ate",
                   "baked", "cleaned", "drank", "bought", "made", "kept"})  # fmt: skip


def _says_where(linked: Linked, lexicon: Lexicon) -> bool:
    """Whether a place, a direction, or a relation to a thing is said outside the mentions."""
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    found = {one.first for one in linked.spoken if one.mention.objects and one.relation}
    opened = {one.opened for one in linked.spoken if one.first in found}
    for chunk in linked.chunks:
        if chunk.first in inside:
            continue
        if chunk.kind == "place":
            return True
        if chunk.kind == "relation" and chunk.last in opened:
            return True
        if linked.tokens[chunk.first].text in lexicon.words("directions"):
            return not _WAS.search(linked.text)
    return False


def _states(linked: Linked) -> bool:
    """ "the cup was a present", "the apple is ripe", "I like the red one"."""
    text = linked.text
    if len({one.mention.slot for one in linked.spoken}) > 1:
        return False
    if _LIKING.match(text):
        return not re.search(r"\b(?:want|wish|would|'d|should|need)\b", text, re.IGNORECASE)
    if _WISH.search(text):
        return False
    return bool(_WAS.search(text) or _IS.search(text))
