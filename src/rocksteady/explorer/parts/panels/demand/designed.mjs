// The dragged block of the Design tab: drawn to scale, its numbers, its verdict and neighbours.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { MotionClass } from '../../draw/classes.mjs' */
/** @import { designRun } from '../../physics/demand/design.mjs' */
import { fillClass } from '../../draw/classes.mjs';
import { numeral } from '../../draw/scale.mjs';
import { DESIGN_FATE, feltBy } from '../../physics/demand/design.mjs';
import { make } from '../../shell/layout.mjs';
import { MOTION_NAMES, NEVER_LIFTS, STANDS } from '../../words.mjs';
import { drawCourse } from './course.mjs';
import { demandOf, demandWords, designOf } from './design.mjs';
import { unitsOf } from './words.mjs';

/** @typedef {ReturnType<typeof designRun>} Designed */
/** @typedef {{ change: string, fate: number, peak: number }[]} DesignNeighbours */

const DESIGN_KEYS = ['demand', 'dg', 'df', 'dn', 'pulse', 'record', 'scale', 'model', 'r', 'rh', 'b', 'h', 'limit',
  'motions'];
/** What a block that does not stand wears. @type {Partial<Record<number, MotionClass>>} */
const STATES = { [DESIGN_FATE.overturns]: 'overturned', [DESIGN_FATE.undecided]: 'undecided' };
const DESIGN_SEEN = 14; // pivot time after a pulse up to which a block that stands is shown

/**
 * Return how a block fares in words.
 * @param {number} fate
 * @param {number} peak
 * @param {number} alpha  slenderness [rad]
 * @param {number} limit  theta/alpha that is allowed
 */
