"""Undo, "put the cup back", "no, the green one": ways back, checked like any other program."""

from __future__ import annotations

import re
from collections.abc import Sequence

import msgspec

from agent.messages import Decision, Dialog, Done, Option, Pending, Question
from clarifier import act, focus
from clarifier.ask import labels
from clarifier.candidates import Planner
from clarifier.corrections import behind
from clarifier.follow_ups import placed_instead
from clarifier.ladder import Ladder
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.other_way import OTHER_WAY, reversed_way
from clarifier.refusals import State, refuse, refuse_problem
from clarifier.rewrite import restate
from clarifier.undo import WayBack, way_back
from clarifier.words import listing
from scene.types import Scene, identifiers

_PUT_BACK = re.compile(
    r"^(?:put|move|bring|place|take|set|return|make) (?P<what>.+?)(?: back)?"
    r"(?: again)?(?: (?:to )?(?:(?:where|how|as|like) (?:it|they) (?:was|were|stood|"
    r"came from|used to be)(?: before)?|(?:its|their) (?:old|former|original|previous) "
    r"(?:place|position|spot)s?))?$",
    re.IGNORECASE,
)
_SAYS_BACK = re.compile(
    r"(?<!the )\bback\b(?! of\b| (?:edge|side|corner|half|left|right|row|end)\b)|"
    r"\b(?:old|former|original|previous) (?:place|position|spot)s?\b|"
    r"\b(?:where|how|like) (?:it|they) (?:was|were|stood|came from|used to be)\b|^return\b",
    re.IGNORECASE,
)


_AND_ON = re.compile(
    r"^(?:(?:actually|well|oh|no|wait|hm+|sorry|ah)\b[\s,.!]*)*(?P<back>(?:undo|revert|reverse|"
    r"put|move|bring|take|set|place) [^,;]*?)[\s,;]+(?:and|then|but)"
    r"(?: then| please| now| rather)* (?P<rest>\w+ .+?)(?: instead| rather)?[\s.!]*$",
    re.IGNORECASE,
)
_OTHER_BACK = re.compile(
    r"[\s,.;!]+(?:(?:and|so|then|please|with)[\s,]+)*(?:put |move |take )?(?:the )?"
    r"(?:other|first|old|wrong)(?: one)?(?: goes| can go| should go)? back(?: again)?"
    r"(?: (?:to )?where it (?:was|stood|came from|belongs)(?: before)?)?[\s.!]*$",
    re.IGNORECASE,
)
"""What a correction says of the wrong thing, which goes back anyway."""
_ONE_OF_THEM = re.compile(r"\b(?:put|move|bring|place|take|set) it\b", re.IGNORECASE)


