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
    const measured = measure.train(bench.capture({ trains: 2, intervals: true }));
    record.trial(place.name, Object.assign({ encoding: encoding.name }, measured));
    rows.push(Object.assign({ condition: place.name }, measured));
  }
  return rows;
}

// What was not measured has no largest: Math.max takes null for 0.
const largest = (values) => (values.some((x) => x === null || !isFinite(x)) ? null : Math.max.apply(null, values));
const best = (pair) => largest([pair.amplitude_jnd, pair.interval_jnd]);
const smallest = (values) => (values.length === 0 || values.some((x) => x === null || !isFinite(x)) ? null
  : Math.min.apply(null, values));
// Compares one axis: pairs that share its level do not concern it.
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
    amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0, hold: "voltage" });
  const sweep = analysis.transitions({ traverse_s: p.traverse_s });
  bench.arm({ load: p.load });
  const found = analysis.separability(measureAll(trials, encoding), { conditions: NAMES });
  const inBetween = analysis.separability(measureAll(between, encoding),
    { conditions: levels().map((each) => each.name) });
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

// The distances that a curve gives, of one assignment: by what is felt as amplitude and as interval, not by what sets
// it.
function distancesOf(each) {
  const n = each.neighbours, swapped = each.assignment === "swapped";
  return {
    amplitude_jnd: each.smallest_amplitude_jnd,
    interval_jnd: each.smallest_interval_jnd,
    pair_jnd: each.smallest_pair_jnd,
    amplitude_levels_jnd: swapped ? n.pressure_min_jnd : n.texture_min_jnd,
    interval_levels_jnd: swapped ? n.texture_min_jnd : n.pressure_min_jnd,
    step_jnd: each.gradual_jnd,
  };
}

// How far the two assignments of a curve differ as measured, once smooth-high and rough-low have changed places: the
// largest over all distances and conditions, just-noticeable differences. Null before a curve was measured under both.
function asymmetryOf(done) {
  const found = [];
  for (const usual of done.filter((each) => each.assignment === "texture_to_amplitude")) {
    const swapped = done.find((each) => each.assignment === "swapped" && each.curve === usual.curve);
    if (swapped === undefined) continue;
    const a = distancesOf(usual), b = distancesOf(swapped);
    for (const key of Object.keys(a)) found.push(a[key] === null || b[key] === null ? null : Math.abs(a[key] - b[key]));
    [0, 2, 1, 3].forEach((there, here) => {
      for (const [axis, key] of [["amplitude", "amplitude_v"], ["interval", "interval_s"]]) {
        const moved = analysis.difference(axis, usual.conditions[here][key].mean, swapped.conditions[there][key].mean);
        found.push(moved === null ? null : Math.abs(moved));
      }
    });
  }
  return found.length === 0 ? null : largest(found);
}

// Against the default, signed: where a condition's amplitude and interval went, and what that did to the distances.
function differenceRow(each, base) {
  const row = { encoding: each.name };
  each.conditions.forEach((condition, i) => {
    const was = base.conditions[i];
    row[condition.name + " amplitude_jnd"] = analysis.difference("amplitude", was.amplitude_v.mean,
      condition.amplitude_v.mean);
    row[condition.name + " interval_jnd"] = analysis.difference("interval", was.interval_s.mean,
      condition.interval_s.mean);
  });
  row.pair_jnd = each.smallest_pair_jnd - base.smallest_pair_jnd;
  row.neighbours_min_jnd = each.neighbours.min_jnd - base.neighbours.min_jnd;
  row.neighbours_mean_jnd = each.neighbours.mean_jnd - base.neighbours.mean_jnd;
  row.per_train_jnd = each.gradual_jnd - base.gradual_jnd;
  return row;
}

// Each condition under each encoding, and how far it moved against the default.
function conditionRows(done, differences) {
  const rows = [];
  done.forEach((each, i) => {
    for (const condition of each.conditions) {
      const moved = i > 0 ? differences[i - 1] : {};
      rows.push(Object.assign({ encoding: each.name, amplitude_jnd: moved[condition.name + " amplitude_jnd"],
        interval_jnd: moved[condition.name + " interval_jnd"] }, condition));
    }
  });
  return rows;
}

