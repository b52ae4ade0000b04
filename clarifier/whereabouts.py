"""Where things are said to be: beside others, in parts of the table, nearer, farther, within."""

from __future__ import annotations

import re

from clarifier.amounts import amounts
from clarifier.comparing import Mark, agreed, denied, every, in_part, is_further, nearer, stands
from clarifier.located import sides_said
from clarifier.named import TABLE, Predicate, Test, Things
from clarifier.words import singular, words
from scene import relations
from scene.types import SceneObject

TOUCHING = 0.03
"""Things with a gap no wider touch (table units)."""
_PLACES = frozenset(
    {"the", "my", "our", "a", "an", "any", "one", "far", "near", "left", "right", "top", "bottom"}
    | {"front", "back", "hand", "handed", "side", "half", "edge", "corner", "middle", "centre"}
    | {"center", "central", "of", "very", "upper", "lower", "rear", "closest", "nearest", "to"}
    | {"furthest", "farthest", "me", "end", "part", "floor", "ground", "area"}
)
_VERTICAL = frozenset({"above", "over", "below", "under", "underneath", "beneath"})
"""Relations that may also be meant of what stands one on another: not read."""
_NEARER = re.compile(
    r"^(?:(?:any|even|a bit|a little|slightly|still) )*(?P<how>nearer|closer|more near|more close|"
    r"further|farther|more far|further away|farther away)(?: away)?(?: (?:to|from|towards|"
    r"of))? (?P<mark>.+?) than (?P<own>(?:(?:it|they)(?:'s|'re| is| are)? )?(?:to|"
    r"from) )?(?P<what>.+?)(?P<is> (?:is|are|does))?$"
)
_FURTHER = re.compile(
    r"^(?:(?:any|even|a bit|a little|slightly|still) )*(?:more|further|farther|furthest)(?: to|"
    r" on)?(?: the)? (?P<side>left|right|back|forward|forwards|away|far)(?: back| over|"
    r" away)? than (?P<what>.+?)(?: is| are)?$"
)
_FAR = re.compile(
    r"^(?:(?P<near>within|less than|under|closer than|nearer than|no more than|not more than|"
    r"at most|no further than)|more than|over|at least|further than|farther than|"
    r"further away than) (?P<far>.+?) (?:(?:away )?(?:from|of|to)|distance from) (?P<what>.+)$"
)
_ADVANCING = {"left": "left", "right": "right", "back": "far", "away": "far", "far": "far",
              "forward": "near", "forwards": "near"}  # fmt: skip
"""Ways of going on, and the side of the table that each leads to."""


