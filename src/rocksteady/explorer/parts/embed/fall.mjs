// The scene fall, alone.

import { pulseFates } from '../physics/demand/pulse.mjs';
import { makeWays } from '../story/scenes/ways.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('fall', makeWays, { pulseFates });
}
