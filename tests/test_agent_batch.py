"""`armchat batch`: every line is answered in order, with every key, whatever stands in it."""

import io
import json
from collections.abc import Iterator

import pytest

from agent.batch import batch
from agent.compose import Mind, parts_on, thinking

TABLE = {
    "objects": [
        {"id": "apple_1", "name": "apple", "x": -0.4, "y": 0.2, "width": 0.12, "height": 0.12,
         "tall": 0.1, "r": 0.0, "color": "red"},
        {"id": "plate_1", "name": "plate", "x": 0.5, "y": -0.1, "width": 0.3, "height": 0.3,
         "tall": 0.04, "r": 0.0, "color": None},
    ],
    "tray": [{"id": "orange_1", "name": "orange", "width": 0.11, "height": 0.11, "tall": 0.11,
              "color": None}],
}  # fmt: skip
TURN_KEYS = {
    "say", "status", "reply", "program", "kind", "trajectory", "question", "reason", "confidence",
    "ms",
}  # fmt: skip
OBJECT_KEYS = {
    "id", "name", "x", "y", "z", "width", "height", "tall", "r", "color", "on", "upright", "held",
}  # fmt: skip
STATUSES = {"done", "asked", "answered", "refused", "failed"}


@pytest.fixture(scope="module")
def mind() -> Iterator[Mind]:
    with thinking() as mind:
        yield mind


def play(mind: Mind, *lines: object, jobs: int = 1) -> tuple[int, list[dict]]:
    """Exit status and decoded answers for lines given as values, or as raw text."""
    text = "".join((line if isinstance(line, str) else json.dumps(line)) + "\n" for line in lines)
    out = io.BytesIO()
    status = batch(io.BytesIO(text.encode()), out, lambda scene: parts_on(mind, scene), jobs)
    return status, [json.loads(line) for line in out.getvalue().splitlines()]


def case(name: object, *turns: str, scene: object = TABLE, task: object = None) -> dict:
    return {"id": name, "scene": scene, "turns": list(turns), "task": task}


def test_a_line_has_every_key_of_the_machine_interface(mind):
    status, (line,) = play(mind, case("t1", "pick up the apple", "how many plates are there?"))
    assert status == 0
    assert set(line) == {"id", "turns", "scene", "error"}
    assert all(set(turn) == TURN_KEYS for turn in line["turns"])
    assert all(turn["status"] in STATUSES for turn in line["turns"])
    assert all(set(turn["ms"]) == {"translate", "decide", "execute", "total"}
               for turn in line["turns"])  # fmt: skip
    assert set(line["scene"]) == {"objects", "tray"}
    assert all(set(item) == OBJECT_KEYS for item in line["scene"]["objects"])


def test_a_motion_is_seen_in_trajectory_and_scene(mind):
    _, (line,) = play(mind, case("t1", "pick up the apple"))
    (turn,) = line["turns"]
    assert (turn["status"], turn["kind"]) == ("done", "manipulate")
    assert set(turn["trajectory"][0]) == {"x", "y", "z", "r", "grip"}
    assert turn["trajectory"][-1]["grip"]
    apple = line["scene"]["objects"][0]
    assert (apple["held"], apple["on"]) == (True, "gripper")


def test_a_question_carries_its_options_and_the_next_turn_answers_it(mind):
    second = {**TABLE["objects"][0], "id": "apple_2", "x": 0.6, "y": 0.6, "color": "green"}
    scene = {**TABLE, "objects": [*TABLE["objects"], second]}
    _, (line,) = play(mind, case("t1", "pick up the apple", "the green one", scene=scene))
    asked, done = line["turns"]
    assert asked["status"] == "asked"
    assert asked["question"]["kind"] == "which"
    assert [option["objects"] for option in asked["question"]["options"]] == [
        ["apple_1"], ["apple_2"],
    ]  # fmt: skip
    assert done["status"] == "done"
    held = [item["id"] for item in line["scene"]["objects"] if item["held"]]
    assert held == ["apple_2"]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("not json", "not a valid line"),
        ("[1, 2]", "not a valid line"),
        (json.dumps({"id": "x", "turns": ["hello"]}), "scene"),
        (json.dumps(case("x", scene={"objects": [{"id": "a"}]})), "`name`"),
        (json.dumps(case("x", task="juggle")), "juggle"),
        (json.dumps({"id": "x", "scene": TABLE, "turns": "hello"}), "turns"),
    ],
)
def test_a_line_that_is_not_valid_is_answered_as_an_error(mind, line, words):
    status, answers = play(mind, line, case("after", "what can you see?"))
    assert status == 1
    assert words in answers[0]["error"]
    assert set(answers[0]) == {"id", "turns", "scene", "error"}
    assert answers[1]["error"] is None


def test_the_id_of_a_bad_line_is_given_back(mind):
    _, (line,) = play(mind, case(7, scene={"objects": [{"id": "a"}]}))
    assert line["id"] == 7


@pytest.mark.parametrize("jobs", [1, 3])
def test_lines_are_answered_in_order(mind, jobs):
    names = [f"t{number}" for number in range(12)]
    _, lines = play(mind, *(case(name, "what can you see?") for name in names), jobs=jobs)
    assert [line["id"] for line in lines] == names


def test_blank_lines_are_passed_over_and_no_lines_are_no_answers(mind):
    assert play(mind, "", "  ") == (0, [])


@pytest.mark.parametrize("say", ["", "   ", "x" * 9000, "\x00\x07", "[bold]", "put", "🤖", "1 + 1"])
def test_nonsense_moves_nothing(mind, say):
    _, (line,) = play(mind, case("t1", say))
    assert line["error"] is None
    assert line["turns"][0]["status"] in ("answered", "refused", "asked")
    assert line["turns"][0]["trajectory"] == []


def test_an_empty_table_is_a_table(mind):
    _, (line,) = play(mind, case("t1", "pick up the apple", scene={"objects": [], "tray": []}))
    assert line["turns"][0]["status"] in ("asked", "refused")
