"""What the fuzzers of `make fuzz` share: first inputs into a folder, then libFuzzer."""

import sys
from pathlib import Path

import atheris


def fuzz(one_input, seeds):
    """Write the seeds into the folder of the command line and fuzz until its options say stop."""
    for number, seed in enumerate(seeds):
        (Path(sys.argv[1]) / f"seed-{number}").write_bytes(seed)
    atheris.Setup(sys.argv, one_input)
    atheris.Fuzz()
