"""Every seed proves itself: on 20 random scenes its program passes the check and does what it says.

    python -m evals.seed_proof [FILE.toml ...]

Slots are bound to random objects, groups to two to four of one noun, measures to random values.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from shutil import copy

import msgspec

from agent.check import check
from agent.errors import SceneError
from agent.execute import Executor
from agent.messages import Kind
from evals.postconditions import Malformed, holds
from evals.world import World
from robot_bridge.ideal import IdealRobot, predict
from scene.generate import random_scene
from scene.types import Scene, identifiers
from translator.corpus.seed import ANGLES, COUNTS, GROUPS, LENGTHS, NAME, Seed, load_seeds

SCENES = 20
DRAWS = 400
NOUNS = ("apple", "orange", "lemon", "cup", "bottle", "block", "can", "sponge", "star", "egg",
         "plum", "toy", "candle", "magnet", "cube", "brick")  # fmt: skip
SMALL = ("strawberry", "key", "coin", "eraser", "magnet")
"""What several of fit side by side on a plate, or stand on one another."""
CARRIERS = ("plate", "box", "bowl")
"""What ``b`` may be where something is put on or into it."""

Value = str | float | list[str]


def prove(seed: Seed, kind: Kind, executor: Executor, scenes: int = SCENES) -> list[str]:
    """What is wrong with a seed, one line a fault; an empty list: it is proven."""
    faults: list[str] = []
    for number in range(scenes):
        chance = random.Random(f"{seed.id} {kind} {number}")
        last = "no scene is as given"
        for _ in range(DRAWS):
            last = _fault(seed, kind, chance, executor)
            if last != "not as given":
                break
        if last:
            faults.append(f"{seed.id} ({kind}) scene {number}: {last}")
    return list(dict.fromkeys(faults))


def _fault(seed: Seed, kind: Kind, chance: random.Random, executor: Executor) -> str:
    scene, values = bind(seed, kind, chance)
    program = fill(seed.program, values)
    robot, known = IdealRobot(scene), identifiers(scene)
    named = [one for value in values.values() if not isinstance(value, float)
             for one in ([value] if isinstance(value, str) else value)]  # fmt: skip
    checked = check(
        program, kind, scene, executor=executor, predict=predict, workspace=robot,
        start=robot.pose(), touched=[known[name].id for name in named],
    )  # fmt: skip
    try:
        before = World(scene, scene, checked.commands)
        if not all(holds(line, before) for line in lines_of(seed.given, values)):
            return "not as given"
        if checked.plan is None or checked.after is None:
            return f"{checked.problems[0].text} in {program!r}"
        world = World(scene, checked.after, checked.commands)
        wrong = [line for line in lines_of(seed.after, values) if not holds(line, world)]
    except (Malformed, SceneError) as error:
        return str(error)
    return f"not true: {wrong[0]}" if wrong else ""


def bind(seed: Seed, kind: Kind, chance: random.Random) -> tuple[Scene, dict[str, Value]]:
    """A random scene with the seed's things and a bystander, and what each slot stands for."""
    names, values, spare = cast(seed, chance)
    if kind == "arrange":
        return random_scene(chance, [], names), values
    scene = random_scene(chance, [*names, spare], room=0.15)
    return _moved_together(scene, seed, values), values


