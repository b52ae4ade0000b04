"""What may be said of a thing that the scene tells: where it is, how it is, how it compares.

`Predicates.read` turns the words behind "is" into a test of one object. Words that are not read to
the last one are not read at all: whoever decides by a condition must not guess half of it.
"""

from __future__ import annotations

import re

from clarifier.comparing import NOUNS, SIZES, Compared, denied, equal, every, superior
from clarifier.named import Predicate, Test
from clarifier.things import thing_of
from clarifier.whereabouts import Whereabouts
from scene.types import Scene, SceneObject

_ADVERBS = re.compile(
    r"^(?:(?:still|already|currently|now|actually|really|indeed|lying|standing|sitting|located|"
    r"placed|positioned|found|resting|sat|stood|somewhere|to be|kept|just|directly|immediately|"
    r"also|both|all|presently|right now|happily|properly|over|on its own|right(?= (?:next|in|on|"
    r"by|beside|behind|at)\b))\s+)+"
)
_BEHIND = re.compile(
    r"\s+(?:already|now|currently|at present|at the moment|right now|still|please|yet|at all|"
    r"anyway|as well|too|today|by any chance|or not|by now|(?<=thing )there|"
    r"(?<=one )there|(?<=thing )here)$"
)
_DENIED = re.compile(r"^(?:not|no longer|never|anywhere but|anywhere other than|anything but|"
                     r"any colou?r but|other than) (?P<rest>.+)$")  # fmt: skip
_BEARS = re.compile(
    r"^(?:with |got |has |have )?(?P<what>something|anything|nothing|things|"
    r"stuff)(?: else)?(?: already)?(?: lying| standing| sitting)? (?:on|in|inside|on top of|"
    r"upon) (?:it|them|top|there)(?: of it)?$"
)
_STATES: tuple[tuple[re.Pattern[str], str], ...] = (
    (re.compile(r"^(?:(?:completely|totally|quite|all) )?(?:empty|bare|free|clear|vacant|"
                r"unoccupied|not in use)$"), "bare"),
    (re.compile(r"^(?:occupied|taken|in use|loaded)$"), "laden"),
    (re.compile(r"^(?:upright|standing(?: up| upright)?)$"), "upright"),
    (re.compile(r"^(?:(?:lying |resting )?on (?:its|their) sides?|lying down|(?:knocked|tipped|"
                r"fallen|toppled|turned) over|toppled|tipped)$"), "fallen"),
    (re.compile(r"^(?:held|in (?:your|the) (?:gripper|hand|grip)|picked up|being held)$"), "held"),
)  # fmt: skip
_MORE = re.compile(
    r"^(?:(?:any|even|a bit|a little|slightly|still|in fact) )*(?P<degree>more |less |not as |as |"
    r"so )?(?P<adjective>\w+) (?:than|as) (?P<than>.+?)(?: is| are| does)?$"
)
_SAME_SIZE = re.compile(r"^(?:of )?the same (?P<noun>size|height|width|length) as (?P<than>.+)$")
_SAME_HUE = re.compile(r"^(?:of )?the same colou?r as (?P<than>.+)$")
_ONE = re.compile(r"^(?:an?|the|one of the) ")
_MOST = re.compile(
    r"^the (?P<most>\w+est)(?: one)?(?: of (?:all|them all|the lot|all of them|the two|them|"
    r"the three)| on the table)?$"
)


