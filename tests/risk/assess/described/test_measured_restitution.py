"""A measured factor of Housner's restitution in object files and tables."""

from pathlib import Path
from typing import Any

import pytest

from rocksteady import Block, read_objects
from rocksteady.errors import InputError
from rocksteady.risk import DescribedObject
from rocksteady.risk.assess.judging import band_of
from tests.every import every

SIZE = {"width_m": 0.4, "height_m": 1.6}


def _object(restitution: object, **geometry: Any) -> DescribedObject:
    values = {"name": "desk", "geometry": {**SIZE, **geometry}, "restitution": restitution}
    return DescribedObject(values=values)


def test_an_object_has_the_factor_of_its_own_value() -> None:
    plain = Block.rectangle(width=0.4, height=1.6)
    found = _object("housner*0.9")
    assert found.block.restitution == 0.9 * plain.restitution
    assert found.block.describe().to_dict()["housner_factor"] == 0.9
    # Both ends of a range have the factor of their own.
    ends = [
        variant.block
        for variant in _object("0.9*housner", width_m={"low": 0.3, "high": 0.5}).variants()
    ]
    for width, block in zip((0.3, 0.5), ends, strict=True):
        own = Block.rectangle(width=width, height=1.6)
        assert block.restitution == pytest.approx(0.9 * own.restitution, rel=1e-15)
    assert band_of(found).ratios(found.block).tolist() == [[found.block.restitution] * 2]
    assert band_of(_object("housner")).draws == 5


def test_a_table_has_it_too(tmp_path: Path) -> None:
    file = tmp_path / "store.csv"
    text = "name,width_m,height_m,restitution\na,0.4,1.6,housner*0.9\nb,0.4,1.6,\n"
    file.write_text(text, encoding="utf-8")
    one, other = read_objects(file)
    assert one.block.restitution == 0.9 * other.block.restitution
    file.write_text(text.replace("housner*0.9", "housner*"), encoding="utf-8")
    with pytest.raises(InputError, match=r"store.csv: line 2: restitution.*housner\*0.965"):
        read_objects(file)


@every("text", ["housner*2", "housner*-1", "housner/2", "Housner*0.9"])
def test_what_is_no_factor_names_the_file(text: str) -> None:
    with pytest.raises(InputError, match=r"^object: .*restitution") as refused:
        _ = _object(text).block
    assert "\n" not in str(refused.value)
