"""A question is answered by digit, arrows, mouse or words, and stays behind, dimmed."""

from __future__ import annotations

import pytest
from tui_pilot import map_rows, pills, say, shown, talking, wait_until

from tui.question import Choice, QuestionView
from tui.screens import HelpScreen

pytestmark = pytest.mark.live


async def asked(app, pilot) -> QuestionView:
    await say(app, pilot, "take the cup")
    await wait_until(pilot, lambda: len(app.screen.query(Choice)) == 3)
    return app.query_one(QuestionView)


async def test_choices_are_numbered_and_shown_verbatim():
    async with talking() as (_, app, pilot):
        await asked(app, pilot)
        assert shown(app, ".question-text") == "Which cup?"
        rows = shown(app, ".choice").split("\n")
        assert rows == [" 1  the left cup", " 2  the [red] one", " 0  something else"]
        assert "asking" in pills(app)


@pytest.mark.parametrize(
    "keys", [["2"], ["down", "down", "enter"], ["up", "up", "enter"], ["down", "down", "down",
             "up", "enter"]]
)  # fmt: skip
async def test_digits_and_arrows_choose(keys):
    async with talking() as (world, app, pilot):
        view = await asked(app, pilot)
        await pilot.press(*keys)
        await wait_until(pilot, lambda: world.agent.heard[-1] == "the [red] one")
        assert view.answered == "the [red] one"
        assert view.has_class("-answered")
        taken = [choice.number for choice in view.query(".-taken").results(Choice)]
        assert taken == [2]


async def test_a_failure_is_told_and_what_it_asks_can_be_answered():
    async with talking() as (world, app, pilot):
        await say(app, pilot, "lift it")
        await wait_until(pilot, lambda: len(app.screen.query(Choice)) == 3)
        assert shown(app, ".reply").endswith("I could not keep hold of the cup.")
        assert shown(app, ".question-text") == "Shall I try again?"
        await pilot.press("1")
        await wait_until(pilot, lambda: world.agent.heard[-1] == "try again")


async def test_a_click_chooses():
    async with talking() as (world, app, pilot):
        view = await asked(app, pilot)
        await pilot.click(view.query(Choice).first())
        await wait_until(pilot, lambda: world.agent.heard[-1] == "the left cup")


async def test_anything_typed_is_a_free_answer_digits_included():
    async with talking() as (world, app, pilot):
        view = await asked(app, pilot)
        await pilot.press(*"no 2", "enter")
        await wait_until(pilot, lambda: world.agent.heard[-1] == "no 2")
        assert "→ no 2" in shown(app, ".question-free")
        assert not view.query(".-taken")


async def test_escape_is_never_mind():
    async with talking() as (world, app, pilot):
        await asked(app, pilot)
        await pilot.press("escape")
        await wait_until(pilot, lambda: world.agent.heard[-1] == "never mind")


async def test_enter_alone_chooses_nothing():
    async with talking() as (world, app, pilot):
        view = await asked(app, pilot)
        await pilot.press("enter", "0")
        assert view.answered is None
        assert world.agent.heard == ["take the cup"]


async def test_an_open_question_takes_words_and_leaves_digits_to_them():
    async with talking() as (world, app, pilot):
        await say(app, pilot, "where to")
        await wait_until(pilot, lambda: len(app.query(QuestionView)) == 1)
        await pilot.press("5", "enter")
        await wait_until(pilot, lambda: world.agent.heard[-1] == "5")


async def test_a_digit_without_a_question_is_typed():
    async with talking() as (_, app, pilot):
        await pilot.press("1")
        await wait_until(pilot, lambda: app.prompt.text == "1")


async def test_highlighting_a_choice_highlights_its_object_on_the_map():
    async with talking((120, 40)) as (_, app, pilot):
        await asked(app, pilot)
        await pilot.press("down")
        await wait_until(pilot, lambda: app.map.picture.marked == {"cup_1"})
        await pilot.press("down")
        await wait_until(pilot, lambda: app.map.picture.marked == {"cup_2"})
        assert any("cup_2" in row for row in map_rows(app))
        await pilot.press("2")
        await wait_until(pilot, lambda: app.map.picture.marked == frozenset())


async def test_hovering_highlights_too():
    async with talking() as (_, app, pilot):
        view = await asked(app, pilot)
        await pilot.hover(list(view.query(Choice))[1])
        await wait_until(pilot, lambda: app.map.picture.marked == {"cup_2"})


async def test_a_question_is_answered_once():
    async with talking() as (world, app, pilot):
        view = await asked(app, pilot)
        await pilot.press("1")
        await wait_until(pilot, lambda: world.agent.heard[-1] == "the left cup")
        await pilot.click(list(view.query(Choice))[1])
        await pilot.press("f1")
        await wait_until(pilot, lambda: isinstance(app.screen, HelpScreen))
        assert world.agent.heard == ["take the cup", "the left cup"]
