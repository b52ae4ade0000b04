"""Programs run in a worker process: what comes back, what is refused, what survives a death."""

import os
import random
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path

import msgspec
import pytest

from agent.errors import (
    LimitReached,
    NotAllowed,
    ProgramError,
    ProgramFailed,
    SolverFailed,
    Unsatisfiable,
)
from agent.execute import Executor
from agent.language import frames
from agent.language import run as budgets
from agent.language.frames import Failure, FrameError, Reply, Request, Result
from agent.messages import Command, Draft, Placement
from agent.primitives import primitives
from evals.solver_storm import storm
from scene.types import Scene, SceneObject

GOOD = "robot.move(apple.x, 0, 0.5, 0)"


def thing(name, x=None, y=None, size=0.12, tall=0.1):
    return SceneObject(
        id=f"{name}_1", name=name, x=x, y=y, width=size, height=size, tall=tall,
        on="tray" if x is None else "table",
    )  # fmt: skip


def table(*names):
    return Scene(objects=tuple(thing(name, 0.2 * n, -0.1 * n) for n, name in enumerate(names)))


def tray(*names, objects=()):
    return Scene(objects=tuple(objects), tray=tuple(thing(name) for name in names))


@pytest.fixture(scope="module")
def executor():
    with Executor() as executor:
        yield executor


# --- one program, many scenes ------------------------------------------------------------------


def test_one_program_runs_on_many_scenes_in_order(executor):
    scenes = [Scene(objects=(thing("apple", n / 100, 0.0),)) for n in range(60)]
    results = executor.run(GOOD, "manipulate", scenes)
    assert [result.commands[0].x for result in results] == [n / 100 for n in range(60)]


def test_each_scene_has_its_own_names_and_its_own_outcome(executor):
    scenes = [table("apple"), table("pear"), table("pear", "apple")]
    source = "robot.move(1 / apple.x, 0, 0, 0)"
    first, second, third = executor.run(source, "manipulate", scenes)
    assert isinstance(first, ProgramFailed) and "division" in first.reason
    assert isinstance(second, NotAllowed) and "apple is unknown" in second.reason
    assert isinstance(third, Draft)


def test_scenes_too_large_to_send_are_refused_without_a_worker_dying(executor):
    before = executor.pid
    huge = Scene(objects=(thing("a" * 400_000, 0.0, 0.0),))
    (result, *_) = executor.run(GOOD, "manipulate", [huge] * 50)
    assert type(result) is SolverFailed and "bytes" in result.reason
    assert executor.pid == before


def test_no_scene_no_result(executor):
    assert executor.run(GOOD, "manipulate", []) == []


@pytest.mark.parametrize(
    ("source", "kind"),
    [
        ("import os", NotAllowed),
        ("x = 1\rimport os", NotAllowed),
        ("x = 1" + " " * 9000, NotAllowed),
        ("x = 1 / 0", ProgramFailed),
        ("while True:\n    pass", LimitReached),
    ],
)
def test_errors_are_values(executor, source, kind):
    (result,) = executor.run(source, "manipulate", [table("apple")])
    assert type(result) is kind


# --- arrange -----------------------------------------------------------------------------------


def places(executor, source, scene):
    (draft,) = executor.run(source, "arrange", [scene])
    assert isinstance(draft, Draft), draft
    return {p.object: (p.x, p.y) for p in draft.placements}


def failure(executor, source, scene):
    (error,) = executor.run(source, "arrange", [scene])
    assert isinstance(error, ProgramError), error
    return error


def test_constraints_become_placements_in_order_of_first_use(executor):
    source = """\
solver.addConstraint(orange.x == 0.3)
solver.addConstraint(apple.x + apple.width / 2 + 0.05 <= orange.x - orange.width / 2)
solver.addConstraint((apple.y == orange.y) | "strong")
solver.addConstraint(orange.y == 0.5)"""
    (draft,) = executor.run(source, "arrange", [tray("apple", "orange", "cup")])
    assert [(p.object, p.line) for p in draft.placements] == [("orange_1", 1), ("apple_1", 2)]
    orange, apple = draft.placements
    assert (orange.x, orange.y, apple.y) == pytest.approx((0.3, 0.5, 0.5))
    assert apple.x <= 0.3 - 0.12 - 0.05 + 1e-6


