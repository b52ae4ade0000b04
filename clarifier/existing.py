"""Whether there is something, and how many: "there are more than two vials on the bench"."""

from __future__ import annotations

import re

from clarifier.ask import labels
from clarifier.comparing import denied
from clarifier.lexicon import Lexicon
from clarifier.named import Fact, Predicate
from clarifier.predicates import Predicates
from clarifier.words import article, number, number_word, plural, singular, tokenise, words
from scene.types import Scene

_THERE = re.compile(
    r"^(?:(?:there|their)(?:'s|s| is| are|'re| be| was| were| happens? to be| exists?| sits| lies|"
    r" stands)(?: still| already| currently| now| also)?|(?:is|are) there(?: still| already)?|"
    r"(?:i|we|you)(?:'ve got| have got| have|'ve| got)|(?:can |do |could )?you (?:can |do |"
    r"still )?(?:see|find|spot)|(?:do|have) (?:we|you|i) (?:have|got)) (?P<not>not |"
    r"n't )?(?P<rest>.+)$"
)
_NOT_THERE = re.compile(r"^there(?: is| are)(?:n't| not| no longer) (?P<rest>.+)$")
_MANY = re.compile(
    r"^(?:(?P<how>more than|over|at least|fewer than|less than|under|at most|no more than|exactly|"
    r"only|just) )?(?P<n>\w+)(?P<more> or more| or fewer| or less)? (?P<what>.+)$"
)
_QUANTITY = re.compile(r"^(?P<q>no|not any|an?|any|some|another|a single|only one|just one|"
                       r"just the one|only the one|the) (?P<what>.+)$")  # fmt: skip
_HERE = re.compile(
    r" (?:around|here|there|left|anywhere|somewhere|lying about|lying around|about|to be seen|"
    r"in sight|present|available|on show)$"
)
BEARING = re.compile(
    r"^(?P<what>something|anything|nothing|things|stuff)(?: else)?(?: already|"
    r" still)? (?:(?:lying|standing|sitting) )?(?P<where>.+)$"
)
"""What something holds."""
_MORE_THAN = re.compile(
    r"^(?P<how>more|fewer|less|as many) (?P<one>.+?) (?:than|as) "
    r"(?:there are )?(?P<other>(?!one\b|two\b|three\b|four\b|five\b|\d).+)$"
)
_BARE = re.compile(
    r"^(?:(?:only|just|exactly|at least|at most|more than|fewer than|less than) )?(?:the )?"
    r"(?:one|two|three|four|five|six|\d+)(?: or more| or fewer)?(?: of them)?$"
)


