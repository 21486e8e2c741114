// Where panels stand: their elements, sizes, tabs and theme.

/** @import { App, Panel } from './app.mjs' */
import { theme } from '../draw/theme.mjs';
import { element, sizeOf } from './app.mjs';
import { ROOMS, TABS } from './state.mjs';

export const TAB_WORDS = ['Shake it', 'Let it go', 'Earthquake', 'Which block'];

/** What to do first, by the tab. @type {Readonly<Record<string, string>>} */
const LEADS = {
  explore: 'For researchers: drag the point on the map to change the shaking.',
  basins: 'Drag the ring to change the angle and velocity at the start.',
  pulse: 'For researchers: drag the point to change the pulse that acts on the block.',
  quake: 'Drag the scale of the ground motion, or drop a record here.',
  design: 'Drag the point to change the size of the block.',
};

/**
 * Return a new element.
 * @param {string} tag
 * @param {Record<string, string>} [attributes]
 * @param {...(Node | string)} inside
 * @returns {HTMLElement}
 */
export function make(tag, attributes = {}, ...inside) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...inside);
  return made;
}

/** Write a text where there is another: the same text would be laid out again.
 * @param {Element} place @param {string} text */
export function say(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

/** Set an attribute that has another value. @param {Element} on @param {string} name @param {string} value */
export function setOn(on, name, value) {
  if (on.getAttribute(name) !== value) on.setAttribute(name, value);
}

/**
 * Put a panel on the page, in the tabs in which it is seen.
 * @param {App} app
 * @param {Panel} panel
 * @param {readonly string[]} tabs
 */
export function place(app, panel, tabs) {
  const id = `panel-${panel.name}`;
  panel.bar = make('div', { class: 'bar' });
  panel.note = make('p', { class: 'note' });
  const heading = make('h2', { id: `${id}-title` }, panel.title);
  const root = make('section', {
    class: 'panel',
    id,
    'data-panel': panel.name,
    'data-tabs': tabs.join(' '),
    ...(tabs.includes(app.state.tab) ? {} : { hidden: '' }),
    'aria-labelledby': `${id}-title`,
  });
  root.append(make('header', {}, heading, panel.bar), panel.note);
  panel.root = root;
  if (panel.draw) {
    const canvas = /** @type {HTMLCanvasElement} */ (make('canvas', { role: 'img' }));
    panel.canvas = canvas;
    root.append(make('div', { class: 'canvas' }, canvas));
    if (panel.keys) {
      canvas.tabIndex = 0;
      canvas.setAttribute('role', 'application');
      canvas.addEventListener('keydown', (event) => {
        if (app.shared.keysOff || event.ctrlKey || event.metaKey || event.altKey) return;
        app.bring(panel);
        if (panel.keys?.(event)) {
          event.preventDefault();
          event.stopPropagation();
        }
      });
    }
    new ResizeObserver(() => {
      panel.size = sizeOf(canvas);
      app.redraw(panel);
    }).observe(canvas);
    new IntersectionObserver((seen) => {
      panel.away = !seen[seen.length - 1].isIntersecting;
      if (!panel.away) app.touch();
    }).observe(canvas);
  } else {
    panel.body = make('div', { class: 'body' });
    root.append(panel.body);
  }
  element('panels').append(root);
  app.panels.push(panel);
  panel.placed?.();
}

/** Return whether a tab is a question of the bench. @param {string} tab */
export function onBench(tab) {
  return TABS.includes(tab) && tab !== 'quake';
}

/**
 * Show the panels of the present tab.
 * @param {App} app
 */
export function showTab(app) {
  const { tab } = app.state, question = ROOMS[tab] ?? tab;
  element('panels').dataset.tab = tab;
  element('lab').dataset.on = onBench(tab) ? 'bench' : 'panels';
  element('panels').setAttribute('aria-labelledby', `tab-${question}`);
  element('bench').hidden = !onBench(tab);
  setOn(element('bench'), 'aria-labelledby', `tab-${question}`);
  element('panels').hidden = element('given').hidden = onBench(tab);
  element('back').hidden = question === tab;
  element('lead').textContent = LEADS[tab] ?? '';
  for (const panel of app.panels) {
    const tabs = panel.root?.dataset.tabs?.split(' ') ?? [];
    if (panel.root) panel.root.hidden = !tabs.includes(tab);
  }
  for (const name of TABS) {
    const button = element(`tab-${name}`);
    button.setAttribute('aria-selected', String(name === question));
    button.tabIndex = name === question ? 0 : -1;
  }
}

/**
 * Make the row of tabs.
 * @param {App} app
 */
export function makeTabs(app) {
  const row = element('tabs');
  TABS.forEach((name, k) => {
    const attributes = {
      role: 'tab', id: `tab-${name}`, type: 'button', 'aria-controls': onBench(name) ? 'bench' : 'panels',
      title: `${TAB_WORDS[k]} (key ${k + 1})`,
    };
    const tab = make('button', attributes, TAB_WORDS[k]);
    tab.addEventListener('click', () => app.set({ tab: name }));
    tab.addEventListener('keydown', ({ key }) => {
      const to = { ArrowRight: k + 1, ArrowLeft: k - 1, Home: 0, End: -1 }[key];
      if (to === undefined) return;
      const other = TABS[(to + TABS.length) % TABS.length];
      app.set({ tab: other });
      element(`tab-${other}`).focus();
    });
    row.append(tab);
  });
}

/**
 * Give the page its colours, light or dark, and have all panels drawn in them.
 * @param {App} app
 */
export function applyTheme(app) {
  const { look } = app.state;
  wear(app, look === 'dark' || (look === 'auto' && darkSystem().matches));
  for (const panel of app.panels) app.redraw(panel);
}

/** Print in light colours, and draw at the size of the sheet, whatever the window has. @param {App} app */
export function printInLight(app) {
  const { dataset } = document.documentElement;
  addEventListener('beforeprint', () => {
    dataset.sheet = '';
    element('bench').dataset.address = decodeURI(location.href);
    wear(app, false);
    app.paintAll();
    document.dispatchEvent(new Event('sheet'));
  });
  addEventListener('afterprint', () => {
    delete dataset.sheet;
    applyTheme(app);
  });
}

/** @param {App} app @param {boolean} dark */
function wear(app, dark) {
  app.theme = theme(dark);
  document.documentElement.dataset.look = dark ? 'dark' : 'light';
  document.dispatchEvent(new Event('theme'));
}

/** Return the query for the theme of the system. */
export function darkSystem() {
  return matchMedia('(prefers-color-scheme: dark)');
}
