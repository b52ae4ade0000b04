"""Things named one by one are stacked in an order that somebody says."""

import re

import pytest
from clarifier_table import SmallTranslator, talk, thing

from agent.messages import Candidate, Translation
from scene.types import Scene

CUBES = Scene(
    objects=(
        thing("cube", -0.6, 0.0, "pink"), thing("cube", 0.0, 0.5, "white", number=2),
        thing("cube", 0.6, 0.0, "black", number=3), thing("box", 0.0, -0.6, size=0.3, tall=0.05),
    )
)  # fmt: skip


class Stacking(SmallTranslator):
    """Stacks what is named, the first one lowest."""

    def _body(self, request):
        slots = dict.fromkeys(m.slot for m in request.mentions)
        lists = [m.slot if m.plural else f"[{m.slot}]" for m in request.mentions if m.slot in slots]
        if re.search(r"\b(?:stack|pile|each other)", request.text):
            return f"stack({' + '.join(dict.fromkeys(lists))})"
        return super()._body(request)

    def __call__(self, request):
        self.requests.append(request)
        return Translation((Candidate(self._body(request), -0.05, 40),), 0.95, 1.0, ())


@pytest.fixture
def said(clarifier_over):
    """What is decided on each of these turns."""
    return lambda *turns: talk(clarifier_over(Stacking()), *turns, scene=CUBES)


@pytest.mark.parametrize(
    ("text", "things"),
    [
        ("pile up the white cube and the pink cube", ["cube_2", "cube_1"]),
        ("put the black cube and the pink one on top of one another", ["cube_3", "cube_1"]),
        ("could you stack the pink, white and black cubes?", ["cube_1", "cube_2", "cube_3"]),
        ("the white cube and the black one, pile them up please", ["cube_2", "cube_3"]),
        ("build a stack of the black cube and the pink cube", ["cube_3", "cube_1"]),
    ],
)
def test_which_is_lowest_is_asked(text, things, said):
    (asked,) = said(text)
    assert (asked.do, asked.question.kind) == ("ask", "which")
    assert [option.objects[0] for option in asked.question.options] == things


@pytest.mark.parametrize(
    "text",
    [
        "stack the cubes",
        "stack all three cubes on top of each other",
        "stack the pink cube and the white cube with the white one at the bottom",
        "stack the pink cube and the box",
        "stack the pink cube on the white one",
    ],
)
def test_where_any_order_will_do_or_one_is_said_nothing_is_asked(text, said):
    (decision,) = said(text)
    assert decision.do != "ask" or "bottom" not in decision.question.text


@pytest.mark.parametrize(
    ("answer", "lowest"),
    [("the white one", "cube_2"), ("white at the bottom", "cube_2"), ("the first", "cube_1"),
     ("the white one on top", "cube_1"), ("pink goes on top", "cube_2")],
)  # fmt: skip
def test_the_answer_says_which_is_lowest_or_which_is_on_top(answer, lowest, said):
    asked, done = said("stack the pink cube and the white one", answer)
    assert asked.do == "ask" and done.do == "act"
    chosen = next(o for o in asked.question.options if o.objects == (lowest,))
    assert done.program == chosen.program
