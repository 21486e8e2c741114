// Made by `python -m tools.aot.web` from the annotations of the kernels.
// Letters: f number, i integer, b truth value, c complex number; f2 an array of rank 2.

const Tables = { segments: 'f2', sides: 'f2' };
const Forcing = { kind: 'i', constant: 'f', slope: 'f', amplitude: 'f', frequency: 'f', beta: 'f', swing: 'f', rising: 'f', node_sine: 'f', node_cosine: 'f' };
const System = { positive: Forcing, negative: Forcing, frequency: 'f', restitution: ['f', 'f'], free: 'i', lean: ['f', 'f'], rate: ['f', 'f'], alpha: ['f', 'f'], amplitude: 'f', left_out: 'f' };
const PulseNumbers = { form: 'i', pieces: 'f2', amplitude: 'f', frequency_ratio: 'f', tolerance: 'f', reach: 'f', oscillations: 'f', phase: 'f', peak: 'f' };
const Points = { amplitude: 'f1', frequency_ratio: 'f1', restitution: 'f1', order: 'i1' };
const Steady = { region: 'i1', boundaries: 'f2', phase: 'f2', velocity: 'f2', trace: 'f2', peak: 'f2', extrema: 'i2', admissible: 'b2' };
const Symmetric = { phase: 'f', sine: 'f', cosine: 'f', velocity: 'f', trace: 'f' };
const Section = { side: 'i', half_cycles: 'i', phase: 'f', speed: 'f' };
const Jacobian = { phase_by_phase: 'f', phase_by_speed: 'f', speed_by_phase: 'f', speed_by_speed: 'f' };
const Passage = { kind: 'i', state: Section, time: 'f', landing: 'f', jacobian: Jacobian };
const SymmetricCells = { amplitude: 'f1', frequency_ratio: 'f1', restitution: 'f1' };
const States = { side: 'i1', angle: 'f1', velocity: 'f1', half_cycles: 'i1', phase: 'f1' };
const Outcomes = { whole: 'i2', real: 'f2' };
const March = { side: 'i', angle: 'f', velocity: 'f', segment: 'i', half_cycles: 'i', phase: 'f', impacts: 'i', flights: 'i' };
const Until = { half_cycles: 'i', phase: 'f', rest_velocity: 'f', limit: 'i' };
const Kept = { rows: 'f2', peaks: 'f1' };
const Fixed = { found: 'b', residual: 'f', jacobian: Jacobian, rests: 'i', grazes: 'i' };
const PulseFates = { status: 'i1', impacts: 'i1', side: 'i1', during: 'i1', margin: 'f1' };
const Blocks = { sides: 'f3', afterwards: 'f1' };
const PeakFates = { status: 'i1', impacts: 'i1', peaks: 'f2' };
const RunFacts = { last: 'f', end: 'f', passing: 'i', since: 'f', overturned: 'f', rested: 'f', peaks: ['f', 'f', 'f'] };
const AnyState = { side: 'i', half_cycles: 'i', phase: 'f', angle: 'f', velocity: 'f' };
const Settled = { outcome: 'i', state: Section, passages: 'i', periods: 'i', residual: 'f', rests: 'i', lyapunov: 'f', least: 'f', after: 'i', growth: 'f' };
const Cells = { amplitude: 'f1', frequency_ratio: 'f1', sides: 'f3' };
const Half = { found: 'b', state: Section, jacobian: Jacobian };

export const signatures = {
  clock: { takes: ['f'], gives: ['i', 'f'] },
  fill_atan2: { takes: ['f1', 'f1', 'f1'], gives: null },
  fill_bounds: { takes: ['f2'], gives: null },
  fill_clocks: { takes: ['f1', 'i1', 'f1'], gives: null },
  fill_cos: { takes: ['f1', 'f1'], gives: null },
  fill_curves: { takes: ['f1', 'f1', 'i1', 'f2'], gives: null },
  fill_exp: { takes: ['f1', 'f1'], gives: null },
  fill_hypot: { takes: ['f1', 'f1', 'f1'], gives: null },
  fill_landings: { takes: [Tables, 'f2', 'f1', 'f2'], gives: 'i' },
  fill_lines: { takes: ['f1', 'f', 'f2'], gives: null },
  fill_log: { takes: ['f1', 'f1'], gives: null },
  fill_log1p: { takes: ['f1', 'f1'], gives: null },
  fill_next_up: { takes: ['f1', 'f1'], gives: null },
  fill_peaks: { takes: [System, 'i', 'f2'], gives: null },
  fill_pulse: { takes: [PulseNumbers, 'f2'], gives: ['i', 'f'] },
  fill_sin: { takes: ['f1', 'f1'], gives: null },
  fill_states: { takes: ['f2', 'f2', 'f2', 'i1', 'f1', 'f2'], gives: null },
  fill_steady: { takes: [Points, 'b', Steady], gives: null },
  fill_tan: { takes: ['f1', 'f1'], gives: null },
  half_cycle_jacobian: { takes: ['f', 'f', 'f', 'i', Symmetric], gives: ['f', 'f', 'f', 'f'] },
  harmonic_segment: { takes: ['f2', 'f', 'f', 'f'], gives: null },
  highest_after: { takes: [System, Section, Passage], gives: ['f', 'f'] },
  is_symmetric: { takes: [System, 'f2', 'i', 'i'], gives: 'b' },
  lane_attractors: { takes: [SymmetricCells, States, 'i', Outcomes], gives: null },
  loss: { takes: [System, 'i', 'i', 'i'], gives: 'f' },
  make_system: { takes: ['f', 'f', 'f2'], gives: System },
  march: { takes: [Tables, March, Until, Kept], gives: ['i', March] },
  measured: { takes: [System, 'i', 'i', 'f2'], gives: Fixed },
  multipliers: { takes: [Jacobian, 'f'], gives: ['c', 'c'] },
  next_passage: { takes: [System, Section, 'f'], gives: Passage },
  polish: { takes: [System, Section, 'i', 'i', 'f2'], gives: Fixed },
  pulse_fates: { takes: [Tables, 'f1', 'f1', 'f', 'i', PulseFates], gives: null },
  record_fates: { takes: ['f2', Blocks, 'i', PeakFates], gives: null },
  run_end: { takes: [Tables, 'f'], gives: ['i', 'f'] },
  run_facts: { takes: [Tables, 'f2', 'i', 'f1'], gives: RunFacts },
  segment_start: { takes: ['f2', 'i'], gives: ['i', 'f'] },
  settle: { takes: [System, AnyState, 'i', 'f2', 'f2'], gives: Settled },
  settle_cells: { takes: [Cells, States, 'i', Outcomes], gives: null },
  symmetric_from: { takes: ['f', 'f', 'f2', 'i', 'i', Section], gives: Half },
  symmetric_orbit: { takes: ['f', 'f', 'f', 'i', 'i'], gives: Symmetric },
};
