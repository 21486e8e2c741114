"""Descriptions of spectra and of many runs: rows, tables, and the names of the JSON keys."""

import math
import re
from functools import cache

import numpy as np
import pytest
import xarray

from rocksteady import Block, Status, compute_rocking_spectrum, simulate_many
from rocksteady.measures import compute_suite_spectrum
from rocksteady.results.rendering import as_text
from rocksteady.words.spectra import Cell, Over, _course, _severity, describe_spectrum, shortened
from tests.every import every
from tests.seismic.grounds import ground

ALPHA, PERIODS = [0.1, 0.2, 0.3], [1.0, 4.0]


@cache
def spectrum_of(records: int) -> xarray.Dataset:
    suite = [ground(seed, 3.0 * (1 + seed), name=f"hut-{seed}") for seed in range(records)]
    return compute_rocking_spectrum(suite, alpha=ALPHA, periods_s=PERIODS)


def test_there_is_a_row_a_cell() -> None:
    values = describe_spectrum(spectrum_of(2)).to_dict()
    assert values["cells"] == len(values["values"]) == 2 * 3 * 2
    for row in values["values"]:
        place = {"record": row["record"], "alpha": row["alpha_rad"], "period": row["period_s"]}
        cell = spectrum_of(2).sel(place)
        assert row["status"] == Status(int(cell.status)).label
        assert row["peak"] == float(cell.peak_angle)
        assert row["peak_velocity"] == float(cell.peak_velocity)
        assert row["p_rad_s"] == pytest.approx(2.0 * math.pi / row["period_s"])
        assert row["peak_rad"] == row["peak"] * row["alpha_rad"]
        speed = row["peak_velocity"] * row["alpha_rad"] * row["p_rad_s"]
        assert row["peak_velocity_rad_s"] == pytest.approx(speed)
    labels = [row["status"] for row in values["values"]]
    assert values["counts"] == {each.label: labels.count(each.label) for each in Status}
    assert {"model", "scale", "reversed", "vertical", "quantiles", "suite"} <= values.keys()


def test_a_suite_has_a_row_a_block_and_a_single_record_none() -> None:
    assert "suite" not in describe_spectrum(spectrum_of(1)).to_dict()
    values = describe_spectrum(spectrum_of(2)).to_dict()
    assert len(values["suite"]) == 3 * 2
    for row in values["suite"]:
        fell = [
            each["status"] == "overturned"
            for each in values["values"]
            if (each["alpha_rad"], each["period_s"]) == (row["alpha_rad"], row["period_s"])
        ]
        assert row["overturned"] == sum(fell) / 2
        assert len(row["peaks"]) == len(row["peak_velocities"]) == len(values["quantiles"]) == 3
        assert (None in row["peaks"]) == any(fell), "a fall is larger than any number"


@pytest.mark.parametrize("scales", [None, [1.0, 2.0]])
def test_a_row_has_a_scale_where_there_are_several(scales: list[float] | None) -> None:
    suite = [ground(1), ground(2, name="other")]
    values = describe_spectrum(
        compute_rocking_spectrum(suite, alpha=0.1, periods_s=1.0, scales=scales)
    ).to_dict()
    for rows, each in ((values["values"], 2), (values["suite"], 1)):
        assert [row["scale"] for row in rows if "scale" in row] == (scales or []) * each


@pytest.mark.parametrize("most", [40, 41, 7])
def test_a_name_is_shortened_in_its_middle_to_the_length_allowed(most: int) -> None:
    letters = "".join(chr(0x4E00 + n) for n in range(most))
    assert shortened(letters, most) == letters
    start, end = shortened(letters + "ab", most).split("…")
    assert (letters + "ab").startswith(start)
    assert (letters + "ab").endswith(end)
    assert len(start) + 1 + len(end) == most
    assert abs(len(start) - len(end)) <= 1


def test_the_table_has_a_row_a_size_and_a_column_a_slenderness() -> None:
    spectrum = spectrum_of(1)
    text = as_text(describe_spectrum(spectrum))
    assert max(map(len, text.splitlines())) <= 80
    *_, heading, first, second = text.splitlines()
    assert all(f"{math.degrees(alpha):.3g}°" in heading for alpha in ALPHA)
    for period, line in zip(PERIODS, (first, second), strict=True):
        size, *cells = line.split()
        assert float(size) == period
        for alpha, cell in zip(ALPHA, cells, strict=True):
            block = spectrum.sel(alpha=alpha, period=period).isel(record=0)
            fell = int(block.status) == Status.OVERTURNED
            assert (
                cell == "falls"
                if fell
                else float(cell) == pytest.approx(float(block.peak_angle), rel=6e-3)
            )


