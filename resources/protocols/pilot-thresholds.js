// What can this participant feel today, and from where is it too strong? Three steps, and a fourth where the study has
// it; each answer is on disk before the next presentation. A study with massagers has a massager in the stimulator's
// place.
protocol({
  title: "Pilot session: thresholds",
  purpose: "Find the levels between which this participant's conditions lie today.",
  kind: "pilot-thresholds",
  needs: ["stimulator"],
  view: "none",
  parameters: {
    participant: { label: "Participant: a code, or virtual:SEED", type: "text", value: "" },
    language: { label: "Language of the participant: a code such as de", type: "text", value: "" },
    unfinished: {
      label: "An unfinished session",
      type: "choice",
      choices: { ask: "is named, and nothing is done", resume: "goes on", end: "is ended, and a new one begins" },
      value: "ask",
    },
    modality: {
      label: "Felt through (rehearsals; a study has its own)",
      type: "choice",
      choices: { study: "as the study or the named device says", electrodes: "electrodes", massager: "a massager" },
      value: "study",
    },
    blocks: { label: "Blocks of the test: not used here", type: "integer", min: 1, max: 50, value: 5 },
    exclusions: { label: "Checklist: items answered yes", type: "text", value: "" },
    method: {
      label: "Detection by",
      type: "choice",
      choices: { quest: "QUEST+", staircase: "weighted staircase" },
      value: "quest",
    },
    comparison: {
      label: "Weber fraction of strength",
      type: "choice",
      choices: { no: "is not measured", yes: "is measured, by 40 trials" },
      value: "no",
    },
    detection: {
      label: "Virtual: perception threshold, median",
      option: "analysis.variation.detection_ma",
      value: 3.5,
    },
    attention: { label: "Virtual: attention threshold, median", option: "analysis.variation.attention_ma", value: 6.9 },
    discomfort: { label: "Virtual: too strong from, median", option: "analysis.variation.discomfort_ma", value: 9.8 },
    intolerance: {
      label: "Virtual: intolerance threshold, median",
      option: "analysis.variation.intolerance_ma",
      value: 13.8,
    },
    noise: { label: "Virtual: noise of what is felt", option: "analysis.variation.noise_jnd", value: 1 },
    adaptation: { label: "Virtual: thresholds rise by at most", min: 0, max: 10, value: 0 },
  },
});

function run(p) {
  // Both STOPs, the skin and the electrodes, before anything is presented.
  pilot.begin({ trials: false });
  pilot.sideEffects("before");

  // Without a usable range the operator may have the three steps done again.
  do {
    // 1. Rising levels, three times, until "too strong".
    pilot.ascendingLimits();
    // 2. The detection threshold: "in the first or in the second interval?"
    pilot.detection({ method: p.method });
    // 3. The range, accepted for half an hour.
  } while (!pilot.range().usable && pilot.measureAgain());
  // 4. How much stronger must it be to be told apart? "In which interval was it stronger?"
  if (p.comparison === "yes") pilot.comparison();

  pilot.skin("after");
  pilot.sideEffects("after");
  pilot.finish("complete");
  verdict(pilot.results("thresholds"));
}
