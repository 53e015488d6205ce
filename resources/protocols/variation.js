// What would a pilot find? Virtual participants, drawn from stated distributions, before a real one is asked.
//
// Nothing here is measured: every figure and table is a prediction and says so.
protocol({
  title: "Variation: virtual participants",
  purpose: "How many people do the amplitudes serve, how well would those tell the conditions apart, and what can a " +
    "pilot of a few people show?",
  kind: "variation",
  needs: [],
  view: "none",
  parameters: {
    participants: { label: "Virtual participants", type: "integer", min: 2, max: 20000, value: 200 },
    trials: { label: "Trials per condition", type: "integer", min: 1, max: 1000, value: 25 },
    levels: {
      label: "Amplitudes",
      type: "choice",
      choices: { personal: "a range of each participant's own", profile: "the profile's, for everybody" },
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
    pilot: { label: "Participants of the pilot", type: "integer", min: 1, max: 1000, value: 5 },
    area: { label: "Area of each electrode", zero: "from the profile", unit: "cm2", min: 0, max: 1000, value: 0 },
    skin_spread: { label: "Skin, spread (geometric s.d., choice)", min: 1, max: 10, value: 1.5 },
    detection: { label: "Perception threshold, median", option: "analysis.variation.detection_ma", value: 3.5 },
    attention: { label: "Attention threshold, median", option: "analysis.variation.attention_ma", value: 6.9 },
    discomfort: { label: "Too strong from, median", option: "analysis.variation.discomfort_ma", value: 9.8 },
    intolerance: { label: "Intolerance threshold, median", option: "analysis.variation.intolerance_ma", value: 13.8 },
    threshold_spread: {
      label: "Thresholds, spread (geometric s.d., choice)",
      option: "analysis.variation.threshold_spread",
      value: 1.4,
    },
    weber_spread: {
      label: "Weber fractions, spread (geometric s.d., choice)",
      option: "analysis.variation.weber_spread",
      value: 1.25,
    },
    lapse: { label: "Largest lapse rate", unit: "%", min: 0, max: 100, value: 6 },
    noise: { label: "Noise of what is felt", option: "analysis.variation.noise_jnd", value: 1 },
  },
});

const MARK = ", predicted, not measured";  // the report adds that it is simulated
const OWN_RANGE = "A range of each participant's own";

function predict(p, levels, label, changed) {
  const options = { participants: p.participants, trials: p.trials, levels: levels, source: p.source, guess: p.guess,
    width: p.width / 100, pilot: p.pilot, detection_ma: p.detection, attention_ma: p.attention,
    discomfort_ma: p.discomfort, intolerance_ma: p.intolerance, threshold_spread: p.threshold_spread,
    weber_spread: p.weber_spread, lapse_most: p.lapse / 100, noise_jnd: p.noise, label: label };
  if (p.area > 0) options.area_cm2 = p.area;
  if (p.skin_spread !== 1.5) options.skin_spread = p.skin_spread;
  return analysis.variation(Object.assign(options, changed));
}

// "94.8 (66.7 to 99.2)": the median, 5 and 95 %. One participant has no range, and none has no number.
function spread(estimate, digits, factor) {
  const shown = (x) => (factor * x).toFixed(digits);
  const middle = estimate.median !== undefined ? estimate.median : estimate.value;
  if (middle === null) return "–";
  if (estimate.low === estimate.high) return shown(middle);
  return shown(middle) + " (" + shown(estimate.low) + " to " + shown(estimate.high) + ")";
}

function percent(estimate) {
  return spread(estimate, 1, 100);
}

function share(x) {
  return (100 * x).toFixed(0) + " %";
}

function volts(range) {
  return range[0] + " to " + range[1] + " V";
}

function fixedRange(found) {
  const papers = found.range_v[0] === 10 && found.range_v[1] === 40;
  return (papers ? "The design paper's " : "The profile's ") + volts(found.range_v);
}

// How many are served stands before anything else that is found.
function headline(p, fixed, personal) {
  const why = [];
  if (fixed.participants_refused > 0) {
    const strong = fixed.withheld.every((each) => each.reason === "too strong for the participant");
    why.push(fixed.participants_refused + " would be refused " +
      (strong ? fixed.range_v[1] + " V as too strong" : "part of it"));
  }
  if (fixed.participants_not_feeling > 0) {
    why.push(fixed.participants_not_feeling + " are given all of it and do not feel " + fixed.range_v[0] + " V");
  }
  if (fixed.participants_without_range > 0) why.push(fixed.participants_without_range +
    " cannot be given it by this device");
  const out = [fixedRange(fixed) + " serves " + fixed.served + " of " + fixed.participants + " virtual participants" +
    (why.length > 0 ? ": " + why.join(", ") : "") + "."];
  if (personal.served === 0) return out.concat("A range of their own within it serves none of them either.");
  out.push("A range of their own within it serves " + personal.served + " of " + personal.participants + "; " +
    personal.clearly_separable +
      " of these have every pair of conditions 5 just-noticeable differences apart, and of their " +
      "answers " + percent(personal.accuracy) + " % would be right (median; 5 to 95 % of them).");
  const pilot = personal.pilots.find((each) => each.people === p.pilot);
  out.push("A pilot of " + p.pilot + (p.pilot === 1 ? " person" : " people") +
    " with such ranges: all are served with " +
    share(pilot.all_served) + " probability; if all are above chance, at least " + share(pilot.prevalence_all) +
    " of such people can do it (95 %).");
  return out;
}

function summary(name, found) {
  return { amplitudes: name, served: found.served, participants_refused: found.participants_refused,
    participants_not_feeling: found.participants_not_feeling,
    participants_without_range: found.participants_without_range, clearly_separable: found.clearly_separable,
    accuracy: found.accuracy };
}

// Where comfort ends is not known: what is served is said for the lowest, the run's and the highest answer.
function readings(p, fixed, personal) {
  const at = [["the attention threshold", p.attention], ["the run's setting", p.discomfort],
    ["the intolerance threshold", p.intolerance]];
  return at.map(([name, milliamps]) => {
    const same = milliamps === p.discomfort;
    const changed = { discomfort_ma: milliamps };
    const shared = same ? fixed : predict(p, "profile", "Too strong from " + milliamps + " mA, fixed amplitudes",
      changed);
    const own = same ? personal : predict(p, "personal", "Too strong from " + milliamps + " mA, personal amplitudes",
      changed);
    return { too_strong_from: name, median_ma: milliamps, fixed_served: shared.served,
      fixed_refused: shared.participants_refused,
      fixed_not_feeling: shared.participants_not_feeling, personal_served: own.served, accuracy: own.accuracy,
      presented_accuracy: own.presented_accuracy, presented_fixed_accuracy: shared.presented_accuracy };
  });
}

// What a pilot wants to show, and how many answers that takes.
function aimsOf(needed) {
  const aim = (text, alone, pooled) => ({ aim: text, one_participant: alone, pooled_each: pooled.per_participant,
    pooled_trials: pooled.total, design_effect: pooled.design_effect,
    participants_at_least: pooled.participants_least });
  return [aim("95 % interval at most " + (100 * needed.width).toFixed(0) + " % wide",
    needed.per_participant.for_width, needed.pooled.for_width),
  aim("lower end above chance, " + (100 * needed.chance).toFixed(0) + " %", needed.per_participant.above_chance,
    needed.pooled.above_chance)];
}

// What is not everybody's result.
function remarks(p, found) {
  const out = ["Everything here is simulated: predicted from stated distributions, not measured on people. A " +
    "condition counts for a participant only if it is presented, felt and not too strong."];
  if (p.source === "voltage") out.push("A voltage source is refused for people: this shows what it would do, judged " +
    "as on a bench load.");
  if (found.model.electrode_area_cm2 === null) out.push("No electrode area is stated: the skin is that under " +
    found.model.skin_area_cm2 + " cm².");
  const missing = found.participants - found.served;
  if (missing > 0) {
    const withheld = found.withheld.map((each) => each.count + " times " + each.reason).join(", ");
    out.push(missing + " of " + found.participants +
      " virtual participants are not served and are left out of accuracy and confusion" +
      (withheld === "" ? "." : ". Conditions that were withheld: " + withheld + "."));
  }
  if (found.trials_needed === null) out.push("No one is served, so there is no accuracy to predict.");
  return out;
}

// Who is served stands before anything else that was found.
function write(p, fixed, personal, found, said) {
  report.text(said.join(" "));
  report.figure("Thresholds and currents of the participants" + MARK, plot.predicted(fixed, "thresholds"));
  report.text("Where comfort ends is not known: somewhere from the attention to the intolerance threshold. The run " +
    "takes " + p.discomfort + " mA.");
  remarks(p, found).forEach((each) => report.text(each));
  report.figure("Confusion" + MARK, plot.predicted(found, "confusion"));
  report.figure("Accuracy of the served" + MARK, plot.predicted(found, "accuracy"));
  report.figure("Width of the interval" + MARK, plot.predicted(found, "width"));
}

// What results keep of the amplitudes that the run did not choose.
function comparedWith(levels, other) {
  return {
    levels: levels,
    accuracy: other.accuracy,
    complete: other.complete,
    refused: other.refused,
    not_felt: other.not_felt,
    served: other.served,
    participants_refused: other.participants_refused,
    participants_not_feeling: other.participants_not_feeling,
    participants_without_range: other.participants_without_range,
    presented_accuracy: other.presented_accuracy,
    conditions: other.conditions,
    people: other.people,
  };
}

function run(p) {
  // The same participants get the chosen amplitudes and, to compare, the others.
  const personalChosen = p.levels === "personal";
  const other = personalChosen ? "profile" : "personal";
  const found = predict(p, p.levels, "Virtual participants");
  const compared = predict(p, other, "Virtual participants, " + other + " amplitudes");
  const fixed = personalChosen ? compared : found;
  const personal = personalChosen ? found : compared;

  // What is too strong for a person is not known, and a bench is only as good as its tolerances.
  const read = readings(p, fixed, personal);
  const benches = analysis.uncertainBench({ source: p.source });

  const said = headline(p, fixed, personal);
  write(p, fixed, personal, found, said);

  const results = Object.assign({ verdict: null, reasons: said, headline: said.join(" "), levels: p.levels,
    source: p.source, profile_served: fixed.served, personal_served: personal.served, readings: read }, found);
  results.other_levels = comparedWith(other, compared);
  results.bench = benches;
  results.ranges = [summary(fixedRange(fixed), fixed), summary(OWN_RANGE, personal)];
  if (results.trials_needed !== null) results.trials_needed.aims = aimsOf(results.trials_needed);
  verdict(results);
  return null;
}
