"""One thing upon two is a bridge; what carries never comes upon what it carries."""

import msgspec
import pytest
from clarifier_table import LEXICON, thing

from clarifier.across import laid_across, resting_on
from clarifier.binding import bindings
from clarifier.mentions import link
from clarifier.stated import as_stated, stated
from clarifier.turns import in_plain_turns
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("lath", 0.0, 0.6, size=0.5, tall=0.04),
        thing("post", -0.4, -0.3, number=1, tall=0.3),
        thing("post", 0.4, -0.3, number=2, tall=0.3),
        thing("pot", -0.6, 0.3, "red", number=1, tall=0.3),
        thing("pot", 0.6, 0.3, "blue", number=2, tall=0.3),
    )
)


@pytest.mark.parametrize(
    ("text", "carriers"),
    [
        ("lay the lath across the two posts", "the left post and the right post"),
        ("rest the lath upon both posts", "the left post and the right post"),
        ("the lath goes over the posts", "the left post and the right post"),
        ("put the lath on the two pots", "the red pot and the blue pot"),
        ("place the lath so that it lies across both pots", "the red pot and the blue pot"),
        ("the lath goes over from one pot to the other", "the red pot and the blue pot"),
    ],
)
def test_what_lies_upon_two_is_a_bridge(text, carriers):
    linked = link(in_plain_turns(text, LEXICON), TABLE, (), LEXICON)
    assert laid_across(linked, TABLE) == f"build a bridge with the lath across {carriers}"


@pytest.mark.parametrize(
    "text",
    [
        "put the two posts on the lath",
        "put the lath on the left post",
        "put the lath between the two posts",
        "put the lath next to the posts",
        "put the lath on the two posts and push the red pot away",
    ],
)
def test_other_sentences_are_no_bridge(text):
    assert laid_across(link(text, TABLE, (), LEXICON), TABLE) is None


def test_what_is_to_carry_does_not_end_on_what_it_carries():
    linked = link("put the lath on the left post", TABLE, (), LEXICON)
    goals = stated(linked, bindings(linked, TABLE, {})[0], TABLE)

    def ends(lower, upper):
        items = (
            msgspec.structs.replace(item, on=lower) if item.id == upper else item
            for item in TABLE.objects
        )
        return as_stated(goals, TABLE, Scene(objects=tuple(items)))

    assert ends("post_1", "lath_1")
    assert not ends("lath_1", "post_1")


def test_two_that_stand_close_enough_are_not_moved():
    near = Scene(objects=(TABLE.get("lath_1"), thing("post", -0.2, 0.0, number=1),
                          thing("post", 0.2, 0.0, number=2)))  # fmt: skip
    text = "lay the lath across the two posts"
    assert laid_across(link(text, near, (), LEXICON), near) is None


STEPS = Scene(
    objects=(
        thing("brick", -0.105, 0.0, "green", size=0.2, tall=0.2),
        thing("brick", 0.105, 0.0, "orange", number=2, size=0.2, tall=0.2),
        thing("brick", 0.5, 0.6, "blue", number=3, size=0.2, tall=0.2),
    )
)


@pytest.mark.parametrize(
    "text",
    [
        "put the blue brick on the green and orange bricks",
        "put the blue brick on top of the green brick and the orange brick",
    ],
)
def test_what_is_to_stand_on_two_neighbours_rests_on_both(text):
    put = resting_on(link(text, STEPS, (), LEXICON), STEPS)
    assert put == "rest the blue brick across the green brick and the orange brick"


@pytest.mark.parametrize(
    "text",
    [
        "put the blue brick on the green brick",
        "put the blue brick on the green brick and the orange brick next to it",
        "put the blue brick next to the green brick and the orange brick",
    ],
)
def test_other_places_are_no_rest_on_two(text):
    assert resting_on(link(text, STEPS, (), LEXICON), STEPS) is None


def test_two_that_stand_apart_carry_nothing():
    green, orange, blue = STEPS.objects
    apart = Scene(objects=(msgspec.structs.replace(green, x=-0.5), orange, blue))
    text = "put the blue brick on the green and orange bricks"
    assert resting_on(link(text, apart, (), LEXICON), apart) is None
