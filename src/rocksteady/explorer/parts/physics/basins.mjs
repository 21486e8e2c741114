// Basins of attraction: what each initial state of a window settles to, in the order of
// `rocksteady.compute_basins` (dynamics/basins): cells first, then labels of distinct attractors.

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Case } from './case.mjs' */
/** @import { Impact } from './start.mjs' */
/** @import { Kind, Orbit } from './attractor.mjs' */
import { START_WINDOW } from '../kernels/window.mjs';
import { systemOf } from './case.mjs';
import { ATTRACTOR_KINDS, ORBIT_COLUMNS, attractorKind, orbitFrom } from './attractor.mjs';
import { settledRows } from './settled.mjs';
import { FULL_TURN } from './start.mjs';
import { impactSection } from './sweep.mjs';

/**
 * What states settle to, an element a state; kind -1 where it is not computed yet.
 * @typedef {object} Cells
 * @property {Int8Array} kind  index of ATTRACTOR_KINDS
 * @property {Int8Array} side  of a state on the orbit, whose phase and speed are below
 * @property {Int32Array} period  forcing periods of the orbit; 0 without one
 * @property {Int32Array} passages
 * @property {Int32Array} rests
 * @property {Float64Array} phase
 * @property {Float64Array} speed
 */

/**
 * Attractor of the states of one basin.
 * @typedef {object} BasinAttractor
 * @property {Kind} kind
 * @property {string} name  kind, period and a letter where several have both in common
 * @property {Orbit | null} orbit
 * @property {number | null} period  forcing periods of the orbit
 * @property {number} states  how many states of the window go there
 */

const SAME_ORBIT = 1e-6, SLOWEST = 1e-3; // distance of one state, speed that errors are of at least
/** @type {Kind[]} */
const LABEL_ORDER = ['overturned', 'rest', 'symmetric', 'unsymmetric', 'aperiodic', 'undecided'];

/**
 * Return room for the results of a number of states, none of them computed.
 * @param {number} count
 * @returns {Cells}
 */
export function emptyCells(count) {
  return {
    kind: new Int8Array(count).fill(-1),
    side: new Int8Array(count),
    period: new Int32Array(count),
    passages: new Int32Array(count),
    rests: new Int32Array(count),
    phase: new Float64Array(count),
    speed: new Float64Array(count),
  };
}

/**
 * Follow states from phase 0 until it is known what they settle to: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ given: Case, angles: ArrayLike<number>, velocities: ArrayLike<number>,
 *   cycles?: number }} asked  an angle and a velocity a state
 * @returns {Cells}
 */
export function settleStates(kernels, { given, angles, velocities, cycles = START_WINDOW.cycles }) {
  const cells = emptyCells(angles.length);
  const every = (/** @type {number} */ value) => new Float64Array(angles.length).fill(value);
  settledRows(kernels, given, { amplitude: every(given.amplitude),
    ratio: every(given.frequencyRatio), angle: angles, velocity: velocities, phase: every(0),
  }, cycles).forEach(({ whole, real }, cell) => {
    const [outcome, side, passages, period, rests, symmetric] = whole;
    const [phase, speed, , , , least] = real;
    cells.kind[cell] = ATTRACTOR_KINDS.indexOf(
      attractorKind(Number(outcome), symmetric !== 0n, least, given.restitution));
    cells.side[cell] = Number(side);
    cells.period[cell] = Number(period);
    cells.passages[cell] = Number(passages);
    cells.rests[cell] = Number(rests);
    cells.phase[cell] = phase;
    cells.speed[cell] = speed;
  });
  return cells;
}

/**
 * Number the attractors that states have found: the label of each state, -1 where it is not
 * computed, and the attractors in the order of their labels.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Cells} cells
 * @returns {{ label: Int16Array, attractors: BasinAttractor[] }}
 */
export function labelStates(kernels, given, cells) {
  const label = new Int16Array(cells.kind.length).fill(-1);
  /** @type {{ kind: Kind, orbit: Orbit | null, of: number[] }[]} */
  const found = [];
  for (const kind of LABEL_ORDER.filter((name) => !/symmetric/.test(name))) {
    const code = ATTRACTOR_KINDS.indexOf(kind);
    const of = placesWhere(cells.kind, (value) => value === code);
    if (of.length) found.push({ kind, orbit: null, of });
  }
  let left = placesWhere(cells.period, (period) => period > 0);
  while (left.length) {
    const first = left[0], orbit = orbitOfCell(kernels, given, cells, first);
    const of = /** @type {number[]} */ ([]), others = /** @type {number[]} */ ([]);
    for (const cell of left) {
      (cell === first || isOn(orbit, cells, cell, first) ? of : others).push(cell);
    }
    found.push({ kind: orbit.symmetric ? 'symmetric' : 'unsymmetric', orbit, of });
    left = others;
  }
  found.sort((one, other) => compareKeys(labelKey(one), labelKey(other)));
  const names = attractorNames(found);
  found.forEach(({ of }, place) => { for (const cell of of) label[cell] = place; });
  const attractors = found.map(({ kind, orbit, of }, place) =>
    ({ kind, name: names[place], orbit, period: orbit && orbit.period, states: of.length }));
  return { label, attractors };
}

