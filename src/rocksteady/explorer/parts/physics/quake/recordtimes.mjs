// The interval between samples that are given with their times, from the digits of the times.
// The same steps as rocksteady.records.core.sampling, so that the interval has the same bits.

import { evaluateEach } from '../case.mjs';

/** @import { Kernels } from '../../kernels/loader.mjs' */

const TIME_JITTER = 0.01; // part of the interval by which a time may be off its place
const USUAL_RATE_FACTORS = [2, 5];

/**
 * What the times of a table say: an interval [s] with a doubt, or why they are refused at a row.
 * @typedef {{ interval: number, doubt: string } | { row: number, found: string }} Spacing
 */

/**
 * Return a number rounded to significant digits, halves to even as Python does.
 * @param {number} value
 * @param {number} digits
 * @returns {number}
 */
export function significant(value, digits) {
  if (!Number.isFinite(value) || value === 0) return value;
  if (value < 0) return -significant(-value, digits);
  const [mantissa, power] = value.toExponential(99).split('e');
  const written = mantissa.replace('.', '');
  const rest = written.slice(digits);
  let kept = BigInt(written.slice(0, digits));
  const half = '5'.padEnd(rest.length, '0');
  if (rest > half || (rest === half && kept % 2n === 1n)) kept += 1n;
  return Number(`${kept}e${Number(power) - digits + 1}`);
}

/** @param {number} value */
function evenlyRounded(value) {
  const near = Math.round(value);
  return Math.abs(near - value) === 0.5 && near % 2 !== 0 ? near - 1 : near;
}

