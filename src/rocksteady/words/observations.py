"""Words of tests, of objects that were tested, and of priors."""

from collections import Counter

from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import angle, plural
from rocksteady.results.result import describes
from rocksteady.risk.observations.object_prior import DEFAULTS, ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import NOISE, Prior
from rocksteady.risk.observations.spread import spread_of


@describes(Observations)
def describe_observations(observations: Observations) -> Description:
    """Return how many tests fell, and a row for each."""
    outcomes = {True: "fell", False: "stood", None: "unknown"}
    rows = [
        {
            "test": test.name,
            "object": test.object,
            "record": test.record.name,
            "outcome": outcomes[test.fell],
            "gain": test.gain,
            "reversed": test.reversed,
            "sigma_ln": test.sigma_ln,
            "group": test.group,
            "session": test.session,
            "peak_rad": test.peak_rad,
            "sigma_rad": test.sigma_rad,
            "vertical": None if test.vertical is None else test.vertical.name,
        }
        for test in observations.tests
    ]
    shown = ("test", "object", "record", "gain", "outcome")
    columns = [Column(key, key, left=key != "gain") for key in shown]
    counts = Counter(outcomes[test.fell] for test in observations.tests)
    words = ", ".join(f"{counts[word]} {word}" for word in outcomes.values() if counts[word])
    records = len({id(test.record) for test in observations.tests})
    facts = [
        Fact("tests", len(observations.tests), "tests"),
        Fact("counts", dict(counts), "outcomes", words),
        Fact("objects", list(observations.objects), "objects"),
        Fact("records", records, "records"),
        Fact("groups", len(set(observations.groups.tolist())), "groups"),
        Fact("sources", dict(observations.sources)),
        Fact("warnings", list(observations.warnings)),
    ]
    return Description(
        headline=f"{plural(len(observations.tests), 'test')} of "
        f"{plural(len(observations.objects), 'object')} on {plural(records, 'record')}: {words}",
        facts=facts,
        tables=[Table("rows", rows, columns, kind=lambda row: str(row["outcome"]))],
        notes=[*observations.warnings, *_defaults_used(observations)],
    )


def _defaults_used(observations: Observations) -> list[str]:
    """Return a sentence on the numbers that are not given of some objects."""
    silent = [
        key for key in DEFAULTS if any(key in p.defaults for p in observations.objects.values())
    ]
    words = "not given, so that calibrate takes priors as wide as geometry allows"
    return [f"{', '.join(silent)}: {words}."] if silent else []


@describes(ObjectPrior)
def describe_object_prior(prior: ObjectPrior) -> Description:
    """Return each number with its spread, and which of them are defaults."""
    rows = [
        {
            "parameter": key,
            "low": spread.low,
            "high": spread.high,
            "mean": spread.mean,
            "sd": spread.sd,
            "from": "default" if key in prior.defaults else "given",
            "spread": str(spread),
        }
        for key, spread in prior.spreads.items()
    ]
    columns = [Column(key, key, left=True) for key in ("parameter", "spread", "from")]
    outline = prior.outline_alpha_rad
    return Description(
        headline=f"{prior.name}: alpha {angle(outline)} by its sizes, "
        f"{plural(len(prior.parameters), 'number')} not exact",
        facts=[
            Fact("name", prior.name, "object"),
            Fact("outline_alpha_rad", outline, "alpha by sizes", angle(outline)),
        ],
        tables=[Table("parameters", rows, columns)],
    )


@describes(Prior)
def describe_prior(prior: Prior) -> Description:
    """Return each spread."""
    spreads = {f"noise.{key}": getattr(prior.noise, key) for key in NOISE}
    spreads |= {f"object.{key}": spread_of(key, value) for key, value in prior.defaults.items()}
    rows = [
        {"parameter": key, "low": spread.low, "high": spread.high, "spread": str(spread)}
        for key, spread in spreads.items()
    ]
    columns = [Column(key, key, left=True) for key in ("parameter", "spread")]
    return Description(
        headline=f"prior: sigma_ln {prior.noise.sigma_ln}, outliers {prior.noise.outliers}",
        tables=[Table("parameters", rows, columns)],
    )
