// What a canvas shows, for those who do not see it: a sentence and a table.

/** @import { App, Panel } from './app.mjs' */
/** @import { Table } from './export.mjs' */
import { numeral } from '../draw/scale.mjs';
import { make } from './layout.mjs';

/**
 * Return a table of quantities, each with its dimensionless column beside that in its unit.
 * @param {...[shown: import('./units.mjs').Shown | string, values: ArrayLike<any>, words?: string]} given
 *   a column, its values, dimensionless or '', and what stands before its name
 * @returns {Table & { rows: (string | number)[][] }}
 */
export function tableOf(...given) {
  const all = given.flatMap(([shown, values, words = '']) => {
    const { label, factor = 1, far = null } = typeof shown === 'string' ? { label: shown } : shown;
    const own = { name: `${words}${label}`, values: Array.from(values, (value) => (factor === 1 || value === '' ? value : value * factor)) };
    return far ? [own, { name: `${words}${far.label}`, values }] : [own];
  });
  return { columns: all.map(({ name }) => name), rows: Array.from(all[0].values, (_, k) => all.map(({ values }) => values[k])) };
}

const MOST_TABLE_ROWS = 200;
const RENEWED = 400; // [ms] after a change

/**
 * Return an element with a table of at most so many rows, and how many there are.
 * @param {Table} table
 * @param {string} caption
 * @param {number} [most]
 * @returns {HTMLElement}
 */
export function tableElement({ columns, rows }, caption, most = MOST_TABLE_ROWS) {
  const shown = rows.slice(0, most);
  const words = rows.length > most ? `${caption}: the first ${most} of ${rows.length} rows`
    : `${caption}: ${rows.length} ${rows.length === 1 ? 'row' : 'rows'}`;
  const head = make('tr', {}, ...columns.map((name) => make('th', { scope: 'col' }, name)));
  const cells = shown.map((row) => row.map((cell) => make('td', {}, cellText(cell))));
  const body = cells.map((row) => make('tr', {}, ...row));
  return make('table', {}, make('caption', {}, words), make('thead', {}, head),
    make('tbody', {}, ...body));
}

/** @param {import('./export.mjs').Cell} cell */
function cellText(cell) {
  return typeof cell === 'number' ? numeral(cell, 6) : String(cell ?? '');
}

/**
 * Give a panel a table that is made when it is opened.
 * @param {Panel} panel
 */
function addTable(panel) {
  if (!panel.table || !panel.root || !panel.draw) return; // what has no canvas is text already
  const room = make('div', { class: 'rows', tabindex: '0', role: 'region' });
  room.setAttribute('aria-label', `${panel.title}: table`);
  const summary = make('summary', { title: `${panel.title} as a table` }, 'Table');
  const details = make('details', { class: 'tabled' }, summary, room);
  details.addEventListener('toggle', () => fillTable(panel));
  panel.bar?.after(details); // in the header: opened, it takes a row of its own
}

/** @param {Panel} panel */
function fillTable(panel) {
  const room = panel.root?.querySelector('.tabled[open] > .rows');
  if (room && panel.table) room.replaceChildren(tableElement(panel.table(), panel.title));
}

/**
 * Describe panels to those who do not see them, and keep that up to date, a few times a second.
 * @param {App} app
 */
export function describePanels(app) {
  for (const panel of app.panels) addTable(panel);
  let waiting = 0;
  const renew = () => {
    waiting = 0;
    for (const panel of app.panels) {
      if (!panel.root || panel.root.hidden) continue;
      app.bring(panel); // its first frame may be late
      panel.canvas?.setAttribute('aria-label', `${panel.title}. ${panel.sentence()}`);
      fillTable(panel);
    }
  };
  const later = () => {
    waiting ||= window.setTimeout(renew, RENEWED);
  };
  const { redraw } = app;
  app.redraw = (panel) => {
    redraw(panel);
    later();
  };
  document.addEventListener('settled', later);
}
