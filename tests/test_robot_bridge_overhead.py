"""The overhead camera's view is that of its pictures, to a fraction of a pixel."""

import numpy as np
import pytest

pytest.importorskip("pybullet")

from robot_bridge.api import Pictured
from robot_bridge.bullet import BulletRobot, overhead
from scene.lean import seen_at
from scene.types import Scene, SceneObject

PLACES = ((0.6, -0.5), (-0.7, 0.3), (0.0, 0.7))


@pytest.mark.parametrize("size", [(320, 240), (300, 300)])
def test_a_point_of_the_table_is_where_the_view_says(size):
    things = tuple(
        SceneObject(
            id=f"a_{n}", name="plaque", x=x, y=y, width=0.2, height=0.2, tall=0.02, color="red"
        )
        for n, (x, y) in enumerate(PLACES)
    )
    robot = BulletRobot(Scene(objects=things))
    assert isinstance(robot, Pictured)
    pixels = robot.picture(*size).astype(float)
    view = robot.view(*size)
    robot.close()
    red = pixels[:, :, 0] - pixels[:, :, 1]
    for x, y in PLACES:
        u, v = view.pixels(np.array([seen_at((x, y), 0.02, view.camera)]))[0]
        rows, columns = np.mgrid[0 : size[1], 0 : size[0]]
        weight = np.where(
            (abs(rows - v) < 15) & (abs(columns - u) < 15), np.maximum(red - 40, 0), 0
        )
        seen = (weight * columns).sum() / weight.sum(), (weight * rows).sum() / weight.sum()
        assert seen == pytest.approx((u, v), abs=0.2)


def test_the_view_goes_there_and_back():
    view = overhead(640, 480)
    points = np.array([[0.0, 0.0], [1.0, -1.0], [-0.3, 0.8]])
    assert view.points(view.pixels(points)) == pytest.approx(points)
    assert view.pixels(points)[0] == pytest.approx((319.75, 239.25))
