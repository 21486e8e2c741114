"""Outcomes: codes and labels, which stored results and kernels share."""

import json
import pickle
import re
from enum import Enum
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

import rocksteady
from rocksteady.dynamics.batch.attractors import KIND_FLAGS
from rocksteady.dynamics.maps.attractor_map import ATTRACTORS
from rocksteady.dynamics.maps.fate_map import FATES
from rocksteady.errors import InputError
from rocksteady.kernels.orbits import return_map
from rocksteady.outcomes import NO_START, AttractorKind, Event, Status
from tests.every import every
from tools.namespace import THINGS


def test_status_codes_never_change() -> None:
    assert {status.label: int(status) for status in Status} == {
        "rocking": 0,
        "at-rest": 1,
        "overturned": 2,
        "lost-contact": 3,
        "undecided": 4,
    }


@every("status", Status)
def test_a_status_is_named_as_its_label_says(status: Status) -> None:
    assert status.name == status.label.upper().replace("-", "_")
    assert Status(int(status)) is status


@every("status", Status)
def test_advice_is_one_sentence_that_also_says_what_to_try(status: Status) -> None:
    assert status.advice.endswith(".")
    assert status.advice.count(".") == 1
    assert ";" in status.advice, "what it means; what to try"


def test_each_status_has_its_own_advice() -> None:
    assert len({status.advice for status in Status}) == len(Status)


def test_a_status_survives_pickle_as_itself() -> None:
    assert all(pickle.loads(pickle.dumps(status)) is status for status in Status)


def test_the_ends_of_a_passage_have_the_labels_of_how_a_run_ends() -> None:
    labels = {status.label for status in Status}
    assert {event.label for event in Event if event.label in labels} == {
        "overturned",
        "at-rest",
        "undecided",
    }
    assert [event.label for event in Event][:3] == ["impact", "uplift", "graze"]


def test_the_events_have_the_codes_of_the_kernel() -> None:
    names = {"OVERTURNED": "FALL", "AT_REST": "STAY", "UNDECIDED": "STUCK"}
    for event in Event:
        assert event == getattr(return_map, names.get(event.name, event.name))


def test_no_start_is_one_code_in_both_maps_and_no_outcome() -> None:
    flags = [question.outputs[0].flags for question in (ATTRACTORS, FATES)]
    assert [found[NO_START] for found in flags] == ["no-start"] * 2
    assert NO_START not in set(Status)
    assert [KIND_FLAGS[code] for code in range(6)] == [kind.value for kind in AttractorKind]


OUTCOMES = (Status, AttractorKind, Event)


@every("kinds", OUTCOMES)
def test_an_outcome_equals_its_word_and_its_code_and_nothing_else(kinds: Any) -> None:
    for place, outcome in enumerate(kinds):
        assert outcome.code == place
        assert outcome == np.int8(place)
        for same in (outcome.label, place, outcome):
            assert outcome == same
            assert same == outcome
            assert not outcome != same  # noqa: SIM202 - both operators are defined
            assert kinds(same) is outcome
        assert outcome in (outcome.label, "another")
        for other in (outcome.label.upper(), "", "fallen", place + 1, -1, None, 0.5, [place]):
            assert outcome != other
            assert not outcome == other  # noqa: SIM201
        assert [each for each in kinds if each == outcome] == [outcome]
        assert {outcome: 1}[pickle.loads(pickle.dumps(outcome))] == 1
        assert hash(outcome) == hash(outcome.value)
        assert json.loads(json.dumps(outcome)) == msgspec.json.decode(msgspec.json.encode(outcome))
        assert (np.array([place, place + 1]) == outcome.code).tolist() == [True, False]
    with pytest.raises(InputError, match=f"must be one of {next(iter(kinds)).label}, "):
        kinds("fallen")


def test_outcomes_of_different_lists_compare_by_their_words() -> None:
    assert Status.OVERTURNED == Event.OVERTURNED == AttractorKind.OVERTURNED
    codes, words = np.array([0, 2]), np.array(["rest", "aperiodic"])
    for array, outcome, other in (
        (codes, Status.OVERTURNED, Status.ROCKING),
        (words, AttractorKind.APERIODIC, AttractorKind.REST),
    ):
        found: Any
        for found in (array == outcome, outcome == array, array != other, other != array):
            assert found.tolist() == [False, True]
    assert Status.AT_REST != Event.UPLIFT, "both have code 1"
    assert Status.UNDECIDED != Event.AT_REST
    assert AttractorKind.REST != Event.OVERTURNED


def test_every_public_list_of_words_compares_with_its_words() -> None:
    lists = [each for each in THINGS.values() if isinstance(each, type) and issubclass(each, Enum)]
    assert set(OUTCOMES) <= set(lists)
    for each in lists:
        for member in each:
            assert member == getattr(member, "label", member.value)
            assert isinstance(member.value, str) or each in OUTCOMES, "a code alone is no word"


def test_a_run_compares_with_a_word() -> None:
    block = rocksteady.DimensionlessBlock(restitution=0.9)
    run = rocksteady.simulate(block, rocksteady.Harmonic(amplitude=9.0, frequency_ratio=1.0))
    assert run.status == "overturned"
    assert run.status in ("overturned", "at-rest")
    assert run.status != "at-rest"
    match run.status:
        case "at-rest":
            pytest.fail("another word")
        case "overturned":
            pass
        case _:
            pytest.fail("no word")


def test_no_change_of_a_block_its_shaking_or_its_start_is_safe_in_general() -> None:
    """Counterexamples to advice: of each pair the first stands, the second should be safer."""
    block, still = rocksteady.DimensionlessBlock(restitution=0.9), rocksteady.Rest()

    def status(amplitude: float, ratio: float, start: rocksteady.State | None = None) -> Status:
        pulse = rocksteady.Pulse(shape="one-sine", amplitude=amplitude, frequency_ratio=ratio)
        return rocksteady.simulate(block, pulse, start=start or still).status

    tilted = rocksteady.State(angle=0.1, velocity=0.0)
    # The same pulse on a larger block has a larger omega/p, on a stockier one a smaller A.
    assert [status(3.5, 3.0), status(3.5, 3.25)] == ["at-rest", "overturned"], "faster, larger"
    assert [status(4.0, 3.25), status(3.5, 3.25)] == ["at-rest", "overturned"], "weaker, stockier"
    assert [status(4.0, 3.6, tilted), status(4.0, 3.6)] == ["at-rest", "overturned"], "less tilted"


def test_no_text_promises_that_a_change_keeps_a_block_standing() -> None:
    root = Path(rocksteady.__file__).parents[2]
    change = (
        r"\b(?:weaker|stronger|faster|slower|larger|smaller|stockier|wider|heavier|lower|more)\b"
    )
    promise = re.compile(
        rf"{change}[^.;:|]{{0,60}}\b(?:keeps?|makes?)\s+(?:it|them|a block|the block)\s+"
        rf"(?:standing|safe|upright)|{change}\s+blocks?[^.;:|]{{0,40}}\b(?:is|are) (?:the )?safer"
    )
    files = [
        *(file for end in ("py", "mjs") for file in root.glob(f"src/**/*.{end}")),
        *root.glob("docs/**/*.md"),
        root / "README.md",
    ]
    promises = [
        (file.name, found[0])
        for file in files
        for found in promise.finditer(
            re.sub(r'"?\s*\n\s*"?', " ", file.read_text(encoding="utf-8"))
        )
        if "as a rule" not in found.string[max(found.start() - 30, 0) : found.end()].lower()
    ]
    assert promises == []
