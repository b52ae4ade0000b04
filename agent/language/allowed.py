"""The allow-list of the little language, by exact node type: no visitor means not allowed.

`Checker` walks the whole tree, dead code included, and recognises attributes, calls and their
arity statically. It evaluates nothing. Every refusal says what to write instead.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Collection, Sequence
from typing import Any, NoReturn

from agent.errors import NotAllowed
from agent.language.builtin import (
    BUILTINS,
    HANDLES,
    INSTEAD,
    MATH_CALLS,
    MATH_CONSTANTS,
    METHODS,
    NUMBER_CALLS,
    OBJECT_CALLS,
    OBJECT_NUMBERS,
    RESERVED,
    STRENGTHS,
)
from agent.language.naming import Names, nearest, none_test
from agent.language.prelude import functions
from agent.messages import Kind

MAX_INT = 2**53
MAX_TEXT = 60

OWNERS = (ast.Name, ast.Call, ast.Subscript, ast.IfExp)
"""Expressions that can be an object, so that its numbers can be asked for."""
BINARY = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.FloorDiv, ast.Mod, ast.Pow)
UNARY = (ast.UAdd, ast.USub, ast.Not)
BOOLEAN = (ast.And, ast.Or)
ORDER = (ast.Eq, ast.NotEq, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.In, ast.NotIn)
SAMENESS = (ast.Eq, ast.NotEq, ast.In, ast.NotIn)
"""Comparisons that objects take part in."""
IDENTITY = (ast.Is, ast.IsNot)


def refuse(node: ast.AST, reason: str) -> NoReturn:
    """Raise NotAllowed at the node's place."""
    raise NotAllowed(reason, getattr(node, "lineno", 0), getattr(node, "col_offset", -1) + 1)


def _unlisted(node: ast.AST, place: ast.AST) -> NoReturn:
    text = INSTEAD.get(type(node), f"{type(node).__name__} is not allowed: use plain statements")
    refuse(place, text)


def _takes_numbers(function: ast.expr) -> bool:
    """Whether no argument of this function can be an object."""
    if type(function) is ast.Attribute:
        return type(function.value) is ast.Name and function.value.id in HANDLES
    return type(function) is ast.Name and function.id in NUMBER_CALLS


