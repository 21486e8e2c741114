"""`rocksteady assess`: from an object to an answer."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rocksteady.cli.console.outputs import INCOMPLETE, announce_file, report_command
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import (
    FlagError,
    both,
    flags_of,
    missing,
    needs,
    refuse,
    require,
)
from rocksteady.cli.console.shell import command_of
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import (
    DesignFlags,
    PeakFlags,
    RowFlags,
    demand_flag,
    described_block,
    share,
)
from rocksteady.cli.flags.ensemble import Suite, SuiteFlags, ensemble_flag
from rocksteady.cli.flags.groups import grouped
from rocksteady.cli.flags.record_files import FLOOR_FLAGS, ReadingFlags
from rocksteady.cli.flags.sweep import RunsFlags
from rocksteady.errors import InputError
from rocksteady.show.export.folders import ASSESSMENT

if TYPE_CHECKING:
    from rocksteady.results.description import Description
    from rocksteady.risk.assess.assessment import Assessment
    from rocksteady.risk.assess.described.building import Building
    from rocksteady.risk.assess.described.objects import DescribedObject
    from rocksteady.risk.assess.objects_table import ObjectsTable
    from rocksteady.risk.counted.suite import Demanded
    from rocksteady.risk.counted.suite import Suite as Motions
    from rocksteady.risk.counted.verdict import Target
    from rocksteady.risk.hazard.hazard_curve import HazardCurve
    from rocksteady.sweep.run import Execution

HELP = (
    "Count how often an object falls under a demand.\n\n"
    "Share of the runs in which an object falls, with its 90 % interval, a verdict and the reason."
    "\n\n"
    "FILE is an object in TOML (docs/guides/objects.md), with its demand. A FILE that ends in .csv "
    "is a table of objects, under --pga-g and --pgv-m-s where they state no demand of their own. "
    "Without FILE the object is the block of the flags. --example needs no file.\n\n"
    "Every record of --records is given both peaks of the demand: its accelerations are "
    "multiplied, its time axis is stretched; with --spectrum it is scaled to the PGA and stretched "
    "until its own spectrum lies on the design spectrum. Without records 59 built-in motions are "
    "run, which no earthquake made: no verdict is then green. --hazard adds the annual rate; --out "
    "keeps all in a folder.\n\n"
    "Exit code 3 where there is no answer; with --check 1 where an object is above its target or "
    "slides, and 3 where nothing is shown. A table has the code of its worst row, 1 before 3."
)
MAIN = "file records pga_g pgv_m_s width_m height_m friction target out example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady assess --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4 --friction 0.5\n\n"
    "rocksteady assess --spectrum design.csv --width-m 0.32 --height-m 1.8 --records suite\n\n"
    "rocksteady assess statue.toml --records suite --hazard site.csv\n\n"
    "rocksteady assess objects.csv --pga-g 0.35 --pgv-m-s 0.4 --csv answers.csv"
    "\n\nrocksteady assess --example --out example\n\n"
    "Your files: statue.toml, an object; objects.csv, a table of objects; design.csv, a "
    "spectrum; site.csv, a hazard curve; suite, a folder of records."
)
TRIED = 75
"""Changed objects that a remedy takes, about."""
MEANT = ("--out", "--runs", "--resume", "--workers")
"""Flags that have a meaning beside --example."""
file_flag = options.Panel("Object files")


@dataclass(frozen=True, kw_only=True)
class _Asked:
    """What is assessed, under which motions, and what is kept of it."""

    context: typer.Context
    block: BlockFlags
    peaks: PeakFlags
    designs: DesignFlags
    recorded: SuiteFlags
    reading: ReadingFlags
    kept: RunsFlags
    output: RowFlags
    file: Path | None
    built_in: tuple[int | None, int | None]
    buildings: Path | None
    hazard: Path | None
    out: Path | None
    target: "Target | None"
    stretch: bool
    example: bool
    lognormal: bool

    def objects(self) -> "list[DescribedObject]":
        """Return the objects: of FILE, of the example, or the block of the flags.

        Raises
        ------
        InputError, FlagError
            If a file cannot be read, a flag is not valid, or an object has no demand.
        """
        from rocksteady.risk.assess.described.objects import EXAMPLE, read_object

        if self.file is not None and self.is_table:
            return self._table_of(self.file)
        if self.file is None and not self.example:
            described = described_block(self.block, self.peaks)
        else:
            described = read_object(self.file or EXAMPLE)
        described = self._on_spectrum(described)
        return [described if self.target is None else described.with_target(self.target)]

    def _on_spectrum(self, described: "DescribedObject") -> "DescribedObject":
        """Return an object with the spectrum of --spectrum, where its file states no other demand.

        Raises
        ------
        InputError, FlagError
            If it states one, or the spectrum cannot be read.
        """
        given = described.given.demand
        if self.designs.spectrum is None:
            return described
        if self.file is not None:
            stated = {
                "spectrum": described.spectrum,
                "pga_g": given.pga_g,
                "pgv_m_s": given.pgv_m_s,
            }
            key = next((key for key, value in stated.items() if value is not None), None)
            if key is not None:
                raise FlagError(
                    "--spectrum",
                    self.designs.spectrum,
                    f"{self.file} states its own {key}",
                    "leave one of the two out",
                )
        if given.pgv_m_s is not None:  # both peaks decide
            return replace(described, spectrum=self.designs.table)
        design = self.designs.design(self.peaks.pga_g)
        assert design is not None
        return described.on_spectrum(design)

    def _table_of(self, file: Path) -> "list[DescribedObject]":
        """Return the objects of a table, each with its demand or that of the flags."""
        from rocksteady.risk.assess.described.schema import USUAL
        from rocksteady.risk.assess.described.tables import read_objects
        from rocksteady.risk.assess.placed_objects import with_demand

        objects = read_objects(file)
        stated = all(each.demand.pga_g or each.demand.pgv_m_s for each in objects)
        demand = self.demand
        if stated:
            flags = {"--spectrum": self.designs.spectrum}
            refuse(flags, f"all objects of {file} state a demand of their own")
        if demand is None and not stated:
            raise missing(
                "--pgv-m-s",
                valid="objects that state no peak of their own are assessed under one demand",
                hint="add --pga-g 0.35 and --pgv-m-s 0.4, or --spectrum design.csv",
            )
        asked = [with_demand(each, demand) for each in objects]
        target = USUAL if self.target is None else self.target
        return [each.with_target(target) for each in asked]

    @cached_property
    def demand(self) -> "Demanded | None":
        """The demand of objects that state none: a spectrum or peaks; None without.

        Raises
        ------
        InputError, FlagError
            If one is not valid, or both are given.
        """
        if self.designs.spectrum is not None and self.peaks.pgv_m_s is not None:
            raise both("--spectrum", "--pgv-m-s", valid="both peaks decide where they are given")
        return self.designs.design(self.peaks.pga_g) or self.peaks.demand

    @property
    def is_table(self) -> bool:
        """Whether FILE is a table of objects."""
        return self.file is not None and self.file.suffix.lower() == ".csv"

    def suite(self, objects: "Sequence[DescribedObject]") -> Suite:
        """Return the records; none where built-in motions stand in for them.

        Raises
        ------
        InputError, FlagError
            If no record can be read, or there is none and an object states one peak alone.
        """
        recorded, named = self.recorded, objects[0].given.assessment.records
        if recorded.records is None and named is not None and self.file is not None:
            recorded = replace(recorded, records=[self.file.parent / named])
        if recorded.records:
            built_in = dict(zip(("--motions", "--seed"), self.built_in, strict=True))
            refuse(built_in, "there are records, and built-in motions stand in for them")
        on_spectrum = any(each.is_on_spectrum for each in objects)
        refuse(
            {"--no-stretch": (on_spectrum and not self.stretch) or None},
            "objects on a spectrum get their motions by a stretch",
        )
        if self.reading.floor is not None:
            felt = {each.name for each in objects if each.given.demand.place == "floor"}
            refuse(
                {"--floor-hz": self.reading.floor_hz if felt else None},
                f"the demand of {next(iter(felt), '')} is that of the floor itself",
                "leave it out",
            )
        if recorded.records is None:
            self._refuse_without_records(objects)
            return Suite()
        return recorded.suite(self.reading.on_ground)

    def _refuse_without_records(self, objects: "Sequence[DescribedObject]") -> None:
        """Refuse what built-in motions have no use for, and a demand of one peak."""
        read = {
            flag: value
            for flag, value in self.reading.given.items()
            if flag not in FLOOR_FLAGS.values()
        }
        refuse(
            {**self.recorded.given, **read, "--no-stretch": not self.stretch},
            "without --records it has no meaning",
            "add --records with your folder, or leave it out",
        )
        if self.file is None and not self.example and self.designs.spectrum is None:
            self.peaks.need_both_peaks()
        for each in objects:
            peaks = {"pga_g": each.pga_g, "pgv_m_s": each.given.demand.pgv_m_s}
            absent = [key for key, value in peaks.items() if value is None]
            if absent and not each.is_on_spectrum:
                raise missing(
                    "--records",
                    valid=f"{each.name} states no {absent[0]}, and built-in motions are made of "
                    "both peaks",
                    hint="add --records with your folder, or state both peaks or a spectrum",
                )

    def run(self) -> "Execution":
        """Return how the runs are computed, the store and the folder checked."""
        self.output.files.check_folder(ASSESSMENT, self.out)
        return self.kept.sweep.run(force=self.output.force)

    def answer(self, run: "Execution") -> "tuple[Assessment | ObjectsTable, Suite]":
        """Return the answer with the records, and write its folder.

        Raises
        ------
        InputError, OutputError, FlagError
            If a file cannot be read, the folder cannot be filled, or a motion is missing.
        """
        objects = self.objects()
        suite = self.suite(objects)
        files = (self.file, self.buildings, self.hazard, *_spectra_of(objects))
        described = [each for each in files if each is not None]
        self.output.files.check_folder(ASSESSMENT, self.out, [*described, *suite.read])
        whole = self._table if self.is_table else self._object
        with flags_of({"hazard": "--hazard"}, InputError):
            answer = whole(objects, suite, run)
        if self.out is not None:
            from rocksteady.show.assessment.folder import write_assessment

            for written in write_assessment(
                answer,
                self.out,
                command=command_of(["rocksteady", *self.context.find_root().obj]),
                files=[*described, *suite.files],
                force=self.output.force,
                lognormal=self.lognormal,
            ):
                announce_file(written)
        return answer, suite

    def _object(
        self, objects: "Sequence[DescribedObject]", suite: Suite, run: "Execution"
    ) -> "Assessment":
        """Return the assessment of one object."""
        from rocksteady.risk.assess.assessment import assess_object
        from rocksteady.risk.counted.reach import MOST

        (described,) = objects
        motions = suite.motions or self._stand_ins
        cells = (MOST + 1) * _runs(described, len(suite.motions or self._stand_ins.motions))
        with sweeping("running the object", cells) as meter:
            assessment = assess_object(
                described,
                motions,
                buildings=self._known_buildings(),
                floor=self.reading.floor,
                stretch=self.stretch,
                hazard=self._site(),
                run=replace(run, progress=meter),
            )
            meter.end()
        return assessment

    def _table(
        self, objects: "Sequence[DescribedObject]", suite: Suite, run: "Execution"
    ) -> "ObjectsTable":
        """Return the answers of a table of objects."""
        from rocksteady.risk.assess.objects_table import MOST_HELPED, assess_placed
        from rocksteady.risk.assess.placed_objects import place_objects
        from rocksteady.risk.assess.rates import site_of
        from rocksteady.risk.counted.reach import MOST

        hazard = self._site()
        sites = [site_of(each, hazard, stretch=self.stretch) for each in objects]
        placed = place_objects(
            objects,
            suite.motions or self._stand_ins,
            self._known_buildings(),
            floor=self.reading.floor,
            stretch=self.stretch,
        )
        kinds = {
            (each.block, id(shaking), each.given.assessment.draws): each
            for each, shaking in zip(placed.objects, placed.shakings, strict=True)
        }
        runs = sum(_runs(each, len(placed.suite.motions)) for each in kinds.values())
        curves = hazard is not None or self.out is not None
        helped = min(MOST_HELPED, len(kinds)) * TRIED // len(kinds)
        cells = (2 + 2 * helped + (MOST + 1) * curves) * runs
        with sweeping("running objects", cells) as meter:
            table = assess_placed(
                placed,
                self.demand,
                sites,
                curves=curves,
                run=replace(run, progress=meter),
            )
            meter.end()
        return table

    @cached_property
    def _stand_ins(self) -> "Motions":
        """The built-in motions, as many as --motions asks for."""
        from rocksteady.risk.counted.built_in import COUNT, SEED, make_built_in_suite

        count, seed = self.built_in
        with flags_of({"count": "--motions", "seed": "--seed"}, InputError):
            return make_built_in_suite(
                COUNT if count is None else count, seed=SEED if seed is None else seed
            )

    def _site(self) -> "HazardCurve | None":
        """Return the hazard curve of --hazard.

        Raises
        ------
        InputError
            If it cannot be read, or the file has several.
        """
        if self.hazard is None:
            return None
        from rocksteady.risk.hazard.read_hazard import read_hazard_curves

        try:
            curves = read_hazard_curves(self.hazard)
        except InputError as error:
            hint = "write the measure, its unit and the time of probabilities into the file"
            kept = error.hint if "=" not in error.hint else hint
            raise InputError("--hazard", error.value, error.valid, kept) from None
        if len(curves) > 1:
            raise InputError(
                "--hazard",
                self.hazard,
                f"it holds {len(curves)} curves, and an object stands at one site",
                "keep the curve of its site",
            )
        return curves[0]

    def _known_buildings(self) -> "Sequence[Building]":
        """Return the buildings of --buildings."""
        if self.buildings is None:
            return ()
        from rocksteady.risk.assess.described.building import read_buildings

        return read_buildings(self.buildings)


@grouped
def assess(
    context: typer.Context,
    block: BlockFlags,
    peaks: PeakFlags,
    designs: DesignFlags,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    kept: RunsFlags,
    output: RowFlags,
    file: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help="An object in TOML, or a table of objects in CSV."),
    ] = None,
    buildings: Path | None = file_flag(
        "--buildings FILE",
        "Read the buildings of objects that state a floor: periods or modes, storeys and rooms. "
        "Motions and demand are then those of the ground.",
    ),
    hazard: Path | None = file_flag(
        "--hazard FILE",
        "Read the hazard curve of the site, as OpenQuake writes it or in two columns, and sum the "
        "annual rate of falling.",
    ),
    out: Path | None = file_flag(
        "--out DIR",
        "Write the report, the runs, the counted shares (also for pelicun and OpenQuake), and the "
        "inputs with their hashes into a new folder; for a table its report, rows and the shares "
        "of each kind. --force replaces those of an earlier assessment.",
    ),
    lognormal: bool = file_flag(
        "--lognormal",
        "Write lognormals for pelicun and OpenQuake, where they are within 10 points of counts.",
        default=False,
    ),
    example: bool = file_flag(
        "--example",
        "Assess a made-up object under built-in motions: no file is needed.",
        default=False,
    ),
    check: bool = options.output_flag(
        "--check",
        "Leave with exit code 1 where an object is above its target or slides, and with 3 where "
        "nothing is shown.",
        default=False,
    ),
    no_stretch: bool = demand_flag(
        "--no-stretch",
        "Multiply the accelerations of records alone, to the PGA, and keep their time axis: their "
        "PGV is then their own.",
        default=False,
    ),
    motions: int | None = ensemble_flag(
        "--motions N", "Set the number of built-in motions where there are no records; default 59."
    ),
    seed: int | None = ensemble_flag("--seed N", "Set the seed of built-in motions; default 1."),
    target: float | None = demand_flag(
        "--target P",
        "Set the share of the runs that may fall at the demand; default 0.1, or that of FILE.",
    ),
    target_50_years: float | None = demand_flag(
        "--target-50-years P",
        "Set the probability of a fall in 50 years that is accepted, in place of --target; with "
        "--hazard.",
    ),
) -> None:
    """Run `rocksteady assess`; `HELP` is what its users read."""
    needs("--damping", designs.damping, "--spectrum", "FILE", beside=designs.spectrum)
    read = [each for each in (file, hazard, *designs.file) if each is not None]
    kept.sweep.check(output.files, read, out=out)
    _refuse_idle(
        block, peaks, designs, recorded, reading, kept, file, buildings, out, example=example
    )
    needs("--lognormal", lognormal or None, "--out", "answer", beside=out)
    goal = _target(target, target_50_years)
    needs("--target-50-years", target_50_years, "--hazard", "site.csv", beside=hazard)
    if file is None and not example:
        require(
            "assess",
            {
                "block": block.given,
                "demand": any((peaks.pga_g, peaks.pgv_m_s, designs.spectrum)),
            },
            "--width-m 0.6 --height-m 2 --pga-g 0.35 --pgv-m-s 0.4",
            "--example",
        )
    asked = _Asked(
        context=context,
        block=block,
        peaks=peaks,
        designs=designs,
        built_in=(motions, seed),
        recorded=recorded,
        reading=reading,
        kept=kept,
        output=output,
        file=file,
        buildings=buildings,
        hazard=hazard,
        out=out,
        target=goal,
        stretch=not no_stretch,
        example=example,
        lognormal=lognormal,
    )
    with kept.sweep.resumable(context.find_root().obj):
        answer, suite = asked.answer(asked.run())
    description = answer.describe()
    output.files.write_csv(
        lambda: description.tables[0] if asked.is_table else _one_row(description)
    )
    output.files.leave(
        "assess",
        replace(description, notes=_notes(description.notes, out)),
        suite=suite,
        follow_up=report_command(context, out),
    )
    code = answer.exit_code if check else INCOMPLETE if _lacks_answer(answer) else 0
    if code:
        raise typer.Exit(code)


def _target(target: float | None, in_50_years: float | None) -> "Target | None":
    """Return the target of the flags.

    Raises
    ------
    InputError, FlagError
        If one is no share, or both are given.
    """
    from rocksteady.risk.counted.verdict import Target

    if target is not None and in_50_years is not None:
        raise both("--target", "--target-50-years", valid="a verdict is on one target")
    if in_50_years is not None:
        return Target(share("--target-50-years", in_50_years), years=50.0)
    return None if target is None else Target(share("--target", target))


def _lacks_answer(answer: "Assessment | ObjectsTable") -> bool:
    """Return whether an object has no answer, one of a table too."""
    from rocksteady.risk.assess.assessment import Assessment

    verdicts = [answer.verdict] if isinstance(answer, Assessment) else answer.verdicts
    return "no-answer" in verdicts


def _spectra_of(objects: "Sequence[DescribedObject]") -> list[Path]:
    """Return the files of the spectra that objects state."""
    from rocksteady.risk.spectra.code_spectra import formula_of

    sources = {each.spectrum.source for each in objects if each.spectrum is not None}
    return [Path(each) for each in sorted(sources) if each and formula_of(each) is None]


def _runs(described: "DescribedObject", motions: int) -> int:
    """Return how many runs an object has at one level at most."""
    return motions * (1 if described.block.symmetric else 2) * described.given.assessment.draws


def _notes(notes: Sequence[str], out: Path | None) -> list[str]:
    """Return the notes of an answer; its caveats stand in the report where one is written."""
    from rocksteady.words.assessment import CAVEATS

    if out is None:
        return [*notes]
    kept = [note for note in notes if note not in CAVEATS]
    return [*kept, f"Caveats, motions and inputs stand in {out / 'report.html'}."]


def _refuse_idle(
    block: BlockFlags,
    peaks: PeakFlags,
    designs: DesignFlags,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    kept: RunsFlags,
    file: Path | None,
    buildings: Path | None,
    out: Path | None,
    *,
    example: bool,
) -> None:
    """Refuse flags that have no meaning beside what is assessed.

    Raises
    ------
    FlagError
        With the flag and what to do.
    """
    if example and file is not None:
        raise FlagError("--example", True, f"{file} is assessed already", "leave one of them out")
    sizes = {f"--{name.replace('_', '-')}": value for name, value in vars(block).items()}
    given = {
        **sizes,
        "--friction": peaks.friction,
        **peaks.vertical_flags,
        "--pga-g": peaks.pga_g,
        "--pgv-m-s": peaks.pgv_m_s,
        "--spectrum": designs.spectrum,
        **recorded.given,
        "--buildings": buildings,
        "--out": out,
        "--runs": kept.runs,
        "--resume": kept.resume,
        "--workers": kept.workers,
        **reading.given,
    }
    columns = [*sizes, "--friction", *peaks.vertical_flags]
    if example:
        idle = [flag for flag in given if flag not in MEANT]
        reason, hint = "--example reads no files", "leave it out"
    elif file is None:
        idle = ["--buildings"]
        reason, hint = "it belongs to objects of a FILE", "leave it out"
    elif file.suffix.lower() == ".csv":
        kept_runs = {"--runs": kept.runs, "--resume": kept.resume}
        refuse(kept_runs, "a table of objects keeps no runs", "leave it out")
        idle = columns
        reason = "a table of objects does not take it"
        hint = "leave it out; sizes, friction and vertical motion are columns of the table"
    else:
        idle = [*columns, *["--pga-g"] * (designs.spectrum is None), "--pgv-m-s"]
        reason, hint = "it belongs in the object's file", "write it there, or leave it out"
    refuse({flag: given[flag] for flag in idle}, reason, hint)
    if buildings is not None:
        floor = {"--floor-hz": reading.floor_hz}
        refuse(floor, "--buildings has the floor of each object", "leave one of the two out")


def _one_row(description: "Description") -> "tuple[list[str], list[list[object]]]":
    """Return the plain facts as a table of one row."""
    facts = {fact.key: fact.value for fact in description.facts if fact.key}
    row = {key: each for key, each in facts.items() if not isinstance(each, list | Mapping)}
    return list(row), [list(row.values())]
