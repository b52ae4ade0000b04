"""The ladder's rules about things: what a phrase may mean, and how many are meant."""

from __future__ import annotations

import itertools

import msgspec

from agent.messages import Decision, Option, QuestionKind
from clarifier import focus
from clarifier.ask import (
    MAX_OFFERED,
    MAX_OPTIONS,
    alike,
    labels,
    many,
    there_is,
    which_text,
)
from clarifier.binding import near_first
from clarifier.branches import vague
from clarifier.deed import link_deed
from clarifier.handed_out import handed_out, is_handed_out, not_handed_out
from clarifier.questions import Questions
from clarifier.refusals import State, refuse, refuse_problem
from clarifier.rewrite import spelled_out
from clarifier.spoken import Linked, Spoken, ambiguous
from clarifier.words import article, listing, number_word, sentence, singular, words


class Referents(Questions):
    """Counts referents on the live scene; asks where they are none, too few or too many."""

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
        asked = self._ask(linked, state, kind, text, options, why)
        if kind != "unknown_word" or asked.dialog.pending is None or spoken.phrase is None:
            return asked
        about = msgspec.structs.replace(asked.dialog.pending, word=spoken.phrase.head[-1])
        dialog = msgspec.structs.replace(asked.dialog, pending=about)
        return msgspec.structs.replace(asked, dialog=dialog)

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
            if vague(spoken) and len(found) > 1:
                return self._ask_count(linked, spoken, state)
            few_of_one = len(found) == 1 and vague(spoken)
            if spoken.phrase is None or (spoken.count <= len(found) and not few_of_one):
                continue
            if spoken.count == len(spoken.same_type) and _leaves_out(spoken, linked):
                continue  # "the four eggs except the largest": four are there
            noun = _noun(spoken, "thing")
            options = self._branches.options(linked, spoken, [found], state)[0]
            few = number_word(len(found))
            one = len(found) == 1
            noun = singular(noun) if one else many(singular(noun))
            text = f"I can see only {few} {noun}. Shall I take {'it' if one else few}?"
            asked = number_word(spoken.count) if spoken.count else "several"
            why = f"{asked} asked, {few} there"
            return self._ask(linked, state, "how_many", text, options, why)
        return None

    def as_handed_out(self, linked: Linked, state: State) -> Linked:
        """The sentence with what is handed out, one for each, linked as the group that it is."""
        shared = handed_out(linked, self._lexicon)
        if shared is None:
            return linked
        whole = shared + linked.caution
        return link_deed(whole, state.scene, state.dialog.focus, self._lexicon)

    def shared_out(self, linked: Linked, state: State) -> Decision | None:
        """One for each, and there are too few; or so many, or so, that no program knows how."""
        unknown = not_handed_out(linked)
        if unknown is not None:
            text = f"I can put one on, in or next to each of them, but not “{unknown}”."
            text += " Please say them one by one."
            return refuse(state, "not_understood", text, f"{unknown!r} is not known")
        shared = is_handed_out(linked)
        if shared is not None and any(s.phrase and s.phrase.group for s in linked.spoken):
            text = "I can hand out one each. Please say what else to do in a sentence of its own."
            return refuse(state, "not_understood", text, "what is left over is not known before")
        if shared is None or len(shared[0].mention.objects) >= len(shared[1].mention.objects):
            return None
        things, places = shared
        few, many_ = (len(one.mention.objects) for one in shared)
        options = self._branches.options(linked, things, [things.mention.objects], state)[0]
        if not options:
            return None
        noun = _noun(things, "thing")
        noun = singular(noun) if few == 1 else many(singular(noun))
        short = f"{number_word(few)} {noun} for {number_word(many_)} {_noun(places, 'things')}"
        text = f"There {'is' if few == 1 else 'are'} only {short}. Shall I do it as far as they go?"
        return self._ask(linked, state, "how_many", text, options, f"only {short}")

    def _ask_count(self, linked: Linked, spoken: Spoken, state: State) -> Decision:
        near = near_first(spoken.mention.objects, state.scene)
        rest = any(one.phrase is not None and one.phrase.group in ("rest", "others")
                   for one in linked.spoken)  # fmt: skip
        counts = range(min(1 if rest else 2, len(near) - 1), len(near) + (not rest))
        pool = [tuple(near[:n]) for n in counts]
        options = self._branches.options(linked, spoken, pool, state)[0]
        options = options or tuple(Option("", objects) for objects in pool)
        options = tuple(
            msgspec.structs.replace(option, label=number_word(len(option.objects)))
            for option in options
        )
        noun = many(singular(_noun(spoken, "thing")))
        names = [option.label for option in options][:MAX_OPTIONS]
        text = f"How many {noun} should I take: {listing(names, 'or')}?"
        return self._ask(linked, state, "how_many", text, options,
                         f"{spoken.mention.text!r} is no number")  # fmt: skip

    def untold_quality(self, linked: Linked, state: State) -> Decision | None:
        """ "The shiny blocks" where no word of the scene tells which of them are: ask."""
        known = {word for item in state.scene for word in words(item.name)}
        for spoken in linked.spoken:
            word = self._untold(spoken, known)
            if word is not None:
                every = labels(spoken.mention.objects, state.scene, self._lexicon)
                names = listing(every.values(), "or")
                text = f"I can't tell what is “{word}”. Which do you mean: {names}?"
                pool = [(one,) for one in spoken.mention.objects]
                options = tuple(Option(every[o], (o,)) for (o,) in pool[:MAX_OPTIONS])
                why = f"{word!r} is nothing that is seen"
                return self._ask(linked, state, "which", text, options, why)
        return None

    def _untold(self, spoken: Spoken, known: set[str]) -> str | None:
        """The adjective of several things that says nothing known about them."""
        phrase = spoken.phrase
        if phrase is None or not spoken.mention.plural or len(spoken.mention.objects) < 2:
            return None
        lists = self._lexicon.words
        skip = known | lists("vague") | lists("grouping")
        new = (
            m for m in phrase.modifiers if m not in self._lexicon.vocabulary or m in lists("unseen")
        )
        return next((m for m in new if m.isalpha() and m not in skip
                     and not self._lexicon.is_noun(m)), None)  # fmt: skip

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
            text = f"{sentence(failed[0].text)} Do you mean {names[0]}?"
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
        )  # fmt: skip


def _noun(spoken: Spoken, otherwise: str) -> str:
    return " ".join(spoken.phrase.head if spoken.phrase is not None else ()) or otherwise


def _leaves_out(spoken: Spoken, linked: Linked) -> bool:
    """Whether some of what a phrase counts is left out of it."""
    assert spoken.phrase is not None
    inside = (c for c in linked.chunks if spoken.phrase.last <= c.first < spoken.last)
    return any(chunk.kind == "except" for chunk in inside)
