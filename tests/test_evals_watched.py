"""Progress of what takes minutes."""

import io

from evals.watched import watched


def test_all_items_pass_and_what_is_quick_says_nothing():
    out = io.StringIO()
    assert list(watched(iter("abc"), "letters", 3, out, every=60)) == ["a", "b", "c"]
    assert out.getvalue() == ""


def test_what_takes_longer_says_how_far_it_is_and_when_it_is_done():
    out = io.StringIO()
    list(watched("abc", "letters", 3, out, every=0))
    lines = out.getvalue().splitlines()
    assert [line.split(",")[0] for line in lines[:-1]] == [
        "armchat: letters: 1 of 3", "armchat: letters: 2 of 3"
    ]  # fmt: skip
    assert lines[-1].startswith("armchat: letters: 3 in ")
