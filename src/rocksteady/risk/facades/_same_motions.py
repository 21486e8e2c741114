"""Motions that a mean would count twice."""

from collections.abc import Sequence
from typing import Final

from rocksteady.errors import InputError, Words
from rocksteady.seismic.spectra.batch import GroundShaking

MOST_SHOWN: Final = 60


def different_motions(grounds: Sequence[GroundShaking]) -> int:
    """Return the number of horizontal motions, once each with and without a vertical one.

    Raises
    ------
    InputError
        If two grounds are alike in every sample, whatever their names.
    """
    names: dict[object, str] = {}
    across = set()
    for number, ground in enumerate(grounds, 1):
        record, up = ground.record, ground.vertical
        name = (record.name or f"record {number}")[:MOST_SHOWN]
        level = (record.dt_s, record.acceleration_m_s2.tobytes())
        across.add(level)
        whole = (level, None if up is None else up.acceleration_m_s2.tobytes())
        if whole in names:
            raise InputError(
                "records",
                Words(f"have one motion twice, as {names[whole]} and as {name}"),
                "a mean counts each motion once",
                "leave one out",
            )
        names[whole] = name
    return len(across)
