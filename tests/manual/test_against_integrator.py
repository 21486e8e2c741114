"""Commands of the manual that name a block's size, against SciPy's DOP853 on the full equations.

Each line is read from the page or the help text that shows it, so that no list can drift.  Fate,
peak, time of the fall and, where it still rocks, number of impacts are those of
`tests.dynamics.full_integrator.follow`, which knows nothing of the package but the names of its
arguments.  Numbers agree to 1e-12, some 20 times what was found, times the growth of
small differences in that run.
"""

import argparse
import csv
import math
import re
import shlex
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.formulas import Side
from tests.cli.program import rocksteady
from tests.dynamics.full_integrator import Ground, Whole, follow, still
from tests.every import every
from tests.manual.lines import HELP, PAGES, ROOT, of_reader, shortened, typed_lines, write_files

G = 9.80665
AGREE = 1e-12
NEAR = 1e-7
"""Part of an end of a window at which the block must fall on one side and stand on the other."""
MANY = 3
"""Cells, windows or orbits of a line that are looked at."""
SIZED = re.compile(r"--(width-m|alpha-rad|left-m|block) ")
MADE = re.compile(r"rocksteady simulate (.+?)\s--plot", re.DOTALL)
LEFT_OUT = re.compile(r"--model linear|--participation|--pair|one-sine .*--floor-hz")
"""The other model, and floors and pairs of channels, which tests/model and tests/records hold."""
SLOW = re.compile(r"--kick --record|--records|overturn .*(-W|--freq-hz) \S+:")


def lines() -> list[str]:
    """Return the command lines to hold against the integrator."""
    demo = " ".join(MADE.findall((ROOT / "Makefile").read_text("utf-8"))[0].split())
    found = [f"simulate {demo.replace(chr(92), '')}"]
    found += [line for text in (PAGES | HELP).values() for line in typed_lines(text)]
    return list(dict.fromkeys(bare(line) for line in found if SIZED.search(f"{line} ")))


def bare(line: str) -> str:
    """Return a command line without what only says where its answer goes."""
    line = re.sub(r" --(plot|animate|csv|out|speed) \S+| --(more|json|force)\b", "", line)
    return re.sub(r" +", " ", line).strip()


def of(command: str, *, slow: bool = False) -> list[str]:
    """Return the lines of a command, the slow ones or the others."""
    mine = [line for line in LINES if line.startswith(f"{command} ")]
    return [line for line in mine if bool(SLOW.search(line)) == slow]


LINES = [line for line in lines() if not LEFT_OUT.search(line)]

# ---------------------------------------------------------------------------- what a line says


def asked(line: str) -> argparse.Namespace:
    """Return the flags of a line that say how the base moves and the block starts."""
    parser = argparse.ArgumentParser(allow_abbrev=False)
    for name in ("pulse", "record", "start", "vertical", "units"):
        parser.add_argument(f"--{name}")
    for name in (
        "accel-g",
        "accel-m-s2",
        "freq-hz",
        "floor-hz",
        "scale",
        "pga-g",
        "dt-s",
        "width-m",
        "height-m",
    ):
        parser.add_argument(f"--{name}", type=str)
    parser.add_argument("--harmonic", action="append", default=[])
    parser.add_argument("--reverse", action="store_true")
    parser.add_argument("--one-sided", action="store_true")
    parser.add_argument("--cycles", type=float, default=50.0)
    parser.add_argument("-A", type=str)
    parser.add_argument("-W", type=str)
    known, _ = parser.parse_known_args(shlex.split(line)[1:])
    return known


def sides_of(block: dict[str, Any], *, one_sided: bool = False) -> tuple[Side, Side | None]:
    """Return both sides of the block of an answer; None against a wall."""
    right, left = (
        Side(
            alpha=each["alpha_rad"],
            radius=each.get("radius_m", 1.0),
            p=each["p_rad_s"],
            restitution=each["restitution"],
        )
        for each in (block, block.get("negative", block))
    )
    return right, None if one_sided else left


