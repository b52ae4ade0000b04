"""What is decided on a sentence: acted on unasked, asked, refused, or answered with no motion."""

import pytest
from clarifier_table import TABLE, SmallTranslator, talk, thing, waiting

from agent.messages import TranslateRequest
from scene.types import Scene


def ids(decision):
    return [option.objects for option in decision.question.options]


# --- acts unasked -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "touched"),
    [
        ("push the sponge to the right", ("sponge_1",)),
        ("could you please put the bottle on the left, thanks", ("bottle_1",)),
        ("place the blue mug on the plate", ("mug_2", "plate_1")),
        ("shove the apple on the left to the right", ("apple_1",)),
        ("grab the apple nearest to the bowl", ("apple_2",)),
        ("lift the second block from the left", ("red_block_1",)),
        ("put the apple next to the bowl on the plate", ("apple_2", "plate_1")),
        ("push an apple to the left", ("apple_2",)),
        ("how about moving the sponge to the right?", ("sponge_1",)),
        ("put the yellow one next to the bottle", ("yellow_block_1", "bottle_1")),
    ],
)
def test_a_clear_command_is_acted_on(clarifier, text, touched):
    (decision,) = talk(clarifier, text)
    assert (decision.do, decision.touched) == ("act", touched)
    assert decision.program and decision.kind == "manipulate" and decision.why


def test_a_thing_is_not_put_next_to_itself(clarifier):
    (decision,) = talk(clarifier, "put the mug next to the blue mug")
    assert (decision.touched, decision.echo) == (("mug_1", "mug_2"), "I took the red mug.")


def test_the_only_reachable_one_is_taken_and_said(clarifier):
    scene = Scene(objects=(thing("cup", -0.5, 0.0), thing("cup", 1.9, 0.0, number=2)))
    (decision,) = talk(clarifier, "lift the cup", scene=scene)
    assert decision.touched == ("cup_1",) and "reach" in decision.echo


def test_the_translator_is_asked_once_over_slots(clarifier, translator):
    talk(clarifier, "push the apple to the left")
    (request,) = translator.requests
    assert [m.slot for m in request.mentions] == ["m1"]


def test_a_slip_is_repaired_and_said(clarifier):
    (decision,) = talk(clarifier, "push the spnge to the left")
    assert decision.touched == ("sponge_1",) and "spnge" in decision.echo


def test_a_thing_of_the_tray_is_arranged(clarifier):
    scene = Scene(objects=(thing("orange", 0.5, 0.5),), tray=(waiting("apple"),))
    (decision,) = talk(clarifier, "the apple goes in the middle", scene=scene)
    assert (decision.do, decision.kind) == ("act", "arrange")


# --- groups and measures -------------------------------------------------------------------------

BLOCKS = ("red_block_1", "green_block_1", "yellow_block_1")


@pytest.mark.parametrize(
    ("text", "touched", "program"),
    [
        ("put both apples on the plate", ("apple_1", "apple_2", "plate_1"),
         "put_all_on([apple_1, apple_2], plate)"),
        ("touch all the blocks", BLOCKS,
         "for one in [red_block, green_block, yellow_block]:\n    touch(one)"),
        ("touch all the blocks except the red one", BLOCKS[1:],
         "for one in [green_block, yellow_block]:\n    touch(one)"),
        ("put the blocks on the plate except the red one", (*BLOCKS[1:], "plate_1"),
         "put_all_on([green_block, yellow_block], plate)"),
        ("apart from the red one, put all blocks on the plate", (*BLOCKS[1:], "plate_1"),
         "put_all_on([green_block, yellow_block], plate)"),
        ("touch both bottles of mine", None, ""),
        ("push the sponge 3 cm to the right", ("sponge_1",),
         "push(sponge, [sponge.x + 0.15, sponge.y])"),
        ("turn the sponge 90 degrees", ("sponge_1",), "turn(sponge, -1.5708)"),
        ("turn the sponge a quarter turn", ("sponge_1",), "turn(sponge, -1.5708)"),
    ],
)  # fmt: skip
def test_a_program_gets_lists_and_numbers(clarifier, text, touched, program):
    (decision,) = talk(clarifier, text)
    if touched is None:
        assert (decision.do, decision.question.kind) == ("ask", "how_many")
        return
    assert (decision.do, set(decision.touched)) == ("act", set(touched))
    assert decision.program == program


def test_any_two_take_the_nearest_and_say_so(clarifier):
    for text in ("touch two blocks", "touch any two blocks", "touch a couple of blocks"):
        (decision,) = talk(clarifier, text)
        assert (decision.do, set(decision.touched)) == ("act", {"red_block_1", "green_block_1"})
        assert "red block" in decision.echo and "green block" in decision.echo


