"""Demand: what a record gives, and what is refused."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, Demand, Record, compute_measures, screen_block
from rocksteady.errors import InputError
from tests.every import every


def test_a_record_gives_its_peaks_and_its_spectrum() -> None:
    t = 0.01 * np.arange(300)
    record = Record(acceleration_m_s2=2.0 * np.sin(9.0 * t), dt_s=0.01)
    found = Demand.from_record(record, sa_v_per_sa_h=0.5)
    measured = compute_measures(record)
    assert found.pga_g == pytest.approx(measured.pga_g, rel=1e-14)
    assert found.pgv_m_s == pytest.approx(measured.pgv_m_s, rel=1e-14)
    assert found.spectrum is record
    assert found.sa_v_per_sa_h == 0.5


def test_a_file_is_read_when_the_demand_is_made(tmp_path: Path) -> None:
    file = tmp_path / "spectrum.txt"
    file.write_text("# damping 0.02\n0.1 0.3\n0.2 0.4\n", encoding="utf-8")
    stated = Demand(spectrum=str(file))
    assert stated.spectrum.tolist() == [[0.1, 0.3], [0.2, 0.4]]
    assert stated.spectrum_damping == (0.02,)
    assert Demand(spectrum=file, spectrum_damping=0.02).spectrum_damping == 0.02
    with pytest.raises(InputError, match=r"spectrum_damping = 0\.05 .* states 0\.02; leave it out"):
        Demand(spectrum=file, spectrum_damping=0.05)
    file.write_text("0.2 0.3\n0.1 0.4\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"spectrum\.txt'.* and after 0\.2 s follows 0\.1 s; "):
        Demand(spectrum=file)


def test_a_row_at_period_zero_is_the_pga_where_none_is_given() -> None:
    table = [[0.0, 0.3], [0.5, 0.8]]
    assert Demand(spectrum=table, spectrum_damping=0.05).with_peak().pga_g == 0.3
    assert Demand(spectrum=table, pga_g=0.4).with_peak().pga_g == 0.4
    assert Demand(spectrum=[[0.1, 0.3], [0.5, 0.8]]).with_peak().pga_g is None
    # At period 0 no damping matters; of columns that differ all the same the largest counts.
    columns = [[0.0, 0.2, 0.35, 0.3], [0.5, 0.8, 0.7, 0.6]]
    assert Demand(spectrum=columns).with_peak().pga_g == 0.35
    # A replaced spectrum brings its own peak.
    stronger = replace(Demand(spectrum=table), spectrum=[[0.0, 0.9], [0.5, 0.8]])
    screens = screen_block(Block.rectangle(width=0.4, height=1.6), stronger)
    assert screens.demand.pga_g == stronger.with_peak().pga_g == 0.9


def test_vertical_motion_acts_with_its_share_at_the_peak() -> None:
    record = Record(acceleration_m_s2=np.array([0.0, 2.0, -2.0, 0.0]), dt_s=0.2)
    whole = Demand.from_record(record, vertical_g=0.3)
    part = Demand.from_record(record, vertical_g=0.3, vertical_share=0.4)
    assert [whole.vertical_at_peak_g, part.vertical_at_peak_g] == pytest.approx([0.3, 0.12])
    assert whole.vertical_words.startswith("0.3 g of vertical motion")
    assert part.vertical_words.startswith(
        "0.12 g of vertical motion downwards at the peak (0.4 of 0.3 g)"
    )
    for none in (Demand(pga_g=0.3), Demand(vertical_g=0.3, vertical_share=0.0)):
        assert none.vertical_words == ""


@every(
    ("arguments", "name"),
    [
        ({"pga_g": 0.0}, "pga_g"),
        ({"pga_g": "0.3"}, "pga_g"),
        ({"pgv_m_s": -0.4}, "pgv_m_s"),
        ({"pgv_m_s": float("nan")}, "pgv_m_s"),
        ({"vertical_g": -0.1}, "vertical_g"),
        ({"vertical_share": 1.1}, "vertical_share"),
        ({"sa_v_per_sa_h": -0.1}, "sa_v_per_sa_h"),
        ({"spectrum_damping": 0.05}, "spectrum_damping"),
        ({"spectrum": 3.0}, "spectrum"),
        ({"spectrum": "no/such.txt"}, "spectrum"),
    ],
)
def test_what_is_no_demand_is_refused(arguments: dict[str, Any], name: str) -> None:
    with pytest.raises(InputError) as refusal:
        Demand(**arguments)
    assert refusal.value.name == name
