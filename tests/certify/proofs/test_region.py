"""Regions proved: each box against the closed forms at points, and against tampered letters."""

import base64
import json
import zlib
from dataclasses import replace

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.certify.proofs import base_checker
from rocksteady.certify.proofs.region import ProvedRegion, certify_region, region_from
from rocksteady.errors import InputError
from tests.every import every

WORDS = {"1": None, "2": True, "3": False, "4": None}


def small(order: int) -> ProvedRegion:
    ranges = ((0.3, 6.0), (1.0, 8.0)) if order == 1 else ((0.5, 6.0), (2.0, 8.0))
    return certify_region(*ranges, 0.8, order=order, most_boxes=3000)


@every("order", [1, 3])
def test_random_points_of_boxes_have_their_verdict(order: int) -> None:
    random = np.random.default_rng(order)
    found = [each for each in small(order).boxes() if each[1] != "0"]
    for number in random.choice(len(found), 60):
        box, letter = found[number]
        a, w = random.uniform(box.low, box.high), random.uniform(box.slow, box.fast)
        states = rs.find_steady_states(
            rs.DimensionlessBlock(restitution=0.8),
            rs.Harmonic(amplitude=a, frequency_ratio=w),
            order=order,
        ).to_dict()
        first = [each for each in states["solutions"] if each["branch"] == 1]
        if letter == "1":
            assert first == []
        else:
            assert first[0]["admissible"] == (letter != "4"), (a, w)
            assert letter == "4" or first[0]["stable"] == WORDS[letter], (a, w)


def test_most_of_the_plane_is_decided_with_few_boxes() -> None:
    region = small(1)
    assert region.decided > 0.95
    assert abs(sum(region.shares.values()) - 1.0) < 1e-12
    assert region.grid(40, 60).shape == (40, 60)
    assert "proved on" in region.describe().headline


def test_the_file_holds_the_tree_and_a_false_letter_is_refused() -> None:
    region = small(1)
    again = region_from(region.to_json())
    assert again is not None
    assert again.tree == region.tree
    claimed = sum(letter not in "05" for letter in region.tree)
    assert again.check(None) == f"holds: all {claimed:,} boxes checked"
    assert again.check(10).startswith(f"sampled: 10 of {claimed:,} boxes checked, ")
    place = region.tree.index("2")
    false = replace(region, tree=region.tree[:place] + "3" + region.tree[place + 1 :])
    assert false.check(None).startswith("refused")
    values = json.loads(region.to_json())
    assert region_from(json.dumps(values | {"tree": "AAAA"})) is None
    cut = base64.b64encode(zlib.compress(region.tree[:-1].encode())).decode()
    assert region_from(json.dumps(values | {"tree": cut})) is None
    assert region_from(json.dumps(values | {"format": "other"})) is None
    for given in ({"path": 5}, {"path": "02"}, {"letter": np.int8(2)}, {"letter": "6"}):
        with pytest.raises(InputError, match=f"{next(iter(given))} = .* it is written with"):
            region.box_json(**({"path": "01", "letter": "2"} | given))
    with pytest.raises(InputError, match=r"arithmetic = 1 .*'arb' or 'iv'"):
        region.check(arithmetic=1)  # type: ignore[arg-type]


def test_which_boxes_are_drawn_is_not_known_beforehand(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[str] = []

    def holds(text: str, _: object) -> str:
        drawn.append(text)
        return "holds"

    monkeypatch.setattr(base_checker, "check", holds)
    region = small(1)
    assert region.check(20).startswith("sampled: 20 of ")
    assert region.check(20).startswith("sampled: 20 of ")
    assert sorted(drawn[:20]) != sorted(drawn[20:])


def test_ranges_orders_and_restitutions_are_checked() -> None:
    with pytest.raises(InputError, match="range above 0"):
        certify_region((2.0, 1.0), (1.0, 2.0), 0.8)
    with pytest.raises(InputError, match="odd"):
        certify_region((1.0, 2.0), (1.0, 2.0), 0.8, order=2)
    with pytest.raises(InputError, match=r"\(0, 1\)"):
        certify_region((1.0, 2.0), (1.0, 2.0), 1.0)


@pytest.mark.slow
def test_shares_of_the_papers_plane() -> None:
    assert certify_region((0.3, 6.0), (1.0, 8.0), 0.8, most_boxes=50_000).decided > 0.99
    assert certify_region((0.5, 6.0), (2.0, 8.0), 0.8, order=3, most_boxes=30_000).decided > 0.95
