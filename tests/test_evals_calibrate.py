"""Calibration of a translator, and of one that has learnt too little for it."""

import pytest

from agent.messages import Translation
from evals import calibrate
from evals.calibrate import Case, cases, fit, likelihood
from translator.translate import PAPER


def mute(request):
    return Translation((), 0.0, 1.0)


def test_sentences_without_a_program_are_not_counted(executor):
    assert cases(mute, executor) == []


def test_where_nothing_is_translated_nothing_is_written(monkeypatch, tmp_path, capsys):
    (tmp_path / "vocabulary.json").write_bytes((PAPER / "vocabulary.json").read_bytes())
    monkeypatch.setattr(calibrate, "_translator", lambda folder: mute)
    assert calibrate.main([str(tmp_path)]) == 1
    assert "no calibration" in capsys.readouterr().err
    assert not (tmp_path / "calibration.json").exists()


@pytest.mark.parametrize(("right", "above"), [(18, True), (2, False)])
def test_the_temperature_makes_confidence_what_comes_true(right, above):
    """-0.7 at a temperature of 1 is a confidence of 50 %: modest for 18 of 20, too sure for 2."""
    seen = [Case(-0.7, number < right) for number in range(20)]
    found = fit(seen).temperature
    assert (found > 1.0) is above
    assert likelihood(seen, found) > likelihood(seen, 1.0)
