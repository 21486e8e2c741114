"""Files in the forms of networks and tools, with what is right of each; and every hint followed.

The files and their expected values lie beside the project, in ``shared/cases``.
"""

import json
import re
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, pair_records, read_recordings
from rocksteady.records.suite import read_records
from tests.every import every

CASES = Path(__file__).parents[3] / "shared" / "cases"
ABSENT = "no files in ../shared/cases"
READ: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "afad-asc-start-time/20010101011734_9999_mp_RawAcc_E.asc": ({}, ()),
    "afad-nsmn-txt/20010101223109_9999.txt": ({}, ("without_options", "channels")),
    "csmip-v2-sta-chn/STATION.V2": ({}, ("channels",)),
    "cwa-tsmip/1-AAA.dat": ({}, ("channels",)),
    "iris-slist-units/slist.txt": ({}, ("slist.txt",)),
    "isesd-cor-acc/99999_H1.cor.acc": ({}, ()),
    "opensees-rockingbc-record/Somewhere.dat": ({}, ()),
    "peer-header-variants/acc_in_brackets.AT2": ({}, ("both",)),
    "peer-header-variants/npts_before_unit.AT2": ({}, ("both",)),
    "scale-and-dt-lines/scale_dt.txt": (
        {"units": "g", "dt_s": 0.005},
        ("scale_dt.txt --units g --dt-s 0.005", "either"),
    ),
    "scale-and-dt-lines/n_dt.txt": ({"units": "m/s^2"}, ("n_dt.txt --units m/s^2", "either")),
    "tspp-smc/A.AT2.smc": ({"units": "cm/s^2"}, ("or_with_units_cm/s^2",)),
    "unam-asa2/AAAA0101.011": ({}, ("channels",)),
    "usgs-three-blocks/usaca40.044": ({}, ("either",)),
}
"""Options that a file needs, and where its channels stand in what is expected."""
REFUSED = {
    "bbp-velocity/999.vel.bbp": "velocity",
    "csmip-v3-spectra/S.V3": "spectra",
    "iris-slist-units/counts.txt": "counts",
}
UNEVEN = "smc-uneven-equal-times/uneven.smc"


def case(name: str) -> Path:
    path = CASES / name
    if not path.is_file():
        pytest.skip(ABSENT)
    return path


def expected(name: str) -> list[dict[str, Any]]:
    part = json.loads(case(name).with_name("expected.json").read_text())["expect"]
    for key in READ[name][1]:
        part = part[key]
    return part if isinstance(part, list) else [part]


def compare(found: Recording, right: dict[str, Any]) -> None:
    """Compare a recording with whatever is expected of it."""
    values, dt_s = found.record.acceleration_m_s2, found.record.dt_s
    assert (len(values), dt_s) == (right["npts"], right["dt_s"])
    tolerance = right.get("tolerance_rel", 1e-6)
    peak = float(values[np.abs(values).argmax()])
    if "peak_at_s" in right:
        peak = float(values[round(right["peak_at_s"] / dt_s)])
        assert peak == pytest.approx(right["peak_m_s2"], rel=tolerance)
    assert np.abs(values).max() == pytest.approx(abs(right["peak_m_s2"]), rel=tolerance)
    for key, value in {
        "component": found.component,
        "orientation": found.orientation,
        "azimuth_deg": found.azimuth_deg,
        "unit": found.units_in_file,
    }.items():
        assert value == right.get(key, value)
    if "start_time" in right:
        stated = datetime.fromisoformat(right["start_time"])
        assert found.start_time is not None
        assert found.start_time.replace(tzinfo=stated.tzinfo) == stated
    if "station" in right:
        assert found.station in right["station"]


def same(found: tuple[Recording, ...], right: list[dict[str, Any]]) -> None:
    assert len(found) == len(right)
    for each, channel in zip(found, right, strict=True):
        compare(each, channel)


@every("name", READ)
def test_a_file_is_read_as_it_states(name: str) -> None:
    same(read_recordings(case(name), **READ[name][0]), expected(name))


@every(("name", "kind"), REFUSED.items())
def test_what_is_no_acceleration_is_refused_whatever_is_asked(name: str, kind: str) -> None:
    for options in ({}, {"units": "cm/s^2"}, {"units": "cm/s^2", "dt_s": 0.02, "resample": True}):
        with pytest.raises(RecordFileError) as refused:
            read_recordings(case(name), **options)
        assert refused.value.kind == kind
        assert kind in str(refused.value)
        assert not re.search(r"units|dt_s|damaged|resample", refused.value.hint)


