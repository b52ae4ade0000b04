"""Program text to tokens and back; what may come next."""

import ast
from collections import Counter
from itertools import pairwise

import pytest

from agent.errors import TranslatorError
from translator.corpus.load import load
from translator.grammar import Grammar
from translator.vocabulary import (
    END,
    NOUNS,
    Vocabulary,
    build_vocabulary,
    detokenize,
    tokenize,
)

PROGRAM = """if orange.x < 0:
    edge, side = -1, 1
else:
    edge, side = 1, -1
for step in range(3):
    robot.move(orange.x + side * (orange.width / 2 + 0.08), -orange.y, 0.3, math.pi / 2)
robot.grip(True)"""
ARRANGE = """gap = Variable("gap")
solver.addConstraint((apple.y == (orange.y + 2 * apple.x) / 2) | "strong")
solver.solve()
if apple.x.value() < 0:
    solver.addConstraint(orange.x == 0)"""


@pytest.fixture(scope="module")
def vocabulary() -> Vocabulary:
    return build_vocabulary([PROGRAM, ARRANGE], ["push the orange"])


def pairs():
    return [*load("arrange"), *load("manipulate")]


@pytest.fixture(scope="module")
def everything() -> Vocabulary:
    return build_vocabulary([pair.program for pair in pairs()], [])


@pytest.mark.parametrize("body", [PROGRAM, ARRANGE])
def test_text_survives_the_way_to_tokens_and_back(body):
    assert ast.dump(ast.parse(detokenize(tokenize(body)))) == ast.dump(ast.parse(body))


def test_every_expert_program_survives_the_way_to_tokens_and_back():
    for pair in pairs():
        again = detokenize(tokenize(pair.program))
        assert ast.dump(ast.parse(again)) == ast.dump(ast.parse(pair.program)), pair.id


def test_an_unreadable_character_is_named_with_its_line():
    with pytest.raises(TranslatorError, match="line 2: cannot read '@x'"):
        tokenize("pass\n@x")


def test_a_token_that_training_never_showed_is_an_error(vocabulary):
    with pytest.raises(TranslatorError, match="'while' is not in the vocabulary"):
        vocabulary.encode(["while"])


def test_a_vocabulary_is_read_as_it_was_written(vocabulary, tmp_path):
    vocabulary.save(tmp_path / "v.json")
    assert Vocabulary.load(tmp_path / "v.json") == vocabulary


def accepted(vocabulary: Vocabulary, tokens: list[str]) -> bool:
    """Whether the grammar lets a program be written token by token to its end."""
    grammar = Grammar(vocabulary)
    prefix = grammar.start()
    for index in vocabulary.encode([*tokens, END]):
        longer = grammar.extend(prefix, index)
        if longer is None:
            return False
        prefix = longer
    return True


@pytest.mark.parametrize("body", [PROGRAM, ARRANGE])
def test_the_grammar_accepts_a_good_program(vocabulary, body):
    assert accepted(vocabulary, tokenize(body))


def test_the_grammar_accepts_every_expert_program(everything):
    for pair in pairs():
        assert accepted(everything, tokenize(pair.program)), pair.id


@pytest.mark.parametrize(
    "body",
    [
        "robot.move(orange.x, orange.y, 0.3)",
        "for step in range(0, 1, 2, 3):\n    robot.grip(True)",
        "robot.move(orange, orange.y, 0.3, 0)",
        "robot.grip(3)",
        "edge = side",
        "edge += 1",
        "if orange.x < 0:\n    edge = 1\nrobot.move(side, edge, 0.3, 0)",
        "solver.addConstraint(apple.x)",
        'solver.addConstraint((apple.x == 0) | "gap")',
        "(",
    ],
)
def test_the_grammar_refuses_a_malformed_program(body):
    programs = [PROGRAM, ARRANGE, "edge += 3"]
    assert not accepted(build_vocabulary(programs, []), tokenize(body))


def test_frequent_neighbours_become_one_piece_and_nouns_stay_single():
    body = "robot.move(apple.x, apple.y, 1.2, 0)"
    vocabulary = build_vocabulary([body] * 20, [])
    assert len(vocabulary.encode(tokenize(body))) < len(tokenize(body)) / 2
    assert all(len(piece) == 1 or not set(piece) & set(NOUNS) for piece in vocabulary.pieces)


def test_a_piece_is_the_two_neighbours_that_stand_together_most_often_in_all_programs():
    programs = [pair.program for pair in pairs()][:60]
    pieces = [piece for piece in build_vocabulary(programs, [], 30).pieces if len(piece) > 1]
    rows = [[(token,) for token in tokenize(program)] for program in programs]
    for expected in pieces:
        together = Counter(
            pair for row in rows for pair in pairwise(row) if not {*pair} & {(n,) for n in NOUNS}
        )
        left, right = max(together, key=lambda pair: (together[pair], pair))
        assert left + right == expected
        rows = [merged(row, left, right) for row in rows]


def merged(row, left, right):
    done = []
    for piece in row:
        if done and (done[-1], piece) == (left, right):
            done[-1] += right
        else:
            done.append(piece)
    return done


def test_pieces_say_what_their_tokens_say(everything):
    for pair in pairs():
        tokens = tokenize(pair.program)
        assert everything.decode(everything.encode(tokens)) == tokens


def test_the_empty_program_is_not_a_program(vocabulary):
    assert not accepted(vocabulary, [])


def test_scope_holds_the_objects_and_the_calls_of_the_task(vocabulary):
    usable = Grammar(vocabulary).usable("arrange", {"apple"})
    allowed = {piece[0] for piece, yes in zip(vocabulary.pieces, usable, strict=True) if yes}
    assert allowed & set(NOUNS) == {"apple"}
    assert "solver.solve" in allowed
    assert "robot.move" not in allowed
