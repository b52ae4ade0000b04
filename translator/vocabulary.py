"""Program text to tokens and back, and the vocabulary of both sides.

A token is one Python token, except that dotted names (``robot.move``, ``math.sin``) and
attributes (``.x``) are one token each, and that layout is explicit: NEWLINE, INDENT, DEDENT.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Literal

import msgspec

from agent.errors import TranslatorError
from agent.messages import Kind
from translator.marked import SLOTS

NOUNS = (
    "apple", "orange", "banana", "lemon", "cup", "bottle",
    "box", "plate", "bowl", "block", "can", "sponge",
)  # fmt: skip
"""The object words the model knows; every mention is translated as one of them."""

PAD, END = "<pad>", "<end>"
STARTS: dict[Kind, str] = {"arrange": "<arrange>", "manipulate": "<manipulate>"}
"""The decoder's first input: it names the task."""
NEWLINE, INDENT, DEDENT = "<newline>", "<indent>", "<dedent>"
SPECIAL = (PAD, END, *STARTS.values(), NEWLINE, INDENT, DEDENT)

_TOKEN = re.compile(
    r"(?P<dotted>(?:robot|solver|math)\.[A-Za-z_]\w*)|(?P<attribute>(?<=[\w)\]])\.[A-Za-z_]\w*)"
    r"|(?P<number>\d+\.\d*(?:[eE][-+]?\d+)?|\.\d+|\d+)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<string>\"[^\"\n]*\"|'[^'\n]*')"
    r"|(?P<operator>==|!=|<=|>=|\*\*|//|\+=|-=|\*=|/=|[-+*/%<>=()\[\],:|])|(?P<blank>[ ]+)"
)
_WORD = re.compile(r"[a-z]+(?:'[a-z]+)?")


def tokenize(body: str) -> list[str]:
    """The tokens of a program body. Raises TranslatorError at a character it cannot read."""
    tokens: list[str] = []
    indents = [0]
    for number, line in enumerate(body.split("\n"), start=1):
        code = re.sub(r"\s*#.*$", "", line)
        if not code.strip():
            continue
        depth = len(code) - len(code.lstrip(" "))
        if depth > indents[-1]:
            indents.append(depth)
            tokens.append(INDENT)
        while depth < indents[-1]:
            indents.pop()
            tokens.append(DEDENT)
        tokens.extend(_line_tokens(code.strip(), number))
        tokens.append(NEWLINE)
    return tokens + [DEDENT] * (len(indents) - 1)


def _line_tokens(code: str, number: int) -> list[str]:
    tokens: list[str] = []
    position = 0
    while position < len(code):
        match = _TOKEN.match(code, position)
        if match is None:
            raise TranslatorError(f"line {number}: cannot read {code[position:]!r}")
        if match.lastgroup != "blank":
            tokens.append(match.group())
        position = match.end()
    return tokens


def detokenize(tokens: Iterable[str]) -> str:
    """Program text of a token sequence: four spaces a level, one statement a line."""
    lines: list[str] = []
    words: list[str] = []
    depth = 0
    for token in tokens:
        if token == INDENT:
            depth += 1
        elif token == DEDENT:
            depth -= 1
        elif token == NEWLINE:
            lines.append("    " * depth + spaced(words))
            words = []
        else:
            words.append(token)
    return "\n".join(lines)


_LAYOUT = {NEWLINE: "⏎", INDENT: "⇥", DEDENT: "⇤"}


def legible(piece: Sequence[str]) -> str:
    """One output symbol as a person reads it; layout is shown by signs."""
    return spaced([_LAYOUT.get(token, token) for token in piece])


_KEYWORDS = {"if", "elif", "else", "for", "while", "in", "and", "or", "not", "is", "return"}


def spaced(words: Sequence[str]) -> str:
    """Tokens of one line as text, with blanks where people put them."""
    text = ""
    before = ""
    unary = False
    for word in words:
        opens = word in "([" and (bool(re.match(r"[\w.]+$", before)) and before not in _KEYWORDS)
        tight = (
            not text
            or before in ("(", "[")
            or unary
            or word in {",", ")", "]", ":"}
            or word.startswith(".")
            or opens
        )
        text += word if tight else f" {word}"
        operand = bool(re.match(r"[\w.\"')\]]", before)) and before not in _KEYWORDS
        unary = word == "-" and not operand
        before = word
    return text


Piece = tuple[str, ...]
"""One output symbol of the model: a token, or several that often stand together."""

MERGES = 160
RAREST_MERGE = 8
"""How often two neighbours must occur together in the training programs to become one piece."""


Dialect = Literal["paper", "skills", "python"]
"""What programs are over: nouns and primitives (the paper's), slots and the prelude's calls, or
slots and whatever Python is mined, which has no grammar here and is only learnt from."""
OBJECTS: dict[Dialect, tuple[str, ...]] = {"paper": NOUNS, "skills": SLOTS, "python": SLOTS}
"""The tokens that stand for things; they are never merged with others."""


