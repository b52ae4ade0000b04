"""What is sent: messages as JSON, keys and which of them meet, what goes first."""

import pytest

from agent.errors import ConfigError
from agent.messages import StopRequest, Submit
from agent.wire import ANY, STREAM, BadPayload, Keys, decode, delivery, encode, matches


def test_a_message_survives_the_wire():
    submit = Submit("r1", "push the apple", "manipulate", True)
    assert decode(encode(submit)) == submit
    assert b'"type":"instruction.submit/1"' in encode(submit)


def test_a_field_added_later_does_no_harm():
    assert decode(b'{"type":"robot.stop/1","by":"ann","added":1}') == StopRequest("ann")


def test_a_wrong_field_is_named():
    with pytest.raises(BadPayload, match=r"\$\.by"):
        decode(b'{"type":"robot.stop/1","by":7}')


@pytest.mark.parametrize("name", ["", "a/b", "a*", "**", "a b", "@cmd", "a$", "a?x", "a#"])
def test_an_id_cannot_smuggle_anything_into_a_key(name):
    with pytest.raises(ConfigError):
        Keys().submit(name)


@pytest.mark.parametrize(
    ("expression", "key", "expected"),
    [
        ("a/*/c", "a/b/c", True),
        ("a/*", "a/b/c", False),
        ("a/**", "a", True),
        ("a/**", "a/b/c", True),
        ("**/c", "a/b/c", True),
        ("a/**/c", "a/c", True),
        ("a/b", "a/*", True),
        ("a/b", "a/c", False),
    ],
)
def test_key_expressions_meet(expression, key, expected):
    assert matches(expression, key) is expected


def test_stop_outranks_everything():
    keys = Keys("lab/left")
    assert delivery(keys.stop("r1")).priority == "real_time"
    assert delivery(keys.stop(ANY)).block
    assert delivery("foreign/key") == STREAM
