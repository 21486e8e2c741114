// Made by `python -m tools.aot.web` from the annotations of the kernels.
// Letters: f number, i integer, b truth value, c complex number; f2 an array of rank 2.

const Cells = { amplitude: 'f1', frequency_ratio: 'f1', sides: 'f3' };
const Starts = { angle: 'f1', velocity: 'f1', phase: 'f1' };
const Fates = { status: 'i1', impacts: 'i1', final: 'f2' };
const SeriesCells = { amplitude: 'f1', frequency_ratio: 'f1', shares: 'f1', sides: 'f3' };
const States = { side: 'i1', angle: 'f1', velocity: 'f1', half_cycles: 'i1', phase: 'f1' };
const Outcomes = { whole: 'i2', real: 'f2' };
const SymmetricCells = { amplitude: 'f1', frequency_ratio: 'f1', restitution: 'f1' };
const Blocks = { sides: 'f3', afterwards: 'f1' };
const PeakFates = { status: 'i1', impacts: 'i1', peaks: 'f2' };
const Tables = { segments: 'f2', sides: 'f2' };
const PulseFates = { status: 'i1', impacts: 'i1', side: 'i1', during: 'i1', margin: 'f1' };
const March = { side: 'i', angle: 'f', velocity: 'f', segment: 'i', half_cycles: 'i', phase: 'f', impacts: 'i', flights: 'i' };
const Until = { half_cycles: 'i', phase: 'f', rest_velocity: 'f', limit: 'i' };
const Kept = { rows: 'f2', peaks: 'f1' };
const RunFacts = { last: 'f', end: 'f', passing: 'i', since: 'f', overturned: 'f', rested: 'f', peaks: ['f', 'f', 'f'] };
const PulseNumbers = { form: 'i', pieces: 'f2', amplitude: 'f', frequency_ratio: 'f', tolerance: 'f', reach: 'f', oscillations: 'f', phase: 'f', peak: 'f' };
const Points = { amplitude: 'f1', frequency_ratio: 'f1', restitution: 'f1', order: 'i1' };
const Steady = { region: 'i1', boundaries: 'f2', phase: 'f2', velocity: 'f2', trace: 'f2', peak: 'f2', extrema: 'i2', admissible: 'b2' };
const Symmetric = { phase: 'f', sine: 'f', cosine: 'f', velocity: 'f', trace: 'f' };
const Section = { side: 'i', half_cycles: 'i', phase: 'f', speed: 'f' };
const Jacobian = { phase_by_phase: 'f', phase_by_speed: 'f', speed_by_phase: 'f', speed_by_speed: 'f' };
const Half = { found: 'b', state: Section, jacobian: Jacobian };
const Forcing = { kind: 'i', constant: 'f', slope: 'f', amplitude: 'f', frequency: 'f', beta: 'f', swing: 'f', rising: 'f', node_sine: 'f', node_cosine: 'f' };
const System = { positive: Forcing, negative: Forcing, frequency: 'f', restitution: ['f', 'f'], free: 'i', lean: ['f', 'f'], rate: ['f', 'f'], alpha: ['f', 'f'], amplitude: 'f', left_out: 'f' };
const Passage = { kind: 'i', state: Section, time: 'f', landing: 'f', jacobian: Jacobian };
const AnyState = { side: 'i', half_cycles: 'i', phase: 'f', angle: 'f', velocity: 'f' };
const Settled = { outcome: 'i', state: Section, passages: 'i', periods: 'i', residual: 'f', rests: 'i', lyapunov: 'f', least: 'f', after: 'i', growth: 'f' };
const Stretch = { phase: 'f', speed: 'f', logarithm: 'f', since: 'i' };
const Sought = { phases: 'f1', speeds: 'f1', most_passages: 'i', most_periods: 'i', mirrors: 'b' };
const Orbits = { states: 'f2', shape: 'i2' };
const Fixed = { found: 'b', residual: 'f', jacobian: Jacobian, rests: 'i', grazes: 'i' };
const SeriesSystem = { positive: Forcing, negative: Forcing, frequency: 'f', restitution: ['f', 'f'], free: 'i', lean: ['f', 'f'], rate: ['f', 'f'], alpha: ['f', 'f'], amplitude: 'f', left_out: 'f', shares: 'f1', lifts: 'f2' };

