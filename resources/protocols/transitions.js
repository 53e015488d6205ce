// How large a change is felt from one train to the next, and how long it takes until it is felt?
//
// The finger steps and moves, and every train that follows is looked for in the oscilloscope's records: the first that
// carries a step, how far each differs from the one before, and the one with which the change is complete. What the
// encoder's design makes of the whole R-P plane is computed beside it. Definitions: science.md sections 4, 10 and 12.
//
// Results: { transitions: from analysis.transitions(), steps, and jumps with small steps among them: [{ name, and what
// bench.step() returned }], movements: [{ name, and what bench.traverse() returned }], changes: from
// analysis.changes(), latency: from analysis.latency(), reference: { load_ohm, measured_ohm, allowed_pct, passed },
// verdict, reasons, notes }.
protocol({
  title: "Transitions",
  purpose: "The largest step from train to train, and the time until a change is felt and is complete",
  kind: "transitions",
  needs: ["stimulator", "oscilloscope"],
  view: "trials",
  parameters: {
    repeats: { label: "Steps of each kind", type: "integer", min: 1, max: 100, value: 10 },
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, value: 1e3 },
    load_tolerance_pct: { label: "Known load must read within", unit: "%", min: 0.001, max: 20, value: 5 },
    low: { label: "A step's lower end (R or P)", min: 0, max: 1, value: 0 },
    high: { label: "A step's upper end (R or P)", min: 0, max: 1, value: 1 },
    held: { label: "The other of R and P meanwhile", min: 0, max: 1, value: 0.5 },
    latency_tolerance_s: { label: "Latency, measured against design, ±", unit: "s", min: 0.001, max: 1, value: 0.02 },
    traverse_s: { label: "A finger crosses the plane in", unit: "s", min: 0.1, max: 600, value: 5 },
    lines: { label: "Lines along R and along P", type: "integer", min: 2, max: 41, value: 11 },
    jumps: { label: "Judge jumps between the plane's corners too", type: "boolean", value: true },
    complete_s: { label: "A change is complete within (choice)", unit: "s", min: 0.01, max: 600, value: 2 },
    complete: {
      label: "Where steps of two differences take longer",
      type: "choice",
      choices: { trains: "with the fewest trains that such steps take (choice)", seconds: "still within that time" },
      value: "trains",
    },
    slew: {
      label: "Limits on a step",
      type: "choice",
      choices: { profile: "as the profile has them", given: "as given here", off: "none" },
      value: "profile",
    },
    slew_amplitude_ratio: {
      label: "Amplitude, at most times the one before",
      zero: "no limit",
      min: 0,
      max: 10,
      value: 1.2,
    },
    slew_v_per_s: { label: "Amplitude, at most", zero: "no limit", unit: "V/s", min: 0, max: 1000, value: 0 },
    slew_ratio: { label: "Interval, at most times the one before", zero: "no limit", min: 0, max: 10, value: 1.34 },
  },
});

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

// Once each: every corner of the plane to every other, and the plane's edges and middle lines at an even pace.
function jumpsOf() {
  const corners = [];
  for (const roughness of [0, 1]) for (const pressure of [0, 1]) corners.push({ roughness, pressure });
  const name = (at) => (at.roughness ? "rough" : "smooth") + "-" + (at.pressure ? "high" : "low");
  const out = [];
  for (const from of corners) {
    for (const to of corners) if (from !== to) out.push({ name: name(from) + " to " + name(to), from, to, phase: 0.5 });
  }
  return random.shuffle(out);
}

// Small enough for steps of two differences to be complete within 2 s: these are judged by the seconds.
function smallSteps() {
  const at = (roughness, pressure) => ({ roughness, pressure });
  return [
    { name: "a little rougher, pressed", from: at(0.5, 1), to: at(0.75, 1), phase: 0.5 },
    { name: "a little smoother, pressed", from: at(0.75, 1), to: at(0.5, 1), phase: 0.5 },
    { name: "pressed a little more", from: at(0.5, 0.8), to: at(0.5, 1), phase: 0.5 },
    { name: "pressed a little less", from: at(0.5, 1), to: at(0.5, 0.8), phase: 0.5 },
  ];
}

