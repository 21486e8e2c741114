// The application: one state, one frame for all panels, and what panels share.

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Pool } from '../work/pool.mjs' */
/** @import { State } from './state.mjs' */
/** @import { Theme } from '../draw/theme.mjs' */
import { linkOf, stateOfLink } from './link.mjs';
import { defaultState, patched } from './state.mjs';

/**
 * @typedef {object} Panel
 * @property {string} name
 * @property {string} title
 * @property {readonly string[]} uses  keys of the state whose change calls `update`
 * @property {(state: State, how: { changed: Set<string>, settled: boolean }) => void} update
 * @property {(pen: any, size: { width: number, height: number }) => void} [draw]  without: no canvas
 * @property {() => string} sentence
 * @property {() => { columns: string[], rows: (string | number)[][] }} [table]
 * @property {(event: KeyboardEvent) => boolean} [keys]
 * @property {(() => void)} [placed]  called once, when the elements below are there
 * @property {HTMLElement} [root]
 * @property {HTMLCanvasElement} [canvas]
 * @property {boolean} [away]  whether its canvas is scrolled out of the window
 * @property {CanvasRenderingContext2D} [pen]
 * @property {{ width: number, height: number }} [size]  of the canvas when it last changed
 * @property {HTMLElement} [body]  of a panel without canvas
 * @property {HTMLElement} [bar]
 * @property {HTMLElement} [note]
 */

/** @typedef {{ name: string, dt: number, acceleration: Float64Array, note: string }} PutIn */

/**
 * @typedef {object} App
 * @property {Kernels} kernels
 * @property {Pool} pool
 * @property {State} state
 * @property {Theme} theme
 * @property {PutIn[]} motions
 * @property {Record<string, any>} shared
 * @property {Panel[]} panels
 * @property {boolean} still  whether the reader wants no motion
 * @property {(patch: Record<string, unknown>, how?: { settled?: boolean, push?: boolean }) => string[]} set
 * @property {(panel: Panel) => void} redraw
 * @property {(panel: Panel, settled?: boolean) => void} bring  updates a panel, if it has to be
 * @property {() => void} paintAll  draws what is seen at once, as printing needs
 * @property {(...names: string[]) => void} touch  has panels updated that use `shared` things of these names
 * @property {(text: string) => void} say
 * @property {(panel: Panel, cause: string, fix: string) => void} fail
 * @property {(panel: Panel, text: string) => void} note
 */

const SETTLED_MS = 8; // for the numbers of panels, and again for their pictures
const FRESH_MS = 4; // from which the first picture of a panel waits for the next frame
const DRAG_MS = 2; // from which a picture waits for the next frame while the point is dragged

/**
 * Return the application without its panels.
 * @param {Kernels} kernels
 * @param {Pool} pool
 * @param {Record<string, string>} first  the first view
 * @returns {App}
 */
