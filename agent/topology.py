"""A Zenoh session's configuration as JSON5: who listens, who connects, who is looked for."""

from __future__ import annotations

import json

LEASE_MS = 1000
CONNECT_MS = 5000


def settings(mode: str, listen: tuple[str, ...], connect: tuple[str, ...], scout: bool) -> str:
    """The JSON5 of a Zenoh configuration. Only what is named here is listened on, never more."""
    multicast = {"enabled": scout, "interface": "lo"}
    block = {"block": {"wait_before_close": 500_000}}
    retry = {"period_init_ms": 100, "period_max_ms": 500, "period_increase_factor": 2}
    tree = {
        "mode": mode,
        "listen": {"endpoints": list(listen), "exit_on_failure": True},
        "connect": {
            "endpoints": list(connect),
            "timeout_ms": CONNECT_MS,
            "exit_on_failure": True,
            "retry": retry,
        },
        "scouting": {
            "delay": 100 if scout else 0,
            "multicast": multicast if scout else {"enabled": False},
            "gossip": {"enabled": scout},
        },
        "timestamping": {"enabled": True},
        "transport": {
            "shared_memory": {"enabled": False},
            "link": {"tx": {"lease": LEASE_MS, "queue": {"congestion_control": block}}},
        },
    }
    return json.dumps(tree)
