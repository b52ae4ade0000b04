"""A program that is to set one thing on another, and does not: what lies on the one is lifted in
its stead, or it goes beside.
"""

from __future__ import annotations

import re

from clarifier.binding import Binding
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken
from scene.relations import upon
from scene.types import Scene

_PUT_ON = re.compile(r"\bput_on\((m\d+), (m\d+)\)")
_PLAINLY = frozenset({"top", "onto", "upon", "atop"})
"""Words after which nothing but on top of it can be meant."""
_IFS = frozenset({"if", "unless", "whether", "when", "should", "not", "don't", "isn't"})


def not_set_upon(linked: Linked, body: str, binding: Binding, after: Scene) -> bool:
    """Whether something does not end on what the program, or the sentence plainly, sets it on."""
    pairs = [(binding.get(a, ()), binding.get(b, ())) for a, b in _PUT_ON.findall(body)]
    if not _IFS & {token.text for token in linked.tokens}:
        pairs += [
            (binding.get(theme.mention.slot, ()), binding.get(one.mention.slot, ()))
            for one in linked.spoken
            if _plainly_on(one, linked) and (theme := _theme(one, linked)) is not None
        ]
    single = ((a[0], b[0]) for a, b in pairs if len(a) == len(b) == 1 and a != b)
    return any(a not in upon(after, b) for a, b in single)


def _plainly_on(one: Spoken, linked: Linked) -> bool:
    """Whether "on top of", "onto" leads to a mention."""
    led = next((chunk for chunk in linked.chunks if chunk.last == one.opened), None)
    return one.relation == "on" and led is not None and bool(_PLAINLY & _words(led, linked))


def _words(chunk: Chunk, linked: Linked) -> set[str]:
    return {token.text for token in linked.tokens[chunk.first : chunk.last]}


def _theme(one: Spoken, linked: Linked) -> Spoken | None:
    """What the verb before a mention puts there, if it is one thing of which nothing else is
    said."""
    before = [s for s in linked.spoken if s.last <= one.first and s.region == one.region]
    alone = len(before) == 1 and before[0].theme and before[0].verb == "place"
    return before[0] if alone else None
