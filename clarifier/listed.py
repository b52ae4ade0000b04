"""A group whose members are listed behind it, in an order: the list is read in the group's place.

"Sort the blocks from left to right: red, green, blue" as "sort the red block, the green block and
the blue block from left to right". The things, and their order, are those that the sentence names.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from clarifier.sequences import LISTING, rank_of, upright
from clarifier.spoken import Linked, Spoken, settles
from clarifier.words import listing, singular

_LEADING = frozenset({":", ",", ";", "as", "follows", "are", "they", "order", "this", "following"}
                     | {"namely", "in", "the", "like", "so", "is", "first"})  # fmt: skip
_CLOSING = frozenset({".", "!", "please", ",", "order", "in", "that", "this"})
_THEIR_WAY = {"x": "from left to right", "y": "from front to back"}


def members_listed(linked: Linked) -> str | None:
    """The sentence with a group's members in its place; None where no list of them follows it."""
    for group in linked.spoken:
        items = _items(group, linked)
        if len(items) < 2 or group.phrase is None:
            continue
        ranks = [rank_of(item, linked) for item in items]
        begun = _begun(items, ranks, linked)
        if begun is not None:
            return _in_its_place(group, items, items, linked, begun)
        if all(ranks):
            return _in_ranks(group, items, [rank for rank in ranks if rank], linked)
        if not any(ranks) and _ends_with(items[-1], linked):
            return _in_its_place(group, items, items, linked, "")
    return None


def _items(group: Spoken, linked: Linked) -> list[Spoken]:
    """The members of the group where the end of the sentence lists every one of them."""
    if not group.mention.plural or not group.theme or group.mention.free:
        return []
    found = [one for one in linked.spoken if one.first >= group.last]
    if found and found[0].mention.slot == group.mention.slot:
        found = found[1:]  # "... so that they are red, green, blue"
    whole = set(group.mention.objects)
    named = [one.mention.objects for one in found if settles(one.mention)]
    fits = len(named) == len(found) == len(set(named)) and {o for (o,) in named} == whole
    led = bool(found) and {t.text for t in linked.tokens[found[0].opened - 1 : found[0].opened]}
    return found if fits and led and led <= _LEADING and _parted(found, linked) else []


def _parted(items: Sequence[Spoken], linked: Linked) -> bool:
    """Whether nothing but a joint, or the place of the one before, stands between the items."""
    for one, other in pairwise(items):
        first = one.phrase.last if one.phrase is not None else one.last
        between = [token.text for token in linked.tokens[first : other.opened]]
        if not between or between[-1] not in LISTING:
            return False
        if not set(between) <= LISTING and rank_of(one, linked) is None:
            return False
    return True


def _begun(
    items: Sequence[Spoken], ranks: Sequence[tuple[str, int] | None], linked: Linked
) -> str | None:
    """The way of a list whose first says where it begins: "red at the bottom, then blue, then
    green", "yellow on top" of its last; None where it does not, or more is said."""
    first, *others, last = ranks
    if first is None or first[1] == 1 or any(others) or (others == [] and last is not None):
        return None
    if last is not None and last != (first[0], 2 - first[1]):
        return None
    if last is None and not _ends_with(items[-1], linked):
        return None
    return _FROM[first]


_FROM = {
    ("x", 0): "from left to right", ("x", 2): "from right to left",
    ("y", 0): "from front to back", ("y", 2): "from back to front",
    ("z", 0): "from the bottom up", ("z", 2): "from the top down",
}  # fmt: skip


def _ends_with(item: Spoken, linked: Linked) -> bool:
    return {token.text for token in linked.tokens[item.last :]} <= _CLOSING


def _in_ranks(
    group: Spoken, items: Sequence[Spoken], ranks: Sequence[tuple[str, int]], linked: Linked
) -> str | None:
    """ "Line the blocks up, red on the left, blue on the right": from left to right."""
    axes = {axis for axis, rank in ranks if rank != 1}
    if len(axes) != 1 or len({rank for _, rank in ranks}) < len(items):
        return None
    (axis,) = axes
    if upright(linked):
        text, start = linked.text, linked.tokens[items[0].opened].start
        before = text[: linked.tokens[group.opened].start].rstrip()
        return f"{before} {text[start:]}"
    order = [item for _, item in sorted(zip(ranks, items, strict=True), key=lambda p: p[0][1])]
    return _in_its_place(group, order, items, linked, _THEIR_WAY[axis])


def _in_its_place(
    group: Spoken, order: Sequence[Spoken], items: Sequence[Spoken], linked: Linked, way: str
) -> str:
    """The members for the group, and the list cut off; ``way`` is said at the end."""
    text, at = linked.text, items[0].opened
    while at > group.last and linked.tokens[at - 1].text in _LEADING:
        at -= 1
    start, end = linked.tokens[group.opened].start, linked.tokens[at - 1].end
    named = listing(_in_full(item, group) for item in order)
    rest = text[group.mention.end : end]
    return f"{text[:start]}{named}{rest} {way}".strip()


def _in_full(item: Spoken, group: Spoken) -> str:
    """ "the red block" for "red" of the blocks."""
    phrase, whole = item.phrase, group.phrase
    if phrase is None or whole is None or phrase.head or not whole.head:
        bare = item.mention.text
        return bare if bare.lower().startswith("the ") else f"the {bare}"
    return f"the {' '.join((*phrase.modifiers, *whole.head[:-1], singular(whole.head[-1])))}"
