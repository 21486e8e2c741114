// One march of a block and what it amounts to: the same bits as `simulate` and `Trajectory` in
// Python.

import { COUNTED } from './case.mjs';

/** @import { Floats, Kernels, March, Tables } from '../kernels/loader.mjs' */

/** @typedef {'rocking'|'at-rest'|'overturned'|'lost-contact'|'undecided'} Status */

/**
 * Impacts in order, an element an impact.
 * @typedef {object} Landings
 * @property {Float64Array} time
 * @property {Float64Array} half  whole half cycles of the shaking
 * @property {Float64Array} phase  within the next one
 * @property {Float64Array} side  from which the block falls
 * @property {Float64Array} before  du/d(pt)
 * @property {Float64Array} after
 */

/**
 * A run in pivot time, angles theta/alpha.
 * @typedef {object} Run
 * @property {Tables} tables
 * @property {Floats} rows  of the flights and rests (kernels/core/tables.py), until the next run
 * @property {number} flights
 * @property {Status} status
 * @property {Float64Array} starts  of the flights and rests
 * @property {number} last  duration of the last one
 * @property {number} end
 * @property {number|null} overturned  when it passes its slenderness for the last time
 * @property {number|null} rested  when it came to rest for good
 * @property {[number, number, number]} peaks  largest |theta|/alpha on either side, and |du/d(pt)|
 * @property {Landings} impacts  that leave with COUNTED or more
 * @property {number} impactCount  with those left out at the limit of flights
 * @property {March} state  in which it ends
 */

/**
 * Where a run begins (at rest), for how many periods endless shaking is followed, and after how
 * many flights the run ends: 64 bytes each.
 * @typedef {{ start?: March, cycles?: number, most?: number }} How
 */

export const RUN_STATUS = /** @type {Status[]} */ ([
  'rocking', 'at-rest', 'overturned', 'lost-contact', 'undecided',
]);
export const FLIGHT_COLUMNS = 8;
export const FLIGHT_SIDE = 3;
export const FLIGHT_DURATION = 6;
const LANDING_ROWS = 6;
const SMALLEST_BOUNCE = 1e-8; // slower chatter may come to rest
const MOST_FLIGHTS = 4_000_000;
const FLIGHT_ROOM = 4096; // flights recorded without counting them before

/** Room for flights, which grows. @type {WeakMap<Kernels, Floats>} */
const flightRooms = new WeakMap();

/**
 * Return room for at least so many flights; 0 for what a run begins with.
 * @param {Kernels} kernels
 * @param {number} flights
 */
function flightRoom(kernels, flights) {
  let room = flightRooms.get(kernels);
  if (!room || room.shape[0] < flights || (!flights && room.shape[0] > 16 * FLIGHT_ROOM)) {
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
export function firstRows(array, rows) {
  return Object.create(array, { shape: { value: [rows, ...array.shape.slice(1)] } });
}

/**
 * Return the march of a block, as a function of its limit of flights and of what it keeps.
 * @param {Kernels} kernels
 * @param {Tables} tables
 * @param {How} how
 * @returns {(limit: number, rows: Floats, peaks: Floats) => [number, March]}
 */
function marchOf(kernels, tables, { start, cycles = 50 }) {
  const [half_cycles, phase] = kernels.segment_start(tables.segments, 0);
  const resting = {
    side: 0, angle: 0, velocity: 0, segment: 0, half_cycles, phase, impacts: 0, flights: 0,
  };
  const [half, rest] = kernels.run_end(tables, cycles);
  return (limit, rows, peaks) => kernels.march(
    tables, start ?? resting,
    { half_cycles: half, phase: rest, rest_velocity: SMALLEST_BOUNCE, limit }, { rows, peaks },
  );
}

/**
 * Return how a run ends, and the largest |theta|/alpha of one that does not overturn.
 * @param {Kernels} kernels
 * @param {Tables} tables
 * @param {How} how
 * @returns {{ status: Status, peak: number }}
 */
export function fateOf(kernels, tables, how) {
  const none = kernels.array('f', [0, FLIGHT_COLUMNS]), peaks = kernels.array('f', [2]);
  const [code] = marchOf(kernels, tables, how)(how.most ?? MOST_FLIGHTS, none, peaks);
  const [peak] = peaks.values;
  none.free();
  peaks.free();
  return { status: RUN_STATUS[code], peak };
}

/**
 * Follow a block, flight by flight.
 * @param {Kernels} kernels
 * @param {Tables} tables
 * @param {How} [how]
 * @returns {Run}
 */
export function runOf(kernels, tables, how = {}) {
  const { most = MOST_FLIGHTS } = how, march = marchOf(kernels, tables, how);
  const nothing = kernels.array('f', [0]);
  // The rows are recorded at once where there is room, and otherwise after counting them.
  let room = flightRoom(kernels, 0);
  let [code, end] = march(Math.min(most, room.shape[0]), room, nothing);
  if (end.flights === room.shape[0] && most > end.flights) {
    const [, counted] = march(most, firstRows(room, 0), nothing);
    room = flightRoom(kernels, counted.flights);
    [code, end] = march(most, room, nothing);
  }
  const { flights } = end, rows = firstRows(room, flights), starts = kernels.array('f', [flights]);
  const facts = kernels.run_facts(tables, rows, code, starts);
  const impacts = impactsOf(kernels, tables, rows, starts);
  const cut = RUN_STATUS[code] === 'at-rest' && flights === most;
  const known = (/** @type {number} */ time) => (Number.isNaN(time) ? null : time);
  const run = {
    tables, rows, flights, status: RUN_STATUS[code], starts: starts.values.slice(),
    last: facts.last, end: facts.end, overturned: known(facts.overturned),
    rested: known(facts.rested), peaks: facts.peaks, impacts,
    impactCount: cut ? end.impacts : impacts.time.length, state: end,
  };
  nothing.free();
  starts.free();
  return run;
}

/**
 * Return the impacts that count.
 * @param {Kernels} kernels
 * @param {Tables} tables
 * @param {Floats} rows
 * @param {Floats} starts
 * @returns {Landings}
 */
function impactsOf(kernels, tables, rows, starts) {
  const flights = rows.shape[0], landings = kernels.array('f', [LANDING_ROWS, flights]);
  const count = kernels.fill_landings(tables, rows, starts, landings), { values } = landings;
  const [time, half, phase, side, before, after] = Array.from({ length: LANDING_ROWS }, (_, row) =>
    values.slice(row * flights, row * flights + count)
      .filter((_, k) => Math.abs(values[5 * flights + k]) >= COUNTED));
  landings.free();
  return { time, half, phase, side, before, after };
}

/**
 * Return in which flight each time lies, and how long after its start.
 * @param {Float64Array} starts
 * @param {ArrayLike<number>} times  in order
 * @returns {[number[], number[]]}
 */
export function flightsAt(starts, times) {
  /** @type {number[]} */
  const index = [], since = [];
  for (let k = 0, row = 0; k < times.length; k += 1) {
    while (row + 1 < starts.length && starts[row + 1] <= times[k]) row += 1;
    index.push(row);
    since.push(Math.max(times[k] - starts[row], 0));
  }
  return [index, since];
}

/**
 * Return angles, velocities and accelerations at times since the starts of rows, one after another.
 * @param {Kernels} kernels
 * @param {Tables} tables
 * @param {Floats} rows
 * @param {[number[], number[]]} places  rows and times, as `flightsAt` has them
 * @returns {Float64Array}
 */
export function statesAt(kernels, { segments, sides }, rows, [index, since]) {
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
