"""What is to be set on something ends there, or the program is not acted on."""

import msgspec
import pytest
from clarifier_table import linked, thing

from clarifier.set_upon import not_set_upon
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("phone", -0.5, 0.0), thing("book", 0.5, 0.0, size=0.4), thing("glue", 0.0, 0.6),
    )
)  # fmt: skip


def after(**on):
    """The table with things on others."""
    moved = (msgspec.structs.replace(item, on=on.get(item.name, item.on)) for item in TABLE.objects)
    return Scene(objects=tuple(moved))


def refused(text, body, ends):
    sentence = linked(text, TABLE)
    binding = {one.slot: one.objects for one in sentence.mentions}
    return not_set_upon(sentence, body, binding, ends)


@pytest.mark.parametrize(
    ("ends", "is_refused"),
    [
        (after(phone="book_1"), False), (after(), True),
        (after(phone="glue_1", glue="book_1"), False), (after(glue="book_1"), True),
    ],
)  # fmt: skip
def test_a_program_sets_upon_what_it_names(ends, is_refused):
    assert refused("phone, book", "put_on(m1, m2)", ends) is is_refused


@pytest.mark.parametrize(
    ("text", "is_refused"),
    [
        ("put the phone on top of the book at its left end", True),
        ("put the phone onto the book", True), ("put the phone next to the book", False),
        ("put the phone on the left of the book", False),
        ("if the phone is on top of the book, put the phone next to the glue", False),
        ("don't put the phone on top of the book", False),
    ],
)  # fmt: skip
def test_what_the_sentence_plainly_sets_on_something_does_not_go_beside(text, is_refused):
    assert refused(text, "put(m1, left_of(m1, m2))", after()) is is_refused
