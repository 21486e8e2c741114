// The block and the shaking of a scene, as the laboratory has them.

/** @import { App } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
import { GRAVITY } from '../physics/case.mjs';
import { peakOf } from '../physics/quake/record.mjs';
import { syntheticMotion } from '../physics/quake/synthetic.mjs';
import { FATE_SHAKING } from '../physics/story/fates.mjs';
import { ORDER_RATIO, ORDER_RESTITUTION } from '../physics/story/order.mjs';
import { pulseNumbers, rectangle } from '../physics/story/pulses.mjs';
import { CABINET } from './scenes/crowd.mjs';
import { HEIGHTS, SIZES_STRENGTH, SLIM } from './scenes/sizes.mjs';
import { WAYS } from './scenes/ways.mjs';

/**
 * Return what of the state a scene sets.
 * @param {App} app
 * @param {string} scene
 * @returns {Partial<State>}
 */
export function labState(app, scene) {
  const { kernels, state } = app, si = { units: /** @type {const} */ ('si') };
  /** @param {number} width @param {number} height @param {number | undefined} restitution
   * @param {number} strength @param {number} frequency */
  const pulse = (width, height, restitution, strength, frequency, tab = 'shake') => {
    const block = rectangle(kernels, width, height, restitution);
    const { amplitude, ratio } = pulseNumbers(block, strength, frequency);
    return {
      ...si, tab, kind: 'push', model: /** @type {const} */ ('nonlinear'), b: width, h: height,
      r: block.restitution, rh: restitution === undefined ? 1 : 0, pA: amplitude, pW: ratio,
    };
  };
  switch (scene) {
    case 'swing':
      return {
        ...si, tab: 'start', ground: 'still', model: 'nonlinear', b: 0.3, h: 1, rh: 1, start: `${state.tilt},0`,
      };
    case 'size': return pulse(HEIGHTS[1] / SLIM, HEIGHTS[1], undefined, SIZES_STRENGTH, 1 / state.length, 'size');
    case 'fall': return pulse(WAYS.width, WAYS.height, WAYS.restitution, state.strength, WAYS.frequency);
    case 'fates':
      return {
        ...si, tab: 'start', ground: 'shaken', model: 'linear', b: 0.3, h: 1, rh: 0, r: FATE_SHAKING.restitution,
        A: FATE_SHAKING.amplitude, W: FATE_SHAKING.frequencyRatio, start: `${state.su},${state.sv}`,
      };
    case 'order':
      return {
        ...si, tab: 'explore', model: 'linear', b: 0.5, h: 2, rh: 0, r: ORDER_RESTITUTION, A: state.shake,
        W: ORDER_RATIO, by: 'a', start: 'steady', a0: 0, a1: 4,
      };
    default: {
      const scale = (state.pga * GRAVITY) / peakOf(syntheticMotion());
      return {
        ...si, tab: 'quake', model: 'nonlinear', b: CABINET.width, h: CABINET.height, rh: 1,
        record: app.motions.length, scale: Number(scale.toFixed(4)),
      };
    }
  }
}
