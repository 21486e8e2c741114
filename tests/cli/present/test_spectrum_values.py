"""What `spectrum` prints of rocking spectra: values, titles and tables."""

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from rocksteady import Status, compute_rocking_spectrum, summarise_spectra
from rocksteady.cli.present.spectrum_values import (
    COLUMNS,
    ROWS,
    print_spectrum,
    spectrum_values,
    title_of,
)
from tests.cli.present.printed import as_json, fits, printed
from tests.seismic.grounds import ground

ALPHA, PERIODS = [0.1, 0.2, 0.3], [1.0, 4.0]
FILES = [Path("a.AT2"), Path("b.AT2")]


@cache
def spectrum_of(records: int) -> xr.Dataset:
    suite = [ground(seed, 3.0 * (1 + seed), name=f"hut-{seed}") for seed in range(records)]
    return compute_rocking_spectrum(suite, alpha=ALPHA, periods_s=PERIODS)


def values_of(records: int) -> dict[str, Any]:
    found = spectrum_of(records)
    summary = summarise_spectra(found) if records > 1 else None
    values = spectrum_values(found, summary, FILES[:records])
    return {**values, "seconds": 0.5, "store": None}


def test_there_is_a_row_a_cell() -> None:
    values = as_json(values_of(2))
    found = spectrum_of(2)
    assert values["cells"] == len(values["values"]) == 2 * 3 * 2
    for row in values["values"]:
        place = {"record": row["record"], "alpha": row["alpha_rad"], "period": row["period_s"]}
        cell = found.sel(place)
        assert row["status"] == Status(int(cell.status)).label
        for name, value in (("peak", cell.peak_angle), ("peak_velocity", cell.peak_velocity)):
            assert row[name] == (float(value) if np.isfinite(value) else None)
        assert row["p_rad_s"] == pytest.approx(2.0 * math.pi / row["period_s"])
        if row["peak"] is not None:
            assert row["peak_rad"] == row["peak"] * row["alpha_rad"]
            speed = row["peak_velocity"] * row["alpha_rad"] * row["p_rad_s"]
            assert row["peak_velocity_rad_s"] == pytest.approx(speed)
    labels = [row["status"] for row in values["values"]]
    assert values["counts"] == {one.label: labels.count(one.label) for one in Status}
    assert {one["name"]: one["file"] for one in values["records"]} == {
        "hut-0": "a.AT2",
        "hut-1": "b.AT2",
    }


def test_a_suite_has_a_row_a_block_and_a_single_record_none() -> None:
    assert "suite" not in values_of(1)
    values = as_json(values_of(2))
    assert len(values["suite"]) == 3 * 2
    for row in values["suite"]:
        fell = [
            one["status"] == "overturned"
            for one in values["values"]
            if (one["alpha_rad"], one["period_s"]) == (row["alpha_rad"], row["period_s"])
        ]
        assert row["overturned"] == sum(fell) / 2
        assert len(row["peaks"]) == len(row["peak_velocities"]) == len(values["quantiles"]) == 3
        assert (None in row["peaks"]) == any(fell), "a fall is larger than any number"


@pytest.mark.parametrize("degrees", [False, True])
def test_the_table_has_a_row_a_size_and_a_column_a_slenderness(degrees: bool) -> None:
    values, found = values_of(1), spectrum_of(1)
    text = printed(print_spectrum, values, found, None, degrees=degrees)
    assert fits(text)
    _, _, heading, *rows, last = text.splitlines()
    for alpha in ALPHA:
        assert (f"{math.degrees(alpha):.4g}°" if degrees else f"{alpha:.4g} rad") in heading
    for period, row in zip(PERIODS, rows, strict=True):
        size, *cells = row.split()
        assert float(size) == period
        for alpha, cell in zip(ALPHA, cells, strict=True):
            block = found.sel(alpha=alpha, period=period).isel(record=0)
            fell = int(block.status) == Status.OVERTURNED
            assert cell == ("falls" if fell else f"{float(block.peak_angle):.6g}")
    assert last.startswith("6 motions in 0.50 s, ")


def test_the_table_of_a_suite_has_medians_and_shares() -> None:
    found = spectrum_of(2)
    summary = summarise_spectra(found)
    text = printed(print_spectrum, values_of(2), found, summary, degrees=False)
    assert fits(text)
    assert "median of the largest" in text
    for share in summary["overturned"].values.ravel().tolist():
        assert f", {100.0 * share:.3g} %" in text


def test_of_many_blocks_some_are_shown_the_first_and_the_last_included() -> None:
    alpha, periods = np.linspace(0.1, 0.3, 11), np.linspace(1.0, 4.0, 50)
    found = compute_rocking_spectrum([ground(1, 2.0)], alpha=alpha, periods_s=periods)
    values = {**spectrum_values(found, None, FILES[:1]), "seconds": 0.0, "store": "here"}
    text = printed(print_spectrum, values, found, None, degrees=False)
    assert fits(text)
    _, _, heading, *rows, cut, last = text.splitlines()
    assert heading.count("rad") == COLUMNS
    assert heading.endswith("0.3 rad")
    assert len(rows) == ROWS
    assert (rows[0].split()[0], rows[-1].split()[0]) == ("1", "4")
    assert cut.startswith(f"{ROWS * COLUMNS} of 550 blocks")
    assert last.endswith(", kept in here")


def test_a_title_names_what_is_not_the_default() -> None:
    plain: dict[str, Any] = {
        "records": [{"name": "hut"}],
        "vertical": None,
        "scale": 1.0,
        "reversed": False,
    }
    plain |= {"restitution": "housner", "model": "linear"}
    assert title_of(plain) == "Rocking spectrum: hut, Housner's restitution, linear"
    other = {**plain, "records": [{"name": "hut"}] * 2, "vertical": "up", "scale": 1.5}
    other |= {"reversed": True, "restitution": 0.85}
    assert title_of(other) == (
        "Rocking spectrum: 2 records and vertical, scaled by 1.5, reversed, restitution 0.85, "
        "linear"
    )
