// The edges of the regions on the map, and where their numbers stand.

/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { EdgeKind } from '../../draw/marks.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { Boundaries } from '../../physics/boundaries.mjs' */
/** @import { PlaneAxes } from '../plane/axis.mjs' */
import { edge, note } from '../../draw/marks.mjs';
import { regionAt } from '../../physics/boundaries.mjs';
import { placeIn } from '../plane/axis.mjs';

/** @typedef {{ region: number, x: number, y: number }} RegionPlace */

const REGION_COLUMNS = 48, REGION_ROWS = 36;
const LEAST_ROOM = 0.8; // cells from the place of a number to the next edge
const LABEL_PARTS = [0.8, 0.6, 0.4, 0.9, 0.7, 0.5, 0.3, 0.2]; // of the points of a curve
const LABEL_LINE = 14; // [px]

/** @type {{ name: 'existence' | 'kind' | 'sign' | 'symmetryBreaking', kind: EdgeKind,
 *   words: string }[]} */
const EDGES = [
  { name: 'kind', kind: 'grazing', words: 'out of phase above' },
  { name: 'sign', kind: 'grazing', words: 'one solution above' },
  { name: 'symmetryBreaking', kind: 'flip', words: 'symmetry lost above' },
  { name: 'existence', kind: 'fold', words: 'steady rocking above' },
];

/**
 * Return where each region has most room for its number.
 * @param {Boundaries} curves
 * @param {PlaneAxes} seen  whose columns the curves follow at equal distances
 * @param {number} shape  height of the window over its width [px]
 * @returns {RegionPlace[]}
 */
export function regionPlaces(curves, seen, shape) {
  const { existence, sign, kind, symmetryBreaking } = curves;
  const points = existence.length;
  const regions = new Int8Array(REGION_COLUMNS * REGION_ROWS);
  const amplitudes = Array.from({ length: REGION_ROWS }, (_, j) =>
    placeIn(seen, { x: 0, y: (j + 0.5) / REGION_ROWS }).y);
  for (let i = 0; i < REGION_COLUMNS; i += 1) {
    const k = Math.min(points - 1, Math.floor(((i + 0.5) / REGION_COLUMNS) * points));
    amplitudes.forEach((a, j) => {
      const above = a > symmetryBreaking[k] ? 8 : 0; // numbers keep away from that curve too
      regions[j * REGION_COLUMNS + i] = regionAt(a, existence[k], sign[k], kind[k]) + above;
    });
  }
  const room = roomOf(regions, shape * (REGION_COLUMNS / REGION_ROWS));
  /** @type {RegionPlace[]} */
  const found = [];
  for (let region = 1; region <= 5; region += 1) {
    let best = -1;
    regions.forEach((one, k) => {
      if ((one & 7) === region && (best < 0 || room[k] > room[best])) best = k;
    });
    if (best < 0 || room[best] < LEAST_ROOM) continue;
    const x = ((best % REGION_COLUMNS) + 0.5) / REGION_COLUMNS;
    const y = (Math.floor(best / REGION_COLUMNS) + 0.5) / REGION_ROWS;
    found.push({ region, ...placeIn(seen, { x, y }) });
  }
  return found;
}

/**
 * Return the distance of each cell to the nearest of another region, or to an end of the window.
 * @param {Int8Array} regions
 * @param {number} upright  height of a cell over its width
 */
function roomOf(regions, upright) {
  const room = new Float64Array(regions.length).fill(Infinity);
  const slanted = Math.sqrt(1 + upright * upright);
  /** @type {(here: number, i: number, j: number, length: number) => void} */
  const relax = (here, i, j, length) => {
    const out = i < 0 || j < 0 || i >= REGION_COLUMNS || j >= REGION_ROWS;
    const there = j * REGION_COLUMNS + i;
    const known = out || regions[there] !== regions[here] ? length / 2 : room[there] + length;
    if (known < room[here]) room[here] = known;
  };
  for (const back of [1, -1]) { // from the lower left corner, and from the upper right one
    for (let n = 0; n < regions.length; n += 1) {
      const here = back > 0 ? n : regions.length - 1 - n;
      const i = here % REGION_COLUMNS, j = (here - i) / REGION_COLUMNS;
      relax(here, i - back, j, 1);
      relax(here, i, j - back, upright);
      relax(here, i - back, j - back, slanted);
      relax(here, i + back, j - back, slanted);
    }
  }
  return room;
}

/**
 * Draw the edges, and the numbers of the regions.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {Boundaries} curves
 * @param {RegionPlace[]} places
 * @param {{ w: number, a: number, other: boolean }} scales  of the axes; whether the curves are
 *   those of another model
 */
export function drawRegions(pen, onto, curves, places, { w, a, other }) {
  const scaled = (/** @type {Float64Array} */ values, /** @type {number} */ by) =>
    values.map((value) => value * by);
  const xs = scaled(curves.frequencyRatio, w);
  pen.save();
  pen.globalAlpha = other ? 0.55 : 1;
  for (const { name, kind } of EDGES) edge(pen, onto, xs, scaled(curves[name], a), kind);
  pen.restore();
  /** @type {{ x: number, y: number, half: number }[]} */
  const taken = places.map((place) =>
    ({ x: onto.x.at(place.x * w), y: onto.y.at(place.y * a), half: 8 }));
  taken.forEach(({ x, y }, k) => {
    note(pen, onto, String(places[k].region), x, y, { font: onto.theme.strong });
  });
  pen.font = onto.theme.small;
  for (const { name, words } of onto.box.width > 340 ? EDGES : []) {
    const half = pen.measureText(words).width / 2 + 3;
    const at = labelPlace(onto, xs, scaled(curves[name], a), half, taken);
    if (!at) continue;
    taken.push({ ...at, half });
    note(pen, onto, words, at.x, at.y);
  }
}

/**
 * Return where a label beside a curve is clear of the others; undefined where it is nowhere.
 * @param {Frame} onto
 * @param {Float64Array} xs
 * @param {Float64Array} ys
 * @param {number} half  of its width [px]
 * @param {{ x: number, y: number, half: number }[]} taken
 */
function labelPlace(onto, xs, ys, half, taken) {
  const { left, top, width, height } = onto.box;
  /** @type {{ x: number, y: number }[]} */
  const seen = [];
  xs.forEach((value, k) => {
    const [x, y] = [onto.x.at(value), onto.y.at(ys[k])];
    if (y > top + LABEL_LINE && y < top + height) seen.push({ x, y });
  });
  for (const part of LABEL_PARTS) {
    const k = Math.floor(part * seen.length);
    const [here, next] = [seen[k], seen[k + 1]];
    if (!here || !next) continue;
    const steep = Math.abs(next.y - here.y) > Math.abs(next.x - here.x);
    const at = steep ? { x: here.x + half + 6, y: here.y } : { x: here.x, y: here.y - 9 };
    const inside = at.x - half > left && at.x + half < left + width;
    const clear = taken.every((other) => Math.abs(other.y - at.y) > LABEL_LINE
      || Math.abs(other.x - at.x) > half + other.half);
    if (inside && clear) return at;
  }
  return undefined;
}
