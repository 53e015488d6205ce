// What would a pilot find? Virtual participants, drawn from stated distributions, before a real one is asked.
//
// Nothing here is measured: every figure and table is a prediction and says so.
protocol({
  title: "Variation: virtual participants",
  purpose: "How far would people differ in telling the conditions apart, and how many trials does a pilot need?",
  needs: [],
  parameters: {
    participants: { label: "Virtual participants", type: "integer", min: 2, max: 20000, value: 200 },
    trials: { label: "Trials per condition", type: "integer", min: 1, max: 1000, value: 25 },
    levels: {
      label: "Amplitudes",
      type: "choice",
      choices: { personal: "between each participant's thresholds", profile: "the profile's, for everybody" },
      value: "personal",
    },
    source: {
      label: "Source",
      type: "choice",
      choices: { current: "current, A / |Z|", voltage: "voltage (bench only)" },
      value: "current",
    },
    guess: {
      label: "Nothing felt",
      type: "choice",
      choices: { none: "answers none", uniform: "guesses" },
      value: "none",
    },
    width: { label: "Wanted width of the 95 % interval", unit: "%", min: 2, max: 100, value: 10 },
    pilot: { label: "Participants of the pilot", type: "integer", min: 1, max: 1000, value: 12 },
    skin_spread: { label: "Skin, spread (geometric s.d.)", min: 1, max: 10, value: 1.5 },
    detection: { label: "Detection threshold, median", unit: "mA", min: 0.1, max: 50, value: 3.5 },
    discomfort: { label: "Discomfort threshold, median", unit: "mA", min: 0.2, max: 200, value: 13.8 },
    threshold_spread: { label: "Thresholds, spread (geometric s.d.)", min: 1, max: 10, value: 1.4 },
    weber_spread: { label: "Weber fractions, spread (geometric s.d.)", min: 1, max: 10, value: 1.25 },
    lapse: { label: "Largest lapse rate", unit: "%", min: 0, max: 100, value: 6 },
    noise: { label: "Noise of what is felt", unit: "JND", min: 0.1, max: 20, value: 1 },
  },
});

const MARK = " (predicted, not measured)";  // the report adds that it is simulated

function predict(p, levels, label) {
  return analysis.variation({ participants: p.participants, trials: p.trials, levels: levels, source: p.source,
    guess: p.guess, width: p.width / 100, pilot: p.pilot, skin_spread: p.skin_spread, detection_ma: p.detection,
    discomfort_ma: p.discomfort, threshold_spread: p.threshold_spread, weber_spread: p.weber_spread,
    lapse_most: p.lapse / 100, noise_jnd: p.noise, label: label });
}

// An accuracy as the tables take it: its median and 5 to 95 % of the participants.
function percent(accuracy) {
  if (accuracy.median === null) return null;
  return { value: 100 * accuracy.median, low: 100 * accuracy.low, high: 100 * accuracy.high };
}

// A thousandth of a just-noticeable difference says nothing.
function rounded(estimate) {
  const digits = (x) => (x === null ? null : Math.round(1000 * x) / 1000);
  return { value: digits(estimate.value), low: digits(estimate.low), high: digits(estimate.high) };
}

function summary(name, found) {
  return { amplitudes: name, participants: found.participants, presented_all: found.complete,
    refused: found.refused, not_felt: found.not_felt, accuracy_pct: percent(found.accuracy),
    information_bits: found.information_bits.median };
}

function pilotRows(needed) {
  if (needed === null) return [];
  const rows = [];
  const add = (aim, alone, pooled) => rows.push({ aim: aim, one_participant: alone,
    pooled_each: pooled.per_participant, pooled_trials: pooled.total, design_effect: pooled.design_effect,
    participants_at_least: pooled.participants_least });
  add("95 % interval at most " + (100 * needed.width).toFixed(0) + " % wide", needed.per_participant.for_width, needed.pooled.for_width);
  add("lower end above chance, " + (100 * needed.chance).toFixed(0) + " %", needed.per_participant.above_chance, needed.pooled.above_chance);
  return rows;
}

// What is not everybody's result is said first.
function remarks(p, found) {
  const out = ["Everything in this report is simulated: predicted from stated distributions, not measured on anybody."];
  if (p.source === "voltage") out.push("A voltage source is refused for people: this shows what it would do, judged as on a bench load.");
  const missing = found.participants - found.complete;
  if (missing > 0) {
    out.push(missing + " of " + found.participants + " virtual participants were not presented every condition and are left out of accuracy and confusion: " +
      found.withheld.map((each) => each.count + " times " + each.reason).join(", ") + ".");
  }
  if (found.trials_needed === null) out.push("Nobody was presented every condition, so there is no accuracy to predict.");
  return out;
}

function run(p) {
  const found = predict(p, p.levels, "Virtual participants");
  const other = p.levels === "personal" ? "profile" : "personal";
  const compared = predict(p, other, "Virtual participants, " + other + " amplitudes");
  const names = { personal: "between the participant's thresholds", profile: "the profile's" };
  const bench = analysis.uncertainBench({ source: p.source });

  remarks(p, found).forEach((each) => report.text(each));
  report.figure("Confusion" + MARK, plot.predicted(found, "confusion"));
  report.figure("Accuracy of virtual participants" + MARK, plot.predicted(found, "accuracy"));
  report.figure("Width of the interval" + MARK, plot.predicted(found, "width"));
  report.text("In every table a value is the median, and in brackets stand 5 and 95 %, of participants or of benches.");
  report.table("Which amplitudes" + MARK, [summary(names[p.levels], found), summary(names[other], compared)],
    ["amplitudes", "participants", "presented_all", "refused", "not_felt", "accuracy_pct", "information_bits"]);
  report.table("Conditions" + MARK, found.conditions,
    ["name", "presented", "refused", "not_felt", "current_ma", "voltage_v"]);
  report.table("Separability" + MARK, found.separability, ["a", "b", "jnd", "amplitude_jnd", "interval_jnd"]);
  report.table("Trials that a pilot of " + p.pilot + " needs" + MARK, pilotRows(found.trials_needed),
    ["aim", "one_participant", "pooled_each", "pooled_trials", "design_effect", "participants_at_least"]);
  if (found.trials_needed !== null) report.text(found.trials_needed.assumptions);
  report.table("Withheld, participants times conditions" + MARK, found.withheld, ["reason", "count"]);
  report.table("Benches within their tolerances" + MARK, bench.conditions, ["name", "amplitude_v", "interval_s"]);
  report.table("Benches: distance of the conditions" + MARK, bench.pairs.map((each) => ({ a: each.a, b: each.b,
    amplitude_jnd: rounded(each.amplitude_jnd), interval_jnd: rounded(each.interval_jnd) })), ["a", "b", "amplitude_jnd", "interval_jnd"]);

  const results = Object.assign({ verdict: null, levels: p.levels, source: p.source }, found);
  results.other_levels = { levels: other, accuracy: compared.accuracy, complete: compared.complete,
    refused: compared.refused, not_felt: compared.not_felt };
  results.bench = bench;
  verdict(results);
  return null;
}
