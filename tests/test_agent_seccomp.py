"""The worker's system-call filter: what it decides, call by call, and what nobody gets past it."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from agent.language.seccomp import ALLOWED, REFUSED, build

ROOT = Path(__file__).parent.parent
PID = 4_321
MACHINES = {"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)}
I386, ARM = 0x40000003, 0x40000028
X32 = 0x40000000
ALLOW, KILL, EPERM = 0x7FFF0000, 0x80000000, 0x00050001
FILTERED = pytest.mark.skipif(
    not sys.platform.startswith("linux") or os.uname().machine not in MACHINES,
    reason="no system-call filter on this system",
)


def decide(program, architecture, number, *arguments):
    """What the kernel would do: runs a filter on one system call, as classic BPF is defined."""
    words = [number, architecture, 0, 0]
    for argument in (*arguments, *[0] * 6)[:6]:
        words += [argument & 0xFFFFFFFF, argument >> 32]
    accumulator, at = 0, 0
    while True:
        code, then, otherwise, operand = program[at]
        at += 1
        if code == 0x20:  # load a word
            assert operand % 4 == 0
            accumulator = words[operand // 4]
        elif code == 0x54:  # and
            accumulator &= operand
        elif code == 0x15:  # jump if equal
            at += then if accumulator == operand else otherwise
        elif code == 0x06:  # return
            return operand
        else:
            raise AssertionError(f"operation {code:#x}")


@pytest.fixture(params=MACHINES)
def machine(request):
    return request.param


@pytest.fixture
def call(machine):
    """``call(name or number, *arguments)`` -> the filter's decision on this machine."""
    column, architecture = MACHINES[machine]
    program = build(machine, PID)
    numbers = {name: pair[column] for name, pair in {**ALLOWED, **REFUSED}.items()}

    def ask(what, *arguments, architecture=architecture):
        number = numbers[what] if isinstance(what, str) else what
        return decide(program, architecture, number, *arguments)

    return ask


HONEST = {
    "mmap": (0, 4096, 3, 0x22, 2**64 - 1, 0),
    "mprotect": (0x7000_0000_0000, 4096, 3),
    "madvise": (0x7000_0000_0000, 4096, 4),
    "futex": (0x7000_0000_0000, 128 | 256 | 9),
    "tgkill": (PID, PID, 6),
}
"""Arguments of an ordinary call, where zeros would not do."""


def test_every_number_is_decided_as_the_lists_say(machine, call):
    column, _ = MACHINES[machine]
    allowed = {pair[column]: name for name, pair in ALLOWED.items()}
    refused = {pair[column] for pair in REFUSED.values()}
    for number in range(601):
        arguments = HONEST.get(allowed.get(number), ())
        expected = ALLOW if number in allowed else EPERM if number in refused else KILL
        assert call(number, *arguments) == expected, number


def test_other_architectures_and_strange_numbers_are_killed(machine, call):
    for number in range(601):
        assert call(number, architecture=I386) == KILL
        assert call(number, architecture=ARM) == KILL
        assert call(number | X32) == KILL
    for number in (601, 2**31, 2**32 - 1):
        assert call(number) == KILL


def test_calls_that_open_the_world_are_on_no_list():
    never = {
        "clone", "clone3", "fork", "vfork", "execve", "execveat", "socket", "connect", "bind",
        "sendmsg", "recvmsg", "ptrace", "process_vm_readv", "kill", "tkill", "pidfd_send_signal",
        "ioctl", "fcntl", "personality", "prctl", "seccomp", "prlimit64", "setrlimit", "bpf",
        "io_uring_setup", "userfaultfd", "memfd_create", "shmat", "pkey_mprotect", "mount",
        "chroot", "unshare", "setns", "unlink", "unlinkat", "rename", "mkdir", "read", "close",
    }  # fmt: skip
    assert not never & {*ALLOWED, *REFUSED}


