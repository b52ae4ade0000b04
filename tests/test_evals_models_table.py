"""Translators beside each other: how a model is named, how a row reads."""

from evals.models_table import Outcomes, Row, environment, table
from evals.tally import share


def test_a_model_is_named_with_its_base_and_adapter():
    assert environment("pretrained:gemma3-270m:none") == {
        "ARMCHAT_TRANSLATOR__MODEL": "pretrained",
        "ARMCHAT_TRANSLATOR__BASE": "gemma3-270m",
        "ARMCHAT_TRANSLATOR__ADAPTER": "none",
    }
    assert environment("runs/x") == {"ARMCHAT_TRANSLATOR__MODEL": "runs/x"}


def test_the_table_says_of_how_many_each_share_is():
    outcomes = Outcomes(right=share(3, 12), rightly_asked=share(2, 12), wrong=share(0, 12))
    row = Row(
        name="few", paper={"arrange": (60.0, 24.5, 5), "manipulate": (25.0, 21.7, 4)},
        malformed=(1, 8), p50=12.0, p95=31.0, processor=9.0, memory=150.0, sets={"wild": outcomes},
    )  # fmt: skip
    head, _, line = table([row]).split("\n")
    assert "paper arrange (n 5) | paper manipulate (n 4)" in head
    assert "(n 12)" in head
    assert (
        "| 60 ± 24 | 25 ± 22 | 25.0 ± 12.5 / 16.7 ± 10.8 / 0.0 ± 0.0 | 1 of 8 | 12 / 31 | 9 | 150 |"
        in line
    )
