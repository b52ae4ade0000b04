"""Signs of print, of lists and of programming languages, put into words: "90°", "(1) … (2) …",
"x.pos := left of y", "nudge(x, dir=left, d=4cm)".

Each keeps the things, places and measures as they are said; what the words come to is for the rest
to find out.
"""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon

_ARROW = r"(?::=|<-|-{1,2}>|={1,2}>|→|⇒|➔|»)"
_LED = r"(?:(?:somewhere|right|just|directly) )?(?:on|onto|in|into|inside|at|to|next to|beside|" \
       r"between|in between|behind|in front of|left of|right of|above|below|under|near|against|" \
       r"towards?|on top of)\b"  # fmt: skip
_PROPERTY = r"(?:pos|position|loc|location|place|xy|x|y|pose|coords?|target|dest|destination)"
_KEYS_OF_PLACES = frozenset(
    {"to", "onto", "into", "on", "in", "target", "dest", "destination", "goal", "at", "where"}
)
_LABEL = re.compile(
    r"^\s*(?:[A-Z]{2,}[-_ ]?#?\d+(?:\.\d+)*|(?i:step|task|item|job|todo|to do|requirement|action|"
    r"command|cmd|request|instruction|goal|order|spec|now)\s*(?:no\.?|#)?\s*\d*)\s*:\s*(?=\S)"
)
"""What a sentence is filed under: "REQ-7: …", "task: …"."""
_NUMBERS = ("one", "two", "three", "four", "five", "six")
_COUNTING = re.compile(
    rf"(?:^|(?<=[.,;:!\n ]))\(?(?P<number>[1-6]|(?i:{'|'.join(_NUMBERS)}))"
    r"(?P<sign>[.)]\)?|,|:)(?=\s*[A-Za-z])"
)
_HEADER = re.compile(
    r"^[^:.;!?]*\b(?:things?|jobs?|tasks?|steps?|requests?|favou?rs?|moves?|order|sequence|list|"
    r"plan|errands?|orders|instructions?)\b[^:.;!?]*:\s*(?=\S)",
    re.IGNORECASE,
)
"""What announces a list: "two things for you: …"."""
_CALL = re.compile(r"^\s*(?P<name>[A-Za-z_]+)\s*\((?P<given>[^()]+)\)(?P<rest>\s*(?:[.;!].*)?)$",
                   re.DOTALL)  # fmt: skip
_ARGUMENT = re.compile(r"\s*(?:(?P<key>[A-Za-z_]+)\s*[=:]\s*)?(?P<value>.*\S)\s*", re.DOTALL)
_ADDED = re.compile(r"^\s*(?P<name>[A-Za-z_]+)\s*\((?P<what>[^()]+)\)\s*\+=\s*(?=\S)")
_SIGNS: tuple[tuple[re.Pattern[str], str], ...] = tuple(
    (re.compile(sign, re.IGNORECASE), words)
    for sign, words in (
        (r"(?<=\d)\s?[°º](?!\s?[CF]\b)", " degrees"),
        (r"(?<=\d)\s?deg\b\.?", " degrees"),
        (r"(?<=\d)(?:″|”|\")(?=\s|[.,;]|$)", " inches"),
        (r"\s*(?:\+/-|±)\s*\d+(?:[.,]\d+)?(?:\s?(?:mm|cm|%|°|degrees))?", ""),
        (r"(?<![\w~])~\s?(?=\d)", "about "),
        (r"(?:≤|<=)\s?(?=\d)", "at most "),
        (r"(?:≥|>=)\s?(?=\d)", "at least "),
        # a dash that holds two words together holds two parts of the sentence apart
        (r"(?<=[A-Za-z.,!?'’])\s?[—–]\s?(?=[A-Za-z])", " – "),
        (rf"^\s*(?:set|let|assign)\s+(?=[^:=]*?(?:\.{_PROPERTY}\s*)?(?::=|=))", ""),
        (rf"(?<=[a-z0-9])\.{_PROPERTY}\s*(?::=|={{1,2}}(?![=>])|<-)\s*", " -> "),
        (rf"(?<=\w)\s*(?<!<){_ARROW}\s*(?=[\w'(])", " -> "),
    )
)
_ASSIGNED = re.compile(rf"(?<=[a-z0-9])\.{_PROPERTY}\s*(?::=|={{1,2}}(?![=>])|<-)", re.IGNORECASE)
_TO_A_PLACE = re.compile(rf"\s->\s(?={_LED})", re.IGNORECASE)
_BARE = re.compile(r"^\s*(?P<what>[^->.;,!?:]+?) -> ", re.IGNORECASE)


