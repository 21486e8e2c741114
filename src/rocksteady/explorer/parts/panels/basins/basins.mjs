// Basins of attraction: what each initial state of a window settles to; one state is dragged.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
import { numeral } from '../../draw/scale.mjs';
import { blockNumbers, isWhole, startOf } from '../../shell/state.mjs';
import { tableOf } from '../../shell/tables.mjs';
import { shakingWords } from '../../shell/units.mjs';
import { NEVER_LIFTS, motionName, motionWords, shareWords } from '../../words.mjs';
import { buttonEntry } from '../entries.mjs';
import { axisOf } from '../plane/axis.mjs';
import { FOLLOWED_KEYS, followedOf } from '../point/followed.mjs';
import { panelUnits } from '../point/units.mjs';
import { makeBasinPlane } from './cells.mjs';
import { makeBasinPicture } from './picture.mjs';

const BASIN_KEYS = /** @type {const} */ ({ x: ['u0', 'u1'], y: ['v0', 'v1'] });

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeBasinsPanel(app) {
  const { plane, labels, attractorOf } = makeBasinPlane(app, () => panel, {
    axes(state) {
      const { startAngle, startVelocity } = unitsOf(state);
      return {
        x: axisOf(state, BASIN_KEYS.x, startAngle),
        y: axisOf(state, BASIN_KEYS.y, startVelocity),
      };
    },
    point(state) {
      const start = startOf(state);
      return start.kind === 'state' ? { x: start.angle, y: start.velocity } : { x: 0, y: 0 };
    },
    moved: ({ x, y }) => ({ start: `${x},${y}` }),
    words({ x, y }, cell) {
      const attractor = cell && attractorOf(cell.at);
      return [placeText(x, y), attractor ? motionName(attractor) : 'not computed'];
    },
    hint: 'drag: initial state',
    tell: () => tell(),
  });
  const picture = makeBasinPicture(app);
  /** @type {Map<string, HTMLButtonElement>} */
  const choices = new Map();

  /** @type {Panel} */
  const panel = {
    name: 'basins',
    title: 'Basins of attraction',
    uses: ['safe', ...FOLLOWED_KEYS, ...BASIN_KEYS.x, ...BASIN_KEYS.y],
    update(state, { settled }) {
      choices.forEach((button, safe) =>
        button.setAttribute('aria-pressed', String(safe === String(state.safe))));
      plane.update(state, settled);
      followedOf(app, settled);
      tell();
      if (settled) app.say(stateText());
    },
    draw(pen, size) {
      const { followed, error } = followedOf(app, false), { state } = app;
      picture.draw(pen, size, {
        plane, drawn: labels().drawn, units: unitsOf(state), axes: plane.handle.axes(),
        safe: state.safe === 1, start: startOf(state), followed: error ? null : followed,
      });
    },
    sentence,
    table,
    keys: (event) => plane.keys(event),
    placed,
  };
  return panel;

  /** @param {State} state */
  function unitsOf(state) {
    return panelUnits(app, blockNumbers(app.kernels, state));
  }

  function tell() {
    const { fault } = labels(), far = plane.words();
    if (fault) {
      app.fail(panel, `The basins could not be computed: ${fault}`, 'Move the point to try again');
    } else if (far !== null) app.note(panel, `${progressText(far)}${stateText()}`);
  }

  /** @param {string} far */
  function progressText(far) {
    if (plane.isOther()) return 'Basins of another point, dimmed. ';
    const total = plane.task() ? plane.nearestCells().length : Infinity;
    if (labels().labels?.computed === total) return '';
    return `${far ? `${far[0].toUpperCase()}${far.slice(1)}` : 'Refining 99 %'}. `;
  }

  /** The sentence of the panel: what becomes of the state, and the share of the map. */
  function stateText() {
    const share = shareText(), start = startOf(app.state), further = share && `; ${share}`;
    if (start.kind !== 'state' && start.kind !== 'rest') {
      return `Drag in the plane to choose an initial state${further}.`;
    }
    const { followed } = followedOf(app, false);
    const { angle = 0, velocity = 0 } = start.kind === 'state' ? start : {};
    if (!followed) return share && `${share}.`;
    const { attractor, history } = followed, { orbit } = attractor;
    const { factor, unit } = unitsOf(app.state).angle;
    const from = start.kind === 'rest' ? 'From rest' : `From ${placeText(angle, velocity)}`;
    if (!orbit) {
      const still = attractor.kind === 'rest' && history.restTime === 0 && start.kind === 'rest';
      return `${from} it ${still ? NEVER_LIFTS : motionWords(attractor)}${further}.`;
    }
    const [high, low] = [orbit.highest, orbit.lowest].map((u) => numeral(u * factor, 3));
    return `${from} it ${motionWords(attractor)}, `
      + `peaks ${high} and ${low}${unit === '°' ? '' : ' '}${unit}${further}.`;
  }

  /** The share of the map that falls, once all of its cells are shown; none of another window. */
  function shareText() {
    const { labels: known } = labels();
    if (!known || plane.isOther() || known.computed < known.label.length || !isWhole(app.state)) return '';
    const falls = known.attractors.find(({ kind }) => kind === 'overturned')?.states ?? 0;
    return shareWords(falls, known.computed);
  }

  /** @param {number} u @param {number} v */
  function placeText(u, v) {
    const { angle, velocity, si } = unitsOf(app.state);
    const [along, up] = [numeral(u * angle.factor, 4), numeral(v * velocity.factor, 4)];
    return si ? `${along}°, ${up} °/s` : `θ/α = ${along}, velocity ${up}`;
  }

  function sentence() {
    const { state } = app, known = labels().labels;
    if (!known) {
      return `The basins at ${shakingWords(unitsOf(state), state)} are not computed yet.`;
    }
    const names = [...new Set(known.attractors.map(motionName))].join('; ');
    return `What ${known.computed} initial states come to at phase 0, `
      + `${shakingWords(unitsOf(state), state)}: ${names}. ${stateText()}`;
  }

  function table() {
    const { angle } = unitsOf(app.state), { attractors } = labels().labels ?? { attractors: [] };
    const orbits = attractors.map(({ orbit }) => orbit), states = attractors.map((each) => each.states);
    return tableOf(['attractor', attractors.map(({ name }) => name)],
      ['states', states],
      ['period [forcing periods]', orbits.map((orbit) => orbit?.period ?? '')],
      [angle, orbits.map((orbit) => orbit?.highest ?? ''), 'highest '],
      [angle, orbits.map((orbit) => orbit?.lowest ?? ''), 'lowest ']);
  }

  function placed() {
    for (const [safe, text, title] of [
      ['0', 'motions', 'One fill for each motion'],
      ['1', 'safe basin', 'The states that never fall'],
    ]) choices.set(safe, buttonEntry(text, title, () => app.set({ safe })));
    panel.bar?.append(...choices.values(), ...plane.buttons());
    plane.listen();
  }
}