// All curves that come within a hundredth of the best: measurement does not tell them apart.
function bestOf(curves, key) {
  const most = Math.max.apply(null, curves.map(key));
  return curves.filter((each) => key(each) > most - 0.01).map((each) => each.curve).join(" or ") + " (" +
    Math.abs(most).toFixed(2) + " JND)";
}

// What the figures say by themselves, and where they end.
function symmetry(asymmetry) {
  return "Swapping R and P is a symmetry of this metric: it exchanges smooth-high and rough-low, and texture and " +
    "pressure, and leaves every distance as it is" + (asymmetry === null ? "" : " (measured: within " +
    Math.max(0.01, asymmetry).toFixed(2) + " JND)") +
    ". No figure here can prefer one assignment; people decide which is told apart, natural or preferred";
}

function conclusion(done) {
  const curves = done.filter((each) => each.assignment === "texture_to_amplitude");
  const axis = (name) => (each) => distancesOf(each)[name];
  return "At constant Weber fractions the curve that keeps the conditions farthest apart is " +
    bestOf(curves, axis("pair_jnd")) +
    "; neighbouring levels in amplitude " + bestOf(curves, axis("amplitude_levels_jnd")) + ", in interval " +
    bestOf(curves, axis("interval_levels_jnd")) + "; the one that moves least per train " +
      bestOf(curves, (each) => -each.gradual_jnd);
}

// What is the same for all is said once.
function sameForAll(done) {
  const accuracies = done.map((each) => each.accuracy);
  const least = Math.min.apply(null, accuracies.map((each) => (each.low === null ? 0 : each.low)));
  const verdicts = Array.from(new Set(done.map((each) => each.separable)));
  return "Recognised trials: " + (100 * Math.min.apply(null, accuracies.map((each) => each.value || 0))).toFixed(1) +
    " % or more under every encoding (95 % interval from " + (100 * least).toFixed(1) +
      " %); separable by an oscilloscope: " + verdicts.join(", ") + ".";
}

function run(p) {
  if (!(p.low < p.high)) throw new Error("low is " + p.low + "; below high, " + p.high + ", is expected");
  report.text(symmetry(null) + ".");
  operator.wired(p.load);
  const reference = bench.readKnownLoad(p.load, p.load_tolerance_pct);
  bench.disarm();
  if (!reference.passed) {
    return verdict({ verdict: "indeterminate", reference, encodings: [],
      reasons: [reference.reason + "; nothing was compared"] });
  }
  const trials = random.blocks(conditionsOf(p), p.repeats);
  const between = random.blocks(levels(), p.level_repeats);
  const done = [];
  for (const encoding of encodings()) {
    done.push(compare(p, encoding, trials, between));
    record.partial({ reference, encodings: done.slice() });
  }
  const asymmetry = asymmetryOf(done);
  report.text("Both assignments were measured along three curves, and differ by no more than " +
    (asymmetry === null ? "?" : Math.max(0.01, asymmetry).toFixed(2)) +
    " JND. Below is the default, texture to amplitude and pressure to interval; swapped, it comes out the same. " +
    "Amplitude and interval are the smallest distances of pairs that differ in them, the worst pair is the smaller " +
    "of the two; levels are neighbours in between. Conditions at R and P of " + p.low + " and " + p.high +
      "; at 0 and 1 all curves meet. Levels at R and P of " + LEVELS.join(", ") +
    "; a train, at most: the largest step from train to train when a finger crosses the plane in " + p.traverse_s +
      " s, computed, without limits on a step.");
  report.text(sameForAll(done));
  report.figure("Four conditions under the default, " + done[0].name, plot.conditions(done[0]));
  report.figure("Exposure against limits", plot.exposure());
  const differences = done.slice(1).map((each) => differenceRow(each, done[0]));
  const results = { reference, default: done[0].name, encodings: done, differences,
    conditions: conditionRows(done, differences), asymmetry_jnd: asymmetry };
  const missing = done.filter((each) => each.smallest_pair_jnd === null || each.neighbours.min_jnd === null);
  // A comparison has no pass: it has a verdict only where it could not be made.
  results.verdict = missing.length > 0 ? "indeterminate" : null;
  results.conclusion = missing.length > 0 ? null : symmetry(asymmetry) + ". " + conclusion(done);
  results.reasons = missing.map((each) => each.name + ": a condition or a level was not measured");
  if (results.conclusion !== null) results.reasons.push(symmetry(asymmetry), conclusion(done));
  return verdict(results);
}
