"""Words above the samples: agreed with, refused with their line, or warned about; never passed."""

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import read_record
from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, read_recordings
from rocksteady.records.core import header_statements as statements
from rocksteady.records.core.text import RecordText
from rocksteady.records.core.units import in_m_s2
from tests.every import every
from tests.records import refused
from tests.records.writers import at2, cosmos_channel, csmip_v2_channel, esm, knet, samples, smc

ROWS = "0,1.0\n0.01,-2.5\n0.02,0.5\n"
ALONE = "1.0\n-2.5\n0.5\n"


def read(tmp_path: Path, text: str, **given: object) -> Recording:
    path = tmp_path / "table.txt"
    path.write_text(text, encoding="utf-8")
    (found,) = read_recordings(path, **given)  # type: ignore[arg-type]
    return found


@every(
    "words",
    [
        *("acceleration in cm/s2", "acc (cm/s2)", "units: gal", "acc in g x 10", "values x 10"),
        *("x10", "x 10", "10 x acc", "data * 100", "values are doubled", "acc \u00d7 1000"),
        *("time in ms, given in s", "t in minutes", "time [ms]"),
    ],
)
def test_words_that_contradict_the_names_are_refused(tmp_path: Path, words: str) -> None:
    text = f"# {words}\ntime (s),acc (g)\n{ROWS}"
    with pytest.raises(RecordFileError, match=r"line [12], "):
        read(tmp_path, text)


@every(
    ("words", "size"),
    [
        *[("time in ms", 1e-3), ("time [ms]", 1e-3), ("time: ms", 1e-3), ("t in minutes", 60.0)],
        *[("time (s)", 1.0), ("origin time: 12:03:00", 1.0), ("record time in ms", 1.0)],
        *[("time: noon", 1.0), ("time = UTC", 1.0), ("time in 5 parts", 1.0)],
    ],
)
def test_the_unit_of_times_in_words(tmp_path: Path, words: str, size: float) -> None:
    found = read(tmp_path, f"# {words}\ntime,acc (g)\n{ROWS}")
    assert found.record.dt_s == pytest.approx(0.01 * size, rel=1e-12)


@every("words", ["time in fortnights", "time in s or ms", "time (Hz)"])
def test_a_unit_of_times_that_is_not_understood(tmp_path: Path, words: str) -> None:
    with pytest.raises(RecordFileError, match="line 1, "):
        read(tmp_path, f"# {words}\ntime,acc (g)\n{ROWS}")


def test_words_that_are_not_understood_beside_a_name_are_warned_about(tmp_path: Path) -> None:
    found = read(tmp_path, f"# acc in g or m/s2\ntime (s),acc (g)\n{ROWS}")
    assert "not understood as a whole: the unit of its column 'acc (g)'" in found.warnings[0]
    found = read(tmp_path, f"# dt 0.01 or 0.02 s\ntime (s),acc (g)\n{ROWS}")
    assert "the times of the table are taken" in found.warnings[0]
    text = "t (s),acc x (g),acc y\n0,1.0,1\n0.01,-2.5,1\n0.02,0.5,2\n"
    path = tmp_path / "two.csv"
    path.write_text(text)
    first, second = read_recordings(path)
    assert not first.warnings
    assert "'acc y' states no unit: that of its neighbour is taken" in second.warnings[0]


@every(
    "words",
    [
        *("was in g, now m/s2", "acc in g or m/s2", "not in g", "acc m/s2 cm/s2", "acc in 10 g"),
        *("trigger level 0.01 g", "acc in g (converted from gal)", "acc in g / cm/s2"),
        *("units: s, g, m/s2", "units: s, g, foo"),
    ],
)
def test_two_units_in_one_statement_are_refused(tmp_path: Path, words: str) -> None:
    with pytest.raises(RecordFileError):
        read(tmp_path, f"# {words}\n{ALONE}", dt_s=0.01)
    found = read(tmp_path, f"# {words}\n{ALONE}", dt_s=Fraction(1, 200), units="g")
    assert found.record.dt_s == 0.005


