"""One shaking of one object, and whether it fell."""

import math
from dataclasses import dataclass

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.model.motions.record import Record

SMALLEST_GAIN, LARGEST_GAIN = 1e-6, 1e6
"""Of a test: a record in wrong units is hardly further off."""

SMALLEST_ERROR = 1e-9
"""Of a measured angle [rad]: no instrument is as good, and densities stay finite."""

LARGEST_SIGMA = 3.0
"""Of an amplitude error: the gain is then known to a factor of 20 either way."""


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

    name: str
    record: Record
    object: str
    fell: bool | None = None
    gain: float = 1.0
    sigma_ln: float | None = None
    vertical: Record | None = None
    reversed: bool = False
    group: str | None = None
    session: str | None = None
    peak_rad: float | None = None
    sigma_rad: float | None = None
    transverse: Record | None = None

    def __post_init__(self) -> None:
        """Validate."""
        for key in ("name", "object", "group", "session"):
            _check_text(key, getattr(self, key), optional=key in ("group", "session"))
        if self.group is None:
            object.__setattr__(self, "group", self._name_of_record())
        hint = "give the factor on the record, as 0.8; reversed changes the sign"
        self._set("gain", in_range("gain", self.gain, SMALLEST_GAIN, LARGEST_GAIN, "[]", hint=hint))
        if self.sigma_ln is not None:
            hint = "give the standard deviation of ln(gain), as 0.1, or leave it out"
            self._set(
                "sigma_ln",
                in_range("sigma_ln", self.sigma_ln, 0.0, LARGEST_SIGMA, "[]", hint=hint),
            )
        self._check_peak()
        if self.transverse is not None and self.transverse.dt_s != self.record.dt_s:
            valid = f"the record has an interval of {self.record.dt_s:g} s"
            hint = "resample one of the two"
            raise InputError("transverse", self.transverse, valid, hint)

    @property
    def motion(self) -> Record:
        """The record as it acts: times the gain, and with the other sign where reversed."""
        factor = -self.gain if self.reversed else self.gain
        return self.record if factor == 1.0 else self.record.scaled(factor)

    def _name_of_record(self) -> str:
        """Return the name of the record as the group."""
        name = self.record.name
        if name is None or not name.strip():
            raise InputError(
                "group",
                Words("is not given"),
                "by default it is the name of the record, which has none",
                "give the record a name, or the test a group",
            )
        return name

    def _check_peak(self) -> None:
        """Check the angle that was measured."""
        given = {key: getattr(self, key) for key in ("peak_rad", "sigma_rad")}
        keys = [key for key, value in given.items() if value is not None]
        if not keys:
            return
        if len(keys) == 1:
            missing = "sigma_rad" if keys == ["peak_rad"] else "peak_rad"
            raise ModelError(
                missing,
                Words(f"is missing beside {keys[0]}"),
                "a measured angle and its measuring error go together",
                "give both, as peak_rad 0.12 and sigma_rad 0.01, or neither",
            )
        if self.fell is not False:
            outcome = "is unknown" if self.fell is None else "is that it fell"
            raise ModelError(
                "peak_rad",
                Words(f"is given of a test whose outcome {outcome}"),
                "only a test that stood has a largest angle",
                "leave peak_rad and sigma_rad out",
            )
        hint, most = "give the angle in radians: 1 degree is 0.01745", 0.5 * math.pi
        self._set("peak_rad", in_range("peak_rad", self.peak_rad, 0.0, most, "[)", hint=hint))
        error = in_range("sigma_rad", self.sigma_rad, SMALLEST_ERROR, most, "[)", hint=hint)
        self._set("sigma_rad", error)

    def _set(self, key: str, value: float) -> None:
        object.__setattr__(self, key, value)


def _check_text(key: str, value: str | None, *, optional: bool) -> None:
    """Refuse a name that is empty or no text."""
    if value is None and optional:
        return
    given: object = value
    if not isinstance(given, str) or not given.strip():
        raise InputError(key, given, "it must be a text that is not empty", "give a name")
