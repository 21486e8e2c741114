"""A survey after a shaking: many objects at one place, and which of them fell."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result
from rocksteady.risk.observations.object_prior import ObjectPrior

MOST_OBJECTS = 10_000


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Survey(Result):
    """Objects of one place, each with its outcome in one shaking.

    Parameters
    ----------
    objects
        What is known of each object, each of another name.
    fell
        Whether it fell, True or False for each.
    reversed
        Whether the object is turned by 180 degrees, so that the shaking acts with the other sign:
        True, False, or None where its facing is unknown; by default None of all.  It matters for
        objects with two different sides alone.
    sources
        Hash (SHA-256) of each file that they come from, by name; default none.

    Raises
    ------
    InputError
        If there is no object, two have one name, or there is not one outcome for each.

    Examples
    --------
    >>> from rocksteady.calibration import ObjectPrior, Survey
    >>> graves = [
    ...     ObjectPrior(name=f"grave {k}", width_m="0.2:0.24", height_m=0.8 + 0.2 * k)
    ...     for k in range(3)
    ... ]
    >>> Survey(objects=graves, fell=[False, True, True])
    <Survey: 3 objects: 2 fell, 1 stood>
    """

    objects: Sequence[ObjectPrior]
    fell: Sequence[bool]
    reversed: Sequence[bool | None] | None = None
    sources: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Validate."""
        objects = tuple(self.objects)
        facing = (None,) * len(objects) if self.reversed is None else tuple(self.reversed)
        if not 1 <= len(objects) <= MOST_OBJECTS:
            raise InputError(
                "objects",
                Words(f"are {len(objects)}"),
                f"a survey has 1 to {MOST_OBJECTS}",
                "give a list of ObjectPrior",
            )
        names = [each.name for each in objects]
        doubled = [name for place, name in enumerate(names) if name in names[:place]]
        if doubled:
            hint = "give each another name"
            raise InputError("objects", doubled[0], "two objects have this name", hint)
        for key, values in (("fell", self.fell), ("reversed", facing)):
            if len(values) != len(objects):
                raise InputError(
                    key,
                    Words(f"has {plural(len(values), 'value')}"),
                    f"there are {len(objects)} objects",
                    "give one for each object",
                )
        object.__setattr__(self, "objects", objects)
        object.__setattr__(self, "fell", tuple(self.fell))
        object.__setattr__(self, "reversed", facing)
        object.__setattr__(self, "sources", dict(self.sources))

    def __len__(self) -> int:
        """Return the number of objects."""
        return len(self.objects)

    @property
    def outcomes(self) -> NDArray[np.float64]:
        """1 of each object that fell, 0 of one that stood, shape (objects,)."""
        return np.array(self.fell, dtype=np.float64)

    @property
    def facings(self) -> tuple[bool | None, ...]:
        """Whether each object is reversed; None where that is unknown or makes no difference."""
        assert self.reversed is not None
        return tuple(
            None if facing is None or _symmetric(each) else facing
            for each, facing in zip(self.objects, self.reversed, strict=True)
        )


def _symmetric(given: ObjectPrior) -> bool:
    """Return whether both sides of an object are alike, whatever it is within its prior."""
    shares = np.repeat([[0.3], [0.8]], len(given.parameters), axis=1)
    return all(block.symmetric for block in given.blocks(given.draw(shares)))
