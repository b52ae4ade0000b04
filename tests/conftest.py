"""What several test files need: the command line, programs run on a scene, a clarifier over a small
translator that knows its sentences."""

import io

import pytest
from clarifier_table import LEXICON, SmallTranslator, writes

from agent.cli import main
from agent.compose import table
from agent.errors import ProgramError
from agent.execute import Executor
from agent.primitives import primitives
from clarifier.binding import bindings
from clarifier.candidates import Planner
from clarifier.decide import Clarifier
from clarifier.mentions import link
from robot_bridge.ideal import IdealRobot, predict

CHECK = table("check")


@pytest.fixture(autouse=True)
def no_calibrations(tmp_path_factory, monkeypatch):
    """No test finds what somebody calibrated on this machine."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path_factory.getbasetemp() / "nobody"))


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """Where calibrations are kept: in a data folder of the test's own, in which it works."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "data" / "armchat" / "calibration"


@pytest.fixture
def armchat(capsys, monkeypatch):
    """Runs a command line: (status, standard output, standard error)."""

    def run(*arguments: str, stdin: str = ""):
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(stdin.encode())))
        out = io.TextIOWrapper(io.BytesIO(), write_through=True)
        monkeypatch.setattr("sys.stdout", out)
        status = main(arguments)
        return status, out.buffer.getvalue().decode(), capsys.readouterr().err

    return run


@pytest.fixture(scope="session")
def executor():
    """The worker of all tests that are not about workers: it keeps nothing of a program."""
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
def after(run):
    """The scene once a program has run on the ideal table."""

    def after(source, scene=CHECK):
        return predict(primitives(run(source, scene), scene), scene)

    return after


@pytest.fixture
def translator():
    return SmallTranslator()


@pytest.fixture
def clarifier_over(executor):
    """Makes a clarifier over a translator of the test's own; its manner, if it has one."""

    def clarifier_over(translate, manner=None):
        return Clarifier(translate, executor, predict, IdealRobot(), None, manner)

    return clarifier_over


@pytest.fixture
def clarifier(clarifier_over, translator):
    return clarifier_over(translator)


@pytest.fixture
def outcome_of(executor):
    """What a sentence comes to on a scene for which the translator writes these programs (body,
    log-probability), so sure of the first."""

    def outcome_of(text, scene, *bodies, sure=1.0):
        linked = link(text, scene, (), LEXICON)
        planner = Planner(writes(*bodies, sure=sure), executor, predict, IdealRobot())
        reading = planner.read(linked, "manipulate", scene)
        return planner.outcome(reading, bindings(linked, scene, {})[0], scene)

    return outcome_of
