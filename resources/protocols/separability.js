// Can an oscilloscope tell the four tactile conditions apart?
//
// Every trial is judged on what the oscilloscope saw across the load, never on what was commanded.
protocol({
  title: "Signal separability",
  purpose: "Can an oscilloscope tell the four tactile conditions apart?",
  kind: "separability",
  needs: ["sensor", "stimulator", "oscilloscope"],
  view: "trials",
  parameters: {
    repeats: { label: "Repeats per condition", type: "integer", min: 2, max: 500, value: 25 },
    source: {
      label: "Drive from",
      type: "choice",
      choices: { finger: "simulated or real finger", direct: "R and P directly" },
      value: "finger",
    },
    load: { label: "Load", unit: "ohm", min: 1, max: 1e6, value: 1e3 },
    rate: {
      label: "Sampling rate",
      type: "choice",
      choices: { "250k": "250 kS/s", "500k": "500 kS/s", "1M": "1 MS/s", "2M": "2 MS/s", "10M": "10 MS/s" },
      value: "1M",
    },
  },
});

const RATES = { "250k": 250e3, "500k": 500e3, "1M": 1e6, "2M": 2e6, "10M": 10e6 };

// Roughness is relative to two reference surfaces, felt on this rig before the run.
function feelReferences() {
  const smooth = bench.measureReference("plastic");
  const rough = bench.measureReference("P120");
  bench.setReferences(smooth, rough);
  return [smooth, rough];
}

// A lane for each condition of the paper's figure: trains one after the other for a little over twice the longest
// interval. Null where the oscilloscope has no more of them (captures from files end with the trials) or shows
// something else.
function lanesOf(p, found) {
  const span_s = 2.2 * Math.max.apply(null, found.conditions.map((condition) => condition.interval_s.mean || 0));
  const near = (x, y) => Math.abs(x - y) <= 0.1 * y;
  const lanes = {};
  for (const condition of bench.conditions) {
    const trial = found.conditions.find((each) => each.name === condition.name);
    if (!(trial.interval_s.mean > 0)) continue;
    bench.present(condition, { source: p.source });
    try {
      const trains = Math.min(32, 1 + Math.floor(span_s / trial.interval_s.mean));
      const captures = bench.capture({ trains: trains, rate_hz: RATES[p.rate] });
      const lane = measure.train(captures);
      if (!near(lane.amplitude_v, trial.amplitude_v.mean) || !near(lane.interval_s, trial.interval_s.mean)) return null;
      lanes[condition.name] = captures;
    } catch (error) {
      if (bench.live().state === "faulted") throw error;
      log("The figure is drawn from means: " + error.message);
      return null;
    }
  }
  return lanes;
}

// What the figures are judged by, and what the instrument leaves open of them.
function basis(found) {
  const floor = found.floor;
  const known = floor.amplitude_v !== null && floor.interval_s !== null;
  return (
    "5 just-noticeable differences (Weber fractions 0.10 of amplitude, 0.16 of interval) and 5 % of variation are " +
    "choices. Each is judged by its one-sided 95 % confidence bound, not by the estimate: the difference by " +
    "Student's t with the oscilloscope's uncertainty, the coefficient of variation by chi-squared. " +
    (known
      ? "No variance is taken below what the oscilloscope resolves, its time base included: " +
        1e3 * Number(floor.amplitude_v.toPrecision(2)) + " mV and " +
        Number((1e6 * floor.interval_s).toPrecision(2)) + " µs."
      : "What the oscilloscope resolves is unknown, so Mahalanobis distances are not evaluated.")
  );
}

function run(p) {
  // Trials are of conditions as they stand, not of the way to them.
  bench.setEncoding({ amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });
  const references = p.source === "finger" ? feelReferences() : [];

  bench.arm({ load: p.load });
  let unsettled = 0;
  const trials = random.blocks(bench.conditions, p.repeats);
  for (const condition of progress(trials, "Trials")) {
    const state = bench.present(condition, { source: p.source });
    if (!state.settled) unsettled += 1;
    const captures = bench.capture({ trains: 2, rate_hz: RATES[p.rate], intervals: true });
    record.trial(condition.name, measure.train(captures));
  }
  const found = analysis.separability(record.trials(), {
    conditions: bench.conditions.map((condition) => condition.name),
  });
  const lanes = lanesOf(p, found);
  bench.disarm();
  bench.lift();
  if (unsettled > 0) log(unsettled + " of " + trials.length + " trials began before R and P had settled");

  if (lanes === null) report.figure("Four conditions", plot.conditions(found));
  else report.figure("Four conditions, as captured", plot.conditions(found, lanes));
  report.figure("Amplitude and interval", plot.plane(found));
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Confusion, cross-validated", plot.confusion(found));
  report.figure("Exposure against limits", plot.exposure());
  report.text(basis(found));
  return verdict(Object.assign(found, { references: references }));
}
