"""A hearing that passes over what is to be done is no hearing."""

import pytest
from clarifier_table import LEXICON, TABLE

from clarifier.overheard import loses_a_deed, whole


@pytest.mark.parametrize(
    ("text", "heard"),
    [
        # a wish of its own, by a verb that nobody knows or one that everybody does
        ("that sponge is dry. Nestle it in the bowl, dear", "that sponge is dry."),
        ("mind the mugs. Put the sponge in the bowl", "mind the mugs."),
        ("push the bottle left. Then the sponge needs care, push the plate back",
         "push the bottle left. Then the sponge needs care"),
        # the thing behind the verb, the verb behind the ban
        ("twist 'er halfway", "twist halfway"),
        ("push the plate but don't scratch the bottle", "push the plate but don't the bottle"),
        # things named and nothing more
        ("Sponge, bowl. Then tap the bottle", "Then tap the bottle"),
        # one of two
        ("put the sponge between the plate and the bottle please",
         "put the sponge between the plate please"),
        # what stands behind a correction
        ("put the sponge left of the plate, no wait, behind it",
         "put the sponge left of the plate"),
    ],
)  # fmt: skip
def test_what_is_to_be_done_is_not_passed_over(text, heard):
    assert loses_a_deed(text, heard, TABLE, LEXICON)
    assert whole(lambda _: [heard], TABLE)(text) == []


@pytest.mark.parametrize(
    ("text", "heard"),
    [
        ("my aunt is coming at nine, put the sponge in the bowl", "put the sponge in the bowl"),
        ("put the sponge in the bowl, it was on my list", "put the sponge in the bowl"),
        ("put the plate back, no wait, put the sponge in the bowl", "put the sponge in the bowl"),
        ("put the sponge on the plate, no, in the bowl", "put the sponge in the bowl"),
        ("well well, push the bottle left, there's a dear", "push the bottle left"),
        ("push the bottle left because the bottle leaks", "push the bottle left"),
    ],
)
def test_talk_is_passed_over(text, heard):
    assert not loses_a_deed(text, heard, TABLE, LEXICON)
    assert whole(lambda _: [heard], TABLE)(text) == [heard]


def test_that_all_of_it_is_talk_may_still_be_heard():
    assert whole(lambda _: [""], TABLE)("put the sponge in the bowl, sang my aunt") == [""]
