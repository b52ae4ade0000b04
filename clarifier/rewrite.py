"""Sentences made whole: an answer put into the sentence that was asked about, an ellipsis put
into the last command. The result is a sentence like any other and goes through the whole ladder.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import msgspec

from agent.messages import Dialog, Focus, Option, Pending
from clarifier.ask import labels
from clarifier.deed import link_deed
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.roles import complete, find_gap
from clarifier.spoken import Linked, Spoken, ambiguous
from clarifier.things import is_attribute
from clarifier.words import stems, words
from scene.types import Scene

_AGAIN = frozenset(
    {"now", "and", "then", "also", "too", "next", "as", "well", "again", "same", "do", "with"}
    | {"the", "thing", "but", "for", "this", "that", "it", "please", "just", "likewise", "instead"}
    | {"you", "there"}
)


_SAME = re.compile(
    r"^(?:(?:now|and|then|please|also|next)[\s,]+)*(?:(?:do|repeat) )?"
    r"(?:the same|same|that|this|it|once more|once again|again)"
    r"(?: thing| again| too| once more)*,?(?: but)?"
    r"(?: this time)? (?:with|for|to) ",
    re.IGNORECASE,
)


_POINTING = frozenset({"there", "here", "down", "over", "up", "right", "just", "please", ","})
_DUE = frozenset({"goes", "go", "belongs", "has", "have", "to", "must", "should", "needs", "be"})
"""Words that say that something is to become of a thing."""
_PUTTING = frozenset({"put", "place", "set"})
"""Behind these "to the plate" needs no thing before it."""
_NEARING = frozenset({"bring", "bringing", "carry", "over", "across"})
"""With these "to the plate" may be beside it."""
_PARTICLE = re.compile(
    r"^(?:down|up|over|back|straight|right) (?=(?:on|in)(?:to)? )", re.IGNORECASE
)
_WITH_IT = re.compile(r"\s+with (?:it|that|this|them|those)[\s.!]*$", re.IGNORECASE)
"""Behind a place said alone: "on the plate with it"."""
_WITH_MORE = re.compile(
    r"\bwith (?:(?:it|that|this|them|those) and\b|[^,.;]+ and (?:it|them)[\s.!]*$)", re.IGNORECASE
)
"""There things are named of which "it" is one."""


def fill(
    pending: Pending,
    option: Option | None,
    said: str,
    scene: Scene,
    focus: Sequence[Focus],
    lexicon: Lexicon,
) -> str:
    """The pending sentence with the option (or the words said) in the place asked about; by its
    identifier where its label would be read in another way there."""
    linked = link_deed(pending.text, scene, focus, lexicon)
    whole = _filled(linked, pending, option, said, lexicon) + linked.caution
    if option is None or len(option.objects) != 1 or pending.question.kind != "which":
        return whole
    named = (one.mention.objects for one in link_deed(whole, scene, focus, lexicon).spoken)
    if option.objects in named:
        return whole
    known = msgspec.structs.replace(option, label=f"the {option.objects[0]}")
    return _filled(linked, pending, known, said, lexicon) + linked.caution


def _filled(
    linked: Linked, pending: Pending, option: Option | None, said: str, lexicon: Lexicon
) -> str:
    """The sentence filled, its cautions aside."""
    answer = option.label if option is not None else said
    spoken = _troubled(linked) or _asked_about(linked, pending)
    objects = option.objects if option is not None else ()
    about_things = pending.question.kind not in ("where", "direction", "open")
    if about_things and spoken is not None and (objects or said):
        if pending.question.kind == "how_many" and " " not in answer and spoken.phrase is not None:
            answer = " ".join((answer, *spoken.phrase.modifiers, *_many(spoken.phrase.head)))
            return _replaced(linked, spoken, answer, determined=True)
        return _replaced(linked, spoken, answer)
    gap = find_gap(linked, lexicon)
    if gap is None:
        return linked.text
    if gap.role == "theme" and not answer.startswith("the "):
        answer = f"the {answer}"
    return complete(linked.text, gap, answer)


def restate(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "now the blue one", "and the cup too": the last command with another theme; else None."""
    if dialog.last_text is None:
        return None
    linked = link(_SAME.sub("", text), scene, dialog.focus, lexicon)
    outside = _words_outside(linked)
    if len(linked.spoken) != 1 or linked.spoken[0].relation or not outside <= _AGAIN:
        return None
    if linked.spoken[0].phrase is not None and linked.spoken[0].last > linked.spoken[0].phrase.last:
        return None  # "the green one on the plate" has a place of its own
    past = link(dialog.last_text, scene, (), lexicon)
    themes = [one for one in past.spoken if one.theme and one.phrase is not None]
    if len({one.mention.slot for one in themes}) != 1 or linked.spoken[0].phrase is None:
        return None
    said = _named_in_full(linked.spoken[0], themes[0], lexicon)
    for theme in reversed(themes):  # from the end, so that the places of those before hold
        past = replace(past, text=_replaced(past, theme, said))
    return past.text


