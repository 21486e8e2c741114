"""Rows of the tables of a facade's page, in the words of a language."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from rocksteady.errors import InputError
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_check import FacadeCheck, LimitStateCheck
from rocksteady.facades.checks.facade_runs import FacadeRuns
from rocksteady.facades.checks.remark import Remark
from rocksteady.facades.checks.spectrum_table import SpectrumTable
from rocksteady.facades.plots.headline import LOOKS
from rocksteady.facades.plots.languages import Language
from rocksteady.outcomes import Status
from rocksteady.results.numbers import number
from rocksteady.risk.spectra.elastic_spectrum import ElasticSpectrum
from rocksteady.show.report import indexed, prose
from rocksteady.show.style.markup import Cell, Row, badge, digest, figure, named, quiet, under

LENGTH_DIGITS = 4
"""Digits of a size that was given."""


def in_words(remark: Remark, words: Language) -> str:
    """Return a remark in a language, its numbers with the decimal mark."""
    values = [
        words.marked(value) if re.fullmatch(r"-?[\d.e+-]+", value) else value
        for value in remark.values
    ]
    return typeset(words(f"remark_{remark.key}", *values))


def typeset(text: str) -> str:
    """Return a text with its indices and Greek letters.

    Examples
    --------
    >>> typeset("a0 FC and 0.4 d0, T0, theta^2, S_e(0)")
    'a₀ FC and 0.4 d₀, T₀, θ², S_e(0)'
    """
    text = re.sub(r"\b([adT])0\b", "\\1₀", text)
    text = re.sub(r"\beta\b", "η", text.replace("alpha_0", "α₀").replace("272-277", "272–277"))
    return text.replace("theta^2", "θ²")


def length(metres: float, words: Language) -> str:
    """Return a length in millimetres below a metre, in metres from there on."""
    if abs(metres) >= 1.0:
        return words.quantity(metres, "m")
    return words.quantity(1e3 * metres, "mm")


def places(facade: Facade, words: Language) -> dict[str, str]:
    """Return the words for a facade in sentences, by their places."""
    the = words[f"the_{facade.kind}"]
    return {"kind": words[facade.kind], "the": the, "The": the[:1].upper() + the[1:]}


def whole_sentence(text: str) -> str:
    """Return a text with a full stop, and a capital unless it begins with a symbol.

    Examples
    --------
    >>> whole_sentence("a₀ is 0.1 g"), whole_sentence("the wall falls.")
    ('a₀ is 0.1 g.', 'The wall falls.')
    """
    word = text[:1].isalpha() and (
        text[1:2].isalpha() or text[1:2] in " \N{RIGHT SINGLE QUOTATION MARK}"
    )
    text = text[:1].upper() + text[1:] if word else text
    return text if text.endswith(".") else f"{text}."


def sentences_of(check: FacadeCheck, words: Language) -> list[str]:
    """Return a sentence for each limit state with a verdict, or the one of none."""
    mechanism = check.mechanism
    if not check.states:
        linear, d0 = words.quantity(mechanism.linear_g, "g"), length(mechanism.d0_m, words)
        return [words("sentence_none", linear=linear, d0=d0)]
    sentences = []
    for state in check.states:
        passed, failed = (
            words.joined([words[f"method_{each.method}"] for each in check.decided(state, which)])
            for which in (True, False)
        )
        key = "differs" if passed and failed else "holds" if passed else "fails"
        name = words[state]
        sentences.append(
            words(
                f"sentence_{key}", state=name[:1].upper() + name[1:], passed=passed, failed=failed,
                methods=passed or failed,
            )
        )  # fmt: skip
    return sentences


def check_row(each: LimitStateCheck, words: Language) -> Row:
    """Return a check in words."""
    word, look = LOOKS[each.satisfied]
    names = {"demand": typeset(each.demand_name), "capacity": typeset(each.capacity_name)}
    ratio = each.ratio
    page = words("pages", page=each.page.replace("-", "–"))
    return {
        f"{words['col_state']}, {words['col_method']}": Cell(
            each.limit_state + under(words[f"method_{each.method}"]), "quarter name"
        ),
        words["col_formula"]: Cell(prose(f"{each.formula} †") + under(page), "formula"),
        words["col_quantity"]: indexed(prose(words(f"quantity_{each.method}", **names))),
        words["col_demand"]: figure(indexed(_amount(each.demand, each.unit, words))),
        words["col_capacity"]: figure(_amount(each.capacity, each.unit, words)),
        words["col_ratio"]: figure(
            "—" if ratio is None else "∞" if math.isinf(ratio) else words.number(ratio)
        ),
        words["col_verdict"]: badge(words[word], look),
    }


def _amount(value: float | None, unit: str, words: Language) -> str:
    """Return a demand or a capacity with its unit."""
    if value is None:
        return "—"
    if math.isinf(value):
        return words["beyond_all"]
    return words.quantity(value, "g") if unit == "g" else length(value, words)


def remarks_of_checks(check: FacadeCheck, words: Language) -> list[dict[str, str]]:
    """Return how each demand was made."""
    rows = []
    for each in check.checks:
        text = "; ".join(in_words(remark, words) for remark in each.remarks)
        if text:
            name = f"{each.limit_state}, {words[f'method_{each.method}']}"
            rows.append({"name": name, "words": text, "note": ""})
    return rows


def facade_rows(check: FacadeCheck, words: Language) -> list[dict[str, str]]:
    """Return geometry, material and the ways it may rock."""
    facade = check.facade

    def metres(value: float) -> str:
        return words.quantity(value, "m", LENGTH_DIGITS)

    level = facade.knowledge_level
    ratio, given = _restitution(check, words)
    rows = [
        ("fact_kind", words[facade.kind], ""),
        ("fact_thickness", metres(facade.thickness_m), ""),
        ("fact_height", metres(facade.height_m), ""),
        ("fact_base" if facade.kind == "gable" else "fact_length", metres(facade.length_m), ""),
        ("fact_unit_weight", words.quantity(facade.unit_weight_kn_m3, "kN/m³"), ""),
        ("fact_weight", words.quantity(facade.weight_kn, "kN"), ""),
        ("fact_hinge", words.quantity(1e3 * facade.hinge_inset_m, "mm"), ""),
        (
            "fact_fc",
            words.number(facade.confidence_factor),
            "" if level is None else words("fact_level", level=level),
        ),
        ("fact_sides", words["one_sided" if facade.one_sided else "two_sided"], ""),
        ("fact_restitution", ratio, given),
        ("fact_free", words["free" if facade.free else "bound"], ""),
    ]
    if facade.base_height_m is not None:
        rows.append(("fact_z", metres(facade.base_height_m), ""))
    if facade.elastic_modulus_mpa is not None:
        rows.append(("fact_modulus", words.quantity(facade.elastic_modulus_mpa, "MPa", 4), ""))
    return [{"name": words[key], "words": text, "note": note} for key, text, note in rows]


def _restitution(check: FacadeCheck, words: Language) -> tuple[str, str]:
    """Return the restitution of the impacts, and where it is from."""
    facade = check.facade
    if isinstance(facade.restitution, float):
        return words.number(facade.restitution), ""
    try:
        return words.number(facade.mechanism.block().restitution), words["housner"]
    except InputError:  # too stocky for Housner's: nothing was run
        return "—", words["housner"]


def acting_rows(check: FacadeCheck, words: Language) -> list[Row]:
    """Return a row for each load, mass, tie and thrust."""
    facade = check.facade
    groups: Sequence[tuple[str, Sequence[Any]]] = (
        ("kind_load", facade.loads),
        ("kind_mass", facade.masses),
        ("kind_tie", facade.ties),
        ("kind_thrust", facade.thrusts),
    )
    return [
        {
            words["col_name"]: named(each.name, "quarter"),
            words["col_kind"]: words[kind],
            f"{words['col_force']} [kN]": figure(
                words.number(getattr(each, "weight_kn", None) or each.force_kn)
            ),
            "x [m]": figure(words.number(getattr(each, "x_m", None), LENGTH_DIGITS)),
            "z [m]": figure(words.number(each.z_m, LENGTH_DIGITS)),
            words["col_end"]: indexed(_end_of(each, facade, words)),
        }
        for kind, group in groups
        for each in group
    ]


def _end_of(action: Any, facade: Facade, words: Language) -> str:
    """Return whether d0 counts an action, or the displacement at which it ends."""
    if not any(action is each for each in facade.ending):
        return words["end_counts"]
    if action.lost_at_m is None:
        return words["end_not"]
    return words("end_at", place=length(action.lost_at_m, words))


def mechanism_rows(check: FacadeCheck, words: Language) -> list[Row]:
    """Return symbol, meaning, value and formula of each number of the mechanism."""
    mechanism = check.mechanism
    angle = words.marked(number(math.degrees(mechanism.theta0_rad)))
    block = words["equivalent"]
    name, linear = typeset(mechanism.linear_name), words.quantity(mechanism.linear_g, "g")
    rows = [
        ("α₀", "m_alpha0", words.number(mechanism.alpha0), "C8.7.1.1 †"),
        ("α₀ g", "m_uplift", words.quantity(mechanism.uplift_g, "g"), "C8.7.1.1 †"),
        ("e*", "m_e_star", words.number(mechanism.e_star), "C8.7.1.5 †"),
        ("e*", "m_e_lumped", words.number(mechanism.e_star_lumped), "C8.7.1.5 †"),
        ("M*", "m_mass", words.quantity(mechanism.mass_kg, "kg", 4), "e* †"),
        ("FC", "m_fc", words.number(mechanism.confidence_factor), "C8.5.IV †"),
        ("a₀", "m_a0", words.quantity(mechanism.a0_g, "g"), "C8.7.1.3 †"),
        ("a₀", "m_a0_lumped", words.quantity(mechanism.a0_lumped_g, "g"), "C8.7.1.3 †"),
        (name, "m_linear", linear, f"C8.7.1.{9 if mechanism.free else 8} †"),
        ("z_d", "m_arm", length(mechanism.arm_m, words), "C8.7.1.2.1 †"),
        ("d₀", "m_d0", length(mechanism.d0_m, words), "C8.7.1.2.1 †"),
        ("d_SLV", "m_dslv", length(mechanism.d_slv_m, words), "C8.7.1.2.1 †"),
        ("d_SLC", "m_dslc", length(mechanism.d_slc_m, words), "C8.7.1.2.1 †"),
        ("T_SLV", "m_tslv", words.quantity(mechanism.t_slv_s, "s"), "C8.7.1.10 †"),
        ("T_SLC", "m_tslc", words.quantity(mechanism.t_slc_s, "s"), "C8.7.1.11 †"),
        ("θ₀", "m_theta0", f"{angle}°", block),
        ("p", "m_p", words.quantity(mechanism.p_rad_s, "rad/s"), block),
        ("λ", "m_lambda", words.number(mechanism.base_factor), block),
        ("tan θ₀/λ", "m_run", words.quantity(mechanism.run_activation_g, "g"), block),
    ]
    if mechanism.elastic_period_s is not None:
        rows.append(("T₀", "m_t0", words.quantity(mechanism.elastic_period_s, "s"), "C8.7.1.9 †"))
    return [
        {
            words["col_symbol"]: indexed(symbol),
            words["col_meaning"]: indexed(words[key]),
            words["col_value"]: figure(value),
            words["col_source"]: source,
        }
        for symbol, key, value, source in rows
    ]


def demand_rows(check: FacadeCheck, words: Language) -> list[dict[str, str]]:
    """Return the spectrum of each limit state in words."""
    return [
        {"name": words[state], "words": _spectrum_words(spectrum, words), "note": ""}
        for state in ("SLD", "SLV", "SLC")
        if (spectrum := check.demand.of(state)) is not None
    ]


def _spectrum_words(spectrum: Any, words: Language) -> str:
    """Return what a spectrum is made of."""
    if isinstance(spectrum, ElasticSpectrum):
        return words(
            "demand_spectrum",
            ag=words.quantity(spectrum.ag_g, "g"),
            f0=words.number(spectrum.f0, 4),
            tc=words.quantity(spectrum.tc_star_s, "s"),
            s=words.number(spectrum.ss * spectrum.st),
            cc=words.number(spectrum.tc_s / spectrum.tc_star_s),
        )
    if isinstance(spectrum, SpectrumTable):
        return words(
            "demand_table",
            count=len(spectrum.periods_s),
            low=words.quantity(spectrum.periods_s[0], "s"),
            high=words.quantity(spectrum.periods_s[-1], "s"),
            damping=words.joined([words.number(100.0 * each) for each in spectrum.damping]),
        )
    return words("demand_records", count=len(spectrum.records))


def run_rows(runs: FacadeRuns, words: Language) -> list[Row]:
    """Return a row for each record, and one for the mean of the largest displacements."""
    signs = [words[f"sign_{each}"] for each in runs.directions]
    rows: list[Row] = [
        {
            words["col_record"]: named(
                name, "quarter", quiet(words["vertical"] if runs.vertical[place] else None)
            ),
            f"{words['col_pga']} [g]": figure(words.number(float(runs.pga_g[place]))),
            words["col_scale"]: figure(words.number(float(runs.scale[place]))),
            **{sign: _end(runs, (place, k), words) for k, sign in enumerate(signs)},
            words["col_largest"]: figure(indexed(_share(float(runs.share[place].max()), words))),
        }
        for place, name in enumerate(runs.records)
    ]
    if runs.mean_m is not None:
        share = runs.mean_m / runs.facade.mechanism.d0_m
        mean = length(runs.mean_m, words) if math.isfinite(share) else ""
        rows.append(
            dict.fromkeys(rows[0])
            | {
                words["col_record"]: Cell(words["mean_row"], "quarter name"),
                words["col_largest"]: figure(indexed(_share(share, words)) + under(mean)),
            }
        )
    return rows


def _end(runs: FacadeRuns, run: tuple[int, int], words: Language) -> Cell:
    """Return the largest displacement of a run, and how it ended where that is not rest."""
    displacement, status = float(runs.displacement_m[run]), Status(int(runs.status[run]))
    if runs.share[run] == 0.0:
        return figure(indexed(words["still"]))
    text = length(displacement, words) if math.isfinite(displacement) else words["beyond_all"]
    known = words.has(f"status_{status.label}")
    end = words[f"status_{status.label}" if known else "status_undecided"]
    return figure(indexed(text) + under(None if status == Status.AT_REST else end))


def _share(share: float, words: Language) -> str:
    """Return a displacement over d0."""
    return words.number(share) if math.isfinite(share) else words["beyond_all"]


def motion_rows(manifest: Mapping[str, Any], words: Language) -> list[Row]:
    """Return name and hash of each record."""
    return [
        {
            words["col_record"]: named(each["name"], "half"),
            "SHA-256": digest(each["sha256"][:16]),
        }
        for each in manifest["records"]
        if "sha256" in each
    ]
