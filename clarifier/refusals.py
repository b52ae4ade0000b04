"""Refusals: how they are worded, and the ladder's first rules, which only refuse."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

import msgspec

from agent.messages import Decision, Dialog, Kind, Problem, Reason
from clarifier.lexicon import Lexicon
from clarifier.people import reaches_someone
from clarifier.pieces import JOINTS, Chunk
from clarifier.spoken import Linked
from clarifier.words import stems
from scene.types import Scene

BEYOND = "is beyond the arm"
"""How the reason ends where a sentence asks for what no arm does."""
_OFF = re.compile(
    r"\b(?:(?:off|off of|beyond|past|outside) the (?:\w+ )?(?:table|desk|edge|border)|"
    r"over the (?:\w+ )?edge|(?:beside|under) the table|(?:onto|on|to) the floor|on the ground)\b"
    r"(?! of (?:the|my) (?!table|desk))"
)
"""Places beyond the table."""
_SET_DOWN = ("in", "on", "beside", "left", "right", "above", "below", "between")
"""Relations of where a thing is set down."""


@dataclass(frozen=True)
class State:
    """The turn so far: live scene, conversation, task asked for, and what to say first."""

    scene: Scene
    dialog: Dialog
    task: Kind | None = None
    echo: str = ""
    questions: int = 0


def harms_someone(linked: Linked, state: State, lexicon: Lexicon) -> Decision | None:
    """Nothing is brought to bear on a person, whatever the tool."""
    verb = reaches_someone(linked, lexicon)
    if verb is None:
        return None
    text = "I won't do that to anybody: it is not safe. I keep away from people."
    return refuse(state, "unsafe", text, f"{verb!r} is to be done to a person")


def beyond_me(linked: Linked, state: State, lexicon: Lexicon) -> Decision | None:
    """Verbs for what an arm must not do, or cannot."""
    for chunk in linked.chunks:
        word = linked.tokens[chunk.first].text
        harms = chunk.value == "harmful" and not _of_its_own(chunk, linked)
        if chunk.kind == "verb" and harms and not _loosely(word, linked):
            text = f"I won't {base_form(word, lexicon)} things: that is not safe."
            text += " I can push something or put it somewhere."
            return refuse(state, "unsafe", text, f"{word!r} does harm")
        if chunk.kind == "verb" and chunk.value == "cannot" and _is_told(chunk, linked):
            text = f"I can't {base_form(word, lexicon)} anything: I can only pick up, put,"
            text += " push and touch things on the table."
            return refuse(state, "not_understood", text, f"{word!r} {BEYOND}")
    return None


def _loosely(word: str, linked: Linked) -> bool:
    """ "chuck the block in the bowl", "... next to it": said of putting it there."""
    soft = any(stem in ("throw", "toss", "chuck", "lob", "fling") for stem in stems(word))
    slang = any(stem in ("toss", "chuck", "lob") for stem in stems(word))
    places = _SET_DOWN if slang else ("in", "on")
    return soft and any(
        s.relation in places
        and s.mention.objects
        and not s.theme
        and linked.tokens[s.opened - 1].text != "at"
        for s in linked.spoken
    )


_SUBJECTS = frozenset({"who", "which", "that", "he", "she", "they", "nobody", "everybody"})


def _of_its_own(chunk: Chunk, linked: Linked) -> bool:
    """ "who breaks up the line", "it never hits anything": said of somebody, nobody is told to."""
    word = linked.tokens[chunk.first].text
    before = linked.tokens[chunk.first - 1].text if chunk.first else ""
    until = {token.text for token in linked.tokens[: chunk.first]} & {"until", "till", "so"}
    return word.endswith("s") and before in _SUBJECTS and word not in stems(word)[-1:] and not until


def _is_told(chunk: Chunk, linked: Linked) -> bool:
    """ "eat the apple", "and then eat it"; not "I'm about to eat" nor "clean up", nor "lift the
    can, wiping under it": what somebody else does meanwhile."""
    word = linked.tokens[chunk.first].text
    before = linked.tokens[chunk.first - 1].text if chunk.first else ","
    after = [token.text for token in linked.tokens[chunk.last : chunk.last + 4]]
    return before in JOINTS and "up" not in after and not (chunk.first and word.endswith("ing"))


