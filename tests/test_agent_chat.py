"""What a chat or a daemon is made of: the configuration counts, and the command line before it."""

import argparse

import pytest

from agent import compose
from agent.chat import _config, factories
from agent.config import RobotConfig
from agent.errors import TranslatorError
from agent.messages import TranslateRequest

NOTHING = argparse.Namespace(
    connect=None, scene=None, robot=None, seed=None, port=None, speed=None, gui=None
)


def test_what_the_command_line_leaves_open_the_configuration_says(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "armchat.toml").write_text('[robot]\nkind = "ideal"\nseed = 7\n')
    assert _config(NOTHING, {}).robot == RobotConfig(kind="ideal", seed=7)
    typed = argparse.Namespace(
        **{**vars(NOTHING), "scene": "desk.json", "robot": "bullet", "seed": 1, "speed": 0.3}
    )
    config = _config(typed, {})
    assert (config.robot.kind, config.robot.seed, config.robot.speed) == ("bullet", 1, 0.3)
    assert config.scene.file == "desk.json"


def test_every_service_has_a_factory_in_the_order_of_starting():
    order = ["robot", "scene", "translator", "clarifier", "agent"]
    assert list(factories(compose.table("kitchen"), RobotConfig(kind="ideal"))) == order


def test_the_configured_weights_are_the_ones_that_are_read(monkeypatch, tmp_path):
    monkeypatch.setenv("ARMCHAT_TRANSLATOR__MODEL", str(tmp_path))
    compose.speakers.cache_clear()
    with pytest.raises(TranslatorError, match=str(tmp_path)):
        compose.translate(TranslateRequest("touch it", (), "manipulate"))
    compose.speakers.cache_clear()
