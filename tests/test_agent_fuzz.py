"""Random texts, trees and bytes: whatever comes in, only the errors that are meant come out."""

import ast
import io
import random
import socket
import subprocess
import sys
import tokenize

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from program_texts import NAMES, SCENES, benign, mutated, prelude, soup
from program_trees import body

from agent.errors import NotAllowed, ProgramError, SolverFailed
from agent.execute import Executor
from agent.language import allowed, builtin, frames
from agent.language.interpret import compile_program, execute
from agent.language.run import MAX_COMMANDS, MAX_STEPS
from agent.messages import Command, Draft, Placement
from agent.program import Program, instantiate, parse, scan

pytestmark = pytest.mark.filterwarnings("ignore::SyntaxWarning")  # of Python's own parser

KINDS = ("manipulate", "arrange")
BENIGN = [source for kind in KINDS for source in benign(kind)]
BATCH = 150
"""Random bodies of each kind that run in worker processes."""
SEEDS = range(600)
"""Random bodies of each kind that run in this process: many more than hypothesis can shrink."""

often = settings(
    derandomize=True,
    deadline=None,
    database=None,
    max_examples=200,
    suppress_health_check=list(HealthCheck),
)
chances = st.randoms(use_true_random=False)
kinds = st.sampled_from(KINDS)
soups = st.builds(soup, chances)
mutants = st.builds(mutated, chances, st.sampled_from(BENIGN))


@st.composite
def programs(draw):
    """A kind and a random body of it."""
    kind = draw(kinds)
    return kind, body(draw(chances), kind)


def parsed(source, kind):
    """The program, or the NotAllowed that refused it; nothing else may happen."""
    try:
        return parse(source, kind, NAMES)
    except NotAllowed as refusal:
        return refusal


class PretendSolver:
    """Takes every constraint, and says that every unknown is 0."""

    def __init__(self):
        self.unknowns = set()

    def add(self, constraint, weight=None):
        self.unknowns.update(constraint.expression.terms)
        return True

    def values(self):
        return dict.fromkeys(self.unknowns, 0.0)


def run(program):
    return run_code(compile_program(program))


def run_code(code):
    """The draft, or the ProgramError; nothing else may happen."""
    try:
        return execute(code, SCENES[code.program.kind], PretendSolver)
    except ProgramError as error:
        return error


# --- the scan and the parser -------------------------------------------------------------------


def assert_refused_or_listed(source, kind):
    program = parsed(source, kind)
    if isinstance(program, NotAllowed):
        assert program.reason
        assert program.line >= 0
        return
    inside = [node for statement in program.body for node in ast.walk(statement)]
    assert {type(node) for node in inside} <= LISTED
    assert {node.id for node in inside if isinstance(node, ast.Name)} <= names_of(program)


def names_of(program):
    ready = {*builtin.RESERVED, *builtin.OBJECT_CALLS, *prelude(program.kind)}
    return {*ready, *NAMES, *program.absent, *program.variables}


LISTED = {
    *allowed.STATEMENTS, *allowed.EXPRESSIONS, *allowed.BINARY, *allowed.UNARY, *allowed.BOOLEAN,
    *allowed.ORDER, *allowed.IDENTITY, ast.BitOr, ast.Load, ast.Store, ast.comprehension,
}  # fmt: skip
"""Node types that an accepted body may hold; ``|`` joins a constraint and its strength."""


@often
@given(programs())
def test_a_random_tree_is_refused_or_holds_listed_nodes_only(program):
    kind, source = program
    assert_refused_or_listed(source, kind)


@often
@given(mutants, kinds)
def test_a_benign_body_with_changes_is_refused_or_holds_listed_nodes_only(source, kind):
    assert_refused_or_listed(source, kind)


@often
@given(soups, kinds)
def test_a_soup_of_tokens_is_refused_or_holds_listed_nodes_only(source, kind):
    assert_refused_or_listed(source, kind)


@often
@given(st.text(), kinds)
def test_any_text_is_refused_or_holds_listed_nodes_only(source, kind):
    assert_refused_or_listed(source, kind)


