// One short knock an impact, made here; silent until it is asked for.

const LONG = 0.11; // [s]

/** @type {AudioContext | null} */
let speaker = null;

/** Turn the sound on or off; return whether it is on. */
export function turnSound() {
  if (speaker) {
    speaker.close();
    speaker = null;
  } else speaker = new AudioContext();
  return speaker !== null;
}

/** Return whether impacts are heard. */
export function heard() {
  return speaker !== null;
}

/**
 * Sound an impact.
 * @param {number} speed  du/d(pt) before it
 */
export function knock(speed) {
  if (!speaker) return;
  const now = speaker.currentTime, tone = speaker.createOscillator(), level = speaker.createGain();
  tone.frequency.setValueAtTime(190, now);
  tone.frequency.exponentialRampToValueAtTime(70, now + 0.07);
  level.gain.setValueAtTime(Math.min(0.5, 0.05 + 0.4 * speed), now);
  level.gain.exponentialRampToValueAtTime(0.001, now + LONG);
  tone.connect(level).connect(speaker.destination);
  tone.start(now);
  tone.stop(now + LONG);
}