@pytest.mark.parametrize("text", ["touch the two blocks", "touch both blocks"])
def test_two_of_three_are_asked_about(clarifier, text):
    asked, decision = talk(clarifier, text, "the red and the yellow one")
    assert (asked.question.kind, len(asked.question.options)) == ("which", 3)
    assert (decision.do, set(decision.touched)) == ("act", {"red_block_1", "yellow_block_1"})


@pytest.mark.parametrize(
    ("text", "answer", "count"),
    [
        ("touch a few blocks", "two", 2), ("touch some blocks", "3", 3),
        ("touch several blocks", "all of them", 3), ("touch some of the blocks", "two please", 2),
    ],
)  # fmt: skip
def test_a_few_are_counted(clarifier, text, answer, count):
    asked, decision = talk(clarifier, text, answer)
    assert (asked.do, asked.question.kind) == ("ask", "how_many")
    assert [option.label for option in asked.question.options] == ["two", "three"]
    assert (decision.do, len(decision.touched)) == ("act", count)


def test_the_group_stays_in_focus(clarifier):
    _, decision = talk(clarifier, "touch all the blocks", "now push them to the left")
    assert decision.touched == BLOCKS


def test_a_measure_must_be_used(clarifier_over):
    class Forgetful(SmallTranslator):
        def __call__(self, request):
            return super().__call__(TranslateRequest(request.text, request.mentions, request.kind))

    clarifier = clarifier_over(Forgetful())
    (decision,) = talk(clarifier, "push the sponge 3 cm to the left")
    assert (decision.do, decision.reason) == ("refuse", "not_understood")


# --- asks -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "kind", "options"),
    [
        ("push the apple left", "which", [("apple_1",), ("apple_2",)]),
        ("pick up the fruit", "which", [("apple_1",), ("apple_2",)]),
        ("put the cup on the plate", "which", [("mug_1",), ("mug_2",)]),
        ("push the flask left", "missing", [("bottle_1",)]),
        ("grab the purple block", "missing",
         [("red_block_1",), ("green_block_1",), ("yellow_block_1",)]),
        ("put two bottles on the plate", "how_many", [("bottle_1",)]),
        ("put three apples in the bowl", "how_many", [("apple_1", "apple_2")]),
        ("move the sponge", "where", [()] * 3),
        ("push the sponge", "direction", [()] * 4),
        ("turn the sponge", "open", []),
        ("the sponge", "open", []),
    ],
)  # fmt: skip
def test_what_is_not_clear_is_asked(clarifier, text, kind, options):
    (decision,) = talk(clarifier, text)
    assert (decision.do, decision.question.kind, ids(decision)) == ("ask", kind, options)
    assert decision.dialog.pending is not None and decision.reply


@pytest.mark.parametrize(("text", "kind"), [("lift the guitar", "missing"), ("lift it", "which"),
                                            ("lift the glorp", "unknown_word")])  # fmt: skip
def test_what_is_there_is_offered_with_programs(clarifier, text, kind):
    (decision,) = talk(clarifier, text)
    assert decision.question.kind == kind
    assert {o for (o,) in ids(decision)} == {item.id for item in TABLE}
    assert all(option.program for option in decision.question.options)


def test_places_carry_their_target(clarifier):
    (decision,) = talk(clarifier, "put the sponge")
    middle = decision.question.options[0]
    assert middle.target is not None and (middle.target.x, middle.target.y) == (0.0, 0.5)
    assert middle.program and middle.touched == ("sponge_1",)


def test_only_what_can_be_done_is_offered(clarifier):
    far = thing("cup", 0.3, 0.0, number=2)
    scene = Scene(objects=(thing("cup", -0.5, 0.0), far, thing("plate", 1.9, 0.0, size=0.3)))
    (decision,) = talk(clarifier, "put the cup on the plate", scene=scene)
    assert (decision.do, decision.reason) == ("refuse", "unreachable")


def test_without_a_trusted_translation_options_have_no_program(clarifier_over):
    unsure = clarifier_over(SmallTranslator(confidence=0.2))
    asked, then = talk(unsure, "push the apple left", "the red one")
    assert [option.program for option in asked.question.options] == [None, None]
    assert (then.do, then.reason) == ("refuse", "not_understood")