@dataclass(frozen=True)
class Base:
    """A base motion: accelerations over g, smooth between its breaks, and still after them."""

    ground: Ground
    breaks: tuple[float, ...]
    longest: float
    vertical: Ground = still

    def times(self, factor: float) -> "Base":
        return replace(self, ground=lambda t: factor * self.ground(t))

    def follow(self, sides: tuple[Side, Side | None], **given: Any) -> Whole:
        how = {"breaks": self.breaks, "longest_step": self.longest, "vertical": self.vertical}
        return follow(self.ground, sides=sides, **{**how, **given})


REST = 60.0
"""Seconds on a still base."""


def harmonic(
    size: float,
    hertz: float,
    cycles: float,
    phase: float = 0.0,
    more: tuple[Any, ...] = ((1, 1, 0),),
) -> Base:
    """Return harmonic shaking, or a sum of harmonics."""
    omega = 2.0 * math.pi * hertz

    def ground(t: float) -> float:
        return size * math.fsum(a * math.sin(k * (omega * t + phase) + b) for k, a, b in more)

    parts = 4 if len(more) == 1 else 64
    ends = {(0.25 * math.pi * k - phase) / omega for k in range(int(4.0 * parts * (cycles + 3)))}
    if len(more) > 1:
        ends = {k / hertz / parts for k in range(int(parts * cycles) + 1)}
    last = cycles / hertz
    inner = sorted(t for t in ends if 1e-12 < t < last - 1e-12)
    return Base(ground, (0.0, *inner, last), 0.1 / hertz)


def sampled(values: Any, dt: float, up: Any = None) -> Base:
    """Return samples over g, with straight lines between them."""
    end = dt * (len(values) - 1)

    def line(samples: list[float]) -> Ground:
        def ground(t: float) -> float:
            if t > end:
                return 0.0
            k = min(int(t / dt), len(samples) - 2)
            return samples[k] + (t / dt - k) * (samples[k + 1] - samples[k])

        return ground

    breaks = (*(dt * np.arange(len(values))).tolist(), math.nextafter(end, 1e9), end + REST)
    vertical = still if up is None else line([*map(float, up)])
    return Base(line([*map(float, values)]), breaks, 0.02, vertical)


def one_sine(size: float, hertz: float) -> Base:
    """Return one period of a sine."""
    omega = 2.0 * math.pi * hertz
    end = 1.0 / hertz

    def ground(t: float) -> float:
        return size * math.sin(omega * t) if t <= end else 0.0

    breaks = (0.0, 0.25 * end, 0.75 * end, end, end + REST)
    return Base(ground, breaks, 0.02)


def recorded(name: str, flags: argparse.Namespace) -> Base:
    """Return a record at its scale, with its vertical component where the line names one."""
    how = {"units": flags.units, "dt_s": flags.dt_s and float(flags.dt_s)}
    record = rs.read_record(name, **{key: value for key, value in how.items() if value})
    values = record.acceleration_m_s2 / G
    factor = float(flags.scale or 1.0)
    if flags.pga_g:
        factor = float(flags.pga_g) / float(np.abs(values).max())
    sign = -1.0 if flags.reverse else 1.0
    up = None
    if flags.vertical:
        up = factor * rs.read_record(flags.vertical).acceleration_m_s2 / G
    return sampled(sign * factor * values, record.dt_s, up)


