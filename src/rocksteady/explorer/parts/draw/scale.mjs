// Scales of axes: from values to pixels and back, ticks and their labels.

/** @typedef {{ value: number, label: string }} Tick */

/**
 * @typedef {object} Scale
 * @property {number} from
 * @property {number} to
 * @property {boolean} log
 * @property {number} start  pixel of `from`
 * @property {number} end  pixel of `to`
 * @property {(value: number) => number} at  pixel of a value; NaN where a logarithm has none
 * @property {(pixel: number) => number} value  value at a pixel
 * @property {(count?: number) => Tick[]} ticks  about so many, all between the ends
 * @property {(count?: number) => number[]} minor  values of the ticks between those
 */

const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';
const MOST_TICKS = 100;

/**
 * Return a number with at most so many significant digits, without trailing zeros.
 * @param {number} value
 * @param {number} [digits]
 * @returns {string}
 */
export function numeral(value, digits = 4) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? '–' : value > 0 ? '∞' : '−∞';
  const rounded = Number(value.toPrecision(digits));
  const size = Math.abs(rounded);
  if (size === 0) return '0';
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = rounded.toExponential().split('e');
    return `${signed(mantissa)}×${powerOfTen(Number(exponent))}`;
  }
  return signed(String(rounded));
}

/**
 * Return a scale between two values and two pixels; either pair may descend.
 * @param {{ from: number, to: number, log?: boolean, start: number, end: number }} given
 * @returns {Scale}
 */
export function scale({ from, to, log = false, start, end }) {
  const along = log ? Math.log10 : identity;
  const low = along(from);
  const span = along(to) - low;
  const lowest = Math.min(from, to);
  const highest = Math.max(from, to);
  const usable = Number.isFinite(span) && span !== 0;
  return {
    from, to, log, start, end,
    at(value) {
      const pixel = usable ? start + (end - start) * ((along(value) - low) / span)
        : (start + end) / 2;
      return Number.isFinite(pixel) ? pixel : NaN;
    },
    value(pixel) {
      const there = low + span * ((pixel - start) / (end - start));
      return log ? 10 ** there : there;
    },
    ticks(count = 6) {
      if (!usable) return [];
      return log ? logTicks(lowest, highest, count) : linearTicks(lowest, highest, count);
    },
    minor(count = 6) {
      if (!usable) return [];
      return log ? logMinor(lowest, highest) : linearMinor(lowest, highest, count);
    },
  };
}

/** @param {number} value */
function identity(value) {
  return value;
}

/** @param {string} text */
function signed(text) {
  return text.replace('-', '−');
}

/** @param {number} exponent */
function powerOfTen(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => SUPERSCRIPTS[Number(digit)]);
  return `10${exponent < 0 ? '⁻' : ''}${digits.join('')}`;
}

/**
 * Return the step of 1, 2 or 5 times a power of ten that gives at most so many ticks.
 * @param {number} span
 * @param {number} count
 */
function tickStep(span, count) {
  const least = span / Math.max(1, count);
  const exponent = Math.floor(Math.log10(least));
  const lead = [1, 2, 5].find((one) => one * 10 ** exponent >= least * (1 - 1e-9));
  return lead ? { lead, exponent } : { lead: 1, exponent: exponent + 1 };
}

/**
 * Return the multiples of lead * 10^exponent between two values, without rounding errors.
 * @param {number} low
 * @param {number} high
 * @param {number} lead
 * @param {number} exponent
 * @returns {number[]}
 */
function multiplesBetween(low, high, lead, exponent) {
  const step = Number(`${lead}e${exponent}`);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const found = [];
  // A span of a few units in the last place has no multiples that differ.
  if (!Number.isSafeInteger(first) || last - first > MOST_TICKS) return [];
  for (let k = first; k <= last; k++) {
    const value = Number(`${k * lead}e${exponent}`);
    found.push(Math.min(high, Math.max(low, value === 0 ? 0 : value)));
  }
  return found;
}

/**
 * @param {number} low
 * @param {number} high
 * @param {number} count
 * @returns {Tick[]}
 */
function linearTicks(low, high, count) {
  const { lead, exponent } = tickStep(high - low, count);
  const values = multiplesBetween(low, high, lead, exponent);
  const largest = Math.max(...values.map(Math.abs), 0);
  const power = largest >= 1e5 || largest < 1e-3 ? Math.floor(Math.log10(largest)) : 0;
  const decimals = Math.min(15, Math.max(0, power - exponent));
  return values.map((value) => {
    if (value === 0) return { value, label: '0' };
    const text = signed((power ? Number(`${value}e${-power}`) || value / 10 ** power : value)
      .toFixed(decimals));
    return { value, label: power ? `${text}×${powerOfTen(power)}` : text };
  });
}

/**
 * @param {number} low
 * @param {number} high
 * @param {number} count
 */
function linearMinor(low, high, count) {
  const { lead, exponent } = tickStep(high - low, count);
  return lead === 2 ? multiplesBetween(low, high, 5, exponent - 1)
    : multiplesBetween(low, high, lead * 2, exponent - 1);
}

/**
 * Return lead * 10^k between two positive values.
 * @param {number} low
 * @param {number} high
 * @param {number[]} leads
 * @param {number} [stride]  of the exponents
 * @returns {number[]}
 */
function logMultiples(low, high, leads, stride = 1) {
  const found = [];
  const last = Math.floor(Math.log10(high) + 1e-9);
  for (let k = Math.floor(Math.log10(low)); k <= last; k++) {
    if (k % stride !== 0) continue;
    for (const lead of leads) {
      const value = Number(`${lead}e${k}`);
      if (value >= low * (1 - 1e-12) && value <= high * (1 + 1e-12)) {
        found.push(Math.min(high, Math.max(low, value)));
      }
    }
  }
  return found;
}

/**
 * @param {number} low
 * @param {number} high
 * @param {number} count
 * @returns {Tick[]}
 */
function logTicks(low, high, count) {
  const choices = [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]]
    .map((leads) => logMultiples(low, high, leads));
  for (let stride = 2; choices[choices.length - 1].length > count && stride < 400; stride *= 2) {
    choices.push(logMultiples(low, high, [1], stride));
  }
  const fit = choices.find((values) => values.length <= count) ?? [];
  if (fit.length < 3 && high / low < 30) return linearTicks(low, high, count);
  return fit.map((value) => ({ value, label: logLabel(value) }));
}

/** @param {number} value */
function logLabel(value) {
  if (value >= 1e-3 && value < 1e5) return numeral(value, 12);
  const exponent = Math.floor(Math.log10(value) + 1e-9);
  const lead = Math.round(value / 10 ** exponent);
  return lead === 1 ? powerOfTen(exponent) : `${lead}×${powerOfTen(exponent)}`;
}

/**
 * @param {number} low
 * @param {number} high
 */
function logMinor(low, high) {
  const values = logMultiples(low, high, [1, 2, 3, 4, 5, 6, 7, 8, 9]);
  return values.length <= MOST_TICKS ? values : [];
}
