"""One valid call of every public function and method on proofs and certificates."""

from typing import Any

import rocksteady as rs
from tests.public.things import fields


def proof_calls(t: dict[str, Any]) -> dict[Any, dict[str, Any]]:
    """Return the arguments of each call by its function, from things of `tests.public.things`."""
    chaos, region, found = t["chaos"], t["proved region"], t["checked certificate"]
    return {
        rs.proofs.Certificate: fields(chaos),
        rs.proofs.CheckedCertificate: fields(found),
        rs.proofs.ProvedRegion: fields(region),
        rs.proofs.certify_orbit: {"origin": t["orbit"]},
        rs.proofs.certify_point: {"origin": t["fold"]},
        rs.proofs.certify_fate: {"block": t["bare"], "motion": t["pulse"]},
        rs.proofs.certify_edges: {"windows": t["windows"], "places": 6},
        rs.proofs.certify_region: {
            "amplitude": (1.9, 2.1),
            "frequency_ratio": (1.9, 2.1),
            "restitution": 0.8,
            "most_boxes": 20,
        },
        rs.proofs.certify_chaos: {"amplitude": 0.6, "frequency_ratio": 2.0, "restitution": 0.8},
        rs.proofs.check_certificate: {"file": t["certificate file"]},
        rs.plots.proved_region: {"region": region},
        chaos.describe: {},
        chaos.to_json: {},
        found.describe: {},
        region.boxes: {},
        region.check: {"leaves": 5},
        region.describe: {},
        region.grid: {"rows": 4, "columns": 5},
        region.to_json: {},
        region.values: {},
        region.box_json: {"path": "0", "letter": "2"},
    }
