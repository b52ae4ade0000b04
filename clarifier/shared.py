"""A landmark that a list says once: "the fork left of the plate, the knife on the right, and the
spoon behind" means all of the plate.
"""

from __future__ import annotations

from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken, settles

_SIDED = {"left": "left of", "right": "right of"}
_STANDING = {"above": "behind", "below": "in front of", "left": "left of", "right": "right of"}
_LISTING = frozenset({",", ";", "and", "then", "&"})


def landmark_shared(linked: Linked) -> str | None:
    """The sentence with the landmark said for every item of the list; None where each has its own,
    or the list is of something else."""
    text, landmark = linked.text, None
    edits: list[tuple[int, int, str]] = []
    for at, chunk in enumerate(linked.chunks):
        if chunk.kind != "relation":
            continue
        own = next((one for one in linked.spoken if one.opened == chunk.last), None)
        if own is not None and own.phrase is not None:
            landmark = own if chunk.value in _STANDING and settles(own.mention) else None
            continue
        place = _bare_side(at, linked) if landmark is not None else None
        if place is not None and landmark is not None and _lists(chunk, landmark, linked):
            edits.append((*place[1], f"{place[0]} {_named(landmark, linked)}"))
    for start, end, said in reversed(edits):
        text = f"{text[:start]}{said}{text[end:]}"
    return text if edits else None


def _bare_side(at: int, linked: Linked) -> tuple[str, tuple[int, int]] | None:
    """ "on the right", "behind", with no landmark: what it says of one, and its characters."""
    chunk = linked.chunks[at]
    following = linked.chunks[at + 1] if at + 1 < len(linked.chunks) else None
    start = linked.tokens[chunk.first].start
    if chunk.value in _STANDING and _over(chunk.last, linked):
        return _STANDING[chunk.value], (start, linked.tokens[chunk.last - 1].end)
    if following is None or following.kind != "place" or not _over(following.last, linked):
        return None
    said = [token.text for token in linked.tokens[chunk.first : following.last]]
    side = "in front of" if said == ["in", "front"] else _SIDED.get(said[-1])
    bare = following.last - following.first <= 2
    end = linked.tokens[following.last - 1].end
    return (side, (start, end)) if side is not None and bare else None


def _over(at: int, linked: Linked) -> bool:
    """Whether an item of a list ends before a token."""
    return at == len(linked.tokens) or linked.tokens[at].text in _LISTING | {".", "!"}


def _lists(chunk: Chunk, landmark: Spoken, linked: Linked) -> bool:
    """Whether a new item, without a verb of its own, stands between the landmark and a relation."""
    ahead = [one for one in linked.spoken if one.theme and one.phrase is not None]
    item = next((one for one in ahead if one.phrase and one.phrase.last == chunk.first), None)
    if item is None or item.first < landmark.last or item.mention.slot == landmark.mention.slot:
        return False
    joint = {token.text for token in linked.tokens[item.opened - 1 : item.opened]}
    between = range(landmark.last, chunk.first)
    return joint <= _LISTING and not any(
        other.kind == "verb" and other.first in between for other in linked.chunks
    )


def _named(landmark: Spoken, linked: Linked) -> str:
    return linked.text[linked.tokens[landmark.opened].start : landmark.mention.end]
