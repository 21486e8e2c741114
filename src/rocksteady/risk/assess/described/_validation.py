"""Values of an object file, checked: each key, its type and its range, in one line an error."""

import itertools
import math
from collections.abc import Mapping

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.housner_forms import form_of_text
from rocksteady.model.blocks.sizes import METRES, TALL
from rocksteady.model.checks.bounds import MASS
from rocksteady.model.checks.validation import in_range, whole_number
from rocksteady.risk.assess.described.schema import (
    TABLES,
    ObjectInput,
    Options,
    Range,
    inline_keys,
    numbers_of,
    own_states,
)
from rocksteady.risk.fragility.damage_states import DamageState
from rocksteady.risk.observations.files.toml_tables import TomlTables, named
from rocksteady.risk.screens.demand import VERTICAL

BOUNDS: Mapping[str, tuple[float, float, str, str]] = {
    "offset_m": (-TALL, TALL, "[]", "give how far right of the middle it is, in metres"),
    "inertia_kg_m2": (0.0, 1e15, "(]", "give the moment of inertia about the mass centre"),
    "mass_kg": MASS,
    "alpha_rad": (0.0, 0.5 * math.pi, "()", "give the angle in radians; alpha_deg takes degrees"),
    "alpha_deg": (0.0, 90.0, "()", "give the angle in degrees; alpha_rad takes radians"),
    "p_rad_s": (0.3, 100.0, "[]", "give the frequency parameter sqrt(M g R / I_0) in rad/s"),
    "cap_mass_ratio": (0.0, 1000.0, "[]", "give the mass of the cap over that of all columns"),
    "friction": (0.0, 3.0, "(]", "give the coefficient of friction, as 0.4"),
    "restitution": (0.0, 1.0, "(]", "give a ratio of angular velocities, or a form of 'housner'"),
    "gravity_m_s2": (0.1, 100.0, "[]", "leave it out for 9.80665 m/s^2"),
    "pga_g": (0.0, 10.0, "(]", "give the peak acceleration in g, as 0.35"),
    "pgv_m_s": (0.0, 10.0, "(]", "give the peak velocity in m/s: write 0.4 for 40 cm/s"),
    **VERTICAL,
    "period_s": (0.0, 60.0, "[]", "give a period in seconds, 0 of the peak acceleration"),
    "sa_g": (0.0, 30.0, "(]", "give a spectral acceleration in g"),
    "damping": (0.0, 1.0, "()", "give it over the critical one: 0.05 for 5 %"),
    "peak": (0.0, 10.0, "[]", "give theta/alpha, as 0.3"),
    "target_probability": (0.0, 1.0, "()", "give a probability, as 0.1"),
    "target_50_years": (0.0, 1.0, "()", "give a probability, as 0.01"),
}
"""Lowest and highest number of each key, whether they belong to it, and what to do."""

WHOLE: Mapping[str, tuple[int, int, str]] = {
    "floor": (0, 1000, "give the number of its floor, 0 for the ground, or the name of a room"),
    "columns": (1, 1000, "give the number of equal columns of a frame, as 4"),
    "draws": (1, 1000, "give the number of restitutions, as 5"),
}

FILE = TomlTables(kinds=TABLES, needs="an object has a name and a [geometry]", inline=inline_keys)


def validated(values: Mapping[str, object], source: str) -> ObjectInput:
    """Return the content of an object file as frozen tables.

    Parameters
    ----------
    values
        As `tomllib` returns them.
    source
        What they come from, for messages: a file, or a file and a line.

    Raises
    ------
    InputError
        With the key that is unknown and the nearest known one, or the key that is missing, of
        another type, or out of range.
    """
    if not values:
        raise InputError(
            source,
            Words("is empty"),
            "an object has a name and a [geometry]",
            "write name = ..., [geometry], width_m = ... and height_m = ...",
        )
    given = FILE.convert(values, ObjectInput, source)
    texts = {
        ("", "name"): given.name,
        ("", "kind"): given.kind,
        ("", "floor"): given.floor,
        ("", "building"): given.building,
        ("assessment", "records"): given.assessment.records,
        ("demand", "spectrum"): given.demand.spectrum,
    }
    for place, text in texts.items():
        if isinstance(text, str) and not text.strip():
            name, hint = named(source, *place), "give a text, or leave it out"
            raise InputError(name, text, "it must not be empty", hint)
    _check_restitution(given, source)
    for table, key, value in numbers_of(given):
        _check(table, key, value, source, walled=given.against_wall)
    options = given.assessment
    if options.target_probability is not None and options.target_50_years is not None:
        raise ModelError(
            named(source, "assessment", "target_50_years"),
            Words("stands beside target_probability"),
            "a verdict is on one target, of runs at the demand or in 50 years",
            "leave one of the two out",
        )
    _check_spectrum(given, source)
    _check_states(options, source)
    return given


def _check(table: str, key: str, value: object, source: str, *, walled: bool) -> None:
    """Refuse a number outside its range, and a range upside down."""
    name = named(source, table, key)
    if key in WHOLE:
        least, most, hint = WHOLE[key]
        whole_number(name, value, at_least=least, at_most=most, hint=hint)
        return
    low, high, ends, hint = BOUNDS.get(key, (0.0, TALL, "(]", METRES))
    if key == "restitution" and walled:
        ends = "[]"
    for number in (value.low, value.high) if isinstance(value, Range) else (value,):
        in_range(name, number, low, high, ends, hint=hint)  # type: ignore[arg-type]
    if isinstance(value, Range) and value.low > value.high:
        raise InputError(
            name, (value.low, value.high), "low must not be above high", "exchange the two"
        )


def _check_restitution(given: ObjectInput, source: str) -> None:
    """Refuse a text that is no form of Housner's restitution, or no factor of it."""
    text, name = given.restitution, named(source, "", "restitution")
    if not isinstance(text, str):
        return
    try:
        form = form_of_text(text)
    except InputError as error:
        raise InputError(name, text, error.valid, error.hint) from None
    if form is None:
        raise InputError(
            name,
            text,
            "it must be 'housner', a factor of it as 'housner*0.965', a number or "
            "{ low = ..., high = ... }",
            "leave it out for 'housner'",
        )


def _check_states(options: Options, source: str) -> None:
    """Refuse a damage state that there is not, one that comes twice, and a list of none."""
    place = named(source, "assessment", "damage_states")
    states = own_states(options)
    for state, peak in states:
        try:
            DamageState(state, peak)
        except InputError as error:
            raise InputError(place, state, error.valid, error.hint) from None
    names = [name for name, _ in states]
    if options.damage_states is not None and len({*names}) != max(1, len(names)):
        raise InputError(
            place,
            names,
            "there must be one or more, each of another name",
            "leave it out for the five usual ones",
        )


def _check_spectrum(given: ObjectInput, source: str) -> None:
    """Refuse a spectrum whose lists do not go together."""
    spectrum = given.demand.spectrum
    if spectrum is None or isinstance(spectrum, str):
        return
    periods = spectrum.period_s
    for before, after in itertools.pairwise(periods):
        if after <= before:
            name, hint = named(source, "demand.spectrum", "period_s"), "sort the rows"
            raise InputError(name, after, f"periods must rise, and {before:g} is before it", hint)
    if len(periods) != len(spectrum.sa_g) or len(periods) < 2:
        raise ModelError(
            named(source, "demand.spectrum", "period_s"),
            Words(f"and sa_g have {len(periods)} and {len(spectrum.sa_g)} values"),
            "a spectrum has two points or more",
            "give one sa_g for each period_s",
        )
