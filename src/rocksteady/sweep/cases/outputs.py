"""Outputs: the quantities computed in each cell of a grid."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.sweep.cases.axes import described, identifier
from rocksteady.sweep.cases.grid import Grid, each_once


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class Output:
    """A quantity computed in each cell of a sweep.

    Parameters
    ----------
    name
        An identifier: the variable of the result.
    dtype
        Type of its array: boolean, integer or float, of up to 64 bits.
    long_name, units
        As for `Axis`.
    flags
        For an integer that stands for a class: what each value means.
    attrs
        More attributes of the variable: numbers and texts by their names.

    Raises
    ------
    InputError
        If the name is no identifier, the dtype another one, or flags are given to what is no
        integer.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady.sweeps import Output
    >>> kind = Output(name="kind", dtype=np.int8, flags={0: "rest", 1: "overturned"})
    >>> kind.attributes["flag_meanings"]
    'rest overturned'
    """

    name: str
    dtype: Any = np.float64
    long_name: str = ""
    units: str = "1"
    flags: Mapping[int, str] = field(default_factory=dict)
    attrs: Mapping[str, int | float | str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Validate."""
        identifier(self.name)
        described(self.long_name, self.units)
        object.__setattr__(self, "dtype", _dtype(self.dtype))
        if self.dtype.kind not in "biuf" or self.dtype.itemsize > 8:
            raise InputError(
                "dtype",
                str(self.dtype),
                "an output is boolean, integer or float, of up to 64 bits",
                "code it as an integer with flags",
            )
        if self.flags and self.dtype.kind not in "iu":
            raise InputError(
                "flags",
                self.name,
                f"only integers have flags, and this output is {self.dtype}",
                "give it an integer dtype",
            )

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes of its variable in a dataset, flags as in the CF conventions."""
        attributes = words_of(self.long_name, self.units)
        if self.flags:
            attributes["flag_values"] = np.array(list(self.flags), dtype=self.dtype)
            attributes["flag_meanings"] = " ".join(
                meaning.replace(" ", "_") for meaning in self.flags.values()
            )
        return attributes | dict(self.attrs)

    @property
    def nothing(self) -> float | int | bool:
        """What stands where a cell has not been computed: nan, the lowest integer, or False."""
        if self.dtype.kind == "f":
            return float("nan")
        return False if self.dtype.kind == "b" else int(np.iinfo(self.dtype).min)


def _dtype(given: object) -> np.dtype[Any]:
    try:
        return np.dtype(given)  # type: ignore[call-overload,no-any-return]
    except Exception:  # noqa: BLE001 - numpy raises five kinds
        raise InputError(
            "dtype",
            given,
            "it must be the dtype of an array",
            "give numpy.float64, numpy.int8, ...",
        ) from None


def words_of(long_name: str, units: str) -> dict[str, Any]:
    """Return the attributes of a variable that has these."""
    return {"long_name": long_name, "units": units} if long_name else {"units": units}


def outputs_of(outputs: Sequence[Output], grid: Grid) -> tuple[Output, ...]:
    """Return the outputs, one or more, whose names are theirs alone.

    Raises
    ------
    InputError
        If there is none, or a name is that of another or of an axis.
    """
    checked = tuple(outputs)
    if not checked or not all(isinstance(output, Output) for output in checked):
        raise InputError(
            "outputs", outputs, "there is one or more", "give outputs=(rs.sweeps.Output(...),)"
        )
    each_once("outputs", [*grid.names, *(output.name for output in checked)])
    return checked
