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
    valid_days: { label: "It holds for", unit: "d", type: "integer", min: 1, max: 366, value: 365 },
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
      label: "Reference source on the oscilloscope (0: none)",
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
      label: "Oscilloscope gain, ± (0: as it declares)",
      unit: "%",
      min: 0,
      max: 20,
      step: "reference",
      value: 0,
    },
    timebase_ppm: {
      label: "Oscilloscope time base, ± (0: as it declares)",
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
const KEYS = { amplitude: "amplitude", interval: "interval_s", width: "width_s", gap: "gap_s" };
const TITLES = { amplitude: "Amplitude", interval: "Interval", width: "Phase width", gap: "Inter-phase gap" };

function quantitiesOf(p) {
  return p.quantities === "all" ? Object.keys(KEYS) : [p.quantities];
}

// What would be refused at the end is refused before an hour's work.
function checkParameters(p) {
  checkRanges(p);
  if (!p.store || p.mode !== "full") return;
  if (p.quantities !== "all") throw new Error("quantities is " + p.quantities + "; all is expected to keep a result");
}

const RANGES = ["amplitude_%_v", "interval_%_s", "width_%_us", "gap_%_us"];

function rangesOf(p) {
  const ranges = {};
  for (const range of RANGES) {
    for (const key of [range.replace("%", "min"), range.replace("%", "max")]) ranges[key] = p[key];
  }
  return ranges;
}

function checkRanges(p) {
  for (const range of RANGES) {
    const low = range.replace("%", "min"), high = range.replace("%", "max");
    if (p[low] < p[high]) continue;
    throw new Error(low + " is " + p[low] + "; below " + high + ", " + p[high] + ", is expected");
  }
}

// Straight curves over the calibrated range, so that R sets the amplitude and P the interval level by level.
function encodingFor(p) {
  return {
    assignment: "texture_to_amplitude",
    amplitude_curve: "linear",
    interval_curve: "linear",
    amplitude_min_v: p.amplitude_min_v,
    amplitude_max_v: p.amplitude_max_v,
    interval_min_s: p.interval_min_s,
    interval_max_s: p.interval_max_s,
    amplitude_ratio_per_train: 0,
    amplitude_slew_v_per_s: 0,
    interval_ratio_per_train: 0,
    hold: "voltage",
    shape: "symmetric",
    pulses: 1,
    phase_width_us: 200,
    inter_phase_gap_us: 100,
  };
}

function armAt(p, encoding, roughness) {
  bench.setEncoding(encoding);
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: roughness, pressure: 1 });
}

// One range for all levels: its errors are then the same for all.
function read(p, trains, how) {
  return measure.pulse(bench.capture(Object.assign({
    trains: trains,
    rate_hz: RATES[p.rate],
    voltage_range_v: 1.3 * p.amplitude_max_v,
    current_range_ma: Math.max(1, (1.3e3 * p.amplitude_max_v) / p.load),
  }, how)));
}

// Two records, or both trains in one where the oscilloscope does not state how good the time stamps of records are.
function readInterval(p, share) {
  // A record of both begins with whatever train comes first: it has the new interval by then.
  if (!p.stamped) bench.wait(2 * (p.interval_min_s + share * (p.interval_max_s - p.interval_min_s)));
  return read(p, 2, { intervals: true });
}

// Width and gap are part of the profile and want a disarmed output.
function applyLevel(p, quantity, share) {
  const encoding = encodingFor(p);
  const at = (low, high) => low + share * (high - low);
  if (quantity === "width") encoding.phase_width_us = at(p.width_min_us, p.width_max_us);
  if (quantity === "gap") encoding.inter_phase_gap_us = at(p.gap_min_us, p.gap_max_us);
  if (quantity === "amplitude") bench.drive("manual", { roughness: share, pressure: 1 });
  else if (quantity === "interval") bench.drive("manual", { roughness: 0, pressure: 1 - share });
  else {
    bench.disarm();
    armAt(p, encoding, 0);
  }
  if (p.settling_s > 0) bench.wait(p.settling_s);
}

// What the oscilloscope states of itself, analysis.calibration() takes from the readings.
function judge(p, quantity, readings, unit) {
  const timing = { quantity, tolerance_pct: p.timing_tolerance_pct };
  if (quantity !== "amplitude") return analysis.calibration(readings, timing);
  return analysis.calibration(readings, {
    quantity,
    tolerance_pct: p.tolerance_pct,
    load_tolerance: p.load_tolerance_pct / 100,
    load_sensitivity: 0, // the channel reads the source's own quantity, whatever the load
    same_level: unit === "mA" ? 0.02 : 1e-9, // a current source is told A / |Z|, and |Z| is measured each time
  });
}

