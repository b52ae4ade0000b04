"""Typing slips: repaired towards one known word, and said (clarifier design, ladder rule 1).

A word of English is never a slip, whatever stands on the table. What is left may be written without
its vowels (`clipped`): a word of the scene, else one that commands are made of, else of the
dictionary. What is left of that may be a slip of

1. a word of the scene (names and colours), its letters swapped ("bule", where something is blue),
2. a small word or a verb, its letters swapped ("teh"),
3. a word of the scene, one letter off, two in a long word,
4. any known word, its letters swapped,
5. a word that commands are made of, close to it ("cornr": no corn stands there),
6. any known word, close to it,
7. a word that commands are made of, one letter left out;

the first of these that has words decides, and only if it has no more than one. What is a thing's
name, or takes guessing, is said; small words and words without their vowels are not.
"""

from __future__ import annotations

import gzip
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache, partial
from importlib.resources import files

import msgspec
from rapidfuzz.distance import OSA

from clarifier import clipped
from clarifier.lexicon import Lexicon
from clarifier.pieces import COUNTS
from clarifier.words import Token, number, plural, singular, stems, tokenise, words
from clarifier.written import apart, pairs, plainly

USUAL = 100
"""How often the dictionary of pyspellchecker must have met a word that is no slip."""
REPAIR_AT = 0.80
"""Least 1 - edits / length at which a word is taken for another."""
SCENE_REPAIR_AT = 0.75
"""The same for words of the scene; of three letters one may be wrong."""
MIN_LENGTH = 3
"""Shorter words are too easily one another."""
Nearness = Callable[[str, str], int]
"""Edits from a word to a form that it may be a slip of; 0: it is none."""
_COMMAND_LISTS = (
    "polite", "directions", "pointing", "angles", "shades", "big", "small", "tall", "short", "wide",
    "narrow", "left", "right", "far", "near", "middle", "ordinals", "vague",
)  # fmt: skip
_AMOUNTS = ("both", "half", "each", "every", "another", "others", "remaining")
_CHATTER = frozenset(
    {"pls", "plz", "thx", "lol", "kay", "btw", "thru", "tho", "gotta", "lemme", "gimme", "sorta"}
    | {"dunno", "yep", "nah", "haha", "omg", "asap", "aka", "cos", "coz", "cuz", "til", "hmm"}
    | {"wanna", "gonna", "kinda", "yeah", "yup", "yay", "wow", "hey", "ugh", "umm", "erm", "etc"}
    | {"hm", "mm", "mhm", "shh", "sh", "psst", "pst", "pfft", "tsk", "brr", "grr", "phew", "pff"}
)
"""What people write in chats: no slips either."""
_REPEATED = re.compile(r"(.)\1+")
_OPENING = frozenset(
    {".", ",", ";", ":", "!", "?", "and", "then", "please", "pls", "plz", "you", "now"}
)
"""Behind these a verb is likely."""


def repair(text: str, names: Iterable[str], lexicon: Lexicon) -> tuple[str, str]:
    """The text with slips repaired, and the sentence that says so ("" for none).

    ``names`` are the names of the scene's objects and their colours.
    """
    names = list(names)
    scene_words = frozenset(word for name in names for word in words(name))
    joined = frozenset(map("".join, pairs(names)))
    known = scene_words | lexicon.vocabulary
    stands = partial(is_known, known=known)
    result, said = plainly(text, names, stands, lexicon), []
    tokens = tokenise(result)
    for at in reversed(range(len(tokens))):
        token = tokens[at]
        full = None if token.text in known else _with_vowels(tokens, at, scene_words, lexicon)
        right = full
        if full is None and not stands(token):
            right = closest(token.text, scene_words | joined, lexicon)
        if right is None:
            continue
        named = {right, singular(right)} & (scene_words | joined) - lexicon.colors
        right = apart(right, names)
        result = result[: token.start] + right + result[token.end :]
        if named or (full is None and right not in lexicon.words("grammar")):
            said.append(f"I read “{token.text}” as “{right}”.")
    return result, " ".join(reversed(said))


def _with_vowels(
    tokens: Sequence[Token], at: int, scene_words: frozenset[str], lexicon: Lexicon
) -> str | None:
    """The word that a token is without its vowels; None where it is none, or might be several."""
    word, met = tokens[at].text, _met()
    once = _REPEATED.sub(r"\1", word)
    if word in met or {word, once} & _CHATTER or not word.isalpha() or len(word) < 2:
        return None
    named = clipped.nearest(word, _forms(scene_words))
    if named and (len(word) > 2 or clipped.is_clipped(word)):
        return named[0] if len(named) == 1 else None
    if _nearest(word, _grammar_forms(lexicon), _swapped):
        return None
    found = clipped.nearest(word, _command_forms(lexicon))
    if not clipped.is_clipped(word):
        sure = len(found) == 1 and len(found[0]) == len(word) + 1 > MIN_LENGTH + 2
        return found[0] if sure else None
    opens = at == 0 or tokens[at - 1].text in _OPENING
    verbs = [form for form in found if (form in lexicon.base_verbs) == opens]
    if "than" in found and at and tokens[at - 1].text.endswith(("r", "re", "ss")):
        return "than"
    verbs = [form for form in verbs if form != "than"]
    return clipped.usual(verbs or found, met) or clipped.in_dictionary(word, met)


