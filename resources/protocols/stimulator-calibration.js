// Does the stimulator deliver what it is told?
//
// Levels are commanded fully up and fully down, again and again, and each reading is taken from an oscilloscope's
// record across the load. Definitions: science.md section 9.
protocol({
  title: "Stimulator calibration",
  purpose: "Commanded against measured amplitude, interval, phase width and gap, with their uncertainty",
  kind: "stimulator-calibration",
  needs: ["stimulator", "oscilloscope"],
  view: "calibration",
  parameters: {
    mode: {
      label: "Mode",
      type: "choice",
      choices: { full: "calibrate", check: "check the stored calibration at three levels of each" },
      value: "full",
    },
    store: { label: "Keep the result for this stimulator", type: "boolean", value: false },
    valid_days: { label: "Valid for", unit: "d", type: "integer", min: 1, max: 366, value: 365 },
    scope_due: { label: "Oscilloscope's own calibration is due", type: "date", step: "reference", value: "" },
    quantities: {
      label: "Calibrate",
      type: "choice",
      choices: {
        all: "amplitude, interval, phase width and gap",
        amplitude: "amplitude",
        interval: "interval",
        width: "phase width",
        gap: "inter-phase gap",
      },
      value: "all",
    },
    levels: { label: "Levels", type: "integer", min: 2, max: 41, value: 11 },
    repeats: { label: "Repeats of each level, each way", type: "integer", min: 2, max: 50, value: 5 },
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, step: "reference", value: 1e3 },
    load_tolerance_pct: { label: "Tolerance of the load", unit: "%", min: 0.001, max: 20, step: "reference", value: 1 },
    reference_tolerance_pct: {
      label: "Known load must read within",
      unit: "%",
      min: 0.01,
      max: 20,
      step: "reference",
      value: 5,
    },
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
    amplitude_min_v: { label: "Lowest amplitude", unit: "V", min: 0.1, max: 200, value: 10 },
    amplitude_max_v: {
      label: "Largest amplitude (of a current source times |Z|)",
      unit: "V",
      min: 0.2,
      max: 200,
      value: 40,
    },
    interval_min_s: { label: "Shortest interval", unit: "s", min: 0.05, max: 60, value: 0.5 },
    interval_max_s: { label: "Longest interval", unit: "s", min: 0.1, max: 60, value: 2 },
    width_min_us: { label: "Shortest phase", unit: "us", min: 10, max: 10000, value: 100 },
    width_max_us: { label: "Longest phase", unit: "us", min: 20, max: 10000, value: 400 },
    gap_min_us: { label: "Shortest gap", unit: "us", min: 10, max: 900, value: 100 },
    gap_max_us: { label: "Longest gap", unit: "us", min: 20, max: 900, value: 400 },
    warm_up_s: { label: "Warm-up before the first level", unit: "s", min: 0, max: 7200, value: 10 },
    settling_s: { label: "Settling at each level", unit: "s", min: 0, max: 60, value: 0 },
    tolerance_pct: { label: "Tolerance of amplitude", unit: "%", min: 0.01, max: 50, value: 2 },
    timing_tolerance_pct: { label: "Tolerance of interval, width and gap", unit: "%", min: 0.01, max: 50, value: 1 },
    scope_gain_pct: {
      label: "Oscilloscope gain, ±",
      zero: "as it declares",
      unit: "%",
      min: 0,
      max: 20,
      step: "reference",
      value: 0,
    },
    timebase_ppm: {
      label: "Oscilloscope time base, ±",
      zero: "as it declares",
      unit: "ppm",
      min: 0,
      max: 10000,
      step: "reference",
      value: 0,
    },
    rate: {
      label: "Sampling rate",
      type: "choice",
      choices: { "500k": "500 kS/s", "1M": "1 MS/s", "2M": "2 MS/s", "5M": "5 MS/s", "10M": "10 MS/s" },
      value: "2M",
    },
  },
});

const RATES = { "500k": 500e3, "1M": 1e6, "2M": 2e6, "5M": 5e6, "10M": 10e6 };
const TITLES = { amplitude: "Amplitude", interval: "Interval", width: "Phase width", gap: "Inter-phase gap" };

function run(p) {
  const stored = bench.stimulatorCalibration.begin(Object.assign({ rate_hz: RATES[p.rate] }, p));
  operator.wired(p.load);
  if (!bench.stimulatorCalibration.knownLoad(p)) return verdict(bench.stimulatorCalibration.conclude());

  const found = [];
  for (const quantity of p.quantities === "all" ? Object.keys(TITLES) : [p.quantities]) {
    const levels = bench.stimulatorCalibration.levels(quantity);
    for (const level of progress(levels, TITLES[quantity])) bench.stimulatorCalibration.read(level);
    found.push(bench.stimulatorCalibration.judge());
  }
  if (p.mode === "check") return verdict(bench.stimulatorCalibration.conclude());

  for (const each of found) report.calibration(each);
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  const results = bench.stimulatorCalibration.conclude();
  report.certificate(found, stored);
  return verdict(results);
}
