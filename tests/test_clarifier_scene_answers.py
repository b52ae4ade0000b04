"""Questions about the scene, answered from it."""

import pytest
from clarifier_table import LEXICON, TABLE, thing, waiting

from clarifier.scene_answers import SceneQuestions
from scene.types import Scene

WITH_LEMON = Scene(
    objects=(*TABLE.objects, thing("lemon", 0.0, 0.75, "yellow", z=0.02, on="plate_1"))
)


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("how many apples are there?", "There are two: the red apple and the green apple."),
        ("how many mugs are on the left", "There is one: the red mug."),
        ("how many lemons do you see?", "There is one: the lemon."),
        ("how many guitars are there", "There is no guitar."),
        ("what is on the plate?", "The lemon is on the plate."),
        ("what's next to the green apple", "The bowl is next to the green apple."),
        ("what is in the bowl?", "Nothing is in the bowl."),
        ("where is the lemon?", "The lemon is on the plate."),
        ("where's the sponge", "The sponge is in the near left corner."),
        ("could you tell me where the lemon is?", "The lemon is on the plate."),
        ("is there a banana?", "No, I can't see a banana."),
        ("is there a bottle on the table?",
         "Yes, the bottle is at the right edge of the table."),
        ("is the lemon on the plate?", "Yes, the lemon is on the plate."),
        ("is the left mug red", "Yes, the left mug is red."),
        ("what colour is the lemon?", "The lemon is yellow."),
        ("what color is the bowl", "I don't know the colour of the bowl."),
        ("which apple is closest to the bowl?", "It is the green apple."),
        ("which mug is blue", "It is the blue mug."),
        ("what are you holding?", "I hold nothing."),
        ("how tall is the bottle?", "The bottle is 6 cm tall."),
        ("is the bottle wider than the plate?", "No, the bottle is not wider than the plate."),
        ("is the red apple closer to the red block than to the bowl?",
         "Yes, the red apple is closer to the red block than to the bowl."),
        ("are there more than two blocks?", "Yes, there are three blocks."),
        ("are both mugs at the near edge", "Yes, both mugs are at the near edge."),
        ("is the bowl blue?", "I don't know the colour of the bowl."),
        ("is the red mug taller than the blue mug?", "No, the red mug is not taller than the blue"
         " mug."),
    ],
)  # fmt: skip
def test_an_answer_from_the_scene(question, answer):
    assert SceneQuestions(WITH_LEMON, (), LEXICON).answer(question) == answer


def test_everything_there_is():
    answer = SceneQuestions(TABLE, (), LEXICON).answer("what can you see?")
    assert answer is not None and answer.startswith("I can see two apples, a bowl, two mugs")
    assert SceneQuestions(Scene(), (), LEXICON).answer("what do you see") == "The table is empty."


@pytest.mark.parametrize("question", ["what is 2+2?", "who are you?", "what time is it?", "why?"])
def test_other_questions_are_not_answered(question):
    assert SceneQuestions(TABLE, (), LEXICON).answer(question) is None


TRAY = Scene(objects=TABLE.objects, tray=(waiting("can"), waiting("jar")))


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("are there more apples than blocks?",
         "No, there are two of the one and three of the other."),
        ("are there fewer apples than blocks?",
         "Yes, there are two of the one and three of the other."),
        ("what's in the tray?", "Nothing waits in the tray."),
        ("measure the distance between the sponge and the bowl",
         "The sponge and the bowl are 28 cm apart, edge to edge."),
        ("is there room in the bowl for the lemon?",
         "I can't tell that beforehand: say what should go there, and I see if it fits."),
        ("which things are round?",
         "I can't tell that: I know what things are called, their colours, sizes and places."),
    ],
)  # fmt: skip
def test_a_question_of_another_kind(question, answer):
    assert SceneQuestions(WITH_LEMON, (), LEXICON).answer(question) == answer


def test_what_waits_in_the_tray_is_told():
    answer = SceneQuestions(TRAY, (), LEXICON).answer("what is in the tray?")
    assert answer == "The can and the jar wait in the tray."
