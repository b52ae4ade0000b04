"""What "it" and "them" stand for: something of this sentence, else what was spoken of before."""

from __future__ import annotations

from collections.abc import Sequence

from agent.messages import Focus
from clarifier.reading import Reading
from clarifier.reference import denote
from clarifier.spoken import Spoken, called_many, settles

FOCUS_MARGIN = 0.15
"""Saliences closer than this do not settle what "it" is."""
FOCUS_FLOOR = 0.45
"""Least salience at which a thing spoken of before settles "the apple" among several."""
_STANDING = frozenset({"left", "right", "above", "below", "beside"})
_NOT = frozenset({"don't", "dont", "not", "never", "doesn't", "without", "mustn't", "shouldn't"})


class Antecedents(Reading):
    """Finds the objects, and the slot where this sentence has one, that a pronoun stands for."""

    def group_before(self) -> tuple[tuple[str, ...], str | None]:
        """The group last spoken of, in this sentence or in an earlier one."""
        for one in reversed(self.spoken):
            if one.mention.plural:
                return one.mention.objects, one.mention.slot
        pair = next((one for one in reversed(self.spoken) if called_many(one)), None)
        if pair is not None:
            return pair.mention.objects, pair.mention.slot
        if self.spoken:
            return tuple(dict.fromkeys(o for one in self.spoken for o in one.mention.objects)), None
        present = {item.id for item in self.scene}
        recent = [f for f in self.focus if f.salience >= FOCUS_FLOOR and f.object in present]
        themes = [f.object for f in recent if f.salience > recent[0].salience - FOCUS_MARGIN]
        return tuple(themes if len(themes) > 1 else [f.object for f in recent]), None

    def acted_on(self, at: int) -> bool:
        """Whether something is to go where the words behind the chunk say: "put them in the middle
        and ...", "... and them at the left edge"."""
        if at == 0 or at + 1 >= len(self.chunks):
            return False
        before, behind = self.chunks[at - 1], self.chunks[at + 1]
        moves = before.kind == "verb" and before.value in ("place", "push")
        listed = self.chunk_text(at - 1) == "and" and self.chunk_text(at) == "them"
        goes = behind.kind == "relation" and behind.value != "idiom"
        return (moves or listed) and goes

    def means_place(self, at: int) -> bool:
        """ "if the left half has the cup in it": a part of the table, which is no thing."""
        inside = self.relation_before(at) in ("in", "on")
        return inside and any(chunk.kind == "place" for chunk in self.chunks[:at])

    def antecedent(self, pronoun: str, at: int) -> tuple[tuple[str, ...], str | None]:
        """Objects (and slot) that the pronoun stands for: this sentence first, then the focus."""
        inside = self._inside(at)
        if inside is not None:
            return inside
        present = {item.id for item in self.scene}
        living = [f for f in self.focus if f.object in present]
        if not living:
            only = tuple(present) if len(present) == 1 else ()
            return only, None
        best = max(f.salience for f in living)
        tied = [f.object for f in living if f.salience > best - FOCUS_MARGIN]
        return tuple(item.id for item in self.scene if item.id in tied), None

    def _without_own_theme(self, singles: list[Spoken], at: int) -> list[Spoken]:
        """ "the spoon left of it": nothing is put left of itself, so "it" is not the spoon."""
        if not self.relation_before(at) or not singles or not singles[-1].theme:
            return singles
        if self.chunk_text(at - 1) == "with":
            return singles  # "lift the cup and wait with it"
        between = [c for c in self.chunks[:at] if c.first >= singles[-1].last]
        reached = any(c.value == "touch" and c.kind == "verb" for c in between)
        if reached or any(self.tokens[c.first].text == "hold" for c in between):
            return singles  # "the yellow spool, just point at it"
        own = singles[-1].mention.objects
        others = [one for one in singles if one.mention.objects != own]
        near = self.chunks[at - 1].first - singles[-1].last <= 3
        return others if near else singles

    def _told_by(self, one: Spoken) -> str | None:
        """ "Move the plug right of the meter to the left of it": the meter, by which the plug is
        told apart."""
        inside = [c.phrase for c in self.chunks if one.first < c.first and c.last <= one.last]
        found = [denote(phrase, self.context()).objects for phrase in inside if phrase is not None]
        return found[0][0] if len(found) == 1 and len(found[0]) == 1 else None

    def _inside(self, at: int) -> tuple[tuple[str, ...], str | None] | None:
        """The theme of the sentence so far. After "A in B" both may be meant as the next theme."""
        singles = [one for one in self.spoken if not one.mention.plural]
        landmark = self._landmark(singles, at)
        if landmark is not None:
            return landmark.mention.objects, landmark.mention.slot
        own, singles = singles, self._without_own_theme(singles, at)
        if own and not singles and (told := self._told_by(own[-1])) is not None:
            return (told,), None
        themes = [one for one in singles if one.theme]
        if self.chunk_text(at - 1) == "where":  # "put the cup where it was": not the cup
            themes = [one for one in themes if one.region != self.region] or themes
        if not themes:
            return (singles[-1].mention.objects, singles[-1].mention.slot) if singles else None
        theme = themes[-1]
        ends = theme.region + (not theme.verb)  # "the apple must go in the bowl": the verb follows
        holders = [
            one
            for one in singles[singles.index(theme) + 1 :]
            if one.relation in ("in", "on") and theme.region <= one.region <= ends
        ]
        later = not self.relation_before(at)
        later = later and self.region > max((one.region for one in holders), default=self.region)
        later = later and self.verb in ("place", "push", "turn", "topple")
        later = later and not self._goes_there(at)
        denied = any(token.text in _NOT for token in self.tokens[: theme.first])
        if (
            holders
            and later
            and not denied
            and not theme.mention.free
            and settles(holders[-1].mention)
        ):
            return (*theme.mention.objects, holders[-1].mention.objects[0]), None
        return theme.mention.objects, theme.mention.slot

    def _landmark(self, singles: list[Spoken], at: int) -> Spoken | None:
        """ "the fork left of the plate, the knife right of it": what the list was begun about,
        where an item has no verb of its own; None elsewhere."""
        own = singles[-1] if singles else None
        if own is None or not own.theme or not self.relation_before(at) or len(singles) < 3:
            return None
        between = self.tokens[singles[-2].last : own.opened]
        joints = {token.text for token in between}
        listed = bool(joints) and joints <= {",", ";", ".", "and", "then"}
        led = {singles[-2].relation, self.relation_before(at)} <= _STANDING
        near = self.chunks[at - 1].first == own.last
        return singles[-2] if listed and led and near and settles(singles[-2].mention) else None

    def _goes_there(self, at: int) -> bool:
        """ "the cup belongs on the plate, so put it there", "..., put it in!": not the plate."""
        rest = [token.text for token in self.tokens[self.chunks[at].last :]]
        ends = len(rest) == 1 or (len(rest) > 1 and not rest[1][0].isalnum())
        return rest[:1] == ["there"] or (rest[:1] in (["in"], ["on"], ["inside"]) and ends)


def clear_best(focus: Sequence[Focus]) -> str | None:
    """The most salient object if it is salient enough and clearly ahead of the next."""
    order = sorted(focus, key=lambda one: -one.salience)
    if not order or order[0].salience < FOCUS_FLOOR:
        return None
    if len(order) > 1 and order[0].salience - order[1].salience < FOCUS_MARGIN:
        return None
    return order[0].object
