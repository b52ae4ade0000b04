"""What a command leaves out: a destination, a direction, an angle, or the thing itself.

Only what each verb class needs is known here (`lexicon.toml`); what the words mean is not. A role
is missing where the verb clearly needs it and nothing in its clause can fill it: what is unusual
but complete ("the apple would look better on the plate") is left to the translator.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from clarifier.clauses import (
    COMPLETE,
    VAGUE,
    Clause,
    Unsaid,
    amount,
    clauses,
    goal,
    unsaid,
    words_of,
)
from clarifier.lexicon import Lexicon
from clarifier.pieces import JOINTS
from clarifier.spoken import Linked, Spoken
from clarifier.words import stems

Role = Literal["where", "direction", "angle", "theme"]
_ACTIONS = frozenset({"place", "push", "turn", "pick", "touch", "topple"})
_ARM = frozenset(
    {"go", "move", "point", "stay", "reach", "hover", "show", "aim", "come", "approach"}
)
"""Verbs that may speak of the arm itself."""
_PILING = frozenset({"stack", "pile"})
"""Several things that are stacked go onto one another."""
_SHOVES = frozenset({"push", "shove", "nudge"})
"""What somebody gives a thing."""
_PUTS = frozenset({"put", "place", "set", "lay"})
"""These are never said of the arm itself."""
_NOT = frozenset({"not", "never", "without", "dont", "no", "avoid"})
_TOLD = frozenset({"you", "we", "i", "should", "must", "shall", "can", "could", "would", "will"}
                  | {"need", "want", "have", "to", "please", "just", "kindly"}
                  | {"now", ","})  # fmt: skip
"""Words between a thing that is named first and the verb that the person is told to do with it."""
_SUFFERS = frozenset({"needs", "need", "wants", "requires", "to", "be", "being", "get", "gets"}
                     | {"must", "should", "has", "have", "can", "could", "may", "might", "will"}
                     | {"is", "please", "now", "just", "also", "a", "bit", "of"})  # fmt: skip
"""Words between a thing and what is to be done with it: "the pen needs moving"."""


@dataclass(frozen=True)
class Gap:
    """A role that nothing fills. ``cut:end`` is the text that an answer replaces.

    ``lead`` is the relation at which the sentence breaks off ("next to"); ``anchor`` the thing
    of which the side is missing.
    """

    role: Role
    verb: str
    theme: Spoken | None
    cut: int
    end: int
    lead: str = ""
    anchor: Spoken | None = None


def find_gap(linked: Linked, lexicon: Lexicon) -> Gap | None:
    """The first role that is missing, or None."""
    for clause in clauses(linked):
        gap = _gap(clause, linked, lexicon)
        if gap is not None:
            return gap
    return None


def _gap(clause: Clause, linked: Linked, lexicon: Lexicon) -> Gap | None:
    verb = linked.tokens[clause.first].text
    if _lacks_object(clause, linked, lexicon):
        at = _behind_verb(clause, linked)
        return Gap("theme", verb, None, at, at)
    needs = _needs(clause, linked)
    if _lacks_what_goes_there(clause, linked):
        return Gap("theme", verb, None, linked.tokens[clause.first].end,
                   linked.tokens[clause.first].end)  # fmt: skip
    verb = verb if needs == clause.verb else needs
    if needs not in ("place", "push", "turn") or _denied(clause, linked):
        return None
    theme = _theme(clause, linked, lexicon)
    if theme is None:
        return None
    if needs == "turn":
        said = {linked.tokens[i].text for i in words_of(clause, linked)}
        filled = bool(said & (lexicon.words("angles") | VAGUE | COMPLETE))
        filled = filled or bool(amount(clause, linked)) or goal(clause, linked, lexicon)
        return None if filled else Gap("angle", verb, theme, *_tail(clause, linked, theme))
    if _piled(clause, linked):
        return None
    begun = unsaid(clause, linked, lexicon)
    if begun is not None:
        return _begun(verb, theme, begun, linked)
    if goal(clause, linked, lexicon):
        return None
    role: Role = "direction" if needs == "push" or amount(clause, linked) else "where"
    return Gap(role, verb, theme, *_cut(clause, linked, theme, lexicon))


def _needs(clause: Clause, linked: Linked) -> str:
    """The class of the verb; "give it a shove" is pushing."""
    words = {linked.tokens[i].text for i in words_of(clause, linked)}
    gives = bool({"give"} & set(stems(linked.tokens[clause.first].text)))
    return "push" if gives and words & _SHOVES else clause.verb


def _begun(verb: str, theme: Spoken, begun: Unsaid, linked: Linked) -> Gap:
    """A place that was begun; what is put there was said before it."""
    before = [s for s in linked.spoken if s.theme and s.mention.end <= begun.cut]
    moved = before[-1] if before else theme
    return Gap("where", verb, moved, begun.cut, begun.end, begun.lead, begun.anchor)


def _theme(clause: Clause, linked: Linked, lexicon: Lexicon) -> Spoken | None:
    """What is to be moved: behind the verb, or named first ("the cup you should put there")."""
    behind = [s for s in linked.spoken if clause.first < s.first < clause.last and s.theme]
    if behind:
        bids = linked.tokens[clause.first].text in lexicon.base_verbs
        subject = _has_subject(clause, linked, behind[0] if bids else None)
        return None if subject else behind[-1]
    ahead = [s for s in linked.spoken if clause.start <= s.first and s.last <= clause.first]
    if not ahead or ahead[-1].relation or ahead[-1].verb or clause.start != 0:
        return None
    before = {token.text for token in linked.tokens[: ahead[-1].opened]}
    between = {token.text for token in linked.tokens[ahead[-1].last : clause.first]}
    if _is_participle(clause, linked, lexicon):
        told = between <= _SUFFERS
    else:
        told = bool({"you", "please", "should", "must"} & between) and between <= _TOLD
    return ahead[-1] if told and not before & JOINTS else None


def _is_participle(clause: Clause, linked: Linked, lexicon: Lexicon) -> bool:
    """ "moved", "moving"; "put" is one behind "be"."""
    verb, before = linked.tokens[clause.first].text, linked.tokens[clause.first - 1].text
    return verb not in lexicon.base_verbs or (clause.first > 0 and before == "be")


def _piled(clause: Clause, linked: Linked) -> bool:
    """Several things that are to be stacked: onto one another."""
    themes = [s for s in linked.spoken if clause.first < s.first < clause.last and s.theme]
    several = len({s.mention.slot for s in themes}) > 1 or any(s.mention.plural for s in themes)
    piles = any(stem in _PILING for stem in stems(linked.tokens[clause.first].text))
    return piles and several


def _has_subject(clause: Clause, linked: Linked, theme: Spoken | None) -> bool:
    """ "the plate should carry the cup": a thing does it, nobody is told where to put anything.
    "The cup, move it" only names the thing first."""
    before = [s for s in linked.spoken if clause.start <= s.first and s.last <= clause.first]
    if not before or before[-1].relation or before[-1].mention.text.lower() == "it":
        return False
    if theme and theme.phrase is None and theme.mention.slot == before[-1].mention.slot:
        return False
    between = {t.text for t in linked.tokens[before[-1].last : clause.first]}
    return not between & (JOINTS | {"to", "please", "just", "you"})


def _denied(clause: Clause, linked: Linked) -> bool:
    """ "don't move it", "without moving it": nothing more needs to be said."""
    before = {t.text for t in linked.tokens[max(clause.first - 2, 0) : clause.first]}
    return bool(before & _NOT) or any(text.endswith("n't") for text in before)


def _lacks_object(clause: Clause, linked: Linked, lexicon: Lexicon) -> bool:
    """ "put", "pick up": nothing in the whole sentence that could be meant."""
    if clause.verb not in _ACTIONS or linked.spoken or _has_them(clause, linked):
        return False
    aimed = goal(clause, linked, lexicon) or amount(clause, linked)
    arm = any(stem in _ARM for stem in stems(linked.tokens[clause.first].text))
    return not (arm and aimed)


def _lacks_what_goes_there(clause: Clause, linked: Linked) -> bool:
    """ "Put on the left side of the bottle": where to, and nothing that goes there."""
    behind = next((c for c in linked.chunks if c.first > clause.first), None)
    return (
        clause.start == 0
        and linked.tokens[clause.first].text in _PUTS
        and behind is not None
        and behind.kind == "relation"
        and behind.value not in ("goal", "on")  # "put on the lamp" may be another matter
        and bool(linked.spoken)
        and all(one.relation and one.phrase is not None for one in linked.spoken)
    )


def _has_them(clause: Clause, linked: Linked) -> bool:
    """Whether the verb has an object of some kind, were it only "the arm"."""
    particles = ("up", "down", "over")
    behind = [c for c in linked.chunks if c.first > clause.first]
    behind = [c for c in behind if linked.tokens[c.first].text not in particles]
    if any(c.kind in ("pronoun", "np") for c in behind):
        return True
    return bool(behind) and behind[0].kind == "other"


def _behind_verb(clause: Clause, linked: Linked) -> int:
    at = clause.first
    if at + 1 < len(linked.tokens) and linked.tokens[at + 1].text in ("up", "down", "over"):
        at += 1
    return linked.tokens[at].end


def _cut(clause: Clause, linked: Linked, theme: Spoken, lexicon: Lexicon) -> tuple[int, int]:
    """The text that the answer replaces: "there" and its like, or nothing, behind the theme."""
    pointing = lexicon.words("pointing")
    rest = list(linked.tokens[max(theme.last, clause.first + 1) : clause.last])
    if any(token.text in pointing for token in rest):
        last = max(t.end for t in rest if t.text in pointing)
        return rest[0].start if theme.last <= clause.first else theme.mention.end, last
    return _tail(clause, linked, theme)


def _tail(clause: Clause, linked: Linked, theme: Spoken) -> tuple[int, int]:
    """The place behind the clause's verb, its last mention and what it says of how far."""
    ends = [s.mention.end for s in linked.spoken if clause.first < s.first < clause.last]
    ends += [linked.tokens[clause.first].end, theme.mention.end]
    ends += amount(clause, linked)
    last = linked.tokens[clause.last - 1]
    ends += [last.end] if last.text in _SHOVES | {"over"} else []
    return max(ends), max(ends)


def complete(text: str, gap: Gap, words: str) -> str:
    """The sentence with the missing words said."""
    return f"{text[: gap.cut].rstrip()} {words.strip()}{text[gap.end :]}"
