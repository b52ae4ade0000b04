"""`ports`, `home`, `jog`, `doctor`, `emulate`; the arm behind say, run, batch, stop and reset."""

import json
import os
import signal
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path
from types import SimpleNamespace

import pytest
from bridge_world import BACK_AND_FORTH, Run, Sender, bridge, client, wait_state
from dobot_world import until

from agent.doctor import findings
from agent.errors import AlarmError, Declined, LinkDown, NoReply
from agent.messages import RobotState, Turn
from evals.fault_matrix import arm, settled
from robot_bridge import dobot_frames as ids
from robot_bridge import ports as serial_ports
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults

pytestmark = pytest.mark.live

ROOT = Path(__file__).parent.parent
LIFT = "robot.move(apple.x, apple.y, 0.9, 0)\nrobot.move(apple.x, apple.y, 0.5, 0)"


@pytest.fixture
def emulator():
    with Emulator(speed=40.0) as made:
        yield made


@pytest.fixture
def homed(emulator):
    settled(emulator)
    return emulator


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "program.py"
    path.write_text(LIFT)
    return str(path)


def motions(emulator):
    with emulator.lock:
        return [frame.id for frame in emulator.controller.seen if frame.id in ids.MOTIONS]


# --- ports ---------------------------------------------------------------------------------------


def plugged_in(monkeypatch, *devices):
    infos = [
        SimpleNamespace(device=device, description="USB serial", vid=vid, pid=pid)
        for device, vid, pid in devices
    ]
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: infos)


def test_ports_says_which_may_be_a_dobot_and_who_may_open_it(armchat, monkeypatch, tmp_path):
    mine = tmp_path / "mine"
    mine.touch()
    plugged_in(monkeypatch, ("/dev/other", 1, 2), (str(mine), 0x10C4, 0xEA60))
    monkeypatch.setattr(serial_ports, "permitted", lambda device: device == "/dev/other")
    status, out, _ = armchat("ports")
    first, second = out.splitlines()
    assert status == 0
    assert first.startswith(str(mine)) and "likely a Dobot" in first and "usermod -aG" in first
    assert second.startswith("/dev/other") and "another device" in second
    assert "permission" not in second


def test_ports_says_what_to_do_where_there_is_none(armchat, monkeypatch):
    plugged_in(monkeypatch)
    status, out, _ = armchat("ports")
    assert status == 1 and "Plug in" in out


def test_the_only_likely_port_is_taken(armchat, monkeypatch, homed):
    plugged_in(monkeypatch, ("/dev/other", None, None), (homed.port, 0x1A86, 0x7523))
    assert armchat("jog", "z", "-5", "--robot", "dobot")[0] == 0
    plugged_in(monkeypatch, ("/dev/a", 0x1A86, 0x7523), ("/dev/b", 0x10C4, 0xEA60))
    status, _, err = armchat("jog", "z", "-5", "--robot", "dobot")
    assert status == 3 and "/dev/a, /dev/b" in err and "--port" in err
    plugged_in(monkeypatch)
    assert "armchat ports" in armchat("jog", "z", "-5", "--robot", "dobot")[2]


# --- home, jog, stop, reset at the port ----------------------------------------------------------


def test_home_homes_and_parks(armchat, emulator):
    status, out, err = armchat("home", "--robot", "dobot", "--port", emulator.port)
    assert (status, out) == (0, "Home: x 0.000, y -1.200, z 0.900 (table units)\n")
    assert emulator.controller.homed and "keep the space around it clear" in err


def test_jog_goes_through_the_check(armchat, homed):
    status, out, _ = armchat("jog", "x", "-15", "--port", homed.port)
    assert (status, out) == (0, "x -0.200 table units\n")
    status, out, _ = armchat("jog", "r", "30", "--port", homed.port)
    assert (status, out) == (0, "r 0.524 rad\n")
    before = motions(homed)
    status, out, err = armchat("jog", "z", "-60", "--port", homed.port)
    assert (status, out) == (1, "") and "out of reach" in err
    assert motions(homed) == before
    assert armchat("jog", "x", "nan", "--port", homed.port)[0] == 2


