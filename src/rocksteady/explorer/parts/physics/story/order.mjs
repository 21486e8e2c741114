// The cascade: what steady shaking comes to as it grows, and two blocks a hair apart.

/** @import { Kernels } from '../../kernels/loader.mjs' */
/** @import { Case, Start } from '../case.mjs' */
/** @import { Kind } from '../attractor.mjs' */
import { attractorOf, startAt } from '../attractor.mjs';
import { historyOf, motionAt } from '../history.mjs';
import { flightPeaks } from '../sweep.mjs';

/**
 * @typedef {object} Order
 * @property {Kind} kind
 * @property {number} period  forcing periods; 0 without an orbit
 * @property {number} lyapunov  largest exponent per forcing period
 * @property {number[]} apart  distance of two blocks in theta/alpha and du/d(pt), once a period
 * @property {number | null} parted  periods after which they are PARTED apart
 */

export const ORDER_RATIO = 2, ORDER_RESTITUTION = 0.8;
export const HAIR = 1e-6; // theta/alpha between two blocks
export const PARTED = 0.1;
export const ORDER_PERIODS = 60;
const ORDER_CYCLES = 600;
const BETWEEN = 0.3; // part of a period at which distances are taken: the start is an impact

/**
 * Return the case of the cascade at an amplitude.
 * @param {number} amplitude
 * @returns {Case}
 */
export function orderCase(amplitude) {
  return {
    amplitude, frequencyRatio: ORDER_RATIO, restitution: ORDER_RESTITUTION, nonlinear: false, alpha: 0.25,
  };
}

/**
 * What a block comes to over amplitudes, each from where the one before has ended.
 * @typedef {object} Cascade
 * @property {number[]} amplitudes  up to the first at which it falls, which is left out
 * @property {Float64Array[]} peaks  largest |theta|/alpha of each flight
 * @property {Start[]} starts  on the motion
 * @property {number | null} falls  the first amplitude at which it does
 */

/**
 * Follow the steady motion up some amplitudes: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ amplitudes: number[] }} asked
 * @returns {Cascade}
 */
export function cascadeOf(kernels, { amplitudes }) {
  /** @type {Start} */
  let start = { kind: 'steady' };
  const peaks = [], starts = [];
  for (const amplitude of amplitudes) {
    const given = orderCase(amplitude), found = attractorOf(kernels, given, start, ORDER_CYCLES);
    if (found.kind === 'overturned') {
      return { amplitudes: amplitudes.slice(0, peaks.length), peaks, starts, falls: amplitude };
    }
    peaks.push(flightPeaks(kernels, given, found).map(Math.abs));
    starts.push(start = found.start ?? start);
  }
  return { amplitudes, peaks, starts, falls: null };
}

/**
 * Return what a motion comes to at an amplitude, and how two blocks part: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ amplitude: number, start: Start }} asked
 * @returns {Order}
 */
export function orderAt(kernels, { amplitude, start }) {
  const given = orderCase(amplitude), found = attractorOf(kernels, given, start, ORDER_CYCLES);
  const on = found.kind === 'aperiodic' && found.state ? startAt(found.state) : found.start;
  const apart = on?.kind === 'impact' ? partingOf(kernels, given, on) : [];
  const parted = apart.findIndex((distance) => distance >= PARTED);
  return {
    kind: found.kind, period: found.period ?? 0, lyapunov: found.lyapunov, apart,
    parted: parted < 0 ? null : parted,
  };
}

/**
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start & { kind: 'impact' }} start
 */
function partingOf(kernels, given, start) {
  const period = (2 * Math.PI) / given.frequencyRatio;
  const times = Array.from({ length: ORDER_PERIODS }, (_, k) => (k + BETWEEN) * period);
  const [one, other] = [0, HAIR].map((more) => {
    const from = { ...start, speed: start.speed + more };
    const history = historyOf(kernels, given, from, ORDER_PERIODS + 1);
    return motionAt(kernels, given, history, times.filter((time) => time <= history.endTime));
  });
  return Array.from({ length: Math.min(one.angle.length, other.angle.length) }, (_, k) =>
    Math.hypot(one.angle[k] - other.angle[k], one.velocity[k] - other.velocity[k]));
}