def test_the_answer_has_the_size_of_the_largest_block_that_falls() -> None:
    spectrum = compute_rocking_spectrum(ground(1, 9.0), alpha=ALPHA, periods_s=PERIODS)
    fell = (spectrum.status == int(Status.OVERTURNED)).to_numpy()
    said = describe_spectrum(spectrum)
    words = r"of ([\d.]+)° fall .* 2 pi/p = ([\d.]+) s \(([\d.]+) x ([\d.]+) m\)"
    found = re.search(words, said.sentence)
    assert found is not None, said
    degrees, period, width, height = map(float, found.groups())
    alpha = min(ALPHA, key=lambda each: abs(math.degrees(each) - degrees))
    assert period == max(np.array(PERIODS)[fell.any(axis=0)])
    assert fell[ALPHA.index(alpha), PERIODS.index(period)]
    block = Block.rectangle(width=width, height=height)
    assert block.p == pytest.approx(2.0 * math.pi / period, rel=5e-3)
    assert block.alpha == pytest.approx(alpha, rel=5e-3)


def test_rows_are_ranked_by_falls_and_then_by_medians() -> None:
    quantiles: Cell = {"peaks": [0.1, 0.2, 0.4], "overturned": 0.0}
    assert _severity([quantiles, quantiles]) == (0.0, 0.2)
    assert _severity([quantiles, {**quantiles, "overturned": 0.5}]) == (0.5, 0.2)


def test_the_table_of_a_suite_has_medians_and_shares() -> None:
    text = as_text(describe_spectrum(spectrum_of(3)))
    assert max(map(len, text.splitlines())) <= 80
    assert "median of the largest" in text
    summary = compute_suite_spectrum(spectrum_of(3))
    medians, shares = summary["peak_angle"].sel({"quantile": 0.5}), summary["overturned"]
    for median, share in zip(medians.values.ravel(), shares.values.ravel(), strict=True):
        peak = "falls" if math.isinf(median) else f"{median:.3g}"
        assert f" {peak}, {100.0 * share:.3g} %" in text


def test_of_many_blocks_those_that_fall_are_shown_first() -> None:
    periods = np.linspace(1.0, 4.0, 50)
    suite = [ground(1, 4.0), ground(2, 3.0, name="other")]
    for columns, grounds in ((5, suite[:1]), (6, suite[:1]), (3, suite), (4, suite)):
        spectrum = compute_rocking_spectrum(
            grounds, alpha=np.linspace(0.1, 0.3, columns), periods_s=periods
        )
        described = describe_spectrum(spectrum)
        assert len(described.to_dict()["values"]) == spectrum["status"].size
        lines = as_text(described).splitlines()
        assert max(map(len, lines)) <= 80
        fell = (spectrum["status"].values == Status.OVERTURNED).any(axis=0)  # of any record
        rows = fell.any(axis=0) if columns in (3, 5) else fell.ravel()  # a row a period, or a block
        count, falls = len(rows), int(rows.sum())
        assert 0 < falls < count
        last = described.tables[-1]
        assert last.kind is not None
        words = [last.kind(row) for row in last.shown]
        assert words[:falls] == ["with falls"] * min(falls, 24)
        left = (max(falls - 24, 0), min(count - falls, count - 24))
        pairs = zip(left, ("with falls", "without falls"), strict=True)
        kinds = ", ".join(f"{n:,} {word}" for n, word in pairs if n)
        assert lines[-1] == f"{count - 24:,} more rows in the file and in JSON: {kinds}"


@pytest.mark.parametrize("scale", [1.0, 9.0])
def test_blocks_of_given_sizes_have_an_answer_for_several_records(scale: float) -> None:
    blocks = [Block.rectangle(width=width, height=1.1) for width in (0.3, 0.45)]
    cells = simulate_many(blocks, [ground(1), ground(2, name="other")], scales=scale)
    answer = describe_spectrum(cells)
    fell = (cells["status"] == int(Status.OVERTURNED)).sum("record").values.ravel()
    shares = [f"falls in {count} of 2 records" if count else "stands" for count in fell]
    rows = {fact[0]: str(fact[1]) for fact in answer.screen}
    assert rows["0.3 x 1.1 m"].startswith(shares[0])
    assert rows["0.45 x 1.1 m"].startswith(shares[1])


