"""Low-rank fine-tuning: what is learnt, kept, gone on with, and served."""

import random
from dataclasses import dataclass
from itertools import islice

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="needs the pretrained extra")
pytest.importorskip("transformers", reason="needs the pretrained extra")

from tiny_model import tiny_model  # noqa: E402

import translator.written as written_lessons  # noqa: E402
from agent.errors import ConfigError  # noqa: E402
from evals.grown import program, request  # noqa: E402
from translator import finetune  # noqa: E402
from translator.corpus.generate import Generator  # noqa: E402
from translator.corpus.seed import kept, load_seeds  # noqa: E402
from translator.finetune import OURS, Checked, TuneConfig, learn, read_config, tune  # noqa: E402
from translator.lora import adapt, learnt, merge, small, whole  # noqa: E402
from translator.pretrained import PretrainedTranslator  # noqa: E402
from translator.speech import Speech, Words  # noqa: E402
from translator.tuned import load_base, tuned  # noqa: E402
from translator.vocabulary import Vocabulary  # noqa: E402
from translator.written import Texts, Written, write  # noqa: E402


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Two threads on two busy cores are ten times slower."""
    torch.set_num_threads(1)


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    return tiny_model(tmp_path_factory.mktemp("base"))


@pytest.fixture(scope="module")
def lessons(base):
    written_lessons.VALID = 20
    return write(Speech(Words(base), Vocabulary.load(OURS)), 40, 1.0, 0)


def test_an_adapter_changes_nothing_before_it_learnt_and_merges_into_the_same_layer():
    torch.manual_seed(1)
    net = torch.nn.Sequential(torch.nn.Linear(5, 7), torch.nn.Tanh(), torch.nn.Linear(7, 3))
    plain = torch.nn.Sequential(torch.nn.Linear(5, 7), torch.nn.Tanh(), torch.nn.Linear(7, 3))
    plain.load_state_dict(net.state_dict())
    inputs = torch.randn(4, 5)
    before = net(inputs)
    adapt(net, 2)
    assert torch.equal(net(inputs), before)
    assert [tuple(w.shape) for w in learnt(net).values()] == [(2, 5), (7, 2), (2, 7), (3, 2)]
    for weight in learnt(net).values():
        weight.data = torch.randn_like(weight)
    assert not torch.allclose(net(inputs), before)
    merge(plain, learnt(net))
    assert torch.allclose(plain(inputs), net(inputs), atol=1e-5)


def test_in_eight_bits_a_weight_is_off_by_half_a_step_of_its_row_at_most():
    torch.manual_seed(2)
    weights = {
        "a.up": torch.randn(5, 9) * torch.logspace(-6, 2, 5)[:, None],
        "read": torch.zeros(2, 3),
    }
    kept = small(weights)
    assert kept["a.up"].dtype == torch.int8
    again = whole(kept)
    assert set(again) == set(weights)
    step = weights["a.up"].abs().amax(1, keepdim=True) / 127
    assert ((again["a.up"] - weights["a.up"]).abs() <= 0.51 * step).all()
    assert torch.equal(again["read"], weights["read"])
    assert torch.equal(whole(weights)["a.up"], weights["a.up"])


def test_only_what_is_ours_is_learnt(base, lessons):
    model = tuned(load_base(base, torch.float32), torch.from_numpy(lessons.rows), lessons.spelling)
    adapt(model.body, 2)
    learning = {name for name, weight in model.named_parameters() if weight.requires_grad}
    ours = ("read", "write", "up", "down")
    assert learning == {n for n, _ in model.named_parameters() if n.rpartition(".")[2] in ours}


def test_lessons_are_kept_as_they_were_written(lessons, tmp_path):
    lessons.save(tmp_path / "lessons.npz")
    again = Written.load(tmp_path / "lessons.npz")
    assert again.spelling == lessons.spelling
    for one, other in zip(again.train + again.valid, lessons.train + lessons.valid, strict=True):
        assert np.array_equal(one, other)
    assert lessons.train.sizes.sum() == len(lessons.train.numbers)


def test_batches_hold_every_lesson_once_within_the_budget(lessons):
    texts = Texts(np.zeros(3 * 500, np.uint16), np.array([[1, 2]] * 400 + [[60, 60]] * 100))
    batches = list(texts.batches(300, np.random.default_rng(0)))
    assert sorted(np.concatenate(batches)) == list(range(500))
    lengths = texts.sizes.sum(1)
    assert all(len(one) * lengths[one].max() <= 300 for one in batches)
    assert len(batches) < 70


def test_a_batch_asks_for_each_piece_behind_the_ones_before(lessons):
    device = torch.device("cpu")
    batch = finetune.OnDevice(lessons.train, device).batch(np.array([0, 7]))
    lengths = lessons.train.sizes.sum(1, dtype=np.int64)
    starts = np.cumsum(lengths) - lengths
    for row, number in enumerate((0, 7)):
        sentence, told = map(int, lessons.train.sizes[number])
        own = lessons.train.numbers[starts[number] :][: sentence + told]
        assert batch.numbers[row, : sentence + told].tolist() == own.tolist()
        targets = [t for t in batch.targets[row].tolist() if t != finetune.IGNORED]
        assert targets == own[sentence:].tolist()
        assert batch.places[row, :told].tolist() == list(range(sentence - 1, sentence + told - 1))


def test_padding_tells_a_lesson_nothing(base, lessons):
    model = tuned(load_base(base, torch.float32), torch.from_numpy(lessons.rows), lessons.spelling)
    texts = finetune.OnDevice(lessons.train, torch.device("cpu"))
    order = np.argsort(lessons.train.sizes.sum(1))
    short, long = order[0], order[-1]
    alone, beside = texts.batch(np.array([short])), texts.batch(np.array([short, long]))
    pieces = int(lessons.train.sizes[short, 1])
    with torch.no_grad():
        one = model(alone.numbers, alone.places)[0, :pieces]
        other = model(beside.numbers, beside.places)[0, :pieces]
    assert torch.allclose(one, other, atol=1e-4)


@dataclass
class Run:
    folder: object
    log: list


@pytest.fixture(scope="module")
def run(base, lessons, tmp_path_factory):
    """Six lessons, learnt by heart in two goes."""
    folder = tmp_path_factory.mktemp("run")
    few = lessons._replace(train=part(lessons.train, 6), valid=part(lessons.train, 6))
    few.save(folder / "lessons.npz")
    Vocabulary.load(OURS).save(folder / "vocabulary.json")
    config = TuneConfig(base=str(base), rank=8, seconds=20.0, numbers=400, learning_rate=2e-2)
    first = tune(config, folder, Ticks())
    again = TuneConfig(base=str(base), rank=8, seconds=100.0, numbers=400, learning_rate=2e-2)
    return Run(folder, [first, tune(again, folder, Ticks())])


class Ticks:
    """A clock that goes on by a tenth of a second whenever it is asked."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        self.now += 0.1
        return self.now