function movementsOf() {
  const at = (roughness, pressure) => ({ roughness, pressure });
  const out = [];
  for (const held of [0, 0.5, 1]) {
    out.push({ name: "texture moves at P " + held, from: at(0, held), to: at(1, held) });
    out.push({ name: "pressure moves at R " + held, from: at(held, 0), to: at(held, 1) });
  }
  return out;
}

// What was not measured has no largest: Math.max takes null for 0.
const largest = (values) => (values.some((x) => x === null || !isFinite(x)) ? null : Math.max.apply(null, values));

// What a pass says: what was found, and what 2 s would need and cannot have.
function passed(p, changes) {
  const groups = changes.groups;
  const most = largest(groups.map((group) => Math.max(group.amplitude_jnd, group.interval_jnd)));
  const ending = groups.filter((group) => group.completes), beyond = ending.filter((group) => group.out_of_reach > 0);
  const out = ["No captured train differs from the one before by more than " + most.toFixed(2) +
    " just-noticeable differences; at most 2 are wanted"];
  const within = "within " + p.complete_s + " s";
  if (beyond.length < ending.length) out.push(ending.length - beyond.length + " of " + ending.length +
    " kinds of change are complete " + within);
  if (beyond.length > 0) {
    const least = Math.min.apply(null, beyond.map((group) => group.fastest_complete_s.min));
    out.push(beyond.length + " of " + ending.length + " kinds of change cannot be complete " + within +
      " in steps of at most 2 differences (" + least.toFixed(1) +
      " s at least); they were, after " + Math.max.apply(null,
        beyond.map((group) => group.complete_s.max)).toFixed(1) +
      " s at most, with the fewest trains that such steps take, which is what is judged there (choice)");
  }
  return out;
}

// Judged with what the captures leave open of a step; the largest of all changes.
function openOf(changes) {
  const worst = (key) => largest(changes.groups.map((group) => group[key]));
  const amplitude = worst("amplitude_u_jnd"), interval = worst("interval_u_jnd");
  if (amplitude === null || interval === null) return "What captures leave open of a step is unknown. ";
  return "Captures leave ± " + Number(amplitude.toPrecision(2)) +
    " differences of amplitude open, by the scatter of trains of one command and what the oscilloscope states, " +
    "and ± " +
    Number(interval.toPrecision(2)) + " of interval. ";
}

// What is asked for and what cannot be had, before the figures.
function writeChanges(p, changes) {
  report.text(
    "Judged on captured trains: no train differs from the one before by more than 2 just-noticeable differences " +
      "(w = 0.10 of amplitude, a choice, and 0.16 of interval, Jones et al. 2009), and a change of state is " +
      "complete within " + p.complete_s +
      " s. (choice) Both at once are out of reach for large changes at these intervals, whatever the encoder " +
      "does: the steps in between are trains, and trains take their intervals. " +
      (p.complete === "seconds" ? "Such a change fails here."
        : "Such a change is judged by its trains: it passes with the fewest that steps of 2 differences take. " +
        "(choice)"),
  );
  report.text(openOf(changes));
}

function limitsText(found) {
  const amplitude = found.amplitude_ratio_per_train, slew = found.amplitude_slew_v_per_s,
    interval = found.interval_ratio_per_train;
  const limits = [];
  if (amplitude > 0) limits.push("amplitude at most " + amplitude + " times the one before");
  if (slew > 0) limits.push("amplitude by at most " + slew + " V/s");
  if (interval > 0) limits.push("interval at most " + interval + " times the one before");
  return limits.length === 0 ? "No limits on a step: a change is taken in one train."
    : "Limits on a step from train to train, either way: " + limits.join(", ") + ".";
}

