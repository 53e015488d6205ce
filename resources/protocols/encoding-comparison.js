// Which of R and P should set the amplitude, and along which curve?
//
// The same trials in the same order under both assignments and the three curves, each judged on what the oscilloscope
// saw. R and P are set directly, so that the encoding alone makes the difference.
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
    traverse_s: { label: "A finger crosses the plane in", unit: "s", min: 0.1, max: 600, value: 5 },
  },
});

const ASSIGNMENTS = { texture_to_amplitude: "texture to amplitude", swapped: "swapped" };
const CURVES = ["linear", "logarithmic", "power"];
const LEVELS = [0.25, 0.5, 0.75];

// The first of them is the default that the others are compared with.
function encodings() {
  const out = [];
  for (const assignment of Object.keys(ASSIGNMENTS)) {
    for (const curve of CURVES) out.push({ assignment, curve, name: ASSIGNMENTS[assignment] + ", " + curve });
  }
  return out;
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

const best = (pair) => Math.max(pair.amplitude_jnd, pair.interval_jnd);
const smallest = (values) => (values.length === 0 || values.some((x) => x === null || !isFinite(x)) ? null : Math.min.apply(null, values));
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
    amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });
  const sweep = analysis.transitions({ traverse_s: p.traverse_s });
  bench.arm({ load: p.load });
  const found = analysis.separability(measureAll(trials, encoding), { conditions: conditionsOf(p).map((each) => each.name) });
  const inBetween = analysis.separability(measureAll(between, encoding), { conditions: levels().map((each) => each.name) });
  bench.disarm();
  return {
    name: encoding.name,
    assignment: encoding.assignment,
    curve: encoding.curve,
    conditions: found.conditions,
    pairs: found.pairs,
    smallest_amplitude_jnd: smallest(found.pairs.map((pair) => pair.amplitude_jnd)),
    smallest_interval_jnd: smallest(found.pairs.map((pair) => pair.interval_jnd)),
    smallest_pair_jnd: smallest(found.pairs.map(best)),
    mahalanobis_min: smallest(found.pairs.map((pair) => pair.mahalanobis)),
    amplitude_variation_max: Math.max.apply(null, found.conditions.map((each) => each.amplitude_variation)),
    interval_variation_max: Math.max.apply(null, found.conditions.map((each) => each.interval_variation)),
    accuracy: found.accuracy,
    separable: found.verdict,
    neighbours: neighbours(inBetween.pairs),
    levels: inBetween.conditions,
    gradual_jnd: sweep.gradual.largest_jnd,
    abrupt_jnd: sweep.abrupt.largest_jnd,
  };
}

function comparisonRow(each) {
  return {
    encoding: each.name,
    pair_amplitude_jnd: each.smallest_amplitude_jnd,
    pair_interval_jnd: each.smallest_interval_jnd,
    pair_best_jnd: each.smallest_pair_jnd,
    mahalanobis: each.mahalanobis_min,
    cv_pct: 100 * Math.max(each.amplitude_variation_max, each.interval_variation_max),
    accuracy: each.accuracy.value,
    accuracy_low: each.accuracy.low,
    accuracy_high: each.accuracy.high,
    step_jnd: each.gradual_jnd,
    separable: each.separable,
  };
}

function levelRow(each) {
  const n = each.neighbours;
  return { encoding: each.name, texture_min_jnd: n.texture_min_jnd, texture_mean_jnd: n.texture_mean_jnd,
    pressure_min_jnd: n.pressure_min_jnd, pressure_mean_jnd: n.pressure_mean_jnd, all_min_jnd: n.min_jnd, all_mean_jnd: n.mean_jnd };
}

function conditionRows(each) {
  return each.conditions.map((condition) => ({ encoding: each.name, condition: condition.name,
    amplitude_v: condition.amplitude_v.mean, interval_s: condition.interval_s.mean }));
}

