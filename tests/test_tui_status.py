"""What the header and the transcript say about services, robot and turns, word for word."""

from __future__ import annotations

import time

import msgspec
import pytest
from tui_world import LIMITS, PARKED, PLAN, SCENE

from agent.errors import Declined, NoAnswer, NoService
from agent.messages import Event, RobotReply, RobotState, StepReport, Turn
from tui.link import Newest
from tui.prompt import completion
from tui.status import connection, missing_news, owner, program, safety, service_news
from tui.steering import Preview, mode, verb
from tui.talk import Talk, answered, describe, safety_news, trouble

pytestmark = pytest.mark.live

ALL = {"robot/r1", "scene/main", "agent/main"}


def state(safety_word="normal", running="idle", holder=None) -> RobotState:
    return RobotState(1, time.time(), "ideal", safety_word, running, PARKED, holder)


def test_connection_names_what_is_missing():
    assert connection(ALL) == ("● connected", "good")
    assert connection(ALL - {"robot/r1"}) == ("◐ no robot bridge", "bad")
    assert connection(set()) == ("○ no services", "bad")


@pytest.mark.parametrize(
    ("known", "bridge", "age", "text"),
    [
        (state(), True, 0.0, "normal"),
        (state("stopped"), True, 0.0, "STOPPED"),
        (state("alarm"), True, 0.0, "ALARM"),
        (state("lost"), True, 0.0, "motion unknown"),
        (state(), False, 0.0, "motion unknown"),
        (state(), True, 9.0, "motion unknown"),
        (None, True, 0.0, "motion unknown"),
    ],
)
def test_safety_is_what_is_known_now(known, bridge, age, text):
    assert safety(known, bridge, age).text == text


def test_program_says_how_far_it_is():
    assert program("idle", state(), 0, 0).text == "idle"
    assert program("running", state(running="running"), 2, 9).text == "running 2/9"
    assert program("idle", state(running="running"), 0, 0).text == "running"
    assert program("running", state(running="paused"), 2, 9).text == "paused"
    assert program("running", state(running="running"), 2, 9, pausing=True).text == "pausing"


def test_owner_is_free_me_or_somebody():
    assert owner(state(), "me").text == "arm free"
    assert owner(state(holder="me"), "me").text == "you hold the arm"
    assert owner(state(holder="bob"), "me").text == "held by bob"


def test_services_are_spoken_of_in_plain_words():
    assert service_news("robot/r1", False, ()) == "robot bridge is gone: motion state unknown"
    assert service_news("translate/w1", False, ["translate/w2"]) == "translator w1 is gone; 1 left"
    assert service_news("agent/main", True, ()) == "agent main is here"
    assert missing_news(ALL) is None
    assert missing_news({"agent/main"}) == "waiting for: robot bridge, scene service"


def test_an_unacknowledged_stop_is_never_called_a_stop():
    text = answered("stop", None, NoService("nobody serves it"))
    assert text.startswith("STOP was not acknowledged")
    assert "motion state unknown" in text


def test_a_stop_by_somebody_else_is_said_once():
    told = msgspec.structs.replace(state("stopped"), text="stopped by bob: reset, then resume")
    assert safety_news(told) == "the robot was stopped by bob. /reset, then /resume to go on."
    assert safety_news(state("alarm")).startswith("the robot raised an alarm. ")


def test_answers_to_verbs():
    assert "/reset" in answered("stop", RobotReply(True), None)
    assert answered("reset", None, Declined("busy", "bob has it")) == (
        "reset was declined (busy): bob has it"
    )
    assert answered("home", RobotReply(False, text="stopped"), None) == "home was refused: stopped"
    assert "unknown" in trouble(NoAnswer("nothing came"))


