"""The page's reader of record files against `read_record`: same samples, or one line of refusal."""

import base64
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import RocksteadyError, read_record
from tests.explorer.in_node import InNode
from tests.records import ABSENT, FOLDER, synthetic

READ = """
const { readMotion } = await import(parts('physics/quake/recordfile.mjs'));
answer(asked.map(({ name, bytes, unit }) => {
  const held = new Uint8Array(Buffer.from(bytes, 'base64'));
  const found = readMotion(kernels, { name, unit, bytes: held });
  if (!found.motion) return found;
  const { samples, dt, doubts } = found.motion;
  const text = Buffer.from(samples.buffer).toString('base64');
  return { name: found.motion.name, dt, doubts, samples: text };
}));
"""
FEW = "0,0\n0.01,0.2\n0.02,-0.1\n0.03,0.05\n"
PEER = (
    "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/2/1990, Hut, 090\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   10, DT=   .0100 SEC,\n"
)
SAMPLES = "  .1000000E-02 -.2000000E-02  .3000000E-02 -.4000000E-02  .5000000E-02\n"


def read(in_node: InNode, files: Mapping[str, bytes], unit: str = "") -> dict[str, Any]:
    """Return what the page makes of files, by their names."""
    asked = [
        {"name": name, "bytes": base64.b64encode(data).decode("ascii"), "unit": unit}
        for name, data in files.items()
    ]
    return dict(zip(files, in_node(READ, asked), strict=True))


def is_as_read(found: dict[str, Any], path: Path, unit: str = "") -> None:
    """Compare an accepted motion with what the package reads, all bits."""
    record = read_record(path, **({"units": unit} if unit else {}))  # type: ignore[arg-type]
    assert found["dt"] == record.dt_s, path.name
    assert base64.b64decode(found["samples"]) == record.acceleration_m_s2.tobytes(), path.name


def numbered(texts: Mapping[str, str | bytes]) -> dict[str, bytes]:
    """Return files of texts, with names that hold no odd letters."""
    return {
        f"{number:03} {name}.csv": text if isinstance(text, bytes) else text.encode()
        for number, (name, text) in enumerate(texts.items())
    }


def longer(step: str = "0.01", count: int = 60, form: str = "{:.5f}") -> list[tuple[str, str]]:
    draw = np.random.default_rng(3)
    values = synthetic(draw, count, float(step), 0.4)
    decimals = len(step.partition(".")[2])
    times = [f"{k * float(step):.{decimals}f}" for k in range(count)]
    return list(zip(times, map(form.format, values.tolist()), strict=True))


def table(rows: list[tuple[str, str]], between: str = ",", head: str = "time (s),acc (g)") -> str:
    return "\n".join([head, *(between.join(row) for row in rows)]) + "\n"


