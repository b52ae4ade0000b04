"""Size words: which measure each speaks of, by how things lie; ties and two readings are kept."""

import msgspec
import pytest
from clarifier_table import LEXICON, named, thing

from clarifier.sizes import by_size, halfway
from clarifier.things import size_of, things_of
from clarifier.turns import in_plain_turns
from scene.types import Scene


def sized(name, number, x, width, height, tall, color=None):
    item = thing(name, x, 0.3, color, number=number)
    return msgspec.structs.replace(item, width=width, height=height, tall=tall)


BOOKS = Scene(objects=tuple(
    sized("book", n, x, 0.3, 0.4, tall)
    for n, x, tall in ((1, -0.6, 0.05), (2, -0.1, 0.1), (3, 0.5, 0.22))
))  # fmt: skip
PENS = Scene(objects=tuple(
    sized("pen", n, x, 0.05, length, 0.05)
    for n, x, length in ((1, -0.6, 0.3), (2, -0.1, 0.22), (3, 0.5, 0.14))
))  # fmt: skip
CANDLES = Scene(objects=tuple(
    sized("candle", n, x, 0.1, 0.1, tall)
    for n, x, tall in ((1, -0.6, 0.5), (2, -0.1, 0.3), (3, 0.5, 0.2))
))  # fmt: skip


@pytest.mark.parametrize(
    ("word", "size"),
    [
        ("skinniest", "thin"), ("fattest", "thick"), ("chunkier", "thick"), ("wee", "small"),
        ("teeniest", "small"), ("hugest", "big"), ("slimmer", "thin"), ("littlest", "small"),
        ("stubbiest", "short"), ("largest", "big"), ("longer", "long"), ("flattest", "short"),
        ("nearest", ""), ("other", ""), ("best", ""), ("paper", ""), ("under", ""),
    ],
)  # fmt: skip
def test_a_size_is_known_in_each_degree(word, size):
    assert size_of(word, LEXICON) == size


@pytest.mark.parametrize(
    ("phrase", "scene", "ids"),
    [
        ("the skinniest book", BOOKS, {"book_1"}),
        ("the fattest book", BOOKS, {"book_3"}),
        ("the slimmest of the books", BOOKS, {"book_1"}),
        ("the second thickest book", BOOKS, {"book_2"}),
        ("the longest book", BOOKS, {"book_1", "book_2", "book_3"}),
        ("the longest pen", PENS, {"pen_1"}),
        ("the stubbiest pen", PENS, {"pen_3"}),
        ("the second-longest pen", PENS, {"pen_2"}),
        ("the two longest pens", PENS, {"pen_1", "pen_2"}),
        ("the thickest pen", PENS, {"pen_1", "pen_2", "pen_3"}),
        ("the shortest candle", CANDLES, {"candle_3"}),
        ("the longest candle", CANDLES, {"candle_1"}),
        ("the most tall candle", CANDLES, {"candle_1"}),
        ("the medium candle", CANDLES, {"candle_2"}),
        ("my wee candle", CANDLES, {"candle_3"}),
        ("the thinnest candle", CANDLES, {"candle_1", "candle_2", "candle_3"}),
    ],
)
def test_a_size_word_compares_what_it_speaks_of(phrase, scene, ids):
    found = named(in_plain_turns(f"touch {phrase}", LEXICON), scene)
    assert set().union(*found.values()) == ids


def test_two_equally_likely_readings_that_disagree_are_both_kept():
    flat_and_upright = Scene(objects=(
        sized("parcel", 1, -0.5, 0.2, 0.2, 0.3), sized("parcel", 2, 0.5, 0.4, 0.4, 0.1)
    ))  # fmt: skip
    assert set(named("lift the fat parcel", flat_and_upright)["fat parcel"]) == {
        "parcel_1", "parcel_2"
    }  # fmt: skip


def test_what_nobody_can_tell_apart_is_a_tie():
    pair = Scene(objects=(sized("pen", 1, -0.5, 0.05, 0.3, 0.05),
                          sized("pen", 2, 0.5, 0.05, 0.305, 0.05)))  # fmt: skip
    assert len(named("lift the longest pen", pair)["longest pen"]) == 2


def test_the_nth_largest_is_empty_where_there_are_fewer():
    books = list(things_of(BOOKS, LEXICON))
    assert by_size("thick", books, BOOKS, nth=4) == []
    assert [t.id for t in by_size("thick", books, BOOKS, nth=3)] == ["book_1"]


def test_of_an_even_number_none_is_halfway():
    candles = list(things_of(CANDLES, LEXICON))
    assert [t.id for t in halfway(candles, CANDLES)] == ["candle_2"]
    assert halfway(candles[:2], CANDLES) == candles[:2]
