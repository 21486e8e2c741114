// Single pulses as tables of segments, the same bits as `Pulse(...).segments()` in Python.
import { evaluate } from '../case.mjs';

/** @import { Floats, Kernels } from '../../kernels/loader.mjs' */

/**
 * A piece of base acceleration in units of alpha g over pivot time:
 * `constant + slope s + amplitude sin(frequency s + phase)`.
 * @typedef {{ duration: number, constant: number, slope: number, amplitude: number,
 *   frequency: number, phase: number }} Piece
 */

/** Names of the shapes and what they are in words. @type {Record<string, string>} */
export const PULSE_SHAPES = {
  'one-sine': 'sine for a period',
  'one-cosine': 'cosine for a period',
  'half-sine': 'sine for half a period',
  'versed-sine': '(1 − cos)/2 for half a period',
  rectangle: 'constant for half a period',
  triangle: 'up and down along lines in half a period',
  'decaying-ramp': 'at once up, down along a line in half a period',
  'type-c1': 'cosine for 1.43 periods; the ground comes back',
  'type-c2': 'the same for 2.46 periods',
  'type-c3': 'the same for 3.47 periods',
  ricker: 'second derivative of a Gaussian bell',
  'ricker-antisymmetric': 'third derivative of a Gaussian bell',
  'mavroeidis-papageorgiou': 'cosine velocity under a bell of two periods',
};

export const PULSE_TOLERANCE = 1e-6; // of the lines along a wavelet, as a part of its amplitude
const PULSE_COLUMN = {
  duration: 0, constant: 2, slope: 3, amplitude: 4, frequency: 5, phase: 6, ceiling: 7, alike: 8,
  linear: 9, nonlinear: 12, // how many there are
};

// Where a Ricker wavelet falls below the tolerance for good, by `kernels.elementary.roots.root`.
/** @type {Record<string, Record<string, number>>} */
const RICKER_REACH = {
  '0.000001': { even: 5.887603206473685, odd: 6.140905750239072 },
  '0.0001': { even: 4.975578687080307, odd: 5.242733127840895 },
};
const RICKER_BENDS = {
  even: [Math.sqrt(5 - Math.sqrt(10)), Math.sqrt(5 + Math.sqrt(10))],
  odd: [0.6167065902, 1.8891758778, 3.3242574336],
};
const RICKER_CUTS = { even: [0.4, 2.2, 4.2], odd: [1.1, 2.6, 4.6] };
const MAVROEIDIS_PEAK = 0.9060248235438082; // acceleration of a velocity of 1 at w = 1
const PI_REST = 1.2246467991473532e-16; // pi less the double that stands for it

/**
 * @param {number} duration
 * @param {Partial<Piece>} [given]
 * @returns {Piece}
 */
export function basePiece(duration, given = {}) {
  return { duration, constant: 0, slope: 0, amplitude: 0, frequency: 0, phase: 0, ...given };
}

/**
 * Return the values of an elementary function of the kernels, in one call.
 * @param {Kernels} kernels
 * @param {'exp'|'sin'|'cos'} name
 * @param {ArrayLike<number>} values
 * @returns {Float64Array}
 */
export function evaluateEach(kernels, name, values) {
  const given = kernels.array('f', [values.length], values);
  const out = kernels.array('f', [values.length]);
  /** @type {Record<string, Function>} */ (/** @type {unknown} */ (kernels))[`fill_${name}`](given, out);
  const found = out.values.slice();
  given.free();
  out.free();
  return found;
}

/**
 * Return the pieces of a pulse.
 * @param {Kernels} kernels
 * @param {string} shape  one of PULSE_SHAPES
 * @param {number} a  largest acceleration over alpha g
 * @param {number} w  omega/p
 * @param {number} [tolerance]  of the lines along a wavelet, PULSE_TOLERANCE or 1e-4
 * @returns {Piece[]}
 */
