// How large a change is felt from one train to the next, and how long it takes until it is felt?
//
// The R-P plane is swept with the bench's own encoding; then the finger steps, and the first train that carries the
// step is looked for in the oscilloscope's records. Definitions: science.md sections 4 and 10.
//
// Results: { transitions: from analysis.transitions(), steps: [{ name, and what bench.step() returned }], latency: from
// analysis.latency(), reference: { load_ohm, measured_ohm, allowed_pct, passed }, verdict, reasons }.
protocol({
  title: "Transitions",
  purpose: "The largest step from train to train in just-noticeable differences, and the latency of a step",
  needs: ["stimulator", "oscilloscope"],
  parameters: {
    repeats: { label: "Steps of each kind", type: "integer", min: 1, max: 100, value: 10 },
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, value: 1e3 },
    load_tolerance_pct: { label: "Tolerance of the load", unit: "%", min: 0.001, max: 20, value: 5 },
    low: { label: "A step's lower end (R or P)", min: 0, max: 1, value: 0 },
    high: { label: "A step's upper end (R or P)", min: 0, max: 1, value: 1 },
    held: { label: "The other of R and P meanwhile", min: 0, max: 1, value: 0.5 },
    latency_tolerance_s: { label: "Latency, measured against design, ±", unit: "s", min: 0.001, max: 1, value: 0.02 },
    traverse_s: { label: "A finger crosses the plane in", unit: "s", min: 0.1, max: 600, value: 5 },
    lines: { label: "Lines along R and along P", type: "integer", min: 2, max: 41, value: 11 },
    jumps: { label: "Judge jumps between the plane's corners too", type: "boolean", value: true },
    slew: {
      label: "Slew limits",
      type: "choice",
      choices: { profile: "as the profile has them", given: "as given here", off: "none" },
      value: "profile",
    },
    slew_v_per_s: { label: "Amplitude, at most (0: no limit)", unit: "V/s", min: 0, max: 1000, value: 1 },
    slew_ratio: { label: "Interval, at most times the one before (0: no limit)", min: 0, max: 10, value: 1.3 },
  },
});

const COLUMNS = ["step", "n", "missing", "latency_s", "median_s", "max_s", "designed_s", "off_s", "trains", "verdict"];
const LARGEST = ["movement", "of", "change", "jnd", "R", "P", "wanted"];

// The two inputs, both directions each; the order of the steps is drawn, and so is the moment within the interval.
function stepsOf(p) {
  const at = (roughness, pressure) => ({ roughness, pressure });
  const kinds = [
    { name: "pressure up", from: at(p.held, p.low), to: at(p.held, p.high) },
    { name: "pressure down", from: at(p.held, p.high), to: at(p.held, p.low) },
    { name: "texture up", from: at(p.low, p.held), to: at(p.high, p.held) },
    { name: "texture down", from: at(p.high, p.held), to: at(p.low, p.held) },
  ];
  const phases = {};
  for (const kind of kinds) {
    const shares = [];
    for (let k = 0; k < p.repeats; ++k) shares.push(0.05 + (0.85 * (k + random.uniform(0, 1))) / p.repeats);
    phases[kind.name] = random.shuffle(shares);
  }
  return {
    names: kinds.map((kind) => kind.name),
    steps: random.blocks(kinds, p.repeats).map((kind) => Object.assign({ phase: phases[kind.name].pop() }, kind)),
  };
}

// Before anything is believed: the wiring as drawn, and the known load must read as what it is. Leaves the bench armed.
function checkReference(p) {
  operator.wired(p.load);
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  return record.reference(measure.pulse(bench.capture({ trains: 1 })), p.load, p.load_tolerance_pct);
}

