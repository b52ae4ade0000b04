"""The scene's objects as they can be talked about: words of the name, head noun, colours."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from clarifier.lexicon import SIZES, Lexicon
from clarifier.words import singular, words
from scene.types import Scene, SceneObject

_MADE_FOR = frozenset({"flower", "plant", "gift", "hand", "school"})
"""Before "pot" or "bag" these do not tell what is in it."""


@dataclass(frozen=True)
class Thing:
    """An object and its name: ``name`` its words, ``head`` the noun, ``extra`` the other words.

    ``noun`` is what kind of thing that is in the lexicon's words ("flower pot"), ``inside`` what a
    name tells of what is in it ("soup" in "can of tomato soup"), or empty. ``plain`` is true if
    every other word is a colour, a material or a size ("red cube" is a kind of cube, "coffee mug"
    has a noun of its own).
    """

    item: SceneObject
    name: tuple[str, ...]
    head: str
    extra: tuple[str, ...]
    colors: frozenset[str]
    plain: bool
    noun: str
    inside: str

    @property
    def id(self) -> str:
        """The object's id."""
        return self.item.id


def thing_of(item: SceneObject, lexicon: Lexicon) -> Thing:
    """How an object can be talked about."""
    return Thing(item, *_called(item.name, item.color or "", lexicon))


@lru_cache(maxsize=1024)
def _called(
    full: str, color: str, lexicon: Lexicon
) -> tuple[tuple[str, ...], str, tuple[str, ...], frozenset[str], bool, str, str]:
    """What a name and a colour tell of a thing: its fields behind ``item``."""
    name = words(full) or (full.strip().lower(),)
    at = next((i - 1 for i, word in enumerate(name) if i and word in ("of", "with")), len(name) - 1)
    extra = name[:at] + name[at + 1 :]
    colors = frozenset(words(color)) | (set(extra) & lexicon.colors)
    plain = all(is_attribute(word, lexicon) for word in extra)
    whole = " ".join(name)
    noun = whole if lexicon.is_noun(whole) else lexicon.noun_in(name[: at + 1])
    holding = name[at] in lexicon.words("holding") and not _MADE_FOR & set(name[:at])
    inside = name[at + 2 :] or (name[:at] if holding and not plain else ())
    return name, singular(name[at]), extra, colors, plain, noun, lexicon.noun_in(inside)


def things_of(scene: Scene, lexicon: Lexicon) -> tuple[Thing, ...]:
    """Every object of the scene, table first, then tray."""
    return tuple(thing_of(item, lexicon) for item in scene)


def is_attribute(word: str, lexicon: Lexicon) -> bool:
    """Whether the word is a colour, a shade, a material or a size."""
    known = word in lexicon.colors or word in lexicon.words("shades")
    return known or bool(lexicon.material(word)[0]) or size_of(word, lexicon) != ""


def size_of(word: str, lexicon: Lexicon) -> str:
    """The size class of an adjective ("largest" -> "big"); empty for other words."""
    return next((name for name in SIZES if word in lexicon.words(name)), "")


def side_of(word: str, lexicon: Lexicon) -> str:
    """The side of the table that an adjective names ("rightmost" -> "right"), or empty."""
    sides = ("left", "right", "far", "near", "middle", "outer")
    return next((name for name in sides if word in lexicon.words(name)), "")


def same_words(said: Sequence[str], name: Sequence[str]) -> bool:
    """Whether two runs of words are one name, number of the last word aside."""
    if len(said) != len(name) or tuple(said[:-1]) != tuple(name[:-1]):
        return False
    return said[-1] == name[-1] or singular(said[-1]) in (name[-1], singular(name[-1]))


def odd_one(found: list[Thing]) -> list[Thing]:
    """ "The odd one out": of one colour where all others of its kind are of another; all where
    there is none such."""
    odd = []
    for thing in found:
        kind = [other for other in found if other.head == thing.head and other is not thing]
        others = {other.colors for other in kind}
        if len(kind) > 1 and len(others) == 1 and thing.colors not in others:
            odd.append(thing)
    return odd or found


def several_alike(things: Sequence[Thing]) -> list[Thing]:
    """Those of the one kind of which there are several: what "the second one" counts."""
    kinds = Counter(thing.head for thing in things)
    several = [kind for kind, count in kinds.items() if count > 1]
    return [t for t in things if t.head == several[0]] if len(several) == 1 else []
