// The time history of a block under harmonic shaking: dynamics/history/simulate.py, trajectory.py.

import { COUNTED, evaluate, sidesOf } from './case.mjs';
import { FULL_TURN, beginOf, turnedPhase } from './start.mjs';

/** @import { Floats, Kernels } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */
/** @import { Impact } from './start.mjs' */

/** @typedef {'rocking'|'at-rest'|'overturned'|'lost-contact'|'undecided'} Status */

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

export const RUN_STATUS = /** @type {Status[]} */ ([
  'rocking', 'at-rest', 'overturned', 'lost-contact', 'undecided',
]);
export const FLIGHT_COLUMNS = 8;
export const FLIGHT_HALF = 1;
export const FLIGHT_PHASE = 2;
export const FLIGHT_SIDE = 3;
export const FLIGHT_ANGLE = 4;
export const FLIGHT_DURATION = 6;
export const FLIGHT_EVENT = 7;
export const BY_IMPACT = 1;
export const AT_REST = 1; // its place in RUN_STATUS
const SMALLEST_BOUNCE = 1e-8; // slower chatter may come to rest
const OVERTURNED_SHOWN_TO = 2; // theta/alpha up to which a fall is followed
const HISTORY_FLIGHTS = 4_000_000;
const SECTION_FLIGHTS = 20_000;
const FLIGHT_ROOM = 4096; // flights recorded without counting them before

/** Room for flights, which grows. @type {WeakMap<Kernels, Floats>} */
const flightRooms = new WeakMap();

/**
 * Return room for at least so many flights.
 * @param {Kernels} kernels
 * @param {number} flights
 */
function flightRoom(kernels, flights) {
  let room = flightRooms.get(kernels);
  if (!room || room.shape[0] < flights) {
    room?.free();
    room = kernels.array('f', [Math.max(flights, FLIGHT_ROOM), FLIGHT_COLUMNS]);
    flightRooms.set(kernels, room);
  }
  return room;
}

/**
 * Return the first rows of an array, which stay where they are.
 * @param {Floats} array
 * @param {number} rows
 * @returns {Floats}
 */
function firstRows(array, rows) {
  return Object.create(array, { shape: { value: [rows, ...array.shape.slice(1)] } });
}

/**
 * Compute the time history of a block, as `rocksteady.simulate`.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start} start
 * @param {number} cycles  periods of the shaking to follow
 * @param {number} [most]  flights after which the run ends: 64 bytes each
 * @returns {History}
 */
export function historyOf(kernels, given, start, cycles, most = HISTORY_FLIGHTS) {
  const { phase, march } = beginOf(kernels, given, start);
  const sides = sidesOf(kernels, given);
  const segments = shakingOf(kernels, given, phase);
  const [firstHalf, firstPhase] = kernels.segment_start(segments, 0);
  const halves = Math.floor(2 * cycles);
  let stopHalf = firstHalf + halves;
  let stopPhase = firstPhase + (2 * cycles - halves) * Math.PI;
  if (stopPhase >= Math.PI) {
    stopHalf += 1;
    stopPhase -= Math.PI;
  }
  const none = kernels.array('f', [0]);
  // The rows are recorded at once where there is room, and otherwise after counting them.
  let room = flightRoom(kernels, 0);
  const run = (/** @type {number} */ limit, /** @type {Floats} */ rows) => kernels.march(
    { segments, sides }, march,
    { half_cycles: stopHalf, phase: stopPhase, rest_velocity: SMALLEST_BOUNCE, limit },
    { rows, peaks: none },
  );
  let [code, end] = run(Math.min(most, room.shape[0]), room);
  if (end.flights === room.shape[0] && most > room.shape[0]) {
    const nothing = firstRows(room, 0);
    const [, counted] = run(most, nothing);
    room = flightRoom(kernels, counted.flights);
    [code, end] = run(most, room);
  }
  const flights = end.flights, rows = firstRows(room, flights);
  const found = measuredRun(kernels, given, {
    status: RUN_STATUS[code], phase, flights, segments, sides, rows, firstHalf, firstPhase,
    known: code === AT_REST && flights === most ? end.impacts : null,
  });
  for (const array of [sides, segments, none]) array.free();
  if (room.shape[0] > 16 * FLIGHT_ROOM) {
    flightRooms.delete(kernels);
    room.free();
  }
  return found;
}

