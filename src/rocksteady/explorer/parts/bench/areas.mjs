// Areas of a map: fills with their patterns, outlines, and the name of each where it fits.

/** @import { Theme } from '../draw/theme.mjs' */
/** @import { Look } from '../draw/classes.mjs' */
/** @import { Pen, Role } from '../story/draw.mjs' */
import { fillLook } from '../draw/classes.mjs';
import { write } from '../story/draw.mjs';

/** @typedef {{ left: number, top: number, width: number, height: number }} Box */
/** @typedef {{ look: Look, name: string, ink: Role, over: Role }} Kind  of areas; lines of a name are parted by | */
/** @typedef {{ columns: number, rows: number, codes: Uint8Array }} Cells  the lowest row first */

const LETTER = 4.5, LINE = 18; // [px] half a letter of a name, and from line to line
const EDGE = 8; // [px] from a name to an outline
const SIZES = { roomy: 15, tight: 13 };
const LEAST_AREA = 0.012; // share of a map below which an area that is too narrow has no name

/**
 * Draw the areas of a map.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {Cells} cells
 * @param {Box} box
 * @param {readonly Kind[]} kinds  by their codes
 * @param {readonly Box[]} avoid  where no name may stand
 */
export function drawAreas(pen, theme, cells, box, kinds, avoid) {
  const { columns, rows, codes } = cells, across = box.width / columns, up = box.height / rows;
  pen.save();
  for (const kind of new Set(kinds)) {
    const path = new Path2D();
    let any = false;
    for (let row = 0; row < rows; row++) {
      for (let from = 0; from < columns;) {
        let to = from;
        while (to < columns && kinds[codes[row * columns + to]] === kind) to++;
        if (to > from) {
          any = true;
          path.rect(box.left + from * across, box.top + box.height - (row + 1) * up - 0.3, (to - from) * across + 0.3, up + 0.6);
        }
        from = Math.max(to, from + 1);
      }
    }
    if (!any) continue;
    pen.save();
    pen.clip(path);
    fillLook(pen, kind.look, box);
    pen.restore();
  }
  drawOutlines(pen, theme, cells, box, kinds);
  pen.restore();
  for (const kind of new Set(kinds)) nameArea(pen, theme, cells, box, kinds, kind, avoid);
}

/** @param {Pen} pen @param {Theme} theme @param {Cells} cells @param {Box} box @param {readonly Kind[]} kinds */
function drawOutlines(pen, theme, { columns, rows, codes }, box, kinds) {
  const across = box.width / columns, up = box.height / rows;
  for (const inner of [false, true]) { // between two ways to fall in their own ink
    pen.beginPath();
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        const here = kinds[codes[row * columns + column]], x = box.left + (column + 1) * across;
        const y = box.top + box.height - (row + 1) * up;
        const right = column + 1 < columns ? kinds[codes[row * columns + column + 1]] : here;
        const above = row + 1 < rows ? kinds[codes[(row + 1) * columns + column]] : here;
        if (right !== here && (right.over === here.over) === inner) {
          pen.moveTo(x, y);
          pen.lineTo(x, y + up);
        }
        if (above !== here && (above.over === here.over) === inner) {
          pen.moveTo(x - across, y);
          pen.lineTo(x, y);
        }
      }
    }
    pen.lineWidth = inner ? 1.5 : 1;
    pen.strokeStyle = inner ? theme.onFalls : theme.edge;
    pen.stroke();
  }
}

/**
 * Write the name of a kind where there is most room for it, or beside a dot where it is narrow.
 * @param {Pen} pen
 * @param {Theme} theme
 * @param {Cells} cells
 * @param {Box} box
 * @param {readonly Kind[]} kinds
 * @param {Kind} kind
 * @param {readonly Box[]} avoid
 */
function nameArea(pen, theme, { columns, rows, codes }, box, kinds, kind, avoid) {
  const across = box.width / columns, up = box.height / rows, lines = kind.name.split('|');
  const half = Math.max(...lines.map((line) => line.length)) * LETTER + EDGE, tall = 0.5 * LINE * lines.length + 4;
  // Of each cell how far it is from the nearest other kind, in sizes of the name.
  const room = new Float64Array(columns * rows), steps = [across / half, up / tall];
  const at = (/** @type {number} */ column, /** @type {number} */ row) =>
    column < 0 || row < 0 || column >= columns || row >= rows ? 0 : room[row * columns + column];
  let area = 0;
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      if (kinds[codes[row * columns + column]] !== kind) continue;
      area++;
      room[row * columns + column] = Math.min(at(column - 1, row) + steps[0], at(column, row - 1) + steps[1]);
    }
  }
  let best = 0, place = -1;
  for (let row = rows - 1; row >= 0; row--) {
    for (let column = columns - 1; column >= 0; column--) {
      const cell = row * columns + column;
      if (!room[cell]) continue;
      room[cell] = Math.min(room[cell], at(column + 1, row) + steps[0], at(column, row + 1) + steps[1]);
      if (room[cell] <= best) continue;
      const x = box.left + (column + 0.5) * across, y = box.top + box.height - (row + 0.5) * up;
      const clear = avoid.every((other) => x + half < other.left || x - half > other.left + other.width
        || y + tall < other.top || y - tall > other.top + other.height);
      if (clear) [best, place] = [room[cell], cell];
    }
  }
  const tight = best < 1.3;
  if (place < 0 || (tight && area < LEAST_AREA * columns * rows)) return;
  const x = box.left + ((place % columns) + 0.5) * across;
  const y = box.top + box.height - (Math.floor(place / columns) + 0.5) * up;
  const within = (/** @type {number} */ at, /** @type {number} */ from, /** @type {number} */ size, /** @type {number} */ part) =>
    Math.min(Math.max(at, from + part), from + size - part);
  const inside = tight ? { x: within(x, box.left, box.width, half + EDGE), y: within(y, box.top, box.height, tall) } : { x, y };
  lines.forEach((line, k) => write(pen, theme, line, inside.x, inside.y + 5 + (k - 0.5 * (lines.length - 1)) * LINE, {
    size: tight ? SIZES.tight : SIZES.roomy, bold: true, align: 'center', role: kind.ink, over: tight ? kind.over : undefined,
  }));
}