@pytest.mark.parametrize(
    ("name", "arguments", "decision"),
    [
        ("mmap", (0, 4096, 0), ALLOW),
        ("mmap", (0, 4096, 4), KILL),
        ("mmap", (0, 4096, 7), KILL),
        ("mmap", (0, 4096, 5 | 1 << 40), KILL),
        ("mprotect", (0, 4096, 1), ALLOW),
        ("mprotect", (0, 4096, 5), KILL),
        ("mremap", (0, 4096, 8192, 1), ALLOW),
        ("madvise", (0, 4096, 8), ALLOW),
        ("madvise", (0, 4096, 14), ALLOW),
        ("madvise", (0, 4096, 100), KILL),
        ("madvise", (0, 4096, 4 | 1 << 32), KILL),
        ("futex", (0, 0), ALLOW),
        ("futex", (0, 128 | 1), ALLOW),
        ("futex", (0, 128 | 256 | 10), ALLOW),
        ("futex", (0, 6), KILL),
        ("futex", (0, 128 | 11), KILL),
        ("futex", (0, 12), KILL),
        ("futex", (0, 1 << 32), KILL),
        ("tgkill", (PID, 99, 9), ALLOW),
        ("tgkill", (PID + 1, PID, 6), KILL),
        ("tgkill", (0, PID, 6), KILL),
        ("tgkill", (PID | 1 << 32, PID, 6), KILL),
        ("tgkill", (2**64 - 1, PID, 6), KILL),
        ("recvfrom", (4, 1, 65536, 0), ALLOW),
        ("recvfrom", (4, 1, 65536, 1), KILL),
        ("sendto", (4, 1, 65536, 1), KILL),
        ("sendto", (4, 1, 65536, 1 << 32), KILL),
    ],
)
def test_arguments_decide(call, name, arguments, decision):
    assert call(name, *arguments) == decision


def test_the_frequent_calls_are_decided_first(machine):
    program, column = build(machine, PID), MACHINES[machine][0]
    second = 5 + program[4].jf
    compared = [program[4].k, program[second].k]
    assert compared == [ALLOWED["recvfrom"][column], ALLOWED["sendto"][column]]


def test_the_kernel_would_take_the_program(machine):
    program = build(machine, PID)
    assert len(program) <= 4_096 and program[-1].code == 0x06
    for at, step in enumerate(program):
        assert 0 <= step.k < 2**32 and max(step.jt, step.jf) < 256
        assert step.code != 0x15 or at + 1 + max(step.jt, step.jf) < len(program)
        assert step.code != 0x20 or step.k < 64


def test_there_is_no_filter_for_an_unknown_machine():
    with pytest.raises(NotImplementedError, match="riscv64"):
        build("riscv64", PID)


@pytest.mark.parametrize(
    ("header", "column"),
    [("x86_64-linux-gnu/asm/unistd_64.h", 0), ("asm-generic/unistd.h", 1)],
)
def test_the_numbers_are_those_of_the_kernel(header, column):
    path = Path("/usr/include") / header
    if not path.exists():
        pytest.skip("no kernel headers here")
    defined = re.findall(r"#define\s+__NR(?:3264)?_(\w+)\s+(\d+)", path.read_text())
    numbers = {name: int(number) for name, number in defined}
    numbers.setdefault("newfstatat", numbers.get("fstatat"))
    for name, pair in {**ALLOWED, **REFUSED}.items():
        assert pair[column] in (None, numbers.get(name)), name


# --- for real ------------------------------------------------------------------------------------

CHILD = """
import ctypes, errno, fcntl, gc, mmap, os, resource, signal, socket, sys, threading, time
sys.path[:0] = {paths!r}
from agent.language import seccomp

libc = ctypes.CDLL(None, use_errno=True)
ours, theirs = socket.socketpair()
page = mmap.mmap(-1, 4096)
address = ctypes.addressof(ctypes.c_char.from_buffer(page))

def raw(*arguments):
    if libc.syscall(*map(ctypes.c_long, arguments)) < 0:
        raise OSError(ctypes.get_errno(), "refused")

def checked(result):
    if result < 0:
        raise OSError(ctypes.get_errno(), "refused")

{before}
seccomp.install()
try:
    {attempt}
except PermissionError:
    os._exit(77)
os._exit(0)
"""
REFUSED_STATUS, DEAD = 77, -signal.SIGSYS


def attempt(code, before=""):
    """How a process ends that filters itself and then does this: 0 if nothing stopped it."""
    paths = [str(ROOT), *filter(None, sys.path)]
    child = CHILD.format(paths=paths, attempt=code.replace("\n", "\n    "), before=before)
    done = subprocess.run([sys.executable, "-c", child], capture_output=True, text=True, timeout=60)
    return done.returncode


