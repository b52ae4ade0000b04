"""What several test files need: programs run on a scene, a clarifier over a small translator that
knows its sentences."""

import pytest
from clarifier_table import SmallTranslator

from agent.compose import table
from agent.errors import ProgramError
from agent.execute import Executor
from clarifier.decide import Clarifier
from robot_bridge.ideal import IdealRobot, predict

CHECK = table("check")


@pytest.fixture(autouse=True)
def no_calibrations(tmp_path_factory, monkeypatch):
    """No test finds what somebody calibrated on this machine."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path_factory.getbasetemp() / "nobody"))


@pytest.fixture(scope="module")
def executor():
    with Executor() as running:
        yield running


@pytest.fixture
def run(executor):
    """Runs a program on one scene, else on the table `check`: what it came to; its error is
    raised."""

    def run(source, scene=CHECK, kind="manipulate"):
        (result,) = executor.run(source, kind, [scene])
        if isinstance(result, ProgramError):
            raise result
        return result

    return run


@pytest.fixture
def translator():
    return SmallTranslator()


@pytest.fixture
def clarifier(executor, translator):
    return Clarifier(translator, executor, predict, IdealRobot())
