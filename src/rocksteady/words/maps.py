"""Words of maps of attractors and of fates, from their attributes and cells."""

import math
from typing import TYPE_CHECKING

from rocksteady.dynamics.maps.cell_classes import map_counts
from rocksteady.dynamics.parameters import AXES
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.blocks.housner_forms import ratio_words
from rocksteady.outcomes import AttractorKind, motion_verb
from rocksteady.results.description import Description, Fact, line
from rocksteady.results.numbers import angle, length, number, plural, quantity, share
from rocksteady.sweep.cases.facts import cell_count, count_table, grid_facts

if TYPE_CHECKING:
    from rocksteady.sweep.cases.cells import Labelled


WORDS = {"alpha": angle, "radius": length, "width": length, "height": length}
"""How engineers write a parameter."""
UNITS = {"p": "rad/s", "phase": "rad", "frequency_hz": "Hz", "gravity": "m/s²"}
LABELS = {"acceleration_m_s2": "peak acceleration", "frequency_hz": "frequency"}
SHORT = {
    "amplitude": ("A", ""),
    "frequency_ratio": ("W", ""),
    "acceleration_m_s2": ("", " g"),
    "frequency_hz": ("", " Hz"),
    "width": ("width", " m"),
    "height": ("height", " m"),
    "radius": ("R", " m"),
    "alpha": ("alpha", " rad"),
}
"""Symbols and units of axes."""
ROCKING = ("rocking", "symmetric", "unsymmetric", "subharmonic", "aperiodic")
"""Classes of cells that rock on."""
MOTIONS = {
    "symmetric": motion_verb(AttractorKind.SYMMETRIC, 1).removeprefix("rocks "),
    "unsymmetric": AttractorKind.UNSYMMETRIC.plain.removeprefix("rocks, "),
    "subharmonic": "alike every n-th shake",
    "aperiodic": AttractorKind.APERIODIC.plain,
}
"""What such a cell does, after "rocks"."""
FEW = 1e-3
"""Share of undecided cells that is no failure."""
START = ("start", "branch", "order", "side", "kick", "angle", "velocity")


def describe_map(dataset: "Labelled") -> Description:
    """Return the cells of each class of a map, its grid, and what is no axis."""
    fates = "fate" in dataset
    name = "fate" if fates else "kind"
    counts, longer = map_counts(dataset)
    cells = cell_count(dataset)
    cycles, floor = _cycles(dataset), dataset.attrs.get("floor")
    facts = [
        *grid_facts(dataset),
        Fact("fate", fates),
        Fact("cycles", cycles, "followed for", f"{cycles} periods at most"),
        Fact("model", _model(dataset), "model"),
        Fact("floor", floor, "stands on" if floor else ""),
        *_parameters(dataset),
        Fact("counts", counts),
        Fact("shares", {word: count / cells for word, count in counts.items()}),
    ]
    notes = []
    if longer:
        facts.append(Fact("subharmonic_counts", longer))
        parts = ", ".join(f"{count:,} {kind}" for kind, count in longer.items())
        notes.append(f"subharmonic: of period 2 or longer, {parts}")
    table = count_table(counts, cells=cells, heading=name)
    sentence, screen = _answer(dataset, counts, cells)
    return Description(headline(dataset), [*screen, *facts], [table], notes, sentence)


def _answer(dataset: "Labelled", counts: "dict[str, int]", cells: int) -> tuple[str, list[Fact]]:
    """Return in which share of a map the block falls, rocks and comes to rest."""
    given = dataset.attrs
    falls, rests = counts["overturned"], counts.get("rest", 0) + counts.get("at-rest", 0)
    moving = {word: counts.get(word, 0) for word in ROCKING}
    rocks, undecided = sum(moving.values()), counts.get("undecided", 0)
    parts = [
        f"{verb} in {share(count, cells) if count < cells else 'all'} of the map"
        for verb, count in (("falls", falls), ("rocks", rocks), ("comes to rest", rests))
        if count
    ]
    words = " and ".join([", ".join(parts[:-1])] * (len(parts) > 1) + parts[-1:])
    words = words.replace(" of the map", "") + " of the map" if words else "is undecided throughout"
    start = str(given.get("start", "")).replace("state", "") or "its starts"
    if {"angle", "velocity"} <= given.keys():
        start = f"{given['angle']:g},{given['velocity']:g}"
    one_body = ", as one body" * ("parts" in given)
    sentence = f"from {start} it {words}{one_body}."
    late = undecided > FEW * cells
    sentence = f"Undecided in {share(undecided, cells)}; {sentence}" if late else sentence
    kinds = [
        f"{MOTIONS[word]} {share(count, cells)}"
        for word, count in moving.items()
        if count and word in MOTIONS
    ]
    restitution = f"{ratio_words(given['restitution'])}, " if "restitution" in given else ""
    model = f"{_model(dataset)}; {restitution}{_cycles(dataset):,} periods at most"
    missing = [
        f"{plural(counts.get(word, 0), 'cell')} {text}"
        for word, text in (
            ("undecided", "undecided, which count as no falls"),
            ("no-start", "without such a start"),
            ("not-computed", "not computed"),
        )
        if counts.get(word)
    ]
    return (
        sentence[0].upper() + sentence[1:],
        [
            line("falls", f"{falls:,} of {plural(cells, 'cell')} ({_axes(dataset)})"),
            line("rocks", ", ".join(kinds)),
            line("left out", "; ".join(missing)),
            line("stands on", str(given.get("floor", ""))),
            line("computed", model),
        ],
    )


