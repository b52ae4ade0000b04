"""The parent trusts nothing that a worker says: replies that lie, bytes that are no frames."""

import random
import socket
import struct
import threading

import msgspec
import pytest
from program_scenes import GOOD, runs, thing, tray

from agent.errors import (
    NotAllowed,
    ProgramError,
    SolverFailed,
)
from agent.execute import Executor
from agent.language import frames
from agent.language import run as budgets
from agent.language.frames import Failure, FrameError, Reply, Request, Result
from agent.messages import Command, Draft, Placement

# --- the parent trusts nothing: replies --------------------------------------------------------

MOVE = {
    "op": "move", "x": 0.0, "y": 0.0, "z": 0.0, "r": 0.0, "grip": False, "line": 1,
    "statement": 1,
}  # fmt: skip
PLACE = {"object": "apple_1", "x": 0.0, "y": 0.0, "line": 1}
FAILED = {"error": "NotAllowed", "reason": "no", "line": 1, "column": 1}
SCENE = tray("apple", objects=[thing("plate", 0.0, 0.0)])
MANIPULATE = Request(GOOD, "manipulate", (SCENE,))
ARRANGE = Request("x = 1", "arrange", (SCENE,))


def reply(**draft):
    empty = {"commands": [], "placements": [], "steps": 1}
    return msgspec.json.encode({"results": [{"draft": empty | draft}]})


def failed(**changes):
    return msgspec.json.encode({"results": [{"failure": FAILED | changes}]})


def test_honest_replies_are_accepted():
    (moved,) = frames.read_reply(reply(commands=[MOVE]), MANIPULATE)
    (placed,) = frames.read_reply(reply(placements=[PLACE]), ARRANGE)
    (refused,) = frames.read_reply(failed(), ARRANGE)
    assert moved.commands == (Command(**MOVE),) and placed.placements == (Placement(**PLACE),)
    assert type(refused) is NotAllowed and str(refused) == "line 1: no"


def test_the_parent_knows_the_budgets_of_the_worker():
    assert frames.MAX_COMMANDS == budgets.MAX_COMMANDS
    assert frames.MAX_STEPS == budgets.MAX_STEPS


def test_the_largest_honest_reply_fits():
    number = -1.2345678901234567e-100
    longest = Command("move", number, number, number, number, False, 200)
    draft = Draft((longest,) * frames.MAX_COMMANDS, (), frames.MAX_STEPS)
    assert len(frames.encode(Reply((Result(draft=draft),)))) < frames.MAX_SCENE_REPLY
    text = "\x01" * frames.MAX_REASON
    failure = Failure.of(NotAllowed(text + "more", 1, 1))
    assert len(frames.encode(Reply((Result(failure=failure),)))) < frames.MAX_SCENE_REPLY


@pytest.mark.parametrize(
    "lie",
    [
        b"",
        b"[]",
        b'{"results":[]}',
        b'{"results":[{}]}',
        b'{"results":[{"draft":null,"failure":null}]}',
        b'{"results":[{"draft":{},"failure":null}]}',
        b"[" * 50_000,
        b'{"results":' + b"[" * 50_000,
        b'{"results":[{"draft":{"deep":' + b'{"x":' * 50_000,
        b'{"results":[{"failure":{"error":"NotAllowed","reason":"\xff","line":1,"column":1}}]}',
        b'{"results":[{"failure":{"error":"NotAllowed","reason":"\\ud800","line":1,"column":1}}]}',
        reply(commands=[MOVE]) + b" ",
        reply(commands=[MOVE]) + reply(commands=[MOVE]),
        reply(commands=[MOVE]).replace(b'"steps":1', b'"steps":2,"steps":1'),
        reply(commands=[MOVE]).replace(b'"x":0.0', b'"x":1.0,"x":0.0'),
        reply(commands=[MOVE]).replace(b'"x":0.0', b'"x":NaN'),
        reply(commands=[MOVE]).replace(b'"x":0.0', b'"x":Infinity'),
        reply(commands=[MOVE]).replace(b'"x":0.0', b'"x":1e999'),
        reply(commands=[MOVE]).replace(b'"x":0.0', b'"x":' + b"9" * 5_000),
        reply(commands=[MOVE]).replace(b'"x":0.0', b'"x":0'),
        reply(commands=[MOVE]).replace(b'"line":1', b'"line":' + b"9" * 5_000),
        reply(commands=[MOVE | {"x": None}]),
        reply(commands=[MOVE | {"x": "0"}]),
        reply(commands=[MOVE | {"x": 1e300}]),
        reply(commands=[MOVE | {"r": -1.1e9}]),
        reply(commands=[MOVE | {"line": -1}]),
        reply(commands=[MOVE | {"line": 202}]),
        reply(commands=[MOVE | {"line": 1.5}]),
        reply(commands=[MOVE | {"op": "shoot"}]),
        reply(commands=[MOVE | {"more": 1}]),
        reply(commands=[MOVE] * 501),
        reply(steps=-1),
        reply(steps=100_001),
        reply(placements=[PLACE]),
        failed(error="KeyboardInterrupt"),
        failed(line=202),
        failed(column=-1),
        failed(reason="x" * 10_001),
    ],
)
def test_a_reply_that_lies_is_refused(lie):
    with pytest.raises(FrameError):
        frames.read_reply(lie, MANIPULATE)


