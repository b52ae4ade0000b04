"""Configuration: five places, the strongest wins, and a bad key says where and what instead."""

import pytest

from agent.config import BusConfig, load
from agent.errors import ConfigError


@pytest.fixture
def files(tmp_path):
    """Paths of the project's and the user's file; neither is there yet."""
    return {"project": tmp_path / "armchat.toml", "user": tmp_path / "user.toml"}


def test_without_anything_there_are_defaults(files):
    config = load({}, {}, **files)
    assert config.bus == BusConfig(prefix="armchat", listen=(), connect=(), scout=True)
    assert config.robot.kind is None
    assert config.scene.file is None


def test_each_place_outranks_the_next(files):
    files["user"].write_text('[bus]\nprefix = "user"\n[robot]\nseed = 1\n[tui]\ntheme = "nord"\n')
    files["project"].write_text('[bus]\nprefix = "project"\n[robot]\nseed = 2\n')
    environ = {"ARMCHAT_BUS__PREFIX": "environ", "ARMCHAT_MODEL_DIR": "/elsewhere"}
    config = load({"bus.prefix": "typed", "robot.pace": None}, environ, **files)
    assert config.bus.prefix == "typed"
    assert load({}, environ, **files).bus.prefix == "environ"
    assert load({}, {}, **files).bus.prefix == "project"
    assert config.robot.seed == 2
    assert config.tui.theme == "nord"
    assert config.robot.pace == 1.0


@pytest.mark.parametrize(
    ("name", "text", "section", "key", "value"),
    [
        ("ARMCHAT_ROBOT__SEED", "7", "robot", "seed", 7),
        ("ARMCHAT_ROBOT__PACE", "0", "robot", "pace", 0.0),
        ("ARMCHAT_BUS__SCOUT", "false", "bus", "scout", False),
        ("ARMCHAT_BUS__CONNECT", "tcp/h:1", "bus", "connect", ("tcp/h:1",)),
        (
            "ARMCHAT_BUS__CONNECT",
            '["tcp/h:1", "tcp/h:2"]',
            "bus",
            "connect",
            ("tcp/h:1", "tcp/h:2"),
        ),
        ("ARMCHAT_SCENE__FILE", "desk.json", "scene", "file", "desk.json"),
        ("ARMCHAT_CAMERA__SOURCE", "0", "camera", "source", 0),
        ("ARMCHAT_CAMERA__SOURCE", "clip.mp4", "camera", "source", "clip.mp4"),
        ("ARMCHAT_CAMERA__SIZE", "[640, 480]", "camera", "size", (640, 480)),
    ],
)
def test_an_environment_variable_sets_a_key(files, name, text, section, key, value):
    config = load({}, {name: text}, **files)
    assert getattr(getattr(config, section), key) == value


def test_the_preview_is_on_off_or_left_to_the_arm(files):
    assert load({}, {}, **files).tui.preview is None
    files["project"].write_text("[tui]\npreview = true\n")
    assert load({}, {}, **files).tui.preview is True
    assert load({}, {"ARMCHAT_TUI__PREVIEW": "false"}, **files).tui.preview is False


def test_a_bad_key_names_its_file_itself_and_the_nearest_key(files):
    files["project"].write_text("[robot]\nsed = 1\n")
    with pytest.raises(ConfigError) as caught:
        load({}, {}, **files)
    for part in (str(files["project"]), "robot.sed", "did you mean robot.seed?"):
        assert part in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[robto]\nseed = 1\n", r"no section \[robto\]; did you mean robot\?"),
        ("[robot]\nkind = 'dobott'\n", r"armchat\.toml: .*dobott.*robot\.kind"),
        ("[robot]\nseed = 'one'\n", r"armchat\.toml: Expected `int`, got `str`.*robot\.seed"),
        ("seed = 1\n", r"'seed' must stand in a \[section\]"),
        ("[robot\n", r"armchat\.toml: "),
        ("[robot]\nzzz = 1\n", "known: kind, seed, pace"),
    ],
)
def test_what_is_wrong_in_a_file_is_said_with_its_name(files, text, message):
    files["project"].write_text(text)
    with pytest.raises(ConfigError, match=message):
        load({}, {}, **files)


def test_a_bad_variable_and_a_bad_option_say_where_they_come_from(files):
    with pytest.raises(ConfigError, match=r"environment: no key bus\.prefx"):
        load({}, {"ARMCHAT_BUS__PREFX": "x"}, **files)
    with pytest.raises(ConfigError, match="command line: no key"):
        load({"bus.prefx": "x"}, {}, **files)


@pytest.mark.parametrize(("key", "value"), [("speed", "1.5"), ("speed", "0"), ("retries", "-1")])
def test_a_speed_and_a_budget_have_bounds_and_a_bad_one_is_named(files, key, value):
    with pytest.raises(ConfigError, match=f"robot.{key}"):
        load({}, {f"ARMCHAT_ROBOT__{key.upper()}": value}, **files)


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("table", "0", r"table must be in \[50, 3000\]"),
        ("marker", "180", "four markers of this size do not fit"),
        ("size", "[0, 480]", r"size must be \[width, height\]"),
        ("burnt", "2", "burnt must be in"),
    ],
)
def test_a_camera_that_cannot_be_is_refused(files, key, value, said):
    if key == "marker":
        files["project"].write_text("[camera]\ntable = 300\n")
    with pytest.raises(ConfigError, match=said):
        load({}, {f"ARMCHAT_CAMERA__{key.upper()}": value}, **files)
