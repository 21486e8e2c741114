// Which panel stands in which tab: one line a panel.

/** @import { App } from './app.mjs' */
import { makeBasinsPanel } from '../panels/basins/basins.mjs';
import { makeBlockPanel } from '../panels/block.mjs';
import { makeFilmPanel } from '../panels/film.mjs';
import { makeHistoryPanel } from '../panels/point/history.mjs';
import { makeMultipliersPanel } from '../panels/point/multipliers.mjs';
import { makePhasePanel } from '../panels/point/phase.mjs';
import { makeReadoutPanel } from '../panels/point/readout.mjs';
import { makeSectionPanel } from '../panels/point/section.mjs';
import { makeStripPanel } from '../panels/strip.mjs';
import { makeDesignPanel } from '../panels/demand/design.mjs';
import { makeDesignedPanel } from '../panels/demand/designed.mjs';
import { makePulsePanel } from '../panels/demand/pulse.mjs';
import { makePulseHistoryPanel } from '../panels/demand/pulsehistory.mjs';
import { makeMapPanel } from '../panels/map/map.mjs';
import { makeQuakePanel } from '../panels/quake/quake.mjs';
import { makeSpectrumPanel } from '../panels/quake/spectrum.mjs';
import { makeVerdictPanel } from '../panels/quake/verdict.mjs';
import { place } from './layout.mjs';

/**
 * Make all panels and put them on the page.
 * @param {App} app
 * @param {() => Promise<void>} turn  lets the browser do what waits
 */
export async function placePanels(app, turn) {
  place(app, makeReadoutPanel(app), ['explore', 'basins']);
  place(app, makeFilmPanel(app), ['explore', 'basins']);
  place(app, makeBlockPanel(app), ['pulse', 'quake', 'design']);
  place(app, makeMapPanel(app), ['explore']);
  place(app, makeBasinsPanel(app), ['basins']);
  await turn();
  place(app, makeHistoryPanel(app), ['explore', 'basins']);
  place(app, makePhasePanel(app), ['explore', 'basins']);
  place(app, makeSectionPanel(app), ['explore']);
  place(app, makeStripPanel(app), ['explore']);
  place(app, makeMultipliersPanel(app), ['explore']);
  await turn();
  place(app, makePulsePanel(app), ['pulse']);
  place(app, makePulseHistoryPanel(app), ['pulse']);
  place(app, makeQuakePanel(app), ['quake']);
  place(app, makeVerdictPanel(app), ['quake']);
  place(app, makeSpectrumPanel(app), ['quake']);
  place(app, makeDesignPanel(app), ['design']);
  place(app, makeDesignedPanel(app), ['design']);
}
