// Ground motions that Python has put into the page.

/** @import { PutIn } from './app.mjs' */

/**
 * Return the ground motions of their block, samples as 64-bit numbers to the last bit.
 * @param {string} text  JSON; the samples are base64, the low byte first
 * @returns {PutIn[]}
 */
export function motionsPutIn(text) {
  /** @type {{ name: string, dt: number, note: string, samples: string }[]} */
  const found = JSON.parse(text);
  return found.map(({ name, dt, note, samples }) => {
    const bytes = Uint8Array.from(atob(samples), (letter) => letter.charCodeAt(0));
    return { name, dt, note, acceleration: new Float64Array(bytes.buffer) };
  });
}
