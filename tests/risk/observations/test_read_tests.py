"""Tables of tests: what is read, and the line of each fault, for any bytes that a file holds."""

import hashlib
import os
import random
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocksteady.errors import RocksteadyError
from rocksteady.records import Cleaning
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.read_tests import _YES, OUTCOMES, read_tests

SHOCK = "time (s),acceleration (g)\n0,0\n0.01,0.2\n0.02,-0.2\n0.03,0\n"
TWO = "time (s),N (g),E (g)\n0,0,0\n0.01,0.2,0.1\n0.02,-0.2,-0.1\n0.03,0,0\n"
OBJECTS = "name,width_m,height_m\ncolumn,0.15,0.6\nvase,0.10:0.12,0.5+-0.01\n"
HEAD = "test,record,object,outcome"
G = 9.80665


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "objects.csv").write_text(OBJECTS, "utf-8")
    (tmp_path / "shock.csv").write_text(SHOCK, "utf-8")
    (tmp_path / "up.csv").write_text(SHOCK.replace("0.2", "0.1"), "utf-8")
    (tmp_path / "two.csv").write_text(TWO, "utf-8")
    return tmp_path


def read(folder: Path, text: str | bytes, **options: Path | str | float | Cleaning) -> Observations:
    file = folder / "tests.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_tests(file, **options)  # type: ignore[arg-type]


def refusal(folder: Path, text: str | bytes, **options: Path | str | float | Cleaning) -> str:
    with pytest.raises(RocksteadyError) as error:
        read(folder, text, **options)
    line = str(error.value)
    assert "\n" not in line
    assert len(line) < 800
    return line


def test_a_table_with_every_column(folder: Path) -> None:
    text = (
        f"{HEAD},gain,sigma_ln,group,session,peak_rad,sigma_rad,reversed,channel,vertical,note\n"
        "1,shock,column,stood,0.5,0.1,g,monday,0.02,0.005,yes,,up.csv,windy\n"
        "\n"
        "2,two.csv,vase,Toppled,,,,,,,no,2,,\n"
        "3,two,vase,,,,,,,,,N,,\n"
    )
    shaken = read(folder, "\ufeff" + text)
    first, second, third = shaken.tests
    assert (first.gain, first.sigma_ln, first.group, first.session) == (0.5, 0.1, "g", "monday")
    assert (first.peak_rad, first.sigma_rad, first.reversed) == (0.02, 0.005, True)
    assert first.record.name == "shock"
    assert first.vertical is not None
    assert first.vertical.peak_acceleration_m_s2 == pytest.approx(0.1 * G)
    assert (second.name, second.gain, second.reversed, second.fell) == ("2", 1.0, False, True)
    assert second.record.peak_acceleration_m_s2 == pytest.approx(0.1 * G)
    assert third.record.peak_acceleration_m_s2 == pytest.approx(0.2 * G)
    assert [test.group for test in (second, third)] == ["two E", "two N"]
    np.testing.assert_array_equal(shaken.fell, [0.0, 1.0, np.nan])
    assert shaken.objects["vase"].parameters[:2] == ("width_m", "height_m")
    assert shaken.remarks == ("tests.csv: column note is not read.",)
    assert shaken.sources == {
        name: hashlib.sha256((folder / name).read_bytes()).hexdigest()
        for name in ("tests.csv", "objects.csv", "shock.csv", "up.csv", "two.csv")
    }


@pytest.mark.parametrize(
    ("word", "fell"),
    [
        ("fell", 1), ("overturned", 1), ("toppled", 1), ("1", 1), ("FELL", 1),
        ("stood", 0), ("standing", 0), ("survived", 0), ("0", 0),
    ],
)  # fmt: skip
def test_words_of_an_outcome(word: str, fell: int, folder: Path) -> None:
    shaken = read(folder, f"{HEAD}\n1,shock,column,{word}\n")
    assert shaken.fell.tolist() == [fell]
    coded = "tests.csv: an outcome 1 is read as fell, and 0 as stood."
    assert (coded in shaken.warnings) == (word in ("0", "1"))


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_spreadsheet_may_separate_and_end_lines_its_way(
    separator: str, end: str, folder: Path
) -> None:
    lines = [f"{HEAD},gain".split(","), ["1", "shock", "column", "fell", "0.5"]]
    shaken = read(folder, end.join(separator.join(line) for line in lines) + end)
    assert shaken.tests[0].gain == 0.5