def _axes(dataset: "Labelled") -> str:
    """Return the axes of a map and their ends."""
    words = []
    for name, size in dataset.sizes.items():
        ends = [float(dataset[str(name)].values[at]) for at in (0, -1)] if size else []
        symbol, unit = SHORT.get(str(name), (str(name).replace("_", " "), ""))
        if name == "acceleration_m_s2":
            ends, unit = [in_g(end) for end in ends], " g"
        unit = unit or (f" {UNITS[str(name)]}" if name in UNITS else "")
        words.append(f"{symbol} {' to '.join(map(number, ends))}{unit}".strip())
    return ", ".join(words)


def headline(dataset: "Labelled") -> str:
    """Return what is no axis in a few words."""
    given = dataset.attrs
    parts = []
    if "amplitude" in given:
        parts.append(f"A = {given['amplitude']:g}")
    elif "acceleration_m_s2" in given:
        parts.append(_text("acceleration_m_s2", given["acceleration_m_s2"]))
    if "frequency_ratio" in given:
        parts.append(f"Ω = {given['frequency_ratio']:g}")
    elif "frequency_hz" in given:
        parts.append(_text("frequency_hz", given["frequency_hz"]))
    restitution = given.get("restitution")
    if restitution is not None:
        negative = given.get("negative_restitution")
        parts.append(ratio_words(restitution) + (f"/{negative:.4g}" if negative else ""))
    if _against_wall(dataset):
        parts.append("against a wall")
    parts += [
        f"{symbol} = {_text(name, given[name])}"
        for name, symbol in (("alpha", "α"), ("p", "p"))
        if name in given
    ]
    if given.get("start") in ("rest", "steady"):
        parts.append(f"from {given['start']}")
    elif {"angle", "velocity"} <= given.keys():
        parts.append(f"from {given['angle']:g},{given['velocity']:g}")
    if given.get("phase"):
        parts.append(f"phase {given['phase']:.4g} rad")
    parts += [given["floor"]] if "floor" in given else []
    parts.append(f"{_model(dataset)} model")
    fates = "fate" in dataset
    what = f"The block after {_cycles(dataset)} periods" if fates else "What the block settles to"
    return f"{what}: " + ", ".join(parts)


def _cycles(dataset: "Labelled") -> int | None:
    """Return for how many forcing periods the motions were followed."""
    cycles = dataset.attrs.get("cycles", dataset.attrs.get("max_cycles"))
    return None if cycles is None else int(cycles)


def _model(dataset: "Labelled") -> str:
    """Return the name of the equations of motion."""
    return str(dataset.attrs["model"])


def _parameters(dataset: "Labelled") -> list[Fact]:
    """Return the parameters that are no axes."""
    names = [*reversed(list(AXES)), "gravity", "negative_restitution", *START]
    given = {name: dataset.attrs[name] for name in dict.fromkeys(names) if name in dataset.attrs}
    wall = [Fact("one_sided", True, "stands", "against a wall")] if _against_wall(dataset) else []
    return wall + [
        Fact(name, value, LABELS.get(name, name.replace("_", " ")), _text(name, value))
        for name, value in given.items()
    ]


def _against_wall(dataset: "Labelled") -> bool:
    """Return whether the block stands against a wall."""
    return bool(dataset.attrs.get("one_sided", 0))


def _text(name: str, value: object) -> str:
    """Return the value of a parameter as engineers write it."""
    if not isinstance(value, int | float):
        return str(value)
    if name == "acceleration_m_s2":
        return quantity(in_g(value), "g")
    if name in WORDS and math.isfinite(value):
        return WORDS[name](value)
    if name in UNITS:
        return quantity(value, UNITS[name])
    return number(value) if isinstance(value, float) else str(value)
