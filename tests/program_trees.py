"""Random program bodies, grown from the tables of the language; shared by the fuzz tests.

`body` is a body whose parts mostly fit together, and in which, if it is wild, anything else that
Python's grammar knows may stand. All chance comes from the ``random.Random`` passed in.
"""

import ast
import re

from program_texts import ABSENT, LISTS, NAMES, NUMBERS, THINGS, UNKNOWNS, prelude

from agent.language import builtin
from agent.language.allowed import BINARY, BOOLEAN, IDENTITY, ORDER, STATEMENTS, UNARY

CONSTANTS = (0, 1, 2, 3, -1, 7, 0.5, -0.25, 0.1, True, False)
EXTREMES = (0.0, 1e-9, 1e3, -40, 2**53, -(2**53), 1e300, 5e-324)
ODD_CONSTANTS = ("strong", "block", "", None, b"x", 1j, ..., 2**70, 1e999, "x " * 35)
TAKES_A_LIST = {"len", "sum", "sorted", "list", "tuple"}
PARAMETERS = {
    "thing": "thing", "other": "thing", "one": "thing", "place": "thing", "things": "things",
    "others": "things", "places": "things", "numbers": "listing", "side": "_side",
    "across": "_side", "along": "_side",
}  # fmt: skip
"""What a function of the prelude takes for a parameter of this name; a number for others."""
WEIGHTS = {
    ast.Assign: 6, ast.AugAssign: 2, ast.Expr: 10, ast.If: 4, ast.For: 4, ast.While: 1,
    ast.Break: 1, ast.Continue: 1, ast.Return: 1, ast.Pass: 1,
}  # fmt: skip
MISTAKE = 0.004
"""How often an expression is of another sort than its place wants."""
WILD = 0.05
"""How often a node of a wild body is any of Python's."""
DEEP = 4
"""Levels of one expression beyond which it grows no further."""
_FIELD = re.compile(r"(\w+)([*?]?) (\w+)")


def body(rng, kind, wild=None):
    """The source of a random body; about half of them pass the allow-list."""
    trees = Trees(rng, kind, rng.random() < 0.5 if wild is None else wild)
    return ast.unparse(ast.fix_missing_locations(ast.Module(trees.program(), [])))


