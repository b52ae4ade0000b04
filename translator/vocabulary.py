"""Program text to tokens and back, and the vocabulary of both sides.

A token is one Python token, except that dotted names (``robot.move``, ``math.sin``) and
attributes (``.x``) are one token each, and that layout is explicit: NEWLINE, INDENT, DEDENT.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

import msgspec

from agent.errors import TranslatorError
from agent.messages import Kind

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
            lines.append("    " * depth + _spaced(words))
            words = []
        else:
            words.append(token)
    return "\n".join(lines)


_KEYWORDS = {"if", "elif", "else", "for", "while", "in", "and", "or", "not", "is", "return"}


def _spaced(words: Sequence[str]) -> str:
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


class Vocabulary(msgspec.Struct, frozen=True):
    """Program tokens by index, and the words that occurred in training sentences."""

    tokens: tuple[str, ...]
    words: tuple[str, ...]

    def encode(self, tokens: Iterable[str]) -> list[int]:
        """Indices of tokens. Raises TranslatorError for one that training never showed."""
        index = {token: i for i, token in enumerate(self.tokens)}
        try:
            return [index[token] for token in tokens]
        except KeyError as error:
            raise TranslatorError(f"{error} is not in the vocabulary") from error

    def decode(self, indices: Iterable[int]) -> list[str]:
        """Tokens of indices."""
        return [self.tokens[i] for i in indices]

    def save(self, path: Path) -> None:
        """Write as JSON."""
        path.write_bytes(msgspec.json.format(msgspec.json.encode(self), indent=1) + b"\n")

    @classmethod
    def load(cls, path: Path) -> Vocabulary:
        """Read what `save` wrote."""
        return msgspec.json.decode(path.read_bytes(), type=cls)


def build_vocabulary(programs: Iterable[str], sentences: Iterable[str]) -> Vocabulary:
    """The vocabulary of a training corpus; every noun is in it, whether used or not."""
    seen = {token for body in programs for token in tokenize(body)} | set(NOUNS)
    known = {word for sentence in sentences for word in words_of(sentence)} | set(NOUNS)
    return Vocabulary((*SPECIAL, *sorted(seen - set(SPECIAL))), tuple(sorted(known)))


def words_of(sentence: str) -> list[str]:
    """The lower-case words of a sentence."""
    return _WORD.findall(sentence.lower())
