"""Clauses that only say what must stay: cut from the deed, kept by the forecast."""

import pytest
from clarifier_table import LEXICON, TABLE, talk, writes

from clarifier.deed import link_deed, only_forbids

EVERY = {item.id for item in TABLE}
DEED = "put the sponge on the plate"


def deed(text):
    return link_deed(text, TABLE, (), LEXICON)


def core(text):
    return " ".join(deed(text).text.split()).strip(" ,.")


@pytest.mark.parametrize(
    "said",
    [
        "the bowl must not be moved", "the bowl is not to be disturbed", "the bowl don't move",
        "the bowl isn't to be touched", "the bowl has to stay where it is", "the bowl stays put",
        "the bowl itself remains in its place", "the bowl no", "the bowl no, it must stay",
        "nobody touches the bowl", "nobody asked you to touch the bowl",
        "I never told you to move the bowl", "I don't want the bowl moved", "hands off the bowl",
        "keep your paws off the bowl", "you need not move the bowl", "you mustn't shift the bowl",
        "there is no need to touch the bowl", "leave the bowl out of this",
        "it is forbidden to move the bowl", "stay away from the bowl", "the bowl is off limits",
        "the bowl is fine where it is", "don't do anything with the bowl",
        "keep the bowl where it is", "let the bowl stay put",
        "under no circumstances is the bowl to be shifted", "the bowl: do not touch",
        "the bowl is hot so leave it well alone", "mustn't touch the bowl",
        "I'd rather you didn't touch the bowl", "the bowl leave where it is",
    ],
)  # fmt: skip
def test_a_thing_that_must_stay_is_no_part_of_the_deed(said):
    for text in (f"{DEED}, {said}", f"{DEED}. {said}.", f"{said}. {DEED}", f"{DEED}, but {said}"):
        assert core(text) == DEED
        assert deed(text).spared == ("bowl_1",)
        assert "bowl" in deed(text).caution


@pytest.mark.parametrize(
    ("said", "left"),
    [
        ("nothing else may move", {"sponge_1"}), ("nothing else is to be touched", {"sponge_1"}),
        ("everything else stays where it is", {"sponge_1"}),
        ("no other object may be moved", {"sponge_1"}),
        ("without moving anything else", {"sponge_1"}),
        ("only the sponge should be moved", {"sponge_1"}), ("move only the sponge", {"sponge_1"}),
        ("nothing but the sponge may be moved", {"sponge_1"}),
        ("the only thing you may move is the sponge", {"sponge_1"}),
        ("nothing must be knocked", {"sponge_1"}),
 
        ("nothing must move", set()), ("let nothing be moved", set()),
        ("everything stays where it is", set()),
        ("only the bottle may be moved", {"bottle_1"}),
    ],
)  # fmt: skip
def test_what_may_move_beside_a_deed(said, left):
    text = f"{DEED}, {said}"
    assert core(text) == DEED
    assert EVERY - set(deed(text).spared) == left


@pytest.mark.parametrize(
    "text",
    [
        "the bowl must not be on the plate",
        "don't put the sponge on the plate",
        "if the bowl must not be moved, put the sponge on the plate",
        "the sponge should be moved to the plate",
        "only put the sponge on the plate",
        "nothing goes on the plate but the sponge",
        "put the bowl where the plate is",
        "the other bowl",
        "take the sponge off the plate",
        "nobody is here",
    ],
)
def test_what_is_no_ban(text):
    assert deed(text).text == text
    assert deed(text).caution == ""


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("you need not move the bowl, just put the sponge next to it",
         "put the sponge next to the bowl"),
        ("nothing is to be touched except the sponge, which goes on the plate",
         "the sponge goes on the plate"),
        ("the red block stays but the other two go on the plate",
         "the green block and the yellow block go on the plate"),
        ("the red block stays put, the remaining ones go on the plate",
         "the green block and the yellow block go on the plate"),
    ],
)  # fmt: skip
def test_what_only_the_ban_names_is_named_again(text, named):
    assert core(text) == named


def test_what_goes_for_one_more_thing():
    for text in (f"{DEED}. The bowl stays where it is. The bottle too.",
                 f"neither the bowl nor the bottle may be touched. {DEED}",
                 f"the bowl is fine there, the bottle as well, {DEED}"):  # fmt: skip
        assert core(text).lower() == DEED
        assert set(deed(text).spared) == {"bowl_1", "bottle_1"}


@pytest.mark.parametrize(
    ("text", "only"),
    [("the bowl must not be moved", True), ("nothing must move.", True),
     (f"the bowl stays. {DEED}", False), ("", False), ("never", False)],
)  # fmt: skip
def test_whether_a_sentence_only_forbids(text, only):
    assert only_forbids(text, TABLE, (), LEXICON) is only


@pytest.fixture
def clarify(clarifier_over):
    """What is decided on a sentence for which the translator writes this program."""
    return lambda text, body: talk(clarifier_over(writes((body, 0.0))), text)[0]


@pytest.mark.parametrize(
    "said",
    ["nothing must move", "the sponge must stay where it is", "only the bottle may be moved",
     "nobody touches the sponge", "but don't move the sponge"],
)  # fmt: skip
def test_a_deed_that_breaks_the_ban_is_not_done(said, clarify):
    decision = clarify(f"{DEED}, {said}", "put_on(m1, m2)")
    assert (decision.do, decision.reason) == ("refuse", "unsafe")
    assert "sponge" in decision.reply


@pytest.mark.parametrize(
    "said", ["nothing else may move", "the bowl must not be moved", "only the sponge may be moved"]
)
def test_a_deed_that_keeps_the_ban_is_done(said, clarify):
    assert clarify(f"{DEED}, {said}", "put_on(m1, m2)").do == "act"


def test_what_is_to_be_touched_may_be_touched_though_it_must_not_move(clarify):
    assert clarify("touch the bowl. nothing must move", "touch(m1)").do == "act"
    assert clarify("touch the bowl but don't push it", "touch(m1)").do == "act"
    assert clarify("touch the bowl, the bowl must not be touched", "touch(m1)").do == "refuse"
    moved = clarify("touch the bowl. nothing must move", "push(m1, [m1.x + 0.2, m1.y])")
    assert moved.do == "refuse"


def test_a_sentence_that_only_forbids_moves_nothing(clarifier, translator):
    for text in ("the bowl must not be moved", "nothing must be moved", "nobody moves the mug"):
        (decision,) = talk(clarifier, text)
        assert decision.do == "answer"
    assert translator.requests == []


def test_an_exception_that_is_not_seen_is_not_chosen_by_the_program(clarify):
    body = "put_all_on(without(m1, first(m1, 1)), m2)"
    decision = clarify("all the blocks on the plate bar the dodgy one", body)
    assert decision.do in ("refuse", "ask")
