// The history of a block at rest under the pulse of the point, and the verdict in words.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { ShownUnits } from './words.mjs' */
/** @import { PulseWindow } from '../../physics/demand/windows.mjs' */
import { numeral } from '../../draw/scale.mjs';
import { pulseHistory } from '../../physics/demand/pulse.mjs';
import { make } from '../../shell/layout.mjs';
import { equationsOf } from '../../shell/state.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { MOTION_NAMES } from '../../words.mjs';
import { drawCourse } from './course.mjs';
import { struckOf, windowWords } from './pulse.mjs';
import { impactWords, sideWords, timeText, unitsOf } from './words.mjs';

const PULSE_SEEN = 14; // pivot time after the pulse up to which a block that stands is shown
const PULSE_SAMPLES = 500;

/**
 * Return the verdict of a run under a pulse.
 * @param {ReturnType<typeof pulseHistory>} run
 * @param {ShownUnits} units
 */
export function pulseVerdict(run, units) {
  const count = run.impacts.length;
  if (run.overturns !== null) {
    const when = run.overturns <= run.duration ? 'during the pulse' : 'after the pulse';
    return `Falls ${impactWords(count)}, ${sideWords(run.side)}, at ${timeText(run.overturns, units)}, ${when}.`;
  }
  if (run.status === 'undecided' || run.status === 'lost contact') return `Undecided: ${run.status} after ${run.flights} flights.`;
  if (run.peak === 0) return 'Stands: the pulse never lifts the block.';
  const peak = `${numeral(run.peak * units.angle, 4)}${units.u}`;
  const share = units.si ? ` (${numeral(run.peak, 4)} α)` : '';
  const rest = run.rests === null ? '' : `, ${MOTION_NAMES.rest} at ${timeText(run.rests, units)}`;
  return `Stands: peak |θ| = ${peak}${share}${rest}.`;
}

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makePulseHistoryPanel(app) {
  /** @type {ReturnType<typeof pulseHistory> | undefined} */
  let run;
  const verdict = make('p', { class: 'verdict' }), place = make('p', { class: 'facts' });
  const list = make('ul', { class: 'facts' });

  /** @param {State} state */
  const asked = (state) => {
    const duration = (2 * Math.PI) / state.pW; // about that of the pulse
    return {
      ...struckOf(app, state), amplitude: state.pA, ratio: state.pW, samples: PULSE_SAMPLES,
      until: 2 * duration + PULSE_SEEN,
    };
  };
  /** @param {State} state @param {boolean} settled */
  const search = (state, settled) => {
    const { ratio, ...block } = { ratio: state.pW, ...struckOf(app, state) };
    if (block.nonlinear && !settled) {
      app.shared.pulseWindows = undefined;
      return;
    }
    const how = { key: 'pulsewindows', priority: 0 };
    app.pool.ask('pulseWindows', { ...block, ratio }, how).then((found) => {
      if (!found) return;
      app.shared.pulseWindows = { ...found, ratio };
      app.touch('pulseWindows');
      write();
      app.redraw(panel);
    }, (error) => app.fail(panel, `The windows could not be computed: ${error}`, 'Move the point'));
  };

  /** @type {Panel} */
  const panel = {
    name: 'pulsehistory',
    title: 'History at the point',
    uses: ['model', 'r', 'rh', 'b', 'h', 'units', 'pulse', 'pA', 'pW'],
    placed() {
      panel.canvas?.parentElement?.before(verdict, place, list);
    },
    update(state, { changed, settled }) {
      const { nonlinear } = struckOf(app, state), sampled = /ricker|mavro/.test(state.pulse);
      if (nonlinear || sampled) {
        app.pool.ask('pulseHistory', asked(state), { key: 'pulserun', priority: 0 }).then((found) => {
          if (!found) return;
          run = found;
          write();
          app.redraw(panel);
        }, (error) => app.fail(panel, `The history could not be computed: ${error}`, 'Move the point'));
      } else run = pulseHistory(app.kernels, asked(state));
      const before = app.shared.pulseWindows;
      if (settled ? !before || [...changed].some((name) => name !== 'pA' && name !== 'units')
        : changed.has('pW')) search(state, settled);
      write();
      if (settled && run) app.say(verdict.textContent ?? '');
    },
    draw(pen, size) {
      if (!run) return;
      const units = unitsOf(app, app.state);
      drawCourse(pen, size, app.theme, run, units);
    },
    sentence() {
      const { state } = app, units = unitsOf(app, state);
      const level = `${units.si ? 'a' : 'A'} = ${numeral(state.pA * units.amplitude, 4)}${units.a}`;
      const rate = `${units.si ? 'f' : 'Ω'} = ${numeral(state.pW * units.frequency, 4)}${units.f}`;
      const words = run ? pulseVerdict(run, units) : '';
      return `One ${state.pulse} pulse of ${level}, ${rate}, ${equationsOf(state)} model. ${words}`;
    },
    table() {
      const { time, angle, base } = unitsOf(app, app.state).axes;
      return tableOf([time, run?.times ?? []], [angle, run?.states ?? []], [base, run?.base ?? []]);
    },
  };

  /** Write verdict and windows. */
  const write = () => {
    const { state } = app, units = unitsOf(app, state), found = app.shared.pulseWindows;
    verdict.textContent = run ? pulseVerdict(run, units) : '';
    const at = `At ${units.si ? 'f' : 'Ω'} = ${numeral(state.pW * units.frequency, 4)}${units.f}`;
    list.replaceChildren();
    if (!found || found.ratio !== state.pW) place.textContent = `${at}: searching for all windows…`;
    else if (!found.windows.length) {
      place.textContent = `${at} no amplitude up to ${numeral(found.high * units.amplitude, 4)}${units.a} fells it.`;
    } else {
      const shown = found.windows.slice(0, 4);
      place.textContent = `${at} it falls`;
      list.append(...shown.map((/** @type {PulseWindow} */ each) =>
        make('li', {}, windowWords(each, found.high, units))));
      const rest = found.windows.length - shown.length + found.leftOut;
      if (rest) list.append(make('li', {}, `in ${rest} more windows`));
    }
  };
  return panel;
}