export function pulsePieces(kernels, shape, a, w, tolerance = PULSE_TOLERANCE) {
  const half = Math.PI / w, whole = (2 * Math.PI) / w, quarter = (0.5 * Math.PI) / w;
  switch (shape) {
    case 'rectangle': return [basePiece(half, { constant: a })];
    case 'half-sine': return [basePiece(half, { amplitude: a, frequency: w })];
    case 'versed-sine': return [basePiece(half, {
      constant: 0.5 * a, amplitude: 0.5 * a, frequency: 2 * w, phase: -0.5 * Math.PI,
    })];
    case 'triangle': return [
      basePiece(quarter, { slope: a / quarter }), basePiece(quarter, { constant: a, slope: -a / quarter }),
    ];
    case 'decaying-ramp': return [basePiece(half, { constant: a, slope: -a / half })];
    case 'one-sine': return [basePiece(whole, { amplitude: a, frequency: w })];
    case 'one-cosine':
      return [basePiece(whole, { amplitude: a, frequency: w, phase: 0.5 * Math.PI })];
    case 'ricker': return rickerLines(kernels, 'even', a, w, tolerance);
    case 'ricker-antisymmetric': return rickerLines(kernels, 'odd', a, w, tolerance);
    case 'mavroeidis-papageorgiou': return mavroeidisLines(kernels, a, w, tolerance);
    default: return [typeC(kernels, Number(shape.slice('type-c'.length)), a, w)];
  }
}

/**
 * @param {Kernels} kernels
 * @param {number} n  number of the type C pulse
 * @param {number} a
 * @param {number} w
 * @returns {Piece}
 */
function typeC(kernels, n, a, w) {
  const turn = (2 * n + 1) * Math.PI;
  let phi = 0;
  for (let k = 0; k < 20; k += 1) phi = evaluate(kernels, 'atan2', 2, turn - 2 * phi);
  return basePiece((turn - 2 * phi) / w, { amplitude: a, frequency: w, phase: phi + 0.5 * Math.PI });
}

/**
 * Return straight lines between even samples.
 * @param {ArrayLike<number>} values
 * @param {number} step
 * @returns {Piece[]}
 */
function linesBetween(values, step) {
  /** @type {Piece[]} */
  const lines = [];
  for (let k = 0; k + 1 < values.length; k += 1) {
    const [constant, slope] = [values[k], (values[k + 1] - values[k]) / step];
    lines.push({ duration: step, constant, slope, amplitude: 0, frequency: 0, phase: 0 });
  }
  return lines;
}

/**
 * @param {number} start
 * @param {number} stop
 * @param {number} count  of intervals
 * @returns {Float64Array}
 */
export function evenlyBetween(start, stop, count) {
  const step = (stop - start) / count;
  return Float64Array.from({ length: count + 1 }, (_, k) => k < count ? k * step + start : stop);
}

/**
 * @param {Kernels} kernels
 * @param {'even'|'odd'} kind
 * @param {number} a
 * @param {number} w
 * @param {number} tolerance
 * @returns {Piece[]}
 */
function rickerLines(kernels, kind, a, w, tolerance) {
  const odd = kind === 'odd';
  const crest = Math.sqrt(3 - Math.sqrt(6));
  const peak = crest * (3 - crest * crest) * evaluate(kernels, 'exp', -0.5 * crest * crest);
  /** @param {ArrayLike<number>} all */
  const bells = (all) => evaluateEach(kernels, 'exp', Float64Array.from(all, (u) => -0.5 * u * u));
  /** @param {number} u */
  const bend = (u) => {
    const square = u * u, bell = evaluate(kernels, 'exp', -0.5 * square);
    if (odd) return Math.abs(u * (square * (square - 10) + 15)) * bell / peak;
    return Math.abs(square * (square - 6) + 3) * bell;
  };
  /** @param {number} low @param {number} high */
  const steepest = (low, high) => (1 + 1e-9) * Math.max(
    ...[low, high, ...RICKER_BENDS[kind]].filter((u) => low <= u && u <= high).map(bend));
  const unit = Math.sqrt(odd ? 3 : 2) / w;
  const reach = RICKER_REACH[String(tolerance)][kind];
  const ends = [0, ...RICKER_CUTS[kind].filter((cut) => cut < reach), reach];
  const half = ends.slice(1).map((high, k) => ({
    time: unit * (high - ends[k]), curvature: steepest(ends[k], high) / (unit * unit),
  }));
  /** @type {Piece[]} */
  const lines = [];
  let start = 0;
  for (const { time, curvature } of [...half.slice().reverse(), ...half]) {
    const count = Math.max(1, Math.ceil(time * Math.sqrt(curvature / (8 * tolerance))));
    const at = evenlyBetween(start, start + time, count).map((s) => s / unit - reach);
    const bell = bells(at);
    const values = at.map((u, k) =>
      a * (odd ? u * (u * u - 3) * bell[k] / peak : (1 - u * u) * bell[k]));
    lines.push(...linesBetween(values, time / count));
    start += time;
  }
  return lines;
}

