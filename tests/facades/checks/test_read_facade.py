"""Facade files: what is read, and the one line for everything that is not."""

from pathlib import Path
from typing import Any

import pytest

from rocksteady.errors import RocksteadyError
from rocksteady.facades.checks.actions import Load, PushingMass, Thrust, Tie
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.facade_demand import FacadeDemand
from rocksteady.facades.checks.read_facade import EXAMPLE, DescribedFacade, read_facade
from rocksteady.facades.checks.spectrum_table import SpectrumTable
from rocksteady.risk.spectra.elastic_spectrum import ElasticSpectrum
from tests.every import every

SIZES = "thickness_m = 0.5\nheight_m = 6\n"
HEAD = f'[facade]\nname = "x"\n{SIZES}'
SITE = "ag_g = 0.2\nf0 = 2.5\ntc_star_s = 0.3\n"


def read(text: str, folder: Path) -> DescribedFacade:
    file = folder / "wall.toml"
    file.write_text(text, encoding="utf-8")
    return read_facade(file)


def test_a_file_is_the_facade_that_it_describes(tmp_path: Path) -> None:
    found = read(
        HEAD
        + 'kind = "gable"\nlength_m = 4\nunit_weight_kn_m3 = 20\nhinge_inset_m = 0.05\n'
        + 'knowledge_level = "LC2"\none_sided = true\nrestitution = "housner*0.9"\n'
        + '[[loads]]\nname = "a"\nweight_kn = 3\nx_m = 0.2\nz_m = 4\n'
        + '[[loads]]\nname = "b"\nweight_kn = 4\nx_m = 0.1\nz_m = 2\n'
        + '[[masses]]\nname = "c"\nweight_kn = 5\nz_m = 3\n'
        + '[[ties]]\nname = "d"\nforce_kn = 6\nz_m = 3\n'
        + '[[thrusts]]\nname = "e"\nforce_kn = 1\nz_m = 2\n',
        tmp_path,
    )
    assert found.facade == Facade(
        name="x",
        kind="gable",
        thickness_m=0.5,
        height_m=6.0,
        length_m=4.0,
        unit_weight_kn_m3=20.0,
        hinge_inset_m=0.05,
        confidence_factor=1.2,
        one_sided=True,
        restitution=("housner", 0.9),
        loads=(
            Load(name="a", weight_kn=3.0, x_m=0.2, z_m=4.0),
            Load(name="b", weight_kn=4.0, x_m=0.1, z_m=2.0),
        ),
        masses=(PushingMass(name="c", weight_kn=5.0, z_m=3.0),),
        ties=(Tie(name="d", force_kn=6.0, z_m=3.0),),
        thrusts=(Thrust(name="e", force_kn=1.0, z_m=2.0),),
    )
    assert found.demand == FacadeDemand()
    assert len(found.sha256 or "") == 64
    assert found.to_dict()["loads"] == 2


def test_defaults_are_those_of_the_class(tmp_path: Path) -> None:
    assert read(HEAD, tmp_path).facade == Facade(name="x", thickness_m=0.5, height_m=6.0)
    mark = read("\ufeff" + HEAD, tmp_path)  # a byte-order mark is no fault
    assert mark.facade == read(HEAD, tmp_path).facade


def test_demands_are_formulas_or_tables_beside_the_file(tmp_path: Path) -> None:
    (tmp_path / "floor.csv").write_text("period_s,sa_g\n0,0.3\n0.5,1\n4,0.1\n", "utf-8")
    found = read(
        HEAD
        + f'[demand.sld]\n{SITE}soil = "C"\ntopography = "T2"\n'
        + f"[demand.slv]\n{SITE}soil_factor = 1.2\ncc = 1.3\ntopography = 1.1\n"
        + '[demand.slc]\ntable = "floor.csv"\ndamping = 0.05\n',
        tmp_path,
    ).demand
    site: dict[str, Any] = {"ag_g": 0.2, "f0": 2.5, "tc_star_s": 0.3}
    assert found.sld == ElasticSpectrum(**site, soil="C", topography="T2")
    assert found.slv == ElasticSpectrum(**site, soil_factor=1.2, cc=1.3, topography=1.1)
    assert isinstance(found.slc, SpectrumTable)
    assert found.slc.sa_g(0.5, 0.05) == pytest.approx(1.0)