class Checker:
    """One walk over a program's tree; ``used`` collects the scene's names it touches."""

    def __init__(self, kind: Kind, names: Names) -> None:
        self.kind = kind
        self.names = names
        self.used: set[str] = set()
        self._loops = self._comprehensions = 0

    def block(self, body: Sequence[ast.stmt]) -> None:
        """Check statements in order. Raises NotAllowed."""
        for node in body:
            visit = STATEMENTS.get(type(node)) or _unlisted(node, node)
            visit(self, node)

    def value(self, node: ast.expr) -> None:
        """Check an expression whose value is used. Raises NotAllowed."""
        visit = EXPRESSIONS.get(type(node)) or _unlisted(node, node)
        visit(self, node)

    def number(self, node: ast.expr) -> None:
        """Check an expression whose value cannot be an object: it is reckoned with."""
        if type(node) is ast.Name and self._is_object(node.id):
            refuse(node, f"the object {node.id} is no number: use its numbers, such as {node.id}.x")
        self.value(node)

    # --- statements ---

    def _assign(self, node: ast.Assign) -> None:
        for target in node.targets:
            self._target(target)
        self.value(node.value)

    def _augmented(self, node: ast.AugAssign) -> None:
        if type(node.target) is not ast.Name:
            refuse(node.target, "only a variable can be changed so: write target = target + value")
        self._target(node.target)
        self._operator(node.op, node, BINARY)
        self.number(node.value)

    def _expression(self, node: ast.Expr) -> None:
        if type(node.value) is not ast.Call:
            refuse(node, "this line does nothing: call something, or write a comment with #")
        self.value(node.value)

    def _if(self, node: ast.If) -> None:
        self.value(node.test)
        self.block(node.body)
        self.block(node.orelse)

    def _for(self, node: ast.For) -> None:
        self._target(node.target)
        self.value(node.iter)
        self._loop(node)

    def _while(self, node: ast.While) -> None:
        self.value(node.test)
        self._loop(node)

    def _loop(self, node: ast.For | ast.While) -> None:
        if node.orelse:
            refuse(node.orelse[0], "else after a loop is not allowed: use a variable and if")
        self._loops += 1
        self.block(node.body)
        self._loops -= 1

    def _jump(self, node: ast.Break | ast.Continue) -> None:
        if not self._loops:
            word = "break" if type(node) is ast.Break else "continue"
            refuse(node, f"{word} outside a loop: use return to end the program")

    def _return(self, node: ast.Return) -> None:
        if node.value is not None:
            self.value(node.value)

    def _pass(self, node: ast.Pass) -> None:
        pass

    def _target(self, node: ast.expr) -> None:
        if type(node) is ast.Tuple or type(node) is ast.List:
            for part in node.elts:
                self._target(part)
        elif type(node) is ast.Name:
            self._assignable(node)
        elif type(node) is ast.Subscript:
            self.value(node.value)
            self.value(node.slice)
        elif type(node) is ast.Attribute:
            refuse(
                node, "an attribute cannot be set: use robot.move or a constraint to move things"
            )
        else:
            _unlisted(node, node)

    def _assignable(self, node: ast.Name) -> None:
        if node.id in RESERVED:
            refuse(node, f"{node.id} has a meaning already: choose another variable name")
        if node.id in self.names.scene:
            refuse(node, f"{node.id} is an object of the scene: choose another variable name")

    # --- expressions ---

    def _constant(self, node: ast.Constant) -> None:
        value = node.value
        if type(value) is int and abs(value) > MAX_INT:
            refuse(node, "the number is too large: the table is 2 units wide")
        elif type(value) is float and not math.isfinite(value):
            refuse(node, "the number is not finite: the table is 2 units wide")
        elif type(value) is str and len(value) > MAX_TEXT:
            refuse(node, f"a text longer than {MAX_TEXT} characters is not allowed: shorten it")
        elif type(value) is str and not value.isprintable():
            refuse(node, "a text is one plain line: leave out line breaks")
        elif type(value) not in (type(None), bool, int, float, str):
            refuse(node, f"a {type(value).__name__} is not allowed: write a number")

    def _name(self, node: ast.Name) -> None:
        name = node.id
        if name in self.names.variables:
            return
        if self._is_object(name):
            self.used.add(name)
            return
        if name in HANDLES:
            refuse(node, f"{name} cannot be passed around: write {HANDLES[name][2]}")
        if name in RESERVED:
            refuse(node, f"{name} cannot be passed around: call it, as in {name}(...)")
        self._unknown(node)

    def _unknown(self, node: ast.Name) -> NoReturn:
        several = sorted(n for n in self.names.scene if n.rpartition("_")[0] == node.id)
        if several:
            refuse(node, f"there are several of these: write one of {', '.join(several[:6])}")
        close = nearest(node.id, {*self.names.scene, *self.names.variables, *RESERVED})
        if close:
            refuse(node, f"the name {node.id} is unknown: did you mean {close}?")
        there = ", ".join(sorted(self.names.scene)[:8]) or "nothing"
        refuse(node, f"the name {node.id} is unknown: the scene has {there}")

    def _is_object(self, name: str) -> bool:
        return name not in self.names.variables and (
            name in self.names.scene or name in self.names.absent
        )

    def _binary(self, node: ast.BinOp) -> None:
        if type(node.op) is ast.BitOr and self.kind == "arrange":
            self._strength(node)
        else:
            self._operator(node.op, node, BINARY)
            self.number(node.left)
            self.number(node.right)

    def _strength(self, node: ast.BinOp) -> None:
        self.value(node.left)
        if type(node.right) is ast.Constant and node.right.value not in STRENGTHS:
            refuse(node.right, f"a strength is one of {', '.join(STRENGTHS)}")
        self.value(node.right)

    def _operator(self, op: ast.AST, node: ast.AST, listed: tuple[type[ast.AST], ...]) -> None:
        if type(op) not in listed:
            _unlisted(op, node)

    def _unary(self, node: ast.UnaryOp) -> None:
        self._operator(node.op, node, UNARY)
        if type(node.op) is ast.Not:
            self.value(node.operand)
        else:
            self.number(node.operand)

    def _boolean(self, node: ast.BoolOp) -> None:
        for part in node.values:
            self.value(part)

    def _compare(self, node: ast.Compare) -> None:
        if none_test(node):
            self.value(node.left)
            return
        for op in node.ops:
            if type(op) in IDENTITY:
                refuse(node, "is compares with None only: write == instead")
            self._operator(op, node, ORDER)
        sames = all(type(op) in SAMENESS for op in node.ops)
        for part in (node.left, *node.comparators):
            self.value(part) if sames else self.number(part)

    def _conditional(self, node: ast.IfExp) -> None:
        self.value(node.test)
        self.value(node.body)
        self.value(node.orelse)

    def _sequence(self, node: ast.List | ast.Tuple) -> None:
        for part in node.elts:
            self.value(part)

    def _index(self, node: ast.Subscript) -> None:
        self.value(node.value)
        self.value(node.slice)

    def _comprehension(self, node: ast.ListComp) -> None:
        if self._comprehensions:
            refuse(node, "a comprehension inside another is not allowed: use a loop and append")
        if len(node.generators) != 1:
            refuse(node, "only one for in a comprehension: use a loop and append")
        clause = node.generators[0]
        if clause.is_async:
            refuse(node, INSTEAD[ast.AsyncFor])
        if type(clause.target) is ast.Subscript:
            refuse(clause.target, "a comprehension needs a plain variable after for")
        self._target(clause.target)
        self.value(clause.iter)
        self._comprehensions += 1
        for test in clause.ifs:
            self.value(test)
        self.value(node.elt)
        self._comprehensions -= 1

    def _attribute(self, node: ast.Attribute) -> None:
        base = node.value.id if type(node.value) is ast.Name else None
        if base == "math" and base not in self.names.variables:
            if node.attr not in MATH_CONSTANTS:
                self._no_attribute(node, "math", {*MATH_CONSTANTS, *MATH_CALLS})
        elif type(node.value) in OWNERS:
            self.value(node.value)
            if node.attr not in OBJECT_NUMBERS:
                listed = ", ".join(OBJECT_NUMBERS)
                refuse(node, f"an object has no {node.attr}: it has {listed}")
        else:
            refuse(node, f".{node.attr} is not allowed: only objects of the scene have attributes")

    def _no_attribute(self, node: ast.Attribute, owner: str, known: Collection[str]) -> NoReturn:
        close = nearest(node.attr, known)
        hint = f"did you mean {owner}.{close}?" if close else f"write {HANDLES[owner][2]}"
        refuse(node, f"there is no {owner}.{node.attr}: {hint}")

    def _call(self, node: ast.Call) -> None:
        if node.keywords:
            refuse(node, "arguments have no names here: write them in order")
        for argument in node.args:
            if type(argument) is ast.Starred:
                _unlisted(argument, argument)
        if type(node.func) is ast.Name:
            self._call_name(node, node.func.id)
        elif type(node.func) is ast.Attribute:
            self._call_attribute(node, node.func)
        else:
            refuse(node, "only named functions can be called: write robot.move(...) or min(...)")
        for argument in node.args:
            self.number(argument) if _takes_numbers(node.func) else self.value(argument)

    def _call_name(self, node: ast.Call, name: str) -> None:
        own = functions(self.kind).get(name)
        if name == "Variable" and self.kind == "arrange":
            self._arity(node, name, 1, 1)
        elif name in BUILTINS:
            self._arity(node, name, *BUILTINS[name])
        elif name in OBJECT_CALLS:
            self._arity(node, name, *OBJECT_CALLS[name])
        elif own is not None:
            count = len(own.parameters)
            if len(node.args) != count:
                refuse(node, f"{name} takes {count} arguments: write {own.usage}")
        else:
            self._no_function(node, name)

    def _no_function(self, node: ast.Call, name: str) -> NoReturn:
        other: Kind = "manipulate" if self.kind == "arrange" else "arrange"
        if name in functions(other):
            does = "moves the arm" if other == "manipulate" else "states constraints"
            refuse(node, f"{name} {does}, in {other} programs only: write {self._own_usage()}")
        known = {*BUILTINS, *OBJECT_CALLS, *functions(self.kind)}
        close = nearest(name, known if self.kind == "manipulate" else {*known, "Variable"})
        hint = f"did you mean {close}?" if close else f"there are {', '.join(BUILTINS)}"
        refuse(node, f"there is no function {name}: {hint}")

    def _call_attribute(self, node: ast.Call, function: ast.Attribute) -> None:
        base = function.value.id if type(function.value) is ast.Name else None
        if base in HANDLES:
            self._call_handle(node, function, base)
        elif function.attr in METHODS:
            owner, count, kind = METHODS[function.attr]
            if kind not in (None, self.kind):
                refuse(
                    node, f".{function.attr}() belongs to {kind} programs: use the number itself"
                )
            self._arity(node, f"{function.attr}() of {owner}", count, count)
            self.value(function.value)
        else:
            refuse(
                node,
                f".{function.attr}() is not allowed: there are .append(x) of a list "
                "and .value() of an unknown",
            )

    def _call_handle(self, node: ast.Call, function: ast.Attribute, base: str) -> None:
        kind, methods, _ = HANDLES[base]
        if kind not in (None, self.kind):
            refuse(node, f"{base} belongs to {kind} programs: write {self._own_usage()}")
        if function.attr not in methods:
            self._no_attribute(function, base, methods)
        self._arity(node, f"{base}.{function.attr}", *methods[function.attr])

    def _own_usage(self) -> str:
        return HANDLES["robot" if self.kind == "manipulate" else "solver"][2]

    def _arity(self, node: ast.Call, name: str, low: int, high: int) -> None:
        if not low <= len(node.args) <= high:
            needs = str(low) if low == high else f"{low} to {high}"
            usage = HANDLES[name.partition(".")[0]][2] if "." in name else name
            refuse(node, f"{name} takes {needs} arguments, not {len(node.args)}: see {usage}")


STATEMENTS: dict[type[ast.stmt], Callable[[Checker, Any], None]] = {
    ast.Assign: Checker._assign,
    ast.AugAssign: Checker._augmented,
    ast.Expr: Checker._expression,
    ast.If: Checker._if,
    ast.For: Checker._for,
    ast.While: Checker._while,
    ast.Break: Checker._jump,
    ast.Continue: Checker._jump,
    ast.Return: Checker._return,
    ast.Pass: Checker._pass,
}
"""The statements of the language; anything else is refused."""
EXPRESSIONS: dict[type[ast.expr], Callable[[Checker, Any], None]] = {
    ast.Constant: Checker._constant,
    ast.Name: Checker._name,
    ast.BinOp: Checker._binary,
    ast.UnaryOp: Checker._unary,
    ast.BoolOp: Checker._boolean,
    ast.Compare: Checker._compare,
    ast.IfExp: Checker._conditional,
    ast.List: Checker._sequence,
    ast.Tuple: Checker._sequence,
    ast.Subscript: Checker._index,
    ast.ListComp: Checker._comprehension,
    ast.Attribute: Checker._attribute,
    ast.Call: Checker._call,
}
"""The expressions of the language; anything else is refused."""