/** @param {ArrayLike<number>} values */
function medianOf(values) {
  const sorted = Float64Array.from(values).sort();
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/**
 * Return one unit of the last digit of a number as it is written.
 * @param {string} written
 */
function lastPlace(written) {
  const [mantissa, exponent = ''] = written.toLowerCase().replace('d', 'e').split('e');
  const decimals = (mantissa.split('.')[1] ?? '').length;
  const power = /^[+-]?\d{1,3}$/.test(exponent) ? Number(exponent) : 0;
  return Number(`1e${power - decimals}`);
}

/**
 * Return half a unit of the last digit that each time of a column may be written with.
 * @param {Kernels} kernels
 * @param {string[]} written
 * @param {Float64Array} values
 */
function placesOf(kernels, written, values) {
  let digits = 0, finest = Infinity;
  for (const one of written) {
    const mantissa = one.split(/[eEdD]/)[0].replace(/^[+\- ]+|[+\- ]+$/g, '');
    digits = Math.max(digits, mantissa.replaceAll('.', '').replace(/^0+/, '').length);
    finest = Math.min(finest, lastPlace(one));
  }
  const sizes = values.map((value) => Math.abs(value) || finest);
  const logs = evaluateEach(kernels, 'log', [...sizes, 10]), ten = logs[sizes.length];
  return logs.slice(0, -1).map((log) => {
    const power = Math.floor(log / ten + 1e-12) - digits + 1;
    return 0.5 * Math.max(Number(`1e${power}`), finest);
  });
}

/**
 * Return the interval with the fewest digits, its own or those of its rate, within bounds.
 * @param {number} low
 * @param {number} high
 */
function simplestBetween(low, high) {
  const middle = 0.5 * (low + high);
  for (let digits = 1; digits < 16; digits++) {
    const plain = significant(middle, digits);
    if (low <= plain && plain <= high) return plain;
    const ofRate = 1 / significant(1 / middle, digits);
    if (low <= ofRate && ofRate <= high) return ofRate;
  }
  return middle;
}

/**
 * @param {number} step
 * @param {number} place
 */
function simplestNear(step, place) {
  const near = Math.min(place, 0.01 * step);
  return step > 0 ? simplestBetween(step - near, step + near) : 0;
}

/**
 * @param {number} interval
 * @param {number} error
 */
function withFewDigits(interval, error) {
  const least = Math.max(error, 1e-12 * interval);
  return simplestBetween(interval - least, interval + least);
}

/**
 * Return the smallest and the largest interval whose multiples are all written as the times are.
 * @param {Float64Array} times
 * @param {Float64Array} near
 * @returns {[number, number] | null}
 */
function slopesOf(times, near) {
  const count = times.length;
  /** @param {number} slope */
  const gap = (slope) => {
    let below = -Infinity, above = Infinity, first = 0, second = 0;
    for (let k = 0; k < count; k++) {
      const low = times[k] - near[k] - slope * k, high = times[k] + near[k] - slope * k;
      if (low > below) [below, first] = [low, k];
      if (high < above) [above, second] = [high, k];
    }
    return [below - above, second - first];
  };
  const mean = (times[count - 1] - times[0]) / (count - 1);
  const widest = near.reduce((most, value) => Math.max(most, value));
  const reach = (2 * widest * 2) / (count - 1) + 1e-9 * mean;
  let left = mean - reach, right = mean + reach, inside = NaN;
  for (let round = 0; round < 80; round++) {
    const middle = 0.5 * (left + right);
    const [size, rising] = gap(middle);
    if (size <= 0) {
      inside = middle;
      break;
    }
    [left, right] = rising > 0 ? [left, middle] : [middle, right];
  }
  if (Number.isNaN(inside)) return null;
  const [low, high] = [mean - reach, mean + reach].map((outside) => {
    let good = inside, bad = outside;
    for (let round = 0; round < 60; round++) {
      const middle = 0.5 * (good + bad);
      if (gap(middle)[0] <= 0) good = middle; else bad = middle;
    }
    return good;
  });
  return [low, high];
}

/**
 * Return whether a rate is one of instruments: whole, of factors 2 and 5, and 3 once.
 * @param {number} interval
 */
function isPlainRate(interval) {
  const rate = 1 / interval;
  let whole = evenlyRounded(rate);
  if (whole < 1 || Math.abs(rate - whole) > 1e-9 * Math.max(rate, whole)) return false;
  for (const factor of USUAL_RATE_FACTORS) while (whole % factor === 0) whole /= factor;
  return whole === 1 || whole === 3;
}

/**
 * Return whether a usual interval with rows left out explains times better than the chosen one.
 * @param {Float64Array} times
 * @param {number} usual
 * @param {number} chosen
 * @param {Float64Array} near
 */
function rowsAreMissing(times, usual, chosen, near) {
  if (!(usual > 0 && usual < 0.999 * chosen) || isPlainRate(chosen)) return false;
  const steps = times.map((time) => evenlyRounded((time - times[0]) / usual));
  const whole = times.every((time, k) => Math.abs(time - times[0] - usual * steps[k]) <= near[k]);
  const growing = steps.every((step, k) => k === 0 || step - steps[k - 1] >= 1);
  return whole && growing && isPlainRate(usual);
}

/**
 * Return a sentence where digits leave the interval open, or it is no usual number.
 * @param {number} low
 * @param {number} high
 * @param {number} chosen
 */
function intervalDoubt(low, high, chosen) {
  const plain = [chosen, 1 / chosen].some(
    (value) => Math.abs(significant(value, 5) - value) <= 1e-12 * value * (1 + 1e-9),
  );
  if (high - low <= 1e-6 * chosen && plain) return '';
  return `the digits of its times leave the interval between ${low.toPrecision(6)} and`
    + ` ${high.toPrecision(6)} s: ${chosen.toPrecision(6)} s is taken`;
}

/**
 * Return the interval of evenly spaced times, or null where they are not.
 * @param {Float64Array} times
 * @param {Float64Array} steps
 * @param {Float64Array} place
 * @returns {{ interval: number, doubt: string } | null}
 */
function evenInterval(times, steps, place) {
  const count = times.length;
  const mean = (times[count - 1] - times[0]) / (count - 1);
  const noise = 1e-12 * times.reduce((most, time) => Math.max(most, Math.abs(time)), 0);
  const off = times.map((time, k) => Math.abs(time - (times[0] + mean * k)));
  const error = (place[0] + place[count - 1]) / (count - 1);
  const exact = 1e-6 * mean + noise, jitter = TIME_JITTER * mean + noise;
  if (off.every((value) => value <= exact)) {
    return { interval: withFewDigits(mean, error), doubt: '' };
  }
  const near = place.map((value) => 1.01 * value + noise); // rounded, or cut off
  const bounds = slopesOf(times, near) ?? slopesOf(times.map((time, k) => time + place[k]), near);
  if (bounds) {
    const [low, high] = bounds, middle = medianOf(steps);
    let chosen = simplestBetween(low, high);
    const usual = simplestNear(middle, medianOf(place));
    const inside = low <= usual && usual <= high;
    const unlike = steps.filter((step) => Math.abs(step - middle) > jitter).length;
    // From the first time as it stands: a gap of one unit of the last digit would else be a first
    // time half a unit off.
    const explained = (inside && steps.every((step) => step > 0)
        && times.every((time, k) => Math.abs(time - times[0] - usual * k) <= near[k]))
      || off.every((value) => value <= jitter);
    const coarse = unlike > Math.max((count >= 50 ? 0.02 : 0.25) * steps.length, 2);
    if (explained || coarse) {
      chosen = inside && !coarse ? usual : chosen;
      if (rowsAreMissing(times, usual, chosen, near)) return null;
      return { interval: chosen, doubt: intervalDoubt(low, high, chosen) };
    }
  }
  if (!off.every((value) => value <= jitter)) return null;
  return { interval: withFewDigits(mean, error), doubt: '' };
}

/**
 * Return the interval between samples [s], or the row at which the times are refused.
 * @param {Kernels} kernels
 * @param {string[]} written  the times as they stand in the file, at least two
 * @param {Float64Array} numbers  the same as numbers
 * @param {number} unit  size of their unit [s]
 * @returns {Spacing}
 */
export function spacingOf(kernels, written, numbers, unit) {
  const times = numbers.map((value) => value * unit);
  const steps = times.slice(1).map((time, k) => time - times[k]);
  const place = placesOf(kernels, written, numbers).map((value) => unit * value);
  const even = times[times.length - 1] - times[0] > 0 ? evenInterval(times, steps, place) : null;
  if (even) return even;
  const shown = (/** @type {number} */ value) => String(Number(value.toPrecision(6)));
  const back = steps.findIndex((step) => !(step > 0)) + 1;
  if (back > 0) {
    const found = `its time, ${shown(times[back])} s, does not come after ${shown(times[back - 1])} s`;
    return { row: back, found };
  }
  const usual = medianOf(steps);
  let odd = 0;
  steps.forEach((step, k) => {
    if (Math.abs(step - usual) > Math.abs(steps[odd] - usual)) odd = k;
  });
  const found = `its time, ${shown(times[odd + 1])} s, is ${shown(steps[odd])} s after the one`
    + ` before, and most are ${shown(usual)} s apart`;
  return { row: odd + 1, found };
}
