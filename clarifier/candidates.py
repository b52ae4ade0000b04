"""From one translation over slots to checked programs over the scene, one for each binding.

Ladder rules 4 to 7 (clarifier design): what does not parse or run is dropped, what does not use
exactly the things that were mentioned is vetoed, what is unsafe or out of reach is refused.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import msgspec

from agent.check import Checked, Predict, Workspace, check
from agent.execute import Executor
from agent.messages import Candidate, Kind, Problem, Quantity, TranslateRequest, Translation
from agent.program import instantiate
from clarifier.binding import Binding, bound_objects
from clarifier.bodies import may_stand, slots_in, turned_once
from clarifier.conformal import PRODUCT, Policy
from clarifier.figures import drawn, sized
from clarifier.formed import spaced, turned
from clarifier.if_words import depends_on_more
from clarifier.matching import twin
from clarifier.measures import quantities
from clarifier.motions import does_the_same, raised, same_way
from clarifier.phrases import alone
from clarifier.put_there import put_there
from clarifier.spoken import Linked
from clarifier.stated import Goal, as_stated, orders, stated, ways
from clarifier.told_apart import told_apart
from clarifier.vetoes import Tried, mistaken, problem_of
from scene.relations import moved
from scene.types import Pose, Scene, identifiers

Translate = Callable[[TranslateRequest], Translation]

LEAST = 0.25
"""Least confidence of the first candidate alone; below, nothing is even tried."""
NOT_SURE = "I'm not sure what you want me to do. Could you say it another way?"
SURE = 0.9
"""Confidence from which on a program may leave out a thing that the sentence names."""
SURE_OF_CONDITION = 0.95
"""Confidence from which on a program's own condition is trusted; the scene could not answer it."""
HANDLING = frozenset({"pick", "touch", "push", "turn", "topple", "trace"})
"""Classes of verbs that need the arm; others may only say where things are to be."""
CANDIDATES = 4
"""Candidates asked of the translator."""
START = Pose(0.0, -1.2, 0.9, 0.0)
"""Where the arm is taken to begin: where one waits. The agent checks again from where it is."""


@dataclass(frozen=True)
class Outcome:
    """What one binding leads to: a program that may run, or the problem that forbids it.

    ``used`` is the part of the binding that the program speaks of; ``unsure``: less confidence
    than is acted on.
    """

    binding: Binding
    used: Binding
    checked: Checked | None
    problem: Problem | None
    confidence: float
    unsure: bool = False

    @property
    def ok(self) -> bool:
        """Whether the program may run."""
        return self.problem is None

    @property
    def touched(self) -> tuple[str, ...]:
        """Everything that the program may move: what the sentence names but it does not, stays."""
        return bound_objects(self.used)


@dataclass(frozen=True)
class Reading:
    """A sentence translated once: its candidates that survive the veto, best first."""

    linked: Linked
    kind: Kind
    translation: Translation
    candidates: tuple[Candidate, ...]
    measures: tuple[Quantity, ...] = ()

    def confidence(self, candidate: Candidate) -> float:
        """The translation's confidence, less for a candidate that is not its first."""
        first = self.translation.candidates[0]
        worse = math.exp(min(0.0, candidate.logprob - first.logprob))
        return self.translation.confidence * worse


Seen = Callable[[Outcome], None]


def unheard(outcome: Outcome) -> None:
    """Nobody listens."""


SURELY: Mapping[str, float] = MappingProxyType({})
"""No place is uncertain."""


