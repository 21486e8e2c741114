// The paper of a panel: grid, axes, ticks and labels.

import { scale } from './scale.mjs';

/** @typedef {import('./classes.mjs').Box} Box */
/** @typedef {import('./scale.mjs').Scale} Scale */
/** @typedef {import('./scale.mjs').Tick} Tick */
/** @typedef {import('./svg.mjs').Pen} Pen */
/** @typedef {import('./theme.mjs').Theme} Theme */

/**
 * @typedef {object} Axis
 * @property {number} from
 * @property {number} to
 * @property {boolean} [log]
 * @property {string} [label]  with its unit
 * @property {Tick[]} [ticks]  in place of round numbers, as at -1, 0, 1
 * @property {boolean} [bare]  without tick labels
 * @property {{ factor: number, label: string }} [far]  scale on the far side; its values times the
 *   factor are those of the axis
 */

/**
 * @typedef {{ left?: number, right?: number, top?: number, bottom?: number }} Margin
 */

/**
 * @typedef {object} Frame
 * @property {Scale} x
 * @property {Scale} y
 * @property {Box} box  inside the axes [px]
 * @property {Theme} theme
 * @property {{ width: number, height: number }} size
 */

const NARROW = 420; // [px] below, letters are of 11 px
const TICK = 4;
const GAP = 5;
const LINE = 16; // [px] of a line of text
const CLOSEST = 13; // [px] from label to label
const FAR_ROOM = { width: 300, height: 250 }; // [px] from which there are scales on far sides

/**
 * Draw paper, grid, axes, tick labels and axis labels; return the scales.
 *
 * The label of the vertical axis stands above it, from left to right. `equal` gives both axes the
 * same unit in pixels, `margin` the least room beside the box.
 * @param {Pen} pen
 * @param {{ width: number, height: number }} size  [px]
 * @param {{ theme: Theme, x: Axis, y: Axis, title?: string, margin?: Margin, grid?: boolean,
 *   equal?: boolean }} options
 * @returns {Frame}
 */
export function frame(pen, size, options) {
  const { theme, x, y, title = '', margin = {}, grid = true, equal = false } = options;
  const { width, height } = size;
  pen.save();
  pen.fillStyle = theme.paper;
  pen.fillRect(0, 0, width, height);
  pen.font = width < NARROW ? theme.small : theme.font;
  const above = [...wrapped(pen, title, width - 8), ...wrapped(pen, y.label ?? '', width - 8)];
  const below = wrapped(pen, x.label ?? '', width - 8);
  const roomy = hasFarRoom(size);
  const up = roomy ? x.far : undefined, beside = roomy ? y.far : undefined;
  // The label of the scale on the right stands at the end of the line, or in one of its own.
  const words = shortenedTo(pen, beside?.label ?? '', width - 8);
  const full = pen.measureText(above.at(-1) ?? '').width + pen.measureText(words).width + 24 > width;
  if (words && full) above.push('');
  const top = Math.max(margin.top ?? 0, above.length ? above.length * LINE + 6 : 10) + (up ? 2 * LINE : 0);
  const under = (x.bare ? TICK : TICK + LINE) + below.length * LINE;
  const bottom = Math.max(top + 8, height - Math.max(margin.bottom ?? 0, under + 3));

  const upright = { ...y, start: bottom, end: top };
  const rows = y.ticks ?? verticalTicks(scale(upright), bottom - top);
  const widest = y.bare ? 0 : Math.max(0, ...rows.map((tick) => pen.measureText(tick.label).width));
  const least = Math.ceil(Math.max(margin.left ?? 0, widest + TICK + GAP + 2));
  const others = beside ? verticalTicks(scale(inFar(upright, beside.factor)), bottom - top) : [];
  const wide = others.map(({ label }) => pen.measureText(label).width + TICK + GAP + 4);
  const { ticks: columns, left, right } = horizontalTicks(pen, x, least, width,
    Math.max(margin.right ?? 0, ...wide));

  const box = { left, top, width: Math.max(8, right - left), height: bottom - top };
  const [across, along] = equal ? equalAxes(x, y, box) : [x, y];
  const found = {
    x: scale({ ...across, start: left, end: left + box.width }),
    y: scale({ ...along, start: bottom, end: top }),
    box, theme, size,
  };
  const marks = { columns: equal && !x.ticks ? found.x.ticks(Math.max(4, columns.length)) : columns,
    rows: equal && !y.ticks ? verticalTicks(found.y, box.height) : rows };
  if (grid) drawGrid(pen, found, marks);
  drawAxes(pen, found, x, y, marks);
  if (beside) drawFar(pen, found, others.map((tick) => ({ ...tick, value: tick.value * beside.factor })), []);
  if (up) {
    const { ticks } = horizontalTicks(pen, inFar(x, up.factor), 0, 0.9 * box.width, 0);
    drawFar(pen, found, [], ticks.map((tick) => ({ ...tick, value: tick.value * up.factor })));
  }

  pen.textBaseline = 'middle';
  pen.textAlign = 'left';
  above.forEach((text, k) => {
    const headed = k === 0 && title !== '';
    pen.font = headed ? theme.strong : width < NARROW ? theme.small : theme.font;
    pen.fillStyle = headed ? theme.ink : theme.quiet;
    pen.fillText(text, 4, (k + 0.5) * LINE + 1);
  });
  pen.fillStyle = theme.quiet;
  if (words) pen.fillText(words, width - 4 - pen.measureText(words).width, (above.length - 0.5) * LINE + 1);
  if (up) {
    const label = shortenedTo(pen, up.label, box.width);
    pen.fillText(label, left + (box.width - pen.measureText(label).width) / 2, top - 1.5 * LINE - TICK);
  }
  below.forEach((text, k) => {
    const half = pen.measureText(text).width / 2;
    const middle = Math.min(width - 4 - half, Math.max(4 + half, left + box.width / 2));
    pen.fillText(text, middle - half, bottom + under - (below.length - k - 0.5) * LINE);
  });
  pen.restore();
  return found;
}

