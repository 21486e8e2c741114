"""Tables of objects: cells, ranges, separators, further columns, and the line of each fault."""

from pathlib import Path

import pytest

from rocksteady.errors import RocksteadyError
from rocksteady.model.blocks.block import Block
from rocksteady.risk.assess.described.facts import compute_object_facts
from rocksteady.risk.assess.described.tables import read_objects
from tests.every import every


def written(tmp_path: Path, text: str | bytes) -> Path:
    file = tmp_path / "store.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def test_an_object_has_its_place_and_its_demand(tmp_path: Path) -> None:
    text = "name,width_m,height_m,building,floor,pga_g\na,0.3,1.5,museum,2,0.3\nb,0.2,1,,attic,\n"
    first, second = read_objects(written(tmp_path, text))
    assert (first.label, second.label) == ("a on floor 2 of museum", "b in attic")
    assert (first.demand.pga_g, second.demand.pga_g) == (0.3, None)


def test_objects_keep_their_order_their_ranges_and_their_further_columns(tmp_path: Path) -> None:
    text = (
        "name,room,width_m,height_m,friction,mass_kg,content_mass_kg,content_mass_centre_height_m,"
        "fixed_parts\n"
        '"vase, blue",4,0.12,0.5,,,,,\n'
        "\n"
        "cask,cellar,0.6:0.7,1.1,0.3:0.5,40,200,0.5,yes\n"
    )
    vase, cask = read_objects(written(tmp_path, text))
    assert vase.name == "vase, blue"
    assert vase.block == Block.rectangle(width=0.12, height=0.5)
    assert vase.given.friction is None
    assert [dict(each.extra) for each in (vase, cask)] == [{"room": "4"}, {"room": "cellar"}]
    assert cask.block.width == pytest.approx(0.65)
    assert cask.body.mass_kg == pytest.approx(240.0)
    assert cask.block.parts == "object and content"
    with pytest.raises(
        RocksteadyError, match="line 4: fixed_parts is not true: object and content"
    ):
        read_objects(written(tmp_path, text.replace("yes", "no")))
    with pytest.raises(RocksteadyError, match=r"fixed_parts = 'perhaps' .* write yes where it is"):
        read_objects(written(tmp_path, text.replace("yes", "perhaps")))
    assert [variant.key for variant in cask.variants()] == ["geometry.width_m"] * 2
    assert cask.source == "store.csv: line 4"
    assert vase.sha256 == cask.sha256


@every("separator", [",", ";", "\t"])
@every("end", ["\n", "\r\n"])
def test_a_spreadsheet_may_separate_and_end_lines_its_way(
    separator: str, end: str, tmp_path: Path
) -> None:
    lines = [("name", "width_m", "height_m"), ("a", "0.3", "1.5"), ("b", "0.2", "1")]
    text = end.join(separator.join(line) for line in lines) + end
    found = read_objects(written(tmp_path, "\ufeff" + text))
    assert [each.block for each in found] == [
        Block.rectangle(width=0.3, height=1.5),
        Block.rectangle(width=0.2, height=1.0),
    ]


@every(
    ("text", "line"),
    [
        ("", "store.csv is empty"),
        ("name,width_m,height_m\n", "store.csv has 0 objects"),
        ("width_m,height_m\n0.3,1\n", "line 1 has no column name"),
        ("name,width_mm,height_m\na,300,1\n", "column 2 = 'width_mm' is not valid"),
        ("name,width_mm,height_m\na,300,1\n", "did you mean width_m? else give it another name"),
        ("name,Height_m,width_m\na,1,0.3\n", "did you mean height_m?"),
        ("name,width_m,width_m\na,1,2\n", "column 3 = 'width_m' is not valid: it occurs twice"),
        ("name,,width_m\na,1,2\n", "give it a name"),
        ("name,width_m,height_m,pga_g\na,1,2,-1\n", "[demand] pga_g = -1.0 is not valid"),
        ("name,width_m,height_m\na,0.3\n", "line 2 has 2 cells: the first line names 3 columns"),
        ("name,width_m,height_m\na,0.3 m,1\n", "line 2, width_m = '0.3 m' is not valid"),
        ('name;width_m;height_m\na;"0,3";1\n', "write a point for a decimal comma"),
        ("name,width_m,height_m\na,0.3:0.4:0.5,1\n", "it must be a number, or a range as 0.3:0.5"),
        ("name,width_m,height_m\na,nan,1\n", "line 2, width_m = 'nan' is not valid"),
        ("name,width_m,height_m\na,,1\n", "line 2: [geometry] width_m is missing"),
        ("name,width_m,height_m\na,,\n", "line 2: [geometry] has no size"),
        ("name,width_m,height_m\n,0.3,1\n", "line 2: name is missing"),
        ("name,width_m,height_m\na,600,1800\n", "write 0.6 for 600 mm"),
        ("name,width_m,height_m\na,0.3,1\n\nb,0.3,1\na,1,2\n", "line 5, name = 'a' is not valid"),
        ('name,width_m,height_m\n"a,0.3,1\n', "is not CSV"),
        (b"name,width_m,height_m\n\xe4,0.3,1\n", "is not UTF-8"),
    ],
)
def test_a_fault_is_named_with_its_line(text: str | bytes, line: str, tmp_path: Path) -> None:
    with pytest.raises(RocksteadyError) as refusal:
        read_objects(written(tmp_path, text))
    assert line in str(refusal.value)
    assert str(refusal.value).startswith("store.csv")
    assert "\n" not in str(refusal.value)