# --- refuses ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("throw the mug at me", "unsafe"),
        ("put the sponge off the table", "unsafe"),
        ("place the plate on the bottle", "unsafe"),
        ("put the bottle far beyond the table", "unsafe"),
        ("place the sponge just outside the right edge of the table", "unsafe"),
        ("set the sponge down well past the edge of the table", "unsafe"),
        ("bake a cake", "not_understood"),
        ("undo that", "not_understood"),
        ("", "not_understood"),
        ("  \t ", "not_understood"),
        ("push \x00 the sponge left", "not_understood"),
        ("push the sponge left " * 400, "not_understood"),
        ("?!", "not_understood"),
    ],
)
def test_what_cannot_be_done_is_refused_with_a_reason(clarifier, text, reason):
    (decision,) = talk(clarifier, text)
    assert (decision.do, decision.reason, decision.program) == ("refuse", reason, None)
    assert decision.reply


def test_what_a_refused_sentence_names_is_spoken_of(clarifier):
    decisions = talk(clarifier, "lift the bottle", "throw the sponge", "push it to the left")
    assert [one.do for one in decisions] == ["act", "refuse", "act"]
    assert decisions[-1].touched == ("sponge_1",)


def test_words_the_model_does_not_know_are_named(clarifier_over):
    clarifier = clarifier_over(SmallTranslator(unknown=("diagonally",)))
    (decision,) = talk(clarifier, "push the sponge diagonally")
    assert decision.reason == "not_understood" and "diagonally" in decision.reply


def test_an_empty_table_is_said(clarifier):
    (decision,) = talk(clarifier, "push the cup left", scene=Scene())
    assert (decision.do, decision.reason) == ("refuse", "missing_object")


# --- no motion ---------------------------------------------------------------------------------


def test_stop_never_touches_the_model(clarifier, translator):
    (decision,) = talk(clarifier, "STOP!")
    assert decision.do == "stop" and translator.requests == []


@pytest.mark.parametrize(
    "text",
    ["what can you see?", "where is the sponge?", "2+2", "hello", "never mind", "thanks",
     "what can you do?", "who is the king of France?", "don't touch the bowl", "qwerty zxcv",
     "my name is Ada", "what a lovely day", "I bought the bottle yesterday", "the bowl is cracked",
     "the red mug was a present", "I like the green apple"],
)  # fmt: skip
def test_talk_is_answered_and_nothing_moves(clarifier, translator, text):
    (decision,) = talk(clarifier, text)
    assert decision.do == "answer" and decision.reply and translator.requests == []


# --- places that are only pointed at, or said as a way -----------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "the bottle over there please", "my sponge right here", "the sponge should go there",
        "the red mug belongs over there", "the bottle needs to be moved",
    ],
)  # fmt: skip
def test_what_is_only_pointed_at_is_asked_for(clarifier, text):
    asked, done = talk(clarifier, text, "on the left side of the table")
    assert (asked.do, asked.question.kind) == ("ask", "where")
    assert done.do == "act"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("place the sponge to the plate", "place the sponge onto the plate"),
        ("move the bottle to the bowl, please", "move the bottle into the bowl"),
        ("take the sponge and put to the plate", "take the sponge and put onto the plate"),
    ],
)
def test_to_what_holds_or_carries_is_into_or_onto_it(clarifier, translator, text, said):
    talk(clarifier, text)
    assert translator.requests[0].text == said


@pytest.mark.parametrize(
    "text",
    [
        "push the sponge to the plate", "put the sponge close to the plate",
        "put the sponge to the left of the plate", "put the sponge to the bottle",
        "bring the sponge over to the plate", "move the sponge to the plate. Next to it",
    ],
)  # fmt: skip
def test_to_anything_else_stays_a_way(clarifier, translator, text):
    talk(clarifier, text)
    assert translator.requests[0].text == text


def test_half_of_what_is_asked_may_be_a_joke(clarifier):
    asked, done = talk(clarifier, "tell me a story and lift the sponge", "yes, only that")
    assert (asked.question.kind, done.do, done.touched) == ("confirm", "act", ("sponge_1",))


def test_an_unknown_word_between_verb_and_place_is_a_thing(clarifier):
    asked, _, done = talk(
        clarifier, "put wumple on the plate", "wumple is what we say for sponge",
        "now move the wumple to the right",
    )  # fmt: skip
    assert (asked.do, asked.question.kind) == ("ask", "unknown_word")
    assert (done.do, done.touched) == ("act", ("sponge_1",))


@pytest.mark.parametrize(
    "text", ["clean up all of it, please", "put everything in order", "clean all of this up"]
)
def test_how_everything_is_to_be_tidied_is_asked(clarifier, text):
    (decision,) = talk(clarifier, text)
    assert (decision.do, decision.question.kind) == ("ask", "open")


def test_what_is_not_there_is_missed_where_something_is_to_become_of_it(clarifier):
    (decision,) = talk(clarifier, "the blue block goes in the bowl")
    assert (decision.do, decision.question.kind) == ("ask", "missing")
