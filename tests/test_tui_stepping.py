"""The terminal over a real bridge and agent: a program is previewed, stepped, held, given up."""

from __future__ import annotations

from contextlib import ExitStack

import msgspec
import pytest
from bridge_world import APPLE, ByHand, bridge, client
from tui_pilot import keys, map_rows, pills, say, shown, talking, wait_until
from tui_world import LIMITS, World

from agent.messages import Decision
from agent.service import AgentService
from robot_bridge.ideal import IdealRobot, predict
from scene.service import SceneService
from scene.types import Scene
from tui.drawing import DARK
from tui.map import TableMap
from tui.screens import HelpScreen

pytestmark = pytest.mark.live

PROGRAM = """\
robot.move(0.2, 0, 0.9, 0)
robot.move(0.2, 0, 0.1, 0)
robot.grip(True)
robot.move(-0.8, 0.8, 0.9, 0)"""
SIZES = [(60, 24), (80, 24), (120, 40)]


class Table:
    """Bridge, eye and agent over the ideal table; every sentence means `PROGRAM`."""

    def __init__(self, executor, robot):
        self.executor, self.robot = executor, robot
        self.stack = ExitStack()

    def __enter__(self):
        self.bus = bridge(self.stack, robot=self.robot)
        for service in (SceneService(self.bus), self.agent()):
            service.start()
            self.stack.callback(service.close)
        self.client = client(self.stack, self.bus, "me")
        return self

    def agent(self):
        def act(request):
            return Decision("act", "because", request.dialog, program=PROGRAM, kind="manipulate",
                            touched=("a1",))  # fmt: skip

        return AgentService(self.bus, act, self.executor, predict)

    def __exit__(self, *error):
        self.stack.close()

    def other(self, name="bob"):
        return client(self.stack, self.bus, name)

    def safety(self):
        return self.client.state().safety


@pytest.fixture
def table(executor):
    """At the table with an arm that moves at once."""
    return lambda: Table(executor, IdealRobot(Scene(objects=(APPLE,))))


@pytest.fixture
def slow_table(executor):
    """At the table with an arm whose motions the test lets go one by one."""
    return lambda: Table(executor, ByHand())


async def previewed(app, pilot):
    """Say something with the preview on, until its program is held before the first line."""
    await say(app, pilot, "/preview on")
    await say(app, pilot, "wave")
    await held_at(app, pilot, 1)


async def held_at(app, pilot, line):
    await wait_until(pilot, lambda: app.mode == "held" and app.panel.running == line)
    await wait_until(pilot, lambda: f"▷{line} robot" in shown(app, "#program-code"))


# --- preview ------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", SIZES)
async def test_a_previewed_program_is_shown_and_held_and_enter_runs_it(table, size):
    async with talking(size, table) as (world, app, pilot):
        await previewed(app, pilot)
        assert "paused" in pills(app)
        assert keys(app)[:3] == ["Enter", "F6", "Esc"]
        assert "Nothing has moved" in app.prompt.placeholder
        assert (len(app.map.picture.plan), app.map.picture.done) == (4, 0)
        assert world.robot.pose().y == -1.2
        await pilot.press("enter")
        await wait_until(pilot, lambda: "done" in pills(app))
        assert world.robot.pose().x == -0.8
        assert keys(app)[0] == "F1"


async def test_on_a_narrow_screen_what_is_previewed_takes_the_place_of_the_talk_once(table):
    async with talking((60, 24), table) as (_, app, pilot):
        assert app.query_one("#side").region.area == 0
        await previewed(app, pilot)
        await wait_until(pilot, lambda: app.query_one("#side").region.width == 60)
        assert any("◇" in row for row in map_rows(app))
        await pilot.press("f2")
        await wait_until(pilot, lambda: app.query_one("#side").region.area == 0)
        await pilot.press("f2", "enter")
        await wait_until(pilot, lambda: "done" in pills(app))
        await wait_until(pilot, lambda: app.chat.region.width == 60)


