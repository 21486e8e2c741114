"""What is known of amplitudes, outliers and objects in general before the tests."""

import difflib
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Final

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.results.result import Result
from rocksteady.risk.observations.files.toml_tables import in_file
from rocksteady.risk.observations.object_prior import BOUNDS, ObjectPrior, possible
from rocksteady.risk.observations.shaking_test import LARGEST_SIGMA
from rocksteady.risk.observations.spread import PriorRange, spread_of
from rocksteady.small_files import content_of, toml_of

GENERAL: Final = ("base", "offset", "restitution", "housner_factor", "scatter")
"""Numbers of an object that may be known of all objects alike."""

SIGMA_LN: Final = PriorRange.between(0.05, 0.2)
SESSION_LN: Final = PriorRange.between(0.0, 0.4)
OUTLIERS: Final = PriorRange.between(0.01, 0.05)

NOISE: Final[Mapping[str, tuple[float, str]]] = {
    "sigma_ln": (LARGEST_SIGMA, "give the standard deviation of ln(gain), as 0.1"),
    "session_ln": (LARGEST_SIGMA, "give the standard deviation of ln(gain) of sessions, as 0.15"),
    "outliers": (0.5, "give the share of tests whose outcome has nothing to do with the model"),
}


@checked
@dataclass(frozen=True, kw_only=True)
class OutcomeErrors:
    """Priors of the amplitude error and of the share of outliers.

    Parameters
    ----------
    sigma_ln
        Amplitude error of a test that has none of its own: standard deviation of ln(gain), from 0
        to 3; default 0.05 to 0.2.
    outliers
        Share of tests whose outcome has nothing to do with the model, from 0 to 0.5; default 0.01
        to 0.05.
    session_ln
        Standard deviation of ln(gain) between sessions, from 0 to 3; default 0 to 0.4.

    Raises
    ------
    InputError
        If one is outside its range.

    Examples
    --------
    >>> OutcomeErrors(sigma_ln=PriorRange.exactly(0.1)).sigma_ln.fixed
    True
    """

    sigma_ln: PriorRange = SIGMA_LN
    outliers: PriorRange = OUTLIERS
    session_ln: PriorRange = SESSION_LN

    def __post_init__(self) -> None:
        """Validate."""
        for name, (most, hint) in NOISE.items():
            spread = getattr(self, name).within(name, 0.0, most, hint=hint)
            object.__setattr__(self, name, spread)


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Prior(Result):
    """Priors of all objects alike and of the errors of tests.

    Parameters
    ----------
    noise
        Amplitude error and outliers; default `OutcomeErrors()`.
    defaults
        Spread, number or text by name for every object that has none of its own: of ``base``,
        ``offset``, ``restitution`` or ``housner_factor``, and ``scatter``; default none.
    sources
        Hash (SHA-256) of each file that it comes from, by name; default none.

    Raises
    ------
    InputError
        If a name is unknown, a number not possible, or restitution and factor are both given.

    Examples
    --------
    >>> from rocksteady.risk.observations.object_prior import ObjectPrior
    >>> prior = Prior(defaults={"base": "0.9:1.0"})
    >>> column = prior.object_prior(ObjectPrior(name="column", width_m=0.15, height_m=0.6))
    >>> column.spreads["base"], column.defaults
    (<Spread 0.9:1.0>, ('offset', 'housner_factor', 'scatter'))
    """

    noise: OutcomeErrors = OutcomeErrors()
    defaults: Annotated[Mapping[str, PriorRange | float | str], INSIDE] = field(
        default_factory=dict
    )
    sources: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Validate."""
        made = {}
        for key, value in self.defaults.items():
            if key not in GENERAL:
                valid = f"it must be one of {', '.join(GENERAL)}"
                raise InputError("defaults", key, valid, _near(key, GENERAL))
            made[key] = possible(key, value)
        if "restitution" in made and "housner_factor" in made:
            raise InputError(
                "restitution, housner_factor",
                Words("are both given"),
                "the restitution is given itself, or as a factor on that of angular momentum",
                "leave one out",
            )
        object.__setattr__(self, "defaults", made)

    def object_prior(self, given: ObjectPrior) -> ObjectPrior:
        """Return an object with the defaults in place of those of the package."""
        return given.with_defaults(self.defaults)  # type: ignore[arg-type]  # ranges by now


@checked
def read_prior(path: Path | str) -> Prior:
    r"""Read priors of objects and errors from a TOML file.

    Parameters
    ----------
    path
        The file, with the tables ``[noise]`` (``sigma_ln``, ``outliers``) and ``[object]``
        (``base``, ``offset``, ``restitution`` or ``housner_factor``, ``scatter``), both optional.
        A value is a number, or a text as ``"0.6:1.0"`` or ``"0.1+-0.02"``.

    Returns
    -------
    Prior
        With the hash of the file.

    Raises
    ------
    InputError
        If it cannot be read, or a table, a key or a value is not valid; the line names them.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "prior.toml")
    ...     _ = file.write_text('[noise]\nsigma_ln = "0.1:0.3"\n[object]\nbase = 1\n', "utf-8")
    ...     prior = read_prior(file)
    >>> prior.noise.sigma_ln, prior.defaults["base"]
    (<Spread 0.1:0.3>, <Spread 1.0>)
    """
    file = Path(path)
    content = content_of(file, "prior", "name a file in TOML with [noise] and [object]")
    values = toml_of(content, file.name)
    known = {"noise": tuple(NOISE), "object": GENERAL}
    for name, table in values.items():
        if name not in known or not isinstance(table, dict):
            raise InputError(
                f"{file.name}: {name}",
                Words("is no table" if name in known else "is unknown"),
                "the tables are [noise] and [object]",
                f"write [{name}] and keys below it" if name in known else "take one of the two",
            )
        for key in table:
            if key not in known[name]:
                place = f"{file.name}: [{name}] {key}"
                valid = f"the keys of [{name}] are {', '.join(known[name])}"
                raise InputError(place, Words("is unknown"), valid, _near(key, known[name]))
    with in_file(file.name, "noise"):
        given = values.get("noise", {}).items()
        noise = OutcomeErrors(**{key: spread_of(key, value) for key, value in given})
    with in_file(file.name, "object"):
        sources = {file.name: hashlib.sha256(content).hexdigest()}
        return Prior(noise=noise, defaults=values.get("object", {}), sources=sources)


def _near(key: object, known: Sequence[str]) -> str:
    """Return a hint with the name that is most like another one."""
    close = difflib.get_close_matches(str(key), known, n=1)
    otherwise = "give sizes in the table of objects" if key in BOUNDS else "remove it"
    return f"did you mean {close[0]}?" if close else otherwise
