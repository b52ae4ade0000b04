"""What is said of a sentence that is not understood: which part of it, and what to do instead."""

from __future__ import annotations

import re
from itertools import pairwise

import msgspec

from agent.messages import Decision, Option
from agent.report import describe
from clarifier import focus
from clarifier.candidates import NOT_SURE, Outcome
from clarifier.deed import link_deed
from clarifier.missing import SIDES
from clarifier.phrases import phrases_of
from clarifier.pieces import Chunk
from clarifier.questions import Questions
from clarifier.refusals import State, refuse
from clarifier.roles import find_gap
from clarifier.spoken import Linked
from clarifier.words import listing, words

_TIDY = re.compile(
    r"\b(?:tidy|neaten|straighten|clean|clear|organi[sz]e|order)\b(?: (?:up|it|this|things|"
    r"everything|all|the (?:table|mess|place|desk)))*\b|\bmake\b.*\btidy\b|\bmess\b",
    re.IGNORECASE,
)
_SETTLED = frozenset(
    {"left", "right", "front", "behind", "on", "onto", "in", "into", "inside", "top", "above"}
    | {"below", "under", "beneath", "between", "back", "over", "swap", "around"}
)
"""Words that say where about a thing another goes."""
MAX_PHRASES = 6
"""Sentences of more phrases are not tried phrase by phrase."""


