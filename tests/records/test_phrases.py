"""Statements as public files spell them: each alone, above a table or as a column's name."""

from pathlib import Path

import pytest

from rocksteady.errors import RecordFileError
from rocksteady.records import Recording, read_recordings
from tests.every import every

G = 9.80665
ROWS = "1.0\n-2.5\n0.5\n0.25\n"
INTERVALS = [
    *("SAMPLING INTERVAL (sec) : 0.01", "SAMPLING_INTERVAL_S: 0.010000", "#SampleRate(Hz): 100"),
    *("SAMPLING RATE= 100Hz", "SAMPLING FREQUENCY (Hz)    :   100", "dt: 10 ms", "Sample Rate,100"),
    *("INTERVALO DE MUESTREO, C1-C6 (s)       : /0.01/0.01/0.01", "Tasa de muestreo: 100 Hz"),
    *("VEL. DE MUESTREO, C1-C6 (muestras/s)   : /100/100/100", "Frecuencia de muestreo (Hz): 100"),
    *("INTERVALO DE MUESTREO (seg)      : 0.01", "# Tasa de muestreo: 100 muestras/seg"),
    *("NO. OF POINTS: 4   EQUALLY SPACED INTERVALS OF: .01 SEC", "Time Increment (s): 0.01"),
    *("At equally-spaced intervals of   0.010  sec.", "sampling period:       0.010000s"),
    *("# sample_rate_hz: 100", "Passo di campionamento: 0.01 s", "Pas de temps : 0.01 s"),
    *("Frequenza di campionamento: 100 Hz", "Fréquence d'échantillonnage : 100 Hz"),
    *("Abtastrate: 100 Hz", "Zeitschritt: 0.01 s", "Örnekleme frekans\u0131: 100 Hz", "100 sps"),
    "Sampling: every 10 ms",
    *(
        "Örnekleme aral\u0131\u011f\u0131 (sn): 0.01",
        "SAMPLES/SEC=100 FILTER TYPE=NONE ORDER=4",
        "DT (SEC): 0.01",
    ),
]
COUNTS = [
    *("NUMBER OF DATA          : {}", "NDATA: {}", "NUMBER OF SAMPLES : {}", "# sample_count: {}"),
    *("NUM. TOTAL DE MUESTRAS, C1-C6 : /{0}/{0}/{0}", "# Número de muestras: {}", "NPTS= {}"),
    *(
        "NUMERO DE DATOS: {}",
        "NO. OF POINTS =  {}",
        "Numero di campioni: {}",
        "Veri say\u0131s\u0131: {}",
    ),
    *("Nombre de points : {}", "Anzahl der Werte: {}", "# Num. samples: {}"),
]
UNITS = {
    **dict.fromkeys(("G", "g's"), G),
    **dict.fromkeys(("mg", "milli-g"), 1e-3 * G),
    **dict.fromkeys(("%g", "% g"), 1e-2 * G),
    "G/10": 0.1 * G,
    **dict.fromkeys(("gal", "Gal", "gals", "cm/s2", "cm/s^2", "cm/s/s", "CM/SEC/SEC"), 0.01),
    **dict.fromkeys(("cm/sec2", "CM/S**2", "cm/s²", "cm s-2", "cm·s⁻²", "cm/seg2"), 0.01),
    **dict.fromkeys(("M/S**2", "m/s/s", "m/s*s", "m/s2", "m.s-2", "ms-2"), 1.0),
    **dict.fromkeys(("mm/s/s", "mm/sec^2"), 1e-3),
    **dict.fromkeys(("in/s/s", "IN/S2"), 0.0254),
    "FT/S/S": 0.3048,
}
UNIT_LINES = {
    **dict.fromkeys(("UNIDADES DE LOS DATOS    : Gal (cm/s/s)", "DATA UNITS     :  cm/s2"), 0.01),
    **dict.fromkeys(("UNIT  = gal(cm/s/s)", "#AmplitudeUnit:  gal. DCoffset(corr)"), 0.01),
    **dict.fromkeys(("UNCORRECTED ACCELERATION   UNIT: CM/SEC/SEC", "Unidades: cm/s2"), 0.01),
    **dict.fromkeys(("ACCELERATION DATA IN UNITS OF (CM/S/S)", "Unità: cm/s2"), 0.01),
    **dict.fromkeys(("UNITS=CM/SEC**2, CM/SEC, AND CM", "Birim: cm/s²"), 0.01),
    **dict.fromkeys(("Unité : m/s2", "Einheit: m/s²", "units: m/s*s, m/s & s"), 1.0),
    **dict.fromkeys(("# field_unit: UTC, M/S**2", "Accelaration time series in m/s/s"), 1.0),
    "units of G": G,
    "Measure Units,milli-g": 1e-3 * G,
    "ACCELERATION TIME SERIES IN UNITS OF G": G,
    "RAW PGA VALUES (gal) : (N-S) 2.500000": 0.01,
    "Peak acceleration: 2.5 cm/s2 at 0.01 s": 0.01,
}
OTHERS = {
    **dict.fromkeys(("velocity in cm/s", "DATA TYPE=VL", "Units: M/S", "Units: cm/s"), "velocity"),
    **dict.fromkeys(("Velocidad (cm/s)", "Vitesse (m/s)", "Geschwindigkeit"), "velocity"),
    **dict.fromkeys(("DATA_TYPE: DISPLACEMENT", "Units: cm", "Units: M"), "displacement"),
    **dict.fromkeys(("Units: Counts", "units: counts"), "counts"),
    **dict.fromkeys(("Response spectra (5 %)", "PEER DATABASE SPECTRUM."), "spectra"),
    "Fourier amplitude spectrum": "spectra",
}
ACROSS = {
    **dict.fromkeys(("N-S", "NS", "360", "N00E", "360 Deg", "Norte-Sur", "Nord-Sud", "K-G"), 0.0),
    **dict.fromkeys(("HNN", "NORTH", "Nord-Süd", "N", "XX_HUT_00_HNN_M", "N(+)", "南北"), 0.0),
    **dict.fromkeys(("E-W", "EW", "090", "N90E", "90 DEG   (STA CHN: 14)", "EO", "E-O"), 90.0),
    **dict.fromkeys(("HHE", "Este-Oeste", "Ost-West", "O-W", "Est-Ouest", "D-B", "BHE00"), 90.0),
    **dict.fromkeys(("S72W", "N 108 W"), 252.0),
    **dict.fromkeys(("N45°W", "315"), 315.0),
    **dict.fromkeys(("HN1", "BH1.00", "L", "T", "LONG", "TRAN", "H1", "H2", "Transverse"), None),
}
UPRIGHT = [
    *("U-D", "UD", "UP", "Up", "UP       (STA CHN: 15)", "HNZ", "BHZ00", "BHZ.00", "IU.CCM.00.BHZ"),
    *("U", "U(+)", "V", "Z", "VER", "UPDO", "Vert", "Vertical", "verticale", "vertikal", "Düşey"),
    *("Κατακόρυφη", "Вертикальная компонента", "XX.HUT..HNZ", "HUT.HNZ.XX.00"),
    *("HNZ--", "COMP V2", "上下", "竖向", "竖向加速度", "上下方向", "XX_HUT_00_H_N_Z"),
]
TURNED = ["FN", "FP", "SN", "SP", "Fault Normal", "Radial", "RADL", "Tang", "HNR", "HNT", "RotD50"]
LINES = {
    **dict.fromkeys(("STREAM: HNE", "COMP. EW", "orientation of transducer:    EW"), "horizontal"),
    **dict.fromkeys(
        ("Orientation : NS", "090 DEGREES", "COMPONENT=  90", "Bileşen: K-G"), "horizontal"
    ),
    **dict.fromkeys(("# SID: XX_QXA_00_H_N_E", "Componente: N-S", "Component S14E"), "horizontal"),
    **dict.fromkeys(("STREAM: U", "COMP. V", "Component: UP"), "vertical"),
    **dict.fromkeys(("Orient. Z", "SNCL: HUT.HNZ.XX.00"), "vertical"),
    **dict.fromkeys(("Component: QX", "Channel: 3", "Direction: wherever"), "unknown"),
}
PLACES = {
    **dict.fromkeys(
        ("Location: Roof", "Location: Deck - Center", "Location: 5th floor"), "structure"
    ),
    **dict.fromkeys(
        ("Location: Basement", "Location: Dam crest", "Ubicación: Sótano"), "structure"
    ),
    **dict.fromkeys(
        ("1er étage", "çat\u0131", "Primo piano", "Sensor: 3/F", "Dam, left abutment"), "structure"
    ),
    **dict.fromkeys(("Location: Free Field", "OBSERVING POINT: GROUND", "HUT FF"), "surface"),
    **dict.fromkeys(("Location: Downhole 30 m", "Sensor depth (m): 30", "GL-30m"), "borehole"),
    **dict.fromkeys(("Depth: 100 m", "井下 30 m"), "borehole"),
    **dict.fromkeys(("OBSERVING POINT: B2 (-30M)", "SENSOR_DEPTH_M: 30.0"), "borehole"),
    **dict.fromkeys(("Sensor depth (m): 0", "EARTHQUAKE DEPTH (km): 10", "Pacoima Dam"), "unknown"),
}