def test_what_the_program_never_constrains_stays_in_the_tray(executor):
    source = "solver.addConstraint(apple.x + cup.width == 0)"
    assert set(places(executor, source, tray("apple", "cup"))) == {"apple_1"}
    assert places(executor, "x = apple.width", tray("apple")) == {}


def test_an_intermediate_solution_can_be_looked_at(executor):
    source = """\
gap = Variable("gap")
solver.addConstraint(gap >= 0.2)
solver.addConstraint(apple.x == -0.5)
solver.solve()
if apple.x.value() < 0:
    solver.addConstraint(orange.x == -apple.x.value())
solver.addConstraint((orange.y - apple.y == gap) | "strong")
solver.addConstraint(apple.y == 0)
solver.solve()
solver.addConstraint((cup.y == (orange.y - apple.y).value() / 2) | "medium")
solver.addConstraint(cup.x == 0)"""
    result = places(executor, source, tray("apple", "orange", "cup"))
    assert result["orange_1"] == pytest.approx((0.5, 0.2))
    assert result["cup_1"] == pytest.approx((0.0, 0.1))


def test_objects_on_the_table_are_numbers(executor):
    scene = tray("apple", objects=[thing("plate", 0.4, -0.3)])
    source = """\
solver.addConstraint(apple.x == plate.x - 0.5)
solver.addConstraint(apple.y == plate.y.value())
solver.addConstraint(plate.x <= 1)"""
    assert places(executor, source, scene)["apple_1"] == pytest.approx((-0.1, -0.3))


def test_strengths_decide_between_wishes(executor):
    source = """\
solver.addConstraint((apple.x == -0.5) | "weak")
solver.addConstraint((apple.x == 0.5) | "strong")
solver.addConstraint((apple.y == 0.1) | "medium")
solver.addConstraint((apple.y == 0.2) | "required")"""
    assert places(executor, source, tray("apple"))["apple_1"] == pytest.approx((0.5, 0.2))


def test_every_placed_object_stays_on_the_table(executor):
    scene = tray("apple")
    source = 'solver.addConstraint((apple.x == 5) | "strong")'
    assert places(executor, source, scene)["apple_1"][0] == pytest.approx(1 - 0.06)
    error = failure(executor, "x = 0\nsolver.addConstraint(apple.x >= 0.95)", scene)
    assert type(error) is Unsatisfiable and error.line == 2


def test_freedom_is_resolved_towards_the_middle(executor):
    assert places(executor, "solver.addConstraint(apple.x >= 0.5)", tray("apple")) == {
        "apple_1": pytest.approx((0.5, 0.0))
    }


def overlap(one, other, size=0.12):
    return all(abs(a - b) < size - 1e-6 for a, b in zip(one, other, strict=True))


def test_objects_left_free_to_overlap_are_moved_apart(executor):
    source = """\
solver.addConstraint(apple.x >= -0.5)
solver.addConstraint(orange.x >= -0.5)
solver.addConstraint((cup.x == 0) | "strong")"""
    scene = tray("apple", "orange", "cup", objects=[thing("plate", 0.0, 0.0)])
    result = [*places(executor, source, scene).values(), (0.0, 0.0)]
    pairs = [(a, b) for n, a in enumerate(result) for b in result[:n]]
    assert not any(overlap(a, b) for a, b in pairs)
    assert result[2][0] == pytest.approx(0.0)


def test_moving_apart_keeps_required_and_strong_constraints(executor):
    source = """\
solver.addConstraint(apple.y == 0)
solver.addConstraint((apple.x <= -0.1) | "strong")"""
    scene = tray("apple", objects=[thing("plate", -0.1, 0.0)])
    x, y = places(executor, source, scene)["apple_1"]
    assert (x, y) == pytest.approx((-0.1 - 0.12 - 0.03, 0.0))


