"""One valid call of every public function and method on facades."""

from pathlib import Path
from typing import Any

import rocksteady as rs
from tests.public.things import fields


def facade_calls(t: dict[str, Any]) -> dict[Any, dict[str, Any]]:
    """Return the arguments of each call by its function, from things of `tests.public.things`."""
    facade, found, runs, table = (
        t[name] for name in ("facade", "facade check", "facade runs", "spectrum table")
    )
    site, mechanism, records = t["elastic spectrum"], facade.mechanism, t["record demand"]
    Path("facade.toml").write_text(
        '[facade]\nname = "front"\nthickness_m = 0.4\nheight_m = 4.0\n', encoding="utf-8"
    )
    Path("floor.csv").write_text("period_s,sa_g\n0,0.3\n0.5,0.9\n6,0.02\n", encoding="utf-8")
    point = {"period_s": 0.5, "damping": 0.08}
    return {
        t["block"].against_wall: {"restitution": 0.4},
        rs.codes.Facade: fields(facade),
        rs.codes.Load: fields(facade.loads[0]),
        rs.codes.PushingMass: fields(facade.masses[0]),
        rs.codes.Tie: fields(facade.ties[0]),
        rs.codes.Thrust: fields(facade.thrusts[0]),
        rs.codes.Mechanism: fields(mechanism),
        mechanism.block: {},
        mechanism.capacity_g: {"displacement_m": 0.05},
        mechanism.period_s: {"share": 0.4, "factor": 1.68},
        mechanism.describe: {},
        rs.codes.ElasticSpectrum: fields(site),
        site.sa_g: point,
        site.displacement_m: point,
        rs.codes.make_design_spectrum: {
            "spectrum": [[0.0, 0.3], [0.3, 0.8], [4.0, 0.1]],
            "spectrum_damping": 0.05,
        },
        rs.codes.DesignSpectrum: fields(t["design spectrum"]),
        t["design spectrum"].accelerations_g: {"periods_s": [0.2, 1.0]},
        rs.codes.SpectrumTable: {
            "periods_s": [0.0, 0.5, 6.0],
            "values_g": [0.3, 0.9, 0.02],
            "damping": 0.05,
        },
        table.sa_g: point,
        table.displacement_m: point,
        table.remark: {"damping": 0.08},
        rs.codes.read_spectrum_table: {"path": "floor.csv", "spectrum_damping": 0.05},
        rs.codes.RecordDemand: fields(records),
        records.sa_g: point,
        records.displacement_m: point,
        records.displacements_m: point,
        rs.codes.FacadeDemand: fields(t["facade demand"]),
        t["facade demand"].of: {"limit_state": "SLV"},
        rs.read_facade: {"path": "facade.toml"},
        rs.codes.DescribedFacade: fields(t["facade file"]),
        t["facade file"].describe: {},
        rs.check_facade: {"facade": facade, "demand": t["facade demand"], "runs": runs},
        rs.codes.FacadeCheck: fields(found),
        found.describe: {},
        found.decided: {"limit_state": "SLV", "satisfied": True},
        rs.codes.LimitStateCheck: fields(found.checks[0]),
        rs.codes.run_facade: {"facade": facade, "records": [t["record"]], "scale": 0.1},
        rs.codes.FacadeRuns: fields(runs),
        runs.describe: {},
        rs.plots.facade_section: {"facade": facade},
        rs.plots.facade_capacity: {"check": found},
        rs.plots.facade_runs: {"runs": runs},
        rs.export.write_facade: {"check": found, "out": "facade", "force": True},
    }
