// The Pulse tab's picture: what one pulse makes of the block, over its frequency and amplitude.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { PulseWindow } from '../../physics/demand/windows.mjs' */
/** @import { ShownUnits } from './words.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { Look, MotionClass } from '../../draw/classes.mjs' */
/** @import { PulseFates } from '../../physics/demand/pulse.mjs' */
import { classLook, fallLook, fillLook, lookTiles } from '../../draw/classes.mjs';
import { clipped, note, rule } from '../../draw/marks.mjs';
import { numeral } from '../../draw/scale.mjs';
import { PULSES } from '../../kernels/pulses.mjs';
import { FATE } from '../../physics/demand/pulse.mjs';
import { upliftOf } from '../../physics/demand/windows.mjs';
import { caseOf } from '../../shell/state.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { buttonEntry, choiceEntry, numberEntry } from '../entries.mjs';
import { axisOf } from '../plane/axis.mjs';
import { makePlane } from '../plane/plane.mjs';
import { drawFates } from './key.mjs';
import { NEVER_LIFTS } from '../../words.mjs';
import { impactWords, sideWords, unitsOf } from './words.mjs';

const PULSE_KEYS = /** @type {const} */ ({ x: ['pw0', 'pw1'], y: ['pa0', 'pa1'] });
const PULSE_GRID = { columns: 384, rows: 288 };
const PULSE_MODES = ['falls without an impact', 'falls after one impact', 'falls after two or more'];
/** @type {MotionClass[]} */
const PULSE_CLASSES = ['rocking', 'rest', 'undecided'];
const PULSE_LOOK = { stands: 0, rests: 1, undecided: 2, first: 3 }; // then modes, each side

/**
 * Return the block that the pulse meets.
 * @param {App} app
 * @param {State} state
 */
export function struckOf(app, state) {
  const { restitution, nonlinear, alpha } = caseOf(app.kernels, state);
  return { shape: state.pulse, restitution, nonlinear, alpha };
}

/**
 * Return what cells look like, by their numbers.
 * @param {Theme} theme
 * @returns {Look[]}
 */
function pulseLooks(theme) {
  return [
    ...PULSE_CLASSES.map((name) => classLook(theme, name)),
    ...[0, 1, 2].flatMap((impacts) => [1, -1].map((side) => fallLook(theme, side, impacts))),
  ];
}

/** Return the number of the look of a fate. @param {PulseFates} fates @param {number} k */
function pulseLook({ status, impacts, side, margin }, k) {
  if (status[k] === FATE.undecided || status[k] === FATE.lost) return PULSE_LOOK.undecided;
  if (status[k] !== FATE.overturned) {
    return impacts[k] || margin[k] > -1 ? PULSE_LOOK.stands : PULSE_LOOK.rests;
  }
  return PULSE_LOOK.first + 2 * Math.min(impacts[k], 2) + (side[k] > 0 ? 0 : 1);
}

/** @param {PulseFates} fates @param {number} k */
function fateWords(fates, k) {
  const look = pulseLook(fates, k);
  if (look >= PULSE_LOOK.first) {
    return `falls ${impactWords(fates.impacts[k])}, ${sideWords(fates.side[k])}`;
  }
  return ['stands', 'does not lift', 'undecided'][look];
}

/**
 * @param {PulseWindow} window
 * @param {number} end  of the range that was searched
 * @param {ShownUnits} units
 */
