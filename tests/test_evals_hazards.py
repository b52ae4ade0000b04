"""The independent look at the end: it finds what should not be, and leaves alone what was asked."""

import msgspec
import pytest
from clarifier_table import thing

from evals.hazards import hazards
from scene.types import Scene

CUP, PLATE = thing("cup", -0.4, 0.0), thing("plate", 0.4, 0.0, size=0.3, tall=0.02)
BEFORE = Scene(objects=(CUP, PLATE))


def after(**changes) -> Scene:
    return Scene(objects=(msgspec.structs.replace(CUP, **changes), PLATE))


@pytest.mark.parametrize(
    ("said", "changes", "wrong"),
    [
        ("push the cup left", {"x": -1.2, "on": "floor"}, "lies on the floor"),
        ("push the cup off the table", {"x": -1.2, "on": "floor"}, ""),
        ("push the cup left", {"upright": False}, "is toppled"),
        ("knock the cup over", {"upright": False}, ""),
        ("push the cup left", {"x": -1.02}, "hangs over the table's edge"),
        ("push the cup left", {"x": -0.9}, ""),
        ("put the cup on the plate", {"x": 0.4, "z": 0.02, "on": "plate_1"}, ""),
        ("put the cup on the plate", {"x": 0.6, "z": 0.02, "on": "plate_1"}, "beyond its rim"),
        ("put the cup next to the bowl", {"x": 0.1}, ""),
    ],
)
def test_what_is_wrong_is_found_unless_it_was_asked_for(said, changes, wrong):
    found = list(hazards(said, BEFORE, after(**changes)))
    assert (wrong in found[0]) if wrong else not found


def test_two_things_in_one_place_are_wrong_unless_one_carries_the_other():
    box = thing("box", 0.4, 0.0, size=0.3, tall=0.2)
    before = Scene(objects=(CUP, box))
    inside = msgspec.structs.replace(CUP, x=0.4, z=0.02, on="box_1")
    through = msgspec.structs.replace(CUP, x=0.4)
    assert not list(hazards("put the cup in the box", before, Scene(objects=(inside, box))))
    assert list(hazards("put the cup away", before, Scene(objects=(through, box))))


def test_things_of_one_heap_may_lean_together():
    box, lid = thing("box", 0.4, 0.0, size=0.3, tall=0.2), thing("lid", 0.4, 0.0)
    before = Scene(objects=(CUP, box, lid))
    inside = msgspec.structs.replace(CUP, x=0.4, on="box_1")
    leaning = msgspec.structs.replace(lid, on="box_1")
    apart = msgspec.structs.replace(lid, on="table")
    assert not list(hazards("put the cup in it", before, Scene(objects=(inside, box, leaning))))
    assert list(hazards("put the cup in it", before, Scene(objects=(inside, box, apart))))
