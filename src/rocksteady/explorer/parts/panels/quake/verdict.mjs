// The verdict with its neighbours, and over the scale of the motion.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { RecordNeighbour } from '../../physics/quake/record.mjs' */
/** @import { FateSeries, Shaken } from './shaken.mjs' */
/** @import { MotionClass } from '../../draw/classes.mjs' */
import { followPointer } from './dragging.mjs';
import { equationsOf } from '../../shell/state.mjs';
import { neighbourCases } from '../../physics/quake/record.mjs';
import { fillClass } from '../../draw/classes.mjs';
import { drawPeaks } from './peaks.mjs';
import { fatesTable } from './spectrum.mjs';
import { askFates, few, shakenBy } from './shaken.mjs';

const STRIP_COUNT = 240;
const SCALE_END = 3; // of the strip, where the scale is not larger
const SCALE_STEP = 0.01;
const NEIGHBOUR_ROOM = 92; // [px] of the table of neighbours
const NEIGHBOURS_OF_A_JOB = 7;
const CASE_PLACE = 1; // of the case itself among its neighbours

/** @typedef {{ name: MotionClass, text: string }} Cell */

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeVerdictPanel(app) {
  /** @type {FateSeries | null} */
  let series = null;
  /** @type {(RecordNeighbour | undefined)[]} */
  let neighbours = [];
  /** @type {Frame | null} */
  let onto = null;
  let asked = '', around = '';

  const last = () => Math.max(SCALE_END, 1.25 * app.state.scale);

  /** @type {Panel} */
  const panel = {
    name: 'verdict',
    title: 'Verdict',
    uses: ['record', 'scale', 'b', 'h', 'r', 'rh', 'model', 'units', 'motions', 'run'],
    update(state, { settled }) {
      const shaken = shakenBy(app, state), { motion, block, scale, refused } = shaken;
      if (refused) {
        app.pool.drop('verdict:');
        app.pool.drop('neighbours:');
        [series, neighbours, asked, around] = [null, [], '', ''];
        app.fail(panel, `No verdict: ${refused}`, 'Choose another motion');
        return;
      }
      const body = [state.record, app.motions.length, state.b, state.h, block.restitution, equationsOf(state)];
      const key = [...body, last()].join();
      if (asked !== `${key} all` && asked !== `${key} ${settled ? 'all' : 'few'}`) {
        asked = `${key} ${settled ? 'all' : 'few'}`;
        const end = last();
        const scales = Float64Array.from({ length: STRIP_COUNT }, (_, k) => (end * (k + 1)) / STRIP_COUNT);
        const fresh = askFates(app, panel, 'recordScales', { motion, block }, scales, settled, () => {
          if (fresh.done >= STRIP_COUNT / 8) series = fresh;
          app.redraw(panel);
        });
        series ??= fresh;
      }
      if (around !== [...body, scale].join()) neighbours = [];
      if (settled && around !== [...body, scale].join()) {
        around = [...body, scale].join();
        askNeighbours(shaken, around);
      }
      tell();
    },
    draw(pen, size) {
      const shaken = shakenBy(app, app.state), { scale, degrees } = shaken;
      const room = size.height > 230 ? NEIGHBOUR_ROOM : 0;
      onto = drawPeaks(pen, { width: size.width, height: size.height - room }, {
        theme: app.theme, degrees, series, at: scale, peak: app.shared.recordRun?.peak ?? null,
        x: { from: 0, to: last(), label: 'scale of the motion' },
        label: `× ${few(scale)}, PGA ${few(shaken.pga)} g`,
      });
      if (room) drawNeighbours(pen, { top: size.height - room, width: size.width, height: room });
    },
    sentence,
    table: () => fatesTable(app, 'scale', series),
    keys(event) {
      const step = { ArrowLeft: -SCALE_STEP, ArrowRight: SCALE_STEP }[event.key];
      if (!step) return false;
      move(app.state.scale + (event.shiftKey ? 10 * step : step), true);
      return true;
    },
    placed() {
      followPointer(app, panel, (event, settled) => onto && move(onto.x.value(event.offsetX), settled),
        ({ offsetY }) => onto !== null && offsetY <= onto.box.top + onto.box.height + 20);
    },
  };
  return panel;

  /** @param {number} value @param {boolean} settled */
  function move(value, settled) {
    const scale = Math.min(last(), Math.max(SCALE_STEP, value));
    app.set({ scale: Number(scale.toFixed(2)) }, { settled });
  }

  /** @param {Shaken} shaken @param {string} key */
  function askNeighbours({ motion, block, scale }, key) {
    const cases = neighbourCases(app.kernels, block);
    /** @type {(RecordNeighbour | undefined)[]} */
    const found = Array.from(cases, () => undefined);
    neighbours = found;
    app.pool.drop('neighbours:');
    for (let first = 0; first < cases.length; first += NEIGHBOURS_OF_A_JOB) {
      const part = cases.slice(first, first + NEIGHBOURS_OF_A_JOB);
      const args = { motion: { samples: motion.samples, dt: motion.dt }, scale, cases: part };
      const how = { key: `neighbours:${first}`, priority: 2 };
      app.pool.ask('recordNeighbours', args, how).then((result) => {
        if (!result || key !== around) return;
        found.splice(first, part.length, ...result);
        tell();
        app.redraw(panel);
      }, (error) => app.fail(panel, `The neighbours stopped: ${error.message}`, 'Choose another motion'));
    }
  }

  function tell() {
    app.note(panel, sentence());
    if (neighbours.length && neighbours.every(Boolean)) app.say(sentence());
  }

  function sentence() {
    const { degrees } = shakenBy(app, app.state), run = app.shared.recordRun;
    if (!run) return 'Computing the response.';
    const fell = run.status === 'overturned';
    const own = fell ? 'Falls' : run.status === 'undecided' ? 'Undecided'
      : `Stands, peak ${few(run.peak * degrees)}° = ${few(100 * run.peak)} % of α`;
    const done = neighbours.filter((each) => each !== undefined);
    if (!done.length || done.length < neighbours.length) return `${own}. Neighbours are computed.`;
    const falls = done.filter(({ status }) => status === 'overturned').length;
    const range = 'scale ±5 %, restitution ±0.03, α ±2 %';
    const count = `${falls} of ${done.length} neighbours (${range}) fall`;
    const robust = falls === (fell ? done.length : 0);
    return `${own}; ${count}: the verdict is ${robust ? 'robust' : 'not robust'}.`;
  }

  /**
   * Draw the 27 cases in three groups of slenderness: restitution upwards, scale to the right.
   * @param {Pen} pen
   * @param {{ top: number, width: number, height: number }} place
   */
  function drawNeighbours(pen, { top, width }) {
    const { theme } = app, group = (width - 74) / 3, cell = { width: (group - 14) / 3, height: 15 };
    pen.save();
    pen.translate(0, top);
    pen.fillStyle = theme.paper;
    pen.fillRect(0, 0, width, NEIGHBOUR_ROOM);
    pen.font = theme.small;
    pen.textBaseline = 'middle';
    const cells = cellsOf();
    for (let shape = 0; shape < 3; shape++) {
      const left = 66 + [1, 0, 2][shape] * group; // alpha ascending to the right
      pen.fillStyle = theme.quiet;
      pen.textAlign = 'center';
      pen.fillText(['α', 'α − 2 %', 'α + 2 %'][shape], left + 1.5 * cell.width, 10);
      for (let change = 0; change < 3; change++) {
        const row = [1, 2, 0][change]; // restitution ascending upwards
        const y = 20 + row * (cell.height + 2);
        for (let place = 0; place < 3; place++) {
          const { name, text } = cells[(shape * 3 + change) * 3 + place];
          const x = left + place * (cell.width + 2);
          fillClass(pen, theme, name, { left: x, top: y, width: cell.width, height: cell.height });
          pen.strokeStyle = shape + change === 0 && place === 1 ? theme.ink : theme.edge;
          pen.lineWidth = shape + change === 0 && place === 1 ? 2.5 : 1;
          pen.strokeRect(x + 0.5, y + 0.5, cell.width - 1, cell.height - 1);
          if (!text || cell.width < 34) continue;
          pen.fillStyle = name === 'rest' ? theme.ink : theme.onRocks;
          pen.fillText(text, x + cell.width / 2, y + cell.height / 2 + 0.5);
        }
        if (shape > 0) continue;
        pen.textAlign = 'right';
        pen.fillStyle = theme.quiet;
        pen.fillText(['δ', 'δ − 0.03', 'δ + 0.03'][change], 58, y + cell.height / 2);
        pen.textAlign = 'center';
      }
      pen.fillStyle = theme.quiet;
      ['−5 %', '×', '+5 %'].forEach((text, place) => {
        const shown = place === 1 ? `${few(app.state.scale)} ×` : text;
        if (cell.width > 26 || place !== 1) pen.fillText(shown, left + (place + 0.5) * (cell.width + 2), 81);
      });
    }
    pen.restore();
  }

  /** @returns {Cell[]} */
  function cellsOf() {
    const run = app.shared.recordRun;
    const { degrees } = shakenBy(app, app.state);
    const all = neighbours.length ? [...neighbours] : Array.from({ length: 26 }, () => undefined);
    const own = run && { status: run.status, peak: run.peak, alpha: (degrees * Math.PI) / 180 };
    all.splice(CASE_PLACE, 0, /** @type {any} */ (own) ?? undefined);
    return all.map((each) => {
      if (!each) return { name: 'not-computed', text: '' };
      if (each.status === 'overturned') return { name: 'overturned', text: '' };
      if (each.status === 'undecided') return { name: 'undecided', text: '' };
      return { name: each.peak ? 'rocking' : 'rest', text: `${((each.peak * each.alpha * 180) / Math.PI).toFixed(1)}°` };
    });
  }
}
