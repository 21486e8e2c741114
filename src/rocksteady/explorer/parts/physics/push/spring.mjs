// The ground under a hand: a heavy table that a critically damped spring ties to the hand.

/**
 * The ground, which moves along straight lines of acceleration from sample to sample.
 * @typedef {object} Ground
 * @property {number} place  [m]
 * @property {number} speed  [m/s]
 * @property {number} push  acceleration [m/s2]
 */

export const SPRING = 11; // [rad/s]; the ground trails the hand by 2/SPRING
export const MOST_PUSH = 1.2 * 9.80665; // [m/s2]
export const PUSH_STEP = 1 / 480; // [s] between samples

/** The ground at rest. @type {Ground} */
export const STILL_GROUND = Object.freeze({ place: 0, speed: 0, push: 0 });

/**
 * Return the ground one sample later: its acceleration there is w^2 (hand - x) - 2 w x', cut off at
 * MOST_PUSH, and its place and speed are the integrals of the line up to it.
 * @param {Ground} ground
 * @param {number} hand  where the hand then is [m]
 * @returns {Ground}
 */
export function pulledGround({ place, speed, push }, hand) {
  const w = SPRING, h = PUSH_STEP;
  // Without the share of the new acceleration, which is solved for.
  const drift = place + h * (speed + (h * push) / 3), pace = speed + 0.5 * h * push;
  const wanted = (w * w * (hand - drift) - 2 * w * pace) / (1 + w * h * (1 + (w * h) / 6));
  const next = Math.min(MOST_PUSH, Math.max(-MOST_PUSH, wanted));
  return { place: drift + (h * h * next) / 6, speed: pace + 0.5 * h * next, push: next };
}

/**
 * Where a hand was, from its events: along straight lines between them, and still after the last.
 * @param {{ time: number, place: number }[]} events  in order; those no longer needed are taken out
 * @param {number} time
 */
export function handAt(events, time) {
  while (events.length > 1 && events[1].time <= time) events.shift();
  const [from, to] = events;
  if (!to || time <= from.time) return from.place;
  return from.place + ((time - from.time) / (to.time - from.time)) * (to.place - from.place);
}