async def test_the_map_shows_the_way_that_comes_next_before_anything_moves(table):
    async with talking((120, 40), table) as (_, app, pilot):
        await previewed(app, pilot)
        await wait_until(pilot, lambda: "◇ next: 40, 0, 180 mm" in shown(app, "#map-aside"))
        await wait_until(pilot, lambda: sum(row.count("◇") for row in map_rows(app)) == 1)
        assert colors(app) >= {DARK.plan, DARK.tool}
        for line in (2, 3):
            await pilot.press("f6")
            await held_at(app, pilot, line)
        await wait_until(pilot, lambda: "◇ next: grip" in shown(app, "#map-aside"))
        assert colors(app) >= {DARK.done, DARK.plan}


def colors(app):
    """The colours of the dotted ways on the map."""
    cells = [cell for row in app.query_one(TableMap).rows() for cell in row]
    return {cell.fg for cell in cells if "\u2800" < cell.char <= "\u28ff"}


async def test_escape_gives_it_up_and_the_next_sentence_needs_no_reset(table):
    async with talking(world=table) as (world, app, pilot):
        await previewed(app, pilot)
        await pilot.press("escape")
        await wait_until(pilot, lambda: "cancelled" in pills(app))
        assert "nothing moved" in shown(app, ".reply")
        assert (world.safety(), world.robot.pose().y) == ("normal", -1.2)
        assert app.map.picture.plan == ()
        await say(app, pilot, "/preview off")
        await say(app, pilot, "wave")
        await wait_until(pilot, lambda: "done" in pills(app))


async def test_enter_and_escape_belong_to_the_prompt_while_something_is_typed(table):
    async with talking(world=table) as (_, app, pilot):
        await previewed(app, pilot)
        await pilot.press("a", "escape")
        await wait_until(pilot, lambda: app.prompt.text == "")
        await say(app, pilot, "wave again")
        await wait_until(pilot, lambda: "held program is over" in app.transcript())
        assert app.mode == "held"
        await pilot.press("escape")
        await wait_until(pilot, lambda: app.talk.waiting == [] and app.mode == "held")
        await pilot.press("enter")
        await wait_until(pilot, lambda: "done" in pills(app))


async def test_ctrl_c_gives_up_what_is_held_instead_of_stopping_it(table):
    async with talking(world=table) as (world, app, pilot):
        await previewed(app, pilot)
        await pilot.press("ctrl+c")
        await wait_until(pilot, lambda: "cancelled" in pills(app))
        assert world.safety() == "normal"


async def test_try_is_a_dry_run_in_any_mode(table):
    async with talking(world=table) as (world, app, pilot):
        await say(app, pilot, "/preview on")
        await say(app, pilot, "/try wave")
        await wait_until(pilot, lambda: "nothing moved" in app.transcript())
        assert world.client.state().program == "idle"


async def test_preview_is_off_for_a_simulated_arm_and_on_for_a_real_one():
    async with talking() as (_, app, pilot):
        assert not app.preview.on
        await say(app, pilot, "/preview")
        await wait_until(pilot, lambda: "preview is off" in app.transcript())
    async with talking(world=RealArm) as (_, app, pilot):
        assert app.preview.on
        assert "you see it before it runs" in app.prompt.placeholder
    async with talking(world=RealArm, preview=False) as (_, app, pilot):
        assert not app.preview.on


class RealArm(World):
    """The small world with a bridge whose arm is real."""

    def __init__(self):
        super().__init__()
        self.bridge.limits = msgspec.structs.replace(LIMITS, simulated=False)


# --- step, pause, stop --------------------------------------------------------------------------


@pytest.mark.parametrize("size", SIZES)
async def test_f6_steps_a_held_program_to_its_end_while_something_is_typed(table, size):
    async with talking(size, table) as (_, app, pilot):
        await previewed(app, pilot)
        await pilot.press("h", "i")
        for line in (2, 3, 4):
            await pilot.press("f6")
            await held_at(app, pilot, line)
            assert "paused" in pills(app)
        await pilot.press("f6")
        await wait_until(pilot, lambda: "done" in pills(app))
        assert app.prompt.text == "hi"
        assert "▷" not in shown(app, "#program-code")