def cast(seed: Seed, chance: random.Random) -> tuple[list[str], dict[str, Value], str]:
    """Names for the seed's things, what each slot stands for (identifiers, where nothing else
    bears their names), and a name that is not among them."""
    carriers = set(re.findall(r"put_(?:all_)?on\(.*, ([a-fB])(?:\[\w+\])?\)", seed.program))
    if "put_on(" in seed.program:
        carriers |= set(re.findall(r"of_\w+_color\(\w+, (B)\)", seed.program))
    listed = " ".join(re.findall(r"put_all_on\(\[(.*?)\]", seed.program))
    small = chance.sample(SMALL, len(SMALL))
    nouns = [noun for noun in chance.sample(NOUNS, len(NOUNS)) if noun not in SMALL]
    names: list[str] = []
    values: dict[str, Value] = {}
    for slot in seed.slots:
        if slot in LENGTHS:
            values[slot] = round(chance.uniform(0.1, 0.4), 2)
        elif slot in ANGLES:
            values[slot] = round(chance.uniform(0.3, 2.8), 2)
        elif slot in COUNTS:
            values[slot] = float(chance.randint(2, 3))
        elif slot in GROUPS:
            few = any(
                word in seed.program for word in ("put_all_on", "stack", "put_on(A[", "_color(")
            )
            count = chance.randint(2, 3 if few or "put_all(" in seed.program else 4)
            stated = re.search(rf"at_least (\d) {slot}\b", " ".join(seed.given))
            count = max(count, int(stated.group(1)) if stated else 0)
            noun = small.pop() if few else nouns.pop()
            if slot in carriers:
                noun = chance.choice(CARRIERS)
            values[slot] = [f"{noun}_{number}" for number in range(1, count + 1)]
            names += [noun] * count
        else:
            spare = [name for name in CARRIERS if name not in names]
            noun = chance.choice(spare) if slot in carriers else nouns.pop()
            if slot in listed:
                noun = small.pop()
            values[slot] = noun
            names.append(noun)
    return names, values, nouns.pop()


def _moved_together(scene: Scene, seed: Seed, values: Mapping[str, Value]) -> Scene:
    """The scene with the second of two things that must ``abut`` beside the first, and as tall, and
    with those that must be ``level`` as tall as the first: chance alone would never put them so."""
    for line in seed.given:
        word, *slots = line.split()
        if word == "abut":
            one, two = (identifiers(scene)[str(values[slot])] for slot in slots)
            x = one.position[0] + (one.width + two.width) / 2 + 0.02
            scene = scene.replace(
                msgspec.structs.replace(two, x=x, y=one.position[1], tall=one.tall)
            )
        if word == "level":
            nouns = lines_of([line], values)[0].split()[1:]
            level = [identifiers(scene)[noun] for noun in nouns]
            for item in level[1:]:
                scene = scene.replace(msgspec.structs.replace(item, tall=level[0].tall))
    return scene


def fill(text: str, values: Mapping[str, Value]) -> str:
    """Text over slots with what they stand for: names, numbers, lists of names."""

    def swap(match: re.Match[str]) -> str:
        value = values.get(match.group())
        if value is None:
            return match.group()
        if isinstance(value, list):
            return f"[{', '.join(value)}]"
        return f"{value:g}" if isinstance(value, float) else value

    return NAME.sub(swap, text)


def lines_of(stated: Sequence[str], values: Mapping[str, Value]) -> list[str]:
    """Conditions over slots as conditions over the scene's names: groups written out."""
    flat = {slot: " ".join(v) if isinstance(v, list) else v for slot, v in values.items()}
    lines: list[str] = []
    for line in stated:
        if line.startswith("each "):
            _, group, rest = line.split(" ", 2)
            members = values[group]
            assert isinstance(members, list)
            lines += [fill(re.sub(r"\bit\b", one, rest), flat) for one in members]
        else:
            lines.append(fill(line, flat))
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Prove the seeds of the files named (default: all), print counts and faults."""
    parser = argparse.ArgumentParser(prog="python -m evals.seed_proof", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--scenes", type=int, default=SCENES)
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        for path in options.files:
            copy(path, folder)
        seeds = load_seeds(Path(folder)) if options.files else load_seeds()
    failed = 0
    with Executor() as executor:
        for seed in seeds:
            kinds: tuple[Kind, ...] = ("manipulate", "arrange")
            for kind in kinds if seed.kind == "both" else (seed.kind,):
                faults = prove(seed, kind, executor, options.scenes)
                failed += bool(faults)
                for fault in faults[:2]:
                    print(f"FAIL {fault}")
    said = sum(len(seed.say) for seed in seeds)
    print(f"{len(seeds)} seeds, {said} pairs, {failed} fail on {options.scenes} scenes each")
    for family, count in sorted(Counter(seed.family for seed in seeds).items()):
        print(f"  {family:28} {count:4}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
