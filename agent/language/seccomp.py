"""A system-call filter for the worker: what it needs after its start is allowed, nothing else.

Seccomp-BPF by hand: the list is short, and the usual library for it is LGPL. `build` is pure: a
machine and a process id in, a program for the kernel's filter machine out. `install` loads it
into this process, for good.

Protects against: code that took the worker over and asks the kernel for anything but memory, the
time and its one socket. Naming a file fails with EPERM (no death: CPython opens a file on every
SyntaxError). A new process, thread or socket, a signal to another process, an executable page,
ptrace, ioctl, a call of another architecture or of the x32 ABI: each kills the process at once.
Does not protect against: bytes on the socket (the parent believes none of them), what is in the
worker's memory (there is no secret), time and memory (resource limits, the parent's deadline),
faults of the kernel in the calls that are left. Three calls that had such faults, or can do harm
as root, are narrowed by argument: no out-of-band data, no priority futexes, no advice but three.
"""

from __future__ import annotations

import ctypes
import errno
import os
import struct
import sys
from typing import NamedTuple

Numbers = dict[str, tuple[int | None, int | None]]
"""Name of a system call -> its number on x86-64 and on aarch64; None: it has no such call."""

ALLOWED: Numbers = {
    # the socket: two calls a request
    "recvfrom": (45, 207),
    "sendto": (44, 206),
    # memory
    "brk": (12, 214),
    "mmap": (9, 222),
    "munmap": (11, 215),
    "mremap": (25, 216),  # keeps a mapping's protection, so it makes nothing executable
    "madvise": (28, 233),
    "mprotect": (10, 226),
    # locks, clocks (not every machine has them without a call), random numbers
    "futex": (202, 98),
    "clock_gettime": (228, 113),
    "getrandom": (318, 278),
    "restart_syscall": (219, 128),
    # the end: of a signal's handler, of the process, and of the solver, which calls abort()
    "rt_sigreturn": (15, 139),
    "rt_sigprocmask": (14, 135),
    "rt_sigaction": (13, 134),
    "getpid": (39, 172),
    "gettid": (186, 178),
    "tgkill": (234, 131),
    "exit": (60, 93),
    "exit_group": (231, 94),
}
"""The frequent ones first: the kernel walks the filter from its top."""
REFUSED: Numbers = {
    # files, by name
    "openat": (257, 56),
    "open": (2, None),
    "openat2": (437, 437),
    "creat": (85, None),
    "stat": (4, None),
    "lstat": (6, None),
    "newfstatat": (262, 79),
    "statx": (332, 291),
    "statfs": (137, 43),
    "access": (21, None),
    "faccessat": (269, 48),
    "faccessat2": (439, 439),
    "readlink": (89, None),
    "readlinkat": (267, 78),
    "getcwd": (79, 17),
    # the last words of abort(), and what malloc asks when memory runs out: both do without
    "write": (1, 64),
    "writev": (20, 66),
    "fstat": (5, 80),
    "sched_getaffinity": (204, 123),
    "sysinfo": (99, 179),
}
"""These fail with EPERM; all that is on neither list kills."""


class Only(NamedTuple):
    """A call is allowed while ``argument & mask`` is one of ``values``, else it kills."""

    argument: int
    mask: int
    values: tuple[int, ...]


_ALL = 2**64 - 1
_PROT_EXEC = 4
_FUTEX_FLAGS = 128 | 256  # private; realtime clock


def _conditions(pid: int) -> dict[str, Only]:
    return {
        "recvfrom": Only(3, _ALL, (0,)),  # flags: MSG_OOB has broken sandboxes
        "sendto": Only(3, _ALL, (0,)),
        "mmap": Only(2, _PROT_EXEC, (0,)),
        "mprotect": Only(2, _PROT_EXEC, (0,)),
        "madvise": Only(2, _ALL, (4, 8, 14)),  # DONTNEED, FREE, HUGEPAGE
        "futex": Only(1, _ALL ^ _FUTEX_FLAGS, (0, 1, 9, 10)),  # WAIT, WAKE, and by bit set
        "tgkill": Only(0, _ALL, (pid,)),
    }


# --- the program ---------------------------------------------------------------------------------


class Instruction(NamedTuple):
    """One instruction of classic BPF: operation, jumps if true and if false, operand."""

    code: int
    jt: int
    jf: int
    k: int


