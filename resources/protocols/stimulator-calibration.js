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
    reference_tolerance_pct: { label: "Known load must read within", unit: "%", min: 0.01, max: 20, value: 5 },
    reference_v: { label: "Reference source on the oscilloscope (0: none)", unit: "V", min: 0, max: 500, value: 0 },
    reference_u_pct: { label: "Its uncertainty (k = 2)", unit: "%", min: 0, max: 10, value: 0 },
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
    timebase_ppm: { label: "Oscilloscope time base, ± (0: as it declares)", unit: "ppm", min: 0, max: 10000, value: 0 },
    rate: {
      label: "Sampling rate",
      type: "choice",
      choices: { "500k": "500 kS/s", "1M": "1 MS/s", "2M": "2 MS/s", "5M": "5 MS/s", "10M": "10 MS/s" },
      value: "2M",
    },
  },
});

const RATES = { "500k": 500e3, "1M": 1e6, "2M": 2e6, "5M": 5e6, "10M": 10e6 };
const CLOCK_PCT = 0.5; // how far intervals may be from the computer's clock
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

// One range for all levels: its errors are then the same for all.
function read(p, trains, record) {
  return measure.pulse(bench.capture(Object.assign({
    trains: trains,
    rate_hz: RATES[p.rate],
    voltage_range_v: 1.3 * p.amplitude_max_v,
    current_range_ma: Math.max(1, (1.3e3 * p.amplitude_max_v) / p.load),
  }, record)));
}

// Two records, or both trains in one where the oscilloscope does not state how good the time stamps of records are.
function readInterval(p, interval_s) {
  if (!p.stamped) bench.wait(2 * interval_s); // a record of both begins with whatever train comes first: it has the new interval by then
  return read(p, 2, { intervals: true });
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
      gain_tolerance: instrument.timebase_tolerance,
      sampling_step: instrument.sampling_step_s,
    };
  }
  return {
    quantity,
    unit: reading.unit,
    tolerance_pct: p.tolerance_pct,
    gain_tolerance: instrument.gain_tolerance,
    probe_tolerance: instrument.probe_tolerance,
    resolution: instrument.resolution,
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
    const commanded_s = p.interval_min_s + step.share * (p.interval_max_s - p.interval_min_s);
    const reading = quantity === "interval" ? readInterval(p, commanded_s) : read(p, 1);
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
  return { check: record.reference(reading, p.load, p.reference_tolerance_pct, p.load_tolerance_pct), reading };
}

function warmUp(p) {
  if (!(p.warm_up_s > 0)) return;
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 0, pressure: 1 });
  bench.wait(p.warm_up_s);
  bench.disarm();
}

// As cells of a table: with U, or without.
const withU = (value, expanded, unit) => ({ value: value, expanded: expanded, unit: unit });
const plain = (value, unit) => ({ value: value, unit: unit });
const apart = (a, b) => (a === null || b === null ? null : a - b);

function levelRows(found) {
  return found.levels.map((level) => ({
    commanded: report.quantity(level.commanded, found.unit),
    n: level.n,
    error_going_up: plain(apart(level.mean_up, level.commanded), found.unit),
    error_going_down: plain(apart(level.mean_down, level.commanded), found.unit),
    hysteresis: plain(apart(level.mean_down, level.mean_up), found.unit),
    "error judged ± U": withU(level.worst_error, level.worst_expanded_uncertainty, found.unit),
    tolerance: "± " + report.quantity(level.tolerance, found.unit, 0),
    verdict: level.verdict,
  }));
}

// What the uncertainty is made of, at both ends: what weighs at one need not at the other.
function budgetRows(found) {
  const small = {};
  for (const row of found.budget_smallest.rows) small[row.name] = row;
  const rows = found.budget.rows.map((row) => ({
    contribution: row.name,
    distribution: row.distribution,
    at_the_smallest: plain(small[row.name] === undefined ? null : small[row.name].contribution, found.unit),
    at_the_largest: plain(row.contribution, found.unit),
    degrees_of_freedom: row.degrees_of_freedom === null ? "∞" : row.degrees_of_freedom.toFixed(0),
  }));
  const sum = (title, key) => rows.push({ contribution: title, distribution: "",
    at_the_smallest: plain(found.budget_smallest[key], found.unit), at_the_largest: plain(found.budget[key], found.unit),
    degrees_of_freedom: "" });
  sum("combined, u", "combined");
  sum("expanded, U (95 %)", "expanded_uncertainty");
  return rows;
}

function coverage(budget) {
  return (budget.coverage_factor === null ? "" : "k = " + budget.coverage_factor.toFixed(2) + ", ") + budget.method;
}

function write(quantity, found) {
  const title = TITLES[quantity];
  report.figure(title + ": error, tolerance and the two sweep directions", plot.residuals(found));
  report.table(title + ": levels", levelRows(found), ["commanded", "n", "error_going_up", "error_going_down", "hysteresis",
    "error judged ± U", "tolerance", "verdict"]);
  report.table(title + ": uncertainty budget at the smallest and the largest command", budgetRows(found),
    ["contribution", "distribution", "at_the_smallest", "at_the_largest", "degrees_of_freedom"]);
  report.text("Coverage at the smallest: " + coverage(found.budget_smallest) + "; at the largest: " + coverage(found.budget) +
    ". " + (found.outliers === 0 ? "No reading stands out." : found.outliers + " readings stand out; they are marked and kept."));
  const marked = found.readings.filter((reading) => reading.outlier);
  if (marked.length > 0) {
    report.table(title + ": marked readings", marked.map((each) => ({ commanded: report.quantity(each.commanded, found.unit),
      measured: plain(each.measured, found.unit), direction: each.direction })), ["commanded", "measured", "direction"]);
  }
}

