"""The state in the page's address: a round trip, what is ignored, and the way back."""

import math
import random

import pytest

from rocksteady import Block
from rocksteady.model.units import in_units
from tests.explorer.browser.watched import DIMENSIONLESS, Explorer, drawn, link, turn_to, values

FIELDS = ("A", "W", "b", "h", "r")
HOSTILE = [
    "#v=1&A=%3Cimg%20src=x%20onerror=alert(1)%3E&start=%3Cscript%3Ealert(1)%3C/script%3E",
    "#v=1&__proto__=1&constructor=2&toString=3&hasOwnProperty=4",
    "#v=1&A=NaN&W=Infinity&r=-1&b=0&h=1e400",
    "#v=1&A=%E0%A4%A&W=%",
    "#v=1&tab=../../etc&model=javascript:alert(1)&units=%00",
    "#v=1&start=0x10,1e3&A=+2",
    "#v=1&" + "x" * 100_000 + "=1",
]


@pytest.mark.slow
def test_a_state_comes_back_from_its_link_bit_for_bit(explorer: Explorer) -> None:
    page, chance = explorer.open(), random.Random(25)
    for _ in range(12):
        state = {
            "A": chance.uniform(0.0, 6.0),
            "W": math.exp(chance.uniform(-2.0, 3.0)),
            "b": chance.uniform(0.1, 0.9),
            "h": chance.uniform(1.0, 3.0),
            "r": chance.uniform(0.2, 1.0),
            "model": chance.choice(["linear", "nonlinear"]),
        }
        turn_to(page, state)
        shown = values(page, "#controls")
        assert {name: float(shown[name]) for name in FIELDS} == {k: state[k] for k in FIELDS}
        page.locator("#in-units").select_option(
            "si" if page.locator("#in-units").input_value() == "none" else "none"
        )
        again = link(page)
        assert {name: float(again[name]) for name in FIELDS} == {k: state[k] for k in FIELDS}
        assert page.locator("#in-model").input_value() == state["model"]


@pytest.mark.slow
def test_keys_at_their_defaults_stay_out_of_the_link(explorer: Explorer) -> None:
    page = explorer.open(DIMENSIONLESS)
    default = page.locator("#in-A").input_value()
    page.locator("#in-A").fill("1.25")
    page.locator("#in-A").press("Enter")
    assert link(page) == {"v": "1", "units": "none", "A": "1.25"}
    page.locator("#in-A").fill(default)
    page.locator("#in-A").press("Enter")
    assert link(page) == {"v": "1", "units": "none"}


@pytest.mark.slow
def test_unknown_keys_are_ignored_with_a_notice(explorer: Explorer) -> None:
    page = explorer.open("#v=1&A=1.5&sparkle=7")
    assert page.locator("#in-A").input_value() == "1.5"
    assert "sparkle" in page.locator("#notice").inner_text()
    turn_to(page, {"A": 1.75})
    assert page.locator("#notice").is_hidden()


@pytest.mark.slow
def test_a_hostile_link_does_nothing_but_a_notice(explorer: Explorer) -> None:
    page = explorer.open()
    tags = "() => document.querySelectorAll('script, img, iframe, object, embed').length"
    before = page.evaluate(tags)
    for fragment in HOSTILE:
        # Followed from the page, and opened anew.
        for arrive in (lambda: turn_to(page, fragment), page.reload):  # noqa: B023
            arrive()
            drawn(page)
            assert page.evaluate(tags) == before, fragment
            assert page.evaluate("Object.keys(Object.prototype).length") == 0
            assert page.locator(".failed").count() == 0, fragment
            shown = values(page, "#controls")
            assert all(math.isfinite(float(shown[name])) for name in FIELDS), fragment


@pytest.mark.slow
def test_back_undoes_what_was_set_and_forward_does_it_again(explorer: Explorer) -> None:
    page = explorer.open(DIMENSIONLESS)
    first = page.locator("#in-A").input_value()
    for value in ("1.5", "2.5"):
        page.locator("#in-A").fill(value)
        page.locator("#in-A").press("Enter")
    shown = []
    for step in (page.go_back, page.go_back, page.go_forward):
        step()
        drawn(page)
        shown.append(page.locator("#in-A").input_value())
    assert shown == ["1.5", first, "1.5"]


@pytest.mark.slow
def test_a_number_that_is_refused_is_marked_and_changes_nothing(explorer: Explorer) -> None:
    page = explorer.open(DIMENSIONLESS)
    before = values(page, "#controls")
    for name, refused in (
        ("A", "-1"), ("W", "0"), ("r", "1.5"), ("b", "0"), ("h", "1e9"), ("A", ""),
    ):  # fmt: skip
        field = page.locator(f"#in-{name}")
        field.fill(refused)
        field.press("Enter")
        drawn(page)
        assert field.get_attribute("aria-invalid") == "true", name
        assert "refused" in str(field.get_attribute("title")), name
        assert values(page, "#controls") == before, name


@pytest.mark.slow
def test_in_engineering_units_a_new_size_keeps_the_shaking(explorer: Explorer) -> None:
    page = explorer.open({"A": 2.0, "W": 3.0, "h": 2.0})
    before = values(page, "#controls")
    block = Block.rectangle(width=0.5, height=2.0, restitution=0.8)
    given = in_units({"amplitude": [2.0], "frequency_ratio": [3.0]}, block)
    for name, column in (("a_g", "accel_g"), ("f_hz", "freq_hz")):
        assert math.isclose(float(before[name]), given[column][0], rel_tol=1e-15)
    page.locator("#in-h").fill("1.5")
    page.locator("#in-h").press("Enter")
    drawn(page)
    after = values(page, "#controls")
    assert float(after["h"]) == 1.5
    for name in ("a_g", "f_hz"):
        assert math.isclose(float(after[name]), float(before[name]), rel_tol=1e-12)
    assert float(link(page)["A"]) != 2.0
