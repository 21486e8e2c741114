// Made by `python -m tools.aot.web` from the annotations of the kernels.
// Letters: f number, i integer, b truth value, c complex number; f2 an array of rank 2.

const Forcing = { kind: 'i', constant: 'f', slope: 'f', amplitude: 'f', frequency: 'f', beta: 'f', swing: 'f', rising: 'f', node_sine: 'f', node_cosine: 'f' };
const System = { positive: Forcing, negative: Forcing, frequency: 'f', restitution: ['f', 'f'], free: 'i', lean: ['f', 'f'], rate: ['f', 'f'], alpha: ['f', 'f'], amplitude: 'f', left_out: 'f' };
const Symmetric = { phase: 'f', sine: 'f', cosine: 'f', velocity: 'f', trace: 'f' };
const Section = { side: 'i', half_cycles: 'i', phase: 'f', speed: 'f' };
const Jacobian = { phase_by_phase: 'f', phase_by_speed: 'f', speed_by_phase: 'f', speed_by_speed: 'f' };
const Passage = { kind: 'i', state: Section, time: 'f', landing: 'f', jacobian: Jacobian };
const March = { side: 'i', angle: 'f', velocity: 'f', segment: 'i', half_cycles: 'i', phase: 'f', impacts: 'i', flights: 'i' };
const Fixed = { found: 'b', residual: 'f', jacobian: Jacobian, rests: 'i', grazes: 'i' };
const Settled = { outcome: 'i', state: Section, passages: 'i', periods: 'i', residual: 'f', rests: 'i', lyapunov: 'f', least: 'f', after: 'i', growth: 'f' };
const Half = { found: 'b', state: Section, jacobian: Jacobian };

export const signatures = {
  clock: { takes: ['f'], gives: ['i', 'f'] },
  fill_atan2: { takes: ['f1', 'f1', 'f1'], gives: null },
  fill_clocks: { takes: ['f1', 'i1', 'f1'], gives: null },
  fill_cos: { takes: ['f1', 'f1'], gives: null },
  fill_curves: { takes: ['f1', 'f1', 'i1', 'f2'], gives: null },
  fill_exp: { takes: ['f1', 'f1'], gives: null },
  fill_hypot: { takes: ['f1', 'f1', 'f1'], gives: null },
  fill_log: { takes: ['f1', 'f1'], gives: null },
  fill_log1p: { takes: ['f1', 'f1'], gives: null },
  fill_next_up: { takes: ['f1', 'f1'], gives: null },
  fill_peaks: { takes: [System, 'i', 'f2'], gives: null },
  fill_sin: { takes: ['f1', 'f1'], gives: null },
  fill_states: { takes: ['f2', 'f2', 'f2', 'i1', 'f1', 'f2'], gives: null },
  fill_steady: { takes: ['f1', 'f1', 'f1', 'i1', 'b', 'i1', 'f2', 'f2', 'f2', 'f2', 'f2', 'i2', 'b2'], gives: null },
  fill_tan: { takes: ['f1', 'f1'], gives: null },
  half_cycle_jacobian: { takes: ['f', 'f', 'f', 'i', Symmetric], gives: ['f', 'f', 'f', 'f'] },
  harmonic_segment: { takes: ['f2', 'f', 'f', 'f'], gives: null },
  highest_after: { takes: [System, Section, Passage], gives: ['f', 'f'] },
  is_nonlinear: { takes: ['f2'], gives: 'b' },
  is_symmetric: { takes: [System, 'f2', 'i', 'i'], gives: 'b' },
  lane_attractors: { takes: ['f1', 'f1', 'f1', 'i1', 'f1', 'f1', 'i1', 'f1', 'i', 'i2', 'f2'], gives: null },
  last_crossing: { takes: ['f2', 'f2', 'f2', 'f'], gives: ['i', 'f'] },
  loss: { takes: [System, 'i', 'i', 'i'], gives: 'f' },
  make_system: { takes: ['f', 'f', 'f2'], gives: System },
  march: { takes: ['f2', 'f2', March, 'i', 'f', 'f', 'i', 'f2', 'f1'], gives: ['i', March] },
  measured: { takes: [System, 'i', 'i', 'f2'], gives: Fixed },
  multipliers: { takes: [Jacobian, 'f'], gives: ['c', 'c'] },
  next_passage: { takes: [System, Section, 'f'], gives: Passage },
  peaks_until_overturning: { takes: ['f2', 'f2', 'f2'], gives: ['f', 'f', 'f'] },
  polish: { takes: [System, Section, 'i', 'i', 'f2'], gives: Fixed },
  pulse_fates: { takes: ['f2', 'f2', 'f1', 'f1', 'f', 'i', 'i1', 'i1', 'i1', 'i1', 'f1'], gives: null },
  record_fates: { takes: ['f2', 'f3', 'f1', 'i', 'i1', 'i1', 'f2'], gives: null },
  recorded_peaks: { takes: ['f2', 'f2', 'f2', 'f'], gives: ['f', 'f', 'f'] },
  segment_start: { takes: ['f2', 'i'], gives: ['i', 'f'] },
  settle: { takes: [System, 'i', 'i', 'f', 'f', 'f', 'i', 'f2', 'f2'], gives: Settled },
  settle_cells: { takes: ['f1', 'f1', 'f3', 'i1', 'f1', 'f1', 'i1', 'f1', 'i', 'i2', 'f2'], gives: null },
  symmetric_from: { takes: ['f', 'f', 'f2', 'i', 'i', Section], gives: Half },
  symmetric_orbit: { takes: ['f', 'f', 'f', 'i', 'i'], gives: Symmetric },
};
