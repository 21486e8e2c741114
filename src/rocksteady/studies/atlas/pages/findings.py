"""Findings of the atlas: named numbers, and sentences built from them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rocksteady.branches import PointType
from rocksteady.results.description import Fact, line
from rocksteady.studies.atlas.analysis.coexistence import Coexistence, OrbitClass
from rocksteady.studies.atlas.analysis.columns import Column
from rocksteady.studies.atlas.analysis.families import FamilyMap
from rocksteady.studies.atlas.analysis.from_rest import FATES, FromRest
from rocksteady.studies.atlas.analysis.lines import Line
from rocksteady.studies.atlas.analysis.windows import Window
from rocksteady.studies.atlas.pages._words import amplitude_text, listed, percent

BANDS = ("symmetric", "unsymmetric", "doubled")


@dataclass(frozen=True, kw_only=True)
class BandsAt:
    """The bands of a family at one frequency, as the page's table has them; nan where none is.

    Attributes
    ----------
    order, frequency_ratio
        Order of the family, and frequency ratio of the sentence.
    begins, symmetric_until, unsymmetric_until, cascade_until
        Amplitudes.
    ends_with
        Where the last band ends: "cascade", "graze", "fold", or "beyond" for above the plane;
        "not-followed" where the symmetric band is too thin for what comes after it.
    """

    order: int
    frequency_ratio: float
    begins: float
    symmetric_until: float
    unsymmetric_until: float
    cascade_until: float
    ends_with: str


def bands_at(column: Column, order: int) -> BandsAt:
    """Return a column as in the table."""
    last = column.ends[-1] if column.ends else None
    ends = "beyond"
    if last is not None:
        ends = {PointType.GRAZING: "graze", PointType.FOLD: "fold"}.get(last, "cascade")
    if not column.followed:
        ends = "not-followed"
    reached = [
        border if end is not None or not column.followed else float("nan")
        for border, end in zip(column.borders, column.ends, strict=True)
    ]
    reached += [float("nan")] * (2 - len(reached))
    return BandsAt(
        order=order,
        frequency_ratio=column.frequency_ratio,
        begins=column.lowest,
        symmetric_until=reached[0],
        unsymmetric_until=reached[1],
        cascade_until=column.limit if last is not None else float("nan"),
        ends_with=ends,
    )


def family_values(family: FamilyMap, lines: Sequence[Line]) -> dict[str, Any]:
    """Return the numbers of a family by name."""
    return {
        "order": family.order,
        "shares": {name: family.area(band) for band, name in enumerate(BANDS)},
        "doubling_meets_graze": meeting(family.order, lines),
    }


def meeting(order: int, lines: Sequence[Line]) -> dict[str, float] | None:
    """Return where the first doubling of a family ends in a graze; None where it does not."""
    for each in lines:
        if (each.order, each.name) != (order, "first-doubling"):
            continue
        for end, place in zip(each.ends, (0, -1), strict=True):
            if end == "doubling-graze":
                return {
                    "frequency_ratio": float(each.frequency_ratio[place]),
                    "amplitude": float(each.amplitude[place]),
                }
    return None


def coexistence_values(result: Coexistence) -> dict[str, Any]:
    """Return the numbers of the coexistence by name."""
    most = int(result.motions.max())
    row, column = np.unravel_index(int(np.argmax(result.motions)), result.motions.shape)
    counts = np.bincount(result.motions.ravel(), minlength=most + 1) / result.motions.size
    return {
        "most": most,
        "cells_with_most": int((result.motions == most).sum()),
        "most_at": {
            "amplitude": float(result.plane.amplitudes[row]),
            "frequency_ratio": float(result.plane.ratios[column]),
            "orbits": result.text_at(int(row), int(column)),
            "rest": bool(result.rest[row, column]),
            "aperiodic": bool(result.aperiodic[row, column]),
        },
        "shares": {str(count): float(share) for count, share in enumerate(counts)},
        "cells_with_undecided": int((result.undecided > 0).sum()),
        "cells_with_aperiodic": int(result.aperiodic.sum()),
        "cells": result.motions.size,
        "classes": [
            {
                "period": kind.period,
                "impacts": kind.impacts,
                "unsymmetric": kind.unsymmetric,
                "cells": count,
            }
            for kind, count in result.classes.items()
        ],
    }


def window_values(window: Window) -> dict[str, Any]:
    """Return the numbers of a window by name."""
    return {
        "period": window.orbits.period,
        "impacts": window.orbits.impacts,
        "cells": window.cells,
        "frequency_ratio": window.frequency_ratio,
        "begins": window.low,
        "symmetric_until": window.high,
        "last_until": window.last,
    }


def rest_values(result: FromRest) -> dict[str, Any]:
    """Return the numbers of the fates from rest by name."""
    share = result.overturned
    return {
        "phases": 2 * len(result.phases),
        "shares_at_phase_0": {fate: result.share(fate) for fate in FATES},
        "share_overturned_at_every_phase": float((share == 1.0).mean()),
        "share_overturned_at_some_phases": float(((share > 0.0) & (share < 1.0)).mean()),
        "lowest_falls": [
            {
                "frequency_ratio": fall.frequency_ratio,
                "amplitude": fall.amplitude,
                "phase": fall.phase,
                "heteroclinic": fall.heteroclinic,
                "step": fall.step,
            }
            for fall in result.falls
        ],
    }


def family_sentences(
    families: Sequence[FamilyMap], lines: Sequence[Line], strips: Sequence[Window]
) -> list[str]:
    """Return what the bands show, one paragraph an entry."""
    texts = []
    for family in families:
        areas = [family.area(band) for band in range(len(BANDS))]
        if areas[0] == 0.0:
            texts.append(f"n = {family.order}: no stable motion of this family in the window.")
            continue
        text = (
            f"n = {family.order}: the symmetric motion is stable in {percent(areas[0])} of the "
            f"window, motions that lean in {percent(areas[1])} beside it, doubled ones in "
            f"{percent(areas[2])}."
        )
        met = meeting(family.order, lines)
        if met is not None:
            text += (
                f" The first doubling ends at Ω = {met['frequency_ratio']:.4f}, "
                f"A = {met['amplitude']:.4f}: at higher frequencies the unsymmetric motion touches "
                "the base between two impacts before it can double, and its stability ends there."
            )
        texts.append(text)
    texts += [_window_sentence(window) for window in strips]
    return texts


def _window_sentence(window: Window) -> str:
    orbits = window.orbits
    more = window.last - window.high > 1e-4
    return (
        f"A window: in {window.cells} cells the search came upon stable symmetric motions of "
        f"{orbits.period} periods with {orbits.impacts} impacts instead of 2. Their strip reaches, "
        f"at Ω = {amplitude_text(window.frequency_ratio)}, from A = {window.low:.4f} to "
        f"{window.high:.4f}"
        + (
            f", and with the unsymmetric and doubled ones above it to {window.last:.4f}." * more
            or "."
        )
    )


def coexistence_sentences(result: Coexistence) -> list[str]:
    """Return what the search shows, one paragraph an entry."""
    values = coexistence_values(result)
    shares, at, most = values["shares"], values["most_at"], values["most"]
    nothing, single = shares.get("0", 0.0), shares.get("1", 0.0)
    several = max(0.0, 1.0 - nothing - single)
    first = (
        f"In {percent(nothing)} of the cells every start ends in a fall. One motion was found in "
        f"{percent(single)}, and more than one, so that the start decides, in {percent(several)}."
    )
    texts = [first]
    if most > 1:
        company = [OrbitClass.of(code).words for code in _codes_at(result, at)]
        company += ["a motion that does not repeat itself"] if at["aperiodic"] else []
        company += ["rest"] if at["rest"] else []
        where = (
            "one cell" if values["cells_with_most"] == 1 else f"{values['cells_with_most']} cells"
        )
        texts.append(
            f"The most are {most}, in {where}; at A = {amplitude_text(at['amplitude'])}, "
            f"Ω = {amplitude_text(at['frequency_ratio'])}: {listed(company)}."
        )
    cells = result.motions.size
    others = result.having(lambda kind: kind.period not in (1, 3, 5)).sum() / cells
    rests = result.having(lambda kind: kind.impacts is None).sum() / cells
    texts.append(
        f"Motions of 3 periods were found in {percent(_share(result, 3))} of the cells, of 5 in "
        f"{percent(_share(result, 5))}, of 2, 4, 6, 7 or more in {percent(others)}; motions that "
        f"come to rest in each of their periods in {percent(rests)}."
    )
    return texts


def atlas_answer(coexistence: Coexistence, rest: FromRest) -> tuple[str, list[Fact]]:
    """Return how much of the plane has several motions, one or none, and the fates from rest."""
    motions, values = coexistence.motions, rest_values(rest)
    none, single, several = (
        percent(float(share.mean())) for share in (motions == 0, motions == 1, motions > 1)
    )
    sentence = "No two steady motions exist side by side in the plane."
    if (motions > 1).any():
        sentence = (
            f"Several steady motions exist side by side in {several} of the plane, "
            f"{motions.max()} at the most."
        )
    every, some = (
        percent(values[f"share_overturned_at_{which}"]) for which in ("every_phase", "some_phases")
    )
    return (
        sentence,
        [
            line("one motion", f"in {single}; in {none} every start falls"),
            line(
                "from rest", f"falls at every phase in {every}; in {some} it depends on the phase"
            ),
        ],
    )


def _share(result: Coexistence, period: int) -> float:
    return float(result.having(lambda kind: kind.period == period).mean())


def _codes_at(result: Coexistence, at: dict[str, Any]) -> list[int]:
    row = int(np.argmin(np.abs(result.plane.amplitudes - at["amplitude"])))
    column = int(np.argmin(np.abs(result.plane.ratios - at["frequency_ratio"])))
    codes: list[int] = [code for code in result.codes[:, row, column].tolist() if code]
    return codes


def rest_sentences(result: FromRest, harmonic: FamilyMap | None) -> list[str]:
    """Return the fates of a block initially at rest, one paragraph an entry."""
    values = rest_values(result)
    every, some = (
        values[f"share_overturned_at_{which}"] for which in ("every_phase", "some_phases")
    )
    first = (
        f"Over {values['phases']} phases of the shaking at its start a block at rest overturns at "
        f"all of them in {percent(every)} of the cells, and in another {percent(some)} it depends "
        "on the phase."
    )
    texts = [first]
    if harmonic is not None:
        safe = harmonic.stable(result.plane.amplitudes)
        fallen = (result.overturned > 0.0) & safe
        texts.append(
            "A stable motion with the shaking does not mean that a block reaches it: in "
            f"{percent(float(fallen.sum() / max(int(safe.sum()), 1)))} of the cells that have one "
            "of n = 1, unsymmetric and doubled ones included, it overturns from rest at some phase."
        )
    above = [fall for fall in result.falls if fall.amplitude == fall.amplitude]
    if above:
        ratios = [fall.amplitude / max(fall.heteroclinic, 1.0) for fall in above]
        texts.append(
            "The heteroclinic amplitude, or uplift at A = 1 where that is higher, is a lower bound "
            "in what was tried: the lowest amplitude that overturns is "
            f"{min(ratios):.2f} to {max(ratios):.2f} times as high."
            if min(ratios) >= 1.0
            else "At some frequencies a block overturns below the heteroclinic amplitude: "
            f"{min(ratios):.2f} times it."
        )
    return texts
