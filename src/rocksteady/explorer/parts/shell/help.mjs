// The help: worked examples, keys, what each panel shows, and how to drag.

/** @import { App } from './app.mjs' */
import { element } from './app.mjs';
import { make } from './layout.mjs';
import { openingMenu } from './menus.mjs';
import { defaultState } from './state.mjs';

/** What the panels show, by their names. @type {Readonly<Record<string, string>>} */
const PANEL_WORDS = {
  readout: 'the motion at the point in numbers, and the motions beside it from other starts',
  map: 'what the block settles to at each frequency and amplitude; edges of regions are lines, and '
    + 'cells that are not computed are dotted',
  film: 'the block on its moving base; play it, or drag along it',
  history: 'the angle over the time, with the impacts; ±1 is the slenderness α',
  phase: 'velocity against angle; an impact is a step at angle 0',
  section: 'the state once a period; a periodic motion is a few points',
  multipliers: 'Floquet multipliers; inside the unit circle the motion is stable',
  strip: 'what the block settles to along the row or the column of the point, in an upward and a '
    + 'downward sweep; where they differ, how it begins decides',
  basins: 'where the block goes from each initial state; drag a state to see its motion',
  pulse: 'whether a single pulse fells the block, and after how many impacts',
  pulsehistory: 'base motion and angle under the pulse at the point',
  quake: 'the ground motion and the angle of the block; drop a file to read another',
  spectrum: 'the largest angle of blocks of other sizes under this motion',
  verdict: 'whether the block falls, at this scale of the motion and at others',
  design: 'sizes of blocks that stand the demand, and sizes that fall',
  designed: 'the chosen block in numbers',
};

const DRAG_WORDS = [
  'Drag the point on a map: all that is computed for it follows.',
  'Shift and drag a box: it is computed again, finer.',
  'Turn the wheel, pinch, or use the keys + and − to zoom; double-click shows all.',
  'Back in the browser undoes a zoom or a jump; the address holds the whole view.',
];

/**
 * Worked examples; keys that are not given have their defaults.
 * @type {readonly (readonly [words: string, patch: Record<string, string | number>])[]}
 */
const EXAMPLES = [
  ['It rocks with the shaking', {}],
  ['It comes to rest or rocks: how it begins decides', { A: 0.8, W: 2 }],
  ['It rocks alike every shake, or every third', { A: 2, W: 6 }],
  ['It rocks further to one side', { A: 2, W: 2, r: 0.5 }],
  ['It never repeats', { A: 2.13, W: 1.95, r: 0.3 }],
  ['Nonlinear equations, a stocky block', { model: 'nonlinear', b: 0.8, h: 1.6, units: 'si' }],
  ['Starts that come to rest, rock or fall', { tab: 'basins', A: 0.8, W: 2, start: '0.4,0' }],
  ['One pulse: two ways to fall', { tab: 'pulse' }],
  ['A tall rack in an earthquake', { tab: 'quake', b: 0.8, h: 5 }],
  ['The size of a cabinet', { tab: 'design', b: 0.6, h: 1.8 }],
];
const KEPT = ['look', 'record']; // by examples

/**
 * Add the menu of worked examples; Back in the browser undoes one.
 * @param {App} app
 */
export function addExamples(app) {
  element('menu').append(openingMenu('Examples', 'Worked examples', EXAMPLES.map(([words, patch]) =>
    [words, () => {
      const plain = Object.entries(defaultState()).filter(([name]) => !KEPT.includes(name));
      app.set({ ...Object.fromEntries(plain), ...patch });
    }])));
}

/**
 * Add the button that opens the help.
 * @param {App} app
 * @param {readonly (readonly [string, string])[]} keys
 */
export function addHelp(app, keys) {
  const button = make('button', { type: 'button', id: 'help-button', title: 'Keys and help (?)' },
    'Help');
  button.addEventListener('click', () => toggleHelp(app, keys));
  element('menu').append(button);
}

/**
 * Open the help, or close it.
 * @param {App} app
 * @param {readonly (readonly [string, string])[]} keys  and what they do
 */
export function toggleHelp(app, keys) {
  const open = /** @type {HTMLDialogElement | null} */ (document.getElementById('help'));
  if (open) open.close();
  else openHelp(app, keys);
}

/** @param {App} app @param {readonly (readonly [string, string])[]} keys */
function openHelp(app, keys) {
  const before = document.activeElement;
  const seen = app.panels.filter(({ root }) => root && !root.hidden);
  const close = make('button', { type: 'button' }, 'Close');
  const switched = /** @type {HTMLInputElement} */ (make('input', { type: 'checkbox' }));
  switched.checked = !app.shared.keysOff;
  switched.addEventListener('change', () => {
    app.shared.keysOff = !switched.checked;
  });
  const dialog = /** @type {HTMLDialogElement} */ (make(
    'dialog', { id: 'help', 'aria-labelledby': 'help-title' },
    make('h2', { id: 'help-title' }, 'Keys and help'),
    make('h3', {}, 'With the pointer'),
    make('ul', {}, ...DRAG_WORDS.map((words) => make('li', {}, words))),
    make('h3', {}, 'Panels'),
    wordList(seen.map(({ name, title }) => [title, PANEL_WORDS[name] ?? ''])),
    make('h3', {}, 'Keys'),
    wordList(keys, 'kbd'),
    make('label', { class: 'check' }, switched, make('span', {}, 'Keys are on')),
    close,
  ));
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('click', ({ target }) => {
    if (target === dialog) dialog.close(); // beside it
  });
  dialog.addEventListener('close', () => {
    dialog.remove();
    if (before instanceof HTMLElement) before.focus();
  });
  document.body.append(dialog);
  dialog.showModal();
  close.focus();
  dialog.scrollTop = 0;
}

/**
 * @param {readonly (readonly string[])[]} pairs
 * @param {string} [tag]
 */
function wordList(pairs, tag = 'span') {
  return make('dl', {}, ...pairs.flatMap(([name, words]) => [
    make('dt', {}, make(tag, {}, name)), make('dd', {}, words),
  ]));
}
