"""The nouns of things and the kinds they are of (``kinds.txt``): an apple is a fruit is food.

Words of one line entry share a sense; a word may have several senses (a nut is food or a fastener).
"""

from __future__ import annotations

from pathlib import Path

from agent.errors import ConfigError
from clarifier.words import singular

KINDS = Path(__file__).with_name("kinds.txt")


class Kinds:
    """Senses of nouns and what is wider than they. A sense is called by its first word."""

    def __init__(self, text: str, source: str = "") -> None:
        self.nouns: set[str] = set()
        """Every noun as it is written, a word or several."""
        self.collective: set[str] = set()
        """Nouns that mean all of their kind at once ("cutlery")."""
        self._senses: dict[str, set[str]] = {}
        self._wider: dict[str, set[str]] = {}
        self._above: dict[str, frozenset[str]] = {}
        heads: set[str] = set()
        for line in text.splitlines():
            if line and not line.startswith("#"):
                heads.add(self._read(line))
        wanted = {wider for all_ in self._wider.values() for wider in all_}
        if wanted - heads:
            lost = ", ".join(sorted(wanted - heads))
            raise ConfigError(f"{source}: wider kinds without a line of their own: {lost}")

    def _read(self, line: str) -> str:
        """One line ``kind = word < wider, wider: noun = word, noun``; the kind's first word."""
        left, _, members = line.partition(":")
        kind, _, wider = left.partition("<")
        head = self._sense(kind)
        self._wider[head].update(entry.strip() for entry in wider.split(",") if entry.strip())
        for member in members.split(","):
            if member.strip():
                self._wider[self._sense(member)].add(head)
        return head

    def _sense(self, entry: str) -> str:
        """The sense that an entry ``noun = another word for it`` adds to."""
        said = [word.strip() for word in entry.split("=")]
        self.collective.update(word[:-1] for word in said if word.endswith("*"))
        said = [word.rstrip("*") for word in said]
        self.nouns.update(said)
        self._wider.setdefault(said[0], set())
        for word in said:
            self._senses.setdefault(one(word), set()).add(said[0])
        return said[0]

    def __contains__(self, noun: str) -> bool:
        """Whether the noun is known, in either number."""
        return noun in self.nouns or one(noun) in self._senses

    def mean(self, said: str, noun: str) -> bool:
        """Whether ``said`` may be said of what is called ``noun``: it is the same word or another
        word for it, a wider kind, or a compound of it ("ballpoint pen", "biro" of a pen)."""
        meant, there = self._senses.get(one(said), set()), self._senses.get(one(noun), set())
        if any(meant & self._at_or_above(sense) for sense in there):
            return True
        compounds = [sense for sense in meant if sense.endswith(f" {one(noun)}")]
        return any(there & self._at_or_above(sense) for sense in compounds)

    def _at_or_above(self, sense: str) -> frozenset[str]:
        """The sense and every wider one."""
        if sense not in self._above:
            found, waiting = {sense}, [sense]
            while waiting:
                fresh = self._wider[waiting.pop()] - found
                found |= fresh
                waiting += fresh
            self._above[sense] = frozenset(found)
        return self._above[sense]


def one(noun: str) -> str:
    """A noun of one or several words in the singular."""
    first, _, last = noun.rpartition(" ")
    return f"{first} {singular(last)}" if first else singular(last)
