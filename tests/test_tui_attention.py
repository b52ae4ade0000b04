"""/attention: the sentence's words shaded by how much the translator looked at them."""

import pytest
from tui_pilot import say, shown, talking, wait_until

from agent.errors import TranslatorError
from agent.messages import Attention
from tui.attention import chosen, rows, shaded, told

pytestmark = pytest.mark.live

LOOKED = Attention(
    "put(cup, left_of(cup))",
    ("put(", "cup", ", left_of(", "<end>"),
    ("[CLS]", "shift", "the", "bull", "##doz", "##er", "[SEP]"),
    (
        (0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        (0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 0.0),
        (0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5),
        (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    ),
)


def test_word_pieces_are_put_together_and_their_shares_added():
    words = dict(rows(LOOKED)[1].words)
    assert list(words) == ["⟨", "shift", "the", "bulldozer", "⟩"]
    assert words["bulldozer"] == pytest.approx(0.9)


@pytest.mark.parametrize(
    ("token", "numbers"),
    [("", [1, 2, 3, 4]), ("2", [2]), ("left", [3]), ("CUP", [2]), ("9", []), ("bowl", [])],
)
def test_a_token_is_meant_by_its_number_or_a_word_of_it(token, numbers):
    assert [row.number for row in chosen(rows(LOOKED), token)] == numbers


def test_in_plain_words_the_most_is_said_first():
    assert told(rows(LOOKED)[1:2]) == "  2 cup: bulldozer 90 %, the 10 %"


def test_on_screen_the_sentence_stands_whole_behind_each_token():
    lines = str(shaded(rows(LOOKED))).splitlines()
    assert len(lines) == 4
    assert all("⟨ shift the bulldozer ⟩" in line for line in lines)


async def test_it_is_shown_for_the_program_that_was_written_last():
    asked = []

    def attend(program):
        asked.append(program)
        return LOOKED

    async with talking(attend=attend) as (_, app, pilot):
        await say(app, pilot, "push the apple off the table")
        await wait_until(pilot, lambda: "✓ I pushed" in shown(app, ".reply"))
        await say(app, pilot, "/attention left_of")
        await wait_until(pilot, lambda: "3 , left_of(: ⟨ 50 %" in app.transcript())
        assert asked == [app.panel.source] == [app.written]
        await say(app, pilot, "/attention 9")
        await wait_until(pilot, lambda: "say a number, 1 to 4" in app.transcript())


@pytest.mark.parametrize(
    "talk", [(), (("push the apple off the table", "I pushed"), ("hello", "You said: hello"))]
)
async def test_a_sentence_without_a_program_has_nothing_to_look_at(talk):
    async with talking(attend=lambda program: LOOKED) as (_, app, pilot):
        for sentence, reply in talk:
            await say(app, pilot, sentence)
            await wait_until(pilot, lambda reply=reply: reply in app.transcript())
        await say(app, pilot, "/attention")
        await wait_until(pilot, lambda: "the last sentence has no program" in app.transcript())


async def test_a_translator_in_another_process_is_not_asked_and_that_is_said():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "/attention")
        await wait_until(pilot, lambda: "the translator is in another process" in app.transcript())


@pytest.mark.parametrize("trouble", [None, TranslatorError("no weights")])
async def test_a_program_that_was_written_elsewhere_is_said_to_be(trouble):
    def attend(program):
        if trouble is not None:
            raise trouble

    async with talking(attend=attend) as (_, app, pilot):
        await say(app, pilot, "smash it")
        await wait_until(pilot, lambda: app.written)
        await say(app, pilot, "/attention")
        await wait_until(pilot, lambda: "was not written by the translator" in app.transcript())
