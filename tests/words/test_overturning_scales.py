"""Words of overturning scales: sentences of one record, of several, and of none that falls."""

import numpy as np

from rocksteady import Block, Record, find_overturning_scales

BLOCK = Block.rectangle(width=0.4, height=1.6, restitution=0.85)
SHOCK = Record(acceleration_m_s2=np.array([0.0, 4.0, -4.0, 0.0]), dt_s=0.3, name="shock")


def test_the_sentence_of_one_record_names_it_once() -> None:
    answer = find_overturning_scales(BLOCK, SHOCK).describe()
    assert answer.sentence.count(" x ") == 3
    assert answer.sentence.count(" x shock (") == answer.sentence.count("shock") == 1


def test_an_answer_is_one_for_one_record_for_several_and_for_none_that_overturns() -> None:
    weak = SHOCK.scaled(1e-3)
    weak = Record(acceleration_m_s2=weak.acceleration_m_s2, dt_s=weak.dt_s, name="weak")
    low, high = (f"{end:g}" for end in find_overturning_scales(BLOCK, weak).within)
    reached = f"{float(high) * 4e-3 / 9.80665:.3g} g"
    one, two, mixed = (
        find_overturning_scales(BLOCK, records).describe()
        for records in (weak, [weak, SHOCK.scaled(1e-4)], [weak, SHOCK])
    )
    assert one.sentence == f"It stands in weak, from {low} to {high} x ({reached})."
    assert two.sentence == f"It stands in all 2 records, from {low} to {high} x ({reached})."
    assert mixed.sentence.startswith("It falls in 1 of 2 records, first at ")
    assert mixed.sentence.endswith(" in shock.")
    (row,) = (words for label, words in mixed.screen if label == "shock")
    assert row.startswith("falls first at ")