class TakingBack:
    """Decides on what takes a motion back. ``ladder`` decides on the command said instead."""

    def __init__(self, planner: Planner, lexicon: Lexicon, ladder: Ladder) -> None:
        self._planner = planner
        self._lexicon = lexicon
        self._ladder = ladder

    def undo(self, text: str, state: State) -> Decision:
        """Take back the last motion that left anything otherwise than it was; of several things
        that it moved, "it" is one, and which one is asked."""
        rest, way = _last(state.dialog.done, state)
        several = isinstance(way, WayBack) and len(way.touched) > 1
        if several and _ONE_OF_THEM.search(text):
            return self._which(state.dialog.done[len(rest)], state)
        if way is None:
            text = "There is nothing that I could take back."
            return refuse(state, "not_understood", text, "nothing was moved, or all is back")
        return self._go_back(way, rest, state)

    def named(self, text: str, state: State) -> Decision | None:
        """ "put the cup back where it was": of the last motion that moved it, its part alone."""
        core = act.strip_courtesy(behind(text) or text).rstrip(".!? ")
        said = _PUT_BACK.match(core)
        if said is None or not _SAYS_BACK.search(core):
            return None
        linked = link(said["what"], state.scene, state.dialog.focus, self._lexicon)
        if any(chunk.kind == "verb" for chunk in linked.chunks):
            return None  # "take the egg and put it in the tin, then move the cup back"
        if any(not s.mention.plural and len(s.mention.objects) > 1 for s in linked.spoken):
            return self.undo("put it back", state)
        wanted = {o for one in linked.spoken for o in one.mention.objects}
        if not wanted or any(one.relation for one in linked.spoken):
            return None
        for at in range(len(state.dialog.done) - 1, -1, -1):
            done = state.dialog.done[at]
            stood = tuple(item for item in done.stood if item.id in wanted)
            if stood:
                way = way_back(Done(done.text, stood), state.scene)
                if way is not None:
                    left = tuple(item for item in done.stood if item.id not in wanted)
                    kept = (Done(done.text, left),) if left else ()
                    rest = (*state.dialog.done[:at], *kept, *state.dialog.done[at + 1 :])
                    return self._go_back(way, rest, state)
        return None

    def corrected(self, text: str, state: State) -> Decision | None:
        """ "no, the green one", once something was done: that is taken back, and the command done
        with the thing meant instead. None where the sentence corrects nothing."""
        rest = behind(text)
        found = self._restored(state) if rest is not None else None
        if found is None or rest is None:
            return None
        way, restored = found
        core = act.strip_courtesy(rest) or rest
        core = _OTHER_BACK.sub("", core)
        placed = placed_instead(core, restored.scene, self._lexicon)
        if placed is not None:
            return self._ladder.decide(placed, state)
        again = restate(core, restored.dialog, restored.scene, self._lexicon)
        return None if again is None else self._instead(again, way, restored, state)

    def back_and_on(self, text: str, state: State) -> Decision | None:
        """ "put it back where it was and touch the tape instead": back, then the rest done."""
        said = _AND_ON.match(act.strip_courtesy(behind(text) or text))
        if said is None:
            return None
        put = _PUT_BACK.match(said["back"])
        it = put is not None and put["what"].lower() in ("it", "that", "them", "this")
        if not act.takes_back(said["back"]) and not (it and _SAYS_BACK.search(said["back"])):
            return None
        found = self._restored(state)
        core = act.strip_courtesy(said["rest"]).rstrip(".! ")
        if found is None or self._lexicon.verb(core.split(" ")[0].lower()) is None:
            return None
        return self._instead(core, *found, state)

    def other_way(self, text: str, state: State) -> Decision | None:
        """ "The other way": the last motion is taken back, and done in the opposite direction."""
        turned = reversed_way(state.dialog.last_text or "") if OTHER_WAY.match(text) else None
        found = self._restored(state) if turned is not None else None
        return None if turned is None or found is None else self._instead(turned, *found, state)

    def _restored(self, state: State) -> tuple[WayBack, State] | None:
        """The way back of the last motion, and how things stand once it is gone; None for none."""
        before, way = _last(state.dialog.done, state)
        if not isinstance(way, WayBack):
            return None
        back = self._planner.check(way.program, "manipulate", state.scene, way.touched)
        if back.after is None or back.problems:
            return None
        dialog = msgspec.structs.replace(state.dialog, done=before)
        return way, State(back.after, dialog, state.task, state.echo)

    def _instead(self, again: str, way: WayBack, restored: State, state: State) -> Decision | None:
        """The way back and behind it the command, as one program."""
        meant = self._ladder.decide(again, restored)
        if meant.do != "act" or meant.program is None or meant.kind != "manipulate":
            return meant if meant.do != "act" else None
        program = f"{way.program}\n{_by_then(meant.program, way.touched, state.scene)}"
        touched = tuple(dict.fromkeys((*way.touched, *meant.touched)))
        both = self._planner.check(program, "manipulate", state.scene, touched)
        if both.problems:
            return refuse_problem(state, both.problems[0], "the correction may not run")
        echo = f"{meant.echo} I put it back first.".strip()
        return msgspec.structs.replace(
            meant, program=program, touched=touched, echo=echo,
            why=f"a correction: the last motion is taken back, then {meant.why}",
        )  # fmt: skip

    def _which(self, done: Done, state: State) -> Decision:
        names = labels([item.id for item in done.stood], state.scene, self._lexicon)
        options = []
        for item in done.stood:
            way = way_back(Done(done.text, (item,)), state.scene)
            if isinstance(way, WayBack):
                options.append(Option(names[item.id], (item.id,), None, way.program, "manipulate",
                                      way.touched))  # fmt: skip
        text = f"Which one should go back: {listing((o.label for o in options), 'or')}?"
        question = Question("which", text, tuple(options))
        pending = Pending(done.text, question)
        dialog = msgspec.structs.replace(state.dialog, pending=pending)
        why = "the last motion moved several things"
        return Decision("ask", why, dialog, reply=f"{state.echo} {text}".strip(),
                        question=question, echo=state.echo)  # fmt: skip

    def _go_back(self, way: WayBack | str, rest: tuple[Done, ...], state: State) -> Decision:
        if isinstance(way, str):
            return refuse(state, "impossible", f"I can't take that back: {way}", way)
        checked = self._planner.check(way.program, "manipulate", state.scene, way.touched)
        if checked.problems:
            return refuse_problem(state, checked.problems[0], "the way back may not run")
        dialog: Dialog = msgspec.structs.replace(
            state.dialog, focus=focus.on(state.dialog.focus, way.touched, ()), pending=None,
            questions_asked=0, done=rest,
        )  # fmt: skip
        return Decision(
            "act", "the last motion is taken back by its inverse, which passed the check", dialog,
            program=checked.program, kind="manipulate", touched=way.touched, echo=state.echo,
        )  # fmt: skip


def _by_then(program: str, moved: Sequence[str], scene: Scene) -> str:
    """The program that goes on behind another: where it reckons with the place of what that one
    moved, that is its place by then."""
    for name, item in identifiers(scene).items():
        if item.id in moved and re.search(rf"\b{name}\.[xyzr]\b", program):
            now = f"{name}_now"
            program = f"{now} = by_now({name})\n" + re.sub(rf"\b{name}\b", now, program)
    return program


def _last(done: tuple[Done, ...], state: State) -> tuple[tuple[Done, ...], WayBack | str | None]:
    """The way back of the last motion that has one or should, and the motions before it."""
    for at in range(len(done) - 1, -1, -1):
        way = way_back(done[at], state.scene)
        if way is not None:
            return done[:at], way
    return (), None
