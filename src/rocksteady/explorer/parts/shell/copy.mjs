// The present view as a Python script, as a command and as a link; numbers keep all their bits.

/** @import { PutIn } from './app.mjs' */
/** @import { Start } from '../physics/case.mjs' */
/** @import { State } from './state.mjs' */
import { START_WINDOW } from '../kernels/window.mjs';
import { STRIP_VALUES } from '../physics/sweep.mjs';
import { GRAVITY } from '../physics/case.mjs';
import { linkOf } from './link.mjs';
import { equationsOf, isWhole, startOf } from './state.mjs';

/**
 * What is computed: a motion, a map, two sweeps, basins, a pulse, a record, a block and a demand.
 * @typedef {'point' | 'map' | 'strip' | 'basins' | 'pulse' | 'quake' | 'design'} Subject
 */

/** @type {Readonly<Record<string, Subject>>} */
const TAB_SUBJECTS = { basins: 'basins', pulse: 'pulse', quake: 'quake', design: 'design' };
/** @type {Readonly<Record<string, Subject>>} */
const PANEL_SUBJECTS = {
  readout: 'point', film: 'point', history: 'point', phase: 'point', section: 'point',
  multipliers: 'point', map: 'map', strip: 'strip', basins: 'basins', pulse: 'pulse',
  pulsehistory: 'pulse', quake: 'quake', verdict: 'quake', spectrum: 'quake', design: 'design', designed: 'design',
};
const MAP_CELLS = 128; // along each axis
const LOG_SPAN = 0.001; // lowest of a logarithmic axis that begins at 0, over the highest

/**
 * Return what a panel shows; of the page as a whole, the first panel of its tab.
 * @param {State} state
 * @param {string} [panel]  its name
 * @returns {Subject}
 */
export function subjectOf(state, panel = '') {
  return PANEL_SUBJECTS[panel] ?? TAB_SUBJECTS[state.tab] ?? 'point';
}

/**
 * Return a Python script that computes what is shown and prints its numbers.
 * @param {State} state
 * @param {Subject} subject
 * @param {PutIn} [motion]  that is shown, of an earthquake
 * @returns {string}
 */
export function pythonOf(state, subject, motion) {
  const lines = {
    point: pointLines, map: mapLines, strip: stripLines, basins: basinLines, pulse: pulseLines,
    quake: quakeLines, design: designLines,
  }[subject](state, motion);
  const arrays = lines.some((line) => line.includes('np.'));
  return [...(arrays ? ['import numpy as np'] : []), 'import rocksteady as rs', '', ...lines, '']
    .join('\n');
}

/**
 * Return a command that computes what is shown.
 * @param {State} state
 * @param {Subject} subject
 * @param {PutIn} [motion]
 * @returns {string}
 */
export function commandOf(state, subject, motion) {
  const start = startFlags(startOf(state));
  const shaking = ['-A', shellNumber(state.A), '-W', shellNumber(state.W)];
  const { w, a } = windowOf(state);
  /** @type {Record<Subject, () => string[]>} */
  const words = {
    point: () => (state.A === 0 && start.length
      ? ['simulate', ...blockFlags(state), start[0]] // let go on a still base
      : ['attractor', ...shaking, ...blockFlags(state), ...start]),
    map: () => ['map', '-A', axisText(centresOf(a, MAP_CELLS)), '-W',
      axisText(centresOf(w, MAP_CELLS)), ...blockFlags(state), ...start],
    strip: () => {
      const [over, other] = state.by === 'a' ? ['-A', '-W'] : ['-W', '-A'];
      const axis = axisText({ ...(state.by === 'a' ? a : w), count: STRIP_VALUES });
      const kept = shellNumber(state.by === 'a' ? state.W : state.A);
      return ['map', over, axis, other, kept, ...blockFlags(state), ...start];
    },
    basins: () => {
      const [u, v] = basinWindow(state).map((axis) => axisText(centresOf(axis, axis.count)));
      const window = isWhole(state) ? [] : [`--angles=${u}`, `--velocities=${v}`];
      return ['basins', ...shaking, ...blockFlags(state), ...window];
    },
    pulse: () => {
      const size = ['-A', shellNumber(state.pA), '-W', shellNumber(state.pW)];
      return ['simulate', '--pulse', state.pulse, ...size, ...blockFlags(state)];
    },
    quake: () => {
      const name = motion ? motion.name : 'record.csv';
      return ['simulate', `--record=${shellText(name)}`, '--scale', shellNumber(scaleOf(state)),
        ...blockFlags(state, true)];
    },
    design: () => {
      if (state.demand === 'record' && motion) return words.quake();
      const size = ['--accel-g', shellNumber(state.dg), '--freq-hz', shellNumber(state.df)];
      const kind = state.demand === 'harmonic' ? ['--cycles', shellNumber(state.dn)]
        : ['--pulse', state.pulse];
      return ['simulate', ...kind, ...size, ...blockFlags(state, true)];
    },
  };
  return ['rocksteady', ...words[subject]()].join(' ');
}

