"""Outcomes: what a dialogue counts as, cases of another form, and how scores are counted."""

from __future__ import annotations

import json

import msgspec
import pytest

from agent.messages import Option, Question, Turn, Waypoint
from evals.outcomes import judge, main, read_cases
from evals.postconditions import Malformed
from evals.tally import by_family, share, summary, table, tally
from scene.types import Scene, read_scene

SIZES = {"width": 0.1, "height": 0.1, "tall": 0.1}
SCENE = {
    "objects": [
        {"id": "mug_1", "name": "mug", "x": -0.5, "y": 0.0, **SIZES},
        {"id": "mug_2", "name": "mug", "x": 0.5, "y": 0.0, **SIZES},
        {"id": "dish_1", "name": "dish", "x": 0.0, "y": 0.5, **SIZES},
    ],
    "tray": [],
}
DO = {
    "id": "do", "family": "moves", "scene": SCENE, "turns": ["shift the dish nearer"], "task": None,
    "expect": [["done"]],
    "goal": [{"p": "moved_dir", "id": "dish_1", "dir": "front"},
             {"p": "others_still", "except": ["dish_1"]}],
    "metrics": {"stayed central": [{"p": "at", "id": "dish_1", "x": 0, "y": None}]},
}  # fmt: skip
ASK = {
    "id": "ask", "family": "asks", "scene": SCENE, "turns": ["a mug, if you please"], "task": None,
    "expect": [{"status": ["asked"], "kind": ["which"], "ids": ["mug_1", "mug_2"]}],
    "goal": [{"p": "nothing_moved"}],
}  # fmt: skip
LEAVE = {**ASK, "id": "leave", "expect": [["refused"]]}


def write(tmp_path, *rows):
    path = tmp_path / "made_up.jsonl"
    lines = [{"meta": {"name": "made up"}}, *rows]
    path.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
    return path


@pytest.fixture
def cases(tmp_path):
    return {case.id: case for case in read_cases(write(tmp_path, DO, ASK, LEAVE))}


def turn(status, *offered, kind="which", moved=False) -> Turn:
    options = tuple(Option(label=one, objects=(one,)) for one in offered)
    question = Question(kind, "Which?", options) if status == "asked" else None
    way = (Waypoint(0, 0, 0.5, 0, False),) if moved else ()
    return Turn(say="", status=status, reply="", question=question, trajectory=way)


def shifted(name="dish_1", dy=-0.3) -> Scene:
    scene = read_scene(SCENE)
    item = scene.get(name)
    return scene.replace(msgspec.structs.replace(item, y=item.position[1] + dy))


def scored(case, *turns, after=None):
    return judge(case, read_scene(SCENE), after or read_scene(SCENE), turns)


def test_a_case_of_another_form_is_a_case_of_ours(cases):
    assert list(cases) == ["do", "ask", "leave"]
    assert cases["do"].want[0].status == ("done",) and len(cases["do"].goal) == 2
    assert cases["ask"].want[0].options == ("mug_1", "mug_2")


def test_what_has_no_verdict_is_passed_over(tmp_path):
    assert read_cases(write(tmp_path, {**DO, "coverage": True})) == []


@pytest.mark.parametrize(
    "fault", [{"goal": [{"p": "levitates", "id": "mug_1"}]}, {"expect": [["perhaps"]]}]
)
def test_a_line_that_cannot_be_judged_is_named(tmp_path, fault, capsys):
    path = write(tmp_path, DO, {**DO, **fault})
    with pytest.raises(Malformed, match=r"made_up\.jsonl:3: "):
        read_cases(path)
    with pytest.raises(SystemExit):
        main([str(path)])
    assert "made_up.jsonl:3" in capsys.readouterr().err


def test_done_is_right_only_if_the_goal_is_reached(cases):
    assert scored(cases["do"], turn("done"), after=shifted()).outcome == "right"
    assert scored(cases["do"], turn("done")).outcome == "wrong"
    assert scored(cases["do"], turn("done"), after=shifted("mug_1")).outcome == "wrong"


def test_done_where_it_should_have_asked_or_refused_is_wrong(cases):
    assert scored(cases["ask"], turn("done")).outcome == "wrong"
    assert scored(cases["leave"], turn("done")).outcome == "wrong"


def test_questions(cases):
    both = turn("asked", "mug_1", "mug_2")
    assert scored(cases["ask"], both).outcome == "right"
    assert scored(cases["ask"], turn("asked", "mug_1")).outcome == "asked_wrongly"
    unfit = turn("asked", "mug_1", "mug_2", kind="where")
    assert scored(cases["ask"], unfit).outcome == "asked_wrongly"
    assert scored(cases["do"], both).outcome == "over_asked"
    assert scored(cases["do"], turn("refused")).outcome == "refused"
    assert scored(cases["leave"], turn("answered")).outcome == "missed"


def test_who_asks_does_not_move(cases):
    both = ("mug_1", "mug_2")
    assert scored(cases["ask"], turn("asked", *both, moved=True)).outcome == "wrong"
    assert scored(cases["ask"], turn("asked", *both), after=shifted()).outcome == "wrong"


def test_metrics_stand_beside_the_outcome(cases):
    assert scored(cases["do"], turn("done")).metrics == {"stayed central": True}
    counted = tally([scored(cases["do"], turn("done"))])
    assert counted.metrics["stayed central"] == share(1, 1) and counted.right == share(0, 1)


def test_asking_is_counted_by_turn(cases):
    scores = [
        scored(cases["do"], turn("asked", "mug_1")),
        scored(cases["do"], turn("done"), after=shifted()),
        scored(cases["ask"], turn("done")),
        scored(cases["leave"], turn("refused")),
    ]
    counted = tally(scores)
    assert counted.over_ask == share(1, 3)  # the turns of "do" and "leave"
    assert counted.missed_ask == share(1, 1)
    assert counted.outcomes["right"] == 2 and counted.n == 4


def test_a_share_has_its_standard_error_and_nothing_has_none():
    assert share(1, 4).rate == 0.25 and share(1, 4).se == pytest.approx(0.2165, abs=1e-4)
    assert share(0, 0).rate is None and share(0, 0).se is None


def test_the_table_has_n_and_error_of_each_family(cases):
    scores = [scored(cases["do"], turn("done")), scored(cases["ask"], turn("asked"))]
    lines = table(summary(by_family(scores))).splitlines()
    assert lines[0].endswith("± se")
    assert [line.split()[0] for line in lines[1:4]] == ["asks", "moves", "all"]
    assert lines[2].split()[-3:] == ["1", "0.0", "0.0"]


def test_files_are_played_and_summed(tmp_path, capsys):
    talk = {**LEAVE, "turns": ["what is left of the dish?"], "expect": [["answered"]]}
    first = write(tmp_path, talk)
    with pytest.raises(SystemExit):
        main([str(first), str(first)])
    second = tmp_path / "again.jsonl"
    second.write_bytes(first.read_bytes())
    out = tmp_path / "scores.jsonl"
    assert main([str(first), str(second), "--json", "--out", str(out)]) == 0
    counted = json.loads(capsys.readouterr().out)
    assert counted["files"]["made_up"]["groups"]["asks"]["right"]["k"] == 1
    assert counted["total"]["all"]["right"] == {"k": 2, "n": 2, "rate": 1.0, "se": 0.0}
    lines = [json.loads(line) for line in out.read_text(encoding="utf-8").splitlines()]
    assert [line["outcome"] for line in lines] == ["right", "right"]
