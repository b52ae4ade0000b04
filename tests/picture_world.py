"""Plans to draw, and their pictures read back from the SVG, that the tests of pictures share."""

from xml.etree import ElementTree

import pytest

from agent.messages import Command
from agent.picture import svg
from robot_bridge.api import PARK, Limits, approve
from scene.types import SceneObject

SVG = "{http://www.w3.org/2000/svg}"


class Space:
    """A workspace without an arm."""

    def __init__(self, **limits):
        self.limits = Limits(**limits)

    def reach(self, pose):
        return None


def move(x, y, z, line=0, grip=False, r=0.0):
    return Command("move", x, y, z, r, grip, line)


def suck(on, line=0):
    return Command("grip", 0.0, 0.0, 0.0, 0.0, on, line)


def thing(name, x, y, **more):
    sizes = {"id": f"{name}_1", "width": 0.2, "height": 0.1, "tall": 0.1}
    return SceneObject(name=name, x=x, y=y, **{**sizes, **more})


APPLE = thing("apple", -0.6, 0.3, width=0.14, height=0.14, tall=0.14, color="red")
BOX = thing("box", 0.5, -0.5, r=0.5, tall=0.3)
PICK = (
    move(-0.6, 0.3, 1.2, 1), move(-0.6, 0.3, 0.14, 2), suck(True, 3), move(-0.6, 0.3, 1.2, 4, True),
    move(0.4, 0.1, 1.2, 5, True), move(0.4, 0.1, 0.14, 6, True), suck(False, 7),
    move(0.4, 0.1, 0.9, 8),
)  # fmt: skip


class Drawing:
    """An SVG read back: its elements by class, and pixels as table units."""

    def __init__(self, commands=(), scene=None, after=None, program="", start=PARK, **limits):
        space = Space(**{"length": 1e6, **limits})
        plan = approve(commands, start, space, program, scene)
        self.plan, self.text = plan, svg(plan, space.limits, after)
        self.root = ElementTree.fromstring(self.text)
        self.above, self.side, self.beside = (
            next(node for node in self.root if node.get("class") == name)
            for name in ("above", "side", "beside")
        )
        (board,) = self.find("table")
        self.scale = float(board.get("width")) / 2
        self.zero = float(board.get("x")) + self.scale, float(board.get("y")) + self.scale

    def find(self, *names, within=None):
        nodes = (self.above if within is None else within).iter()
        return [node for node in nodes if set(names) <= set(node.get("class", "").split())]

    def words(self, *names, within=None):
        return [node.text for node in self.find(*names, within=within) if node.tag == f"{SVG}text"]

    def units(self, node, x="x", y="y"):
        """A point of the view from above in table units."""
        across = (float(node.get(x)) - self.zero[0]) / self.scale
        return across, (self.zero[1] - float(node.get(y))) / self.scale

    def discs(self, name):
        return [self.units(node, "cx", "cy") for node in self.find(name)]

    def lines(self, *names):
        found = [node for node in self.find(*names) if node.tag == f"{SVG}line"]
        return [(self.units(node, "x1", "y1"), self.units(node, "x2", "y2")) for node in found]

    def footprint(self, name, kind="thing"):
        (node,) = [item for item in self.find(kind) if item.get("data-id") == name]
        return node

    def middle(self, node):
        x, y = self.units(node)
        width, height = (float(node.get(key)) / self.scale for key in ("width", "height"))
        return x + width / 2, y - height / 2

    def height(self, pixel):
        """A height in the side view, read between the two limits."""
        top, bottom = sorted(float(n.get("y1")) for n in self.find("limit", within=self.side))
        return 1.5 * (bottom - pixel) / (bottom - top)

    def path(self, pixel):
        """A length of path in the side view, read between two ticks of its axis."""
        texts = self.find("text", within=self.side)
        ticks = [node for node in texts if node.get("text-anchor") == "middle"]
        one, other = ticks[0], ticks[-1]
        share = (pixel - float(one.get("x"))) / (float(other.get("x")) - float(one.get("x")))
        return float(one.text) + share * (float(other.text) - float(one.text))


def near(*expected):
    return pytest.approx(expected if len(expected) > 1 else expected[0], abs=2e-3)


def pairs(found, expected):
    assert len(found) == len(expected)
    for (one, other), (start, goal) in zip(found, expected, strict=True):
        assert one == near(*start) and other == near(*goal)
