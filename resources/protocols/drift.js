// Does the amplitude stay where it was, trial after trial?
//
// A stimulator that warms up, a battery that runs down, a contact that loosens: each changes the amplitude of a long
// session. Every trial is judged on what the oscilloscope saw across the load, never on what was commanded.
protocol({
  title: "Drift of the amplitude",
  purpose: "Does the amplitude stay where it was over the trials of a session?",
  kind: "drift",
  needs: ["stimulator", "oscilloscope"],
  view: "trials",
  parameters: {
    repeats: { label: "Repeats per condition", type: "integer", min: 3, max: 500, value: 25 },
    pause: { label: "Pause between trials", unit: "s", min: 0, max: 600, value: 0 },
    tolerance: { label: "Change that is accepted, ±", unit: "%", min: 0.01, max: 100, value: 5 },
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

function run(p) {
  // Trials are of conditions as they stand, not of the way to them.
  bench.setEncoding({ amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });
  bench.arm({ load: p.load });
  for (const condition of progress(random.blocks(bench.conditions, p.repeats), "Trials")) {
    bench.present(condition, { source: "direct" });
    record.trial(condition.name, measure.train(bench.capture({ trains: 2, rate_hz: RATES[p.rate], intervals: true })));
    if (p.pause > 0) bench.wait(p.pause);
  }
  bench.disarm();

  const found = analysis.drift(record.trials(), { tolerance_pct: p.tolerance });
  report.figure("Amplitude over the trials", plot.curves(found.curves));
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  return verdict(found);
}
