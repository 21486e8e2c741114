"""One of every class, made once, for the calls of the namespace."""

import atexit
import contextlib
import dataclasses
import functools
import inspect
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import rocksteady as rs
from tests.show.calibrated import without_pictures


def square(amplitude: Any, **_: Any) -> dict[str, Any]:
    """Be a case function."""
    return {"value": np.asarray(amplitude, dtype=np.float64) ** 2}


NOISE = rs.motions.BandNoise(rms=0.2, band=(1.0, 5.0), duration=8.0, seed=1)
MANY = [field.name for field in dataclasses.fields(rs.orbits.Attractors)]


@functools.cache
def folder() -> Path:
    """Return the folder with the files of things; it is removed when the process ends."""
    path = Path(tempfile.mkdtemp(prefix="things-"))
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    return path


def made_in_the_folder(make: Callable[[], dict[str, Any]]) -> Callable[[], dict[str, Any]]:
    """Make a function write its files in that folder, wherever the process is."""

    @functools.wraps(make)
    def made() -> dict[str, Any]:
        with contextlib.chdir(folder()):
            return make()

    return made


@functools.cache
def resting_branches() -> rs.branches.RestingBranches:
    """Return orbits that come to rest, over a parameter."""
    bare = rs.DimensionlessBlock(restitution=0.8)
    lifted = rs.Harmonic(amplitude=1.05, frequency_ratio=2.0)
    return rs.branches.find_resting_branches(
        bare, lifted, "amplitude", (0.99, 1.06), resolution=0.035
    )


def on_floors(described: rs.risk.DescribedObject, motions: list[rs.Record]) -> dict[str, Any]:
    """Return a building, whose file is written, and a table of objects in it."""
    house = rs.risk.Building.of_first_mode("house", storeys=2, period_s=0.3)
    text = '[[buildings]]\nname = "house"\nstoreys = 2\nperiod_s = 0.3\n'
    Path("buildings.toml").write_text(text, encoding="utf-8")
    upstairs = rs.risk.DescribedObject(values={**described.values, "floor": 2})
    peaks = rs.risk.Peaks(pga_g=0.3)
    table = rs.assess_objects([upstairs], motions, buildings=[house], demand=peaks)
    return {"house": house, "on floors": table}