def test_stop_and_reset_at_the_port_move_nothing(armchat, homed):
    with homed.lock:
        homed.controller.alarms.add(0x30)
    assert armchat("stop", "--port", homed.port)[0] == 0
    assert homed.controller.force_stops == 1 and homed.controller.alarms
    assert armchat("reset", "--port", homed.port)[0] == 0
    assert not homed.controller.alarms and motions(homed) == []


# --- say, run, batch -----------------------------------------------------------------------------


def test_a_program_waits_for_home_then_runs_on_the_arm(armchat, emulator, program):
    at = ("--robot", "dobot", "--port", emulator.port)
    status, out, err = armchat("run", program, *at, "--json")
    turn = json.loads(out)
    assert (turn["status"], turn["reason"], turn["trajectory"]) == ("refused", "unsafe", [])
    assert status == 6 and "armchat home" in turn["reply"] and "no camera" in err
    assert motions(emulator) == []
    assert armchat("home", *at)[0] == 0
    status, out, _ = armchat("run", program, *at, "--json")
    assert (status, json.loads(out)["status"]) == (0, "done")
    assert motions(emulator).count(ids.PTP) == 2


def test_say_moves_the_arm_and_its_table_follows(armchat, homed):
    status, out, _ = armchat("say", "pick up the apple", "--robot", "dobot", "--port", homed.port)
    assert (status, "I hold the apple. (Computed" in out) == (0, True)
    assert motions(homed).count(ids.PTP) >= 3


def test_at_a_share_of_the_speed_the_arm_is_told_no_more(armchat, homed, program, monkeypatch):
    at = ("--robot", "dobot", "--port", homed.port)

    def told(*arguments):
        assert armchat(*arguments)[0] == 0
        with homed.lock:
            return ids.read_floats(homed.controller.settings[ids.PTP_COORDINATE])[0]

    assert told("run", program, *at) == 100
    assert told("run", program, *at, "--speed", "30%") == 30
    assert told("run", program, *at) == 100
    monkeypatch.setenv("ARMCHAT_ROBOT__SPEED", "0.5")
    assert told("run", program, *at) == told("jog", "z", "5", "--port", homed.port) == 50
    status, _, err = armchat("run", program, *at, "--speed", "0.5%")
    assert status == 2 and "speed must be in [1, 300]" in err


def test_centimetres_are_those_of_the_arms_own_table(armchat, homed):
    at = ("--robot", "dobot", "--port", homed.port)
    status, _, _ = armchat("say", "move the apple 3 cm to the right", *at)
    with homed.lock:
        goals = [one.goal for one in homed.controller.made if one.id == ids.PTP]
    assert status == 0
    across = [round(goal.y) for goal in goals]  # the arm's y is to the left
    assert across == [45, 45, 45, 15, 15, 15]


def test_what_the_arm_cannot_reach_is_refused_before_a_byte(armchat, homed, tmp_path):
    path = tmp_path / "far.py"
    path.write_text("robot.move(0, 0, 0.9, 0)\nrobot.move(0, 1.6, 0.1, 0)")
    at = ("--robot", "dobot", "--port", homed.port)
    _, out, _ = armchat("run", str(path), *at, "--json")
    turn = json.loads(out)
    assert (turn["status"], turn["reason"]) == ("refused", "unreachable")
    assert "out of reach" in turn["reply"]
    assert motions(homed) == []


def test_batch_plays_one_line_after_the_other(armchat, homed):
    line = {"id": 1, "turns": ["push the apple to the left"], "scene": {"objects": [
        {"id": "a", "name": "apple", "x": 0.2, "y": 0.1, "width": 0.12, "height": 0.12,
         "tall": 0.1}]}}  # fmt: skip
    at = ("--robot", "dobot", "--port", homed.port)
    status, out, _ = armchat("batch", *at, stdin=f"{json.dumps(line)}\n" * 2)
    results = [json.loads(one) for one in out.splitlines()]
    assert status == 0 and [one["error"] for one in results] == [None, None]
    assert all(one["turns"][0]["status"] == "done" for one in results)
    assert armchat("batch", *at, "--jobs", "2", stdin="")[0] == 2