def test_a_record_that_many_tests_name_is_one_record(folder: Path) -> None:
    (folder / "sub").mkdir()
    (folder / "sub" / "shock.csv").write_text(SHOCK, "utf-8")
    names = [
        "shock",
        "shock.csv",
        "./shock.csv",
        "sub/../shock",
        "sub/shock",
        str(folder / "shock"),
    ]
    rows = "".join(f"{k},{name},column,fell\n" for k, name in enumerate(names))
    shaken = read(folder, f"{HEAD}\n{rows}")
    records = [test.record for test in shaken.tests]
    assert len({id(record) for record in records}) == 2
    # Two files of one name are two groups.
    assert shaken.groups.tolist() == ["shock.csv"] * 4 + ["sub/shock.csv", "shock.csv"]


def test_records_and_objects_may_lie_elsewhere(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / "elsewhere"
    other.mkdir()
    (folder / "objects.csv").rename(other / "things.csv")
    (folder / "shock.csv").rename(other / "shock.csv")
    text = f"{HEAD}\n1,shock,column,fell\n"
    shaken = read(folder, text, records=other, objects=other / "things.csv")
    assert sorted(shaken.sources) == ["shock.csv", "tests.csv", "things.csv"]


def test_a_folder_of_records_beside_the_table_is_found(folder: Path) -> None:
    (folder / "records").mkdir()
    (folder / "shock.csv").rename(folder / "records" / "shock.csv")
    (test,) = read(folder, f"{HEAD}\n1,shock,column,fell\n").tests
    assert test.record.name == "shock"


def test_units_and_interval_of_files_that_do_not_state_them(folder: Path) -> None:
    (folder / "bare.txt").write_text("0\n0.2\n-0.2\n0\n", "utf-8")
    text = f"{HEAD}\n1,bare,column,fell\n"
    assert "tests.csv: line 2, record = 'bare' is not valid: it cannot be read" in refusal(
        folder, text
    )
    (test,) = read(folder, text, units="g", dt_s=0.02).tests
    assert test.record.dt_s == 0.02
    assert test.record.peak_acceleration_m_s2 == pytest.approx(0.2 * G)


ROW = "1,shock,column,fell"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", "tests.csv is empty: a table has from 1 to 100000 tests"),
        (f"{HEAD}\n", "tests.csv has 0 tests"),
        ("test,record,object\n1,shock,column\n", "tests.csv: line 1 has no column outcome"),
        ("test,record,object,outcom\n1,shock,column,fell\n", "did you mean outcome?"),
        (f"{HEAD},Gain\n{ROW},1\n", "line 1, column 5 = 'Gain' is not valid"),
        (f"{HEAD},gain,gain\n{ROW},1,1\n", "column 6 = 'gain' is not valid: it occurs twice"),
        (f"{HEAD}\n{ROW},1\n", "line 2 has 5 cells: the first line names 4 columns"),
        (f"{HEAD}\n{ROW}\n{ROW}\n", "line 3, test = '1' is not valid: line 2 has it too"),
        (f"{HEAD}\n,shock,column,fell\n", "line 2, test = '' is not valid"),
        (f"{HEAD}\n1,shock,colum,fell\n", "did you mean column?"),
        (f"{HEAD}\n1,shock,,fell\n", "line 2, object is empty: objects.csv has no such object"),
        (f"{HEAD}\n1,shok,column,fell\n", "did you mean shock"),
        (f"{HEAD}\n1,,column,fell\n", "line 2, record is empty"),
        (f"{HEAD}\n1,.,column,fell\n", "record = '.' is not valid"),
        (f"{HEAD}\n1,no/such,column,fell\n", "there is no folder"),
        (f"{HEAD}\n1,{'x' * 300},column,fell\n", "File name too long"),
        (f"{HEAD}\n1,objects,column,fell\n", "line 2, record = 'objects' is not valid: it cannot"),
        (f"{HEAD}\n1,two,column,fell\n", "line 2, channel is not given"),
        (f"{HEAD},channel\n1,two,column,fell,Z\n", "line 2, channel = 'Z' is not valid"),
        (f"{HEAD},vertical\n{ROW},two\n", "line 2, vertical_channel is not given"),
        (f"{HEAD}\n1,shock,column,felt\n", "outcome = 'felt' is not valid: it must be one of fell"),
        (f"{HEAD}\n1,shock,column,felt\n", "did you mean fell?"),
        (f"{HEAD}\n1,shock,column,?\n", "leave the cell empty"),
        (f"{HEAD},gain\n{ROW},0\n", "tests.csv: line 2, gain = 0.0 is not valid"),
        (f"{HEAD},gain\n{ROW},-1\n", "reversed changes the sign"),
        (f"{HEAD},gain\n{ROW},nan\n", "gain = 'nan' is not valid: it must be a finite number"),
        (f"{HEAD},gain\n{ROW},{'9' * 5000}\n", "it must be a finite number"),
        (
            f"{HEAD},gain\n{ROW},0.5:0.6\n",
            "gain = '0.5:0.6' is not valid: it must be a finite number",
        ),
        (f"{HEAD.replace(',', ';')};gain\n1;shock;column;fell;0,5\n", "for a decimal comma"),
        (f"{HEAD},sigma_ln\n{ROW},-0.1\n", "line 2, sigma_ln = -0.1 is not valid"),
        (f"{HEAD},peak_rad,sigma_rad\n{ROW},0.1,0.01\n", "is that it fell: only a test that stood"),
        (f"{HEAD},peak_rad\n1,shock,column,stood,0.1\n", "sigma_rad is missing beside peak_rad"),
        (f"{HEAD},reversed\n{ROW},maybe\n", "write yes or no"),
        (f"{HEAD},reversed\n{ROW},ture\n", "did you mean true?"),
        (f"{HEAD}\n1,shock,column,\0\n", "line 2 has a zero byte"),
        (f"{HEAD}\n".encode() + b"\xe4,shock,column,fell\n", "is not UTF-8"),
        (f'{HEAD}\n"1,shock,column,fell\n', "is not CSV"),
    ],
)
def test_a_fault_is_one_line_with_its_place(text: str | bytes, line: str, folder: Path) -> None:
    assert line in refusal(folder, text)