/**
 * Return the address of the present view, with every value: it shows the same where defaults differ.
 * @param {State} state
 * @param {string} page  address of the page
 */
export function addressOf(state, page) {
  return page.replace(/#.*$/s, '') + linkOf(state, true);
}

// ------------------------------------------------------------------------- numbers and names

/**
 * Return a number as Python reads it: the same double, and never an integer.
 * @param {number} value
 * @returns {string}
 */
export function pythonNumber(value) {
  if (Object.is(value, -0)) return '-0.0';
  const text = String(value);
  return /^-?\d+$/.test(text) ? `${text}.0` : text;
}

/** @param {number} value */
function shellNumber(value) {
  return Object.is(value, -0) ? '0' : String(value);
}

/**
 * Return a text as a literal of Python.
 * @param {string} text
 */
export function pythonText(text) {
  return JSON.stringify(text).replace(/[^ -~]/gu, (letter) => {
    const code = /** @type {number} */ (letter.codePointAt(0)).toString(16);
    return code.length > 4 ? `\\U${code.padStart(8, '0')}` : `\\u${code.padStart(4, '0')}`;
  });
}

/**
 * Return a text as one word of a shell; control characters are left out.
 * @param {string} text
 */
export function shellText(text) {
  const plain = text.replace(/[\u0000-\u001f\u007f-\u009f]/g, '');
  return /^[\w./:=+,-]+$/.test(plain) ? plain : `'${plain.replace(/'/g, "'\\''")}'`;
}

/** @param {{ from: number, to: number, count: number, log: boolean }} axis */
function axisText({ from, to, count, log }) {
  return `${log ? 'log:' : ''}${shellNumber(from)}:${shellNumber(to)}:${count}`;
}

/**
 * Return the first and the last of the middles of equal cells.
 * @param {{ from: number, to: number, log: boolean }} axis
 * @param {number} count
 */
function centresOf({ from, to, log }, count) {
  const half = 0.5 / count;
  /** @type {(part: number) => number} */
  const at = (part) => (log ? from * (to / from) ** part : from + (to - from) * part);
  return { from: at(half), to: at(1 - half), count, log };
}

// ---------------------------------------------------------------------- parts of the state

/** @param {State} state */
function windowOf(state) {
  const log = state.log === 1;
  return {
    w: { from: state.w0, to: state.w1, log },
    a: { from: log ? Math.max(state.a0, LOG_SPAN * state.a1) : state.a0, to: state.a1, log },
  };
}

/** @param {State} state */
function basinWindow({ u0, u1, v0, v1 }) {
  const { columns, rows } = START_WINDOW;
  return [{ from: u0, to: u1, log: false, count: columns }, { from: v0, to: v1, log: false, count: rows }];
}

/** @param {State} state */
function scaleOf(state) {
  return Number(/** @type {Record<string, any>} */ (state).scale ?? 1);
}

/** @param {State} state */
function restitutionText(state) {
  return state.rh === 1 ? '"housner"' : pythonNumber(state.r);
}

/**
 * @param {State} state
 * @param {boolean} [sized]  whether only a block of known size will do
 */
function blockLine(state, sized = false) {
  const slender = equationsOf(state) === 'linear' && state.units === 'none' && state.rh !== 1;
  const restitution = `restitution=${restitutionText(state)}`;
  if (slender && !sized) return `block = rs.DimensionlessBlock(${restitution})`;
  const size = `width=${pythonNumber(state.b)}, height=${pythonNumber(state.h)}`;
  return `block = rs.Block.rectangle(${size}, ${restitution})`;
}

/**
 * @param {State} state
 * @param {boolean} [sized]
 */
function blockFlags(state, sized = false) {
  const slender = equationsOf(state) === 'linear' && state.units === 'none' && state.rh !== 1;
  const restitution = state.rh === 1 ? 'housner' : shellNumber(state.r);
  if (slender && !sized) return ['-r', restitution, '--model', equationsOf(state)];
  const size = ['--width-m', shellNumber(state.b), '--height-m', shellNumber(state.h)];
  return [...size, '-r', restitution, '--model', equationsOf(state)];
}

/** @param {State} state */
function modelText(state) {
  return equationsOf(state) === 'nonlinear' ? 'rs.Nonlinear()' : 'rs.Linear()';
}

/** @param {State} state */
function motionLine({ A, W }) {
  return `motion = rs.Harmonic(amplitude=${pythonNumber(A)}, frequency_ratio=${pythonNumber(W)})`;
}

/** @param {Start} start */
function pythonStart(start) {
  if (start.kind === 'rest') return 'rs.Rest()';
  if (start.kind === 'steady') return 'rs.Steady()';
  if (start.kind === 'state') {
    const { angle, velocity } = start;
    return `rs.State(angle=${pythonNumber(angle)}, velocity=${pythonNumber(velocity)})`;
  }
  const { side, phase, speed } = start;
  const where = `side=${side}, phase=${pythonNumber(phase)}`;
  return `rs.histories.ImpactState(${where}, speed=${pythonNumber(speed)})`;
}

/** @param {Start} start */
function startFlags(start) {
  if (start.kind === 'rest') return [];
  if (start.kind === 'steady') return ['--start', 'steady'];
  if (start.kind === 'state') {
    return [`--start=${shellNumber(start.angle)},${shellNumber(start.velocity)}`];
  }
  const velocity = shellNumber(start.side * start.speed);
  return [`--start=0,${velocity}`, `--phase=${shellNumber(start.phase)}`];
}

// --------------------------------------------------------------------------------- scripts

/** @param {State} state */
function pointLines(state) {
  const how = `start=${pythonStart(startOf(state))}, model=${modelText(state)}`;
  return [
    blockLine(state),
    motionLine(state),
    `found = rs.find_attractor(block, motion, ${how})`,
    'print("attractor:", found.kind)',
    'if found.orbit is not None:',
    '    print("period [periods of the shaking]:", found.period)',
    '    print("impacts in a period:", found.orbit.impacts)',
    '    print("highest theta/alpha:", found.orbit.highest)',
    '    print("lowest theta/alpha:", found.orbit.lowest)',
    '    print("multipliers:", *found.orbit.multipliers)',
    `run = rs.simulate(block, motion, cycles=${pythonNumber(state.cycles)}, ${how})`,
    'print("status:", run.status.label)',
    'print("peak of |theta|/alpha:", run.peak)',
    'print("impacts:", run.impact_count)',
  ];
}

/** @param {{ from: number, to: number, log: boolean }} axis */
function centresText({ from, to, log }) {
  const [low, high] = [pythonNumber(from), pythonNumber(to)];
  return log ? `np.exp(centres(np.log(${low}), np.log(${high})))` : `centres(${low}, ${high})`;
}

/** @param {State} state */
function mapLines(state) {
  const { w, a } = windowOf(state);
  return [
    `def centres(low, high, cells=${MAP_CELLS}):`,
    '    return low + (high - low) * ((np.arange(cells) + 0.5) / cells)',
    '',
    '',
    blockLine(state),
    `ratios = ${centresText(w)}`,
    `amplitudes = ${centresText(a)}`,
    'found = rs.map_attractors(',
    '    block,',
    '    axes={"amplitude": amplitudes, "frequency_ratio": ratios},',
    `    start=${pythonStart(startOf(state))},`,
    `    model=${modelText(state)},`,
    ')',
    'print(found.rocksteady.summary())',
  ];
}

/** @param {State} state */
function stripLines(state) {
  const { w, a } = windowOf(state);
  const { from, to, log } = state.by === 'a' ? a : w;
  const spaced = log ? 'geomspace' : 'linspace';
  const name = state.by === 'a' ? 'amplitude' : 'frequency_ratio';
  return [
    blockLine(state),
    motionLine(state),
    `values = np.${spaced}(${pythonNumber(from)}, ${pythonNumber(to)}, ${STRIP_VALUES})`,
    ...[['up', 'values', 'rs.Rest()'], ['down', 'values[::-1]', 'rs.Steady()']].flatMap(
      ([way, values, start]) => [
        `${way} = rs.orbits.sweep_attractor(`,
        `    block, motion, "${name}", ${values}, start=${start}, model=${modelText(state)}`,
        ')',
        `print(${way}.summary())`,
      ]),
  ];
}

/** @param {State} state */
function basinLines(state) {
  const [u, v] = basinWindow(state).map(middlesText), whole = isWhole(state);
  return [
    ...(whole ? [] : ['def middles(low, high, cells):',
      '    places = np.arange(cells) - 0.5 * (cells - 1)',
      '    return 0.5 * (low + high) + places * ((high - low) / cells)',
      '',
      '']),
    blockLine(state),
    motionLine(state),
    ...(whole ? [`found = rs.compute_basins(block, motion, model=${modelText(state)})`]
      : ['found = rs.compute_basins(',
        '    block,',
        '    motion,',
        `    angles=${u},`,
        `    velocities=${v},`,
        `    model=${modelText(state)},`,
        ')']),
    'print("states:", found.label.size)',
    'for attractor, part in zip(found.attractors, found.fractions()):',
    '    print(f"{attractor.name}:", part.share)',
  ];
}

/** @param {{ from: number, to: number, count: number }} axis */
function middlesText({ from, to, count }) {
  return `middles(${pythonNumber(from)}, ${pythonNumber(to)}, ${count})`;
}

/** @param {State} state */
function pulseLines(state) {
  const [amplitude, ratio] = [state.pA, state.pW].map(pythonNumber);
  const size = `amplitude=${amplitude}, frequency_ratio=${ratio}`;
  return [
    blockLine(state),
    `pulse = rs.Pulse(shape=${pythonText(state.pulse)}, ${size})`,
    ...runLines(state, 'pulse'),
    `ratios = [${ratio}]`,
    `found = rs.find_overturning_windows(block, pulse, ratios, model=${modelText(state)})`,
    'for window in found.at(0):',
    '    print("overturned from", window.low, "to", window.high, "impacts:", window.impacts)',
  ];
}

/**
 * @param {State} state
 * @param {PutIn} [motion]
 */
function quakeLines(state, motion) {
  const made = motion ? [
    'record = rs.Record(',
    `    name=${pythonText(motion.name || 'motion')},`,
    `    dt_s=${pythonNumber(motion.dt)},`,
    `    acceleration_m_s2=[${Array.from(motion.acceleration, pythonNumber).join(', ')}],`,
    ')',
  ] : ['record = rs.read_record("record.csv")'];
  return [
    blockLine(state, true),
    ...made,
    `motion = record.scaled(${pythonNumber(scaleOf(state))})`,
    ...runLines(state, 'motion'),
  ];
}

/**
 * @param {State} state
 * @param {PutIn} [motion]
 */
function designLines(state, motion) {
  if (state.demand === 'record' && motion) return quakeLines(state, motion);
  const harmonic = state.demand === 'harmonic';
  const shape = harmonic ? '' : ` shape=${pythonText(state.pulse)},`;
  return [
    blockLine(state, true),
    `acceleration = ${pythonNumber(state.dg)} * ${pythonNumber(GRAVITY)}`,
    `motion = rs.${harmonic ? 'Harmonic' : 'Pulse'}.from_si(`,
    `    block,${shape} acceleration_m_s2=acceleration, frequency_hz=${pythonNumber(state.df)}`,
    ')',
    ...runLines(state, 'motion', harmonic ? `, cycles=${pythonNumber(state.dn)}` : ''),
  ];
}

/**
 * Return lines that follow a block from rest and print how it fares.
 * @param {State} state
 * @param {string} motion
 * @param {string} [further]  arguments
 */
function runLines(state, motion, further = '') {
  return [
    `run = rs.simulate(block, ${motion}${further}, model=${modelText(state)})`,
    'print("status:", run.status.label)',
    'print("peak of |theta|/alpha:", run.peak)',
    'print("impacts:", run.impact_count)',
  ];
}
