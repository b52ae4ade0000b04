"""/model: which translator speaks, and another one while armchat runs."""

import pytest
from tui_pilot import say, talking, wait_until

from agent.errors import TranslatorError

pytestmark = pytest.mark.live


class Models:
    """Two translators, of which one is not here."""

    def __init__(self):
        self.model = "seq2seq"

    def choose(self, model, say):
        if model == "pretrained":
            raise TranslatorError("gemma3-270m is not here: armchat models pull gemma3-270m")
        say(f"loading the model {model} ...")
        self.model = model


async def test_another_model_is_loaded_beside_the_talk_and_its_progress_is_told():
    models = Models()
    async with talking(models=models) as (_, app, pilot):
        await say(app, pilot, "/model")
        await wait_until(pilot, lambda: "seq2seq translates" in app.transcript())
        await say(app, pilot, "/model cascade")
        await wait_until(pilot, lambda: "from the next sentence on cascade" in app.transcript())
        assert "loading the model cascade" in app.transcript()
        assert models.model == "cascade"


async def test_what_to_type_for_a_model_that_is_missing_is_said():
    async with talking(models=Models()) as (_, app, pilot):
        await say(app, pilot, "/model pretrained")
        await wait_until(pilot, lambda: "armchat models pull gemma3-270m" in app.transcript())
        assert "seq2seq goes on translating" in app.transcript()


async def test_a_translator_in_another_process_is_chosen_there():
    async with talking() as (_, app, pilot):
        await say(app, pilot, "/model cascade")
        await wait_until(pilot, lambda: "choose its model there" in app.transcript())
