// Can this participant tell the four tactile conditions apart? Thresholds first, then training, then test blocks
// without feedback. Each answer is on disk before the next presentation; an interrupted session goes on with
// the first trial of its order that has no answer. A study with massagers has a massager in the stimulator's place:
// strength for current, no electrodes.
protocol({
  title: "Pilot session: identification",
  purpose: "Can this participant tell the four tactile conditions apart?",
  kind: "pilot-identification",
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
    blocks: { label: "Blocks of the test (rehearsals)", type: "integer", min: 1, max: 50, value: 5 },
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

const SHORT_BREAK = 60; // s, between blocks
const LONG_BREAK = 300; // s, after the third block, with a look at the skin

function run(p) {
  // The order of all trials is drawn and stored; both STOPs, the skin and the electrodes are checked.
  pilot.begin();
  pilot.sideEffects("before");

  // What is felt, and from where it is too strong. Without a usable range the operator may have it measured again.
  let range;
  do {
    pilot.ascendingLimits();
    pilot.detection({ method: p.method });
    range = pilot.range();
  } while (!range.usable && pilot.measureAgain());
  if (!range.usable) {
    pilot.skin("after");
    pilot.sideEffects("after");
    pilot.finish("no usable range");
    verdict(pilot.results("identification"));
    return;
  }

  // How much stronger must it be to be told apart? Asked where the approval has it.
  if (p.comparison === "yes") pilot.comparison();

  // The four conditions with their names, then with feedback.
  pilot.familiarise();
  pilot.train();

  // The test: four of each condition and two empty presentations in each block, without feedback. A participant who
  // feels less by now may end before a block.
  let why = "complete";
  for (const block of progress(pilot.blocks, "Blocks")) {
    if (block > 1) {
      pilot.takeBreak(block - 1, block === 4 ? LONG_BREAK : SHORT_BREAK);
      if (block === 4) pilot.skin("break 3");
    }
    pilot.beforeBlock(block);
    if (block > 1 && !pilot.driftCheck(block)) {
      why = `ended by the participant before block ${block}: what is weakest is felt less`;
      break;
    }
    pilot.testBlock(block);
  }

  pilot.ratings();
  pilot.skin("after");
  pilot.sideEffects("after");
  pilot.finish(why);
  verdict(pilot.results("identification"));
}
