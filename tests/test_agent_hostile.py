"""567 bodies that attack one property each, written without sight of the code.

Every line of evals/hostile.jsonl names its category, the property it attacks and the verdicts that
the language's description allows; ``ruling`` says why where that left it open. Each runs for real,
in the worker; after each the same good program must give the same answer.
"""

import hashlib
import json
from collections import Counter
from pathlib import Path

import pytest

from agent.compose import table
from agent.errors import LimitReached, ProgramError
from agent.execute import Executor
from agent.programs import laid_out

ROOT = Path(__file__).parent.parent
BODIES = [json.loads(line) for line in (ROOT / "evals/hostile.jsonl").open()]
GOOD = "put(apple, left_of(apple, cup))\nrobot.move(math.sin(0.5), 0, 1, 0)"
SCENES = {kind: laid_out(table("check"), kind) for kind in ("manipulate", "arrange")}


def files() -> dict[str, str]:
    """Our own sources, as they are now."""
    found = [*ROOT.glob("agent/**/*.py"), *ROOT.glob("agent/**/*.txt"), *ROOT.glob("*.toml")]
    return {str(path): hashlib.sha256(path.read_bytes()).hexdigest() for path in found}


@pytest.fixture(scope="module")
def answers():
    """(verdict, reason, what the good program answers afterwards) for each body."""
    before, found = files(), {}
    with Executor() as executor:
        (good,) = executor.run(GOOD, "manipulate", [SCENES["manipulate"]])
        for body in BODIES:
            (result,) = executor.run(body["body"], body["kind"], [SCENES[body["kind"]]])
            (after,) = executor.run(GOOD, "manipulate", [SCENES["manipulate"]])
            found[body["id"]] = verdict(result), str(result), after == good
    assert not isinstance(good, ProgramError)
    assert files() == before
    return found


def verdict(result) -> str:
    if isinstance(result, LimitReached):
        return "limited"
    return "rejected" if isinstance(result, ProgramError) else "accepted"


@pytest.mark.parametrize("body", BODIES, ids=lambda body: body["id"])
def test_a_hostile_body_gets_the_verdict_and_leaves_nothing_behind(answers, body):
    verdict, reason, good_still_runs = answers[body["id"]]
    assert verdict in body["expect"], f"{body['property']}: {verdict}, {reason}"
    assert good_still_runs, body["property"]


@pytest.mark.parametrize("body", BODIES, ids=lambda body: body["id"])
def test_a_refusal_is_one_plain_line_of_text(answers, body):
    verdict, reason, _ = answers[body["id"]]
    if verdict != "accepted":
        assert reason.isprintable() and 10 < len(reason) < 400


def test_every_category_is_attacked_and_has_look_alikes_that_must_pass():
    attacks = Counter(body["category"] for body in BODIES if "accepted" not in body["expect"])
    passing = Counter(body["category"] for body in BODIES if body["expect"] == ["accepted"])
    assert len(attacks) == 14 and min(attacks.values()) >= 14 and min(passing.values()) >= 2
    assert len({body["body"] for body in BODIES}) == len(BODIES) >= 150
