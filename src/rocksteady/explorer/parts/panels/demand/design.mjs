// The Design tab's plane: which sizes of blocks stand one demand, and how far they rock.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { Demand } from '../../physics/demand/design.mjs' */
/** @import { Look, MotionClass } from '../../draw/classes.mjs' */
/** @import { PlaneAxis } from '../plane/axis.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
import { classLook, lookTiles } from '../../draw/classes.mjs';
import { curve } from '../../draw/marks.mjs';
import { numeral } from '../../draw/scale.mjs';
import { PULSES } from '../../kernels/pulses.mjs';
import { evaluate, rectangleOf } from '../../physics/case.mjs';
import { DESIGN_FATE } from '../../physics/demand/design.mjs';
import { equationsOf } from '../../shell/state.mjs';
import { NEVER_LIFTS } from '../../words.mjs';
import { buttonEntry, choiceEntry, numberEntry } from '../entries.mjs';
import { axisOf, partOn, valueOn } from '../plane/axis.mjs';
import { makePlane } from '../plane/plane.mjs';
import { drawFates } from './key.mjs';

const SIZE_KEYS = /** @type {const} */ ({ x: ['db0', 'db1'], y: ['dh0', 'dh1'] });
const ALPHA_KEYS = /** @type {const} */ ({ x: ['ds0', 'ds1'], y: ['dr0', 'dr1'] });
const DESIGN_GRID = { columns: 384, rows: 288 };
const DESIGN_LOOK = { rests: 0, safe: 1, beyond: 2, overturns: 3, undecided: 4, impossible: 5,
  peaks: 6 };
const DESIGN_WORDS = ['does not lift', 'safe', 'stands', 'falls', 'undecided',
  'so stocky that it does not rock'];
const TABLE_STEP = 24; // cells from one row of the table to the next
const PEAK_LEVELS = 5; // flat steps of the ramp
const DEMAND_KEYS = ['demand', 'dg', 'df', 'dn', 'pulse', 'record', 'scale', 'model', 'r', 'rh',
  'motions'];

/**
 * Return what shakes the base in the Design tab.
 * @param {App} app
 * @param {State} state
 * @returns {Demand}
 */
export function demandOf(app, state) {
  const { dg: level, df: hertz, dn: cycles } = state;
  const { record = 0, scale = 1 } = /** @type {any} */ (state), put = app.motions[record];
  if (state.demand === 'record' && put) {
    return { kind: 'record', dt: put.dt, acceleration: put.acceleration, scale };
  }
  if (state.demand === 'harmonic') return { kind: 'harmonic', level, hertz, cycles };
  return { kind: 'pulse', shape: state.pulse, level, hertz };
}

/**
 * Return what is computed of each block.
 * @param {App} app
 * @param {State} state
 */
export function designOf(app, state) {
  return {
    demand: demandOf(app, state), restitution: state.rh === 1 ? null : state.r,
    nonlinear: equationsOf(state) === 'nonlinear',
  };
}

/**
 * Return the demand in words.
 * @param {App} app
 * @param {State} state
 */
