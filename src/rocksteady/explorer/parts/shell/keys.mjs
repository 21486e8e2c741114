// Keys of the page.  A panel with the focus comes first; what it leaves, others may take.

/** @import { App, Panel } from './app.mjs' */
import { toggleHelp } from './help.mjs';
import { openMenu } from './menus.mjs';
import { TABS } from './state.mjs';

/** Keys and what they do, for the list of keys. @type {readonly (readonly [string, string])[]} */
export const KEY_WORDS = [
  ['← → ↑ ↓', 'move the point of the panel that has the focus; with Shift ten times as far'],
  ['+ − 0', 'zoom in, zoom out, show all'],
  ['[ ]', 'go to the previous or next region of the map'],
  ['Space', 'play or stop the film'],
  [', .', 'step the film back or forward'],
  ['P', 'pin the present history, to compare others with it'],
  ['1 to 4', 'Shake it, Let it go, Earthquake, Which block'],
  ['B', 'bifurcation strip: along the row or the column of the point'],
  ['E', 'save or copy the panel that has the focus'],
  ['L', 'logarithmic or linear axes of the map'],
  ['?', 'this help'],
  ['Esc', 'close what is open'],
];

const MAIN_PANELS = ['map', 'basins', 'pulse', 'quake', 'design'];
// What takes letters, numbers, arrows or Space itself.
const TAKES_KEYS = 'input, select, textarea, [contenteditable], [role="slider"]';
const TAKES_SPACE = 'button, summary, a, [role="button"]';

/**
 * Have the page listen to keys.
 * @param {App} app
 */
export function listenToKeys(app) {
  document.addEventListener('keydown', (event) => {
    if (app.state.at !== 'lab' || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    if (app.shared.keysOff && event.key !== 'Escape') return;
    const target = event.target instanceof Element ? event.target : document.body;
    if (isTaken(event.key, target)) return;
    if (pageKey(app, event.key, target) || othersKey(app, event, target)) event.preventDefault();
  });
}

/**
 * Return whether an element takes a key itself.
 * @param {string} key
 * @param {Element} target
 */
function isTaken(key, target) {
  if (target.closest('dialog')) return key !== '?' || target.matches(TAKES_KEYS);
  if (target.closest(TAKES_KEYS)) return true;
  return (key === ' ' || key === 'Enter') && target.closest(TAKES_SPACE) !== null;
}

/**
 * Do what a key of the page does; return whether it does something.
 * @param {App} app
 * @param {string} key
 * @param {Element} target
 * @returns {boolean}
 */
function pageKey(app, key, target) {
  const { state } = app;
  if (key === '?') toggleHelp(app, KEY_WORDS);
  else if (/^[1-4]$/.test(key)) app.set({ tab: TABS[Number(key) - 1] });
  else if (/^b$/i.test(key)) app.set({ by: state.by === 'w' ? 'a' : 'w' });
  else if (/^l$/i.test(key)) app.set({ log: state.log === 1 ? 0 : 1 });
  else if (/^e$/i.test(key)) return openMenu(focusedPanel(app, target) ?? mainPanel(app));
  else return false;
  return true;
}

/**
 * Offer a key to the panels that are seen, the main one first; arrows scroll the page unless a
 * panel has the focus.
 * @param {App} app
 * @param {KeyboardEvent} event
 * @param {Element} target
 */
function othersKey(app, event, target) {
  const focused = focusedPanel(app, target);
  if (event.key.startsWith('Arrow') && !focused) return false;
  if (/^(Tab|Enter|Page|Home|End)/.test(event.key)) return false;
  const seen = seenPanels(app).filter((panel) => panel.keys && panel.canvas !== target);
  const first = mainPanel(app);
  const ordered = [...seen.filter((panel) => panel === first), ...seen];
  return ordered.some((panel) => {
    app.bring(panel);
    return panel.keys?.(event) === true;
  });
}

/** @param {App} app */
function seenPanels(app) {
  return app.panels.filter(({ root }) => root && root.offsetParent !== null);
}

/** @param {App} app @returns {Panel | undefined} */
function mainPanel(app) {
  const seen = seenPanels(app);
  return seen.find(({ name }) => MAIN_PANELS.includes(name)) ?? seen[0];
}

/** @param {App} app @param {Element} target @returns {Panel | undefined} */
function focusedPanel(app, target) {
  return app.panels.find(({ root }) => root?.contains(target));
}
