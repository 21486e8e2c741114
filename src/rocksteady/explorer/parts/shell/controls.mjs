// The parameters of block and shaking at the top of the page: numbers, as the units are chosen.

/** @import { App } from './app.mjs' */
/** @import { State } from './state.mjs' */
import { GRAVITY } from '../physics/case.mjs';
import { element } from './app.mjs';
import { make, say, setOn } from './layout.mjs';
import { FIELDS, blockNumbers, equationsOf } from './state.mjs';
import { pageUnits } from './units.mjs';

/**
 * @typedef {object} Entry
 * @property {string} name
 * @property {string} label
 * @property {string} unit
 * @property {number} step
 * @property {(app: App) => number} read
 * @property {(app: App, value: number) => Record<string, unknown>} write
 * @property {'none' | 'si'} [units]  only with these units
 */

/** @param {string} name @returns {Pick<Entry, 'read' | 'write'>} */
const plain = (name) => ({
  read: (app) => Number(app.state[/** @type {keyof State} */ (name)]),
  write: (_, value) => ({ [name]: value }),
});

/** @type {readonly Entry[]} */
const ENTRIES = [
  { name: 'A', label: 'amplitude A', unit: '', step: 0.05, units: 'none', ...plain('A') },
  { name: 'W', label: 'frequency ratio Ω', unit: '', step: 0.05, units: 'none', ...plain('W') },
  {
    name: 'a_g', label: 'peak acceleration', unit: 'g', step: 0.01, units: 'si',
    read: (app) => app.state.A * pageUnits(app).amplitude.factor,
    write: (app, value) => ({ A: value / pageUnits(app).amplitude.factor }),
  },
  {
    name: 'f_hz', label: 'frequency', unit: 'Hz', step: 0.05, units: 'si',
    read: (app) => app.state.W * pageUnits(app).frequency.factor,
    write: (app, value) => ({ W: value / pageUnits(app).frequency.factor }),
  },
  { name: 'b', label: 'width', unit: 'm', step: 0.05, ...plain('b'), write: resized('b') },
  { name: 'h', label: 'height', unit: 'm', step: 0.05, ...plain('h'), write: resized('h') },
  {
    name: 'r', label: 'restitution δ', unit: '', step: 0.01,
    read: (app) => blockNumbers(app.kernels, app.state).restitution,
    write: (_, value) => ({ r: value, rh: 0 }),
  },
];

/** Names in the line that stands for the closed controls. @type {Record<string, string>} */
const SHORT = {
  a_g: 'acceleration', f_hz: 'frequency', A: 'A', W: 'Ω', r: 'δ', b: 'width', h: 'height',
};

/** Tabs whose pictures are dimensionless or not; the others have engineering units throughout. */
const WITH_UNITS = ['explore', 'basins', 'pulse'];

/**
 * Return what a new size changes: in g and Hz the shaking stays, so that A and Omega follow.
 * @param {'b' | 'h'} name
 * @returns {(app: App, value: number) => Record<string, unknown>}
 */
function resized(name) {
  return (app, value) => {
    const size = FIELDS[name].parse(String(value));
    if (app.state.units === 'none' || size === undefined) return { [name]: value };
    const before = blockNumbers(app.kernels, app.state);
    const after = blockNumbers(app.kernels, { ...app.state, [name]: Number(size) });
    return {
      [name]: value,
      A: (app.state.A * before.alpha) / after.alpha,
      W: (app.state.W * before.p) / after.p,
    };
  };
}

/**
 * Make the row of controls.
 * @param {App} app
 */
