// Along which curve should amplitude and interval follow R and P? Which of the two sets which is not a question for an
// oscilloscope: swapping them is a symmetry of the distances that are measured here, and people decide.
//
// The same trials in the same order under both assignments and the three curves, each judged on what the oscilloscope
// saw. R and P are set directly, so that the encoding alone makes the difference.
//
// Results: { default, encodings: [{ name, assignment, curve, conditions, pairs, smallest_amplitude_jnd,
// smallest_interval_jnd, smallest_pair_jnd, mahalanobis_min, amplitude_variation_max, interval_variation_max, accuracy,
// separable, neighbours, levels, gradual_jnd, abrupt_jnd }], differences, asymmetry_jnd, conclusion, reference };
// verdict null: a comparison has none unless something was not measured (indeterminate).
protocol({
  title: "Encoding comparison",
  purpose: "Both assignments and the three curves side by side, in just-noticeable differences",
  kind: "encoding-comparison",
  needs: ["stimulator", "oscilloscope"],
  view: "trials",
  parameters: {
    repeats: { label: "Repeats per condition", type: "integer", min: 2, max: 200, value: 20 },
    level_repeats: { label: "Repeats per level in between", type: "integer", min: 2, max: 100, value: 3 },
    low: { label: "R or P of a smooth or low condition", min: 0, max: 1, value: 0.1 },
    high: { label: "R or P of a rough or high condition", min: 0, max: 1, value: 0.9 },
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, value: 1e3 },
    load_tolerance_pct: { label: "Known load must read within", unit: "%", min: 0.001, max: 20, value: 5 },
    traverse_s: { label: "A finger crosses the plane in", unit: "s", min: 0.1, max: 600, value: 5 },
  },
});

const ASSIGNMENTS = { texture_to_amplitude: "R to A", swapped: "swapped" };
const CURVES = ["linear", "logarithmic", "power"];

// The first of them is the default that the others are compared with.
function encodings() {
  const out = [];
  for (const assignment of Object.keys(ASSIGNMENTS)) {
    for (const curve of CURVES) out.push({ assignment, curve, name: ASSIGNMENTS[assignment] + ", " + curve });
  }
  return out;
}

// As in separability.js: present, capture, record.
function measureAll(trials, encoding) {
  const rows = [];
  for (const place of progress(trials, encoding.name)) {
    bench.present(place, { source: "direct" });
    const measured = measure.train(bench.capture({ trains: 2, intervals: true }));
    record.trial(place.name, Object.assign({ encoding: encoding.name }, measured));
    rows.push(Object.assign({ condition: place.name }, measured));
  }
  return rows;
}

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  const places = bench.encodingComparison.begin(p);
  operator.wired(p.load);
  if (!bench.encodingComparison.knownLoad()) return verdict(bench.encodingComparison.conclude());

  // The same trials in the same order under each.
  const trials = random.blocks(places.conditions, p.repeats);
  const between = random.blocks(places.levels, p.level_repeats);
  for (const encoding of encodings()) {
    bench.setEncoding({ assignment: encoding.assignment, amplitude_curve: encoding.curve,
      interval_curve: encoding.curve, amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0,
      interval_ratio_per_train: 0, hold: "voltage" });
    bench.arm({ load: p.load });
    const measured = measureAll(trials, encoding), inBetween = measureAll(between, encoding);
    bench.disarm();
    bench.encodingComparison.add(encoding, measured, inBetween);
  }
  const results = bench.encodingComparison.conclude();
  report.figure("Four conditions under the default, " + results.default, plot.conditions(results.encodings[0]));
  report.figure("Exposure against limits", plot.exposure());
  return verdict(results);
}
