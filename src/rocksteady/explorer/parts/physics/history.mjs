// The time history of a block under harmonic shaking: dynamics/history/simulate.py, trajectory.py.

import { sidesOf } from './case.mjs';
import { harmonicTable } from './motions.mjs';
import { FLIGHT_COLUMNS, FLIGHT_DURATION, FLIGHT_SIDE, flightsAt, runOf, statesAt } from './run.mjs';
import { FULL_TURN, beginOf, turnedPhase } from './start.mjs';

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */
/** @import { Status } from './run.mjs' */
/** @import { Impact } from './start.mjs' */

/**
 * A curve to draw: of an impact both the state before it and that after it.
 * @typedef {object} Course
 * @property {Float64Array} periods  time in periods of the shaking
 * @property {Float64Array} angle  theta/alpha
 * @property {Float64Array} velocity  du/d(pt)
 */

/**
 * What `rocksteady.simulate` returns; times are pivot times p t.
 * @typedef {object} History
 * @property {Status} status
 * @property {number} phase  of the shaking at the start [rad]
 * @property {number} flights
 * @property {Float64Array} rows  of the flights and rests, 8 columns (kernels/core/tables.py)
 * @property {Float64Array} starts  times at which they begin
 * @property {number} lastDuration  of the last one
 * @property {number} endTime
 * @property {number|null} overturnTime  when it passes its slenderness for the last time
 * @property {number|null} restTime  when it came to rest for good
 * @property {[number, number]} sidePeaks  largest |theta|/alpha on either side
 * @property {number} peak
 * @property {number} peakVelocity
 * @property {HistoryImpacts} impacts  that leave with COUNTED or more
 * @property {number} impactCount  with those left out at the limit of flights
 */

/**
 * @typedef {object} HistoryImpacts
 * @property {Float64Array} time
 * @property {Float64Array} phase  of the shaking, from 0 to 2 pi [rad]
 * @property {Int8Array} side  from which the block falls
 * @property {Float64Array} before  du/d(pt)
 * @property {Float64Array} after
 */

const SECTION_FLIGHTS = 20_000;

/**
 * Compute the time history of a block, as `rocksteady.simulate`.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start} start
 * @param {number} cycles  periods of the shaking to follow
 * @param {number} [most]  flights after which the run ends
 * @returns {History}
 */
export function historyOf(kernels, given, start, cycles, most) {
  const { phase, march } = beginOf(kernels, given, start);
  const segments = harmonicTable(kernels, given, phase), sides = sidesOf(kernels, given);
  const run = runOf(kernels, { segments, sides }, { start: march, cycles, most });
  segments.free();
  sides.free();
  const { impacts, flights } = run, [positive, negative, peakVelocity] = run.peaks;
  return {
    status: run.status,
    phase,
    flights,
    rows: run.rows.values.slice(0, flights * FLIGHT_COLUMNS),
    starts: run.starts,
    lastDuration: run.last,
    endTime: run.end,
    overturnTime: run.overturned,
    restTime: run.rested,
    sidePeaks: [positive, negative],
    peak: Math.max(positive, negative),
    peakVelocity,
    impacts: {
      time: impacts.time,
      phase: impacts.phase.map((rest, k) =>
        turnedPhase((impacts.half[k] % 2 !== 0 ? 1 : 0) * Math.PI + rest)),
      side: Int8Array.from(impacts.side),
      before: impacts.before,
      after: impacts.after,
    },
    impactCount: run.impactCount,
  };
}

/**
 * Return the motion at times of a history.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {History} history
 * @param {ArrayLike<number>} times  pivot times in order, from 0 to its end
 * @returns {{ angle: Float64Array, velocity: Float64Array, acceleration: Float64Array }}
 */
export function motionAt(kernels, given, history, times) {
  const states = statesOfRun(kernels, given, history, flightsAt(history.starts, times));
  const count = times.length;
  return {
    angle: states.subarray(0, count),
    velocity: states.subarray(count, 2 * count),
    acceleration: states.subarray(2 * count),
  };
}

