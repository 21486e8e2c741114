"""The reference of files: keys, ranges and defaults are those of the readers; examples are read."""

import copy
import math
import re
import tomllib
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, get_args

import msgspec
import pytest

import rocksteady as rs
from rocksteady.errors import InputError, RocksteadyError
from rocksteady.facades.checks.actions import BOUNDS as FACADE_BOUNDS
from rocksteady.facades.checks.facade_schema import FILE as FACADE_FILE
from rocksteady.facades.checks.spectrum_table import COLUMNS as SPECTRUM_COLUMNS
from rocksteady.model.blocks.sizes import TALL
from rocksteady.records.core.units import UNITS
from rocksteady.records.read import FORMATS
from rocksteady.results.rendering import printable
from rocksteady.risk.assess.described import _validation as object_bounds
from rocksteady.risk.assess.described.schema import TABLES as OBJECT_TABLES
from rocksteady.risk.assess.described.tables import COLUMNS as OBJECT_COLUMNS
from rocksteady.risk.calibration.sampler.space import WIDEST
from rocksteady.risk.observations import object_prior, prior, read_peaks, read_tests
from rocksteady.risk.spectra.elastic_spectrum import LIMITS as SPECTRUM_LIMITS
from rocksteady.show.export.ensemble_rows import HEAD as RUN_COLUMNS
from tests.cli.program import rocksteady
from tests.every import every

FOLDER = Path(__file__).parents[2] / "docs" / "reference" / "files"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in sorted(FOLDER.glob("*.md"))}
EXAMPLE = re.compile(
    r"^:::\{code-block\} \w+\n:caption: (\S+)\n\n(.*?)^:::$", re.DOTALL | re.MULTILINE
)
EXAMPLES = {page: dict(EXAMPLE.findall(content)) for page, content in PAGES.items()}
INTERVAL = re.compile(r"^([\[(])(-?[\w./]+), (-?[\w./]+)([\])])")

Row = dict[str, str]