/**
 * Return the middles of equal cells between two ends, mirrored exactly where these are: as
 * `centred` of dynamics/basins/window.py gives them.
 * @param {number} from
 * @param {number} to
 * @param {number} count
 * @returns {Float64Array}
 */
export function cellMiddles(from, to, count) {
  const middle = 0.5 * (from + to), step = (to - from) / count;
  return Float64Array.from({ length: count }, (_, place) => middle + (place - 0.5 * (count - 1)) * step);
}

/** @param {ArrayLike<number>} values @param {(value: number, place: number) => boolean} holds */
function placesWhere(values, holds) {
  const places = [];
  for (let place = 0; place < values.length; place += 1) {
    if (holds(values[place], place)) places.push(place);
  }
  return places;
}

/**
 * Return the orbit of a cell, started where it would be whichever cell had found it.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Cells} cells
 * @param {number} cell
 */
function orbitOfCell(kernels, given, cells, cell) {
  const { [cell]: passages } = cells.passages, { [cell]: period } = cells.period;
  const state = { side: cells.side[cell], phase: cells.phase[cell], speed: cells.speed[cell] };
  const orbit = orbitThrough(kernels, given, state, passages, period);
  /** @param {Impact} here */
  const key = (here) => [Number(here.speed > 0), (here.phase + SAME_ORBIT) % FULL_TURN];
  const begin = orbit.states.reduce(
    (best, here) => (compareKeys(key(here), key(best)) < 0 ? here : best));
  return begin === orbit.states[0] ? orbit : orbitThrough(kernels, given, begin, passages, period);
}

/**
 * Return the orbit through a state that lies on it.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Impact} state
 * @param {number} passages
 * @param {number} periods
 * @returns {Orbit}
 */
function orbitThrough(kernels, given, state, passages, periods) {
  const system = systemOf(kernels, given), table = kernels.array('f', [passages, ORBIT_COLUMNS]);
  const begin = impactSection(kernels, state);
  const { residual } = kernels.polish(system, begin, passages, periods, table);
  const orbit = orbitFrom(kernels, system, { passages, periods, residual }, table);
  table.free();
  return orbit;
}

/**
 * Return whether a cell has found an orbit, with as many passages, periods and rests as the first.
 * @param {Orbit} orbit
 * @param {Cells} cells
 * @param {number} cell
 * @param {number} first
 */
function isOn(orbit, { period, passages, rests, side, phase, speed }, cell, first) {
  if (period[cell] !== period[first] || passages[cell] !== passages[first]) return false;
  if (rests[cell] !== rests[first]) return false;
  for (const state of orbit.states) {
    const turned = Math.abs(phase[cell] - state.phase);
    const size = Math.max(Math.min(speed[cell], state.speed), SLOWEST);
    if (side[cell] === state.side && Math.min(turned, FULL_TURN - turned) <= SAME_ORBIT
      && Math.abs(speed[cell] - state.speed) <= SAME_ORBIT * size) return true;
  }
  return false;
}

/** @param {{ kind: Kind, orbit: Orbit | null }} attractor  mirror images stand side by side */
function labelKey({ kind, orbit }) {
  if (!orbit) return [LABEL_ORDER.indexOf(kind)];
  const largest = Math.max(orbit.highest, -orbit.lowest);
  return [LABEL_ORDER.indexOf('symmetric'), orbit.period, orbit.states.length,
    Number(!orbit.symmetric), -Number(largest.toFixed(9)), Number(orbit.highest < -orbit.lowest)];
}

/** @param {number[]} one @param {number[]} other */
function compareKeys(one, other) {
  const place = one.findIndex((value, index) => value !== other[index]);
  return place < 0 ? 0 : one[place] - other[place];
}

/** @param {{ kind: Kind, orbit: Orbit | null }[]} found */
function attractorNames(found) {
  const plain = found.map(({ kind, orbit }) => (orbit ? `${kind}-${orbit.period}` : kind));
  return plain.map((name, place) => {
    if (plain.filter((other) => other === name).length === 1) return name;
    const letter = plain.slice(0, place).filter((other) => other === name).length;
    return name + (letter < 26 ? String.fromCharCode(97 + letter) : `-${letter + 1}`);
  });
}
