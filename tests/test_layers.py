"""Who may import whom: the table of ARCHITECTURE.md, enforced over the source."""

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
OURS = ("agent", "translator", "clarifier", "scene", "robot_bridge", "tui", "evals")
FLOOR = {
    "agent.messages", "agent.bus", "agent.bus_zenoh", "agent.wire", "agent.inbox", "agent.errors",
    "agent.config", "agent.stopping", "agent.client", "agent.plain", "agent.topology",
    "agent.workers", "scene.types",
}  # fmt: skip
COMPOSITION_ROOTS = {
    "agent.cli", "agent.compose", "agent.commands", "agent.chat", "agent.demo", "agent.programs",
    "agent.remote", "agent.snapshot", "agent.eyes", "agent.shows", "agent.hardware",
    "agent.doctor", "agent.optics", "agent.showing", "agent.touching", "agent.models",
    "agent.speaking", "agent.training",
}  # fmt: skip
MAY_IMPORT = {
    "scene": {"scene"},
    "robot_bridge": {"robot_bridge", "scene"},
    "translator": {
        "translator",
        "agent.program",
        "agent.language.prelude",
        "agent.language.builtin",
    },
    "clarifier": {
        "clarifier",
        "scene",
        "agent.program",
        "agent.check",
        "agent.execute",
        "agent.report",
    },
    "agent": {"agent", "scene", "clarifier", "robot_bridge.api"},
    "tui": {"tui"},
    "evals": {"evals", "agent", "translator", "clarifier", "scene", "robot_bridge"},
}
ONLY_IN = {
    "pybullet": {"robot_bridge.bullet"},
    "pydobot": {"robot_bridge.dobot"},
    "serial": {"robot_bridge.dobot", "robot_bridge.dobot_arm", "robot_bridge.ports"},
    "kiwisolver": {"agent.language.cassowary"},
    "zenoh": {"agent.bus_zenoh"},
    "textual": {"tui"},
    "torch": {
        "translator.train",
        "translator.attention",
        "translator.minilm",
        "translator.model",
        "translator.transformer",
        "translator.learner",
        "translator.resume",
        "translator.export",
        "translator.causal",
        "translator.finetune",
        "translator.gguf",
        "translator.lora",
        "translator.tuned",
        "translator.served",
        "translator.train_hearing",
        "scene.train_detector",
        "scene.detector_net",
        "scene.export_detector",
        "scene.augment",
        "scene.losses",
        "scene.targets",
        "evals.baselines",
        "evals.ssdlite",
    },
    "torchvision": {"evals.ssdlite"},
    "transformers": {"translator.gguf", "translator.tuned"},
    "cv2": {"evals.heat", "scene.opencv"},
    "onnxruntime": {
        "translator.embed",
        "translator.decode",
        "translator.export",
        "scene.detector",
    },
    "huggingface_hub": {"translator.models"},
    "rapidfuzz": {"clarifier.spelling"},
    "lark": {"translator.grammar"},
    "tokenizers": {"translator.embed", "translator.lessons", "translator.speech"},
}


def modules() -> list[str]:
    files = [path for folder in OURS for path in (ROOT / folder).rglob("*.py")]
    names = [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in files]
    return sorted(name.removesuffix(".__init__") for name in names)


@cache
def imports(module: str) -> frozenset[str]:
    """Dotted names that a module imports, wherever in the file."""
    path = ROOT / Path(*module.split("."))
    path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: relative import"
            found.add(node.module or "")
    return frozenset(found)


def within(name: str, allowed: set[str]) -> bool:
    return any(name == one or name.startswith(f"{one}.") for one in allowed)


@pytest.mark.parametrize("module", [name for name in modules() if name not in COMPOSITION_ROOTS])
def test_a_module_imports_only_what_its_layer_may(module):
    folder = module.split(".")[0]
    allowed = FLOOR if module in FLOOR else FLOOR | MAY_IMPORT[folder]
    ours = {name for name in imports(module) if name.split(".")[0] in OURS}
    wrong = {name for name in ours if not within(name, allowed)}
    assert not wrong, f"{module} must not import {sorted(wrong)}"


@pytest.mark.parametrize("library", sorted(ONLY_IN))
def test_a_third_party_library_stays_in_its_file(library):
    users = {m for m in modules() if library in {name.split(".")[0] for name in imports(m)}}
    wrong = {name for name in users if not within(name, ONLY_IN[library])}
    assert not wrong, f"{library} is imported by {sorted(wrong)}"


def test_the_import_graph_has_no_circle():
    known = modules()
    graph = {name: imports(name) & set(known) for name in known}
    done: set[str] = set()

    def visit(name: str, path: tuple[str, ...]) -> None:
        assert name not in path, " -> ".join((*path, name))
        if name not in done:
            for other in graph[name]:
                visit(other, (*path, name))
            done.add(name)

    for name in graph:
        visit(name, ())


def test_say_loads_no_training_library_and_no_robot_it_does_not_use():
    code = (
        "import sys\n"
        "from agent.cli import main\n"
        "status = main(['say', 'put the apple on the plate', '--json'])\n"
        "heavy = {'torch', 'transformers', 'pydobot', 'pybullet', 'textual', 'cv2', 'zenoh'}\n"
        "assert not heavy & set(sys.modules), heavy & set(sys.modules)\n"
        "sys.exit(status)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr + done.stdout
