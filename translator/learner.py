"""How a model learns from batches, on a GPU or on threads (torch)."""

from __future__ import annotations

import copy
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor

import msgspec
import torch
from torch import Tensor, nn

from translator.course import TrainConfig
from translator.embed import SentenceEncoder
from translator.lessons import PADDING, Padded
from translator.minilm import minilm
from translator.model import Seq2Seq
from translator.transformer import Transformer
from translator.translate import WEIGHTS

AHEAD = 8
"""Batches made ahead of the one that the model learns from."""
Model = Seq2Seq | Transformer


class Batch(msgspec.Struct, frozen=True):
    """words (B, T, E), slots (B, T), lengths (B,), inputs (B, L), targets (B, L; PADDING beyond
    the end)."""

    words: Tensor
    slots: Tensor
    lengths: Tensor
    inputs: Tensor
    targets: Tensor

    def share(self, number: int, of: int) -> Batch:
        """Every ``of``-th sentence, from ``number`` on."""
        return Batch(*(getattr(self, field)[number::of] for field in self.__struct_fields__))


Reader = Callable[[Tensor, Tensor], Tensor]
"""Frozen embeddings (B, T, E) of word pieces (B, T) of sentences of these lengths (B,)."""


def reader_on(device: torch.device) -> Reader:
    """The frozen encoder: on a GPU in torch, else the graph that serves, sentence by sentence."""
    if device.type != "cpu":
        frozen = minilm().to(device)

        @torch.no_grad()
        def together(ids: Tensor, lengths: Tensor) -> Tensor:
            states: Tensor = frozen(ids, lengths)
            return states

        return together
    encoder = SentenceEncoder(WEIGHTS)

    def one_by_one(ids: Tensor, lengths: Tensor) -> Tensor:
        rows = [
            torch.from_numpy(encoder.states(row[:length].numpy()))
            for row, length in zip(ids, lengths.tolist(), strict=True)
        ]
        return nn.utils.rnn.pad_sequence(rows, batch_first=True)

    return one_by_one


def batch_of(padded: Padded, reader: Reader, device: torch.device) -> Batch:
    """Tensors on the device."""
    ids, slots, lengths, inputs, targets = (
        torch.from_numpy(one).to(device, non_blocking=True) for one in padded
    )
    return Batch(reader(ids, lengths), slots, lengths, inputs, targets)


def _logits(model: Model, batch: Batch) -> Tensor:
    # bfloat16 only where the processor has it: elsewhere it is slower than float32
    device = batch.words.device.type
    fast = device != "cpu" or bool(torch.cpu.get_capabilities().get("avx512_bf16"))
    with torch.autocast(device, dtype=torch.bfloat16, enabled=fast):
        logits: Tensor = model(batch.words, batch.lengths, batch.inputs, batch.slots)  # (B, L, V)
    return logits.float()


def _loss(logits: Tensor, targets: Tensor) -> Tensor:
    return nn.functional.cross_entropy(
        logits.flatten(0, 1), targets.flatten(), ignore_index=PADDING
    )


def ahead(padded: Iterable[Padded], make: Callable[[Padded], Batch]) -> Iterator[Batch]:
    """Batches made a few ahead, on a thread: the frozen encoder works while the model learns."""
    with ThreadPoolExecutor(1) as pool:
        made: deque[Future[Batch]] = deque()
        for one in padded:
            made.append(pool.submit(make, one))
            if len(made) > AHEAD:
                yield made.popleft().result()
        yield from (batch.result() for batch in made)


