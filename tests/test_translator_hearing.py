"""What is talk in a sentence: the corpus that says so, and the tagger that learnt from it."""

import random
from itertools import islice, pairwise

import pytest

from agent.errors import ConfigError
from translator.corpus.seed import kept, load_seeds
from translator.corpus.talk import Asides, Talker, halved, load_asides
from translator.hearing import Hearing, Word
from translator.translate import WEIGHTS

NOUNS = ("mug", "glue stick", "toy car", "hinge")


def talker(chance=0, asides=None, held_out=False):
    asides = asides or halved(load_asides(), held_out)
    return Talker(kept(load_seeds(), held_out), asides, NOUNS, random.Random(chance))


def test_the_same_chance_says_the_same_and_another_one_something_else():
    one, same, other = (list(islice(talker(chance), 50)) for chance in (1, 1, 2))
    assert one == same != other


def test_parts_take_turns_and_something_is_wanted_but_for_one_sentence_in_eight():
    sentences = list(islice(talker(3), 900))
    for parts in sentences:
        assert all(one.talk != other.talk for one, other in pairwise(parts))
    chat = sum(
        all(part.talk or not part.text.strip(" .!") for part in parts) for parts in sentences
    )
    assert 80 < chat < 150


def test_without_asides_only_corrections_are_talk():
    plain = Asides(*[("hm",)] * len(Asides.__struct_fields__))
    for parts in islice(talker(4, plain), 300):
        said = "".join(part.text for part in parts if not part.talk)
        assert "hm" not in said.split()


def test_what_is_held_out_is_never_learnt_from():
    asides = load_asides()
    for key in Asides.__struct_fields__:
        learnt, unseen = (set(getattr(halved(asides, held), key)) for held in (False, True))
        assert learnt and unseen and not learnt & unseen, key
        assert learnt | unseen == set(getattr(asides, key))


def test_a_file_with_a_key_of_its_own_is_named(tmp_path):
    (tmp_path / "odd.toml").write_text('songs = ["la"]', encoding="utf-8")
    with pytest.raises(ConfigError, match=r"odd\.toml.*songs"):
        load_asides(tmp_path)


@pytest.fixture(scope="module")
def hearing():
    return Hearing(WEIGHTS)


def test_on_wordings_and_asides_never_seen_most_words_are_told_rightly(hearing):
    right = words = passed = rightly = 0
    for parts in islice(talker(5, held_out=True), 200):
        text = "".join(part.text for part in parts)
        talk = [part.talk for part in parts for _ in part.text]
        for word in hearing.words(text):
            said, meant = word.talk > 0.5, talk[word.start]
            right += said == meant
            words += 1
            passed += said
            rightly += said and meant
    assert right / words > 0.88
    assert rightly / passed > 0.85


@pytest.mark.parametrize(
    ("said", "left"),
    [
        ("My uncle sailed with this very thing, bless him, so put the red cup behind the tin.",
         "put the red cup behind the tin."),
        ("put the mug, no wait, put the jug on the plate", "put the jug on the plate"),
        ("push the box to the left because my knees hurt", "push the box to the left"),
        ("The boss will be here in five minutes. Put the hinge in the bowl",
         "Put the hinge in the bowl"),
    ],
)  # fmt: skip
def test_stories_reasons_and_corrections_are_passed_over(hearing, said, left):
    assert left.strip(" .").lower() in [one.strip(" .").lower() for one in hearing(said)]


@pytest.mark.parametrize("said", [
    "put the red cup to the left of the bowl",
    "move everything except the blue mug to the right edge",
    "not the red one, the green one goes on the plate",
    "if the jug is taller than the vase, put it behind the vase",
    "push the tin 5 cm towards me without touching the fork",
    "put two of the coins in the box and leave the others",
])  # fmt: skip
def test_what_is_wanted_is_kept_word_for_word(hearing, said):
    assert hearing(said) == []


def test_every_word_has_its_place_and_a_probability(hearing):
    text = "well, put  the mug on the plate"
    words = hearing.words(text)
    assert [text[word.start : word.end] for word in words] == text.split()
    assert all(isinstance(word, Word) and 0 <= word.talk <= 1 for word in words)


@pytest.mark.parametrize("said", [
    "I put the mug in the box yesterday and now my sister has lost it",
    "My grandmother always moved the candle before the guests came",
])  # fmt: skip
def test_what_is_talk_throughout_leaves_nothing(hearing, said):
    assert hearing(said) == [""]


def test_where_something_is_wanted_something_is_left(hearing):
    heard = hearing("bless her cotton socks, my back is killing me, so put the mug on the plate")
    assert heard and all("the mug on the plate" in said for said in heard)
