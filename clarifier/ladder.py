"""The decision ladder for a command: each rule is one method, the first that decides wins.

A rule returns a Decision or None. Rules before the translation count referents and empty roles on
the live scene (structure before probability); the last one translates, checks and acts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import msgspec

from agent.messages import (
    Decision,
    Dialog,
    Kind,
    Option,
    Pending,
    Problem,
    Question,
    QuestionKind,
    Reason,
    Target,
)
from clarifier import focus
from clarifier.ask import MAX_OFFERED, inventory, labels, many, which_text
from clarifier.candidates import Outcome, Planner, Reading, bindings, doubt, kind_of
from clarifier.lexicon import Lexicon
from clarifier.measures import measures_of
from clarifier.mentions import Linked, Spoken, link
from clarifier.roles import Gap, complete, find_gap
from clarifier.things import thing_of
from clarifier.words import article, listing, number_word, singular
from scene.types import Scene

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
NEGATIONS = frozenset(
    {"don't", "not", "never", "without", "except", "dont", "avoid", "unless", "nor", "doesn't"}
)
"""Words that turn a sentence round; not understood so far, so never acted on."""
_SETTLED_PLACES = ("off the table", "off the edge", "over the edge", "onto the floor",
                   "on the floor", "to the floor", "on the ground", "off the desk",
                   "outside the table", "beside the table", "under the table",
                   "off of the table")  # fmt: skip

Refusal = tuple[Reason, str]


@dataclass(frozen=True)
class State:
    """The turn so far: live scene, conversation, task asked for, and what to say first."""

    scene: Scene
    dialog: Dialog
    task: Kind | None = None
    echo: str = ""
    questions: int = 0


class Ladder:
    """Decides on a command. Pure but for the planner's translation and checks."""

    def __init__(self, planner: Planner, lexicon: Lexicon) -> None:
        self._planner = planner
        self._lexicon = lexicon

    def decide(self, text: str, state: State) -> Decision:
        """The decision on a command, a question of its own included."""
        linked = link(text, state.scene, state.dialog.focus, self._lexicon)
        rules: tuple[Callable[[Linked, State], Decision | None], ...] = (
            self.negated, self.beyond_me, self.off_the_table, self.nothing_said, self.absent,
            self.how_many, self.groups, self.which, self.role,
        )  # fmt: skip
        for rule in rules:
            decision = rule(linked, state)
            if decision is not None:
                return decision
        return self.act(linked, state)

    # --- what is refused before anything else ------------------------------------------------

    def negated(self, linked: Linked, state: State) -> Decision | None:
        """ "push the cup but not the plate": must not be done as if "not" had not been said."""
        word = next((t.text for t in linked.tokens if t.text in NEGATIONS), None)
        if word is None:
            return None
        text = f"I don't follow “{word}” yet. Please say only what I should do."
        return refuse(state, "not_understood", text, f"the sentence is negated by {word!r}")

    def beyond_me(self, linked: Linked, state: State) -> Decision | None:
        """Verbs for what an arm must not do, or cannot."""
        for chunk in linked.chunks:
            word = linked.tokens[chunk.first].text
            if chunk.kind == "verb" and chunk.value == "harmful":
                text = f"I won't {_base(word, self._lexicon)} things: that is not safe."
                text += " I can push something or put it somewhere."
                return refuse(state, "unsafe", text, f"{word!r} does harm")
            if chunk.kind == "verb" and chunk.value == "cannot":
                text = f"I can't {_base(word, self._lexicon)} anything: I can only pick up, put,"
                text += " push and touch things on the table."
                return refuse(state, "not_understood", text, f"{word!r} is beyond the arm")
        return None

    def off_the_table(self, linked: Linked, state: State) -> Decision | None:
        """Off the table is no place to put a thing; pushing it off is another matter."""
        said = " ".join(token.text for token in linked.tokens)
        placed = [s for s in linked.spoken if s.theme and s.verb == "place"]
        if not placed or not any(place in said for place in _SETTLED_PLACES):
            return None
        if any(s.verb in ("push", "topple") for s in linked.spoken):
            return None
        name = placed[0].mention.text
        text = f"I won't put the {name} off the table. I can push it over an edge if you want that."
        return refuse(state, "unsafe", text, "the destination is off the table")

    def nothing_said(self, linked: Linked, state: State) -> Decision | None:
        """No thing and no verb that is known, or an unknown verb about unknown things."""
        verbs = [chunk for chunk in linked.chunks if chunk.kind == "verb"]
        known = any(s.mention.objects for s in linked.spoken)
        if verbs or known or (linked.spoken and linked.spoken[0].first <= 1):
            return None
        text = "I did not understand that. Tell me to put, push, pick up or touch something."
        return refuse(state, "not_understood", text, "no known verb and nothing on the scene")

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
            text = f"What do you mean by “{spoken.mention.text}”? There {self._there(state, used)}."
            return rest, "which", text
        noun = spoken.mention.text.lower()
        said = article(noun) if not spoken.phrase.plural else f"any {noun}"
        typed = tuple(o for o in spoken.same_type if o not in used)
        names = list(labels(typed, state.scene, self._lexicon).values())
        if typed and spoken.phrase.head and len(typed) < len(rest):
            text = f"I can't see {said}. Did you mean {listing(names, 'or')}?"
            return typed, "missing", text
        kin = self._kin(spoken, rest, state)
        if kin:
            names = list(labels(kin, state.scene, self._lexicon).values())
            return kin, "missing", f"I can't see {said}. Did you mean {listing(names, 'or')}?"
        there = self._there(state, used)
        if not spoken.phrase.known:
            word = singular(spoken.phrase.head[-1])
            return rest, "unknown_word", f"I don't know the word “{word}”. There {there}."
        return rest, "missing", f"I can't see {said}. There {there}."

    def _kin(self, spoken: Spoken, rest: Sequence[str], state: State) -> tuple[str, ...]:
        """Things much like what was said: offered, never taken."""
        assert spoken.phrase is not None
        words = " ".join(spoken.phrase.head)
        alike = self._lexicon.alike(singular(words)) | self._lexicon.alike(words)
        things = [thing_of(state.scene.get(object_id), self._lexicon) for object_id in rest]
        return tuple(t.id for t in things if t.head in alike or " ".join(t.name) in alike)

    def _there(self, state: State, used: set[str]) -> str:
        seen = inventory(state.scene, self._lexicon, tuple(used))
        plain = seen or "nothing else"
        one = (
            " and " not in plain and "," not in plain and plain.startswith(("a ", "an ", "nothing"))
        )
        return f"{'is' if one else 'are'} {plain}"

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
        if len(options) == 1 and failed and options[0].program and only_reachable:
            return self._take_only(linked, options[0], state, why)
        names = [option.label for option in options]
        noun = "one" if spoken.phrase is None else _noun(spoken)
        text = which_text(noun, names)
        if len(options) == 1:
            text = f"{failed[0].text} Do you mean {names[0]}?"
        kind: QuestionKind = "confirm" if len(options) == 1 else "which"
        return self._ask(linked, state, kind, text, options, why)

    def _take_only(self, linked: Linked, option: Option, state: State, why: str) -> Decision:
        """Only one of several can be reached: take it, and say so."""
        assert option.program is not None and option.kind is not None
        said = f"I took {option.label}: the other is out of reach."
        new = msgspec.structs.replace(
            state.dialog, focus=focus.after(state.dialog.focus, linked), pending=None,
            last_text=linked.text, questions_asked=0,
        )  # fmt: skip
        return Decision(
            "act", f"{why}; only one can be reached", new, program=option.program,
            kind=option.kind, touched=option.touched, echo=f"{state.echo} {said}".strip(),
            ms_translate=self._planner.ms,
        )  # fmt: skip

    # --- roles ------------------------------------------------------------

    def role(self, linked: Linked, state: State) -> Decision | None:
        """A verb lacks its destination, direction, angle or theme."""
        gap = find_gap(linked, self._lexicon)
        if gap is None:
            return None
        if gap.role == "theme":
            return self._ask_theme(linked, gap, state)
        name = f"the {gap.theme.mention.text}" if gap.theme and gap.theme.phrase else "it"
        if gap.theme is not None and gap.theme.phrase and gap.theme.phrase.det in ("a", "an"):
            name = f"{gap.theme.phrase.det} {gap.theme.mention.text}"
        verb, why = _base(gap.verb, self._lexicon), f"{gap.verb!r} needs a {gap.role}"
        if gap.role == "angle":
            return self._ask(linked, state, "open", f"How far should I {verb} {name}?", (), why)
        places = PLACES if gap.role == "where" else DIRECTIONS
        options = self._places(linked, gap, places, state)
        kind: QuestionKind = "where" if gap.role == "where" else "direction"
        lead = "Where should I" if kind == "where" else "Which way should I"
        text = f"{lead} {verb} {name}{_examples(options)}?"
        return self._ask(linked, state, kind, text, options, why)

    def _ask_theme(self, linked: Linked, gap: Gap, state: State) -> Decision:
        names = labels([item.id for item in state.scene][:MAX_OFFERED], state.scene, self._lexicon)
        options = tuple(Option(label, (name,)) for name, label in names.items())
        text = f"What should I {_base(gap.verb, self._lexicon)}?"
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
            pending=None, last_text=linked.text, questions_asked=0,
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
        return words - self._lexicon.words("pointing") - {"again"}

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
        return self._executable(reading, spoken, pool, names, state)

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