/**
 * Return the table of the shaking; free it.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {number} phase  at the start [rad]
 */
function shakingOf(kernels, given, phase) {
  const segments = kernels.array('f', [1, given.nonlinear ? 12 : 9]);
  kernels.harmonic_segment(segments, given.amplitude, given.frequencyRatio, phase);
  return segments;
}

/**
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {{ status: Status, phase: number, flights: number, segments: Floats, sides: Floats,
 *   rows: Floats, firstHalf: number, firstPhase: number, known: number | null }} run
 *   known: impacts of a run that came to rest at its limit of flights
 * @returns {History}
 */
function measuredRun(kernels, given, run) {
  const { status, phase, flights, segments, sides, rows } = run;
  const values = rows.values.slice(0, flights * FLIGHT_COLUMNS), starts = new Float64Array(flights);
  let latest = 0;
  for (let row = 0; row < flights; row++) {
    const half = values[row * FLIGHT_COLUMNS + FLIGHT_HALF] - run.firstHalf;
    const local = values[row * FLIGHT_COLUMNS + FLIGHT_PHASE] - run.firstPhase;
    latest = Math.max(latest, 0 + (half * Math.PI + local) / given.frequencyRatio);
    starts[row] = latest;
  }
  const last = (flights - 1) * FLIGHT_COLUMNS;
  let lastDuration = values[last + FLIGHT_DURATION], overturnTime = null;
  if (status === 'overturned') {
    if (!Number.isFinite(lastDuration)) {
      let level = Math.max(OVERTURNED_SHOWN_TO, 1 + Math.abs(values[last + FLIGHT_ANGLE]));
      if (given.nonlinear) level = Math.min(level, (0.5 * Math.PI) / given.alpha);
      const [row, since] = kernels.last_crossing(segments, sides, rows, level);
      lastDuration = row === flights - 1 ? since : 0;
    }
    const [row, since] = kernels.last_crossing(segments, sides, rows, 1);
    overturnTime = starts[row] + since;
  }
  const [positive, negative, peakVelocity] = status === 'overturned'
    ? kernels.peaks_until_overturning(segments, sides, rows)
    : kernels.recorded_peaks(segments, sides, rows, lastDuration);
  const landings = landingsOf(kernels, given, { segments, sides, rows, values, starts });
  const impacts = countedOf(landings);
  return {
    status,
    phase,
    flights,
    rows: values,
    starts,
    lastDuration,
    endTime: starts[flights - 1] + lastDuration,
    overturnTime,
    restTime: status === 'at-rest'
      ? restTimeOf(kernels, given, values, starts, landings, phase) : null,
    sidePeaks: [positive, negative],
    peak: Math.max(positive, negative),
    peakVelocity,
    impacts,
    impactCount: run.known ?? impacts.time.length,
  };
}

/**
 * Return the impacts that count.
 * @param {HistoryImpacts} landings
 * @returns {HistoryImpacts}
 */
function countedOf({ time, phase, side, before, after }) {
  const counts = (/** @type {number} */ _, /** @type {number} */ k) => Math.abs(after[k]) >= COUNTED;
  return {
    time: time.filter(counts), phase: phase.filter(counts), side: side.filter(counts),
    before: before.filter(counts), after: after.filter(counts),
  };
}

/**
 * Return all impacts, however slow.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {{ segments: Floats, sides: Floats, rows: Floats, values: Float64Array,
 *   starts: Float64Array }} run
 * @returns {HistoryImpacts}
 */
