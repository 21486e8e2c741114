"""`rocksteady certify`: proofs in ball arithmetic, their certificates, and the check of these."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_args

import typer

from rocksteady.cli.console.outputs import NEGATIVE, announce_file
from rocksteady.cli.console.refusals import FlagError, missing, needs, refuse, require
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
)
from rocksteady.cli.flags.groups import OutputFlags, check_ending, grouped
from rocksteady.cli.flags.parsing import number
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.results.description import MOST_FACTS, Column, Description, Table, left_out, line
from rocksteady.results.numbers import plural
from rocksteady.show.export.files import check_apart, check_writable, save_text
from rocksteady.small_files import content_of

if TYPE_CHECKING:
    from rocksteady.certify.proofs.certificate import Certificate

HELP = (
    "Prove an answer in ball arithmetic, and check certificates.\n\n"
    "WHAT is orbit: the periodic motions at a point exist, are stable or not; point: their folds, "
    "symmetry breakings and period doublings over -A LOW:HIGH; fate: a block at rest falls or "
    "stands under a pulse or a record; region: the symmetric motion over -A LOW:HIGH and -W "
    "LOW:HIGH; chaos: every sequence of flights is a motion.\n\n"
    "Proofs are of the linear model (--model linear beside a block of known slenderness) and of "
    "blocks whose sides are alike. Needs the extra proof "
    "(python-flint). --out writes a certificate, which --check, or the program of --print-checker "
    "by itself, proves again. Exit code 3 where a proof is undecided; of --check 0 holds or "
    "sampled, 1 refused, 3 undecided."
)
MAIN = "what amplitude frequency_ratio restitution order kind pulse record out check"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady certify orbit -A 2 -W 2 -r 0.8\n\n"
    "rocksteady certify orbit -A 2 -W 2 -r 0.8 --number 1 --out one.json\n\n"
    "rocksteady certify point -A 1:2.7 -W 2 -r 0.8\n\n"
    "rocksteady certify fate --pulse one-sine -A 2 -W 2 -r 0.9\n\n"
    "rocksteady certify region -A 0.3:6 -W 1:8 -r 0.8 --plot region.png\n\n"
    "rocksteady certify chaos -A 2.698 -W 2 -r 0.8 --kind homoclinic\n\n"
    "rocksteady certify --check one.json"
)
DOUBLINGS = 4
"""Of the cascade that is proved with the points: to 32 impacts."""
PLACES = 9
"""Decimals of A in which points of one number of impacts differ."""
KINDS = {
    "orbit": "-A 2 -W 2 -r 0.8",
    "point": "-A 1:2.7 -W 2 -r 0.8",
    "fate": "--pulse one-sine -A 2 -W 2 -r 0.9",
    "region": "-A 0.3:6 -W 1:8 -r 0.8",
    "chaos": "-A 2.698 -W 2 -r 0.8",
}
"""Each proof with an example."""
proof_flag = options.Panel("Proof")


@grouped
def certify(
    shaking: ShakingFlags,
    block: BlockFlags,
    pulse: PulseFlags,
    recorded: RecordFlags,
    reading: ReadingFlags,
    model: str | None = options.model(),
    what: Annotated[
        str | None, typer.Argument(metavar="WHAT", help="Prove this: " + ", ".join(KINDS) + ".")
    ] = None,
    order: int = options.order(),
    which: int | None = proof_flag(
        "--number K", "Prove this one of the motions or points alone, as they are numbered."
    ),
    kind: str = proof_flag(
        "--kind NAME",
        "Prove chaos near the hilltops (hilltop, default) or of flights of one half period along "
        "a homoclinic motion (homoclinic).",
        default="hilltop",
    ),
    out: Path | None = proof_flag("--out FILE", "Write the certificate: .json."),
    plot: Path | None = options.output_flag(
        "--plot FILE", "Save the picture of a region: .png, .svg or .pdf."
    ),
    force: bool = options.force(),
    check: Path | None = proof_flag("--check FILE", "Check the certificate in this file."),
    samples: Path | None = proof_flag(
        "--samples FILE", "Read the samples of a record for --check, one in m/s^2 a line."
    ),
    leaves: str | None = proof_flag(
        "--leaves N",
        "Set how many boxes of a region --check samples, the largest and random ones, or all; "
        "default 1000.",
    ),
    arithmetic: str = proof_flag(
        "--arithmetic NAME",
        "Check in balls of python-flint (arb, default) or intervals of mpmath (iv).",
        default="arb",
    ),
    print_checker: bool = proof_flag(
        "--print-checker",
        "Print the program that checks certificates of WHAT alone; default orbit and chaos.",
        default=False,
    ),
    as_json: bool = options.as_json(),
    more: bool = options.more(),
    quiet: bool = options.quiet(),
) -> int:
    """Run `rocksteady certify`; `HELP` is what its users read."""
    if what is not None and what not in KINDS:
        raise InputError("WHAT", what, "there is no such proof", "give " + ", ".join(KINDS))
    if print_checker:
        refuse({"--json": as_json}, "the checker is a program, and no object", "leave one out")
        from rocksteady.certify.proofs.files import program

        print(program(what or "chaos"), end="")
        return 0
    output = OutputFlags(as_json=as_json, more=more, quiet=quiet, plot=plot, force=force)
    if what != "region":
        refuse({"--plot": plot}, "a picture is one of a region")
    output.check()
    written = _written(out, samples=what == "fate" and bool(recorded.files))
    read = [*recorded.files, *(file for file in (check, samples) if file is not None)]
    check_apart({**output.files, **written}, read=read)
    needs("--samples", samples, "--check", "fate.json", beside=check)
    needs("--leaves", leaves, "--check", "region.json", beside=check)
    if check is not None:
        refuse({"WHAT": what, "--out": out}, "--check reads a certificate alone")
        return _check(output, check, samples, leaves, arithmetic)
    if what is None:
        raise missing("WHAT", valid="what is proved is needed", hint="give " + ", ".join(KINDS))
    check_ending("--out", out, ".json")
    for file in written.values():
        check_writable("--out", file, force=force)
    of_record = what == "fate" and recorded.given(reading, pulse=pulse.given, on_floor=pulse.given)
    moved = of_record or pulse.given or shaking.given
    require(f"certify {what}", {"block": block.given, "motion": moved}, KINDS[what])
    if what == "fate":
        body = recorded.block(block) if of_record else block.described()
        equations = _provable(block, body, model)
        certificates = [_fate(body, shaking, pulse, recorded, reading, equations)]
    else:
        idle = {"--record": next(iter(recorded.record or ()), None), **reading.given}
        refuse(idle, f"a proof of {what} is of lasting shaking", "leave it out, or prove a fate")
        body = block.described()
        _provable(block, body, model)
        if what == "region":
            return _region(output, body, shaking, order, out)
        proofs = _proofs(what, body, shaking, kind)
        certificates = [prove() for prove in _chosen(proofs, which, out)]
    _save(certificates, out)
    _leave(output, what, certificates, out)
    return 0


def _provable(block: BlockFlags, body: Block | DimensionlessBlock, model: str | None) -> Any:
    """Return the equations of a proof, after refusing a block that none is written for."""
    from rocksteady.certify.proofs.certificate import check_model

    equations = equations_for(model, body)
    try:
        check_model(body, equations)
    except ModelError as error:
        if error.name != "block":
            raise
        raise block.refuse_sides(error.valid, error.hint) from None
    return equations


def _written(out: Path | None, *, samples: bool) -> dict[str, Path]:
    """Return the files that are written: a certificate, and the samples of a record beside it."""
    if out is None:
        return {}
    return {"--out": out} | ({"samples beside --out": out.with_suffix(".txt")} if samples else {})


def _check(
    output: OutputFlags, file: Path, samples: Path | None, leaves: str | None, arithmetic: Any
) -> int:
    """Check a certificate's file, and return the exit code."""
    from rocksteady.certify.proofs.files import HOLDS, SAMPLED, check_certificate
    from rocksteady.certify.proofs.region import Arithmetic

    if arithmetic not in (known := get_args(Arithmetic)):
        raise FlagError(
            "--arithmetic", arithmetic, "there is no such one", f"give {' or '.join(known)}"
        )
    numbers: list[float] = []
    if samples is not None:
        content = content_of(samples, "--samples", "give samples in m/s^2")
        try:
            numbers = [float(word) for word in content.decode().split()]
        except ValueError:
            raise InputError(
                "--samples", samples, "it must hold one number a line", "give samples in m/s^2"
            ) from None
    count = None if leaves == "all" else int(number("--leaves", leaves or "1000"))
    result = check_certificate(
        file, accelerations_m_s2=numbers, leaves=count, arithmetic=arithmetic
    )
    further = f"rocksteady certify --check {quoted(file)} --leaves all"
    output.leave(
        "certify",
        result.describe(),
        decided=result.verdict != "undecided",
        follow_up=further if result.verdict == SAMPLED else "",
    )
    return 0 if result.verdict in (HOLDS, SAMPLED) else NEGATIVE


