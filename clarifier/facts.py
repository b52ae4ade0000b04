"""Whether what a clause says is so on the scene: "the jug is taller than the vase", "there are more
than two vials on the bench". The same reading answers a person's questions and their conditions.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.comparing import denied, every
from clarifier.existing import BEARING, Existing
from clarifier.lexicon import Lexicon
from clarifier.named import IT, Fact, Named, Predicate
from clarifier.predicates import Predicates
from clarifier.words import listing, plural, singular, tokenise, words
from scene.types import Scene

_BE = (r"(?:is|are|was|isn't|aren't|wasn't|be|being|sits?|stands?|lies|lie|happens? to be|"
       r"has been|have been|appears? to be|seems? to be|turns? out to be|looks?|seems?|remains?|"
       r"stays?)")  # fmt: skip
_COPULA = re.compile(rf"\s+(?P<be>{_BE})(?P<not> not| n't|n't| no longer)?\s+")
_INVERTED = re.compile(r"^(?P<be>is|are|isn't|aren't|was|were)\s+(?P<not>not )?(?P<rest>.+)$")
_HAS = re.compile(
    r"\s+(?P<not>(?:does not|doesn't|do not|don't|has no longer|no longer) )?(?:has|have|"
    r"contains?|holds?|carries|carry|touch|(?:has|have) got|'ve got) "
)
_QUANTIFIED = re.compile(
    r"^(?:(?P<of>any|one|some|none|all|both|each|every one|neither|"
    r"either)(?: one)? of (?P<these>.+)|(?P<each>neither|either|no|any|each|every) (?P<kind>.+))$"
)
_SPOKEN = {"any": "one of", "some": "one of", "either": "one of", "no": "none of", "each": "all",
           "every": "all", "neither": "none of", "none": "none of", "one": "one of", "all": "all",
           "both": "both", "every one": "all"}  # fmt: skip
_CONTRARY = {"one of": "none of", "none of": "one of", "all": "not all", "both": "not both"}
_UPON_IT = re.compile(r" (?:on|in|inside|upon)(?: (?:it|top|them|there))?(?: already)?$")
_ALIKE = re.compile(r"^(?P<what>.+?) (?P<be>are|is|are not|aren't) (?:all |both |of )*the same "
                    r"(?P<how>size|height|width|length|colou?r)(?: as each other)?$")  # fmt: skip
_CONTRACTED = re.compile(r"(?<=\w)'(?P<be>s|re)(?= )")
_NOUN = {"tall": "height", "high": "height", "wide": "width", "long": "length", "big": "size",
         "large": "size"}  # fmt: skip
_Plain = str | Callable[[re.Match[str]], str]
_TURNS: tuple[tuple[str, _Plain], ...] = (
    (r"\btheres\b", "there's"), (r"\bisnt\b", "isn't"), (r"\barent\b", "aren't"),
    (r"\bdoesnt\b", "doesn't"),
    (r"\bits\b(?= (?:not|on|in|at|still|already|near|next)\b)", "it's"),
    (r"^(?:that|whether|if|it(?:'s| is) true that|it (?:so happens|turns out|happens)(?: that)?|"
     r"by (?:any )?chance|perhaps|maybe) ", ""),
    # "you find that the cup is empty"
    (r"^(?:you (?:can |do )?|i |we )?(?:find|see|notice|think|believe|say)(?: that)? "
     r"(?=(?:the|there|it|my|both|all)\b)", ""),
    # "the cup is red, isn't it"
    (r",? (?:isn't|aren't|is|are|doesn't|does|right) (?:it|they|he|she|there)$", ""),
    # "the cup, is it red", "is it the cup that is red", "does the cup have nothing in it"
    (r"^(?P<what>(?:the|my|that|this|both|all) [^,]+), (?P<be>is|are) (?:it|they|he|she) ",
     r"\g<be> \g<what> "),
    (r"^is it (?P<what>.+?) (?:that|which|who)(?: is|'s|(?= has)) ?", r"\g<what> is "),
    (r"^(?:does|do) (?P<what>.+?) (?=(?:have|hold|contain|touch)\b)", r"\g<what> "),
    (r"\b(?:are|is) (?:both )?equally (?P<how>tall|high|wide|long|big|large)$",
     lambda said: f"are the same {_NOUN[said['how']]}"),
    (r"\bare (?:of )?different (?P<how>size|height|width|length|colou?r)s$",
     r"are not the same \g<how>"),
)  # fmt: skip
"""Turns of phrase, and what they are read as."""
_READ = tuple((re.compile(turn), plain) for turn, plain in _TURNS)


class Facts:
    """Reads clauses over one scene. ``it``: what "it" stands for, else the focus settles it."""

    def __init__(
        self, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon, it: tuple[str, ...] = (),
        beside: tuple[str, ...] = (), kind: str = "",
    ) -> None:  # fmt: skip
        """``beside``: what else was spoken of: in "if it is left of it", the second."""
        self._beside = beside
        self._kind = kind
        recent = (focus[0].object,) if focus and not it else it
        self._scene = scene
        self._lexicon = lexicon
        self._read = Predicates(scene, lexicon, recent)

    def fact(self, clause: str) -> Fact | None:
        """Whether a clause is so; None where it cannot be read to its last word."""
        said = re.sub(r"\s+", " ", clause.replace("’", "'").strip(' ,.;:!?"').lower())
        for turn, plain in _READ:
            said = turn.sub(plain, said)
        return self._one(said) or self._joined(said) if said else None

    def _one(self, said: str) -> Fact | None:
        there = Existing(self._scene, self._lexicon, self._read, self._kind).fact(said)
        if there is not None:
            return there
        found = list(self._readings(said)) or self._alike(said)
        truths = {fact.holds for fact in found}
        if not found or len(truths) > 1:
            return None
        return found[0]

    def _joined(self, said: str) -> Fact | None:
        """ "The cup is red and on the plate", "the cup is red or the plate is empty"."""
        for joint in (" and ", " or ", " but "):
            for match in re.finditer(joint, said):
                one, rest = said[: match.start()], said[match.end() :].removeprefix("that ")
                first = self._one(one.strip(" ,"))
                if first is None:
                    continue
                beside = first.others if len(first.others) == 1 else ()
                also = Facts(self._scene, (), self._lexicon, first.about, beside)
                bare = self._read.named(rest) is not None  # "taller than the cup or the jug"
                second = None if bare else also.fact(rest) or also.fact(f"it is {rest}")
                if bare and first.kind:  # "there is an orange and a lemon"
                    second = also.fact(f"there is {rest}")
                if second is None:
                    continue
                pair = (first.holds, second.holds)
                holds = every(pair)
                if joint == " or ":
                    holds = denied(every(denied(one) for one in pair))
                others = tuple(dict.fromkeys((*first.others, *second.others, *second.about)))
                others = tuple(one for one in others if one not in first.about)
                text = f"{first.said.rstrip('.')}, and {_low(second.said)}"
                return Fact(holds, first.about, first.name, others, second.where, text)
        return None

    # --- "the jug is taller than the vase" ---------------------------------------------------

    def _alike(self, said: str) -> list[Fact]:
        """ "The mugs are the same colour": each as the first of them."""
        match = _ALIKE.match(re.sub(r"\b(they)'re ", r"\1 are ", said))
        named = self._read.named(match["what"]) if match is not None else None
        objects = named.objects if named is not None else ()
        objects = (*objects, *self._beside) if len(objects) == 1 else objects
        if match is None or len(objects) < 2:
            return []
        first, rest = self._label(objects[0]), objects[1:]
        test = self._read.read(f"the same {match['how']} as {first}")
        if test is None:
            return []
        holds = every(test.test(self._scene.get(one)) for one in rest)
        true, negative = holds is not False, "n" in match["be"].removeprefix("are")
        these = listing(self._label(one) for one in objects)
        same = f"{these} are {'' if true else 'not '}the same {match['how']}"
        holds = denied(holds) if negative else holds
        return [Fact(holds, objects, "", (), "", _stated(same), negative)]

    def _readings(self, said: str) -> Iterator[Fact]:
        """Every way of parting a clause into what it speaks of and what it says of it."""
        for subject, predicate, negated in self._parts(said):
            quantified = _QUANTIFIED.match(subject)
            quantifier = quantified and (quantified["of"] or quantified["each"])
            these = subject
            either = re.match(r"^(?:(?P<not>neither)|either)? ?(?P<these>.+? n?or .+)$", subject)
            if either is not None:
                these = re.sub(r" n?or ", " and ", either["these"])
                quantifier = "neither" if either["not"] else "any"
            elif quantified is not None:
                kind = plural(singular(quantified["kind"] or ""))
                these = quantified["these"] or f"the {kind}"
            every_one = quantifier is not None and either is None
            named = self._read.named(f"all {these}" if every_one else these)
            if named is None and subject in _SPOKEN and len(self._read.it) > 1:
                named, quantifier = Named(self._read.it, True), subject  # "if one is red"
            if named is None or not named.objects:
                continue
            told = self._own_kind(predicate, named)
            for read in self._readers(subject, predicate):
                test = read.read(told) or read.read(predicate) or self._than(predicate)
                fact = test and self._of(these, named, quantifier, test, predicate, negated)
                if fact:
                    yield fact

    def _readers(self, subject: str, predicate: str) -> list[Predicates]:
        """What "it" can mean behind the subject: in "it is left of it", "the cup is left of it"."""
        pointed = self._beside and re.search(r"\b(?:it|them)\b", predicate)
        if not pointed:
            return [self._read]
        beside = Predicates(self._scene, self._lexicon, self._beside)
        return [beside] if subject in IT else [beside, self._read]

    def _than(self, predicate: str) -> Predicate | None:
        """ "If it is shorter": than what it was held to before."""
        if len(self._beside) != 1 or not re.match(r"^(?:more |less )?\w+$", predicate):
            return None
        return self._read.read(f"{predicate} than {self._label(self._beside[0])}")

    def _own_kind(self, predicate: str, named: Named) -> str:
        """ "Further left than the green one": the green one of its kind."""
        heads = {words(self._scene.get(one).name)[-1] for one in named.objects}
        if len(heads) != 1:
            return predicate
        (head,) = heads
        return re.sub(r"\b((?:the|an?) (?!other\b)\w+) one\b", rf"\1 {head}", predicate)

    def _parts(self, said: str) -> Iterator[tuple[str, str, bool]]:
        whole = _CONTRACTED.sub(lambda match: {"s": " is", "re": " are"}[match["be"]], said)
        whole = re.sub(r"\b(is|are)n't\b", r"\1 not", whole)
        whole = re.sub(r"^(?:should|might|may|could|can|would|will) (?=.* be )", "", whole)
        whole = re.sub(r"\b(?:touches|is touching)\b", "is touching", whole)
        copulas = list(_COPULA.finditer(f"{whole} "))
        for match in copulas:
            yield whole[: match.start()], whole[match.end() :].strip(), bool(match["not"])
        for match in _HAS.finditer(f"{whole} "):
            held, upon = whole[match.end() :].strip(), whole[: match.start()]
            inner = re.sub(
                r" (?:on|in|inside|upon)(?: (?:it|top|them|there))?(?: already)?$", "", held
            )
            if inner != held and re.match(r"(?:something|anything|nothing)\b", inner):
                yield upon, f"{inner} on it", bool(match["not"])
            elif re.search(r"\b(?:contains?|holds?)\b", match.group()) or inner != held:
                yield inner, f"in {upon}", bool(match["not"])
        inverted = _INVERTED.match(whole)
        if inverted is not None:
            yield from self._cuts(inverted["rest"], bool(inverted["not"]))
        elif not copulas:
            yield from self._cuts(whole, False)

    def _cuts(self, rest: str, negated: bool) -> Iterator[tuple[str, str, bool]]:
        """ "The parcel | wider than the pallet", at every word."""
        for token in tokenise(rest)[1:]:
            yield rest[: token.start].strip(), rest[token.start :].strip(), negated

    def _of(
        self, subject: str, named: Named, quantifier: str | None, test: Predicate, predicate: str,
        negated: bool,
    ) -> Fact | None:  # fmt: skip
        answers = [test.test(self._scene.get(one)) for one in named.objects]
        about = named.objects
        if quantifier in ("any", "one", "some", "either"):
            holds = denied(every(denied(one) for one in answers))
            about = tuple(o for o, yes in zip(about, answers, strict=True) if yes) or about
        elif quantifier in ("none", "neither", "no"):
            holds = every(denied(one) for one in answers)
        elif quantifier or named.several:
            holds = every(answers)
        elif len(set(answers)) > 1:
            return None  # which of them is meant makes the difference
        else:
            holds = answers[0]
        holds = denied(holds) if negated else holds
        negative = negated is not predicate.startswith("not ")
        where, others = test.where, tuple(one for one in test.others if one not in about)
        if test.holder and len(about) == 1:
            name = words(self._scene.get(about[0]).name)[-1]
            where = f"{self._lexicon.goes(name) or 'on'} {self._label(about[0])}"
        whole = quantifier in (None, "all", "each", "every", "every one", "both")
        name = subject if whole else ""
        told = re.sub(r"\b(?:it|them)$", self._label(others[0]), predicate) if others else predicate
        said = self._statement(subject, named, quantifier, told, holds, negated)
        return Fact(holds, about, name, others, where, _stated(said), negative)

    def _statement(
        self, subject: str, named: Named, quantifier: str | None, predicate: str,
        holds: bool | None, negated: bool,
    ) -> str:  # fmt: skip
        """The clause as it is true, told of what it speaks of."""
        true = (holds is not False) is not negated
        if subject in IT or subject in _SPOKEN:
            subject = listing(self._label(one) for one in named.objects)
        last = subject.split()[-1]
        verb = "are" if named.several or (last.endswith("s") and not last.endswith("ss")) else "is"
        if quantifier:
            lead = _SPOKEN[quantifier] if true else _CONTRARY[_SPOKEN[quantifier]]
            return f"{lead} {subject} {'is' if lead.endswith('of') else 'are'} {predicate}"
        bears = BEARING.match(predicate)
        if bears is not None:
            is_bare = true is (bears["what"] == "nothing")
            return f"{subject} has {'nothing' if is_bare else 'something'} {bears['where']}"
        if not true and subject.startswith(("all ", "both ")):
            return f"not {subject} {verb} {predicate}"
        if not true and predicate.startswith("not "):
            return f"{subject} {verb} {predicate.removeprefix('not ')}"
        return f"{subject} {verb} {'' if true else 'not '}{predicate}"

    def _label(self, object_id: str) -> str:
        return labels((object_id,), self._scene, self._lexicon)[object_id]


def _stated(text: str) -> str:
    """A clause as the arm says it."""
    turned = {"me": "you", "my": "your", "i": "you", "us": "you", "our": "your", "your": "my"}
    said = re.sub(r"\b(?:me|my|i|us|our|your)\b", lambda match: turned[match[0]], text)
    bare = re.sub(r"^(?=\w)(?!(?:the|a|an|my|your|this|that|all|both|any|one|none|it|they|each|"
                  r"some|every|these|those|either|neither|not)\b)", "the ", said)  # fmt: skip
    return f"{bare[0].upper()}{bare[1:]}."


def _low(text: str) -> str:
    return f"{text[0].lower()}{text[1:]}"
