"""Tables on which the tests of the prelude run programs."""

from agent.compose import table
from scene.types import Scene, SceneObject

CHECK = table("check")


def thing(identity, name, x, y, size=0.1, color=None):
    return SceneObject(
        id=identity, name=name, x=x, y=y, width=size, height=size, tall=size, color=color
    )


BLOCKS = Scene(
    objects=(
        thing("b1", "block", 0.4, 0.1, 0.10, "red"),
        thing("b2", "block", -0.5, 0.5, 0.14, "blue"),
        thing("b3", "block", -0.1, -0.6, 0.12, "green"),
        thing("s1", "red star", 0.7, -0.7, 0.08, "red"),
    )
)