def test_a_quoted_cell_has_lines_of_its_own(tmp_path: Path) -> None:
    """Also a line separator of Unicode, which ends no row of a table."""
    text = 'name,width_m,height_m\n"vase\nblue",0.3,1\ncup\u2028red,0.2,1\n'
    assert [each.name for each in read_objects(written(tmp_path, text))] == [
        "vase\nblue",
        "cup\u2028red",
    ]


def test_a_wall_behind_an_object_is_yes_or_no(tmp_path: Path) -> None:
    text = (
        "name,width_m,height_m,against_wall,restitution\n"
        "wall,0.3,1.8,yes,0\nfree,0.3,1.8,No,\nother,0.3,1.8,,\n"
    )
    wall, free, other = read_objects(written(tmp_path, text))
    assert wall.block == Block.rectangle(width=0.3, height=1.8).against_wall(0.0)
    assert free.block == other.block == Block.rectangle(width=0.3, height=1.8)
    with pytest.raises(RocksteadyError, match=r"line 2, against_wall = 'maybe' .*yes or no"):
        read_objects(written(tmp_path, text.replace("yes", "maybe")))


def test_rows_may_be_frames_of_columns(tmp_path: Path) -> None:
    """The other cells describe one column; both cells of a frame are needed, and whole columns."""
    head = "name,width_m,height_m,columns,cap_mass_ratio,mass_kg\n"
    temple, vase = read_objects(
        written(tmp_path, f"{head}temple,1.6,9.6,4,2,900\nvase,0.12,0.5,,,\n")
    )
    assert temple.block == Block.frame(columns=4, cap_mass_ratio=2.0, width=1.6, height=9.6)
    assert vase.block.cap is None
    facts = compute_object_facts(temple)
    assert facts.mass_kg == 4 * 900.0 * (1.0 + 2.0), "that on the base"
    assert " kg of columns and cap" in facts.summary()
    for cells, words in (
        ("4,", r"cap_mass_ratio is missing: a frame has columns and cap_mass_ratio; add it"),
        (",2", r"columns is missing: a frame has columns and cap_mass_ratio; add it"),
        ("2.5,2", r"columns = 2.5 is not valid: it must be a whole number"),
        ("0,2", r"columns = 0 is not valid: it must be a whole number from 1 to 1000"),
        ("4,-1", r"cap_mass_ratio = -1.0 is not valid: it must lie in \[0, 1000\]"),
    ):
        with pytest.raises(RocksteadyError, match=words):
            read_objects(written(tmp_path, f"{head}temple,1.6,9.6,{cells},\n"))
    for column in ("offset_m", "base_width_m", "mass_centre_height_m"):
        text = f"name,width_m,height_m,columns,cap_mass_ratio,{column}\ntemple,1.6,9.6,4,2,0.1\n"
        with pytest.raises(RocksteadyError, match=f"{column} does not go with width_m"):
            read_objects(written(tmp_path, text))
    text = f"{head[:-1]},content_mass_kg,content_mass_centre_height_m\nx,1.6,9.6,4,2,9,5,1\n"
    with pytest.raises(RocksteadyError, match="columns carry their cap alone; leave"):
        read_objects(written(tmp_path, text))


@every("column", ["target_probability", "draws", "damage_states", "place"])
def test_a_key_of_files_that_a_table_would_pass_over_is_refused(
    column: str, tmp_path: Path
) -> None:
    file = tmp_path / "store.csv"
    file.write_text(f"name,width_m,height_m,{column}\nvase,0.12,0.5,floor\n", encoding="utf-8")
    with pytest.raises(RocksteadyError, match=f"line 2, {column} = 'floor' is not valid"):
        read_objects(file)
