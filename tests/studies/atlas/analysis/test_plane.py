"""The window of an atlas: what it accepts, and its edges."""

import numpy as np
import pytest

from rocksteady.errors import InputError
from rocksteady.studies.atlas.analysis.plane import Plane
from tests.every import every

ROWS, COLUMNS = (1.0, 2.0, 3.0), (2.0, 4.0, 6.0, 8.0)


def test_edges_are_those_of_the_outermost_cells() -> None:
    plane = Plane(restitution=0.8, amplitude=ROWS, frequency_ratio=COLUMNS)
    assert plane.window == (1.0, 9.0, 0.5, 3.5)
    assert plane.top == 3.5


def test_no_edge_lies_below_zero() -> None:
    plane = Plane(restitution=0.8, amplitude=(0.1, 0.5, 0.9), frequency_ratio=(0.2, 1.2, 2.2))
    assert plane.window[0] == plane.window[2] == 0.0


def test_orders_come_once_and_ascending() -> None:
    plane = Plane(restitution=0.8, amplitude=ROWS, frequency_ratio=COLUMNS, orders=(5, 1, 5))
    assert plane.orders == (1, 5)


def test_axes_are_copies_that_nobody_changes() -> None:
    rows = np.array(ROWS)
    plane = Plane(restitution=0.8, amplitude=rows, frequency_ratio=COLUMNS)
    rows[0] = 7.0
    assert plane.amplitudes[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        plane.amplitudes[0] = 7.0


@every(
    ("name", "values"),
    [
        ("restitution", 1.0),
        ("restitution", 0.0),
        ("restitution", float("nan")),
        ("amplitude", (0.0, 1.0, 2.0)),
        ("amplitude", (1.0, 2.0)),
        ("amplitude", (3.0, 2.0, 1.0)),
        ("amplitude", (1.0, 2.0, 4.0)),
        ("amplitude", (1.0, 2.0, float("nan"))),
        ("amplitude", 2.0),
        ("frequency_ratio", (0.001, 1.001, 2.001)),
        ("orders", ()),
    ],
)
def test_what_is_no_plane_is_refused_by_name(name: str, values: object) -> None:
    given: dict[str, object] = {
        "restitution": 0.8,
        "amplitude": ROWS,
        "frequency_ratio": COLUMNS,
        name: values,
    }
    with pytest.raises(InputError) as caught:
        Plane(**given)  # type: ignore[arg-type]
    assert caught.value.name == name


def test_an_even_order_is_refused() -> None:
    with pytest.raises(InputError, match="odd"):
        Plane(restitution=0.8, amplitude=ROWS, frequency_ratio=COLUMNS, orders=(2,))
