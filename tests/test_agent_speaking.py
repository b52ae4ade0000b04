"""Which translator speaks: as configured, until another one is chosen."""

import pytest

from agent.config import TranslatorConfig
from agent.errors import TranslatorError
from agent.messages import Mention, TranslateRequest
from agent.speaking import Speakers
from translator import models

REQUEST = TranslateRequest(
    "put the cup on the box",
    (Mention("m1", 8, 11, "cup", ("c",)), Mention("m2", 19, 22, "box", ("b",))), "manipulate",
)  # fmt: skip


def test_the_model_that_comes_with_armchat_speaks_unless_another_is_configured():
    assert Speakers(TranslatorConfig())(REQUEST).candidates[0].body == "put_on(m1, m2)"


def test_loading_is_told_once_and_a_folder_is_a_model(tmp_path):
    from translator.translate import PRODUCT

    told = []
    speakers = Speakers(TranslatorConfig(model=str(PRODUCT)))
    speakers.whole(told.append)
    speakers.whole(told.append)
    assert [line.split(" ")[0] for line in told] == ["loading", str(PRODUCT)]


def test_only_a_model_that_was_chosen_is_loaded_before_the_first_sentence():
    from translator.translate import PRODUCT

    told = []
    Speakers(TranslatorConfig()).prepare(told.append)
    assert told == []
    Speakers(TranslatorConfig(model=str(PRODUCT))).prepare(told.append)
    assert len(told) == 2


def test_a_model_that_cannot_be_loaded_leaves_the_old_one_speaking(monkeypatch, tmp_path):
    monkeypatch.setattr(models, "user_data_path", lambda name: tmp_path)
    monkeypatch.setattr(models, "find_spec", lambda name: object())
    speakers = Speakers(TranslatorConfig())
    with pytest.raises(TranslatorError, match="armchat models pull gemma3-270m"):
        speakers.choose("cascade")
    assert speakers.model == "seq2seq"
    assert speakers(REQUEST).candidates
    with pytest.raises(TranslatorError, match=r"no weights|vocabulary"):
        speakers.choose(str(tmp_path))


def test_a_name_of_no_model_says_which_there_are():
    with pytest.raises(TranslatorError, match=r"'pretraned': seq2seq, pretrained, cascade, or"):
        Speakers(TranslatorConfig(model="pretraned")).whole()


def test_an_adapter_is_not_put_on_another_model_than_it_was_learnt_for(tmp_path):
    pytest.importorskip("torch", reason="needs the pretrained extra")
    pytest.importorskip("transformers", reason="needs the pretrained extra")
    from tiny_model import tiny_model

    base = tiny_model(tmp_path / "base")
    with pytest.raises(TranslatorError, match=r"learnt for another model.*\"none\""):
        Speakers(TranslatorConfig(model="pretrained", base=str(base))).whole()


def test_a_pretrained_model_and_a_cascade_speak_over_the_same_slots(tmp_path):
    pytest.importorskip("torch", reason="needs the pretrained extra")
    pytest.importorskip("transformers", reason="needs the pretrained extra")
    from tiny_model import tiny_model

    from translator import prompt, subwords

    base = tiny_model(tmp_path / "base")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(prompt, "POOL", 200)
        patch.setattr(subwords, "LONGEST", 12)
        told = []
        speakers = Speakers(TranslatorConfig(base=str(base), adapter="none"))
        speakers.choose("cascade", told.append)
        assert any(str(base) in line for line in told)
        assert speakers(REQUEST).candidates[0].body == "put_on(m1, m2)"
        speakers.choose("pretrained")
        translation = speakers(REQUEST)
        assert translation.ms > 0
        assert speakers.attend(REQUEST) == ()
