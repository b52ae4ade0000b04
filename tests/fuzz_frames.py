"""Coverage-guided fuzzing of what the executor makes of a worker's bytes: `make fuzz`.

    python tests/fuzz_frames.py FOLDER [libFuzzer options]

An input is what a worker sends or, after two zero bytes, what decides how a reply looks.
FOLDER takes the first inputs, the replies to the benign bodies, and whatever comes of them.
"""

import random

import atheris
from fuzzing import fuzz

with atheris.instrument_imports(include=["agent"]):
    from program_texts import SCENES, Chances, benign
    from test_agent_fuzz import (
        PretendSolver,
        assert_checked,
        parsed,
        random_reply,
        read,
        received,
    )

    from agent.errors import NotAllowed, ProgramError
    from agent.language import frames
    from agent.language.interpret import compile_program, execute

LARGEST = 2_000
"""Bytes of a frame that is accepted here: about half of what the fuzzer sends."""


def one_input(data):
    if data[:2] == b"\0\0":
        data = random_reply(Chances(data[2:]))
    for kind in SCENES:
        assert_checked(read(data, kind), kind)
    found = received(data, LARGEST)
    whole = data[:4] == len(data[4:]).to_bytes(4, "big") and len(data) <= LARGEST + 4
    assert (found == data[4:]) if whole else isinstance(found, frames.FrameError)


def reply_to(source, kind):
    """What a worker answers to a program."""
    program = parsed(source, kind)
    if isinstance(program, NotAllowed):
        return frames.Result(failure=frames.Failure.of(program))
    try:
        return frames.Result(draft=execute(compile_program(program), SCENES[kind], PretendSolver))
    except ProgramError as error:
        return frames.Result(failure=frames.Failure.of(error))


def seeds():
    for kind in SCENES:
        for source in benign(kind):
            payload = frames.encode(frames.Reply((reply_to(source, kind),)))
            yield payload
            yield len(payload).to_bytes(4, "big") + payload
    for number in range(50):
        yield b"\0\0" + random.Random(number).randbytes(60)


if __name__ == "__main__":
    fuzz(one_input, seeds())