@every(
    "words",
    [
        *("dt 0.01 or 0.02 s", "sampling interval 0.02 s, resampled to 0.01 s", "dt = 0.01-0.02 s"),
        *("dt 0.02 s now 0.01 s", "dt=0.01 s, dt=0.02 s", "dt,0.01\n# 50 sps", "dt 0.01 to 0.02"),
    ],
)
def test_two_intervals_are_refused(tmp_path: Path, words: str) -> None:
    with pytest.raises(RecordFileError, match=r"line [12], "):
        read(tmp_path, f"# {words}\n{ALONE}", units="g")


@every(("words", "dt"), [("dt,0.02", 0.02), ("50 sps", 0.02), ("100 Hz", 0.01)])
def test_intervals_in_few_words(tmp_path: Path, words: str, dt: float) -> None:
    assert read(tmp_path, f"# {words}\n{ALONE}", units="g").record.dt_s == dt
    found = read(tmp_path, f"# {words}\ntime (s),acc (g)\n{ROWS}")
    assert ("its times are 0.01 s apart" in " ".join(found.warnings)) == (dt != 0.01)


@every(("written", "rate"), [("0.005", 199), ("0.0050", 199), ("0.0051", 196), ("0.50", 2.01)])
def test_a_decimal_comma_states_an_interval_as_a_point_does(
    tmp_path: Path, written: str, rate: float
) -> None:
    head = f"# dt {written} s\n# {rate} Hz\n"
    point, comma = (
        read(tmp_path, each + ALONE, units="g") for each in (head, head.replace(".", ","))
    )
    assert point.record == comma.record


@every("words", ["samples 400", "N = 400", "400 points", "points: 400", "400 samples"])
def test_counts_that_the_rows_contradict(tmp_path: Path, words: str) -> None:
    with pytest.raises(RecordFileError, match="states 400"):
        read(tmp_path, f"# {words}\ntime (s),acc (g)\n{ROWS}")
    found = read(tmp_path, f"# {words.replace('400', '3')}\ntime (s),acc (g)\n{ROWS}")
    assert not found.warnings


@every(
    ("old", "new"),
    [
        ("UNITS OF G", "UNITS OF G OR CM/S2"),
        ("UNITS OF G", "UNITS OF G / GAL"),
        ("DT= 0.01000 SEC", "DT= .0100-.02 SEC"),
        ("DT= 0.01000 SEC", "DT= .0100 SEC, DT= .02 SEC"),
        ("DT= 0.01000 SEC", "DT= .0100 OR .02 SEC"),
        ("DT= 0.01000 SEC", "DT= .0100 SEC, NPTS= 7"),
    ],
)
def test_two_values_in_a_file_of_peer(tmp_path: Path, old: str, new: str) -> None:
    text = at2(samples())
    assert old in text
    with pytest.raises(RecordFileError, match=r"line [34], "):
        read(tmp_path, text.replace(old, new))


KNET = knet(np.rint(1e5 * samples(800)).astype(np.int64))


@every(
    ("text", "key", "value"),
    [
        (KNET, "Scale Factor", "7840(gal)/6182761"),
        (KNET, "Sampling Freq(Hz)", "200Hz"),
        (KNET, "Dir.", "U-D"),
        (esm(samples()), "UNITS", "g"),
        (esm(samples()), "NDATA", "7"),
        (esm(samples()), "SAMPLING_INTERVAL_S", "0.02"),
        (esm(samples()), "STREAM", "HNZ"),
    ],
)
def test_a_line_of_a_header_that_is_there_twice(
    tmp_path: Path, text: str, key: str, value: str
) -> None:
    (line,) = (line for line in text.splitlines() if line.startswith(key))
    plain = read(tmp_path, text)
    same = read(tmp_path, text.replace(line, f"{line}\n{line}", 1))
    assert same.record == plain.record
    other = line[: len(key)] + (": " if ":" in line else "   ") + value
    with pytest.raises(RecordFileError, match="states the same with another value"):
        read(tmp_path, text.replace(line, f"{line}\n{other}", 1))