def part(texts, count):
    return Texts(texts.numbers[: int(texts.sizes[:count].sum())], texts.sizes[:count])


def test_what_is_shown_is_learnt_and_a_run_goes_on_where_it_was_kept(run):
    first, second = run.log
    assert second[: len(first)] == first
    assert second[-1].lessons > first[-1].lessons
    assert second[-1].seconds == pytest.approx(100.0, abs=0.5)
    assert second[-1].valid < 0.5 < first[0].train


def test_the_adapter_serves_what_was_learnt(base, run):
    """Sentences that were learnt by heart are translated, with a confidence, over their slots."""
    entry: Checked = run.log[-1][-1]
    translate = PretrainedTranslator(base, run.folder, quantised=False)
    samples = islice(Generator(kept(load_seeds(), held_out=False), random.Random(0)), 6)
    right = [
        bool(found := translate(request(one)).candidates) and found[0].body == program(one)
        for one in samples
    ]
    assert sum(right) >= round(6 * entry.exact) - 1
    assert sum(right) >= 3


def test_a_key_that_is_none_is_named(tmp_path):
    path = tmp_path / "run.toml"
    path.write_text('base = "x"\nranks = 3\n')
    with pytest.raises(ConfigError, match="ranks"):
        read_config(path)


def test_learning_stops_by_the_clock(base, lessons, tmp_path):
    config = TuneConfig(base=str(base), rank=2, seconds=0.0, numbers=400)
    log = learn(config, lessons, tmp_path / "adapter.safetensors", Ticks())
    assert len(log) == 1
    assert (tmp_path / "adapter.safetensors").stat().st_size < 1_000_000