def test_an_overlap_that_the_program_demands_is_left_alone(executor):
    source = "solver.addConstraint(apple.x == plate.x)\nsolver.addConstraint(apple.y == plate.y)"
    scene = tray("apple", objects=[thing("plate", 0.3, 0.3, size=0.4, tall=0.02)])
    assert places(executor, source, scene)["apple_1"] == pytest.approx((0.3, 0.3))


def test_the_same_program_always_gives_the_same_placements(executor):
    source = 'gap = Variable("gap")\nsolver.addConstraint(cup.x + gap >= orange.x - 0.3)\n'
    names = ("apple", "orange", "cup", "pear", "plum")
    source += "\n".join(f"solver.addConstraint({n}.x <= 0.2 + gap)" for n in names)
    results = executor.run(source, "arrange", [tray(*names)] * 20)
    with Executor() as another:
        results += another.run(source, "arrange", [tray(*names)] * 5)
    assert all(result == results[0] for result in results)


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("solver.addConstraint(0 <= apple.x <= 1)", "no a <= b <= c"),
        ("solver.addConstraint(apple.x <= 1 and apple.x >= 0)", "neither true nor false"),
        ("if apple.x >= 0:\n    pass", "to test, call solver.solve()"),
        ("if apple.x:\n    pass", "use .value() in tests"),
        ("x = not (apple.x == 1)", "neither true nor false"),
        ("solver.addConstraint(apple.x < 1)", "<=, >= or =="),
        ("solver.addConstraint(apple.x != 1)", "<=, >= or =="),
        ("solver.addConstraint(apple.x * orange.x == 1)", "cannot be multiplied"),
        ("solver.addConstraint(1 / apple.x == 1)", "not linear"),
        ("solver.addConstraint(apple.x ** 2 == 1)", "not an unknown"),
        ("solver.addConstraint(abs(apple.x) <= 1)", "add two constraints"),
        ("solver.addConstraint(max(apple.x, 0) <= 1)", "not an unknown"),
        ("solver.addConstraint(math.sin(apple.x) <= 1)", "not an unknown"),
        ("solver.addConstraint(apple.x)", "not an unknown"),
        ("solver.addConstraint(3)", "needs a comparison"),
        ("solver.addConstraint(apple.x | 'strong')", "belongs to a constraint"),
        ("x = [apple.x, 1]\ny = 1 in x", "neither true nor false"),
        ("x = apple.x.value()", "call solver.solve() before"),
        ("solver.addConstraint(apple.x == 0)\nsolver.solve()\nx = orange.x.value()",
         "add a constraint on it"),
        ("solver.addConstraint(apple.x * 1e9 <= 1)", "too large"),
        ("solver.addConstraint(apple.x <= 1e300)", "too large"),
        ("x = Variable(3)", "needs a name"),
    ],
)  # fmt: skip
def test_wrong_use_of_unknowns_is_explained(executor, source, reason):
    assert reason in failure(executor, source, tray("apple", "orange")).reason


@pytest.mark.parametrize(
    "source",
    [
        "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.x == 0.5)",
        "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.x - apple.x == 1)",
        "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.width >= 3)",
    ],
)
def test_constraints_that_cannot_all_hold_name_the_line(executor, source):
    error = failure(executor, source, tray("apple"))
    assert type(error) is Unsatisfiable and error.line == 2


def test_constraints_and_unknowns_have_budgets(executor):
    many = "for i in range(201):\n    solver.addConstraint(apple.x >= -0.5 - i)"
    assert type(failure(executor, many, tray("apple"))) is LimitReached
    free = "for i in range(101):\n    x = Variable('x')"
    assert type(failure(executor, free, tray("apple"))) is LimitReached
    doubled = "e = apple.x\nfor i in range(15):\n    e = e + e\nsolver.addConstraint(e == 0)"
    assert "apple_1" in places(executor, doubled, tray("apple"))


