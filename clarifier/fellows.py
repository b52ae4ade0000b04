"""Things spoken of as if they were somebody: "put him behind the lamp", "the green dude", "the baby
bear".

A thing that was named before is meant by "him", never a person: what is handed, shown or said to
"him", and what hurts, is left as it is, and so is every sentence in which a person is named.
"""

from __future__ import annotations

from collections.abc import Sequence

from clarifier.lexicon import Lexicon
from clarifier.people import CONTACT, PEOPLE
from clarifier.pieces import DETERMINERS, JOINTS
from clarifier.things import Thing, is_attribute, side_of, things_of
from clarifier.words import Token, singular, tokenise
from scene.types import Scene

_OBJECTS = frozenset({"him", "her", "he", "she"})
_SUBJECTS = frozenset({"he", "she"})
_BECOMES = frozenset({"goes", "belongs", "should", "must", "gets"})
_GIVING = frozenset({"give", "hand", "pass", "show", "fetch", "get", "tell", "bring", "ask", "let"})
_BESIDE = frozenset({"behind", "beside", "under", "near", "by", "over", "on", "in", "onto", "into"})
_PARTICLES = frozenset({"up", "down", "over", "off", "away", "back", "out"})
_BEHIND = frozenset(
    {"in", "on", "at", "by", "into", "onto", "to", "behind", "beside", "under", "over", "near"}
    | {"between", "inside", "from", "against", "off", "towards", "toward", "around", "next"}
    | {"up", "down", "away", "back", "out", "there", "here", "left", "right", "upright", "again"}
    | {"please", "gently", "carefully", "straight", "forward", "forwards", "too", "now"}
)
"""What may stand behind "her" where it owns nothing."""


def as_things(text: str, scene: Scene, lexicon: Lexicon) -> str:
    """The sentence with "it" for "him" and "her", "one" for "dude", "small" for "baby", where
    things of the scene are meant."""
    things, tokens = things_of(scene, lexicon), tokenise(text)
    named = {word for thing in things for word in thing.name}
    other = lexicon.words("fellows") - named
    in_company = any(
        singular(token.text.removesuffix("'s")) in PEOPLE - named - other for token in tokens
    )
    said = {token.text for token in tokens}
    in_company = in_company or bool(said & {"he", "him"} and said & {"she", "her"})
    for at in range(len(tokens) - 1, -1, -1):
        token = tokens[at]
        if token.text in _OBJECTS - named and not in_company:
            plain = "it" if _is_thing(at, tokens, things, lexicon) else None
        elif singular(token.text) in other and _is_told_apart(at, tokens, lexicon):
            plain = "one" if token.text in other else "ones"
        elif token.text == "baby" and "baby" not in named:
            plain = "small" if _is_of_several(at, tokens, things) else None
        else:
            plain = None
        if plain is not None:
            text = f"{text[: token.start]}{plain}{text[token.end :]}"
    return text


def _is_thing(at: int, tokens: Sequence[Token], things: Sequence[Thing], lexicon: Lexicon) -> bool:
    """Whether a pronoun of persons stands for what was named before it."""
    said = [token.text for token in tokens]
    word, before = said[at], said[at - 1] if at else ""
    after = said[at + 1] if at + 1 < len(said) else ""
    if not any(_names(token, thing, lexicon) for token in said[:at] for thing in things):
        return False
    if word in _SUBJECTS and after in _BECOMES:
        return True
    if not (after == "" or not after[0].isalnum() or after in _BEHIND | JOINTS):
        return False
    verb = next((w for w in reversed(said[:at]) if lexicon.verb(w) is not None), "")
    hurts = lexicon.verb(verb) == "harmful" or verb in CONTACT or verb in _GIVING
    acted_on = lexicon.verb(before) is not None or before in _PARTICLES
    beside = before in _BESIDE or (before == "to" and said[at - 2 : at - 1] == ["next"])
    return not hurts and (acted_on or beside)


def _names(word: str, thing: Thing, lexicon: Lexicon) -> bool:
    one = singular(word)
    return one == thing.head or (
        lexicon.is_noun(word) and (word in thing.name or lexicon.means(word, thing.noun))
    )


def _is_told_apart(at: int, tokens: Sequence[Token], lexicon: Lexicon) -> bool:
    """ "The green dude", "that other fellow": an adjective stands before it."""
    before = tokens[at - 1].text if at else ""
    told = is_attribute(before, lexicon) or side_of(before, lexicon) != "" or before == "other"
    return told or before in lexicon.words("ordinals")


def _is_of_several(at: int, tokens: Sequence[Token], things: Sequence[Thing]) -> bool:
    """ "The baby bear" of two bears, "the baby one"."""
    after = tokens[at + 1].text if at + 1 < len(tokens) else ""
    led = at > 0 and (tokens[at - 1].text in DETERMINERS or not tokens[at - 1].text[0].isalnum())
    return led and (after == "one" or sum(thing.head == after for thing in things) > 1)
