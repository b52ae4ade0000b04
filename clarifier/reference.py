"""What a noun phrase denotes on the live scene: the ids of every object it may mean.

Order (clarifier design, "References"): a scene name, a synonym, a class word; never similarity.
Adjectives, sides, ordinals and relations then narrow the set. Nothing is chosen here: a set of
several stays a set of several.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from clarifier.lexicon import Lexicon
from clarifier.located import Link, extreme, narrowed
from clarifier.pieces import Phrase
from clarifier.ranks import by_rank, by_side
from clarifier.sizes import by_size, halfway, nth_in_size
from clarifier.things import (
    Thing,
    is_attribute,
    odd_one,
    same_words,
    several_alike,
    side_of,
    size_of,
    things_of,
)
from clarifier.words import singular
from scene.kinds import is_container
from scene.types import Scene

_MEDIUM = frozenset({"medium", "mid", "middling"})


@dataclass(frozen=True)
class Denotation:
    """The objects a phrase may mean, in scene order, and those of its noun, adjectives aside."""

    objects: tuple[str, ...]
    same_type: tuple[str, ...] = ()


@dataclass(frozen=True)
class Context:
    """What a phrase is read against. ``named`` are ids mentioned earlier in the sentence, by
    themselves; ``grouped`` those mentioned as a group; ``part`` those of which one was counted off
    ("one of the cups"), ``fellows`` all of which a group of several kinds was told by its noun.
    ``standing``: what has a place is meant before what waits in the tray."""

    scene: Scene
    lexicon: Lexicon
    focus: tuple[str, ...] = ()
    named: tuple[str, ...] = ()
    grouped: tuple[str, ...] = ()
    among: tuple[str, ...] | None = None
    part: tuple[str, ...] = ()
    fellows: tuple[str, ...] = ()
    standing: bool = False

    @property
    def things(self) -> tuple[Thing, ...]:
        """The objects that may be meant."""
        every = things_of(self.scene, self.lexicon)
        return every if self.among is None else tuple(t for t in every if t.id in self.among)


def denote(phrase: Phrase, context: Context, links: Sequence[Link] = ()) -> Denotation:
    """Every object that the phrase, narrowed by its relations, may mean."""
    if phrase.also:
        return _any_of_these(phrase, context, links)
    kind = _still_there(of_type(phrase, context), links)
    whatever = phrase.group in ("all", "rest") or _any_thing(phrase, context)
    if context.standing and whatever:
        kind = _placed(kind)
    elif phrase.plural and whatever:
        kind = movable(kind, bool(links))
    found = kind
    many = max(1, int(phrase.count or 1)) if phrase.plural else 1
    for link in links:
        found = narrowed(link, found, context.scene, many)
    if phrase.det in ("other", "others"):
        found = _others(found, context, phrase.plural)
    found = _narrow(phrase, found, context)
    for link in links:
        said = int(phrase.count or 0) if phrase.plural else 1
        found = extreme(link, found, context.scene, said)
    if whatever and not found and not context.standing:
        return denote(phrase, replace(context, standing=True), links)
    found = _placed(found) if context.standing else found
    return Denotation(tuple(t.id for t in found), tuple(t.id for t in kind))


def _any_of_these(phrase: Phrase, context: Context, links: Sequence[Link]) -> Denotation:
    """ "the red and blue cups": what either of the adjectives fits."""
    parts = [
        denote(replace(phrase, modifiers=modifiers, also=()), context, links)
        for modifiers in (phrase.modifiers, *phrase.also)
    ]
    said = {name for part in parts for name in part.objects}
    return Denotation(tuple(t.id for t in context.things if t.id in said), parts[0].same_type)


def _still_there(found: list[Thing], links: Sequence[Link]) -> list[Thing]:
    """Without what fell to the floor, unless all did or the phrase speaks of the floor."""
    standing = [thing for thing in found if thing.item.on != "floor"]
    return found if not standing or any("floor" in link.sides for link in links) else standing


def _any_thing(phrase: Phrase, context: Context) -> bool:
    return bool(phrase.head) and context.lexicon.is_anything(" ".join(phrase.head))


def _placed(found: list[Thing]) -> list[Thing]:
    """Those that do not wait in the tray, unless all do."""
    return [thing for thing in found if thing.item.on != "tray"] or found


def movable(found: list[Thing], placed: bool) -> list[Thing]:
    """What "everything" speaks of: what waits in the tray, while it is no less than what stands on
    the table; else what stands there."""
    waiting = [thing for thing in found if thing.item.on == "tray"]
    standing = [thing for thing in found if thing.item.on != "tray"]
    return standing if placed or len(waiting) < len(standing) else waiting


# --- the noun ------------------------------------------------------------


def of_type(phrase: Phrase, context: Context) -> list[Thing]:
    """The objects of the phrase's noun: by name, else by another word or a wider kind for them or
    for what is inside, else by part."""
    things, lexicon = context.things, context.lexicon
    if phrase.group in ("rest", "others") and context.part:
        return [thing for thing in things if thing.id in context.part]
    if phrase.group == "others" and context.fellows:
        return [thing for thing in things if thing.id in context.fellows]
    if phrase.group in ("all", "rest"):
        return list(things)
    if not phrase.head:
        return _same_type_as_before(phrase, context)
    said = " ".join(phrase.head)
    if lexicon.is_anything(said):
        return list(things)
    noun = " ".join((*phrase.head[:-1], singular(phrase.head[-1])))
    full = (*phrase.modifiers, *phrase.head)
    for rank in (
        lambda t: _named(t, full, phrase.head, phrase.plural),
        lambda t: t.head == noun or said == t.id.lower(),
        lambda t: lexicon.means(said, t.noun) or lexicon.means(said, t.inside) or _toy(noun, t),
        lambda t: not lexicon.is_noun(said) and said in t.name,
    ):
        found = [thing for thing in things if rank(thing)]
        if found:
            literal = _most_literal(found, full, phrase.head)
            return _with_compounds(noun, literal, context)
    return []


def _with_compounds(noun: str, found: list[Thing], context: Context) -> list[Thing]:
    """ "The cup" where an egg cup and a teacup stand: either, however they are written."""
    if any(thing.plain or thing.head != noun for thing in found):
        return found
    alike = [
        thing
        for thing in context.things
        if thing.head.endswith(noun) and context.lexicon.means(noun, thing.noun)
    ]
    return [t for t in context.things if t in found or t in alike]


def _toy(noun: str, thing: Thing) -> bool:
    """ "The toys": a toy drum is one, a toy box holds them."""
    return noun == "toy" and "toy" in thing.extra and not is_container(" ".join(thing.name))


def _named(thing: Thing, full: Sequence[str], head: Sequence[str], plural: bool) -> bool:
    """The phrase ends with the object's whole name, or names its noun and leaves adjectives out;
    "the mugs" are coffee mugs too."""
    if same_words(full[-len(thing.name) :], thing.name):
        return True
    alone = len(head) == 1 and singular(head[-1]) == thing.head
    return alone and (thing.plain or plural)


def _most_literal(found: list[Thing], full: Sequence[str], head: Sequence[str]) -> list[Thing]:
    """Of "mug" and "coffee mug", the one that "coffee mug" names in full."""
    literal = [t for t in found if same_words(full[-len(t.name) :], t.name)]
    if any(len(t.name) >= len(head) > 1 for t in literal):  # "the bronze coin" is no silver coin
        return [t for t in found if set(head[:-1]) <= {*t.name, *t.colors}]
    return [t for t in literal if not t.plain] or found


def _same_type_as_before(phrase: Phrase, context: Context) -> list[Thing]:
    """ "one": a thing of the type last spoken of that fits, else any thing that fits."""
    by_id = {thing.id: thing for thing in context.things}
    fellows = [thing for thing in context.things if thing.id in context.fellows]
    if fellows and not context.named and _narrow(phrase, fellows, context):
        return fellows
    for past in (*reversed(context.named), *context.grouped, *context.focus):
        if past not in by_id:
            continue
        kind = [thing for thing in context.things if thing.head == by_id[past].head]
        left = [thing for thing in kind if thing.id not in context.named]
        if phrase.group == "others" and phrase.plural and not phrase.count and len(left) == 1:
            continue  # "the others" are several: not the only other one of the kind
        if len(kind) > 1 and _narrow(phrase, kind, context):
            return kind
    counts = bool(set(phrase.modifiers) & context.lexicon.words("ordinals"))
    return (several_alike(context.things) if counts else []) or list(context.things)


def _others(found: list[Thing], context: Context, several: bool) -> list[Thing]:
    """Those of the type that were not spoken of: "the other mug", "the rest"."""
    spoken = context.named + (context.grouped if several else ())
    spoken = spoken or (context.focus if several else context.focus[:1])
    return [thing for thing in found if thing.id not in spoken]


# --- adjectives ------------------------------------------------------------


def _narrow(phrase: Phrase, found: list[Thing], context: Context) -> list[Thing]:
    """Keep those that every adjective fits: colours and names first, then sizes, then sides."""
    lexicon = context.lexicon
    spare = [m for m in phrase.modifiers if m not in lexicon.words("vague") or _in_names(m, found)]
    if phrase.head and not lexicon.is_anything(phrase.head[-1]):
        whole = [t for t in found if _full_name(t, phrase)]
        found = whole or found
    rest: list[str] = []
    nth, sized = nth_in_size(spare, lexicon)
    spare = [word for i, word in enumerate(spare) if i not in sized]
    for word in spare:
        told = any(word in thing.colors for thing in found)
        if phrase.plural and lexicon.is_material_kind(word) and not told:
            unnamed = phrase.group == "all" or _any_thing(phrase, context)
            narrowed: list[Thing] | None = _made_of(word, found, lexicon, told_only=unnamed)
        else:
            narrowed = _literal(word, found, lexicon, context)
        if narrowed is None:
            rest.append(word)
        else:
            found = narrowed
    if nth:
        size, many = size_of(nth[1], lexicon), int(phrase.count or 0) if phrase.plural else 1
        found = by_size(size, found, context.scene, many, nth[0])
    for word in sorted(rest, key=lambda w: _order(w, lexicon)):
        found = _comparative(word, phrase, found, context)
    if _MEDIUM & set(spare) and len(found) > 2:
        found = halfway(found, context.scene)
    if "odd" in phrase.modifiers and not _in_names("odd", found):
        found = odd_one(found)
    fond = (m for m in phrase.modifiers if m not in spare and size_of(m, lexicon))
    for word in fond:  # "my little cup" is one of several cups only if it is a small one
        found = _comparative(word, phrase, found, context) if len(found) > 1 else found
    return found


def _full_name(thing: Thing, phrase: Phrase) -> bool:
    return bool(phrase.modifiers) and same_words((*phrase.modifiers, *phrase.head), thing.name)


def _in_names(word: str, found: Sequence[Thing]) -> bool:
    return any(word in thing.name for thing in found)


def _literal(
    word: str, found: list[Thing], lexicon: Lexicon, context: Context
) -> list[Thing] | None:
    """Narrowing by a colour or a word of the names; None for words that need comparison."""
    named = [thing for thing in found if word in thing.name or word in thing.colors]
    named = named or _called_of_size(word, found, lexicon)
    if not named and word in lexicon.colors:
        return [t for t in found if any(lexicon.same_color(word, color) for color in t.colors)]
    if not named and lexicon.material(word)[0]:
        return _made_of(word, found, lexicon)
    named = named or [thing for thing in found if lexicon.means(word, thing.noun)]
    if named:
        return named
    if word in lexicon.words("shades") or is_attribute(word, lexicon):
        return found if word in lexicon.words("shades") else None
    if side_of(word, lexicon) or word in lexicon.words("ordinals"):
        return None
    elsewhere = any(word in thing.name for thing in context.things)
    return [] if elsewhere or (len(found) > 1 and lexicon.is_noun(word)) else found


def _called_of_size(word: str, found: list[Thing], lexicon: Lexicon) -> list[Thing]:
    """Those whose name says the size in another word: "the large cup" is the "big cup"."""
    size = size_of(word, lexicon)
    if not size or word.endswith(("er", "est")):
        return []
    return [t for t in found if any(size_of(part, lexicon) == size for part in t.extra)]


def _made_of(
    word: str, found: list[Thing], lexicon: Lexicon, told_only: bool = False
) -> list[Thing]:
    """Those of a material: by name, else by its colour ("the aluminium can" is the grey one), else
    those of which no other material is said, unless only what is ``told`` counts."""
    material, looks = lexicon.material(word)
    told = [thing for thing in found if material & set(thing.name)]
    untold = [t for t in found if not any(lexicon.material(part)[0] for part in t.extra)]
    if told_only:
        return told
    return told or [thing for thing in untold if looks & thing.colors] or untold


def _order(word: str, lexicon: Lexicon) -> int:
    return 0 if size_of(word, lexicon) else 2 if word in lexicon.words("ordinals") else 1


def _comparative(word: str, phrase: Phrase, found: list[Thing], context: Context) -> list[Thing]:
    lexicon = context.lexicon
    size = size_of(word, lexicon)
    many = int(phrase.count or 0) if phrase.plural else 1
    if size and not (word in lexicon.words("near") and phrase.origin):
        return by_size(size, found, context.scene, many)
    if word in lexicon.words("ordinals"):
        origin = phrase.origin or _implied_origin(phrase, lexicon)
        return by_rank(word, origin, found, context.scene, many)
    return by_side(side_of(word, lexicon), found, context.scene, many)


def _implied_origin(phrase: Phrase, lexicon: Lexicon) -> str:
    return next((s for m in phrase.modifiers if (s := side_of(m, lexicon))), "left")