// Fully up and fully down, again and again.
function calibrate(p, quantity, results) {
  const readings = [];
  const key = KEYS[quantity];
  let unit = "";
  bench.setEncoding(encodingFor(p));
  if (quantity === "amplitude" || quantity === "interval") bench.arm({ load: p.load });
  for (const step of progress(random.sweeps(p.levels, p.repeats), TITLES[quantity])) {
    applyLevel(p, quantity, step.share);
    const reading = quantity === "interval" ? readInterval(p, step.share) : read(p, 1);
    unit = reading.unit;
    readings.push({
      reading: reading.reading,
      commanded: reading.commanded[key],
      measured: reading[key],
      direction: step.direction,
      repeat: step.repeat,
    });
    record.trial(quantity + " " + step.direction, reading);
    if (readings.length % p.levels !== 0) continue;
    record.partial(Object.assign({}, results, { [quantity]: { readings: readings } }), [
      { caption: TITLES[quantity] + ", readings", rows: readings,
        columns: ["commanded", "measured", "direction", "repeat"] },
    ]);
  }
  bench.disarm();
  return judge(p, quantity, readings, unit);
}

// Before anything is believed: the known load must read as what it is.
function readKnownLoad(p) {
  armAt(p, encodingFor(p), 1);
  const reading = read(p, 1);
  bench.disarm();
  return reading;
}

// A gain error that voltage and current share shows only on a voltage of known size.
function readAbsolute(p) {
  if (!(p.reference_v > 0)) return null;
  if (!(p.reference_u_pct > 0)) throw new Error("reference_u_pct is 0; above 0 is expected with a reference source");
  return bench.readReference(p.reference_v, p.reference_u_pct, p.tolerance_pct);
}

function warmUp(p) {
  if (!(p.warm_up_s > 0)) return;
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 0, pressure: 1 });
  bench.wait(p.warm_up_s);
  bench.disarm();
}

function indeterminate(results, reason) {
  return verdict(Object.assign(results, { verdict: "indeterminate", reasons: [reason + "; nothing was calibrated"] }));
}

function worst(verdicts) {
  if (verdicts.includes("fail")) return "fail";
  return verdicts.includes("indeterminate") ? "indeterminate" : "pass";
}

// Does the stored calibration still hold?
function checkStored(p, stored, results) {
  const few = Object.assign({}, p, calibration.knownRanges(stored, rangesOf(p)), { levels: 3, repeats: 2 });
  checkRanges(few);
  const checks = [];
  results.check = [];
  for (const quantity of quantitiesOf(p)) {
    const tolerance_pct = quantity === "amplitude" ? p.tolerance_pct : p.timing_tolerance_pct;
    const check = analysis.calibrationCheck(calibrate(few, quantity, results), stored[quantity], tolerance_pct);
    report.calibrationCheck(check);
    checks.push(check);
    results.check.push(...check.rows);
  }
  results.verdict = worst(checks.map((check) => check.verdict));
  results.reasons = [].concat(...checks.map((check) => check.reasons));
  if (results.verdict === "pass") results.reasons = [stored.text + "; it still holds at three levels of each"];
  return verdict(results);
}

function calibrateAll(p, results) {
  const quantities = quantitiesOf(p);
  for (const quantity of quantities) {
    const found = calibrate(p, quantity, results);
    record.measurement("calibration of " + quantity, found);
    results[quantity] = found;
  }
  const all = quantities.map((quantity) => results[quantity]);
  report.calibrations(all);
  for (const found of all) report.calibration(found);
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());

  const clock = calibration.timeBase(results.interval === undefined ? null : results.interval);
  if (p.store && clock === "") {
    results.stored = record.calibration(results, { valid_days: p.valid_days, scope_due: p.scope_due });
    record.event("calibration stored", results.stored);
  }
  results.verdict = worst(all.map((found) => found.verdict).concat(clock === "" ? [] : ["indeterminate"]));
  results.reasons = clock === "" ? [] : [clock + (p.store ? "; nothing was stored" : "")];
  for (const found of all) {
    for (const reason of found.reasons) results.reasons.push(TITLES[found.quantity] + ": " + reason);
  }
  return verdict(results);
}

function run(p) {
  checkParameters(p);
  const stored = bench.calibration;
  bench.useCalibration(false); // what it delivers for what it is told, not for what a calibration makes of it
  report.text("Stored calibration: " + stored.text + ".");
  if (p.mode === "check" && !stored.calibrated) throw new Error(stored.text + "; there is nothing to check");

  operator.wired(p.load);
  const reading = readKnownLoad(p);
  const known = record.reference(reading, p.load, p.reference_tolerance_pct, p.load_tolerance_pct);
  const absolute = readAbsolute(p);
  const results = absolute === null ? { reference: known } : { reference: known, absolute: absolute };
  if (absolute !== null && !absolute.passed) return indeterminate(results, "the absolute reference: " + absolute.text);
  if (!known.passed) return indeterminate(results, known.reason);

  p = Object.assign({}, p, { stamped: reading.instrument.stamp_tolerance_s !== null });
  warmUp(p);
  return p.mode === "check" ? checkStored(p, stored, results) : calibrateAll(p, results);
}
