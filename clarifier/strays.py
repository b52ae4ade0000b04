"""Exceptions said too late: "put everything in the box, except the cup" is read as "put everything
except the cup in the box".
"""

from __future__ import annotations

from clarifier.spoken import Linked, Spoken

_CONCEDING = frozenset({"though", "however"})
_CLOSING = _CONCEDING | {"please", "thanks", "then", "thank", "ok"}
_LISTS = frozenset({"and", "or", ",", "nor"})


def gathered(linked: Linked) -> str | None:
    """The sentence with its late exception behind the one group that it can be an exception to;
    None if there is none."""
    at = _late_exception(linked)
    if at is None:
        return None
    groups = [one for one in linked.spoken if one.mention.plural and one.theme
              and one.last <= linked.chunks[at].first]  # fmt: skip
    end = _end_of_list(linked, at)
    if len(groups) != 1 or end is None or not _covers(linked, groups[0], at, end):
        return None
    first, last = linked.chunks[at + 1].first, linked.chunks[end - 1].last
    said = linked.text[linked.tokens[first].start : linked.tokens[last - 1].end]
    until = linked.text[: linked.tokens[linked.chunks[at].first].start].rstrip(" ,-")
    if last < len(linked.tokens) and linked.tokens[last].text in _CONCEDING:
        last += 1
    group, rest = groups[0].mention.end, linked.text[linked.tokens[last - 1].end :]
    return f"{until[:group]} except {said}{until[group:]}{rest}"


def _late_exception(linked: Linked) -> int | None:
    """The chunk of an exception that no mention took in: "except", ", not"."""
    for at, chunk in enumerate(linked.chunks[:-1]):
        taken = any(one.first <= chunk.first < one.last for one in linked.spoken)
        words = [token.text for token in linked.tokens[max(chunk.first - 1, 0) : chunk.last]]
        late = (chunk.kind == "except" and chunk.value == "") or words == [",", "not"]
        if late and not taken and linked.chunks[at + 1].kind == "np":
            return at
    return None


def _end_of_list(linked: Linked, at: int) -> int | None:
    """Index behind the things that an exception lists, if the sentence or clause ends there."""
    end = at + 2
    while end + 1 < len(linked.chunks):
        joint, more = linked.chunks[end], linked.chunks[end + 1]
        if linked.tokens[joint.first].text not in _LISTS or more.kind != "np":
            break
        end += 2
    over = end == len(linked.chunks) or linked.chunks[end].kind == "joint"
    over = over or linked.tokens[linked.chunks[end].first].text in _CLOSING
    return end if over else None


def _covers(linked: Linked, group: Spoken, at: int, end: int) -> bool:
    """Whether all that is excepted belongs to the group; "the red one" is the one that does."""
    first, last = linked.chunks[at].first, linked.chunks[end - 1].last
    named = [one for one in linked.spoken if first <= one.first and one.last <= last]
    return bool(named) and all(_belongs(one, group) for one in named)


def _belongs(one: Spoken, group: Spoken) -> bool:
    objects, members = set(one.mention.objects), set(group.mention.objects)
    if one.phrase is not None and not one.phrase.head:
        return bool(objects & members)
    return bool(objects) and objects <= members
