"""What a sentence asks to be done, without what it asks to be spared: the deed, linked.

What is spared (`cautions`, `forbidden`) is cut from what is translated; the objects that must stay
are noted with the deed, and the forecast shows whether they do (`unasked`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.cautions import BEHIND, CHOICES, JOINING, Caution, cautions, past_light, word_at
from clarifier.denied_places import without_denied
from clarifier.forbidden import TOUCHING, Ban, bans
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken, settles
from clarifier.unasked import only_the_tool
from clarifier.words import listing, number, singular
from scene.types import Scene

_FALLING = frozenset({"drop", "spill", "break", "tilt", "tip", "topple", "overturn", "crush"})
"""What can be asked not to happen to the thing that is moved itself."""
_MOVING = frozenset({"place", "push", "pick", "turn", "topple"})
"""Classes of verbs that move what they act on."""
_STAYING = frozenset({"", "move", "shift", "displace", "budge"})
"""Nothing at all is to do this; what is moved may well be touched."""
_PRONOUNS = frozenset({"it", "its", "it's", "them", "their", "there", "that", "other", "one"})
_REST = frozenset({"others", "rest", "remaining", "only"})
"""What is left of things that a caution names."""
_HANGING = re.compile(r"(?:[\s,;:]|\b(?:and|but|while|whereas|though|yet)$)+$", re.IGNORECASE)
"""What joined a clause that was cut to what stood before it."""
_AGAIN = re.compile(r"^[,;:.]+(?=\s*(?:[,;:.!?]|and\b|but\b|$))\s*")
_BUT_FOR = re.compile(
    r"^everything (?:except|but|save|bar|apart from)(?: for)? (the .+)$", re.IGNORECASE
)
_BUT = re.compile(r"\b(?:only|except|apart from)\b", re.IGNORECASE)
"""Behind these comes what may move although everything else stays."""
_MOST_NAMED = 4
"""More things than this are not listed in place of "the others"."""
_OTHERS = re.compile(
    r"\b(?:all )?(?:the |my )?(?:others?|rest|remaining)\b(?! (?:side|end|way|half|edge|corner))"
    r"(?: (?P<count>two|three|four|[234])\b)?(?: (?:ones?|of them|of those)\b)?"
    r"(?: (?!(?:go|in|on|to|at|by|and|onto|into|behind|left|right|next|should|must|may|can|are|is|"
    r"under|between|near|beside|please|over|off|out)\b)(?P<noun>[a-z]+s?)\b)?",
    re.IGNORECASE,
)
_WHICH = re.compile(r"^,? ?(?:which|that one|that|it)\b(?='s| \w)")
"""What goes on from the one thing that may be moved."""


def link_deed(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Linked:
    """The sentence without its cautions, linked; what they spare is noted with it."""
    linked = link(text, scene, focus, lexicon)
    elsewhere = without_denied(linked)
    if elsewhere is not None:
        wanted, words, denied = elsewhere
        rest = link_deed(wanted, scene, focus, lexicon)
        return replace(rest, caution=rest.caution + words, denied=denied)
    told = bans(linked)
    if not told:
        return _without_cautions(linked, scene, focus, lexicon)
    core, said = _parted(told, linked)
    if not any(character.isalnum() for character in core):
        return _without_cautions(linked, scene, focus, lexicon)
    core = _rest_named(core, told, scene, lexicon)
    rest = _without_cautions(link(core, scene, focus, lexicon), scene, focus, lexicon)
    spared = tuple(dict.fromkeys((*rest.spared, *_kept(told, rest, scene))))
    alone = {o for ban in told if ban.verb in TOUCHING or not ban.verb for one in ban.named
             for o in one.mention.objects}  # fmt: skip
    touchable = tuple(o for o in _only_touched(rest) if o not in alone)
    return replace(rest, spared=spared, touchable=touchable, caution=rest.caution + said)


def only_forbids(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> bool:
    """Whether a sentence says what must stay, and nothing else."""
    linked = link(text, scene, focus, lexicon)
    told = bans(linked)
    core, _ = _parted(told, linked)
    if any(ban.scope == "others" for ban in told):
        return False  # "touch only the jar" asks for it
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
    tool = only_the_tool(deed)
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
            strict = ban.scope == "all" and ban.verb in _STAYING and not _BUT.search(deed.text)
            kept += [o for o in every if strict or o not in movers]
    return tuple(dict.fromkeys(kept))


def _left_out(linked: Linked, lexicon: Lexicon) -> tuple[str, ...]:
    """ "Don't put the red cup on the plate, only the blue one": the red cup is to stay."""
    left = _not_meant(linked)
    for at, token in enumerate(linked.tokens):
        denied = token.text in ("don't", "never") or (
            token.text == "not" and at > 0 and linked.tokens[at - 1].text == "do"
        )
        verb = past_light(at + 1, linked)
        if not denied or lexicon.verb(word_at(verb, linked)) not in _MOVING:
            continue
        joints = (c.first for c in linked.chunks if c.kind == "joint" and c.first > verb)
        end = next(joints, len(linked.tokens))
        inside = [s for s in linked.spoken if s.theme and verb < s.first < end]
        instead = {o for s in linked.spoken if s.theme and s not in inside
                   for o in s.mention.objects}  # fmt: skip
        if instead:
            left += [o for s in inside for o in s.mention.objects if o not in instead]
    return tuple(dict.fromkeys(left))


def _not_meant(linked: Linked) -> list[str]:
    """ "The block on the right, not the ones on the left": these are to stay."""
    if CHOICES & {token.text for token in linked.tokens}:
        return []
    no, yes = set[str](), set[str]()
    for one in linked.spoken:
        every = one.phrase is None or one.phrase.det in ("all", "both", "every", "each", "any")
        denied = one.theme and not every and word_at(one.opened - 1, linked) == "not"
        if denied and one.opened:
            no.update(one.mention.objects)
        elif settles(one.mention):
            yes.update(one.mention.objects)
    return sorted(no - yes)


def _parted(found: Sequence[Caution | Ban], linked: Linked) -> tuple[str, str]:
    """The sentence without its cautions, and their words. A pronoun that stands for what only a
    caution before it names is put as its name."""
    core, said, at = "", "", 0
    for caution in found:
        first, last = caution.first, caution.last
        while first == 0 and word_at(last, linked) in BEHIND:
            last += 1
        start, end = linked.tokens[first].start, linked.tokens[last - 1].end
        before = _named_again(at, start, found, linked).rstrip()
        if isinstance(caution, Ban):
            before = _HANGING.sub("", before)
        core = f"{core.rstrip()} {before} ".lstrip()
        lead = "" if word_at(first, linked) in JOINING else ","
        said += f"{lead} {linked.text[start:end].strip(' ,')}"
        at = end
    rest = _named_again(at, len(linked.text), found, linked).lstrip()
    final = found[-1] if found else None
    if isinstance(final, Ban):
        rest = rest.lstrip(" ?!") if not core else _AGAIN.sub("", rest)
        if final.scope == "others" and len(final.named) == 1:
            rest = _WHICH.sub(f"the {final.named[0].mention.text}", rest)
        left_out = _BUT_FOR.search(final.named[-1].mention.text) if final.named else None
        if final.scope == "these" and left_out is not None:
            rest = _WHICH.sub(left_out[1], rest)
    return (core + rest).strip(), said


def _rest_named(core: str, told: Sequence[Ban], scene: Scene, lexicon: Lexicon) -> str:
    """ "The red one stays, the other two go in the box": which ones these are, where the clause
    that was cut says it."""
    named = [one for ban in told if ban.scope == "these" for one in ban.named]
    said = _OTHERS.search(core)
    if said is None or not named or named[-1].phrase is None:
        return core
    stay = {o for one in named for o in one.mention.objects}
    head = named[-1].phrase.head[-1:]
    kin = {item.id for item in scene if head and singular(item.name.split()[-1]) == head[0]}
    others = [item.id for item in scene
              if item.id in kin | set(named[-1].same_type) and item.id not in stay]  # fmt: skip
    noun, count = said["noun"], number(said["count"].lower()) if said["count"] else None
    fits = noun is None or (singular(noun.lower()),) == tuple(map(singular, head))
    fits = fits and (count is None or count == len(others))
    if not fits or not 0 < len(others) <= _MOST_NAMED:
        return core
    name = listing(labels(others, scene, lexicon).values())
    return f"{core[: said.start()]}{name}{core[said.end() :]}"


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
            if word_at(one.opened - 1, linked) in ("of", "among"):
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
