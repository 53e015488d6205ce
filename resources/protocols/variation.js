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
    skin_spread: { label: "Skin, spread (geometric s.d., chosen)", min: 1, max: 10, value: 1.5 },
    detection: { label: "Perception threshold, median", option: "analysis.variation.detection_ma", value: 3.5 },
    attention: { label: "Attention threshold, median", option: "analysis.variation.attention_ma", value: 6.9 },
    discomfort: { label: "Too strong from, median", option: "analysis.variation.discomfort_ma", value: 9.8 },
    intolerance: { label: "Intolerance threshold, median", option: "analysis.variation.intolerance_ma", value: 13.8 },
    threshold_spread: {
      label: "Thresholds, spread (geometric s.d., chosen)",
      option: "analysis.variation.threshold_spread",
      value: 1.4,
    },
    weber_spread: {
      label: "Weber fractions, spread (geometric s.d., chosen)",
      option: "analysis.variation.weber_spread",
      value: 1.25,
    },
    lapse: { label: "Largest lapse rate", unit: "%", min: 0, max: 100, value: 6 },
    noise: { label: "Noise of what is felt", option: "analysis.variation.noise_jnd", value: 1 },
  },
});

function run(p) {
  const options = { participants: p.participants, trials: p.trials, levels: p.levels, source: p.source, guess: p.guess,
    width: p.width / 100, pilot: p.pilot, detection_ma: p.detection, attention_ma: p.attention,
    discomfort_ma: p.discomfort, intolerance_ma: p.intolerance, threshold_spread: p.threshold_spread,
    weber_spread: p.weber_spread, lapse_most: p.lapse / 100, noise_jnd: p.noise };
  if (p.area > 0) options.area_cm2 = p.area;
  if (p.skin_spread !== 1.5) options.skin_spread = p.skin_spread;

  // The same participants get the chosen amplitudes and, to compare, the others.
  bench.variation.begin(options);
  // What is too strong for a person is not known, and a bench is only as good as its tolerances.
  bench.variation.readings();
  verdict(bench.variation.conclude());
  return null;
}