@functools.cache
@made_in_the_folder
def things() -> dict[str, Any]:
    """Return one of every class, made once."""
    block = rs.Block.rectangle(width=0.4, height=1.2)
    bare = rs.DimensionlessBlock(restitution=0.8)
    shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    t = np.arange(60) * 0.05
    record = rs.Record(acceleration_m_s2=4.0 * np.sin(5.0 * t), dt_s=0.05, name="made")
    run = rs.simulate(block, shaking, cycles=3)
    pulse = rs.Pulse(shape="half-sine", amplitude=2.0, frequency_ratio=4.0)
    pushed = rs.simulate(block, pulse)
    orbit = rs.find_attractor(bare, shaking, start=rs.Steady()).orbit
    assert orbit is not None
    (branch,) = rs.branches.find_branches(
        [orbit], "amplitude", (1.9, 2.1), largest_step=0.1, max_branches=1
    )
    point = branch.points[0]
    fold = rs.branches.BranchPoint(
        type=rs.branches.PointType.FOLD, arclength=0.0, chain=point.chain
    )
    recording = rs.records.Recording(
        record=record, format="peer", path=Path("made.AT2"), units_in_file="g", component="000"
    )
    spectrum = rs.compute_rocking_spectrum(record, alpha=[0.2, 0.3], periods_s=[1.0, 2.0])
    other = rs.Record(acceleration_m_s2=np.array([0.0, 3.0, -3.0]), dt_s=0.2, name="other")
    suite = rs.compute_rocking_spectrum([record, other], alpha=0.2, periods_s=[1.0, 2.0])
    grid = rs.sweeps.Grid(axes=(rs.sweeps.Axis(name="amplitude", values=[1.0, 2.0]),))
    maps = rs.map_attractors(
        bare, axes={"amplitude": [1.0, 2.0], "frequency_ratio": [3.0, 4.0]}, max_cycles=50
    )
    few = [-0.5, 0.0, 0.5]
    edge = rs.find_edge_state(bare, rs.Harmonic(amplitude=0.1, frequency_ratio=4.0))
    saddles = rs.basins.find_hilltop_saddles(bare, edge.motion)[:1]
    states = rs.formulas.steady_states(2.0, 4.0, 0.8)
    hazard = rs.risk.HazardCurve(
        measure="pgv_m_s", levels=np.array([0.1, 0.5, 1.0]), rates=np.array([1e-2, 1e-4, 1e-5])
    )
    Path("hazard.csv").write_text("PGA [g],annual rate\n0.1,0.01\n1,0.0001\n", encoding="utf-8")
    Path("peaks.csv").write_text("peak_rad\n0.2\n0.16\n0.13\n", encoding="utf-8")
    Path("objects.csv").write_text("name,width_m,height_m\nvase,0.1,0.5\n", encoding="utf-8")
    Path("object.toml").write_text(
        "name = 'vase'\n[geometry]\nwidth_m = 0.1\nheight_m = 0.5\n", encoding="utf-8"
    )
    described = rs.read_object("object.toml")
    vase = rs.calibration.ObjectPrior(name="vase", width_m="0.10:0.12", height_m=0.5)
    tests = [
        rs.calibration.ShakingTest(
            name=f"test {k}", record=record, object="vase", fell=k > 0, gain=0.5 + k
        )
        for k in range(2)
    ]
    survey = rs.calibration.Survey(
        objects=[vase, rs.calibration.ObjectPrior(name="urn", width_m=0.2, height_m=0.5)],
        fell=[True, False],
    )
    falls = rs.export.LossState(name="overturned", median=0.4, beta=0.5)
    sliding = rs.risk.DescribedObject(
        values={**described.values, "friction": 0.1, "demand": {"pga_g": 0.5, "pgv_m_s": 0.5}}
    )
    assessed = rs.assess_object(sliding, [record, other])
    eleven = rs.motions.make_synthetic_suite(11)
    for path in ("kept.zarr", "made.csv"):
        if path.endswith("csv"):
            Path(path).write_text("t (s),acc (m/s2)\n0,0\n0.1,1\n0.2,-1\n", encoding="utf-8")
        else:
            rs.sweeps.evaluate(
                square, grid, (rs.sweeps.Output(name="value"),), run=rs.Execution(store=path)
            )
    levels = rs.risk.Levels("pga_g", [0.4, 0.8, 1.6])
    fragility = rs.compute_fragility(
        block,
        [record, other],
        levels=levels,
        restitution=rs.risk.RestitutionBand(draws=1),
        states=["uplift", "overturned"],
    )
    demand = rs.Demand(pga_g=0.5, pgv_m_s=0.6)
    screens = rs.screen_block(block, demand)
    observations = rs.calibration.Observations(tests=tests, objects={"vase": vase})
    calibration = rs.calibrate(observations, most_runs=100, folds="test")
    if not Path("calibrated").exists():
        with without_pictures():
            rs.export.write_calibration(calibration, "calibrated")
    return {
        **facade_things(record),
        "survey": survey,
        "calibrated": "calibrated",
        "back analysis": rs.back_analyse(
            survey,
            [record, other],
            scan=rs.calibration.ScanOptions(levels=6, draws=2, temper=0.5, trials=0),
        ),
        "levels": levels,
        "fragility": fragility,
        "state_fragility": fragility.states[0],
        "demand": demand,
        "peaks": rs.risk.Peaks(pga_g=0.3, pgv_m_s=0.3),
        "target": rs.risk.Target(0.01, years=50.0),
        "screens": screens,
        "screen": screens.rows[0],
        "quick": rs.risk.assess_by_formula(block, 0.5, 0.6),
        "block": block,
        "bare": bare,
        "shaking": shaking,
        "view": rs.export.ExplorerView(block=block, motion=shaking),
        "record": record,
        "run": run,
        "pulse": pulse,
        "orbit": orbit,
        "doubling": rs.find_orbits(
            bare, rs.Harmonic(amplitude=2.0, frequency_ratio=2.0), max_period=1
        )[0],
        "branch": branch,
        "point": point,
        "fold": fold,
        "resting": resting_branches(),
        "resting branch": resting_branches().branches[0],
        "resting point": resting_branches().branches[0].points[9],
        "recording": recording,
        "set": rs.records.RecordSet(name="made", horizontal=(recording,)),
        "spectrum": spectrum,
        "suite": suite,
        "summary": rs.measures.compute_suite_spectrum(suite),
        "grid": grid,
        "object": described,
        "facts": rs.risk.compute_object_facts(described),
        "assessment": assessed,
        "assessed runs": rs.assess_object(described.with_peaks(pga_g=0.5, pgv_m_s=0.3), eleven),
        "objects": rs.assess_objects(
            [described], eleven, demand=rs.risk.Peaks(pga_g=0.3, pgv_m_s=0.3)
        ),
        **on_floors(described, eleven),
        "placed": rs.motions.place_on_spectrum(eleven[:2], "en1998-1:2004:type1:A:ag=0.25"),
        "output": rs.sweeps.Output(name="value"),
        "map": maps,
        "basins": rs.compute_basins(bare, shaking, angles=few, velocities=few, max_cycles=20),
        "shares": rs.basins.compute_basin_shares(
            bare,
            shaking,
            "amplitude",
            [1.9, 2.0],
            sampling=rs.basins.SamplingOptions(angles=few, velocities=few, max_cycles=20),
        ),
        "entropy": rs.basins.compute_basin_entropy([[0, 1], [0, 0]], 2),
        "exponent": rs.basins.compute_uncertainty_exponent(
            [0, 0, 1, 1, 1, 1, 0, 0, 1, 0, 1], [1, 2, 3]
        ),
        "boundary": rs.basins.check_boundary([[0] * 9 + [1] * 9] * 18, 2, balls=100),
        "erosion": rs.compute_erosion(
            bare, shaking, [0.5, 3.0], angles=few, velocities=few, cycles=5
        ),
        "edge": edge,
        "hilltop": saddles[0],
        "manifold": rs.basins.compute_manifold(saddles[0], kind="stable", length=0.5, spacing=0.1),
        "fates": rs.compute_fate_basins(block, pulse, angles=few, velocities=few),
        "noise": NOISE,
        "both components": rs.BaseMotion(record, other),
        "series": rs.motions.FourierSeries(
            amplitude=1.2, frequency_ratio=4.0, harmonics=((2, 0.5, 0.3),)
        ),
        "impulses": rs.motions.Impulses(velocities=(0.5, -0.7), times=(0.5, 1.5)),
        "pieces": rs.Piecewise(
            pieces=(
                rs.motions.Segment(duration=1.0, constant=1.5),
                rs.motions.Segment(duration=2.0, slope=-0.5),
            )
        ),
        "still": rs.Still(),
        "synthetic": rs.SyntheticMotion(rms=0.5, frequency_ratio=6.0, duration=10.0, seed=1),
        "noise fates": rs.compute_noise_fates(
            block, pulse, NOISE, axes={"level": [0.0, 1.0], "scale": [0.5, 1.0]}, draws=2
        ),
        "pushed": pushed,
        "neighbours": rs.check_neighbours(pushed),
        "trail": rs.orbits.sweep_attractor(bare, shaking, "amplitude", [1.9, 2.0], max_cycles=50),
        "diagram": rs.find_bifurcations(
            bare,
            shaking,
            "amplitude",
            within=(1.9, 2.1),
            values=2,
            search=rs.branches.BranchOptions(max_period=1, max_impacts=2, doublings=1),
        ),
        "curves": rs.find_bifurcation_curves(
            bare,
            shaking,
            within=((3.9, 4.1), (0.1, 1.0)),
            search=rs.branches.CurveOptions(lines=(1, 0), max_impacts=2, max_period=1),
        ),
        "cascade": rs.branches.Cascade(parameter="amplitude", points=branch.points),
        "course": rs.measures.integrate_record(record),
        "bifurcation": rs.branches.Bifurcation(point=fold, branches=(1,), highest=0.2, lowest=-0.2),
        "many": rs.orbits.find_attractors([0.5, 2.0], 4.0, 0.8, velocity=0.2, max_cycles=50),
        "response": rs.measures.compute_response_spectrum(record, [0.5, 1.0]),
        "curve": rs.compute_response_curve(bare, 2.0, frequency_ratio=[3.0, 4.0]),
        "states": states,
        "steady": rs.orbits.compute_steady_orbit(2.0, 4.0, 0.8, samples=11),
        "regions": rs.orbits.compute_region_map([3.0, 4.0], 0.8),
        "windows": rs.find_overturning_windows(
            bare, "half-sine", [3.0, 3.5], within=(3.0, 4.0), resolution=0.1
        ),
        "scales": rs.find_overturning_scales(block, record, within=(1.0, 1.2), resolution=0.1),
        "kicks": rs.find_fatal_kicks(block, times_pt=[0.0, 1.0]),
        "attractor": rs.find_attractor(bare, shaking, max_cycles=50),
        "state": rs.histories.ImpactState(side=1, phase=0.5, speed=0.3),
        "map_of_return": rs.orbits.ReturnMap(bare, shaking),
        "store": rs.Store("new.zarr"),
        "hazard": hazard,
        "risk": rs.compute_risk((0.4, 0.5), hazard),
        "branch test": rs.risk.check_hazard_branches((0.4, 0.5), [hazard], 10_000.0),
        "boundaries": rs.orbits.compute_region_boundaries(4.0, 0.8),
        "fragility_curve": rs.risk.fit_curve([0.2, 0.4, 0.8], [1, 9, 14], [15, 15, 15]),
        "restitution_fit": rs.fit_restitution([0.2, 0.16, 0.13, 0.11, 0.1, 0.09], block),
        "loss state": falls,
        "component": rs.export.LossComponent(
            identifier="RS.vase", measure="pga_g", states=(falls,)
        ),
        "spread": rs.calibration.PriorRange.parse("0.3:0.4"),
        "object prior": vase,
        "prior": rs.calibration.Prior(),
        "shaking test": tests[0],
        "observations": observations,
        "calibration": calibration,
        "validation": calibration.validation,
        "predictions": calibration.validation.predictions,
        "posterior": calibration.posteriors["vase"],
        "scores": calibration.validation.rows["predicted"],
        "installation": rs.installation.check_installation(),
        **proof_things(),
    }


