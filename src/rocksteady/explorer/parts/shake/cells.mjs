// The cells of a map, coarse first, then three times as fine, and finer again beside borders.

/** @import { Pool } from '../work/pool.mjs' */
/** @import { Cells } from './areas.mjs' */

const LEVELS = /** @type {const} */ ([[16, 12], [48, 36], [144, 108]]); // each cell has nine in the next
const CHUNK = 48; // cells of a job
const JOBS = 'shaken cells';

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

  /** @param {(x: Float64Array, y: Float64Array) => object} job @param {number} mine */
  const compute = async (job, mine) => {
    /** @type {Cells | null} */
    let before = null;
    for (const [level, [columns, rows]] of LEVELS.entries()) {
      const codes = new Uint8Array(columns * rows), open = before ? opened(before, codes) : codes.map((_, k) => k);
      const all = before ? Array.from(open) : Array.from(codes, (_, k) => k);
      /** @type {Promise<void>[]} */
      const asked = [];
      for (let from = 0; from < all.length; from += CHUNK) {
        const part = all.slice(from, from + CHUNK);
        const x = Float64Array.from(part, (k) => ((k % columns) + 0.5) / columns);
        const y = Float64Array.from(part, (k) => (Math.floor(k / columns) + 0.5) / rows);
        asked.push(pool.ask('shakenCells', job(x, y), { key: `${JOBS} ${mine} ${level} ${from}`, priority: 2 + level })
          .then((found) => found && part.forEach((k, i) => { codes[k] = found.fate[i]; })));
      }
      await Promise.all(asked);
      if (mine !== turn) return;
      before = { columns, rows, codes };
      const last = level === LEVELS.length - 1;
      if (last) kept.set(key, before);
      if (kept.size > 8) kept.delete([...kept.keys()][0]);
      ready(before, last);
    }
  };
  return {
    /**
     * Compute a map unless it is being computed; its axes run from 0 to 1.
     * @param {string} next  what it depends on
     * @param {(x: Float64Array, y: Float64Array) => object} job  what a worker is asked for some cells
     */
    ask(next, job) {
      if (next === key) return;
      key = next;
      turn++;
      pool.drop(JOBS);
      const known = kept.get(key);
      if (known) ready(known, true);
      else compute(job, turn).catch(failed);
    },
  };
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
