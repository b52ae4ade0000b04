"""Frames: bytes known from the protocol, and frames found again in whatever surrounds them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot_bridge import dobot_alarms as alarms
from robot_bridge.dobot_frames import LONGEST, Frame, Reader, encode, floats, read_floats, take

FRAMES = st.builds(
    Frame, st.integers(0, 255), st.sampled_from((0, 1, 3)), st.binary(max_size=LONGEST - 2)
)


@pytest.mark.parametrize(
    ("frame", "data"),
    [
        (Frame(10), "aa aa 02 0a 00 f6"),
        (Frame(240, 1), "aa aa 02 f0 01 0f"),
        (Frame(62, 3, bytes((1, 1))), "aa aa 04 3e 03 01 01 bd"),
        (Frame(0, 0), "aa aa 02 00 00 00"),
    ],
)
def test_a_frame_has_the_bytes_of_the_protocol(frame, data):
    assert encode(frame) == bytes.fromhex(data)
    assert take(bytes.fromhex(data)) == (frame, b"")


@given(FRAMES)
def test_a_frame_adds_up_to_nothing(frame):
    data = encode(frame)
    assert sum(data[3:]) % 256 == 0 and data[2] == len(data) - 4


def test_what_does_not_fit_a_frame_is_no_frame():
    with pytest.raises(ValueError, match="do not fit"):
        encode(Frame(1, 0, bytes(LONGEST - 1)))


@given(st.lists(FRAMES, min_size=1, max_size=4), st.integers(1, 7))
def test_frames_come_out_of_a_stream_however_it_is_cut(frames, size):
    data, reader = b"".join(map(encode, frames)), Reader()
    found = [one for at in range(0, len(data), size) for one in reader.feed(data[at : at + size])]
    assert found == frames


@given(st.binary(max_size=40).filter(lambda noise: b"\xaa" not in noise), FRAMES)
def test_noise_before_a_frame_is_dropped(noise, frame):
    assert take(noise + encode(frame)) == (frame, b"")


@pytest.mark.parametrize("before", ["aa", "aaaa", "aaaa40", "aaaa020a00", "aaaaff", "aaaa02aaaa"])
def test_a_header_that_is_none_hides_no_frame(before):
    frame = Frame(246, 0, bytes(8))
    assert take(bytes.fromhex(before) + encode(frame))[0] == frame


def test_a_wrong_sum_is_no_frame_and_the_next_one_is_found():
    bad = encode(Frame(10, 0, bytes(32)))[:-1] + b"\x13"
    assert take(bad)[0] is None
    assert take(bad + encode(Frame(20)))[0] == Frame(20)


@given(st.lists(st.floats(width=32, allow_nan=False), max_size=8))
def test_numbers_are_float32(values):
    assert list(read_floats(floats(*values))) == values


@given(st.sets(st.integers(0, 127)))
def test_alarms_are_bits_of_a_mask(codes):
    mask = alarms.mask(codes)
    assert len(mask) == 16 and set(alarms.codes(mask)) == codes


@pytest.mark.parametrize(
    ("code", "meaning", "remedy"),
    [
        (0x11, "out of reach", "plan another way"), (0x12, "joint", "plan another way"),
        (0x21, "left what the arm can reach", "unlock"), (0x30, "too fast", "lower speed"),
        (0x45, "at its limit", "unlock"), (0x52, "lost steps", "home"), (0x7F, "unknown", "off"),
    ],
)  # fmt: skip
def test_every_alarm_has_a_meaning_and_a_remedy(code, meaning, remedy):
    assert meaning in alarms.describe((code,)) and f"0x{code:02x}" in alarms.describe((code,))
    assert remedy in alarms.remedy((code,))
    assert alarms.loses_position((code,)) is (code == 0x52)