class Planner:
    """Translates and checks; everything slow or physical is passed in."""

    def __init__(
        self, translate: Translate, executor: Executor, predict: Predict, workspace: Workspace,
        policy: Policy = PRODUCT, seen: Seen = unheard, sd: Mapping[str, float] = SURELY,
    ) -> None:  # fmt: skip
        """``policy``: from when on is acted or asked; ``seen`` is told of every outcome; ``sd``:
        how uncertain the scene's places are (`agent.check`)."""
        self.policy = policy
        self._seen = seen
        self._translate = translate
        self._executor = executor
        self._predict = predict
        self._workspace = workspace
        self._sd = sd
        self.ms = 0.0
        self._known: dict[TranslateRequest, Translation] = {}

    def read(self, linked: Linked, kind: Kind, scene: Scene) -> Reading:
        """Translate the sentence over its slots and apply the veto. Raises TranslatorError."""
        measures = quantities(linked, scene)
        request = TranslateRequest(
            linked.text, linked.mentions, kind, CANDIDATES, measures, alone(linked)
        )
        translation = self._translated(request)
        slots = (*linked.slots, *(measure.slot for measure in measures))
        whole = Reading(linked, kind, translation, translation.candidates, measures)
        bodies = (
            sized(spaced(one.body, linked.text, measures), linked.text, measures)
            for one in translation.candidates
        )
        kept = tuple(
            msgspec.structs.replace(candidate, body=body)
            for candidate, body in zip(translation.candidates, bodies, strict=True)
            if may_stand(body, linked, slots, whole.confidence(candidate) > SURE)
        )
        return replace(whole, candidates=kept)

    def _translated(self, request: TranslateRequest) -> Translation:
        """The translation, asked for once a turn; its time is added up."""
        if request not in self._known:
            self._known[request] = self._translate(request)
            self.ms += self._known[request].ms
        return self._known[request]

    def outcome(self, reading: Reading, binding: Binding, scene: Scene) -> Outcome:
        """The likeliest outcome of the reading's programs for one binding."""
        found = self.clusters(reading, binding, scene)
        return found[0] if found else self.lost(binding)

    def lost(self, binding: Binding) -> Outcome:
        """What a binding comes to for which no candidate is a program at all."""
        missing = Problem("not_understood", "I did not understand that well enough to act on it.")
        return Outcome(binding, {}, None, missing, 0.0)

    def clusters(self, reading: Reading, binding: Binding, scene: Scene) -> list[Outcome]:
        """What the reading's programs come to for one binding, likeliest first.

        Programs that do the same on this scene are one outcome, their probabilities added up
        (clarifier design, "Candidates, clusters, permutation"). Once one is sure, the rest is not
        run. Where the sentence says how things are to end, a program that ends otherwise is
        dropped, those that do so with the same things are one, and one that may run comes before
        one that may not.
        """
        values = program_values(reading, binding, scene)
        goals = stated(reading.linked, binding, scene)
        said = ways(goals)
        found: list[Outcome] = []
        dropped: list[Candidate] = []
        for written in reading.candidates:
            body = turned_once(turned(written.body, goals), reading.linked.text)
            body = put_there(drawn(told_apart(body, reading.linked.text), goals), goals)
            candidate = msgspec.structs.replace(written, body=body)
            if any(one.confidence >= SURE and (one.ok or not said) for one in found):
                break
            outcome = self._tried(reading, candidate, binding, values, scene)
            ends = None if outcome.checked is None else outcome.checked.after
            if outcome.problem is not None and outcome.problem.reason == "bad_program":
                continue
            if ends is None or as_stated(goals, scene, ends):
                found = self._joined(found, outcome, reading, scene, said)
            else:
                dropped.append(candidate)
        if orders(goals):
            found = _inherited(_with_twins(found, dropped, reading, values), dropped, reading)
        ranked = sorted(found, key=lambda one: (bool(said) and _gives_way(one), -one.confidence))
        for one in ranked:
            self._seen(one)
        return ranked

    def _tried(
        self, reading: Reading, candidate: Candidate, binding: Binding, values: Mapping[str, str],
        scene: Scene,
    ) -> Outcome:  # fmt: skip
        """What one candidate comes to, with its own probability."""
        named = slots_in(candidate.body)
        used = {slot: ids for slot, ids in binding.items() if slot in named}
        program = instantiate(candidate.body, values)
        checked = self._in_the_air(program, reading.kind, scene, bound_objects(used))
        tried = Tried(reading.linked, candidate.body, program, binding, scene, checked)
        sure = self._sure_of(tried, reading.confidence(candidate))
        return Outcome(binding, used, checked, problem_of(tried), sure)

    def _sure_of(self, tried: Tried, sure: float) -> float:
        """The probability of a program that the translation is so ``sure`` of: none where it does
        something else than is meant, no more than is asked about where it answers a condition."""
        if mistaken(tried):
            return 0.0
        if tried.ends and depends_on_more(tried.text) and sure < SURE_OF_CONDITION:
            return min(sure, self.policy.ask)
        return sure

    def _in_the_air(
        self, program: str, kind: Kind, scene: Scene, touched: Sequence[str]
    ) -> Checked:  # fmt: skip
        """The program checked; one that only traces and would meet something, above everything."""
        checked = self.check(program, kind, scene, touched)
        higher = raised(program, scene) if checked.after != scene else None
        return checked if higher is None else self.check(higher, kind, scene, touched)

    def _joined(
        self, found: list[Outcome], outcome: Outcome, reading: Reading, scene: Scene,
        goals: tuple[Goal, ...],
    ) -> list[Outcome]:  # fmt: skip
        """The outcomes with one more, which counts for the first that does the same."""
        for number, other in enumerate(found):
            if (
                self.alike(other, outcome, scene)
                or _as_said(other, outcome, scene, goals)
                or _goes_alike(other, outcome, scene, reading.linked.text)
            ):
                sure = min(1.0, other.confidence + outcome.confidence)
                return [*found[:number], replace(other, confidence=sure), *found[number + 1 :]]
        return [*found, outcome]

    def alike(self, one: Outcome, other: Outcome, scene: Scene) -> bool:
        """Whether two outcomes are one and the same to the person."""
        return one.checked is not None and other.checked is not None and does_the_same(
            one.checked, other.checked, scene
        )  # fmt: skip

    def check(
        self, program: str, kind: Kind, scene: Scene, touched: Sequence[str] | None
    ) -> Checked:
        """The program checked on the scene as it is."""
        return check(
            program, kind, scene, executor=self._executor, predict=self._predict,
            workspace=self._workspace, start=START, touched=touched, doubt=self._sd,
        )  # fmt: skip


