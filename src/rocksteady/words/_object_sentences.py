"""What a screen says of an object: a sentence and lines, from the fields of its judgement."""

from typing import Final, get_args

import numpy as np

from rocksteady.results.numbers import chance, length, number, plural, quantity
from rocksteady.results.stated import Stated, band_words, runs_that, share_words
from rocksteady.risk.assess.judging import Judged
from rocksteady.risk.assess.remedy import CHANGES, Remedy
from rocksteady.risk.counted.band import records_to_show, upper_of_none
from rocksteady.risk.counted.built_in import ACCURACY, ACCURACY_ON_SPECTRUM
from rocksteady.risk.counted.count import Count
from rocksteady.risk.counted.motions import folds, median_fold
from rocksteady.risk.counted.suite import Shaking, Suite
from rocksteady.risk.counted.verdict import (
    LEAST,
    MARGIN,
    NEAR,
    TOO_FAR,
    VERDICTS,
    Doubt,
    Reason,
    Target,
    Unfit,
    Verdict,
)
from rocksteady.risk.hazard.failure_risk import LEAST_FOR_BAND
from rocksteady.words.hazard import rate_words
from rocksteady.words.placing import doubt_on_spectrum, spectrum_line


def change_words(remedy: Remedy, target: Target) -> str:
    """Return the least change of a kind, as "base 165 mm wide (9.0 % at 1.1 x); ..."."""

    def named(value: float) -> str:
        if remedy.change == CHANGES[0]:
            return f"base {length(value)} wide"
        return f"mass centre {length(value)} lower"

    if remedy.value is None and remedy.shown_at is None:
        reason = "the next would slide" if remedy.slides else "the last that was run"
        return f"none up to a {named(remedy.last)}, {reason}"
    if remedy.value is None:
        return f"{named(remedy.shown_at or 0.0)} to be sure of {target.words}"
    beyond = f"{chance(remedy.share_1_1)} at" if remedy.share_1_1 else "none falls at"
    words = f"{named(remedy.value)} ({beyond} {MARGIN:g} x)"
    if remedy.shown_at is not None and remedy.shown_at > remedy.value:
        words += f"; {length(remedy.shown_at)} to be sure of {target.words}"
    return words


PEAKS: Final = "with your two peaks"
SAME: Final = 1e-6
"""Part of a level by which peaks differ that are the same but for rounding."""
WORDS: Final[dict[Verdict, str]] = {verdict: verdict.replace("-", " ") for verdict in VERDICTS}
"""Verdicts as people read them."""


