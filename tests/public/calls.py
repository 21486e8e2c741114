"""One valid call of every public function, constructor and method, cheap enough to repeat."""

import functools
import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np

import rocksteady as rs
from rocksteady.results.result import Result
from tests.public.dynamics_calls import dynamics_calls
from tests.public.facade_calls import facade_calls
from tests.public.observation_calls import observation_calls
from tests.public.proof_calls import proof_calls
from tests.public.risk_calls import risk_calls
from tests.public.things import MANY, fields, folder, made_in_the_folder, square, things
from tools.namespace import THINGS

ELSEWHERE = {"installation", "check_installation", "Installation", "KernelCheck"}
"""Things and calls whose answer is the machine's."""
PICTURES = ("plot_", "animate")
"""Begin names of calls whose answers are compared as pictures."""
LONG = {"write_calibration", "write_facade"}
"""Calls that take seconds."""
REFUSED_LATER = {"follow_bifurcation"}
"""Calls that succeed, and whose points are refused: the fold is made up, and no curve leaves it."""


class Call(NamedTuple):
    """A call that succeeds."""

    function: Callable[..., Any]
    arguments: dict[str, Any]
    """By name; "*" holds those of ``*args``."""
    parameters: tuple[str, ...]
    """All that it takes, in order."""

    def __call__(self, **changed: Any) -> Any:
        """Call with some arguments changed."""
        arguments = {**self.arguments, **changed}
        kinds = inspect.signature(self.function).parameters
        places = [n for n in self.parameters if kinds[n].kind is inspect.Parameter.POSITIONAL_ONLY]
        row = [arguments.pop(name) for name in places if name in arguments]
        for name in self.parameters:
            if kinds[name].kind is inspect.Parameter.VAR_POSITIONAL:
                row += arguments.pop(name)
        return self.function(*row, **arguments)


def room() -> Path:
    """Return the folder with the files of things and of calls."""
    calls()
    return folder()