def ambiguous(spoken: Spoken) -> bool:
    """Whether a singular definite phrase fits several things."""
    mention = spoken.mention
    return len(mention.objects) > 1 and not mention.free and not mention.plural


def refuse(state: State, reason: Reason, text: str, why: str) -> Decision:
    """Nothing moves, nothing waits for an answer."""
    dialog = msgspec.structs.replace(state.dialog, pending=None, questions_asked=0)
    reply = f"{state.echo} {text}".strip()
    return Decision("refuse", why, dialog, reply=reply, reason=reason, echo=state.echo)


def refuse_problem(state: State, problem: Problem, why: str) -> Decision:
    """A refusal with the check's own reason."""
    text = problem.text[:1].upper() + problem.text[1:]
    lead: dict[Literal["unsafe", "unreachable", "impossible"], str] = {
        "unsafe": "I won't do that: ", "unreachable": "I can't reach that: ",
        "impossible": "That can't be done: ",
    }  # fmt: skip
    start = next((said for reason, said in lead.items() if reason == problem.reason), "")
    body = problem.text.rstrip(".") if start else text.rstrip(".")
    return refuse(state, problem.reason, f"{start}{body}.", f"{why}: {problem.text}")


def _bound(linked: Linked, outcome: Outcome) -> Linked:
    """The linked sentence with every mention bound to the object that was taken."""
    spoken = tuple(
        msgspec_replace(one, (outcome.binding.get(one.mention.slot, ""),)) for one in linked.spoken
    )
    return Linked(linked.text, linked.tokens, linked.chunks, spoken)


