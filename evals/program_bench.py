"""`armchat bench program`: the figures of the little language and its worker, all layers on."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import random
import signal
import threading
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import msgspec

from agent.compose import table
from agent.errors import LimitReached, NotAllowed, ProgramError
from agent.execute import Executor
from agent.messages import Draft, Kind
from agent.primitives import primitives
from agent.programs import laid_out
from evals.figures import Figure, at_least, at_most, median, times
from evals.paper_metric import scenes_of
from evals.solver_storm import storm
from robot_bridge.api import PARK, approve
from robot_bridge.ideal import IdealRobot
from scene.types import Scene
from translator.corpus.load import Pair, load

HOSTILE = Path(__file__).parent / "hostile.jsonl"
SYSTEMS = 20_000
"""Random solver systems."""
KILLED_FOR_S = 10.0
KILL_EVERY_S = 0.05
CALLERS = 4
"""Threads that ask at once while workers are killed."""
GOOD = "put(apple, left_of(apple, cup))"


class Body(msgspec.Struct, frozen=True):
    """One line of `hostile.jsonl`, as far as the bench needs it."""

    id: str
    kind: Kind
    body: str
    expect: tuple[str, ...]


def program_figures() -> dict[str, Figure]:
    """Every figure of the language's table, measured now."""
    return {
        **_speed(),
        **_starting(),
        **_hostile(),
        "paper_programs_refused": _refused(),
        **_storm(),
        **_killed(),
    }


# --- speed ---------------------------------------------------------------------------------------


def _speed() -> dict[str, Figure]:
    """From program text to approved plans: scan, parse, run, re-validate, check the trajectory."""
    pair = next(pair for pair in load("manipulate") if pair.family.startswith("pick"))
    layout = max(load("arrange"), key=lambda one: one.program.count("\n"))
    scenes, others = scenes_of(pair, 20), scenes_of(layout, 20)
    arm = IdealRobot()
    with Executor() as executor:

        def plans(pair: Pair, scenes: Sequence[Scene]) -> None:
            drafts = executor.run(pair.program, pair.kind, scenes)
            for draft, scene in zip(drafts, scenes, strict=True):
                assert isinstance(draft, Draft)
                approve(primitives(draft, scene), PARK, arm, pair.program, scene)

        return {
            "one_program_20_scenes": median(times(lambda: plans(pair, scenes), 300), 2.0),
            "one_program_one_scene": median(times(lambda: plans(pair, scenes[:1]), 300), 0.8),
            "worker_alone_20_scenes": median(
                times(lambda: executor.run(pair.program, pair.kind, scenes), 300)
            ),
            "longest_arrange_20_scenes": median(times(lambda: plans(layout, others), 30)),
        }


def _starting() -> dict[str, Figure]:
    """From nothing to a hardened worker's first answer; from a killed worker to the spare's."""
    scene = table("check")
    starts = []
    for _ in range(10):
        began = time.perf_counter()
        with Executor() as executor:
            executor.run("pass", "manipulate", [scene])
            starts.append(1000 * (time.perf_counter() - began))
    swaps = []
    with Executor() as executor:
        for _ in range(20):
            for _ in range(100):  # the next spare gets ready beside ordinary work
                executor.run(GOOD, "manipulate", [scene])
                time.sleep(0.002)
            os.kill(executor.pid, signal.SIGKILL)
            began = time.perf_counter()
            (answer,) = executor.run(GOOD, "manipulate", [scene])
            swaps.append(1000 * (time.perf_counter() - began))
            assert isinstance(answer, Draft)
        hardened = executor.hardened
    return {
        "worker_spawn_to_answer": median(starts, 100.0),
        "worker_killed_to_answer": median(swaps, 10.0),
        "worker_killed_to_answer_max": at_most(max(swaps), None, "ms", len(swaps)),
        "system_calls_filtered": at_least(float(hardened), 1, "yes=1", 1),
    }


# --- hostility ------------------------------------------------------------------------------------


