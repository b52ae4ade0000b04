"""`armchat run` and `armchat check`: programs that somebody wrote, from the shell."""

import json
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from agent.cli import main

LIFT = "pick(apple)"


@pytest.fixture
def shell(tmp_path, capsys, monkeypatch):
    """Run a command with a program in a file: (status, stdout, stderr)."""
    monkeypatch.chdir(tmp_path)

    def shell(command, *options, program=None):
        given = [command]
        if program is not None:
            (tmp_path / "program.txt").write_text(program)
            given.append("program.txt")
        status = main([*given, *options])
        told = capsys.readouterr()
        return status, told.out, told.err

    return shell


def lines(*bodies):
    return "".join(json.dumps(body) + "\n" for body in bodies)


def jsonl(text, *options):
    done = subprocess.run(
        [sys.executable, "-m", "agent.cli", "check", "--jsonl", *options],
        input=text, capture_output=True, text=True,
    )  # fmt: skip
    return done.returncode, [json.loads(line) for line in done.stdout.splitlines()]


# --- check ---------------------------------------------------------------------------------------


def test_a_good_program_is_accepted(shell):
    status, out, _ = shell("check", program=LIFT)
    assert status == 0 and out.startswith("accepted: 4 motions, ")


def test_a_bad_one_is_rejected_with_line_construct_reason_and_place(shell):
    status, out, _ = shell("check", program="x = 1\nimport os")
    assert status == 6
    assert out.splitlines() == [
        "rejected (bad_program): line 2, column 1: an import is not allowed: math is already there",
        "    2 | import os",
        "        ^",
    ]


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("robot.move(5, 0, 1, 0)", "rejected (unreachable): line 1: "),
        ("robot.move(apple.x, apple.y, 1, 0)\nrobot.move(apple.x, apple.y, 0, 0)", "(unsafe)"),
        ("x = [1]\nwhile True:\n    x = x + x", "a list has at most"),
        ("x = 1 / 0", "division by zero"),
    ],
)
def test_every_layer_of_the_check_can_reject(shell, program, words):
    status, out, _ = shell("check", program=program)
    assert status == 6 and words in out


def test_an_arrange_program_is_checked_with_things_in_the_tray(shell):
    status, out, _ = shell("check", "--kind", "arrange", program="put(apple, [0.5, 0.5])")
    assert status == 0 and out.startswith("accepted: 8 motions")


def test_json_gives_verdict_problems_and_the_plan_in_numbers(shell):
    status, out, _ = shell("check", "--json", program=LIFT)
    report = json.loads(out)
    assert status == 0 and report["verdict"] == "accepted" and report["hardened"] is True
    assert report["problems"] == [] and len(report["explanation"]["stretches"]) == 4
    assert report["explanation"]["stretches"][2] == {
        "line": 1, "primitive": "robot.grip(True)", "length": 0.0, "seconds": 0.0
    }  # fmt: skip
    status, out, _ = shell("check", "--json", program="robot.mov(1)")
    report = json.loads(out)
    assert status == 6 and report["verdict"] == "rejected" and report["explanation"] is None
    assert (report["problems"][0]["line"], report["problems"][0]["column"]) == (1, 1)


def test_hostile_text_is_shown_harmless(shell):
    status, out, _ = shell("check", program="x = 1 # \x1b[2J\u202e")
    assert status == 6 and "\x1b" not in out and "\u202e" not in out


def test_check_needs_something_to_check(shell):
    assert shell("check")[0] == 2
    status, _, err = shell("check", "no-such-file.txt")
    assert status == 2 and "no-such-file.txt" in err


def test_keep_outs_of_the_configuration_count(shell, monkeypatch):
    monkeypatch.setenv(
        "ARMCHAT_ROBOT__KEEP_OUTS", '[{name = "lamp", x = [-1, 1], y = [0, 1], z = [0, 2]}]'
    )
    status, out, _ = shell("check", program=LIFT)
    assert status == 6 and "the keep-out lamp" in out