class Trees:
    """Grows the tree of one body. Methods named after a sort return an expression of it."""

    def __init__(self, rng, kind, wild):
        self.rng, self.kind, self.wild = rng, kind, wild
        self.fuel = rng.randint(5, 60)
        self.loops = self.depth = self.comprehensions = 0

    def chance(self, probability):
        return self.rng.random() < probability

    def program(self):
        self.depth = DEEP  # first values are simple
        first = [
            self._assign(name, self.sort(sort))
            for sort, name in self._variables()
            if not self.chance(0.05)
        ]
        self.depth = 0
        return first + [self.statement() for _ in range(self.rng.randint(1, 8))]

    def _variables(self):
        pools = {"constant": NUMBERS, "_list": LISTS, "_present": THINGS}
        if self.kind == "arrange":
            pools["_coordinate"] = UNKNOWNS
        return [(sort, name) for sort in pools for name in pools[sort]]

    def _present(self):
        return self._variable(NAMES)

    def _coordinate(self):
        return ast.Attribute(self._variable(NAMES), self.rng.choice("xy"), ast.Load())

    # --- statements ---

    def block(self):
        return [self.statement() for _ in range(self.rng.randint(1, 3))]

    def statement(self):
        if self._out_of_bounds():
            return self.grow(self.rng.choice(subclasses(ast.stmt)))
        weights = [WEIGHTS.get(kind, 1) for kind in STATEMENTS]
        (kind,) = self.rng.choices(list(STATEMENTS), weights)
        if self._spent() and kind in (ast.If, ast.For, ast.While):
            kind = ast.Expr
        if kind in (ast.Break, ast.Continue) and not self.loops:
            kind = ast.Pass
        build = getattr(self, f"_make_{kind.__name__.lower()}", None)
        return build() if build else self.grow(kind)

    def _out_of_bounds(self):
        return self.wild and self.fuel > 0 and self.chance(WILD)

    def _spent(self):
        self.fuel -= 1
        return self.fuel <= 0

    def _assign(self, name, value):
        return ast.Assign([ast.Name(name, ast.Store())], value)

    def _make_assign(self):
        if self.chance(0.1):
            return ast.Assign([self.target()], self.listing())
        grown = {"constant": "number", "_list": "listing", "_present": "thing"}
        sort, name = self.rng.choice(self._variables())
        return self._assign(name, self.sort(grown.get(sort, "unknown")))

    def _make_augassign(self):
        target = ast.Name(self.rng.choice(NUMBERS), ast.Store())
        return ast.AugAssign(target, self.rng.choice(BINARY)(), self.number())

    def _make_expr(self):
        return ast.Expr(self.command() if self.chance(0.8) else self.call())

    def _make_if(self):
        return ast.If(self.truth(), self.block(), self.block() if self.chance(0.5) else [])

    def _make_for(self):
        target, source = self.target(), self.listing()
        return ast.For(target, source, self._loop_body(), [])

    def _make_while(self):
        return ast.While(self.truth(), self._loop_body(), [])

    def _loop_body(self):
        self.loops += 1
        inside = self.block()
        self.loops -= 1
        return inside

    def _make_return(self):
        return ast.Return(self.expression() if self.chance(0.5) else None)

    def target(self):
        if self.chance(0.75):
            return ast.Name(self.rng.choice(NUMBERS), ast.Store())
        if self.chance(0.5):
            return ast.Subscript(self._variable(LISTS), self.index(), ast.Store())
        return ast.Tuple([self.target() for _ in range(self.rng.randint(1, 3))], ast.Store())

    # --- expressions ---

    def sort(self, name):
        return getattr(self, name)()

    def expression(self):
        if self._spent():
            return self.constant()
        return self.sort(self.rng.choice(("number", "truth", "listing", "thing", "constant")))

    def _or(self, *builders):
        """One of the builders; now and then something that does not belong there."""
        if self._out_of_bounds():
            return self.grow(self.rng.choice(subclasses(ast.expr)))
        self.depth += 1
        simple = self.depth > DEEP or self._spent()
        if self.chance(MISTAKE) and not simple:
            build = self.expression
        else:
            build = self.rng.choice(builders[:1] if simple else builders)
        built = build()
        self.depth -= 1
        return built

    def constant(self):
        if self.wild and self.chance(0.03):
            return ast.Constant(self.rng.choice(ODD_CONSTANTS))
        return ast.Constant(self.rng.choice(EXTREMES if self.chance(0.02) else CONSTANTS))

    def _variable(self, pool):
        return ast.Name(self.rng.choice(pool), ast.Load())

    def number(self):
        return self._or(
            self.constant, lambda: self._variable(NUMBERS), self._attribute, self._attribute,
            self._binary, self._binary, self._unary, self._number_call, self._math, self._element,
            self._conditional, self.truth, self._value,
        )  # fmt: skip

    def _attribute(self):
        unknown = self.kind == "arrange" and self.chance(0.9)  # not of objects on the table: rare
        numbers = [n for n in builtin.OBJECT_NUMBERS if not (unknown and n in "xy")]
        if self.chance(0.1):
            return ast.Attribute(
                ast.Name("math", ast.Load()),
                self.rng.choice(sorted(builtin.MATH_CONSTANTS)),
                ast.Load(),
            )
        return ast.Attribute(self.thing(), self.rng.choice(numbers), ast.Load())

    def _binary(self):
        return ast.BinOp(self.number(), self.rng.choice(BINARY)(), self.number())

    def _unary(self):
        return ast.UnaryOp(self.rng.choice(UNARY)(), self.number())

    def _number_call(self):
        name = self.rng.choice(sorted(builtin.BUILTINS))
        return self._call_name(name, self._some(*builtin.BUILTINS[name]))

    def _math(self):
        name = self.rng.choice(sorted(builtin.MATH_CALLS))
        _, low, high = builtin.MATH_CALLS[name]
        arguments = [self.number() for _ in range(self._some(low, high))]
        return self._method(ast.Name("math", ast.Load()), name, arguments)

    def _some(self, low, high):
        return self.rng.randint(low, min(high, low + 2))

    def _element(self):
        return ast.Subscript(self.listing(), self.index(), ast.Load())

    def index(self):
        return ast.Constant(self.rng.randint(-1, 1)) if self.chance(0.9) else self.number()

    def _conditional(self):
        return ast.IfExp(self.truth(), self.number(), self.number())

    def _value(self):
        return self._method(self.unknown(), "value", []) if self._arranges() else self.constant()

    def _arranges(self):
        return self.kind == "arrange"

    def truth(self):
        return self._or(
            self.constant, self._none_test, self._comparison, self._comparison, self._logic,
            lambda: ast.UnaryOp(ast.Not(), self.truth()), self.listing, self.thing,
        )  # fmt: skip

    def _none_test(self):
        left = ast.Name(self.rng.choice((*NAMES, ABSENT, *THINGS)), ast.Load())
        return ast.Compare(left, [self.rng.choice((*IDENTITY, ast.Eq))()], [ast.Constant(None)])

    def _comparison(self):
        count = self.rng.choice((1, 1, 1, 2))
        ops = [self.rng.choice(ORDER)() for _ in range(count)]
        sides = [
            self.listing() if isinstance(o, ast.In | ast.NotIn) else self.number() for o in ops
        ]
        return ast.Compare(self.number(), ops, sides)

    def _logic(self):
        parts = [self.truth() for _ in range(self.rng.randint(2, 3))]
        return ast.BoolOp(self.rng.choice(BOOLEAN)(), parts)

    def listing(self):
        return self._or(
            lambda: self._variable(LISTS), self._list, self._list, self._list, self._comprehension,
            self._range, lambda: self._call_name("sorted", 1), self._joined,
        )  # fmt: skip

    def _list(self):
        make = self.thing if self.chance(0.05) else self.number
        parts = [make() for _ in range(0 if self.chance(0.02) else self.rng.randint(2, 4))]
        return self.rng.choice((ast.List, ast.List, ast.Tuple))(parts, ast.Load())

    def _joined(self):
        return ast.BinOp(self._list(), ast.Add(), self._list())

    def _range(self):
        limits = [ast.Constant(n) for n in self.rng.choice(((3,), (2, 4), (6, 0, -2), (1, 9, 3)))]
        return self._call_free("range", limits)

    def _comprehension(self):
        source = self.listing()
        if self.comprehensions and not self.chance(MISTAKE):
            return source
        self.comprehensions += 1
        tests = [self.truth() for _ in range(self.rng.choice((0, 0, 1, 2)))]
        target = ast.Name(self.rng.choice((*NUMBERS, "k")), ast.Store())
        element = self.number()
        self.comprehensions -= 1
        return ast.ListComp(element, [ast.comprehension(target, source, tests, 0)])

    def thing(self):
        return self._or(
            self._present, lambda: self._variable(THINGS), self._chosen, self._chosen,
            lambda: self._own_call(("nearest", "largest", "leftmost", "at")),
        )  # fmt: skip

    def _chosen(self):
        return ast.Subscript(self.things(), ast.Constant(self.rng.choice((0, -1))), ast.Load())

    def things(self):
        words = [ast.Constant(self.rng.choice(("block", "block", "apple")))]
        named = [self._variable(NAMES) for _ in range(self.rng.randint(1, 3))]
        return self.rng.choice(
            (self._call_free("group", words if self.chance(0.5) else []),
             ast.List(named, ast.Load()))
        )  # fmt: skip

    # --- calls ---

    def call(self):
        return self._or(self._number_call, self._math, self._append, self._own_call, self.command)

    def command(self):
        """A call that does something: of the robot or of the solver."""
        handle = "solver" if self._arranges() else "robot"
        methods = builtin.HANDLES[handle][1]
        name = self.rng.choice([*methods, next(iter(methods))])
        if name == "addConstraint":
            arguments = [self.constraint()]
        elif name == "grip":
            arguments = [ast.Constant(self.rng.choice((True, False)))]
        else:
            arguments = [self.number() for _ in range(methods[name][0])]
        return self._method(ast.Name(handle, ast.Load()), name, arguments)

    def _append(self):
        return self._method(self._variable(LISTS), "append", [self.number()])

    def _own_call(self, among=()):
        """A call of a function over objects, or of one written in the language itself."""
        named = {name: ["number"] * high for name, (_, high) in builtin.OBJECT_CALLS.items()}
        named["at"] = ["thing", "number", "number", "number"]
        for name, tree in prelude(self.kind).items():
            named[name] = [PARAMETERS.get(p.arg, "number") for p in tree.args.args]
        name = self.rng.choice(sorted({*named} & {*among} or {*named}))
        return self._call_free(name, [self.sort(sort) for sort in named[name]])

    def _side(self):
        return ast.Constant(self.rng.choice(("left", "right", "near", "far")))

    def _call_name(self, name, count):
        make = self.listing if name in TAKES_A_LIST else self.number
        return self._call_free(name, [make() for _ in range(count)])

    def _call_free(self, name, arguments):
        return ast.Call(ast.Name(name, ast.Load()), arguments, [])

    def _method(self, owner, name, arguments):
        return ast.Call(ast.Attribute(owner, name, ast.Load()), arguments, [])

    # --- unknowns ---

    def unknown(self):
        return self._or(
            self._coordinate,
            lambda: self._call_free("Variable", [ast.Constant("gap")]),
            lambda: self._variable(UNKNOWNS), self._linear, self._linear,
        )  # fmt: skip

    def _linear(self):
        if self.chance(0.6):
            op = self.rng.choice((ast.Add, ast.Sub))()
            return ast.BinOp(self.unknown(), op, self.rng.choice((self.unknown, self.constant))())
        return ast.BinOp(ast.Constant(self.rng.choice((2, 0.5, -1))), ast.Mult(), self.unknown())

    def constraint(self):
        op = self.rng.choice((ast.LtE, ast.GtE, ast.Eq))()
        right = self.rng.choice((self.unknown, self.unknown, self.constant))()
        stated = ast.Compare(self.unknown(), [op], [right])
        if self.chance(0.5):
            return ast.BinOp(stated, ast.BitOr(), ast.Constant(self.rng.choice(builtin.STRENGTHS)))
        return stated

    # --- anything that Python's grammar knows ---

    def grow(self, kind):
        """A node of this class, its fields filled as Python's grammar says (see its docstring)."""
        length = self.rng.randint(1, 2)  # of all its lists: some go in parallel
        if kind in (ast.JoinedStr, ast.FormattedValue):
            return ast.JoinedStr([ast.FormattedValue(self.number(), -1, None)])
        if kind is ast.Raise:
            return ast.Raise(self.expression(), None)
        if kind is ast.MatchSingleton:
            return ast.MatchSingleton(None)
        node = kind()
        for sort, quantity, field in _FIELD.findall(kind.__doc__ or ""):
            if field in ("target", "targets", "optional_vars"):
                setattr(node, field, [self.target()] if quantity == "*" else self.target())
            else:
                setattr(node, field, self._field(sort, quantity, length))
        return node

    def _field(self, sort, quantity, length):
        if quantity == "*":
            return [self._part(sort) for _ in range(length)]
        if quantity == "?" and (self._spent() or self.chance(0.5)):
            return None
        return self._part(sort)

    def _part(self, sort):
        if sort == "expr":
            return self.expression()
        if sort == "stmt":
            return self.statement()
        if sort == "expr_context":
            return ast.Load()
        if sort == "identifier":
            return self.rng.choice((*NAMES, *NUMBERS, "x", "real", "append"))
        if sort in ("int", "string", "constant"):
            return {"int": 0, "string": None}.get(
                sort, self.rng.choice((*CONSTANTS, *ODD_CONSTANTS))
            )
        kinds = subclasses(getattr(ast, sort)) or [getattr(ast, sort)]
        if self._spent():
            kinds = [min(kinds, key=lambda kind: len(_FIELD.findall(kind.__doc__ or "")))]
        return self.grow(self.rng.choice(kinds))


def subclasses(base):
    """The classes of Python's syntax trees below this one, but for what no source can say."""
    unsayable = (ast.Interactive, ast.Expression, ast.FunctionType)
    deprecated = ("Num", "Str", "Bytes", "NameConstant", "Ellipsis", "Index", "ExtSlice")
    return [
        kind
        for kind in base.__subclasses__()
        if kind not in unsayable and kind.__name__ not in deprecated
    ]
