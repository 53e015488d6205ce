// Which of R and P should set the amplitude, and along which curve?
//
// The same trials in the same order under both assignments and the three curves, each judged on what the oscilloscope
// saw. R and P are set directly, so that the encoding alone makes the difference.
//
// Results: { default, encodings: [{ name, assignment, curve, conditions, pairs, smallest_amplitude_jnd,
// smallest_interval_jnd, smallest_pair_jnd, mahalanobis_min, amplitude_variation_max, interval_variation_max, accuracy,
// separable, neighbours, levels, gradual_jnd, abrupt_jnd }], differences, conclusion, reference }; verdict null: a
// comparison has none unless something was not measured (indeterminate).
protocol({
  title: "Encoding comparison",
  purpose: "Both assignments and the three curves side by side, in just-noticeable differences",
  needs: ["stimulator", "oscilloscope"],
  parameters: {
    repeats: { label: "Repeats per condition", type: "integer", min: 2, max: 200, value: 20 },
    level_repeats: { label: "Repeats per level in between", type: "integer", min: 2, max: 100, value: 3 },
    low: { label: "R or P of a smooth or low condition", min: 0, max: 1, value: 0.1 },
    high: { label: "R or P of a rough or high condition", min: 0, max: 1, value: 0.9 },
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, value: 1e3 },
    load_tolerance_pct: { label: "Tolerance of the load", unit: "%", min: 0.001, max: 20, value: 5 },
    traverse_s: { label: "A finger crosses the plane in", unit: "s", min: 0.1, max: 600, value: 5 },
  },
});

const ASSIGNMENTS = { texture_to_amplitude: "R to A", swapped: "swapped" };
const CURVES = ["linear", "logarithmic", "power"];
const LEVELS = [0.25, 0.5, 0.75];
const NAMES = ["smooth-low", "smooth-high", "rough-low", "rough-high"];

// The first of them is the default that the others are compared with.
function encodings() {
  const out = [];
  for (const assignment of Object.keys(ASSIGNMENTS)) {
    for (const curve of CURVES) out.push({ assignment, curve, name: ASSIGNMENTS[assignment] + ", " + curve });
  }
  return out;
}

// Before anything is believed: the wiring as drawn, and the known load must read as what it is. Leaves the bench armed.
function checkReference(p) {
  operator.wired(p.load);
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  return record.reference(measure.pulse(bench.capture({ trains: 1 })), p.load, p.load_tolerance_pct);
}

function conditionsOf(p) {
  const out = [];
  for (const [texture, roughness] of [["smooth", p.low], ["rough", p.high]]) {
    for (const [force, pressure] of [["low", p.low], ["high", p.high]]) {
      out.push({ name: texture + "-" + force, roughness, pressure });
    }
  }
  return out;
}

function levelName(roughness, pressure) {
  return "R " + roughness + " P " + pressure;
}

function levels() {
  const out = [];
  for (const roughness of LEVELS) {
    for (const pressure of LEVELS) out.push({ name: levelName(roughness, pressure), roughness, pressure });
  }
  return out;
}

// As in separability.js: present, capture, record.
function measureAll(trials, encoding) {
  const rows = [];
  for (const place of progress(trials, encoding.name)) {
    bench.present(place, { source: "direct" });
    const measured = measure.train(bench.capture({ trains: 2 }));
    record.trial(place.name, Object.assign({ encoding: encoding.name }, measured));
    rows.push(Object.assign({ condition: place.name }, measured));
  }
  return rows;
}

// What was not measured has no largest: Math.max takes null for 0.
const largest = (values) => (values.some((x) => x === null || !isFinite(x)) ? null : Math.max.apply(null, values));
const best = (pair) => largest([pair.amplitude_jnd, pair.interval_jnd]);
const smallest = (values) => (values.length === 0 || values.some((x) => x === null || !isFinite(x)) ? null : Math.min.apply(null, values));
// Of one axis: pairs that share its level are none of its business.
const smallestApart = (pairs, key) => smallest(pairs.map((pair) => pair[key]).filter((x) => x === null || x > 1));
const mean = (values) => (smallest(values) === null ? null : values.reduce((sum, x) => sum + x, 0) / values.length);