function landingsOf(kernels, given, { segments, sides, rows, values, starts }) {
  const index = [];
  for (let row = 0; row < starts.length; row++) {
    if (values[row * FLIGHT_COLUMNS + FLIGHT_EVENT] === BY_IMPACT) index.push(row);
  }
  const since = index.map((row) => values[row * FLIGHT_COLUMNS + FLIGHT_DURATION]);
  const states = statesAt(kernels, segments, sides, rows, index, since);
  const before = states.slice(index.length, 2 * index.length);
  const last = starts.length - 1;
  const after = index.map((row) => Math.min(row + 1, last));
  return {
    time: Float64Array.from(index, (row, k) =>
      row === last ? starts[row] + since[k] : starts[after[k]]),
    phase: Float64Array.from(after, (row) => {
      const at = row * FLIGHT_COLUMNS, odd = values[at + FLIGHT_HALF] % 2 !== 0 ? 1 : 0;
      return turnedPhase(odd * Math.PI + values[at + FLIGHT_PHASE]);
    }),
    side: Int8Array.from(index, (row) => values[row * FLIGHT_COLUMNS + FLIGHT_SIDE]),
    before,
    after: before.map((speed) => given.restitution * speed),
  };
}

/**
 * Return angles, velocities and accelerations at times since the starts of rows, one after another.
 * @param {Kernels} kernels
 * @param {Floats} segments
 * @param {Floats} sides
 * @param {Floats} rows
 * @param {ArrayLike<number>} index
 * @param {ArrayLike<number>} since
 * @returns {Float64Array}
 */
export function statesAt(kernels, segments, sides, rows, index, since) {
  const count = index.length;
  const times = kernels.array('f', [count], since), given = kernels.array('i', [count]);
  // The lower halves of 64 bits: quicker than a BigInt each.
  const { buffer, byteOffset } = given.values;
  const halves = new Int32Array(buffer, byteOffset, 2 * count);
  for (let k = 0; k < count; k++) halves[2 * k] = index[k];
  const states = kernels.array('f', [3, count]);
  kernels.fill_states(segments, sides, rows, given, times, states);
  const found = states.values.slice();
  for (const array of [given, times, states]) array.free();
  return found;
}

/**
 * Return when a block came to rest where it stayed, the bounces that are not recorded included.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Float64Array} values
 * @param {Float64Array} starts
 * @param {HistoryImpacts} landings
 * @param {number} phase
 */
function restTimeOf(kernels, given, values, starts, landings, phase) {
  let first = starts.length;
  while (first > 0 && values[(first - 1) * FLIGHT_COLUMNS + FLIGHT_SIDE] === 0) first--;
  const start = starts[first];
  if (first === 0 || values[(first - 1) * FLIGHT_COLUMNS + FLIGHT_EVENT] !== BY_IMPACT) {
    return start;
  }
  const velocity = Math.abs(landings.after[landings.after.length - 1]);
  const base = given.amplitude * evaluate(kernels, 'sin', given.frequencyRatio * start + phase);
  const towards = -values[(first - 1) * FLIGHT_COLUMNS + FLIGHT_SIDE] * base;
  const pull = (/** @type {number} */ push) => {
    if (!given.nonlinear) return 1 - push;
    const own = evaluate(kernels, 'sin', given.alpha) / given.alpha;
    return own - push * evaluate(kernels, 'cos', given.alpha);
  };
  const r = given.restitution, lost = (1 - r) * (1 + r) + (r - r);
  return start + (2 * velocity * (1 / pull(towards) + r / pull(-towards))) / lost;
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
  const { starts } = history, index = new Array(times.length), since = new Array(times.length);
  let row = 0;
  for (let k = 0; k < times.length; k++) {
    while (row + 1 < starts.length && starts[row + 1] <= times[k]) row++;
    index[k] = row;
    since[k] = Math.max(times[k] - starts[row], 0);
  }
  const states = statesOfRun(kernels, given, history, index, since), count = times.length;
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
 * @param {ArrayLike<number>} index
 * @param {ArrayLike<number>} since
 */
function statesOfRun(kernels, given, history, index, since) {
  const sides = sidesOf(kernels, given), segments = shakingOf(kernels, given, history.phase);
  const rows = kernels.array('f', [history.flights, FLIGHT_COLUMNS], history.rows);
  const states = statesAt(kernels, segments, sides, rows, index, since);
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
  const count = index.length, states = statesOfRun(kernels, given, history, index, since);
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