@pytest.mark.parametrize(
    ("objects", "line"),
    [
        ("name,width_m\ncolumn,0.2\n", "objects.csv: line 2, object column: height_m is missing"),
        ("name,width_m,height_m\na,0.2,1\na,0.2,1\n", "line 3, name = 'a' is not valid: line 2"),
        ("name,width_m,height_m\n,0.2,1\n", "objects.csv: line 2, name = '' is not valid"),
        ("name,width_m,height_m\na,0.2 m,1\n", "objects.csv: line 2, width_m = '0.2 m'"),
        ("name,width_m,height_m\na,200,600\n", "write 0.6 for 600 mm"),
        ("name,widht_m,height_m\na,0.2,1\n", "did you mean width_m?"),
        ("name,width_m,height_m,heigth\na,0.2,1,2\n", "did you mean height_m?"),
        ("name,width_m,height_m,base\na,0.2,1,1:0.6\n", "exchange the two"),
        ("", "objects.csv is empty"),
    ],
)
def test_a_fault_of_the_objects_is_one_line(objects: str, line: str, folder: Path) -> None:
    (folder / "objects.csv").write_text(objects, "utf-8")
    assert line in refusal(folder, f"{HEAD}\n{ROW}\n")


@pytest.mark.parametrize(
    ("column", "meant"),
    [
        ("gian", "gain"),
        ("gain [%]", "gain"),
        ("gain_percent", "gain"),
        ("Peak (deg)", "peak_rad"),
        ("peak_deg", "peak_rad"),
        ("sigma", "sigma_ln"),
    ],
)
def test_a_column_that_means_one_is_not_left_out(column: str, meant: str, folder: Path) -> None:
    line = refusal(folder, f"{HEAD},{column}\n{ROW},0.5\n")
    assert f"did you mean {meant}?" in line


def test_a_column_of_notes_is_left_out(folder: Path) -> None:
    names = "record_note,test date,photo,remark"
    shaken = read(folder, f"{HEAD},{names}\n{ROW},a,b,c,d\n")
    assert shaken.remarks == (
        "tests.csv: columns record_note, test date, photo, remark are not read.",
    )


def test_not_fell_is_not_taken_for_fell(folder: Path) -> None:
    line = refusal(folder, f"{HEAD}\n1,shock,column,not fell\n")
    assert "did you mean" not in line
    assert "write fell or stood" in line


def test_a_measured_factor_of_the_restitution_has_its_column(folder: Path) -> None:
    objects = "name,width_m,height_m,restitution\ncolumn,0.15,0.6,housner*0.965\n"
    (folder / "objects.csv").write_text(objects, "utf-8")
    assert "as housner_factor" in refusal(folder, f"{HEAD}\n{ROW}\n")


def test_a_channel_of_no_vertical_motion_is_refused(folder: Path) -> None:
    line = refusal(folder, f"{HEAD},vertical,vertical_channel\n{ROW},,2\n")
    assert "line 2, vertical_channel = '2'" in line


def test_an_angle_beyond_the_slenderness_is_remarked_on(folder: Path) -> None:
    def remarks(angle: str) -> bool:
        shaken = read(folder, f"{HEAD},peak_rad,sigma_rad\n1,shock,column,stood,{angle},0.01\n")
        return any("check the unit of peak_rad" in each for each in shaken.warnings)

    assert remarks("1.2")
    assert remarks("0.25")  # alpha is atan(0.15/0.6), 0.245
    assert not remarks("0.24")


