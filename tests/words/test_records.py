"""Words of measures, integrated records and response spectra: all measures, their units."""

import math

import numpy as np
import pytest

from rocksteady import Block, Record, compute_measures
from rocksteady.measures import compute_response_spectrum, integrate_record
from rocksteady.words.records import WORDS
from tests.seismic.sines import noise, sine

BLOCK = Block.rectangle(width=0.4, height=1.6, gravity=3.7)


def test_the_table_of_notebooks_has_every_measure() -> None:
    found = compute_measures(sine(), BLOCK)
    html = found._repr_html_()
    for words, unit in WORDS.values():
        assert words in html
        assert unit in html
    assert ">PGV/PGA</th>" in html
    assert found.record == sine()
    assert found.block is BLOCK
    assert repr(found).startswith("<Measures: record: PGA ")


def test_the_keys_are_the_measures_without_those_of_no_block() -> None:
    found = compute_measures(sine())
    assert found.to_dict().keys() == WORDS.keys() - {
        "pga_per_uplift",
        "p_pgv_per_uplift",
        "p_pgv_per_pga",
    }
    assert all(value == getattr(found, name) for name, value in found.to_dict().items())
    assert found.warning is None
    samples = sine().acceleration_m_s2 + 0.5
    drifting = compute_measures(Record(acceleration_m_s2=samples, dt_s=sine().dt_s))
    assert (drifting.warning or "").startswith("PGD = ")
    assert "--baseline linear" in drifting.summary().replace("\n", " ")


def test_a_response_spectrum_has_a_row_for_each_period() -> None:
    spectrum = compute_response_spectrum(noise(3), [0.1, 0.5, 1.0], damping=0.02)
    values = spectrum.to_dict()
    assert values["periods_s"] == [0.1, 0.5, 1.0]
    assert values["damping"] == 0.02
    frequency = 2.0 * math.pi / np.array(values["periods_s"])
    np.testing.assert_allclose(
        values["pseudo_velocity_m_s"], frequency * np.array(values["displacement_m"])
    )
    rows = [line.split() for line in spectrum.summary().splitlines()[-3:]]
    assert [float(row[0]) for row in rows] == values["periods_s"]
    shown = [1e-3 * float(row[5]) for row in rows]
    assert shown == pytest.approx(values["displacement_m"], rel=6e-3)
    dataset = spectrum.to_dataset()
    assert dataset.displacement_m.values.tolist() == values["displacement_m"]
    assert dataset.acceleration_m_s2.attrs["units"] == "m s-2"
    assert spectrum.plot().get_lines()


def test_an_integrated_record_has_its_peaks_and_its_end() -> None:
    course = integrate_record(noise(3))
    values = course.to_dict()
    assert values["pga_m_s2"] == abs(course.peak_acceleration.value)
    assert values["pgv_t_s"] == course.peak_velocity.t_s
    assert values["final_velocity_m_s"] == course.velocity_m_s[-1]
    assert "PGV" in course.summary()
    dataset = course.to_dataset()
    np.testing.assert_array_equal(dataset.velocity_m_s, course.velocity_m_s)
    assert dataset.sizes == {"t_s": len(course.t_s)}
    assert repr(course).startswith("<IntegratedRecord: Ground motion of ")
