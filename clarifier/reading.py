"""A sentence while its mentions are being found, left to right: what is known so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from agent.messages import Focus
from clarifier.lexicon import Lexicon
from clarifier.pieces import Chunk
from clarifier.reference import Context
from clarifier.spoken import Spoken, settles
from clarifier.things import things_of
from clarifier.words import Token, stems
from scene.types import Scene

_STIRRING = frozenset({"push", "turn", "touch", "topple"})
"""Classes of verbs that are done to what stands somewhere; "pick" may empty the tray."""
COPULAS = frozenset({"is", "are", "be", "being", "was", "were", "stays", "remains", "becomes"})


@dataclass
class Reading:
    """Chunks, scene and conversation, and what was found up to here.

    ``verb`` is the class of the verb that governs now, ``said_verb`` its form, ``region`` counts
    verbs. ``chosen``: the sentence chooses among things that it names ("the larger of the two").
    ``naming``: it only names a thing, one of ``among``.
    """

    text: str
    tokens: tuple[Token, ...]
    chunks: tuple[Chunk, ...]
    scene: Scene
    focus: tuple[Focus, ...]
    lexicon: Lexicon
    spoken: list[Spoken] = field(default_factory=list)
    naming: bool = False
    among: tuple[str, ...] | None = None
    verb: str = ""
    said_verb: str = ""
    region: int = 0
    chosen: bool = False

    def chunk_text(self, at: int) -> str:
        """The words of a chunk; nothing beyond the ends of the sentence."""
        if not 0 <= at < len(self.chunks):
            return ""
        chunk = self.chunks[at]
        return " ".join(token.text for token in self.tokens[chunk.first : chunk.last])

    def in_choice(self, at: int) -> bool:
        """Whether a chunk is one of those that a choice is made from: "of it and the cup", ", the
        other one or the bowl"."""
        before, behind = self.chunk_text(at - 1), self.chunk_text(at + 1)
        if not self.chosen or behind not in ("and", "or", ","):
            return before in ("and", "or") and self.chosen and at + 1 == len(self.chunks)
        listed = at + 2 < len(self.chunks) and self.chunks[at + 2].kind in ("np", "joint")
        return listed and before in ("of", "among", "between", "and", "or", ",", "compare")

    def context(self) -> Context:
        """What a phrase is read against at this point."""
        order = sorted(self.focus, key=lambda one: -one.salience)
        named = [o for one in self.spoken for o in one.mention.objects if settles(one.mention)]
        several = [one for one in self.spoken if one.mention.plural and not one.mention.free]
        groups = [one.mention for one in several if not counted_off(one)]
        grouped = tuple(o for group in groups for o in group.objects)
        focus = tuple(f.object for f in order)
        counted = [one for one in reversed(self.spoken) if counted_off(one)]
        counted.sort(key=lambda one: not one.theme)  # of those in a bowl, not of the bowls
        part = counted[0].mention.objects if counted else ()
        return Context(
            self.scene, self.lexicon, focus, tuple(named), grouped, part=part,
            fellows=self._fellows(), standing=self._stirs(),
        )  # fmt: skip

    def _stirs(self) -> bool:
        """Whether the verb that governs is done to what stands somewhere already."""
        said = set(stems(self.said_verb)) & self.lexicon.words("stirring")
        return bool(said) or self.verb in _STIRRING

    def _fellows(self) -> tuple[str, ...]:
        """What the group last spoken of is taken from, by its noun ("the red blocks": blocks), or
        where that is left out by what its things are, if they are of several kinds."""
        groups = [one for one in self.spoken if one.theme and one.mention.plural and one.phrase]
        last = groups[-1] if groups else None
        if last is None or last.phrase is None or last.phrase.group:
            return ()
        kinds = {
            t.head for t in things_of(self.scene, self.lexicon) if t.id in last.mention.objects
        }
        return last.same_type if len(kinds) > 1 else ()

    def among_context(self) -> Context:
        """For the first mention of an answer, only what it was asked about may be meant."""
        return replace(self.context(), among=None if self.spoken else self.among)

    def relation_before(self, at: int) -> str:
        """The relation that leads to the mention at a chunk; "between A and B" leads to both."""
        if at and self.chunks[at - 1].kind == "relation":
            return self.chunks[at - 1].value
        if at and self.chunk_text(at - 1) == "than":
            return "than"
        joined = at >= 3 and self.chunks[at - 1].kind == "joint"
        if joined and self.spoken and self.spoken[-1].relation == "between":
            return "between"
        return ""


def counted_off(spoken: Spoken) -> bool:
    """ "One of the cups", "two cups", "some cups", "a cup" of several: the rest are the others."""
    phrase = spoken.phrase
    if phrase is None or phrase.group:
        return False
    one = phrase.any_will_do and not phrase.plural and not spoken.relation
    part = phrase.vague or (phrase.det == "a" and phrase.count == 1)
    return part or max(spoken.count, int(one)) in range(1, len(spoken.mention.objects))
