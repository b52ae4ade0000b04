"""Coverage-guided fuzzing of the text scan, the parser, the allow-list and runs: `make fuzz`.

    python tests/fuzz_scan.py FOLDER [libFuzzer options]

An input is the text of a program or, after a zero byte, what decides how a random tree grows.
FOLDER takes the first inputs, the benign and the hostile bodies, and whatever comes of them.
"""

import json
import random
import warnings
from pathlib import Path

import atheris
from fuzzing import fuzz

with atheris.instrument_imports(include=["agent"]):
    from program_texts import Chances, benign
    from program_trees import body
    from test_agent_fuzz import assert_good_end, assert_refused_or_listed, parsed, run

    from agent.program import Program

HOSTILE = Path(__file__).parent.parent / "evals" / "hostile.jsonl"


def one_input(data):
    if data[:1] == b"\0":
        kind = "arrange" if data[1:2] > b"\x7f" else "manipulate"
        source = body(Chances(data[2:]), kind)
    else:
        source = data.decode("utf-8", "replace")
        kind = "arrange" if "solver" in source else "manipulate"
    try:
        check(source, kind)
    except Exception as error:
        raise AssertionError(f"{kind} program:\n{source}") from error


def check(source, kind):
    assert_refused_or_listed(source, kind)
    program = parsed(source, kind)
    if isinstance(program, Program):
        assert_good_end(source, kind, run(program))


def seeds():
    for kind in ("manipulate", "arrange"):
        yield from (source.encode() for source in benign(kind))
    if HOSTILE.exists():
        rows = [json.loads(row) for row in HOSTILE.read_text(encoding="utf-8").splitlines()]
        yield from (row["body"].encode("utf-8", "replace") for row in rows)
    for number in range(50):
        yield bytes([0, number * 5]) + random.Random(number).randbytes(300)


if __name__ == "__main__":
    warnings.simplefilter("ignore", SyntaxWarning)  # of Python's own parser
    fuzz(one_input, seeds())