// The limits on a step from train to train: the profile's, those given, or none.
function setLimits(p) {
  bench.setEncoding({ hold: "voltage" });
  if (p.slew === "given") {
    bench.setEncoding({ amplitude_ratio_per_train: p.slew_amplitude_ratio, amplitude_slew_v_per_s: p.slew_v_per_s,
      interval_ratio_per_train: p.slew_ratio });
  }
  if (p.slew === "off") bench.setEncoding({ amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0,
    interval_ratio_per_train: 0 });
}

function changesOf(p) {
  const plan = stepsOf(p);
  const jumps = smallSteps().concat(p.jumps ? jumpsOf() : []), movements = movementsOf();
  const names = plan.names.concat(jumps.map((jump) => jump.name), movements.map((movement) => movement.name));
  return { steps: plan.steps, stepNames: plan.names, jumps: jumps, movements: movements, names: names };
}

// What has been watched so far is judged, and stands if the run ends early.
function judge(p, changes, results) {
  results.latency = analysis.latency(results.steps, { names: changes.stepNames, tolerance_s: p.latency_tolerance_s });
  results.changes = analysis.changes(results.steps.concat(results.jumps, results.movements),
    { names: changes.names, complete_s: p.complete_s, seconds_alone: p.complete === "seconds" });
  record.partial(results);
}

function watchSteps(changes, results, keep) {
  for (const step of progress(changes.steps.concat(changes.jumps), "Steps")) {
    const seen = bench.step(step.from, step.to, { phase: step.phase });
    (changes.jumps.includes(step) ? results.jumps : results.steps).push(Object.assign({ name: step.name }, seen));
    record.trial(step.name, seen);
    keep();
  }
}

function watchMovements(p, changes, results) {
  for (const movement of progress(changes.movements, "Movements")) {
    results.movements.push(Object.assign({ name: movement.name },
      bench.traverse(movement.from, movement.to, { seconds: p.traverse_s })));
  }
}

// Captures decide; a design that steps too far elsewhere in the plane leaves it open.
function conclude(p, sweep, results) {
  const elsewhere = sweep.reasons.map((reason) => "computed, not captured: " + reason);
  results.notes = results.changes.notes;
  results.reasons = results.changes.reasons.concat(results.latency.reasons, elsewhere);
  if (!results.reference.passed) results.reasons.unshift(results.reference.reason + "; nothing was measured");
  const verdicts = [results.changes.verdict, results.latency.verdict, sweep.verdict === "pass" ? "pass"
    : "indeterminate"];
  results.verdict = verdicts.includes("fail") ? "fail" : verdicts.includes("indeterminate") ? "indeterminate" : "pass";
  if (results.verdict === "pass") results.reasons = passed(p, results.changes);
}

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  setLimits(p);

  // What the encoding does all over the plane, by computation.
  const sweep = analysis.transitions({ lines: p.lines, traverse_s: p.traverse_s, jumps: p.jumps });
  const results = { transitions: sweep, changes: null, latency: null, steps: [], jumps: [], movements: [] };
  record.partial(results);
  report.text(limitsText(sweep));

  // The wiring as drawn, and the known load must read as what it is. Leaves the bench armed.
  operator.wired(p.load);
  results.reference = bench.readKnownLoad(p.load, p.load_tolerance_pct);

  // What the oscilloscope sees of steps and movements.
  const changes = changesOf(p);
  const keep = () => { judge(p, changes, results); };
  if (results.reference.passed) {
    watchSteps(changes, results, keep);
    watchMovements(p, changes, results);
  }
  bench.disarm();
  keep();

  writeChanges(p, results.changes);
  report.figure("Computed from the encoding: largest step from train to train over the R-P plane",
    plot.transitions(sweep));
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  conclude(p, sweep, results);
  return verdict(results);
}