class Existing:
    """Reads clauses that say what is there."""

    def __init__(
        self, scene: Scene, lexicon: Lexicon, read: Predicates, kind: str = ""
    ) -> None:  # fmt: skip
        """``kind``: what was counted before: in "if there is only one", one of what."""
        self._kind = kind
        self._scene = scene
        self._lexicon = lexicon
        self._read = read

    def fact(self, said: str) -> Fact | None:
        absent = _NOT_THERE.match(said)
        match = absent or _THERE.match(said)
        rest = match["rest"] if match is not None else ""
        if match is None and re.match(r"any(?:one)? (?!of\b)", said):
            rest = said
        rest = _HERE.sub("", rest)
        if not rest:
            return None
        negated = absent is not None or bool(match is not None and match["not"])
        bare = _BARE.match(rest) if self._kind else None
        rest = f"{rest.removesuffix(' of them')} {self._kind}" if bare is not None else rest
        found = (
            self._bearing(rest) or self._compared(rest) or self._counted(rest) or self._any(rest)
        )
        if found is None or not negated:
            return found
        return found._replace(holds=denied(found.holds), negative=True)

    def _bearing(self, rest: str) -> Fact | None:
        """ "Something on it", "nothing in the bowl"."""
        match = BEARING.match(rest)
        test = self._read.read(match["where"]) if match is not None else None
        if match is None or test is None or not test.where or not test.others:
            return None
        found = tuple(one.id for one in self._scene if one.id not in test.others and test.test(one))
        holds = bool(found) is (match["what"] != "nothing")
        some = "something" if found else "nothing"
        where = re.sub(r"\b(?:it|them|there)$", self._label(test.others[0]), test.where)
        said = f"There is {some} {where}."
        negative = match["what"] == "nothing"
        return Fact(holds, test.others, "", found, test.where, said, negative)

    def _compared(self, rest: str) -> Fact | None:
        """ "More cups than plates", "as many cups as plates"."""
        match = _MORE_THAN.match(rest)
        one, other = (
            (self._those(match[name]) for name in ("one", "other")) if match else (None, None)
        )
        if match is None or one is None or other is None:
            return None
        n, m = len(one[0].about), len(other[0].about)
        holds = {"more": n > m, "fewer": n < m, "less": n < m, "as many": n == m}[match["how"]]
        said = f"{one[0].said.rstrip('.')} and {other[0].said.removeprefix('There ')}"
        return one[0]._replace(
            holds=holds,
            others=other[0].about,
            said=re.sub(
                r"^There (?:is|are) ", "There are ", re.sub(r" and (?:is|are) ", " and ", said)
            ),
        )

    def _counted(self, rest: str) -> Fact | None:
        match = _MANY.match(rest)
        if match is None:
            return None
        count = number(match["n"])
        count = {"a": 1.0, "couple": 2.0}.get(match["n"], count) if match["how"] else count
        those = self._those(match["what"]) if count is not None else None
        if those is None or count is None:
            return None
        found, _ = those
        how, n = (match["how"] or "") + (match["more"] or ""), len(found.about)
        tests = {
            "more than": n > count, "over": n > count, "at least": n >= count,
            " or more": n >= count, "fewer than": n < count, "less than": n < count,
            "under": n < count, "at most": n <= count, "no more than": n <= count,
            " or fewer": n <= count, " or less": n <= count, "exactly": n == count,
            "only": n == count, "just": n == count,
            "": n == count or (None if n > count else False),
        }  # fmt: skip
        return found._replace(holds=tests.get(how))

    def _any(self, rest: str) -> Fact | None:
        match = _QUANTITY.match(rest)
        if match is not None and match["q"] in ("another", "the"):
            return None
        those = self._those(match["what"] if match is not None else rest)
        if those is None:
            return None
        found, noun = those
        quantity = match["q"] if match is not None else ""
        n = len(found.about)
        if quantity in ("no", "not any"):
            return found._replace(holds=n == 0, negative=True)
        if quantity in ("only one", "just one", "a single", "just the one", "only the one"):
            return found._replace(holds=n == 1)
        kind = match["what"] if match is not None else rest
        many = quantity in ("any", "some", "") and singular(noun.split()[-1]) != noun.split()[-1]
        return found._replace(holds=n > 0, name=found.name if many or n == 1 else article(kind))

    def _label(self, object_id: str) -> str:
        return labels((object_id,), self._scene, self._lexicon)[object_id]

    def _those(self, what: str) -> tuple[Fact, str] | None:
        """The things of a kind, of a place where one is said behind it."""
        places: list[tuple[str, Predicate | None]] = []
        for token in tokenise(what)[1:]:
            test = self._read.read(what[token.start :])
            if test is not None:
                places.append((what[: token.start].strip(), test))
        places.append((what, None))
        for noun, test in places:
            noun = re.sub(
                r" (?:that|which|who)(?: is| are)?$| (?:lying|standing|sitting)$", "", noun
            )
            named = self._read.named(f"all the {noun}") if noun and noun not in ("room",) else None
            if named is None or not self._is_noun(noun):
                continue
            answers = [True if test is None else test.test(self._scene.get(one))
                       for one in named.objects]  # fmt: skip
            if None in answers:
                return None
            found = tuple(o for o, yes in zip(named.objects, answers, strict=True) if yes)
            where = f" {test.where}" if test is not None and test.where else ""
            many = plural(singular(head)) if (head := noun.split()[-1]) and len(found) != 1 else ""
            kind = f"{noun.removesuffix(head)}{many or singular(head)}"
            count = "is one" if len(found) == 1 else f"are {number_word(len(found))}"
            said = f"There {count if found else 'are no'} {kind}{where}."
            name = f"the {kind}" if found == named.objects else f"the {what.replace(noun, kind)}"
            name = f"the {noun}" if not found else name
            name = "" if len(found) == 1 and found != named.objects else name
            others = test.others if test is not None else ()
            return Fact(True, found, name, others, "", said, kind=noun), noun
        return None

    def _is_noun(self, noun: str) -> bool:
        """Whether the words end with a noun for things: "room" and "time" are none."""
        head = words(noun)[-1] if words(noun) else ""
        named = {part for item in self._scene for part in words(item.name)}
        if head in self._lexicon.abstract and head not in named:
            return False
        forms = {head, singular(head)}
        return bool(forms & named) or any(self._lexicon.is_noun(form) for form in forms)
