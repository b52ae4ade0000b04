"""The expert pairs: what the files hold, how they are read, and that every pair proves itself."""

from __future__ import annotations

import random
import re
from collections import Counter
from pathlib import Path

import msgspec
import pytest

from agent.errors import ConfigError
from agent.program import parse
from evals.postconditions import PREDICATES
from evals.proof import named, prove
from robot_bridge.ideal import predict
from scene.generate import random_scene
from translator.corpus.load import Pair, load
from translator.vocabulary import NOUNS, tokenize

SPLITS = {
    "arrange": {"train": 102, "valid": 11, "test": 11},
    "manipulate": {"train": 122, "valid": 12, "test": 12},
}
KINDS = list(SPLITS)
SEEDS = range(3)


def normal(say: str) -> str:
    """The sentence with its nouns numbered in order, lower case, letters only."""
    words = re.findall(r"[a-zA-Z']+", say)
    nouns = list(dict.fromkeys(word for word in words if word in NOUNS))
    return " ".join(f"m{nouns.index(w)}" if w in NOUNS else w.lower() for w in words)


# --- what the files hold ---------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_the_splits_have_the_papers_sizes(kind):
    assert Counter(pair.split for pair in load(kind)) == SPLITS[kind]


@pytest.mark.parametrize("kind", KINDS)
def test_sentences_and_programs_are_all_different(kind):
    pairs = load(kind)
    assert len({pair.say.lower() for pair in pairs}) == len(pairs)
    assert len({" ".join(tokenize(pair.program)) for pair in pairs}) == len(pairs)


@pytest.mark.parametrize("kind", KINDS)
def test_no_held_out_sentence_is_a_training_sentence_with_other_nouns(kind):
    pairs = load(kind)
    trained = {normal(pair.say) for pair in pairs if pair.split == "train"}
    assert [
        pair.id for pair in pairs if pair.split != "train" and normal(pair.say) in trained
    ] == []


@pytest.mark.parametrize("kind", KINDS)
def test_every_program_is_allowed_and_names_only_what_the_sentence_names(kind):
    for pair in load(kind):
        said = set(re.findall(r"[a-z]+", pair.say)) & set(NOUNS)
        parse(pair.program, kind, said)


@pytest.mark.parametrize("kind", KINDS)
def test_the_word_can_is_always_the_thing(kind):
    # Training swaps nouns in the text, so a modal "can" would become "lemon you put ...";
    # at the start of a sentence it is written "Can", which is no noun.
    for pair in load(kind):
        assert not re.search(r"\bcan (you|i|we|it)\b", pair.say), pair.say


def test_arrange_sentences_hold_no_digits():
    assert [pair.id for pair in load("arrange") if re.search(r"\d", pair.say)] == []


# --- how they are read -----------------------------------------------------------------------

GOOD = """
[[pair]]
id = "x1"
split = "train"
family = "corner"
say = "put the apple in the top left corner"
after = ["in_corner apple above left"]
program = "solver.addConstraint(apple.x == 0)"
"""


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (GOOD + 'colour = "red"', "pair 1 .x1.*colour"),
        (GOOD.replace('"train"', '"trial"'), "pair 1 .x1.*trial"),
        (GOOD.replace('split = "train"', ""), "pair 1 .x1.*split"),
        (GOOD.replace('["in_corner apple above left"]', "[]"), "after must not be empty"),
        (GOOD + GOOD, "x1 has the id of x1"),
        (GOOD + GOOD.replace("x1", "x2"), "x2 has the say of x1"),
        ("[[pair]", "arrange.toml"),
        ("title = 1", r"nothing but \[\[pair\]\]"),
    ],
)
def test_a_bad_file_says_which_pair_and_what(tmp_path: Path, text, message):
    (tmp_path / "arrange.toml").write_text(text)
    with pytest.raises(ConfigError, match=message):
        load("arrange", tmp_path)


def test_a_missing_file_is_named(tmp_path: Path):
    with pytest.raises(ConfigError, match=r"manipulate\.toml"):
        load("manipulate", tmp_path)


# --- the proof -------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_every_pair_proves_itself(kind, executor):
    faults = [line for pair in load(kind) for line in prove(pair, executor, predict, SEEDS)]
    assert faults == []


@pytest.fixture
def corner() -> Pair:
    return next(pair for pair in load("arrange") if pair.after == ("in_corner apple left above",))


@pytest.mark.parametrize(
    ("field", "value", "fault"),
    [
        ("after", ("in_corner apple right above",), "not true: in_corner apple right above"),
        ("after", ("not in_corner apple left above",), "not true: not in_corner"),
        ("after", ("inside apple",), "no predicate 'inside'"),
        ("after", ("in_corner apple",), "in_corner apple"),
        ("after", ("in_corner apple up left",), "up"),
        ("after", ("only orange",), "not true: only orange"),
        ("program", "import os", "line 1"),
        ("program", "solver.addConstraint(apple.x == 5)", "cannot hold"),
        ("program", "solver.addConstraint(bottle.x == 0)", "bottle"),
    ],
)
def test_a_wrong_pair_is_found_out(corner, executor, field, value, fault):
    wrong = msgspec.structs.replace(corner, **{field: value})
    if "bottle" in str(value):
        wrong = msgspec.structs.replace(wrong, after=("in_corner bottle left above",))
    faults = prove(wrong, executor, predict, range(1))
    assert len(faults) == 1 and fault in faults[0]


def test_a_modal_can_is_no_object(corner):
    asked = msgspec.structs.replace(corner, say="Can you put the apple in the top left corner")
    assert named(asked) == ["apple"]


@pytest.mark.parametrize("kind", KINDS)
def test_every_postcondition_begins_with_a_known_predicate(kind):
    lines = [line for pair in load(kind) for line in (*pair.after, *pair.given)]
    parts = [part for line in lines for part in line.removeprefix("if ").split(" then ")]
    assert {part.removeprefix("not ").split()[0] for part in parts} <= set(PREDICATES)


def test_arrange_placements_do_not_depend_on_the_order_of_the_constraints(executor):
    # The metric compares positions: a program with more than one solution would be no truth.
    for pair in load("arrange"):
        scene = _tray(pair)
        lines = pair.program.split("\n")
        unknowns = [line for line in lines if "Variable" in line]
        turned = unknowns + [line for line in reversed(lines) if "Variable" not in line]
        first = _placed(executor, pair.program, scene)
        second = _placed(executor, "\n".join(turned), scene)
        assert first.keys() == second.keys(), pair.id
        for name, where in first.items():
            assert where == pytest.approx(second[name], abs=1e-3), (pair.id, name)


def _tray(pair: Pair):
    return random_scene(random.Random(pair.id), [], named(pair))


def _placed(executor, program, scene):
    draft = executor.run(program, "arrange", [scene])[0]
    return {place.object: (place.x, place.y) for place in draft.placements}
