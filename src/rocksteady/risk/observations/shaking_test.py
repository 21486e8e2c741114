"""One shaking of one object, and whether it fell."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Final

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, nonempty_text
from rocksteady.model.motions.record import Record

GAIN: Final = Bounds(
    1e-6, 1e6, "[]", "give the factor on the record, as 0.8; reversed changes the sign"
)
"""Of a test: a record in wrong units is hardly further off."""

LARGEST_SIGMA: Final = 3.0
"""Of an amplitude error: the gain is then known to a factor of 20 either way."""
SIGMA: Final = Bounds(
    0.0, LARGEST_SIGMA, "[]", "give the standard deviation of ln(gain), as 0.1, or leave it out"
)

_RADIANS: Final = "give the angle in radians: 1 degree is 0.01745"
PEAK: Final = Bounds(0.0, 0.5 * math.pi, "[)", _RADIANS)
PEAK_ERROR: Final = Bounds(1e-9, 0.5 * math.pi, "[)", _RADIANS)
"""Of a measured angle [rad]: no instrument is better than 1e-9, and densities stay finite."""


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class ShakingTest:
    """One shaking of one object with its outcome.

    Parameters
    ----------
    name
        Name of the test, another one for each.
    record
        Base acceleration that was measured or commanded.
    object
        Name of the object that was shaken.
    fell
        Whether it fell; None where that is not known, as in a prediction.
    gain
        Factor on the record and on the vertical motion; default 1.
    transverse
        Acceleration of the second horizontal channel, with the interval of the record; none by
        default.  The object then rocks in a plane whose angle from the record's is unknown.
    sigma_ln
        Amplitude error: standard deviation of ln(gain); default the prior's.
    vertical
        Vertical base acceleration, positive upwards; none by default.
    reversed
        Whether the object was turned by 180 degrees, so that the record acts with the other sign;
        default False.
    group
        Name of the tests that stay together when tests are held out; default the record's name.
    session
        Name of the day or the set-up; none by default.
    peak_rad, sigma_rad
        Largest absolute angle measured of a test that stood, and its measuring error as a standard
        deviation [rad]; none by default.

    Raises
    ------
    InputError
        If a name is empty, a record has no name and the test no group, the gain is not in
        [1e-6, 1e6], the amplitude error not in [0, 3], the angle not in [0, pi/2) or its error not
        in [1e-9, pi/2).
    ModelError
        If a peak is given without its error, an error without its peak, or either of a test that
        did not stand.

    Examples
    --------
    >>> from rocksteady import Record
    >>> record = Record(acceleration_m_s2=[0.0, 3.1, -1.2, 0.0], dt_s=0.02, name="run 7")
    >>> test = ShakingTest(name="t1", record=record, object="column", fell=True, gain=0.5)
    >>> test.group, test.motion.peak_acceleration_m_s2
    ('run 7', 1.55)
    """

    name: Annotated[str, nonempty_text]
    record: Record
    object: Annotated[str, nonempty_text]
    fell: bool | None = None
    gain: Annotated[float, GAIN] = 1.0
    sigma_ln: Annotated[float | None, SIGMA] = None
    vertical: Record | None = None
    reversed: bool = False
    group: Annotated[str | None, nonempty_text] = None
    session: Annotated[str | None, nonempty_text] = None
    peak_rad: Annotated[float | None, PEAK] = None
    sigma_rad: Annotated[float | None, PEAK_ERROR] = None
    transverse: Record | None = None

    def __post_init__(self) -> None:
        """Validate what goes together."""
        if self.group is None:
            if not (self.record.name or "").strip():
                raise InputError(
                    "group",
                    Words("is not given"),
                    "by default it is the name of the record, which has none",
                    "give the record a name, or the test a group",
                )
            object.__setattr__(self, "group", self.record.name)
        if (self.peak_rad is None) != (self.sigma_rad is None):
            keys = ("peak_rad", "sigma_rad")
            missing, given = keys if self.peak_rad is None else keys[::-1]
            raise ModelError(
                missing,
                Words(f"is missing beside {given}"),
                "a measured angle and its measuring error go together",
                "give both, as peak_rad 0.12 and sigma_rad 0.01, or neither",
            )
        if self.peak_rad is not None and self.fell is not False:
            outcome = "is unknown" if self.fell is None else "is that it fell"
            raise ModelError(
                "peak_rad",
                Words(f"is given of a test whose outcome {outcome}"),
                "only a test that stood has a largest angle",
                "leave peak_rad and sigma_rad out",
            )
        if self.transverse is not None and self.transverse.dt_s != self.record.dt_s:
            valid = f"the record has an interval of {self.record.dt_s:g} s"
            hint = "resample one of the two"
            raise InputError("transverse", self.transverse, valid, hint)

    @property
    def motion(self) -> Record:
        """The record as it acts: times the gain, and with the other sign where reversed."""
        factor = -self.gain if self.reversed else self.gain
        return self.record if factor == 1.0 else self.record.scaled(factor)


def distinct(tests: Sequence[ShakingTest]) -> tuple[ShakingTest, ...]:
    """Return tests, one or more, each of another name.

    Raises
    ------
    InputError
        If there is none, or two have one name.
    """
    if not tests:
        raise InputError("tests", [], "there must be one or more", "give a list of ShakingTest")
    name, times = Counter(test.name for test in tests).most_common(1)[0]
    if times > 1:
        raise InputError("tests", name, "two tests have this name", "give each another name")
    return tuple(tests)
