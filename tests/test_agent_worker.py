"""The worker process: what it holds, what it answers once it is shut in, when it ends."""

import os
import select
import subprocess
import sys
from pathlib import Path

import pytest

from agent import execute
from agent.errors import LimitReached, NotAllowed, ProgramFailed, Unsatisfiable
from agent.execute import Executor
from agent.messages import Draft
from scene.types import Scene, SceneObject

ROOT = Path(__file__).parent.parent
LINUX = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")

GOOD = "robot.move(apple.x, 0, 0.5, 0)"
APPLE = SceneObject(id="apple", name="apple", x=0.1, y=0.0, width=0.1, height=0.1, tall=0.1)
PEAR = SceneObject(id="pear", name="pear", width=0.1, height=0.1, tall=0.1, on="tray")
SCENE = Scene(objects=(APPLE,), tray=(PEAR,))


def run(executor, source, kind="manipulate"):
    (result,) = executor.run(source, kind, [SCENE])
    return result


# --- what it holds -----------------------------------------------------------------------------


@LINUX
def test_the_system_calls_of_worker_and_spare_are_filtered(executor):
    assert executor.hardened
    status = (Path("/proc") / str(executor.pid) / "status").read_text()
    assert "Seccomp:\t2" in status and "NoNewPrivs:\t1" in status and "Threads:\t1" in status


@LINUX
def test_nothing_is_inherited_but_one_socket(executor):
    with Path(os.devnull).open() as other:
        os.set_inheritable(other.fileno(), True)
        with Executor() as another:
            assert another.hardened
            process = Path("/proc") / str(another.pid)
            assert (process / "environ").read_bytes() == b""
            held = {int(fd.name): str(fd.readlink()) for fd in (process / "fd").iterdir()}
    assert [held.pop(stream) for stream in (0, 1, 2)] == [os.devnull] * 3
    assert len(held) == 1 and next(iter(held.values())).startswith("socket:")


@LINUX
def test_it_has_its_own_session_and_limits(executor):
    assert executor.hardened
    assert os.getsid(executor.pid) == executor.pid
    lines = (Path("/proc") / str(executor.pid) / "limits").read_text().splitlines()
    limits = {line[:26].strip(): line[26:].split()[:2] for line in lines}
    assert limits["Max open files"] == ["0", "0"]
    assert limits["Max processes"] == ["0", "0"]
    assert limits["Max file size"] == ["0", "0"]
    assert limits["Max address space"] == [str(256 * 2**20)] * 2
    assert limits["Max cpu time"] == ["20", "21"]
    longest = execute.DEADLINE_S + execute.SCENE_S * execute.BATCH
    assert execute.RECYCLE_BUSY_S + longest < 20


@LINUX
def test_no_page_can_be_written_and_executed(executor):
    assert executor.hardened
    maps = (Path("/proc") / str(executor.pid) / "maps").read_text().splitlines()
    assert not [line for line in maps if "wx" in line.split()[1]]


# --- what it answers ---------------------------------------------------------------------------

FULL = f"""\
some = []
for i in range(500):
    some.append(i)
kept = []
for i in range(200):
    row = []
    for j in range(11):
        row.append([{", ".join(["some + some"] * 20)}])
    kept.append(row)
"""
"""Keeps 44,000 lists of 1,000 elements: more memory than there is, within the steps there are."""


@pytest.mark.parametrize(
    ("source", "kind", "outcome", "reason"),
    [
        (GOOD, "manipulate", Draft, ""),
        ("robot.move(nearest([apple], [0, 0]).x, 0, 1, 0)", "manipulate", Draft, ""),
        ("solver.addConstraint(pear.x == 0)", "arrange", Draft, ""),
        ("robot.move(", "manipulate", NotAllowed, "not valid Python"),
        ("x = 'no end", "manipulate", NotAllowed, "not valid Python"),
        ("if apple:\n  x = 1\n x = 2", "manipulate", NotAllowed, "not valid Python"),
        ("x = 0b12", "manipulate", NotAllowed, "not valid Python"),
        ("x = 1if apple else 2", "manipulate", Draft, ""),
        ("x = 1 is 1", "manipulate", NotAllowed, "is compares"),
        ("x = 1(2)", "manipulate", NotAllowed, "only named functions"),
        ("x = " + "-" * 59 + "1", "manipulate", Draft, ""),
        ("x = " + "- " * 100 + "1", "manipulate", NotAllowed, "operators"),
        ("import os", "manipulate", NotAllowed, "import"),
        ("x = 1\rimport os", "manipulate", NotAllowed, "character"),
        ("x = '\udcff'", "manipulate", NotAllowed, "character"),
        ("x" * 9_000, "manipulate", NotAllowed, "longer"),
        ("x = aple.x", "manipulate", NotAllowed, "did you mean apple"),
        ("robot.mvoe(0, 0, 0, 0)", "manipulate", NotAllowed, "did you mean robot.move"),
        ("x = nearst([apple], [0, 0])", "manipulate", NotAllowed, "nearest"),
        ("x = 1 / 0", "manipulate", ProgramFailed, "division"),
        ("x = 2 ** 0.5 ** 9e9 * 9e307 * 9", "manipulate", ProgramFailed, "finite"),
        ("x = math.sqrt(-1)", "manipulate", ProgramFailed, "math.sqrt"),
        ("robot.move(1e10, 0, 0, 0)", "manipulate", ProgramFailed, "far outside"),
        ("robot.move(0, 0, 0, -1e300)", "manipulate", ProgramFailed, "far outside"),
        ("while True:\n    pass", "manipulate", LimitReached, "steps"),
        ("for i in range(501):\n    robot.grip(True)", "manipulate", LimitReached, "500"),
        ("a = []\na.append(a)\nx = a == a", "manipulate", LimitReached, "lists"),
        (
            "solver.addConstraint(pear.x == 0)\nsolver.addConstraint(pear.x == 1)",
            "arrange",
            Unsatisfiable,
            "cannot hold",
        ),
        (
            "solver.addConstraint(pear.x == 0)\nsolver.solve()\ny = pear.y.value() ** pear.x",
            "arrange",
            ProgramFailed,
            "not an unknown",
        ),
        ("solver.addConstraint(pear.x * 1e9 <= 1)", "arrange", ProgramFailed, "too large"),
    ],
)
def test_every_kind_of_answer_comes_from_behind_the_filter(executor, source, kind, outcome, reason):
    result = run(executor, source, kind)
    assert type(result) is outcome, result
    assert reason in getattr(result, "reason", "")


