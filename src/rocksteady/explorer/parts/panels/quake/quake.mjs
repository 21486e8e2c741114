// A block on a recorded ground motion: the motion, the rotation, and files that are opened.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { RecordRun } from '../../physics/quake/record.mjs' */
/** @import { NamedMotion, Shaken } from './shaken.mjs' */
import { GRAVITY, evaluate } from '../../physics/case.mjs';
import { scaledMotion } from '../../physics/motions.mjs';
import { runRecord } from '../../physics/quake/record.mjs';
import { frame, hasFarRoom } from '../../draw/frame.mjs';
import { curve, drawMark, note, rule } from '../../draw/marks.mjs';
import { make } from '../../shell/layout.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { pageUnits } from '../../shell/units.mjs';
import { MOTION_NAMES } from '../../words.mjs';
import { makeFileOpener } from './files.mjs';
import { few, motionChoices, shakenBy } from './shaken.mjs';

const CURVE_POINTS = 1200;
const MOST_HERE = 20_000; // samples of a motion whose response is computed on the page's own thread
const MOST_DRAWN = 2400; // samples of a motion that are drawn one by one
const MOST_IMPACT_MARKS = 400;
const SECONDS_AFTER = 12; // shown at most after the end of the motion
const CURSOR_STEP = 0.01; // of the time shown

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeQuakePanel(app) {
  /** @type {RecordRun | null} */
  let run = null;
  /** @type {{ motion: NamedMotion, times: Float64Array, values: Float64Array } | null} */
  let drawn = null;
  /** @type {{ ground: Frame, tilt: Frame, split: number } | null} */
  let onto = null;
  /** @type {number | null} */
  let cursor = null; // [s]
  let asked = '';
  /** @type {{ refresh: () => void, show: (run: RecordRun | null, words: string) => void } | null} */
  let bar = null;

  /** @type {Panel} */
  const panel = {
    name: 'quake',
    title: 'Block on a recorded ground motion',
    uses: ['record', 'scale', 'b', 'h', 'r', 'rh', 'model', 'units', 'motions', 'run'],
    update(state) {
      bar?.refresh();
      const shaken = shakenBy(app, state), { motion, block, scale, refused } = shaken;
      const key = [state.record, app.motions.length, scale, block.alpha, block.p, block.restitution,
        block.nonlinear].join();
      if (refused) {
        app.shared.recordRun = run = null;
        asked = '';
        bar?.show(null, '');
        app.fail(panel, `${motion.name}: ${refused}`, 'Choose another motion');
      } else if (key !== asked) {
        asked = key;
        if (motion.samples.length <= MOST_HERE) {
          came(runRecord(app.kernels, scaledMotion(motion, scale), block, CURVE_POINTS));
        } else {
          const args = { motion: { samples: motion.samples, dt: motion.dt }, block, scale };
          const how = { key: 'quake:run', priority: 0 };
          app.pool.ask('recordRun', { ...args, points: CURVE_POINTS }, how).then((found) => {
            if (!found || key !== asked) return;
            came(found);
            app.redraw(panel);
            app.touch('run');
          }, (error) => app.fail(panel, `The response stopped: ${error.message}`, 'Choose another motion'));
        }
      }
      if (!refused) tell();
    },
    draw,
    sentence,
    table,
    keys(event) {
      const step = { ArrowLeft: -CURSOR_STEP, ArrowRight: CURSOR_STEP }[event.key];
      if (!step) return false;
      const end = lastSecond();
      const from = cursor ?? 0, far = (event.shiftKey ? 10 * step : step) * end;
      pointTo(Math.min(end, Math.max(0, from + far)));
      return true;
    },
    placed() {
      bar = makeBar(app, panel);
      panel.canvas?.addEventListener('pointermove', ({ offsetX }) => {
        if (!onto) return;
        const { box, x } = onto.ground;
        pointTo(offsetX < box.left || offsetX > box.left + box.width ? null : x.value(offsetX));
      });
      panel.canvas?.addEventListener('pointerleave', () => pointTo(null));
    },
  };
  return panel;

  /** @param {RecordRun} found */
  function came(found) {
    run = found;
    app.shared.recordRun = found;
    const stands = found.status === 'rocking' || found.status === 'at-rest';
    bar?.show(found, stands ? `stands, peak ${few(found.peak * shakenBy(app, app.state).degrees)}°`
      : app.theme.words[found.status === 'overturned' ? 'overturned' : 'undecided']);
  }

  /** @param {number | null} seconds */
  function pointTo(seconds) {
    if (seconds === cursor) return;
    cursor = seconds;
    tell();
    app.redraw(panel);
  }

  function tell() {
    app.note(panel, cursor === null ? sentence() : cursorText(cursor));
  }

  function lastSecond() {
    const { motion, block } = shakenBy(app, app.state);
    const lasts = (motion.samples.length - 1) * motion.dt;
    const ends = run && run.pt.length ? run.pt[run.pt.length - 1] / block.p : 0;
    return Math.max(lasts, Math.min(ends, lasts + SECONDS_AFTER));
  }

  function sentence() {
    const { motion, block, scale, pga, degrees, refused } = shakenBy(app, app.state);
    if (refused) return `${motion.name}: ${refused}.`;
    const lasts = few((motion.samples.length - 1) * motion.dt);
    const what = `${motion.name} × ${few(scale)}: PGA ${few(pga)} g, ${lasts} s`;
    if (!run) return `${what}; computing.`;
    const { impactCount, peak, overturned, rested, status } = run;
    const met = `${impactCount} ${impactCount === 1 ? 'impact' : 'impacts'}`;
    const seconds = (/** @type {number} */ pt) => `${few(pt / block.p)} s`;
    if (overturned !== null) return `${what}. The block falls at ${seconds(overturned)} after ${met}.`;
    if (peak === 0) return `${what}. The block never lifts: that takes ${few(upliftOf(block))} g.`;
    const end = rested !== null ? `, ${MOTION_NAMES.rest} at ${seconds(rested)}`
      : status === 'undecided' ? ', undecided: too many flights' : '';
    return `${what}. The block stands: peak ${few(peak * degrees)}° = ${few(100 * peak)} % of α, ${met}${end}.`;
  }

  /** Return the base acceleration that lifts the block [g]. @param {Shaken['block']} block */
  function upliftOf({ alpha, nonlinear }) {
    return nonlinear ? evaluate(app.kernels, 'tan', alpha) : alpha;
  }

  /** @param {number} seconds */
  function cursorText(seconds) {
    const { motion, scale, block, degrees } = shakenBy(app, app.state);
    const { samples, dt } = motion, place = seconds / dt, k = Math.floor(place);
    const a = k + 1 < samples.length ? samples[k] + (place - k) * (samples[k + 1] - samples[k]) : 0;
    const angle = angleAt(seconds * block.p);
    const tilt = angle === null ? 'it falls' : `θ = ${(angle * degrees).toFixed(2)}°`;
    return `t = ${seconds.toFixed(2)} s: ground ${((scale * a) / GRAVITY).toFixed(3)} g, ${tilt}`;
  }

  /** Return theta/alpha of the curve at a pivot time; null after a fall. @param {number} pt */
  function angleAt(pt) {
    if (!run) return 0;
    const { pt: times, angle, status } = run, last = times.length - 1;
    if (pt >= times[last]) return status === 'overturned' ? null : 0;
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= pt) low = middle; else high = middle;
    }
    const part = (pt - times[low]) / (times[high] - times[low] || 1);
    return angle[low] + part * (angle[high] - angle[low]);
  }

  /** @param {Pen} pen @param {{ width: number, height: number }} size */
  function draw(pen, size) {
    const shaken = shakenBy(app, app.state), { motion, block, scale, pga, degrees } = shaken;
    const { theme } = app, { angle, base } = pageUnits(app, app.state, true), end = lastSecond(), split = Math.round(0.42 * size.height);
    if (drawn?.motion !== motion) drawn = { motion, ...outlineOf(motion) };
    const lower = { width: size.width, height: size.height - split };
    const margin = { left: 46, right: hasFarRoom(lower) ? 44 : 0 }, uplift = upliftOf(block), high = 1.08 * Math.max(pga, 1.15 * uplift, 1e-9);
    const ground = frame(pen, { width: size.width, height: split }, {
      theme, margin, x: { from: 0, to: end, bare: true },
      y: { from: -high, to: high, label: `${base.label}; dashed: lifts the block`, far: base.far },
    });
    for (const side of [1, -1]) rule(pen, ground, { y: side * uplift }, { colour: theme.limit, dash: [6, 4] });
    curve(pen, ground, drawn.times, drawn.values.map((value) => (scale * value) / GRAVITY),
      { colour: theme.base, width: 1.3 });
    if (cursor !== null) rule(pen, ground, { x: cursor }, { colour: theme.ink });
    pen.save();
    pen.translate(0, split);
    const tilt = frame(pen, lower, {
      theme, margin, x: { from: 0, to: end, label: 'time [s]' },
      y: { from: -1.2 * degrees, to: 1.2 * degrees, label: `${angle.label}; dots: impacts`, far: angle.far },
    });
    for (const side of [1, -1]) {
      rule(pen, tilt, { y: side * degrees }, { colour: theme.limit, dash: [6, 4], width: 1.2 });
      note(pen, tilt, side > 0 ? 'α' : '−α', tilt.box.left + 10, tilt.y.at(side * degrees) + side * 10);
    }
    if (run) drawRun(pen, tilt, run, block.p, degrees);
    if (cursor !== null) rule(pen, tilt, { x: cursor }, { colour: theme.ink });
    pen.restore();
    onto = { ground, tilt, split };
  }

  /**
   * @param {Pen} pen
   * @param {Frame} tilt
   * @param {RecordRun} shown
   * @param {number} p
   * @param {number} degrees
   */
  function drawRun(pen, tilt, shown, p, degrees) {
    const { theme } = app, seconds = shown.pt.map((pt) => pt / p);
    curve(pen, tilt, seconds, shown.angle.map((angle) => angle * degrees), { width: 1.8 });
    const zero = tilt.y.at(0), { box } = tilt;
    for (const pt of shown.impacts.subarray(0, MOST_IMPACT_MARKS)) {
      const x = tilt.x.at(pt / p);
      if (x > box.left + box.width) break;
      drawMark(pen, 'dot', x, zero, { colour: theme.impact, radius: 2.2 });
    }
    if (shown.overturned === null) return;
    const x = tilt.x.at(shown.overturned / p), y = box.top + box.height - 14;
    rule(pen, tilt, { x: shown.overturned / p }, { colour: theme.limit, dash: [2, 3] });
    const onRight = x < box.left + 0.6 * box.width;
    note(pen, tilt, `${theme.words.overturned} at ${few(shown.overturned / p)} s`, x + (onRight ? 8 : -8), y,
      { align: onRight ? 'left' : 'right', font: theme.strong });
  }

  function table() {
    const { time, velocity } = pageUnits(app, app.state, true);
    const { impacts, impactVelocities } = run ?? { impacts: [], impactVelocities: [] };
    return tableOf(['impact', Array.from(impacts, (_, k) => k + 1)], [time, impacts],
      [velocity, Array.from(impactVelocities, Math.abs), 'before the impact: ']);
  }
}

