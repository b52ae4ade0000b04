"""`python -m evals.solver_storm [N] [SEED]`: random systems of constraints against the solver.

kiwisolver aborts its process on some finite, ordinary systems. Each of N random ones, written as
an arrange program, must be solved, found unsatisfiable, or answered by "the solver failed": a
worker that died of it, or a solution beyond the numbers of the language. Whatever happens, the
next program runs. Prints one JSON object; status 1 if anything else happened, or if a plain
program does not run at the end.
"""

from __future__ import annotations

import json
import random
import sys
import time
from collections import Counter
from collections.abc import Sequence

from agent.errors import SolverFailed, Unsatisfiable
from agent.execute import Executor
from agent.messages import Draft
from scene.types import Scene, SceneObject

NAMES = ("apple", "orange", "cup", "pear")
RELATIONS = ("<=", ">=", "==")
STRENGTHS = ("required", "strong", "medium", "weak")
COEFFICIENTS = (0.0, 1e-9, 0.01, 0.5, 1.0, 2.0, 3.0, 100.0, 1e4)
FREE = tuple(f"v{number}" for number in range(8))
POSITIONS = tuple(f"{name}.{axis}" for name in NAMES for axis in "xy")
AFTER = "solver.addConstraint(apple.x == 0.25)"

KINDS = ("solved", "unsatisfiable", "failed", "other")

SCENE = Scene(
    objects=(
        SceneObject(id="plate", name="plate", x=0.4, y=-0.3, width=0.3, height=0.3, tall=0.03),
    ),
    tray=tuple(
        SceneObject(id=name, name=name, width=0.12, height=0.12, tall=0.1, on="tray")
        for name in NAMES
    ),
)


def main(arguments: Sequence[str]) -> int:
    """Run the storm and print its counts; the exit status."""
    n = int(arguments[0]) if arguments else 20_000
    seed = int(arguments[1]) if len(arguments) > 1 else 0
    began = time.monotonic()
    with Executor() as executor:
        counts = storm(executor, n, seed)
        seconds = round(time.monotonic() - began, 1)
        alive = _outcome(executor, AFTER) == "solved"
    ok = alive and counts["other"] == 0
    print(json.dumps({"n": n, "seed": seed, "seconds": seconds, "alive": alive, **counts}))
    return 0 if ok else 1


def storm(executor: Executor, n: int, seed: int) -> Counter[str]:
    """Run ``n`` random systems and count what came of them; "other" must stay 0."""
    rng = random.Random(seed)
    counts = Counter(dict.fromkeys(KINDS, 0))
    counts.update(_outcome(executor, system(rng)) for _ in range(n))
    return counts


def _outcome(executor: Executor, source: str) -> str:
    (result,) = executor.run(source, "arrange", [SCENE])
    match result:
        case Draft():
            return "solved"
        case Unsatisfiable():
            return "unsatisfiable"
        case SolverFailed():
            return "failed"
        case _:
            return "other"


def system(rng: random.Random) -> str:
    """A program of 1 to 12 random constraints over 1 to 8 unknowns, free ones and positions."""
    used = rng.sample(rng.choice((FREE, FREE + POSITIONS)), rng.randint(1, 8))
    lines = [f'{name} = Variable("{name}")' for name in used if name in FREE]
    lines += [_constraint(rng, used) for _ in range(rng.randint(1, 12))]
    return "\n".join(lines)


def _constraint(rng: random.Random, unknowns: Sequence[str]) -> str:
    terms = rng.sample(unknowns, rng.randint(1, len(unknowns)))
    left = " + ".join(f"{_number(rng)} * {term}" for term in terms)
    relation, strength = rng.choice(RELATIONS), rng.choice(STRENGTHS)
    return f'solver.addConstraint(({left} + {_number(rng)} {relation} 0) | "{strength}")'


def _number(rng: random.Random) -> str:
    size = rng.choice([*COEFFICIENTS, rng.uniform(0, 2), rng.uniform(0, 1000)])
    return f"{rng.choice((-1, 1)) * size:.9g}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