def kinds_of(linked: Linked, scene: Scene, task: Kind | None) -> tuple[Kind, ...]:
    """Of which kinds a program may be, to be tried in this order. Where only what waits in the
    tray is to go somewhere, its places may be unknowns, to be solved together; else everything
    stands or waits somewhere, from where the arm takes it. The task asked for decides where
    nothing is mentioned.
    """
    waiting = {item.id for item in scene.tray}
    mentioned = {o for mention in linked.mentions for o in mention.objects}
    if not mentioned:
        return (task or "manipulate",)
    themes = [one for one in linked.spoken if one.theme]
    standing = any(set(one.mention.objects) - waiting for one in themes)
    handled = bool(themes) and all(one.verb in HANDLING for one in themes)
    arm = standing or handled or not mentioned & waiting
    return ("manipulate",) if arm else ("arrange", "manipulate")


def doubt(reading: Reading, unimportant: frozenset[str]) -> str | None:
    """Why the reading as a whole is not to be acted on; None if it is (before any binding)."""
    words = [w for w in reading.translation.unknown if w not in unimportant and not slots_in(w)]
    if words:
        said = " or ".join(f"“{word}”" for word in dict.fromkeys(words))
        return f"I don't know what {said} means here. Could you say it another way?"
    if not reading.candidates or reading.confidence(reading.candidates[0]) < LEAST:
        return NOT_SURE
    return None


def _as_said(one: Outcome, other: Outcome, scene: Scene, goals: tuple[Goal, ...]) -> bool:
    """Whether two outcomes that are as was said of the end move the same things."""
    if not goals or one.checked is None or other.checked is None:
        return False
    ends = one.checked.after, other.checked.after
    return None not in ends and len({frozenset(_shifted(scene, end)) for end in ends if end}) == 1


def _goes_alike(one: Outcome, other: Outcome, scene: Scene, text: str) -> bool:
    """Whether two outcomes that may run and move nothing take the tool the same way."""
    if not (one.ok and other.ok) or one.checked is None or other.checked is None:
        return False
    return same_way(one.checked, other.checked, scene, text)


def _inherited(
    found: Sequence[Outcome], dropped: Sequence[Candidate], reading: Reading
) -> list[Outcome]:
    """The outcomes with the probability of the candidates that the said order rules out, by their
    own shares; none is surer than the translation was of its first."""
    lost = sum(math.exp(candidate.logprob) for candidate in dropped)
    first = math.exp(reading.translation.candidates[0].logprob)
    more = max(1.0, first / max(1.0 - lost, first * 0.01)) if dropped else 1.0
    most = reading.translation.confidence
    return [replace(one, confidence=max(one.confidence, min(most, more * one.confidence)))
            for one in found]  # fmt: skip


def _with_twins(
    found: Sequence[Outcome], dropped: Sequence[Candidate], reading: Reading,
    values: Mapping[str, str],
) -> list[Outcome]:  # fmt: skip
    """The outcomes with the confidence in what goes by the other of the same colour and another:
    which of the two is meant is said outright, that one of them is, both speak for."""
    more = {instantiate(other, values): reading.confidence(one)
            for one in dropped if (other := twin(one.body)) is not None}  # fmt: skip
    return [
        one if one.checked is None or one.checked.program not in more
        else replace(one, confidence=min(1.0, one.confidence + more[one.checked.program]))
        for one in found
    ]  # fmt: skip


def _gives_way(one: Outcome) -> bool:
    """Whether another way to the same end is to be tried first."""
    return one.problem is not None and one.problem.reason != "impossible"


def _shifted(before: Scene, after: Scene) -> set[str]:
    ends = {item.id: item for item in after}
    return {item.id for item in before if item.id in ends and moved(item, ends[item.id]) > 0}


def program_values(reading: Reading, binding: Binding, scene: Scene) -> dict[str, str]:
    """What each slot is in a program over the scene's names: a name, a list of names, a number."""
    names = {item.id: name for name, item in identifiers(scene).items()}
    values = {}
    for slot, objects in binding.items():
        several = reading.linked.first(slot).mention.plural
        listed = ", ".join(names[o] for o in objects)
        values[slot] = f"[{listed}]" if several else listed
    for measure in reading.measures:
        number = f"{measure.value:.6g}"
        values[measure.slot] = f"({number})" if measure.value < 0 else number
    return values