/** Return an axis in the values of its far side. @template {Axis} T @param {T} axis @param {number} factor */
function inFar(axis, factor) {
  return { ...axis, from: axis.from / factor, to: axis.to / factor };
}

/**
 * Draw the ticks and numbers of scales on the right and above.
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {Tick[]} rows
 * @param {Tick[]} columns
 */
function drawFar(pen, { x, y, box, theme }, rows, columns) {
  const right = crisp(box.left + box.width - 1), top = crisp(box.top);
  pen.strokeStyle = pen.fillStyle = theme.quiet;
  pen.textBaseline = 'middle';
  pen.beginPath();
  for (const { value, label } of rows) {
    pen.moveTo(right, crisp(y.at(value)));
    pen.lineTo(right + TICK, crisp(y.at(value)));
    pen.textAlign = 'left';
    pen.fillText(label, right + TICK + 3, Math.min(box.top + box.height, Math.max(box.top, y.at(value))));
  }
  for (const { value, label } of columns) {
    pen.moveTo(crisp(x.at(value)), top);
    pen.lineTo(crisp(x.at(value)), top - TICK);
    pen.textAlign = 'center';
    pen.fillText(label, x.at(value), top - TICK - LINE / 2);
  }
  pen.stroke();
}

/** Return whether scales on far sides have room. @param {{ width: number, height: number }} size */
export function hasFarRoom({ width, height }) {
  return width >= FAR_ROOM.width && height >= FAR_ROOM.height;
}

/**
 * Draw the outline of the box again, over what fills it.
 * @param {Pen} pen
 * @param {Frame} onto
 */
export function outline(pen, { box, theme }) {
  pen.save();
  pen.strokeStyle = theme.ink;
  pen.lineWidth = 1;
  pen.strokeRect(Math.round(box.left) + 0.5, Math.round(box.top) + 0.5, Math.round(box.width) - 1,
    Math.round(box.height) - 1);
  pen.restore();
}

/**
 * Return a text in lines that fit a width, two at most; the second is cut where it has to be.
 * @param {Pen} pen
 * @param {string} text
 * @param {number} width  [px]
 * @returns {string[]}
 */
export function wrapped(pen, text, width) {
  if (!text) return [];
  if (pen.measureText(text).width <= width) return [text];
  const words = text.split(' ');
  let count = words.length - 1;
  while (count > 1 && pen.measureText(words.slice(0, count).join(' ')).width > width) count--;
  const lines = [words.slice(0, count).join(' '), words.slice(count).join(' ')];
  return lines.filter((line) => line).map((line) => shortenedTo(pen, line, width));
}

/**
 * Return a text that is cut, with an ellipsis, where it is wider than allowed.
 * @param {Pen} pen
 * @param {string} text
 * @param {number} width  [px]
 */
export function shortenedTo(pen, text, width) {
  if (pen.measureText(text).width <= width) return text;
  const letters = [...text];
  while (letters.length && pen.measureText(`${letters.join('')}…`).width > width) letters.pop();
  return `${letters.join('').trimEnd()}…`;
}

/**
 * @param {number} length  [px]
 * @param {number} each  [px]
 */
function fitting(length, each) {
  return Math.min(10, Math.max(2, Math.floor(length / each)));
}

/**
 * Return ticks with room between them: three where they fit, though closer than the others.
 * @param {Scale} along
 * @param {number} length  [px]
 */
function verticalTicks(along, length) {
  const count = fitting(length, 2.2 * LINE);
  const choices = [0, 1, 2, 3, 4, -1, -2].map((more) => along.ticks(Math.max(1, count + more)));
  const clear = choices.filter((ticks) => ticks.every(({ value }, k) => k === 0
    || Math.abs(along.at(value) - along.at(ticks[k - 1].value)) >= CLOSEST));
  return clear.find((ticks) => ticks.length >= 3) ?? clear[0] ?? choices[0].slice(0, 1);
}

