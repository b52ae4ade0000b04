"""The terminal application as a person meets it, against a real small world on a bus."""

from __future__ import annotations

import pytest
from tui_pilot import held, map_rows, pills, say, shown, talking, wait_until
from tui_world import World

from agent.errors import ConfigError
from tui.app import ArmchatApp
from tui.link import StateSeen, TurnOver
from tui.screens import HelpScreen

pytestmark = pytest.mark.live


async def test_a_sentence_is_answered_in_the_transcript():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "hello")
        await wait_until(pilot, lambda: "You said: hello" in app.transcript())
        assert shown(app, ".person") == "hello"
        assert app.prompt.text == ""


async def test_a_program_is_shown_run_line_by_line_and_reported():
    async with talking((120, 40)) as (world, app, pilot):
        with held(world):
            await say(app, pilot, "push the apple off the table")
            await wait_until(pilot, lambda: app.panel.source.startswith("robot.move(-0.8"))
            assert app.panel.display
            for line in (1, 2, 3, 4):
                await wait_until(pilot, lambda line=line: app.panel.running == line)
                assert f"▶{line} robot.move" in shown(app, "#program-code")
                await wait_until(pilot, lambda line=line: app.talk.done == line - 1)
                world.agent.steps.release()
            await wait_until(pilot, lambda: "running 4/4" in pills(app))
            world.agent.steps.release()
            await wait_until(pilot, lambda: "✓ I pushed" in shown(app, ".reply"))
        await wait_until(pilot, lambda: "done" in pills(app))
        assert "▶" not in shown(app, "#program-code")


async def test_a_long_program_scrolls_to_the_line_that_runs():
    async with talking() as (_, app, pilot):
        app.panel.load("\n".join(f"robot.move(0, 0, 0.{n:02}, 0)" for n in range(1, 31)), None)
        scroll = app.query_one("#program-scroll")
        await wait_until(pilot, lambda: scroll.max_scroll_y > 0)
        app.panel.mark(25, held=False)
        await wait_until(pilot, lambda: scroll.scroll_offset.y <= 24
                         < scroll.scroll_offset.y + scroll.size.height)  # fmt: skip
        assert app.query_one("#map").region.height >= 10


async def test_a_rejected_program_is_shown_as_not_run():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "smash it")
        await wait_until(pilot, lambda: "✕ I won't." in shown(app, ".reply"))
        assert shown(app, ".code").startswith("not run\nrobot.throw(1)")
        assert "refused" in pills(app)


async def test_f8_stops_while_a_turn_hangs():
    async with talking() as (world, app, pilot):
        with held(world):
            await say(app, pilot, "wait")
            await wait_until(pilot, lambda: world.agent.heard == ["wait"])
            await pilot.press("f8")
            await wait_until(pilot, lambda: "STOP acknowledged" in app.transcript())
            assert [stop.now for stop in world.bridge.stops] == [False]
            assert app.talk.busy
        await wait_until(pilot, lambda: "STOPPED" in pills(app))


async def test_f8_stops_while_typing_and_behind_help_and_the_palette():
    async with talking() as (world, app, pilot):
        await pilot.press("a", "f8")
        await wait_until(pilot, lambda: len(world.bridge.stops) == 1)
        assert app.prompt.text == "a"
        await pilot.press("f1")
        await wait_until(pilot, lambda: isinstance(app.screen, HelpScreen))
        await pilot.press("f8")
        await wait_until(pilot, lambda: len(world.bridge.stops) == 2)
        await pilot.press("escape")
        await wait_until(pilot, lambda: not isinstance(app.screen, HelpScreen))
        await pilot.press("ctrl+p")
        await wait_until(pilot, lambda: app.screen.is_modal)
        await pilot.press("f8")
        await wait_until(pilot, lambda: len(world.bridge.stops) == 3)


async def test_typed_stop_goes_to_the_bridge_and_not_to_the_agent():
    async with talking() as (world, app, pilot):
        with held(world):
            await say(app, pilot, "wait")
            await say(app, pilot, "hello")
            await say(app, pilot, "stop now!")
            await wait_until(pilot, lambda: world.bridge.stops)
            assert world.bridge.stops[0].now
        await wait_until(pilot, lambda: not app.talk.busy)
        assert world.agent.heard == ["wait"], "what waited is not said after a STOP"


