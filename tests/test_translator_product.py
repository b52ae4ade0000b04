"""The model that is served: sentences over slots in, programs over the same slots out."""

import re

import msgspec
import pytest

from agent.messages import Mention, Quantity, TranslateRequest
from agent.program import instantiate, parse
from evals.grown import held_out
from translator.translate import Translator


@pytest.fixture(scope="module")
def translate():
    return Translator()


def asked(text, things=(), groups=(), measures=(), kind="manipulate"):
    """A request whose mentions and measures are these words of the sentence, in their order."""
    found = sorted((text.index(word), word) for word in (*things, *groups))
    mentions = tuple(
        Mention(f"m{number}", at, at + len(word), word, (), word in groups)
        for number, (at, word) in enumerate(found, 1)
    )
    quantities = tuple(
        Quantity(slot, text.index(word), text.index(word) + len(word), word, 0.5)
        for slot, word in measures
    )
    return TranslateRequest(text, mentions, kind, 4, quantities)


@pytest.mark.parametrize(
    ("request_", "program"),
    [
        (asked("put the apple to the left of the plate", ["apple", "plate"]),
         "put(m1, left_of(m1, m2))"),
        (asked("pick up the red star", ["red star"]), "pick(m1)"),
        (asked("put the wug in the top right corner", ["wug"], kind="arrange"),
         'put(m1, corner(m1, "right", "far"))'),
        (asked("push the mug 10 cm to the right", ["mug"], measures=[("d1", "10 cm")]),
         "push(m1, [m1.x + d1, m1.y])"),
        (asked("put all the blocks on the plate", ["plate"], ["blocks"]), "put_all_on(m1, m2)"),
        (asked("touch each of the mugs", (), ["mugs"]), "for one in m1:\n    touch(one)"),
    ],
)  # fmt: skip
def test_plain_requests_get_the_plain_program(translate, request_, program):
    found = translate(request_)
    assert found.candidates[0].body == program and found.confidence > 0.5
    assert found.unknown == ()


def test_what_things_are_called_does_not_matter(translate):
    text = "put the {} between the {} and the {}"
    names = (("apple", "cup", "box"), ("flurble", "coca cola", "z9"), ("Ω", "thing one", "it"))
    found = [translate(asked(text.format(*three), three)) for three in names]
    assert len({one.candidates for one in found}) == 1


def test_candidates_come_best_first_and_speak_of_the_request_alone(translate):
    for request, _ in held_out(60, seed=31):
        candidates = translate(request).candidates
        assert [one.logprob for one in candidates] == sorted(
            (one.logprob for one in candidates), reverse=True
        )
        slots = {one.slot for one in (*request.mentions, *request.measures)}
        for one in candidates:
            assert set(re.findall(r"\b[mgdtn]\d\b", one.body)) <= slots


def test_no_candidate_is_malformed(translate):
    for request, _ in held_out(60, seed=32):
        names = {one.slot: f"[a{one.slot}]" if one.plural else f"a{one.slot}"
                 for one in request.mentions}  # fmt: skip
        numbers = {one.slot: "0.5" for one in request.measures}
        for one in translate(request).candidates:
            body = instantiate(one.body, {**names, **numbers})
            parse(body, request.kind, [name.strip("[]") for name in names.values()])


def test_more_things_than_slots_are_translated_without_a_crash(translate):
    words = [f"thing{number}" for number in range(12)]
    request = asked("line up " + ", ".join(words), words)
    assert all("thing" not in one.body for one in translate(request).candidates)


def test_a_beam_of_one_is_the_best_of_four_or_near_it(translate):
    request = asked("put the apple on the plate", ["apple", "plate"])
    one = translate(msgspec.structs.replace(request, k=1))
    assert len(one.candidates) == 1
    assert one.candidates[0].body == translate(request).candidates[0].body
