"""The command line: exit statuses, what goes to standard output, clear errors."""

import json
import re

import pytest

LIFT = "robot.move(apple.x, apple.y, 0.9, 0)\nrobot.move(apple.x, apple.y, 0.5, 0)"


@pytest.fixture
def program(tmp_path):
    def write(text: str) -> str:
        path = tmp_path / "program.py"
        path.write_text(text)
        return str(path)

    return write


@pytest.mark.parametrize(
    ("say", "status"),
    [
        ("pick up the apple", 0),
        ("what can you see?", 0),
        ("pick up the fruit", 4),
        ("throw the apple at me", 1),
    ],
)
def test_say_tells_by_its_exit_status_how_the_turn_ended(armchat, say, status):
    assert armchat("say", say)[0] == status


def test_say_answers_the_question_that_comes(armchat):
    status, out, _ = armchat("say", "pick up the fruit", "--answer", "the red one", "--json")
    turns = [json.loads(line) for line in out.splitlines()]
    assert [turn["status"] for turn in turns] == ["asked", "done"]
    assert status == 0


def test_say_reads_the_sentence_from_standard_input(armchat):
    status, out, _ = armchat("say", "-", "--json", stdin="what can you see?\n")
    assert (status, json.loads(out)["say"]) == (0, "what can you see?")


def test_a_dry_run_says_what_would_happen(armchat):
    _, out, _ = armchat("say", "pick up the apple", "--dry-run")
    assert "nothing moved" in out


def test_a_scene_that_cannot_be_read_is_a_usage_error_with_its_name(armchat, tmp_path):
    path = tmp_path / "scene.json"
    path.write_text('{"objects": [{"id": "a"}]}')
    status, out, err = armchat("say", "hello", "--scene", str(path))
    assert (status, out) == (2, "")
    assert "scene.json" in err
    assert armchat("say", "hello", "--scene", "nowhere.json")[0] == 2


def test_nobody_to_connect_to_is_status_3(armchat):
    status, _, err = armchat("say", "hello", "--connect", "tcp/127.0.0.1:1")
    assert status == 3
    assert "nobody listens on tcp/127.0.0.1:1" in err
    assert "armchat daemon --listen" in err


def test_run_runs_a_program_file_and_says_nothing_of_a_sentence(armchat, program):
    status, out, _ = armchat("run", program(LIFT), "--json")
    turn = json.loads(out)
    assert (status, turn["status"], turn["say"], len(turn["trajectory"])) == (0, "done", None, 2)


@pytest.mark.parametrize("body", ["import os", "robot.move(9, 9, 9, 0)", "while True:\n    pass"])
def test_a_rejected_program_exits_6_and_moves_nothing(armchat, program, body):
    status, out, _ = armchat("run", program(body), "--json")
    assert (status, json.loads(out)["trajectory"]) == (6, [])


def test_check_names_line_and_construct(armchat, program):
    status, out, _ = armchat("check", program("robot.grip(True)\nimport os"))
    assert status == 6
    assert "line 2" in out
    assert "import" in out


def test_check_accepts_without_moving(armchat, program):
    assert armchat("check", program(LIFT))[0] == 0


def test_check_lines_gives_one_verdict_a_line(armchat):
    bodies = [
        {"id": 1, "kind": "manipulate", "body": LIFT},
        {"id": 2, "kind": "manipulate", "body": "eval('1')"},
        {"id": 3, "kind": "manipulate", "body": "while True:\n    pass"},
        {"id": 4, "kind": "arrange", "body": "solver.addConstraint(apple.x == 0)"},
    ]
    text = "".join(json.dumps(body) + "\n" for body in bodies)
    _, out, _ = armchat("check", "--jsonl", "--execute", stdin=text)
    lines = [json.loads(line) for line in out.splitlines()]
    assert [line["verdict"] for line in lines] == ["accepted", "rejected", "limited", "accepted"]
    assert all(set(line) == {"id", "verdict", "line", "reason", "ms"} for line in lines)
    assert lines[1]["line"] == 1


def test_a_bad_line_among_bodies_is_answered_and_loses_nothing(armchat):
    good = json.dumps({"id": "a", "kind": "manipulate", "body": LIFT})
    status, out, _ = armchat("check", "--jsonl", stdin=f"nonsense\n{good}\n")
    lines = [json.loads(line) for line in out.splitlines()]
    assert (status, lines[0]["id"], lines[1]["verdict"]) == (1, None, "accepted")


def test_a_wrong_option_is_a_usage_error(armchat):
    with pytest.raises(SystemExit) as left:
        armchat("say")
    assert left.value.code == 2


@pytest.mark.parametrize("speed", ["0%", "130%", "-1", "1.5"])
def test_a_speed_beyond_the_full_one_is_a_usage_error(armchat, capsys, speed):
    with pytest.raises(SystemExit) as caught:
        armchat("say", "pick up the apple", f"--speed={speed}")
    assert caught.value.code == 2
    assert "not above 0 and at most 100%" in capsys.readouterr().err


def test_at_a_share_of_the_speed_a_plan_takes_longer(armchat, program):
    path, seconds = program(LIFT), []
    for speed in ("100%", "0.25"):
        status, out, _ = armchat("run", path, "--explain", "--dry-run", "--speed", speed)
        assert status == 0
        seconds.append(float(re.search(r"total.* ([\d.]+)\n", out)[1]))
    assert seconds[1] > 2 * seconds[0]


def test_a_snapshot_is_the_scene_object_and_a_picture(armchat, tmp_path):
    pytest.importorskip("pybullet")
    picture = tmp_path / "table.png"
    status, out, _ = armchat("scene", "snapshot", "--picture", str(picture), "--size", "64", "48")
    assert status == 0
    assert {item["name"] for item in json.loads(out)["objects"]} >= {"apple", "cup"}
    assert picture.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    status, _, err = armchat("scene", "snapshot", "--picture", str(tmp_path / "no" / "x.png"))
    assert (status, "cannot write" in err) == (2, True)


def test_a_window_without_a_display_is_a_configuration_error(armchat, monkeypatch):
    pytest.importorskip("pybullet")
    monkeypatch.delenv("DISPLAY", raising=False)
    status, _, err = armchat("say", "pick up the apple", "--robot", "bullet", "--gui")
    assert (status, "needs a display" in err) == (2, True)
