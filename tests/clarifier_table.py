"""The table, the small honest translator and the conversation that the clarifier's tests share."""

from __future__ import annotations

import re

from agent.messages import (
    Candidate,
    ClarifyRequest,
    Decision,
    Dialog,
    Focus,
    Kind,
    TranslateRequest,
    Translation,
)
from clarifier.decide import Clarifier
from clarifier.lexicon import load_lexicon
from clarifier.mentions import Linked, link
from scene.types import Scene, SceneObject

LEXICON = load_lexicon()


def thing(name, x, y, color=None, *, number=1, size=0.12, tall=0.1, **more):
    """An object of the table; its id is its name and number."""
    object_id = f"{name.replace(' ', '_')}_{number}"
    return SceneObject(
        id=object_id, name=name, x=x, y=y, width=size, height=size, tall=tall, color=color, **more
    )  # fmt: skip


def waiting(name, number=1):
    """An object in the tray."""
    object_id = f"{name.replace(' ', '_')}_{number}"
    return SceneObject(id=object_id, name=name, width=0.12, height=0.12, tall=0.1, on="tray")


TABLE = Scene(
    objects=(
        thing("apple", -0.7, 0.25, "red"),
        thing("apple", 0.3, 0.25, "green", number=2),
        thing("bowl", 0.55, 0.25, size=0.2),
        thing("mug", -0.3, -0.6, "red", size=0.1),
        thing("mug", 0.3, -0.6, "blue", number=2, size=0.1),
        thing("plate", 0.0, 0.75, size=0.3, tall=0.02),
        thing("bottle", 0.75, -0.3, size=0.1, tall=0.3),
        thing("sponge", -0.75, -0.75, size=0.14, tall=0.05),
        thing("red block", -0.3, 0.0),
        thing("green block", 0.0, -0.25),
        thing("yellow block", -0.75, -0.25),
    )
)
"""Two apples, two mugs, three blocks; one bowl, plate, bottle and sponge."""

_LIFT = """robot.move(m1.x, m1.y, 0.9, 0)
robot.move(m1.x, m1.y, m1.z + m1.tall, 0)
robot.grip(True)
robot.move(m1.x, m1.y, 0.9, 0)"""
_SET_DOWN = """
x = {x}
y = {y}
robot.move(x, y, 0.9, 0)
robot.move(x, y, {z}, 0)
robot.grip(False)
robot.move(x, y, 0.9, 0)"""
_PUSH = """robot.move(m1.x + m1.width / 2 + 0.06, m1.y, 0.9, 0)
robot.move(m1.x + m1.width / 2 + 0.06, m1.y, 0.04, 0)
robot.move(m1.x + m1.width / 2 - 0.05, m1.y, 0.04, 0)"""


class SmallTranslator:
    """Knows a few shapes of sentence over m1, m2 and d1; gives up, saying so, on any other."""

    def __init__(self, confidence=0.95, unknown=()):
        self.requests: list[TranslateRequest] = []
        self._confidence = confidence
        self._unknown = unknown

    def __call__(self, request):
        self.requests.append(request)
        body = self._body(request)
        if body is None:
            return Translation((), 0.0, 1.0)
        return Translation((Candidate(body, -0.05, 40),), self._confidence, 1.0, self._unknown)

    def _body(self, request):
        slots = {mention.slot for mention in request.mentions}
        text = request.text.lower()
        if request.kind == "arrange":
            return "solver.addConstraint(m1.x == 0)\nsolver.addConstraint(m1.y == 0)"
        if request.mentions and request.mentions[0].plural:
            return _over_group(slots, text)
        if request.measures and slots == {"m1"}:
            way = "-" if "left" in text else "+"
            turns = request.measures[0].slot == "t1"
            return "turn(m1, -t1)" if turns else f"push(m1, [m1.x {way} d1, m1.y])"
        if slots == {"m1"} and re.search(r"\b(push|shove|slide)\b", text):
            return _PUSH
        if slots == {"m1"} and re.search(r"\b(put|move|place)\b", text):
            x = "-0.7" if "left" in text else "0.7" if "right" in text else "0"
            return _LIFT + _SET_DOWN.format(x=x, y="0.5", z="m1.tall")
        if slots == {"m1"}:
            return _LIFT
        if slots == {"m1", "m2"} and re.search(r"\b(on|in)\b", text):
            return _LIFT + _SET_DOWN.format(x="m2.x", y="m2.y", z="m2.z + m2.tall + m1.tall")
        if slots == {"m1", "m2"}:
            x = "m2.x - m2.width / 2 - m1.width / 2 - 0.05"
            return _LIFT + _SET_DOWN.format(x=x, y="m2.y", z="m1.tall")
        return None


def _over_group(slots, text):
    """Programs over a group m1."""
    if slots == {"m1", "m2"}:
        return "put_all_on(m1, m2)"
    if slots == {"m1"} and re.search(r"\b(row|line)\b", text):
        return "row(m1)"
    if slots == {"m1"} and re.search(r"\b(push|shove|slide)\b", text):
        return "for one in m1:\n    push(one, [one.x - 0.2, one.y])"
    return "for one in m1:\n    touch(one)" if slots == {"m1"} else None


def writes(*bodies, sure=1.0):
    """A translator that writes these programs (body, log-probability) for any sentence, so sure of
    the first."""
    candidates = tuple(Candidate(body, logprob, 9) for body, logprob in bodies)
    return lambda request: Translation(candidates, sure, 1.0)


def linked(text, scene=TABLE, focus=()) -> Linked:
    """The sentence's mentions on the scene; ``focus`` as (id, salience)."""
    return link(text, scene, tuple(Focus(*one) for one in focus), LEXICON)


def named(text, scene=TABLE, focus=()) -> dict[str, tuple[str, ...]]:
    """What each mention denotes, by its text."""
    return {m.text: m.objects for m in linked(text, scene, focus).mentions}


def talk(
    clarifier: Clarifier,
    *turns: str,
    scene: Scene = TABLE,
    dialog: Dialog = Dialog(),  # noqa: B008 - an immutable default
    task: Kind | None = None,
) -> list[Decision]:
    """Say the sentences one after the other; the scene stays as it is."""
    decisions = []
    for text in turns:
        decision = clarifier.decide(ClarifyRequest(text, scene, dialog, task))
        dialog = decision.dialog
        decisions.append(decision)
    return decisions