// Neighbours differ by one level in R or in P; each pair counts on the axis that tells it best.
function neighbours(pairs) {
  const named = {};
  for (const pair of pairs) named[pair.a + "|" + pair.b] = named[pair.b + "|" + pair.a] = best(pair);
  const texture = [], pressure = [];
  for (let i = 0; i + 1 < LEVELS.length; ++i) {
    for (const other of LEVELS) {
      texture.push(named[levelName(LEVELS[i], other) + "|" + levelName(LEVELS[i + 1], other)]);
      pressure.push(named[levelName(other, LEVELS[i]) + "|" + levelName(other, LEVELS[i + 1])]);
    }
  }
  const all = texture.concat(pressure);
  return { texture_min_jnd: smallest(texture), texture_mean_jnd: mean(texture), pressure_min_jnd: smallest(pressure),
    pressure_mean_jnd: mean(pressure), min_jnd: smallest(all), mean_jnd: mean(all) };
}

function compare(p, encoding, trials, between) {
  bench.setEncoding({ assignment: encoding.assignment, amplitude_curve: encoding.curve, interval_curve: encoding.curve,
    amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0, hold: "voltage" });
  const sweep = analysis.transitions({ traverse_s: p.traverse_s });
  bench.arm({ load: p.load });
  const found = analysis.separability(measureAll(trials, encoding), { conditions: NAMES });
  const inBetween = analysis.separability(measureAll(between, encoding), { conditions: levels().map((each) => each.name) });
  bench.disarm();
  return {
    name: encoding.name,
    assignment: encoding.assignment,
    curve: encoding.curve,
    conditions: found.conditions,
    pairs: found.pairs,
    smallest_amplitude_jnd: smallestApart(found.pairs, "amplitude_jnd"),
    smallest_interval_jnd: smallestApart(found.pairs, "interval_jnd"),
    smallest_pair_jnd: smallest(found.pairs.map(best)),
    mahalanobis_min: smallest(found.pairs.map((pair) => pair.mahalanobis)),
    amplitude_variation_max: largest(found.conditions.map((each) => each.amplitude_variation)),
    interval_variation_max: largest(found.conditions.map((each) => each.interval_variation)),
    accuracy: found.accuracy,
    separable: found.verdict,
    neighbours: neighbours(inBetween.pairs),
    levels: inBetween.conditions,
    gradual_jnd: sweep.gradual.largest_jnd,
    abrupt_jnd: sweep.abrupt.largest_jnd,
  };
}

// A report shows thousandths: what is below is measurement, not encoding.
const shown = (x) => (x === null || !isFinite(x) ? null : Math.round(1000 * x) / 1000);
const inPercent = (x) => (x === null ? null : 100 * x);
const percent = (x) => (x === null ? "?" : (100 * x).toFixed(1));

function comparisonRow(each) {
  return {
    encoding: each.name,
    amplitude_jnd: shown(each.smallest_amplitude_jnd),
    interval_jnd: shown(each.smallest_interval_jnd),
    pair_jnd: shown(each.smallest_pair_jnd),
    mahalanobis: each.mahalanobis_min,
    variation_pct: inPercent(largest([each.amplitude_variation_max, each.interval_variation_max])),
    accuracy: percent(each.accuracy.value) + " % (" + percent(each.accuracy.low) + " to " + percent(each.accuracy.high) + ")",
    step_jnd: shown(each.gradual_jnd),
    separable: each.separable,
  };
}

function levelRow(each) {
  const n = each.neighbours;
  return {
    encoding: each.name,
    texture_min_jnd: shown(n.texture_min_jnd),
    texture_mean_jnd: shown(n.texture_mean_jnd),
    pressure_min_jnd: shown(n.pressure_min_jnd),
    pressure_mean_jnd: shown(n.pressure_mean_jnd),
    all_min_jnd: shown(n.min_jnd),
    all_mean_jnd: shown(n.mean_jnd),
  };
}

// "13.00 V, 1.850 s" of each condition.
function conditionRow(each) {
  const row = { encoding: each.name };
  for (const condition of each.conditions) {
    const known = condition.amplitude_v.mean !== null && condition.interval_s.mean !== null;
    row[condition.name] = known ? condition.amplitude_v.mean.toFixed(2) + " V, " + condition.interval_s.mean.toFixed(3) + " s" : null;
  }
  return row;
}

// Against the default, signed: where a condition's amplitude and interval went, and what that did to the distances.
function differenceRow(each, base) {
  const row = { encoding: each.name };
  each.conditions.forEach((condition, i) => {
    const was = base.conditions[i];
    row[condition.name + " amplitude_jnd"] = analysis.difference("amplitude", was.amplitude_v.mean, condition.amplitude_v.mean);
    row[condition.name + " interval_jnd"] = analysis.difference("interval", was.interval_s.mean, condition.interval_s.mean);
  });
  row.pair_jnd = each.smallest_pair_jnd - base.smallest_pair_jnd;
  row.neighbours_min_jnd = each.neighbours.min_jnd - base.neighbours.min_jnd;
  row.neighbours_mean_jnd = each.neighbours.mean_jnd - base.neighbours.mean_jnd;
  row.per_train_jnd = each.gradual_jnd - base.gradual_jnd;
  return row;
}

