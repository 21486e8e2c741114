// A strip of fates over one quantity, with its handle: words on the fills, and no legend.

/** @import { Theme } from '../draw/theme.mjs' */
/** @import { MotionClass } from '../draw/classes.mjs' */
/** @import { Area, Pen, Role } from './draw.mjs' */
import { fillClass } from '../draw/classes.mjs';
import { drawLine, drawRing, write } from './draw.mjs';

/** @typedef {{ name: MotionClass, words: string[] }} Cell  words: the longest that fit are written */

const HANDLE = 3; // [px] half its width

/** @type {Partial<Record<MotionClass, Role>>} */
const ON = { overturned: 'onFalls', rocking: 'onRocks' };
/** @type {Partial<Record<MotionClass, Role>>} */
const FILLS = { overturned: 'falls', rocking: 'rocks', rest: 'rest' };

/**
 * Draw cells side by side, neighbours of one word as one; words make way for the handle.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {readonly Cell[]} cells
 * @param {Area} area
 * @param {number} handle  its x
 */
export function drawStrip(pen, theme, cells, [left, top, width, height], handle) {
  const step = width / cells.length;
  for (let from = 0, to = 1; to <= cells.length; to++) {
    if (to < cells.length && cells[to].words[0] === cells[from].words[0]) continue;
    const { name, words } = cells[from], x = left + from * step, wide = (to - from) * step;
    fillClass(pen, theme, name, { left: x, top, width: wide + (to < cells.length ? 0.5 : 0), height });
    pen.font = theme.strong;
    const right = x + wide, split = Math.max(x, Math.min(right, handle)), how = { bold: true, role: ON[name] ?? 'ink', over: FILLS[name] };
    /** @type {[number, number][]} */
    const rooms = split > x && split < right ? [[x, split - HANDLE], [split + HANDLE, right]] : [[x, right]];
    for (const word of words) {
      const long = pen.measureText(word).width, room = rooms.find(([begin, end]) => long < end - begin - 8);
      if (!room) continue;
      write(pen, theme, word, room[0] + Math.min(9, (room[1] - room[0] - long) / 2), top + height / 2 + 4, how);
      break;
    }
    from = to;
  }
}

/**
 * Draw the handle of a strip.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {number} x
 * @param {Area} area
 */
export function drawHandle(pen, theme, x, [, top, , height]) {
  drawLine(pen, theme, [x, top - 4, x, top + height + 2], 'paper', 6);
  drawLine(pen, theme, [x, top - 4, x, top + height + 2], 'ink', 3);
  drawRing(pen, theme, x, top - 8);
}