CM = samples(403, peak=150.0)
PEER, ESM, COSMOS, CSMIP, SMC = (
    *(at2(samples(403)), esm(CM), cosmos_channel(CM), csmip_v2_channel(CM), smc(CM)),
)
PEER_COUNTS = "NPTS=    403, DT= 0.01000 SEC"
COLUMN = "".join(f"{value:.6f}\n" for value in samples(403))
TIMES = (
    *((PEER, "DT= 0.01000 SEC", written) for written in ("DT= @", "DT= @ SEC", "DT(s)= @ SEC")),
    *((PEER, ", DT= 0.01000 SEC", "\nDT= @ SEC"), (PEER, PEER_COUNTS, "DT=@, NPTS= 403")),
    *((f"# {words}\n{COLUMN}", "@", "@") for words in ("dt = @", "dt (s) = @", "sampling rate @")),
    *((ESM, ": 0.005000", ": @"), (KNET, "100Hz", "@"), (KNET, "Time(s)  8", "Time(s)  @")),
    *((CSMIP, "spaced at  0.005 sec", "spaced at  @ sec"), (SMC, " 2.0000000E+02", "           @")),
    *((COSMOS, "approx   4 secs", "approx   @ secs"), (COSMOS, "    10.000000", "          @")),
)
ODD_TIMES = (
    *(".02,.04", ".02;.04", "-.02", "nan", "inf", "1e999", "1,000", "1'000", "1_0", ".02*2"),
    *(
        "1/.02",
        ".02(3)",
        ".02[.04]",
        ".02 .04",
        ".02 s .04",
        ".02 .04 SEC",
        ".02 .04 ms",
        ".02 (.04)",
        ".02 +/- .01",
        ".02 or .04",
    ),
    *("2 10-2", "2 x 10-2", ".02 %", ".02%", ".02 s / .04 s", ".02 SEC, .04 SEC", ".02 furlongs"),
)
COUNTS = (
    *((PEER, "    403,", written) for written in (" @,", " @", " @\n")),
    *((f"# {words}\n# dt .01\n{COLUMN}", "@", "@") for words in ("npts = @", "samples: @")),
    *((ESM, "NDATA: 403", "NDATA: @"), (SMC, "       403", "         @")),
    *((CSMIP, "403 points of accel", "@ points of accel"), (COSMOS, "403  acc", "@  acc")),
)
ODD_COUNTS = (
    *("403 100", "403;100", "403,100", "-403", "0", "nan", "inf", "1e999", "4,03", "40,3", "4'03"),
    *("4_03", "403 %", "403%", "403 ms", "403 (1)", "403*1", "403/1", "403.5", "403 +/- 1"),
    *("403 or 404", "403-404", "403..404"),
)
FACTORS = (
    (f"# scale factor: @\n# units: g, dt .01\n{COLUMN}", "@", "@"),
    (PEER, "UNITS OF G\n", "UNITS OF G\n SCALE FACTOR @\n"),
    (ESM, "DATA_TYPE:", "SCALE_FACTOR: @\nDATA_TYPE:"),
    (KNET, "3920(gal)/6182761", "@(gal)/6182761"),
)
ODD_FACTORS = (
    *("1 2", "1,5", "1.5 2", "1'000", "1,000", "1_0", "1;2", "1%", "1 %", "1 per g", "1 V/g"),
    *("-1", "0", "nan", "inf", "1 981", "1(2)", "1.0.2", "1 +/- .1"),
)