// Amplitude and interval of each condition went this far, in just-noticeable differences.
function movedRow(difference) {
  const row = { encoding: difference.encoding };
  for (const name of NAMES) {
    const moved = ["amplitude", "interval"].map((axis) => difference[name + " " + axis + "_jnd"]);
    row[name] = moved.includes(null) ? null : moved.map((x) => (shown(x) > 0 ? "+" : "") + (shown(x) || 0).toFixed(2)).join(", ");
  }
  return row;
}

function tablesOf(done) {
  const first = ["encoding"];
  const differences = done.slice(1).map((each) => differenceRow(each, done[0]));
  const changes = ["pair_jnd", "neighbours_min_jnd", "neighbours_mean_jnd", "per_train_jnd"];
  const rounded = differences.map((each) => {
    const row = { encoding: each.encoding };
    for (const key of changes) row[key] = shown(each[key]);
    return row;
  });
  return [
    { caption: "Six encodings side by side", rows: done.map(comparisonRow),
      columns: first.concat(["amplitude_jnd", "interval_jnd", "pair_jnd", "mahalanobis", "variation_pct", "accuracy", "step_jnd", "separable"]) },
    { caption: "Levels in between: distance of neighbours", rows: done.map(levelRow),
      columns: first.concat(["texture_min_jnd", "texture_mean_jnd", "pressure_min_jnd", "pressure_mean_jnd", "all_min_jnd", "all_mean_jnd"]) },
    { caption: "The four conditions as measured", rows: done.map(conditionRow), columns: first.concat(NAMES) },
    { caption: "Against the default: conditions moved by (amplitude, interval; JND)", rows: differences.map(movedRow), columns: first.concat(NAMES) },
    { caption: "Against the default: distances (JND)", rows: rounded, columns: first.concat(changes) },
  ].filter((table) => table.rows.length > 0);
}

// All that come within a hundredth of the best: measurement does not tell them apart.
function bestOf(done, key) {
  const most = Math.max.apply(null, done.map(key));
  return done.filter((each) => key(each) > most - 0.01).map((each) => each.name).join(" or ") + " (" + Math.abs(most).toFixed(2) + " JND)";
}

// What the tables say by themselves, and where they end.
function conclusion(done) {
  return "The tables decide, at constant Weber fractions, which encoding keeps conditions farthest apart: " +
    bestOf(done, (each) => each.smallest_pair_jnd) + "; neighbouring levels of texture: " +
    bestOf(done, (each) => each.neighbours.texture_min_jnd) + ", of pressure: " +
    bestOf(done, (each) => each.neighbours.pressure_min_jnd) + ", of both: " + bestOf(done, (each) => each.neighbours.min_jnd) +
    "; and which moves least per train: " + bestOf(done, (each) => -each.gradual_jnd) +
    "; which one people tell apart, find natural or prefer they do not decide.";
}

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  const reference = checkReference(p);
  bench.disarm();
  if (!reference.passed) {
    return verdict({ verdict: "indeterminate", reference, encodings: [], reasons: [reference.reason + "; nothing was compared"] });
  }
  const trials = random.blocks(conditionsOf(p), p.repeats);
  const between = random.blocks(levels(), p.level_repeats);
  const done = [];
  for (const encoding of encodings()) {
    done.push(compare(p, encoding, trials, between));
    record.partial({ reference, encodings: done.slice() }, tablesOf(done));
  }
  report.text("R to A: texture sets the amplitude, pressure the interval; swapped: the other way round. The default is " + done[0].name +
    ". Conditions at R and P of " + p.low + " and " + p.high + ": at 0 and 1 all curves meet.");
  for (const table of tablesOf(done)) report.table(table.caption, table.rows, table.columns);
  report.figure("Four conditions under the default, " + done[0].name, plot.conditions(done[0]));
  report.figure("Exposure against limits", plot.exposure());
  const results = { reference, default: done[0].name, encodings: done, differences: done.slice(1).map((each) => differenceRow(each, done[0])) };
  const missing = done.filter((each) => each.smallest_pair_jnd === null || each.neighbours.min_jnd === null);
  // A comparison has no pass: it has a verdict only where it could not be made.
  results.verdict = missing.length > 0 ? "indeterminate" : null;
  results.conclusion = missing.length > 0 ? null : conclusion(done);
  results.reasons = missing.map((each) => each.name + ": a condition or a level was not measured");
  if (results.conclusion !== null) results.reasons.push(results.conclusion);
  report.text(results.reasons.join(". "));
  return verdict(results);
}
