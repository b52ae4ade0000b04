"""Episodes played with the product's own turn against a simulated person, and what became of each.

Blocks of episodes are generated and played in processes of their own; the same seed gives the same
results however many there are.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Literal, NamedTuple

from agent.compose import Mind, parts_on, translate
from agent.errors import ArmchatError
from agent.execute import Executor
from agent.messages import Dialog, Turn
from agent.turn import Parts, run_turn
from clarifier.candidates import Outcome
from clarifier.decide import Clarifier, Manner
from evals.episodes import Episode, episodes
from evals.hazards import hazards
from evals.intents import Table, fitting
from evals.outcomes import path_of
from evals.simulated_user import STYLES, Person, Style
from evals.wordings import Group, Sort
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene

BLOCK = 25
"""Episodes that one process generates and plays in one go."""
MAX_QUESTIONS = 2
"""Questions to a person, one to say it another way included, after which nothing is won."""

Did = Literal["act", "ask", "open", "refuse", "answer", "failed"]
"""``open``: a question without options, or "I don't understand, say it another way"."""


class Seen(NamedTuple):
    """An outcome that the clarifier weighed: its probability, which meaning it is (-1: none)."""

    probability: float
    meaning: int


class Reading(NamedTuple):
    """An answer in a style, and whether it was taken for what was meant."""

    style: Style
    right: bool
    said: str


class Result(NamedTuple):
    """One episode played.

    ``meant``: v*; ``size``: how many V has; ``seen``: all outcomes weighed over the command;
    ``later``: the score of what was weighed after an answer that picks; ``named``: whether v* was
    offered by name, to be translated once it is picked. ``first``: what was done at once; ``luck``:
    whether that was what is meant; ``allowed``: whether it is one of V. ``exact``: whether the
    question's options are V, None where there were none. ``succeeded``: within two questions.
    ``ms``: deciding, without translation.
    """

    name: str
    group: Group
    sort: Sort
    text: str
    size: int
    meant: int
    seen: tuple[Seen, ...]
    later: float
    named: bool
    first: Did
    luck: bool
    allowed: bool
    exact: bool | None
    succeeded: bool
    questions: int
    readings: tuple[Reading, ...]
    hazards: tuple[str, ...]
    ms: float
    told: tuple[str, ...]

    @property
    def score(self) -> float:
        """1 - p(the outcome that was meant), 1 if it was never thought of; a dialogue is one
        episode, so the largest over its turns. What is offered by name is sure until it is
        picked: of structure, not of the model."""
        first = 0.0 if self.named else score(self.seen, self.meant)
        return max(first, self.later)

    @property
    def feasible(self) -> bool:
        """Whether anything is to be done at all."""
        return self.size > 0


def score(seen: Sequence[Seen], meant: int) -> float:
    """1 less the probability of what is meant among what was weighed."""
    return 1.0 - max((one.probability for one in seen if one.meaning == meant), default=0.0)


class Job(NamedTuple):
    """Which episodes, and how they are played."""

    episodes: int
    seed: int
    manner: Manner = Manner()
    noise: float = 0.0
    sorts: tuple[Sort, ...] = ()


def play(job: Job, processes: int = 2) -> list[Result]:
    """Play the episodes of a job, in order."""
    blocks = range((job.episodes + BLOCK - 1) // BLOCK)
    if processes == 1:
        return _cut(job, (_block(job, block) for block in blocks))
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        return _cut(job, pool.map(_block, [job] * len(blocks), blocks))


def _cut(job: Job, blocks: Iterator[list[Result]]) -> list[Result]:
    return [result for block in blocks for result in block][: job.episodes]


def _block(job: Job, number: int) -> list[Result]:
    with Executor() as executor:
        found = list(episodes(BLOCK, job.seed * 10_000 + number, executor, job.sorts))
        return [Player(job, executor).play(one) for one in found]


class Player:
    """Plays episodes one by one; listens to what the clarifier weighs."""

    def __init__(self, job: Job, executor: Executor) -> None:
        self._job = job
        self._table = Table(executor)
        self._weighed: list[Outcome] = []
        heard = job.manner._replace(seen=self._weighed.append)
        decide = Clarifier(translate, executor, predict, IdealRobot(), None, heard).decide
        self._mind = Mind(decide, executor, ())

    def play(self, episode: Episode) -> Result:
        """One dialogue from its opening to its end."""
        chance = random.Random(episode.name)
        style = chance.choice(STYLES)
        person = Person(episode, self._table, chance, style, self._job.noise)
        with parts_on(self._mind, episode.scene) as parts:
            return _Dialogue(episode, person, parts, self._table, self._weighed, style).play()


class _Dialogue:
    """One episode on one table."""

    def __init__(
        self, episode: Episode, person: Person, parts: Parts, table: Table,
        weighed: list[Outcome], style: Style,
    ) -> None:  # fmt: skip
        self._episode = episode
        self._person = person
        self._parts = parts
        self._table = table
        self._weighed = weighed
        self._style = style
        self._dialog = Dialog()
        self._turns: list[Turn] = []
        self._told: list[str] = []

    def play(self) -> Result:
        """The opening, the command, and answers as long as something is asked."""
        one = self._episode
        if one.opening is not None:
            self._say(one.opening[0])
        before = self._parts.arm.scene()
        self._weighed.clear()
        opened = len(self._turns)
        turn = self._say(one.text)
        did, exact = _did(turn), self._exact(turn, before)
        seen = tuple(self._seen(outcome, before) for outcome in self._weighed)
        fits = self._fitting(before, [turn])
        named = self._named(turn, before)
        questions, later, readings = 0, 0.0, list[Reading]()
        while questions < MAX_QUESTIONS + 1:
            answer = self._person.answer(turn, before)
            if answer is None:
                break
            questions += 1
            self._weighed.clear()
            asked, turn = turn, self._say(answer)
            if self._named(asked, before) and self._weighed:
                weighed = [self._seen(outcome, before) for outcome in self._weighed]
                later = max(later, score(weighed, one.meant))
            reading = self._reading(asked, turn, answer, before)
            readings += [] if reading is None else [reading]
        ended = self._fitting(before, self._turns[opened:])
        succeeded = turn.status == "done" and one.meant in ended and questions <= MAX_QUESTIONS
        said = " ".join(self._told)
        after = self._parts.arm.scene()
        return Result(
            one.name, one.group, one.sort, one.text, len(one.meanings), one.meant, seen, later,
            named, did, one.meant in fits, bool(fits), exact, succeeded, questions, tuple(readings),
            tuple(hazards(said, one.scene, after)),
            self._turns[opened].ms.decide, tuple(self._log()),
        )  # fmt: skip

    def _say(self, text: str) -> Turn:
        self._told.append(text)
        try:
            turn, self._dialog = run_turn(text, self._dialog, self._parts, task=None)
        except ArmchatError as error:
            turn = Turn(say=text, status="failed", reply=f"{type(error).__name__}: {error}")
        self._turns.append(turn)
        return turn

    def _log(self) -> Iterator[str]:
        for said, turn in zip(self._told, self._turns, strict=True):
            yield f"{said} -> {turn.status}: {turn.reply} {turn.program or ''}"

    def _fitting(self, before: Scene, turns: Sequence[Turn]) -> list[int]:
        """Which meanings what was done fits; none where nothing was done."""
        if not turns or turns[-1].status != "done":
            return []
        after, path = self._parts.arm.scene(), list(path_of(turns))
        return fitting(self._episode.meanings, before, after, path)

    def _seen(self, outcome: Outcome, before: Scene) -> Seen:
        checked = outcome.checked
        if not outcome.ok or checked is None or checked.after is None:
            return Seen(outcome.confidence, -1)
        found = fitting(self._episode.meanings, before, checked.after, checked.commands)
        if self._episode.meant in found:
            return Seen(outcome.confidence, self._episode.meant)
        return Seen(outcome.confidence, found[0] if found else -1)

    def _named(self, turn: Turn, before: Scene) -> bool:
        """Whether v* is among a question's options, by name and without a program of its own."""
        if turn.question is None:
            return False
        bare = [option for option in turn.question.options if option.program is None]
        return any(self._person.means(option, before) for option in bare)

    def _exact(self, turn: Turn, before: Scene) -> bool | None:
        """Whether a question with options offers V, each once and nothing else."""
        if turn.question is None or len(turn.question.options) < 2 or not self._episode.ambiguous:
            return None
        fits = [self._person.comes_to(option, before) for option in turn.question.options]
        covered = {number for found in fits for number in found}
        return all(fits) and len(covered) == len(fits) == len(self._episode.meanings)

    def _reading(self, asked: Turn, turn: Turn, answer: str, before: Scene) -> Reading | None:
        """How an answer that picks one of the options offered was taken."""
        question = asked.question
        if question is None or len(question.options) < 2:
            return None
        if self._person.chosen(question, before) is None:
            return None
        went_on = turn.question is not None and turn.question.text != question.text
        fits = self._fitting(before, [turn])
        return Reading(self._style, self._episode.meant in fits or went_on, answer)


def _did(turn: Turn) -> Did:
    """What a turn comes to for the one who waits for it."""
    if turn.status == "done":
        return "act"
    if turn.status == "failed":
        return "failed"
    if turn.status == "asked":
        return "ask" if turn.question is not None and turn.question.options else "open"
    lost = turn.status == "refused" and turn.reason == "not_understood"
    return "open" if lost else "refuse" if turn.status == "refused" else "answer"