GOOD: dict[str, str | bytes] = {
    "names with units": "time (s),acceleration (g)\n" + FEW,
    "crlf": ("time (s),acc (m/s2)\n" + FEW).replace("\n", "\r\n"),
    "cr": ("time (s),acc (gal)\n" + FEW).replace("\n", "\r"),
    "crcrlf": ("time [s];acc [cm/s^2]\n" + FEW.replace(",", ";")).replace("\n", "\r\r\n"),
    "byte order mark": b"\xef\xbb\xbf" + ("Time,Acc (g)\n" + FEW).encode(),
    "utf-16": ("t (s),a (g)\n" + FEW).encode("utf-16"),
    "utf-16 big": b"\xfe\xff" + ("t (s),a (g)\n" + FEW).encode("utf-16-be"),
    "comment mark": "# time (s), acc (g)\n" + FEW,
    "quoted names": '"time (s)","acceleration (g)"\n' + FEW,
    "quoted numbers": 'time (s),acc (g)\n"0","0.1"\n"0.5","0.2"\n',
    "blanks": "time(s)   acc(g)\n  0.00   0.0\n  0.01   0.2\n  0.02  -0.1\n",
    "tabs": "time_s\tacc_g\n" + FEW.replace(",", "\t"),
    "milliseconds": "time (ms),acc (m/s^2)\n0,1\n5,2\n10,-3\n",
    "decimal comma": "time (s);acc (g)\n0;0,5\n0,01;-0,25\n0,02;1\n",
    "decimal comma, blanks": "time(s)  acc(g)\n0,00  0,5\n0,01  -0,25\n0,02  1,0\n",
    "times last": "acc (g),time (s)\n0.1,0\n0.2,0.01\n0.3,0.02\n",
    "no end of the last line": "time (s),acc (g)\n" + FEW.rstrip(),
    "padding": ("time (s),acc (g)\n" + FEW).encode() + b"\x00\x00\x1a",
    "blank lines": "\n\ntime (s),acc (g)\n\n" + FEW.replace("\n", "\n\n"),
    "separator at the end": "time (s),acc (g),\n" + FEW.replace("\n", ",\n"),
    "Fortran": "time (s) acc (g)\n0.0D0 1.0D-1\n1.0D-2 2.0D-1\n",
    "two samples": "time (s),acc (g)\n0,1\n0.02,0\n",
    "late start": "time (s),acc (g)\n5,1\n5.25,0\n5.5,-1\n",
    "thirds": table(longer("0.0333333")),
    "coarse times": table([(f"{k / 128:.2f}", value) for k, (_, value) in enumerate(longer())]),
    "256 Hz": table([(f"{k / 256:.4f}", value) for k, (_, value) in enumerate(longer())]),
    "200 Hz in few digits": table([(f"{k * 0.005:.3g}", v) for k, (_, v) in enumerate(longer())]),
    "float32 times": table(
        [(repr(float(np.float32(k * 0.01))), v) for k, (_, v) in enumerate(longer())]
    ),
    "unlike decimals": table([(t, repr(float(v))) for t, v in longer()]),
    "AT2": PEER + 2 * SAMPLES,
    "AT2 crlf": (PEER + 2 * SAMPLES).replace("\n", "\r\n"),
    "AT2 run together": PEER + 2 * " .1-.2 .3-.4E-02-.5\n",
    "AT2 letterless exponent": PEER + 2 * " 0.1234-105 .2 .3 .4 .5\n",
    "AT2 numbers first": PEER.replace("NPTS=   10, DT=   .0100 SEC,", "10 .01 NPTS, DT")
    + 2 * SAMPLES,
    "AT2 small letters": PEER.replace(", DT=", ", dt=") + 2 * SAMPLES,
    "AT2 filter": PEER.replace("OF G", "OF G. FILTER POINTS: HP=0.2 Hz LP=25.0 Hz") + 2 * SAMPLES,
    "AT2 downwards": PEER.replace("090", "DWN") + 2 * SAMPLES,
    "AT2 surplus": PEER + 3 * SAMPLES,
    "AT2 short last line": PEER.replace("10,", " 7,") + SAMPLES + SAMPLES[:29] + "\n",
}
ASKED: dict[str, str | bytes] = {
    "no names": FEW,
    "names without units": "time,acceleration\n" + FEW,
    "no names, blanks": FEW.replace(",", "   "),
    "AT2 without its unit": PEER.replace("ACCELERATION TIME SERIES IN UNITS OF G", "")
    + 2 * SAMPLES,
}
BAD: dict[str, str | bytes] = {
    "empty": "",
    "blank": " \r\n\t\n",
    "zeros": b"\x00" * 4000,
    "binary": bytes(range(256)) * 20,
    "picture": b"\x89PNG\r\n\x1a\n" + bytes(200),
    "words": "no numbers in this\nand none here\n",
    "html": "<!doctype html><script>alert(1)</script>\n<img src=x onerror=alert(1)>\n",
    "names alone": "time (s),acc (g)\n",
    "one sample": "time (s),acc (g)\n0,1\n",
    "nan": "time (s),acc (g)\n0,0\n0.01,nan\n0.02,1\n",
    "infinite": "time (s),acc (g)\n0,0\n0.01,1e999\n0.02,1\n",
    "nan last": "time (s),acc (g)\n" + FEW + "0.04,NaN\n",
    "underscore": "time (s),acc (g)\n0,1_0\n0.01,1\n",
    "other digits": "time (s),acc (g)\n0,\u0661\n0.01,1\n",
    "hexadecimal": "time (s),acc (g)\n0,0x10\n0.01,1\n",
    "all zero": "time (s),acc (g)\n0,0\n0.01,0\n0.02,0\n",
    "short row": "time (s),acc (g)\n0,0\n0.01\n0.02,1\n",
    "long row": "time (s),acc (g)\n0,0\n0.01,1,2\n0.02,1\n",
    "words inside": "time (s),acc (g)\n0,0\nbreak,here\n0.02,1\n",
    "uneven": "time (s),acc (g)\n0,0\n0.01,1\n0.05,2\n0.06,1\n",
    "gap": table([row for k, row in enumerate(longer()) if k != 30]),
    "back in time": "time (s),acc (g)\n0,0\n0.02,1\n0.01,2\n0.03,1\n",
    "one time": "time (s),acc (g)\n1,0\n1,1\n1,2\n",
    "no times": "1.5,2\n-3,1\n2,0.5\n-1,1\n",
    "one column": "0.1\n0.2\n0.3\n",
    "three columns": "time (s),acc (g),acc2 (g)\n0,1,1\n0.01,2,2\n",
    "velocity": "time (s),velocity (m/s)\n" + FEW,
    "spectrum": "period (s),SA (g)\n" + FEW,
    "factor in the name": "time (s),1000*acc (g)\n" + FEW,
    "unknown unit": "time (s),acc (furlongs)\n" + FEW,
    "two units": "time (s),acc g (m/s2)\n" + FEW,
    "count above": "4 0.01\n0 0\n0.01 1\n0.02 2\n0.03 1\n",
    "huge": "time (s),acc (g)\n0,0\n0.01,5000\n0.02,1\n",
    "AT2 velocity": PEER.replace("ACCELERATION TIME SERIES", "VELOCITY TIME SERIES") + 2 * SAMPLES,
    "AT2 velocity in cm/s": PEER.replace("ACCELERATION TIME SERIES IN UNITS OF G",
                                         "VELOCITY TIME SERIES IN UNITS OF CM/S") + 2 * SAMPLES,
    "AT2 too few": PEER + SAMPLES,
    "AT2 nan": PEER + SAMPLES + SAMPLES.replace(".3000000E-02", "NaN"),
    "AT2 other count": PEER.replace("10", "1") + 2 * SAMPLES,
    "AT2 fraction": PEER.replace("10,", "9.5,") + 2 * SAMPLES,
    "AT2 zero interval": PEER.replace(".0100", ".0000") + 2 * SAMPLES,
    "AT2 factor": PEER.replace("OF G", "OF G, MULTIPLIED BY 981") + 2 * SAMPLES,
    "AT2 other unit of time": PEER.replace("SEC", "MIN") + 2 * SAMPLES,
    **{
        f"AT2 {old} {new}": PEER.replace(old, new) + 2 * SAMPLES
        for old, new in (
            *[(".0100", odd) for odd in (".01 .02", ".01,.02", ".01 or .02", "0,01", "nan")],
            *[("  10,", odd) for odd in ("10 5,", "1'0,", "1,0,", "10 %,", "-10,", "1e999,")],
        )
    },
    "AT2 with times": PEER + "".join(f"{k * 0.01:.2f} 0.001\n" for k in range(8)),
    "AT2 cut": (PEER.replace("10,", "100,") + 20 * SAMPLES)[:-8],
}  # fmt: skip


