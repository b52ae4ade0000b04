"""Talk to armchat from any program that speaks Zenoh: nothing of armchat is imported here.

    armchat daemon --listen tcp/127.0.0.1:7447
    python examples/remote_client.py tcp/127.0.0.1:7447 "push the apple off the table"
    python examples/remote_client.py tcp/127.0.0.1:7447 "push the cup away" "the left one"

The first sentence is the instruction; the others answer the questions that come, in order. A turn
that asks before anything moves is "asked"; one that "failed" after its tries asks who does the
rest.
Prints one JSON event a line. Exit status: 0 done or answered, 1 refused or failed, 3 nobody there,
4 a question is left open. Any other language does the same: six keys, all JSON.

    armchat/v1/alive/agent/*                 token: the agent is ready
    armchat/v1/instruction/<me>/submit       query: a sentence with a request_id, acknowledged
    armchat/v1/instruction/<me>/event        what happens to it; the event with a "turn" is the last
    armchat/v1/lease/robot/r1/<me>           token: I hold, or want, the robot
    armchat/v1/robot/r1/cmd/acquire          query: make me its owner; keepalive every 250 ms
    armchat/v1/robot/r1/cmd/release          query: give it back
"""

import json
import queue
import sys
import threading
import time
import uuid

import zenoh
from zenoh.handlers import Callback

ROOT = "armchat/v1"
ME = f"example-{uuid.uuid4().hex[:8]}"
JSON = "application/json"


def open_session(endpoint: str) -> zenoh.Session:
    """A client of that endpoint: no scouting, no shared memory, nothing listens here."""
    settings = {
        "mode": "client",
        "connect": {"endpoints": [endpoint], "timeout_ms": 5000, "exit_on_failure": True},
        "scouting": {"multicast": {"enabled": False}},
        "transport": {"shared_memory": {"enabled": False}},
    }
    return zenoh.open(zenoh.Config.from_json5(json.dumps(settings)))


def ask(session: zenoh.Session, key: str, message: dict, timeout: float = 5.0) -> dict:
    """Query and return the answer; an empty list of replies means that nobody is there."""
    payload = json.dumps(message).encode()
    for reply in session.get(key, payload=payload, encoding=JSON, timeout=timeout):
        if reply.ok is not None:
            return json.loads(reply.ok.payload.to_bytes())
        raise RuntimeError(f"{key}: {reply.err.payload.to_string()}")
    raise ConnectionError(f"nobody serves {key}")


class Robot:
    """The lease of robot r1: a token, acquire, and a keepalive every 250 ms until released."""

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._epoch = self._seq = 0
        self._over = threading.Event()
        self._lock = threading.Lock()
        self._name = uuid.uuid4().hex[:12]
        self._beat = threading.Thread(target=self._keep)

    def command(self, verb: str) -> dict:
        with self._lock:
            self._seq += 1
            command = {
                "type": "robot.command/1",
                "client": ME,
                "session": self._name,
                "epoch": self._epoch,
                "seq": self._seq,
                "deadline": time.time() + 5,
            }
        return ask(self._session, f"{ROOT}/robot/r1/cmd/{verb}", command)

    def __enter__(self) -> "Robot":
        self._token = self._session.liveliness().declare_token(f"{ROOT}/lease/robot/r1/{ME}")
        reply = self.command("acquire")
        if not reply["ok"]:
            # Without the robot a sentence is still answered; nothing will move.
            print(f"no lease: {reply['code']}", file=sys.stderr)
        self._epoch = reply["epoch"]
        self._beat.start()
        return self

    def _keep(self) -> None:
        while not self._over.wait(0.25):
            self.command("keepalive")

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._beat.join()
        self.command("release")
        self._token.undeclare()


def say(session: zenoh.Session, events: queue.Queue, text: str) -> dict:
    """Submit a sentence, print its events, return its turn."""
    request_id = uuid.uuid4().hex
    submit = {"type": "instruction.submit/1", "request_id": request_id, "text": text}
    ask(session, f"{ROOT}/instruction/{ME}/submit", submit)
    while True:
        event = events.get(timeout=120)
        if event["request_id"] != request_id:
            continue
        print(json.dumps(event), flush=True)
        if event["stage"] == "turn":
            return event["turn"]


def main(endpoint: str, sentences: list[str]) -> int:
    events: queue.Queue = queue.Queue()
    # A session with a callback must be closed, or the interpreter never ends.
    with open_session(endpoint) as session:
        if not list(session.liveliness().get(f"{ROOT}/alive/agent/*", timeout=2)):
            print("no agent is there", file=sys.stderr)
            return 3
        session.declare_subscriber(
            f"{ROOT}/instruction/{ME}/event",
            Callback(lambda sample: events.put(json.loads(sample.payload.to_bytes()))),
        )
        with Robot(session):
            for sentence in sentences:
                turn = say(session, events, sentence)
                if turn["question"] is None:
                    break
    return {"done": 0, "answered": 0, "asked": 4}.get(turn["status"], 1)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
