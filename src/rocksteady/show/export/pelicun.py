"""Fragility of components as pelicun and its library of damage models read it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.risk.counted.reach import RATIO
from rocksteady.show.export.components import (
    LossComponent,
    LossState,
    check_identifiers,
    state_name,
)
from rocksteady.show.export.files import save_csv, save_text

HEAD = ("ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional")
OF_EACH = ("Family", "Theta_0", "Theta_1", "DamageStateWeights")
"""Columns of each limit state."""
REMARKS = (
    "Demand-Directional is 1, with the demand of the direction in which the object rocks: pelicun "
    "multiplies the demands of components with 0 by 1.2. A multilinear_CDF ends at 1: where "
    "counted shares end below it, the last point is added, and beyond the one before it nothing is "
    "counted."
)
PARTS = 1_000_000
"""Of the probability 1: six digits hold one of them."""


@checked
def write_pelicun(path: Path | str, components: Sequence[LossComponent]) -> tuple[Path, Path]:
    """Write components as a fragility table of pelicun, with its companion JSON.

    Columns and values are as `simcenter-dlml` 3.2 reads them: a lognormal has its median as
    ``Theta_0`` and its beta as ``Theta_1``, PGA is in g and PGV in m/s ("mps"). Points are a
    ``multilinear_CDF``: ``Theta_0`` has intensities, "|", and the probability at each.

    Such a curve rises from 0 to 1 everywhere. Equal shares rise by a millionth each, and a curve
    whose last share is below 1 has another point with 1, a step of levels beyond; the companion
    says so.

    Parameters
    ----------
    path
        Ends in ".csv"; the companion has the same name with ".json". Both are replaced.
    components
        One or more, of different identifiers.

    Returns
    -------
    tuple of Path
        The table and its companion.

    Raises
    ------
    InputError
        If an identifier occurs twice, or anything but components is given.
    OutputError
        If a file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady.export import LossComponent, LossState
    >>> falls = LossState(name="overturned", median=0.466, beta=0.592)
    >>> cabinet = LossComponent(
    ...     identifier="RS.cabinet", measure="pgv_m_s", states=(falls,), floor=True
    ... )
    >>> with TemporaryDirectory() as folder:
    ...     table, _ = write_pelicun(f"{folder}/fragility.csv", [cabinet])
    ...     print(table.read_text(encoding="utf-8").splitlines()[1])
    RS.cabinet,0,Peak Floor Velocity,mps,0,1,lognormal,0.466,0.592,
    """
    table = Path(path)
    if table.suffix.lower() != ".csv":
        raise InputError("path", path, "the table ends in .csv", "name it as fragility.csv")
    check_identifiers(components)
    companion = table.with_suffix(".json")
    most = max(len(component.states) for component in components)
    head = [*HEAD, *(f"LS{k + 1}-{name}" for k in range(most) for name in OF_EACH)]
    save_text("path", companion, _companion(components))  # first: no table is without its remarks
    save_csv("path", table, head, [_row(component, most) for component in components])
    return table, companion


def _row(component: LossComponent, most: int) -> list[object]:
    """Return the row of a component; an absent limit state is empty."""
    measure = component.intensity
    quantity, unit = ("Velocity", "mps") if measure.name == "pgv_m_s" else ("Acceleration", "g")
    demand = f"Peak {'Floor' if component.floor else 'Ground'} {quantity}"
    if measure.period_s is not None:
        demand = f"Spectral Acceleration|{measure.period_s!r}"
    row: list[object] = [component.identifier, 0, demand, unit, 0, 1]
    for state in component.states:
        if state.median is None:
            row += ["multilinear_CDF", _points_text(state), "", ""]
        else:
            row += ["lognormal", state.median, state.beta, ""]
    return row + [""] * (len(OF_EACH) * (most - len(component.states)))


def _points_text(state: LossState) -> str:
    """Return intensities and probabilities as pelicun reads them: rising from 0 to 1."""
    levels, shares = list(state.levels or ()), [*(state.shares or ()), 1.0]
    levels.append(RATIO * levels[-1])
    parts = np.rint(PARTS * np.array(shares)).astype(np.int64)
    count = int(np.argmax(parts == PARTS)) + 1
    steps = np.arange(count)  # two points differ by one at least
    parts = np.minimum.accumulate((parts[:count] - steps)[::-1])[::-1] + steps
    parts = np.maximum(parts, steps)
    texts = [f"{at:.12g}" for at in levels[:count]], [f"{part / PARTS:.6g}" for part in parts]
    return "|".join(",".join(column) for column in texts)


def _companion(components: Sequence[LossComponent]) -> str:
    """Return the companion: what each component and each of its states is."""
    import json

    from rocksteady import __version__

    values: dict[str, Any] = {
        "_GeneralInformation": {
            "ShortName": "Objects that rock",
            "Description": "Fragility of free-standing rigid objects, computed by rocksteady "
            f"{__version__}. The engineer verifies it.",
            "Version": "1.0",
        }
    }
    for component in components:
        values[component.identifier] = {
            "Description": component.description or f"Free-standing object {component.identifier}",
            "Comments": "\n".join(filter(None, [REMARKS, component.note])),
            "SuggestedComponentBlockSize": "1 EA",
            "RoundUpToIntegerQuantity": "True",
            "LimitStates": {
                f"LS{k + 1}": {"DS1": {"Description": state.name, "Name": state_name(state.name)}}
                for k, state in enumerate(component.states)
            },
        }
    # Plain ASCII: a reader with another encoding, as Windows has, gets the same text.
    return json.dumps(values, indent=2, ensure_ascii=True, allow_nan=False) + "\n"