def base_of(line: str, values: dict[str, Any], cycles: float | None = None) -> Base:
    """Return the base motion of a line; the block of its answer turns -A and -W into g and Hz."""
    flags, block = asked(line), values["block"]
    if flags.record:
        return recorded(flags.record, flags)
    if flags.A is None and flags.accel_g is None and flags.accel_m_s2 is None:
        return Base(still, (0.0, REST), 0.02)
    size = float(flags.accel_g or 0.0) + float(flags.accel_m_s2 or 0.0) / G
    hertz = float(flags.freq_hz) if flags.freq_hz else 0.0
    if flags.A is not None:
        size = float(flags.A) * block["alpha_rad"]
    if flags.W is not None:
        hertz = float(flags.W) * block["p_rad_s"] / (2.0 * math.pi)
    if flags.pulse:
        assert flags.pulse == "one-sine"
        return one_sine(-size if flags.reverse else size, hertz)
    if size == 0.0:
        return Base(still, (0.0, REST), 0.02)
    phase = values.get("phase") or 0.0
    if flags.floor_hz:  # relative to the ground: a viscously damped oscillator's absolute motion
        ratio = hertz / float(flags.floor_hz)
        gain = (1.0 + 0.1j * ratio) / (1.0 - ratio**2 + 0.1j * ratio)
        size, phase = size * abs(gain), math.atan2(gain.imag, gain.real)
    more = tuple(tuple(map(float, each.split(","))) for each in flags.harmonic) or (
        (1.0, 1.0, 0.0),
    )
    return harmonic(size, hertz, cycles or flags.cycles, phase, more)


def answered(
    line: str, folder: Path, monkeypatch: pytest.MonkeyPatch, *more: str
) -> dict[str, Any]:
    """Run a line in a folder that has the files of its reader, and return its JSON."""
    monkeypatch.chdir(folder)
    write_files(folder, of_reader(f"```sh\nrocksteady {line}\n```\n"), {})
    ran = rocksteady("", *shlex.split(line), "--json", *more)
    assert ran.code in {0, 3}, ran.err
    values = ran.json
    assert values["model"] == "nonlinear"
    block, flags = values.get("block"), asked(line)
    plain = flags.width_m and flags.height_m and ":" not in flags.width_m + flags.height_m
    if block and plain and not re.search("--(columns|offset|mass-centre|gyration)", line):
        width, height = float(flags.width_m), float(flags.height_m)
        size = {"alpha_rad": math.atan(width / height), "radius_m": 0.5 * math.hypot(width, height)}
        size["p_rad_s"] = math.sqrt(0.75 * G / size["radius_m"])
        assert {key: block[key] for key in size} == pytest.approx(size, rel=1e-14)
    return values


def start_of(line: str, block: dict[str, Any]) -> dict[str, float]:
    """Return the start of a line in rad and rad/s; rest where it names none."""
    start = asked(line).start or "0,0"
    if start == "rest":
        start = "0,0"
    if start == "steady":
        flags = asked(line)
        own = rs.Block.named(re.findall("--block (\\S+)", line)[0])
        shaking = rs.Harmonic(amplitude=float(flags.A), frequency_ratio=float(flags.W))
        first = rs.simulate(own, shaking, start=rs.Steady(), cycles=1)(0.0)
        start = f"{float(first.angle)!r},{float(first.velocity)!r}"
    angle, velocity = map(float, start.split(","))
    unit = block["alpha_rad"]
    return {"angle": angle * unit, "velocity": velocity * unit * block["p_rad_s"]}


# -------------------------------------------------------------------------------- the commands


def test_there_are_forty_lines_and_more() -> None:
    held = ("simulate", "attractor", "orbits", "bifurcate", "overturn", "basins", "map", "spectrum")
    assert sum(line.split()[0] in held for line in LINES) >= 60
    assert any("tso-wong-1989 -A 2 -W 1.7 --start steady" in line for line in LINES)
    for command in held:
        assert of(command), command


