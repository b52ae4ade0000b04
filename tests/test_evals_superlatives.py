"""What is chosen by size is clear where a person can see it."""

import pytest
from clarifier_table import thing

from evals.superlatives import told_apart
from scene.types import Scene

CUPS = Scene(
    objects=(
        thing("cup", -0.5, 0.0, size=0.30, tall=0.40),
        thing("cup", 0.0, 0.0, number=2, size=0.305, tall=0.30),
        thing("cup", 0.5, 0.0, number=3, size=0.40, tall=0.41),
    )
)


@pytest.mark.parametrize(
    ("program", "group", "clear"),
    [
        ("touch(largest(A))", ["cup_1", "cup_2", "cup_3"], True),
        ("touch(smallest(A))", ["cup_1", "cup_2", "cup_3"], True),
        ("touch(ordered(A, [one.tall for one in A])[-1])", ["cup_1", "cup_2", "cup_3"], False),
        ("touch(ordered(A, [one.tall for one in A])[0])", ["cup_1", "cup_2", "cup_3"], True),
        ("touch(ordered(A, [one.width for one in A])[-1])", ["cup_1", "cup_2"], False),
        ("for one in A:\n    touch(one)", ["cup_1", "cup_2"], True),
    ],
)
def test_a_superlative_is_clear_where_it_can_be_seen(program, group, clear):
    assert told_apart(program, {"A": group}, CUPS) is clear


def test_single_things_are_compared_too():
    assert told_apart("pick(largest([a, b]))", {"a": "cup_1", "b": "cup_3"}, CUPS)
    same = Scene(objects=(CUPS.objects[0], thing("mug", 0.5, 0.5, size=0.3, tall=0.4)))
    assert not told_apart("pick(largest([a, b]))", {"a": "cup", "b": "mug"}, same)
