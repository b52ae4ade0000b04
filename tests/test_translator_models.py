"""Pretrained models on this machine: found, verified, and what to type where they are not."""

import sys
from types import SimpleNamespace

import pytest

from agent.cli import main
from agent.errors import TranslatorError
from translator import models
from translator.models import GEMMA, Known, Manifest, checksums, faults, located, pull, pulled


@pytest.fixture(autouse=True)
def home(monkeypatch, tmp_path):
    monkeypatch.setattr(models, "user_data_path", lambda name: tmp_path / "data")
    return tmp_path / "data" / "models"


@pytest.fixture
def tiny(home):
    """A pulled model of two small files."""
    folder = home / "tiny"
    folder.mkdir(parents=True)
    (folder / "config.json").write_text("{}")
    (folder / "model.safetensors").write_bytes(bytes(range(64)))
    manifest = Manifest("a test", "none", "", checksums(folder))
    (folder / models.MANIFEST).write_bytes(models.msgspec.json.encode(manifest))
    return folder


def test_a_model_is_found_by_name_and_by_folder(tiny, tmp_path):
    assert located("tiny") == tiny == located(str(tiny))
    assert list(pulled()) == ["tiny"]
    assert models.folder("Owner/a-b.c").name == "Owner--a-b.c"


@pytest.mark.parametrize("name", ["gemma3-270m", "Owner/model"])
def test_a_model_that_is_not_here_says_what_to_type(name):
    with pytest.raises(TranslatorError, match=f"armchat models pull {name}"):
        located(name)


@pytest.mark.parametrize("name", ["/no/such/folder", "..", "a b", ""])
def test_what_is_no_name_is_not_looked_for(name):
    with pytest.raises(TranslatorError, match=r"config\.json"):
        located(name)


def test_files_that_were_changed_or_are_missing_are_named(tiny, capsys):
    assert faults("tiny") == []
    assert main(["models", "verify"]) == 0
    (tiny / "model.safetensors").write_bytes(b"other")
    (tiny / "config.json").unlink()
    assert faults("tiny") == ["config.json is missing", "model.safetensors was changed"]
    assert main(["models", "verify", "tiny"]) == 1
    assert "model.safetensors was changed" in capsys.readouterr().out


def test_where_no_model_is_verify_says_so(capsys):
    assert main(["models", "verify"]) == 0
    assert "no pretrained model is here" in capsys.readouterr().err


def test_ls_names_what_is_here_and_what_can_be_got(tiny, capsys):
    assert main(["models", "ls"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("tiny\t") and line.endswith("\there") for line in lines)
    assert any("gemma3-270m" in line and "Gemma Terms of Use" in line for line in lines)
    assert main(["models", "path", "tiny"]) == 0
    assert capsys.readouterr().out.strip() == str(tiny)


def test_missing_libraries_say_what_to_type(monkeypatch):
    monkeypatch.setattr(models, "find_spec", lambda name: None)
    with pytest.raises(TranslatorError, match=r"torch and transformers.*armchat\[pretrained\]"):
        models.need_libraries()
    with pytest.raises(TranslatorError, match="torch"):
        pull("gemma3-270m", lambda model: True, print)


@pytest.fixture
def package(monkeypatch):
    """A package of parts, as the registry has it, and an unpacker that writes one file."""
    gguf = SimpleNamespace(unpack=lambda file, home, say: (home / "config.json").write_text("{}"))
    parts = SimpleNamespace(
        MODEL_NAME="whole.gguf", EXPECTED_SHA256="abc",
        assemble=lambda path: path.write_bytes(b"weights"),
    )  # fmt: skip
    monkeypatch.setitem(sys.modules, "translator.gguf", gguf)
    monkeypatch.setitem(sys.modules, GEMMA.package, parts)
    monkeypatch.setattr(models, "find_spec", lambda name: object())


def test_terms_are_shown_and_what_is_not_accepted_is_not_unpacked(package, home):
    asked: list[Known] = []
    with pytest.raises(TranslatorError, match="terms"):
        pull("gemma3-270m", lambda model: bool(asked.append(model)), print)
    assert asked == [GEMMA]
    assert "ai.google.dev/gemma/terms" in asked[0].terms
    assert not home.exists()


def test_the_day_of_acceptance_is_kept_with_the_model(package, home):
    told = []
    folder = pull("gemma3-270m", lambda model: True, told.append)
    manifest = pulled()["gemma3-270m"]
    assert manifest.accepted == models.date.today().isoformat()
    assert manifest.source.endswith("abc")
    assert list(manifest.files) == ["config.json"]
    assert located("gemma3-270m") == folder
    assert told[0].startswith("putting the parts together")
    pull("gemma3-270m", lambda model: pytest.fail("asked twice"), told.append)


def test_what_unpacking_needs_is_said_before_the_terms_are(package, home, monkeypatch):
    monkeypatch.setattr(models, "find_spec", lambda name: None if name == "accelerate" else name)
    with pytest.raises(TranslatorError, match=r"needs accelerate: .*armchat\[pretrained\]"):
        pull("gemma3-270m", lambda model: pytest.fail("asked"), print)


def test_what_could_not_be_unpacked_leaves_nothing_behind(package, home, monkeypatch):
    def unpack(file, home, say):
        raise ImportError("something is required")

    monkeypatch.setattr(sys.modules["translator.gguf"], "unpack", unpack)
    with pytest.raises(TranslatorError, match="cannot unpack gemma3-270m: something is required"):
        pull("gemma3-270m", lambda model: True, print)
    assert list(home.iterdir()) == []