class Whereabouts(Things):
    """Reads predicates that say where a thing is."""

    def further_to(self, said: str) -> Predicate | None:
        match = _FURTHER.match(said)
        other = self.single(match["what"]) if match is not None else None
        if match is None or other is None:
            return None
        side = _ADVANCING[match["side"]]
        return Predicate(lambda item: is_further(side, item, other, self.scene), (other.id,))

    def nearer_to(self, said: str) -> Predicate | None:
        """ "nearer to me than the cup", "closer to the jug than to the cup": distances to one mark
        from two things, or from one thing to two marks. Where the words leave open which is meant,
        both must come to the same."""
        match = _NEARER.match(said)
        first = self._mark(match["mark"]) if match is not None else None
        if match is None or first is None:
            return None
        second = self._mark(match["what"])
        other = None if match["own"] else self.single(match["what"])
        near = match["how"].startswith(("near", "close", "more near", "more close"))
        tests: list[Test] = []
        if other is not None:
            tests.append(lambda item: self._is_nearer(first.far(item), first.far(other), near))
        apart = other is None and second is not None and second.thing is None
        marks = match["own"] or first.thing is not None or apart
        if second is not None and not match["is"] and marks:
            tests.append(lambda item: self._is_nearer(first.far(item), second.far(item), near))
        others = tuple(one.thing.id for one in (first, second) if one is not None and one.thing)
        if not tests:
            return None
        return Predicate(lambda item: agreed(test(item) for test in tests), others)

    def _is_nearer(
        self, one: tuple[float, ...], other: tuple[float, ...], near: bool
    ) -> bool | None:
        return nearer(one, other, self.scene) if near else nearer(other, one, self.scene)

    def _mark(self, text: str) -> Mark | None:
        if text in ("me", "us", "myself", "my side", "my end", "where i sit", "where i am"):
            return Mark(side="near")
        thing, said = self.single(text), words(text)
        if thing is not None:
            return Mark(thing)
        sides = sides_said(said, self.lexicon) if set(said) <= _PLACES | TABLE else ()
        known = sides[:1] if sides and sides[0] not in ("table", "floor", "corner") else ()
        return Mark(side=known[0]) if len(sides) == 1 and known else None

    def at_distance(self, said: str) -> Predicate | None:
        """ "within 5 cm of the vice", "more than 10 cm away from the edge"."""
        match = _FAR.match(said)
        found = [one for one in amounts(match["far"]) if one.sort == "d"] if match else []
        whole = match is not None and [(one.start, one.end) for one in found] == [
            (0, len(match["far"]))]  # fmt: skip
        mark = self._mark(match["what"]) if match is not None and whole else None
        if match is None or mark is None:
            return None
        most, near = self.scene.units(found[0].value), match["near"] is not None
        others = (mark.thing.id,) if mark.thing is not None else ()
        return Predicate(lambda item: _as(near, mark.within(item, most)), others)

    def placed(self, said: str) -> Predicate | None:
        """ "on the plate", "to the left of the bowl", "in the near right corner"."""
        touched = re.match(
            r"^(?:touching|in contact with|up against|right against) (?P<what>.+)$", said
        )
        if touched is not None:
            other = self.single(touched["what"])
            return None if other is None or other.x is None else Predicate(
                lambda item: item.id != other.id and Mark(other).within(item, TOUCHING),
                (other.id,), f"next to {touched['what']}",
            )  # fmt: skip
        for run, relation in self.lexicon.relations:
            lead = " ".join(run)
            rest = said[len(lead) + 1 :] if said.startswith(f"{lead} ") else ""
            if not rest:
                continue
            zone = self._zone(said, rest, lead)
            if zone is not None:
                return Predicate(zone, where=said)
            if lead in _VERTICAL or relation not in (
                "left", "right", "above", "below", "beside", "between", "on", "in",
            ):  # fmt: skip
                continue
            things = self._anchors(rest, relation)
            if things:
                return self._standing(relation, things, said)
            group = self.named(rest)
            if group is not None and group.several and relation in relations.ALONG:
                return self._of_all(relation, group.objects, said)
        return None

    def _standing(self, to: str, things: list[SceneObject], said: str) -> Predicate:
        others = tuple(one.id for one in things)
        return Predicate(lambda item: stands(to, item, things, self.scene), others, said)

    def _of_all(self, to: str, objects: tuple[str, ...], said: str) -> Predicate:
        """ "Behind both cups"."""
        things = [self.scene.get(object_id) for object_id in objects]
        return Predicate(
            lambda item: every(stands(to, item, [one], self.scene) for one in things
                               if one.x is not None), objects, said,
        )  # fmt: skip

    def _zone(self, whole: str, rest: str, lead: str) -> Test | None:
        """The part of the table that a place phrase names, as a test."""
        said = words(rest)
        if not said or not set(said) <= _PLACES | TABLE or self.single(rest) is not None:
            return None
        whole_table = set(said) <= TABLE | {"the", "my", "our"}
        if lead in ("on", "upon") and whole_table:
            return lambda item: item.on not in ("floor", "tray", "gripper")
        if not whole_table and lead not in ("in", "on", "at", "near", "by", "to"):
            return None
        sides = sides_said(words(whole) if whole_table else said, self.lexicon)
        if not sides or sides == ("table",):
            return None
        said = words(whole)
        kinds = ("corner", "edge", "end")
        kind = next((one for one in kinds if one in map(singular, said)), "part")
        return lambda item: in_part(sides, "edge" if kind == "end" else kind, item, self.scene)

    def _anchors(self, rest: str, relation: str) -> list[SceneObject]:
        texts = rest.split(" and ") if relation == "between" else [rest]
        found = [one for one in map(self.single, texts) if one is not None and one.x is not None]
        group = self.named(rest) if relation == "between" and len(texts) == 1 else None
        if group is not None and group.several:
            found = [self.scene.get(object_id) for object_id in group.objects]
        return found if len(found) == (2 if relation == "between" else 1) else []


def _as(wanted: bool, answer: bool | None) -> bool | None:
    return answer if wanted else denied(answer)