def test_a_turn_goes_through_its_phases():
    talk = Talk()
    talk.begin()
    assert (talk.phase, talk.moving) == ("thinking", False)
    talk.hear(Event("r", 1, "program", program="x = 1", plan=PLAN))
    assert talk.moving
    talk.hear(Event("r", 2, "step", step=StepReport(0, 4, 1, PLAN[0], PLAN[0])))
    assert (talk.phase, talk.done, talk.count) == ("running", 1, 4)
    talk.hear(Event("r", 3, "turn", turn=Turn(say="push", status="done", reply="Pushed.")))
    talk.waiting.append("more")
    assert talk.over(None) == "more"
    assert (talk.phase, talk.plan) == ("done", ())


def test_what_waits_is_not_said_after_a_failure_or_into_a_question():
    for status in ("failed", "asked", "refused"):
        talk = Talk()
        talk.begin()
        talk.waiting.append("more")
        talk.hear(Event("r", 1, "turn", turn=Turn(say="x", status=status, reply="")))
        assert talk.over(None) is None
    talk = Talk()
    talk.begin()
    talk.waiting.append("more")
    assert talk.over(NoService("gone")) is None


def test_what_a_person_broke_off_has_not_failed():
    for trajectory, phase in (((), "cancelled"), (PLAN[:1], "stopped")):
        talk = Talk()
        talk.begin()
        talk.waiting.append("more")
        turn = Turn(say="x", status="failed", reply="", reason="cancelled", trajectory=trajectory)
        talk.hear(Event("r", 1, "turn", turn=turn))
        assert talk.phase == phase
        assert talk.over(None) == ("more" if phase == "cancelled" else None)


def steered(running, holder="me", line=1) -> RobotState:
    return msgspec.structs.replace(state(running=running, holder=holder), line=line)


@pytest.mark.parametrize(
    ("known", "expected"),
    [
        (None, "none"),
        (steered("idle"), "none"),
        (steered("running", line=0), "none"),
        (steered("running"), "runs"),
        (steered("paused"), "held"),
        (steered("paused", "bob"), "others"),
    ],
)
def test_what_there_is_to_steer(known, expected):
    assert mode(known, "me", ours=False) == expected


@pytest.mark.parametrize(
    ("now", "pausing", "enter", "escape", "f6", "f7"),
    [
        ("none", False, None, None, None, None),
        ("runs", False, None, None, "step", "pause"),
        ("runs", True, None, None, "step", "resume"),
        ("held", False, "resume", "cancel", "step", "resume"),
        ("others", False, None, None, "step", "pause"),
    ],
)
def test_what_the_keys_tell_the_bridge(now, pausing, enter, escape, f6, f7):
    keys = ("enter", "escape", "f6", "f7")
    assert [verb(key, now, pausing) for key in keys] == [enter, escape, f6, f7]


def test_preview_is_as_told_else_wherever_something_real_moves():
    assert Preview().on, "until it is known"
    simulated, real = Preview(), Preview()
    simulated.limits, real.limits = LIMITS, msgspec.structs.replace(LIMITS, simulated=False)
    assert (simulated.on, real.on) == (False, True)
    assert "is off" in real.command("off")
    assert not real.on
    assert "is off" in real.command("")
    assert "/preview on" in real.command("maybe")


def test_the_scene_in_words_gives_units():
    text = describe(SCENE)
    assert "blue cup (cup_1): table, at 40, -100 mm" in text
    assert "orange (orange_1): tray" in text


def test_names_are_completed_from_two_letters_on():
    words = ["red cube", "cup", "/scene"]
    assert completion("push the re", words) == "d cube"
    assert completion("push the c", words) == ""
    assert completion("push the red cu", words) == "be"
    assert completion("/sc", words) == "ene"
    assert completion("", words) == ""


def test_a_reader_is_told_once_of_many_values():
    newest: Newest[int] = Newest()
    assert [newest.put(1), newest.put(2), newest.put(3)] == [True, False, False]
    assert newest.take() == 3
    assert newest.put(4)


def test_a_reader_who_could_not_read_is_told_of_the_next_value():
    newest: Newest[int] = Newest()
    assert newest.put(1)
    assert not newest.put(2), "it is under way"
    newest.missed()
    assert newest.put(3)
    assert newest.take() == 3
