"""How the terminal's tests wait: until something is so, never for a fixed time."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from typing import Any

from textual.pilot import Pilot
from textual.widgets import Static
from tui_world import World

from tui.app import ArmchatApp
from tui.map import TableMap


async def wait_until(pilot: Pilot[int], so: Callable[[], object]) -> None:
    """Let the application work until ``so()`` is true; fails after half a minute, with the chat."""
    try:
        async with asyncio.timeout(30):
            while not so():
                await pilot.pause(0.01)
    except TimeoutError:
        app = pilot.app
        chat = app.transcript() if isinstance(app, ArmchatApp) else ""
        raise AssertionError(f"it did not come to this; the chat says:\n{chat}") from None


@asynccontextmanager
async def talking(
    size: tuple[int, int] = (80, 24), world: Any = World, **options: Any
) -> AsyncIterator[tuple[Any, ArmchatApp, Pilot[int]]]:
    """A world, an application connected to it, and a pilot."""
    with world() as world:
        app = ArmchatApp(world.client, **options)
        async with app.run_test(size=size) as pilot:
            # until the limits are known an arm counts as real, and its programs are previewed
            await wait_until(pilot, lambda: app.seen and app.state and app.preview.limits)
            await wait_until(pilot, lambda: "● connected" in pills(app))
            yield world, app, pilot


async def say(app: ArmchatApp, pilot: Pilot[int], text: str) -> None:
    """Type a sentence and press Enter."""
    app.prompt.insert(text)
    await pilot.press("enter")


def pills(app: ArmchatApp) -> list[str]:
    """The header's words."""
    return [pill.text for pill in app.query_one("#header").pills]


def keys(app: ArmchatApp) -> list[str]:
    """The keys that the bottom line offers."""
    return [key for key, _ in app.query_one("#keys").hints]


def map_rows(app: ArmchatApp) -> list[str]:
    """The map's characters, row by row."""
    return ["".join(cell.char for cell in row) for row in app.query_one(TableMap).rows()]


def shown(app: ArmchatApp, selector: str) -> str:
    """The text of the widgets that match, as it is on screen."""
    found = app.screen.query(selector).results(Static)
    return "\n".join(str(widget.visual) for widget in found)


@contextmanager
def held(world: World) -> Iterator[None]:
    """While inside, the agent's "wait" hangs and "push" goes step by step."""
    world.agent.gate.clear()
    world.agent.pace_by_hand = True
    yield
    world.agent.gate.set()