export function makeApp(kernels, pool, first) {
  const linked = stateOfLink(location.hash);
  const begin = linked ?? patchedFirst(first);
  /** @type {Set<Panel>} */
  const dirty = new Set();
  /** @type {Set<Panel>} */
  const late = new Set(); // put off from the last frame to this one
  /** @type {Map<Panel, Set<string>>} */
  const owed = new Map(); // keys changed since a panel was last updated
  /** @type {WeakSet<Panel>} */
  const met = new WeakSet(); // panels that have been updated: before that there is nothing to draw
  /** @type {Set<string>} */
  let unsettled = new Set();
  let settling = false, dragging = false;
  let frame = 0;
  let spoken = 0;
  /** @type {Panel | null} */
  let updating = null;

  /** @type {App} */
  const app = {
    kernels,
    pool,
    state: begin.state,
    theme: /** @type {Theme} */ (/** @type {unknown} */ (null)),
    motions: [],
    shared: {},
    panels: [],
    still: matchMedia('(prefers-reduced-motion: reduce)').matches,
    set(patch, { settled = true, push = settled } = {}) {
      const { state, refused } = patched(app.state, patch);
      change(state, settled);
      if (settled) write(push);
      return refused;
    },
    bring(panel, settled = settling) {
      const changed = owed.get(panel);
      if (!changed?.size) return;
      owed.delete(panel);
      met.add(panel);
      updating = panel; // what it touches itself it knows
      guarded(app, panel, () => panel.update(app.state, { changed, settled }));
      updating = null;
      dirty.add(panel);
    },
    paintAll() {
      for (const panel of app.panels) {
        if (!panel.root?.hidden && panel.draw) guarded(app, panel, () => paint(panel));
      }
    },
    redraw(panel) {
      if (!met.has(panel)) return;
      dirty.add(panel);
      request();
    },
    touch(...names) {
      owe(names, updating);
      if (!updating) request();
    },
    say(text) {
      clearTimeout(spoken);
      spoken = window.setTimeout(() => {
        element('live').textContent = text;
      }, 400);
    },
    fail(panel, cause, fix) {
      panel.root?.classList.add('failed');
      if (panel.note) panel.note.textContent = `${cause}. ${fix}`;
    },
    note(panel, text) {
      panel.root?.classList.remove('failed');
      if (panel.note && panel.note.textContent !== text) panel.note.textContent = text;
    },
  };

  /** @param {Iterable<string>} names @param {Panel | null} [but] */
  const owe = (names, but = null) => {
    for (const panel of app.panels) {
      if (panel === but) continue;
      const keys = owed.get(panel) ?? new Set();
      for (const name of names) if (panel.uses.includes(name)) keys.add(name);
      owed.set(panel, keys);
    }
  };
  const request = () => {
    frame ||= requestAnimationFrame(() => {
      frame = 0;
      draw();
    });
  };
  /** @param {State} state @param {boolean} settled */
  const change = (state, settled) => {
    const keys = /** @type {(keyof State)[]} */ (Object.keys(state));
    const changed = keys.filter((key) => state[key] !== app.state[key]);
    app.state = state;
    dragging = !settled;
    for (const key of changed) unsettled.add(key);
    owe(changed);
    if (settled) {
      owe(unsettled);
      unsettled = new Set();
      settling = true;
    }
    document.dispatchEvent(new CustomEvent('state', { detail: { changed, settled } }));
    request();
  };
  /** @param {boolean} push */
  const write = (push) => {
    const link = linkOf(app.state);
    if (link === (location.hash || linkOf(begin.state))) return;
    try {
      if (push) history.pushState(null, '', link);
      else history.replaceState(null, '', link);
    } catch {
      // Some frames allow no history of their own: the view changes all the same.
    }
  };
  // A frame that takes long leaves the rest to the next one, where that comes first.
  const draw = () => {
    const settled = settling, began = performance.now();
    settling = false;
    // During a drag what is scrolled away waits.
    const seen = app.panels.filter(({ root, away }) => root && !root.hidden && !(away && dragging));
    for (const panel of seen) {
      if (!owed.get(panel)?.size) continue;
      if (settled && performance.now() - began > SETTLED_MS) {
        settling = true;
        break;
      }
      app.bring(panel, settled);
    }
    const limit = dragging ? began + DRAG_MS : performance.now() + SETTLED_MS;
    const slow = !dragging && performance.now() - began > 2 * SETTLED_MS; // pictures wait a frame
    const waiting = slow ? [] : seen.filter((panel) => dirty.has(panel));
    const first = waiting.filter((panel) => late.has(panel));
    let painted = 0;
    for (const panel of new Set([...first, ...waiting])) {
      // The first picture, for which code is compiled, has a frame of its own.
      const fresh = panel.draw && !panel.pen && !dragging;
      if (fresh ? performance.now() - began > FRESH_MS : painted && performance.now() > limit) {
        late.add(panel);
        continue;
      }
      painted += 1;
      dirty.delete(panel);
      late.delete(panel);
      if (panel.draw && panel.canvas) guarded(app, panel, () => paint(panel));
    }
    if (seen.some((panel) => dirty.has(panel) || owed.get(panel)?.size)) request();
    if (settled && !settling) document.dispatchEvent(new CustomEvent('settled'));
  };
  addEventListener('popstate', () => {
    const found = stateOfLink(location.hash) ?? begin;
    tell(found.ignored);
    change(found.state, true);
  });
  /** @param {string[]} ignored */
  const tell = (ignored) => {
    const notice = element('notice');
    const names = ignored.map((name) => name.slice(0, 40)).slice(0, 8).join(', ');
    notice.hidden = ignored.length === 0;
    notice.textContent = names && `Ignored, since this page does not know or allow it: ${names}.`;
  };
  tell(begin.ignored);
  unsettled = new Set(Object.keys(app.state));
  return app;
}

/** @param {Record<string, string>} first */
function patchedFirst(first) {
  const { state, refused } = patched(defaultState(), first);
  return { state, ignored: refused };
}

/**
 * Return an element of the page by its name.
 * @param {string} id
 * @returns {HTMLElement}
 */
export function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found;
}

/**
 * Do something for a panel; an error stays in it.
 * @param {App} app
 * @param {Panel} panel
 * @param {() => void} work
 */
function guarded(app, panel, work) {
  try {
    work();
  } catch (error) {
    console.error(error);
    app.fail(panel, `This could not be computed: ${error}`, 'Move the point, or reload the page');
  }
}

/** Draw a panel at the resolution of the screen. @param {Panel} panel */
function paint(panel) {
  const canvas = /** @type {HTMLCanvasElement} */ (panel.canvas);
  const { width, height } = panel.size?.width ? panel.size : (panel.size = sizeOf(canvas));
  if (!width || !height) return;
  const ratio = Math.min(3, devicePixelRatio || 1);
  const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== across || canvas.height !== down) {
    canvas.width = across;
    canvas.height = down;
  }
  const pen = panel.pen ??= /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  panel.draw?.(pen, { width, height });
}

/** Return the size of a canvas, which has the page laid out. @param {HTMLCanvasElement} canvas */
export function sizeOf({ clientWidth, clientHeight }) {
  return { width: clientWidth, height: clientHeight };
}
