// How large a change is felt from one train to the next, and how long it takes until it is felt?
//
// The finger steps and moves, and every train that follows is looked for in the oscilloscope's records: the first that
// carries a step, how far each differs from the one before, and the one with which the change is complete. What the
// encoder's design makes of the whole R-P plane is computed beside it. Definitions: science.md sections 4, 10 and 12.
//
// Results: { transitions: from analysis.transitions(), steps, and jumps with small steps among them: [{ name, and what
// was seen of it }], movements: [{ name, and what was seen }], changes and latency as judged, reference: { load_ohm,
// measured_ohm, allowed_pct, passed }, verdict, reasons, notes }.
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
    finger: { label: "Press a finger too, that drives by itself", type: "boolean", value: false },
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

// Places of the plane.
const at = (roughness, pressure) => ({ roughness, pressure });

// The two inputs, both directions each.
function kindsOf(p) {
  return [
    { name: "pressure up", from: at(p.held, p.low), to: at(p.held, p.high) },
    { name: "pressure down", from: at(p.held, p.high), to: at(p.held, p.low) },
    { name: "texture up", from: at(p.low, p.held), to: at(p.high, p.held) },
    { name: "texture down", from: at(p.high, p.held), to: at(p.low, p.held) },
  ];
}

// The order of the steps is drawn, and so is the moment within the interval.
function stepsOf(p, kinds) {
  const phases = {};
  for (const kind of kinds) {
    const shares = [];
    for (let k = 0; k < p.repeats; ++k) shares.push(0.05 + (0.85 * (k + random.uniform(0, 1))) / p.repeats);
    phases[kind.name] = random.shuffle(shares);
  }
  return random.blocks(kinds, p.repeats).map((kind) => Object.assign({ phase: phases[kind.name].pop() }, kind));
}

// Once each: every corner of the plane to every other, and the plane's edges and middle lines at an even pace.
function cornerJumps() {
  const corners = [at(0, 0), at(0, 1), at(1, 0), at(1, 1)];
  const name = (corner) => (corner.roughness ? "rough" : "smooth") + "-" + (corner.pressure ? "high" : "low");
  const out = [];
  for (const from of corners) {
    for (const to of corners) if (from !== to) out.push({ name: name(from) + " to " + name(to), from, to, phase: 0.5 });
  }
  return out;
}

// Small enough for steps of two differences to be complete within 2 s: these are judged by the seconds.
function smallSteps() {
  return [
    { name: "a little rougher, pressed", from: at(0.5, 1), to: at(0.75, 1), phase: 0.5 },
    { name: "a little smoother, pressed", from: at(0.75, 1), to: at(0.5, 1), phase: 0.5 },
    { name: "pressed a little more", from: at(0.5, 0.8), to: at(0.5, 1), phase: 0.5 },
    { name: "pressed a little less", from: at(0.5, 1), to: at(0.5, 0.8), phase: 0.5 },
  ];
}

function movementsOf() {
  const out = [];
  for (const held of [0, 0.5, 1]) {
    out.push({ name: "texture moves at P " + held, from: at(0, held), to: at(1, held) });
    out.push({ name: "pressure moves at R " + held, from: at(held, 0), to: at(held, 1) });
  }
  return out;
}

// What a finger drives that presses harder or more lightly on its surface: a board's own trains, if it is on a board
// that encodes. To another surface it comes by another touch, which starts over.
function fingerChanges() {
  const conditions = bench.conditions, out = [];
  for (const from of conditions) {
    for (const to of conditions) {
      if (from.roughness !== to.roughness || from.pressure === to.pressure) continue;
      out.push({ name: "finger, " + from.name + " to " + to.name, from, to });
    }
  }
  return out;
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

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  setLimits(p);
  const kinds = kindsOf(p), steps = stepsOf(p, kinds), movements = movementsOf();
  const jumps = smallSteps().concat(p.jumps ? random.shuffle(cornerJumps()) : []);
  const pressed = p.finger ? random.shuffle(fingerChanges()) : [];
  const names = (changes) => changes.map((change) => change.name);

  // What the encoding does all over the plane, by computation.
  bench.transitions.begin(p, names(kinds), names(jumps.concat(movements, pressed)));

  // The wiring as drawn, and the known load must read as what it is. Leaves the bench armed.
  operator.wired(p.load);
  if (bench.transitions.knownLoad()) {
    // What the oscilloscope sees of steps and movements.
    for (const step of progress(steps.concat(jumps), "Steps")) bench.transitions.step(step);
    for (const movement of progress(movements, "Movements")) bench.transitions.traverse(movement);
    for (const change of progress(pressed, "Finger")) bench.transitions.press(change);
  }
  bench.disarm();
  if (p.finger) bench.lift();
  const results = bench.transitions.conclude();
  report.figure("Computed from the encoding: largest step from train to train over the R-P plane",
    plot.transitions(results.transitions));
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  return verdict(results);
}
