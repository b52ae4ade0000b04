"""What the header and the transcript say about services, robot and turns, word for word."""

from __future__ import annotations

import time

import pytest
from tui_world import PARKED, PLAN, SCENE

from agent.errors import Declined, NoAnswer, NoService
from agent.messages import Event, RobotReply, RobotState, StepReport, Turn
from tui.link import Newest
from tui.prompt import completion
from tui.status import connection, missing_news, owner, program, safety, service_news
from tui.talk import Talk, answered, describe, trouble

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