def in_words(text: str, lexicon: Lexicon) -> str:
    """The sentence with its signs put into words."""
    text = _LABEL.sub("", text)
    text = _without_numbers(text)
    text = _call(_ADDED.sub(lambda said: _added(said, lexicon), text), lexicon)
    told = _ASSIGNED.search(text) is not None
    for sign, words in _SIGNS:
        text = sign.sub(words, text)
    if not told and not _TO_A_PLACE.search(text):
        return text
    bare = _BARE.match(text)
    verbless = bare is not None and not any(map(lexicon.verb, bare["what"].lower().split()))
    text = _TO_A_PLACE.sub(" ", text)
    return f"put {text.lstrip()}" if verbless else text


def _without_numbers(text: str) -> str:
    """ "(1) lift it. (2) turn it" without the numbers, and without what announces the list."""
    found = list(_COUNTING.finditer(text))
    counted, last = [], 0
    for said in found:
        value = _value(said["number"])
        if value == last + 1 and (value > 1 or _opens(text, said.start())):
            counted.append(said)
            last = value
    signs = {said["sign"] for said in counted}
    if len(counted) > 1 and len(signs) == 1:
        kept, at = [], 0
        for said in counted:
            before = text[at : said.start()].rstrip(" ,;\n")
            kept.append(before if not before or before[-1] in ".!?:" else f"{before}.")
            at = said.end()
        parts = [part for part in (*kept[1:], text[at:]) if part.strip()]
        head = "" if _HEADER.match(f"{kept[0]} x") or not kept[0].strip() else f"{kept[0]} "
        return head + " ".join(part.strip() for part in parts)
    return _HEADER.sub("", text) if re.match(r"^\s*(?:\d|two|three|a (?:few|couple))\b", text,
                                             re.IGNORECASE) else text  # fmt: skip


def _opens(text: str, at: int) -> bool:
    """Whether a list may begin at an index: at the start, behind a colon or a full stop."""
    before = text[:at].rstrip()
    return not before or before[-1] in ":.!?\n"


def _value(number: str) -> int:
    return int(number) if number.isdigit() else _NUMBERS.index(number.lower()) + 1


def _verb(name: str, lexicon: Lexicon) -> str | None:
    """The verb that a name of a call says ("pick_up", "yaw"); None if it is none."""
    said = name.replace("_", " ").lower()
    said = "turn" if said == "yaw" else said
    return said if lexicon.verb(said.split()[0]) is not None else None


def _call(text: str, lexicon: Lexicon) -> str:
    """ "nudge(cup, dir=left, d=4cm)" as "nudge cup left 4cm"."""
    said = _CALL.match(text)
    verb = _verb(said["name"], lexicon) if said is not None else None
    if said is None or verb is None:
        return text
    words, things = [verb], 0
    for given in said["given"].split(","):
        argument = _ARGUMENT.fullmatch(given)
        if argument is None:
            continue
        key, value = (argument["key"] or "").lower(), argument["value"].strip("'\"")
        led = re.match(_LED, value, re.IGNORECASE) is not None
        if key in _KEYS_OF_PLACES and not led:
            words.append("->")
        elif not key and things:
            words.append(_between(verb, lexicon) if not led else "")
        things += not key
        words.append(value)
    return " ".join(filter(None, words)) + said["rest"]


def _between(verb: str, lexicon: Lexicon) -> str:
    """What stands between two things of a call: "place(cup, tray)", "swap(cup, tray)"."""
    return {"place": "->", "arrange": "and"}.get(lexicon.verb(verb.split()[0]) or "", "")


def _added(said: re.Match[str], lexicon: Lexicon) -> str:
    verb = _verb(said["name"], lexicon)
    return said.group() if verb is None else f"{verb} {said['what'].strip()} by "