/**
 * Return straight lines along a Mavroeidis-Papageorgiou pulse of gamma = 2 and nu = 0.
 * @param {Kernels} kernels
 * @param {number} a
 * @param {number} w
 * @param {number} tolerance
 * @returns {Piece[]}
 */
function mavroeidisLines(kernels, a, w, tolerance) {
  const v = 1 / (w * MAVROEIDIS_PEAK), start = (-2 * Math.PI) / w, duration = -2 * start;
  const waves = [[0.5, 1], [0.25, 1.5], [0.25, 0.5]].map(([share, turns]) => {
    const frequency = turns * w, size = v * share * turns * w;
    // A negative amplitude is a positive one half a cycle on; the phase is not above 0.
    const turned = remainder2Pi((turns * w * start + 0 + Math.PI) + PI_REST);
    const sine = evaluate(kernels, 'sin', turned), cosine = evaluate(kernels, 'cos', turned);
    return { frequency, one: 0 + size * cosine, other: 0 + size * sine };
  });
  const curvature = waves.reduce((sum, { frequency, one, other }) =>
    sum + evaluate(kernels, 'hypot', one, other) * frequency * frequency, 0);
  const count = Math.max(1, Math.ceil(duration * Math.sqrt(curvature / (8 * tolerance))));
  const at = evenlyBetween(0, duration, count);
  const values = new Float64Array(count + 1);
  for (const { frequency, one, other } of waves) {
    const turned = at.map((s) => frequency * s);
    const sine = evaluateEach(kernels, 'sin', turned), cosine = evaluateEach(kernels, 'cos', turned);
    for (let k = 0; k <= count; k += 1) values[k] += one * sine[k] + other * cosine[k];
  }
  return linesBetween(values, duration / count).map((line) =>
    ({ ...line, constant: a * line.constant, slope: a * line.slope }));
}

/**
 * Return what IEEE's remainder by 2 pi is for a few turns; the product and difference are exact.
 * @param {number} x
 * @returns {number}
 */
function remainder2Pi(x) {
  const turns = Math.round(x / (2 * Math.PI));
  return x - turns * (2 * Math.PI);
}

/**
 * Return the table of some pieces; free it.
 * @param {Kernels} kernels
 * @param {Piece[]} pieces
 * @param {{ nonlinear: boolean, still?: boolean, ceiling?: boolean }} how  still: whether a still
 *   base follows; ceiling false: infinite ones, as a search for windows has them
 * @returns {Floats}
 */
export function tableOfPieces(kernels, pieces, { nonlinear, still = true, ceiling = true }) {
  const rows = still ? [...pieces, basePiece(Infinity)] : pieces;
  const columns = nonlinear ? PULSE_COLUMN.nonlinear : PULSE_COLUMN.linear;
  const values = new Float64Array(rows.length * columns);
  let highest = 0, alike = 0;
  for (let k = rows.length - 1; k >= 0; k -= 1) {
    const row = rows[k], at = k * columns;
    const end = row.constant + (row.duration === Infinity ? 0 : row.slope * row.duration);
    highest = Math.max(highest, Math.max(Math.abs(row.constant), Math.abs(end)) + row.amplitude);
    const next = rows[k + 1];
    const plain = row.duration !== Infinity && row.frequency === 0 && next?.frequency === 0
      && row.duration === next.duration;
    alike = plain ? alike + 1 : 0;
    values[at + PULSE_COLUMN.duration] = row.duration;
    values[at + PULSE_COLUMN.constant] = row.constant;
    values[at + PULSE_COLUMN.slope] = row.slope;
    values[at + PULSE_COLUMN.amplitude] = row.amplitude;
    values[at + PULSE_COLUMN.frequency] = row.frequency;
    values[at + PULSE_COLUMN.phase] = row.frequency ? row.phase : 0;
    values[at + PULSE_COLUMN.ceiling] = ceiling ? highest : Infinity;
    values[at + PULSE_COLUMN.alike] = alike;
  }
  return kernels.array('f', [rows.length, columns], values);
}