class Learner:
    """Adam over replicas of one model, which share its weights and learn side by side.

    One operation on two threads waits for the slower one at every step of the way, and on busy
    cores that costs more than it saves; replicas meet once a batch (figures: evals/LOG.md).
    """

    def __init__(self, model: Model, config: TrainConfig, began: float | None = None) -> None:
        """``began``: when the time that the configuration allows began (time.monotonic)."""
        self._config = config
        self._model = model
        self._began = time.monotonic() if began is None else began
        several = config.threads if next(model.parameters()).device.type == "cpu" else 1
        self._replicas = [model] + [copy.deepcopy(model) for _ in range(several - 1)]
        for replica in self._replicas[1:]:
            for mine, shared in zip(replica.parameters(), model.parameters(), strict=True):
                mine.data = shared.data
        self._optimiser = torch.optim.Adam(model.parameters(), lr=config.learning_rate, fused=True)
        self.batches = 0

    def moments(self) -> dict[str, Tensor]:
        """Adam's moments and steps, by the number of the parameter and their name."""
        state = self._optimiser.state_dict()["state"]
        return {f"{n}.{name}": one for n, part in state.items() for name, one in part.items()}

    def restore(self, moments: Mapping[str, Tensor], batches: int, seconds: float) -> None:
        """Go on behind so many batches and seconds of the time that training may take."""
        state: dict[int, dict[str, Tensor]] = {}
        for key, tensor in moments.items():
            number, name = key.split(".")
            state.setdefault(int(number), {})[name] = tensor
        groups = self._optimiser.state_dict()["param_groups"]
        self._optimiser.load_state_dict({"state": state, "param_groups": groups})
        self.batches = batches
        self._began -= seconds

    @property
    def seconds(self) -> float:
        """How much of its time training has used."""
        return time.monotonic() - self._began

    @property
    def out_of_time(self) -> bool:
        """Whether the time that the configuration allows is over."""
        return self._time_used() >= 1

    def epoch(self, number: int, batches: Iterable[Batch]) -> float:
        """Learn from every batch while there is time; the mean loss. ``number``: from 1."""
        losses: list[Tensor] = []
        for replica in self._replicas:
            replica.train()
        with ThreadPoolExecutor(len(self._replicas), initializer=torch.set_num_threads,
                                initargs=(1,)) as pool:  # fmt: skip
            for batch in batches:
                rate = self.next_rate(number)
                for group in self._optimiser.param_groups:
                    group["lr"] = rate
                losses.append(self._learn(batch, pool))
                if self.out_of_time:
                    break
        return float(torch.stack(losses).mean())

    def _learn(self, batch: Batch, pool: ThreadPoolExecutor) -> Tensor:
        of = min(len(self._replicas), len(batch.lengths))
        shares = [batch.share(number, of) for number in range(of)]
        losses = list(pool.map(_backward, self._replicas[:of], shares))
        for mine, *others in zip(*(one.parameters() for one in self._replicas[:of]), strict=True):
            for other in others:
                if mine.grad is not None and other.grad is not None:
                    mine.grad.add_(other.grad)
            if mine.grad is not None:
                mine.grad.div_(of)
        nn.utils.clip_grad_norm_(self._model.parameters(), self._config.clip)
        self._optimiser.step()
        return torch.stack(losses).mean()

    def next_rate(self, number: int) -> float:
        """The learning rate of the next batch, in epoch ``number``."""
        self.batches += 1
        config = self._config
        share = max((number - 1) / max(1, config.epochs - 1), self._time_used())
        rate = config.learning_rate * (config.final_rate / config.learning_rate) ** share
        return float(rate * min(1.0, self.batches / max(1, config.warmup)))

    def _time_used(self) -> float:
        """The share of the time that the configuration allows."""
        minutes = self._config.minutes
        return min(1.0, self.seconds / (60 * minutes)) if minutes else 0.0


def _backward(model: Model, batch: Batch) -> Tensor:
    model.zero_grad()
    loss = _loss(_logits(model, batch), batch.targets)
    loss.backward()  # type: ignore[no-untyped-call]
    return loss.detach()


@torch.no_grad()
def evaluate(model: Model, batches: Iterable[Batch]) -> tuple[float, float]:
    """The mean loss of the batches, and the share of programs with every symbol right."""
    model.eval()
    losses, right = list[Tensor](), list[Tensor]()
    for batch in batches:
        logits = _logits(model, batch)
        losses.append(_loss(logits, batch.targets))
        hit = (logits.argmax(-1) == batch.targets) | (batch.targets == PADDING)
        right.append(hit.all(1))
    return float(torch.stack(losses).mean()), float(torch.cat(right).float().mean())