@FILTERED
@pytest.mark.parametrize(
    "code",
    [
        "open('/etc/passwd')",
        "open('/tmp/armchat-written', 'w')",
        "os.stat('/')",
        "os.lstat('/')",
        "os.readlink('/proc/self/exe')",
        "os.listdir('/')",
        "os.getcwd()",
        "os.write(1, b'x')",
        "checked(libc.access(b'/', 0))",
    ],
)
def test_naming_a_file_is_refused(code):
    assert attempt(code) == REFUSED_STATUS


@FILTERED
@pytest.mark.parametrize(
    "code",
    [
        "socket.socket()",
        "socket.socketpair()",
        "ours.connect('/tmp/socket')",
        "ours.sendmsg([b'x'])",
        "ours.recvmsg(1)",
        "ours.send(b'x', socket.MSG_OOB)",
        "ours.getsockname()",
        "os.fork()",
        "os.execv(sys.executable, [sys.executable])",
        "os.posix_spawn(sys.executable, [sys.executable], {})",
        "threading.Thread(target=print).start()",
        "os.kill(os.getppid(), 0)",
        "os.kill(os.getpid(), 0)",
        "raw(seccomp.ALLOWED['tgkill'][seccomp._ARCHITECTURES[os.uname().machine][0]], 1, 1, 0)",
        "libc.ptrace(0, 0, 0, 0)",
        "libc.personality(0)",
        "libc.prctl(4, 1, 0, 0, 0)",
        "fcntl.ioctl(0, 0x5412, b'x')",
        "fcntl.fcntl(0, fcntl.F_GETFL)",
        "mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_EXEC)",
        "libc.mprotect(ctypes.c_void_p(address), 4096, 5)",
        "libc.madvise(ctypes.c_void_p(address), 4096, 100)",
        "resource.setrlimit(resource.RLIMIT_CPU, (999, 999))",
        "os.unlink('/nowhere/file')",
        "os.mkdir('/nowhere/directory')",
        "os.chmod('/nowhere', 0o777)",
        "os.pipe()",
        "os.dup(0)",
        "os.read(0, 1)",
        "os.close(0)",
        "os.memfd_create('x')",
        "os.uname()",
        "time.sleep(0.001)",
        "signal.setitimer(signal.ITIMER_REAL, 1)",
        "raw(999)",
    ],
)
def test_what_a_worker_has_no_use_for_ends_it(code):
    assert attempt(code) == DEAD


@FILTERED
def test_what_a_worker_does_all_day_is_let_through():
    code = """
for size in (10, 300, 10_000, 300_000, 10_000_000):
    kept = [bytearray(size) for _ in range(20)]
    kept[0] += bytes(size)
    del kept
try:
    compile("x = (", "?", "exec")
    os._exit(1)
except SyntaxError:
    pass
try:
    bytearray(2**45)
    os._exit(2)
except MemoryError:
    pass
gc.collect()
threading.Lock().acquire()
time.monotonic(), time.time(), os.urandom(8), os.getpid()
signal.signal(signal.SIGXCPU, signal.SIG_DFL)
signal.pthread_kill(threading.get_ident(), 0)
ours.sendall(bytes(100_000))
theirs.recv(2**20)"""
    assert attempt(code) == 0


@FILTERED
def test_running_out_of_memory_is_survived():
    before = "resource.setrlimit(resource.RLIMIT_AS, (200 * 2**20, 200 * 2**20))"
    code = """
for size in (100, 5_000, 200_000):
    kept = []
    try:
        while True:
            kept.append(bytearray(size))
    except MemoryError:
        kept.clear()
gc.collect()
[bytearray(5_000) for _ in range(1_000)]"""
    assert attempt(code, before) == 0


@FILTERED
def test_abort_still_aborts():
    assert attempt("os.abort()") == -signal.SIGABRT


@FILTERED
@pytest.mark.skipif(os.uname().machine != "x86_64", reason="x86-64 only")
def test_calls_of_the_other_abis_end_the_process():
    assert attempt("raw(0x40000000 + 39)") == DEAD
    # mov eax, 20; int 0x80; ret: getpid of the 32-bit ABI, which numbers calls differently
    before = """
code = mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
code.write(bytes.fromhex("b814000000cd80c3"))
getpid = ctypes.CFUNCTYPE(ctypes.c_int)(ctypes.addressof(ctypes.c_char.from_buffer(code)))"""
    assert attempt("getpid()", before) in (DEAD, -signal.SIGSEGV)


@FILTERED
def test_a_filter_cannot_be_replaced():
    assert attempt("seccomp.load(seccomp.build(os.uname().machine, os.getpid()))") == DEAD
