"""`rocksteady study chaos`: its contract, and how an interrupted study goes on."""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady.certify.chaos_study import _study as chaos_study
from rocksteady.certify.proofs.certificate import Certificate
from rocksteady.certify.proofs.chaos import certify_chaos
from tests.cli.program import refused, rocksteady
from tests.outputs import unrendered


@pytest.mark.slow
def test_the_study_of_chaos_leaves_its_page_and_its_contract(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    proof = certify_chaos(0.6, 2, "0.8")
    ready = chaos_study.Chaos(
        restitution="0.8",
        points={"hilltop": proof, "homoclinic": proof},
        edges=(np.array([0.6, 0.7]), np.array([2.0, 2.1])),
        entropy=np.array([[0.5]]),
        strip=(np.array([1.3]), np.array([2.0])),
        rocking=np.array([[0.2]]),
    )
    monkeypatch.setattr(chaos_study, "chaos", lambda _, **__: ready)
    folder = tmp_path / "out"
    with unrendered():
        ran = rocksteady("study chaos --json --out", folder)
    assert ran.code == 0
    assert ran.json["schema"] == chaos_study.SCHEMA
    assert ran.json["files"] == sorted(file.name for file in folder.iterdir())
    assert "proved on 1 of 1 boxes" in ran.json["sentences"][0]
    assert "--force" in refused("study chaos --out", folder)
    whole = rocksteady("study chaos --force --more --out", folder).out
    first = rocksteady("study chaos --force --quiet --out", folder).out
    assert whole.startswith(first)
    assert first.count("\n") < whole.count("\n")


@pytest.mark.slow
def test_an_interrupted_study_of_chaos_says_how_it_goes_on_and_proves_nothing_twice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    edges = np.array([0.5, 0.6, 0.7, 0.8]), np.array([2.0, 2.1, 2.2])
    boxes: list[Any] = []

    def proof(*numbers: Any, kind: Any) -> Certificate:
        if isinstance(numbers[0], tuple) and kind == "hilltop":
            if len(boxes) == 4:
                raise KeyboardInterrupt
            boxes.append(numbers)
        return certify_chaos(*numbers, kind=kind)

    monkeypatch.setattr(chaos_study, "CASES", {"hilltop": ("0.6", "2")})
    strip = np.array([1.1]), np.array([2.0])
    monkeypatch.setattr(chaos_study, "chaos", partial(chaos_study.chaos, edges=edges, strip=strip))
    whole, folder = tmp_path / "whole", tmp_path / "out"
    with unrendered():
        assert rocksteady("study chaos --out", whole).code == 0
        with monkeypatch.context() as patched:
            patched.setattr(chaos_study, "certify_chaos", proof)
            ran = rocksteady("study chaos --out", folder)
            assert (ran.code, ran.out) == (130, "")
            assert ran.err.splitlines()[-2] == f"  rocksteady study chaos --out {folder} --resume"
            assert [file.name for file in folder.iterdir()] == [".unfinished"]
            assert "--resume" in refused("study chaos --out", folder)
            assert "of another restitution" in refused("study chaos -r 0.7 --resume --out", folder)
            del boxes[:-2]  # as many as are left
            assert rocksteady("study chaos --resume --out", folder).code == 0
    assert len({*boxes}) == 4
    files = {file.name: file.read_bytes() for file in folder.iterdir()}
    assert files == {file.name: file.read_bytes() for file in whole.iterdir()}
