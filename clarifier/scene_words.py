"""How the things of a scene, and places on its table, are called in answers."""

from __future__ import annotations

from collections.abc import Sequence

from clarifier.ask import labels
from clarifier.lexicon import Lexicon
from clarifier.located import Link
from clarifier.spoken import Spoken
from clarifier.things import thing_of
from clarifier.words import article, listing, singular
from scene import relations
from scene.types import Scene, SceneObject

_RELATIONS = {
    "on": "on", "in": "in", "left": "to the left of", "right": "to the right of",
    "above": "behind", "below": "in front of", "beside": "next to", "between": "between",
    "nearest": "nearest to", "furthest": "furthest from",
}  # fmt: skip


class SceneWords:
    """Words for one scene."""

    def __init__(self, scene: Scene, lexicon: Lexicon) -> None:
        self._scene = scene
        self._lexicon = lexicon

    def label(self, object_id: str) -> str:
        """The object's name with the article, told apart from others of its name."""
        item = self._scene.get(object_id)
        same = [other.id for other in self._scene if other.name == item.name]
        return labels(same, self._scene, self._lexicon)[object_id]

    def labels(self, objects: Sequence[str]) -> str:
        """The objects as a list."""
        return listing(self.label(object_id) for object_id in objects)

    def whereabouts(self, object_id: str) -> str:
        """That an object is where it is."""
        return f"{self.label(object_id)} is {self.place(object_id)}"

    def place(self, object_id: str) -> str:
        """Where an object is, in words."""
        item = self._scene.get(object_id)
        if item.held or item.on == "gripper":
            return "in my gripper"
        if item.on in ("tray", "floor"):
            return "waiting in the tray" if item.on == "tray" else "on the floor"
        if item.on != "table":
            carrier = self._scene.get(item.on)
            noun = thing_of(carrier, self._lexicon).head
            return f"{self._lexicon.goes(noun) or 'on'} {self.label(carrier.id)}"
        near = [
            i
            for i in self._scene.objects
            if i.id != object_id and i.on == "table" and relations.next_to(self._scene, item, i)
        ]
        beside = f", next to {listing(self.label(i.id) for i in near[:2])}" if near else ""
        return f"{_region(item, self._scene)}{beside}"

    def relation(self, link_: Link) -> str:
        """What a relation comes to: "to the left of the cup", "on the far side"."""
        if link_.sides:
            side = " ".join(link_.sides)
            return {"table": "on the table", "floor": "on the floor", "middle": "in the middle",
                    "edge": "at the edge", "corner": "in a corner"}.get(
                        side, f"on the {side} side")  # fmt: skip
        anchors = [self.label(anchor) for anchor in link_.anchors]
        return f"{_RELATIONS[link_.relation]} {listing(anchors)}"

    def length(self, units: float) -> str:
        """A length (table units) in centimetres."""
        cm = units * self._scene.table_m / 2 * 100
        return f"{cm:.0f} cm" if cm >= 2 else f"{cm:.1f} cm"

    def unseen(self, spoken: Spoken | None) -> str:
        """That what was named is not here."""
        if spoken is None or spoken.phrase is None:
            return "I don't know which thing you mean."
        noun = " ".join((*spoken.phrase.modifiers, *spoken.phrase.head))
        return f"I can't see {article(one_of(noun))}." if noun else "I can't see one."


def _region(item: SceneObject, scene: Scene) -> str:
    """The part of the table in which an object stands."""
    if relations.centred(scene, item):
        return "in the middle of the table"
    across = [side for side in ("left", "right") if relations.at_edge(scene, item, side)]
    along = [side for side in ("above", "below") if relations.at_edge(scene, item, side)]
    names = {"above": "far", "below": "near"}
    if across and along:
        return f"in the {names[along[0]]} {across[0]} corner"
    if across or along:
        side = (across + [names[s] for s in along])[0]
        return f"at the {side} edge of the table"
    x, y = item.position
    if abs(x) >= abs(y):
        return f"on the {'left' if x < 0 else 'right'} side of the table"
    return f"on the {'far' if y > 0 else 'near'} side of the table"


def one_of(noun: str) -> str:
    """A noun of one or several words in the singular."""
    head, _, last = noun.rpartition(" ")
    return f"{head} {singular(last)}".strip()