def read(tmp_path: Path, text: str, **given: object) -> Recording:
    path = tmp_path / "hut.txt"
    path.write_text(text)
    (found,) = read_recordings(path, **given)  # type: ignore[arg-type]
    return found


@every("line", INTERVALS)
def test_intervals(tmp_path: Path, line: str) -> None:
    assert read(tmp_path, f"Hut\n{line}\n{ROWS}", units="g").record.dt_s == pytest.approx(0.01)


@every("line", COUNTS)
def test_counts(tmp_path: Path, line: str) -> None:
    assert not read(tmp_path, f"Hut\n{line.format(4)}\n{ROWS}", units="g", dt_s=0.01).warnings
    with pytest.raises(RecordFileError, match="states 5"):
        read(tmp_path, f"Hut\n{line.format(5)}\n{ROWS}", units="g", dt_s=0.01)


@every(("unit", "size"), [*UNITS.items(), *UNIT_LINES.items()])
def test_units(tmp_path: Path, unit: str, size: float) -> None:
    line = f"Units: {unit}" if unit in UNITS else unit
    found = read(tmp_path, f"Hut\n{line}\n{ROWS}", dt_s=0.01)
    assert found.record.acceleration_m_s2[1] == pytest.approx(-2.5 * size, rel=1e-12)