# --- the worker dies of a program --------------------------------------------------------------

ABORTS = """\
v0, v1, v2 = Variable("v0"), Variable("v1"), Variable("v2")
v3, v4, v5 = Variable("v3"), Variable("v4"), Variable("v5")
solver.addConstraint((2 * v5 + 100 * v4 + 1 * v2 + 3 * v3 + -2 == 0) | "medium")
solver.addConstraint((-0.5 * v3 + 0 == 0) | "strong")
solver.addConstraint((2 * v1 + -1 * v0 + -3 * v4 + 100 * v2 + -1 * v5 + 1 <= 0) | "medium")
solver.addConstraint((100 * v3 + -0.01 * v4 + 2 == 0) | "strong")
solver.addConstraint((100 * v5 + -3 * v3 + 100 * v2 + 0 >= 0) | "strong")
"""
"""An ordinary, finite system on which kiwisolver 1.5 aborts its process."""


def runs(executor, source=GOOD):
    (result,) = executor.run(source, "manipulate", [table("apple")])
    return result


def test_a_system_that_aborts_the_solver_costs_nothing_but_its_own_answer(executor):
    results = executor.run(ABORTS, "arrange", [tray("apple")] * 2)
    assert [type(result) for result in results] == [SolverFailed] * 2
    assert "gave up on these constraints" in results[0].reason
    assert isinstance(runs(executor), Draft)


def test_a_worker_that_does_not_answer_in_time_is_killed_and_replaced():
    with Executor(deadline_s=0.3) as executor:
        assert isinstance(runs(executor), Draft)
        stuck = executor.pid
        os.kill(stuck, signal.SIGSTOP)
        result = runs(executor)
        assert type(result) is SolverFailed and "deadline" in result.reason
        with pytest.raises(ProcessLookupError):
            os.kill(stuck, 0)
        assert isinstance(runs(executor), Draft)


@pytest.mark.parametrize(
    ("signum", "words"),
    [
        (signal.SIGSEGV, "crashed"),
        (signal.SIGXCPU, "processor time"),
        (signal.SIGALRM, "signal 14"),
        (signal.SIGRTMIN + 3, "signal 37"),
    ],
)
def test_what_a_worker_died_of_is_said_and_the_program_not_run_again(dying, log, signum, words):
    result = runs(dying, f"x = {int(signum)}")
    assert type(result) is SolverFailed and words in result.reason
    assert log.read_text() == "asked\n"
    assert isinstance(runs(dying, "x = 0"), Draft)


def test_a_worker_that_ends_by_itself_is_not_asked_again(dying, log):
    assert "by itself, with status 3" in runs(dying, "x = 103").reason
    assert log.read_text() == "asked\n"


def test_a_program_whose_worker_is_killed_twice_is_given_up(dying, log):
    result = runs(dying, f"x = {int(signal.SIGKILL)}")
    assert type(result) is SolverFailed and "killed from outside" in result.reason
    assert log.read_text() == "asked\n" * 2


DYING = """
import os
from pathlib import Path
from agent.language import frames, worker

def main(descriptor):
    import socket
    sock = socket.socket(fileno=descriptor)
    frames.send(sock, frames.encode(frames.Ready()))
    while True:
        request = frames.receive(sock, frames.MAX_REQUEST)
        with Path({log!r}).open("a") as log:
            log.write("asked\\n")
        number = int(frames.read_request(request).source.split()[-1])
        if 0 < number < 100:
            os.kill(os.getpid(), number)
        if number >= 100:
            os._exit(number - 100)
        frames.send(sock, worker.answer(request))
"""
"""A worker that kills itself by the signal, or ends with the status, that the program names."""


@pytest.fixture
def log(tmp_path):
    """Where the workers of `dying` write a line for each request."""
    return tmp_path / "asked"


@pytest.fixture
def dying(tmp_path, monkeypatch, log):
    (tmp_path / "dying_worker.py").write_text(DYING.format(log=str(log)))
    monkeypatch.syspath_prepend(tmp_path)
    with Executor(worker="dying_worker") as executor:
        yield executor