def is_known(token: Token, known: frozenset[str]) -> bool:
    """Whether a token is a word as it stands, or too short or odd to be repaired."""
    word = token.text.removesuffix("'s")
    if len(word) < MIN_LENGTH or not word.isalpha() or number(word) is not None:
        return True
    forms = {word, singular(word), *stems(word)}
    return any(not forms.isdisjoint(some) for some in (known, english(), _CHATTER))


@lru_cache(maxsize=1)
def english() -> frozenset[str]:
    """Words of English that are no slips: those that pyspellchecker's dictionary has met often."""
    return frozenset(_met())


@lru_cache(maxsize=1)
def _met() -> Mapping[str, int]:
    """How often that dictionary has met each of these words."""
    packed = files("spellchecker").joinpath("resources", "en.json.gz").read_bytes()
    met = msgspec.json.decode(gzip.decompress(packed), type=dict[str, int])
    return {word: times for word, times in met.items() if times >= USUAL}


def closest(word: str, scene_words: frozenset[str], lexicon: Lexicon) -> str | None:
    """The one word that ``word`` must be a slip of, in the number that fits best."""
    scene, every, commands = _forms(scene_words), _known_forms(lexicon), _command_forms(lexicon)
    steps: tuple[tuple[Mapping[str, str], Nearness], ...] = (
        (scene, _swapped), (_grammar_forms(lexicon), _swapped), (scene, _one_off),
        (every, _swapped), (commands, _close), (every, _close), (commands, _left_out),
    )  # fmt: skip
    for forms, nearness in steps:
        bases = _nearest(word, forms, nearness)
        if bases:
            return next(iter(bases.values())) if len(bases) == 1 else None
    return None


def _nearest(word: str, forms: Mapping[str, str], nearness: Nearness) -> dict[str, str]:
    """The base words fewest edits away, each with its nearest form, the base before its plural."""
    best: dict[str, tuple[int, bool, str]] = {}
    for form, base in forms.items():
        if abs(len(form) - len(word)) <= 2 and (edits := nearness(word, form)):
            fit = (edits, form != base, form)
            best[base] = min(best.get(base, fit), fit)
    fewest = min((edits for edits, _, _ in best.values()), default=0)
    return {base: form for base, (edits, _, form) in best.items() if edits == fewest}


def _swapped(word: str, form: str) -> int:
    """1 if two neighbouring letters changed places."""
    same = len(word) == len(form) and sorted(word) == sorted(form)
    return 1 if same and OSA.distance(word, form) == 1 else 0


def _one_off(word: str, form: str) -> int:
    """One edit; in long words as many as `SCENE_REPAIR_AT` allows."""
    edits: int = OSA.distance(word, form)
    alike = 1 - edits / max(len(word), len(form)) >= SCENE_REPAIR_AT
    return edits if len(form) >= MIN_LENGTH and (edits == 1 or alike) else 0


def _close(word: str, form: str) -> int:
    """As many edits as `REPAIR_AT` allows."""
    edits: int = OSA.distance(word, form)
    return edits if 1 - edits / max(len(word), len(form)) >= REPAIR_AT - 1e-9 else 0


def _left_out(word: str, form: str) -> int:
    """1 if a letter was left out, the first one apart."""
    missing = len(form) == len(word) + 1 and form[0] == word[0]
    return 1 if missing and OSA.distance(word, form) == 1 else 0


def _forms(bases: Iterable[str]) -> dict[str, str]:
    """Every form of the words, and the word it is a form of."""
    known = list(bases)
    return {plural(base): base for base in known} | {base: base for base in known}


@lru_cache(maxsize=2)
def _known_forms(lexicon: Lexicon) -> dict[str, str]:
    return _forms(lexicon.vocabulary)


@lru_cache(maxsize=2)
def _grammar_forms(lexicon: Lexicon) -> dict[str, str]:
    """Words that any sentence may hold."""
    relations = (word for run, _ in lexicon.relations for word in run)
    return {word: word for word in (*lexicon.words("grammar"), *relations, *lexicon.base_verbs)}


@lru_cache(maxsize=2)
def _command_forms(lexicon: Lexicon) -> dict[str, str]:
    """Words that commands are made of whatever stands on the table: no names of things."""
    places = lexicon.place_heads | lexicon.place_adjectives | lexicon.abstract | lexicon.colors
    listed = (word for name in _COMMAND_LISTS for word in lexicon.words(name))
    return _forms((*_grammar_forms(lexicon), *places, *listed, *COUNTS, *_AMOUNTS))
