// Can an oscilloscope tell the four tactile conditions apart?
//
// Every trial is judged on what the oscilloscope saw across the load, never on what was commanded.
protocol({
  title: "Signal separability",
  purpose: "Can an oscilloscope tell the four tactile conditions apart?",
  needs: ["sensor", "stimulator", "oscilloscope"],
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
  report.table("Reference surfaces", [smooth, rough], ["material", "h", "v", "frames"]);
}

function run(p) {
  if (p.source === "finger") feelReferences();

  bench.arm({ load: p.load });
  let unsettled = 0;
  const trials = random.blocks(bench.conditions, p.repeats);
  for (const condition of progress(trials, "Trials")) {
    const state = bench.present(condition, { source: p.source });
    if (!state.settled) unsettled += 1;
    const captures = bench.capture({ trains: 2, rate_hz: RATES[p.rate] });
    record.trial(condition.name, measure.train(captures));
  }
  bench.disarm();
  bench.lift();
  if (unsettled > 0) log(unsettled + " of " + trials.length + " trials began before R and P had settled");

  const found = analysis.separability(record.trials(), {
    conditions: bench.conditions.map((condition) => condition.name),
  });
  report.figure("Four conditions", plot.conditions(found));
  report.figure("Amplitude and interval", plot.plane(found));
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Confusion, cross-validated", plot.confusion(found));
  report.figure("Exposure against limits", plot.exposure());
  report.table("Conditions", found.conditions, ["name", "n", "amplitude_v", "interval_s", "amplitude_variation", "interval_variation"]);
  report.table("Pairs", found.pairs, ["a", "b", "mahalanobis", "amplitude_jnd", "interval_jnd"]);
  return verdict(found);
}