class Screen:
    """Sentence and lines of an object.

    Parameters
    ----------
    judged
        The object at its demand.
    target
        Share that is accepted, at the demand or in some years.
    friction
        Lowest friction that is given; None where it is not.
    where
        The demand in words after a verb, as "at 0.40 g".
    suite
        Motions of the ground.
    on_floor, of_floor
        Whether they reach it through a floor, and whether they are taken as those of one.
    idle_spectrum
        Whether a spectrum is stated beside both peaks, which decide.
    """

    def __init__(
        self,
        judged: Judged,
        *,
        target: Target,
        friction: float | None,
        where: str,
        suite: Suite,
        on_floor: bool,
        of_floor: bool,
        idle_spectrum: bool,
    ) -> None:
        """Keep the fields."""
        self.judged, self.decision = judged, judged.decision
        self.target, self.friction, self.where = target, friction, where
        self.built_in, self.copies = suite.built_in, suite.copies
        self.on_floor, self.of_floor = on_floor, of_floor
        self.idle_spectrum = idle_spectrum
        self.placing = None if judged.shaking is None else judged.shaking.placing
        self.this = "on this spectrum" if self.placing else "at this demand"

    @property
    def sentence(self) -> str:
        """The first line."""
        judged, decision = self.judged, self.decision
        if decision.verdict == "slides":
            when = "before it lifts" if judged.stands else self.where
            return f"It slides {when}: rocking alone is no answer."
        on = " on built-in motions" * self.built_in
        if self.target.years is not None and decision.verdict != "no-answer":
            words = self._rate()
            return f"{words[:1].upper()}{words[1:]}{on}."
        if decision.verdict == "no-answer":
            return f"No answer {self.where}: {self._no_answer()}."
        if judged.stands:
            lifts = quantity(judged.uplift_g, "g")
            return f"It stands {self.where}: nothing below {lifts} can lift it."
        return f"{self._counted()[0]} {self.where}{on}: {self._counted()[1]}."

    def _counted(self) -> tuple[str, str]:
        """Return how many runs fall, and the share."""
        count = self.judged.count
        assert count is not None
        words = share_words(count.falls, count.runs, count.band, count.share)
        return runs_that("Falls", count.falls, count.runs), words

    def _rate(self) -> str:
        """Return how often it falls, or why that is not known."""
        risk, why = self.judged.risk, self.judged.no_rate
        return f"no rate: {why}" if why or risk is None else f"falls {rate_words(risk)}"

    def _no_answer(self) -> str:
        """Return why there is no answer."""
        reason, count, shaking = self.decision.reason, self.judged.count, self.judged.shaking
        if reason == "too-far":
            assert self.judged.shaking is not None
            fold = number(median_of(self.judged), 2)
            return (
                f"half of the records are scaled or stretched {fold}-fold or more, "
                f"{TOO_FAR:g} is the most"
            )
        records = 0 if count is None else count.records
        if count is None and shaking is not None and reason == "few-records":
            records = len(shaking.motions)
        verb = "has" if records == 1 else "have"
        what = "a vertical" if reason == "few-vertical" else "an answer"
        who = plural(records, "record") if records else "no record"
        return f"{who} {verb if records else 'has'} {what}, {LEAST} are the least"

    @property
    def lines(self) -> list[Stated]:
        """The facts below the sentence."""
        decision, judged = self.decision, self.judged
        lines = [Stated(quantity="verdict", text=f"{WORDS[decision.verdict]}: {self._why()}")]
        if decision.verdict == "no-answer":
            lines = self._of_no_answer()
        if decision.verdict == "slides":
            return [*lines, self._lifts(), self._friction()]
        lines += [*self._beside_rate(), *self._spectrum()]
        if judged.stands:
            return [*lines, *self._change(), self._friction()]
        lines += [self._friction(), *self._change()]
        last = [self._lifts(), *self._records()]
        return [*lines, *(reversed(last) if self.placing else last)]

    def _spectrum(self) -> list[Stated]:
        """Return how the motions lie on a spectrum, or that one is not used."""
        if self.placing is None:
            words = "both peaks decide; it serves the published formulas alone"
            return [Stated(quantity="spectrum", text=words * self.idle_spectrum)]
        unfit = {*self.decision.doubts} & {*get_args(Unfit)} - {self.decision.reason}
        return [spectrum_line(self.placing, "; ".join(map(self._unfit, unfit)))]

    def _beside_rate(self) -> list[Stated]:
        """Return the rate, or of a target in years what is counted at the demand."""
        judged = self.judged
        if self.target.years is None or self.decision.verdict == "no-answer":
            if judged.no_rate:
                return [Stated(quantity="no rate", text=judged.no_rate)]
            words = "" if judged.risk is None else rate_words(judged.risk)
            return [Stated(quantity="rate", text=words)]
        if self.judged.stands or self.judged.count is None:
            return [Stated(quantity="at the demand", text=f"it stands {self.where}")]
        runs, share = self._counted()
        return [Stated(quantity="at the demand", text=f"{runs.lower()} {self.where}: {share}")]

    def _change(self) -> list[Stated]:
        """Return the least change that is a remedy."""
        remedies, count = self.judged.remedies, self.judged.count
        if not remedies or count is None:
            return []
        best = next((each for each in remedies if each.values), remedies[0])
        takes = records_to_show(self.target.share)
        shown = best.shown_at is not None or takes <= count.records
        few = "" if shown else f"{self.target.words} takes {takes} records"
        words = change_words(best, self.target)
        return [Stated(quantity="least change", text=words, condition=few)]

    def _at_best(self, count: Count) -> str:
        """Return what records show at best, and how many the target takes."""
        least = upper_of_none(count.records)
        best = chance(least)
        if best == chance(self.target.share):
            best = f"{number(100.0 * least)} %"
        takes = records_to_show(self.target.share)
        return (
            f"{plural(count.records, 'record')} show {best} at best, a target of "
            f"{number(100.0 * self.target.share)} % takes {takes}"
        )

    def _why(self) -> str:
        """Return what the verdict rests on."""
        judged, target = self.judged, f"target {self.target.words}"
        count, beyond, near = judged.count, judged.beyond, judged.near
        reason = self.decision.reason
        if self.decision.verdict == "slides":
            return "its friction is too low for rocking alone"
        if self.target.years is not None:
            return self._why_rate(target)
        if judged.stands or count is None or beyond is None:
            return self._by_statics()
        words = f"{target}; at {MARGIN:g} x {self.this[3:]} {_fall(beyond)}"
        high = count.band[1]
        if reason == "band" and count.falls and chance(high) == chance(self.target.share):
            words = f"{target}; the interval ends at {number(100.0 * high)} %"
        elif reason == "band" and not count.falls:
            words = self._at_best(count)
        elif reason == "stretched" and near is not None:
            words = f"{target}; of the {near.records} records stretched less than {NEAR:g}-fold "
            words += _fall(near)
        elif reason == "without-answer":
            words = f"{target}; {plural(count.without, 'run')} without an answer could turn it"
        elif reason == "built-in" or (reason and reason in get_args(Unfit)):
            words = self._unfit(reason)
        elif reason == "friction":
            words = f"green if the friction is at least {number(judged.friction.largest)}"
        return words

    def _why_rate(self, target: str) -> str:
        """Return what the verdict on a probability in some years rests on."""
        risk, need = self.judged.risk, self.judged.friction_of_rate
        if risk is None or need is None:
            return target
        low, high = risk.probability_band or (0.0, 0.0)
        return {
            "rate-unknown": target,
            "rate-records": f"{target}; a rate has an interval from {LEAST_FOR_BAND} records on",
            "stretched": f"{target}; records stretched less than {NEAR:g}-fold say otherwise",
            "friction": f"green if the friction is at least {number(need.largest)}",
            "": f"{target}; {band_words((low, high)).strip(' ()')}",
            "band": f"{target}; {band_words((low, high)).strip(' ()')}",
        }.get(self.decision.reason) or self._unfit(self.decision.reason)

    def _unfit(self, reason: Reason | Doubt) -> str:
        """Return why its motions are never green."""
        if reason == "built-in" or self.placing is None:
            return f"built-in motions are noise {'on your spectrum' if self.placing else PEAKS}"
        if reason == "floor-spectrum":
            return "a floor's spectrum alone: give the ground's, building and floor"
        return doubt_on_spectrum(self.placing)

    def _by_statics(self) -> str:
        """Return what statics says, and what of 1.1 times the demand."""
        beyond, margin = self.judged.beyond, f"{MARGIN:g} x"
        if self.decision.reason == "odd-peak":
            return self._unfit("odd-peak")
        if self.decision.reason == "cliff-unjudged":
            return f"stands {self.this}, {margin} cannot be judged"
        if self.decision.reason == "cliff" and beyond is not None:
            return f"stands {self.this}, {_fall(beyond)} at {margin}"
        return "by statics, without a run"

    def _of_no_answer(self) -> list[Stated]:
        """Return what is known where there is no answer."""
        lines = []
        for name, count in (
            ("counted", self.judged.count),
            ("without vertical", self.judged.plain),
        ):
            if count is not None and count.records and self.decision.reason != "too-far":
                words = share_words(count.falls, count.runs, count.band, count.share)
                share = f"{runs_that('falls', count.falls, count.runs)}: {words}"
                lines.append(Stated(quantity=name, text=share))
        return lines

    def _lifts(self) -> Stated:
        """Return where it lifts."""
        judged, shaking = self.judged, self.judged.shaking
        moved = shaking is not None and (self.on_floor or shaking.is_lifted)
        if moved and shaking is not None and judged.runs is not None:
            scales = judged.runs["uplift_scale"].values
            ratio = scales.reshape(scales.shape[0], scales.shape[1], -1).min(axis=2)
            at = float((ratio / judged.runs["scale"].values).min()) * shaking.level
            some = f"{judged.lifted} of {len(shaking.motions)} lift it {self.this}"
            return Stated(
                quantity="lifts at",
                value=at,
                unit=shaking.measure.unit + " of ground motion" * self.on_floor,
                evidence="in the worst record",
                condition=some,
            )
        pga, evidence = None if shaking is None else shaking.demand.pga_g, ""
        if pga is not None and not self.on_floor:
            evidence = f"{number(judged.uplift_g / pga, 2)} of {self.this[3:]}"
        elif shaking is not None and judged.lifted is not None:
            evidence = f"{judged.lifted} of {len(shaking.motions)} records lift it"
        unit = "g" + " of motion of its floor" * self.on_floor
        return Stated(quantity="lifts at", value=judged.uplift_g, unit=unit, evidence=evidence)

    def _records(self) -> list[Stated]:
        """Return what was done to the motions, and how far that goes."""
        judged, shaking = self.judged, self.judged.shaking
        if self.built_in and self.decision.verdict == "no-answer":
            return []
        if self.built_in:
            pair = ACCURACY_ON_SPECTRUM if self.placing else ACCURACY
            usual, worst = (number(100.0 * each) for each in pair)
            words = f"real records differed by {usual} points on average, {worst} at most"
            if self.placing:
                words = f"closest real records differed by {usual} points rms, {worst} at most"
            return [Stated(quantity="accuracy", text=words)]
        if shaking is None or judged.count is None:
            return []
        evidence, near = self._stretched(shaking) if shaking.stretched else _scaled(shaking)
        far = int((np.maximum(folds(shaking.scales), folds(shaking.stretches)) > TOO_FAR).sum())
        fold = number(median_of(judged), 2)
        remarks = [
            near,
            f"{self.copies:,} more are copies and left out" * bool(self.copies),
            "taken as motions of the floor" * self.of_floor,
            f"{far} changed more than {TOO_FAR:g}-fold" * bool(far),
            f"half are changed {fold}-fold or more: doubtful" * ("far" in self.decision.doubts),
        ]
        return [
            Stated(
                quantity="records",
                text=f"{len(shaking.motions):,}",
                evidence=evidence,
                condition="; ".join(filter(None, remarks)),
            )
        ]

    def _stretched(self, shaking: Shaking) -> tuple[str, str]:
        """Return the stretch of the records, and the share among the least stretched."""
        near = self.judged.near
        usual, most = (
            number(fold, 2)
            for fold in (median_fold(shaking.stretches), float(folds(shaking.stretches).max()))
        )
        words = f"stretched in time {usual}-fold ({most} at most)"
        if near is None:
            return words, ""
        some = f"only {near.records} are" if near.records > 1 else "only 1 is"
        if near.records >= LEAST:
            some = f"{chance(near.share) if near.falls else 'none'} of the {near.records}"
        elif not near.records:
            some = "none is"
        return words, f"{some} stretched less than {NEAR:g}-fold"

    def _friction(self) -> Stated:
        """Return the friction that it needs, beside what is given."""
        need, shaking, worst = number(self.judged.friction.largest), self.judged.shaking, ""
        if shaking is not None and float(np.ptp(shaking.floor_pga_g)) > SAME * shaking.level:
            worst = " in the worst record"
        if self.judged.stands and self.decision.verdict == "slides" and self.friction is not None:
            text = f"needs {number(self.judged.uplift_g)} to lift before it slides"
            return Stated(quantity="friction", text=text, evidence=f"given {number(self.friction)}")
        more = [f"{what} {number(value)}" for what, value in self._more_friction()]
        words = ", ".join([f"needs {need}", *more]) if more else f"needs {need}{worst}"
        if self.friction is not None:
            return Stated(
                quantity="friction", text=words, evidence=f"given {number(self.friction)}"
            )
        if more:
            return Stated(quantity="friction", text=words, condition="not given")
        words = f"must be at least {need}{worst}"
        return Stated(quantity="friction", text=words, condition="it is not given")

    def _more_friction(self) -> list[tuple[str, float]]:
        """Return for what it needs more friction, and how much."""
        judged = self.judged
        changed = max((each.friction_needed or 0.0 for each in judged.remedies), default=0.0)
        changed *= self.friction is None  # what would slide is no remedy
        rate = 0.0 if judged.friction_of_rate is None else judged.friction_of_rate.largest
        needs = [("once changed", changed), ("for the rate", rate)]
        return [(what, value) for what, value in needs if value > judged.friction.largest]