def test_the_example_is_read_and_has_all_demands() -> None:
    example = read_facade(EXAMPLE)
    assert "example" in example.facade.name
    assert example.demand.given == ("SLD", "SLV", "SLC")
    assert "front wall" in example.summary()


WRONG = [
    ("", "wall.toml is empty: a file has a [facade] with name"),
    ("name = 'x'\n", "wall.toml: name is unknown"),
    ("name = 'x'\n", "it belongs to [facade]"),
    ("[facade]\nname = 'x'\nheight_m = 6\n", "[facade] thickness_m is missing: [facade] needs it"),
    ("[[loads]]\nname = 'a'\n", "wall.toml: [[loads]] 1: weight_kn is missing: [[loads]] needs it"),
    ("[demand.slv]\nag_g = 0.2\n", "wall.toml: [facade] is missing: a file has a [facade]"),
    (HEAD + "thikness = 1\n", "wall.toml: [facade] thikness is unknown: the keys of [facade] are"),
    (HEAD + "thikness = 1\n", "did you mean thickness_m?"),
    (HEAD + "x_m = 1\n", "it belongs to [[loads]]"),
    (HEAD + "[[load]]\nname = 'a'\n", "wall.toml: load is unknown: the keys of the file's top are"),
    (HEAD + "[[load]]\nname = 'a'\n", "did you mean loads?"),
    (HEAD + "[loads]\nname = 'a'\n", "loads = {'name': 'a'} is not valid: it must be tables, each"),
    (HEAD + "loads = 3\n", "[facade] loads is unknown"),
    (HEAD + "[[ties]]\nname = 'a'\nforce_kn = 'x'\nz_m = 1\n", "[[ties]] 1: force_kn = 'x' is not"),
    (HEAD + "[[ties]]\nname='a'\nforce_kn=1\nz_m=1\n[[ties]]\nname='b'\nforce_kn=1\nz_m=9.0\n",
     "[facade] z_m of b = 9.0 is not valid: it is at most height_m = 6"),
    (HEAD + "[[ties]]\nname='a'\nforce_kn=-1\nz_m=1\n", "[[ties]] 1: force_kn of tie a = -1.0 is"),
    (HEAD + "[[ties]]\nname='a'\nforce=1\nz_m=1\n", "[[ties]] 1: force is unknown"),
    (HEAD + "[[loads]]\nname='a'\nweight=1\nx_m=0\nz_m=1\n", "[[loads]] 1: weight is unknown"),
    (HEAD + "[[masses]]\nname='a'\nweight=1\nz_m=1\n", "[[masses]] 1: weight is unknown"),
    (HEAD + f"[demand.slv]\n{SITE}ground = 'A'\n", "[demand.slv] ground is unknown"),
    (HEAD + "length_m = nan\n", "wall.toml: [facade] length_m = nan is not valid"),
    (HEAD + "length_m = inf\n", "wall.toml: [facade] length_m = inf is not valid"),
    (HEAD + "length_m = true\n", "[facade] length_m = True is not valid: it must be a number"),
    (HEAD + "length_m = [1.0]\n", "length_m = [1.0] is not valid: it must be a number"),
    (HEAD + "length_m = 1" + "0" * 400 + "\n", "is not valid: it must be a number of usual size"),
    (HEAD + "one_sided = 1\n", "one_sided = 1 is not valid: it must be true or false"),
    (HEAD + "kind = 'tower'\n", "it must be one of wall, parapet, pinnacle, gable; leave it"),
    (HEAD + "knowledge_level = 'LC4'\n", "it must be one of LC1, LC2, LC3; leave it out"),
    (HEAD + "knowledge_level = 'LC1'\nconfidence_factor = 1.2\n", "has both knowledge_level and"),
    (HEAD + "restitution = 'hausner'\n", "[facade] restitution = 'hausner' is not valid"),
    (HEAD + "restitution = 'housner*-1'\n", "[facade] restitution = 'housner*-1' is not valid"),
    (HEAD + "restitution = 1.4\n", "[facade] restitution = 1.4 is not valid"),
    (HEAD + "[facade.more]\nx = 1\n", "[facade] more is unknown"),
    (HEAD.replace("0.5", "500"), "[facade] thickness_m = 500.0 is not valid: it must lie in [0.05"),
    (HEAD + "[demand]\nslu = 3\n", "did you mean sl"),
    (HEAD + "[demand]\nslv = 3\n", "slv = 3 is not valid: it must be a table of keys"),
    (HEAD + f"[demand.slv]\n{SITE}", "wall.toml: [demand.slv] soil is missing"),
    (HEAD + "[demand.slv]\nag_g = 0.2\n", "wall.toml: [demand.slv] f0 is missing"),
    (HEAD + f"[demand.slv]\n{SITE}soil = 'F'\n", "[demand.slv] soil = 'F' is not valid: it must"),
    (HEAD + f"[demand.slv]\n{SITE}soil = 'A'\ndamping = 0.05\n", "damping goes with a table alone"),
    (HEAD + "[demand.slv]\ntable = 'a.csv'\nag_g = 0.2\n", "[demand.slv] ag_g does not go with"),
    (HEAD + "[demand.slv]\ntable = 'none.csv'\ndamping = 0.05\n", "[demand.slv] spectrum = "),
    (HEAD + "[demand.slv]\ntable = 'none.csv'\ndamping = 0.05\n", "No such file"),
    (HEAD + "[demand.slv]\ntable = ' '\n", "[demand.slv] table = ' ' is not valid"),
    (HEAD + '[demand.slv]\ntable = "a\\u0000b"\n', "[demand.slv] table = 'a\\x00b' is not valid"),
    (HEAD + "hinge_inset_m = 0.3\n", "x falls by itself"),
    (HEAD + "height_m = 7\n", "it is not TOML: Cannot overwrite a value"),
    ("x = " + "[" * 5000 + "]" * 5000, "nested or its numbers are long beyond reason"),
    ("x = 1" + "0" * 5000, "nested or its numbers are long beyond reason"),
]  # fmt: skip


