// A plane of fates, with what its fills mean in rows above its box, so that no cell is covered.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { ClassTiles } from '../../draw/classes.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { Plane } from '../plane/plane.mjs' */
import { fillClass, hatchBox, rgbOf, wordOf } from '../../draw/classes.mjs';
import { frame, outline } from '../../draw/frame.mjs';
import { clipped } from '../../draw/marks.mjs';
import { shownAxes } from '../plane/axis.mjs';

/**
 * What one kind of cell is drawn with: a colour, and lines or dots on it.
 * @typedef {{ fill: string, mark?: string, kind?: 'rising' | 'falling' | 'crossed' | 'dots' }}
 *   CellLook
 */

/** @typedef {{ words: string, look: CellLook }} KeyEntry */

const LOOK_TILE = 24; // [px] of a pattern
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
    pen.fillStyle = look.fill;
    pen.fillRect(box.left, box.top, box.width, box.height);
    const style = { colour: look.mark ?? look.fill, every: 8 };
    if (look.kind === 'dots') {
      pen.fillStyle = style.colour;
      for (let k = 3; k < 18; k += 6) {
        for (const y of [3, 8]) pen.fillRect(box.left + k, box.top + y, 2, 2);
      }
    } else if (look.kind) {
      if (look.kind !== 'falling') hatchBox(pen, box, style);
      if (look.kind !== 'rising') hatchBox(pen, box, { ...style, falling: true });
    }
    pen.strokeStyle = theme.faint;
    pen.lineWidth = 1;
    pen.setLineDash([]);
    pen.strokeRect(box.left + 0.5, box.top + 0.5, box.width - 1, box.height - 1);
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
  const rows = planeKeyRows(pen, theme, key, size.width);
  const margin = { right: 12, top: rows.top };
  const axes = shownAxes(plane.handle.axes());
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

/** Return the pixels of looks. @param {CellLook[]} looks @returns {ClassTiles} */
export function lookTiles(looks) {
  const pixels = looks.map(({ fill, mark = fill, kind }) => {
    const [plain, marked] = [fill, mark].map((colour) => wordOf(rgbOf(colour)));
    return Uint32Array.from({ length: LOOK_TILE * LOOK_TILE }, (_, k) => {
      const x = k % LOOK_TILE, y = Math.floor(k / LOOK_TILE);
      const rising = (x + y) % 8 === 0, falling = (x - y + LOOK_TILE) % 8 === 0;
      const on = kind === 'dots' ? x % 8 < 2 && y % 8 < 2 : kind === 'crossed' ? rising || falling
        : kind === 'rising' ? rising : kind === 'falling' && falling;
      return on ? marked : plain;
    });
  });
  return { size: LOOK_TILE, pixels };
}