def test_about_half_of_the_random_trees_pass_the_allow_list():
    rng = random.Random(1)
    bodies = [(body(rng, kind), kind) for kind in KINDS for _ in range(200)]
    programs = [parsed(source, kind) for source, kind in bodies]
    accepted = [program for program in programs if isinstance(program, Program)]
    assert 0.35 < len(accepted) / len(programs) < 0.65
    ended = [program for program in accepted if isinstance(run(program), Draft)]
    assert len(ended) > 0.3 * len(accepted)


def test_random_trees_hold_every_listed_node():
    rng = random.Random(2)
    trees = [ast.parse(body(rng, kind, wild=False)) for kind in KINDS for _ in range(200)]
    assert {type(node) for tree in trees for node in ast.walk(tree)} >= LISTED


SCAN_ONLY = """\
import sys
from agent.errors import NotAllowed
from agent.program import scan

def refuse(event, arguments):
    if event in ("compile", "exec", "import", "open"):
        raise SystemExit(event)

texts = sys.stdin.buffer.read().decode("utf-8", "surrogatepass").split("\\0\\0")
sys.addaudithook(refuse)
for text in texts:
    try:
        scan(text)
    except NotAllowed:
        pass
"""


def test_the_scan_never_parses():
    rng = random.Random(3)
    texts = [soup(rng) for _ in range(300)] + [body(rng, "manipulate") for _ in range(100)]
    joined = "\0\0".join([*texts, *BENIGN]).encode("utf-8", "surrogatepass")
    done = subprocess.run([sys.executable, "-c", SCAN_ONLY], input=joined, capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")


@often
@given(soups)
def test_the_scan_lets_no_text_through_that_holds_more_than_plain_characters(source):
    try:
        scan(source)
    except NotAllowed:
        return
    assert all(" " <= character <= "~" for character in source.replace("\n", ""))
    assert "__" not in source and "\\" not in source


# --- runs --------------------------------------------------------------------------------------


def assert_good_end(source, kind, outcome):
    """A draft within the budgets, or an error that says where and why."""
    if isinstance(outcome, Draft):
        assert outcome.steps <= MAX_STEPS
        assert len(outcome.commands) <= MAX_COMMANDS
        assert kind == "manipulate" or not outcome.commands
    else:
        assert not isinstance(outcome, SolverFailed)
        assert outcome.reason
        assert outcome.line <= source.count("\n") + 1


@settings(often, max_examples=100)
@given(programs())
def test_a_random_tree_runs_to_a_good_end(program):
    kind, source = program
    accepted = parsed(source, kind)
    assume(isinstance(accepted, Program))
    assert_good_end(source, kind, run(accepted))


@often
@given(mutants, kinds)
def test_a_benign_body_with_changes_runs_to_a_good_end(source, kind):
    accepted = parsed(source, kind)
    assume(isinstance(accepted, Program))
    assert_good_end(source, kind, run(accepted))


@pytest.mark.parametrize("kind", KINDS)
def test_many_random_trees_run_to_a_good_end_and_leave_nothing_behind(kind):
    for seed in SEEDS:
        source = body(random.Random(seed), kind, wild=False)
        accepted = parsed(source, kind)
        if isinstance(accepted, Program):
            code = compile_program(accepted)
            outcome, again = run_code(code), run_code(code)
            assert_good_end(source, kind, outcome)
            assert told(outcome) == told(again), source


def told(outcome):
    """An outcome as something that compares equal when it says the same."""
    if isinstance(outcome, ProgramError):
        return type(outcome), outcome.reason, outcome.line, outcome.column
    return outcome


def random_bodies(kind):
    rng = random.Random(4)
    return [body(rng, kind) for _ in range(BATCH)]


def run_all(executor, bodies, kind):
    return [told(executor.run(source, kind, [SCENES[kind]])[0]) for source in bodies]


@pytest.mark.parametrize("kind", KINDS)
def test_a_worker_keeps_nothing_from_one_program_to_the_next(kind):
    bodies = random_bodies(kind)
    with Executor(deadline_s=5.0) as used, Executor(deadline_s=5.0) as fresh:
        first = run_all(used, bodies, kind)
        again = run_all(used, bodies, kind)
        assert first == again == run_all(fresh, bodies[::-1], kind)[::-1]
    assert kind == "arrange" or SolverFailed not in [outcome[0] for outcome in failed(first)]


def failed(outcomes):
    return [outcome for outcome in outcomes if not isinstance(outcome, Draft)]


# --- slots -------------------------------------------------------------------------------------

PIECES = (
    *NAMES, "m1", "m2", "if", "1.5", "1e5", "+", "(", ")", "[", "]", ",", "=", " ", " ", "\n",
    "'m1 apple'", '"m1 m2"', "'# m1'", '"it\'s m1"', "'a' 'm1'", "# m1 apple\n", "# 'm1\n",
    '# "m1" apple\n', '"""m1"""',
)  # fmt: skip


@settings(often, max_examples=1000)
@given(st.lists(st.sampled_from(PIECES)), st.sampled_from(NAMES))
def test_filling_slots_changes_neither_strings_nor_comments(pieces, name):
    source = "".join(pieces)
    before = tokens(source)
    assume(before is not None)
    filled = tokens(instantiate(source, {"m1": name, "m2": "m1", "apple": "m2"}))
    assert kept(filled) == kept(before)
    assert [t.type for t in filled] == [t.type for t in before]


def tokens(source):
    """Python's tokens, or None where it finds none."""
    try:
        return list(tokenize.generate_tokens(io.StringIO(source).readline))
    except (tokenize.TokenError, SyntaxError):
        return None


def kept(found):
    """The strings and comments among the tokens."""
    return [t.string for t in found if t.type in (tokenize.STRING, tokenize.COMMENT)]


# --- frames ------------------------------------------------------------------------------------


def received(data, largest=1000):
    """What `frames.receive` makes of these bytes when the other end sends them and closes."""
    ours, theirs = socket.socketpair()
    with ours:
        with theirs:
            theirs.sendall(data)
        try:
            return frames.receive(ours, largest)
        except frames.FrameError as error:
            return error


@often
@given(st.binary(max_size=40))
def test_any_bytes_are_a_frame_or_a_frame_error(data):
    found = received(data)
    if isinstance(found, bytes):
        assert data == len(found).to_bytes(4, "big") + found
    else:
        assert isinstance(found, frames.FrameError)


@often
@given(st.binary(max_size=2000), st.integers(0, 3000))
def test_a_frame_is_taken_whole_or_not_at_all(payload, largest):
    found = received(len(payload).to_bytes(4, "big") + payload, largest)
    assert found == payload if len(payload) <= largest else isinstance(found, frames.FrameError)


NUMBERS = (0.0, -0.0, 0.5, -1.5, 5e-324, 1e9, -1e9, 1.1e9, 1e308, -1e308)
LINES = (0, 1, 1, 2, 200, 201, 202, 8192, 8193, -1, 2**70)
WORDS = ("apple_1", "block_1", "block_2", "plate_1", "", "nothing", "é", "\u202e", "x" * 10_001)


def random_reply(rng):
    """A reply as a worker writes it: the right fields, with right and wrong things in them."""
    results = [random_result(rng) for _ in range(rng.choice((1,) * 10 + (0, 2)))]
    return frames.encode(frames.Reply(tuple(results)))


def random_result(rng):
    draft = failure = None
    what = rng.choice(("moves", "places", "failure") * 5 + ("all", "none"))
    if what in ("moves", "places", "all"):
        moves = rng.choice((0, 1, 2, 3)) if what != "places" else 0
        places = rng.choice((0, 1, 1, 2)) if what != "moves" else 0
        draft = Draft(
            tuple(random_command(rng) for _ in range(moves if rng.random() < 0.95 else 501)),
            tuple(random_placement(rng) for _ in range(places)),
            some_line(rng) if rng.random() < 0.95 else MAX_STEPS + rng.randint(0, 1),
        )
    if what in ("failure", "all"):
        kind = rng.choice(("NotAllowed", "ProgramFailed", "SolverFailed"))
        failure = frames.Failure(kind, rng.choice(WORDS), some_line(rng), some_line(rng))
    return frames.Result(draft, failure)


def random_command(rng):
    place = [some_number(rng) for _ in range(4)]
    return Command(rng.choice(("move", "grip")), *place, rng.random() < 0.5, some_line(rng))


def random_placement(rng):
    name = rng.choice(WORDS if rng.random() < 0.1 else WORDS[:3])
    return Placement(name, some_number(rng), some_number(rng), some_line(rng))


def some_number(rng):
    return rng.choice(NUMBERS) if rng.random() < 0.05 else rng.random()


def some_line(rng):
    return rng.choice(LINES) if rng.random() < 0.1 else 1


def read(payload, kind="manipulate"):
    """What the parent makes of a reply; nothing but FrameError may be raised."""
    try:
        return frames.read_reply(payload, frames.Request("pass", kind, (SCENES[kind],)))
    except frames.FrameError as error:
        return error


def assert_checked(results, kind):
    """Refused, or one result that holds nothing which the rest of the system must not see."""
    if isinstance(results, frames.FrameError):
        return
    (result,) = results
    if isinstance(result, Draft):
        waiting = {item.id for item in SCENES[kind].tray}
        assert {placement.object for placement in result.placements} <= waiting
        places = [(c.x, c.y, c.z, c.r) for c in result.commands]
        places += [(p.x, p.y) for p in result.placements]
        assert all(abs(number) <= frames.FARTHEST for place in places for number in place)
        assert len(result.commands) <= MAX_COMMANDS
        assert not (result.commands if kind == "arrange" else result.placements)
        assert 0 <= result.steps <= MAX_STEPS
    else:
        assert isinstance(result, ProgramError)
        assert len(result.reason) <= frames.MAX_REASON


@often
@given(st.binary(max_size=300), kinds)
def test_any_bytes_are_a_checked_reply_or_a_frame_error(payload, kind):
    assert_checked(read(payload, kind), kind)


@settings(often, max_examples=600)
@given(st.builds(random_reply, chances), kinds)
def test_any_reply_is_checked_or_a_frame_error(payload, kind):
    assert_checked(read(payload, kind), kind)


def test_random_replies_are_accepted_and_refused():
    rng = random.Random(5)
    read_all = [read(random_reply(rng), kind) for kind in KINDS for _ in range(300)]
    refused = [result for result in read_all if isinstance(result, frames.FrameError)]
    assert 0.2 < len(refused) / len(read_all) < 0.8
    assert len({str(reason)[:20] for reason in refused}) > 8


HONEST = [
    frames.encode(frames.Reply((result,)))
    for result in (
        frames.Result(draft=Draft((Command("move", 0.1, 0.2, 0.3, 0.0, False, 1),), (), 2)),
        frames.Result(failure=frames.Failure("ProgramFailed", "division by zero", 1, 0)),
    )
]


def test_an_honest_reply_is_read():
    assert [type(read(payload)) for payload in HONEST] == [list, list]


@often
@given(st.sampled_from(HONEST), st.integers(0, 200), st.integers(0, 5), st.binary(max_size=5))
def test_an_honest_reply_with_other_bytes_in_it_is_checked_or_a_frame_error(
    payload, at, length, put
):
    assert_checked(read(payload[:at] + put + payload[at + length :]), "manipulate")


@pytest.mark.parametrize(
    "payload",
    [
        b"[" * 200_000,
        b'{"results":[],"x":' + b"[" * 200_000,
        b'{"results":[{"failure":{"error":"ProgramFailed","reason":"\xff","line":1,"column":0}}]}',
        b'{"results":[{"draft":{"steps":' + b"9" * 5000 + b"}}]}",
    ],
    ids=["deep", "deep-in-a-field", "no-utf8", "huge-number"],
)
def test_a_reply_that_tires_the_decoder_is_a_frame_error(payload):
    assert isinstance(read(payload), frames.FrameError)
