"""Tests and what is known of the objects before them."""

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.result import Result
from rocksteady.risk.observations._doubts import doubts_on
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.shaking_test import ShakingTest, distinct


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Observations(Result):
    """Shaking tests and the priors of their objects.

    Parameters
    ----------
    tests
        One or more, each of another name.
    objects
        What is known of each object, by its name; objects without a test are left out.
    sources
        Hash (SHA-256) of each file that they come from, by name; default none.
    remarks
        Sentences on how the files were read; default none.

    Raises
    ------
    InputError
        If there is no test, two have one name, or an object of one is not there.

    Examples
    --------
    >>> from rocksteady import Record
    >>> from rocksteady.risk.observations.object_prior import ObjectPrior
    >>> record = Record(acceleration_m_s2=[0.0, 3.1, -1.2, -1.9, 0.0], dt_s=0.02, name="run 7")
    >>> tests = [
    ...     ShakingTest(name=f"t{k}", record=record, object="column", fell=k > 0, gain=1.0 + k)
    ...     for k in range(3)
    ... ]
    >>> column = ObjectPrior(name="column", width_m=0.15, height_m=0.6)
    >>> shaken = Observations(tests=tests, objects={"column": column})
    >>> shaken
    <Observations: 3 tests of 1 object on 1 record: 2 fell, 1 stood>
    >>> shaken.subset([1, 2]).fell.tolist()
    [1.0, 1.0]
    """

    tests: Sequence[ShakingTest]
    objects: Mapping[str, ObjectPrior]
    sources: Mapping[str, str] = field(default_factory=dict)
    remarks: Sequence[str] = ()

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "tests", distinct(self.tests))
        for test in self.tests:
            if test.object not in self.objects:
                close = difflib.get_close_matches(test.object, map(str, self.objects), n=1)
                raise InputError(
                    "objects",
                    Words(f"has no {test.object!r}, which test {test.name!r} shook"),
                    "each test has an object there",
                    f"did you mean {close[0]}?" if close else "add it",
                )
        used = {test.object for test in self.tests}
        objects = {name: prior for name, prior in self.objects.items() if name in used}
        object.__setattr__(self, "objects", objects)
        object.__setattr__(self, "remarks", tuple(self.remarks))

    def __len__(self) -> int:
        """Return the number of tests."""
        return len(self.tests)

    @cached_property
    def fell(self) -> Floats:
        """1 of each test that fell, 0 of one that stood, NaN where it is not known."""
        return np.array([np.nan if t.fell is None else float(t.fell) for t in self.tests])

    @cached_property
    def groups(self) -> NDArray[np.str_]:
        """Group of each test, shape (n,)."""
        return np.array([test.group for test in self.tests])

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what is unusual in the tests and in how they were read."""
        return tuple(dict.fromkeys((*doubts_on(self.tests, self.objects), *self.remarks)))

    def subset(self, indices: ArrayLike) -> "Observations":
        """Return some of the tests, with their objects.

        Parameters
        ----------
        indices
            Places of the tests, from 0.

        Raises
        ------
        InputError
            If there is no such test, or none is left.
        """
        chosen = np.asarray(indices)
        count = len(self.tests)
        whole = chosen.ndim == 1 and (chosen.dtype.kind in "iu" or chosen.size == 0)
        if not whole or (chosen.size and not -count <= chosen.min() <= chosen.max() < count):
            raise InputError(
                "indices",
                indices,
                f"it must be a row of whole numbers from 0 to {count - 1}",
                "give places of tests, as np.flatnonzero has them",
            )
        return replace(self, tests=[self.tests[k] for k in chosen.tolist()])

    def of(self, name: str) -> "Observations":
        """Return the tests of an object.

        Raises
        ------
        InputError
            If there are none.
        """
        if name not in self.objects:
            raise InputError("name", name, f"objects are {', '.join(self.objects)}", "give one")
        return replace(self, tests=[test for test in self.tests if test.object == name])
