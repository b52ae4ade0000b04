"""Things, scenes and the plain program that the tests of running programs share."""

from scene.types import Scene, SceneObject

GOOD = "robot.move(apple.x, 0, 0.5, 0)"


def thing(name, x=None, y=None, size=0.12, tall=0.1):
    return SceneObject(
        id=f"{name}_1", name=name, x=x, y=y, width=size, height=size, tall=tall,
        on="tray" if x is None else "table",
    )  # fmt: skip


def table(*names):
    return Scene(objects=tuple(thing(name, 0.2 * n, -0.1 * n) for n, name in enumerate(names)))


def tray(*names, objects=()):
    return Scene(objects=tuple(objects), tray=tuple(thing(name) for name in names))


def runs(executor, source=GOOD):
    """The one result of a program on one scene."""
    (result,) = executor.run(source, "manipulate", [table("apple")])
    return result