class Unclear(Questions):
    """Explains a refusal. Translates phrases to see which are understood; moves nothing."""

    def unclear(self, linked: Linked, why: str, state: State) -> Decision:
        """The refusal of a sentence that was not understood, or a question that helps."""
        text = why
        if why == NOT_SURE:
            which = self.which_side(linked, state)
            if which is not None:
                return which
            text = self._by_phrases(linked, state) or why
        return refuse(state, "not_understood", text, "the translation is not to be trusted")

    def confirm(self, linked: Linked, outcome: Outcome, state: State) -> Decision:
        """Ask whether the likeliest reading is meant, by what it would come to; if nothing is
        likely enough, or can be told, say that the sentence is not understood."""
        checked = outcome.checked
        assert checked is not None
        if (
            outcome.confidence < self._planner.policy.ask
            or checked.after is None
            or checked.after == state.scene
        ):
            return self.unclear(linked, NOT_SURE, state)
        ends = describe(state.scene, checked.after, checked.commands, outcome.touched)
        text = f"I'm not sure that I understood. It would end like this: {ends} Shall I do that?"
        yes = Option("yes", (), None, checked.program, checked.kind, outcome.touched)
        why = f"its likeliest reading has a confidence of {outcome.confidence:.2f} only"
        return self._ask(linked, state, "confirm", text, (yes,), why)

    def which_side(self, linked: Linked, state: State) -> Decision | None:
        """A thing is to be put somewhere about another, and where is not understood: on which side
        of it. None unless the sentence speaks of two things and one deed, and no side is named."""
        if len(linked.spoken) != 2 or len(phrases_of(linked)) > 1:
            return None
        theme, anchor = linked.spoken
        single = all(len(s.mention.objects) == 1 and not s.mention.plural for s in linked.spoken)
        said = {token.text for token in linked.tokens}
        elsewhere = said & (_SETTLED | {"not", "if", "away", "towards", "forward"})
        if not single or theme.verb != "place" or not theme.theme or elsewhere:
            return None
        options = []
        for side in SIDES:
            text = f"put the {theme.mention.text} {side} the {anchor.mention.text}"
            whole = link_deed(text, state.scene, state.dialog.focus, self._lexicon)
            outcome = self._tried(whole, state)
            if outcome is not None and outcome.ok and outcome.checked is not None:
                options.append(Option(f"{side} the {anchor.mention.text}", (), None,
                                      outcome.checked.program, outcome.checked.kind,
                                      outcome.touched))  # fmt: skip
        if len(options) < 2:
            return None
        text = f"On which side of the {anchor.mention.text} should I put the {theme.mention.text}"
        choice = listing((option.label for option in options), "or")
        why = "where it goes about the other is not understood"
        return self._ask(linked, state, "where", f"{text}: {choice}?", tuple(options), why)

    def possible_half(self, linked: Linked, state: State, refused: Decision) -> Decision | None:
        """ "bake a cake and put the apple in the bowl": whether to do what can be done of it."""
        rest = []
        for phrase in phrases_of(linked):
            part = link_deed(phrase, state.scene, state.dialog.focus, self._lexicon)
            if not any(c.kind == "verb" and c.value in ("cannot", "harmful") for c in part.chunks):
                rest.append(part)
        done = [self._tried(part, state) for part in rest]
        if len(rest) != 1 or done[0] is None or not done[0].ok or done[0].checked is None:
            return None
        checked = done[0].checked
        text = f"{refused.reply} Shall I only {rest[0].text.strip(' .!')}?"
        yes = Option("yes", (), None, checked.program, checked.kind, done[0].touched)
        return self._ask(rest[0], state, "confirm", text, (yes,), refused.why)

    def untidy(self, linked: Linked, state: State) -> Decision | None:
        """ "tidy up": how, is for the person to say."""
        named = [s for s in linked.spoken if s.mention.objects]
        whole = all(s.phrase is not None and s.phrase.group == "all" for s in named)
        placed = named and any(chunk.kind in ("relation", "place") for chunk in linked.chunks)
        if placed or not whole or not _TIDY.search(linked.text):
            return None
        text = "How should I tidy up? For example, say what to line up, to stack, or to put where."
        return self._ask(linked, state, "open", text, (), "tidying may end in many ways")

    def unknown_deed(self, linked: Linked, state: State) -> Decision | None:
        """ "frob the bottle": one thing, and words that say nothing known about it."""
        if len(linked.spoken) != 1 or linked.spoken[0].phrase is None:
            return None
        thing = linked.spoken[0]
        rest = [c for c in linked.chunks if not thing.opened <= c.first < thing.last]
        first = linked.tokens[0].text
        said = {linked.tokens[c.first].text for c in rest}
        telling = self._lexicon.words("directions") | self._lexicon.words("pointing")
        if any(c.kind in ("verb", "relation", "place", "measure", "joint") for c in rest):
            return None
        if not rest or rest[0].first or first in self._lexicon.vocabulary or said & telling:
            return None
        text = f"I don't know “{first}”. What should I do with the {thing.mention.text}?"
        return self._ask(linked, state, "open", text, (), f"{first!r} is no known deed")

    def untold_exception(self, linked: Linked, state: State) -> Decision | None:
        """ "All but the dodgy one": which one is left out is not for a program to choose."""
        known = {i for one in linked.spoken for i in range(one.first, one.last)}
        for chunk, after in pairwise(linked.chunks):
            phrase = after.phrase
            if chunk.kind != "except" or phrase is None or known & set(range(*_span(after))):
                continue
            if phrase.det in ("the", "that", "this", "my") and phrase.modifiers:
                said = linked.text[linked.tokens[after.first].start : _ends(after, linked)]
                text = f"I can't tell what is to be left out: “{said}”. Please name it."
                return refuse(state, "not_understood", text, f"{said!r} is nothing that is seen")
        return None

    def unseen_quality(self, linked: Linked, state: State) -> Decision | None:
        """ "the heaviest on top": no scene tells which one that is."""
        named = {word for item in state.scene for word in words(item.name)}
        for token in linked.tokens:
            if token.text not in named and self._superlative(token.text, linked):
                text = (
                    f"I can't tell what is “{token.text}” here: I see sizes, colours and places."
                    " Please name the things themselves."
                )
                return refuse(state, "not_understood", text, f"{token.text!r} is not to be seen")
        return None

    def _superlative(self, word: str, linked: Linked) -> bool:
        """Whether a word compares by what is not to be seen: "lightest", "most valuable"."""
        unseen = self._lexicon.words("unseen")
        if word in unseen:
            before = [one.text for one, two in pairwise(linked.tokens) if two.text == word]
            return any(text in ("most", "least", "more", "less") for text in before)
        for end in ("est", "er"):
            stem = word.removesuffix(end)
            forms = {stem, f"{stem}e", stem[:-1], f"{stem.removesuffix('i')}y"}
            if stem != word and forms & unseen:
                return True
        return False

    def _by_phrases(self, linked: Linked, state: State) -> str | None:
        """Which of several phrases is understood, and which is not."""
        phrases = phrases_of(linked)
        if not 1 < len(phrases) <= MAX_PHRASES:
            return None
        good, bad, now = list[str](), list[str](), state
        for phrase in phrases:
            part = link_deed(phrase, now.scene, now.dialog.focus, self._lexicon)
            outcome = None if find_gap(part, self._lexicon) else self._tried(part, now)
            (bad if outcome is None else good).append(f"“{phrase}”")
            seen = focus.after(now.dialog.focus, part)
            dialog = msgspec.structs.replace(now.dialog, focus=seen)
            after = outcome.checked.after if outcome is not None and outcome.checked else None
            now = State(after or now.scene, dialog, now.task)
        if not bad:
            return f"I understand {listing(good)}, but not all of it at once. Please say one after \
the other."
        again = "Could you say that part another way?"
        if good:
            return f"I understand {listing(good)}, but not {listing(bad, 'or')}. {again}"
        return f"I don't understand {listing(bad, 'or')}. Could you say it another way?"

    def _tried(self, part: Linked, state: State) -> Outcome | None:
        """What a phrase alone comes to; None if it is not understood."""
        if not part.spoken or any(not one.mention.objects for one in part.spoken):
            return None
        outcome = self._branches.best(part, state)
        if isinstance(outcome, str) or outcome.checked is None or outcome.unsure:
            return None
        return outcome


def _span(chunk: Chunk) -> tuple[int, int]:
    return chunk.first, chunk.last


def _ends(chunk: Chunk, linked: Linked) -> int:
    return linked.tokens[chunk.last - 1].end
