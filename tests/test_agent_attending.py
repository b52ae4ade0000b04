"""Which request a program came from, and what was looked at for it."""

import pytest

from agent.attending import Attending, fitted
from agent.messages import Attention, TranslateRequest, Translation

SILENT = Translation((), 0.0, 0.0)


def asked(text: str) -> TranslateRequest:
    return TranslateRequest(text, (), "manipulate")


def attending(bodies: dict[str, tuple[str, ...]]) -> Attending:
    """A translator whose candidates for each sentence are these."""

    def attend(request: TranslateRequest) -> list[Attention]:
        return [
            Attention(body, ("put(", "m1", ")"), (request.text,), ((1.0,),) * 3)
            for body in bodies[request.text]
        ]

    watched = Attending(lambda request: SILENT, attend)
    for text in bodies:
        assert watched(asked(text)) is SILENT
    return watched


@pytest.mark.parametrize(
    ("body", "program", "names"),
    [
        ("pick(m1)", "pick(red_cup)", {"m1": "red_cup"}),
        ("put(m1, left_of(m1, m2))", "put(cup, left_of(cup, box))", {"m1": "cup", "m2": "box"}),
        ("put(m1, left_of(m1, m2))", "put(cup, left_of(can, box))", None),
        ("row(g1)", "row([cup, can])", {"g1": "[cup, can]"}),
        ("turn(m1, t1)", "turn(cup, (-1.5))", {"m1": "cup", "t1": "(-1.5)"}),
        ("pick(m1)", "touch(cup)", None),
        ("pick(m1)", "pick(cup)\npick(can)", None),
        ("home()", "home()", {}),
    ],
)
def test_a_program_is_a_candidate_with_names_in_the_place_of_its_slots(body, program, names):
    assert fitted(body, program) == names


def test_the_tokens_speak_of_what_the_program_does():
    found = attending({"take it": ("touch(m1)", "put(m1)")}).of("put(cup)")
    assert found is not None
    assert (found.body, found.tokens) == ("put(cup)", ("put(", "cup", ")"))


def test_the_newest_request_that_fits_is_it():
    watched = attending({"first": ("pick(m1)",), "second": ("pick(m1)",), "third": ("stay()",)})
    found = watched.of("pick(cup)")
    assert found is not None
    assert found.pieces == ("second",)


def test_a_program_from_elsewhere_has_no_attention_here():
    assert attending({"take it": ("pick(m1)",)}).of("robot.grip(True)") is None
    assert attending({}).of("pick(cup)") is None