@pytest.mark.parametrize(
    "lie",
    [
        reply(commands=[MOVE]),
        reply(placements=[PLACE | {"object": "plate_1"}]),
        reply(placements=[PLACE | {"object": "nothing"}]),
        reply(placements=[PLACE, PLACE]),
        reply(placements=[PLACE | {"y": None}]),
        reply(placements=[PLACE | {"y": 1e10}]),
        reply(placements=[PLACE | {"line": 1_000}]),
    ],
)
def test_placements_that_lie_are_refused(lie):
    with pytest.raises(FrameError):
        frames.read_reply(lie, ARRANGE)


def test_mangled_replies_are_refused_or_say_nothing_unchecked():
    rng = random.Random(5)
    honest = [reply(commands=[MOVE] * 3), reply(placements=[PLACE]), failed()]
    pieces = [b"", b"0", b"-1", b"1e999", b"NaN", b"null", b"{}", b"[", b"}", b'"', b"\xff", b","]
    for _ in range(5_000):
        told = bytearray(rng.choice(honest))
        for _ in range(rng.randint(1, 4)):
            at, length = rng.randrange(len(told) + 1), rng.choice([0, 1, 1, 3, 40])
            told[at : at + length] = rng.choice([*pieces, rng.randbytes(2)])
        request = rng.choice([MANIPULATE, ARRANGE])
        try:
            (result,) = frames.read_reply(bytes(told), request)
        except FrameError:
            continue
        if isinstance(result, Draft):
            places = [*result.commands, *result.placements]
            assert all(frames.is_position(p.x, p.y) and 0 <= p.line <= 201 for p in places)
        else:
            assert isinstance(result, ProgramError)


# --- the parent trusts nothing: bytes ----------------------------------------------------------

LENGTH = struct.Struct(">I")


@pytest.mark.parametrize(
    ("told", "reason"),
    [
        (b"", "closed"),
        (b"\x00\x00", "closed"),
        (LENGTH.pack(10) + b"123", "closed"),
        (LENGTH.pack(2**32 - 1) + b"123", "limit"),
        (LENGTH.pack(1_001) + b"123", "limit"),
        (LENGTH.pack(3) + b"1234", "more than one frame"),
    ],
)
def test_bytes_that_are_no_frame_are_refused(told, reason):
    ours, theirs = socket.socketpair()
    with ours:
        with theirs:
            theirs.sendall(told)
        with pytest.raises(FrameError, match=reason):
            frames.receive(ours, 1_000, frames.within(5))


@pytest.mark.parametrize("told", [b"", b"\x00\x00", LENGTH.pack(10) + b"123"])
def test_an_end_that_neither_speaks_nor_closes_meets_the_deadline(told):
    ours, theirs = socket.socketpair()
    with ours, theirs:
        theirs.sendall(told)
        with pytest.raises(frames.TooLate):
            frames.receive(ours, 1_000, frames.within(0.05))


def test_frames_of_every_size_arrive_whole():
    ours, theirs = socket.socketpair()
    with ours, theirs:
        for size in (0, 1, 65_531, 65_532, 65_533, 3_000_000):
            payload = random.Random(size).randbytes(size)
            sender = threading.Thread(target=frames.send, args=(theirs, payload))
            sender.start()
            assert frames.receive(ours, size, frames.within(5)) == payload
            sender.join()


LYING = """
import socket
from agent.language import frames

def main(descriptor):
    sock = socket.socket(fileno=descriptor)
    frames.send(sock, frames.encode(frames.Ready()))
    while True:
        frames.receive(sock, frames.MAX_REQUEST)
        sock.sendall({lie!r})
"""
"""A worker that was taken over and sends these bytes."""


@pytest.mark.parametrize(
    "lie",
    [
        LENGTH.pack(2**31) + b"x" * 100_000,
        LENGTH.pack(2) + b"{}",
        LENGTH.pack(len(reply())) + reply() + b"and more",
        LENGTH.pack(2_000_000) + b"[" * 2_000_000,
    ],
)
def test_a_worker_that_was_taken_over_fails_its_program_and_nothing_else(
    tmp_path, monkeypatch, lie
):
    (tmp_path / "lying_worker.py").write_text(LYING.format(lie=lie))
    monkeypatch.syspath_prepend(tmp_path)
    with Executor(worker="lying_worker") as executor:
        for _ in range(3):
            assert type(runs(executor)) is SolverFailed