export function demandWords(app, state) {
  const demand = demandOf(app, state);
  if (demand.kind === 'record') {
    const name = app.motions[/** @type {any} */ (state).record ?? 0]?.name ?? 'the record';
    return `${name} times ${numeral(demand.scale, 3)}`;
  }
  const level = `${numeral(demand.level, 3)} g at ${numeral(demand.hertz, 3)} Hz`;
  if (demand.kind === 'harmonic') return `${numeral(demand.cycles, 4)} cycles of ${level}`;
  return `a ${demand.shape} pulse of ${level}`;
}

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeDesignPanel(app) {
  /** @type {ReturnType<typeof makeDesignEntries> | undefined} */
  let entries;
  const found = () => /** @type {{ fates: Uint8Array, peaks: Float64Array }} */ (
    /** @type {unknown} */ (plane.cells()));
  const plane = makePlane(app, () => panel, {
    name: 'design',
    grid: DESIGN_GRID,
    whole: 4,
    empty: (count) => ({ fates: new Uint8Array(count), peaks: new Float64Array(count) }),
    tiles: (theme, ratio) => lookTiles(designLooks(theme), ratio),
    look: (k) => lookOf(k),
    undecided: (k) => found().fates[k] === DESIGN_FATE.undecided,
    axes: (state) => (state.plane === 'alpha' ? {
      x: axisOf(state, ALPHA_KEYS.x, { factor: 180 / Math.PI, label: 'slenderness α [°]' }),
      y: axisOf(state, ALPHA_KEYS.y, { label: 'half-diagonal R [m]' }),
    } : {
      x: axisOf(state, SIZE_KEYS.x, { label: 'width [m]' }),
      y: axisOf(state, SIZE_KEYS.y, { label: 'height [m]' }),
    }),
    point(state) {
      if (state.plane !== 'alpha') return { x: state.b, y: state.h };
      const { alpha, radius } = rectangleOf(app.kernels, { width: state.b, height: state.h });
      return { x: alpha, y: radius };
    },
    moved({ x, y }) {
      if (app.state.plane !== 'alpha') return { b: x, h: y };
      const sine = evaluate(app.kernels, 'sin', x), cosine = evaluate(app.kernels, 'cos', x);
      return { b: Number((2 * y * sine).toPrecision(6)), h: Number((2 * y * cosine).toPrecision(6)) };
    },
    work(state) {
      const args = designOf(app, state), { demand, nonlinear, restitution } = args;
      const { kind } = demand, slender = state.plane === 'alpha';
      const long = kind === 'record' ? demand.acceleration.length
        : kind === 'pulse' && /ricker|mavro/.test(demand.shape) ? 4000 : 0;
      const shaking = kind === 'record' ? [state.record, app.motions.length, demand.scale]
        : Object.values(demand);
      return {
        job: 'designCells', cost: `${kind} ${long} ${nonlinear}`,
        ms: (nonlinear ? 0.3 : 0.06) + long * (nonlinear ? 5e-4 : 2.5e-4),
        motion: [kind, ...shaking, nonlinear, restitution, slender].join(' '),
        args: (xs, ys) => ({ ...args, sizes: Array.from(xs, (x, k) =>
          (slender ? { alpha: x, radius: ys[k] } : { width: x, height: ys[k] })) }),
      };
    },
    words({ x, y }, cell) {
      const { peaks } = found(), { unit } = plane.handle.axes().x;
      const place = app.state.plane === 'alpha' ? `α = ${numeral(x * unit, 3)}°, R = ${numeral(y, 3)} m`
        : `${numeral(x, 3)} m wide, ${numeral(y, 3)} m high`;
      const look = cell ? lookOf(cell.at) : -1, peak = cell ? peaks[cell.at] : 0;
      const stands = peak > 0 ? `${cell && isSafe(cell.at) ? 'safe' : 'stands'}, peak ${numeral(peak, 3)} α` : '';
      return [place, stands || (DESIGN_WORDS[look] ?? 'not computed yet')];
    },
    tell: () => tell(),
  });

  /** Return the look of a computed cell. @param {number} k */
  const lookOf = (k) => {
    const { fates: { [k]: fate }, peaks: { [k]: peak } } = found(), { limit, dpeak } = app.state;
    if (fate !== DESIGN_FATE.stands) {
      return fate === DESIGN_FATE.overturns ? DESIGN_LOOK.overturns
        : fate === DESIGN_FATE.undecided ? DESIGN_LOOK.undecided : DESIGN_LOOK.impossible;
    }
    if (dpeak) return DESIGN_LOOK.peaks + Math.min(PEAK_LEVELS - 1, Math.floor(peak * PEAK_LEVELS));
    if (peak === 0) return DESIGN_LOOK.rests;
    return peak <= limit ? DESIGN_LOOK.safe : DESIGN_LOOK.beyond;
  };

  const key = () => {
    const looks = designLooks(app.theme), { limit, dpeak } = app.state;
    const overturns = { words: app.theme.words.overturned, look: looks[DESIGN_LOOK.overturns] };
    if (dpeak) {
      const steps = Array.from({ length: PEAK_LEVELS }, (_, k) => ({
        words: k ? `to ${numeral((k + 1) / PEAK_LEVELS, 2)} α` : `peak to ${numeral(1 / PEAK_LEVELS, 2)} α`,
        look: looks[DESIGN_LOOK.peaks + k],
      }));
      return [...steps, overturns];
    }
    return [
      { words: NEVER_LIFTS, look: looks[DESIGN_LOOK.rests] },
      { words: `safe: peak ≤ ${numeral(100 * limit, 3)} % of α`, look: looks[DESIGN_LOOK.safe] },
      { words: 'stands, peak beyond', look: looks[DESIGN_LOOK.beyond] }, overturns,
      ...(app.state.rh === 1 ? [{ words: 'too stocky to rock', look: looks[DESIGN_LOOK.impossible] }] : []),
    ];
  };

  /** @type {Panel} */
  const panel = {
    name: 'design',
    title: 'Blocks against one demand',
    uses: [...DEMAND_KEYS, 'b', 'h', 'limit', 'plane', 'dpeak', ...SIZE_KEYS.x, ...SIZE_KEYS.y,
      ...ALPHA_KEYS.x, ...ALPHA_KEYS.y],
    placed() {
      entries = makeDesignEntries(app, plane);
      panel.bar?.append(...entries.all);
      plane.listen();
    },
    update(state, { settled }) {
      entries?.refresh(state);
      plane.update(state, settled);
      tell();
    },
    draw(pen, size) {
      const { limit, dpeak } = app.state;
      drawFates(pen, size, app, plane, { key: key(), colours: `${limit} ${dpeak}`,
        over: (onto) => drawShapes(pen, onto) });
    },
    sentence() {
      const { state } = app, words = `Blocks under ${demandWords(app, state)}, ${equationsOf(state)} model`;
      return `${words}. ${leastWords()}`;
    },
    table() {
      const seen = plane.task(), rows = [];
      if (!seen) return { columns: [], rows: [] };
      const { axes: { x, y }, columns } = seen, looks = looksSeen();
      for (let at = 0; at < looks.length; at += TABLE_STEP) {
        const row = Math.floor(at / columns), look = looks[at];
        if (row % TABLE_STEP) continue;
        rows.push([along(x, (at % columns + 0.5) / columns), along(y, (row + 0.5) / seen.rows),
          look >= DESIGN_LOOK.peaks ? 'stands' : DESIGN_WORDS[look] ?? 'not computed']);
      }
      return { columns: [x.label, y.label, 'fate'], rows };
    },
    keys: (event) => plane.keys(event),
  };

  /** @param {PlaneAxis} axis @param {number} part */
  const along = (axis, part) => valueOn(axis, part) * axis.unit;

  /** Return whether a cell is one of the safe set; one that is not computed is none. @param {number} at */
  const isSafe = (at) => at >= 0 && found().fates[at] === DESIGN_FATE.stands
    && found().peaks[at] <= app.state.limit;

  /** Return the looks of all cells; -1 where no cell is computed. */
  const looksSeen = () => plane.nearestCells().map((at) => (at < 0 ? -1 : lookOf(at)));

  /** Return the part of the plane that is safe. */
  /** Return from which width on all blocks of this height are safe, to the width of a cell. */
  const leastWords = () => {
    const seen = plane.task(), { state } = app;
    if (!seen || !plane.progress().level || state.plane === 'alpha') return '';
    const { axes, columns, rows } = seen, row = Math.floor(partOn(axes.y, state.h) * rows);
    if (row < 0 || row >= rows) return '';
    const near = plane.nearestCells().subarray(row * columns, (row + 1) * columns);
    let first = columns;
    while (first > 0 && isSafe(near[first - 1])) first -= 1;
    const high = `${numeral(state.h, 3)} m high`, end = numeral(axes.x.to, 3);
    if (first === columns) return `The widest, ${end} m, is not safe ${high}.`;
    if (first === 0) return `All widths that were run, from ${numeral(axes.x.from, 3)} m, are safe ${high}.`;
    const step = (axes.x.to - axes.x.from) / columns, width = axes.x.from + first * step;
    return `${high[0].toUpperCase()}${high.slice(1)}, all widths that were run from ${width.toFixed(2)} to ${end} m are safe.`;
  };

  /** Write how far the picture is. */
  const tell = () => {
    const far = plane.words();
    if (far === null) return;
    const words = plane.progress().complete ? leastWords() || 'Drag the point.' : '';
    app.note(panel, `${demandWords(app, app.state)}: ${[words, far].filter(Boolean).join(' ')}`);
  };

  /**
   * Draw lines of blocks of one shape.
   * @param {any} pen
   * @param {Frame} onto
   */
  const drawShapes = (pen, onto) => {
    if (app.state.plane === 'alpha') return;
    const { theme } = app, { x, y, box } = onto;
    for (const ratio of [2, 3, 4, 6, 10]) {
      const widths = [x.from, x.to];
      const heights = widths.map((width) => ratio * width);
      curve(pen, onto, widths, heights, { colour: theme.quiet, width: 1, dash: [1, 4] });
      const top = Math.min(y.to, ratio * x.to), at = x.at(top / ratio);
      if (at < box.left + 20 || top < y.from) continue;
      const words = `h = ${ratio} b`;
      pen.save();
      pen.font = theme.small;
      pen.textAlign = 'center';
      pen.textBaseline = 'middle';
      const wide = pen.measureText(words).width + 8;
      const [left, middle] = [Math.min(at, box.left + box.width) - wide - 2, y.at(top) + (top < y.to ? 0 : 11)];
      pen.fillStyle = theme.paper;
      pen.fillRect(left, middle - 8, wide, 16);
      pen.fillStyle = theme.quiet;
      pen.fillText(words, left + wide / 2, middle);
      pen.restore();
    }
  };
  return panel;
}