def proof_things() -> dict[str, Any]:
    """Return one of every class of proofs, and a file of a certificate."""
    chaos = rs.proofs.certify_chaos(0.6, 2.0, 0.8)
    file = Path(tempfile.mkdtemp()) / "chaos.json"
    file.write_text(chaos.to_json(), encoding="utf-8")
    return {
        "chaos": chaos,
        "certificate file": file,
        "checked certificate": rs.proofs.check_certificate(file),
        "proved region": rs.proofs.certify_region((1.9, 2.1), (1.9, 2.1), 0.8, most_boxes=20),
    }


def facade_things(record: rs.Record) -> dict[str, Any]:
    """Return one of every class of facades."""
    front = rs.codes.Facade(
        name="front",
        thickness_m=0.4,
        height_m=4.0,
        loads=(rs.codes.Load(name="roof", weight_kn=4.0, x_m=0.2, z_m=4.0),),
        masses=(rs.codes.PushingMass(name="vault", weight_kn=3.0, z_m=2.0),),
        ties=(rs.codes.Tie(name="rods", force_kn=2.0, z_m=3.0),),
        thrusts=(rs.codes.Thrust(name="vault", force_kn=0.5, z_m=2.0),),
    )
    site = rs.codes.ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.3, soil="B")
    floor = rs.codes.SpectrumTable(
        periods_s=[0.0, 0.5, 6.0], values_g=[0.3, 0.9, 0.02], damping=0.05
    )
    seven = rs.codes.RecordDemand(records=tuple(record.scaled(0.7 + 0.1 * k) for k in range(7)))
    loads = rs.codes.FacadeDemand(sld=site, slv=floor, slc=seven)
    fronts = rs.codes.run_facade(front, seven.records, scale=0.1)
    return {
        "facade": front,
        "mechanism": front.mechanism,
        "elastic spectrum": site,
        "design spectrum": rs.codes.make_design_spectrum(site),
        "spectrum table": floor,
        "record demand": seven,
        "facade demand": loads,
        "facade file": rs.codes.DescribedFacade(facade=front, demand=loads),
        "facade runs": fronts,
        "facade check": rs.check_facade(front, loads, runs=fronts),
    }


def fields(thing: Any) -> dict[str, Any]:
    """Return the arguments that make a dataclass or a named tuple again."""
    names = inspect.signature(type(thing)).parameters
    return {name: getattr(thing, name) for name in names}
