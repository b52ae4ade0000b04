"""Attention as a picture: which rows, which columns, and that a share is seen."""

import pytest

from agent.cli import main
from agent.errors import ConfigError
from agent.messages import Attention
from evals.attention import chosen, request
from translator.translate import PAPER, PRODUCT, Translator

FOUND = Attention("a", ("put(", "m1", ")"), ("[CLS]", "put"), ((0.1, 0.9),) * 3)


@pytest.fixture(scope="module", params=["paper", "product"])
def attended(request) -> Attention:
    translator = Translator(PAPER if request.param == "paper" else PRODUCT)
    return translator.attend(wanted("put the cup 5 cm to the left of the plate", request.param))[0]


def wanted(sentence, model):
    return request(sentence, "manipulate", model)[0]


def test_each_token_attends_to_the_whole_sentence_once(attended):
    assert len(attended.tokens) == len(attended.weights) > 3
    assert attended.tokens[-1] == "<end>"
    for row in attended.weights:
        assert len(row) == len(attended.pieces)
        assert sum(row) == pytest.approx(1.0, abs=1e-4)


def test_the_columns_are_the_words_that_were_said(attended):
    words = " ".join(attended.pieces[1:-1])
    assert words == "put the cup 5 cm to the left of the plate"


def test_what_stands_for_a_slot_is_one_column():
    sentence = "put the coca cola 5 cm to the left of the plate"
    found = Translator(PRODUCT).attend(wanted(sentence, "product"))[0]
    assert "5 cm" in found.pieces


def test_the_body_is_what_the_translator_writes():
    translator = Translator(PRODUCT)
    asked = wanted("put the cup next to the plate", "product")
    bodies = [one.body for one in translator(asked).candidates]
    assert [one.body for one in translator.attend(asked)] == bodies


def test_a_token_is_chosen_by_its_number_from_one():
    assert chosen(FOUND, "all") == [0, 1, 2]
    assert chosen(FOUND, "3") == [2]
    for wrong in ("0", "4", "-1", "put", ""):
        with pytest.raises(ConfigError, match="tokens 1 to 3"):
            chosen(FOUND, wrong)


def test_a_share_is_seen_in_its_cell():
    pytest.importorskip("cv2")
    from evals.heat import HEAT, ROW, draw

    picture = draw(["one", "two"], ["left", "right"], [[1.0, 0.0], [0.0, 1.0]])
    assert picture.shape[0] == 3 * ROW
    edge = picture.shape[1] - 3
    assert tuple(picture[2 * ROW + 2, edge]) == HEAT
    assert tuple(picture[ROW + 2, edge]) == (255, 255, 255)


def test_letters_that_the_font_lacks_do_no_harm():
    pytest.importorskip("cv2")
    from evals.heat import draw

    assert draw(["x ⏎ ⇥" * 40], ["naïve", ""], [[0.5, 0.5]]).size


def test_the_command_writes_a_png_and_prints_the_program(tmp_path, capsys):
    cv2 = pytest.importorskip("cv2")
    one, all_of_it = tmp_path / "one.png", tmp_path / "all.png"
    line = ["reproduce", "attention", "pick up the apple", "--out"]
    assert main([*line, str(one), "--token", "2"]) == 0
    assert main([*line, str(all_of_it), "--model", "product"]) == 0
    assert "apple" in capsys.readouterr().out
    heights = [cv2.imread(str(path)).shape[0] for path in (one, all_of_it)]
    assert heights[0] < heights[1]


def test_a_file_that_cannot_be_written_is_a_usage_error(tmp_path, capsys):
    pytest.importorskip("cv2")
    nowhere = str(tmp_path / "no" / "such.png")
    assert main(["reproduce", "attention", "pick up the apple", "--out", nowhere]) == 2
    assert nowhere in capsys.readouterr().err