@pytest.mark.slow
@every(
    ("places", "odd"),
    [(TIMES, ODD_TIMES), (COUNTS, ODD_COUNTS), (FACTORS, ODD_FACTORS)],
)
def test_a_number_of_a_header_is_one_number_or_refused_with_its_line(
    tmp_path: Path, places: tuple[tuple[str, str, str], ...], odd: tuple[str, ...]
) -> None:
    for text, old, new in places:
        assert old in text
        for written in odd:
            changed = text.replace(old, new.replace("@", written), 1)
            given = {"units": "g"} if text.startswith("# dt") or "npts" in text else {}
            # In CSMIP's files and COSMOS' a line that does not announce samples is none of theirs.
            where = "cannot be read" if text in {CSMIP, COSMOS} else r"line \d+[,:] "
            with pytest.raises(RecordFileError, match=where):
                pytest.fail(f"{new!r} with {written!r} is read: {read(tmp_path, changed, **given)}")


@every("unit", ["mins", "hours", "furlongs"])
def test_a_duration_of_cosmos_in_another_unit(tmp_path: Path, unit: str) -> None:
    text = cosmos_channel(samples(403, peak=150.0), raw_dt=0.01)
    assert " secs" in text
    with pytest.raises(RecordFileError, match=r"no interval of its header|its unit of time is not"):
        read(tmp_path, text.replace(" secs", f" {unit}"))


def test_numbers_of_a_header_that_are_one_number(tmp_path: Path) -> None:
    for written in (
        ".02",
        "+0.02",
        "0,02",
        "2e-2",
        "2D-2",
        "20 ms",
        ".02 s, 403 points",
        ".02 s; x",
    ):
        for text, old, new in TIMES[:1] + TIMES[5:6]:
            found = read(tmp_path, text.replace(old, new.replace("@", written)), units="g")
            assert found.record.dt_s == 0.02, (new, written)
    for written in ("403", "+403", "0403", "403.", "4.03e2", "403 points"):
        for text, old, new in COUNTS[:5]:
            found = read(tmp_path, text.replace(old, new.replace("@", written)), units="g")
            assert len(found.record.acceleration_m_s2) == 403, (new, written)
    thousands = f"# npts = 1,209\n# dt .01\n{3 * COLUMN}"
    assert len(read(tmp_path, thousands, units="g").record.acceleration_m_s2) == 1209


def test_an_interval_of_another_type(tmp_path: Path) -> None:
    path = tmp_path / "table.txt"
    path.write_text(ALONE)
    dt_s: Any = Fraction(1, 200)
    assert read_record(path, units="g", dt_s=dt_s).dt_s == 0.005


def head(*lines: str) -> RecordText:
    return RecordText(path=Path("hut.txt"), lines=lines)


def test_units_of_the_last_digit() -> None:
    for written, place in (
        *(("1", 1.0), ("1.", 1.0), ("10", 1.0), ("1.25", 0.01), ("-0.5", 0.1), (".005", 1e-3)),
        *(("1.5e-3", 1e-4), ("1E2", 100.0), ("1.50D+2", 1.0), ("2d-1", 0.1), ("1e-1234", 1.0)),
        *(("1.5e+003", 100.0), ("1.5e-0003", 0.1)),
    ):
        assert statements.last_place(written) == pytest.approx(place, rel=1e-15), written


