"""Tables of surveyed objects: words for outcomes, facings, and one line for each fault."""

import hashlib
from pathlib import Path

import numpy as np
import pytest

from rocksteady import RocksteadyError, read_survey
from rocksteady.errors import InputError
from rocksteady.risk.back_analysis.synthetic_survey import make_synthetic_survey
from tests.every import every

HEADER = "name,width_m,height_m,base,outcome,reversed,photo\n"
GOOD = (
    HEADER
    + "A,0.20:0.22,0.8,1,stood,,1.jpg\n"
    + "B,0.2,1.2+-0.02,0.8:1.0,FELL,yes,\n"
    + "C,0.2,1.4,1,toppled,no,\n"
)


def written(folder: Path, text: str | bytes) -> Path:
    file = folder / "cemetery.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def test_a_table_is_read(tmp_path: Path) -> None:
    file = written(tmp_path, GOOD)
    survey = read_survey(file)
    assert survey.fell == (False, True, True)
    assert survey.reversed == (None, True, False)
    assert [each.name for each in survey.objects] == ["A", "B", "C"]
    assert str(survey.objects[0].spreads["width_m"]) == "0.2:0.22"
    assert survey.objects[1].spreads["height_m"].sd == 0.02
    assert survey.sources == {"cemetery.csv": hashlib.sha256(file.read_bytes()).hexdigest()}
    assert len(survey) == 3
    assert survey.outcomes.tolist() == [0.0, 1.0, 1.0]


@every(
    ("text", "words"),
    [
        ("", "cemetery.csv"),
        (HEADER, "has 0 objects"),
        (GOOD.replace("outcome", "result"), "no column outcome"),
        (GOOD.replace("outcome", "outcom"), "did you mean outcome"),
        (GOOD.replace("photo", "fell_side"), "side that an object fell to"),
        (GOOD.replace("photo", "direction_deg"), "side that an object fell to"),
        (GOOD.replace("stood", "stod"), "line 2, outcome = 'stod'"),
        (GOOD.replace("stood", ""), "line 2, outcome is empty"),
        (GOOD.replace("yes", "perhaps"), "line 3, reversed = 'perhaps'"),
        (GOOD.replace("\nB,", "\nA,"), "line 2 has it too"),
        (GOOD.replace("0.20:0.22", "0.22:0.20"), "line 2, width_m"),
        (GOOD.replace("1.4", "1400"), "write 0.6 for 600 mm"),
        (GOOD.replace("0.8,1,", "0.8,1"), "line 2"),
        (GOOD.encode() + b"\xff", "UTF-8"),
        (GOOD.replace("1.4", "1\0"), "zero byte"),
    ],
)
def test_a_fault_is_named_in_one_line(tmp_path: Path, text: str | bytes, words: str) -> None:
    with pytest.raises(RocksteadyError) as caught:
        read_survey(written(tmp_path, text))
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="survey"):
        read_survey(tmp_path / "none.csv")
    with pytest.raises(InputError, match="survey"):
        read_survey(tmp_path)


def test_the_objects_of_a_made_survey_fill_their_ranges_and_the_slender_fall() -> None:
    survey = make_synthetic_survey(200)
    sizes = [(str(each.width_m), str(each.height_m)) for each in survey.objects]
    width, height = (
        np.array([np.mean([float(end) for end in pair[k].split(":")]) for pair in sizes])
        for k in (0, 1)
    )
    for values, low, high in ((height, 0.5, 1.6), (height / width, 2.5, 6.0)):
        assert low <= values.min() < 1.05 * low < 0.95 * high < values.max() <= high
    fell = np.array(survey.fell)
    assert (width / height)[fell].max() < (width / height)[~fell].min()
