"""The paper's two baselines: no program, straight from sentence and sizes to numbers.

Arrange: an LSTM's sentence vector and all sizes -> FC layers -> positions. Manipulate: an LSTM
encoder and an LSTM decoder with attention, and all positions and sizes -> FC layers -> pose and
grip at each step. Both are trained on 20 executions of each true program (arXiv 2012.13695,
section IV-B). Needs the ``[train]`` extra.
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec
import torch
from safetensors.torch import load_file, save_file
from torch import Tensor, nn

from agent.errors import ProgramError
from agent.execute import Executor
from agent.messages import Kind
from evals.paper_metric import Path as Trajectory
from evals.paper_metric import Predict, path_of
from evals.world import random_table
from scene.types import Scene, SceneObject
from translator.corpus.load import Pair, load
from translator.data import Sample, nouns_of, swap_nouns
from translator.embed import SentenceEncoder
from translator.translate import WEIGHTS as MODELS
from translator.vocabulary import NOUNS

WIDTH = 192
EXECUTIONS = 20
EPOCHS: dict[Kind, int] = {"arrange": 20, "manipulate": 20}
LONGEST = 150
"""Steps of a predicted trajectory at most."""
SCALE = ".scale"
"""What the name of a matrix's scales ends with."""
WEIGHTS = Path(__file__).parent / "weights"
FEATURES = 7
"""A noun's numbers: present, x, y, z, width, height, tall."""


class Arranger(nn.Module):
    """words (B, T, 384), lengths (B,), sizes (B, 12 * 7) -> positions (B, 12, 2)."""

    def __init__(self) -> None:
        super().__init__()
        self.encoder = nn.LSTM(SentenceEncoder.size, WIDTH, batch_first=True)
        inputs = WIDTH + len(NOUNS) * FEATURES
        self.head = nn.Sequential(
            nn.Linear(inputs, WIDTH), nn.ReLU(), nn.Linear(WIDTH, WIDTH), nn.ReLU(),
            nn.Linear(WIDTH, len(NOUNS) * 2),
        )  # fmt: skip

    def forward(self, words: Tensor, lengths: Tensor, sizes: Tensor) -> Tensor:
        packed = nn.utils.rnn.pack_padded_sequence(
            words, lengths, batch_first=True, enforce_sorted=False
        )
        _, (h, _) = self.encoder(packed)
        places: Tensor = self.head(torch.cat([h[0], sizes], -1))
        return places.view(-1, len(NOUNS), 2)


class Mover(nn.Module):
    """Steps are (x, y, z, r, grip, end): words, lengths, sizes, steps (B, L, 6) -> (B, L, 6)."""

    def __init__(self) -> None:
        super().__init__()
        self.encoder = nn.LSTM(SentenceEncoder.size, WIDTH, batch_first=True)
        self.decoder = nn.LSTM(6, WIDTH, batch_first=True)
        self.score = nn.Linear(WIDTH, WIDTH, bias=False)
        inputs = 2 * WIDTH + len(NOUNS) * FEATURES
        self.head = nn.Sequential(
            nn.Linear(inputs, WIDTH), nn.ReLU(), nn.Linear(WIDTH, WIDTH), nn.ReLU(),
            nn.Linear(WIDTH, 6),
        )  # fmt: skip

    def read(self, words: Tensor, lengths: Tensor) -> tuple[Tensor, tuple[Tensor, Tensor]]:
        """The sentence: memory (B, T, H) and the decoder's first state."""
        packed = nn.utils.rnn.pack_padded_sequence(
            words, lengths, batch_first=True, enforce_sorted=False
        )
        states, final = self.encoder(packed)
        return nn.utils.rnn.pad_packed_sequence(states, batch_first=True)[0], final

    def steps(
        self, memory: Tensor, lengths: Tensor, state: tuple[Tensor, Tensor], sizes: Tensor,
        steps: Tensor,
    ) -> tuple[Tensor, tuple[Tensor, Tensor]]:  # fmt: skip
        """The step after each of ``steps``."""
        hidden, state = self.decoder(steps, state)  # (B, L, H)
        scores = self.score(hidden) @ memory.transpose(1, 2)  # (B, L, T)
        padding = torch.arange(memory.shape[1])[None, :] >= lengths[:, None]
        context = scores.masked_fill(padding[:, None, :], float("-inf")).softmax(-1) @ memory
        spread = sizes[:, None, :].expand(-1, hidden.shape[1], -1)
        return self.head(torch.cat([context, hidden, spread], -1)), state


