"""The sample session of the README is played for real and must come out as it is printed."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def session() -> list[tuple[str, str]]:
    """Command line and printed output of each `$ armchat` of the README's first console block."""
    block = README.split("```console\n", 1)[1].split("```", 1)[0]
    steps = [step.partition("\n") for step in block.split("$ ")[1:]]
    return [(command, output) for command, _, output in steps]


def test_the_session_is_what_armchat_prints():
    assert len(session()) >= 4
    for command, output in session():
        program, *arguments = shlex.split(command)
        assert program == "armchat"
        done = subprocess.run(
            [sys.executable, "-m", "agent.cli", *arguments], capture_output=True, text=True,
            cwd=ROOT,
        )  # fmt: skip
        assert done.stdout.strip() == output.strip(), command


def test_every_command_the_readme_names_exists():
    told = subprocess.run(
        [sys.executable, "-m", "agent.cli", "--help"], capture_output=True, text=True, cwd=ROOT
    ).stdout
    named = set(re.findall(r"^armchat ([a-z]+)", README, re.MULTILINE))
    assert len(named) > 5
    assert all(re.search(rf"^ +{name}\b", told, re.MULTILINE) for name in named)