# --- check --jsonl -------------------------------------------------------------------------------


def test_many_programs_one_verdict_a_line_in_order():
    status, verdicts = jsonl(
        lines({"id": 1, "kind": "manipulate", "body": LIFT},
              {"id": "b", "kind": "manipulate", "body": "x = 1 / 0"},
              {"id": "c", "kind": "manipulate", "body": "while True:\n    pass"},
              {"id": "d", "kind": "arrange", "body": "put(apple, [0, 0])"},
              {"id": "e", "kind": "manipulate", "body": "import os"}),
        "--execute",
    )  # fmt: skip
    assert status == 0
    assert [(one["id"], one["verdict"], one["line"]) for one in verdicts] == [
        (1, "accepted", None), ("b", "rejected", 1), ("c", "limited", 2), ("d", "accepted", None),
        ("e", "rejected", 1),
    ]  # fmt: skip
    assert all(set(one) == {"id", "verdict", "line", "reason", "ms"} for one in verdicts)


def test_without_execute_only_what_can_be_seen_before_counts():
    status, verdicts = jsonl(
        lines({"id": 1, "kind": "manipulate", "body": "x = 1 / 0"},
              {"id": 2, "kind": "manipulate", "body": "x = y"})
    )  # fmt: skip
    assert status == 0 and [one["verdict"] for one in verdicts] == ["accepted", "rejected"]


def test_a_line_that_is_none_keeps_its_id_and_the_run_goes_on():
    status, verdicts = jsonl(
        "nonsense\n" + lines({"id": 7, "kind": "dance", "body": LIFT}) + "\n"
        + lines({"id": 8, "kind": "manipulate", "body": LIFT})
    )  # fmt: skip
    assert status == 1
    assert [(one["id"], one["verdict"]) for one in verdicts] == [
        (None, "rejected"), (7, "rejected"), (8, "accepted")
    ]  # fmt: skip


# --- run, and what is shown before ----------------------------------------------------------------


def test_run_runs_it_and_says_what_was_seen(shell):
    status, out, _ = shell("run", program=LIFT)
    assert status == 0 and out == "    pick(apple)\nI hold the apple.\n"


def test_a_rejected_program_runs_not_even_its_beginning(shell):
    status, out, _ = shell("run", "--json", program=LIFT + "\nimport os")
    turn = json.loads(out)
    assert status == 6
    assert (turn["status"], turn["reason"], turn["trajectory"]) == ("refused", "bad_program", [])


def test_dry_run_moves_nothing_and_foretells(shell):
    status, out, _ = shell("run", "--dry-run", program="put(apple, [0, 0])")
    assert status == 0 and "Checked, nothing moved. The apple is" in out
    assert "robot.move(0, 0, 1.2, 0)" in out, "the plan as text"


def test_explain_shows_the_primitives_and_the_room_left(shell):
    status, out, _ = shell("run", "--dry-run", "--explain", program=LIFT)
    assert status == 0
    assert "robot.grip(True)" in out and "closest approach to each limit" in out
    assert "the table" in out and "mm" in out


def test_with_json_the_explanation_goes_to_standard_error(shell):
    status, out, err = shell("run", "--json", "--explain", program=LIFT)
    assert status == 0 and json.loads(out)["status"] == "done" and "closest approach" in err


@pytest.mark.parametrize("command", [("run",), ("run", "--dry-run"), ("check",)])
def test_svg_draws_the_plan_before_it_runs(shell, tmp_path, command):
    status, _, _ = shell(*command[:1], *command[1:], "--svg", "plan.svg", program=LIFT)
    assert status == 0
    root = ElementTree.parse(tmp_path / "plan.svg").getroot()
    assert root.tag.endswith("svg") and "apple" in ElementTree.tostring(root, "unicode")


def test_a_drawing_that_cannot_be_written_is_said_before_anything_moves(shell):
    status, out, err = shell("run", "--svg", "no/such/folder/plan.svg", program=LIFT)
    assert status == 2 and "no/such/folder/plan.svg" in err and out == ""
