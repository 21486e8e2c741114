"""Held-out scores that plots need."""

from rocksteady.errors import InputError, Words
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.validate import Validation


def checked_validation(calibration: Calibration) -> Validation:
    """Return the held-out scores of a calibration.

    Raises
    ------
    InputError
        If it has none.
    """
    if not calibration.validation.rows:
        raise InputError(
            "calibration",
            Words("has no held-out scores"),
            "they need outcomes of two groups or more",
            "read its warnings",
        )
    return calibration.validation
