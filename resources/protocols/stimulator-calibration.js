// Does the stimulator deliver what it is told?
//
// Levels are commanded fully up and fully down, again and again, and each reading is taken from an oscilloscope's
// record across the load. Definitions: science.md section 9.
protocol({
  title: "Stimulator calibration",
  purpose: "Commanded against measured amplitude, interval, phase width and gap, with their uncertainty",
  needs: ["stimulator", "oscilloscope"],
  parameters: {
    mode: {
      label: "Mode",
      type: "choice",
      choices: { full: "calibrate", check: "check the stored calibration at three levels of each" },
      value: "full",
    },
    store: { label: "Keep the result for this stimulator", type: "boolean", value: false },
    valid_days: { label: "It holds for", unit: "d", type: "integer", min: 1, max: 366, value: 365 },
    scope_due: { label: "Oscilloscope's own calibration is due (2027-03-01)", type: "text", value: "" },
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
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, value: 1e3 },
    load_tolerance_pct: { label: "Tolerance of the load", unit: "%", min: 0.001, max: 20, value: 1 },
    amplitude_min_v: { label: "Lowest amplitude", unit: "V", min: 0.1, max: 200, value: 10 },
    amplitude_max_v: { label: "Largest amplitude (of a current source times |Z|)", unit: "V", min: 0.2, max: 200, value: 40 },
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
    scope_gain_pct: { label: "Oscilloscope gain, ± (0: as it declares)", unit: "%", min: 0, max: 20, value: 0 },
    timebase_ppm: { label: "Oscilloscope time base, ±", unit: "ppm", min: 0, max: 10000, value: 50 },
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
    amplitude_slew_v_per_s: 0,
    interval_ratio_per_train: 0,
    hold: "voltage",
    shape: "symmetric",
    pulses: 1,
    phase_width_us: 200,
    inter_phase_gap_us: 100,
  };
}

function read(p, trains) {
  const range_v = 1.3 * p.amplitude_max_v;
  const captures = bench.capture({
    trains: trains,
    rate_hz: RATES[p.rate],
    voltage_range_v: range_v, // one range for all levels: its errors are then the same for all
    current_range_ma: Math.max(1, (1.3e3 * p.amplitude_max_v) / p.load),
  });
  return measure.pulse(captures);
}

// What the levels of a quantity are set with. Width and gap are part of the profile and want a disarmed output.
function applyLevel(p, quantity, share) {
  const at = (low, high) => low + share * (high - low);
  if (quantity === "amplitude") bench.drive("manual", { roughness: share, pressure: 1 });
  if (quantity === "interval") bench.drive("manual", { roughness: 0, pressure: 1 - share });
  if (quantity === "width" || quantity === "gap") {
    bench.disarm();
    const encoding = encodingFor(p);
    if (quantity === "width") encoding.phase_width_us = at(p.width_min_us, p.width_max_us);
    if (quantity === "gap") encoding.inter_phase_gap_us = at(p.gap_min_us, p.gap_max_us);
    bench.setEncoding(encoding);
    bench.arm({ load: p.load });
    bench.drive("manual", { roughness: 0, pressure: 1 });
  }
  if (p.settling_s > 0) bench.wait(p.settling_s);
}

// Fully up and fully down; which way comes first is drawn for each repeat.
function sweepsOf(p) {
  const up = [];
  for (let k = 0; k < p.levels; ++k) up.push(k / (p.levels - 1));
  const down = up.slice().reverse();
  const steps = [];
  for (let repeat = 1; repeat <= p.repeats; ++repeat) {
    for (const direction of random.shuffle(["up", "down"])) {
      for (const share of direction === "up" ? up : down) steps.push({ repeat, direction, share });
    }
  }
  return steps;
}

function optionsFor(p, quantity, reading) {
  const instrument = reading.instrument;
  if (quantity !== "amplitude") {
    return {
      quantity,
      unit: "s",
      tolerance_pct: p.timing_tolerance_pct,
      gain_tolerance: p.timebase_ppm * 1e-6,
      sampling_step: instrument.sampling_step_s,
    };
  }
  return {
    quantity,
    unit: reading.unit,
    tolerance_pct: p.tolerance_pct,
    gain_tolerance: p.scope_gain_pct > 0 ? p.scope_gain_pct / 100 : instrument.gain_tolerance,
    offset_tolerance: instrument.offset_tolerance || 0,
    resolution: instrument.resolution || 0,
    load_tolerance: p.load_tolerance_pct / 100,
    load_sensitivity: 0, // the channel reads the source's own quantity, whatever the load
    // A current source is told A / |Z|, and |Z| is measured each time.
    same_level: reading.unit === "mA" ? 0.02 : 1e-9,
  };
}