def _ends(flag: str, text: str | None) -> tuple[float, float]:
    """Return both ends of a range LOW:HIGH."""
    parts = (text or "").split(":")
    if len(parts) != 2:
        raise FlagError(flag, text, "a range LOW:HIGH is needed", "give it as 0.3:6")
    return number(flag, parts[0]), number(flag, parts[1])


def _fate(
    body: Block | DimensionlessBlock,
    shaking: ShakingFlags,
    pulse: PulseFlags,
    recorded: RecordFlags,
    reading: ReadingFlags,
    model: Any,
) -> "Certificate":
    """Return the certificate of a run under a pulse or a record."""
    from rocksteady.certify.proofs.fate import certify_fate

    refuse({"--vertical": recorded.vertical}, "proofs lack vertical motion")
    if recorded.record:
        record = recorded.scaled(recorded.recording(reading).record)
        return certify_fate(body, record, model=model)
    if not pulse.given:
        raise missing("--pulse", valid="a pulse or a record is needed", hint="add --pulse one-sine")
    motion = pulse.of(shaking.at(body), phase=None, reverse=recorded.reverse)
    return certify_fate(body, reading.on_floor(motion, body), model=model)


def _proofs(
    what: str, body: Block | DimensionlessBlock, shaking: ShakingFlags, kind: str
) -> "Sequence[Callable[[], Certificate]]":
    """Return what proves each of the orbits or points, or chaos."""
    if what == "chaos":
        from rocksteady.certify.proofs.chaos import certify_chaos

        if ":" in f"{shaking.amplitude}{shaking.frequency_ratio}":
            ranges = (
                _ends("--amplitude/-A", shaking.amplitude),
                _ends("--frequency-ratio/-W", shaking.frequency_ratio),
            )
            return [partial(certify_chaos, *ranges, body.restitution, kind=kind)]  # type: ignore[arg-type]
        motion = shaking.at(body)
        numbers = motion.amplitude, motion.frequency_ratio, body.restitution
        return [partial(certify_chaos, *numbers, kind=kind)]  # type: ignore[arg-type]
    if what == "orbit":
        from rocksteady.certify.proofs.orbit import certify_orbit
        from rocksteady.dynamics.orbits.search import find_orbits

        orbits = find_orbits(body, shaking.at(body), model="linear")
        return [partial(certify_orbit, orbit) for orbit in orbits if not orbit.rest_phases]
    from rocksteady.certify.proofs.point import SIGNS, certify_point
    from rocksteady.dynamics.continuation.branches import BranchOptions
    from rocksteady.dynamics.continuation.find_bifurcations import find_bifurcations

    within = _ends("--amplitude/-A", shaking.amplitude)
    motion = replace(shaking, amplitude=str(within[1])).at(body)
    search = BranchOptions(doublings=DOUBLINGS)
    diagram = find_bifurcations(
        body, motion, "amplitude", within=within, values=0, search=search, model="linear"
    )
    points = [each.point for each in diagram.points if each.point.type in SIGNS]
    known = {(each.impacts, round(each.amplitude, PLACES)) for each in points}
    further = () if diagram.cascade is None else diagram.cascade.points
    points += [
        each for each in further if (each.impacts, round(each.amplitude, PLACES)) not in known
    ]
    return [partial(certify_point, point) for point in points]


