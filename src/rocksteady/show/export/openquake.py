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

    A component of lognormals is a continuous function. One of points is a discrete function, with
    the levels of all its states; the first is the limit without damage, and above the last the
    probabilities stay.

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
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "fragilityModel", id=model_id, assetCategory="buildings", lossCategory=loss_category
    )
    ET.SubElement(model, "description").text = _allowed(_description(components))
    ET.SubElement(model, "limitStates").text = " ".join(states)
    for component in components:
        _add_function(model, component)
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


def _add_function(model: ET.Element, component: LossComponent) -> None:
    """Add the curves of a component: its lognormals, or its points, linear between them."""
    measure, states = component.intensity, component.states
    unit = CM if measure.name == "pgv_m_s" else 1.0
    imt = measure.name.partition("_")[0].upper()
    if measure.period_s is not None:
        imt = f"SA({measure.period_s!r})"
    function = ET.SubElement(model, "fragilityFunction", id=component.identifier)
    imls = ET.SubElement(function, "imls", imt=imt)
    if states[0].median is None:
        function.set("format", "discrete")
        first, *levels = sorted({level for state in states for level in state.levels or ()})
        imls.set("noDamageLimit", repr(unit * first))
        imls.text = _numbers(unit * np.array(levels))
        for state in states:
            poes = ET.SubElement(function, "poes", ls=state_name(state.name))
            poes.text = _numbers(state.probability(levels))
        return
    function.attrib |= {"format": "continuous", "shape": "logncdf"}
    betas = [(unit * (state.median or 0.0), state.beta or 0.0) for state in states]
    low = min(median * math.exp(-REACH * beta) for median, beta in betas)
    high = max(median * math.exp(REACH * beta) for median, beta in betas)
    # Below minIML the probability is that at minIML, and 0 up to noDamageLimit.
    imls.attrib |= {"noDamageLimit": repr(low), "minIML": repr(0.5 * low), "maxIML": repr(high)}
    for state, (median, beta) in zip(states, betas, strict=True):
        mean, deviation = arithmetic_moments(median, beta)
        name = state_name(state.name)
        ET.SubElement(function, "params", ls=name, mean=repr(mean), stddev=repr(deviation))


def _numbers(values: Floats) -> str:
    return " ".join(repr(value) for value in values.tolist())


def _description(components: Sequence[LossComponent]) -> str:
    """Return what the model is, and what each component's curves stand for."""
    from rocksteady import __version__

    head = f"Free-standing rigid objects, computed by rocksteady {__version__}."
    return "\n".join(
        [
            f"{head} The engineer verifies.",
            *(f"{each.identifier}: {each.description} {each.note}".strip() for each in components),
        ]
    )


def _allowed(text: str) -> str:
    """Return text in characters that XML has."""
    return NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text.replace("\r\n", "\n").replace("\r", "\n"))
