// The Floquet multipliers of the orbit on the unit circle.

import { frame } from '../../draw/frame.mjs';
import { curve, drawMark, note, rule } from '../../draw/marks.mjs';
import { numeral } from '../../draw/scale.mjs';
import { FOLLOWED_KEYS, followIn, ghostsOf } from './followed.mjs';
import { motionClass } from './motions.mjs';
import { GHOST_ALPHAS } from './phase.mjs';
import { multiplierText } from './section.mjs';

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Followed } from './followed.mjs' */

const UNIT_CIRCLE = Array.from({ length: 121 }, (_, k) => (k * Math.PI) / 60);
const SHOWN_TO = 1.25;

/**
 * Make the panel of the multipliers.
 * @param {App} app
 * @returns {Panel}
 */
export function makeMultipliersPanel(app) {
  /** @type {Followed | null} */
  let followed = null;

  /** Solutions in closed form that are motions and not stable. */
  const unstable = () => (followed && !followed.given.nonlinear
    ? followed.steady.filter(({ worth }) => worth === 'unstable' || worth === 'neutral') : []);

  /** @type {Panel} */
  const panel = {
    name: 'multipliers',
    title: 'Floquet multipliers',
    uses: [...FOLLOWED_KEYS, 'history'],
    update(_state, { settled }) {
      followed = followIn(app, panel, settled);
    },
    draw(pen, size) {
      if (!followed) return;
      const { theme } = app, { attractor } = followed;
      const ticks = ['−1', '0', '1'].map((label, k) => ({ value: k - 1, label }));
      const onto = frame(pen, size, {
        theme, equal: true,
        x: { from: -SHOWN_TO, to: SHOWN_TO, label: 'real part', ticks },
        y: { from: -SHOWN_TO, to: SHOWN_TO, label: 'imaginary part', ticks },
      });
      rule(pen, onto, { x: 0 });
      rule(pen, onto, { y: 0 });
      curve(pen, onto, UNIT_CIRCLE.map(Math.cos), UNIT_CIRCLE.map(Math.sin),
        { colour: theme.limit, width: 1.2, dash: [6, 4] });
      const put = (/** @type {[number, number][]} */ pair, /** @type {any} */ mark,
        /** @type {any} */ style, alpha = 1) => {
        pen.save();
        pen.globalAlpha = alpha;
        for (const [real, imaginary] of pair) {
          if (Math.abs(real) > onto.x.to || Math.abs(imaginary) > onto.y.to) continue;
          drawMark(pen, mark, onto.x.at(real), onto.y.at(imaginary), style);
        }
        pen.restore();
      };
      ghostsOf(app.shared).forEach((ghost, k) => {
        const pair = ghost.attractor.orbit?.multipliers;
        if (pair) put(pair, 'dot', { colour: theme.quiet, radius: 4 }, GHOST_ALPHAS[k]);
      });
      for (const { multipliers } of unstable()) {
        put(multipliers, 'cross', { colour: theme.motion, radius: 4 });
        if (Math.abs(multipliers[0][0]) > onto.x.to) drawBeyond(pen, onto, multipliers[0][0]);
      }
      const { orbit } = attractor, { box } = onto;
      const say = (/** @type {string} */ text) =>
        note(pen, onto, text, box.left + 4, box.top + 10, { align: 'left' });
      if (orbit) {
        put(orbit.multipliers, 'dot', { colour: theme.motion, radius: 5, casing: theme.paper });
        say(`largest |m| = ${numeral(orbit.largest, 3)}`);
      } else say(`${theme.words[motionClass(attractor)]}: no orbit`);
      const [first] = unstable();
      if (first) {
        const values = first.multipliers.map(multiplierText).join(', ');
        ['× unstable orbit', values].forEach((text, k) => {
          const level = box.top + box.height - 24 + 15 * k;
          note(pen, onto, text, box.left + 4, level, { align: 'left' });
        });
      }
    },
    sentence() {
      const orbit = followed?.attractor.orbit;
      if (!orbit) return 'No periodic orbit, so no Floquet multipliers.';
      const [first, second] = orbit.multipliers.map(multiplierText);
      const inside = orbit.largest < 1 ? 'inside the unit circle: the orbit is stable'
        : 'not inside the unit circle';
      return `Floquet multipliers ${first} and ${second}, ${inside}.`;
    },
    table() {
      const rows = [];
      const orbit = followed?.attractor.orbit;
      for (const [real, imaginary] of orbit?.multipliers ?? []) {
        rows.push(['attractor', real, imaginary]);
      }
      for (const { branch, multipliers } of unstable()) {
        for (const pair of multipliers) rows.push([`unstable branch ${branch}`, ...pair]);
      }
      return { columns: ['orbit', 'real part', 'imaginary part'], rows };
    },
  };
  return panel;
}

/**
 * Point to a multiplier outside the box.
 * @param {CanvasRenderingContext2D} pen
 * @param {Frame} onto
 * @param {number} real
 */
function drawBeyond(pen, { box, y, theme }, real) {
  const side = Math.sign(real), level = y.at(0);
  const tip = side > 0 ? box.left + box.width - 2 : box.left + 2;
  pen.save();
  pen.fillStyle = theme.motion;
  pen.beginPath();
  pen.moveTo(tip, level);
  pen.lineTo(tip - 9 * side, level - 5);
  pen.lineTo(tip - 9 * side, level + 5);
  pen.fill();
  pen.restore();
}