export const signatures = {
  fates_of_sides: { takes: [Cells, Starts, 'i', 'i', Fates], gives: null },
  series_fates: { takes: [SeriesCells, Starts, 'i', 'i', Fates], gives: null },
  lane_fates: { takes: [Cells, Starts, 'i', 'b', 'i', Fates], gives: null },
  nonlinear_lane_fates: { takes: [Cells, Starts, 'i', 'b', 'i', Fates], gives: null },
  settle_cells: { takes: [Cells, States, 'i', Outcomes], gives: null },
  settle_series_cells: { takes: [SeriesCells, States, 'i', Outcomes], gives: null },
  lane_attractors: { takes: [SymmetricCells, States, 'i', Outcomes], gives: null },
  nonlinear_lane_attractors: { takes: [Cells, States, 'i', Outcomes], gives: null },
  fill_clocks: { takes: ['f1', 'i1', 'f1'], gives: null },
  record_fates: { takes: ['f2', Blocks, 'i', PeakFates], gives: null },
  record_forces: { takes: ['f2', Blocks, 'f3', 'i', 'f2'], gives: null },
  fill_hardest: { takes: ['f2', 'b', 'f1'], gives: null },
  pulse_fates: { takes: [Tables, 'f1', 'f1', 'f', 'i', PulseFates], gives: null },
  harmonic_segment: { takes: ['f2', 'f', 'f', 'f'], gives: null },
  fill_oscillator: { takes: ['f1', 'f2', 'f2'], gives: null },
  fill_largest: { takes: ['f1', 'f2', 'f', ['f', 'f'], 'f1'], gives: null },
  march: { takes: [Tables, March, Until, Kept], gives: ['i', March] },
  fill_states: { takes: ['f2', 'f2', 'f2', 'i1', 'f1', 'f2'], gives: null },
  last_crossing: { takes: ['f2', 'f2', 'f2', 'f'], gives: ['i', 'f'] },
  peaks_until_overturning: { takes: ['f2', 'f2', 'f2'], gives: ['f', 'f', 'f'] },
  recorded_peaks: { takes: ['f2', 'f2', 'f2', 'f'], gives: ['f', 'f', 'f'] },
  run_end: { takes: [Tables, 'f'], gives: ['i', 'f'] },
  run_facts: { takes: [Tables, 'f2', 'i', 'f1'], gives: RunFacts },
  fill_landings: { takes: [Tables, 'f2', 'f1', 'f2'], gives: 'i' },
  largest_forces: { takes: [Tables, 'f2', 'f', 'f2', 'f1'], gives: null },
  clock: { takes: ['f'], gives: ['i', 'f'] },
  segment_start: { takes: ['f2', 'i'], gives: ['i', 'f'] },
  is_nonlinear: { takes: ['f2'], gives: 'b' },
  jump_share: { takes: ['f2', 'i', 'f'], gives: 'f' },
  fill_pulse: { takes: [PulseNumbers, 'f2'], gives: ['i', 'f'] },
  fill_lines: { takes: ['f1', 'f', 'f2'], gives: null },
  fill_bounds: { takes: ['f2'], gives: null },
  ricker_at: { takes: ['b', 'f'], gives: 'f' },
  fill_steady: { takes: [Points, 'b', Steady], gives: null },
  fill_curves: { takes: ['f1', 'f1', 'i1', 'f2'], gives: null },
  fill_half_cycle: { takes: ['f', 'f', 'i', Symmetric, 'f1', 'f2'], gives: null },
  half_cycle_jacobian: { takes: ['f', 'f', 'f', 'i', Symmetric], gives: ['f', 'f', 'f', 'f'] },
  symmetric_orbit: { takes: ['f', 'f', 'f', 'i', 'i'], gives: Symmetric },
  symmetric_from: { takes: ['f', 'f', 'f2', 'i', 'i', Section], gives: Half },
  symmetry_breaking: { takes: ['f', 'f', 'i'], gives: 'f' },
  make_system: { takes: ['f', 'f', 'f2'], gives: System },
  fill_uplifts: { takes: [System, 'f1', 'f2'], gives: null },
  next_passage: { takes: [System, Section, 'f'], gives: Passage },
  uplift_after: { takes: [System, 'i', 'f'], gives: Passage },
  chatter_end: { takes: [System, Section, Section], gives: ['f', 'f', 'i'] },
  guess_after: { takes: [Passage], gives: 'f' },
  highest_after: { takes: [System, Section, Passage], gives: ['f', 'f'] },
  phase_between: { takes: [Section, Section], gives: 'f' },
  settle: { takes: [System, AnyState, 'i', 'f2', 'f2'], gives: Settled },
  stretched: { takes: [Stretch, Jacobian], gives: Stretch },
  search: { takes: [System, Sought, 'f2', Orbits, 'i'], gives: 'i' },
  polish: { takes: [System, Section, 'i', 'i', 'f2'], gives: Fixed },
  measured: { takes: [System, 'i', 'i', 'f2'], gives: Fixed },
  multipliers: { takes: [Jacobian, 'f'], gives: ['c', 'c'] },
  loss: { takes: [System, 'i', 'i', 'i'], gives: 'f' },
  fill_peaks: { takes: [System, 'i', 'f2'], gives: null },
  is_symmetric: { takes: [System, 'f2', 'i', 'i'], gives: 'b' },
  mirror: { takes: [Section, 'i'], gives: Section },
  put: { takes: ['f2', 'i', Section], gives: null },
  state_at: { takes: ['f2', 'i'], gives: Section },
  fill_chain: { takes: ['f', 'f', 'f2', 'i1', 'f1', 'i', 'f2'], gives: null },
  fill_matrix: { takes: ['f2', 'f', 'f2'], gives: null },
  fill_arcs: { takes: [System, 'i1', 'f1', 'f2', 'f2'], gives: null },
  series_fill_chain: { takes: [SeriesSystem, 'i1', 'f1', 'i', 'f2'], gives: null },
  side_of: { takes: ['i'], gives: 'i' },
  turned_over: { takes: ['f2'], gives: Jacobian },
  fill_exp: { takes: ['f1', 'f1'], gives: null },
  fill_expm1: { takes: ['f1', 'f1'], gives: null },
  fill_log: { takes: ['f1', 'f1'], gives: null },
  fill_log1p: { takes: ['f1', 'f1'], gives: null },
  fill_sin: { takes: ['f1', 'f1'], gives: null },
  fill_cos: { takes: ['f1', 'f1'], gives: null },
  fill_tan: { takes: ['f1', 'f1'], gives: null },
  fill_asin: { takes: ['f1', 'f1'], gives: null },
  fill_acos: { takes: ['f1', 'f1'], gives: null },
  fill_atan: { takes: ['f1', 'f1'], gives: null },
  fill_sinh: { takes: ['f1', 'f1'], gives: null },
  fill_cosh: { takes: ['f1', 'f1'], gives: null },
  fill_tanh: { takes: ['f1', 'f1'], gives: null },
  fill_asinh: { takes: ['f1', 'f1'], gives: null },
  fill_next_up: { takes: ['f1', 'f1'], gives: null },
  fill_atan2: { takes: ['f1', 'f1', 'f1'], gives: null },
  fill_hypot: { takes: ['f1', 'f1', 'f1'], gives: null },
  series_next_passage: { takes: [SeriesSystem, Section, 'f'], gives: Passage },
  series_uplift_after: { takes: [SeriesSystem, 'i', 'f'], gives: Passage },
  series_highest_after: { takes: [SeriesSystem, Section, Passage], gives: ['f', 'f'] },
  series_settle: { takes: [SeriesSystem, AnyState, 'i', 'f2', 'f2'], gives: Settled },
  series_search: { takes: [SeriesSystem, Sought, 'f2', Orbits, 'i'], gives: 'i' },
  series_polish: { takes: [SeriesSystem, Section, 'i', 'i', 'f2'], gives: Fixed },
  series_measured: { takes: [SeriesSystem, 'i', 'i', 'f2'], gives: Fixed },
  series_loss: { takes: [SeriesSystem, 'i', 'i', 'i'], gives: 'f' },
  series_fill_peaks: { takes: [SeriesSystem, 'i', 'f2'], gives: null },
  series_is_symmetric: { takes: [SeriesSystem, 'f2', 'i', 'i'], gives: 'b' },
  series_fill_arcs: { takes: [SeriesSystem, 'i1', 'f1', 'f2', 'f2'], gives: null },
};