def with_verb(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "now the green one on the plate", once something was put somewhere: with that verb."""
    if dialog.last_text is None:
        return None
    linked = link(text, scene, dialog.focus, lexicon)
    if any(chunk.kind == "verb" for chunk in linked.chunks):
        return None
    if not linked.spoken:
        return None
    alone = elsewhere(text, scene, lexicon)
    if alone is not None:
        return alone
    first = linked.tokens[: linked.spoken[0].opened]
    placed = any(one.relation for one in linked.spoken) or (
        linked.spoken[0].phrase is not None and linked.spoken[0].last > linked.spoken[0].phrase.last
    )
    past = link(dialog.last_text, scene, (), lexicon)
    if (
        not placed
        or not {token.text for token in first} <= _AGAIN
        or "place" not in {one.verb for one in past.spoken}
    ):
        return None
    return f"put {text[linked.tokens[linked.spoken[0].opened].start :]}"


def elsewhere(text: str, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "in the bowl", "on the plate with it": a place alone, for what was spoken of last."""
    text = _PARTICLE.sub("", text)
    linked = link(text, scene, (), lexicon)
    led = bool(linked.chunks) and linked.chunks[0].kind == "relation" and bool(linked.spoken)
    verb = any(chunk.kind == "verb" for chunk in linked.chunks)
    alone = led and not verb and not _WITH_MORE.search(text)
    return f"put it {_WITH_IT.sub('', text)}" if alone else None


def put_there(text: str, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "sponge down there": it is to be put somewhere, and where is only pointed at."""
    linked = link(text, scene, (), lexicon)
    if len(linked.spoken) != 1:
        return None
    said = [token.text for token in linked.tokens[linked.spoken[0].last :]]
    said = [text for text in said if text not in _DUE]
    verbs = [
        c for c in linked.chunks if c.kind == "verb" and linked.tokens[c.first].text not in _DUE
    ]
    if verbs:
        return None
    pointed = bool({"there", "here"} & set(said)) and set(said) <= _POINTING
    bare = linked.spoken[0].opened == linked.spoken[0].first
    thing = text[linked.tokens[linked.spoken[0].opened].start : linked.spoken[0].mention.end]
    return f"put {'the ' if bare else ''}{thing} {' '.join(said)}" if pointed else None


def told_to_do(text: str, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "The bottle has to be moved": to move the bottle, where nothing more is said."""
    linked = link(text, scene, (), lexicon)
    if len(linked.spoken) != 1 or len(linked.tokens) < 3 or linked.spoken[0].opened:
        return None
    *between, last = [token.text for token in linked.tokens[linked.spoken[0].last :]] or [""]
    base = next((stem for stem in reversed(stems(last)) if stem in lexicon.base_verbs), "")
    due = "be" in between and set(between) <= _DUE
    moves = due and lexicon.verb(base) in ("place", "push", "turn")
    return f"{base} {text[: linked.spoken[0].mention.end]}" if moves else None


def into_holder(linked: Linked, lexicon: Lexicon) -> str | None:
    """ "put the apple to the plate", "cup to box": onto what carries, into what holds; None where
    nothing is said like that."""
    if any(token.text in _NEARING for token in linked.tokens):
        return None
    for at, chunk in enumerate(linked.chunks):
        to = linked.tokens[chunk.first]
        goal = next((s for s in linked.spoken if s.opened == chunk.last and s.phrase), None)
        if chunk.value != "goal" or to.text != "to" or goal is None or at == 0:
            continue
        assert goal.phrase is not None
        ahead = linked.chunks[at - 1]
        led = ahead.kind in ("np", "pronoun") or linked.tokens[ahead.first].text in _PUTTING
        rest = [c for c in linked.chunks if c.first >= goal.last]
        over = not rest or rest[0].kind == "joint" or linked.tokens[goal.last].text == "please"
        told = any(c.kind == "verb" for c in rest[2:])  # ", in its place put the other one"
        over = over and not (len(rest) > 1 and rest[1].kind == "relation" and not told)
        way = lexicon.goes(goal.phrase.head[-1]) if goal.phrase.head else None
        if way is not None and led and over and goal.verb in ("", "place", "pick"):
            return f"{linked.text[: to.start]}{way}to{linked.text[to.end :]}"
    return None


def spelled_out(linked: Linked, scene: Scene, lexicon: Lexicon) -> str:
    """The sentence with its pronouns replaced by names, so that it can be understood later."""
    text = linked.text
    for one in reversed(linked.spoken):
        if one.phrase is None and len(one.mention.objects) == 1:
            (object_id,) = one.mention.objects
            same = [item.id for item in scene if item.name == scene.get(object_id).name]
            label = labels(same, scene, lexicon)[object_id]
            text = text[: one.mention.start] + label + text[one.mention.end :]
    return text


def _named_in_full(new: Spoken, old: Spoken, lexicon: Lexicon) -> str:
    """ "blue one" after "red mug" is a "blue mug", whether or not "red" is part of its name."""
    assert new.phrase is not None and old.phrase is not None
    if new.phrase.head or not old.phrase.head:
        return new.mention.text
    noun = [w for w in old.phrase.head[:-1] if not is_attribute(w, lexicon)]
    return " ".join((*new.phrase.modifiers, *noun, old.phrase.head[-1]))


def _words_outside(linked: Linked) -> set[str]:
    inside: set[int] = set()
    for one in linked.spoken:
        inside |= set(range(one.opened, one.last))
    texts = [t.text for i, t in enumerate(linked.tokens) if i not in inside]
    return {text for text in texts if text[0].isalnum()}


def _troubled(linked: Linked) -> Spoken | None:
    """The mention that a question must have been about: absent, too many, or unclear."""
    for one in linked.spoken:
        short = one.count > len(one.mention.objects)
        vague = one.phrase is not None and one.phrase.vague
        if not one.mention.objects or ambiguous(one) or short or vague:
            return one
    return None


def _asked_about(linked: Linked, pending: Pending) -> Spoken | None:
    """The group of which it was asked which of its members are meant."""
    offered = [set(option.objects) for option in pending.question.options]
    whole = set().union(*offered)
    apart = pending.question.kind == "which" and all(len(objects) == 1 for objects in offered)
    groups = (s for s in linked.spoken if s.mention.plural and whole <= set(s.mention.objects))
    return next(groups, None) if apart and len(whole) > 1 else None


def _many(head: Sequence[str]) -> tuple[str, ...]:
    return tuple(head) or ("things",)


def exception_beside(linked: Linked) -> str | None:
    """The sentence with an exception moved behind its group ("put all blocks on the plate except
    the red one"), so that it is read as part of it; None where nothing is to be moved."""
    for at, chunk in enumerate(linked.chunks):
        if chunk.kind != "except" or any(s.first <= chunk.first < s.last for s in linked.spoken):
            continue
        left_out = _listed(at, linked)
        if not left_out:
            continue
        groups = [s for s in linked.spoken if s.mention.plural and s not in left_out]
        wanted = {o for one in left_out for o in one.mention.objects}
        groups = [s for s in groups if wanted & set(s.mention.objects)]
        before = [s for s in groups if s.last <= chunk.first]
        group = before[-1] if before else groups[0] if groups else None
        if group is None or group.last == chunk.first:
            continue
        start, end = linked.tokens[chunk.first].start, left_out[-1].mention.end
        said, text = linked.text[start:end], linked.text
        if start < group.mention.start:
            rest = text[end : group.mention.end].lstrip(" ,")
            return f"{text[:start]}{rest} {said}{text[group.mention.end :]}"
        rest = text[group.mention.end : start].rstrip(" ,")
        return f"{text[: group.mention.end]} {said}{rest}{text[end:]}"
    return None


def _listed(at: int, linked: Linked) -> list[Spoken]:
    """The mentions of the list that starts behind a chunk: "the red one and the cup"."""
    found: list[Spoken] = []
    at += 1
    while at < len(linked.chunks):
        first = linked.chunks[at].first
        spoken = next((s for s in linked.spoken if s.opened == first), None)
        if spoken is None or spoken.relation:
            return found
        found.append(spoken)
        at = next((i for i, c in enumerate(linked.chunks) if c.first >= spoken.last), at + 1)
        joint = linked.tokens[linked.chunks[at].first].text if at < len(linked.chunks) else ""
        following = linked.chunks[at + 2].kind if at + 2 < len(linked.chunks) else ""
        if joint not in ("and", "or") or following in ("verb", "relation"):
            return found
        at += 1
    return found


def _replaced(linked: Linked, spoken: Spoken, answer: str, determined: bool = False) -> str:
    """The sentence with a mention, determiner included, replaced by "the ..."."""
    start = linked.tokens[spoken.opened].start
    if determined:
        return f"{linked.text[:start]}{answer}{linked.text[spoken.mention.end :]}"
    bare = answer if words(answer)[:1] in (("the",), ("a",), ("an",)) else f"the {answer}"
    return f"{linked.text[:start]}{bare}{linked.text[spoken.mention.end :]}"