class Predicates(Whereabouts):
    """Reads predicates on one scene; ``it`` is what "it" stands for."""

    def read(self, said: str) -> Predicate | None:
        """The test that a predicate stands for, "not" included; None for what cannot be read."""
        said = _BEHIND.sub("", said.strip(" ,.;:!?").lower())
        unread = _DENIED.match(said)
        if unread is not None and not said.startswith("not as "):
            found = self.read(unread["rest"])
            if found is None:
                return None
            test = found.test
            return found._replace(test=lambda item: denied(test(item)))
        rules = (self._state, self._colour, self.further_to, self.nearer_to, self.at_distance,
                 self._compared, self.placed, self._kind)  # fmt: skip
        for text in dict.fromkeys((said, _ADVERBS.sub("", said))):
            for rule in rules:
                found = rule(text)
                if found is not None:
                    return found
        return None

    # --- what things are like ----------------------------------------------------------------

    def _state(self, said: str) -> Predicate | None:
        bears = _BEARS.match(said)
        state = next((name for pattern, name in _STATES if pattern.match(said)), "")
        if bears is not None:
            state = "bare" if bears["what"] == "nothing" else "laden"
        tests: dict[str, Test] = {
            "bare": lambda item: not self._carries(item), "laden": self._carries,
            "upright": lambda item: item.upright, "fallen": lambda item: not item.upright,
            "held": lambda item: item.held or item.on == "gripper",
        }  # fmt: skip
        return Predicate(tests[state], holder=state in ("bare", "laden")) if state else None

    def _carries(self, item: SceneObject) -> bool:
        return any(other.on == item.id for other in self.scene)

    def _colour(self, said: str) -> Predicate | None:
        same = _SAME_HUE.match(said)
        if same is not None:
            other = self.single(same["than"])
            return None if other is None else Predicate(
                lambda item: self._shares(item, thing_of(other, self.lexicon).colors), (other.id,)
            )  # fmt: skip
        said = re.sub(r"^(?:an?|in|of|coloured|colored|painted|of colou?r) ", "", said)
        said = re.sub(r" (?:in|of|by) colou?r$| colou?red$| ones?$|^colou?r ", "", said)
        hues = frozenset(re.split(r",? or |, ", said))
        if not hues <= self.lexicon.colors:
            return None
        return Predicate(lambda item: self._shares(item, hues))

    def _shares(self, item: SceneObject, hues: frozenset[str]) -> bool | None:
        own = thing_of(item, self.lexicon).colors
        if not own or not hues:
            return None
        alike = any(self.lexicon.same_color(one, hue) for one in own for hue in hues)
        return alike or bool(own & hues)

    def _compared(self, said: str) -> Predicate | None:
        """ "taller than the jug", "as long as the pen", "the same height as it"."""
        same, more = _SAME_SIZE.match(said), _MORE.match(said)
        match = same or more
        if match is None:
            return None
        by = self._size(more["adjective"]) if more is not None else None
        by = NOUNS[same["noun"]] if same is not None else by
        named = self.named(match["than"])
        if by is None or named is None or not (named.several or len(named.objects) == 1):
            return None
        degree = "same" if same is not None else ((more and more["degree"]) or "").strip()
        others = [self.scene.get(object_id) for object_id in named.objects]
        return Predicate(
            lambda item: every(_by_degree(degree, by, item, other, self.scene) for other in others
                               if other.id != item.id), named.objects,
        )  # fmt: skip

    def _size(self, word: str) -> Compared | None:
        """What an adjective compares: "taller", "tall" behind "more"."""
        bases = (word, word.removesuffix("er"), word.removesuffix("r"), word.removesuffix("est"),
                 word.removesuffix("st"), word[:-3] if len(word) > 5 else word,
                 f"{word.removesuffix('ier')}y", f"{word[:-4]}" if word.endswith("est") else word,
                 f"{word.removesuffix('iest')}y")  # fmt: skip
        return next((SIZES[base] for base in bases if base in SIZES), None)

    def _kind(self, said: str) -> Predicate | None:
        """ "a mug", "the leftmost cup", "the biggest": what the words can mean."""
        most = _MOST.match(said)
        by = self._size(most["most"]) if most is not None else None
        if by is not None:
            return Predicate(lambda item: self._is_most(item, by))
        bare = re.match(r"^\w+est \w", said) is not None
        whole = f"the {said}" if bare else said
        named = self.named(whole) if _ONE.match(whole) and most is None else None
        if named is None or not named.objects:
            return None
        sure = len(named.objects) == 1 or said.startswith(("a", "one"))
        return Predicate(lambda item: (None if not sure else True) if item.id in named.objects
                         else False)  # fmt: skip

    def _is_most(self, item: SceneObject, by: Compared) -> bool | None:
        """Whether it is the largest (...) of its kind, or of all where it is the only one of it."""
        head = thing_of(item, self.lexicon).head
        rest = [other for other in self.scene if other.id != item.id]
        alike = [other for other in rest if thing_of(other, self.lexicon).head == head]
        return every(superior(by, item, other, self.scene) for other in alike or rest)


def _by_degree(
    degree: str, by: Compared, item: SceneObject, other: SceneObject, scene: Scene
) -> bool | None:
    if degree in ("", "more"):
        return superior(by, item, other, scene)
    if degree == "less":
        return superior(by._replace(less=not by.less), item, other, scene)
    if degree == "same":
        return equal(by, item, other, scene)
    smaller = superior(by._replace(less=not by.less), item, other, scene)
    return smaller if degree == "not as" else denied(smaller)