def test_times_with_their_units() -> None:
    for written, before, seconds in (
        *((".01", None, 0.01), (".01 s", None, 0.01), ("10 ms", None, 0.01), ("2 min", None, 120)),
        *(("10", "ms", 0.01), ("10 ms", "ms", 0.01), ("100", "Hz", 0.01), ("100 Hz", None, 0.01)),
        *(("0.1 kHz", None, 0.01), ("50 sps", None, 0.02), ("200 samples/s", None, 0.005)),
        *((" 5e-3 (s)", None, 0.005), (".01 SEC, 400 POINTS", None, 0.01), (".01", " ", 0.01)),
        *((",5", None, None), ("0,5", None, 0.5), ("1,25", None, 1.25), ("-0,5", None, None)),
        *(("0", None, None), ("-.01", None, None), ("0 Hz", None, None), ("", None, None)),
    ):
        if seconds is None:
            with pytest.raises(RecordFileError, match=r"line 1, .*; give dt_s, in seconds"):
                statements.time_value(head("dt"), 0, written, before)
        else:
            result = statements.time_value(head("dt"), 0, written, before)
            assert result == pytest.approx(seconds, rel=1e-14), written
    for written, before, words in (
        ("x", None, "it must state a time or a rate above 0"),
        ("0 s", None, "it must state a time or a rate above 0"),
        ("0 Hz", None, "it must state a time or a rate above 0"),
        (".01.2", None, "its number of seconds is not understood as a whole"),
        (".01", "furlongs", "its unit of time is not understood as a whole"),
        (".01 furlongs", None, "its unit of time is not understood as a whole"),
        (".01 s resampled", None, "it states two times"),
        (".01 s times 2", None, "its unit of time is not understood as a whole"),
        (".01 s", "ms", "it states two units of time"),
    ):
        with pytest.raises(RecordFileError, match=f"line 2, .*: {words}; give dt_s, in seconds"):
            statements.time_value(head("", "dt"), 1, written, before)
        value, doubts = statements.interval_value(head("dt"), 0, written, before, 0.01)
        assert value is None
        assert doubts[0].endswith(": 0.01 s, as given, is taken")
        with pytest.raises(RecordFileError):
            statements.interval_value(head("dt"), 0, written, before, None)


def test_intervals_agree_within_the_digits_that_they_are_written_with() -> None:
    for lines, interval in (
        *((("dt = 0.01 s", "100 Hz"), 0.01), (("100 Hz", "dt = 0.01 s"), 0.01), (("hut",), None)),
        *((("dt: 0.0078 s", "128 Hz"), 1 / 128), (("fs: 128", "dt 0.0078125"), 0.0078125)),
        *((("sampling rate: 200 Hz",), 0.005), (("sampling rate = 200",), 0.005)),
        *((("fs (kHz): 0.2",), 0.005), (("time step (ms): 5",), 0.005), (("50 sps",), 0.02)),
        *((("sampling interval: 5 ms", "rate"), 0.005), (("dt = 1 s", "1 Hz"), 1.0)),
    ):
        result = statements.stated_interval(head(*lines), [*range(len(lines))])
        assert result == (None if interval is None else pytest.approx(interval, rel=1e-12)), lines
    # The finest of them is named first, and the line of the other.
    for lines, words in (
        (("dt = 0.01 s", "50 Hz"), "line 1, .*states 0.02 s and 0.01 s between samples|line 2, "),
        (("dt = 0.01000 s", "dt = 0.0102 s"), "line 2, .*states 0.01 s and 0.0102 s between"),
        (("dt = 0.010000 s", "dt = 0.01005 s"), "line [12], .*between samples; take out the line"),
        (("dt = 0.0078 s", "fs: 125.00"), "line [12], .*between samples; take out the line"),
    ):
        with refused("contradiction", words):
            statements.stated_interval(head(*lines), [*range(len(lines))])
    # Few digits leave half a hundredth at most.
    assert statements.stated_interval(head("dt = 0.2 s", "dt = 0.2009 s"), [0, 1]) is not None
    with pytest.raises(RecordFileError):
        statements.stated_interval(head("dt = 0.2 s", "dt = 0.2030 s"), [0, 1])


