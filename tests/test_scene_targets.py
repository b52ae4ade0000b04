"""What is wanted of the detector's network: laid out, turned, and decoded again to the labels."""

import math

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from scene.augment import planes as batched  # noqa: E402
from scene.augment import relit, turned  # noqa: E402
from scene.detector_net import STRIDE  # noqa: E402
from scene.losses import overlap  # noqa: E402
from scene.peaks import peaks  # noqa: E402
from scene.pictured import Label, level_view  # noqa: E402
from scene.rectify import Grid, planes  # noqa: E402
from scene.targets import AROUND, middles, targets  # noqa: E402
from scene.truth import COLUMNS, MOST, NAMES, UNKNOWN, truth  # noqa: E402

GRID = Grid(size=96, mm=5.0)
CAMERA = (0.4, -0.3, 3.0)
UNIT = STRIDE * GRID.pixel
CELLS = GRID.size // STRIDE


def label(name="block", x=0.3, y=-0.2, width=0.4, height=0.2, r=0.3, seen=1.0, round=False):
    return Label(name, "blue", x, y, width, height, 0.25, r, round, seen, "", None)


def known(*labels):
    return torch.from_numpy(truth(labels))[None]


def camera():
    return torch.tensor([CAMERA])


def wanted(*labels):
    return targets(known(*labels), camera(), GRID)


def maps_of(target):
    """The maps of a network that says exactly what is wanted of it."""
    heat = torch.zeros(len(NAMES), CELLS * CELLS)
    place, shape = torch.zeros(4, CELLS * CELLS), torch.zeros(7, CELLS * CELLS)
    place[3] = 1.0
    for number in torch.nonzero(target.weight)[:, 0].tolist():
        cell = int(target.where[number])
        place[:2, cell], shape[:, cell] = target.place[number], target.shape[number]
        heat[target.kind[number], cell] = target.heat.flatten()[cell]
    return {
        name: plane.reshape(-1, CELLS, CELLS).numpy()
        for name, plane in (("heat", heat), ("place", place), ("shape", shape))
    }


@pytest.mark.parametrize("r", [-0.7, -0.2, 0.0, 0.5, 0.78])
@pytest.mark.parametrize(("width", "height"), [(0.4, 0.2), (0.2, 0.5), (0.31, 0.3)])
def test_what_is_wanted_of_the_network_decodes_to_the_label(r, width, height):
    one = label(width=width, height=height, r=r)
    other = label("apple", -0.5, 0.6, 0.3, 0.3, 0.0, round=True)
    found = peaks(maps_of(wanted(one, other)), UNIT, NAMES.index("other"))
    assert {NAMES[peak.kind] for peak in found} == {"block", "apple"}
    for peak in found:
        true = one if NAMES[peak.kind] == "block" else other
        assert (peak.x, peak.y) == pytest.approx((true.x, true.y), abs=1e-5)
        assert peak.tall == pytest.approx(true.tall, rel=1e-4)
        if width != 0.31 or true is other:  # nearly square: which side is long may not be told
            got = (peak.width, peak.height, peak.r)
            assert got == pytest.approx((true.width, true.height, true.r), abs=1e-3)


def test_the_peak_is_where_the_thing_shows_and_the_place_where_it_stands():
    one = label(x=-0.6, y=0.5)
    shown = middles(known(one), camera())[0, 0].tolist()
    heat = wanted(one).heat[0].numpy()
    row, column = np.unravel_index(heat.argmax(), heat.shape)
    at = GRID.at(np.array([STRIDE * (column + 0.5) - 0.5]), np.array([STRIDE * (row + 0.5) - 0.5]))
    assert at[0] == pytest.approx(shown, abs=UNIT / 2)
    assert math.dist(shown, (one.x, one.y)) > 0.01


def test_the_lean_planes_take_the_middle_that_shows_back_to_the_place():
    """Along the lean at the point that shows, times the height: the same as the projection."""
    one = label()
    shown = middles(known(one), camera())[0, :1].numpy().astype(float)
    u, v = level_view(CAMERA, GRID.size * GRID.pixel / 2, GRID.size).pixels(shown)[0]
    given = planes(np.full((GRID.size, GRID.size, 3), 90, np.uint8), CAMERA, GRID)
    right, down = given[3:, round(v), round(u)]
    back = GRID.at(
        np.array([u - right * one.tall / 2 / GRID.pixel]),
        np.array([v - down * one.tall / 2 / GRID.pixel]),
    )
    assert back[0] == pytest.approx((one.x, one.y), abs=0.005)