@functools.cache
@made_in_the_folder
def calls() -> dict[str, Call]:
    """Return every call by a label, as ``Block.rectangle``."""
    t = things()
    block, bare, shaking, record, run = (
        t[name] for name in ("block", "bare", "shaking", "record", "run")
    )
    few = [-0.5, 0.0, 0.5]
    axes = {"amplitude": [1.0, 2.0], "frequency_ratio": [3.0, 4.0]}
    segment = rs.motions.Segment(duration=1.0, constant=2.0)
    table: dict[Any, dict[str, Any]] = {
        rs.sweeps.Axis: {"name": "amplitude", "values": [1.0, 2.0]},
        rs.Block: {"positive": block.positive, "negative": block.negative},
        rs.Block.asymmetric: {"left": 0.15, "right": 0.25, "height": 1.2},
        rs.Block.from_alphas: {"positive": 0.2, "negative": 0.3, "radius": 1.0},
        rs.Block.frame: {"columns": 4, "cap_mass_ratio": 2.0, "width": 0.4, "height": 1.2},
        block.capped: {"columns": 4, "cap_mass_ratio": 2.0},
        rs.Block.from_p: {"alpha": 0.2, "p": 2.0},
        rs.Block.from_radius: {"alpha": 0.2, "radius": 1.0},
        rs.Block.general: {"mass": 2.0, "inertia": 3.0, "radius": 1.0, "alpha": 0.2},
        rs.Block.rectangle: {"width": 0.4, "height": 1.2},
        block.with_restitution: {"restitution": 0.7},
        block.dimensionless: {},
        rs.DimensionlessBlock: {"restitution": 0.8},
        bare.with_restitution: {"restitution": 0.7},
        bare.dimensionless: {},
        rs.export.ExplorerView: {"block": block, "motion": shaking, "tab": "basins"},
        rs.write_explorer: {"path": "page.html", "view": t["view"], "records": [record]},
        rs.sweeps.Grid: {"axes": t["grid"].axes},
        t["grid"].at: {"numbers": np.array([0, 1])},
        t["grid"].cells: {"first": 0, "stop": 2},
        t["grid"].axes[0].at: {"indices": [0, 1]},
        rs.Harmonic: {"amplitude": 2.0, "frequency_ratio": 4.0},
        rs.Harmonic.from_si: {"block": block, "acceleration_m_s2": 4.0, "frequency_hz": 2.0},
        shaking.acceleration_m_s2: {"block": block},
        shaking.frequency_hz: {"block": block},
        shaking.segments: {},
        rs.histories.ImpactState: {"side": 1, "phase": 0.5, "speed": 0.3},
        rs.motions.Impulses: {"velocities": (0.5,)},
        rs.motions.Impulses.from_si: {"block": block, "velocities_m_s": (0.5,)},
        rs.motions.Impulses(velocities=(0.5,)).segments: {},
        rs.sweeps.Output: {"name": "value"},
        rs.Piecewise: {"pieces": (segment,)},
        rs.Piecewise(pieces=(segment,)).segments: {},
        rs.Pulse: {"shape": "half-sine", "amplitude": 2.0, "frequency_ratio": 4.0},
        rs.Pulse.from_si: {
            "block": block,
            "shape": "half-sine",
            "acceleration_m_s2": 4.0,
            "frequency_hz": 2.0,
        },
        rs.Pulse.lasting: {"duration": 1.0, "shape": "half-sine", "amplitude": 2.0},
        t["pulse"].acceleration_m_s2: {"block": block},
        t["pulse"].frequency_hz: {"block": block},
        t["pulse"].segments: {},
        rs.Record: {"acceleration_m_s2": [0.0, 1.0, -1.0], "dt_s": 0.01},
        record.scaled: {"factor": 2.0},
        record.reversed: {},
        rs.records.RecordSet: {"name": "made"},
        t["set"].aligned: {"method": "trim"},
        rs.records.RecordSuite: {"recordings": (t["recording"],)},
        rs.records.Recording: {
            "record": record,
            "format": "peer",
            "path": Path("made.AT2"),
            "units_in_file": "g",
        },
        t["recording"].processed: {"record": record, "note": "read again"},
        rs.Rest: {},
        rs.Still: {},
        rs.Still().segments: {},
        rs.orbits.ReturnMap: {"block": bare, "motion": shaking},
        t["map_of_return"].__call__: {"state": t["state"]},
        t["map_of_return"].passages: {"state": t["state"]},
        rs.Linear: {},
        rs.Linear().lower: {"block": bare, "motion": shaking},
        rs.Linear().sides: {"block": bare},
        rs.Nonlinear: {"tolerance": 1e-8},
        rs.Nonlinear().lower: {"block": block, "motion": record},
        rs.Nonlinear().sides: {"block": block},
        rs.floor_motion: {"motion": record, "frequencies_hz": 2.0},
        rs.motions.Floor: {"frequencies_hz": 2.0},
        rs.motions.Floor(frequencies_hz=2.0).motion: {"motion": record},
        rs.motions.Floor(frequencies_hz=2.0).amplification: {"frequency_hz": [1.0, 2.0]},
        rs.motions.Floor(frequencies_hz=2.0).phase_lead: {"frequency_hz": [1.0, 2.0]},
        rs.BaseMotion: {"horizontal": record, "vertical": record},
        rs.BaseMotion(record).scaled: {"factor": 2.0},
        rs.BaseMotion(record).reversed: {},
        rs.Execution: {"executor": "serial", "workers": 1},
        rs.motions.Segment: {"duration": 1.0, "constant": 2.0},
        rs.formulas.Outline: {"height": 1.8},
        rs.formulas.Side: {"alpha": 0.2, "radius": 1.0, "p": 2.0, "restitution": 0.8},
        rs.State: {"angle": 0.1, "velocity": 0.2},
        rs.State.per_tau: {"angle": 0.1, "velocity_tau": 0.2, "frequency_ratio": 4.0},
        rs.Steady: {},
        rs.Store: {"path": "kept.zarr"},
        t["store"].check: {},
        rs.SyntheticMotion: {"rms": 1.0, "frequency_ratio": 3.0, "duration": 5.0, "seed": 1},
        rs.motions.BandNoise: {"rms": 0.2, "band": (1.0, 5.0), "duration": 8.0, "seed": 1},
        rs.motions.BandNoise.from_si: {
            "block": block,
            "rms_m_s2": 0.3,
            "band_hz": (0.5, 4.0),
            "duration_s": 4.0,
            "seed": 1,
        },
        t["noise"].realisation: {"number": 3},
        t["noise"].segments: {},
        rs.motions.add_noise: {"motion": t["pulse"], "noise": t["noise"]},
        rs.motions.cut: {"motion": shaking, "at": 0.5},
        rs.SyntheticMotion.from_si: {
            "block": block,
            "rms_m_s2": 1.0,
            "frequency_hz": 2.0,
            "duration_s": 2.0,
            "seed": 1,
        },
        rs.SyntheticMotion(
            rms=1.0, frequency_ratio=3.0, duration=5.0, seed=1
        ).segments: {},
        run.__call__: {"pt": [0.1, 0.2]},
        run.at_tau: {"tau": [0.1, 0.2]},
        run.at_time: {"t_s": [0.1, 0.2]},
        run.state: {"pt": 0.2},
        t["pushed"].base_force_kn: {"mass_kg": 100.0},
        run.describe: {},
        run.to_columns: {"samples": 10},
        run.to_dataset: {"samples": 10},
        block.describe: {},
        bare.describe: {},
        block.positive.to_dict: {},
        rs.check_neighbours: {"trajectory": t["pushed"]},
        t["neighbours"].describe: {},
        rs.histories.Neighbour: fields(t["neighbours"].cases[0]),
        run.base_acceleration: {"pt": [0.1, 0.2]},
        run.base_displacement: {"pt": [0.1, 0.2]},
        run.phase_path: {"per_unit": 10},
        run.times: {"per_unit": 10},
        t["course"].time_of_arias: {"part": 0.5},
        t["course"].describe: {},
        t["course"].to_dataset: {},
        t["response"].describe: {},
        t["response"].to_dataset: {},
        t["recording"].describe: {},
        t["set"].describe: {},
        t["set"].motions: {},
        t["many"].are: {"kind": rs.outcomes.AttractorKind.SYMMETRIC},
        t["many"].start: {"index": 1},
        rs.orbits.Attractors: {name: getattr(t["many"], name) for name in MANY},
        rs.orbits.find_attractors: {
            "amplitude": [0.5, 2.0],
            "frequency_ratio": 4.0,
            "restitution": 0.8,
            "velocity": 0.2,
            "max_cycles": 50,
        },
        rs.sweeps.Axis.logarithmic: {"name": "amplitude", "start": 1.0, "stop": 8.0, "count": 4},
        rs.Execution().in_memory: {"reason": "it is kept in memory"},
        t["store"].foreign_files: {},
        rs.installation.Installation(
            system="Linux",
            cpu_level=None,
            kernels="python",
            library=None,
            target=None,
            sources="0",
            versions={"rocksteady": "1", "python": "3", "numpy": "2"},
            checks=(),
            gpu=None,
            no_gpu="cuda-python is not installed",
        ).describe: {},
        t["windows"].at: {"index": 0},
        t["scales"].at: {"index": 0},
        t["scales"].describe: {},
        t["scales"].falls: {"index": 0, "scale": 1.1},
        t["scales"].intervals: {"index": 0},
        t["scales"].unlisted: {"index": 0},
        t["scales"].to_dataset: {},
        t["kicks"].at: {"index": 0},
        t["kicks"].describe: {},
        t["kicks"].intervals: {"index": 0},
        t["kicks"].unlisted: {"index": 0},
        t["kicks"].to_dataset: {},
        t["windows"].describe: {},
        t["course"].to_dataframe: {},
        t["windows"].intervals: {"index": 0},
        t["windows"].unlisted: {"index": 0},
        t["windows"].to_dataset: {},
        t["states"].to_dataset: {},
        t["trail"].runs: {},
        t["orbit"].trajectory: {},
        rs.motions.add: {"motions": [t["pulse"], rs.Still()]},
        rs.plots.animate: {"trajectory": run, "span": (0.0, 0.2), "fps": 5.0},
        rs.find_attractor: {"block": bare, "motion": shaking, "max_cycles": 20},
        rs.map_attractors: {"block": bare, "axes": axes, "max_cycles": 20},
        rs.orbits.sweep_attractor: {
            "block": bare,
            "motion": shaking,
            "parameter": "amplitude",
            "values": [1.9, 2.0],
            "max_cycles": 20,
        },
        rs.measures.compute_average_acceleration: {"record": record, "period_s": 0.5},
        rs.records.Cleaning: {"baseline": "mean", "filter_hz": "0.1:2", "trim_s": "0:1"},
        rs.records.Cleaning(baseline="mean").apply: {"recording": t["recording"]},
        rs.compute_basins: {
            "block": bare,
            "motion": shaking,
            "angles": few,
            "velocities": few,
            "max_cycles": 10,
        },
        rs.orbits.compute_region_boundaries: {"frequency_ratio": [3.0, 4.0], "restitution": 0.8},
        rs.motions.delay: {"motion": t["pulse"], "by": 0.5},
        rs.formulas.equivalent_damping: {"restitution": [0.7, 0.8]},
        rs.basins.compute_basin_shares: {
            "block": bare,
            "motion": shaking,
            "parameter": "amplitude",
            "values": [1.9, 2.0],
            "sampling": rs.basins.SamplingOptions(angles=few, velocities=few, max_cycles=10),
        },
        rs.compute_erosion: {
            "block": bare,
            "motion": shaking,
            "amplitudes": [0.5, 3.0],
            "angles": few,
            "velocities": few,
            "cycles": 5,
        },
        rs.sweeps.evaluate: {"cases": square, "grid": t["grid"], "outputs": (t["output"],)},
        rs.Block.named: {"name": "fema-p58-cabinet"},
        rs.export.write_dataset: {"dataset": t["map"], "file": "map.nc"},
        rs.map_fates: {"block": bare, "axes": axes, "cycles": 10},
        rs.formulas.free_rocking_peaks: {"amplitude_ratio": 0.5, "restitution": 0.8, "impacts": 3},
        rs.formulas.free_rocking_period: {"amplitude_ratio": [0.2, 0.5]},
        rs.measures.integrate_record: {"record": record},
        rs.formulas.heteroclinic_amplitude: {"frequency_ratio": 4.0, "restitution": 0.8},
        rs.formulas.housner_restitution: {"alpha": 0.2},
        rs.formulas.impact_restitution: {"alphas": (0.2, 0.3), "radii": (1.0, 1.1), "gyration":
        0.5}, rs.compute_measures: {"record": record},
        rs.motions.join: {"motions": [t["pulse"], shaking]},
        rs.formulas.melnikov_amplitude: {"frequency_ratio": 4.0, "restitution": 0.8},
        rs.open_store: {"path": "kept.zarr"},
        rs.find_orbits: {
            "block": bare,
            "motion": shaking,
            "max_period": 1,
            "max_impacts": 2,
            "seeds": 2,
        },
        rs.formulas.overturning_impulse: {"block": block},
        rs.formulas.overturning_amplitude: {"shape": "half-sine", "frequency_ratio": 4.0},
        rs.find_overturning_windows: {
            "block": bare,
            "pulse": "half-sine",
            "frequency_ratios": [3.0],
            "within": (3.0, 4.0),
            "resolution": 0.1,
        },
        rs.find_overturning_scales: {
            "block": block,
            "motions": record,
            "within": (1.0, 1.2),
            "resolution": 0.1,
        },
        rs.basins.compute_manifold: {
            "saddle": t["hilltop"], "kind": "unstable", "length": 0.5, "spacing": 0.1,
        },
        rs.find_edge_state: {
            "block": bare, "motion": rs.Harmonic(amplitude=0.1, frequency_ratio=4.0),
        },
        rs.basins.find_hilltop_saddles: {"block": bare, "motion": shaking},
        rs.find_fatal_kicks: {"block": block, "times_pt": [0.0, 1.0]},
        rs.compute_fate_basins: {
            "block": block,
            "motion": t["pulse"],
            "angles": few,
            "velocities": few,
        },
        t["fates"].fractions: {"confidence": 0.9},
        t["fates"].state: {"row": 0, "column": 1},
        t["fates"].to_dataset: {},
        t["fates"].to_dataframe: {},
        t["fates"].describe: {},
        t["fates"].fractions()[0].describe: {},
        rs.basins.FateShare: fields(t["fates"].fractions()[0]),
        rs.compute_noise_fates: {
            "block": block,
            "motion": t["pulse"],
            "noise": t["noise"],
            "axes": {"level": [0.0, 1.0]},
            "draws": 2,
        },
        t["noise fates"].interval: {"confidence": 0.9},
        t["noise fates"].to_dataset: {},
        t["noise fates"].describe: {},
        rs.plots.fate_basins: {"fates": t["fates"]},
        rs.plots.noise_fates: {"fates": t["noise fates"]},
        rs.records.pair_records: {"paths": []},
        rs.plots.base: {"motion": run, "quantity": "velocity"},
        rs.plots.basins: {"basins": t["basins"]},
        rs.plots.basin_shares: {"shares": t["shares"], "top": 0.5},
        rs.plots.basin_entropies: {"entropies": t["shares"].entropies(3)},
        rs.plots.uncertainty: {"exponent": t["exponent"]},
        rs.plots.rows: {"result": t["branch test"], "most": 3},
        rs.plots.channels: {"channels": t["set"]},
        rs.plots.survey: {"survey": t["survey"]},
        rs.plots.bifurcation_curves: {"curves": [[t["fold"], t["fold"]]]},
        rs.plots.bifurcations: {"diagram": [t["branch"]], "sweeps": [t["trail"]]},
        rs.plots.block: {"trajectory": run, "pt": 0.1},
        rs.plots.edge_state: {"edge": t["edge"]},
        rs.plots.manifolds: {"manifolds": t["manifold"]},
        rs.plots.cascade: {"cascade": t["cascade"]},
        rs.plots.erosion: {"erosion": t["erosion"]},
        rs.plots.free_rocking: {"restitutions": [0.8], "impacts": 3},
        rs.plots.integrated_record: {"course": t["course"]},
        rs.plots.husid: {"course": t["course"]},
        rs.plots.outcomes: {"dataset": t["map"]},
        t["many"].describe: {},
        t["bifurcation"].describe: {},
        t["state_fragility"].describe: {},
        rs.plots.attractor_kinds: {"attractors": t["many"]},
        rs.plots.hazard_curve: {"curves": t["hazard"]},
        rs.plots.neighbours: {"neighbours": t["neighbours"]},
        rs.plots.assessment: {"assessment": t["assessed runs"]},
        rs.plots.objects: {"table": t["objects"], "most": 3},
        rs.plots.screens: {"screens": t["screens"]},
        rs.plots.steady_states: {"states": t["states"]},
        rs.plots.multipliers: {"orbits": [t["orbit"]]},
        rs.plots.steady_orbit: {"orbit": t["steady"]},
        rs.plots.share_that_falls: {"summary": t["summary"]},
        rs.plots.overturning: {"windows": t["windows"]},
        rs.plots.fatal_kicks: {"kicks": t["kicks"]},
        rs.plots.overturning_scales: {"scales": t["scales"]},
        rs.plots.phase_portrait: {"trajectory": run},
        rs.plots.steady_regions: {"curves": t["regions"]},
        rs.plots.response: {"curves": [t["curve"]]},
        rs.plots.response_spectra: {"spectra": [t["response"]]},
        rs.plots.rocking_spectrum: {"dataset": t["spectrum"]},
        rs.plots.safe_basin: {"erosion": t["erosion"], "index": 0},
        rs.plots.poincare_section: {"motions": [t["orbit"]]},
        rs.plots.spectrum_map: {"dataset": t["spectrum"]},
        rs.plots.suite_spectrum: {"summary": t["summary"]},
        rs.plots.trajectory: {"trajectory": run},
        rs.read_record: {"path": "made.csv"},
        rs.records.read_recordings: {"path": "made.csv"},
        rs.read_records: {"folder": ".", "pattern": "made.csv"},
        rs.orbits.compute_region_map: {"frequency_ratio": [3.0, 4.0], "restitution": 0.8},
        rs.records.resample: {"recording": t["recording"], "dt_s": 0.025},
        rs.compute_response_curve: {"block": bare, "amplitude": 2.0, "frequency_ratio": [3.0, 4.0]},
        rs.measures.compute_response_spectrum: {"record": record, "periods_s": [0.5, 1.0]},
        rs.compute_rocking_spectrum: {"motions": record, "alpha": [0.2], "periods_s": [1.0, 2.0]},
        rs.simulate_many: {"blocks": block, "motions": record, "scales": [1.0, 2.0]},
        rs.motions.scale: {"motion": t["pulse"], "factor": -1.0},
        rs.simulate: {"block": block, "motion": shaking, "cycles": 2.0},
        rs.orbits.compute_steady_orbit: {
            "amplitude": 2.0,
            "frequency_ratio": 4.0,
            "restitution": 0.8,
            "samples": 11,
        },
        rs.find_steady_states: {"block": block, "motion": shaking},
        rs.formulas.steady_states: {"amplitude": 2.0, "frequency_ratio": 4.0, "restitution": 0.8},
        rs.measures.compute_suite_spectrum: {"spectra": t["suite"]},
        rs.formulas.symmetry_breaking_amplitude: {"frequency_ratio": 4.0, "restitution": 0.8},
        rs.formulas.symmetry_breaking_frequencies: {"amplitude": 2.0, "restitution": 0.8},
        rs.basins.ManifoldBranch: fields(t["manifold"].branches[0]),
        rs.overturning.FatalKicks: fields(t["kicks"]),
        rs.overturning.OverturningScales: fields(t["scales"]),
        rs.basins.BasinAttractor: fields(t["basins"].attractors[0]),
        rs.overturning.OverturningWindow: {"low": 1.0, "high": 2.0, "impacts": 1, "side": 1,
        "endless": False}, rs.basins.IntegrityDrop: {
            "measure": "radius", "level": 0.5, "low": 1.0, "high": 2.0, "above": 0.6, "below": 0.4,
        },
        rs.basins.BasinFamily: fields(t["shares"].families[0]),
        rs.basins.BasinEntropies: fields(t["shares"].entropies(1)),
        rs.basins.BasinShare: {"label": 1, "states": 2, "share": 0.5, "low": 0.4, "high": 0.6},
        rs.measures.Peak: {"value": 1.0, "t_s": 0.5},
        rs.branches.BranchOptions: {"orders": (1,), "max_impacts": 2},
        rs.branches.Bifurcation: {"point": t["fold"], "branches": (1,), "highest": 0.2, "lowest":
        -0.2}, rs.find_bifurcations: {
            "block": bare, "motion": shaking, "parameter": "amplitude", "within": (1.9, 2.1),
            "values": 2, "search": rs.branches.BranchOptions(max_period=1, max_impacts=2,
            doublings=0),
        },
        t["states"].for_block: {"block": block},
        t["attractor"].trajectory: {"last": 2},
        **{
            getattr(t[name], method): {}
            for name, methods in (
                ("attractor", ("describe", "rows", "to_dataframe")),
                ("orbit", ("describe", "to_dataframe")),
                ("trail", ("describe", "run_rows", "to_dataframe", "to_dataset")),
                ("trail", ("values_by_kind",)),
                ("branch", ("describe", "rows", "to_dataframe", "to_dataset")),
                ("curves", ("describe", "rows", "to_dataframe")),
                ("resting", ("describe", "rows", "to_dataframe")),
                ("resting branch", ("describe", "rows", "to_dataframe")),
                ("resting point", ("describe",)),
                ("point", ("describe",)),
                ("cascade", ("describe", "to_dataset", "values_by_name")),
                ("diagram", ("describe", "rows", "to_dataframe", "to_dataset")),
                ("states", ("describe", "rows", "to_dataframe")),
                ("steady", ("describe", "to_dataframe")),
                ("regions", ("describe",)),
                ("boundaries", ("describe",)),
                ("curve", ("describe",)),
                ("hazard", ("describe",)),
                ("risk", ("describe", "rows")),
                ("branch test", ("describe", "rows")),
                *(
                    (motion, ("describe", "to_dataframe"))
                    for motion in (
                        *("shaking", "series", "pulse", "impulses", "pieces", "still"),
                        *("noise", "synthetic", "record", "both components"),
                    )
                ),
            )
            for method in methods
        },
        rs.branches.Stretch: {"first": 0, "last": 1, "stable": True, "admissible": True},
        rs.orbits.Passage: fields(t["map_of_return"](t["state"])),
        rs.measures.Measures: fields(rs.compute_measures(record, block)),
        rs.compute_measures(record, block).describe: {},
        rs.histories.Samples: fields(run([0.1, 0.2])),
        rs.installation.check_installation: {},
        rs.installation.Installation: fields(t["installation"]),
        rs.installation.KernelCheck: fields(t["installation"].checks[0]),
    }  # fmt: skip
    results = {
        rs.orbits.Attractor: "attractor", rs.orbits.AttractorSweep: "trail", rs.basins.Basins:
        "basins", rs.basins.BasinShares: "shares", rs.basins.BasinEntropy: "entropy",
        rs.basins.BoundaryCheck: "boundary", rs.basins.UncertaintyExponent: "exponent",
        rs.branches.BifurcationDiagram: "diagram",
        rs.orbits.RegionBoundaries: "boundaries", rs.branches.Branch: "branch",
        rs.branches.BranchPoint: "point", rs.branches.RestingBranches: "resting",
        rs.branches.RestingBranch: "resting branch", rs.branches.RestingPoint: "resting point",
        rs.branches.Cascade: "cascade", rs.basins.Erosion: "erosion", rs.measures.IntegratedRecord:
        "course", rs.basins.EdgeState: "edge", rs.basins.HilltopSaddle: "hilltop",
        rs.basins.Manifold: "manifold", rs.orbits.Orbit: "orbit",
        rs.overturning.OverturningWindows: "windows", rs.orbits.RegionMap: "regions",
        rs.orbits.ResponseCurve: "curve", rs.measures.ResponseSpectrum: "response",
        rs.orbits.SteadyOrbit: "steady", rs.risk.HazardCurve: "hazard", rs.risk.Risk: "risk",
        rs.risk.HazardBranchCheck: "branch test", rs.orbits.SteadyStates: "states",
        rs.histories.Trajectory: "run", rs.histories.Neighbours: "neighbours", rs.risk.Fragility:
        "fragility", rs.risk.StateFragility: "state_fragility",
        rs.basins.FateBasins: "fates", rs.overturning.NoiseFates: "noise fates",
    }  # fmt: skip
    table |= dynamics_calls(t) | risk_calls(t) | observation_calls(t) | facade_calls(t)
    table |= proof_calls(t)
    table |= {kind: fields(t[name]) for kind, name in results.items()}
    table |= {rs.histories.Flights: fields(run.flights), rs.histories.Impacts: fields(run.impacts)}
    found = {}
    for function, arguments in table.items():
        found[label_of(function)] = Call(
            function, arguments, tuple(inspect.signature(function).parameters)
        )
    # Arguments that only one kind of input reaches have a call of that kind too.
    variants = {
        "plot_poincare_section of a trajectory": (
            "plot_poincare_section",
            {"motions": run, "since": 0.1},
        ),
    }
    for label, (name, arguments) in variants.items():
        found[label] = found[name]._replace(arguments=arguments)
    return found


