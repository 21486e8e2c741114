// Pictures and tables as files: PNG, SVG and CSV of a panel.

/** @import { App, Panel } from './app.mjs' */
import { SvgPen } from '../draw/svg.mjs';

/** @typedef {string | number | boolean | null | undefined} Cell */
/** @typedef {{ columns: string[], rows: readonly (readonly Cell[])[] }} Table */

const PIXELS = 2; // of a picture, a pixel of the page
const FORMULA = /^[\s]*[=+\-@]|^[\t\r]/; // how spreadsheets recognise what they would compute

/**
 * Return a table as CSV by RFC 4180; text that a spreadsheet would compute is led by an apostrophe.
 * @param {Table} table
 * @returns {string}
 */
export function csvOf({ columns, rows }) {
  return [columns, ...rows].map((row) => `${row.map(csvCell).join(',')}\r\n`).join('');
}

/** @param {Cell} value */
function csvCell(value) {
  if (typeof value === 'number') return Number.isNaN(value) ? '' : String(value);
  let text = String(value ?? '');
  if (FORMULA.test(text)) text = `'${text}`;
  return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

/**
 * Return the name of a file of a panel, as rocksteady-map-A2-W3.png.
 * @param {string} panel
 * @param {{ A: number, W: number }} state
 * @param {string} ending
 */
export function fileName(panel, { A, W }, ending) {
  const [a, w] = [A, W].map((value) => String(Number(value.toPrecision(6))));
  return `rocksteady-${panel.replace(/[^a-z0-9]+/gi, '-')}-A${a}-W${w}.${ending}`;
}

/**
 * Return a panel's picture as SVG, as large as it is seen.
 * @param {App} app
 * @param {Panel} panel
 * @returns {string}
 */
export function svgOf(app, panel) {
  const size = pictureSize(panel);
  const ruler = document.createElement('canvas').getContext('2d') ?? undefined;
  const pen = new SvgPen(size.width, size.height, {
    title: panel.title, description: panel.sentence(), ruler, prefix: `${panel.name}-`,
  });
  coverPaper(app, pen, size);
  panel.draw?.(pen, size);
  return pen.toString();
}

/**
 * Return a panel's picture as PNG, at twice the resolution of the page.
 * @param {App} app
 * @param {Panel} panel
 * @returns {Promise<Blob>}
 */
export function pngOf(app, panel) {
  const size = pictureSize(panel);
  const canvas = document.createElement('canvas');
  canvas.width = size.width * PIXELS;
  canvas.height = size.height * PIXELS;
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  pen.scale(PIXELS, PIXELS);
  coverPaper(app, pen, size);
  panel.draw?.(pen, size);
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture was made'))));
  });
}

/**
 * Have the browser keep a file.
 * @param {string} name
 * @param {Blob} content
 */
export function keepFile(name, content) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/**
 * Have the browser keep a panel's picture or table.
 * @param {App} app
 * @param {Panel} panel
 * @param {'png' | 'svg' | 'csv'} kind
 */
export async function exportPanel(app, panel, kind) {
  const name = fileName(panel.name, app.state, kind);
  app.bring(panel);
  if (kind === 'png') keepFile(name, await pngOf(app, panel));
  else if (kind === 'svg') keepFile(name, new Blob([svgOf(app, panel)], { type: 'image/svg+xml' }));
  else if (panel.table) {
    keepFile(name, new Blob([csvOf(panel.table())], { type: 'text/csv;charset=utf-8' }));
  }
  app.say(`${name} is saved`);
}

/** @param {Panel} panel */
function pictureSize({ canvas }) {
  return { width: canvas?.clientWidth || 640, height: canvas?.clientHeight || 400 };
}

/**
 * @param {App} app
 * @param {import('../draw/svg.mjs').Pen} pen
 * @param {{ width: number, height: number }} size
 */
function coverPaper(app, pen, { width, height }) {
  pen.fillStyle = app.theme.paper;
  pen.fillRect(0, 0, width, height);
}
