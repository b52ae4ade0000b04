"""Sentences of several phrases: whole or phrase by phrase, whatever is likelier to be right."""

import re

from agent.messages import (
    Attention,
    Candidate,
    Mention,
    Quantity,
    TranslateRequest,
    Translation,
)
from translator.phrases import PhraseTranslator, attend

TEXT = "put the cup left of the box, then push the cup 5 cm up"
PHRASES = ((0, 27), (34, 54))
MEASURE = Quantity("d1", TEXT.index("5 cm"), TEXT.index("5 cm") + 4, "5 cm", 0.25)


def mentions(text=TEXT):
    slots = {"cup": "m1", "box": "m2"}
    return tuple(
        Mention(slots[m.group(1)], m.start(), m.end(), m.group(), (m.group(1),))
        for m in re.finditer(r"the (cup|box)", text)
    )


REQUEST = TranslateRequest(TEXT, mentions(), "manipulate", 4, (MEASURE,), PHRASES)


class Fake:
    """Knows some sentences; every other one gets a program that is hardly believed."""

    def __init__(self, **known):
        self.known = known
        self.asked = []

    def __call__(self, request):
        self.asked.append(request)
        body, confidence = self.known.get(request.text.split()[0], ("pick(m1)", 0.1))
        if request.phrases:
            body, confidence = self.known.get("whole", ("pick(m1)", 0.1))
        return Translation((Candidate(body, -1.0 / confidence, 3),), confidence, 2.0)


def test_phrases_are_translated_alone_with_slots_of_their_own():
    fake = Fake(put=("put(m1, left_of(m1, m2))", 0.9), push=("push(m1, [m1.x, m1.y + d1])", 0.8))
    found = PhraseTranslator(fake)(REQUEST)
    assert [one.text for one in fake.asked[1:]] == [
        "put the cup left of the box",
        "push the cup 5 cm up",
    ]
    for one in fake.asked[1:]:
        spans = [*one.mentions, *one.measures]
        assert all(one.text[span.start : span.end] == span.text for span in spans)
        assert [m.slot for m in one.mentions] == ["m1", "m2"][: len(one.mentions)]
    assert found.candidates[0].body == (
        "w1 = put(m1, left_of(m1, m2))\npush(w1, [w1.x, w1.y + d1])"
    ), "the second phrase means the cup where it is by then"
    assert found.confidence == 0.9 * 0.8
    assert found.ms == 6.0, "all that was spent"


def test_what_is_said_first_in_a_phrase_gets_its_own_name_back():
    text = "touch the box and touch the cup"
    at = mentions(text)
    fake = Fake(touch=("touch(m1)", 0.9))
    request = TranslateRequest(text, at, "manipulate", 4, (), ((0, 13), (18, 31)))
    found = PhraseTranslator(fake)(request)
    assert found.candidates[0].body == "touch(m2)\ntouch(m1)"


def test_the_whole_stays_first_where_it_is_likelier():
    fake = Fake(whole=("touch(m1)", 0.9), put=("put(m1, m2)", 0.9), push=("push(m1, m2)", 0.9))
    found = PhraseTranslator(fake)(REQUEST)
    assert found.candidates[0].body == "touch(m1)"
    assert found.confidence == 0.9


def test_the_whole_stays_behind_as_another_candidate():
    fake = Fake(whole=("touch(m1)", 0.3), put=("pick(m1)", 0.9), push=("pick(m1)", 0.9))
    found = PhraseTranslator(fake)(REQUEST)
    assert [one.body for one in found.candidates] == ["pick(m1)\npick(m1)", "touch(m1)"]
    logprobs = [one.logprob for one in found.candidates]
    assert logprobs == sorted(logprobs, reverse=True)


def test_nothing_is_split_that_is_certain_or_of_one_phrase():
    sure = Fake(whole=("touch(m1)", 0.99))
    PhraseTranslator(sure)(REQUEST)
    assert len(sure.asked) == 1
    single = Fake()
    PhraseTranslator(single)(TranslateRequest("put the cup down", (), "manipulate"))
    assert len(single.asked) == 1


def looked(request):
    """Two tokens and the sentence's words; the program is the sentence's first word and slot."""
    words = tuple(request.text.split())
    body = f"{words[0]}(m1)" if not request.phrases else "whole(m1)"
    rows = tuple(tuple(float(n == i) for n in range(len(words))) for i in (0, 1))
    return [Attention(body, (f"{words[0]}(", "m1"), words, rows)]


def test_what_is_looked_at_for_phrases_stands_side_by_side():
    whole, phrased = attend(REQUEST, looked)
    assert whole.body == "whole(m1)"
    assert phrased.body == "put(m1)\npush(m1)"
    assert phrased.tokens == ("put(", "m1", "push(", "m1")
    assert phrased.pieces == ("put", "the", "cup", "left", "of", "the", "box", "push", "the", "cup",
                              "5", "cm", "up")  # fmt: skip
    assert [row.index(1.0) for row in phrased.weights] == [0, 1, 7, 8]
    assert all(len(row) == len(phrased.pieces) and sum(row) == 1.0 for row in phrased.weights)


def test_a_sentence_of_one_phrase_is_looked_at_as_a_whole():
    one = TranslateRequest(TEXT, mentions(), "manipulate", 4, (MEASURE,))
    assert attend(one, looked) == tuple(looked(one))
