"""What each part of the clarifier is worth: the same episodes, one part left out at a time.

    python -m evals.ablate_clarifier [--episodes 300] [--seed 2] [--permutation 100]

``--permutation`` decides so many episodes on three shuffles of the scene's objects and ids as well,
and counts how often the end is another one (clarifier design, "Candidates, clusters, permutation").
"""

from __future__ import annotations

import argparse
import random
import sys
from collections.abc import Sequence

import msgspec

from agent.compose import parts_on, thinking
from agent.execute import Executor
from agent.messages import Dialog
from agent.turn import Parts, run_turn
from clarifier.conformal import PRODUCT
from evals.ablations import ABLATIONS
from evals.clarifier_figures import (
    covered,
    missed_ask,
    over_ask,
    over_step,
    share,
    wrong_acts,
)
from evals.conformal import TEST_SEED
from evals.episodes import Episode, episodes
from evals.figures import Figure
from evals.played import Job, Result, play
from scene.relations import moved
from scene.types import Scene, SceneObject

SHUFFLES = 3
ENDS = 0.02
"""Places that differ by no more are the same (table units)."""


def rates(results: Sequence[Result]) -> dict[str, Figure]:
    """The columns of the table."""
    able = [one for one in results if one.feasible]
    exact = [one.exact for one in able if one.exact is not None]
    return {
        "covered": share(covered(results, 1 - PRODUCT.level)),
        "recall": share([one.score < 1 for one in able]),
        "over-ask": share(over_ask(results)), "missed ask": share(missed_ask(results)),
        "over-step": share(over_step(results)), "wrong acts": share(wrong_acts(results)),
        "exact set": share(exact), "success": share([one.succeeded for one in able]),
    }  # fmt: skip


def table(episodes_: int, seed: int, processes: int = 2) -> str:
    """A line for each ablation, in per cent."""
    lines: list[str] = []
    for name, manner in ABLATIONS.items():
        found = rates(play(Job(episodes_, seed, manner), processes))
        if not lines:
            lines.append(f"{'':34}" + "".join(f"{key:>12}" for key in found))
        cells = ("-" if one.value is None else f"{one.value:.1f}" for one in found.values())
        lines.append(f"{name:34}" + "".join(f"{cell:>12}" for cell in cells))
    return "\n".join(lines)


def permuted(count: int, seed: int) -> tuple[int, int]:
    """Of so many clear commands that are acted on, how many end otherwise on a shuffled scene; and
    how many were acted on."""
    changed = acted = 0
    with Executor() as executor, thinking() as mind:
        for episode in episodes(count, seed * 10_000, executor, ("clear",)):
            ends = []
            for number in range(SHUFFLES + 1):
                scene, back = _shuffled(episode, number)
                with parts_on(mind, scene) as parts:
                    ends.append(_ended(episode, parts, back))
            if ends[0] is not None:
                acted += 1
                changed += any(not _same(ends[0], end) for end in ends[1:])
    return changed, acted


def _shuffled(episode: Episode, number: int) -> tuple[Scene, dict[str, str]]:
    """The scene with its objects in another order under other ids, and what those were."""
    if number == 0:
        return episode.scene, {item.id: item.id for item in episode.scene}
    chance = random.Random(f"{episode.name} {number}")
    items, tray = list(episode.scene.objects), list(episode.scene.tray)
    chance.shuffle(items)
    chance.shuffle(tray)
    counts: dict[str, int] = {}
    new: dict[str, str] = {}
    for item in (*items, *tray):
        stem = item.id.rpartition("_")[0]
        counts[stem] = counts.get(stem, 0) + 1
        new[item.id] = f"{stem}_{counts[stem]}"

    def renamed(some: Sequence[SceneObject]) -> tuple[SceneObject, ...]:
        return tuple(msgspec.structs.replace(one, id=new[one.id]) for one in some)

    scene = msgspec.structs.replace(episode.scene, objects=renamed(items), tray=renamed(tray))
    return scene, {now: was for was, now in new.items()}


def _ended(episode: Episode, parts: Parts, back: dict[str, str]) -> Scene | None:
    """The scene at the end, under its first ids; None if the command was not acted on."""
    dialog = Dialog()
    for text in ([episode.opening[0]] if episode.opening else []) + [episode.text]:
        turn, dialog = run_turn(text, dialog, parts)
    if turn.status != "done":
        return None
    end = parts.arm.scene()
    return msgspec.structs.replace(
        end, objects=tuple(msgspec.structs.replace(one, id=back[one.id]) for one in end.objects),
        tray=tuple(msgspec.structs.replace(one, id=back[one.id]) for one in end.tray),
    )  # fmt: skip


def _same(one: Scene, other: Scene | None) -> bool:
    if other is None:
        return False
    ends = {item.id: item for item in other}
    return all(moved(item, ends[item.id], ENDS) == 0 and item.held == ends[item.id].held
               for item in one)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m evals.ablate_clarifier", description=__doc__)
    parser.add_argument("--episodes", type=int, default=300)
    parser.add_argument("--seed", type=int, default=TEST_SEED)
    parser.add_argument("--permutation", type=int, default=0)
    options = parser.parse_args(arguments)
    if options.permutation:
        changed, acted = permuted(options.permutation, options.seed)
        print(f"another end on a shuffled scene: {changed} of {acted} that were acted on")
        return 0
    print(table(options.episodes, options.seed))
    return 0


if __name__ == "__main__":
    sys.exit(main())
