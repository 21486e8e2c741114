// The rocking spectrum: largest tilt of blocks of all sizes and one slenderness on the motion.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { FateSeries } from './shaken.mjs' */
import { followPointer } from './dragging.mjs';
import { GRAVITY, evaluate } from '../../physics/case.mjs';
import { RUN_STATUS } from '../../physics/run.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { pageUnits } from '../../shell/units.mjs';
import { drawPeaks } from './peaks.mjs';
import { askFates, fallenOf, few, shakenBy } from './shaken.mjs';

const SPECTRUM_VALUES = 161;
const SPECTRUM_ENDS = [0.5, 16]; // [s]
const SPECTRUM_STEP = 1.01; // of the period by an arrow key

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeSpectrumPanel(app) {
  /** @type {FateSeries | null} */
  let series = null;
  /** @type {Frame | null} */
  let onto = null;
  let asked = '';

  const ownPeriod = () => (2 * Math.PI) / shakenBy(app, app.state).block.p;
  /** @param {number} own  [s] */
  const ends = (own) => [Math.min(SPECTRUM_ENDS[0], own / 1.5), Math.max(SPECTRUM_ENDS[1], own * 1.5)];
  /** @param {number} period @param {boolean} settled */
  const resize = (period, settled) => {
    const p = (2 * Math.PI) / period, radius = (0.75 * GRAVITY) / (p * p);
    const { alpha } = shakenBy(app, app.state).block;
    const width = 2 * radius * evaluate(app.kernels, 'sin', alpha);
    const height = 2 * radius * evaluate(app.kernels, 'cos', alpha);
    app.set({ b: Number(width.toPrecision(6)), h: Number(height.toPrecision(6)) }, { settled });
  };

  /** @type {Panel} */
  const panel = {
    name: 'spectrum',
    title: 'Rocking spectrum',
    uses: ['record', 'scale', 'b', 'h', 'r', 'rh', 'model', 'units', 'motions', 'run'],
    update(state, { settled }) {
      const shaken = shakenBy(app, state), { motion, block, scale, refused } = shaken;
      const own = ownPeriod();
      // Of one slenderness all sizes have one spectrum: dragging the size asks for nothing.
      const slender = few(block.alpha, 5);
      const key = [state.record, app.motions.length, scale, slender, block.restitution.toPrecision(5),
        block.nonlinear, ...ends(own).map((end) => few(end, 3))].join();
      if (refused) {
        app.pool.drop('spectrum:');
        [series, asked] = [null, ''];
      } else if (asked !== `${key} all` && asked !== `${key} ${settled ? 'all' : 'few'}`) {
        asked = `${key} ${settled ? 'all' : 'few'}`;
        const [from, to] = ends(own), ratio = to / from;
        const periods = Float64Array.from({ length: SPECTRUM_VALUES }, (_, k) =>
          from * ratio ** (k / (SPECTRUM_VALUES - 1)));
        const fresh = askFates(app, panel, 'recordSpectrum', { motion, block, scale }, periods, settled, () => {
          if (fresh.done >= SPECTRUM_VALUES / 8 || !series) series = fresh;
          tell();
          app.redraw(panel);
        });
        series ??= fresh;
      }
      tell();
    },
    draw(pen, size) {
      const { degrees } = shakenBy(app, app.state), own = ownPeriod(), [from, to] = ends(own);
      onto = drawPeaks(pen, size, {
        theme: app.theme, degrees, series, at: own, peak: app.shared.recordRun?.peak ?? null,
        x: { from, to, log: true, label: 'period 2π/p of blocks of this slenderness [s]' },
        label: `height ${few(app.state.h)} m`,
      });
    },
    sentence,
    table: () => fatesTable(app, 'period 2π/p [s]', series),
    keys(event) {
      const step = { ArrowLeft: 1 / SPECTRUM_STEP, ArrowRight: SPECTRUM_STEP }[event.key];
      if (!step) return false;
      resize(ownPeriod() * (event.shiftKey ? step ** 10 : step), true);
      return true;
    },
    placed: () => followPointer(app, panel, take),
  };
  return panel;

  /** @param {PointerEvent} event @param {boolean} settled */
  function take(event, settled) {
    if (!onto) return;
    const { box } = onto, pixel = Math.min(Math.max(event.offsetX, box.left), box.left + box.width);
    resize(onto.x.value(pixel), settled);
  }

  function tell() {
    const { refused } = shakenBy(app, app.state);
    if (refused) app.fail(panel, `No spectrum: ${refused}`, 'Choose another motion');
    else app.note(panel, sentence());
  }

  function sentence() {
    const { degrees, block } = shakenBy(app, app.state), own = ownPeriod();
    const part = series && series.done < SPECTRUM_VALUES
      ? `, ${Math.round((100 * series.done) / SPECTRUM_VALUES)} % computed` : '';
    const fell = series ? fallenOf(series) : 0;
    return `Rectangles of α = ${few(degrees)}° and restitution ${few(block.restitution)}: of `
      + `${SPECTRUM_VALUES} sizes ${fell} fall${part}. This block: 2π/p = ${few(own)} s. `
      + 'Drag to change its size.';
  }
}

/**
 * Return a table of fates: value, status, peak, impacts.
 * @param {App} app
 * @param {string} name  of the values
 * @param {FateSeries | null} series
 */
export function fatesTable(app, name, series) {
  const { values, status, peak, impacts } = series ?? { values: [], status: [], peak: [], impacts: [] };
  const known = (/** @type {ArrayLike<number>} */ some) => Array.from(some, (each) => (Number.isNaN(each) ? '' : each));
  return tableOf([name, values], ['status', Array.from(status, (code) => RUN_STATUS[code] ?? 'not computed')],
    [pageUnits(app, app.state, true).angle, known(peak), 'largest '], ['impacts', known(impacts)]);
}