def test_workers_that_never_start_are_given_up_too(tmp_path, monkeypatch):
    (tmp_path / "broken_worker.py").write_text("def main(descriptor): raise SystemExit")
    monkeypatch.syspath_prepend(tmp_path)
    with Executor(worker="broken_worker") as executor:
        result = runs(executor)
        assert type(result) is SolverFailed and "did not start" in result.reason
        assert not executor.hardened


# --- the worker dies for another reason --------------------------------------------------------


def test_a_killed_worker_is_replaced_and_the_program_asked_again(executor):
    for _ in range(3):
        os.kill(executor.pid, signal.SIGKILL)
        assert isinstance(runs(executor), Draft)


def test_worker_and_spare_killed_at_once_are_replaced(executor):
    assert executor.hardened
    killed = children()
    for pid in killed:
        os.kill(pid, signal.SIGKILL)
    for pid in killed:
        os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)
    assert isinstance(runs(executor), Draft)
    assert executor.hardened


def children():
    """Process ids of this process's children."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == os.getpid():
            found.append(int(stat.parent.name))
    return found


def test_the_spare_answers_when_the_worker_is_killed_or_aborts(executor):
    def killed():
        os.kill(executor.pid, signal.SIGKILL)

    def aborted():
        assert isinstance(executor.run(ABORTS, "arrange", [tray("apple")])[0], SolverFailed)

    for end in (killed, aborted) * 3:
        assert executor.hardened  # and the spare is ready
        ready = set(children()) - {executor.pid}
        end()
        assert isinstance(runs(executor), Draft)
        assert executor.pid in ready, "nobody waited for a new one"


def test_an_interrupted_exchange_does_not_answer_the_next_program(executor):
    slow = "x = 0\nwhile x < 20000:\n    x += 1"
    previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(KeyboardInterrupt):
            executor.run(slow, "manipulate", [table("apple")] * 50)
    finally:
        signal.signal(signal.SIGALRM, previous)
    assert len(runs(executor).commands) == 1


def test_workers_are_replaced_after_so_many_requests():
    with Executor(recycle_requests=3) as executor:
        assert executor.hardened
        seen = []
        for _ in range(7):
            seen.append(executor.pid)
            assert isinstance(runs(executor), Draft)
        assert [seen.count(pid) for pid in dict.fromkeys(seen)] == [3, 3, 1]


def test_an_executor_that_was_closed_starts_again_on_demand():
    executor = Executor()
    try:
        runs(executor)
        executor.close()
        assert isinstance(runs(executor), Draft)
    finally:
        executor.close()


def test_under_random_kills_every_request_is_answered_or_refused_and_none_twice():
    rng = random.Random(3)
    outcomes: list[tuple[float, object]] = []
    over = threading.Event()

    def ask(first):
        number = first
        while not over.is_set():
            scene = Scene(objects=(thing("apple", number / 1e6, 0.0),))
            if number % 50 == 7:
                (result,) = executor.run(ABORTS, "arrange", [tray("apple")])
            else:
                (result,) = executor.run(GOOD, "manipulate", [scene])
            outcomes.append((number / 1e6, result))
            number += 4

    with Executor() as executor:
        threads = [threading.Thread(target=ask, args=(n,)) for n in range(4)]
        for thread in threads:
            thread.start()
        kills, until = 0, time.monotonic() + 60
        while (kills < 15 or len(outcomes) < 40) and time.monotonic() < until:
            over.wait(rng.uniform(0.03, 0.07))
            try:
                os.kill(executor.pid, signal.SIGKILL)
                kills += 1
            except ProcessLookupError:
                continue
        over.set()
        for thread in threads:
            thread.join()
        assert isinstance(runs(executor), Draft)
    assert kills >= 15
    drafts = [(x, result) for x, result in outcomes if isinstance(result, Draft)]
    assert all(result.commands[0].x == x for x, result in drafts)
    assert all(isinstance(result, Draft | SolverFailed) for _, result in outcomes)
    assert len({x for x, _ in outcomes}) == len(outcomes) and len(drafts) > 10


def test_random_systems_are_solved_refused_or_given_up_and_nothing_else(executor):
    counts = storm(executor, 300, seed=11)
    assert counts["other"] == 0 and counts["solved"] > 100 and counts["unsatisfiable"] > 20
    assert isinstance(runs(executor), Draft)


def test_neither_solver_nor_interpreter_is_loaded_in_the_parent():
    code = (
        "import sys\n"
        "from agent.check import check\n"
        "from agent.execute import Executor\n"
        "from scene.types import Scene\n"
        "with Executor() as executor:\n"
        "    executor.run('x = 1', 'arrange', [Scene()])\n"
        "inside = ('kiwisolver', 'agent.language.interpret', 'agent.language.worker')\n"
        "print([m for m in inside if m in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"


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
            frames.receive(ours, 1_000, time.monotonic() + 5)


@pytest.mark.parametrize("told", [b"", b"\x00\x00", LENGTH.pack(10) + b"123"])
def test_an_end_that_neither_speaks_nor_closes_meets_the_deadline(told):
    ours, theirs = socket.socketpair()
    with ours, theirs:
        theirs.sendall(told)
        with pytest.raises(frames.TooLate):
            frames.receive(ours, 1_000, time.monotonic() + 0.05)


def test_frames_of_every_size_arrive_whole():
    ours, theirs = socket.socketpair()
    with ours, theirs:
        for size in (0, 1, 65_531, 65_532, 65_533, 3_000_000):
            payload = random.Random(size).randbytes(size)
            sender = threading.Thread(target=frames.send, args=(theirs, payload))
            sender.start()
            assert frames.receive(ours, size, time.monotonic() + 5) == payload
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


# --- primitives --------------------------------------------------------------------------------


def test_placements_become_pick_and_place_motions():
    scene = tray("apple")
    motions = primitives(Draft(placements=(Placement("apple_1", 0.2, -0.3, 4),)), scene)
    assert [(c.op, c.grip) for c in motions] == [
        ("move", False), ("move", False), ("grip", True), ("move", True), ("move", True),
        ("move", True), ("grip", False), ("move", False),
    ]  # fmt: skip
    pick, place = motions[2], motions[6]
    assert (pick.x > 1, pick.z) == (True, 0.1)
    assert (place.x, place.y, place.z) == (0.2, -0.3, 0.1)
    assert {c.line for c in motions} == {4}


def test_what_is_placed_on_something_is_let_go_on_its_top_and_after_it():
    scene = Scene(
        objects=(thing("box", 0.0, 0.0, size=0.5, tall=0.2),),
        tray=(thing("apple"), thing("plate", size=0.4, tall=0.02)),
    )
    draft = Draft(placements=(Placement("apple_1", 0.0, 0.0, 1), Placement("plate_1", 0.0, 0.0, 2)))
    releases = [c for c in primitives(draft, scene) if c.op == "grip" and not c.grip]
    assert [(c.line, pytest.approx(c.z)) for c in releases] == [(2, 0.22), (1, 0.32)]


def test_tall_things_are_carried_above_everything_that_stands():
    scene = Scene(objects=(thing("lamp", 0.0, 0.0, tall=0.8),), tray=(thing("bottle", tall=0.4),))
    motions = primitives(Draft(placements=(Placement("bottle_1", 0.5, 0.5),)), scene)
    assert max(c.z for c in motions) >= 1.2


def test_an_object_without_a_place_in_the_tray_cannot_be_placed():
    scene = Scene(tray=(thing("board", size=3.9),))
    with pytest.raises(ProgramError, match="no room"):
        primitives(Draft(placements=(Placement("board_1", 0.0, 0.0, 1),)), scene)


def test_the_primitives_of_a_manipulate_program_are_its_commands():
    commands = (Command("move", 0.0, 0.0, 0.5, 0.0, False, 1),)
    assert primitives(Draft(commands=commands), Scene()) == commands