@every(("line", "quantity"), OTHERS.items())
def test_other_quantities(tmp_path: Path, line: str, quantity: str) -> None:
    for given in ({}, {"units": "g"}):
        with pytest.raises(RecordFileError) as refused:
            read(tmp_path, f"{line}\nHut\n{ROWS}", dt_s=0.01, **given)
        assert refused.value.kind == quantity


@every(("name", "azimuth"), ACROSS.items())
def test_directions_across(tmp_path: Path, name: str, azimuth: float | None) -> None:
    found = read(tmp_path, f"Component: {name}\n{ROWS}", units="g", dt_s=0.01)
    assert (found.orientation, found.azimuth_deg) == ("horizontal", azimuth)


@every("name", UPRIGHT)
def test_directions_upright(tmp_path: Path, name: str) -> None:
    assert (
        read(tmp_path, f"Component: {name}\n{ROWS}", units="g", dt_s=0.01).orientation == "vertical"
    )
    if ":" not in name:
        table = f"time (s);{name} (g);E (g)\n" + "".join(
            f"{k * 0.01:.2f};{k};1\n" for k in range(9)
        )
        path = tmp_path / "table.csv"
        path.write_text(table)
        assert [each.orientation for each in read_recordings(path)] == ["vertical", "horizontal"]


@every(("line", "orientation"), LINES.items())
def test_lines_of_directions(tmp_path: Path, line: str, orientation: str) -> None:
    found = read(tmp_path, f"Hut\n{line}\n{ROWS}", units="g", dt_s=0.01)
    assert found.orientation == orientation
    assert any("is not understood" in words for words in found.warnings) == (
        orientation == "unknown" and "3" not in line
    )


@every(("line", "position"), PLACES.items())
def test_positions(tmp_path: Path, line: str, position: str) -> None:
    assert read(tmp_path, f"Hut\n{line}\n{ROWS}", units="g", dt_s=0.01).position == position