function calibrate(p, quantity, results) {
  const readings = [];
  let options = null;
  bench.setEncoding(encodingFor(p));
  if (quantity === "amplitude" || quantity === "interval") bench.arm({ load: p.load });
  for (const step of progress(sweepsOf(p), TITLES[quantity])) {
    applyLevel(p, quantity, step.share);
    const reading = read(p, quantity === "interval" ? 2 : 1);
    const key = KEYS[quantity];
    readings.push({
      reading: reading.reading,
      commanded: reading.commanded[key],
      measured: reading[key],
      direction: step.direction,
      repeat: step.repeat,
    });
    record.trial(quantity + " " + step.direction, reading);
    if (options === null) options = optionsFor(p, quantity, reading);
    if (readings.length % p.levels !== 0) continue;
    const kept = { readings: readings.slice() };
    record.partial(Object.assign({}, results, { [quantity]: kept }), [
      { caption: TITLES[quantity] + ", readings", rows: readings, columns: ["commanded", "measured", "direction", "repeat"] },
    ]);
  }
  bench.disarm();
  return analysis.calibration(readings, options);
}

// Before anything is believed: the known load must read as what it is.
function checkReference(p) {
  bench.setEncoding(encodingFor(p));
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  const reading = read(p, 1);
  bench.disarm();
  return { check: record.reference(reading, p.load, p.load_tolerance_pct), reading };
}

function warmUp(p) {
  if (!(p.warm_up_s > 0)) return;
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 0, pressure: 1 });
  bench.wait(p.warm_up_s);
  bench.disarm();
}

function write(quantity, found) {
  const title = TITLES[quantity];
  report.figure(title + ": measured against commanded", plot.calibration(found));
  report.figure(title + ": error and tolerance", plot.residuals(found));
  report.table(title + ": levels (" + found.unit + ")", found.levels, [
    "commanded", "n", "mean", "mean_up", "mean_down", "s", "error", "expanded_uncertainty", "tolerance", "verdict",
  ]);
  report.table(title + ": uncertainty budget at the largest command (" + found.unit + ")", found.budget.rows, [
    "name", "distribution", "value", "divisor", "sensitivity", "contribution", "degrees_of_freedom",
  ]);
  const k = found.budget.coverage_factor;
  report.text(
    title + ": gain " + found.gain.toPrecision(6) + ", offset " + found.offset.toPrecision(3) + " " + found.unit +
      "; U = " + found.expanded_uncertainty.toPrecision(3) + " " + found.unit + " (95 %" +
      (k === null ? "" : ", k = " + k.toPrecision(3)) + ", by " + found.budget.method + "). " +
      (found.outliers === 0 ? "No reading stands out." : found.outliers + " readings stand out; they are marked and kept."),
  );
  const marked = found.readings.filter((reading) => reading.outlier);
  if (marked.length > 0) report.table(title + ": marked readings", marked, ["commanded", "measured", "direction"]);
}

// Does the stored line still hold? Guard-banded, as at its making: within the tolerance, this run's uncertainty included.
function checkLine(p, quantity, line, found) {
  const [scale, unit] = quantity === "width" || quantity === "gap" ? [1e6, "us"] : [1, found.unit]; // as people read them
  const tolerance_pct = quantity === "amplitude" ? p.tolerance_pct : p.timing_tolerance_pct;
  return found.levels.map((level) => {
    const expected = line.gain * level.commanded + line.offset;
    const off = level.mean - expected;
    const u = level.expanded_uncertainty;
    const allowed = (tolerance_pct / 100) * level.commanded;
    // A current source is told A / |Z|: that it comes back to the same levels is not sure. The line knows its own range.
    const known = level.commanded >= 0.98 * line.lowest && level.commanded <= 1.02 * line.highest;
    let judged = "indeterminate";
    if (known && Math.abs(off) + u <= allowed) judged = "pass";
    if (known && Math.abs(off) - u > allowed) judged = "fail";
    const row = { commanded: level.commanded, expected, measured: level.mean, off, expanded_uncertainty: u, allowed };
    for (const key of Object.keys(row)) row[key] *= scale;
    return Object.assign({ quantity }, row, { unit, verdict: judged });
  });
}

