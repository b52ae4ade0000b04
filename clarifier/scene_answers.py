"""Questions about what is on the table, answered from the scene (`scene.relations`)."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from agent.messages import Focus
from clarifier.act import question_core
from clarifier.ask import inventory
from clarifier.facts import Facts
from clarifier.lexicon import Lexicon
from clarifier.located import Link, holds, sides_said
from clarifier.mentions import link, link_answer
from clarifier.named import Fact
from clarifier.scene_words import SceneWords, one_of
from clarifier.spoken import Linked, Spoken
from clarifier.things import is_attribute, thing_of
from clarifier.words import listing, number_word, sentence, tokenise, words
from scene import relations
from scene.types import Scene

_SIZES = {"tall": "tall", "high": "tall", "wide": "wide", "broad": "wide", "long": "deep",
          "deep": "deep", "big": "size", "large": "size"}  # fmt: skip
_COUNTED = re.compile(r"(?:more|fewer|less) than|at least|at most|exactly|only|two|three|four|five")


class SceneQuestions:
    """Answers one question over one scene; every answer is a plain sentence."""

    def __init__(self, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> None:
        self._scene = scene
        self._focus = tuple(focus)
        self._lexicon = lexicon
        self._words = SceneWords(scene, lexicon)

    def answer(self, text: str) -> str | None:
        """The answer, or None for a question that is not about the scene."""
        asked = question_core(text).lower()
        for pattern, reply in self._table():
            match = re.match(pattern, asked)
            if match is not None:
                found = reply(match.group("x") if "x" in match.groupdict() else asked)
                if found is not None:
                    return found
        return None

    def _table(self) -> tuple[tuple[str, Callable[[str], str | None]], ...]:
        seen = r"(?:\s+(?:are|is|do|can|have|on|in|lie|lies|stand).*)?$"
        return (
            (r"(?:what|which|how).* (?:in|on) the tray\b.*", self._waiting),
            (r"how (?:many|much) (?P<x>.+)", self._how_many),
            (r"count (?P<x>.+)", self._how_many),
            (r"what (?:colou?r|colou?rs) (?:is|are|has|does) (?P<x>.+)", self._color),
            (r"what(?:'s| is) the colou?r of (?P<x>.+)", self._color),
            (r"(?:where(?:'s|s| is| are| was| were)) (?P<x>.+)", self._where),
            (r"where (?P<x>.+?) (?:is|are)$", self._where),
            (r"where (?:can i find|did you put|do you see) (?P<x>.+)", self._where),
            (r"how (?P<x>(?:tall|wide|high|broad|long|deep|big|large) .+)", self._how_big),
            (r"how far (?P<x>.+)", self._how_far),
            (r"(?:what(?:'s| is) the|measure the|tell me the) distance (?P<x>.+)", self._how_far),
            (r"what (?:are you|do you|is the (?:arm|robot|gripper)) (?:hold|carry|grip).*",
             self._held),
            (r"(?:what|which|who)(?:'s| is| are| do you see| can you see)? (?P<x>.+)", self._which),
            (r"which (?P<x>.+)", self._which),
            (r"(?:are|is) there (?P<x>(?:more|fewer|less|as many) .+)", self._more),
            (r"(?:are|is) there (?:still )?(?P<x>.+)", self._exists),
            (r"(?:can|could|do) you (?:see|find|spot) (?P<x>.+)", self._exists),
            (r"(?:do|have) (?:you|we|i) (?:have|got) (?P<x>.+)", self._exists),
            (r"any (?P<x>.+)", self._exists),
            (r"(?:is|are|isn't|aren't) (?P<x>.+)", self._whether),
            (rf"(?:what|describe|list|show|name|tell|which things|which objects).*{seen}",
             self._all),
        )  # fmt: skip

    # --- kinds of question ------------------------------------------------------------

    def _all(self, said: str) -> str | None:
        """ "what can you see", "list the objects", "describe the table"."""
        about = {"see", "there", "table", "objects", "things", "everything", "scene", "have"}
        about |= {"items", "got", "available", "around", "here", "left", "desk", "in", "front"}
        if not about & set(words(said)):
            return None
        asked = re.search(r"\b(?:are|is|can i|could i) (\w+)$", said)
        if asked is not None and asked[1] not in about | self._lexicon.words("grammar"):
            told = "what things are called, their colours, sizes and places"
            return f"I can't tell that: I know {told}."
        return self.everything()

    def _waiting(self, said: str) -> str | None:
        """ "what is in the tray", where that is no thing on the table."""
        tray = self._first("the tray")
        if tray is not None and tray.mention.objects:
            return None
        names = [self._words.label(item.id) for item in self._scene if item.on == "tray"]
        verb = "waits" if len(names) == 1 else "wait"
        found = f"{listing(names)} {verb} in the tray" if names else "nothing waits in the tray"
        return sentence(found)

    def everything(self) -> str:
        """All that is on the table, on the floor and in the tray."""
        table = tuple(i.id for i in self._scene if i.on not in ("floor", "tray"))
        other = {w: [i for i in self._scene if i.on == w] for w in ("floor", "tray")}
        skip = [item.id for item in self._scene if item.id not in table]
        parts = []
        if table:
            parts.append(f"I can see {inventory(self._scene, self._lexicon, skip)}.")
        for where, items in other.items():
            if items:
                rest = [i.id for i in self._scene if i not in items]
                place = "on the floor" if where == "floor" else "waiting in the tray"
                parts.append(f"There is {inventory(self._scene, self._lexicon, rest)} {place}.")
        return " ".join(parts) or "The table is empty."

    def _how_many(self, said: str) -> str | None:
        """ "how many apples are there", "how many things are on the plate"."""
        said = re.sub(r"^(?:of )?(?:the|all)\s+", "", said)
        said = re.sub(r"\b(?:are|is|do|can|have|does)\b (?:there|you|we|i)\b.*$", "", said)
        spoken = self._first(f"all {said}")
        if spoken is None or spoken.phrase is None:
            return None
        found = spoken.mention.objects
        if spoken.phrase.last == spoken.last:
            found = self._narrowed(said, found)
        noun = " ".join((*spoken.phrase.modifiers, *spoken.phrase.head)) or "one"
        if not found:
            return f"There is no {one_of(noun)}." if noun else "There is none."
        if len(found) == 1:
            return f"There is one: {self._words.label(found[0])}."
        return f"There are {number_word(len(found))}: {self._words.labels(found)}."

    def _more(self, said: str) -> str | None:
        """ "more apples than oranges": how many there are of either."""
        parts = re.match(r"(more|fewer|less|as many) (.+) (?:than|as) (.+)", said)
        if parts is None:
            return None
        one, other = (self._first(f"all {part}") for part in parts.groups()[1:])
        if one is None or other is None:
            return None
        few, many = len(one.mention.objects), len(other.mention.objects)
        holds = {"more": few > many, "as many": few == many}.get(parts[1], few < many)
        counts = f"{number_word(few)} of the one and {number_word(many)} of the other"
        return f"{'Yes' if holds else 'No'}, there {'is' if few == 1 else 'are'} {counts}."

    def _narrowed(self, said: str, found: tuple[str, ...]) -> tuple[str, ...]:
        """Those of which the rest of the question is true ("on the left", "in the bowl")."""
        link_ = self._relation_in(said)
        if link_ is None:
            return found
        return tuple(o for o in found if holds(link_, self._scene.get(o), self._scene))

    def _color(self, said: str) -> str | None:
        spoken = self._first(said)
        if spoken is None:
            return None
        if not spoken.mention.objects:
            return self._words.unseen(spoken)
        parts = []
        for object_id in spoken.mention.objects:
            thing = thing_of(self._scene.get(object_id), self._lexicon)
            color = thing.item.color or " and ".join(sorted(thing.colors))
            parts.append(
                f"{self._words.label(object_id)} is {color}" if color
                else f"I don't know the colour of {self._words.label(object_id)}"
            )  # fmt: skip
        return sentence(listing(parts))

    def _where(self, said: str) -> str | None:
        spoken = self._first(said)
        if spoken is None:
            return None
        if not spoken.mention.objects:
            return self._words.unseen(spoken)
        objects = spoken.mention.objects
        return " ".join(sentence(self._words.whereabouts(one)) for one in objects)

    def _how_big(self, said: str) -> str | None:
        word, _, rest = said.partition(" ")
        spoken = self._first(re.sub(r"^(?:is|are) ", "", rest))
        if spoken is None or len(spoken.mention.objects) != 1:
            return self._words.unseen(spoken) if spoken and not spoken.mention.objects else None
        item = self._scene.get(spoken.mention.objects[0])
        wide, deep, tall = (self._words.length(v) for v in (item.width, item.height, item.tall))
        sizes = {"tall": f"{tall} tall", "wide": f"{wide} wide", "deep": f"{deep} deep"}
        size = sizes.get(_SIZES[word], f"{wide} wide, {deep} deep and {tall} tall")
        return sentence(f"{self._words.label(item.id)} is {size}")

    def _how_far(self, said: str) -> str | None:
        linked = link(said, self._scene, self._focus, self._lexicon)
        ids = [o for one in linked.spoken for o in one.mention.objects]
        if len(linked.spoken) != 2 or len(ids) != 2:
            return None
        one, other = (self._scene.get(object_id) for object_id in ids)
        if one.x is None or other.x is None:
            return None
        far = self._words.length(relations.gap(one, other))
        first, second = self._words.label(one.id), self._words.label(other.id)
        return sentence(f"{first} and {second} are {far} apart, edge to edge")

    def _held(self, said: str) -> str | None:
        held = [item.id for item in self._scene if item.held]
        return f"I hold {self._words.labels(held)}." if held else "I hold nothing."

    def _which(self, said: str) -> str | None:
        """ "what is left of the cup", "which block is nearest to the plate", "the biggest"."""
        said = self._adjective_first(said)
        said = re.sub(r"\b(?:is|are|lies|stands|sits|do you see|can you see)\b\s*", "", said)
        said = re.sub(r"^(?:else|there|one|ones|of (?:them|these|the \w+))\s+", "", said)
        link_ = self._relation_in(said)
        if link_ is not None and self._starts_with_relation(said):
            found = [i.id for i in self._scene if holds(link_, i, self._scene)]
            found = self._extreme(link_, said, found)
            where = self._words.relation(link_)
            found = [object_id for object_id in found if object_id not in link_.anchors]
            if not link_.anchors and not link_.sides:
                return self._words.unseen(self._first(said))
            if not found:
                return sentence(f"nothing is {where}")
            verb = "is" if len(found) == 1 else "are"
            return sentence(f"{self._words.labels(found)} {verb} {where}")
        if {"table", "see", "there", "scene"} & set(words(said)):
            return self._all(said)
        spoken = self._first(said if re.match(r"(?:the|all|a|an)\b", said) else f"the {said}")
        if spoken is None or spoken.phrase is None or not spoken.phrase.modifiers:
            known = spoken is not None and spoken.last > (spoken.phrase or spoken).last
            if not known or spoken is None:
                return None
        found = list(spoken.mention.objects)
        pronoun = "it is" if len(found) == 1 else "they are"
        if not found:
            return self._words.unseen(spoken)
        return sentence(f"{pronoun} {self._words.labels(found)}")

    def _adjective_first(self, said: str) -> str:
        """ "mug is blue" as "blue mug"."""
        match = re.match(r"(?:of the )?(.+?) (?:is|are) (?:the )?(\w+)$", said)
        if match is None or not is_attribute(match.group(2), self._lexicon):
            return said
        return f"{match.group(2)} {match.group(1)}"

    def _extreme(self, link_: Link, said: str, found: list[str]) -> list[str]:
        if link_.relation not in ("nearest", "furthest"):
            return found
        return list(link_answer(f"the thing {said}", self._scene, self._lexicon).spoken[0]
                    .mention.objects)  # fmt: skip

    def _exists(self, said: str) -> str | None:
        if re.match(r"(?:any |enough |some )*(?:space|room|a? ?place)\b", said):
            return "I can't tell that beforehand: say what should go there, and I see if it fits."
        lead = r"^(?:any|some|something|anything)\s+(?=on|in|at|left|right|next|behind|near)"
        said = re.sub(lead, "", said)
        counted = self.stated(f"there are {said}") if _COUNTED.match(said) else None
        if counted is not None:
            return counted
        if self._starts_with_relation(said):
            return self._which(said)
        spoken = self._first(said)
        if spoken is None:
            return self._all(said)
        found = self._narrowed(said, spoken.mention.objects)
        if not found:
            return f"No, {_lower(self._words.unseen(spoken))}"
        if len(found) == 1:
            return f"Yes, {self._words.whereabouts(found[0])}."
        return f"Yes, there are {number_word(len(found))}: {self._words.labels(found)}."

    def _whether(self, said: str) -> str | None:
        """ "is the jug taller than the vase", "is the cup red": what is so, and where it is."""
        fact, told = self._fact(f"is {said}"), self._whereabouts(said)
        if fact is None or (told is not None and fact.holds is None):
            return told
        known = _told(fact)
        return told if told and fact.where and told[:3] == known[:3] else known

    def stated(self, clause: str) -> str | None:
        """Whether a clause is so ("the jug taller than the vase"); None for what is not read."""
        fact = self._fact(clause)
        return None if fact is None else _told(fact)

    def _fact(self, clause: str) -> Fact | None:
        return Facts(self._scene, self._focus, self._lexicon).fact(clause)

    def _whereabouts(self, said: str) -> str | None:
        """ "is the apple left of the bowl", "is it on the table", "is the cup red"."""
        spoken = self._first(self._without_colors(said))
        if spoken is None or len(spoken.mention.objects) != 1:
            return self._words.unseen(spoken) if spoken and not spoken.mention.objects else None
        item = self._scene.get(spoken.mention.objects[0])
        rest = " ".join(t.text for t in tokenise(said)[spoken.phrase.last if spoken.phrase
                                                       else spoken.last:])  # fmt: skip
        thing = thing_of(item, self._lexicon)
        colors = set(words(rest)) & self._lexicon.colors
        if colors:
            color = item.color or " and ".join(thing.colors)
            if not color:
                return f"I don't know the colour of {self._words.label(item.id)}."
            yes = bool(colors & (thing.colors | {color}))
            return f"{'Yes' if yes else 'No'}, {self._words.label(item.id)} is {color}."
        link_ = self._relation_in(rest)
        if link_ is None:
            return f"It is {self._words.place(item.id)}." if re.search(r"\bthere\b", rest) else None
        yes = holds(link_, item, self._scene)
        return f"{'Yes' if yes else 'No'}, {self._words.whereabouts(item.id)}."

    # --- pieces of sentences ------------------------------------------------------------

    def _without_colors(self, said: str) -> str:
        """ "the cup red or blue" as "the cup": the colours are asked about."""
        tokens = list(tokenise(said))
        while len(tokens) > 2 and tokens[-1].text in self._lexicon.colors | {"or", "and"}:
            tokens.pop()
        return said[: tokens[-1].end] if tokens else said

    def _first(self, said: str) -> Spoken | None:
        """The first thing named in a piece of the question."""
        linked = link(said, self._scene, self._focus, self._lexicon)
        if linked.spoken and linked.spoken[0].phrase is None:
            return linked.spoken[0]
        named = link_answer(said, self._scene, self._lexicon).spoken
        return named[0] if named else None

    def _relations(self, said: str) -> Linked:
        return link(said, self._scene, self._focus, self._lexicon)

    def _starts_with_relation(self, said: str) -> bool:
        chunks = self._relations(said).chunks
        return bool(chunks) and chunks[0].kind == "relation"

    def _relation_in(self, said: str) -> Link | None:
        """The first relation of the text with what it leads to."""
        linked = self._relations(said)
        for at, chunk in enumerate(linked.chunks[:-1]):
            if chunk.kind != "relation":
                continue
            following = linked.chunks[at + 1]
            anchors = [o for one in linked.spoken if one.first >= following.first
                       for o in one.mention.objects]  # fmt: skip
            text = [t.text for t in linked.tokens[following.first : following.last]]
            if following.kind == "place":
                sides = sides_said(text, self._lexicon)
                relation = chunk.value
                if relation in ("left", "right") and sides == ("table",):
                    sides = (relation,)
                return Link(relation, sides=sides)
            count = 2 if chunk.value == "between" else 1
            return Link("beside" if chunk.value == "goal" else chunk.value, tuple(anchors[:count]))
        return None


def _told(fact: Fact) -> str:
    if fact.holds is None:
        return "I can't tell that clearly."
    return f"{'Yes' if fact.holds else 'No'}, {_lower(fact.said)}"


def _lower(text: str) -> str:
    return text if text.startswith(("I ", "I'")) else text[0].lower() + text[1:]