def test_uneven_times_are_no_samples() -> None:
    pairs = np.array(
        re.findall(r"[ -]\d\.\d{4}E[+-]\d", case(UNEVEN).read_text().split("|")[-1]), dtype=float
    )
    for dt_s in (None, 0.0014):
        with pytest.raises(RecordFileError, match=r"most are 0\.0005 s apart; ask for resampling"):
            read_recordings(case(UNEVEN), dt_s=dt_s)
        (found,) = read_recordings(case(UNEVEN), dt_s=dt_s, resample=True)
        record = found.record
        assert record.peak_acceleration_m_s2 == pytest.approx(1.8582, rel=0.02)
        times = np.arange(len(record.acceleration_m_s2)) * record.dt_s
        times, uneven = times[times > 12.3], pairs[0::2]
        between = np.interp(
            times,
            uneven[np.r_[True, np.diff(uneven) > 0]] - uneven[0],
            0.01 * pairs[1::2][np.r_[True, np.diff(uneven) > 0]],
        )
        near = np.abs(record.acceleration_m_s2[-len(times) :] - between)
        assert near.max() < 0.1 * record.peak_acceleration_m_s2


def test_stations_of_one_file_and_of_three() -> None:
    for name in ("csmip-v2-sta-chn/STATION.V2", "peer-seed-channel/RSN9_Town_IU.CCM.BHZ.00.AT2"):
        files = sorted(each for each in case(name).parent.iterdir() if each.suffix != ".json")
        suite = read_records(case(name).parent)
        assert len(suite) == 2
        assert [(each.kind, each.channel) for each in suite.left_out if each.channel] == [
            ("vertical", "UP" if len(files) == 1 else "BHZ00")
        ]
        assert [each.file.name for each in suite.left_out if each.kind == "no record"] == [
            "expected.json"
        ]
        (one,) = pair_records(files)
        assert (len(one.horizontal), one.vertical is not None) == (2, True)


WRONG: tuple[dict[str, Any], ...] = (
    {},
    {"units": "mg"},
    {"dt_s": 0.0031},
    {"units": "mg", "dt_s": 0.0031},
)


def truth(name: str) -> dict[str, Any]:
    """Return what somebody who knows the file would give for an option that a hint asks for."""
    right = expected(name)[0] if name in READ else {"dt_s": 0.02}
    given = READ.get(name, ({}, ()))[0].get("units", "cm/s^2")
    return {"units": right.get("unit", given), "dt_s": right["dt_s"]}


def followed(options: dict[str, Any], hint: str, known: dict[str, Any]) -> dict[str, Any] | None:
    """Return the options that a hint asks for, followed to the letter; None where it has none."""
    if "leave out" in hint:
        word = re.search(r"leave out (\w+)", hint)
        assert word is not None
        return {key: value for key, value in options.items() if key != word[1]}
    if asked := re.search(r"give (units|dt_s)", hint):
        return options | {asked[1]: known[asked[1]]}
    return options | {"resample": True} if "resample" in hint else None


@every("name", [*READ, *REFUSED, UNEVEN])
def test_a_hint_that_is_followed_leads_to_the_motion(name: str) -> None:
    for start in WRONG:
        options: dict[str, Any] | None = dict(start)
        for _ in range(5):
            assert options is not None
            try:
                found = read_recordings(case(name), **options)
            except RecordFileError as error:
                options = followed(options, error.hint, truth(name))
                if options is None:
                    assert name in REFUSED
                    break
                continue
            if "mg" in options.values():
                assert "units" in READ[name][0]  # the file states none
            elif name == UNEVEN:
                assert found[0].record.peak_acceleration_m_s2 == pytest.approx(1.8582, rel=0.02)
            else:
                same(found, expected(name))
            break
        else:
            pytest.fail(f"{name} {start}: the hints lead nowhere")


@every("name", READ)
def test_the_samples_alone_by_the_options(name: str) -> None:
    right = expected(name)
    given = truth(name)
    if "V2" in name or "usgs" in name:
        # Several channels below each other: which is which stands in the headers alone.
        with pytest.raises(RecordFileError, match="several blocks of numbers"):
            read_recordings(case(name), ignore_header=True, **given)
        return
    found = read_recordings(case(name), ignore_header=True, **given)
    assert found[0].processing[0].startswith("header ignored: the numbers from line")
    if not name.startswith("scale-and-dt-lines"):  # whose first lines are then samples
        for each, channel in zip(found, right, strict=True):
            assert each.record.peak_acceleration_m_s2 == pytest.approx(abs(channel["peak_m_s2"]))
            assert (len(each.record.acceleration_m_s2), each.record.dt_s) == (
                channel["npts"],
                channel["dt_s"],
            )
