"""Clarifiers with one of their parts left out, to show what it is worth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from agent.messages import Decision, Kind
from clarifier.candidates import Outcome, Planner, Reading
from clarifier.conformal import PRODUCT
from clarifier.decide import Manner
from clarifier.ladder import Ladder
from clarifier.refusals import State
from clarifier.spoken import Linked
from scene.types import Scene

EVERYTHING = 2.0
"""A probability that nothing has: no set, or no question."""


class NoRules(Ladder):
    """Counts no referents and misses no role: the translator alone decides, over the first things
    that fit."""

    def absent(self, linked: Linked, state: State) -> Decision | None:
        """Never."""
        return None

    def how_many(self, linked: Linked, state: State) -> Decision | None:
        """Never."""
        return None

    def which(self, linked: Linked, state: State) -> Decision | None:
        """Never."""
        return None

    def role(self, linked: Linked, state: State) -> Decision | None:
        """Never."""
        return None

    def unknown_deed(self, linked: Linked, state: State) -> Decision | None:
        """Never."""
        return None


class NoVeto(Planner):
    """Takes every candidate, whatever things it uses."""

    def read(self, linked: Linked, kind: Kind, scene: Scene) -> Reading:
        """The reading with all its candidates."""
        reading = super().read(linked, kind, scene)
        return replace(reading, candidates=reading.translation.candidates)


class TextClusters(Planner):
    """Programs are one outcome if they are one text, whatever they come to."""

    def alike(self, one: Outcome, other: Outcome, scene: Scene) -> bool:
        """Whether the programs read the same."""
        return one.checked is not None and other.checked is not None and (
            one.checked.program == other.checked.program
        )  # fmt: skip


_LEVEL = PRODUCT.level
ALWAYS = Manner(
    PRODUCT._replace(level=EVERYTHING, act=0.0, stated=0.0, ask=EVERYTHING), ladder=NoRules
)
"""Acts whenever anything can be run."""
ABLATIONS: Mapping[str, Manner] = {
    "the product": Manner(),
    "no rules of structure": Manner(ladder=NoRules),
    "no conformal set (floors alone)": Manner(PRODUCT._replace(level=EVERYTHING)),
    "conformal set alone (no floors)": Manner(
        PRODUCT._replace(act=_LEVEL, stated=_LEVEL, ask=_LEVEL)
    ),
    "no veto": Manner(planner=NoVeto),
    "clusters by text": Manner(planner=TextClusters),
    "always act": ALWAYS,
}
