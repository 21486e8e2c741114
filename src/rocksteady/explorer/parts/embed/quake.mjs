// The scene quake, alone.

import { crowdReels } from '../physics/story/crowd.mjs';
import { makeCrowd } from '../story/scenes/crowd.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('quake', makeCrowd, { crowdReels });
}