function designVerdict(fate, peak, alpha, limit) {
  if (fate === DESIGN_FATE.impossible) return 'does not rock: Housner’s restitution is not above 0';
  if (fate === DESIGN_FATE.undecided) return 'undecided';
  if (fate === DESIGN_FATE.overturns) return MOTION_NAMES.overturned;
  if (peak === 0) return NEVER_LIFTS;
  const degrees = `${numeral((peak * alpha * 180) / Math.PI, 3)}° = ${numeral(100 * peak, 3)} % of α`;
  return `${STANDS}${peak <= limit ? '' : ', beyond the limit'}: peak ${degrees}`;
}

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeDesignedPanel(app) {
  /** @type {Designed | undefined} */
  let found;
  /** @type {DesignNeighbours} */
  let neighbours = [];
  const verdict = make('p', { class: 'verdict' }), numbers = make('p', { class: 'facts' });
  const beside = make('table', { class: 'neighbours' });

  /** @param {State} state */
  const asked = (state) => ({
    ...designOf(app, state), sizes: { width: state.b, height: state.h }, samples: 500,
    until: state.demand === 'pulse' ? DESIGN_SEEN + 40 / state.df : undefined,
  });

  /** @type {Panel} */
  const panel = {
    name: 'designed',
    title: 'This block',
    uses: DESIGN_KEYS,
    placed() {
      panel.canvas?.parentElement?.before(verdict, numbers);
      panel.canvas?.parentElement?.after(beside);
    },
    update(state) {
      const fail = (/** @type {unknown} */ error) =>
        app.fail(panel, `This block could not be computed: ${error}`, 'Move the point');
      app.pool.ask('designRun', asked(state), { key: 'designrun', priority: 0 }).then((result) => {
        if (!result) return;
        found = result;
        write();
        app.redraw(panel);
        app.say(verdict.textContent ?? '');
      }, fail);
      const design = { ...designOf(app, state), width: state.b, height: state.h };
      app.pool.ask('designNeighbours', design, { key: 'designbeside', priority: 0.5 }).then((result) => {
        if (!result) return;
        neighbours = result;
        write();
      }, fail);
    },
    draw(pen, size) {
      if (!found) return;
      const { state, theme } = app, wide = size.width >= 420;
      const part = { // of the canvas, for the block
        width: wide ? Math.round(Math.min(230, 0.4 * size.width)) : size.width,
        height: wide ? size.height : Math.round(size.height * 0.42),
      };
      drawToScale(pen, part, app, found);
      if (!found.run) return;
      pen.save();
      pen.translate(wide ? part.width : 0, wide ? 0 : part.height);
      const rest = {
        width: wide ? size.width - part.width : size.width,
        height: wide ? size.height : size.height - part.height,
      };
      drawCourse(pen, rest, theme, found.run, unitsOf(app, state, true));
      pen.restore();
    },
    sentence() {
      const { b, h } = app.state;
      return `A block of ${numeral(b, 4)} m by ${numeral(h, 4)} m under ${demandWords(app, app.state)}: ${verdict.textContent} `
        + `${numbers.textContent}`;
    },
    table() {
      return {
        columns: ['change', 'fate', 'peak [θ/α]'],
        rows: neighbours.map(({ change, fate, peak }) => [change, fateWord(fate), peak]),
      };
    },
  };

  /** Write verdict, numbers and neighbours. */
  const write = () => {
    if (!found) return;
    const { state } = app, { block, fate, run } = found, demand = demandOf(app, state);
    const words = designVerdict(fate, run?.peak ?? NaN, block.alpha, state.limit);
    const others = neighbours.filter((each) => isFallen(each.fate) !== isFallen(fate)).length;
    const robust = !neighbours.length || fate > DESIGN_FATE.overturns ? ''
      : others ? ` Not robust: ${others} of ${neighbours.length} neighbours ${isFallen(fate) ? 'stand' : 'fall'}.`
        : ` All ${neighbours.length} neighbours ${isFallen(fate) ? 'fall' : 'stand'} too.`;
    verdict.textContent = `${words[0].toUpperCase()}${words.slice(1)}.${robust}`;
    const felt = demand.kind === 'record' ? ''
      : `; A = ${numeral(feltBy(demand, block).amplitude, 4)}, Ω = ${numeral(feltBy(demand, block).frequencyRatio, 4)}`;
    numbers.textContent = `α = ${numeral((block.alpha * 180) / Math.PI, 4)}°, R = ${numeral(block.radius, 4)} m, `
      + `p = ${numeral(block.p, 4)} rad/s, δ = ${numeral(block.restitution, 4)}`
      + `${state.rh === 1 ? ' (Housner)' : ''}, uplift at ${numeral(block.uplift, 4)} g${felt}.`;
    /** @param {string} change @returns {HTMLElement} */
    const cell = (change) => {
      const each = neighbours.find((one) => one.change === change);
      if (!each) return make('td');
      const words = each.fate !== DESIGN_FATE.stands ? fateWord(each.fate)
        : each.peak ? `stands, ${numeral(100 * each.peak, 3)} % of α` : NEVER_LIFTS;
      return make('td', { class: isFallen(each.fate) === isFallen(fate) ? '' : 'other' }, words);
    };
    const names = neighbours.map(({ change }) => change.replace(/ [−+].*/, ''));
    beside.replaceChildren(
      make('tr', {}, make('td', {}, 'neighbours'), make('th', { scope: 'col' }, '−10 % (δ − 0.03)'),
        make('th', { scope: 'col' }, '+10 % (δ + 0.03)')),
      ...[...new Set(names)].map((name) => {
        const by = name === 'restitution' ? '0.03' : '10 %';
        return make('tr', {}, make('th', { scope: 'row' }, name), cell(`${name} −${by}`), cell(`${name} +${by}`));
      }));
  };
  return panel;
}

/** @param {number} fate */
function isFallen(fate) {
  return fate === DESIGN_FATE.overturns;
}

/** @param {number} fate */
function fateWord(fate) {
  return ['stands', 'falls', 'undecided', 'does not rock'][fate];
}

