// The scene fates, alone.

import { stateFates } from '../physics/story/fates.mjs';
import { makeFates } from '../story/scenes/fates.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('fates', makeFates, { stateFates });
}
