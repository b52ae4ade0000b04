"""The decision ladder for a command: each rule is one method, the first that decides wins.

A rule returns a Decision or None. Rules before the translation count referents and empty roles on
the live scene (structure before probability); the last one translates, checks and acts.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import replace

import msgspec

from agent.messages import (
    Decision,
    Dialog,
    Option,
    Pending,
    Problem,
    Question,
    QuestionKind,
    Target,
)
from clarifier import focus
from clarifier.ask import (
    MAX_OFFERED,
    MAX_OPTIONS,
    alike,
    examples,
    labels,
    many,
    there_is,
    which_text,
)
from clarifier.branches import Branches
from clarifier.candidates import Outcome, Planner, near_first
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.refusals import (
    State,
    base_form,
    beyond_me,
    nothing_said,
    off_the_table,
    refuse,
    refuse_problem,
)
from clarifier.rewrite import exception_beside, spelled_out
from clarifier.roles import Gap, complete, find_gap
from clarifier.spoken import Linked, Spoken, ambiguous, without_asides
from clarifier.words import article, listing, number_word, singular

MAX_QUESTIONS = 4
"""Questions about one command; then the clarifier gives up."""
PLACES = (
    "in the middle of the table",
    "on the left side of the table",
    "on the right side of the table",
)
"""Destinations that are offered when none was said."""
DIRECTIONS = ("to the left", "to the right", "away from me", "towards me")
"""Directions that are offered when none was said."""


_ROLES = {"where": "destination", "direction": "direction", "angle": "angle", "theme": "thing"}


class Ladder:
    """Decides on a command. Pure but for the planner's translation and checks."""

    def __init__(self, planner: Planner, lexicon: Lexicon) -> None:
        self._planner = planner
        self._lexicon = lexicon
        self._branches = Branches(planner, lexicon)

    def decide(self, text: str, state: State) -> Decision:
        """The decision on a command, a question of its own included."""
        linked = self._link(text, state)
        rules: tuple[Callable[[Linked, State], Decision | None], ...] = (
            self.absent, self.how_many, self.which, self.role
        )  # fmt: skip
        for refusal in (beyond_me, off_the_table, nothing_said):
            refused = refusal(linked, state, self._lexicon)
            if refused is not None:
                return refused
        for rule in rules:
            decision = rule(linked, state)
            if decision is not None:
                return decision
        return self.act(linked, state)

    def _link(self, text: str, state: State) -> Linked:
        """The sentence's mentions; what a group leaves out is read beside it."""
        linked = link(text, state.scene, state.dialog.focus, self._lexicon)
        beside = exception_beside(linked)
        if beside is not None:
            linked = link(beside, state.scene, state.dialog.focus, self._lexicon)
        return without_asides(linked)

    # --- referents ------------------------------------------------------------

    def absent(self, linked: Linked, state: State) -> Decision | None:
        """A phrase denotes nothing here: say so and offer what there is."""
        spoken = next((s for s in linked.spoken if not s.mention.objects), None)
        if spoken is None:
            return None
        if not any(True for _ in state.scene):
            return refuse(state, "missing_object", "The table is empty.", "there are no objects")
        pool, kind, text = self._offer(spoken, linked, state)
        why = f"nothing on the scene is {spoken.mention.text!r}"
        options = self._branches.options(linked, spoken, [(one,) for one in pool], state)[0]
        return self._ask(linked, state, kind, text, options, why)

    def _offer(
        self, spoken: Spoken, linked: Linked, state: State
    ) -> tuple[tuple[str, ...], QuestionKind, str]:
        """What to offer for an absent thing: those of its type, its kin, or everything."""
        used = {o for s in linked.spoken for o in s.mention.objects if len(s.mention.objects) == 1}
        rest = tuple(item.id for item in state.scene if item.id not in used)
        if spoken.phrase is None:
            there = there_is(state.scene, self._lexicon, tuple(used))
            return rest, "which", f"What do you mean by “{spoken.mention.text}”? There {there}."
        noun = " ".join((*spoken.phrase.modifiers, *spoken.phrase.head)) or spoken.mention.text
        noun = spoken.mention.text.lower() if not spoken.phrase.plural else noun
        said = article(noun) if not spoken.phrase.plural else f"any {noun}"
        typed = tuple(o for o in spoken.same_type if o not in used)
        names = list(labels(typed, state.scene, self._lexicon).values())
        if typed and spoken.phrase.head and len(typed) < len(rest):
            text = f"I can't see {said}. Did you mean {listing(names, 'or')}?"
            return typed, "missing", text
        kin = alike(" ".join(spoken.phrase.head), rest, state.scene, self._lexicon)
        if kin:
            names = list(labels(kin, state.scene, self._lexicon).values())
            return kin, "missing", f"I can't see {said}. Did you mean {listing(names, 'or')}?"
        there = there_is(state.scene, self._lexicon, tuple(used))
        if not spoken.phrase.head:
            return rest, "missing", f"I see nothing that is meant by “{noun}”. There {there}."
        if not spoken.phrase.known:
            word = singular(spoken.phrase.head[-1])
            return rest, "unknown_word", f"I don't know the word “{word}”. There {there}."
        return rest, "missing", f"I can't see {said}. There {there}."

    def how_many(self, linked: Linked, state: State) -> Decision | None:
        """More asked for than there are, or "a few"."""
        for spoken in linked.spoken:
            found = spoken.mention.objects
            if spoken.phrase is not None and spoken.phrase.vague and len(found) > 1:
                return self._ask_count(linked, spoken, state)
            if spoken.phrase is None or spoken.count <= len(found):
                continue
            noun = _noun(spoken, "thing")
            options = self._branches.options(linked, spoken, [found], state)[0]
            few = number_word(len(found))
            one = len(found) == 1
            noun = singular(noun) if one else many(singular(noun))
            text = f"I can see only {few} {noun}. Shall I take {'it' if one else few}?"
            why = f"{number_word(spoken.count)} asked, {few} there"
            return self._ask(linked, state, "how_many", text, options, why)
        return None

    def _ask_count(self, linked: Linked, spoken: Spoken, state: State) -> Decision:
        near = near_first(spoken.mention.objects, state.scene)
        counts = range(min(2, len(near) - 1), len(near) + 1)
        options = self._branches.options(linked, spoken, [tuple(near[:n]) for n in counts], state)[
            0
        ]
        options = tuple(
            msgspec.structs.replace(option, label=number_word(len(option.objects)))
            for option in options
        )
        noun = many(singular(_noun(spoken, "thing")))
        names = [option.label for option in options][:MAX_OPTIONS]
        text = f"How many {noun} should I take: {listing(names, 'or')}?"
        return self._ask(linked, state, "how_many", text, options,
                         f"{spoken.mention.text!r} is no number")  # fmt: skip

    def which(self, linked: Linked, state: State) -> Decision | None:
        """Several things fit a singular definite phrase: ask, offering only what can be done."""
        spoken = next((s for s in linked.spoken if ambiguous(s)), None)
        if spoken is None:
            return None
        objects = spoken.mention.objects
        some = spoken.count if spoken.mention.plural else 1
        pool = list(itertools.islice(itertools.combinations(objects, some), MAX_OFFERED + 1))
        if some > 1 and len(pool) > MAX_OFFERED:
            there = there_is(state.scene, self._lexicon, ())
            text = f"Which {number_word(some)} do you mean? There {there}."
            why = f"{spoken.mention.text!r} may be any {some} of {len(objects)} things"
            return self._ask(linked, state, "which", text, (), why)
        options, failed = self._branches.options(linked, spoken, pool, state)
        why = f"{spoken.mention.text!r} may be any of {len(pool)}"
        if not options and failed:
            return refuse_problem(state, failed[0], why)
        only_reachable = all(problem.reason == "unreachable" for problem in failed)
        if len(options) == 1 and options[0].program and only_reachable:
            return self._take_only(linked, options[0], state, why, bool(failed))
        names = [option.label for option in options]
        noun = "one" if spoken.phrase is None else _noun(spoken, "one")
        noun = noun if some == 1 else f"{number_word(some)} {many(singular(noun))}"
        text = which_text(noun, names)
        if len(options) == 1:
            text = f"{failed[0].text} Do you mean {names[0]}?"
        kind: QuestionKind = "confirm" if len(options) == 1 else "which"
        return self._ask(linked, state, kind, text, options, why)

    def _take_only(
        self, linked: Linked, option: Option, state: State, why: str, unreachable: bool
    ) -> Decision:
        """Only one of several can be meant: the others are out of reach, or already have another
        part in the sentence. Take it, and say so."""
        assert option.program is not None and option.kind is not None
        said = f"I took {option.label}{': nothing else is in reach' * unreachable}."
        new = msgspec.structs.replace(
            state.dialog, focus=focus.on(state.dialog.focus, option.objects, option.touched),
            pending=None, last_text=spelled_out(linked, state.scene, self._lexicon),
            questions_asked=0,
        )  # fmt: skip
        return Decision(
            "act", f"{why}; only one can be meant", new, program=option.program,
            kind=option.kind, touched=option.touched, echo=f"{state.echo} {said}".strip(),
            ms_translate=self._planner.ms,
        )  # fmt: skip

    # --- roles ------------------------------------------------------------

    def role(self, linked: Linked, state: State) -> Decision | None:
        """A verb lacks its destination, direction, angle or theme."""
        gap = find_gap(linked, self._lexicon)
        if gap is None:
            return self._only_named(linked, state)
        if gap.role == "theme":
            return self._ask_theme(linked, gap, state)
        name = f"the {gap.theme.mention.text}" if gap.theme and gap.theme.phrase else "it"
        if gap.theme is not None and gap.theme.phrase and gap.theme.phrase.det in ("a", "an"):
            name = f"{gap.theme.phrase.det} {gap.theme.mention.text}"
        verb, why = (
            base_form(gap.verb, self._lexicon),
            f"{gap.verb!r} needs {article(_ROLES[gap.role])}",
        )
        if gap.role == "angle":
            return self._ask(linked, state, "open", f"How far should I {verb} {name}?", (), why)
        places = PLACES if gap.role == "where" else DIRECTIONS
        options = self._places(linked, gap, places, state)
        kind: QuestionKind = "where" if gap.role == "where" else "direction"
        lead = "Where should I" if kind == "where" else "Which way should I"
        text = f"{lead} {verb} {name}{examples(options)}?"
        return self._ask(linked, state, kind, text, options, why)

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
            whole = link(
                complete(linked.text, gap, place), state.scene, state.dialog.focus, self._lexicon
            )
            outcome = self._branches.best(whole, state)
            if isinstance(outcome, Outcome) and outcome.ok:
                options.append(_place_option(place, outcome, gap))
        return tuple(options)

    # --- candidates ------------------------------------------------------------

    def act(self, linked: Linked, state: State) -> Decision:
        """Translate, check every binding, run the first that may run; else say why not."""
        outcome = self._branches.best(linked, state)
        if isinstance(outcome, str):
            return refuse(state, "not_understood", outcome, "the translation is not to be trusted")
        if outcome.problem is not None or outcome.checked is None:
            problem = outcome.problem or Problem("not_understood", "I did not understand that.")
            return refuse_problem(state, problem, "the check refused the program")
        new = msgspec.structs.replace(
            state.dialog, focus=focus.after(state.dialog.focus, _bound(linked, outcome)),
            pending=None, last_text=spelled_out(linked, state.scene, self._lexicon),
            questions_asked=0,
        )  # fmt: skip
        echo = " ".join(part for part in (state.echo, self._taken(linked, outcome, state)) if part)
        return Decision(
            "act", "every mention is settled and the program passed the check", new,
            program=outcome.checked.program, kind=outcome.checked.kind,
            touched=outcome.touched, confidence=outcome.confidence, echo=echo,
            ms_translate=self._planner.ms,
        )  # fmt: skip

    def _taken(self, linked: Linked, outcome: Outcome, state: State) -> str:
        """Says which ones were taken where the focus settled it or any would do."""
        broken = [s for s in linked.spoken if s.tie_broken]
        chosen = [s for s in linked.spoken if s.mention.plural and s.mention.free
                  and len(outcome.binding[s.mention.slot]) < len(s.mention.objects)]  # fmt: skip
        if chosen:
            taken = outcome.binding[chosen[0].mention.slot]
            names = labels(taken, state.scene, self._lexicon)
            return f"I took {listing(names.values())}."
        if not broken:
            return ""
        name = labels(broken[0].same_type, state.scene, self._lexicon)
        label = name.get(broken[0].mention.objects[0], broken[0].mention.text)
        return f"I took {label}, which we just spoke of."

    # --- asking ------------------------------------------------------------

    def _ask(
        self, linked: Linked, state: State, kind: QuestionKind, text: str,
        options: tuple[Option, ...], why: str,
    ) -> Decision:  # fmt: skip
        """The decision to ask; after too many questions about one command, to give up."""
        if state.questions >= MAX_QUESTIONS:
            reply = "I have asked enough about this one. Please say it again in other words."
            return refuse(state, "not_understood", reply, "too many questions about one command")
        question = Question(kind, text, options)
        named = [object_id for option in options for object_id in option.objects]
        new = Dialog(
            focus.after(state.dialog.focus, linked, named), Pending(linked.text, question),
            state.dialog.last_text, state.questions + 1,
        )  # fmt: skip
        return Decision(
            "ask", why, new, reply=f"{state.echo} {text}".strip(), question=question,
            ms_translate=self._planner.ms, echo=state.echo,
        )  # fmt: skip


def _bound(linked: Linked, outcome: Outcome) -> Linked:
    """The linked sentence with every mention bound to the objects that were taken."""
    spoken = tuple(
        _with_objects(one, outcome.binding.get(one.mention.slot, ())) for one in linked.spoken
    )
    return Linked(linked.text, linked.tokens, linked.chunks, spoken)


def _with_objects(spoken: Spoken, objects: tuple[str, ...]) -> Spoken:
    return replace(spoken, mention=msgspec.structs.replace(spoken.mention, objects=objects))


def _place_option(place: str, outcome: Outcome, gap: Gap) -> Option:
    assert outcome.checked is not None and gap.theme is not None
    theme = outcome.binding[gap.theme.mention.slot][0]
    after = outcome.checked.after
    item = after.get(theme) if after is not None else None
    target = None if item is None or item.x is None or item.y is None else Target(item.x, item.y)
    return Option(place, (), target, outcome.checked.program, outcome.checked.kind,
                  outcome.touched)  # fmt: skip


def _noun(spoken: Spoken, otherwise: str) -> str:
    return " ".join(spoken.phrase.head if spoken.phrase is not None else ()) or otherwise