function largestRows(found) {
  const rows = [];
  for (const movement of ["gradual", "abrupt"]) {
    for (const axis of ["amplitude", "interval"]) {
      const worst = found[movement][axis];
      const unit = axis === "amplitude" ? "v" : "s";
      rows.push({
        movement: movement === "gradual" ? "across in " + found.traverse_s + " s" : "jump between corners",
        of: axis,
        change: worst["from_" + unit].toPrecision(3) + " to " + worst["to_" + unit].toPrecision(3) + (unit === "v" ? " V" : " s"),
        jnd: worst.jnd,
        R: worst.roughness,
        P: worst.pressure,
        wanted: worst.jnd <= found.wanted_jnd ? "yes" : "no",
      });
    }
  }
  return rows;
}

function latencyRows(latency) {
  return latency.groups.map((group) => ({
    step: group.name,
    n: group.n,
    missing: group.not_measured,
    latency_s: group.latency_s,
    median_s: group.latency_s.median,
    max_s: group.latency_s.max,
    designed_s: group.designed_latency_s,
    off_s: group.n > 0 ? Math.max(Math.abs(group.difference_s.min), Math.abs(group.difference_s.max)) : null,
    trains: group.trains.max === null ? null : group.trains.max + " / " + group.designed_trains.max,
    verdict: group.verdict,
  }));
}

function writeSweep(found) {
  report.figure("Largest step from train to train over the R-P plane", plot.transitions(found));
  report.table("Largest step from train to train (at most " + found.wanted_jnd + " differences are wanted)", largestRows(found), LARGEST);
  const slew = found.amplitude_slew_v_per_s, ratio = found.interval_ratio_per_train;
  const limits = [];
  if (slew > 0) limits.push("amplitude by at most " + slew + " V/s");
  if (ratio > 0) limits.push("the interval at most " + ratio + " times from train to train");
  report.text(limits.length === 0 ? "No slew limits: a change is taken in one train." : "Slew limits: " + limits.join(", ") + ".");
}

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  bench.setEncoding({ hold: "voltage" });
  if (p.slew === "given") bench.setEncoding({ amplitude_slew_v_per_s: p.slew_v_per_s, interval_ratio_per_train: p.slew_ratio });
  if (p.slew === "off") bench.setEncoding({ amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });

  const sweep = analysis.transitions({ lines: p.lines, traverse_s: p.traverse_s, jumps: p.jumps });
  const results = { transitions: sweep, latency: null, steps: [] };
  record.partial(results, [{ caption: "Largest step from train to train", rows: largestRows(sweep), columns: LARGEST }]);
  writeSweep(sweep);
  results.reference = checkReference(p);

  const plan = stepsOf(p);
  const options = { names: plan.names, tolerance_s: p.latency_tolerance_s };
  for (const step of results.reference.passed ? progress(plan.steps, "Steps") : []) {
    const seen = bench.step(step.from, step.to, { phase: step.phase });
    results.steps.push(Object.assign({ name: step.name }, seen));
    record.trial(step.name, seen);
    results.latency = analysis.latency(results.steps, options);
    record.partial(results, [
      { caption: "Largest step from train to train", rows: largestRows(sweep), columns: LARGEST },
      { caption: "Latency of a step", rows: latencyRows(results.latency), columns: COLUMNS },
    ]);
  }
  bench.disarm();
  if (!results.reference.passed) results.latency = analysis.latency([], options);

  report.table("Latency: from the step to the first train that carries it, mean ± s.d.", latencyRows(results.latency), COLUMNS);
  report.text(
    "Design: the pending train is pulled forward to max(now, last onset + new interval), and carries the newest " +
      "amplitude. Steps fall on moments spread over the interval. Off is the largest difference between a step and its design; trains is " +
      "how many a change takes until it is complete, measured / designed.",
  );
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  results.reasons = sweep.reasons.concat(results.latency.reasons);
  if (!results.reference.passed) results.reasons.unshift(results.reference.reason + "; no latency was measured");
  const verdicts = [sweep.verdict, results.latency.verdict];
  results.verdict = verdicts.includes("fail") ? "fail" : verdicts.includes("indeterminate") ? "indeterminate" : "pass";
  return verdict(results);
}