// Against the default, signed: where a condition's amplitude and interval went, and what that did to the distances.
function differenceRow(each, base) {
  const row = { encoding: each.name };
  each.conditions.forEach((condition, i) => {
    const was = base.conditions[i];
    row[condition.name + " amplitude_jnd"] = analysis.difference("amplitude", was.amplitude_v.mean, condition.amplitude_v.mean);
    row[condition.name + " interval_jnd"] = analysis.difference("interval", was.interval_s.mean, condition.interval_s.mean);
  });
  row.pair_best_jnd = each.smallest_pair_jnd - base.smallest_pair_jnd;
  row.neighbours_min_jnd = each.neighbours.min_jnd - base.neighbours.min_jnd;
  row.neighbours_mean_jnd = each.neighbours.mean_jnd - base.neighbours.mean_jnd;
  row.step_jnd = each.gradual_jnd - base.gradual_jnd;
  return row;
}

function tablesOf(done) {
  let conditions = [];
  for (const each of done) conditions = conditions.concat(conditionRows(each));
  const differences = done.slice(1).map((each) => differenceRow(each, done[0]));
  const where = ["smooth-low", "smooth-high", "rough-low", "rough-high"];
  const moved = (quantity) => where.map((name) => name + " " + quantity + "_jnd");
  const out = [
    { caption: "Six encodings side by side", rows: done.map(comparisonRow) },
    { caption: "Levels in between: distance of neighbours", rows: done.map(levelRow) },
    { caption: "The four conditions as measured", rows: conditions },
  ];
  if (differences.length === 0) return out;
  return out.concat([
    { caption: "Against the default: amplitude of each condition (JND)", rows: differences, columns: ["encoding"].concat(moved("amplitude")) },
    { caption: "Against the default: interval of each condition (JND)", rows: differences, columns: ["encoding"].concat(moved("interval")) },
    { caption: "Against the default: distances (JND)", rows: differences,
      columns: ["encoding", "pair_best_jnd", "neighbours_min_jnd", "neighbours_mean_jnd", "step_jnd"] },
  ]);
}

// What the table says by itself, and where it ends.
function conclusion(done) {
  const by = (key) => done.slice().sort((a, b) => key(b) - key(a))[0];
  const pair = by((each) => each.smallest_pair_jnd);
  const level = by((each) => each.neighbours.min_jnd);
  const gentle = by((each) => -each.gradual_jnd);
  return "The table decides which encoding keeps conditions and levels farthest apart at constant Weber fractions (conditions: " +
    pair.name + ", " + pair.smallest_pair_jnd.toFixed(1) + " JND; neighbouring levels: " + level.name + ", " +
    level.neighbours.min_jnd.toFixed(2) + " JND) and which moves least per train (" + gentle.name + ", " +
    gentle.gradual_jnd.toFixed(1) + " JND); equal entries are ties, and which one people tell apart, find natural or prefer it does not decide.";
}

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  const trials = random.blocks(conditionsOf(p), p.repeats);
  const between = random.blocks(levels(), p.level_repeats);
  const done = [];
  for (const encoding of encodings()) {
    done.push(compare(p, encoding, trials, between));
    record.partial({ encodings: done.slice() }, tablesOf(done));
  }
  for (const table of tablesOf(done)) report.table(table.caption, table.rows, table.columns);
  report.figure("Exposure against limits", plot.exposure());
  const results = { default: done[0].name, encodings: done, differences: done.slice(1).map((each) => differenceRow(each, done[0])) };
  const missing = done.filter((each) => each.smallest_pair_jnd === null || each.neighbours.min_jnd === null);
  // A comparison has no pass: it has a verdict only where it could not be made.
  results.verdict = missing.length > 0 ? "indeterminate" : null;
  results.conclusion = missing.length > 0 ? null : conclusion(done);
  results.reasons = missing.map((each) => each.name + ": a condition or a level was not measured");
  if (results.conclusion !== null) results.reasons.push(results.conclusion);
  report.text(results.reasons.join(". "));
  return verdict(results);
}