async def test_the_stop_button_stops():
    async with talking() as (world, _, pilot):
        await pilot.click("#stop")
        await wait_until(pilot, lambda: world.bridge.stops)


async def test_a_stop_that_nobody_acknowledges_says_so(monkeypatch):
    async with talking() as (world, app, pilot):
        monkeypatch.setattr(app.link.client.stop.__func__, "__defaults__", (False, 0.1))
        world.bridge.bus.close()
        await pilot.press("f8")
        await wait_until(pilot, lambda: "STOP was not acknowledged" in app.transcript())
        assert "motion state unknown" in app.transcript()


async def test_ctrl_c_stops_what_moves():
    async with talking() as (world, app, pilot):
        with held(world):
            await say(app, pilot, "push the apple")
            await wait_until(pilot, lambda: app.talk.moving)
            await pilot.press("ctrl+c")
            await wait_until(pilot, lambda: world.bridge.stops)


async def test_ctrl_c_clears_the_prompt_and_twice_quits():
    async with talking() as (world, app, pilot):
        await pilot.press("a", "b", "ctrl+c")
        await wait_until(pilot, lambda: app.prompt.text == "")
        assert app.is_running
        await pilot.press("ctrl+c")
        await wait_until(pilot, lambda: app.return_value == 0)
        assert world.bridge.stops == []


async def test_the_palette_stops_by_force_and_resets():
    async with talking() as (world, app, pilot):
        for words in ("stop now", "reset"):
            await pilot.press("ctrl+p")
            await wait_until(pilot, lambda: app.screen.is_modal)
            await pilot.press(*words)
            await wait_until(
                pilot, lambda: app.screen.query("OptionList").first().option_count == 1
            )
            await pilot.press("enter")
            await wait_until(pilot, lambda: not app.screen.is_modal)
        await wait_until(pilot, lambda: "the latch is cleared" in app.transcript())
        assert [stop.now for stop in world.bridge.stops] == [True]


async def test_try_shows_and_says_nothing_while_a_sentence_is_open():
    async with talking() as (world, app, pilot):
        await say(app, pilot, "/try hello")
        await wait_until(pilot, lambda: "You said: hello" in app.transcript())
        with held(world):
            await say(app, pilot, "wait")
            await say(app, pilot, "/try hello again")
            await wait_until(pilot, lambda: "not now" in app.transcript())
        assert "hello again" not in world.agent.heard


async def test_reset_and_resume_are_sent_to_the_bridge():
    async with talking() as (_, app, pilot):
        await pilot.press("f8")
        await wait_until(pilot, lambda: "STOPPED" in pills(app))
        await say(app, pilot, "/reset")
        await wait_until(pilot, lambda: "the latch is cleared" in app.transcript())
        await say(app, pilot, "/resume")
        await wait_until(pilot, lambda: "normal" in pills(app))
        assert "the robot is ready again" in app.transcript()
        assert "you hold the arm" in pills(app)


async def test_a_stop_by_somebody_else_is_said():
    async with talking() as (world, app, pilot):
        world.bridge.safety = "stopped"
        world.bridge.publish()
        await wait_until(pilot, lambda: "the robot was stopped" in app.transcript())


async def test_services_that_vanish_and_return_are_said_in_plain_words():
    async with talking() as (world, app, pilot):
        app._settle()
        world.bridge.token.close()
        gone = "robot bridge is gone: motion state unknown"
        await wait_until(pilot, lambda: gone in app.transcript())
        await wait_until(pilot, lambda: "◐ no robot bridge" in pills(app))
        assert "motion unknown" in pills(app)
        world.bridge.bus.token(world.bridge.bus.keys.alive("robot", "r1"))
        await wait_until(pilot, lambda: "robot bridge r1 is here" in app.transcript())
        world.agent.token.close()
        await wait_until(pilot, lambda: "agent is gone: nobody answers" in app.transcript())


async def test_an_agent_that_dies_in_mid_turn_ends_the_turn():
    async with talking() as (world, app, pilot):
        with held(world):
            await say(app, pilot, "wait")
            await wait_until(pilot, lambda: world.agent.heard)
            world.agent.token.close()
            await wait_until(pilot, lambda: not app.talk.busy)
        assert "No agent" in app.transcript()