@every("line", of("simulate"))
def test_a_time_history_is_that_of_the_integrator(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(line, tmp_path, monkeypatch)
    block = values["block"]
    sides = sides_of(block, one_sided=values.get("one_sided", False))
    begin = start_of(line, block)
    seen = base_of(line, values).follow(sides, **begin)
    agree = AGREE * max(1.0, values["growth"])
    assert agree < 0.01
    assert (values["status"] == "overturned") == seen.falls
    if seen.falls:
        assert seen.crossing is not None
        assert values["overturn_time_s"] == pytest.approx(
            seen.crossing, rel=0.0, abs=agree / block["p_rad_s"]
        )
        return
    most = max(seen.peak, abs(begin["angle"]) / block["alpha_rad"])
    assert values["peak"] == pytest.approx(most, rel=0.0, abs=agree)
    assert (values["status"] == "at-rest") == seen.rests
    if not seen.rests:
        assert values["impacts"] == len(seen.impacts)


def period_from(
    orbit: dict[str, Any], base: Callable[[float], Base], block: dict[str, Any]
) -> tuple[Whole, float]:
    """Return one period from the first state of an orbit, and that state's speed."""
    first = orbit["states"][0]
    speed = first["side"] * first["speed"] * block["alpha_rad"] * block["p_rad_s"]
    shaken = base(first["phase"])
    seen = shaken.follow(sides_of(block), velocity=speed, count=len(orbit["states"]), slowest=0.0)
    return seen, speed


def holds(orbit: dict[str, Any], values: dict[str, Any]) -> None:
    """Assert that a motion is periodic under the integrator, and reaches what is stated."""
    block, period = values["block"], orbit["period"]
    size, hertz = values["accel_g"], values["freq_hz"]
    seen, speed = period_from(
        orbit, lambda phase: harmonic(size, hertz, period + 1.0, phase), block
    )
    grown = max(abs(complex(*each)) for each in orbit["multipliers"])
    agree = 100.0 * AGREE * max(1.0, grown)
    assert len(seen.impacts) == orbit["impacts_per_period"]
    assert seen.impacts[-1] * hertz == pytest.approx(period, rel=0.0, abs=agree)
    assert seen.state[1] == pytest.approx(speed, rel=agree)
    assert seen.peak == pytest.approx(max(map(abs, orbit["peaks"])), rel=0.0, abs=agree)


@every("line", of("attractor"))
def test_an_attractor_is_where_the_integrator_settles(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(line, tmp_path, monkeypatch)
    assert values["kind"] in {"symmetric", "unsymmetric"}
    holds(values, values)
    if asked(line).start is None:
        settled = values["settled_after_periods"] - math.ceil(20.0 / values["lyapunov"])
        seen = base_of(line, values, settled).follow(sides_of(values["block"]))
        hertz, period = values["freq_hz"], values["period"]
        shaken = harmonic(values["accel_g"], hertz, settled + period, values["phase"])
        late = tuple(t for t in shaken.breaks if t > settled / hertz + 1e-9)
        last = replace(shaken, breaks=(settled / hertz, *late)).follow(
            sides_of(values["block"]), angle=seen.state[0], velocity=seen.state[1]
        )
        assert last.peak == pytest.approx(max(map(abs, values["peaks"])), rel=0.0, abs=1e-8)


@every("line", of("orbits"))
def test_an_orbit_is_periodic_under_the_integrator(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(re.sub(" --seeds \\d+", "", line), tmp_path, monkeypatch, "--seeds", "24")
    moving = [orbit for orbit in values["orbits"] if orbit["admissible"]]
    assert moving
    for orbit in moving:
        if not orbit["rest_phases"]:
            holds(orbit, values)


@every("line", of("bifurcate"))
def test_a_bifurcation_has_a_motion_of_the_integrator(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(shortened(line), tmp_path, monkeypatch)
    block = values["block"]
    own = rs.Block.from_p(
        alpha=block["alpha_rad"], p=block["p_rad_s"], restitution=block["restitution"]
    )
    points = [each for each in values["points"] if each["impacts"] == 2]
    assert points
    for each in points[:2]:
        shaken = rs.Harmonic(amplitude=each["amplitude"], frequency_ratio=each["frequency_ratio"])
        orbits = rs.find_orbits(own, shaken, max_period=each["period"], seeds=24)
        orbit = min(orbits, key=lambda orbit: abs(orbit.highest - each["peaks"][0]))
        assert orbit.highest == pytest.approx(each["peaks"][0], abs=1e-6), each
        holds(orbit.to_dict(), each | {"block": block})


# ---------------------------------------------------------------- windows, cells and fates


def falls(base: Base, sides: tuple[Side, Side | None], **given: Any) -> bool:
    """Return whether a block falls, by the integrator; slow bounces are rest."""
    return base.follow(sides, **{"slowest": 1e-3, **given}).falls


def ends_of(intervals: list[list[float]], top: float) -> Iterator[tuple[float, float]]:
    """Yield sizes just inside and just outside of the ends of windows that have a gap there."""
    lows, highs = ([pair[k] for pair in intervals] for k in (0, 1))
    for low in lows:
        if low > 0.0 and all(abs(low / high - 1.0) > 10.0 * NEAR for high in highs):
            yield low * (1.0 + NEAR), low * (1.0 - NEAR)
    for high in highs:
        if high < top * (1.0 - NEAR) and all(abs(low / high - 1.0) > 10.0 * NEAR for low in lows):
            yield high * (1.0 - NEAR), high * (1.0 + NEAR)


def bordered(
    falls_at: Callable[[float], bool], intervals: list[list[float]], top: float, *, narrow: int
) -> int:
    """Assert that a block falls just inside of the windows and stands just outside.

    Where windows are so `narrow` that some are left out, one of them may begin at once.
    """
    ends = list(ends_of(intervals, top))
    few = ends[:: max(1, len(ends) // MANY)][:MANY]
    for inside, outside in few:
        assert falls_at(inside), inside
        assert narrow or not falls_at(outside), outside
    return len(few)


def windows_end_where_fates_change(line: str, folder: Path, patch: pytest.MonkeyPatch) -> None:
    """Assert that the windows of a line end where the fate of the integrator changes."""
    values = answered(shortened(line), folder, patch)
    block, flags = values["block"], asked(line)
    sides, held = sides_of(block), 0
    if "kicks" in values:
        unit = block["alpha_rad"] / block["p_rad_s"]  # alpha g/p over g
        kicks = values["kicks"]
        for each in kicks[:: max(1, len(kicks) // MANY)]:
            base = base_of(line, {"block": block})
            at = each["t_s"]
            breaks = tuple(sorted({*base.breaks, at}))
            push = each["direction"] * unit

            def felled(
                size: float,
                base: Base = base,
                at: float = at,
                push: float = push,
                breaks: tuple[float, ...] = breaks,
            ) -> bool:
                begin = start_of(line, block)
                return falls(base, sides, breaks=breaks, jumps={at: push * size}, **begin)

            held += bordered(felled, each["windows"], values["sizes"][1], narrow=each["left_out"])
    elif "records" in values:
        names = re.findall(r"--records? (example:\S+)", line)
        by_name = {rs.read_record(name).name: name for name in names}
        for each in values["windows"]:
            base = recorded(by_name[each["record"]], asked(""))
            held += bordered(
                lambda size, base=base: falls(base.times(size), sides),  # type: ignore[misc]
                each["intervals"],
                values["scales"][1],
                narrow=each["left_out"],
            )
    else:
        assert flags.pulse == "one-sine"
        rows = values["windows"]
        for each in rows[:: max(1, len(rows) // 2)]:
            hertz = each["frequency_ratio"] * block["p_rad_s"] / (2.0 * math.pi)
            held += bordered(
                lambda size, hertz=hertz: falls(  # type: ignore[misc]
                    one_sine(size * block["alpha_rad"], hertz), sides
                ),
                each["intervals"],
                values["amplitudes"][1],
                narrow=each["left_out"],
            )
    assert held > 0


@every("line", of("overturn"))
def test_windows_end_where_the_fate_changes(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    windows_end_where_fates_change(line, tmp_path, monkeypatch)


@pytest.mark.slow
@every("line", of("overturn", slow=True))
def test_windows_of_long_searches_end_where_the_fate_changes(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    windows_end_where_fates_change(line, tmp_path, monkeypatch)


@every("line", of("edge"))
def test_the_least_kick_fells_and_a_weaker_one_does_not(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(line, tmp_path, monkeypatch)
    block = values["block"]
    shaken = harmonic(values["accel_g"], values["freq_hz"], 60.0)
    unit = block["alpha_rad"] / block["p_rad_s"]  # alpha g/p over g
    for kick in (values["least_kick"], values["opposite_kick"]):
        for part, fate in ((1.0 + 1e-6, True), (1.0 - 1e-6, False), (0.99, False), (0.9, False)):
            assert falls(shaken, sides_of(block), jumps={0.0: part * kick * unit}) == fate, part


def cells_of(file: Path, count: int) -> list[dict[str, str]]:
    """Return some of the rows of a CSV file, from all over it."""
    rows = list(csv.DictReader(file.read_text("utf-8").splitlines()))
    chosen = np.random.default_rng(1).choice(len(rows), size=min(count, len(rows)), replace=False)
    return [rows[k] for k in sorted(chosen)]


@every("line", of("basins"))
def test_starts_of_a_basin_end_as_the_integrator_does(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    few = () if "--angles" in line else ("--angles=-1.2:1.2:12", "--velocities=-1.2:1.2:12")
    values = answered(shortened(line), tmp_path, monkeypatch, *few, "--csv", "cells.csv")
    block = values["block"]
    sides = sides_of(block)
    base = base_of(line, values, 30.0)
    at = float((re.findall(r"--at-s (\S+)", line) or ["0"])[0])
    late = (at, *(t for t in base.breaks if t > at))
    fates = set()
    for cell in cells_of(tmp_path / "cells.csv", 3 * MANY):
        unit = block["alpha_rad"]
        begin = {
            "angle": float(cell["angle"]) * unit,
            "velocity": float(cell["velocity"]) * unit * block["p_rad_s"],
        }
        fate = cell.get("fate") or cell["attractor"]
        fates.add(fate)
        assert (fate == "overturned") == falls(base, sides, breaks=late, **begin), cell
    assert len(fates) > 1


@every("line", of("map"))
def test_cells_of_a_map_are_those_of_the_integrator(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(shortened(line), tmp_path, monkeypatch, "--csv", "cells.csv")
    flags, kinds = asked(line), set()
    floor = f" --floor-hz {flags.floor_hz}" if flags.floor_hz else ""
    for cell in cells_of(tmp_path / "cells.csv", 2 * MANY):
        given = {**vars(flags), **cell}
        width, height = (float(given[name]) for name in ("width_m", "height_m"))
        block = rs.Block.rectangle(width=width, height=height)
        hertz = cell.get("frequency_hz") or flags.freq_hz
        kind = cell.get("fate") or cell["kind"]
        kinds.add(kind)
        words = f"map --accel-g {given['accel_g']} --freq-hz {hertz}{floor}"
        cycles = values["cycles"] if "fate" in cell else 60.0
        shaken = base_of(words, {"block": {}}, cycles)
        seen = shaken.follow((block.positive, block.negative))
        assert (kind == "overturned") == seen.falls, cell
        if kind in {"rest", "at-rest"}:
            assert seen.rests, cell
    assert len(kinds) > 1


@every("line", of("spectrum"))
def test_values_of_a_spectrum_are_those_of_the_integrator(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    values = answered(shortened(line), tmp_path, monkeypatch)
    names = re.findall(r"--record (example:\S+)", line)
    by_name = {rs.read_record(name).name: name for name in names}
    rows = [each for each in values["values"] if each["peak"] > 0.0]
    assert rows
    chosen = np.random.default_rng(2).choice(len(rows), size=min(2, len(rows)), replace=False)
    for each in (rows[k] for k in sorted(chosen)):
        walled = "--one-sided" in line
        ratio = each.get("restitution") or values["restitution"]
        if ratio == "housner":
            own = rs.Block.from_p(alpha=each["alpha_rad"], p=each["p_rad_s"])
            ratio = own.against_wall().restitution if walled else own.restitution
        sides = sides_of(each | {"restitution": ratio}, one_sided=walled)
        base = recorded(by_name[each["record"]], asked("")).times(each.get("scale", 1.0))
        seen = base.follow(sides)
        assert (each["status"] == "overturned") == seen.falls, each
        if not seen.falls and abs(each["peak"] - seen.peak) > AGREE:
            moved = base.times(1.0 + 1e-9).follow(sides)
            growth = abs(moved.peak - seen.peak) / 1e-9
            assert each["peak"] == pytest.approx(seen.peak, rel=0.0, abs=AGREE * growth), each