export function windowWords({ low, high, impacts, side }, end, units) {
  const from = numeral(low * units.amplitude), to = numeral(high * units.amplitude);
  const range = high >= end ? `from ${from}${units.a}` : `${from} to ${to}${units.a}`;
  const ways = impacts >= 10 ? 'after 10 or more impacts' : impactWords(impacts);
  return `${range}: ${ways}, ${sideWords(side)}`;
}

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makePulsePanel(app) {
  /** @type {ReturnType<typeof makeEntries> | undefined} */
  let entries;
  let uplift = 1;
  const fates = () => /** @type {PulseFates} */ (/** @type {unknown} */ (plane.cells()));
  const plane = makePlane(app, () => panel, {
    name: 'pulse',
    grid: PULSE_GRID,
    whole: 2,
    empty: (count) => ({ status: new Uint8Array(count), impacts: new Int32Array(count),
      side: new Int8Array(count), margin: new Float64Array(count) }),
    tiles: (theme, ratio) => lookTiles(pulseLooks(theme), ratio),
    look: (k) => pulseLook(fates(), k),
    undecided: (k) => pulseLook(fates(), k) === PULSE_LOOK.undecided,
    axes(state) {
      const { axes: units } = unitsOf(app, state), log = state.plog === 1;
      return {
        x: axisOf(state, PULSE_KEYS.x, units.frequency, log),
        y: axisOf(state, PULSE_KEYS.y, units.amplitude, log),
      };
    },
    point: ({ pW, pA }) => ({ x: pW, y: pA }),
    moved: ({ x, y }) => ({ pW: x, pA: y }),
    work(state) {
      const struck = struckOf(app, state), { shape, restitution, nonlinear, alpha } = struck;
      const sampled = /ricker|mavro/.test(shape);
      return {
        job: 'pulseFates', cost: `${nonlinear} ${sampled}`,
        ms: (nonlinear ? 0.06 : 0.005) * (sampled ? 8 : 1),
        motion: [shape, restitution, nonlinear && alpha].join(' '),
        args: (ratios, amplitudes) => ({ ...struck, ratios, amplitudes }),
      };
    },
    words({ x, y }, cell) {
      const { amplitude, frequency, a, f, si } = unitsOf(app, app.state);
      const [up, along] = [numeral(y * amplitude, 4), numeral(x * frequency, 4)];
      return [si ? `${up}${a}, ${along}${f}` : `A = ${up}, Ω = ${along}`,
        cell ? fateWords(fates(), cell.at) : 'not computed yet'];
    },
    tell: () => tell(),
  });
  const key = () => {
    const looks = pulseLooks(app.theme);
    const modes = PULSE_MODES.map((words, k) => ({ words, look: looks[PULSE_LOOK.first + 2 * k] }));
    return [...modes, { words: 'falls to the right', look: looks[PULSE_LOOK.first + 1] },
      { words: 'stands', look: looks[PULSE_LOOK.stands] },
      { words: NEVER_LIFTS, look: looks[PULSE_LOOK.rests] }];
  };

  /** @type {Panel} */
  const panel = {
    name: 'pulse',
    title: 'Falling in one pulse',
    uses: ['model', 'r', 'rh', 'b', 'h', 'units', 'pulse', 'plog', 'pA', 'pW', ...PULSE_KEYS.x,
      ...PULSE_KEYS.y, 'pulseWindows'],
    placed() {
      entries = makeEntries(app, plane);
      panel.bar?.append(...entries.all);
      plane.listen();
    },
    update(state, { settled }) {
      entries?.refresh(state);
      uplift = upliftOf(app.kernels, struckOf(app, state));
      plane.update(state, settled);
      tell();
    },
    draw(pen, size) {
      const { state, theme } = app, units = unitsOf(app, state);
      drawFates(pen, size, app, plane, { key: key(), over: (onto) => {
        rule(pen, onto, { y: uplift * units.amplitude }, { colour: theme.limit, dash: [6, 4], width: 1.2 });
        note(pen, onto, `lifts above ${numeral(uplift * units.amplitude, 3)}${units.a}`, onto.box.left + onto.box.width - 4,
          onto.y.at(uplift * units.amplitude) + 9, { align: 'right' });
        drawColumn(pen, onto, units);
      } });
    },
    sentence() {
      const { state } = app, units = unitsOf(app, state);
      const found = app.shared.pulseWindows;
      const place = `at ${units.si ? 'f' : 'Ω'} = ${numeral(state.pW * units.frequency, 4)}${units.f}`;
      const head = `Fates of a block at rest under a ${state.pulse} pulse`;
      if (!found) return `${head}, over its frequency and amplitude.`;
      if (!found.windows.length) return `${head}: ${place} no amplitude up to ${numeral(found.high, 4)} αg fells it.`;
      const words = found.windows.map((/** @type {PulseWindow} */ each) => windowWords(each, found.high, units));
      return `${head}: ${place} it falls ${words.join('; ')}.`;
    },
    table() {
      const { amplitude } = unitsOf(app, app.state).axes;
      /** @type {PulseWindow[]} */
      const windows = app.shared.pulseWindows?.windows ?? [];
      const each = (/** @type {'low' | 'high' | 'impacts' | 'side'} */ name) => windows.map((one) => one[name]);
      return tableOf([amplitude, each('low'), 'from '], [amplitude, each('high'), 'to '],
        ['impacts before', each('impacts')], ['side (+1: θ > 0)', each('side')]);
    },
    keys: (event) => plane.keys(event),
  };

  /** Write how far the picture is. */
  const tell = () => {
    const far = plane.words();
    if (far === null) return;
    const words = plane.progress().complete ? 'Drag the point; shift-drag a box to come closer.' : '';
    app.note(panel, [words, far].filter(Boolean).join(' '));
  };

  /**
   * Draw the windows at the frequency of the point, with their borders.
   * @param {any} pen
   * @param {import('../../draw/frame.mjs').Frame} onto
   * @param {ShownUnits} units
   */
  const drawColumn = (pen, onto, units) => {
    const { state, theme } = app, found = app.shared.pulseWindows;
    if (!found) return;
    const middle = onto.x.at(found.ratio * units.frequency), wide = 10;
    const labelled = middle > onto.box.left + onto.box.width - 120 ? 'right' : 'left';
    clipped(pen, onto, () => {
      for (const { low, high, impacts, side } of found.windows) {
        const [top, bottom] = [high, low].map((a) => onto.y.at(a * units.amplitude));
        fillLook(pen, fallLook(theme, side, impacts),
          { left: middle - wide / 2, top, width: wide, height: Math.max(1, bottom - top) });
        pen.strokeStyle = theme.paper;
        pen.lineWidth = 3;
        pen.strokeRect(middle - wide / 2, top, wide, Math.max(1, bottom - top));
        pen.strokeStyle = theme.ink;
        pen.lineWidth = 1.2;
        pen.strokeRect(middle - wide / 2, top, wide, Math.max(1, bottom - top));
      }
    });
    let before = Infinity;
    // A border between two windows is where the upper one begins.
    const ends = new Map(found.windows.flatMap((/** @type {PulseWindow} */ { low, high }) => [[low, 'from'], [high, 'to']]));
    for (const [end, word] of ends) {
      const y = onto.y.at(end * units.amplitude);
      if (y > before - 13 || end < state.pa0 || end > state.pa1 || end >= found.high) continue;
      before = y;
      const text = `falls ${word} ${numeral(end * units.amplitude)}${units.a}`;
      note(pen, onto, text, middle + (labelled === 'left' ? 10 : -10), y, { align: labelled, colour: theme.ink });
    }
  };
  return panel;
}