/**
 * Return what cells look like, by their numbers.
 * @param {Theme} theme
 * @returns {Look[]}
 */
function designLooks(theme) {
  const { rocksRamp } = theme, look = (/** @type {MotionClass} */ name) => classLook(theme, name);
  return [look('rest'), { fill: rocksRamp[1] }, { fill: rocksRamp[3] }, look('overturned'),
    look('undecided'), look('no-start'), ...rocksRamp.map((fill) => ({ fill }))];
}

/**
 * @param {App} app
 * @param {ReturnType<typeof makePlane>} plane
 */
function makeDesignEntries(app, plane) {
  const kind = choiceEntry(app, 'demand', 'demand', [['pulse', 'one pulse'], ['harmonic', 'harmonic shaking'], ['record', 'motion put in']]);
  const shape = choiceEntry(app, 'pulse', 'shape', Object.keys(PULSES).map((name) => [name, name.replace(/-/g, ' ')]));
  shape.input.id = 'in-design-pulse';
  /** @param {'dg' | 'df' | 'dn'} name @param {string} label @param {number} step */
  const number = (name, label, step) => numberEntry(app, {
    name, label, step, read: () => app.state[name], write: (value) => ({ [name]: value }),
  });
  const level = number('dg', 'a [g]', 0.05), rate = number('df', 'f [Hz]', 0.1);
  const cycles = number('dn', 'cycles', 1);
  const limit = numberEntry(app, {
    name: 'limit', label: 'safe: peak ≤ [% of α]', step: 5, read: () => 100 * app.state.limit,
    write: (value) => ({ limit: value / 100 }),
  });
  const axes = choiceEntry(app, 'plane', 'axes', [['size', 'width, height'], ['alpha', 'slenderness, R']]);
  const peaks = buttonEntry('peaks', 'colour by the largest tilt', () => app.set({ dpeak: 1 - app.state.dpeak }));
  const numbers = [level, rate, cycles, limit];
  const all = [
    kind.root, shape.root, level.root, rate.root, cycles.root, limit.root, axes.root, peaks,
    ...plane.buttons(),
  ];
  return {
    all,
    /** @param {State} state */
    refresh(state) {
      for (const entry of [kind, shape, axes, ...numbers]) entry.refresh();
      kind.input.options[2].disabled = app.motions.length === 0;
      const shaking = demandOf(app, state).kind; // a pulse where no motion is put in
      kind.input.value = shaking;
      shape.root.hidden = shaking !== 'pulse';
      cycles.root.hidden = shaking !== 'harmonic';
      for (const entry of [level, rate]) entry.root.hidden = shaking === 'record';
      peaks.setAttribute('aria-pressed', String(state.dpeak === 1));
    },
  };
}
