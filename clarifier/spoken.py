"""A sentence with its mentions: what each phrase may mean, and its part in the sentence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import msgspec

from agent.messages import Mention
from clarifier.pieces import Chunk, DeniedPlace, Phrase
from clarifier.words import Token


@dataclass(frozen=True)
class Spoken:
    """A mention with its grammar: ``theme`` is what the verb acts on, else ``relation`` leads to
    it; ``same_type`` are the objects of its noun, adjectives aside."""

    mention: Mention
    phrase: Phrase | None
    same_type: tuple[str, ...]
    theme: bool
    relation: str
    verb: str
    first: int
    last: int
    tie_broken: bool = False
    region: int = 0

    @property
    def opened(self) -> int:
        """The first token, the determiner included."""
        return self.phrase.opened if self.phrase is not None else self.first

    @property
    def count(self) -> int:
        """How many of its objects are meant where that was said, else 0."""
        if self.phrase is None:
            return 0
        both = 2 if self.phrase.det == "both" else 0
        return int(self.phrase.count or both)


@dataclass(frozen=True)
class Linked:
    """A sentence with its mentions, in order, and the pieces it was cut into.

    ``caution`` is what was cut from it ("without touching the box"), ``spared`` are the objects
    that must stay where they are; those of them that are ``touchable`` the tool may come down on;
    ``denied`` is where nothing that is moved may end.
    """

    text: str
    tokens: tuple[Token, ...]
    chunks: tuple[Chunk, ...]
    spoken: tuple[Spoken, ...]
    spared: tuple[str, ...] = ()
    touchable: tuple[str, ...] = ()
    caution: str = ""
    denied: tuple[DeniedPlace, ...] = ()

    @property
    def whole(self) -> str:
        """The sentence with its cautions."""
        return self.text + self.caution

    @property
    def untouchable(self) -> tuple[str, ...]:
        """The spared objects that the tool may not come down on either."""
        return tuple(o for o in self.spared if o not in self.touchable)

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """What the translator is told."""
        return tuple(one.mention for one in self.spoken)

    @property
    def slots(self) -> tuple[str, ...]:
        """Slots in order of first mention."""
        return tuple(dict.fromkeys(one.mention.slot for one in self.spoken))

    def first(self, slot: str) -> Spoken:
        """The first mention of a slot."""
        return next(one for one in self.spoken if one.mention.slot == slot)


def ambiguous(spoken: Spoken) -> bool:
    """Whether a definite phrase fits more things than it speaks of."""
    mention = spoken.mention
    if mention.plural:
        return 0 < spoken.count < len(mention.objects) and not mention.free
    return len(mention.objects) > 1 and not mention.free


def settles(mention: Mention) -> bool:
    """Whether the mention stands for one thing and no other."""
    return len(mention.objects) == 1 and not mention.plural


def called_many(one: Spoken) -> bool:
    """Whether a single thing is spoken of as "them": the scissors, the beans."""
    head = one.phrase.head if one.phrase is not None else ()
    return bool(head) and head[-1].endswith("s") and not head[-1].endswith("ss")


def without_goals(spoken: Sequence[Spoken]) -> list[Spoken]:
    """A group never holds what it is to be put on or next to: "put everything in the box"."""
    left_out: dict[str, set[str]] = {}
    for one in spoken:
        if one.mention.plural and one.theme:
            goals = (other.mention for other in spoken
                     if not other.theme and not other.mention.plural
                     and (other.region == one.region or _goes_to(one, other, spoken)))  # fmt: skip
            left_out.setdefault(one.mention.slot, set()).update(
                o for goal in goals for o in goal.objects
            )
    result = []
    for one in spoken:
        mention = one.mention
        rest = tuple(o for o in mention.objects if o not in left_out.get(mention.slot, ()))
        if rest and rest != mention.objects:
            one = replace(one, mention=msgspec.structs.replace(mention, objects=rest))
        result.append(one)
    return result


def _goes_to(theme: Spoken, goal: Spoken, spoken: Sequence[Spoken]) -> bool:
    """ "Everything goes in the box": the verb behind the theme leads to the goal."""
    between = [one for one in spoken if theme.last <= one.first < goal.first]
    return goal.region == theme.region + 1 and goal.first >= theme.last and not between


_BECOMING = frozenset({"goes", "belongs", "should", "must"})
_REASONS = frozenset({"so", "because", "since", "cause", "cos", "coz", "as"})
"""Words that begin a reason; what a reason speaks of is not what is to be moved."""


def without_asides(linked: Linked) -> Linked:
    """The sentence without mentions of what is not there and was only said in passing.

    "The guests are coming, put the cup on the tray", "... so the dog can't reach it": neither what
    a verb of doing acts on nor where something goes. They stay words; slots are numbered anew.
    """
    done = [one for one in linked.spoken if one.mention.objects and one.verb]
    kept = tuple(
        one for one in linked.spoken
        if one.mention.objects or one.relation or not done or not _in_passing(one, linked)
    )  # fmt: skip
    if len(kept) == len(linked.spoken):
        return linked
    slots = list(dict.fromkeys(one.mention.slot for one in kept))
    numbered = tuple(
        replace(one, mention=msgspec.structs.replace(
            one.mention, slot=f"m{slots.index(one.mention.slot) + 1}"))
        for one in kept
    )  # fmt: skip
    return replace(linked, spoken=numbered)


def _in_passing(spoken: Spoken, linked: Linked) -> bool:
    """Before anything is to be done, unless it is said what is to become of it, or in a reason."""
    behind = linked.tokens[spoken.last].text if spoken.last < len(linked.tokens) else ""
    if not spoken.verb:
        return behind not in _BECOMING
    joints = [c for c in linked.chunks if c.kind == "joint" and c.last <= spoken.first][-2:]
    said = {token.text for c in joints for token in linked.tokens[c.first : c.last]}
    return bool(_REASONS & said)