def is_recorded(label: str) -> bool:
    """Return whether each change of a call compares its answer with a record."""
    return label.partition(".")[0] not in LONG | ELSEWHERE and not label.startswith(PICTURES)


def label_of(function: Any) -> str:
    """Return a name as the namespace has it: a method is its object's, wherever it is defined."""
    holder = getattr(function, "__self__", None)
    if inspect.ismethod(function) and not inspect.isclass(holder):
        return f"{type(holder).__name__}.{function.__name__}"
    return str(function.__qualname__)


def public_callables() -> set[str]:
    """Return the labels of all that can be called in the public namespace."""
    found = set()
    for name, thing in THINGS.items():
        if not callable(thing):
            continue
        if inspect.isclass(thing) and issubclass(thing, str | int | Exception):
            continue  # enumerations and errors
        found.add(label_of(thing))
        if inspect.isclass(thing) and not issubclass(thing, tuple):
            # A base class of a private module is a part of the class.
            # So is what results with windows share, and motions.
            shared = ("._", "window_lists", "described_motion")
            bases = [b for b in thing.__mro__[1:] if any(part in b.__module__ for part in shared)]
            members = {method: vars(base)[method] for base in bases for method in vars(base)}
            if issubclass(thing, Result):
                members["describe"] = Result.describe  # by the words of each class
            for method, member in (members | dict(vars(thing))).items():
                routine = isinstance(member, classmethod | staticmethod) or inspect.isfunction(
                    member
                )
                if routine and (not method.startswith("_") or method == "__call__"):
                    found.add(f"{name}.{method}")
    return found


def close_pictures() -> None:
    """Close all figures."""
    plt.close("all")