async def test_text_that_looks_like_markup_or_escapes_is_shown_verbatim():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "[bold red]x[/] $text \x1b[31m")
        await wait_until(pilot, lambda: "You said" in app.transcript())
        assert shown(app, ".person") == "[bold red]x[/] $text \ufffd[31m"
        assert "[bold red]x[/]" in shown(app, ".reply")
        assert "\x1b" not in app.transcript()


async def test_commands_answer_in_the_transcript():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "/scene")
        await wait_until(pilot, lambda: "red apple (apple_1): table, at -100, 40 mm"
                         in app.transcript())  # fmt: skip
        await say(app, pilot, "/program")
        await say(app, pilot, "/dance")
        await wait_until(pilot, lambda: "no command /dance" in app.transcript())
        assert "there is no program yet" in app.transcript()
        await say(app, pilot, "/quit")
        await wait_until(pilot, lambda: app.return_value == 0)


async def test_the_program_is_copied_by_y_in_its_panel():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "push the apple")
        await wait_until(pilot, lambda: "done" in pills(app))
        app.query_one("#program-scroll").focus()
        await pilot.press("y")
        await wait_until(pilot, lambda: app.clipboard == app.panel.source)
        await pilot.press("escape")
        await wait_until(pilot, lambda: app.focused is app.prompt)


@pytest.mark.parametrize("size", [(80, 24), (120, 40)])
async def test_everything_fits_on_the_screen(size):
    async with talking(size) as (world, app, pilot):
        with held(world):
            await say(app, pilot, "push the apple off the table")
            await wait_until(pilot, lambda: app.panel.source)
            await wait_until(pilot, lambda: app.panel.region.height > 0)
            everything = app.screen.region
            for name in ("#header", "#chat", "#map", "#program", "#prompt", "#keys", "#stop"):
                region = app.query_one(name).region
                assert everything.contains_region(region), name
                assert region.area > 0, name
            assert app.query_one("#map").region.height >= 10
            assert app.query_one("#chat").region.width >= 40


async def test_a_narrow_screen_shows_the_map_on_f2():
    async with talking((60, 24)) as (_, app, pilot):
        assert not app.query_one("#side").display or app.query_one("#side").region.area == 0
        await pilot.press("f2")
        await wait_until(pilot, lambda: app.query_one("#side").region.width == 60)
        assert any("apple" in row for row in map_rows(app))


async def test_the_prompt_grows_remembers_and_completes():
    async with talking() as (_, app, pilot):
        await wait_until(pilot, lambda: "apple" in app.prompt.words)
        await pilot.press(*"ap")
        await wait_until(pilot, lambda: app.prompt.suggestion == "ple")
        await pilot.press("tab", "ctrl+j", "b")
        await wait_until(pilot, lambda: app.prompt.text == "apple\nb")
        await wait_until(pilot, lambda: app.prompt.region.height == 3)
        await pilot.press("enter")
        await wait_until(pilot, lambda: "You said" in app.transcript())
        await pilot.press("up")
        await wait_until(pilot, lambda: app.prompt.text == "apple\nb")


async def test_no_color_means_no_colour(monkeypatch):
    monkeypatch.setenv("NO_COLOR", "1")
    async with talking() as (_, app, _pilot):
        assert app.no_color


async def test_the_theme_is_chosen_by_name():
    async with talking(theme="armchat-light") as (_, app, _pilot):
        assert not app.current_theme.dark


def test_an_unknown_theme_is_refused_with_those_there_are():
    with World() as world, pytest.raises(ConfigError, match="armchat-light"):
        ArmchatApp(world.client, theme="mauve")


async def test_nothing_is_left_on_the_bus_when_the_terminal_ends():
    async with talking() as (_, app, _pilot):
        app.exit(0)
    assert app.link._closings == []


async def test_what_arrives_while_the_screen_is_taken_down_widget_by_widget_is_dropped(monkeypatch):
    async with talking() as (_, app, pilot):
        await app.query_one("#keys").remove()
        monkeypatch.setattr(type(app), "is_running", False)
        app.post_message(StateSeen())
        app.post_message(TurnOver(None))
        await pilot.pause(0.05)
        monkeypatch.undo()
        assert app.link.state.put(app.state)  # the next one is told again