def written(folder: Path, files: Mapping[str, bytes]) -> dict[str, Path]:
    for name, data in files.items():
        (folder / name).write_bytes(data)
    return {name: folder / name for name in files}


def test_good_files_give_the_samples_of_the_package(in_node: InNode, tmp_path: Path) -> None:
    files = numbered(GOOD)
    paths = written(tmp_path, files)
    for name, found in read(in_node, files).items():
        assert "refused" not in found, (name, found)
        is_as_read(found, paths[name])


@pytest.mark.parametrize("unit", ["g", "m/s2", "cm/s2"])
def test_a_unit_that_is_not_stated_is_asked_for(in_node: InNode, tmp_path: Path, unit: str) -> None:
    files = numbered(ASKED)
    paths = written(tmp_path, files)
    for name, found in read(in_node, files).items():
        assert found["asks"] == "unit", (name, found)
        with pytest.raises(RocksteadyError):
            read_record(paths[name])
    for name, found in read(in_node, files, unit).items():
        is_as_read(found, paths[name], unit)


def test_a_unit_that_is_stated_is_not_overruled(in_node: InNode) -> None:
    files = numbered({"stated": GOOD["names with units"]})
    (one,), (other,) = (read(in_node, files, unit).values() for unit in ("", "m/s2"))
    assert one == other