def _chosen(
    proofs: "Sequence[Callable[[], Certificate]]", which: int | None, out: Path | None
) -> "Sequence[Callable[[], Certificate]]":
    """Return the proof of a number, or all: one where a file is written."""
    if which is not None:
        if not 1 <= which <= len(proofs):
            valid = f"there are {len(proofs)} of them"
            raise InputError("--number", which, valid, "take a number of the list")
        return [proofs[which - 1]]
    if out is not None and len(proofs) != 1:
        valid = f"a file holds one certificate, and there are {len(proofs)}"
        raise FlagError("--out", out, valid, "choose one with --number")
    return proofs


def _region(
    output: OutputFlags,
    body: Block | DimensionlessBlock,
    shaking: ShakingFlags,
    order: int,
    out: Path | None,
) -> int:
    """Prove a region, write it and print it."""
    from rocksteady.certify.proofs.region import BITS, certify_region

    ranges = (
        _ends("--amplitude/-A", shaking.amplitude),
        _ends("--frequency-ratio/-W", shaking.frequency_ratio),
    )
    region = certify_region(*ranges, body.restitution, order=order)
    if out is not None:
        _write(out, region.to_json())
    from rocksteady.certify.plots import plot_proved_region

    title = region.describe().headline.capitalize()
    output.write_plot(lambda page: page.panel(8.0, 4.6, title, plot_proved_region, region))
    further = "" if out is None else f"rocksteady certify --check {quoted(out)}"
    description = region.describe()
    after = {"proved": region.decided > 0.0, "claim": description.headline, "bits": BITS}
    after["model"] = "linear"
    after["file"] = None if out is None else str(out)
    output.leave("certify", description, after=after, follow_up=further)
    return 0