def test_counts_durations_and_units_of_time_of_words() -> None:
    for lines, count in (
        *((("npts = 403",), (403, 0)), (("", "403 points"), (403, 1)), (("hut",), None)),
        *((("samples: 403", "n = 403"), (403, 0)), (("number of data points: 1,209",), (1209, 0))),
        *((("npts = 7, npts = 7",), (7, 0)), (("N 12",), (12, 0)), (("12 data points",), (12, 0))),
    ):
        assert statements.stated_count(head(*lines), [*range(len(lines))]) == count, lines
    two = "line 3, .*: its header states 7 and 8 samples; take out the line that is wrong"
    with refused("contradiction", two):
        statements.stated_count(head("npts = 7", "n = 7", "8 samples"), [0, 1, 2])
    for written in ("7.5", "7 s", "7 or 8", "x"):
        with pytest.raises(RecordFileError, match="must state a whole number, once; correct the l"):
            statements.count_value(head("npts"), 0, written)
    for lines, duration in (
        (("duration = 40 s",), (40.0, 0.2)),
        (("duration: 40.0 s",), (40.0, 0.05)),
        (("record length (min) 2.00",), (120.0, 0.3)),
        (("duration = 5 s",), (5.0, 0.025)),
        (("significant duration = 5 s", "total length: 12.5"), (12.5, 0.05)),
        (("duration = 5 furlongs", "duration: 8.00 s"), (8.0, 0.005)),
        (("duration = 5 or 6 s",), None),
        (("hut",), None),
    ):
        result = statements.stated_duration(head(*lines), [*range(len(lines))])
        assert result == (None if duration is None else pytest.approx(duration, rel=1e-12)), lines
    for lines, size in (
        *((("time in ms",), 1e-3), (("t (s)",), 1.0), (("start time in ms",), None)),
        *((("time: noon",), None), (("time in ms", "t [ms]"), 1e-3), (("time is in min",), 60.0)),
    ):
        assert statements.stated_time_unit(head(*lines), [*range(len(lines))]) == size, lines
    with pytest.raises(RecordFileError, match=r"line 2, .*states another unit of time; name the c"):
        statements.stated_time_unit(head("time in ms", "t in s"), [0, 1])
    for wrong in ("time in furlongs", "time in Hz", "time in s or ms", "time in s x 10"):
        with pytest.raises(RecordFileError, match="not understood as a whole; name the column"):
            statements.stated_time_unit(head(wrong), [0])


def test_units_that_words_state() -> None:
    for lines, unit in (
        *((("units: cm/s2",), "cm/s^2"), (("acceleration in g",), "g"), (("hut",), None)),
        *((("units: g (9.81 m/s2)",), "g"), (("units: g (9.80 m/s2)",), "g")),
        *(
            (("acc (gal)", "units of cm/s^2"), "gal"),
            (("units: s, g",), "g"),
            (("(0.35 g)",), None),
        ),
        *(
            (("PGA in g: 1", "acc in gal"), "gal"),
            (("units: sec",), None),
            (("units: time",), None),
        ),
        *((("acc in 0.001 g",), "0.001 g"), (("acc in 10^-3 g",), "mg")),
    ):
        result = statements.stated_unit(head(*lines), [*range(len(lines))])
        assert (result is None) == (unit is None), lines
        assert result is None or in_m_s2(result) == in_m_s2(unit or ""), lines
    assert statements.stated_unit(head("acc in g"), [0], explicit=True) is None
    assert statements.stated_unit(head("units: g"), [0], explicit=True) == "g"
    joint = "line 2, .*: its header states g and gal, which are not one unit; take out the line th"
    with refused("contradiction", joint):
        statements.stated_unit(head("acc in g", "acc in gal"), [0, 1])
    for wrong in ("units: furlongs", "units: g (9.7 m/s2)", "acc in g or gal", "was in g"):
        with pytest.raises(RecordFileError, match="its unit is not understood as a whole; give un"):
            statements.stated_unit(head(wrong), [0])


def test_factors_of_words() -> None:
    words = "line 2, .*: a factor on the samples is stated, and whether it is applied already is n"
    for line in ("scale factor 2", "x 10", "acc x 10^3", "gain = 0.5", "values are doubled"):
        with pytest.raises(RecordFileError, match=words):
            statements.refuse_factors(head("hut", line), [0, 1])
        statements.refuse_factors(head("hut", line), [0])
    for line in ("scale factor 1", "scale factor: 1.0", "gain 1.00", "hut x"):
        statements.refuse_factors(head("hut", line), [0, 1])
    statements.refuse_factors(head("hut", "x1 x2"), [0, 1], names=1)
    with pytest.raises(RecordFileError, match=words):
        statements.refuse_factors(head("hut", "x1 x2"), [0, 1], names=0)
    with pytest.raises(RecordFileError, match=words):
        statements.refuse_factors(head("hut", "scale factor 2"), [0, 1], names=1)
