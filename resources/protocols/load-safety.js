// Is what the stimulator delivers into resistors and a skin equivalent within every limit?
//
// Each load of the bench set in turn: its value is verified first, then the commands are given from the weakest up and
// judged on what the oscilloscope saw. What the limits forbid is asked for and must be refused; an open or short
// circuit, a loose contact and a silent control loop must end the output by themselves.
protocol({
  title: "Resistor-load safety check",
  purpose: "Does the stimulator stay within every limit on known loads, and does it stop when it must?",
  kind: "load-safety",
  needs: ["stimulator", "oscilloscope"],
  view: "loads",
  parameters: {
    area: {
      label: "Area of the smallest electrode",
      zero: "from the profile",
      unit: "cm2",
      min: 0,
      max: 1000,
      value: 0,
      needed: "current and power density are not evaluated, and the check ends indeterminate",
    },
    trains: { label: "Trains per command", type: "integer", min: 2, max: 20, value: 4 },
    steps: { label: "Commands per load", type: "integer", min: 2, max: 11, value: 4 },
    dmm: { label: "Enter multimeter readings", type: "boolean", step: "reference", value: false },
    load_tolerance: { label: "Tolerance of a load's value", unit: "%", min: 0.1, max: 15, value: 5 },
    resistor_tolerance: { label: "Resistors as marked", unit: "%", min: 0.01, max: 10, step: "reference", value: 1 },
    area_tolerance: { label: "Electrode area, uncertainty", unit: "%", min: 0.01, max: 50, value: 5 },
    amplitude_tolerance: { label: "Amplitude over the command", unit: "%", min: 0.1, max: 20, value: 2 },
    reference_v: {
      label: "Reference source on the oscilloscope",
      zero: "none",
      unit: "V",
      min: 0,
      max: 500,
      step: "reference",
      value: 0,
    },
    reference_u_pct: { label: "Its uncertainty (k = 2)", unit: "%", min: 0, max: 10, step: "reference", value: 0 },
    silence: { label: "Heartbeat withheld for", unit: "s", min: 0.5, max: 10, value: 1.5 },
    reference: {
      label: "Known load, measured first",
      step: "reference",
      type: "choice",
      choices: { "500 ohm": "500 ohm", "1 kohm": "1 kohm", "2 kohm": "2 kohm" },
      value: "1 kohm",
    },
  },
});

function run(p) {
  // A reading is of its command, not of the way to it.
  bench.setEncoding({ amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });
  operator.wired();
  if (p.area > 0) bench.setElectrodeArea(p.area);

  // A voltage of known size, where there is one, and a known load: instruments that misread them can judge nothing.
  bench.loadSafety.begin(p);
  const known = bench.loadSafety.knownLoad();
  if (known) {
    // The value of each load is verified first; then commands from the weakest up. What ends the output by itself is
    // provoked at the end.
    for (const load of progress(bench.loads, "Loads")) bench.loadSafety.load(load.name);
    for (const kind of progress(["open", "short", "intermittent"], "Trips")) bench.loadSafety.trip(kind);
    bench.loadSafety.silence();
  }
  const found = bench.loadSafety.judge();
  if (known) bench.loadSafety.tracings();
  return verdict(found);
}
