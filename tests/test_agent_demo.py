"""The scripted conversation: it is played for real and shows every kind of turn."""

import io

from agent.demo import SCRIPT, play_demo


def test_the_conversation_shows_every_kind_of_turn():
    out = io.StringIO()
    assert play_demo("ideal", 0, out) == 0
    told = out.getvalue()
    assert len(SCRIPT) >= 8
    assert all(f"> {say}\n" in told for say in SCRIPT)
    for seen in (
        "put(sponge, corner(sponge", "The sponge is in the far left corner",
        "put(apple, left_of(apple, orange))",
        "The apple is left of the orange", "The lemon went off", "Which fruit do you mean",
        "I hold the banana", "The banana is on the plate", "I can't see a flask", "I won't",
        "to the left of the plate", "Stopped",
    ):  # fmt: skip
        assert seen in told, seen
