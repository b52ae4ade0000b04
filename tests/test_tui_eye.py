"""What the terminal shows of the eye: whether it has a picture, what it is unsure of or misses."""

from __future__ import annotations

import time

import pytest
from tui_pilot import talking, wait_until
from tui_world import SCENE, thing

from agent.messages import SceneSnapshot
from scene.types import Scene
from tui.drawing import DARK, Picture, draw, labels
from tui.map import aside
from tui.status import STALE, camera, doubts

pytestmark = pytest.mark.live

ONE = Scene(objects=(thing("apple_1", 0.0, 0.0, 0.4, color="red"),))


def told(**fields):
    return SceneSnapshot(1, 0.0, SCENE, **fields)


@pytest.mark.parametrize(
    ("seen", "age", "text"),
    [
        (None, 0.0, None),
        (told(), 0.0, None),
        (told(camera="ok"), 0.0, "camera ok"),
        (told(camera="lost"), 0.0, "no picture"),
        (told(camera="ok"), STALE + 1, "no picture"),
    ],
)
def test_the_pill_says_whether_there_is_a_picture_where_there_is_a_camera(seen, age, text):
    pill = camera(seen, age)
    assert (None if pill is None else pill.text) == text


def test_only_what_is_worth_telling_is_told():
    seen = told(sd={"apple_1": 0.015, "cup_1": 0.009}, unseen={"cup_1": 0.9, "cup_2": 12.7})
    assert doubts(seen) == ((("apple_1", 3),), (("cup_2", 12),))


def test_below_the_map_stands_what_is_unsure_and_unseen():
    picture = Picture(SCENE, unsure=(("apple_1", 3),), unseen=(("cup_2", 12), ("gone_1", 3)))
    assert "unsure: apple ±3 mm" in aside(picture)
    assert "unseen: cup_2 for 12 s" in aside(picture)
    assert "gone" not in aside(picture)


def test_what_is_not_seen_has_a_question_mark():
    items = list(ONE.objects)
    assert labels(items, {"apple_1"}) == {"apple_1": "apple?"}
    assert labels(items) == {"apple_1": "apple"}


def test_an_unsure_thing_has_a_ring_about_it_the_wider_the_less_is_known():
    def dots(mm):
        picture = Picture(ONE, unsure=(("apple_1", mm),) if mm else ())
        rows = draw(picture, 80, 40, DARK)
        return {
            (column, row)
            for row, cells in enumerate(rows)
            for column, cell in enumerate(cells)
            if 0x2800 < ord(cell.char) <= 0x28FF
        }

    assert not dots(0)
    narrow, wide = dots(10), dots(30)
    assert narrow and wide
    assert max(column for column, _ in wide) > max(column for column, _ in narrow)


async def test_a_camera_that_goes_is_seen_in_the_header():
    async with talking() as (world, app, pilot):

        def tell(**fields):
            snapshot = SceneSnapshot(99, time.time(), SCENE, **fields)
            world.bus.publish(world.bus.keys.objects("main"), snapshot)

        def pills():
            return [pill.text for pill in app.header.pills]

        assert "camera ok" not in pills() and "no picture" not in pills()
        tell(camera="ok", sd={"apple_1": 0.02})
        await wait_until(pilot, lambda: "camera ok" in pills())
        await wait_until(pilot, lambda: app.map.picture.unsure == (("apple_1", 4),))
        tell(camera="lost", unseen={"apple_1": 2.5})
        await wait_until(pilot, lambda: "no picture" in pills())
        await wait_until(pilot, lambda: app.map.picture.unseen == (("apple_1", 2),))
