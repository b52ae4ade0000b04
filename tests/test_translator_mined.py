"""Docstrings and bodies: what is read, what becomes of it, and what is left alone."""

import ast
from importlib.metadata import Distribution, PathDistribution
from pathlib import Path

import pytest

from translator import lessons
from translator.embed import sentence_tokenizer
from translator.lessons import CHUNK, DocstringLessons, Packer
from translator.marked import SLOTS, Mark
from translator.mined import (
    COMMON,
    ELSEWHERE,
    OTHER,
    Pair,
    licence_of,
    mine,
    paired,
    sources,
    summary_of,
)
from translator.translate import WEIGHTS
from translator.vocabulary import build_vocabulary, detokenize, tokenize


def function(source: str) -> ast.FunctionDef:
    (node,) = ast.parse(source).body
    assert isinstance(node, ast.FunctionDef)
    return node


def pair_of(source: str) -> Pair | None:
    node = function(source)
    summary = summary_of(node)
    found = None if summary is None else paired(summary, node)
    return None if found is None else Pair(*found)


def package(folder: Path, metadata: str) -> Distribution:
    info = folder / "thing-1.0.dist-info"
    info.mkdir(exist_ok=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.4\nName: thing\nVersion: 1\n{metadata}\n")
    return PathDistribution(info)


def test_what_a_docstring_names_becomes_slots_in_it_and_in_the_body():
    pair = pair_of(
        'def f(shelf, items, n):\n'
        '    """Put all items into `shelf`, the items first.\n\n    More of it.\n    """\n'
        '    total: int = n\n'
        '    shelf.extend(items)\n'
        '    return shelf, total\n'
    )  # fmt: skip
    assert pair is not None
    assert pair.said.text == "Put all blocks into block, the blocks first."
    assert pair.said.marks == (Mark(8, 14, "g1"), Mark(20, 25, "m1"), Mark(31, 37, "g1"))
    assert pair.body == "v1 = v2\nm1.extend(g1)\nreturn (m1, v1)"


def test_a_name_of_several_words_is_found_where_it_is_spoken_in_words():
    pair = pair_of('def f(old_name):\n    """Forget the old name at once."""\n    drop(old_name)\n')
    assert pair is not None
    assert pair.said.text == "Forget the block at once."
    assert pair.body == "drop(m1)"


def test_an_article_is_no_variable():
    pair = pair_of('def f(a):\n    """Return a copy of it."""\n    return copy(a)\n')
    assert pair is not None
    assert (pair.said.marks, pair.body) == ((), "return copy(v1)")


def test_texts_numbers_and_imports_are_plain():
    pair = pair_of(
        'def f(x):\n    """Say something about x loudly."""\n    import os\n'
        '    say(f"{x} is", "loud", 3, 4096, ...)\n'
    )  # fmt: skip
    assert pair is not None
    assert pair.body == "say(text, text, 3, number, Ellipsis)"


@pytest.mark.parametrize("source", [
    'def f(x):\n    """Do something else."""\n',
    'def f(x):\n    """Too short."""\n    return x\n',
    'def f(x):\n    """Mach etwas für mich."""\n    return x\n',
    'def f(x):\n    """Be done by others."""\n    raise NotImplementedError("by others")\n',
    'def f(x):\n    """Hold one of its own."""\n    def g():\n        return x\n    return g\n',
    "def f(x):\n    return x\n",
])  # fmt: skip
def test_what_says_nothing_of_its_body_is_no_pair(source):
    assert pair_of(source) is None


def test_files_give_each_pair_once_and_uncommon_names_are_one(tmp_path):
    same = 'def f(x):\n    """Return the first of x."""\n    return x[0]\n'
    rare = ('class C:\n    def g(self, x):\n        """Take x for {n} in all."""\n'
            "        while x and x is not None and x > {n}:\n            x = x.odd\n"
            "        return x - 1\n")  # fmt: skip
    braces = 'def h(x):\n    """Return a table of x."""\n    return {x: x}\n'
    texts = [same, same, braces, "def broken(:\n", *(rare.format(n=n) for n in range(COMMON - 1))]
    files = [tmp_path / f"{number}.py" for number in range(len(texts))]
    for file, text in zip(files, texts, strict=True):
        file.write_text(text)
    pairs = mine([*files, tmp_path / "missing.py"])
    assert [pair.said.text for pair in pairs].count("Return the first of block.") == 1
    assert len(pairs) == 1 + COMMON - 1
    assert all(f"while m1 and m1 is not None and (m1 > {n}):\n    m1 = m1.{OTHER}\n" in pair.body
               for n, pair in enumerate(pairs[1:]))  # fmt: skip
    assert not any("odd" in pair.body or "{" in pair.body for pair in pairs)


def test_a_body_reads_the_same_as_symbols():
    pair = pair_of(
        'def f(self, xs, *rest, k=2):\n    """Yield what xs are in turn."""\n'
        "    for x in xs[1:]:\n        if not (x - 1) and k:\n            yield (x, -k, *rest)\n"
        "    with lock as held:\n        return [y for y in rest if y is not held]\n"
    )  # fmt: skip
    assert pair is not None
    tokens = tokenize(pair.body)
    assert tokenize(detokenize(tokens)) == tokens
    assert {"g1", "v1", "<indent>", "<dedent>"} <= set(tokens)


@pytest.mark.parametrize(("metadata", "licence"), [
    ("License-Expression: MIT", "MIT"),
    ("License-Expression: Apache-2.0 OR BSD-2-Clause", "Apache-2.0 OR BSD-2-Clause"),
    ("Classifier: License :: OSI Approved :: BSD License", "BSD"),
    ("License: Apache 2.0", "Apache-2.0"),
    ("License-Expression: MIT AND GPL-3.0-only", None),
    ("License-Expression: MPL-2.0", None),
    ("Classifier: License :: OSI Approved :: MIT License\n"
     "Classifier: License :: OSI Approved :: GNU General Public License v3 (GPLv3)", None),
    ("License: Proprietary", None),
    ("Summary: says nothing", None),
])  # fmt: skip
def test_only_a_permissive_licence_is_one(tmp_path, metadata, licence):
    assert licence_of(package(tmp_path, metadata)) == licence


def test_what_is_read_is_neither_ours_nor_a_copy_of_others():
    found = {source.name.lower(): source for source in sources()}
    assert "python" in found
    assert "armchat" not in found
    assert all(path.suffix == ".py" for source in found.values() for path in source.files)
    assert ELSEWHERE.search("pip/_vendor/certifi/core.py")
    assert ELSEWHERE.search("tests/test_it.py")
    assert not ELSEWHERE.search("textual/widgets/_button.py")


@pytest.fixture
def shelf(monkeypatch):
    """Few pairs in the place of what is installed."""
    sources = [f'def f(x):\n    """Return x times {n}."""\n    return x * {n % 11}\n'
               for n in range(400)]  # fmt: skip
    pairs = [pair for pair in map(pair_of, sources) if pair is not None]
    monkeypatch.setattr(lessons, "_mined", lambda: pairs)
    lessons._docstrings.cache_clear()
    yield pairs
    lessons._docstrings.cache_clear()


def test_lessons_of_docstrings_come_again_and_hold_some_out(shelf):
    course = DocstringLessons(seed=3)
    chunk, valid = course.chunk(0), course.valid()
    assert chunk == course.chunk(0) != course.chunk(1)
    assert 0 < len(valid) < len(chunk) <= CHUNK
    assert len(chunk) + len(valid) == len(shelf)
    assert not {one.text for one in chunk} & {one.text for one in valid}
    assert {one.kind for one in chunk} == {"arrange", "manipulate"}


def test_a_lesson_of_a_docstring_reads_its_slot(shelf):
    lesson = DocstringLessons(seed=3).chunk(0)[0]
    vocabulary = build_vocabulary([one.body for one in shelf], [], 0, "python")
    (batch,) = Packer(sentence_tokenizer(WEIGHTS), vocabulary, 4)([lesson])
    assert set(batch.slots[0].tolist()) == {0, SLOTS.index("m1") + 1}
    assert vocabulary.symbol("m1") in batch.targets[0]