/**
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {History} history
 * @param {[number[], number[]]} places
 */
function statesOfRun(kernels, given, history, places) {
  const sides = sidesOf(kernels, given), segments = harmonicTable(kernels, given, history.phase);
  const rows = kernels.array('f', [history.flights, FLIGHT_COLUMNS], history.rows);
  const states = statesAt(kernels, { segments, sides }, rows, places);
  for (const array of [sides, segments, rows]) array.free();
  return states;
}

/**
 * Return a curve of a history to draw, at most some twice `most` points.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {History} history
 * @param {number} perPeriod  samples of a period of the shaking
 * @param {number} [most]  samples; with more flights than that, of a part of them
 * @returns {Course}
 */
export function courseOf(kernels, given, history, perPeriod, most = 8000) {
  const { starts, flights, rows, endTime } = history, last = flights - 1;
  const period = FULL_TURN / given.frequencyRatio;
  const step = Math.max(period / perPeriod, endTime / most);
  /** @type {number[]} */
  const index = [], since = [], times = [];
  const fewest = 16 * flights < most ? 8 : 1; // parts of a flight, so that it is seen to be round
  let shown = -Infinity;
  for (let row = 0; row < flights; row++) {
    const at = row * FLIGHT_COLUMNS;
    const lasts = row === last ? history.lastDuration : rows[at + FLIGHT_DURATION];
    // Of bounces that no picture can tell apart one a step is drawn, and the last.
    if (lasts < 0.1 * step && starts[row] < shown + 0.1 * step && row !== last) continue;
    shown = starts[row];
    const parts = rows[at + FLIGHT_SIDE] === 0 ? 1 : Math.max(fewest, Math.ceil(lasts / step));
    for (let part = 0; part <= parts; part++) {
      index.push(row);
      since.push(part === parts ? lasts : (lasts * part) / parts);
      times.push((starts[row] + since[since.length - 1]) / period);
    }
  }
  const count = index.length, states = statesOfRun(kernels, given, history, [index, since]);
  return {
    periods: Float64Array.from(times),
    angle: states.slice(0, count),
    velocity: states.slice(count, 2 * count),
  };
}

/**
 * Return the states after the impacts of a history: its points in the Poincare section.
 * @param {History} history
 * @param {number} [from]  pivot time from which they count
 * @returns {Impact[]}
 */
export function sectionOf({ impacts }, from = 0) {
  const points = [];
  for (let k = 0; k < impacts.time.length; k++) {
    if (impacts.time[k] < from) continue;
    const speed = impacts.after[k];
    points.push({ side: speed > 0 ? 1 : -1, phase: impacts.phase[k], speed: Math.abs(speed) });
  }
  return points;
}

/**
 * Return the times at which the phase of the shaking is 0.
 * @param {Case} given
 * @param {History} history
 * @returns {number[]}  pivot times
 */
export function periodTimes({ frequencyRatio }, { phase, endTime }) {
  const period = FULL_TURN / frequencyRatio, before = phase / FULL_TURN, times = [];
  for (let k = Math.ceil(before); (k - before) * period <= endTime; k++) {
    times.push((k - before) * period);
  }
  return times;
}

/**
 * States after impacts, and those once a period.
 * @typedef {object} SectionPoints
 * @property {Float64Array} phase  from 0 to 2 pi [rad]
 * @property {Float64Array} speed
 * @property {Float64Array} angle
 * @property {Float64Array} velocity
 */

/**
 * Return the Poincare section of a motion that does not repeat: a job for a worker.
 * @param {Kernels} kernels
 * @param {{ given: Case, start: Start, cycles: number }} asked
 * @returns {SectionPoints}
 */
export function longSection(kernels, { given, start, cycles }) {
  const run = historyOf(kernels, given, start, cycles, SECTION_FLIGHTS);
  const { angle, velocity } = motionAt(kernels, given, run, periodTimes(given, run));
  return {
    phase: run.impacts.phase,
    speed: run.impacts.after.map(Math.abs),
    angle: angle.slice(),
    velocity: velocity.slice(),
  };
}
