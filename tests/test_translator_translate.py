"""The translator as it is served: slots in and out, only well-formed programs, honest scores."""

import gzip
import random
import shutil
from pathlib import Path

import pytest

from agent.errors import NotAllowed, TranslatorError
from agent.messages import Mention, TranslateRequest
from agent.program import parse
from translator.corpus.load import load
from translator.embed import SentenceEncoder, session
from translator.translate import PAPER, PRODUCT, WEIGHTS, Translator, choose_nouns, write_nouns
from translator.vocabulary import NOUNS, words_of


@pytest.fixture(scope="module")
def translator() -> Translator:
    return Translator(PAPER)


def mention(slot: str, text: str, sentence: str) -> Mention:
    start = sentence.index(text)
    return Mention(slot, start, start + len(text), text, (text,))


def request(sentence: str, *names: str, kind="manipulate", k=4) -> TranslateRequest:
    mentions = [mention(f"m{i}", name, sentence) for i, name in enumerate(names, start=1)]
    return TranslateRequest(sentence, tuple(mentions), kind, k)


def test_a_program_speaks_of_slots_and_never_of_nouns(translator):
    sentence = "put the coca cola to the left of the brown bowl"
    best = translator(request(sentence, "coca cola", "brown bowl")).candidates[0].body
    assert "m1.x" in best
    assert not any(f"{noun}." in best for noun in NOUNS)


def test_what_an_object_is_called_does_not_change_its_program(translator):
    plain = translator(request("pick up the apple", "apple")).candidates[0].body
    odd = translator(request("pick up the small red star", "small red star")).candidates[0].body
    assert plain == odd


def test_candidates_come_best_first_and_are_different(translator):
    found = translator(request("put the cup next to the box", "cup", "box")).candidates
    logprobs = [candidate.logprob for candidate in found]
    assert logprobs == sorted(logprobs, reverse=True)
    assert len({candidate.body for candidate in found}) == len(found) > 1


def test_no_more_candidates_than_asked_for(translator):
    assert len(translator(request("touch the cup", "cup", k=1)).candidates) == 1


def test_the_confidence_is_a_probability(translator):
    for sentence in ("pick up the apple", "the apple apple up of"):
        assert 0.0 <= translator(request(sentence, "apple")).confidence <= 1.0


def test_words_that_training_never_showed_are_named(translator):
    told = translator(request("paint the apple gorgeously", "apple"))
    assert told.unknown == ("paint", "gorgeously")


def test_the_same_request_has_the_same_answer(translator):
    wanted = request("push the can away from the box", "can", "box")
    assert translator(wanted).candidates == translator(wanted).candidates


@pytest.mark.parametrize("kind", ["arrange", "manipulate"])
def test_whatever_is_said_no_program_is_malformed(translator, kind):
    rng = random.Random(7)
    words = sorted({word for pair in load(kind) for word in words_of(pair.say)} - set(NOUNS))
    for _ in range(60):
        nouns = rng.sample(NOUNS, rng.randint(1, 3))
        said = rng.sample(words, rng.randint(0, 9)) + nouns
        rng.shuffle(said)
        sentence = " ".join(said)
        spaced = f" {sentence} "
        mentions = tuple(
            Mention(f"m{i}", at := spaced.index(f" {noun} "), at + len(noun), noun, (noun,))
            for i, noun in enumerate(nouns, start=1)
        )
        slots = [f"m{i}" for i in range(1, len(nouns) + 1)]
        for candidate in translator(TranslateRequest(sentence, mentions, kind, 4)).candidates:
            try:
                parse(candidate.body, kind, slots)
            except NotAllowed as error:
                pytest.fail(f"{sentence!r}: {error}\n{candidate.body}")


def test_a_mention_keeps_a_noun_that_the_model_knows():
    sentence = "put the red cube on the green box"
    nouns = choose_nouns(request(sentence, "red cube", "green box").mentions)
    assert nouns["m2"] == "box"
    assert nouns["m1"] in set(NOUNS) - {"box"}


def test_articles_agree_with_the_noun_that_stands_in():
    sentence = "put an umbrella on a box"
    wanted = request(sentence, "umbrella", "box").mentions
    assert write_nouns(sentence, wanted, {"m1": "cup", "m2": "orange"}) == "put a cup on an orange"


def test_missing_weights_are_named_with_the_remedy(tmp_path):
    with pytest.raises(TranslatorError, match="vocabulary"):
        Translator(tmp_path)


def test_a_packed_graph_is_served_like_a_plain_one(tmp_path):
    for name in ("encoder.onnx.gz", "tokenizer.json"):
        shutil.copy(WEIGHTS / name, tmp_path)
    packed = SentenceEncoder(tmp_path)("put it down")
    file = tmp_path / "encoder.onnx.gz"
    (tmp_path / "encoder.onnx").write_bytes(gzip.decompress(file.read_bytes()))
    file.unlink()
    assert (SentenceEncoder(tmp_path)("put it down") == packed).all()


def test_a_graph_that_is_nowhere_is_named(tmp_path):
    with pytest.raises(TranslatorError, match=r"no weights at .*step\.onnx"):
        session(tmp_path / "step.onnx")


def test_all_committed_weights_together_stay_below_forty_megabytes():
    root = Path(__file__).parent.parent
    folders = [WEIGHTS, root / "scene/weights", root / "evals/weights"]
    files = [path for folder in folders for path in folder.rglob("*") if path.is_file()]
    assert PRODUCT.is_dir()
    assert 20e6 < sum(path.stat().st_size for path in files) <= 40e6
