"""Names that the person gives to things: known for the whole conversation, and to the eye."""

from collections.abc import Iterator

import msgspec
import pytest

from agent.arm import BusArm, LocalArm
from agent.bus import MemoryBus
from agent.called import called
from agent.compose import parts_on, table, thinking
from agent.errors import Declined
from agent.messages import Dialog, SceneCall, SceneSnapshot
from agent.turn import run_turn
from scene.types import Scene

KITCHEN = table("kitchen")
NAMELESS = msgspec.structs.replace(
    KITCHEN.get("block_1"), id="thing_1", name="thing", color="purple"
)
TABLE = msgspec.structs.replace(
    KITCHEN, objects=(*(one for one in KITCHEN.objects if one.name != "block"), NAMELESS)
)


@pytest.fixture(scope="module")
def mind() -> Iterator[object]:
    with thinking() as mind:
        yield mind


def talk(mind, *sentences: str, scene: Scene = TABLE):
    dialog, turns = Dialog(), []
    with parts_on(mind, scene) as parts:
        for say in sentences:
            turn, dialog = run_turn(say, dialog, parts)
            turns.append(turn)
    return turns


@pytest.mark.parametrize(
    "naming",
    ["call this the widget", "Let's call it a widget.", "that's a widget", "this is the widget",
     "name that thing widget", "this one is called the widget"],
)  # fmt: skip
def test_what_was_spoken_of_last_is_called_by_its_new_name(mind, naming):
    _, named, used = talk(mind, "touch the purple thing", naming, "lift the widget")
    assert named.status == "answered" and "widget" in named.reply
    assert (used.status, used.reply) == ("done", "I hold the widget.")


def test_the_only_thing_without_a_name_needs_no_pointing(mind):
    _, used = talk(mind, "this is a frobnicator", "touch the frobnicator")
    assert used.program == "touch(frobnicator)"


def test_a_thing_without_a_name_is_named_by_what_it_looks_like_for_good(mind):
    """The name is the thing's own: it stays when another one of that colour comes."""
    twin = msgspec.structs.replace(NAMELESS, id="thing_2", x=0.7, y=-0.2)
    (named,) = talk(mind, "call the purple thing the gizmo")
    assert named.status == "answered"
    again = msgspec.structs.replace(TABLE, objects=(*TABLE.objects, twin))
    dialog = Dialog(called=(("thing_1", "gizmo"),))
    with parts_on(mind, again) as parts:
        turn, _ = run_turn("touch the gizmo", dialog, parts)
    assert turn.status == "done"


def test_one_of_several_things_without_names_has_to_be_pointed_out(mind):
    twin = msgspec.structs.replace(NAMELESS, id="thing_2", x=0.7, y=-0.2, color="green")
    scene = msgspec.structs.replace(TABLE, objects=(*TABLE.objects, twin))
    (turn,) = talk(mind, "call this the widget", scene=scene)
    assert turn.status == "refused" and "Which thing" in turn.reply


@pytest.mark.parametrize("naming", ["call it left", "name this move"])
def test_words_of_the_language_name_nothing(mind, naming):
    _, turn = talk(mind, "touch the purple thing", naming)
    assert turn.status == "refused"


def test_a_known_word_names_nothing_by_the_way(mind):
    """ "this is the apple" is no naming, while "call this the apple" is."""
    _, turn, after = talk(mind, "touch the cup", "this is the apple", "touch the cup")
    assert turn.status != "done" and after.status == "done"


def test_a_scene_with_names_is_otherwise_the_same():
    scene = called(TABLE, {"thing_1": "widget", "gone_1": "ghost"})
    assert scene.get("thing_1") == msgspec.structs.replace(NAMELESS, name="widget")
    others = [one for one in scene if one.id != "thing_1"]
    assert others == [one for one in TABLE if one.id != "thing_1"]
    assert called(TABLE, {}) is TABLE


def test_the_arm_tells_a_name_to_the_eye_once(mind):
    heard: list[tuple[str, str]] = []

    class Told(LocalArm):
        def call(self, id_: str, name: str) -> None:
            heard.append((id_, name))

    dialog = Dialog()
    with parts_on(mind, TABLE) as parts:
        parts = parts._replace(arm=Told(parts.arm._robot))
        for say in ("touch the purple thing", "call this the widget", "touch the widget"):
            _, dialog = run_turn(say, dialog, parts)
    assert heard == [("thing_1", "widget")]


def test_over_the_bus_the_eye_that_is_there_gets_the_name():
    bus, heard = MemoryBus(), []

    def call(key: str, request: SceneCall) -> SceneSnapshot:
        heard.append(request)
        return SceneSnapshot(1, 0.0, TABLE)

    arm = BusArm(bus, "ann")
    arm.call("thing_1", "widget")
    assert heard == []  # nobody sees: the conversation alone knows it
    bus.serve(bus.keys.call(), call)
    arm.call("thing_1", "widget")
    assert heard == [SceneCall("thing_1", "widget")]


@pytest.mark.parametrize("error", [Declined("no_object", "gone"), RuntimeError("broken")])
def test_an_eye_that_cannot_keep_a_name_does_not_end_the_turn(error):
    bus = MemoryBus()

    def call(key: str, request: SceneCall) -> SceneSnapshot:
        raise error

    bus.serve(bus.keys.call(), call)
    BusArm(bus, "ann").call("thing_9", "widget")