class Vocabulary(msgspec.Struct, frozen=True):
    """The model's output symbols by index, and the words that occurred in training sentences."""

    pieces: tuple[Piece, ...]
    words: tuple[str, ...]
    dialect: Dialect = "paper"

    def encode(self, tokens: Sequence[str]) -> list[int]:
        """Indices of a token sequence, longest pieces first.

        Raises TranslatorError for a token that training never showed.
        """
        return self.encoder()(tokens)

    def encoder(self) -> Callable[[Sequence[str]], list[int]]:
        """`encode`, for many sequences."""
        index = {piece: i for i, piece in enumerate(self.pieces)}
        longest = max(map(len, self.pieces))

        def encode(tokens: Sequence[str]) -> list[int]:
            result: list[int] = []
            start = 0
            while start < len(tokens):
                for size in range(min(longest, len(tokens) - start), 0, -1):
                    found = index.get(tuple(tokens[start : start + size]))
                    if found is not None:
                        result.append(found)
                        start += size
                        break
                else:
                    raise TranslatorError(f"{tokens[start]!r} is not in the vocabulary")
            return result

        return encode

    def decode(self, indices: Iterable[int]) -> list[str]:
        """Tokens of indices."""
        return [token for i in indices for token in self.pieces[i]]

    def symbol(self, token: str) -> int:
        """The index of a single token."""
        return self.pieces.index((token,))

    def with_tokens_of(self, programs: Iterable[str]) -> Vocabulary:
        """With the tokens of programs that it lacks behind its own."""
        own = {piece[0] for piece in self.pieces if len(piece) == 1}
        new = {token for body in programs for token in tokenize(body)} - own
        pieces = (*self.pieces, *((token,) for token in sorted(new)))
        return Vocabulary(pieces, self.words, self.dialect)

    def save(self, path: Path) -> None:
        """Write as JSON."""
        path.write_bytes(msgspec.json.encode(self) + b"\n")

    @classmethod
    def load(cls, path: Path) -> Vocabulary:
        """Read what `save` wrote. Raises TranslatorError naming the file."""
        try:
            return msgspec.json.decode(path.read_bytes(), type=cls)
        except (OSError, msgspec.DecodeError) as error:
            raise TranslatorError(f"cannot read the vocabulary {path}: {error}") from error


def build_vocabulary(
    programs: Iterable[str],
    sentences: Iterable[str],
    merges: int = MERGES,
    dialect: Dialect = "paper",
) -> Vocabulary:
    """The vocabulary of a training corpus; every object token is in it, whether used or not."""
    texts = [tokenize(body) for body in programs]
    objects = OBJECTS[dialect]
    single = {token for text in texts for token in text} | set(objects)
    pieces: list[Piece] = [(token,) for token in (*SPECIAL, *sorted(single - set(SPECIAL)))]
    known = {word for sentence in sentences for word in words_of(sentence)}
    known |= set(objects) if dialect == "paper" else set()
    return Vocabulary((*pieces, *_merged(texts, merges, objects)), tuple(sorted(known)), dialect)


def _merged(texts: Sequence[Sequence[str]], merges: int, objects: Sequence[str]) -> list[Piece]:
    """Byte-pair encoding over tokens: the neighbours that occur most often become one piece.

    Objects stay single, so that a piece says what is done and they to what.
    """
    nouns = {(token,) for token in objects}
    rows: list[tuple[list[Piece], int]] = [
        ([(token,) for token in text], times) for text, times in Counter(map(tuple, texts)).items()
    ]
    counts: Counter[tuple[Piece, Piece]] = Counter()
    places: defaultdict[tuple[Piece, Piece], set[int]] = defaultdict(set)

    def count(number: int, sign: int) -> None:
        row, times = rows[number]
        for pair in pairwise(row):
            if nouns.isdisjoint(pair):
                counts[pair] += sign * times
                places[pair].add(number)

    for number in range(len(rows)):
        count(number, 1)
    found: list[Piece] = []
    for _ in range(merges):
        pair = max(counts, key=lambda pair: (counts[pair], pair), default=None)
        if pair is None or counts[pair] < RAREST_MERGE:
            break
        found.append(pair[0] + pair[1])
        for number in places.pop(pair):  # only where it stands does anything change
            count(number, -1)
            row, times = rows[number]
            rows[number] = (_merge(row, *pair), times)
            count(number, 1)
    return list(dict.fromkeys(found))


def _merge(row: list[Piece], left: Piece, right: Piece) -> list[Piece]:
    result: list[Piece] = []
    for piece in row:
        if result and result[-1] == left and piece == right:
            result[-1] = left + right
        else:
            result.append(piece)
    return result


def words_of(sentence: str) -> list[str]:
    """The lower-case words of a sentence."""
    return _WORD.findall(sentence.lower())
