"""What a program did, as postconditions and conditions see it."""

from __future__ import annotations

import random
from collections.abc import Sequence

import msgspec

from agent.messages import Command, Kind, Status
from scene.generate import random_scene
from scene.types import Scene, SceneObject, identifiers


class World(msgspec.Struct, frozen=True):
    """What a program did: the scene before and after, the primitives in between.

    ``statuses``: how each turn ended, where a dialogue is looked at.
    """

    before: Scene
    after: Scene
    path: tuple[Command, ...]
    statuses: tuple[Status, ...] = ()

    def was(self, noun: str) -> SceneObject:
        """The object as it was. Raises KeyError if the scene has none of that name."""
        return identifiers(self.before)[noun]

    def now(self, noun: str) -> SceneObject:
        """The object as it is. Raises KeyError if the scene had none of that name."""
        return self.after.get(self.was(noun).id)

    def moves(self) -> list[Command]:
        """The ``move`` primitives of the path."""
        return [command for command in self.path if command.op == "move"]


def random_table(kind: Kind, nouns: Sequence[str], rng: random.Random) -> Scene:
    """A random scene of these things: in the tray for an arrange program, on the table else."""
    return random_scene(rng, [], nouns) if kind == "arrange" else random_scene(rng, nouns)


def unmoved(world: World) -> World:
    """The world as it was before the program: what a condition looks at."""
    return World(world.before, world.before, world.path)