def _hostile() -> dict[str, Figure]:
    """Every hostile body: does it get its verdict, how soon, and does the next program run?"""
    # not msgspec's decoder: one body holds half a surrogate pair
    bodies = [msgspec.convert(json.loads(line), Body) for line in HOSTILE.open("rb")]
    scenes = {kind: laid_out(table("check"), kind) for kind in ("manipulate", "arrange")}
    wrong, broken, slowest = 0, 0, 0.0
    with Executor() as executor:
        (good,) = executor.run(GOOD, "manipulate", [scenes["manipulate"]])
        for body in bodies:
            began = time.perf_counter()
            (result,) = executor.run(body.body, body.kind, [scenes[body.kind]])
            slowest = max(slowest, 1000 * (time.perf_counter() - began))
            wrong += _verdict(result) not in body.expect
            (after,) = executor.run(GOOD, "manipulate", [scenes["manipulate"]])
            broken += after != good
    return {
        "hostile_bodies_escaped": at_most(wrong, 0, "bodies", len(bodies)),
        "hostile_slowest_answer": at_most(slowest, 2000.0, "ms", len(bodies)),
        "good_program_fails_after": at_most(broken, 0, "bodies", len(bodies)),
    }


def _verdict(result: Draft | ProgramError) -> str:
    if isinstance(result, LimitReached):
        return "limited"
    return "rejected" if isinstance(result, ProgramError) else "accepted"


def _refused() -> Figure:
    """The paper's kinds of program: how many of the corpora's pairs are not allowed."""
    pairs = [*load("arrange"), *load("manipulate")]
    with Executor() as executor:
        refused = sum(
            isinstance(executor.run(pair.program, pair.kind, scenes_of(pair, 1))[0], NotAllowed)
            for pair in pairs
        )
    return at_most(refused, 0, "programs", len(pairs))


def _storm() -> dict[str, Figure]:
    """Random solver systems: each is answered, and the service lives."""
    with Executor() as executor:
        counts = storm(executor, SYSTEMS, 0)
        (after,) = executor.run(GOOD, "manipulate", [table("check")])
    total = sum(counts.values())
    return {
        "solver_systems_answered": at_least(total - counts["other"], SYSTEMS, "systems", SYSTEMS),
        "solver_systems_solver_failed": at_most(counts["failed"], None, "systems", SYSTEMS),
        "solver_service_alive": at_least(float(isinstance(after, Draft)), 1, "yes=1", 1),
    }


def _killed() -> dict[str, Figure]:
    """Workers killed at random under load: answers, typed refusals, and nothing else."""
    chance, done = random.Random(0), threading.Event()
    counts: Counter[str] = Counter()
    scene = table("check")
    with Executor() as executor:

        def ask() -> None:
            for number in itertools.count():
                if done.is_set():
                    return
                program = f"robot.move({number % 100} / 100, 0, 1, 0)"
                results = executor.run(program, "manipulate", [scene])
                counts["asked"] += 1
                counts[_outcome(results, number)] += 1

        callers = [threading.Thread(target=ask) for _ in range(CALLERS)]
        for caller in callers:
            caller.start()
        end = time.monotonic() + KILLED_FOR_S
        while time.monotonic() < end:
            time.sleep(chance.uniform(0, 2 * KILL_EVERY_S))
            with contextlib.suppress(ProcessLookupError):  # it may have gone already
                os.kill(executor.pid, signal.SIGKILL)
        done.set()
        for caller in callers:
            caller.join()
        (after,) = executor.run(GOOD, "manipulate", [scene])
    return {
        "killed_requests_answered": at_least(counts["answered"], 1, "requests", counts["asked"]),
        "killed_requests_refused": at_most(counts["refused"], None, "requests", counts["asked"]),
        "killed_requests_wrong": at_most(counts["wrong"], 0, "requests", counts["asked"]),
        "killed_next_program_runs": at_least(float(isinstance(after, Draft)), 1, "yes=1", 1),
    }


def _outcome(results: Sequence[Draft | ProgramError], number: int) -> str:
    if len(results) != 1:
        return "wrong"
    (result,) = results
    if isinstance(result, ProgramError):
        return "refused"
    return "answered" if result.commands[0].x == number % 100 / 100 else "wrong"
