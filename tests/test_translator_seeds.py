"""Seeds: each proves itself; what the loader refuses; what the generator makes of them."""

import random
import re
from itertools import islice

import pytest

from agent.errors import ConfigError
from evals.grown import program, request
from evals.seed_proof import prove
from translator.chain import remembered
from translator.corpus.generate import Generator
from translator.corpus.seed import SEEDS, canonical, kept, load_seeds
from translator.grammar import Grammar
from translator.marked import PLACEHOLDERS, SLOTS, Mark, marked, read, slot_ids
from translator.vocabulary import END, build_vocabulary, tokenize

SCENES = 2
"""A sample of what `python -m evals.seed_proof` does with twenty."""


@pytest.fixture(scope="module")
def seeds():
    return load_seeds()


@pytest.fixture(scope="module")
def grown(seeds):
    return list(islice(Generator(kept(seeds, held_out=False), random.Random(7)), 3000))


# --- the corpus ----------------------------------------------------------------------------------


def test_there_are_as_many_seeds_as_there_are_families_to_cover(seeds):
    pairs = {canonical(say, seed.program) for seed in seeds for say in seed.say}
    assert len(seeds) >= 600 and len(pairs) >= 6000
    assert len({seed.family for seed in seeds}) >= 30


@pytest.mark.parametrize("path", sorted(SEEDS.glob("*.toml")), ids=lambda path: path.stem)
def test_every_seed_proves_itself(path, tmp_path, executor):
    (tmp_path / path.name).write_bytes(path.read_bytes())
    faults = [
        fault
        for seed in load_seeds(tmp_path)
        for kind in (("manipulate", "arrange") if seed.kind == "both" else (seed.kind,))
        for fault in prove(seed, kind, executor, SCENES)
    ]
    assert faults == []


SEED = """
[[seed]]
id = "one"
family = "f"
program = "put(a, left_of(a, b))"
after = ["left_of a b"]
say = ["put {a} left of {b}"]
"""


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("{b}", "{c}"), "does not name exactly"),
        (("left of {b}", "left of {b} {"), "does not name exactly"),
        (("{a} left", "it left"), "what the program speaks of"),
        (("after", "afters"), "afters"),
        (("[[seed]]", "[seed]"), "one.toml"),
    ],
)
def test_what_the_loader_refuses(tmp_path, change, words):
    more = SEED.replace('"one"', '"two"').replace("put {a}", "set {a}")
    text = SEED.replace(*change) if change[0] != "{b}" else SEED + more.replace(
        '"]', '", "left of {b} goes {c}"]')  # fmt: skip
    (tmp_path / "one.toml").write_text(text)
    with pytest.raises(ConfigError, match=re.escape(words)):
        load_seeds(tmp_path)


def test_other_hands_add_wordings_by_the_id_of_the_meaning(tmp_path):
    seeds, wordings = tmp_path / "seeds", tmp_path / "wordings"
    seeds.mkdir()
    wordings.mkdir()
    (seeds / "one.toml").write_text(SEED)
    (wordings / "more.toml").write_text('one = ["{b}, and left of it {a}"]')
    assert load_seeds(seeds)[0].say == ("put {a} left of {b}", "{b}, and left of it {a}")


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ('two = ["{a} by {b}"]', "more.toml: there is no seed two"),
        ('one = ["{a} on its own"]', "does not name exactly"),
        ("one = 3", "more.toml"),
    ],
)
def test_what_is_refused_of_added_wordings(tmp_path, more, words):
    seeds, wordings = tmp_path / "seeds", tmp_path / "wordings"
    seeds.mkdir()
    wordings.mkdir()
    (seeds / "one.toml").write_text(SEED)
    (wordings / "more.toml").write_text(more)
    with pytest.raises(ConfigError, match=re.escape(words)):
        load_seeds(seeds)


def test_one_wording_cannot_mean_two_things(tmp_path):
    other = SEED.replace('"one"', '"two"').replace("left_of(a, b)", "right_of(a, b)")
    (tmp_path / "one.toml").write_text(SEED + other)
    with pytest.raises(ConfigError, match="means another thing in one"):
        load_seeds(tmp_path)