async def test_f6_holds_a_running_program_at_the_end_of_its_line(slow_table):
    async with talking((120, 40), slow_table) as (world, app, pilot):
        await say(app, pilot, "wave")
        await wait_until(pilot, lambda: "▶1" in shown(app, "#program-code"))
        assert keys(app)[:2] == ["F6", "F7"]
        await pilot.press("f6")
        await wait_until(pilot, lambda: "pausing" in pills(app))
        assert ("F7", "go on") in app.query_one("#keys").hints
        world.robot.motions.release()
        await held_at(app, pilot, 2)
        assert keys(app)[0] == "Enter"
        assert app.panel.held
        assert "held at line 2" in shown(app, "#program-title")


async def test_f7_pauses_and_goes_on_even_behind_help(slow_table):
    async with talking(world=slow_table) as (world, app, pilot):
        await say(app, pilot, "wave")
        await wait_until(pilot, lambda: app.mode == "runs")
        await pilot.press("f1")
        await wait_until(pilot, lambda: isinstance(app.screen, HelpScreen))
        await pilot.press("f7")
        world.robot.motions.release(9)
        await wait_until(pilot, lambda: app.mode == "held")
        await pilot.press("f7")
        await wait_until(pilot, lambda: "done" in pills(app))


async def test_f7_takes_back_a_pause_that_has_not_come_yet(slow_table):
    async with talking(world=slow_table) as (world, app, pilot):
        await say(app, pilot, "wave")
        await wait_until(pilot, lambda: app.mode == "runs")
        await pilot.press("f7", "f7")
        await wait_until(pilot, lambda: not app.talk.pausing)
        world.robot.motions.release(9)
        await wait_until(pilot, lambda: "done" in pills(app))


async def test_f8_stops_a_paused_program_and_latches(table):
    async with talking(world=table) as (world, app, pilot):
        await previewed(app, pilot)
        await pilot.press("f6")
        await held_at(app, pilot, 2)
        await pilot.press("f8")
        await wait_until(pilot, lambda: "STOPPED" in pills(app))
        await wait_until(pilot, lambda: not app.talk.busy)
        assert world.safety() == "stopped"
        await pilot.press("f6")
        await wait_until(pilot, lambda: "F6 steps a program: none" in app.transcript())
        await say(app, pilot, "/reset")
        await wait_until(pilot, lambda: "the latch is cleared" in app.transcript())
        await say(app, pilot, "/resume")
        await wait_until(pilot, lambda: "normal" in pills(app))


async def test_the_program_of_somebody_else_is_not_ours_to_step(slow_table):
    async with talking((120, 40), slow_table) as (world, app, pilot):
        events = world.other().say("wave")
        await wait_until(pilot, lambda: app.mode == "others")
        assert keys(app)[0] == "F1"
        await pilot.press("f6")
        await wait_until(pilot, lambda: "held by bob: only it can" in app.transcript())
        world.robot.motions.release(9)
        assert [*events][-1].turn.status == "done"


async def test_the_palette_steps_cancels_and_switches_the_preview(table):
    async with talking(world=table) as (_, app, pilot):
        await chosen(app, pilot, "preview")
        await wait_until(pilot, lambda: app.preview.on)
        await say(app, pilot, "wave")
        await held_at(app, pilot, 1)
        await chosen(app, pilot, "step")
        await held_at(app, pilot, 2)
        await chosen(app, pilot, "cancel program")
        await wait_until(pilot, lambda: "stopped by you" in shown(app, ".reply"))
        assert "stopped" in pills(app)


async def chosen(app, pilot, words):
    """Pick from the palette what these words find first."""
    await pilot.press("ctrl+p")
    await wait_until(pilot, lambda: app.screen.is_modal)
    await pilot.press(*words)
    found = app.screen.query("OptionList").first()
    await wait_until(pilot, lambda: found.option_count >= 1 and words.split()[0] in str(
        found.get_option_at_index(0).prompt).lower())  # fmt: skip
    await pilot.press("enter")
    await wait_until(pilot, lambda: not app.screen.is_modal)
