"""Pictures of recorded motions: what is drawn is what was computed, with its unit."""

import math
from typing import Any, Literal

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady import Block, Harmonic, Record, plots, simulate
from rocksteady.errors import InputError, ModelError
from rocksteady.measures import compute_response_spectrum, integrate_record
from rocksteady.model.equations import Linear, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.show.figures.single import record_figure
from tests.every import every
from tests.seismic.sines import noise, sine

PERIODS = np.geomspace(0.05, 5.0, 30)


def axes() -> Axes:
    return Figure().add_subplot()


@every(
    ("quantity", "label", "size"),
    [
        ("acceleration", "acceleration [g]", 2.0 / 9.80665),
        ("velocity", "velocity [m/s]", 2.0 / math.pi),
        ("displacement", "displacement [m]", 1.0 / math.pi),
    ],
)
@every("sign", [1.0, -1.0])
def test_the_course_has_its_peak_marked(
    quantity: Literal["acceleration", "velocity", "displacement"],
    label: str,
    size: float,
    sign: float,
) -> None:
    drawn = plots.integrated_record(
        integrate_record(sine().scaled(sign)), axes(), quantity=quantity
    )
    _, curve, mark = drawn.lines
    assert (drawn.get_xlabel(), drawn.get_ylabel()) == ("time [s]", label)
    marked = float(np.asarray(mark.get_ydata())[0])
    assert abs(marked) == pytest.approx(size, rel=1e-5)
    assert abs(marked) == pytest.approx(np.abs(np.asarray(curve.get_ydata())).max(), rel=1e-9)
    assert f"{size:.3g}" in drawn.texts[0].get_text()
    low, high = drawn.get_ylim()
    assert low < marked < high
    assert low < 0.0 < high


def test_husids_curve_rises_from_0_to_1_through_its_marks() -> None:
    course = integrate_record(noise(1, samples=200))
    drawn = plots.husid(course, axes())
    curve, marks = drawn.lines
    values = np.asarray(curve.get_ydata())
    assert (values[0], values[-1]) == (0.0, 1.0)
    assert (np.diff(values) >= 0.0).all()
    at = np.asarray(marks.get_xdata())
    np.testing.assert_allclose(np.interp(at, course.t_s, values), [0.05, 0.75, 0.95], atol=0.01)
    assert [text.get_text() for text in drawn.texts[:3]] == ["5 %", "75 %", "95 %"]
    assert f"5 to 95 %: {at[2] - at[0]:.3g} s" in drawn.texts[3].get_text()


def test_spectra_and_their_geometric_mean() -> None:
    spectra = [compute_response_spectrum(noise(seed), PERIODS) for seed in (1, 2)]
    drawn = plots.response_spectra(spectra, axes())
    one, other, mean = (np.asarray(line.get_ydata()) for line in drawn.lines)
    np.testing.assert_allclose(one, spectra[0].pseudo_acceleration_m_s2 / 9.80665)
    np.testing.assert_allclose(mean, np.sqrt(one * other))
    names = [text.get_text() for text in drawn.texts]
    assert names == ["record 1", "record 2", "geometric mean", "5 % damping"] or sorted(
        names[:-1]
    ) == ["geometric mean", "record 1", "record 2"]
    assert drawn.get_legend() is None, "few have their names at the ends of their lines"
    below = plots.response_spectra(spectra, axes(), legend="below").get_legend()
    assert below is not None
    assert [text.get_text() for text in below.get_texts()] == [
        "record 1",
        "record 2",
        "geometric mean",
    ]
    assert below.get_title().get_text() == "5 % damping"
    assert (drawn.get_xscale(), drawn.get_yscale()) == ("log", "log")


def test_many_spectra_have_one_entry_beside_their_mean() -> None:
    spectra = [compute_response_spectrum(noise(seed), PERIODS) for seed in range(8)]
    legend = plots.response_spectra(spectra, axes()).get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["8 records", "geometric mean"]


def test_evenly_spaced_periods_have_even_axes() -> None:
    drawn = plots.response_spectra(
        [compute_response_spectrum(noise(1), np.linspace(0.1, 4, 40))], axes()
    )
    assert (drawn.get_xscale(), drawn.get_ylim()[0]) == ("linear", 0.0)
    assert drawn.texts[0].get_text() == "5 % damping"


def test_the_figure_of_one_and_of_several_records() -> None:
    courses = [integrate_record(noise(seed)) for seed in (1, 2)]
    spectra = [compute_response_spectrum(course.record, PERIODS) for course in courses]
    assert len(record_figure(courses[:1], spectra[:1], "one").axes) == 5
    assert len(record_figure(courses, spectra, "two").axes) == 1


def test_a_vertical_motion_is_drawn_beside_the_horizontal_one() -> None:
    block = Block.rectangle(width=0.4, height=1.6)
    upwards = Record(acceleration_m_s2=2.0 * sine().acceleration_m_s2, dt_s=sine().dt_s)
    run = simulate(block, BaseMotion(sine().scaled(2.0), upwards), model=Nonlinear())
    drawn = plots.base(run, axes())
    curves = {str(line.get_label()): np.asarray(line.get_ydata()) for line in drawn.lines}
    # Both in g, on one axis.
    assert np.abs(curves["vertical"]).max() == pytest.approx(4.0 / 9.80665, rel=1e-3)
    across = np.abs(sine().scaled(2.0).acceleration_m_s2).max()
    assert np.abs(curves["horizontal"]).max() == pytest.approx(across / 9.80665, rel=1e-3)
    assert drawn.get_ylabel() == "base  $a$ [g]"
    assert drawn.get_ylim()[1] > np.abs(curves["vertical"]).max()
    legend = drawn.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["horizontal", "vertical"]
    assert plots.base(simulate(block, sine(), model=Linear()), axes()).get_legend() is None


def test_what_is_refused() -> None:
    wrong: Any = "jerk"
    with pytest.raises(InputError, match="quantity = 'jerk'"):
        plots.integrated_record(integrate_record(sine()), axes(), quantity=wrong)
    with pytest.raises(InputError, match="spectra are 0"):
        plots.response_spectra([], axes())
    unlike = [compute_response_spectrum(noise(1), [period]) for period in (1.0, 2.0)]
    with pytest.raises(InputError, match="same periods"):
        plots.response_spectra(unlike, axes())


def test_a_motion_without_a_block_is_drawn_in_units_that_its_components_share() -> None:
    upwards = sine().scaled(-0.5)
    drawn = plots.base(BaseMotion(sine(), upwards), axes())
    longest = sorted(drawn.lines, key=lambda line: len(np.asarray(line.get_ydata())))[-2:]
    heights = sorted(float(np.abs(np.asarray(line.get_ydata())).max()) for line in longest)
    assert heights[0] == pytest.approx(0.5 * heights[1])
    with pytest.raises(ModelError, match="no unit in common"):
        plots.base(BaseMotion(Harmonic(amplitude=2.0, frequency_ratio=4.0), sine()), axes())
    drawn = plots.base(
        Harmonic(amplitude=2.0, frequency_ratio=4.0), axes(), quantity="displacement"
    )
    assert np.asarray(drawn.lines[0].get_ydata()).max() == pytest.approx(2.0 / 4.0**2, rel=1e-3)