def test_files_that_are_none_are_refused(folder: Path) -> None:
    text = f"{HEAD}\n{ROW}\n"
    assert "objects = " in refusal(folder, text, objects=folder)
    assert "objects = " in refusal(folder, text, objects=folder / "missing.csv")
    assert "it must be a folder" in refusal(folder, text, records=folder / "shock.csv")
    with pytest.raises(RocksteadyError, match="tests = "):
        read_tests(folder)
    os.mkfifo(folder / "pipe")
    for name in (folder / "pipe", Path("/dev/zero"), Path("/dev/null")):
        assert "a pipe or a device, and no file" in refusal(folder, text, objects=name)
    (folder / "shock.AT2").write_text(SHOCK, "utf-8")
    assert "shock.AT2, shock.csv have this name" in refusal(folder, text)
    assert "it must be" in refusal(folder, text.replace("shock", "shock.csv"), units="furlongs")


@pytest.mark.slow
def test_many_faults_of_chance_are_one_line_each(folder: Path) -> None:
    chance = random.Random(7)
    head = f"{HEAD},gain,sigma_ln,peak_rad,sigma_rad,reversed,channel,vertical"
    cells = [
        "", "1", "shock", "two", "up", "column", "vase", "fell", "stood", "0.5", "-1", "nan",
        "1e400", "9" * 400, "é\u2028", '"', "a;b", "0,5", "\x1f", "../..", "/", "=1+1", "N", "yes",
    ]  # fmt: skip
    ended = 0
    for _ in range(300):
        row = ["1", "shock", "column", "stood", *[""] * 7]
        for place in chance.sample(range(11), chance.randint(1, 3)):
            row[place] = chance.choice(cells)
        text = head + "\n" + ",".join(row) + "\n"
        try:
            read(folder, text)
            ended += 1
        except RocksteadyError as error:
            assert "\n" not in str(error)  # noqa: PT017
            assert str(error).startswith("tests.csv")  # noqa: PT017
    assert 20 < ended < 280


@pytest.mark.slow
@settings(
    max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None
)
@given(
    content=st.binary(max_size=80)
    | st.lists(st.text(max_size=8), max_size=12).map(
        lambda cells: f"{HEAD},gain\n{','.join(cells)}".encode("utf-8", "replace")
    )
)
def test_whatever_a_table_holds_it_is_read_or_refused(content: bytes, folder: Path) -> None:
    for name in ("tests.csv", "objects.csv"):
        (folder / "objects.csv").write_text(OBJECTS, "utf-8")
        (folder / "tests.csv").write_text(f"{HEAD}\n{ROW}\n", "utf-8")
        (folder / name).write_bytes(content)
        try:
            read_tests(folder / "tests.csv")
        except RocksteadyError as error:
            assert "\n" not in str(error)  # noqa: PT017


def test_motions_are_read_as_laboratories_leave_them(folder: Path) -> None:
    """Units in brackets before the plot's number, a chosen column, a baseline taken off."""
    rows = "0,9,0.1\n0.01,9,0.3\n0.02,9,-0.1\n0.03,9,0.1\n"
    head = "Time [s] - Plot 0,command,table east [g] - Plot 0\n"
    (folder / "lab.csv").write_text(head + rows, "utf-8")
    table = f"{HEAD}\n1,lab,column,fell\n"
    made = read(folder, table, column="table east [g] - Plot 0", cleaning=Cleaning(baseline="mean"))
    samples = made.tests[0].record.acceleration_m_s2
    assert samples == pytest.approx([0.0, 0.2 * G, -0.2 * G, 0.0], abs=1e-12)
    assert made.remarks == ("Each record was cleaned: baseline mean.",)
    words = refusal(folder, table, column="west")
    assert "no such column" in words
    assert len(words.splitlines()) == 1
    words = refusal(folder, table, column="3", cleaning=Cleaning(filter_hz=":90"))
    assert words.startswith("filter_hz = ':90' is not valid: its ends must lie in [0.0001, 50) Hz")


def test_words_of_outcomes_and_of_reversed_tests() -> None:
    for word, fell in (
        *((each, True) for each in ("fell", "overturned", "toppled", "1")),
        *((each, False) for each in ("stood", "standing", "survived", "0")),
        ("", None),
    ):
        assert OUTCOMES[word] is fell
    assert {word for word, yes in _YES.items() if yes} == {"yes", "true", "1"}
    assert {word for word, yes in _YES.items() if not yes} == {"no", "false", "0", ""}
