// Menus of panels and of the page: what is saved as a file, and what is copied.

/** @import { App, Panel } from './app.mjs' */
import { element } from './app.mjs';
import { addressOf, commandOf, pythonOf, subjectOf } from './copy.mjs';
import { exportPanel } from './export.mjs';
import { make } from './layout.mjs';

/** @typedef {[label: string, chosen: () => void | Promise<void>]} MenuItem */

/**
 * Add the menus of all panels and that of the page.
 * @param {App} app
 */
export function addMenus(app) {
  for (const panel of app.panels) {
    panel.bar?.after(panelMenu(app, panel));
  }
  element('menu').append(openingMenu('Copy', 'Copy the present view', [
    ['Copy link', () => copyText(app, 'Link', addressOf(app.state, location.href))],
    ['Copy as Python', () => copyText(app, 'Python script', pageScript(app))],
    ['Copy as command', () => copyText(app, 'Command', pageCommand(app))],
  ]));
  document.addEventListener('pointerdown', ({ target }) => closeMenus(target));
  document.addEventListener('keydown', ({ key }) => {
    if (key !== 'Escape') return;
    const open = document.querySelector('details.menu[open]');
    closeMenus(null);
    /** @type {HTMLElement | null | undefined} */ (open?.querySelector('summary'))?.focus();
  });
}

/**
 * Open the menu of a panel.
 * @param {Panel | undefined} panel
 */
export function openMenu(panel) {
  const menu = /** @type {HTMLDetailsElement | null | undefined} */ (
    panel?.root?.querySelector('details.menu'));
  if (!menu) return false;
  menu.open = true;
  menu.querySelector('button')?.focus();
  return true;
}

/** @param {App} app @param {string} [panel] */
function pageScript(app, panel) {
  return pythonOf(app.state, subjectOf(app.state, panel), shownMotion(app));
}

/** @param {App} app @param {string} [panel] */
function pageCommand(app, panel) {
  return commandOf(app.state, subjectOf(app.state, panel), shownMotion(app));
}

/** @param {App} app */
function shownMotion(app) {
  const { record = 0 } = /** @type {Record<string, any>} */ (app.state);
  return app.motions[Number(record)] ?? app.motions[0];
}

/** @param {App} app @param {Panel} panel */
function panelMenu(app, panel) {
  /** @type {(kind: 'png' | 'svg' | 'csv') => MenuItem} */
  const saved = (kind) => [`${kind.toUpperCase()}`, () => exportPanel(app, panel, kind)];
  return openingMenu('Save', `Save or copy: ${panel.title}`, [
    ...(panel.draw ? [saved('png'), saved('svg')] : []),
    ...(panel.table ? [saved('csv')] : []),
    ['Copy as Python', () => copyText(app, 'Python script', pageScript(app, panel.name))],
    ['Copy as command', () => copyText(app, 'Command', pageCommand(app, panel.name))],
  ]);
}

/**
 * @param {string} label
 * @param {string} title
 * @param {MenuItem[]} items
 */
export function openingMenu(label, title, items) {
  const summary = make('summary', { title, 'aria-label': title }, label);
  const list = make('div', { class: 'list' });
  const made = make('details', { class: 'menu' }, summary, list);
  const menu = /** @type {HTMLDetailsElement} */ (made);
  for (const [words, chosen] of items) {
    const button = make('button', { type: 'button' }, words);
    button.addEventListener('click', async () => {
      menu.open = false;
      summary.focus();
      await chosen();
    });
    list.append(button);
  }
  menu.addEventListener('toggle', () => {
    if (!menu.open) return;
    for (const other of document.querySelectorAll('details.menu[open]')) {
      if (other !== menu) /** @type {HTMLDetailsElement} */ (other).open = false;
    }
  });
  return menu;
}

/** @param {EventTarget | null} target */
function closeMenus(target) {
  for (const menu of document.querySelectorAll('details.menu[open]')) {
    if (!(target instanceof Node && menu.contains(target))) {
      /** @type {HTMLDetailsElement} */ (menu).open = false;
    }
  }
}

/**
 * Copy a text; where the browser refuses, show it in a dialog, selected.
 * @param {App} app
 * @param {string} name
 * @param {string} text
 */
async function copyText(app, name, text) {
  try {
    await navigator.clipboard.writeText(text);
    app.say(`${name} copied`);
    showCopied(`${name} copied`);
  } catch {
    showText(name, text);
  }
}

/** Say for a moment that something was copied. @param {string} words */
function showCopied(words) {
  const note = make('p', { class: 'copied', 'aria-hidden': 'true' }, words);
  document.body.append(note);
  setTimeout(() => note.remove(), 1600);
}

/** @param {string} name @param {string} text */
function showText(name, text) {
  const area = /** @type {HTMLTextAreaElement} */ (
    make('textarea', { readonly: '', rows: '12', cols: '64', 'aria-label': name }));
  area.value = text;
  const close = make('button', { type: 'button' }, 'Close');
  const words = make('p', {}, `${name}: this browser lets no page copy. Copy the selected text.`);
  const dialog = /** @type {HTMLDialogElement} */ (make('dialog', {}, words, area, close));
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  area.focus();
  area.select();
}
