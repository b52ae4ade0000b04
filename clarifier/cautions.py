"""Cautions: what a sentence asks to be spared, beside what it asks to be done.

"... without touching the box", "... but don't hit it", "mind the glass": no deed. A caution is cut
from what is translated, and the things that it spares must stay where they are, which the forecast
shows (`unasked.disturbed`). "Don't put it on the plate, put it on the box" is no caution: it says
where something goes.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from agent.messages import Focus
from clarifier.forbidden import DISTURBING, TOUCHING, Ban, bans
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken, settles
from clarifier.words import stems
from scene.types import Scene

_SO_NOT = frozenset({"doesn't", "won't", "can't"})
_NOT = frozenset({"don't", "dont", "not", "never", "without", "avoid", "avoiding"}) | _SO_NOT
_CARE = frozenset({"careful", "mind", "beware", "watch"})
_STAYS = frozenset({"alone", "be", "where", "as", "untouched", "undisturbed", "still"})
"""Behind "leave the box": it is to stay."""
_ADVERBS = frozenset({"exactly", "precisely", "just", "right", "there", "all", "well"})
_OVER = frozenset({"", ",", ".", ";", "!", "?", "please", "belongs", "goes", "should", "thanks"})
_FALLING = frozenset({"drop", "spill", "break", "tilt", "tip", "topple", "overturn", "crush"})
"""What can be asked not to happen to the thing that is moved itself."""
_STAYING = frozenset({"", "move", "shift", "displace", "budge"})
"""Nothing at all is to do this; what is moved may well be touched."""
_AGAINST = frozenset({"into", "against", "off", "over", "with", "on", "down"})
"""Relations that belong to such a verb: "bump into", "knock over", "with the gripper"."""
_MOVING = frozenset({"place", "push", "pick", "turn", "topple"})
"""Classes of verbs that move what they act on."""
_LIGHT = frozenset({"ever", "please", "even", "accidentally", "actually", "you", "to", "do", "be"})
_JOINING = frozenset({",", ".", ";", "and", "but", "while", "please", "be", "very", "taking"}
                     | {"take", "care", "make", "sure", "try", "trying", "just", "careful", "do"}
                     | {"also", "then", "-", "never"})  # fmt: skip
_BEHIND = frozenset({",", ".", ";", "and", "then", "but", "please", "just", "only", "instead"})
_PRONOUNS = frozenset({"it", "its", "it's", "them", "their", "there", "that", "other", "one"})
_REST = frozenset({"others", "rest", "remaining", "only"})
"""What is left of things that a caution names."""
_EVERY = frozenset({"everything", "anything", "all", "nothing", "something"})
_HANGING = re.compile(r"(?:[\s,;:]|\b(?:and|but|while|whereas|though|yet)$)+$", re.IGNORECASE)
"""What joined a clause that was cut to what stood before it."""
_AGAIN = re.compile(r"^[,;:.]+(?=\s*(?:[,;:.!?]|and\b|but\b|$))\s*")
_TOOL = re.compile(r"\b(?:move|bring|guide|run|take|lead|steer|drive|swing|wave) (?:the|your) "
                   r"(?:tool|arm|gripper|hand|finger|claw|tip|suction cup)\b", re.IGNORECASE)
"""Here nothing on the table is to be moved."""
_WHICH = re.compile(r"^,? ?(?:which|that one|that|it)\b(?='s| \w)")
"""What goes on from the one thing that may be moved."""
_CHOICES = frozenset({"if", "otherwise", "else", "unless", "when", "should", "whether"})


@dataclass(frozen=True)
class Caution:
    """Tokens ``first:last``; ``verb`` is what is not to happen, "" where that was not said."""

    first: int
    last: int
    verb: str


def link_deed(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Linked:
    """The sentence without its cautions, linked; what they spare is noted with it."""
    linked = link(text, scene, focus, lexicon)
    told = bans(linked)
    if not told:
        return _without_cautions(linked, scene, focus, lexicon)
    core, said = _parted(told, linked)
    if not any(character.isalnum() for character in core):
        return replace(linked, spared=_kept(told, linked, scene))
    rest = _without_cautions(link(core, scene, focus, lexicon), scene, focus, lexicon)
    spared = tuple(dict.fromkeys((*rest.spared, *_kept(told, rest, scene))))
    alone = {o for ban in told if ban.verb in TOUCHING or not ban.verb for one in ban.named
             for o in one.mention.objects}  # fmt: skip
    touchable = tuple(o for o in _only_touched(rest) if o not in alone)
    return replace(rest, spared=spared, touchable=touchable, caution=rest.caution + said)


def only_forbids(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> bool:
    """Whether a sentence says what must stay, and nothing else."""
    linked = link(text, scene, focus, lexicon)
    core, _ = _parted(bans(linked), linked)
    return bool(linked.tokens) and not any(character.isalnum() for character in core)


def _without_cautions(
    linked: Linked, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon
) -> Linked:
    linked = replace(linked, spared=_left_out(linked, lexicon))
    found = cautions(linked, lexicon)
    if not found:
        return linked
    objects, beside_deed = _spared(found, linked)
    spared = tuple(dict.fromkeys((*linked.spared, *objects)))
    core, said = _parted(found, linked)
    rest = link(core, scene, focus, lexicon)
    does = any(c.kind == "verb" for c in rest.chunks) or bool(rest.spoken)
    left = {token.text for token in rest.tokens}
    refers = (found[0].first == 0 and left & _PRONOUNS) or left & _REST
    touches = any(one.verb in TOUCHING or not one.verb for one in found)
    touchable = () if touches else _only_touched(linked)
    if not (beside_deed and does) or refers:
        return replace(linked, spared=spared, touchable=touchable)
    return replace(rest, spared=spared, touchable=touchable, caution=said)


def _only_touched(linked: Linked) -> tuple[str, ...]:
    """What the deed comes down on with the tool, and moves nowhere."""
    handling = ("touch", "trace", "turn")
    themes = (one for one in linked.spoken if one.theme and one.verb in handling)
    return tuple(dict.fromkeys(o for one in themes for o in one.mention.objects))


def _kept(told: Sequence[Ban], deed: Linked, scene: Scene) -> tuple[str, ...]:
    """The objects that must stay where they are beside a deed."""
    every = [item.id for item in scene]
    tool = _TOOL.search(deed.text)
    themes = [one for one in deed.spoken if one.theme and one.verb not in ("touch", "trace")]
    themes = [] if tool else themes
    touches = tool or any(chunk.value in ("touch", "trace") for chunk in deed.chunks)
    movers = {o for one in themes or (() if touches else deed.spoken) for o in one.mention.objects}
    kept: list[str] = []
    for ban in told:
        named = {o for one in ban.named for o in one.mention.objects}
        if ban.scope == "these":
            kept += [o for o in every if o in named and not (o in movers and ban.verb in _FALLING)]
        elif ban.scope == "others":
            kept += [o for o in every if o not in named]
        else:
            strict = ban.scope == "all" and ban.verb in _STAYING
            kept += [o for o in every if strict or o not in movers]
    return tuple(dict.fromkeys(kept))


def _left_out(linked: Linked, lexicon: Lexicon) -> tuple[str, ...]:
    """ "Don't put the red cup on the plate, only the blue one": the red cup is to stay."""
    left: list[str] = []
    for at, token in enumerate(linked.tokens):
        denied = token.text in ("don't", "never") or (
            token.text == "not" and at > 0 and linked.tokens[at - 1].text == "do"
        )
        verb = _past_light(at + 1, linked)
        if not denied or lexicon.verb(_text(verb, linked)) not in _MOVING:
            continue
        joints = (c.first for c in linked.chunks if c.kind == "joint" and c.first > verb)
        end = next(joints, len(linked.tokens))
        inside = [s for s in linked.spoken if s.theme and verb < s.first < end]
        instead = {o for s in linked.spoken if s.theme and s not in inside
                   for o in s.mention.objects}  # fmt: skip
        if instead:
            left += [o for s in inside for o in s.mention.objects if o not in instead]
    return tuple(dict.fromkeys(left))


def cautions(linked: Linked, lexicon: Lexicon) -> tuple[Caution, ...]:
    """The cautions of a sentence, in order."""
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    chosen = any(
        token.text in _CHOICES and not (token.text == "else" and _text(i - 1, linked) in _EVERY)
        for i, token in enumerate(linked.tokens)
    )
    found: list[Caution] = []
    for i, token in enumerate(linked.tokens):
        if i in inside or (found and i < found[-1].last):
            continue
        if chosen and token.text not in ("without", "avoiding"):
            continue
        caution = _caution_at(i, linked, lexicon)
        if caution is not None:
            least = found[-1].last if found else 0
            first = _widened(i, least, linked, inside)
            led = {t.text for t in linked.tokens[first:i]}
            if token.text in _SO_NOT and "so" not in led:
                continue  # "it won't fall" is no request
            found.append(replace(caution, first=first))
    return tuple(found)


def _caution_at(at: int, linked: Linked, lexicon: Lexicon) -> Caution | None:
    word = linked.tokens[at].text
    if word == "not" and (contrast := _contrasted(at, linked)) is not None:
        return contrast
    if word == "not" and at and _text(at - 1, linked) not in _JOINING | {"to", "as"}:
        return None  # "the box must not move" has its own subject
    if word in _NOT:
        verb = _past_light(at + 1, linked)
        stem = next((s for s in stems(_text(verb, linked)) if s in DISTURBING), None)
        avoids = word.startswith("avoid") and _named_at(verb, linked) is not None
        if not avoids and (stem is None or _is_no_caution(at, verb, stem, linked)):
            return None
        last = _end(verb if avoids else verb + 1, linked, lexicon)
        return None if last is None else Caution(at, last, stem or "")
    if word in _CARE:
        after = at + 1 + (_text(at + 1, linked) == "out")
        after += _text(after, linked) in ("with", "of", "for", "about", "around")
        if _named_at(after, linked) is None:
            return None
        last = _end(after, linked, lexicon)
        return None if last is None else Caution(at, last, "")
    return _left_alone(at, linked) if word in ("leave", "leaving") else None


def _contrasted(at: int, linked: Linked) -> Caution | None:
    """ "the tall candle, not the stubby one": says again which one is not meant."""
    named = _named_at(at + 1, linked)
    if named is None or named.phrase is None or named.mention.plural or not at:
        return None
    before = [s for s in linked.spoken if s.last <= at and settles(s.mention)]
    kin = [s for s in before if set(s.mention.objects) & set(named.same_type)]
    told = kin and set(kin[-1].mention.objects) != set(named.mention.objects)
    over = _text(named.last, linked) in _OVER and _text(at - 1, linked) in (",", "and", "but")
    return Caution(at, named.last, "") if told and over else None


def _is_no_caution(at: int, verb: int, stem: str, linked: Linked) -> bool:
    """ "In a row, not touching", "the box don't move", "hold it there and don't drop it": how
    things are to stand, whose subject was said, or what is to be kept hold of."""
    word = _text(at, linked)
    if word == "not" and _text(verb, linked).endswith("ing"):
        return True
    if stem == "drop" and word not in ("without", "avoiding"):
        return True
    subject = any(one.last == at for one in linked.spoken)
    return subject and word != "without" and _named_at(verb + 1, linked) is None


def _left_alone(at: int, linked: Linked) -> Caution | None:
    """ "leave the box where it is"."""
    named = _named_at(at + 1, linked)
    if named is None or named.phrase is None:
        return None
    last = named.last
    while _text(last, linked) in _ADVERBS:
        last += 1
    if _text(last, linked) not in _STAYS:
        bare = last == named.last and at > 0 and _is_over(last, linked)
        return Caution(at, last, "") if bare else None
    last += 1
    if _text(last - 1, linked) in ("where", "as"):
        while _text(last, linked) in ("it", "they", "is", "are", "stands", "stand", "it's"):
            last += 1
    return Caution(at, last, "")


def _is_over(at: int, linked: Linked) -> bool:
    """Whether nothing more is said: "put the nuts in the jar, leave the bolts"."""
    word, after = _text(at, linked), _text(at + 1, linked)
    verbs = {c.first for c in linked.chunks if c.kind == "verb"}
    return word in _OVER or (
        word in ("and", "but", "then") and (after == "then" or at + 1 in verbs)
    )


def _end(at: int, linked: Linked, lexicon: Lexicon) -> int | None:
    """Where a caution that goes on at a token ends; None if it says where something goes."""
    chunks = [c for c in linked.chunks if c.first >= at]
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    for nth, chunk in enumerate(chunks):
        text = linked.tokens[chunk.first].text
        if chunk.first in inside:
            continue
        if chunk.kind == "relation" and text not in _AGAINST:
            return None
        if chunk.kind == "joint" and text != "else" and _starts_clause(nth, chunks, linked):
            return chunk.first
        gerund = text.endswith("ing")
        if chunk.kind == "verb" and nth and not gerund and lexicon.verb(text) is not None:
            return chunk.first
    return len(linked.tokens)


def _starts_clause(at: int, chunks: Sequence[Chunk], linked: Linked) -> bool:
    """Whether something else begins behind a joint, no other thing to be spared."""
    text = linked.tokens[chunks[at].first].text
    if text in (".", ";", "!", "?", "then", "but", "instead"):
        return True
    rest = list(chunks[at + 1 :])
    while rest and linked.tokens[rest[0].first].text in _BEHIND:
        rest.pop(0)
    if not rest or rest[0].kind not in ("np", "pronoun"):
        return text != "or" or not rest
    ends = (i for i, c in enumerate(rest) if c.kind == "joint")
    return any(c.kind in ("relation", "place") for c in rest[: next(ends, len(rest))])


def _widened(at: int, least: int, linked: Linked, inside: set[int]) -> int:
    """The first of the words that lead to a caution: "but please", "and be"."""
    first = next((i for i in range(at - 1, max(at - 4, least) - 1, -1)
                  if _text(i, linked) == "so"), at)  # fmt: skip
    while first > least and first - 1 not in inside and _text(first - 1, linked) in _JOINING:
        first -= 1
    return first


def _past_light(at: int, linked: Linked) -> int:
    while _text(at, linked) in _LIGHT:
        at += 1
    return at


def _text(at: int, linked: Linked) -> str:
    return linked.tokens[at].text if at < len(linked.tokens) else ""


def _named_at(at: int, linked: Linked) -> Spoken | None:
    return next((s for s in linked.spoken if s.opened == at), None)


def _parted(found: Sequence[Caution | Ban], linked: Linked) -> tuple[str, str]:
    """The sentence without its cautions, and their words. A pronoun that stands for what only a
    caution before it names is put as its name."""
    core, said, at = "", "", 0
    for caution in found:
        first, last = caution.first, caution.last
        while first == 0 and _text(last, linked) in _BEHIND:
            last += 1
        start, end = linked.tokens[first].start, linked.tokens[last - 1].end
        before = _named_again(at, start, found, linked).rstrip()
        if isinstance(caution, Ban):
            before = _HANGING.sub("", before)
        core = f"{core.rstrip()} {before} ".lstrip()
        lead = "" if _text(first, linked) in _JOINING else ","
        said += f"{lead} {linked.text[start:end].strip(' ,')}"
        at = end
    rest = _named_again(at, len(linked.text), found, linked).lstrip()
    last = found[-1] if found else None
    if isinstance(last, Ban):
        rest = rest.lstrip(" ?!") if not core else _AGAIN.sub("", rest)
        if last.scope == "others" and len(last.named) == 1:
            rest = _WHICH.sub(lambda which: f"the {last.named[0].mention.text}", rest)
    return (core + rest).strip(), said


def _named_again(start: int, end: int, found: Sequence[Caution | Ban], linked: Linked) -> str:
    """Characters ``start:end`` of the sentence, what they mean by "it" named where only a caution
    said it."""
    text = linked.text[start:end]
    told = [s for s in linked.spoken if any(c.first <= s.first < c.last for c in found)]
    here = [s for s in linked.spoken if s not in told and s.phrase is not None]
    for one in reversed(linked.spoken):
        if one.phrase is not None or not start <= one.mention.start < end or one in told:
            continue
        alike = [s for s in told if s.phrase is not None and s.last <= one.first
                 and s.mention.objects == one.mention.objects]  # fmt: skip
        if alike and not any(s.mention.objects == one.mention.objects for s in here):
            named = linked.text[linked.tokens[alike[-1].opened].start : alike[-1].mention.end]
            a, b = one.mention.start - start, one.mention.end - start
            text = f"{text[:a]}{named.lower() if named[:1] == 'T' else named}{text[b:]}"
    return text


def _spared(found: Sequence[Caution], linked: Linked) -> tuple[tuple[str, ...], bool]:
    """The objects that must stay where they are; False where a caution speaks of what is to be
    moved, so that it belongs to the deed.

    "It", where that is what is to be moved, is what it is moved to: nobody pushes a thing without
    hitting it. One of a group that is to be moved is left out of it.
    """

    def within(one: Spoken) -> bool:
        return any(c.first <= one.first < c.last for c in found)

    doing = [one for one in linked.spoken if not within(one)]
    themes = [s for s in doing if s.theme and s.verb not in ("touch", "trace")]
    single = {o for s in themes if not s.mention.plural for o in s.mention.objects}
    grouped = {o for s in themes for o in s.mention.objects} - single
    goals = [o for s in doing if not s.theme for o in s.mention.objects]
    spared: list[str] = []
    beside_deed = True
    for caution in found:
        named = [s for s in linked.spoken if caution.first <= s.first < caution.last]
        for one in [s for s in named if s.phrase is not None] or named:
            said = one.mention.objects
            if one.phrase is None and any(not s.verb for s in themes):
                return tuple(spared), False  # "a ring around the box, without moving it"
            if _text(one.opened - 1, linked) in ("of", "among"):
                return tuple(spared), False  # "the biggest of the blocks": the program chooses
            if one.phrase is not None and caution.verb in _STAYING - {""}:
                before = {o for s in themes if s.last <= caution.first for o in s.mention.objects}
                spared += [o for o in said if o in before & single]  # what was asked is denied
            whole = grouped if grouped <= set(said) else set()
            objects = [o for o in said if o not in single | whole]
            if not objects and one.phrase is None and caution.verb not in _FALLING:
                objects = [o for o in goals if o not in single | grouped]
            near = set(objects) & {o for s in doing for o in s.mention.objects}
            if near and caution.verb in TOUCHING and not single | grouped:
                beside_deed = False  # "reach for the box but don't touch it": how far the tool goes
            of_deed = bool(grouped & set(objects)) or (bool(said) and not objects)
            beside_deed = beside_deed and not (of_deed and caution.verb not in _FALLING)
            spared += objects
    return tuple(dict.fromkeys(spared)), beside_deed