def test_the_headline_names_what_is_not_the_default() -> None:
    plain = spectrum_of(1)
    words = "Rocking spectrum: hut-0, Housner's restitution, nonlinear"
    assert describe_spectrum(plain).headline == words
    other = plain.assign_attrs(direction="reversed", vertical="up", restitution=0.85)
    other = other.assign_coords(scale=1.5)
    assert describe_spectrum(other).headline == (
        "Rocking spectrum: hut-0 and vertical, scaled by 1.5, reversed, restitution 0.85, nonlinear"
    )


def test_runs_of_many_blocks_have_their_levels() -> None:
    blocks = [Block.rectangle(width=0.4, height=height) for height in (1.2, 1.6)]
    suite = [ground(1), ground(2, name="other")]
    result = simulate_many(blocks, suite, pga_g=[0.3, 0.6], reverse="both")
    values = describe_spectrum(result).to_dict()
    assert len(values["values"]) == 16
    for row in values["values"]:
        cell = result.sel(
            block=row["block"], record=row["record"], direction=row["direction"], level=row["pga_g"]
        )
        assert row["peak"] == float(cell.peak_angle)
        assert row["scale"] == float(cell.scale)
        assert row["height_m"] == pytest.approx(float(cell.height))
    assert values["scale"] is None
    assert len(values["suite"]) == 8
    assert "both directions" in describe_spectrum(result).headline
    leaning = Block.asymmetric(left=0.2, right=0.3, height=1.8)
    single = describe_spectrum(simulate_many(leaning, ground()))
    assert len(single.to_dict()["values"]) == 1
    assert "peak_rad" not in single.to_dict()["values"][0]
    assert "1 block" in single.headline


def test_a_list_has_a_column_for_what_differs() -> None:
    sizes = [Block.rectangle(width=width, height=1.2) for width in (0.3, 0.4)]
    same = [sizes[0], sizes[0].with_restitution(0.8)]
    grounds = [ground(1), ground(2, name="other")]
    for blocks, given, expected in (
        (sizes[:1], {"motions": grounds[0]}, ["width", "height"]),
        (sizes, {"motions": grounds[0]}, ["width", "height", "alpha"]),
        (same, {"motions": grounds[0]}, ["block", "width", "height", "restitution"]),
        (sizes, {"motions": grounds}, ["width", "height", "alpha"]),
        (sizes[:1], {"motions": grounds[0], "reverse": "both"}, ["direction", "width", "height"]),
        (
            sizes[:1],
            {"motions": grounds[0], "pga_g": [0.2, 0.4]},
            ["width", "height", "PGA [g]", "scale"],
        ),
    ):
        table = describe_spectrum(simulate_many(blocks, **given)).tables[-1]
        assert [column.heading for column in table.columns] == [*expected, "peak"], expected


@every(
    ("key", "fates", "words"),
    [
        ("scale", {1.0: 0.25, 2.0: 0.5}, "stands; tilts to 0.5 alpha"),
        ("scale", {4.0: None, 1.0: 0.25, 2.0: None}, "falls from 2 x on; tilts to 0.25 alpha"),
        (
            "scale",
            {1.0: None, 2.0: 0.75, 3.0: None, 4.0: 0.5},
            "falls from 1 x on, stands at 2 of 4; tilts to 0.75 alpha",
        ),
        ("period_s", {1.0: None, 2.0: None, 4.0: 0.25}, "falls up to 2 s; tilts to 0.25 alpha"),
        (
            "period_s",
            {1.0: 0.5, 2.0: None, 4.0: 0.25},
            "falls up to 2 s, stands at 1 of 2; tilts to 0.5 alpha",
        ),
        ("period_s", {1.0: None}, "falls"),
    ],
)
def test_fates_over_sizes_and_scales_are_said_from_the_gentlest_on(
    key: Over, fates: dict[float, float | None], words: str
) -> None:
    """Larger scales and smaller blocks fall first."""
    rows: list[Cell] = []
    for at, peak in fates.items():
        rows.append({"peak": math.inf, "status": "overturned"})
        if peak is not None:
            rows[-1] = {"peak": peak, "status": "rocking"}
        rows[-1][key] = at
    assert _course(rows, key, 1) == words


def test_fates_of_a_suite_count_records() -> None:
    rows: list[Cell] = [
        {"period_s": at, "overturned": share, "peaks": [0.25, peak]}
        for at, share, peak in ((1.0, 0.75, math.inf), (2.0, 0.25, 0.5), (4.0, 0.0, 0.375))
    ]
    words = "falls up to 2 s, in at most 3 of 4 records; tilts to 0.375 alpha"
    assert _course(rows, "period_s", 4) == words
    assert _course(rows[1:2], "period_s", 4) == "falls in 1 of 4 records"
    assert _course(rows[2:], "period_s", 4) == "stands; tilts to 0.375 alpha"
