"""Words of what is measured of records: measures, integrated records and response spectra."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import length, number, quantity
from rocksteady.results.result import describes
from rocksteady.seismic.measures.intensity import Measures
from rocksteady.seismic.measures.response_spectrum import ORDINATES, ResponseSpectrum
from rocksteady.seismic.measures.time_course import IntegratedRecord

if TYPE_CHECKING:
    import xarray


WORDS: Mapping[str, tuple[str, str]] = {
    "pga_g": ("PGA", "g"),
    "pga_m_s2": ("", "m/s^2"),
    "pgv_m_s": ("PGV", "m/s"),
    "pgd_m": ("PGD", "m"),
    "pgv_per_pga_s": ("PGV/PGA", "s"),
    "arias_m_s": ("Arias intensity", "m/s"),
    "arias_of_samples_m_s": ("", "m/s"),
    "cav_m_s": ("cumulative absolute velocity", "m/s"),
    "significant_5_75_s": ("significant duration, 5-75 %", "s"),
    "significant_5_95_s": ("significant duration, 5-95 %", "s"),
    "rms_m_s2": ("rms over 5-95 %", "m/s^2"),
    "bracketed_s": ("bracketed duration", "s"),
    "uniform_s": ("uniform duration", "s"),
    "threshold_m_s2": ("", "m/s^2"),
    "mean_period_s": ("mean period", "s"),
    "housner_intensity_m": ("Housner intensity", "m"),
    "damping": ("", ""),
    "final_velocity_m_s": ("velocity at the end", "m/s"),
    "drifts": ("", ""),
    "pga_per_uplift": ("PGA/(g tan alpha)", ""),
    "p_pgv_per_uplift": ("p PGV/(g tan alpha)", ""),
    "p_pgv_per_pga": ("p PGV/PGA", ""),
}
"""Name and unit of each measure; without a name it is for JSON alone."""


@describes(Measures)
def describe_measures(measures: Measures) -> Description:
    """Return all measures, those of a block where there is one."""
    facts = []
    for key, (label, unit) in WORDS.items():
        value = getattr(measures, key)
        if value is not None:
            facts.append(Fact(key, value, label, quantity(value, unit) if unit else ""))
    rule = (
        f"The ground begins at rest; 1 g is {STANDARD_GRAVITY} m/s^2; Arias intensity of "
        f"straight lines between the samples; bracketed and uniform above "
        f"{number(measures.threshold_m_s2 / STANDARD_GRAVITY)} g; Housner intensity at "
        f"{number(100.0 * measures.damping)} % of critical damping."
    )
    notes = [rule]
    if measures.warning is not None:
        notes.append(measures.warning)
    name = measures.record.name or "record"
    sentence, screen = _measures_answer(measures, name)
    return Description(
        headline=f"{name}: PGA {number(measures.pga_g)} g, PGV {number(measures.pgv_m_s)} m/s, "
        f"significant duration {number(measures.significant_5_95_s)} s",
        facts=[*screen, *facts],
        notes=notes,
        sentence=sentence,
    )


def _measures_answer(measures: Measures, name: str) -> tuple[str, list[Fact]]:
    """Return the peaks, how long it is strong, and whether it drifts."""
    end = quantity(measures.final_velocity_m_s, "m/s")
    ratio = quantity(measures.pgv_per_pga_s, "s")
    facts = [
        line("drift", measures.warning or f"none: velocity at the end {end}"),
        line("Arias intensity", quantity(measures.arias_m_s, "m/s")),
        line("PGV/PGA", f"{ratio}; mean period {quantity(measures.mean_period_s, 's')}"),
    ]
    if (reached := measures.peak_per_uplift) is not None:
        lifts = "never lifts" if reached < 1.0 else "lifts"
        what = "PGA is" if reached == measures.pga_per_uplift else "to a free side it reaches"
        words = f"it {lifts}: {what} {number(reached)} x what lifts it"
        facts.insert(0, line("block at rest", words))
    strong = quantity(measures.significant_5_95_s, "s")
    return f"{name} peaks at {measures.peaks_text}; its strong part lasts {strong}.", facts


@describes(IntegratedRecord)
def describe_integrated_record(course: IntegratedRecord) -> Description:
    """Return the largest values and their times."""
    pga, pgv, pgd = course.peak_acceleration, course.peak_velocity, course.peak_displacement
    in_g = number(abs(pga.value) / STANDARD_GRAVITY)
    facts = [
        Fact("pga_m_s2", abs(pga.value), "PGA", f"{in_g} g at {number(pga.t_s)} s"),
        Fact("pga_t_s", pga.t_s),
        Fact(
            "pgv_m_s",
            abs(pgv.value),
            "PGV",
            f"{number(abs(pgv.value))} m/s at {number(pgv.t_s)} s",
        ),
        Fact("pgv_t_s", pgv.t_s),
        Fact("pgd_m", abs(pgd.value), "PGD", f"{length(abs(pgd.value))} at {number(pgd.t_s)} s"),
        Fact("pgd_t_s", pgd.t_s),
        Fact(
            "arias_m_s",
            float(course.arias_m_s[-1]),
            "Arias intensity",
            f"{number(float(course.arias_m_s[-1]))} m/s",
        ),
        Fact(
            "final_velocity_m_s",
            float(course.velocity_m_s[-1]),
            "velocity at the end",
            f"{number(float(course.velocity_m_s[-1]))} m/s",
        ),
        Fact("drifts", course.drifts, "drifts"),
    ]
    name = course.record.name or "a record"
    words = f"{len(course.t_s):,} samples every {course.record.dt_s:g} s"
    return Description(headline=f"Ground motion of {name}: {words}, PGA {in_g} g", facts=facts)


def integrated_dataset(course: IntegratedRecord) -> "xarray.Dataset":
    """Return the samples as a Dataset over ``t_s``."""
    import xarray

    units = {
        "acceleration_m_s2": "m s-2",
        "velocity_m_s": "m s-1",
        "displacement_m": "m",
        "arias_m_s": "m s-1",
    }
    return xarray.Dataset(
        {name: ("t_s", getattr(course, name), {"units": unit}) for name, unit in units.items()},
        coords={"t_s": ("t_s", course.t_s, {"units": "s"})},
        attrs={"record": course.record.name or ""},
    )


def _in_g(value: float) -> str:
    """Return an acceleration in g."""
    return number(value / STANDARD_GRAVITY)


COLUMNS = (
    Column("periods_s", "T [s]", number),
    Column("pseudo_acceleration_m_s2", "PSA [g]", _in_g),
    Column("acceleration_m_s2", "Sa [g]", _in_g),
    Column("pseudo_velocity_m_s", "PSV [m/s]", number),
    Column("velocity_m_s", "Sv [m/s]", number),
    Column("displacement_m", "Sd [mm]", lambda metres: number(1e3 * metres)),
)


@describes(ResponseSpectrum)
def describe_response_spectrum(spectrum: ResponseSpectrum) -> Description:
    """Return the ordinates, a row for each period."""
    arrays = {name: getattr(spectrum, name).tolist() for name in ORDINATES}
    rows = [dict(zip(arrays, row, strict=True)) for row in zip(*arrays.values(), strict=True)]
    largest = int(np.argmax(spectrum.pseudo_acceleration_m_s2))
    peak = spectrum.pseudo_acceleration_m_s2[largest] / STANDARD_GRAVITY
    return Description(
        headline=f"Response spectrum of {spectrum.record.name or 'a record'}, "
        f"{number(100.0 * spectrum.damping)} % damping: {len(rows)} periods, PSA up to "
        f"{number(peak)} g at {number(spectrum.periods_s[largest])} s",
        facts=[
            Fact("damping", spectrum.damping),
            *(Fact(name, values) for name, values in arrays.items()),
        ],
        tables=[Table("", rows, COLUMNS, title=f"Damping {number(spectrum.damping)} of critical")],
    )


def spectrum_dataset(spectrum: ResponseSpectrum) -> "xarray.Dataset":
    """Return the ordinates as a Dataset over ``period_s``."""
    import xarray

    return xarray.Dataset(
        {
            name: ("period_s", getattr(spectrum, name), {"units": unit})
            for name, unit in ORDINATES.items()
            if name != "periods_s"
        },
        coords={"period_s": ("period_s", spectrum.periods_s, {"units": "s"})},
        attrs={"damping": spectrum.damping, "record": spectrum.record.name or ""},
    )