/**
 * Return as many ticks as have room for their labels, and the ends of the axis.
 * @param {Pen} pen
 * @param {Axis} axis
 * @param {number} least  of the left end
 * @param {number} width
 * @param {number} margin  on the right
 */
function horizontalTicks(pen, axis, least, width, margin) {
  for (let count = fitting(width - least, 42); ; count--) {
    const plain = scale({ ...axis, start: 0, end: 1 });
    const ticks = axis.ticks ?? plain.ticks(count);
    const widths = ticks.map((tick) => (axis.bare ? 0 : pen.measureText(tick.label).width));
    // What a label needs beyond an end of the axis.
    const length = width - least;
    const before = ticks.map(({ value }, k) => widths[k] / 2 - plain.at(value) * length * 0.8);
    const left = Math.ceil(Math.max(least, ...before.map((far) => far + 2)));
    const beyond = ticks.map(({ value }, k) => widths[k] / 2 - (1 - plain.at(value)) * length * 0.8);
    const right = width - Math.ceil(Math.max(margin, 6, ...beyond.map((far) => far + 2)));
    const at = ticks.map(({ value }) => left + plain.at(value) * (right - left));
    const order = at.map((_, k) => k).sort((one, other) => at[one] - at[other]);
    const clear = order.every((k, n) => n === 0 || at[k] - widths[k] / 2 - GAP
      >= at[order[n - 1]] + widths[order[n - 1]] / 2);
    if (clear || count <= 1 || axis.ticks) {
      return { ticks: clear || axis.ticks ? ticks : ticks.slice(0, 1), left, right };
    }
  }
}

/**
 * Widen one of two axes so that a unit is as long on both.
 * @param {Axis} x
 * @param {Axis} y
 * @param {Box} box
 * @returns {[Axis, Axis]}
 */
function equalAxes(x, y, box) {
  const unit = Math.min(box.width / Math.abs(x.to - x.from), box.height / Math.abs(y.to - y.from));
  /** @type {(axis: Axis, length: number) => Axis} */
  const widened = (axis, length) => {
    const middle = (axis.from + axis.to) / 2;
    const half = (Math.sign(axis.to - axis.from) * length) / unit / 2;
    return { ...axis, from: middle - half, to: middle + half };
  };
  return [widened(x, box.width), widened(y, box.height)];
}

/** @param {number} pixel */
function crisp(pixel) {
  return Math.round(pixel) + 0.5;
}

/**
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {{ columns: Tick[], rows: Tick[] }} marks
 */
function drawGrid(pen, { x, y, box, theme }, { columns, rows }) {
  pen.beginPath();
  for (const { value } of columns) {
    pen.moveTo(crisp(x.at(value)), box.top);
    pen.lineTo(crisp(x.at(value)), box.top + box.height);
  }
  for (const { value } of rows) {
    pen.moveTo(box.left, crisp(y.at(value)));
    pen.lineTo(box.left + box.width, crisp(y.at(value)));
  }
  pen.strokeStyle = theme.hair;
  pen.lineWidth = 1;
  pen.stroke();
}

/**
 * @param {Pen} pen
 * @param {Frame} onto
 * @param {Axis} across
 * @param {Axis} along
 * @param {{ columns: Tick[], rows: Tick[] }} marks
 */
function drawAxes(pen, { x, y, box, theme }, across, along, { columns, rows }) {
  const [left, bottom] = [crisp(box.left), crisp(box.top + box.height)];
  pen.beginPath();
  pen.moveTo(left, box.top);
  pen.lineTo(left, bottom);
  pen.lineTo(box.left + box.width, bottom);
  for (const { value } of columns) {
    pen.moveTo(crisp(x.at(value)), bottom);
    pen.lineTo(crisp(x.at(value)), bottom + TICK);
  }
  for (const { value } of rows) {
    pen.moveTo(left, crisp(y.at(value)));
    pen.lineTo(left - TICK, crisp(y.at(value)));
  }
  if (!across.ticks) {
    for (const value of x.minor(columns.length)) {
      pen.moveTo(crisp(x.at(value)), bottom);
      pen.lineTo(crisp(x.at(value)), bottom + TICK / 2);
    }
  }
  if (!along.ticks) {
    for (const value of y.minor(rows.length)) {
      pen.moveTo(left, crisp(y.at(value)));
      pen.lineTo(left - TICK / 2, crisp(y.at(value)));
    }
  }
  pen.strokeStyle = theme.ink;
  pen.lineWidth = 1;
  pen.stroke();
  pen.fillStyle = theme.ink;
  if (!across.bare) {
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    for (const { value, label } of columns) {
      pen.fillText(label, x.at(value), bottom + TICK + LINE / 2);
    }
  }
  if (!along.bare) {
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    for (const { value, label } of rows) {
      const edge = Math.min(bottom, Math.max(box.top, y.at(value)));
      pen.fillText(label, left - TICK - 3, edge);
    }
  }
}
