"""The decision ladder for a command: each rule is one method, the first that decides wins.

A rule returns a Decision or None. Rules before the translation count referents and empty roles on
the live scene (structure before probability); the last one translates, checks and acts.
"""

from __future__ import annotations

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
from clarifier.ask import MAX_OFFERED, alike, examples, labels, many, there_is, which_text
from clarifier.candidates import Outcome, Planner, Reading, bindings, doubt, kind_of
from clarifier.lexicon import Lexicon
from clarifier.measures import measures_of
from clarifier.mentions import Linked, Spoken, ambiguous, link
from clarifier.refusals import (
    State,
    base_form,
    beyond_me,
    negated,
    nothing_said,
    off_the_table,
    refuse,
    refuse_problem,
)
from clarifier.rewrite import spelled_out
from clarifier.roles import Gap, complete, find_gap
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


_WEIGHTY = frozenset({"again", "if", "some", "next", "first", "finally", "also", "afterwards"})
"""Polite or joining words that can still change what is to be done."""


class Ladder:
    """Decides on a command. Pure but for the planner's translation and checks."""

    def __init__(self, planner: Planner, lexicon: Lexicon) -> None:
        self._planner = planner
        self._lexicon = lexicon

    def decide(self, text: str, state: State) -> Decision:
        """The decision on a command, a question of its own included."""
        linked = link(text, state.scene, state.dialog.focus, self._lexicon)
        rules: tuple[Callable[[Linked, State], Decision | None], ...] = (
            self.absent, self.how_many, self.groups, self.which, self.role
        )  # fmt: skip
        for refusal in (negated, beyond_me, off_the_table, nothing_said):
            refused = refusal(linked, state, self._lexicon)
            if refused is not None:
                return refused
        for rule in rules:
            decision = rule(linked, state)
            if decision is not None:
                return decision
        return self.act(linked, state)

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
        options = self._options(linked, spoken, pool, state)[0]
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
        noun = spoken.mention.text.lower()
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
        if not spoken.phrase.known:
            word = singular(spoken.phrase.head[-1])
            return rest, "unknown_word", f"I don't know the word “{word}”. There {there}."
        return rest, "missing", f"I can't see {said}. There {there}."

    def how_many(self, linked: Linked, state: State) -> Decision | None:
        """More asked for than there are."""
        for spoken in linked.spoken:
            phrase, found = spoken.phrase, spoken.mention.objects
            count = phrase.count if phrase is not None else None
            if phrase is not None and phrase.det == "both" and count is None:
                count = 2.0
            if count is None or count <= len(found):
                continue
            noun = singular(spoken.mention.text.split()[-1])
            options, _ = self._options(linked, spoken, found, state)
            few = number_word(len(found))
            noun = noun if len(found) == 1 else many(noun)
            text = f"I can see only {few} {noun}. Shall I take {'it' if len(found) == 1 else few}?"
            options = options if len(found) == 1 else ()
            why = f"{number_word(int(count))} asked, {few} there"
            return self._ask(linked, state, "how_many", text, options, why)
        return None

    def groups(self, linked: Linked, state: State) -> Decision | None:
        """Several things at once: understood, but today's translator handles single things."""
        spoken = next(
            (s for s in linked.spoken if s.mention.plural and len(s.mention.objects) > 1), None
        )
        if spoken is None:
            return None
        text = f"I can only handle one thing at a time so far, not “{spoken.mention.text}”."
        text += " Please name them one by one."
        return refuse(state, "not_understood", text, "the sentence speaks of a group")

    def which(self, linked: Linked, state: State) -> Decision | None:
        """Several things fit a singular definite phrase: ask, offering only what can be done."""
        spoken = next((s for s in linked.spoken if ambiguous(s)), None)
        if spoken is None:
            return None
        objects = spoken.mention.objects
        options, failed = self._options(linked, spoken, objects, state)
        why = f"{spoken.mention.text!r} may be any of {len(objects)} things"
        if not options and failed:
            return refuse_problem(state, failed[0], why)
        only_reachable = all(problem.reason == "unreachable" for problem in failed)
        if len(options) == 1 and options[0].program and only_reachable:
            return self._take_only(linked, options[0], state, why, bool(failed))
        names = [option.label for option in options]
        noun = "one" if spoken.phrase is None else _noun(spoken)
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
        more = ("verb", "relation", "place")
        behind = linked.spoken[0].last if linked.spoken else 0
        doing = any(c.kind == "verb" or (c.kind in more and c.first >= behind)
                    for c in linked.chunks)  # fmt: skip
        if len(linked.spoken) != 1 or doing:
            return None
        first, last = linked.spoken[0].first, linked.spoken[0].last
        rest = {t.text for t in (*linked.tokens[:first], *linked.tokens[last:])}
        if rest & self._lexicon.words("directions") or linked.spoken[0].phrase is None:
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
            outcome = self._best(whole, state)
            if isinstance(outcome, Outcome) and outcome.ok:
                options.append(_place_option(place, outcome, gap))
        return tuple(options)

    # --- candidates ------------------------------------------------------------

    def act(self, linked: Linked, state: State) -> Decision:
        """Translate, check every binding, run the first that may run; else say why not."""
        outcome = self._best(linked, state)
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
        echo = " ".join(part for part in (state.echo, self._taken(linked, state)) if part)
        return Decision(
            "act", "every mention is settled and the program passed the check", new,
            program=outcome.checked.program, kind=outcome.checked.kind,
            touched=tuple(outcome.binding.values()), confidence=outcome.confidence, echo=echo,
            ms_translate=self._planner.ms,
        )  # fmt: skip

    def _taken(self, linked: Linked, state: State) -> str:
        """Says which one was taken where the focus settled it."""
        broken = [s for s in linked.spoken if s.tie_broken]
        if not broken:
            return ""
        name = labels(broken[0].same_type, state.scene, self._lexicon)
        label = name.get(broken[0].mention.objects[0], broken[0].mention.text)
        return f"I took {label}, which we just spoke of."

    def _best(self, linked: Linked, state: State) -> Outcome | str:
        """The first binding that may run, else the first that may not; a str says the reading is
        not to be trusted."""
        reading = self._read(linked, state)
        why = doubt(reading, self._unimportant())
        if why is not None:
            return why
        outcomes = (
            self._planner.outcome(reading, binding, state.scene)
            for binding in bindings(linked, state.scene, {})
        )
        first: Outcome | None = None
        for outcome in outcomes:
            if outcome.ok:
                return outcome
            first = first or outcome
        return first or "I can't use one thing for both. Please name two different things."

    def _read(self, linked: Linked, state: State) -> Reading:
        kind = kind_of(linked, state.scene, state.task)
        return self._planner.read(linked, kind, measures_of(linked, state.scene))

    def _unimportant(self) -> frozenset[str]:
        """Words that a translation may leave out without harm."""
        words = self._lexicon.words("polite") - self._lexicon.words("directions")
        return words - self._lexicon.words("pointing") - _WEIGHTY

    def _options(
        self, linked: Linked, spoken: Spoken, pool: Sequence[str], state: State
    ) -> tuple[tuple[Option, ...], list[Problem]]:
        """The pool as options, each with its program where the sentence works with it, and why
        others were dropped. Without a trustworthy translation all are offered, without programs."""
        names = labels(pool, state.scene, self._lexicon)
        bare = tuple(Option(names[o], (o,)) for o in pool[:MAX_OFFERED])
        others = [s for s in linked.spoken if s.mention.slot != spoken.mention.slot]
        if any(ambiguous(s) or not s.mention.objects or s.mention.plural for s in others):
            return bare, []
        if find_gap(linked, self._lexicon) is not None or spoken.mention.plural:
            return bare, []
        reading = self._read(linked, state)
        if doubt(reading, self._unimportant()) is not None:
            return bare, []
        options, failed = self._executable(reading, spoken, pool, names, state)
        return (options, failed) if options or failed else (bare, [])

    def _executable(
        self, reading: Reading, spoken: Spoken, pool: Sequence[str], names: dict[str, str],
        state: State,
    ) -> tuple[tuple[Option, ...], list[Problem]]:  # fmt: skip
        options: list[Option] = []
        failed: list[Problem] = []
        for object_id in pool:
            chosen = {spoken.mention.slot: object_id}
            every = bindings(reading.linked, state.scene, chosen)
            tried = [self._planner.outcome(reading, binding, state.scene) for binding in every]
            good = next((outcome for outcome in tried if outcome.ok), None)
            if good is not None and good.checked is not None:
                touched = tuple(good.binding.values())
                checked = good.checked
                options.append(Option(names[object_id], (object_id,), None, checked.program,
                                      checked.kind, touched))  # fmt: skip
            elif tried and tried[0].problem is not None:
                failed.append(tried[0].problem)
        return tuple(options[:MAX_OFFERED]), failed

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
    """The linked sentence with every mention bound to the object that was taken."""
    spoken = tuple(
        _with_object(one, outcome.binding.get(one.mention.slot, "")) for one in linked.spoken
    )
    return Linked(linked.text, linked.tokens, linked.chunks, spoken)


def _with_object(spoken: Spoken, object_id: str) -> Spoken:
    return replace(spoken, mention=msgspec.structs.replace(spoken.mention, objects=(object_id,)))


def _place_option(place: str, outcome: Outcome, gap: Gap) -> Option:
    assert outcome.checked is not None and gap.theme is not None
    theme = outcome.binding[gap.theme.mention.slot]
    after = outcome.checked.after
    item = after.get(theme) if after is not None else None
    target = None if item is None or item.x is None or item.y is None else Target(item.x, item.y)
    touched = tuple(outcome.binding.values())
    return Option(place, (), target, outcome.checked.program, outcome.checked.kind, touched)


def _noun(spoken: Spoken) -> str:
    assert spoken.phrase is not None
    return " ".join(spoken.phrase.head) or "one"