def _scaled(shaking: Shaking) -> tuple[str, str]:
    """Return what records were scaled to, and what their other peak is then."""
    words = f"scaled to {quantity(shaking.level, shaking.measure.unit)}"
    if shaking.other is None:
        return words, ""
    measure, low, high = shaking.other
    ends = f"{number(low, 2)} to {quantity(high, measure.unit, 2)} (10 to 90 %)"
    if low == high:
        ends = quantity(low, measure.unit, 2)
    return words, f"their {measure.label} is then {ends}"


def median_of(judged: Judged) -> float:
    """Return the median fold of the records' scales or stretches, the larger."""
    assert judged.shaking is not None
    return max(median_fold(judged.shaking.scales), median_fold(judged.shaking.stretches))


def _fall(count: Count) -> str:
    """Return a share with its verb."""
    return f"{chance(count.share)} fall" if count.falls else "none falls"


def remedy_warning(remedy: Remedy) -> str:
    """Return what to know of smaller values that pass; empty where there are none."""
    if not remedy.islands:
        return ""
    spans = ", ".join(" to ".join(dict.fromkeys(map(length, ends))) for ends in remedy.islands)
    more = "" if remedy.value is None else f" below {length(remedy.value)}"
    return (
        f"{remedy.change.capitalize()}: {spans} would do too, but not all others{more}; shares "
        "need not fall with a change."
    )
