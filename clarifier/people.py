"""People: what is said of them where only things can be meant."""

from __future__ import annotations

from clarifier.lexicon import Lexicon
from clarifier.spoken import Linked
from clarifier.words import singular, stems

_SOMEONE = frozenset({"me", "him", "her", "us", "them", "myself", "yourself", "himself", "herself"}
                     | {"themselves", "someone", "somebody", "anyone", "anybody", "everyone"}
                     | {"everybody", "whoever"})  # fmt: skip
_OWNERS = frozenset({"my", "your", "his", "her", "our", "their", "the", "a", "an", "this", "that"}
                    | {"someone's", "somebody's"})  # fmt: skip
_OWN = frozenset({"my", "his", "her", "their", "our", "someone's", "somebody's"})
"""Whose body it is; "your hand" is the gripper."""
PEOPLE = frozenset(
    {"person", "man", "woman", "boy", "girl", "child", "kid", "baby", "guy", "friend", "sister"}
    | {"brother", "mother", "father", "mom", "mum", "dad", "wife", "husband", "son", "daughter"}
    | {"colleague", "boss", "neighbour", "neighbor", "human", "user", "visitor", "teacher"}
    | {"grandma", "grandpa", "aunt", "uncle", "dog", "cat", "pet"}
)
_BODY = frozenset(
    {"hand", "finger", "thumb", "arm", "elbow", "face", "eye", "nose", "mouth", "ear", "head"}
    | {"neck", "throat", "chest", "belly", "stomach", "back", "leg", "knee", "foot", "toe"}
    | {"skin", "heart", "shoulder", "wrist", "hair", "body", "chin", "cheek", "palm", "ankle"}
)
CONTACT = frozenset({"poke", "touch", "tap", "press", "contact", "prod", "tickle", "pinch"}
                     | {"scratch", "sting", "jab", "prick", "slap", "strike", "beat", "hurt"}
                     | {"injure", "wound", "attack", "pierce", "spear", "whip", "bite", "choke"}
                     | {"strangle", "slash", "scald", "electrocute", "threaten", "harm", "cut"}
                     | {"slice", "peel", "saw", "drill", "nail", "hammer"})  # fmt: skip
"""Verbs that reach a person's body, besides those of pushing, toppling and doing harm."""
_GIVING = frozenset({"give", "deal", "fetch", "land"})
_BLOWS = frozenset({"hit", "whack", "smack", "kick", "punch", "bash", "stab", "blow", "knock"})
_ON = frozenset({"in", "into", "inside", "on", "onto", "against", "through", "across", "atop"})
_ADVERBS = frozenset({"gently", "hard", "just", "really", "please", "softly", "quickly", "lightly"})


def reaches_someone(linked: Linked, lexicon: Lexicon) -> str | None:
    """The verb that would bring something to bear on a person: "poke me", "stick it in my eye";
    None where things alone are spoken of ("hand me the cup", "push it towards me")."""
    inside = {i for one in linked.spoken if one.mention.objects for i in
              range(one.opened, one.last)}  # fmt: skip
    told = bool(linked.spoken) and linked.spoken[0].opened == 1
    verb = linked.tokens[0].text if told else ""  # known or not: "ram the fork into my leg"
    for at, token in enumerate(linked.tokens):
        if at in inside:
            continue
        kind = lexicon.verb(token.text)
        bears = kind in ("push", "topple", "harmful") or set(stems(token.text)) & CONTACT
        begins = at == 0 or linked.tokens[at - 1].text not in _OWNERS
        if kind is not None and begins:
            verb = token.text
        if bears and begins and _is_struck(at, linked, inside, lexicon):
            return token.text
        if token.text in _GIVING and (blow := _blow(at, linked, inside, lexicon)) is not None:
            return blow
        if verb and token.text in _ON and _person_at(at + 1, linked, inside, lexicon, True):
            return verb
    return None


def _blow(give: int, linked: Linked, inside: set[int], lexicon: Lexicon) -> str | None:
    """ "Give her a good poke": what a person is given."""
    end = _person_at(give + 1, linked, inside, lexicon)
    given = [] if end is None else [token.text for token in linked.tokens[end : end + 4]]
    if given[:1] not in (["a"], ["an"], ["another"], ["one"]):
        return None
    return next((word for word in given[1:] if set(stems(word)) & CONTACT | {word} & _BLOWS), None)


def _is_struck(verb: int, linked: Linked, inside: set[int], lexicon: Lexicon) -> bool:
    """Whether a person is what the verb acts on, not whom it is done for."""
    at = verb + 1
    while at < len(linked.tokens) and linked.tokens[at].text in _ADVERBS:
        at += 1
    end = _person_at(at, linked, inside, lexicon)
    if end is None:
        return False
    gets = any(one.opened == end and one.phrase is not None for one in linked.spoken)
    return not gets  # "push me the cup"


def _person_at(
    at: int, linked: Linked, inside: set[int], lexicon: Lexicon, bodies_only: bool = False
) -> int | None:
    """The token behind a person, or a part of one, that is named at a token."""
    words = [token.text for token in linked.tokens[at : at + 4]]
    if not words or at in inside:
        return None
    if words[0] in _SOMEONE and not (bodies_only or _is_owner(words)):
        return None if words[0] == "them" and linked.spoken else at + 1
    if words[0] not in _OWNERS:
        return None
    for nth, word in enumerate(words[1:3], start=1):
        behind = words[nth + 1] if nth + 1 < len(words) else ""
        if at + nth in inside or word in ("left", "right"):
            return None  # "on my left hand side"
        own = words[0] in _OWN and singular(word) in _BODY and behind != "side"
        person = singular(word.removesuffix("'s")) in PEOPLE and not lexicon.is_noun(behind)
        if own or person:
            return at + nth + 1
    return None


def _is_owner(words: list[str]) -> bool:
    """ "her" in "her hand"."""
    return words[0] == "her" and len(words) > 1 and singular(words[1]) in _BODY | PEOPLE