_UPSIDE_DOWN = re.compile(
    r"\bupside[- ]?down\b(?! (?:pyramid|pile|stack|tower|triangle|v\b|order|heap))|"
    r"\bface[- ]?down(?:wards?)?\b|"
    r"\b(?:flip|turn)\b(?: (?!it\b|them\b)[\w'-]+){1,4} over$"
)
_ITS = re.compile(r"\b(?:is|are|lies|lying|stands|standing|sits) upside")
"""How something lies already."""


def upside_down(linked: Linked, state: State, lexicon: Lexicon) -> Decision | None:
    """What stands on its base is set down on it again."""
    said = " ".join(token.text for token in linked.tokens).rstrip(" .!?")
    if not _UPSIDE_DOWN.search(said) or _ITS.search(said):
        return None
    text = "I can't turn things upside down: I set them down as I lift them. I can turn them round,"
    text += " or knock them over."
    return refuse(state, "not_understood", text, "what stands on its base stays on it")


_STAND_UP = re.compile(
    r"^(?:please )?(?:stand|set|put|turn)(?: [\w'-]+){1,5}? (?:back )?(?:up|upright)(?: again)?$"
)


def stood_up(linked: Linked, state: State, lexicon: Lexicon) -> Decision | None:
    """ "Stand the bottle up": what lies cannot be raised, what stands need not be."""
    said = " ".join(token.text for token in linked.tokens).rstrip(" .!?")
    named = [one.mention.objects for one in linked.spoken]
    if not _STAND_UP.match(said) or len(named) != 1 or len(named[0]) != 1:
        return None
    item = state.scene.get(named[0][0])
    if item.upright:
        return refuse(state, "impossible", f"The {item.name} stands upright.", "it stands already")
    text = f"I can't stand the {item.name} up again: I lift things from above."
    return refuse(state, "impossible", text, "what lies cannot be raised")


def off_the_table(linked: Linked, state: State, lexicon: Lexicon) -> Decision | None:
    """Off the table is no place to put a thing; pushing it off is another matter."""
    said = " ".join(token.text for token in linked.tokens)
    off = _OFF.search(said)
    ahead = len(said[: off.start()].split()) if off is not None else 0
    placed = [s for s in linked.spoken if s.theme and s.opened < ahead][-1:]
    if not placed or placed[0].verb != "place":
        return None
    if any(s.verb in ("push", "topple") for s in linked.spoken):
        return None
    verbs = [chunk.value for chunk in linked.chunks if chunk.kind == "verb" and chunk.first < ahead]
    if verbs and verbs[-1] in ("push", "topple"):
        return None  # "as for the fork, that may be pushed off the table"
    name = placed[0].mention.text
    text = f"I won't put the {name} off the table. I can push it over an edge if you want that."
    return refuse(state, "unsafe", text, "the destination is off the table")


def nothing_said(linked: Linked, state: State, lexicon: Lexicon) -> Decision | None:
    """No thing, no place and no verb that is known, or an unknown verb about unknown things."""
    verbs = [chunk for chunk in linked.chunks if chunk.kind == "verb"]
    known = any(s.mention.objects for s in linked.spoken)
    known = known or any(chunk.kind == "place" for chunk in linked.chunks)
    if verbs or known or (linked.spoken and linked.spoken[0].first <= 1):
        return None
    text = "I did not understand that. Tell me to put, push, pick up or touch something."
    return refuse(state, "not_understood", text, "no known verb and nothing on the scene")


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


def base_form(verb: str, lexicon: Lexicon) -> str:
    """The base form of a verb as it was said ("putting" -> "put")."""
    return next((stem for stem in reversed(stems(verb)) if stem in lexicon.base_verbs), verb)
