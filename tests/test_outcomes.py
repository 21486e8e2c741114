"""Outcomes: codes and labels, which stored results and kernels share."""

import pickle

import pytest

from rocksteady.dynamics.batch.attractors import KIND_FLAGS
from rocksteady.dynamics.maps.attractor_map import ATTRACTORS
from rocksteady.dynamics.maps.fate_map import FATES
from rocksteady.kernels.orbits import return_map
from rocksteady.outcomes import NO_START, AttractorKind, Event, Status


def test_status_codes_never_change() -> None:
    assert {status.label: int(status) for status in Status} == {
        "rocking": 0,
        "at-rest": 1,
        "overturned": 2,
        "lost-contact": 3,
        "undecided": 4,
    }


@pytest.mark.parametrize("status", Status)
def test_a_status_is_named_as_its_label_says(status: Status) -> None:
    assert status.name == status.label.upper().replace("-", "_")
    assert Status(int(status)) is status


@pytest.mark.parametrize("status", Status)
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
