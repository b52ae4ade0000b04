"""A person who knows what they want, and says so when asked: truthfully, in one of ten styles.

What is said comes from the scene and the intent (`evals.naming`), not from how the options are
worded; only an ordinal, a letter or a number goes by the order in which they were put. Where the
question offers nothing that is meant, or is an open one, the command is said once more in full.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Literal, get_args

from agent.messages import Option, Question, Turn
from evals.episodes import Episode
from evals.intents import Meaning, Table, fitting
from evals.naming import MARGIN, descriptions, namesakes
from scene.relations import gap
from scene.types import Scene, SceneObject

Style = Literal[
    "full", "short", "ordinal", "letter", "number", "attribute", "side", "landmark", "sentence",
    "typo",
]  # fmt: skip
"""The red apple; red apple; the second one; b; number two; red; left; the one by the plate; I mean
the red apple; the red aplpe."""
STYLES: tuple[Style, ...] = get_args(Style)
YES = ("yes", "yes please", "yep", "ok", "that's right", "sure", "go ahead", "correct", "do that",
       "yes, do that")  # fmt: skip
NO = ("no", "nope", "no, not that", "no thanks", "that's wrong")
USELESS = ("hmm", "I don't know", "what?", "blah blah", "the thing", "maybe")
"""What a distracted person says instead of an answer."""
_RANKS = ("first", "second", "third", "fourth", "fifth", "sixth")
_NUMBERS = ("one", "two", "three", "four", "five", "six")


class Person:
    """Answers the questions of one dialogue."""

    def __init__(
        self, episode: Episode, table: Table, chance: random.Random, style: Style, noise: float = 0
    ) -> None:
        """``noise``: how often something useless, or another option, is said once instead."""
        self._episode = episode
        self._table = table
        self._chance = chance
        self._style = style
        self._noise = noise
        self._denied = False

    @property
    def meant(self) -> Meaning | None:
        """What the person wants; None where nothing that they said can be done."""
        one = self._episode
        return one.meanings[one.meant] if one.meanings else None

    def answer(self, turn: Turn, scene: Scene) -> str | None:
        """What is said to a question, or to "I don't understand"; None: nothing more."""
        meant = self.meant
        if meant is None:
            return None
        if turn.question is None:
            lost = turn.status == "refused" and turn.reason in ("not_understood", "unknown_word")
            lost = lost or (self._denied and turn.status == "answered")
            self._denied = False
            return meant.said if lost else None
        if self._chance.random() < self._noise:
            self._noise = 0
            return self._chance.choice(USELESS)
        question = turn.question
        at = self.chosen(question, scene)
        if question.kind == "confirm" or (len(question.options) == 1 and at is not None):
            self._denied = at != 0
            return self._chance.choice(NO if self._denied else YES)
        if at is None:
            return meant.said
        return self._worded(meant, question, at, scene)

    def chosen(self, question: Question, scene: Scene) -> int | None:
        """The option that is meant; None if none is."""
        for number, option in enumerate(question.options):
            if self.means(option, scene):
                return number
        return None

    def means(self, option: Option, scene: Scene) -> bool:
        """Whether an option is what is meant: by what it would do, else by what it names."""
        return self._episode.meant in self.comes_to(option, scene)

    def comes_to(self, option: Option, scene: Scene) -> list[int]:
        """Which of the meanings an option comes to: as whatever is done is judged, so that no
        person takes the left plate where it is the other one that ends just as is meant."""
        meanings = self._episode.meanings
        if option.program is None or option.kind is None:
            return [number for number, one in enumerate(meanings) if _named(option, one)]
        done = self._table.check(option.program, option.kind, scene, option.touched)
        if done.plan is None or done.after is None:
            return []
        return fitting(meanings, scene, done.after, done.commands)

    # --- wording ----------------------------------------------------------------------------------

    def _worded(self, meant: Meaning, question: Question, at: int, scene: Scene) -> str:
        """The option that is meant, in the person's style, or the nearest that can be said."""
        by_order = self._by_order(at)
        if question.kind == "how_many" and self._style == "number":
            return f"option {at + 1}"  # "number two" could be two of them
        if self._style in by_order:
            return by_order[self._style]
        if question.kind == "how_many":
            return self._counted(len(question.options[at].objects))
        if meant.words:
            return self._placed(meant)
        ids = question.options[at].objects or meant.picked
        if len(ids) != 1:
            return question.options[at].label
        others = self._others(question, ids[0], scene)
        if not self._described(scene.get(ids[0]), others, scene):
            return question.options[at].label
        return self._thing(scene.get(ids[0]), others, scene)

    def _by_order(self, at: int) -> dict[str, str]:
        if at >= len(_RANKS):
            return {}
        rank, word = _RANKS[at], _NUMBERS[at]
        return {
            "ordinal": self._chance.choice((f"the {rank} one", f"the {rank}", rank)),
            "letter": self._chance.choice((chr(97 + at), chr(65 + at))),
            "number": self._chance.choice((f"number {word}", f"option {at + 1}", str(at + 1))),
        }

    def _counted(self, count: int) -> str:
        word = _NUMBERS[count - 1]
        ways = {"full": f"{word} of them", "short": word, "attribute": str(count), "side": word,
                "landmark": f"just {word}", "sentence": f"take {word} of them, please"}  # fmt: skip
        return ways.get(self._style) or self._slipped(word)

    def _placed(self, meant: Meaning) -> str:
        push = "push" if self._episode.text.lower().find("put") < 0 else "put"
        verb = push if meant.words.startswith(("to", "away")) else "put"
        ways = {"full": meant.words, "short": meant.short, "attribute": meant.short,
                "side": meant.short, "landmark": meant.words,
                "sentence": f"{verb} it {meant.words}"}  # fmt: skip
        return ways.get(self._style) or self._slipped(meant.words)

    def _others(self, question: Question, chosen: str, scene: Scene) -> list[SceneObject]:
        ids = {one for option in question.options for one in option.objects}
        return [scene.get(one) for one in sorted(ids - {chosen})]

    def _thing(self, item: SceneObject, others: Sequence[SceneObject], scene: Scene) -> str:
        """A thing among others, in words that fit no other of them."""
        full = self._chance.choice(self._described(item, others, scene))
        ways: dict[str, str | None] = {
            "full": f"the {full}", "short": full, "attribute": self._attribute(item, others),
            "side": self._side(item, others), "landmark": self._landmark(item, others, scene),
            "sentence": self._chance.choice((
                f"I mean the {full}", f"the {full} is the one I meant", f"take the {full} please",
                f"I meant the {full}, please",
            )), "typo": self._slipped(f"the {full}"),
        }  # fmt: skip
        return ways[self._style] or f"the {full}"

    def _described(
        self, item: SceneObject, others: Sequence[SceneObject], scene: Scene
    ) -> list[str]:
        """Phrases that denote it; which is the second is another matter where not all of its name
        are asked about."""
        every = len(others) + 1 >= len(namesakes(scene, item))
        return [one.text for one in descriptions(scene, item) if every or one.way != "order"]

    def _attribute(self, item: SceneObject, others: Sequence[SceneObject]) -> str | None:
        if not item.color or any(other.color == item.color for other in others):
            return None
        return self._chance.choice((item.color, f"the {item.color} one"))

    def _side(self, item: SceneObject, others: Sequence[SceneObject]) -> str | None:
        if item.x is None or any(other.x is None for other in others):
            return None
        for word, axis, sign in (("left", 0, -1), ("right", 0, 1), ("far", 1, 1), ("near", 1, -1)):
            rest = max((sign * other.position[axis] for other in others), default=-9.0)
            if sign * item.position[axis] >= rest + MARGIN:
                return self._chance.choice((f"the {word} one", f"the one on the {word}")
                                           if axis == 0 else (f"the {word} one",))  # fmt: skip
        return None

    def _landmark(
        self, item: SceneObject, others: Sequence[SceneObject], scene: Scene
    ) -> str | None:
        names = [other.name for other in scene]
        if item.x is None or any(other.x is None for other in others):
            return None
        for mark in scene.objects:
            apart = mark.id != item.id and mark.id not in {other.id for other in others}
            if not apart or names.count(mark.name) > 1:
                continue
            rest = min((gap(other, mark) for other in others), default=9.0)
            if gap(item, mark) + MARGIN <= rest:
                close = gap(item, mark) <= 0.3 and rest > 0.3
                how = "by" if close else "closest to"
                return f"the one {how} the {mark.name}"
        return None

    def _slipped(self, text: str) -> str:
        """The words with two letters of the longest in the wrong order; a short one might become
        another word ("three", "there")."""
        word = max(text.split(), key=len)
        if len(word) < 6:
            return text
        at = self._chance.randrange(1, len(word) - 2)
        swapped = word[:at] + word[at + 1] + word[at] + word[at + 2 :]
        return text.replace(word, swapped, 1)


def _named(option: Option, meaning: Meaning) -> bool:
    """Whether an option without a program names what a meaning takes, or where it goes."""
    picked = meaning.picked and set(option.objects) == set(meaning.picked)
    return bool(picked) or (bool(meaning.words) and option.label == meaning.words)
