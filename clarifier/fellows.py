"""Things spoken of as if they were somebody: "the green dude", "the baby bear", "put him behind the
lamp" (`he_and_she`)."""

from __future__ import annotations

from collections.abc import Sequence

from agent.messages import Focus
from clarifier.he_and_she import as_it
from clarifier.lexicon import Lexicon
from clarifier.pieces import DETERMINERS
from clarifier.things import Thing, is_attribute, side_of, things_of
from clarifier.words import Token, singular, tokenise
from scene.types import Scene


def as_things(text: str, scene: Scene, lexicon: Lexicon, focus: Sequence[Focus] = ()) -> str:
    """The sentence with "it" for "him" and "her", "one" for "dude", "small" for "baby", where
    things of the scene are meant."""
    text = as_it(text, scene, focus, lexicon)
    things, tokens = things_of(scene, lexicon), tokenise(text)
    named = {word for thing in things for word in thing.name}
    other = lexicon.words("fellows") - named
    for at in range(len(tokens) - 1, -1, -1):
        token = tokens[at]
        plain: str | None = None
        if singular(token.text) in other and _is_told_apart(at, tokens, lexicon):
            plain = "one" if token.text in other else "ones"
        elif token.text == "baby" and "baby" not in named:
            plain = "small" if _is_of_several(at, tokens, things) else None
        if plain is not None:
            text = f"{text[: token.start]}{plain}{text[token.end :]}"
    return text


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