// A share of the largest command; two digits tell enough.
function brief(percent) {
  return report.rounded(percent, "%", 2);
}

// All quantities side by side; U of gain and offset beside them.
function writeSummary(results, quantities) {
  report.table("What was found, in % of the largest command where a % stands", quantities.map((quantity) => {
    const found = results[quantity];
    return { quantity: TITLES[quantity], gain: withU(found.gain, found.gain_expanded_uncertainty, ""),
      offset: withU(found.offset, found.offset_expanded_uncertainty, found.unit),
      residual: brief(found.residual_max_pct_fs), repeatability: brief(found.repeatability_pct_fs),
      hysteresis: brief(found.hysteresis_pct_fs), verdict: found.verdict };
  }), ["quantity", "gain", "offset", "residual", "repeatability", "hysteresis", "verdict"]);
}

// Does the stored line still hold? Guard-banded, as at its making: within the tolerance, this run's uncertainty included.
function checkLine(p, quantity, line, found) {
  const [scale, unit] = quantity === "width" || quantity === "gap" ? [1e6, "us"] : [1, found.unit]; // as people read them
  const tolerance_pct = quantity === "amplitude" ? p.tolerance_pct : p.timing_tolerance_pct;
  return found.levels.map((level) => {
    const expected = line.gain * level.commanded + line.offset;
    const off = level.mean - expected;
    const u = level.expanded_uncertainty === null ? NaN : level.expanded_uncertainty;
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
    report.table(TITLES[quantity] + ": check of the stored calibration", rows.map((row) => ({
      commanded: report.quantity(row.commanded, row.unit), expected: report.quantity(row.expected, row.unit, 0),
      "off ± U": withU(row.off, row.expanded_uncertainty, row.unit), allowed: "± " + report.quantity(row.allowed, row.unit),
      verdict: row.verdict })), ["commanded", "expected", "off ± U", "allowed", "verdict"]);
    results.check.push(...rows);
  }
  results.verdict = worst(results.check.map((row) => row.verdict));
  results.reasons = results.check.filter((row) => row.verdict !== "pass").map(notHeld);
  if (results.verdict === "pass") results.reasons = [stored.text + "; it still holds at three levels of each"];
  return verdict(results);
}

function notHeld(row) {
  return (
    TITLES[row.quantity] + ": at " + report.quantity(row.commanded, row.unit) + " the stored calibration expects " +
    report.quantity(row.expected, row.unit) + ", and " + report.quantity(row.measured, row.unit, row.expanded_uncertainty) +
    " was measured; ± " + report.quantity(row.allowed, row.unit) + " is allowed"
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

// Trains are handed out by the computer's clock: a time base that reads it wrong reads every time wrong.
function judgeTimeBase(results) {
  const found = results.interval;
  if (found === undefined) return null;
  const off_pct = 100 * Math.abs(found.gain - 1), u_pct = 100 * (found.gain_expanded_uncertainty === null ? NaN : found.gain_expanded_uncertainty);
  if (off_pct + u_pct <= CLOCK_PCT) return null;
  return "the time base is not sure: intervals by the computer's clock are read " + report.quantity(off_pct, "%", u_pct) +
    " off, at most " + CLOCK_PCT + " % is allowed (choice)";
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
  p = Object.assign({}, p, { stamped: reading.instrument.stamp_tolerance_s !== null });
  const results = { reference: check };
  if (p.reference_v > 0) {
    if (!(p.reference_u_pct > 0)) throw new Error("reference_u_pct is 0; above 0 is expected with a reference source");
    results.absolute = bench.readReference(p.reference_v, p.reference_u_pct, p.tolerance_pct);
  }
  if (results.absolute && !results.absolute.passed) {
    results.verdict = "indeterminate";
    results.reasons = ["the absolute reference: " + results.absolute.text + "; nothing was calibrated"];
    return verdict(results);
  }
  if (!check.passed) {
    results.verdict = "indeterminate";
    results.reasons = [check.reason + "; nothing was calibrated"];
    return verdict(results);
  }
  warmUp(p);
  if (p.mode === "check") return checkStored(p, stored, results);
  const quantities = quantitiesOf(p);
  for (const quantity of quantities) {
    const found = calibrate(p, quantity, results);
    record.measurement("calibration of " + quantity, found);
    results[quantity] = found;
  }
  writeSummary(results, quantities);
  for (const quantity of quantities) write(quantity, results[quantity]);
  report.figure("Measured waveforms", plot.waveforms());
  report.figure("Exposure against limits", plot.exposure());
  const clock = judgeTimeBase(results);
  if (p.store && clock === null) {
    results.stored = record.calibration(results, { valid_days: p.valid_days, scope_due: p.scope_due });
    record.event("calibration stored", results.stored);
  }
  results.verdict = worst(quantities.map((quantity) => results[quantity].verdict).concat(clock === null ? [] : ["indeterminate"]));
  results.reasons = clock === null ? [] : [clock + (p.store ? "; nothing was stored" : "")];
  for (const quantity of quantities) {
    for (const reason of results[quantity].reasons) results.reasons.push(quantity + ": " + reason);
  }
  return verdict(results);
}