def test_held_out_wordings_are_held_out(seeds):
    train = {(s.id, say) for s in kept(seeds, held_out=False) for say in s.say}
    test = {(s.id, say) for s in kept(seeds, held_out=True) for say in s.say}
    assert not train & test
    assert len(train) + len(test) == sum(len(seed.say) for seed in seeds)
    assert 0.03 < len(test) / len(train) < 0.07


# --- what grows ----------------------------------------------------------------------------------


def test_the_same_chance_grows_the_same_sentences(seeds, grown):
    again = Generator(kept(seeds, held_out=False), random.Random(7))
    assert list(islice(again, 50)) == grown[:50]


def test_hardly_two_sentences_are_alike(grown):
    assert len({(one.sentence.text, one.program) for one in grown}) > 0.97 * len(grown)


def test_a_program_speaks_of_what_is_marked_in_its_sentence(grown):
    for one in grown:
        used = set(re.findall(r"\b[mgdtn]\d\b", one.program))
        assert used <= {mark.slot for mark in one.sentence.marks}, one


def test_marks_stand_where_the_placeholders_are(grown):
    for one in grown[:500]:
        for start, end, slot in one.sentence.marks:
            assert one.sentence.text[start:end] == PLACEHOLDERS[slot[0]]


def test_the_grammar_derives_every_program_that_grows(grown):
    vocabulary = build_vocabulary([one.program for one in grown], ["x"], 120, "skills")
    grammar = Grammar(vocabulary)
    for one in grown:
        usable, prefix = grammar.usable(one.kind, set(SLOTS)), grammar.start()
        for index in (*vocabulary.encode(tokenize(one.program)), vocabulary.symbol(END)):
            assert usable[index], one.program
            prefix = grammar.extend(prefix, index)
            assert prefix is not None, one.program


def test_later_phrases_mean_things_where_they_are_by_then():
    first, second = "put(m1, left_of(m1, m2))", "put(m3, next_to(m3, m1))"
    assert remembered([first, second]) == f"w1 = {first}\nput(m3, next_to(m3, w1))"
    assert remembered([first, "pick(m3)"]) == f"{first}\npick(m3)"
    moved = "moved = put(m1, [0, 0])\nput(m2, left_of(m2, moved))"
    assert remembered([moved]) == moved.replace("moved", "w1")
    swapped = "spot = where(m1)\nput(m1, free_place(m1))\nput(m2, spot)"
    assert remembered([swapped]) == swapped
    chain = remembered([first, "push(m1, [0, 0])", "touch(m1)"])
    assert chain.split("\n")[1:] == ["w1 = push(w1, [0, 0])", "touch(w1)"]


def test_texts_keep_their_words():
    out = remembered(['near = put(m1, corner(m1, "left", "near"))\ntouch(near)'])
    assert out == 'w1 = put(m1, corner(m1, "left", "near"))\ntouch(w1)'


def test_a_sample_asks_as_the_linker_would(grown):
    for one in grown[:300]:
        asked = request(one)
        sentence, names = read(asked)
        assert sentence == one.sentence
        assert set(re.findall(r"\b[mdtn]\d\b", program(one))) <= set(names.values())


# --- marks ---------------------------------------------------------------------------------------


def test_what_is_marked_gives_way_to_its_placeholder():
    text = "put the red star 7 inches left of both flurbles"
    marks = [Mark(8, 16, "m1"), Mark(17, 25, "d1"), Mark(39, 47, "g2"), Mark(12, 16, "m3")]
    found = marked(text, marks)
    assert found.text == "put the block 10 cm left of both blocks"
    assert [(found.text[a:b], slot) for a, b, slot in found.marks] == [
        ("block", "m1"), ("10 cm", "d1"), ("blocks", "g2")
    ]  # fmt: skip


def test_each_word_piece_knows_its_slot():
    found = marked("put apple on cup", [Mark(4, 9, "m1"), Mark(13, 16, "m2")])
    offsets = [(0, 0), (0, 3), (4, 9), (10, 12), (13, 18), (0, 0)]
    ids = slot_ids(offsets, found.marks)
    assert ids == [0, 0, SLOTS.index("m1") + 1, 0, SLOTS.index("m2") + 1, 0]