class Example(msgspec.Struct, frozen=True):
    """One execution: words (T, 384), sizes (84,), goal: (12, 3) x, y, used; or (L, 6) steps."""

    words: Tensor
    sizes: Tensor
    goal: Tensor


def sizes_of(scene: Scene) -> Tensor:
    """All positions and sizes of a scene by noun; shape (12 * 7,)."""
    rows: dict[str, SceneObject] = {item.name: item for item in scene}
    table = [
        [1.0, item.x or 0.0, item.y or 0.0, item.z, item.width, item.height, item.tall]
        if (item := rows.get(noun)) is not None
        else [0.0] * FEATURES
        for noun in NOUNS
    ]
    return torch.tensor(table).flatten()


def examples(kind: Kind, executor: Executor, encoder: SentenceEncoder, seed: int) -> list[Example]:
    """Twenty executions of each true program of the training split, nouns swapped.

    Things too large for what is asked of them are drawn again, at most ten times in all for each
    execution that is wanted.
    """
    result = []
    for pair in (pair for pair in load(kind) if pair.split == "train"):
        rng = random.Random(f"baseline {pair.id} {seed}")
        found: list[Example] = []
        for _ in range(10 * EXECUTIONS):
            example = _example(Sample(pair.say, pair.program, kind), executor, encoder, rng)
            found += [] if example is None else [example]
            if len(found) == EXECUTIONS:
                break
        result += found
    return result


def _example(
    pair: Sample, executor: Executor, encoder: SentenceEncoder, rng: random.Random
) -> Example | None:
    sample = swap_nouns(pair, rng)
    names = nouns_of(f"{sample.say} {sample.program}")
    arrange = sample.kind == "arrange"
    scene = random_table(sample.kind, names, rng)
    draft = executor.run(sample.program, sample.kind, [scene])[0]
    if isinstance(draft, ProgramError):
        return None
    path = path_of(draft, scene)
    goal = _placed(path, scene) if arrange else _stepped(path)
    return Example(torch.from_numpy(encoder(sample.say)), sizes_of(scene), goal)


def _placed(path: Trajectory, scene: Scene) -> Tensor:
    goal = torch.zeros((len(NOUNS), 3))
    for item, place in zip(scene.tray, path, strict=True):
        if all(abs(value) < 10 for value in place):
            goal[NOUNS.index(item.name)] = torch.tensor([*place, 1.0])
    return goal


def _stepped(path: Trajectory) -> Tensor:
    steps = [[x, y, z, 0.0, float(grip > 0), 0.0] for x, y, z, grip in path[: LONGEST - 1]]
    return torch.tensor([*steps, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]])


def train(kind: Kind, executor: Executor, out: Path, epochs: int, seed: int = 0) -> nn.Module:
    """Train a baseline with Adam 1e-3 at batch 16 and save it (`packed`)."""
    torch.manual_seed(seed)
    data = examples(kind, executor, SentenceEncoder(MODELS), seed)
    model: Arranger | Mover = Arranger() if kind == "arrange" else Mover()
    optimiser = torch.optim.Adam(model.parameters(), lr=1e-3)
    order = random.Random(seed)
    for epoch in range(1, epochs + 1):
        began = time.perf_counter()
        order.shuffle(data)
        total = 0.0
        for start in range(0, len(data), 16):
            optimiser.zero_grad()
            loss = _loss(model, data[start : start + 16])
            loss.backward()  # type: ignore[no-untyped-call]
            optimiser.step()
            total += loss.item()
        mean, seconds = total / (len(data) / 16), time.perf_counter() - began
        print(f"{kind} baseline, epoch {epoch}: {mean:.4f} ({seconds:.0f} s)", file=sys.stderr)
    out.mkdir(parents=True, exist_ok=True)
    save_file(packed(model.state_dict()), out / f"baseline_{kind}.safetensors")
    return model