def test_an_arm_that_is_not_there_is_status_3_and_a_missing_extra_2(armchat, program, monkeypatch):
    at = ("--robot", "dobot", "--port", "/dev/none")
    status, _, err = armchat("run", program, *at)
    assert status == 3 and "no such port" in err
    status, _, err = armchat("run", program, "--port", "/dev/none")
    assert status == 2 and "--robot dobot" in err
    monkeypatch.setattr("agent.compose.find_spec", lambda name: None)
    status, _, err = armchat("run", program, *at)
    assert status == 2 and "pip install 'armchat[dobot]'" in err


def unplugged_on_motion(emulator, number):
    planned = emulator.controller._planned

    def during(frame):
        begun = motions(emulator).count(ids.PTP)
        emulator.faults.unplug_at = 0.5 if begun == number else None
        return planned(frame)

    emulator.controller._planned = during


@pytest.mark.parametrize("number", [1, 2])
def test_an_arm_that_is_lost_on_the_way_is_status_3_and_the_turn_says_failed(
    armchat, program, number
):
    with Emulator(speed=5.0) as emulator:
        settled(emulator)
        unplugged_on_motion(emulator, number)
        at = ("--robot", "dobot", "--port", emulator.port)
        status, out, err = armchat("run", program, *at, "--json")
    turn = json.loads(out)
    assert (status, turn["status"], len(turn["trajectory"])) == (3, "failed", number - 1)
    assert "motion state unknown" in turn["reply"] and "connection lost" in err


def test_a_stop_before_the_first_step_ended_is_status_5_too():
    from agent.commands import exit_status

    stopped = Turn(say=None, status="failed", reply="I was stopped by ann.", reason="cancelled")
    called_off = Turn(say=None, status="refused", reply="Called off.", reason="cancelled")
    assert (exit_status(stopped), exit_status(called_off)) == (5, 1)


