"""Fragility of components as OpenQuake reads it: NRML 0.5."""

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree as ET

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.show.export.components import (
    LossComponent,
    LossState,
    check_identifiers,
    state_name,
    text_value,
)
from rocksteady.show.export.files import save_whole

LossCategory = Literal["contents", "nonstructural"]
NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
MODEL = re.compile(r"[A-Za-z0-9_-]{1,75}")
REACH = 4.75
"""Standard deviations from the median to the limit without damage: a probability of 1e-6."""
QUANTILES = 191
"""Levels of a lognormal that stands beside points."""
CM = 100.0
"""OpenQuake's velocities are in cm/s."""
NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML 1.0 does not allow, in any spelling."""


@checked
def write_openquake(
    path: Path | str,
    components: Sequence[LossComponent],
    *,
    model_id: str = "rocksteady",
    loss_category: LossCategory = "contents",
) -> Path:
    r"""Write components as a fragility model of OpenQuake, NRML 0.5.

    A component whose states are all lognormal is a continuous function. Any other is a discrete
    one, with the levels of all its states; the first is the limit without damage, and above the
    last the probabilities stay.

    A lognormal has the arithmetic mean :math:`m = \hat x \exp(\beta^2/2)` and standard deviation
    :math:`m \sqrt{\exp(\beta^2) - 1}`, and not the median :math:`\hat x` and :math:`\beta`. PGV
    is in cm/s, PGA and spectral acceleration are in g.

    Parameters
    ----------
    path
        The file, which is replaced.
    components
        One or more, of different identifiers and the same damage states.
    model_id
        Identifier of the model: letters, digits, "_" and "-", at most 75.
    loss_category
        "contents", the default, or "nonstructural".

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If the states differ between components, or anything but components is given.
    OutputError
        If the file cannot be written.

    Notes
    -----
    OpenQuake holds the probability constant above ``maxIML``, and in classical damage calculations
    of continuous functions takes ``continuous_fragility_discretization`` levels between them, 20 by
    default: raise that number.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady.export import LossComponent, LossState
    >>> falls = LossState(name="overturned", median=0.3, beta=0.5)
    >>> vase = LossComponent(identifier="RS.vase", measure="pga_g", states=(falls,))
    >>> with TemporaryDirectory() as folder:
    ...     file = write_openquake(f"{folder}/fragility.xml", [vase])
    ...     print(file.read_text(encoding="utf-8").splitlines()[-4].strip())
    <params ls="overturned" mean="0.33994453592004786" stddev="0.18117015996326435" />
    """
    file = Path(path)
    check_identifiers(components)
    if not MODEL.fullmatch(text_value("model_id", model_id)):
        valid = "it must be 1 to 75 letters, digits, '_' and '-'"
        raise InputError("model_id", model_id, valid, "name it as museum_2026")
    states = [state_name(state.name) for state in components[0].states]
    for component in components:
        names = [state_name(state.name) for state in component.states]
        if names != states:
            raise InputError(
                component.identifier,
                Words(f"has the states {', '.join(names)}"),
                f"all components of a model have the same states, here {', '.join(states)}",
                "write the others to a file of their own",
            )
    root = ET.Element("nrml", {"xmlns": NAMESPACE})
    model = _child(
        root, "fragilityModel", id=model_id, assetCategory="buildings", lossCategory=loss_category
    )
    _child(model, "description").text = _allowed(_description(components))
    _child(model, "limitStates").text = " ".join(states)
    for component in components:
        function = _child(model, "fragilityFunction", id=component.identifier)
        if any(state.median is None for state in component.states):
            function.set("format", "discrete")
            _add_points(function, component)
        else:
            function.attrib |= {"format": "continuous", "shape": "logncdf"}
            _add_lognormals(function, component)
    ET.indent(root)
    data = ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"
    save_whole("path", file, lambda target: target.write_bytes(data))
    return file


def arithmetic_moments(median: float, beta: float) -> tuple[float, float]:
    """Return the arithmetic mean and standard deviation of a lognormal, in the median's unit.

    Examples
    --------
    >>> mean, deviation = arithmetic_moments(0.3, 0.5)
    >>> round(mean, 3), round(deviation, 3)
    (0.34, 0.181)
    """
    mean = median * math.exp(0.5 * beta * beta)
    return mean, mean * math.sqrt(math.expm1(beta * beta))


def _child(parent: ET.Element, tag: str, **attributes: str) -> ET.Element:
    return ET.SubElement(parent, tag, attributes)


def _unit(component: LossComponent) -> float:
    """Return by what an intensity is multiplied in the file."""
    return CM if component.measure == "pgv_m_s" else 1.0


def _measure(component: LossComponent) -> str:
    """Return the measure in OpenQuake's words."""
    if component.measure == "sa_g":
        return f"SA({component.period_s!r})"
    return "PGV" if component.measure == "pgv_m_s" else "PGA"


def _add_lognormals(function: ET.Element, component: LossComponent) -> None:
    """Add the lognormal of each state, and the levels between which it holds."""
    unit = _unit(component)
    betas = [(state.median or 0.0, state.beta or 0.0) for state in component.states]
    low = min(median * math.exp(-REACH * beta) for median, beta in betas)
    high = max(median * math.exp(REACH * beta) for median, beta in betas)
    # Below minIML the probability is that at minIML, and 0 up to noDamageLimit.
    _child(
        function,
        "imls",
        imt=_measure(component),
        noDamageLimit=repr(unit * low),
        minIML=repr(0.5 * unit * low),
        maxIML=repr(unit * high),
    )
    for state, (median, beta) in zip(component.states, betas, strict=True):
        mean, deviation = arithmetic_moments(unit * median, beta)
        name = state_name(state.name)
        _child(function, "params", ls=name, mean=repr(mean), stddev=repr(deviation))


def _add_points(function: ET.Element, component: LossComponent) -> None:
    """Add the curve of each state at the levels of all, linear between them."""
    levels = np.unique(np.concatenate([_levels_of(each) for each in component.states]))
    unit = _unit(component)
    limit = repr(float(unit * levels[0]))
    imls = _child(function, "imls", imt=_measure(component), noDamageLimit=limit)
    imls.text = _numbers(unit * levels[1:])
    for state in component.states:
        poes = _child(function, "poes", ls=state_name(state.name))
        poes.text = _numbers(state.probability(levels[1:]))


def _levels_of(state: LossState) -> Floats:
    """Return the levels of points, or those between which straight lines hold a lognormal."""
    if state.median is None or state.beta is None:
        return np.array(state.levels)
    return np.asarray(state.median * np.exp(state.beta * np.linspace(-REACH, REACH, QUANTILES)))


def _numbers(values: Floats) -> str:
    return " ".join(repr(value) for value in values.tolist())


def _description(components: Sequence[LossComponent]) -> str:
    """Return what the model is, and what each component's curves stand for."""
    from rocksteady import __version__

    lines = [
        f"Free-standing rigid objects, computed by rocksteady {__version__}. The engineer verifies."
    ]
    for component in components:
        head = f"{component.identifier}: {component.description}".strip()
        lines.append(" ".join([head, *component.notes]))
    return "\n".join(lines)


def _allowed(text: str) -> str:
    """Return text in characters that XML has."""
    return NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text.replace("\r\n", "\n").replace("\r", "\n"))