def msgspec_replace(spoken: Spoken, objects: tuple[str, ...]) -> Spoken:
    """The mention with other objects."""
    from dataclasses import replace

    return replace(spoken, mention=msgspec.structs.replace(spoken.mention, objects=objects))


def _place_option(place: str, outcome: Outcome, gap: Gap) -> Option:
    assert outcome.checked is not None and gap.theme is not None
    theme = outcome.binding[gap.theme.mention.slot]
    after = outcome.checked.after
    item = after.get(theme) if after is not None else None
    target = None if item is None or item.x is None or item.y is None else Target(item.x, item.y)
    touched = tuple(outcome.binding.values())
    return Option(place, (), target, outcome.checked.program, outcome.checked.kind, touched)


def _examples(options: Sequence[Option]) -> str:
    return f": {listing([o.label for o in options], 'or')}" if options else ""


def _noun(spoken: Spoken) -> str:
    assert spoken.phrase is not None
    return " ".join(spoken.phrase.head) or "one"


def _base(verb: str, lexicon: Lexicon) -> str:
    """The base form of a verb as it was said ("putting" -> "put")."""
    from clarifier.words import stems

    return next((stem for stem in reversed(stems(verb)) if lexicon.verb(stem) and
                 stem in lexicon.vocabulary), verb)  # fmt: skip
