"""Every expert pair proves itself: on random scenes its program passes the check and its
postconditions hold, and nothing that the sentence does not name moves.

    python -m evals.proof [arrange|manipulate]

The words of a postcondition are in `evals.postconditions`.
"""

from __future__ import annotations

import argparse
import math
import random
import re
import sys
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import msgspec

from agent.check import Predict, check
from agent.errors import ProgramError, SceneError
from agent.execute import Executor
from agent.messages import Command, Kind
from agent.primitives import primitives
from agent.program import parse
from evals.postconditions import Malformed, holds
from evals.world import World, random_table
from robot_bridge.ideal import IdealRobot, predict
from scene.generate import random_scene
from scene.relations import extents
from scene.types import Scene, SceneObject, identifiers
from translator.corpus.load import Pair, load
from translator.vocabulary import NOUNS, tokenize, words_of

SEEDS = range(20)
"""Scenes on which a pair must hold, as many as the paper's metric uses."""
OTHERS = 6
"""Bystanders to try at most; one that finds no room clear of what the arm does stays away."""
DRAWS = 200
"""Random scenes to draw at most until one is as a pair's ``given`` wants it."""


def prove(
    pair: Pair, executor: Executor, predict: Predict, seeds: Sequence[int] = SEEDS
) -> list[str]:
    """What is wrong with a pair, one line a fault; an empty list: it is proven.

    Each seed makes a scene with the pair's objects (on the table, for arrange in the tray) and
    one or two others that must not move. Where ``after`` has no ``only``, the pair's own objects
    may all move.
    """
    nouns = named(pair)
    try:
        parse(pair.program, pair.kind, nouns)
    except ProgramError as error:
        return [f"{pair.id}: {error}"]
    faults = [fault for seed in seeds for fault in _faults(pair, nouns, seed, executor, predict)]
    return list(dict.fromkeys(faults))


def named(pair: Pair) -> list[str]:
    """The nouns that sentence, program and postconditions speak of, in order of first mention."""
    words = re.findall(r"[a-z]+", " ".join([pair.say, pair.program, *pair.after]))
    return list(dict.fromkeys(word for word in words if word in NOUNS))


def _faults(
    pair: Pair, nouns: Sequence[str], seed: int, executor: Executor, predict: Predict
) -> list[str]:
    rng = random.Random(f"{pair.id} {seed}")
    where = f"{pair.id} seed {seed}"
    try:
        scene = scene_for(pair, nouns, rng, executor)
    except (Malformed, ProgramError, SceneError) as error:
        return [f"{where}: {error}"]
    robot = IdealRobot()
    known = identifiers(scene)
    touched = [known[noun].id for noun in nouns]
    checked = check(
        pair.program,
        pair.kind,
        scene,
        executor=executor,
        predict=predict,
        workspace=robot,
        start=robot.pose(),
        touched=touched,
    )
    if not checked.ok or checked.after is None:
        return [f"{where}: {problem.reason}: {problem.text}" for problem in checked.problems]
    world = World(scene, checked.after, checked.commands)
    lines = [*pair.after]
    if not any(line.startswith("only ") for line in lines):
        lines.append(" ".join(["only", *nouns]))
    try:
        return [f"{where}: not true: {line}" for line in lines if not holds(line, world)]
    except (Malformed, SceneError) as error:
        return [f"{where}: {error}"]


# --- the scene of a proof --------------------------------------------------------------------


def scene_for(pair: Pair, nouns: Sequence[str], rng: random.Random, executor: Executor) -> Scene:
    """The pair's objects at random, and bystanders as far as can be from what the arm does.

    Raises ProgramError if the program fails on the scene without bystanders, SceneError if no
    scene is as ``given`` wants it.
    """
    scene, path = _given(pair, nouns, rng, executor)
    reach = max((_reach(item, pair.kind) for item in scene), default=0.0)
    wanted = len(scene.objects) + rng.choice((1, 2))
    for noun in rng.sample([noun for noun in NOUNS if noun not in nouns], OTHERS):
        if len(scene.objects) == wanted:
            break
        item = random_scene(rng, [noun]).objects[0]
        place = _free_place(scene, path, item, rng)
        if _clearance(scene, path, place, reach) > math.hypot(*extents(item)):
            placed = msgspec.structs.replace(item, x=place[0], y=place[1])
            scene = msgspec.structs.replace(scene, objects=(*scene.objects, placed))
    return scene


