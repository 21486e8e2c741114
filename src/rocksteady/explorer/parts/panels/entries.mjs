// Entries of the bars of panels: numbers, choices and buttons.

/** @import { App } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
import { make } from '../shell/layout.mjs';

/**
 * Return a number field of a bar; it sets a key of the state.
 * @param {App} app
 * @param {{ label: string, step: number, read: () => number,
 *   write: (value: number) => Record<string, unknown>, name: string }} entry
 * @returns {{ root: HTMLElement, refresh: () => void, words: (text: string) => void }}
 */
export function numberEntry(app, { label, step, read, write, name }) {
  const input = /** @type {HTMLInputElement} */ (make('input', {
    type: 'number', step: String(step), inputmode: 'decimal', id: `in-${name}`,
  }));
  const text = make('span', {}, label), root = make('label', { class: 'entry' }, text, input);
  const refresh = () => {
    if (document.activeElement === input && input.getAttribute('aria-invalid') === 'true') return;
    input.value = String(Number(read().toPrecision(4)));
    input.dataset.value = String(read());
    input.setAttribute('aria-invalid', 'false');
  };
  input.addEventListener('change', () => {
    const refused = input.value.trim() === '' ? [name] : app.set(write(Number(input.value)));
    input.setAttribute('aria-invalid', String(refused.length > 0));
    if (refused.length) app.say(`${text.textContent} is refused: ${input.value || 'no number'}`);
  });
  return { root, refresh, words: (words) => { text.textContent = words; } };
}

/**
 * Return a select of a bar that sets a key of the state.
 * @param {App} app
 * @param {keyof State} key
 * @param {string} label
 * @param {[string, string][]} options  values and words
 * @returns {{ root: HTMLElement, refresh: () => void, input: HTMLSelectElement }}
 */
export function choiceEntry(app, key, label, options) {
  const input = /** @type {HTMLSelectElement} */ (make('select', { id: `in-${key}` },
    ...options.map(([value, words]) => make('option', { value }, words))));
  input.addEventListener('change', () => app.set({ [key]: input.value }));
  return {
    root: make('label', { class: 'entry' }, make('span', {}, label), input), input,
    refresh: () => { input.value = String(app.state[key]); },
  };
}

/**
 * @param {string} words
 * @param {string} title
 * @param {() => void} does
 * @returns {HTMLButtonElement}
 */
export function buttonEntry(words, title, does) {
  const button = /** @type {HTMLButtonElement} */ (make('button', { type: 'button', title }, words));
  if (title) button.setAttribute('aria-label', title);
  button.addEventListener('click', does);
  return button;
}
