// A plane of fates, with what its fills mean in rows above its box, so that no cell is covered.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Look } from '../../draw/classes.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { Plane } from '../plane/plane.mjs' */
import { fillClass, lookSwatch } from '../../draw/classes.mjs';
import { frame, outline } from '../../draw/frame.mjs';
import { clipped } from '../../draw/marks.mjs';
import { shownAxes } from '../plane/axis.mjs';

/** @typedef {{ words: string, look: Look }} KeyEntry */

const KEY_LINE = 17, KEY_TOP = 20, KEY_SWATCH = 20; // [px]

/**
 * Return the rows of a key in a width, and the room above the box that they need.
 * @param {any} pen
 * @param {Theme} theme
 * @param {KeyEntry[]} entries
 * @param {number} width
 */
function planeKeyRows(pen, theme, entries, width) {
  pen.save();
  pen.font = theme.small;
  /** @type {{ entry: KeyEntry, x: number, row: number }[]} */
  const placed = [];
  let x = 4, row = 0;
  for (const entry of entries) {
    const needed = KEY_SWATCH + 6 + pen.measureText(entry.words).width + 14;
    if (x > 4 && x + needed - 14 > width - 4) [x, row] = [4, row + 1];
    placed.push({ entry, x, row });
    x += needed;
  }
  pen.restore();
  return { placed, top: KEY_TOP + KEY_LINE * (row + 1) + 5 };
}

/**
 * @param {any} pen
 * @param {Theme} theme
 * @param {ReturnType<typeof planeKeyRows>} rows
 */
function drawPlaneKey(pen, theme, { placed }) {
  pen.save();
  pen.font = theme.small;
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  for (const { entry: { words, look }, x, row } of placed) {
    const box = { left: x, top: KEY_TOP + KEY_LINE * row + 2, width: KEY_SWATCH, height: 12 };
    lookSwatch(pen, theme, look, box);
    pen.fillStyle = theme.ink;
    pen.fillText(words, x + KEY_SWATCH + 6, box.top + 6);
  }
  pen.restore();
}

/**
 * Draw a plane of fates: key, cells, what `over` draws on them, and the point.
 * @param {Pen} pen
 * @param {{ width: number, height: number }} size
 * @param {App} app
 * @param {Plane} plane
 * @param {{ key: KeyEntry[], colours?: string, over: (onto: Frame) => void }} what
 */
export function drawFates(pen, size, { theme }, plane, { key, colours, over }) {
  const rows = planeKeyRows(pen, theme, key, size.width), axes = shownAxes(plane.handle.axes());
  const margin = { right: axes.y.far ? 36 : 12, top: rows.top };
  const onto = frame(pen, size, { theme, ...axes, grid: false, margin });
  drawPlaneKey(pen, theme, rows);
  clipped(pen, onto, () => fillClass(pen, theme, 'not-computed', onto.box));
  plane.drawCells(pen, onto, colours);
  plane.drawLines(pen, onto, 'both');
  over(onto);
  plane.drawPoint(pen, onto);
  outline(pen, onto);
  plane.drawTouched(pen, onto);
}