def packed(state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Weights as they are stored: matrices int8 with a scale for each row, the rest float16."""
    stored = {}
    for name, value in state.items():
        if value.dim() < 2:
            stored[name] = value.half()
            continue
        scale = value.abs().amax(1, keepdim=True).clamp(min=1e-8) / 127
        stored[name] = (value / scale).round().to(torch.int8)
        stored[f"{name}{SCALE}"] = scale.float()
    return stored


def unpacked(stored: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The weights of `packed`, float32."""
    return {
        name: value.float() * stored.get(f"{name}{SCALE}", torch.tensor(1.0))
        for name, value in stored.items()
        if not name.endswith(SCALE)
    }


def _loss(model: Arranger | Mover, batch: Sequence[Example]) -> Tensor:
    words = nn.utils.rnn.pad_sequence([one.words for one in batch], batch_first=True)
    lengths = torch.tensor([len(one.words) for one in batch])
    sizes = torch.stack([one.sizes for one in batch])
    if isinstance(model, Arranger):
        goal = torch.stack([one.goal for one in batch])
        error = (model(words, lengths, sizes) - goal[..., :2]) ** 2 * goal[..., 2:]
        mean: Tensor = error.sum() / goal[..., 2:].sum().clamp(min=1)
        return mean
    goal = nn.utils.rnn.pad_sequence([one.goal for one in batch], batch_first=True)
    counts = torch.tensor([len(one.goal) for one in batch])
    inside = (torch.arange(goal.shape[1])[None, :] < counts[:, None]).float()
    before = torch.cat([torch.zeros_like(goal[:, :1]), goal[:, :-1]], 1)
    memory, state = model.read(words, lengths)
    found, _ = model.steps(memory, lengths, state, sizes, before)
    pose = ((found[..., :4] - goal[..., :4]) ** 2).sum(-1) * (1 - goal[..., 5])
    flags = nn.functional.binary_cross_entropy_with_logits(
        found[..., 4:], goal[..., 4:], reduction="none"
    ).sum(-1)
    loss: Tensor = ((pose + flags) * inside).sum() / inside.sum()
    return loss


def baseline(kind: Kind, folder: Path | None = None) -> Predict:
    """A trained baseline as a model under test."""
    model: Arranger | Mover = Arranger() if kind == "arrange" else Mover()
    state = load_file((folder or WEIGHTS) / f"baseline_{kind}.safetensors")
    model.load_state_dict(unpacked(state))
    model.eval()
    encoder = SentenceEncoder(MODELS)

    @torch.no_grad()
    def predict(pair: Pair, tables: Sequence[Scene]) -> list[Trajectory]:
        words = torch.from_numpy(encoder(pair.say))[None]
        if isinstance(model, Arranger):
            return [_arranged(model, words, table) for table in tables]
        return [_moved(model, words, table) for table in tables]

    return predict


def _arranged(model: Arranger, words: Tensor, table: Scene) -> Trajectory:
    places = model(words, torch.tensor([words.shape[1]]), sizes_of(table)[None])[0]
    return tuple(tuple(places[NOUNS.index(item.name)].tolist()) for item in table.tray)


def _moved(model: Mover, words: Tensor, table: Scene) -> Trajectory:
    lengths = torch.tensor([words.shape[1]])
    memory, state = model.read(words, lengths)
    sizes, step = sizes_of(table)[None], torch.zeros((1, 1, 6))
    path: list[tuple[float, ...]] = []
    while len(path) < LONGEST:
        found, state = model.steps(memory, lengths, state, sizes, step)
        if found[0, 0, 5] > 0:
            break
        grip = float(found[0, 0, 4] > 0)
        step = torch.cat([found[..., :4], torch.tensor([[[grip, 0.0]]])], -1)
        x, y, z = found[0, 0, :3].tolist()
        path.append((x, y, z, 4.0 * grip))
    return tuple(path)


def main() -> int:
    """Train both baselines: `python -m evals.baselines`."""
    torch.set_num_threads(2)
    with Executor() as executor:
        for kind, epochs in EPOCHS.items():
            train(kind, executor, WEIGHTS, epochs)
    return 0


if __name__ == "__main__":
    sys.exit(main())
