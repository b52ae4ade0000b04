"""How sure the detector's places are: fitted on pictures that are in no lesson and no bench.

The network gives a mean error for each thing; its deviation is that times one factor, the larger of
those by which 68.3 % of the errors along x and y lie within one deviation, and 95.4 % within two.
"""

from __future__ import annotations

from itertools import chain
from pathlib import Path

import numpy as np

from evals.bullet_sights import simulated
from evals.detector_bench import SIZE, USUAL, Seen, seen_by
from scene.detector import NetDetector
from scene.export_detector import state
from scene.pictured import Terms, camera_sight
from scene.strange import SEEN

PICTURES = 80


def fit_spread(weights: Path, pictures: int = PICTURES) -> float:
    """Measure the factor on usual, on any, and on PyBullet's tables, and write it to the file."""
    detector = NetDetector(weights=weights)
    usual, anything = USUAL._replace(families=tuple(SEEN)), Terms(most=8)
    tables = (camera_sight(f"spread {number}", terms, *SIZE)
              for number in range(pictures) for terms in (usual, anything))  # fmt: skip
    seen = seen_by(detector, chain(tables, simulated("spread", pictures)))
    factor = detector.spread * _factor(seen)
    state(weights, {"spread": f"{factor:.3f}"})
    return factor


def _factor(seen: Seen) -> float:
    errors = np.array([
        abs(getattr(pair.label, axis) - getattr(pair.seen, axis)) / pair.seen.sd
        for pair in seen.pairs if pair.seen for axis in ("x", "y")
    ])  # fmt: skip
    return float(max(np.quantile(errors, 0.683), np.quantile(errors, 0.954) / 2))
