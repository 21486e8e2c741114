// The bifurcation strip: what two sweeps along the row or the column of the point settle to.

/** @import { App, Panel } from '../shell/app.mjs' */
/** @import { Frame } from '../draw/frame.mjs' */
/** @import { Carry, SweepSteps } from '../physics/sweep.mjs' */
/** @import { StripRun, StripView, Sweep } from './stripline.mjs' */
import { ATTRACTOR_KINDS } from '../physics/attractor.mjs';
import { STRIP_VALUES, movedCase, steadyCurves, sweepValues } from '../physics/sweep.mjs';
import { numeral } from '../draw/scale.mjs';
import { make, say } from '../shell/layout.mjs';
import { caseOf, startText } from '../shell/state.mjs';
import { tableOf } from '../shell/tables.mjs';
import { pageUnits } from '../shell/units.mjs';
import { MOTION_NAMES, motionName } from '../words.mjs';
import { FOLLOWED_KEYS, followedOf } from './point/followed.mjs';
import { drawStrip } from './stripdrawing.mjs';
import { dotAngles, placeInSweep, sameStep, stripLine, stripUnits } from './stripline.mjs';

const STRIP_CURVE_VALUES = 161;
const STRIP_ORDERS = [1, 3];
const STEP_MILLISECONDS = 20; // a job's steps
const NEAR_DOT = 9; // [px]

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeStripPanel(app) {
  /** @type {StripRun | null} */
  let run = null;
  /** @type {StripView['closed']} */
  let closed = null;
  /** @type {Frame | null} */
  let onto = null;
  /** @type {number | null} */
  let hovered = null;
  let wanted = '', serial = 0, owing = false;
  /** @type {{ moved: boolean, x: number } | null} */
  let held = null;

  /** @type {Panel} */
  const panel = {
    name: 'strip',
    title: 'Bifurcation strip',
    uses: ['by', 'w0', 'w1', 'a0', 'a1', 'log', ...FOLLOWED_KEYS],
    update(state, { settled }) {
      for (const button of panel.bar?.querySelectorAll('button') ?? []) {
        const { by = '' } = button.dataset, words = state.units === 'si' ? { w: 'f', a: 'a' } : { w: 'Ω', a: 'A' };
        button.setAttribute('aria-pressed', String(by === state.by));
        say(button, `over ${words[/** @type {'w'} */ (by)]}`);
      }
      const line = stripLine(app, state);
      if (line.key !== wanted) {
        wanted = line.key;
        app.pool.drop('strip:');
        askCurves(line);
        owing = true;
        hovered = null;
      }
      if (settled && owing) {
        owing = false;
        if (run?.key !== line.key || run.sweeps.some(({ kinds }) => kinds.length < STRIP_VALUES)) {
          begin(line);
        }
      }
      followedOf(app, settled);
      tell();
    },
    draw(pen, size) {
      onto = drawStrip(pen, size, app.theme, view());
    },
    sentence,
    table,
    keys,
    placed,
  };
  return panel;

  /** @returns {StripView} */
  function view() {
    const { state } = app, { from, to, log } = stripLine(app, state);
    return {
      run, closed, state, hovered, by: state.by, window: { from, to, log },
      stale: run?.key !== wanted, units: stripUnits(app, state), present: presentPeaks(),
    };
  }

  /** The peaks of what the motion at the point settles to, one where they are alike. */
  function presentPeaks() {
    const { followed, error } = followedOf(app, false);
    const { highest = null, lowest = null } = error ? {} : followed?.attractor ?? {};
    if (highest === null || lowest === null) return [];
    return followed?.attractor.kind === 'unsymmetric' ? [highest, -lowest] : [highest];
  }

  /** @param {ReturnType<typeof stripLine>} line */
  function begin(line) {
    const values = sweepValues(app.kernels, line, STRIP_VALUES);
    const fresh = { kinds: [], periods: [], peaks: [], states: [], reasons: [] };
    /** @type {(way: 'up' | 'down', from: string, kind: 'rest' | 'steady') => Sweep} */
    const sweep = (way, from, kind) => structuredClone({ ...fresh, way, from, start: { kind } });
    run = {
      ...line, values,
      sweeps: [sweep('up', 'rest', 'rest'), sweep('down', 'the steady state', 'steady')],
    };
    serial += 1;
    for (const each of run.sweeps) follow(run, each, { begin: each.start, carried: null }, serial);
  }

  /** @param {StripRun} of @param {Sweep} sweep @param {Carry} carry @param {number} own */
  async function follow(of, sweep, carry, own) {
    const done = sweep.kinds.length;
    const left = sweep.way === 'up' ? of.values.slice(done)
      : of.values.slice(0, STRIP_VALUES - done).reverse();
    if (!left.length) return;
    const { given, by } = of;
    const asked = { given, by, values: left, carry, milliseconds: STEP_MILLISECONDS };
    try {
      /** @type {SweepSteps | undefined} */
      const steps = await app.pool.ask('sweepSteps', asked,
        { key: `strip:${sweep.way}`, priority: 4 });
      if (!steps || own !== serial) return;
      sweep.kinds.push(...Array.from(steps.kinds, (code) => ATTRACTOR_KINDS[code]));
      sweep.periods.push(...steps.periods);
      sweep.peaks.push(...steps.peaks);
      sweep.states.push(...steps.states);
      sweep.reasons.push(...steps.reasons);
      tell();
      app.redraw(panel);
      follow(of, sweep, steps.carry, own);
    } catch (error) {
      if (own !== serial) return;
      const cause = `The ${sweep.way}ward sweep stopped: ${error}`;
      app.fail(panel, cause, 'Move the point to try again');
    }
  }

  /** @param {ReturnType<typeof stripLine>} line */
  async function askCurves(line) {
    if (line.given.nonlinear) {
      closed = null; // closed forms are the linear model's
      return;
    }
    const values = sweepValues(app.kernels, line, STRIP_CURVE_VALUES);
    const asked = { given: line.given, by: line.by, values, orders: STRIP_ORDERS };
    const curves = await app.pool.ask('steadyCurves', asked, { key: 'strip:curves', priority: 0 });
    if (!curves || line.key !== wanted) return;
    closed = { key: line.key, values, curves };
    tell();
    app.redraw(panel);
  }

  function tell() {
    app.note(panel, hovered === null ? progressText() || differenceText() : hoveredText(hovered));
  }

  function progressText() {
    if (run?.key !== wanted) return 'Sweeps of another line, dimmed: they follow when you let go.';
    const parts = (run?.sweeps ?? []).filter(({ kinds }) => kinds.length < STRIP_VALUES)
      .map(({ way, kinds }) => `${way}ward ${Math.floor((100 * kinds.length) / STRIP_VALUES)} %`);
    return parts.length ? `Sweeping: ${parts.join(', ')}` : '';
  }

  /** Where both sweeps know a value and differ: two motions attract there. */
  function differingPlaces() {
    const [up, down] = run?.sweeps ?? [];
    const places = [];
    for (let place = 0; up && place < STRIP_VALUES; place += 1) {
      const back = STRIP_VALUES - 1 - place;
      const lasting = [up.kinds[place], down.kinds[back]].every((kind) =>
        kind && kind !== 'overturned' && kind !== 'undecided');
      if (lasting && !sameStep(up, place, down, back)) places.push(place);
    }
    return places;
  }

  /** Where motions alike every third shake are stable, which sweeps need not meet. */
  function thirdText() {
    const third = closed?.curves.find(({ order, branch }) => order === 3 && branch === 1);
    if (!closed || !third || closed.key !== wanted) return '';
    const { x, unit, symbol } = stripUnits(app, app.state);
    const there = Array.from(closed.values).filter((_, place) => third.stable[place]);
    if (!there.length) return '';
    const [first, last] = [there[0], there[there.length - 1]].map((value) => numeral(value * x, 3));
    const where = first === last ? `at ${symbol} = ${first}`
      : `for ${symbol} from ${first} to ${last}`;
    return ` From some starts it ${motionName({ kind: 'symmetric', period: 3 })}, ${where}${unit && ` ${unit}`}: click that line.`;
  }

  function differenceText() {
    const places = differingPlaces();
    if (!run || !places.length) {
      return `Both sweeps meet the same motions wherever neither falls.${thirdText()}`;
    }
    const [first, last] = [places[0], places[places.length - 1]].map((place) => valueText(place));
    const where = first === last ? `at ${first}` : `between ${first} and ${last}`;
    return `How it begins decides at ${places.length} of ${STRIP_VALUES} values ${where}: `
      + `the sweeps differ there.${thirdText()}`;
  }

  /** @param {number} place */
  function valueText(place) {
    const { x, unit, symbol } = stripUnits(app, app.state);
    return `${symbol} = ${numeral((run?.values[place] ?? NaN) * x, 4)}${unit && ` ${unit}`}`;
  }

  /** @param {number} place */
  function hoveredText(place) {
    if (!run) return '';
    const steps = run.sweeps.map((sweep) =>
      `${sweep.way}: ${stepText(sweep, placeInSweep(sweep, place))}`);
    return `${valueText(place)}; ${steps.join('; ')}`;
  }

  /** @param {Sweep} sweep @param {number} step */
  function stepText({ kinds, periods, peaks, reasons }, step) {
    const kind = kinds[step];
    if (!kind) return 'not computed';
    if (kind === 'rest') return app.theme.words.rest;
    if (kind === 'undecided') return `undecided, ${reasons[step]}`;
    if (kind === 'overturned') return app.theme.words[kind];
    const { y, angleUnit } = stripUnits(app, app.state);
    const high = numeral(peaks[step].reduce((most, u) => Math.max(most, Math.abs(u)), 0) * y, 3);
    const peak = `peak ${high}${angleUnit}`;
    return `${motionName({ kind, period: periods[step] })}, ${peak}`;
  }

  function sentence() {
    const { state } = app, { symbol, x, unit, fixed } = stripUnits(app, state);
    const { from, to } = stripLine(app, state);
    const ends = `${symbol} from ${numeral(from * x)} to ${numeral(to * x)}${unit && ` ${unit}`}`;
    const met = (run?.sweeps ?? []).map((sweep) => {
      /** @type {Map<string, number>} */
      const counts = new Map();
      for (const kind of sweep.kinds) counts.set(kind, (counts.get(kind) ?? 0) + 1);
      const list = [...counts].map(([kind, count]) => `${MOTION_NAMES[kind]} at ${count}`).join('; ');
      return `${sweep.way}ward from ${sweep.from}: ${list || 'not computed'}`;
    });
    return `Peaks of the flights over ${ends} at ${fixed}. Of ${STRIP_VALUES} values, `
      + `${met.join('; ')}. ${progressText() || differenceText()}`;
  }

  function table() {
    const { amplitude, frequency, angle } = pageUnits(app);
    const rows = (run?.sweeps ?? []).flatMap((sweep) => sweep.kinds.map((kind, step) => {
      const peaks = kind === 'rest' ? [0] : Array.from(sweep.peaks[step]);
      const value = /** @type {StripRun} */ (run).values[placeInSweep(sweep, step)];
      const extremes = peaks.length ? [Math.max(...peaks), Math.min(...peaks)] : ['', ''];
      return [value, sweep.way, kind, sweep.periods[step] || '', ...extremes];
    }));
    const column = (/** @type {number} */ k) => rows.map((row) => row[k]);
    return tableOf([app.state.by === 'w' ? frequency : amplitude, column(0)], ['sweep', column(1)], ['kind', column(2)],
      ['period [forcing periods]', column(3)], [angle, column(4), 'highest '], [angle, column(5), 'lowest ']);
  }

  function placed() {
    const { bar, canvas } = panel;
    for (const [by, text, title] of [
      ['w', 'over Ω', 'Sweep the frequency along the row of the point'],
      ['a', 'over A', 'Sweep the amplitude along the column of the point'],
    ]) {
      const button = make('button', { type: 'button', 'data-by': by, title }, text);
      button.addEventListener('click', () => app.set({ by }));
      bar?.append(button);
    }
    canvas?.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || !onto) return;
      canvas.setPointerCapture(event.pointerId);
      held = { moved: false, x: event.offsetX };
      hovered = null;
    });
    canvas?.addEventListener('pointermove', (event) => {
      if (held) {
        held.moved ||= Math.abs(event.offsetX - held.x) > 3;
        if (held.moved) moveTo(event.offsetX, false);
      } else if (event.pointerType === 'mouse') hover(event.offsetX);
    });
    canvas?.addEventListener('pointerup', (event) => {
      if (!held) return;
      const { moved } = held;
      held = null;
      if (moved || !takeDot(event.offsetX, event.offsetY)) moveTo(event.offsetX, true);
    });
    canvas?.addEventListener('pointercancel', () => {
      if (held?.moved) app.set({});
      held = null;
    });
    canvas?.addEventListener('pointerleave', () => {
      if (hovered === null) return;
      hovered = null;
      tell();
      app.redraw(panel);
    });
  }

  /** @param {number} pixel */
  function valueAt(pixel) {
    const { from, to } = stripLine(app, app.state), { x } = stripUnits(app, app.state);
    const frame = /** @type {Frame} */ (onto);
    const [value, next] = [frame.x.value(pixel) / x, frame.x.value(pixel + 1) / x];
    const digits = Math.min(12, Math.max(0, Math.round(-Math.log10(next - value))));
    return Number(Math.min(to, Math.max(from, value)).toFixed(digits));
  }

  /** @param {number} pixel @param {boolean} settled */
  function moveTo(pixel, settled) {
    if (onto) app.set({ [app.state.by === 'w' ? 'W' : 'A']: valueAt(pixel) }, { settled });
  }

  /** @param {number} pixel */
  function hover(pixel) {
    if (!onto || !run || run.key !== wanted) return;
    const { x } = stripUnits(app, app.state), { values } = run, at = onto.x.at;
    const inside = pixel >= onto.box.left && pixel <= onto.box.left + onto.box.width;
    let best = 0;
    for (let k = 1; k < values.length; k += 1) {
      if (Math.abs(at(values[k] * x) - pixel) < Math.abs(at(values[best] * x) - pixel)) best = k;
    }
    hovered = inside ? best : null;
    tell();
    app.redraw(panel);
  }

  /**
   * Go to the motion of a dot, where one is near: to its value, and to a state on it.
   * @param {number} across
   * @param {number} down
   */
  function takeDot(across, down) {
    if (!onto || !run || run.key !== wanted) return false;
    const { x, y } = stripUnits(app, app.state);
    let near = NEAR_DOT, found = null;
    for (const sweep of run.sweeps) {
      for (let step = 0; step < sweep.kinds.length; step += 1) {
        const left = onto.x.at(run.values[placeInSweep(sweep, step)] * x);
        if (Math.abs(left - across) > near) continue;
        for (const u of dotAngles(sweep, step)) {
          const far = Math.hypot(left - across, onto.y.at(Math.abs(u) * y) - down);
          if (far < near) [near, found] = [far, { sweep, step }];
        }
      }
    }
    if (found) go(found.sweep, found.step);
    return found !== null || takeCurve(across, down);
  }

  /**
   * Go to the stable motion in closed form whose curve is near.
   * @param {number} across
   * @param {number} down
   */
  function takeCurve(across, down) {
    if (!onto || closed?.key !== wanted) return false;
    const { state } = app, { y } = stripUnits(app, state), value = valueAt(across);
    const given = movedCase(caseOf(app.kernels, state), state.by, value);
    const found = steadyCurves(app.kernels,
      { given, by: state.by, values: [value], orders: STRIP_ORDERS });
    for (const { peaks, stable, phases, speeds } of found) {
      if (!stable[0] || Math.abs(onto.y.at(peaks[0] * y) - down) > NEAR_DOT) continue;
      const start = startText({ kind: 'impact', side: 1, phase: phases[0], speed: speeds[0] });
      app.set({ [state.by === 'w' ? 'W' : 'A']: value, start });
      return true;
    }
    return false;
  }

  /** @param {Sweep} sweep @param {number} step */
  function go(sweep, step) {
    const value = /** @type {StripRun} */ (run).values[placeInSweep(sweep, step)];
    const state = sweep.states[step];
    const start = startText(state ? { kind: 'impact', ...state } : { kind: 'rest' });
    app.set({ [app.state.by === 'w' ? 'W' : 'A']: value, start });
    app.say(`${stepText(sweep, step)}, from the ${sweep.way}ward sweep`);
  }

  /** @param {KeyboardEvent} event */
  function keys({ key, shiftKey }) {
    const { from, to, log } = stripLine(app, app.state), name = app.state.by === 'w' ? 'W' : 'A';
    const way = { ArrowLeft: -1, ArrowRight: 1 }[key];
    if (way) {
      const step = (way * (shiftKey ? 10 : 1)) / (STRIP_VALUES - 1), here = app.state[name];
      const next = log ? here * (to / from) ** step : here + (to - from) * step;
      app.set({ [name]: Number(Math.min(to, Math.max(from, next)).toPrecision(6)) });
      return true;
    }
    if (key !== 'Enter' || !run || run.key !== wanted) return false;
    const { values } = run, here = app.state[name];
    const place = values.reduce((best, value, k) =>
      (Math.abs(value - here) < Math.abs(values[best] - here) ? k : best), 0);
    const options = run.sweeps.filter((sweep) => sweep.kinds[placeInSweep(sweep, place)]
      && dotAngles(sweep, placeInSweep(sweep, place)).length);
    const present = options.findIndex((sweep) => {
      const state = sweep.states[placeInSweep(sweep, place)];
      return startText(state ? { kind: 'impact', ...state } : { kind: 'rest' }) === app.state.start;
    });
    const next = options[(present + 1) % options.length];
    if (next) go(next, placeInSweep(next, place));
    return true;
  }
}