/**
 * @param {App} app
 * @param {ReturnType<typeof makePlane>} plane
 */
function makeEntries(app, plane) {
  const shape = choiceEntry(app, 'pulse', 'pulse', Object.keys(PULSES).map((name) => [name, name.replace(/-/g, ' ')]));
  const amplitude = numberEntry(app, {
    name: 'pA', label: 'A', step: 0.05,
    read: () => app.state.pA * unitsOf(app, app.state).amplitude,
    write: (value) => ({ pA: value / unitsOf(app, app.state).amplitude }),
  });
  const frequency = numberEntry(app, {
    name: 'pW', label: 'Ω', step: 0.05,
    read: () => app.state.pW * unitsOf(app, app.state).frequency,
    write: (value) => ({ pW: value / unitsOf(app, app.state).frequency }),
  });
  const log = buttonEntry('log', 'logarithmic axes', () => app.set({ plog: 1 - app.state.plog }));
  const all = [
    shape.root, amplitude.root, frequency.root, log,
    ...plane.buttons(),
  ];
  return {
    all,
    /** @param {State} state */
    refresh(state) {
      const si = state.units === 'si';
      shape.refresh();
      shape.root.title = PULSES[state.pulse].words;
      amplitude.words(si ? 'a [g]' : 'A');
      frequency.words(si ? 'f [Hz]' : 'Ω');
      amplitude.refresh();
      frequency.refresh();
      log.setAttribute('aria-pressed', String(state.plog === 1));
    },
  };
}