def as_in_a_terminal():
    """What a shell runs in the background ignores Ctrl-C, and so do its children."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_ctrl_c_halts_the_arm(tmp_path):
    path = tmp_path / "long.py"
    path.write_text("robot.move(0.9, -0.2, 0.9, 0)\nrobot.move(-0.9, -0.2, 0.9, 0)")
    with Emulator() as emulator:
        settled(emulator)
        command = [sys.executable, "-m", "agent.cli", "run", str(path), "--robot", "dobot"]
        command += ["--port", emulator.port, "--speed", "5%"]  # still on its way when it is told
        with subprocess.Popen(command, cwd=ROOT, preexec_fn=as_in_a_terminal) as process:
            until(lambda: motions(emulator) and emulator.controller.moving, 30.0)
            process.send_signal(signal.SIGINT)
            assert process.wait(10) == 130
        until(lambda: emulator.controller.force_stops)
        assert not emulator.controller.moving and motions(emulator) == [ids.PTP]


# --- doctor --------------------------------------------------------------------------------------


def test_doctor_looks_at_everything_and_changes_nothing(armchat, homed):
    status, out, _ = armchat("doctor", "--robot", "dobot", "--port", homed.port)
    assert status == 0
    assert "98% of the table" in out
    for text in (
        "Python 3.11",
        "msgspec",
        "weights",
        "firmware 3.7.0",
        "no alarms",
        "pose",
        "homed",
    ):
        assert text in out
    written = [frame for frame in homed.controller.seen if frame.ctrl != ids.READ]
    assert written == []


def test_doctor_says_what_to_do_about_the_arm(armchat, emulator):
    with emulator.lock:
        emulator.controller.alarms.add(0x41)
    status, out, _ = armchat("doctor", "--port", emulator.port)
    assert status == 1
    assert any(line.startswith("fail") and "unlock" in line for line in out.splitlines())
    assert any(line.startswith("warn") and "armchat home" in line for line in out.splitlines())
    status, out, _ = armchat("doctor", "--port", "/dev/none")
    assert status == 1 and "no such port" in out


def test_doctor_and_home_say_when_the_arm_cannot_work_as_it_stands(
    armchat, homed, monkeypatch, tmp_path
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "armchat.toml").write_text("[dobot]\nscale = 120\n")
    status, out, _ = armchat("doctor", "--port", homed.port)
    assert status == 1 and "cannot reach where it waits" in out
    status, _, err = armchat("home", "--port", homed.port)
    assert status == 1 and "[dobot]" in err and motions(homed) == []


def test_doctor_finds_no_dobot_where_nobody_answers(armchat):
    with Emulator(Faults(dropped=10**6)) as emulator:
        status, out, _ = armchat("doctor", "--port", emulator.port)
    assert status == 1 and "is it a Dobot" in out


def test_doctor_names_what_is_missing_and_what_is_wrong(monkeypatch, tmp_path):
    def version(name):
        from importlib.metadata import PackageNotFoundError

        raise PackageNotFoundError(name)

    monkeypatch.setattr("agent.doctor.version", version)
    monkeypatch.setattr("agent.doctor.sys.version_info", (3, 13))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "armchat.toml").write_text("[dobot]\nscal = 7\n")
    found = list(findings(True, "/dev/none"))
    failed = {line.text.split()[0] for line in found if line.verdict == "fail"}
    assert {"Python", "msgspec", "pydobot", "configuration"} <= failed
    assert all(line.fix for line in found if line.verdict != "ok")
    assert any("did you mean dobot.scale" in line.fix for line in found)


# --- emulate -------------------------------------------------------------------------------------


def test_emulate_prints_its_port_and_serves_until_it_is_told_to_end(tmp_path, armchat):
    link = tmp_path / "port"
    command = [sys.executable, "-m", "agent.cli", "emulate", "dobot", "--port-link", str(link)]
    environ = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        [*command, "--speed", "40", "--fault", "bad-sum=2"], cwd=ROOT, env=environ,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        assert process.stdout.readline().strip() == str(link)
        assert armchat("home", "--port", str(link))[0] == 0
        assert armchat("jog", "z", "-10", "--port", str(link))[0] == 0
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 0
    assert not link.is_symlink()


@pytest.mark.parametrize("options", [["--fault", "nonsense"], ["--speed", "0"]])
def test_emulate_refuses_what_it_does_not_know(armchat, options):
    assert armchat("emulate", "dobot", *options)[0] == 2


# --- behind the bridge ---------------------------------------------------------------------------


@pytest.fixture
def served():
    with ExitStack() as stack:
        bench = stack.enter_context(arm(Faults()))
        bus = bridge(stack, robot=bench.robot)
        yield SimpleNamespace(stack=stack, bench=bench, bus=bus)


def test_the_bridge_homes_stops_and_resets_the_arm(served):
    ann = client(served.stack, served.bus)
    ann.acquire()
    controller = served.bench.emulator.controller
    controller.homed = False
    assert ann.home().ok and controller.homed
    run = Run(served.bus, BACK_AND_FORTH)
    until(lambda: motions(served.bench.emulator).count(ids.PTP))
    assert client(served.stack, served.bus, "bob").stop(now=True).ok
    assert "Stopped" in type(run.ended()).__name__ and controller.force_stops
    with pytest.raises(Declined):
        ann.home()
    assert ann.reset().ok and ann.resume().ok and ann.home().ok


def test_the_bridge_tells_of_a_lost_arm_and_finds_it_again(served):
    ann = client(served.stack, served.bus)
    ann.acquire()
    served.bench.emulator.unplug()
    state = wait_state(served.bus, lambda state: state.safety == "lost")
    assert "connection lost" in state.text
    served.bench.emulator.plug()
    assert ann.reset().ok
    state = served.bus.ask(served.bus.keys.state("r1"), None, RobotState)
    assert state.safety != "lost"


@pytest.mark.parametrize(
    ("fault", "error"),
    [({"alarm_at": 0.5}, AlarmError), ({"lost_reply": 1}, NoReply), ({"unplug_at": 0.5}, LinkDown)],
)
def test_what_the_arm_raises_arrives_by_its_name(served, fault, error):
    sender = Sender(served.stack, served.bus)
    sender.own()
    for name, value in fault.items():
        setattr(served.bench.emulator.faults, name, value)
    _, end = sender.run_to_end(BACK_AND_FORTH[:2])
    assert end.error == error.__name__ and end.text