/**
 * Return the curve of a motion: its samples, or of many the least and the largest of stretches.
 * @param {NamedMotion} motion
 */
function outlineOf({ samples, dt }) {
  const stretch = Math.ceil((2 * samples.length) / MOST_DRAWN);
  if (stretch < 3) return { times: samples.map((_, k) => k * dt), values: samples };
  const parts = Math.ceil(samples.length / stretch);
  const times = new Float64Array(2 * parts), values = new Float64Array(2 * parts);
  for (let part = 0; part < parts; part++) {
    const inside = samples.subarray(part * stretch, (part + 1) * stretch);
    let [low, high] = [0, 0];
    inside.forEach((value, k) => {
      if (value < inside[low]) low = k;
      if (value > inside[high]) high = k;
    });
    [Math.min(low, high), Math.max(low, high)].forEach((k, n) => {
      times[2 * part + n] = (part * stretch + k) * dt;
      values[2 * part + n] = inside[k];
    });
  }
  return { times, values };
}

/**
 * Make the row of choices: the motion, a file, the scale.
 * @param {App} app
 * @param {Panel} panel
 */
function makeBar(app, panel) {
  const chosen = /** @type {HTMLSelectElement} */ (make('select', { 'aria-label': 'ground motion' }));
  const number = /** @type {HTMLInputElement} */ (make('input', {
    type: 'number', min: '0.01', max: '100', step: '0.05', 'aria-label': 'scale of the motion',
    id: 'in-scale',
  }));
  const slider = /** @type {HTMLInputElement} */ (make('input', {
    type: 'range', min: '0.01', max: '3', step: '0.01', 'aria-label': 'scale of the motion, slider',
  }));
  chosen.classList.add('motions');
  chosen.addEventListener('change', () => app.set({ record: Number(chosen.value) }));
  slider.addEventListener('input', () => app.set({ scale: Number(slider.value) }, { settled: false }));
  slider.addEventListener('change', () => app.set({ scale: Number(slider.value) }));
  number.addEventListener('change', () => {
    const refused = number.value.trim() === '' || app.set({ scale: Number(number.value) }).length > 0;
    number.setAttribute('aria-invalid', String(refused));
  });
  const status = make('strong', { class: 'result', 'data-name': 'quake-status' });
  const peak = make('span', { 'data-name': 'quake-peak', hidden: '' });
  const impacts = make('span', { 'data-name': 'quake-impacts', hidden: '' });
  const pga = make('output', { 'data-name': 'quake-pga' });
  const row = make('label', { class: 'scale' }, 'scale ', slider, number, pga);
  panel.bar?.append(chosen, row);
  let listed = -1;
  const refresh = () => {
    const choices = motionChoices(app);
    if (listed !== choices.length) {
      listed = choices.length;
      chosen.replaceChildren(...choices.map(({ name }, k) => make('option', { value: String(k) }, name)));
    }
    const place = Math.min(Math.round(app.state.record), choices.length - 1);
    chosen.value = String(place);
    chosen.title = choices[place].note;
    if (document.activeElement !== number) number.value = String(Number(app.state.scale.toPrecision(6)));
    slider.value = String(app.state.scale);
    pga.textContent = `${few(shakenBy(app, app.state).pga)} g`;
  };
  makeFileOpener(app, panel, refresh);
  panel.bar?.append(status, peak, impacts);
  /** @param {RecordRun | null} run @param {string} words */
  const show = (run, words) => {
    status.textContent = words;
    status.dataset.value = run?.status ?? '';
    peak.dataset.value = String(run?.peak ?? '');
    impacts.dataset.value = String(run?.impactCount ?? '');
  };
  return { refresh, show };
}
