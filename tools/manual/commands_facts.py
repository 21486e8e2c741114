"""What the program does not hold about its commands: where they are explained, and valid values."""

import re

from rocksteady.model.blocks.examples import SOURCES
from rocksteady.records.read import FORMATS
from rocksteady.show.style.legends import PLACES

GUIDES = {
    "explore": ("guides/explorer.md",),
    "steady": ("theory/steady.md",),
    "simulate": ("guides/records.md", "guides/pulses.md", "theory/march.md"),
    "attractor": ("theory/orbits.md",),
    "orbits": ("theory/orbits.md", "theory/periodic.md"),
    "bifurcate": ("theory/continuation.md",),
    "certify": ("theory/proofs.md",),
    "curves": ("theory/codimension-two.md",),
    "basins": ("theory/basins.md", "theory/basin-measures.md"),
    "edge": ("theory/edges.md",),
    "map": ("guides/sweeps.md",),
    "overturn": ("guides/overturning.md",),
    "record": ("guides/records.md", "guides/measures.md"),
    "spectrum": ("guides/spectra.md",),
    "fragility": ("guides/fragility.md",),
    "assess": ("guides/objects.md", "guides/hazard.md"),
    "facade": ("guides/facades.md",),
    "screens": ("guides/screens.md",),
    "calibrate": ("guides/calibration.md",),
    "predict": ("guides/calibration.md",),
    "back-analyse": ("guides/back-analysis.md",),
    "restitution": ("guides/restitution.md",),
    "paper": ("theory/literature.md",),
    "study-atlas": ("theory/steady.md", "guides/sweeps.md"),
    "study-chaos": ("theory/proofs.md", "how-to/prove.md"),
}
"""Pages that explain the subject of a command, below `docs`."""

FILES = {
    "simulate": ("motions",),
    "map": ("stores",),
    "basins": ("stores",),
    "record": ("motions",),
    "spectrum": ("motions", "stores"),
    "overturn": ("motions",),
    "fragility": ("motions", "stores", "results"),
    "assess": ("object", "hazard", "results"),
    "facade": ("facade", "results"),
    "screens": ("facade",),
    "calibrate": ("observations",),
    "predict": ("observations",),
    "back-analyse": ("observations",),
    "restitution": ("observations",),
    "paper": ("results",),
    "study-atlas": ("results",),
    "study-chaos": ("results",),
}
"""Pages on the files that a command reads and writes, in `docs/reference/files`."""

HOW_TO = {
    "explore": ("explorer-for-a-class",),
    "steady": ("steady-states",),
    "simulate": ("does-it-fall", "film", "choose-a-model"),
    "attractor": ("coexisting-motions",),
    "orbits": ("coexisting-motions",),
    "bifurcate": ("follow-a-branch",),
    "certify": ("prove",),
    "curves": ("bifurcation-curves",),
    "basins": ("basins",),
    "edge": ("least-fatal-kick",),
    "map": ("map-two-parameters", "resume-a-map", "run-on-a-cluster"),
    "overturn": ("overturning-spectrum", "overturning-scales"),
    "record": ("read-a-record",),
    "fragility": ("fragility-with-vertical-motion",),
    "assess": ("design-spectrum", "annual-risk", "pelicun-and-openquake"),
    "facade": ("check-a-facade",),
    "calibrate": ("calibrate",),
    "back-analyse": ("back-analysis",),
    "restitution": ("restitution-from-a-test",),
    "doctor": ("install-offline",),
}
"""Pages of `docs/how-to` that use a command; one that is not there is not linked."""

PYTHON = {
    "explore": ("write_explorer",),
    "steady": ("find_steady_states", "compute_response_curve"),
    "simulate": ("simulate", "check_neighbours"),
    "attractor": ("find_attractor",),
    "orbits": ("find_orbits",),
    "bifurcate": ("find_bifurcations",),
    "certify": (
        "certify_orbit",
        "certify_point",
        "certify_fate",
        "certify_region",
        "certify_chaos",
        "check_certificate",
    ),
    "curves": ("find_bifurcation_curves",),
    "basins": (
        "compute_basins",
        "compute_basin_shares",
        "compute_erosion",
        "compute_fate_basins",
        "compute_basin_entropy",
        "compute_uncertainty_exponent",
    ),
    "edge": ("find_edge_state", "compute_manifold"),
    "map": ("map_attractors", "map_fates"),
    "overturn": ("find_overturning_windows", "find_overturning_scales", "find_fatal_kicks"),
    "record": ("read_recordings", "compute_measures", "compute_response_spectrum"),
    "spectrum": ("compute_rocking_spectrum", "compute_suite_spectrum"),
    "fragility": ("compute_fragility", "run_ensemble", "count_fragility"),
    "assess": (
        "assess_object",
        "assess_objects",
        "place_on_spectrum",
        "read_hazard_curves",
        "assess_by_formula",
        "write_assessment",
    ),
    "facade": ("read_facade", "run_facade", "check_facade", "write_facade"),
    "screens": ("screen_block",),
    "calibrate": ("read_tests", "calibrate", "write_calibration"),
    "predict": ("read_posterior",),
    "back-analyse": ("read_survey", "back_analyse"),
    "restitution": ("read_peaks", "fit_restitution"),
    "doctor": ("check_installation",),
}
"""Public functions that compute what a command prints."""

VALID: dict[str, tuple[str, ...]] = {
    "--block": tuple(SOURCES),
    "--format": FORMATS,
    "--legend": tuple(PLACES),
    "--model": ("linear", "nonlinear"),
    "--tab": ("explore", "basins", "pulse", "quake", "design"),
    "--side": ("+", "-"),
    "--directions": ("both", "recorded", "reversed"),
    "--limit-state": ("SLV", "SLC"),
    "--language": ("en", "it"),
    "--folds": ("record", "test", "session", "group"),
}
"""Valid values of flags that take one name of a list; tests compare them with the program."""

INTERVAL = re.compile(r"\bin ([\[(][\w.]+, [\w.]+[\])])")
"""An interval of valid values in a help text."""

DEFAULT = re.compile(
    r"\b[Dd]efault:? (?P<value>[\w.:+/^,-]*[\w+])(?=;|\.$|\. |\)|, or an axis|, or that of FILE|$)"
)
AFTER = re.compile(r"(?:^|[:,] )(?P<value>'?[\w.+-]+'?) \(default\)")


def default_in(help_text: str) -> str:
    """Return the default that a help text names, or nothing."""
    plain = help_text.replace("\\[", "[")
    found = AFTER.search(plain) or DEFAULT.search(plain)
    return found["value"].strip() if found else ""
