// What the cells of the basins settle to: a plane, and labels that the pool gives its cells.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Case } from '../../physics/case.mjs' */
/** @import { BasinAttractor, Cells } from '../../physics/basins.mjs' */
/** @import { PlanePart } from '../plane/plane.mjs' */
/** @import { RasterOptions } from '../plane/raster.mjs' */
import { lookTiles } from '../../draw/classes.mjs';
import { START_WINDOW } from '../../kernels/window.mjs';
import { ATTRACTOR_KINDS } from '../../physics/attractor.mjs';
import { cellMiddles, emptyCells } from '../../physics/basins.mjs';
import { caseOf } from '../../shell/state.mjs';
import { makePlane } from '../plane/plane.mjs';
import { attractorLooks } from './looks.mjs';

/**
 * @typedef {object} BasinLabels
 * @property {Int16Array} label  of each cell; -1 where it is not computed
 * @property {BasinAttractor[]} attractors
 * @property {number} computed  number of cells that have a label
 * @property {Case} given
 */

const LABEL_EVERY = 120; // [ms]
const CELL_MS = { linear: 0.03, nonlinear: 0.3 }; // until it is measured
const UNDECIDED = ATTRACTOR_KINDS.indexOf('undecided');

/**
 * Return the plane of the basins, and what is known of its cells.
 * @param {App} app
 * @param {() => Panel} panelOf
 * @param {Pick<PlanePart & RasterOptions, 'axes' | 'point' | 'moved' | 'words' | 'hint' | 'tell'>} part
 */
export function makeBasinPlane(app, panelOf, part) {
  /** @type {BasinLabels | null} */
  let labels = null;
  /** The last labels, perhaps of another point or window. @type {BasinLabels | null} */
  let drawn = null;
  /** @type {Case} */
  let given;
  let serial = 0, labelling = false, labelled = 0, fault = '';
  const cells = () => /** @type {Cells} */ (/** @type {unknown} */ (plane.cells()));
  const plane = makePlane(app, panelOf, {
    name: 'basins',
    grid: START_WINDOW,
    steps: [8, 4, 2, 1],
    late: true,
    arrow: 1 / 200,
    empty: (count) => ({ ...emptyCells(count) }),
    values: ({ from, to }, count) => cellMiddles(from, to, count),
    look: (k) => labels?.label[k] ?? -1,
    tiles: (theme, ratio) => lookTiles(attractorLooks(theme, drawn?.attractors ?? [],
      app.state.safe === 1).map(({ look }) => look), ratio),
    undecided: (k) => cells().kind[k] === UNDECIDED,
    ready: () => labels !== null,
    begun() {
      serial += 1;
      given = caseOf(app.kernels, app.state);
      [labels, fault] = [null, ''];
    },
    noted() {
      if (!labelling) askLabels(serial).catch(failed);
    },
    work(state) {
      const block = caseOf(app.kernels, state), { alpha, nonlinear, ...shaken } = block;
      const cost = nonlinear ? 'nonlinear' : 'linear';
      return {
        job: 'settleStates', cost, ms: CELL_MS[cost],
        motion: [...Object.values(shaken), nonlinear ? alpha : 'linear'].join(' '),
        args: (angles, velocities) => ({ given: block, angles, velocities }),
      };
    },
    ...part,
  });

  /** Have the pool label the cells that are known. @param {number} own */
  async function askLabels(own) {
    labelling = true;
    await new Promise((resolve) => {
      setTimeout(resolve, Math.max(0, labelled + LABEL_EVERY - performance.now()));
    });
    labelled = performance.now();
    const computed = plane.progress().done;
    const found = own !== serial ? undefined : await app.pool.ask('labelStates',
      { given, cells: cells() }, { key: 'basins:labels', priority: -2 });
    labelling = false;
    if (own === serial && found) {
      labels = drawn = { ...found, computed, given };
      plane.repaint();
      part.tell();
      app.redraw(panelOf());
    }
    if (plane.progress().done > (labels?.computed ?? 0)) askLabels(serial).catch(failed);
  }

  /** @param {unknown} error */
  function failed(error) {
    labelling = false;
    fault = error instanceof Error ? error.message : String(error);
    part.tell();
  }

  return {
    plane,
    /** The labels of the present cells, and the last that there were. */
    labels: () => ({ labels, drawn, fault }),
    /** Return the attractor of a cell. @param {number} k @returns {BasinAttractor | undefined} */
    attractorOf: (k) => labels?.attractors[labels.label[k]],
  };
}
