"""What survives the death of a worker: every request is answered or refused, none twice."""

import os
import random
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from program_scenes import GOOD, runs, table, thing, tray

from agent import execute
from agent.errors import SolverFailed
from agent.execute import Executor
from agent.messages import Draft
from evals.solver_storm import storm
from scene.types import Scene

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


def test_a_worker_that_waits_for_a_processor_is_not_late(monkeypatch):
    monkeypatch.setattr(execute._Worker, "_queued_s", lambda worker: time.monotonic())
    with Executor(deadline_s=0.3) as executor:
        assert isinstance(runs(executor), Draft)
        waiting = executor.pid
        os.kill(waiting, signal.SIGSTOP)
        threading.Timer(1.0, os.kill, (waiting, signal.SIGCONT)).start()
        assert isinstance(runs(executor), Draft)
        assert executor.pid == waiting


def test_not_even_a_worker_that_waits_for_a_processor_is_awaited_for_ever(monkeypatch):
    monkeypatch.setattr(execute._Worker, "_queued_s", lambda worker: time.monotonic())
    with Executor(deadline_s=0.05) as executor:
        assert isinstance(runs(executor), Draft)
        os.kill(executor.pid, signal.SIGSTOP)
        assert "deadline" in runs(executor).reason


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
