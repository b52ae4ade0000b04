"""The arm's own parts by whatever name: "hover the suction cup over the dish", "tap it with the end
of your arm". No thing of the table is meant, so the part is left out: "hover over the dish".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

_DET = r"(?:the|your|its|that|this) "
_NAMES = (
    "suction cup", "suction pad", "suction head", "suction gripper", "suction tip", "sucker",
    "suction nozzle", "vacuum cup", "vacuum gripper", "gripper", "tool", "tool tip", "arm", "claw",
    "robot arm", "robotic arm", "fingertip", "finger", "hand", "end effector",
)  # fmt: skip
_TIP = rf"(?:{_DET}(?:very )?(?:end|tip|head|point) of )?"
_OVER = r"(?P<where>(?:directly |right |just |straight )?(?:over|above))"
_CARRY = r"(?:hover|hold|keep|bring|move|place|position|put|park|take|raise|send|swing|leave|have)"
_ONTO = r"(?:onto|on to|on|to touch|against|down to) "
_THING = (
    r"(?=(?:the|my|a|an|that|this|it|each|both) )"
    r"(?!the (?:table|desk|left|right|front|back|side|middle|centre|center|near|far|edge)\b)"
)
_ALONE = (
    r"(?=(?:the|my|a|an|that|this|it|each|both)(?: (?!the\b|my\b|a\b|an\b)[\w'-]+){1,5}"
    r"(?:\s*[.,;!?]|$| and\b| then\b| please\b))"
)
"""Nothing else that could be meant to go there."""
_REACH = r"(?:move|bring|get|put|place|position|take|swing|drive|reach|extend|stretch|set)"
_GO = r"(?:move|go|come|get)"
_BITS = r"(?:slightly|a bit|a little|over|up|right|close|closer|near|nearer|out|just|very)"
_NEAR = (
    r"(?:to|towards?|near|next to|beside|by|up to|in the direction of|on top of|nearer|"
    r"closer?)"
)
_BESIDE = (
    r"(?:(?:to|on|at) the (?P<side>left|right)(?: side| hand side|-hand side)? of|"
    r"(?P<depth>in front of|behind))"
)
_MEET = r"(?:lower|bring|put|place|rest|set|press|lay|take|move)"


def _aside(said: re.Match[str]) -> str:
    return f"hover to the {said['side']} of " if said["side"] else f"hover {said['depth']} "


def without_own_parts(text: str, names: Iterable[str]) -> str:
    """The sentence without the arm's parts; as it is where a thing there is called like one."""
    said = {name.lower() for name in names}
    own = [name for name in _NAMES if not any(name in one.split() or name == one for one in said)]
    if not own:
        return text
    part = f"{_TIP}{_DET}(?:{'|'.join(sorted(own, key=len, reverse=True))})"
    over = rf"\b{_CARRY} {part} (?:hovering |so that it(?:'s| is| hovers) )?{_OVER} "
    onto = rf"\b{_MEET} {part} (?:down )?(?:lightly |gently |just )?{_ONTO}{_THING}"
    goes = rf"(?:\b{_REACH} {part}|(?:^|(?<=then )|(?<=please )|(?<=now )){_GO})(?: {_BITS})*"
    rules: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
        (rf"{goes} {_NEAR} {_THING}{_ALONE}", "hover over "),
        (rf"{goes} {_BESIDE} {_THING}{_ALONE}", _aside),
        (rf"^(?P<please>please )?approach (?:to )?{_THING}", r"\g<please>hover over "),
        (over, r"hover \g<where> "),
        (onto, "touch "),
        (rf",? (?:with|using) {part}(?= |$|[.,;!?])", ""),
        (rf"\buse {part} to ", ""),
    )
    for turn, plain in rules:
        text = re.sub(turn, plain, text, flags=re.IGNORECASE)
    return text
