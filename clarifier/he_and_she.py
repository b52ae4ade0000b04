"""A thing that is spoken of as if it were alive: "that knob is junk, push him over the edge",
"where's the princess? Put her in the castle". What was named before in the sentence is meant.

People stay people: where no thing, or somebody, was named before, or two are told apart ("he",
"her"), nothing is changed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Focus
from clarifier.act import imperative, strip_courtesy
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.people import PEOPLE
from clarifier.things import Thing, things_of
from clarifier.words import singular, words
from scene.types import Scene

_BEHIND = (
    r"(?=\s*(?:[.,;!?]|$)|\s+(?:in|on|to|into|onto|next|beside|besides|by|between|behind|near|off|"
    r"over|up|down|back|left|right|clean|straight|at|from|around|round|halfway|half|and|then|quick|"
    r"quickly|please|there|here|gently|forwards?|backwards?|away|towards?|with|under|inside|upon|"
    r"against|away|aside|closer|nearer|further|farther|upright|a (?:bit|little|touch|tad|quarter|"
    r"half)|\d+|one|two|three|four|five|ten|clockwise|anticlockwise|sideways|out|for|now|so|where)\b)"
)
_OBJECT = re.compile(rf"(?<![\w'’])(?:him|her|'im|'er|’im|’er){_BEHIND}", re.IGNORECASE)
_FOR_SOMEBODY = re.compile(
    r"\b(?:to|for|with|at|towards?|near|by|behind|of|on|in|into|onto|from|against|through|give|hand|"
    r"pass|show|tell|help|let|ask|serve|bring|beside|over|past|round|around)\s*$",
    re.IGNORECASE,
)
"""Behind these a person is spoken of, or nobody knows who: "bring it to her"."""
_USED_ON = re.compile(r"\s*[^.;!?]*?\b(?:with|using|until|till)\b", re.IGNORECASE)
"""What is done to somebody with a thing: "poke him with it"."""
_SUBJECT = re.compile(
    r"\b(?:he|she) (?=(?:has|needs|wants|must|should|ought|goes|gets|shall|belongs)\b)",
    re.I,
)
_MISUSED = re.compile(
    rf"(?<=\bput |\bset )he{_BEHIND}|(?<=\bmove |\bpush )he{_BEHIND}", re.IGNORECASE
)
_HE, _SHE = frozenset({"he", "him", "'im"}), frozenset({"she", "her", "'er"})
_QUESTION = re.compile(
    r"^\W*(?:(?:ok|okay|so|well|hey|now|and)\b[\s,]*)*(?:where(?:'s|s| is| are|'re)|"
    r"do you see|can you see|can you find|did you see|have you seen|what about|how about) "
    r"(?P<what>[^?.!;]+?)(?: at| gone| now)?\s*(?:[?!]|\.{2,}|…)+\s*(?P<rest>\w.*)$",
    re.IGNORECASE,
)
_POINTS = re.compile(r"\b(?:it|them|that one)\b", re.IGNORECASE)


def as_it(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with every "him" and "her" that is a thing named before as "it"."""
    persons = set(words(text))
    if persons & _HE and persons & _SHE:
        return text
    for pattern, plain in ((_OBJECT, "it"), (_MISUSED, "it"), (_SUBJECT, "it ")):
        for said in reversed(list(pattern.finditer(text))):
            before, behind = text[: said.start()], text[said.end() :]
            told = pattern is _SUBJECT or not _to_somebody(before, behind, lexicon)
            if told and _names_a_thing(before, scene, focus, lexicon):
                text = f"{text[: said.start()]}{plain}{text[said.end() :]}"
    return text


def _to_somebody(before: str, behind: str, lexicon: Lexicon) -> bool:
    """Whether "him" may be somebody: after a preposition, of whom something is used on, or behind a
    verb that touches, once another deed was told ("take the stick and poke him")."""
    if _FOR_SOMEBODY.search(before) or _USED_ON.match(behind):
        return True
    *earlier, verb = words(before) or ("",)
    bears = lexicon.verb(verb) not in ("place", "pick", "turn", "push")
    return bears and any(
        lexicon.verb(word) in ("place", "pick", "push", "touch", "harmful") for word in earlier
    )


def without_question(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """ "Where's the frog? Put it in the tub" as "put the frog in the tub": a question before a
    deed, about what the deed is done to."""
    said = _QUESTION.match(text)
    if said is None:
        return text
    rest = strip_courtesy(said["rest"])
    first = imperative(rest, lexicon).partition(" ")[0].lower().strip(",.!")
    linked = link(said["what"], scene, focus, lexicon)
    known = len(linked.spoken) == 1 and bool(linked.spoken[0].mention.objects)
    points = _POINTS.search(rest)
    if not known or first not in lexicon.base_verbs or points is None:
        return text
    ahead = link(rest[: points.start()], scene, focus, lexicon).spoken
    if any(one.phrase is not None for one in ahead):
        return text
    return f"{rest[: points.start()]}{said['what'].strip()}{rest[points.end() :]}"


def _names_a_thing(before: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> bool:
    """Whether things, and nobody, are named in the words before."""
    own = {word for item in scene for word in words(item.name)}
    people = {one for word in words(before) if (one := singular(word)) in PEOPLE} - own
    if people:
        return False
    named = (one for one in link(before, scene, focus, lexicon).spoken if one.phrase is not None)
    things = things_of(scene, lexicon)
    return any(one.mention.objects for one in named) or any(
        _is_called(word, thing, lexicon) for word in words(before) for thing in things
    )


def _is_called(word: str, thing: Thing, lexicon: Lexicon) -> bool:
    """Whether a word names a thing, if only by part of its name."""
    return singular(word) == thing.head or (
        lexicon.is_noun(word) and (word in thing.name or lexicon.means(word, thing.noun))
    )