export function makeControls(app) {
  const given = /** @type {HTMLDetailsElement} */ (element('given'));
  given.open = matchMedia('(min-width: 700px)').matches; // where it leaves room for the pictures
  const row = element('controls');
  const shown = ENTRIES.map((entry) => {
    const input = /** @type {HTMLInputElement} */ (make('input', {
      type: 'number', step: String(entry.step), id: `in-${entry.name}`, inputmode: 'decimal',
      'data-name': entry.name,
    }));
    const unit = entry.unit ? ` [${entry.unit}]` : '';
    const label = make('label', {}, make('span', {}, `${entry.label}${unit}`), input);
    input.addEventListener('change', () => {
      const value = Number(input.value);
      const refused = input.value.trim() === '' ? [entry.name] : app.set(entry.write(app, value));
      input.setAttribute('aria-invalid', String(refused.length > 0));
      if (refused.length) input.title = `${entry.label} is refused: ${input.value || 'no number'}`;
      else input.removeAttribute('title');
      if (refused.length) app.say(input.title);
    });
    row.append(label);
    return { entry, input, label };
  });
  const housner = checkbox('Housner', 'rh', 'restitution 1 − 1.5 sin² α, of a slender rectangle');
  const model = select('equations', 'model',
    [['auto', 'default'], ['linear', 'linear'], ['nonlinear', 'nonlinear']]);
  const units = select('units', 'units', [['none', 'dimensionless'], ['si', 'g, Hz, °, s']]);
  const look = select('theme', 'look',
    [['auto', 'system theme'], ['light', 'light'], ['dark', 'dark']]);
  row.append(housner.label, model.label, units.label);
  look.label.firstElementChild?.classList.add('unseen');
  element('menu').append(look.label);
  housner.input.addEventListener('change', () => {
    const on = housner.input.checked;
    app.set(on ? { rh: 1 } : { rh: 0, r: blockNumbers(app.kernels, app.state).restitution });
    refresh();
  });
  for (const one of [model, units, look]) {
    one.input.addEventListener('change', () => app.set({ [one.name]: one.input.value }));
  }

  const refresh = () => {
    const { state } = app;
    for (const { entry, input, label } of shown) {
      // The pulse, the record and the demand of a design stand in their own tabs.
      label.hidden = entry.units !== undefined
        && (entry.units !== state.units || ['pulse', 'quake', 'design'].includes(state.tab));
      if (document.activeElement === input && input.getAttribute('aria-invalid') === 'true') continue;
      const value = entry.read(app);
      // What is derived is shown with the digits that people give.
      const text = String(Number(value.toPrecision(entry.units === 'si' ? 4 : 6)));
      if (input.value !== text) input.value = text;
      setOn(input, 'data-value', String(value));
      setOn(input, 'aria-invalid', 'false');
    }
    units.label.hidden = !WITH_UNITS.includes(state.tab);
    say(model.input.options[0], `default, ${equationsOf({ ...state, model: 'auto' })}`);
    housner.input.checked = state.rh === 1;
    for (const one of [model, units, look]) {
      const chosen = String(state[/** @type {keyof State} */ (one.name)]);
      if (one.input.value !== chosen) one.input.value = chosen;
    }
    const { alpha, radius, p } = blockNumbers(app.kernels, state);
    const values = shown.filter(({ label }) => !label.hidden).map(({ entry, input }) =>
      `${SHORT[entry.name] ?? entry.label} ${input.value}${entry.unit && ` ${entry.unit}`}`);
    const summary = given.querySelector('summary');
    if (summary) say(summary, values.join(', '));
    // The linear equations put alpha for tan(alpha), which is width over height.
    const [least, name] = equationsOf(state) === 'linear' ? [alpha, 'αg'] : [state.b / state.h, 'g tan α'];
    say(element('measures'),
      `α = ${((alpha * 180) / Math.PI).toFixed(2)}°, R = ${radius.toPrecision(4)} m, ` +
      `p = ${p.toPrecision(4)} rad/s, uplift at ${least.toPrecision(3)} g ` +
      `(${name} = ${(least * GRAVITY).toPrecision(3)} m/s²)`);
  };
  document.addEventListener('state', refresh);
  refresh();
}

/** @param {string} words @param {string} name @param {string} title */
function checkbox(words, name, title) {
  const input = /** @type {HTMLInputElement} */ (make('input', { type: 'checkbox', id: `in-${name}` }));
  return { input, label: make('label', { class: 'check', title }, input, make('span', {}, words)) };
}

/** @param {string} words @param {string} name @param {string[][]} options */
function select(words, name, options) {
  const made = options.map(([value, text]) => make('option', { value }, text));
  const input = /** @type {HTMLSelectElement} */ (make('select', { id: `in-${name}` }, ...made));
  return { name, input, label: make('label', {}, make('span', {}, words), input) };
}
