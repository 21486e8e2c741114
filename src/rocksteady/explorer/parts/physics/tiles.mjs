// What the block settles to in the cells of a map, as `rocksteady.map_attractors` computes it.

import { ATTRACTOR_KINDS, attractorKind } from './attractor.mjs';
import { evaluateEach } from './case.mjs';
import { REAL_CELL, WHOLE_CELL, settledRows } from './settled.mjs';
import { NoStart, solutionsIn, steadyStart, steadyTable } from './start.mjs';

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */

/** Codes of the kinds in a tile, those of Python's maps. */
export const MAP_KIND = Object.freeze({
  symmetric: 0, unsymmetric: 1, rest: 2, overturned: 3, aperiodic: 4, undecided: 5,
  noStart: -1, notComputed: -128,
});
const MAP_CYCLES = 2000; // the default of `map_attractors`
const LOSSLESS_CYCLES = 200; // without loss nothing settles, however long one waits

/**
 * Return the forcing periods for which the motions of a map are followed.
 * @param {Case} given
 */
export function mapCycles({ restitution }) {
  return restitution < 1 ? MAP_CYCLES : LOSSLESS_CYCLES;
}

/**
 * Cells of a map: a rectangle of amplitudes (rows) and frequency ratios (columns).
 * @typedef {object} TileRequest
 * @property {Case} given  restitution, model and slenderness; its amplitude and frequency are moved
 * @property {Start} start
 * @property {ArrayLike<number>} ratios
 * @property {ArrayLike<number>} amplitudes
 * @property {boolean} [nested]  leave out the cells of even row and even column: a coarser tile's
 * @property {number} [cycles]  forcing periods after which a motion counts as unsettled
 */

/**
 * Row after row; a cell that was left out has the kind `NOT_COMPUTED`.
 * @typedef {object} Tile
 * @property {Int8Array} kind
 * @property {Int32Array} period  forcing periods of the orbit; 0 without one
 * @property {Int32Array} impacts  in a period; 0 without an orbit, -1 for infinitely many
 * @property {Float64Array} highest  theta/alpha; NaN without an orbit
 * @property {Float64Array} lowest
 */

/**
 * Return the values at the centres of the cells along an axis.
 * @param {Kernels} kernels
 * @param {{ from: number, to: number, count: number, log: boolean }} axis
 * @returns {Float64Array}
 */
export function axisValues(kernels, { from, to, count, log }) {
  const centres = (/** @type {number} */ low, /** @type {number} */ high) =>
    Float64Array.from({ length: count }, (_, i) => low + (high - low) * ((i + 0.5) / count));
  if (!log) return centres(from, to);
  const [low, high] = evaluateEach(kernels, 'log', [from, to]);
  return evaluateEach(kernels, 'exp', centres(low, high));
}

/**
 * Return what the block settles to in the cells of a tile.
 * @param {Kernels} kernels
 * @param {TileRequest} request
 * @returns {Tile}
 */
export function mapTile(kernels, { given, start, ratios, amplitudes, nested = false, cycles }) {
  const [rows, columns] = [amplitudes.length, ratios.length];
  /** @type {number[]} */
  const places = [];
  for (let i = 0; i < rows * columns; i += 1) {
    if (!nested || Math.floor(i / columns) % 2 || (i % columns) % 2) places.push(i);
  }
  const cells = cellsFrom(kernels, given, start, {
    amplitude: Float64Array.from(places, (i) => amplitudes[Math.floor(i / columns)]),
    ratio: Float64Array.from(places, (i) => ratios[i % columns]),
  });
  const tile = emptyTile(rows * columns);
  settledRows(kernels, given, cells, cycles ?? mapCycles(given)).forEach(({ whole, real }, i) => {
    noteCell(tile, places[i], given.restitution, cells.there[i] !== 0, whole, real);
  });
  return tile;
}

/**
 * Return cells of which none is computed.
 * @param {number} count
 * @returns {Tile}
 */
export function emptyTile(count) {
  return {
    kind: new Int8Array(count).fill(MAP_KIND.notComputed),
    period: new Int32Array(count),
    impacts: new Int32Array(count),
    highest: new Float64Array(count).fill(NaN),
    lowest: new Float64Array(count).fill(NaN),
  };
}

/**
 * Motions, one a cell: the shaking, the state at the start, and where there is such a start.
 * @typedef {object} MapCells
 * @property {Float64Array} amplitude  0 without a start: there is nothing to follow
 * @property {Float64Array} ratio
 * @property {Float64Array} angle
 * @property {Float64Array} velocity
 * @property {Float64Array} phase  of the shaking [rad]
 * @property {Uint8Array} there
 */

/**
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start} start
 * @param {{ amplitude: Float64Array, ratio: Float64Array }} shaking
 * @returns {MapCells}
 */
function cellsFrom(kernels, given, start, { amplitude, ratio }) {
  const every = (/** @type {number} */ value) => new Float64Array(ratio.length).fill(value + 0);
  const there = new Uint8Array(ratio.length).fill(1);
  const cells = { amplitude, ratio, angle: every(0), velocity: every(0), phase: every(0), there };
  if (start.kind === 'state') {
    return { ...cells, angle: every(start.angle), velocity: every(start.velocity) };
  }
  if (start.kind === 'impact') {
    return { ...cells, velocity: every(start.side * start.speed), phase: every(start.phase) };
  }
  if (start.kind === 'rest') return cells;
  const table = steadyTable(kernels, amplitude, ratio, given.restitution, 1);
  const none = (/** @type {number} */ i) => {
    amplitude[i] = there[i] = 0;
  };
  amplitude.forEach((value, i) => {
    const at = { ...given, amplitude: value, frequencyRatio: ratio[i] };
    const solutions = solutionsIn(table, i, at);
    if (solutions.region === 4 || !solutions.branches[0].admissible) return none(i);
    try {
      const begun = steadyStart(kernels, at, 1, solutions);
      [cells.phase[i], cells.velocity[i]] = [begun.phase, begun.velocity];
    } catch (error) {
      if (!(error instanceof NoStart)) throw error;
      none(i);
    }
  });
  return cells;
}

/**
 * Write what a cell settles to into a tile.
 * @type {(tile: Tile, place: number, restitution: number, there: boolean, whole: BigInt64Array,
 *   real: Float64Array) => void}
 */
function noteCell(tile, place, restitution, there, whole, real) {
  const outcome = Number(whole[WHOLE_CELL.outcome]), symmetric = whole[WHOLE_CELL.symmetric] !== 0n;
  const found = attractorKind(outcome, symmetric, real[REAL_CELL.least], restitution);
  const kind = there ? ATTRACTOR_KINDS.indexOf(found) : MAP_KIND.noStart;
  tile.kind[place] = kind;
  tile.period[place] = Number(whole[WHOLE_CELL.periods]);
  tile.impacts[place] = whole[WHOLE_CELL.rests] > 0n ? -1 : Number(whole[WHOLE_CELL.passages]);
  const still = kind === MAP_KIND.rest;
  tile.highest[place] = still ? 0 : there ? real[REAL_CELL.highest] : NaN;
  tile.lowest[place] = still ? 0 : there ? real[REAL_CELL.lowest] : NaN;
}