def _reach(item: SceneObject, kind: Kind) -> float:
    """How far from the tool's path an object that is carried, pushed or toppled may reach."""
    if kind == "arrange":
        return math.hypot(item.width, item.height) / 2
    return math.hypot(item.width, item.height, item.tall)


def _given(
    pair: Pair, nouns: Sequence[str], rng: random.Random, executor: Executor
) -> tuple[Scene, tuple[Command, ...]]:
    """A random scene of the pair's objects that is as ``given``, and the program's path on it."""
    for _ in range(DRAWS):
        scene = random_table(pair.kind, nouns, rng)
        draft = executor.run(pair.program, pair.kind, [scene])[0]
        if isinstance(draft, ProgramError):
            raise draft
        path = primitives(draft, scene)
        if all(holds(line, World(scene, scene, path)) for line in pair.given):
            return scene, path
    raise SceneError(f"not one of {DRAWS} random scenes is as given: {', '.join(pair.given)}")


def _free_place(
    scene: Scene, path: Sequence[Command], item: SceneObject, rng: random.Random
) -> tuple[float, float]:
    """The one of sixty random places that is farthest from path and objects (table units)."""
    reach = 0.95 - max(extents(item))
    places = [(rng.uniform(-reach, reach), rng.uniform(-reach, reach)) for _ in range(60)]
    return max(places, key=lambda place: _clearance(scene, path, place))


def _clearance(
    scene: Scene, path: Sequence[Command], place: tuple[float, float], reach: float = 0.0
) -> float:
    """Distance to the nearest object's outline, or to the path less the ``reach`` of what moves."""
    away = [
        math.dist(place, thing.position) - math.hypot(*extents(thing)) for thing in scene.objects
    ]
    moves = [command for command in path if command.op == "move"]
    for one, other in pairwise(moves):
        away.append(_segment_distance(place, (one.x, one.y), (other.x, other.y)) - reach)
    return min(away, default=math.inf)


def _segment_distance(
    point: tuple[float, float], start: tuple[float, float], end: tuple[float, float]
) -> float:
    dx, dy = end[0] - start[0], end[1] - start[1]
    long = dx * dx + dy * dy
    share = 0.0
    if long > 0:
        share = ((point[0] - start[0]) * dx + (point[1] - start[1]) * dy) / long
        share = min(1.0, max(0.0, share))
    return math.dist(point, (start[0] + share * dx, start[1] + share * dy))


# --- the command -----------------------------------------------------------------------------


def main(arguments: Sequence[str] | None = None) -> int:
    """Prove the corpora named (default both), print counts and faults; 1 if any pair fails."""
    parser = argparse.ArgumentParser(prog="python -m evals.proof", description=__doc__)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help="arrange, manipulate")
    parser.add_argument("--seeds", type=int, default=len(SEEDS), help="scenes a pair")
    parser.add_argument("--folder", type=Path, default=None, help="folder of the TOML files")
    options = parser.parse_args(arguments)
    kinds: list[Kind] = options.kinds or ["arrange", "manipulate"]
    failed = 0
    with Executor() as executor:
        for kind in kinds:
            pairs = load(kind, options.folder) if options.folder else load(kind)
            failed += _report(kind, pairs, executor, range(options.seeds))
    return 1 if failed else 0


def _report(kind: Kind, pairs: Sequence[Pair], executor: Executor, seeds: range) -> int:
    faults = {pair.id: prove(pair, executor, predict, seeds) for pair in pairs}
    failed = sum(bool(lines) for lines in faults.values())
    splits = Counter(pair.split for pair in pairs)
    print(f"{kind}: {len(pairs)} pairs {dict(splits)}, {failed} fail on {len(seeds)} scenes")
    for family, count in sorted(Counter(pair.family for pair in pairs).items()):
        print(f"  {family:16} {count:4}")
    words = {word for pair in pairs for word in words_of(pair.say)}
    tokens = {token for pair in pairs for token in tokenize(pair.program)}
    print(f"  vocabulary: {len(words)} words, {len(tokens)} program tokens")
    for lines in faults.values():
        for line in lines[:4]:
            print(f"  FAIL {line}")
    return failed


if __name__ == "__main__":
    sys.exit(main())
