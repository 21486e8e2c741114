// Buttons and choices above the map.

/** @import { App } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
import { make } from '../../shell/layout.mjs';
import { startOf } from '../../shell/state.mjs';

const FIRST_STATE = '0.4,0'; // where the first choice of a state starts: angle, velocity

/**
 * Put the choices of the map into a bar; return what makes them show a state.
 * @param {App} app
 * @param {HTMLElement} bar
 * @returns {(state: State) => void}
 */
export function makeMapBar(app, bar) {
  let state = FIRST_STATE;
  const start = choice('start', [['rest', 'from rest'], ['steady', 'from the steady state'],
    ['state', 'from this state']]);
  const hue = choice('colour', [['kind', 'by kind'], ['period', 'by period'], ['peak', 'by peak']]);
  const log = /** @type {HTMLInputElement} */ (make('input', { type: 'checkbox' }));
  const logged = make('label', { class: 'check' }, log, ' log axes');
  bar.append(start, hue, logged);
  start.addEventListener('change', () => {
    app.set({ start: start.value === 'state' ? state : start.value });
  });
  hue.addEventListener('change', () => app.set({ hue: hue.value }));
  log.addEventListener('change', () => app.set({ log: log.checked ? 1 : 0 }));
  return (shown) => {
    const { kind } = startOf(shown);
    const free = kind === 'state' || kind === 'impact';
    if (free) state = shown.start;
    start.value = free ? 'state' : kind;
    const words = state.split(/[,:]/).map((part) => String(Number(Number(part).toPrecision(3))));
    start.options[2].textContent = `from this state (${words.join(', ')})`;
    hue.value = shown.hue;
    log.checked = shown.log === 1;
  };
}

/** @param {string} name @param {string[][]} options */
function choice(name, options) {
  const made = options.map(([value, text]) => make('option', { value }, text));
  const label = name === 'start' ? 'Start of the motions on the map' : 'Colours of the map';
  return /** @type {HTMLSelectElement} */ (make('select', { 'aria-label': label }, ...made));
}
