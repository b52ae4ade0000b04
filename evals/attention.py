"""`armchat reproduce attention SENTENCE --out FILE.png`: where the decoder looked, as a picture.

The paper's figures of attention, for any instruction and output token: one row for each
token of the most probable program, one column for each word piece of the sentence, shaded by the
share of attention. In the product's model what a slot stands for is one column.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Literal, TextIO

from agent.compose import scene_from
from agent.errors import ConfigError, TranslatorError
from agent.messages import Attention, Kind, TranslateRequest
from agent.program import instantiate
from clarifier.lexicon import load_lexicon
from clarifier.measures import quantities
from clarifier.mentions import link
from evals.paper_metric import request_of
from translator.corpus.load import Pair
from translator.translate import PAPER, PRODUCT, Translator, renamed

Model = Literal["paper", "product"]
FOLDERS: dict[Model, Path] = {"paper": PAPER, "product": PRODUCT}


def request(sentence: str, kind: Kind, model: Model) -> tuple[TranslateRequest, dict[str, str]]:
    """The sentence as the model gets it, and what its slots are called.

    The paper's model gets its twelve nouns linked, and the other words as they are; the product's
    what its clarifier finds things and measures in, on the default table.
    """
    if model == "paper":
        asked = Pair(id="", split="test", family="", say=sentence, program="", after=(), kind=kind)
        wanted, names = request_of(asked)
        return wanted, dict(names)
    scene = scene_from(None)
    linked = link(sentence, scene, (), load_lexicon())
    measures = quantities(linked, scene)
    names = {one.slot: one.text for one in reversed(linked.mentions)}
    names |= {one.slot: one.text for one in measures}
    return TranslateRequest(linked.text, linked.mentions, kind, 4, measures), names


def chosen(attention: Attention, token: str) -> list[int]:
    """Numbers (from 0) of the rows to draw: of one token (from 1), or of ``all``.

    Raises ConfigError for a token that the program does not have.
    """
    count = len(attention.tokens)
    if token == "all":
        return list(range(count))
    if not (token.isascii() and token.isdigit() and 1 <= int(token) <= count):
        raise ConfigError(f"--token {token}: the program has tokens 1 to {count}; or say all")
    return [int(token) - 1]


def reproduce(
    sentence: str, kind: Kind, token: str, translator: Translator, model: Model, file: Path,
    out: TextIO,
) -> int:  # fmt: skip
    """Draw the picture and print the program; 0.

    Raises TranslatorError when there is no program, ConfigError for a token that there is not, or
    where the picture cannot be drawn or written.
    """
    if importlib.util.find_spec("cv2") is None:
        raise ConfigError("pictures of attention need OpenCV: pip install 'armchat[camera]'")
    from evals.heat import draw, save

    wanted, names = request(sentence, kind, model)
    found = translator.attend(wanted)
    if not found:
        raise TranslatorError(f"the model has no program for {sentence!r}")
    best = found[0]
    rows = chosen(best, token)
    labels = [f"{row + 1} {renamed(best.tokens[row], names)}" for row in rows]
    try:
        save(draw(labels, best.pieces, [best.weights[row] for row in rows]), file)
    except OSError as error:
        raise ConfigError(f"cannot write {file}: {error.strerror}") from error
    out.write(instantiate(best.body, names) + "\n")
    return 0