/**
 * Draw the block to scale, upright and at its largest tilt.
 * @param {any} pen
 * @param {{ width: number, height: number }} size
 * @param {App} app
 * @param {Designed} found
 */
function drawToScale(pen, size, app, { block, fate, run }) {
  const { state, theme } = app, { b, h } = state;
  const size0 = state.plane === 'alpha' ? { wide: state.dr1, high: 2 * state.dr1 } : { wide: state.db1, high: state.dh1 };
  const [wide, high] = [Math.max(b, 0.5 * size0.wide), Math.max(1.1 * h, 0.5 * size0.high)];
  const ground = size.height - 22, unit = Math.min((ground - 26) / (1.06 * high), (size.width - 24) / Math.max(1.3 * wide, 3.1 * b));
  const middle = 0.5 * size.width;
  const turned = fate === DESIGN_FATE.overturns ? 1 : Math.min(run?.peak ?? 0, 1);
  const angles = run ? Array.from(run.states.subarray(0, run.times.length)) : [];
  const side = angles.reduce((most, u) => (Math.abs(u) > Math.abs(most) ? u : most), 0) < 0 ? -1 : 1;
  pen.fillStyle = theme.paper;
  pen.fillRect(0, 0, size.width, size.height);
  pen.fillStyle = theme.soil;
  pen.fillRect(0, ground, size.width, 8);
  /** @param {number} angle  [rad] */
  const trace = (angle) => {
    const pivot = angle < 0 ? b / 2 : -b / 2, [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    pen.beginPath();
    [[-b / 2, 0], [b / 2, 0], [b / 2, h], [-b / 2, h]].forEach(([x, y], k) => {
      const px = middle + unit * (pivot + (x - pivot) * cos - y * sin);
      const py = ground - unit * ((x - pivot) * sin + y * cos);
      if (k) pen.lineTo(px, py); else pen.moveTo(px, py);
    });
    pen.closePath();
  };
  /** @param {number} angle  [rad] @param {boolean} filled */
  const outlined = (angle, filled) => {
    trace(angle);
    if (filled) {
      pen.save();
      pen.clip();
      fillClass(pen, theme, STATES[fate] ?? (turned ? 'rocking' : 'rest'), { left: 0, top: 0, ...size });
      pen.restore();
      trace(angle); // a hatch has left another path
    }
    pen.setLineDash(filled ? [] : [4, 3]);
    pen.strokeStyle = filled && isFallen(fate) ? theme.edge : theme.ink;
    pen.lineWidth = 1.4;
    pen.stroke();
    pen.setLineDash([]);
  };
  outlined(0, true);
  if (turned > 0) outlined(side * turned * block.alpha, false);
  pen.fillStyle = theme.quiet;
  pen.font = theme.small;
  pen.textBaseline = 'middle';
  pen.textAlign = 'center';
  pen.fillText(`${numeral(b, 4)} m`, middle - 0.12 * size.width, ground + 15);
  // Beside the block, where it does not lean.
  pen.textAlign = side < 0 ? 'right' : 'left';
  pen.fillText(`${numeral(h, 4)} m`, middle - side * (-(unit * b) / 2 - 6), ground - (unit * h) / 2);
  const bar = [5, 2, 1, 0.5, 0.2, 0.1, 0.05].find((length) => length * unit < 0.2 * size.width) ?? 0.02;
  pen.strokeStyle = theme.ink;
  pen.lineWidth = 2;
  const right = size.width - 12;
  pen.beginPath();
  pen.moveTo(right - bar * unit, ground + 15);
  pen.lineTo(right, ground + 15);
  pen.stroke();
  pen.textAlign = 'right';
  pen.fillText(`${bar} m`, right - bar * unit - 5, ground + 15);
  if (turned > 0) {
    pen.fillStyle = theme.quiet;
    const words = fate === DESIGN_FATE.overturns ? 'dashed: balance, θ = α' : 'dashed: largest tilt';
    pen.textAlign = 'left';
    pen.fillText(words, 4, 10);
  }
}