@every(("text", "line"), WRONG)
def test_what_is_wrong_is_named_in_one_line(text: str, line: str, tmp_path: Path) -> None:
    with pytest.raises(RocksteadyError) as refusal:
        read(text, tmp_path)
    message = str(refusal.value)
    assert line in message
    assert message.startswith("wall.toml")
    assert "\n" not in message
    assert len(message) < 500


def test_a_file_that_is_none_is_named(tmp_path: Path) -> None:
    with pytest.raises(RocksteadyError, match=r"none.toml' is not valid: No such file"):
        read_facade(tmp_path / "none.toml")
    with pytest.raises(RocksteadyError, match="Is a directory"):
        read_facade(tmp_path)
    file = tmp_path / "wall.toml"
    file.write_bytes(HEAD.encode() + b"# Sta\xe4tue")
    with pytest.raises(RocksteadyError, match="is not UTF-8, as TOML must be"):
        read_facade(file)


def test_a_file_says_until_when_actions_act_and_how_an_element_vibrates(tmp_path: Path) -> None:
    file = tmp_path / "top.toml"
    ends = {"ties": "until_collapse = true", "thrusts": "lost_at_m = 0.1"}
    acting = "".join(
        f"[[{kind}]]\nname = '{kind}'\nforce_kn = 1.0\nz_m = 1.0\n{end}\n"
        for kind, end in ends.items()
    )
    keys = "base_height_m = 9.0\nelastic_modulus_mpa = 750\none_sided = true\nkind = 'parapet'\n"
    file.write_text(
        f"[facade]\nname = 'top'\nthickness_m = 0.4\nheight_m = 2.0\n{keys}{acting}", "utf-8"
    )
    found = read_facade(file)
    assert found.facade.ties[0].until_collapse is True
    assert found.facade.thrusts[0].lost_at_m == 0.1
    values = found.to_dict()
    assert (values["ending"], values["base_height_m"]) == (["thrusts"], 9.0)
    assert values["t0_s"] == found.facade.t0_s == pytest.approx(0.096992, abs=1e-5)
    file.write_text(f"{file.read_text('utf-8')}until_collapse = true\n", "utf-8")
    with pytest.raises(RocksteadyError, match=r"\[\[thrusts\]\] 1: lost_at_m of thrusts"):
        read_facade(file)
