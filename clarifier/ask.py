"""Questions: the shortest label that tells an option apart, and how the question is worded."""

from __future__ import annotations

from collections.abc import Sequence

from agent.messages import Option
from clarifier.lexicon import Lexicon
from clarifier.mentions import link_answer
from clarifier.things import Thing, thing_of
from clarifier.words import article, listing, number_word, plural, singular
from scene import relations
from scene.types import Scene

MAX_OPTIONS = 6
"""More options than this are not read out."""
MAX_OFFERED = 12
"""Most options of a question."""


def labels(objects: Sequence[str], scene: Scene, lexicon: Lexicon) -> dict[str, str]:
    """For each object the shortest description that denotes it alone on the scene, with "the".

    Kinds of description, in order: type, colour, size, landmark, side, order; one kind for all
    objects of a name where it can be done. Falls back on the id.
    """
    found: dict[str, str] = {}
    for object_id in objects:
        if object_id not in found:
            name = scene.get(object_id).name
            found |= _labels_of([item.id for item in scene if item.name == name], scene, lexicon)
    return {object_id: found[object_id] for object_id in objects}


def _labels_of(objects: Sequence[str], scene: Scene, lexicon: Lexicon) -> dict[str, str]:
    """Labels of all objects that bear one name."""
    things = [thing_of(scene.get(object_id), lexicon) for object_id in objects]
    for describe in (_by_type, _by_color, _by_size, _by_landmark, _by_side, _by_order):
        found = {thing.id: describe(thing, things, scene) for thing in things}
        if all(found.values()) and _tell_apart(found, scene, lexicon):
            return {name: f"the {label}" for name, label in found.items()}
    return {thing.id: _alone(thing, things, scene, lexicon) for thing in things}


def _alone(thing: Thing, things: Sequence[Thing], scene: Scene, lexicon: Lexicon) -> str:
    """The first kind of description that does for one object when none does for all."""
    for describe in (_by_type, _by_color, _by_size, _by_side, _by_landmark, _by_order):
        label = describe(thing, things, scene)
        if label and _denotes(label, thing.id, scene, lexicon):
            return f"the {label}"
    return f"the {thing.item.name} ({thing.id})"


def _tell_apart(found: dict[str, str], scene: Scene, lexicon: Lexicon) -> bool:
    distinct = len(set(found.values())) == len(found)
    return distinct and all(_denotes(label, name, scene, lexicon) for name, label in found.items())


def _denotes(label: str, object_id: str, scene: Scene, lexicon: Lexicon) -> bool:
    """Whether the label, said as an answer, means that object alone."""
    spoken = link_answer(f"the {label}", scene, lexicon).spoken
    return len(spoken) == 1 and spoken[0].mention.objects == (object_id,)


def _by_type(thing: Thing, things: Sequence[Thing], scene: Scene) -> str:
    return thing.item.name


def _by_color(thing: Thing, things: Sequence[Thing], scene: Scene) -> str:
    color = thing.item.color
    if color is None or color in thing.item.name.split():
        return thing.item.name if thing.colors else ""
    return f"{color} {thing.item.name}"


def _by_size(thing: Thing, things: Sequence[Thing], scene: Scene) -> str:
    if len(things) != 2:
        return ""
    size = [t.item.width * t.item.height * t.item.tall for t in things]
    big = things[0] if size[0] > size[1] else things[1]
    return f"{'big' if thing is big else 'small'} {thing.item.name}"


def _by_landmark(thing: Thing, things: Sequence[Thing], scene: Scene) -> str:
    """ "apple by the plate": next to one thing whose name is unique and which is not an option."""
    if thing.item.x is None:
        return ""
    options = {t.id for t in things}
    names = [item.name for item in scene]
    near = [
        item
        for item in scene.objects
        if item.id not in options
        and names.count(item.name) == 1
        and relations.next_to(scene, thing.item, item)
    ]
    return f"{thing.item.name} by the {near[0].name}" if len(near) == 1 else ""


def _by_side(thing: Thing, things: Sequence[Thing], scene: Scene) -> str:
    """ "left apple", "middle apple", "far apple": along the axis that parts the options most."""
    if any(t.item.x is None for t in things) or len(things) > 3:
        return ""
    spans = [
        max(t.item.position[axis] for t in things) - min(t.item.position[axis] for t in things)
        for axis in (0, 1)
    ]
    axis = 0 if spans[0] >= spans[1] * 0.7 else 1
    order = sorted(things, key=lambda t: t.item.position[axis])
    words = (("left", "right"), ("near", "far"))[axis]
    at = order.index(thing)
    word = words[0] if at == 0 else words[1] if at == len(order) - 1 else "middle"
    return f"{word} {thing.item.name}"


def _by_order(thing: Thing, things: Sequence[Thing], scene: Scene) -> str:
    """ "second apple from the left"."""
    if any(t.item.x is None for t in things) or len(things) > 6:
        return ""
    order = sorted(things, key=lambda t: t.item.position[0])
    rank = ("first", "second", "third", "fourth", "fifth", "sixth")[order.index(thing)]
    return f"{rank} {thing.item.name} from the left"


# --- wording ------------------------------------------------------------


def which_text(noun: str, options: Sequence[str]) -> str:
    """ "Which apple do you mean: the left apple or the right apple?" """
    if len(options) > MAX_OPTIONS:
        return f"I can see {number_word(len(options))} of them. Which {noun} do you mean?"
    return f"Which {noun} do you mean: {listing(options, 'or')}?"


def inventory(scene: Scene, lexicon: Lexicon, skip: Sequence[str] = ()) -> str:
    """What is there, in words: "a bottle, two apples and a red cup"."""
    counts: dict[str, int] = {}
    for item in scene:
        if item.id not in skip:
            counts[item.name] = counts.get(item.name, 0) + 1
    parts = [article(name) if n == 1 else f"{number_word(n)} {many(name)}" for name, n in
             counts.items()]  # fmt: skip
    return listing(parts)


def many(name: str) -> str:
    """The plural of a name of several words."""
    head, _, last = name.rpartition(" ")
    return f"{head} {plural(last)}".strip()


def numbered(text: str, options: Sequence[Option]) -> str:
    """The question once more, its options numbered."""
    lines = ", ".join(f"{i} {option.label}" for i, option in enumerate(options, start=1))
    return f"{text} Please choose: {lines}." if lines else text


def alike(noun: str, pool: Sequence[str], scene: Scene, lexicon: Lexicon) -> tuple[str, ...]:
    """Those of the pool that are much like what was said: to be offered, never to be taken."""
    words = lexicon.alike(singular(noun)) | lexicon.alike(noun)
    things = [thing_of(scene.get(object_id), lexicon) for object_id in pool]
    return tuple(t.id for t in things if t.head in words or " ".join(t.name) in words)


def there_is(scene: Scene, lexicon: Lexicon, skip: Sequence[str]) -> str:
    """ "is a cup", "are a cup and two plates": what is there besides ``skip``."""
    seen = inventory(scene, lexicon, skip) or "nothing else"
    one = " and " not in seen and seen.startswith(("a ", "an ", "nothing"))
    return f"{'is' if one else 'are'} {seen}"


def examples(options: Sequence[Option]) -> str:
    """The options' labels behind a colon; nothing where there are none."""
    return f": {listing([option.label for option in options], 'or')}" if options else ""