_ARCHITECTURES = {"x86_64": (0, 0xC000_003E), "aarch64": (1, 0xC000_00B7)}
"""Machine -> its column in the tables, and AUDIT_ARCH_* of its 64-bit calls."""
_NUMBER, _ARCHITECTURE, _ARGUMENTS = 0, 4, 16
"""Offsets in ``struct seccomp_data``; an argument is eight bytes, the low half first."""
_KILL_PROCESS, _ERRNO, _ALLOW = 0x8000_0000, 0x0005_0000, 0x7FFF_0000


def build(machine: str, pid: int) -> tuple[Instruction, ...]:
    """The filter for a process on a machine (as ``uname -m`` says). Raises NotImplementedError."""
    if machine not in _ARCHITECTURES:
        raise NotImplementedError(f"there is no system-call filter for {machine}")
    column, architecture = _ARCHITECTURES[machine]
    conditions = _conditions(pid)
    program = [
        _load(_ARCHITECTURE),
        _equal(architecture, 1, 0),
        _return(_KILL_PROCESS),
        _load(_NUMBER),
    ]
    for name, numbers in ALLOWED.items():
        condition = conditions.get(name)
        program += _rule(numbers[column], _narrowed(condition) if condition else [_return(_ALLOW)])
    for numbers in REFUSED.values():
        program += _rule(numbers[column], [_return(_ERRNO | errno.EPERM)])
    return (*program, _return(_KILL_PROCESS))


def _rule(number: int | None, verdict: list[Instruction]) -> list[Instruction]:
    """The verdict (which returns, whatever it finds) for one system call."""
    return [] if number is None else [_equal(number, 0, len(verdict)), *verdict]


def _narrowed(only: Only) -> list[Instruction]:
    """Allow or kill by an argument: its upper half is zero under the mask, its lower one listed."""
    low, count = _ARGUMENTS + 8 * only.argument, len(only.values)
    return [
        _load(low + 4),
        _and(only.mask >> 32),
        _equal(0, 0, count + 2),
        _load(low),
        _and(only.mask & 0xFFFF_FFFF),
        *(_equal(value, count - number, 0) for number, value in enumerate(only.values)),
        _return(_KILL_PROCESS),
        _return(_ALLOW),
    ]


def _load(offset: int) -> Instruction:
    return Instruction(0x20, 0, 0, offset)


def _and(mask: int) -> Instruction:
    return Instruction(0x54, 0, 0, mask)


def _equal(value: int, then: int, otherwise: int) -> Instruction:
    """Skip so many instructions if the accumulator is, or is not, this value."""
    return Instruction(0x15, then, otherwise, value)


def _return(verdict: int) -> Instruction:
    return Instruction(0x06, 0, 0, verdict)


# --- into the kernel -----------------------------------------------------------------------------

_PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP, _MODE_FILTER = 38, 22, 2
_ASK_PERSONALITY, _READ_IMPLIES_EXEC = 0xFFFF_FFFF, 0x0040_0000


def install() -> None:
    """Filter the system calls of this process from now on; its threads must not have started.

    Raises NotImplementedError where there is no such filter, OSError where the kernel refuses.
    """
    if not sys.platform.startswith("linux") or sys.maxsize < 2**32:
        raise NotImplementedError(f"there is no system-call filter for {sys.platform}")
    load(build(os.uname().machine, os.getpid()))


def load(program: tuple[Instruction, ...]) -> None:
    """Hand a filter to the kernel. Raises OSError."""
    library = ctypes.CDLL(None, use_errno=True)
    if library.personality(ctypes.c_ulong(_ASK_PERSONALITY)) & _READ_IMPLIES_EXEC:
        raise OSError(errno.EPERM, "every readable page is executable in this process")
    code = b"".join(struct.pack("=HBBI", *instruction) for instruction in program)
    kept = ctypes.create_string_buffer(code)
    header = ctypes.create_string_buffer(struct.pack("@HP", len(program), ctypes.addressof(kept)))
    _prctl(library, _PR_SET_NO_NEW_PRIVS, 1)  # without it only root may filter itself
    _prctl(library, _PR_SET_SECCOMP, _MODE_FILTER, ctypes.addressof(header))


def _prctl(library: ctypes.CDLL, *arguments: int) -> None:
    words = [ctypes.c_ulong(argument) for argument in (*arguments, 0, 0, 0, 0)[:5]]
    if library.prctl(*words) != 0:
        code = ctypes.get_errno()
        raise OSError(code, os.strerror(code))