// The part of a range that the calibration knows. A current source's amplitude is set in volts and known in mA.
function knownPart(p, stored) {
  const few = Object.assign({}, p, { levels: 3, repeats: 2 });
  const part = (line, key, scale) => {
    few[key.replace("%", "min")] = Math.max(line.lowest * scale, p[key.replace("%", "min")]);
    few[key.replace("%", "max")] = Math.min(line.highest * scale, p[key.replace("%", "max")]);
  };
  if (stored.amplitude.unit === "V") part(stored.amplitude, "amplitude_%_v", 1);
  part(stored.interval, "interval_%_s", 1);
  part(stored.width, "width_%_us", 1e6);
  part(stored.gap, "gap_%_us", 1e6);
  return few;
}

function checkStored(p, stored, results) {
  const few = knownPart(p, stored);
  checkRanges(few);
  results.check = [];
  for (const quantity of quantitiesOf(p)) {
    const rows = checkLine(p, quantity, stored[quantity], calibrate(few, quantity, results));
    report.table(TITLES[quantity] + ": check of the stored calibration (" + rows[0].unit + ")", rows);
    results.check.push(...rows);
  }
  results.verdict = worst(results.check.map((row) => row.verdict));
  results.reasons = results.check.filter((row) => row.verdict !== "pass").map(notHeld);
  if (results.verdict === "pass") results.reasons = [stored.text + "; it still holds at three levels of each"];
  return verdict(results);
}

function notHeld(row) {
  return (
    TITLES[row.quantity] + ": at " + row.commanded.toPrecision(4) + " " + row.unit +
    " the stored calibration expects " + row.expected.toPrecision(5) + ", and " + row.measured.toPrecision(5) + " ± " +
    row.expanded_uncertainty.toPrecision(2) + " was measured; ± " + row.allowed.toPrecision(2) + " is allowed"
  );
}

function quantitiesOf(p) {
  return p.quantities === "all" ? Object.keys(KEYS) : [p.quantities];
}

function checkRanges(p) {
  for (const range of ["amplitude_%_v", "interval_%_s", "width_%_us", "gap_%_us"]) {
    const low = range.replace("%", "min");
    const high = range.replace("%", "max");
    if (!(p[low] < p[high])) throw new Error(low + " is " + p[low] + "; below " + high + ", " + p[high] + ", is expected");
  }
}

function worst(verdicts) {
  if (verdicts.includes("fail")) return "fail";
  return verdicts.includes("indeterminate") ? "indeterminate" : "pass";
}

function run(p) {
  checkRanges(p);
  // What would be refused at the end is refused before an hour's work.
  if (p.store && p.mode === "full") {
    if (p.quantities !== "all")
      throw new Error("quantities is " + p.quantities + "; all is expected to keep a result");
    if (p.scope_due !== "" && !/^\d{4}-\d{2}-\d{2}$/.test(p.scope_due))
      throw new Error("scope_due is " + p.scope_due + "; a day such as 2027-03-01, or nothing, is expected");
  }
  const stored = bench.calibration;
  bench.useCalibration(false); // what it delivers for what it is told, not for what a calibration makes of it
  report.text("Stored calibration: " + stored.text + ".");
  if (p.mode === "check" && !stored.calibrated) throw new Error(stored.text + "; there is nothing to check");
  operator.wired(p.load);
  const { check, reading } = checkReference(p);
  const results = { reference: check, instruments: bench.devices };
  if (!check.passed) {
    results.verdict = "indeterminate";
    results.reasons = [check.reason + "; nothing was calibrated"];
    return verdict(results);
  }
  if (!(p.scope_gain_pct > 0) && !reading.instrument.gain_tolerance) {
    throw new Error("the oscilloscope states no gain tolerance; scope_gain_pct is expected, from its data sheet");
  }
  warmUp(p);
  if (p.mode === "check") return checkStored(p, stored, results);
  const quantities = quantitiesOf(p);
  for (const quantity of quantities) {
    const found = calibrate(p, quantity, results);
    record.measurement("calibration of " + quantity, found);
    write(quantity, found);
    results[quantity] = found;
  }
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  if (p.store) {
    results.stored = record.calibration(results, { valid_days: p.valid_days, scope_due: p.scope_due });
    record.event("calibration stored", results.stored);
  }
  results.verdict = worst(quantities.map((quantity) => results[quantity].verdict));
  results.reasons = [];
  for (const quantity of quantities) {
    for (const reason of results[quantity].reasons) results.reasons.push(quantity + ": " + reason);
  }
  return verdict(results);
}
