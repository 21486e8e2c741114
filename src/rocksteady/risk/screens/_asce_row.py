"""The row of ASCE 43-05: rocking angles against a spectrum at the effective damping."""

from typing import Any

from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.results.numbers import number, quantity
from rocksteady.risk.screens._asce import RockingBody, Rotations, find_rotations, rotations_text
from rocksteady.risk.screens._rows import Case
from rocksteady.risk.screens.screen import Screen
from rocksteady.risk.screens.spectra import HeaderDamping, spectrum_of

SOURCE = "ASCE/SEI 43-05, Appendix A.2, approximate method for rocking of an unanchored rigid body"


def asce_row(case: Case) -> Screen:
    """Return the row of ASCE 43-05, Appendix A.2, with all roots."""
    demand = case.demand
    ratio = demand.spectral_ratio
    body = RockingBody.of_side(case.side, case.block.gravity, ratio or 0.0)
    if body.restitution <= 0.0:
        return _row(case, None, verdict="", no_answer="no answer: restitution below 0")
    longest = 1.0 / body.frequency_hz(body.alpha)
    constants = [
        ("C_I", body.inertia, ""),
        ("C_R", body.restitution, ""),
        ("beta_e", body.damping, ""),
        ("period at alpha", longest, "s"),
    ]
    spectrum = spectrum_of(demand.spectrum, demand.spectrum_damping)
    if spectrum is None or ratio is None:
        what, key = "a PGA or SA_V/SA_H", "pga_g or sa_v_per_sa_h"
        if demand.spectrum is None:
            what, key = "a spectrum with its damping", "spectrum, spectrum_damping"
        elif spectrum is None:
            what, key = "its damping", "spectrum_damping"
        return _row(case, None, verdict=f"needs {what}", needs=key, details=constants)
    constants += [("SA_V/SA_H", ratio, ""), ("F_v", body.vertical_factor, "")]
    chain, how = spectrum.at_damping(body.damping, longest)
    if isinstance(demand.spectrum_damping, HeaderDamping):
        given = " and ".join(f"{100.0 * each:.3g} %" for each in demand.spectrum_damping)
        how += f"; {given} by its header"
    rotations = find_rotations(body, chain)
    for root in rotations.roots_rad:
        constants += [
            ("root", root, "rad"),
            ("f_e at the root", body.frequency_hz(root), "Hz"),
            ("SA_cap at the root", body.capacity_m_s2(root) / STANDARD_GRAVITY, "g"),
        ]
    verdict, passes, needs = _verdict(body, rotations, longest)
    value = rotations.roots_rad[-1] if rotations.roots_rad else None
    remark = "A.2 calls its angle a best estimate: the row passes up to alpha, with no margin."
    remark += " The spectrum is a power law between its points."
    if value is not None:
        remark += f" Roots at {rotations_text(rotations.roots_rad)}; the largest is shown."
    if rotations.examined_rad < body.alpha:
        remark += (
            f" It ends at {number(chain.last_s)} s: up to {number(rotations.examined_rad)} rad."
        )
    if ratio or demand.vertical_g:
        how_much = "that of the peaks" if demand.sa_v_per_sa_h is None else "as stated"
        remark += f" Vertical motion: F_v with SA_V/SA_H {number(ratio)}, {how_much}."
    return _row(
        case,
        value,
        verdict=verdict if needs else f"{verdict}; {how}",
        passes=passes,
        counts_vertical=demand.vertical_g > 0.0 and demand.sa_v_per_sa_h is None,
        needs=needs,
        details=constants,
        remark=remark,
        answered=not needs,
    )


def _verdict(
    body: RockingBody, rotations: Rotations, longest: float
) -> tuple[str, bool | None, str]:
    """Return the words, whether it passes, and what is missing."""
    complete = rotations.examined_rad >= body.alpha
    if not complete and (rotations.above_at_end or not rotations.roots_rad):
        return f"needs a spectrum up to {number(longest)} s", None, "spectrum"
    if not rotations.roots_rad:
        if rotations.above_at_end:
            return "overturns: no root, demand above capacity", False, ""
        return "does not overturn: no root, capacity above demand", True, ""
    largest = quantity(rotations.roots_rad[-1] / body.alpha, "alpha")
    if rotations.above_at_end:
        return f"may overturn beyond {largest}", False, ""
    return f"rocks up to {largest}", True, ""


def _row(case: Case, value: float | None, *, details: Any = (), **fields: Any) -> Screen:
    """Return the row with its source."""
    return case.rocking(
        name="ASCE 43-05 rocking",
        made_for="nuclear facilities",
        equation="A.2, A-5 on",
        edition="ASCE/SEI 43-05",
        source=SOURCE,
        value=value,
        unit="rad",
        details=tuple(details),
        **fields,
    )
