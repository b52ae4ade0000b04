"""When a motion is over: number, pose and clock together."""

import pytest

from agent.errors import MoveTimeout, NotAtTarget
from robot_bridge.dobot_cell import Millimetres
from robot_bridge.dobot_watch import LOOKS, SETTLE_S, STALL_S, Watch

START, GOAL = Millimetres(200, 0, 0, 0), Millimetres(200, 100, 0, 30)
STEP = 0.02


def looks(watch, told, poses, now=0.0):
    """Look once a step; at which look it was over, None if never."""
    for count, (number, pose) in enumerate(zip(told, poses, strict=True), 1):
        if watch.look(number, pose, now + count * STEP):
            return count
    return None


def way(count):
    return [Millimetres(200, 100 * n / count, 0, 30 * n / count) for n in range(1, count + 1)]


def watch(number=5, target=GOAL, deadline=100.0):
    return Watch(number, target, START, 0.0, deadline)


def test_it_is_over_once_the_number_is_told_and_the_arm_rests_at_the_target():
    poses = [*way(10), GOAL, GOAL, GOAL]
    assert looks(watch(), [4] * 10 + [5] * 3, poses) == 11
    assert looks(watch(), [4] * 12 + [5], poses) == 13


@pytest.mark.parametrize("stale", [6, 99, 2**64 - 1, 4, 0])
def test_other_numbers_do_not_count_larger_ones_neither(stale):
    assert looks(watch(), [stale] * 12 + [5], [*way(10), GOAL, GOAL, GOAL]) == 13


def test_a_number_told_too_early_waits_for_the_pose():
    assert looks(watch(), [5] * 12, [*way(10), GOAL, GOAL]) == 11


def test_a_motion_that_is_told_done_and_never_made_is_not_at_its_target():
    count = max(LOOKS, round(SETTLE_S / STEP)) + 3
    with pytest.raises(NotAtTarget, match=r"100\.0 mm off"):
        looks(watch(), [5] * count, [START] * count)


def test_an_arm_that_stands_still_is_stuck_after_three_seconds():
    count = round(STALL_S / STEP)
    assert looks(watch(), [4] * (count - 1), [START] * (count - 1)) is None
    with pytest.raises(MoveTimeout, match="3 s"):
        looks(watch(), [4] * (count + 3), [START] * (count + 3))


def test_a_stall_needs_several_looks_however_late_they_come():
    late = watch(deadline=1e6)
    for n in range(1, LOOKS):
        assert not late.look(4, START, 10.0 * n)
    with pytest.raises(MoveTimeout):
        late.look(4, START, 10.0 * LOOKS)


def test_a_motion_has_a_deadline_though_it_goes_on():
    slow = watch(deadline=1.0)
    with pytest.raises(MoveTimeout, match="longer"):
        looks(slow, [4] * 80, way(800)[:80])


def test_who_comes_late_to_look_blames_no_arm_that_is_there():
    late = watch(deadline=1.0)
    assert not late.look(4, way(10)[5], 0.5)
    assert not late.look(5, GOAL, 60.0)
    assert late.look(5, GOAL, 60.1)


def test_a_millimetre_is_at_the_target_and_more_is_not():
    for off, there in ((0.9, True), (1.1, False)):
        poses = [GOAL._replace(x=200 + off)] * 3
        assert (looks(watch(), [5] * 3, poses) is not None) is there


def test_what_moves_nothing_is_over_when_it_is_told():
    assert looks(watch(target=None), [4, 4, 5], [START] * 3) == 3