def test_a_program_that_fills_the_memory_is_told_so_and_the_worker_lives():
    with Executor(deadline_s=30) as executor:
        assert executor.hardened
        before = executor.pid
        result = run(executor, FULL)
        assert type(result) is LimitReached and "memory" in result.reason
        assert isinstance(run(executor, GOOD), Draft)
        assert executor.pid == before


def test_many_scenes_with_long_plans_come_back_whole(executor):
    source = "for i in range(500):\n    robot.move(apple.x + i / 7, i / 3, 0.123456789, i / 11)"
    results = executor.run(source, "manipulate", [SCENE] * 50)
    assert {len(result.commands) for result in results} == {500}


# --- when it ends ------------------------------------------------------------------------------

PARENT = """
import contextlib, os, sys, threading
from pathlib import Path
sys.path[:0] = {paths!r}
from agent.execute import Executor
from scene.types import Scene

def stat(pid):
    return (Path("/proc") / str(pid) / "stat").read_text().rpartition(")")[2].split()

def ticks(pid):
    return int(stat(pid)[11])

def children():
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if stat(process.name)[1] == str(os.getpid()):
                yield process.name

executor = Executor(deadline_s=60)
assert executor.hardened
worker = executor.pid
workers = list(children())
if {busy}:
    program = "while True: pass", "manipulate", [Scene()] * 50
    threading.Thread(target=executor.run, args=program, daemon=True).start()
    before = ticks(worker)
    while ticks(worker) < before + 5:
        pass
print(*workers, flush=True)
sys.stdin.read()
"""


@LINUX
@pytest.mark.parametrize("busy", [False, True])
def test_worker_and_spare_end_with_their_parent(busy):
    code = PARENT.format(paths=[str(ROOT), *filter(None, sys.path)], busy=busy)
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as parent:
        handles = [os.pidfd_open(int(pid)) for pid in parent.stdout.readline().split()]
        parent.kill()
    assert len(handles) == 2
    for handle in handles:
        end = select.poll()
        end.register(handle, select.POLLIN)
        assert end.poll(20_000)
        os.close(handle)


# --- without the filter ------------------------------------------------------------------------

REFUSING = """
import errno, logging, sys
sys.path[:0] = {paths!r}
from agent.language import seccomp
from agent.language.seccomp import Instruction

# A kernel that knows no prctl: this process and all its children are told so.
prctl = {{"x86_64": 157, "aarch64": 167}}[__import__("os").uname().machine]
seccomp.load((
    Instruction(0x20, 0, 0, 0),
    Instruction(0x15, 0, 1, prctl),
    Instruction(0x06, 0, 0, 0x00050000 | errno.EINVAL),
    Instruction(0x06, 0, 0, 0x7FFF0000),
))
logging.basicConfig(format="%(levelname)s %(message)s", stream=sys.stdout)
from agent.execute import Executor
from scene.types import Scene
with Executor(recycle_requests=1) as executor:
    for _ in range(3):
        print(executor.run("robot.move(0, 0, 1, 0)", "manipulate", [Scene()])[0].steps > 0)
    print(executor.run("x = (", "manipulate", [Scene()])[0].reason)
    print(executor.hardened)
"""


@LINUX
def test_where_the_kernel_refuses_the_worker_serves_and_says_so_once():
    code = REFUSING.format(paths=[str(ROOT), *filter(None, sys.path)])
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    assert [line for line in lines if line.startswith("WARNING")] == [lines[0]]
    assert "without a system-call filter" in lines[0] and "Invalid argument" in lines[0]
    assert lines[1:4] == ["True"] * 3
    assert "was never closed" in lines[4] and lines[5] == "False"
