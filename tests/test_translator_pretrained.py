"""A pretrained model in the translator's place: what it writes is well formed."""

import random
from itertools import islice

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="needs the pretrained extra")
pytest.importorskip("transformers", reason="needs the pretrained extra")

from tiny_model import tiny_model  # noqa: E402

from agent.errors import NotAllowed  # noqa: E402
from agent.messages import Mention, TranslateRequest  # noqa: E402
from agent.program import instantiate, parse  # noqa: E402
from translator import prompt as prompts  # noqa: E402
from translator.causal import Causal  # noqa: E402
from translator.corpus.generate import Generator  # noqa: E402
from translator.corpus.seed import kept, load_seeds  # noqa: E402
from translator.finetune import OURS  # noqa: E402
from translator.marked import read  # noqa: E402
from translator.speech import Speech, Words  # noqa: E402
from translator.spelling import InPieces, InWords, Place  # noqa: E402
from translator.subwords import LONGEST, Writer  # noqa: E402
from translator.vocabulary import END, Vocabulary, detokenize, tokenize  # noqa: E402


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    return tiny_model(tmp_path_factory.mktemp("base"))


@pytest.fixture(scope="module")
def vocabulary():
    return Vocabulary.load(OURS)


def grown(count):
    return list(islice(Generator(kept(load_seeds(), held_out=True), random.Random(3)), count))


def test_a_program_in_subwords_is_the_program_as_text(base, vocabulary):
    written = InWords(vocabulary, Words(base))
    tokenizer = Words(base)._tokenizer
    for sample in grown(60):
        tokens = tokenize(sample.program)
        text = tokenizer.decode(written.program([*tokens, END]), skip_special_tokens=False)
        assert text == detokenize(tokens) + "\n\n"


def test_what_a_program_is_spelt_with_leads_the_search_to_that_program(base, vocabulary):
    """A model that is sure of the true numbers makes the search write the true program."""
    words = Words(base)
    written = InWords(vocabulary, words)
    column = {row: number for number, row in enumerate(written.rows)}
    for sample in grown(30):
        tokens = [*tokenize(sample.program), END]
        numbers = [column[number] for number in written.program(tokens)]
        if len(numbers) > LONGEST:
            continue  # longer than it may write
        things = {token for token in tokens if token[0] in "mgdtn" and token[1:].isdigit()}
        found = Writer(vocabulary, written).search(
            Sure(numbers, len(written.rows)), [], sample.kind, things, 2
        )
        assert vocabulary.decode(found[0].pieces) == tokens
        assert found[0].length == len(numbers)
        assert found[0].logprob == pytest.approx(0.0, abs=1e-3)


class Sure:
    """Writes these numbers and thinks little of all others."""

    def __init__(self, numbers, count):
        self.numbers, self.count, self.at = numbers, count, 0

    def begin(self, prompt):
        return self._told(1)

    def step(self, rows, numbers):
        self.at += 1
        return self._told(len(rows))

    def _told(self, rows):
        told = torch.full((rows, self.count), -20.0)
        told[:, self.numbers[min(self.at, len(self.numbers) - 1)]] = 0.0
        return told.log_softmax(-1).numpy()


class Wild:
    """Writes at random; lines and brackets end often enough for programs to come to an end."""

    def __init__(self, count, ends, seed):
        self.count, self.ends = count, ends
        self.chance = np.random.default_rng(seed)

    def begin(self, prompt):
        return self._told(1)

    def step(self, rows, numbers):
        return self._told(len(rows))

    def _told(self, rows):
        told = self.chance.normal(-5.0, 1.5, (rows, self.count))
        told[:, self.ends] += 3.0
        return told


@pytest.mark.parametrize("spelt", ["pieces", "words"])
def test_nothing_malformed_is_written_by_a_model_that_knows_nothing(base, vocabulary, spelt):
    if spelt == "words":
        spelling = InWords(vocabulary, Words(base))
        count, ends = len(spelling.rows), [spelling.numbers(text)[0] for text in ("\n", ")", "]")]
    else:
        spelling, count = InPieces(vocabulary), len(vocabulary.pieces)
        ends = [vocabulary.symbol(token) for token in ("<newline>", ")", "]", END)]
    writer = Writer(vocabulary, spelling)
    things = {"m1", "m2", "g3", "d1", "t1", "n1"}
    names = {"m1": "cup", "m2": "box", "g3": "[pen, jar]", "d1": "0.1", "t1": "1.2", "n1": "2"}
    lines = []
    for number in range(30):
        kind = ("manipulate", "arrange")[number % 2]
        for found in writer.search(Wild(count, ends, number), [], kind, things, 3):
            body = detokenize(vocabulary.decode(found.pieces[:-1]))
            lines += body.split("\n")
            try:
                parse(instantiate(body, names), kind, ["cup", "box", "pen", "jar"])
            except NotAllowed as error:
                pytest.fail(f"{body!r}: {error}")
    assert len(set(lines)) >= 8


def test_a_step_tells_what_reading_it_all_at_once_tells(base, vocabulary):
    """The memory of a hypothesis is its own, whichever row it was kept from."""
    written = InWords(vocabulary, Words(base))
    causal = Causal(base, rows=written.rows, quantised=False)
    reading = causal.reading()
    reading.begin([2, 30, 40, 50])
    reading.step([0, 0, 0], [5, 6, 7])
    told = reading.step([2, 0], [9, 8])
    whole = [causal.reading().begin([2, 30, 40, 50, written.rows[a], written.rows[b]])
             for a, b in ((7, 9), (5, 8))]  # fmt: skip
    assert np.allclose(told, np.concatenate(whole), atol=1e-4)


def test_the_likest_pairs_are_shown_last_and_the_sentence_after_them(base, vocabulary):
    shown = prompts.Prompts(Words(base), vocabulary, pool=400)
    sample = grown(1)[0]
    text = Words(base)._tokenizer.decode(shown.examples(sample.sentence, sample.kind).numbers)
    assert text.count("# ") == prompts.SHOWN + 1
    assert text.endswith(f"# {prompts.named(sample.sentence)}\n")
    pairs = shown._pairs[sample.kind]
    known = pairs._pairs[0]
    assert pairs.like(known.say, 3)[-1].program == known.program


def test_pieces_are_single_numbers_and_slots_are_read_as_pieces(base, vocabulary):
    speech = Speech(Words(base), vocabulary)
    cup = Mention("m1", 9, 12, "cup", ("cup",))
    request = TranslateRequest("push the cup", (cup,), "manipulate")
    numbers = speech.sentence(read(request)[0], request.kind)
    m1, task = vocabulary.symbol("m1"), vocabulary.symbol("<manipulate>")
    assert numbers[0] == 2
    assert numbers[-2:] == [~m1, ~task]
    assert all(n >= 0 for n in numbers[:-2])
    assert speech.program("pick(m1)")[-1] == ~vocabulary.symbol(END)
    spelling = InPieces(vocabulary)
    assert spelling.begins(Place())[m1][0].numbers == (m1,)