def _save(certificates: "Sequence[Certificate]", out: Path | None) -> None:
    """Write a certificate, and the samples of a record beside it."""
    if out is None:
        return
    if certificates[0].proved:
        _write(out, certificates[0].to_json())
        *_, beside = _written(out, samples=True).values()
        if certificates[0].samples:
            _write(beside, "".join(f"{x!r}\n" for x in certificates[0].samples))


def _write(file: Path, text: str) -> None:
    """Write a file whole."""
    save_text("--out", file, text)
    announce_file(file)


def _leave(
    output: OutputFlags, what: str, certificates: "Sequence[Certificate]", out: Path | None
) -> None:
    """Print one certificate, or a list of them."""
    proved = sum(each.proved for each in certificates)
    decided = all(each.verdict != "undecided" for each in certificates)
    after: dict[str, Any] = {"model": "linear", "file": None if out is None else str(out)}
    if len(certificates) == 1:
        further = ""
        if out is not None and certificates[0].proved:
            text = f" --samples {quoted(out.with_suffix('.txt'))}" * bool(certificates[0].samples)
            further = f"rocksteady certify --check {quoted(out)}{text}"
        description = certificates[0].describe()
        output.leave("certify", description, after=after, decided=decided, follow_up=further)
        return
    rows = [
        {"number": n, "verdict": each.verdict, "claim": each.claim, "reason": each.reason}
        for n, each in enumerate(certificates, 1)
    ]
    sentence = f"Proved {proved} of {plural(len(rows), what)}, by the linear equations"
    if not rows:
        sentence = f"There is no {what} to be proved here"
    shown = [
        line(f"{n}", f"{each.verdict}: {_short(each)}")
        for n, each in enumerate(certificates[:MOST_FACTS], 1)
    ]
    if len(rows) > MOST_FACTS:
        shown[-1] = left_out(len(rows) - MOST_FACTS + 1)
    columns = [Column(key, key, left=True) for key in ("number", "verdict", "claim", "reason")]
    output.leave(
        "certify",
        Description(
            sentence,
            shown,
            tables=[Table("certificates", rows, columns)],
            sentence=sentence,
        ),
        values={"proved": 0 < proved == len(rows), "claim": sentence, "certificates": rows},
        after=after,
        decided=decided,
        wrap=True,
    )


def _short(certificate: "Certificate") -> str:
    """Return a claim without its parameters, with the amplitude that it encloses."""
    words = certificate.claim.partition(": ")[0].partition(" of the ")[0].removeprefix("one ")
    amplitude = certificate.content.get("amplitude")
    return words if amplitude is None else f"A = {str(amplitude)[:12]}, {words}"
