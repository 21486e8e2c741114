"""The measured form of restitution: a factor of Housner's value, in every constructor."""

from typing import Any

import pytest

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.formulas import housner_restitution, impact_restitution
from rocksteady.model.blocks.housner_forms import form_of_text, ratio_words
from tests.every import every

MEASURED: Any = ("housner", 0.965)


@every(
    "make",
    [
        lambda e: Block.rectangle(width=0.4, height=1.6, restitution=e),
        lambda e: Block.from_radius(alpha=0.2, radius=1.1, restitution=e),
        lambda e: Block.from_p(alpha=0.2, p=2.0, restitution=e),
        lambda e: Block.general(mass=2.0, inertia=3.0, radius=1.0, alpha=0.3, restitution=e),
        lambda e: Block.asymmetric(left=0.2, right=0.2, height=1.6, restitution=e),
        lambda e: Block.asymmetric(left=0.2, right=0.3, height=1.6, restitution=e),
        lambda e: Block.from_alphas(positive=0.2, negative=0.3, p=2.0, restitution=e),
        lambda e: Block.named("statue-on-plinth", restitution=e),
        lambda e: Block.named("makris-roussos-2000", restitution=e),
    ],
)
def test_each_impact_keeps_the_factor_of_its_own_value(make: Any) -> None:
    plain, measured = make("housner"), make(MEASURED)
    for side, other in (("positive", "negative"), ("negative", "positive")):
        here, there = getattr(plain, side), getattr(plain, other)
        # Independent: angular momentum about the pivot that is struck.
        gyration = (plain.gravity * here.radius / here.p**2 - here.radius**2) ** 0.5
        angles, radii = (here.alpha, there.alpha), (here.radius, there.radius)
        expected = 0.965 * impact_restitution(angles, radii, gyration=gyration)
        assert getattr(measured, side).restitution == pytest.approx(expected, rel=1e-12)
    other = plain.with_restitution(MEASURED)
    assert other.positive.restitution == pytest.approx(measured.positive.restitution, rel=1e-14)
    assert other.negative.restitution == pytest.approx(measured.negative.restitution, rel=1e-14)
    again = plain.with_restitution(0.5).with_restitution("housner")
    assert again.restitution == pytest.approx(plain.restitution, rel=1e-14)
    if plain.symmetric:
        assert (other, again) == (measured, plain)
    assert make(("housner", 1.0)) == plain
    assert measured.dimensionless().restitution == measured.restitution


def test_descriptions_show_the_number_and_the_form() -> None:
    measured = Block.rectangle(width=0.4, height=1.6, restitution=MEASURED)
    value = 0.965 * housner_restitution(measured.alpha)
    assert measured.to_dict()["restitution"] == pytest.approx(value, rel=1e-15)
    assert measured.to_dict()["housner_factor"] == 0.965
    assert "0.88 (0.965 of Housner's)" in measured.summary()
    assert "housner_factor" not in measured.with_restitution(0.88).to_dict()
    assert "housner_factor" not in Block.rectangle(width=0.4, height=1.6).to_dict()
    assert measured == Block.rectangle(width=0.4, height=1.6, restitution=measured.restitution)


@every(
    ("form", "words"),
    [
        (("housner", 1.2), "which the factor makes 1.094.*give a factor up to 1.0967"),
        (("housner", -1.0), "must be a finite number above 0"),
        (("housner", float("nan")), "must be a finite number above 0"),
        (("housner", "0.9"), "as .*0.965"),
        (("housner",), "as .*0.965"),
        (("housner", 0.9, 0.8), "as .*0.965"),
        (("hausner", 0.9), "as .*0.965"),
        ("housner*0.9", "as .*0.965"),
    ],
)
def test_what_is_no_factor_is_refused(form: Any, words: str) -> None:
    makers: list[Any] = [
        lambda: Block.rectangle(width=0.4, height=1.6, restitution=form),
        lambda: Block.rectangle(width=0.4, height=1.6).with_restitution(form),
    ]
    for make in makers:
        with pytest.raises(InputError, match=words) as refused:
            make()
        assert "\n" not in str(refused.value)


def test_the_largest_factor_of_the_hint_is_valid_and_keeps_all() -> None:
    largest = Block.rectangle(width=0.4, height=1.6, restitution=("housner", 1.0967))
    assert 0.999 < largest.restitution <= 1.0


def test_texts_are_read_in_both_orders_and_nothing_else() -> None:
    assert form_of_text("housner*0.965") == form_of_text("0.965*housner") == MEASURED
    assert form_of_text("housner") == "housner"
    for text in ("", "*", "housner*", "*housner", "housner*housner", "housner*1*1", "0.9"):
        assert form_of_text(text) is None
    assert ratio_words("housner*0.965") == "restitution 0.965 of Housner's"
