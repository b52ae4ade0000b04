"""Typing slips: repaired towards one known word, and said (clarifier design, ladder rule 1)."""

from __future__ import annotations

from collections.abc import Iterable

from rapidfuzz.distance import OSA

from clarifier.lexicon import Lexicon
from clarifier.words import Token, number, plural, singular, stems, tokenise

REPAIR_AT = 0.80
"""Least 1 - edits / length at which a word is taken for another."""
RIVAL_AT = 0.75
"""A second word this close makes the slip ambiguous: nothing is repaired."""
MIN_LENGTH = 4
"""Shorter words are too easily one another."""


def repair(text: str, names: Iterable[str], lexicon: Lexicon) -> tuple[str, str]:
    """The text with slips repaired, and the sentence that says so ("" for none).

    ``names`` are the words of the scene's names.
    """
    scene_words = frozenset(names)
    known = scene_words | lexicon.vocabulary
    result, said = text, []
    for token in reversed(tokenise(text)):
        if is_known(token, known, lexicon):
            continue
        right = closest(token.text, scene_words, known)
        if right is not None:
            result = result[: token.start] + right + result[token.end :]
            said.append(f"I read “{token.text}” as “{right}”.")
    return result, " ".join(reversed(said))


def is_known(token: Token, known: frozenset[str], lexicon: Lexicon) -> bool:
    """Whether a token is a word as it stands, or too short or odd to be repaired."""
    word = token.text.removesuffix("'s")
    if len(word) < MIN_LENGTH or not word.isalpha() or number(word) is not None:
        return True
    forms = {word, singular(word), *stems(word)}
    return bool(forms & known) or bool(forms & lexicon.not_typos)


def closest(word: str, scene_words: frozenset[str], known: frozenset[str]) -> str | None:
    """The one word that ``word`` must be a slip of; words of the scene win over others."""
    many = {plural(name): name for name in known} | {name: name for name in known}
    scores: dict[str, tuple[float, str]] = {}
    for form, base in many.items():
        if len(form) >= MIN_LENGTH and abs(len(form) - len(word)) <= 2:
            score = OSA.normalized_similarity(word, form, score_cutoff=RIVAL_AT)
            if score and score > scores.get(base, (0.0, ""))[0]:
                scores[base] = (score, form)
    sure = {base: hit for base, hit in scores.items() if hit[0] >= REPAIR_AT - 1e-9}
    if not sure:
        return None
    best = min(sure, key=lambda base: (base not in scene_words, -sure[base][0]))
    rivals = [base for base in scores if base != best]
    if best in scene_words:
        rivals = [base for base in rivals if base in scene_words]
    return None if rivals else sure[best][1]
