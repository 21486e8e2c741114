"""Labels of an ensemble: its coordinates, attributes, and sentences on what to mind."""

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.results.numbers import number, plural
from rocksteady.risk.ensemble import qualification
from rocksteady.risk.ensemble.levels import Levels, measured
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.seismic.measures.free_sides import side_coordinates
from rocksteady.seismic.spectra.batch import OUTPUTS

if TYPE_CHECKING:
    import xarray


DIMENSIONS = ("block", "record", "direction", "vertical", "draw", "level")
LARGE_FACTOR = 10.0
"""Factor of a record's accelerations above which scaling is remarked on."""
MOST_NAMES = 5


def labelled(
    arrays: Mapping[str, NDArray[Any]],
    bodies: Sequence[Block],
    records: Sequence[Record],
    levels: Levels,
    scale: Floats,
    band: RestitutionBand,
    *,
    coordinates: Mapping[str, Any],
    attributes: Mapping[str, Any],
) -> "xarray.Dataset":
    """Return the runs as a dataset.

    Parameters
    ----------
    arrays
        The variables, over all dimensions.
    bodies, records
        The blocks and the records.
    levels, scale, band
        What they were run at; the scale has shape (blocks, records, levels).
    coordinates
        Values of record, direction, vertical, uplift_scale and copied.
    attributes
        Further attributes.
    """
    import xarray

    words: dict[str, Mapping[str, Any]] = {
        **{output.name: output.attributes for output in OUTPUTS},
        **qualification.OUTPUTS,
        **qualification.FORCES,
        "uplift_time_s": {"units": "s", "long_name": "time of the first uplift"},
    }
    ratios = np.stack([band.ratios(block) for block in bodies])
    gravity = [block.gravity for block in bodies]
    intensity = levels.intensity
    factor = {"units": "1", "long_name": "factor of all accelerations"}
    level = dict(factor)
    if intensity is not None:
        level = {"long_name": intensity.label, "units": intensity.unit or "1"}
    lifting = {"units": "1", "long_name": "factor of all accelerations above which it lifts"}
    columns: dict[str, Any] = {
        "record": ("record", coordinates["record"], {"long_name": "ground motion"}),
        "direction": ("direction", coordinates["direction"], {"long_name": "sign of the record"}),
        "vertical": ("vertical", coordinates["vertical"], {"long_name": "vertical component"}),
        "draw": ("draw", np.arange(band.draws), {"long_name": "value of the restitution"}),
        "level": ("level", list(levels.values), level),
        "block": ("block", np.arange(1, len(bodies) + 1), {"long_name": "block"}),
        "gravity": (
            "block", gravity, {"units": "m s-2", "long_name": "acceleration of gravity"}
        ),
        "scale": (("block", "record", "level"), scale, factor),
        "uplift_scale": (DIMENSIONS[:4], coordinates["uplift_scale"], lifting),
    }  # fmt: skip
    columns |= side_coordinates(bodies)
    if coordinates["copied"].any():
        words_of_copy = {"long_name": "copy of the run without a vertical component"}
        columns["copied"] = (("record", "vertical"), coordinates["copied"], words_of_copy)
    two = "negative_alpha" in columns
    for prefix, side, column in (("", "positive", 0), ("negative_", "negative", 1))[: 1 + two]:
        of = f" of the {side} side" if two else ""
        values = ratios[:, :, column]
        about: dict[str, Any] = {"units": "1", "long_name": f"restitution{of}"}
        columns[f"{prefix}restitution"] = (("block", "draw"), values, about)
    beside = dict.fromkeys((*levels.beside, *(() if intensity is None else (intensity,))))
    for each in beside:
        about = {
            "units": each.unit or "1",
            "long_name": each.label,
            "measure": each.name,
            "scales": int(each.scales),
            **({} if each.period_s is None else {"period_s": each.period_s}),
        }
        columns[f"im_{each.key}"] = (("block", "record"), measured(each, records, bodies), about)
    return xarray.Dataset(
        {name: (DIMENSIONS, arrays[name], words[name]) for name in arrays},
        coords=columns,
        attrs={**attributes, "seed": str(band.seed), "scatter": band.scatter},
    )


def warnings_of(
    names: Sequence[str],
    records: Sequence[Record],
    scale: Floats,
    status: NDArray[Any],
    copied: NDArray[np.bool_],
) -> str:
    """Return sentences on what to mind, as a list in JSON."""
    remarks = []
    if flat := int(copied.any(axis=1).sum()):
        remarks.append(
            f"{flat} of {plural(len(names), 'record')} have no vertical component: their runs with "
            "it are copies, which count in shares and curves so that all records weigh the same."
        )
    alike: dict[tuple[float, bytes], list[str]] = {}
    for name, record in zip(names, records, strict=True):
        alike.setdefault((record.dt_s, record.acceleration_m_s2.tobytes()), []).append(name)
    remarks += [
        f"{', '.join(same[:MOST_NAMES])} hold the same samples: they count as "
        f"{len(same)} records and are one."
        for same in alike.values()
        if len(same) > 1
    ]
    large = scale > LARGE_FACTOR
    if large.any():
        strongest = names[int(np.unravel_index(int(np.argmax(scale)), scale.shape)[1])]
        remarks.append(
            f"Records are scaled by up to {number(float(scale.max()))} ({strongest}), in "
            f"{100.0 * large.mean():.0f} % of the runs by more than {LARGE_FACTOR:g}: a real "
            "motion that strong usually has another spectrum and duration."
        )
    for outcome in (Status.LOST_CONTACT, Status.UNDECIDED):
        if count := int((status == outcome).sum()):
            remarks.append(
                f"{count:,} of {status.size:,} runs ended {outcome.label}, without an answer."
            )
    return json.dumps(remarks)
