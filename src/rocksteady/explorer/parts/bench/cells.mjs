// The cells of a map, coarse first, then three times as fine, and finer again beside borders.

/** @import { Pool } from '../work/pool.mjs' */
/** @import { Cells } from './areas.mjs' */
import { cellMiddles } from '../physics/basins.mjs';
import { SHAKEN } from '../physics/shake.mjs';

/** @typedef {{ falls: number, cells: number }} Share  of the cells of a map, all of which are computed */

/**
 * What the cells of a map are asked of.
 * @typedef {object} Asked
 * @property {string} job  of the pool, given `args` with the places x and y of some cells
 * @property {object} args
 * @property {readonly [number, number]} x  ends of the axis
 * @property {readonly [number, number]} y
 * @property {boolean} [whole]  every cell is computed, not those beside borders alone
 */

const LEVELS = /** @type {const} */ ([[16, 12], [48, 36], [144, 108]]); // each cell has nine in the next
const CHUNK = 48; // cells of a job
const JOBS = 'cells of a map';
const KEPT = 8; // maps

/**
 * Make what computes the cells of maps; only the newest map is gone on with.
 * @param {Pool} pool
 * @param {(cells: Cells, last: boolean) => void} ready  after each level
 * @param {(fault: Error) => void} failed
 */
export function makeCells(pool, ready, failed) {
  let key = '', turn = 0;
  /** @type {Map<string, Cells>} */
  const kept = new Map();

  /** @param {Asked} asked @param {number} mine */
  const compute = async ({ job, args, x, y, whole = false }, mine) => {
    const own = key;
    /** @type {Cells | null} */
    let before = null;
    for (const [level, [columns, rows]] of LEVELS.entries()) {
      const codes = new Uint8Array(columns * rows), open = before ? opened(before, codes) : Array.from(codes, (_, k) => k);
      const across = cellMiddles(x[0], x[1], columns), up = cellMiddles(y[0], y[1], rows);
      const fill = (/** @type {number[]} */ all, /** @type {number} */ late) => Promise.all(chunks(all).map(async (part) => {
        const places = { x: part.map((k) => across[k % columns]), y: part.map((k) => up[Math.floor(k / columns)]) };
        const found = await pool.ask(job, { ...args, ...places }, { key: `${JOBS} ${mine} ${level} ${late} ${part[0]}`, priority: 2 + level + late });
        part.forEach((k, i) => { if (found) codes[k] = found.fate[i]; });
      }));
      await fill(open, 0);
      if (mine !== turn) return;
      before = { columns, rows, codes };
      const finest = level === LEVELS.length - 1;
      if (finest && whole) {
        ready(before, false);
        const known = new Set(open);
        await fill(Array.from(codes, (_, k) => k).filter((k) => !known.has(k)), 1);
        if (mine !== turn) return;
      }
      if (finest) kept.set(own, before);
      if (kept.size > KEPT) kept.delete([...kept.keys()][0]);
      ready(before, finest);
    }
  };
  return {
    /** Compute a map unless it is being computed, or none; return whether it is another. @param {Asked | null} asked */
    ask(asked) {
      const next = JSON.stringify(asked);
      if (next === key) return false;
      key = next;
      turn++;
      pool.drop(JOBS);
      const known = kept.get(key);
      if (known) queueMicrotask(() => ready(known, true));
      else if (asked) compute(asked, turn).catch(failed);
      return true;
    },
  };
}

/** Return how many cells of a map fall. @param {Cells} cells @returns {Share} */
export function shareOf({ codes }) {
  return { falls: codes.filter((code) => code === SHAKEN.once || code === SHAKEN.after).length, cells: codes.length };
}

/** Return cells in parts that are a job each. @param {number[]} all */
function chunks(all) {
  return Array.from({ length: Math.ceil(all.length / CHUNK) }, (_, k) => all.slice(k * CHUNK, (k + 1) * CHUNK));
}

/**
 * Give finer cells the codes of the coarser ones; return those beside a border, which are open.
 * @param {Cells} coarse
 * @param {Uint8Array} codes  filled
 */
function opened({ columns, rows, codes: before }, codes) {
  /** @type {number[]} */
  const open = [];
  const wide = 3 * columns;
  codes.forEach((_, k) => {
    const [x, y] = [k % wide, Math.floor(k / wide)], [column, row] = [Math.floor(x / 3), Math.floor(y / 3)];
    const code = before[row * columns + column];
    codes[k] = code;
    if (x % 3 === 1 && y % 3 === 1) return; // the same place
    for (let up = Math.max(row - 1, 0); up <= Math.min(row + 1, rows - 1); up++) {
      for (let along = Math.max(column - 1, 0); along <= Math.min(column + 1, columns - 1); along++) {
        if (before[up * columns + along] === code) continue;
        open.push(k);
        return;
      }
    }
  });
  return open;
}