@pytest.mark.parametrize("ways", [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)])
def test_a_picture_turned_and_what_is_known_of_it_stay_together(ways):
    level = torch.zeros((1, GRID.size, GRID.size, 3), dtype=torch.uint8)
    view = level_view(CAMERA, GRID.size * GRID.pixel / 2, GRID.size)
    one = label(x=0.5, y=0.25, r=0.3)
    ahead = (one.x + 0.4 * math.cos(one.r), one.y + 0.4 * math.sin(one.r))
    for number, point in enumerate(((one.x, one.y), ahead)):
        u, v = view.pixels(np.array([point]))[0]
        level[0, round(v), round(u), number] = 255
    chosen = torch.tensor([ways], dtype=torch.bool)
    picture, eye, rows = turned(level, camera(), known(one), chosen)
    spots = [np.argwhere(picture[0, :, :, number].numpy())[0][::-1] for number in (0, 1)]
    at, then = (GRID.at(np.array([float(u)]), np.array([float(v)]))[0] for u, v in spots)
    assert at == pytest.approx(rows[0, 0, :2].tolist(), abs=GRID.pixel)
    turn = float(rows[0, 0, COLUMNS.index("turn")])
    across = (then - at) @ (-math.sin(turn), math.cos(turn))
    assert abs(across) < 2 * GRID.pixel < math.dist(at, then) - 0.3
    far = math.dist(eye[0, :2].tolist(), rows[0, 0, :2].tolist())
    assert far == pytest.approx(math.dist(CAMERA[:2], (one.x, one.y)), rel=1e-5)


def test_hidden_things_are_neither_wanted_nor_forbidden():
    target = wanted(label(seen=0.1))
    assert target.heat.max() == 0
    assert target.mind.min() == 0
    assert target.weight.max() == 0


def test_rows_of_nothing_ask_for_nothing_and_all_shapes_are_the_same():
    nothing, one = wanted(), wanted(label())
    assert nothing.weight.max() == nothing.heat.max() == 0
    assert nothing.mind.min() == 1
    assert len(nothing.where) == len(one.where) == MOST * AROUND


def test_a_color_or_a_kind_that_is_not_asked_for():
    hidden = label("")._replace(color=None)
    target = wanted(hidden)
    asked = target.weight > 0
    assert set(target.color[asked].tolist()) == set(target.kind[asked].tolist()) == {UNKNOWN}
    assert wanted(label()).heat.max() == target.heat.max() == 1


def test_many_pictures_planes_are_those_of_each():
    levels = np.random.default_rng(0).integers(0, 255, (2, 96, 96, 3)).astype(np.uint8)
    levels[1, :20] = 0
    eyes = [CAMERA, (-0.1, 0.2, 4.0)]
    given = torch.from_numpy(levels)
    shown = given.any(-1, keepdim=True)
    made = batched(given.float() / 255, shown, torch.tensor(eyes), GRID).numpy()
    for number, eye in enumerate(eyes):
        assert made[number] == pytest.approx(planes(levels[number], eye, GRID), abs=1e-5)


def test_another_light_leaves_black_black_and_changes_the_rest():
    torch.manual_seed(0)
    levels = torch.full((4, 8, 8, 3), 120, dtype=torch.uint8)
    levels[:, 0] = 0
    lit = relit(levels)
    assert (lit[:, 0] == 0).all()
    assert 0 < lit[:, 1:].min() < lit.max() <= 1
    assert len({round(float(one.mean()), 4) for one in lit}) == 4


@pytest.mark.parametrize(
    ("away", "factor", "common"), [((0, 0), 1.0, 1.0), ((0, 0), 0.5, 0.25), ((2.0, 0), 1.0, 1 / 3)]
)
def test_how_much_of_two_level_rectangles_is_common(away, factor, common):
    true = torch.tensor([[math.log(4.0), math.log(2.0), 0.0, 1.0, 0.0, 1.0, 0.0]])
    told = true.clone()
    told[:, :2] += math.log(factor)
    assert float(overlap(torch.tensor([away]).float(), told, true)) == pytest.approx(common)
    turned_shape = torch.tensor([[math.log(4.0), math.log(2.0), 0.0, -1.0, 0.0, 1.0, 0.0]])
    along = overlap(torch.tensor([[0.0, 2.0]]), turned_shape, turned_shape)
    assert float(along) == pytest.approx(1 / 3, abs=1e-5)
