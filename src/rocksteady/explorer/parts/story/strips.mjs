// A strip of fates over one quantity, with its handle: words on the fills, and no legend.

/** @import { Theme } from '../draw/theme.mjs' */
/** @import { MotionClass } from '../draw/classes.mjs' */
/** @import { Area, Pen, Role } from './draw.mjs' */
import { fillClass } from '../draw/classes.mjs';
import { drawLine, drawRing, write } from './draw.mjs';

/** @typedef {{ name: MotionClass, words: string[] }} Cell  words: the longest that fit are written */

/** @type {Partial<Record<MotionClass, Role>>} */
const ON = { overturned: 'onFalls', rocking: 'onRocks' };
/** @type {Partial<Record<MotionClass, Role>>} */
const FILLS = { overturned: 'falls', rocking: 'rocks', rest: 'rest' };

/**
 * Draw cells side by side, neighbours of one word as one.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {readonly Cell[]} cells
 * @param {Area} area
 */
export function drawStrip(pen, theme, cells, [left, top, width, height]) {
  const step = width / cells.length;
  for (let from = 0, to = 1; to <= cells.length; to++) {
    if (to < cells.length && cells[to].words[0] === cells[from].words[0]) continue;
    const { name, words } = cells[from], x = left + from * step, wide = (to - from) * step;
    fillClass(pen, theme, name, { left: x, top, width: wide + (to < cells.length ? 0.5 : 0), height });
    pen.font = theme.strong;
    const fits = words.find((word) => pen.measureText(word).width < wide - 8);
    if (fits) {
      const how = { bold: true, role: ON[name] ?? 'ink', over: FILLS[name] };
      write(pen, theme, fits, x + Math.min(9, (wide - pen.measureText(fits).width) / 2), top + height / 2 + 4, how);
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
