"""The ladder's rule about roles: it asks for what a command leaves out."""

from __future__ import annotations

from collections.abc import Sequence

from agent.messages import Decision, Option, QuestionKind, Target
from clarifier.ask import MAX_OFFERED, MAX_OPTIONS, examples, labels
from clarifier.candidates import Outcome
from clarifier.deed import link_deed
from clarifier.questions import Questions
from clarifier.refusals import State, base_form
from clarifier.roles import Gap, complete, find_gap
from clarifier.spoken import Linked, Spoken
from clarifier.words import article

PLACES = (
    "in the middle of the table",
    "on the left side of the table",
    "on the right side of the table",
)
"""Destinations that are offered when none was said."""
DIRECTIONS = ("to the left", "to the right", "away from me", "towards me")
"""Directions that are offered when none was said."""
SIDES = ("to the left of", "to the right of", "in front of", "behind")
"""Sides of a thing that are offered when none was said."""
_ROLES = {"where": "destination", "direction": "direction", "angle": "angle", "theme": "thing"}


class Missing(Questions):
    """Asks where to, which way, how far, or what."""

    def role(self, linked: Linked, state: State) -> Decision | None:
        """A verb lacks its destination, direction, angle or theme."""
        gap = find_gap(linked, self._lexicon)
        if gap is not None and gap.role == "theme" and linked.spoken and state.dialog.focus:
            gap = None  # "... and put in the bowl": what was spoken of last
        if gap is None:
            return self._only_named(linked, state)
        if gap.role == "theme":
            return self._ask_theme(linked, gap, state)
        name = _name(gap.theme)
        verb, why = (
            base_form(gap.verb, self._lexicon),
            f"{gap.verb!r} needs {article(_ROLES[gap.role])}",
        )
        if gap.role == "angle":
            return self._ask(linked, state, "open", f"How far should I {verb} {name}?", (), why)
        if gap.lead:
            options = self._beside_what(linked, gap, state)
            text = f"{gap.lead[:1].upper()}{gap.lead[1:]} what should I {verb} {name}?"
            return self._ask(linked, state, "where", text, options, "the sentence breaks off")
        kind: QuestionKind = "where" if gap.role == "where" else "direction"
        options = self._places(linked, gap, _offered(gap), state)
        lead = "Where should I" if kind == "where" else "Which way should I"
        if gap.anchor is not None:
            lead = f"On which side of the {gap.anchor.mention.text} should I"
        text = f"{lead} {verb} {name}{examples(options)}?"
        return self._ask(linked, state, kind, text, options, why)

    def _beside_what(self, linked: Linked, gap: Gap, state: State) -> tuple[Option, ...]:
        """Where the sentence breaks off behind "next to": the other things, if they are few."""
        named = {o for one in linked.spoken for o in one.mention.objects}
        others = [item.id for item in state.scene.objects if item.id not in named]
        if len(others) > MAX_OPTIONS:
            return ()
        names = labels(others, state.scene, self._lexicon)
        return tuple(Option(f"{gap.lead} {label}", (name,)) for name, label in names.items())

    def _only_named(self, linked: Linked, state: State) -> Decision | None:
        """ "the bottle": a thing, and nothing to do with it."""
        if len(linked.spoken) != 1 or linked.spoken[0].phrase is None:
            return None
        first, last = linked.spoken[0].opened, linked.spoken[0].last
        outside = [c for c in linked.chunks if not first <= c.first < last]
        rest = {linked.tokens[i].text for c in outside for i in range(c.first, c.last)}
        light = self._lexicon.words("polite") | {",", ".", "!", "?", "and"}
        if any(c.kind in ("verb", "relation", "place") for c in outside) or not rest <= light:
            return None
        if rest & (self._lexicon.words("directions") | self._lexicon.words("pointing")):
            return None
        text = f"What should I do with the {linked.spoken[0].mention.text}?"
        return self._ask(linked, state, "open", text, (), "a thing was named and nothing else")

    def _ask_theme(self, linked: Linked, gap: Gap, state: State) -> Decision:
        names = labels([item.id for item in state.scene][:MAX_OFFERED], state.scene, self._lexicon)
        options = tuple(Option(label, (name,)) for name, label in names.items())
        text = f"What should I {base_form(gap.verb, self._lexicon)}?"
        return self._ask(linked, state, "which", text, options, f"{gap.verb!r} lacks its object")

    def _places(
        self, linked: Linked, gap: Gap, places: Sequence[str], state: State
    ) -> tuple[Option, ...]:
        """The places of which the completed sentence translates to a program that may run."""
        options = []
        for place in places:
            text = complete(linked.text, gap, place) + linked.caution
            whole = link_deed(text, state.scene, state.dialog.focus, self._lexicon)
            outcome = self._branches.best(whole, state)
            unsure = isinstance(outcome, str) or outcome.unsure
            if isinstance(outcome, Outcome) and outcome.ok and not unsure:
                options.append(_place_option(place, outcome, gap))
            elif unsure and gap.anchor is not None:
                options.append(Option(place))
        return tuple(options)


def _name(theme: Spoken | None) -> str:
    """The thing as the person spoke of it."""
    if theme is None or theme.phrase is None:
        return "it"
    text, det = theme.mention.text, theme.phrase.det
    if theme.phrase.opened == theme.first:
        return text  # "some cups", "everything"
    return f"{det if det in ('a', 'an') else 'the'} {text}"


def _offered(gap: Gap) -> tuple[str, ...]:
    """What is offered for a role that is missing."""
    if gap.anchor is not None:
        return tuple(f"{side} the {gap.anchor.mention.text}" for side in SIDES)
    return PLACES if gap.role == "where" else DIRECTIONS


def _place_option(place: str, outcome: Outcome, gap: Gap) -> Option:
    assert outcome.checked is not None and gap.theme is not None
    # the completed sentence is linked anew: its theme can be a group that is still to be chosen
    themes = outcome.binding.get(gap.theme.mention.slot) or outcome.touched
    after = outcome.checked.after
    item = after.get(themes[0]) if after is not None and themes else None
    target = None if item is None or item.x is None or item.y is None else Target(item.x, item.y)
    return Option(place, (), target, outcome.checked.program, outcome.checked.kind,
                  outcome.touched)  # fmt: skip
