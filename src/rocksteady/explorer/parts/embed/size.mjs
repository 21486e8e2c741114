// The scene size, alone.

import { pulseFates } from '../physics/demand/pulse.mjs';
import { makeSizes } from '../story/scenes/sizes.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('size', makeSizes, { pulseFates });
}