def test_bad_files_are_refused_in_one_line(in_node: InNode) -> None:
    for name, found in read(in_node, numbered(BAD)).items():
        assert set(found) == {"refused"}, name
        assert "\n" not in found["refused"]
        assert "rocksteady explore --record" in found["refused"]
        assert len(found["refused"]) < 400


def test_files_made_to_keep_a_reader_busy_are_refused(in_node: InNode) -> None:
    # Each takes minutes where a step looks at the rest of a text from every place in it.
    many = 400_000
    files = {
        "returns": "\r" * many + "x",
        "blanks": "a" + " " * many + "x",
        "empty lines": "1 2" + " \n" * many + "x",
        "digits": "a\nNPTS= " + "1" * many + "x\n",
        "blanks after dt": "NPTS= 5, DT= 1" + " " * many + "x\n1 2\n",
        "quotes": "x," + '"' * many + "a\n1,2\n",
        "brackets": "a\nb," + "(" * many + "\nNPTS= 2, DT= 1\n1 2\n",
    }
    for name, found in read(in_node, numbered(files)).items():
        assert "refused" in found, name


def test_what_is_refused_by_the_package_is_refused_here(in_node: InNode, tmp_path: Path) -> None:
    """Mutations: a letter lost, doubled or changed; whoever reads it here reads it there alike."""
    draw = np.random.default_rng(25)
    files = {}
    letters = list("0123456789.,;-+eEdDx*/()\n\r\t \"'#%gs")
    everything = [*GOOD.values(), *ASKED.values()]
    for number in range(1500):
        given = everything[number % len(everything)]
        data = bytearray(given.encode() if isinstance(given, str) else given)
        for _ in range(draw.integers(1, 4)):
            at = int(draw.integers(len(data)))
            with_what = ord(draw.choice(letters))
            match draw.integers(3):
                case 0:
                    del data[at]
                case 1:
                    data.insert(at, with_what)
                case _:
                    data[at] = with_what
        files[f"{number:04}.csv"] = bytes(data)
    paths = written(tmp_path, files)
    accepted = 0
    for name, found in read(in_node, files).items():
        if "refused" not in found:
            is_as_read(found, paths[name])
            accepted += 1
    assert accepted > 150, "or little is tested"


@pytest.mark.slow
def test_real_files_give_the_samples_of_the_package(in_node: InNode) -> None:
    paths = [path for path in sorted(FOLDER.glob("*/*")) if path.suffix.lower() in (".at2", ".csv")]
    if not paths:
        pytest.skip(ABSENT)
    paths = paths[::3]
    found = read(in_node, {path.name: path.read_bytes() for path in paths})
    for path in paths:
        assert "refused" not in found[path.name], found[path.name]
        is_as_read(found[path.name], path)


def test_files_of_other_networks_are_refused(in_node: InNode) -> None:
    paths = [*sorted(FOLDER.glob("formats/*")), *FOLDER.glob("other/*")]
    if not paths:
        pytest.skip(ABSENT)
    found = read(in_node, {path.name: path.read_bytes() for path in paths})
    assert all(set(each) == {"refused"} for each in found.values())


NAMES = [
    "<img src=x onerror=alert(1)>.csv",
    '"></script><script>alert(1)</script>.csv',
    "a" * 4000 + ".csv",
    "\u202egpj.exe\u2066.csv",
    "\u0000\u001b[31m\r\n.csv",
    "\ud83d\ude00" * 200,
    "   ",
    "../../etc/passwd",
    "__proto__",
]


def test_hostile_names_are_shown_short_and_plain(in_node: InNode) -> None:
    lines = """
    const file = await import(parts('physics/quake/recordfile.mjs'));
    const { plainName, readMotion, refusedUnread } = file;
    answer(asked.map((name) => [plainName(name), refusedUnread(name, 1e8), refusedUnread(name, 10),
      readMotion(kernels, { name, bytes: new TextEncoder().encode('1,2,3') }).refused]));
    """
    for name, (shown, large, small, refused) in zip(NAMES, in_node(lines, NAMES), strict=True):
        assert 0 < len(shown.encode("utf-16-le")) // 2 <= 90
        assert shown.isprintable()
        assert large.startswith(f"{shown}: 100 MB")
        assert small == ""
        assert refused.startswith(f"{shown}: ")
        assert refused.isprintable()
        assert shown == name or name != "<img src=x onerror=alert(1)>.csv"
