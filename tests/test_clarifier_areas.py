"""What is brought "to" an area marked on the table goes onto it."""

import pytest
from clarifier_table import thing

from clarifier.areas import onto_area
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from scene.types import Scene

LEXICON = load_lexicon()
TABLE = Scene(
    objects=(
        thing("domino", -0.6, 0.4, "white", size=0.15),
        thing("domino", -0.3, 0.4, "black", number=2, size=0.15),
        thing("zone", 0.5, 0.4, "green", size=0.6, tall=0.01),
        thing("pad", 0.5, -0.4, size=0.5, tall=0.02),
        thing("square", -0.5, -0.5, "red", size=0.1, tall=0.05),
        thing("tower", 0.0, 0.0, size=0.15, tall=0.5),
    )
)


def reworded(text):
    return onto_area(link(text, TABLE, (), LEXICON), TABLE, LEXICON)


@pytest.mark.parametrize(
    "text",
    [
        "bring both dominoes over to the green zone",
        "push the black domino to the pad",
        "transfer one of the dominoes to the zone please",
        "the white domino goes to the pad",
        "send the tower to the green zone",
    ],
)
def test_to_an_area_is_onto_it(text):
    assert reworded(text) == text.replace(" to the ", " onto the ")


def test_every_area_of_a_sentence_is_read_so():
    said = reworded("carry the white domino to the zone and then the black domino to the pad")
    assert said == "carry the white domino onto the zone and then the black domino onto the pad"


@pytest.mark.parametrize(
    "text",
    [
        "move the black domino to the tower",
        "move the black domino to the square",
        "point to the green zone",
        "slide the tower right up to the zone",
        "put the tower next to the zone",
        "move the black domino towards the pad",
        "pick up the white domino and go to the pad",
        "shift the pad to the left of the zone",
    ],
)
def test_what_is_no_area_or_no_destination_stays(text):
    assert reworded(text) is None