def sections(page: str) -> dict[str, str]:
    """Return the text below each heading of a page."""
    parts = re.split(r"^#+ (.+)$", PAGES[page], flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def rows_of(text: str) -> list[Row]:
    """Return the rows of the table of keys in a text, a row for each key."""
    lines = iter(text.splitlines())
    head: list[str] = []
    for line in lines:
        if re.match(r"\| (key|column) \|", line):
            head = [cell.strip() for cell in line.strip("|").split("|")]
            break
    found = []
    for line in lines:
        if not line.startswith("|"):
            break
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        assert len(cells) == len(head), line
        names = re.findall(r"`([\w]+)`", cells[0])
        found += [dict(zip(head, cells, strict=True)) | {"key": name} for name in names]
    return found


def tables_of(page: str) -> dict[str, list[Row]]:
    """Return the rows of each table of a TOML file, by its name; "" is what stands above all."""
    found: dict[str, list[Row]] = {}
    for heading, text in sections(page).items():
        names = re.findall(r"`\[+([\w.]+)\]+`", heading)
        names += [""] if "above the first table" in heading else []
        found |= dict.fromkeys(names, rows_of(text))
    return {name: rows for name, rows in found.items() if rows}


def keys(rows: list[Row]) -> list[str]:
    return [row["key"] for row in rows]


def mandatory(rows: list[Row]) -> set[str]:
    return {row["key"] for row in rows if row["default"].startswith("**mandatory**")}


def limits(row: Row) -> tuple[str, float, float, str] | None:
    """Return the interval of a row: its brackets and its ends."""
    found = INTERVAL.match(row["valid"])
    if found is None:
        return None
    low, high = (0.5 * math.pi if text == "pi/2" else float(text) for text in (found[2], found[3]))
    return found[1], low, high, found[4]


# ------------------------------------------------------------------------------------ examples


@pytest.fixture(name="written")
def _written(tmp_path: Path) -> Callable[[str], Path]:
    """Return the function that writes the examples of a page into a folder."""

    def write(page: str) -> Path:
        for name, text in EXAMPLES[page].items():
            file = tmp_path / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        return tmp_path

    return write


def read_motions(file: Path) -> Any:
    alone = {"units": "m/s^2", "dt_s": 0.01} if file.name == "column.txt" else {}
    found = rs.records.read_recordings(file, **alone)  # type: ignore[arg-type]
    assert all(each.warnings == () and each.processing == () for each in found)
    peaks = [round(each.record.peak_acceleration_m_s2, 9) for each in found]
    assert peaks[0] == 3.92266  # one motion in four formats
    return found


READERS: dict[str, dict[str, Callable[[Path], Any]]] = {
    "object": {r".*\.toml": rs.read_object, r".*\.csv": rs.read_objects},
    "facade": {
        r".*\.toml": rs.read_facade,
        r"floor\.csv": lambda file: rs.codes.read_spectrum_table(file, spectrum_damping=0.05),
        r"two-dampings\.csv": rs.codes.read_spectrum_table,
    },
    "observations": {
        r".*/tests\.csv": rs.read_tests,
        r".*\.toml": rs.calibration.read_prior,
        r".*-survey\.csv": rs.read_survey,
        r".*-peaks\.csv": rs.calibration.read_peaks,
    },
    "hazard": {r".*\.csv": rs.read_hazard_curves},
    "motions": {r".*": read_motions},
}
BESIDE = {"screens.csv", "objects.csv", "shock.csv", "pair.csv"}
"""Examples that are read with others, or by a command."""


@every(("page", "name"), [(page, name) for page, texts in EXAMPLES.items() for name in texts])
def test_each_example_is_read_without_a_warning(
    page: str, name: str, written: Callable[[str], Path]
) -> None:
    file = written(page) / name
    readers = [read for end, read in READERS[page].items() if re.fullmatch(end, name)]
    assert len(readers) == (file.name not in BESIDE)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for read in readers:
            assert read(file)


def test_the_spectrum_of_screens_is_read(written: Callable[[str], Path]) -> None:
    file = written("facade") / "screens.csv"
    ran = rocksteady("screens --width-m 0.32 --height-m 1.8 --pga-g 0.3 --json --spectrum", file)
    assert ran.code == 0, ran.err
    assert ran.err == ""


def test_pages_have_a_minimal_and_a_complete_example() -> None:
    for page in ("object", "facade", "observations"):
        assert any(name.startswith("minimal") for name in EXAMPLES[page])
        assert any(name.startswith("complete") for name in EXAMPLES[page])
    assert sum(len(texts) for texts in EXAMPLES.values()) >= 30


# --------------------------------------------------------------------------- TOML: the structs


def structs(page: str) -> dict[str, type[msgspec.Struct]]:
    return OBJECT_TABLES if page == "object" else {k: v for k, v in FACADE_FILE.kinds.items() if k}


def plain_fields(kind: type[msgspec.Struct]) -> Iterator[msgspec.structs.FieldInfo]:
    """Yield the fields of a table that are keys, and no tables of their own."""
    for field in msgspec.structs.fields(kind):
        parts = {field.type, *get_args(field.type)}
        own = {
            part for part in parts if isinstance(part, type) and issubclass(part, msgspec.Struct)
        }
        if not own or any(part.__name__ == "Range" for part in own):
            yield field


@pytest.mark.parametrize("page", ["object", "facade"])
def test_keys_and_mandatory_ones_are_those_of_the_reader(page: str) -> None:
    written = tables_of(page)
    kinds = structs(page)
    with_keys = {name for name, kind in kinds.items() if list(plain_fields(kind))}
    assert set(written) == with_keys
    for table in with_keys:
        fields = list(plain_fields(kinds[table]))
        assert sorted(keys(written[table])) == sorted(field.name for field in fields), table
        needed = {field.name for field in fields if field.required}
        if table.startswith("demand.s") and page == "facade":
            continue  # one of two ways: below
        assert mandatory(written[table]) == needed, table


@pytest.mark.parametrize("page", ["object", "facade"])
def test_defaults_are_those_of_the_reader(page: str) -> None:
    for table, kind in structs(page).items():
        fields = {field.name: field for field in plain_fields(kind)}
        for row in tables_of(page).get(table, []):
            default = fields[row["key"]].default
            if default not in (None, msgspec.NODEFAULT):
                text = str(default).lower() if isinstance(default, bool) else str(default)
                assert row["default"] == f"`{text}`", (table, row["key"])


def test_ranges_of_an_object_are_those_of_the_reader() -> None:
    for table, rows in tables_of("object").items():
        for row in rows:
            key, found = row["key"], limits(row)
            if found is None:
                assert key not in object_bounds.BOUNDS, key
                continue
            low, top, ends, _ = object_bounds.BOUNDS.get(key, (0.0, TALL, "(]", ""))
            assert found == (ends[0], low, top, ends[1]), (table, key)
    for row in tables_of("object")["assessment"]:
        if row["key"] in object_bounds.WHOLE:
            least, most, _ = object_bounds.WHOLE[row["key"]]
            numbers = [int(text) for text in re.findall(r"\d+", row["valid"])]
            assert (numbers[0], numbers[-1]) == (least, most)


def test_ranges_of_a_facade_are_those_of_the_reader() -> None:
    for table, rows in tables_of("facade").items():
        for row in rows:
            key = row["key"]
            found = INTERVAL.search(row["valid"][row["valid"].find("[1, 2]") :])
            found = found if key == "topography" else INTERVAL.match(row["valid"])
            if key in FACADE_BOUNDS or key in SPECTRUM_LIMITS:
                low, high, ends, _ = {**FACADE_BOUNDS, **SPECTRUM_LIMITS}[key]
                assert found is not None, key
                shown = (found[1], float(found[2]), float(found[3]), found[4])
                assert shown == (ends[0], low, high, ends[1]), (table, key)


# --------------------------------------------------------------- TOML: what the readers refuse


def toml_of(values: Any, name: str = "") -> str:
    """Return TOML of tables; enough for the examples."""
    plain = {
        k: v for k, v in values.items() if not isinstance(v, dict) or set(v) == {"low", "high"}
    }
    lists = {k: v for k, v in plain.items() if isinstance(v, list) and "z_m" in str(v[0])}
    lines = [f"[{name}]"] if name else []
    lines += [f"{key} = {inline(value)}" for key, value in plain.items() if key not in lists]
    for key, each in lists.items():
        for one in each:
            lines += [f"[[{key}]]", *(f"{k} = {inline(v)}" for k, v in one.items())]
    for key, value in values.items():
        if key not in plain:
            lines.append(toml_of(value, f"{name}.{key}" if name else key))
    return "\n".join(lines) + "\n"


def inline(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {inline(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


READ_TOML: dict[str, Callable[[Path], Any]] = {
    "object": rs.read_object,
    "facade": rs.read_facade,
    "observations": rs.calibration.read_prior,
}


def place(values: Any, table: str) -> Any:
    """Return a table of a file, or nothing where the file has none of this name."""
    for part in table.split(".") if table else []:
        values = values.get(part, {})
    return values[0] if isinstance(values, list) else values


@every("page", list(READ_TOML))
def test_a_file_without_a_mandatory_key_is_refused_and_without_another_read(
    page: str, written: Callable[[str], Path]
) -> None:
    folder = written(page)
    values = tomllib.loads(EXAMPLES[page]["complete.toml"])
    file = folder / "changed.toml"
    file.write_text(toml_of(values), encoding="utf-8")
    READ_TOML[page](file)
    together = {"table", "soil_factor", "cc", "soil"}
    for table, rows in tables_of(page).items():
        for row in rows:
            changed = copy.deepcopy(values)
            if row["key"] not in place(changed, table) or row["key"] in together:
                continue
            del place(changed, table)[row["key"]]
            file.write_text(toml_of(changed), encoding="utf-8")
            needed = row["default"].startswith(("**mandatory**", "mandatory"))
            way = page == "object" and row["key"] in {
                "width_m",
                "height_m",
                "mass_kg",
                "fixed_parts",
            }
            if row["key"] == "damping" or needed or way:
                with pytest.raises(RocksteadyError, match=row["key"]):
                    READ_TOML[page](file)
            else:
                READ_TOML[page](file)


@every("page", list(READ_TOML))
def test_a_value_outside_its_range_is_refused_and_an_unknown_key_too(
    page: str, written: Callable[[str], Path]
) -> None:
    folder = written(page)
    file = folder / "changed.toml"
    tried = 0
    for name in [name for name in EXAMPLES[page] if name.endswith(".toml")]:
        values = tomllib.loads(EXAMPLES[page][name])
        for table, rows in tables_of(page).items():
            for row in rows:
                found = limits(row)
                if row["key"] not in place(values, table) or found is None:
                    continue
                for value in (found[1] - 0.01, found[2] * 1.01):
                    changed = copy.deepcopy(values)
                    listed = isinstance(place(changed, table)[row["key"]], list)
                    place(changed, table)[row["key"]] = [value, 2.0 * value] if listed else value
                    file.write_text(toml_of(changed), encoding="utf-8")
                    with pytest.raises(RocksteadyError, match=row["key"]):
                        READ_TOML[page](file)
                    tried += 1
        for table in tables_of(page):
            changed = copy.deepcopy(values)
            if place(changed, table):
                place(changed, table)["unheard_of"] = 1
                file.write_text(toml_of(changed), encoding="utf-8")
                with pytest.raises(InputError, match="unheard_of"):
                    READ_TOML[page](file)
    assert tried >= 14


# -------------------------------------------------------------------------------------- tables


def test_columns_of_objects_are_those_of_the_reader() -> None:
    rows = rows_of(sections("object")["Tables of objects"])
    assert sorted(keys(rows)) == sorted(OBJECT_COLUMNS)
    header = EXAMPLES["object"]["complete.csv"].partition("\n")[0].split(",")
    assert set(header) - {"room"} == set(OBJECT_COLUMNS)
    assert [row["key"] for row in rows if row["mandatory"]] == ["name"]


def test_columns_of_a_spectrum_are_those_of_the_reader() -> None:
    rows = rows_of(sections("facade")["Spectrum tables"])
    assert set(keys(rows)) == set(SPECTRUM_COLUMNS.known)
    assert mandatory(rows) == set(SPECTRUM_COLUMNS.needed)


def test_columns_of_observations_are_those_of_the_readers() -> None:
    parts = sections("observations")
    tests = rows_of(parts["Tests"])
    assert tuple(keys(tests)) == read_tests.TEST_COLUMNS
    assert mandatory(tests) == {"test", "record", "object", "outcome"}
    outcomes = re.findall(r"\w+", next(row["valid"] for row in tests if row["key"] == "outcome"))
    assert set(outcomes) - {"empty"} == {word for word in read_tests.OUTCOMES if word}
    peaks = rows_of(parts["Peaks of free rocking"])
    assert set(keys(peaks)) == set(read_peaks.COLUMNS.known)
    sides = next(row["valid"] for row in peaks if row["key"] == "side").split(", ")
    assert {*sides, "+1"} == set(read_peaks.SIDES)
    survey = rows_of(parts["Surveys"])
    assert keys(survey) == ["outcome", "reversed"]
    header = EXAMPLES["observations"]["complete/tests.csv"].partition("\n")[0].split(",")
    assert tuple(header[:-1]) == read_tests.TEST_COLUMNS


def test_numbers_of_objects_and_priors_are_those_of_the_readers() -> None:
    parts = sections("observations")
    objects = rows_of(parts["Objects before the tests"])
    assert keys(objects) == ["name", *object_prior.BOUNDS]
    defaults = {
        key: str(WIDEST[key][0] if key in WIDEST else spread)
        for key, spread in object_prior.DEFAULTS.items()
    }
    general = rows_of(parts["`[object]`"])
    assert tuple(keys(general)) == prior.GENERAL
    for row in [*objects[1:], *general]:
        found = limits(row)
        assert found is not None
        low, high, _ = object_prior.BOUNDS[row["key"]]
        assert found == ("[", low, high, "]"), row["key"]
        if row["key"] in defaults:
            assert (
                str(rs.calibration.PriorRange.parse(row["default"].strip("`")))
                == defaults[row["key"]]
            )
    noise = rows_of(parts["`[noise]`"])
    given = prior.OutcomeErrors()
    assert {row["key"]: row["default"].strip("`") for row in noise} == {
        key: str(getattr(given, key)) for key in prior.NOISE
    }
    assert {row["key"]: limits(row) for row in noise} == {
        key: ("[", 0.0, most, "]") for key, (most, _) in prior.NOISE.items()
    }


@every(
    ("names", "rate"),
    [
        ("PGA [g], annual rate", 0.02),
        ("PGA [m/s^2], frequency", 0.02),
        ("PGV [cm/s], lambda", 0.02),
        ("PGV [kine], MAFE", 0.02),
        ("PGA [% g], 1/yr", 0.02),
        ("Sa(1.0) [g], rate per 50 years", 0.02 / 50.0),
        ("PGV [m/s], annual probability", -math.log1p(-0.02)),
        ("PGA [g], probability in 50 years [%]", -math.log1p(-0.0002) / 50.0),
        ("PGA [g], probability", None),
        ("level, annual rate", None),
    ],
)
def test_names_of_columns_of_hazard_are_understood_as_the_page_has_it(
    names: str, rate: float | None, tmp_path: Path
) -> None:
    assert all(word in PAGES["hazard"] for word in re.findall(r"[A-Za-z/]{4,}", names))
    file = tmp_path / "site.csv"
    file.write_text(f"{names}\n0.05, 0.02\n0.1, 0.006\n", encoding="utf-8")
    if rate is None:
        with pytest.raises(InputError):
            rs.read_hazard_curves(file)
    else:
        (curve,) = rs.read_hazard_curves(file)
        assert curve.rates[0] == pytest.approx(rate, rel=1e-12)


@pytest.mark.slow
def test_what_becomes_of_a_store_is_as_the_table_has_it(tmp_path: Path) -> None:
    path = tmp_path / "map.zarr"

    def outcome(restitution: float = 0.8, **how: bool) -> str:
        axes = {"amplitude": [0.5, 1.0], "frequency_ratio": [1.0, 2.0]}
        run = rs.Execution(store=rs.Store(path, **how))
        try:
            rs.map_attractors(rs.DimensionlessBlock(restitution=restitution), axes=axes, run=run)
        except rs.errors.OutputError:
            return "refused"
        return "done"

    def row(restitution: float = 0.8) -> list[str]:
        ways: tuple[dict[str, bool], ...] = ({}, {"resume": True}, {"overwrite": True})
        return [outcome(restitution, **how) for how in ways]

    path.mkdir()
    assert outcome() == outcome(overwrite=True) == "refused"  # an empty folder
    assert outcome(resume=True) == "done"
    assert row() == ["refused", "done", "done"]
    assert row(0.7) == ["refused", "refused", "done"]
    (path / "notes.txt").write_text("mine", encoding="utf-8")
    assert row(0.7) == ["refused", "done", "refused"]
    path = tmp_path
    assert row() == ["refused", "refused", "refused"]
    table = PAGES["stores"].partition("## Resume")[2]
    assert "| an empty folder | refused | begun | refused |" in table
    assert "| another folder | refused | refused | refused |" in table
    assert "| a store in which other files lie | refused | continued | refused" in table


def test_formats_and_units_of_motions_are_those_of_the_readers() -> None:
    parts = sections("motions")
    cells = re.findall(r"^\| (`.*?) \|", parts["Formats"], re.MULTILINE)
    names = re.findall(r"`([\w-]+)`", "".join(cells))
    assert sorted(names) == sorted(FORMATS)
    line = next(row for row in parts["Units, channels, signs"].splitlines() if "| unit |" in row)
    assert all(f"`{unit}`" in line for unit in UNITS)


def test_files_of_folders_and_columns_of_runs_are_those_that_are_written() -> None:
    from rocksteady.facades.page.files import FACADE
    from rocksteady.show.export.folders import ASSESSMENT, CALIBRATION
    from rocksteady.show.export.manifest import SCHEMA, make_manifest

    parts = sections("results")
    rows = parts["Report folders"].splitlines()
    for word, pattern in (
        ("assess", ASSESSMENT.ours),
        ("facade --out", FACADE.ours),
        ("calibrate", CALIBRATION.ours),
    ):
        lines = [row.split("|")[2] for row in rows if row.startswith("|") and word in row]
        named = {name for line in lines for name in re.findall(r"`([\w.]+)`", line)}
        assert named
        assert all(re.fullmatch(pattern, name) for name in named)
        endings = set(re.findall(r"(\w+)\\\.", pattern))
        assert endings <= {name.partition(".")[0] for name in named}
    columns = rows_of(parts["`results.csv`: a row for each run"])
    assert set(keys(columns)) == set(RUN_COLUMNS)
    manifest = rows_of(parts["`run.json`: the manifest"])
    assert set(keys(manifest)) == {"schema", "ensemble", *make_manifest()}
    assert f"`{SCHEMA}`" in parts["`run.json`: the manifest"]


def test_pages_hold_only_what_prints() -> None:
    for name, text in PAGES.items():
        assert printable(text, keep="\n") == text, name
