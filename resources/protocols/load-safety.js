// Is what the stimulator delivers into resistors and a skin equivalent within every limit?
//
// Each load of the bench set in turn: its value is verified first, then the commands are given from the weakest up and
// judged on what the oscilloscope saw. What the limits forbid is asked for and must be refused; an open or short
// circuit, a loose contact and a silent control loop must end the output by themselves.
protocol({
  title: "Resistor-load safety check",
  purpose: "Does the stimulator keep every limit on known loads, and does it stop when it must?",
  needs: ["stimulator", "oscilloscope"],
  parameters: {
    trains: { label: "Trains per command", type: "integer", min: 2, max: 20, value: 4 },
    steps: { label: "Commands per load", type: "integer", min: 2, max: 11, value: 4 },
    area: { label: "Smallest electrode (0: profile)", unit: "cm2", min: 0, max: 1000, value: 0 },
    dmm: { label: "Enter multimeter readings", type: "boolean", value: false },
    load_tolerance: { label: "Tolerance of a load's value", unit: "%", min: 0.1, max: 15, value: 5 },
    resistor_tolerance: { label: "Resistors, as marked (without multimeter)", unit: "%", min: 0.01, max: 10, value: 1 },
    area_tolerance: { label: "Uncertainty of the electrode's area", unit: "%", min: 0.01, max: 50, value: 5 },
    amplitude_tolerance: { label: "Amplitude over the command", unit: "%", min: 0.1, max: 20, value: 2 },
    reference_v: { label: "Reference source on the oscilloscope (0: none)", unit: "V", min: 0, max: 500, value: 0 },
    reference_u_pct: { label: "Its uncertainty (k = 2)", unit: "%", min: 0, max: 10, value: 0 },
    silence: { label: "Heartbeat withheld for", unit: "s", min: 0.5, max: 10, value: 1.5 },
    reference: {
      label: "Known load, measured first",
      type: "choice",
      choices: { "500 ohm": "500 ohm", "1 kohm": "1 kohm", "2 kohm": "2 kohm" },
      value: "1 kohm",
    },
  },
});

// What the table of loads shows of each: title, key of a load, unit.
const MEASURED = [
  ["|Z| at the end of the leading phase", "measured_ohm", "ohm"],
  ["Peak voltage", "peak_v", "V"],
  ["Peak current", "peak_ma", "mA"],
  ["RMS current in the train", "rms_train_ma", "mA"],
  ["RMS current over 1 s", "rms_1s_ma", "mA"],
  ["RMS current over 5 s", "rms_5s_ma", "mA"],
  ["Charge of a phase", "charge_uc", "uC"],
  ["Net charge of a pulse", "net_charge_uc", "uC"],
  ["Energy of a pulse", "energy_mj", "mJ"],
  ["Current density", "current_density_ma_cm2", "mA/cm2"],
  ["Power density over 1 s", "power_density_w_cm2", "W/cm2"],
];
const CRITICAL = 3; // rows closest to their limits that are named before the matrix

// A load as people write it.
function written(load) {
  return load.replace(/ohm/g, "Ω").replace(/\|\|/g, "∥");
}

function newRecord(name) {
  return { name: name, steps: [], refusals: [], undriven: [] };
}

// The resistor's own value, from a multimeter, where the technician has one at hand.
function enterDmm(record, p) {
  if (!p.dmm) return;
  const key = record.name.replace(/[^a-z0-9]+/gi, "-");
  record.dmm_ohm = operator.enter("dmm-" + key, "Multimeter reading of " + record.name, { unit: "ohm", min: 0.1, max: 1e7 });
  const expanded = operator.enter("dmm-u-" + key, "Its uncertainty (95 %)", { unit: "ohm", min: 0, max: 1e6 });
  record.dmm_u_ohm = expanded / 2;
  record.serial = operator.enter("serial-" + key, "Serial number or mark of " + record.name, { text: true });
}

// What is wrong with one load ends that load; a fault or a stop ends the run.
function arms(record) {
  try {
    bench.arm({ load: record.name });
    return true;
  } catch (error) {
    if (bench.live().state !== "disarmed") throw error;
    record.problem = error.message;
    record.limited = error.limit === true;
    return false;
  }
}

function captureAs(command, trains, range_ma, how) {
  const options = command.capture;
  return bench.capture(Object.assign({ trains: trains, rate_hz: options.rate_hz, trigger_v: options.trigger_v,
    voltage_range_v: options.voltage_range_v, current_range_ma: range_ma }, how || { samples: options.samples }));
}

// Several trains, so that there is an interval and a spread to measure, after one that brings the output to its level.
// A refusal of what no limit forbids is kept as such; anything else ends the run.
function deliver(record, command, trains) {
  const refusedBefore = bench.live().trains_refused;
  let reading = null;
  try {
    bench.drive("manual", { roughness: command.roughness, pressure: command.pressure });
    do bench.wait(1.2 * command.interval_s);
    while (Math.abs(bench.live().amplitude_v - command.command_v) > 1e-6);
    const captures = captureAs(command, trains, command.capture.current_range_ma);
    // Two trains in one record, for an oscilloscope that does not state how good its time stamps are.
    const rhythm = captures[0].stamp_tolerance_s === null
      ? captureAs(command, 2, command.capture.current_range_ma, { intervals: true }) : null;
    // Where current settles far below a charging spike, it is read in a range of its own.
    const fine = command.fine_range_ma !== null ? captureAs(command, trains, command.fine_range_ma) : null;
    reading = measure.load(captures, fine, rhythm);
  } catch (error) {
    if (bench.live().trains_refused === refusedBefore || bench.live().state === "faulted") throw error;
    record.refusals.push({ command_v: command.command_v, interval_s: command.interval_s, forbidden: false, refused: true,
      predicted: "", reason: error.message });
  }
  bench.drive("off");
  if (reading === null) return;
  record.steps.push({ command_v: command.command_v, interval_s: command.interval_s, rate_hz: command.capture.rate_hz,
    reading: reading });
  keepStep(record, command, reading);
}

function condition(name, command) {
  return name + ", " + command.command_v.toFixed(1) + " V";
}

function keepStep(load, command, reading) {
  const kept = Object.assign({ command_v: command.command_v }, load.reference ? {} : { load: load.name }, reading);
  record.trial((load.reference ? "reference " : "") + condition(load.name, command), kept);
}

// What a load has come to, at once: a row of the session, and of the window.
function keepLine(line) {
  record.trial(line.name, Object.assign({ load: line.name, load_verdict: line.verdict }, line));
}

// The value of a load, judged alone: nothing else is asked of one that is not what it should be.
function valueIsRight(record, tolerances) {
  const rows = analysis.loadSafety([record], [], { tolerances: tolerances }).rows;
  const row = rows.filter((each) => each.load === record.name && each.item === "load_value")[0];
  if (row.verdict === "pass") return true;
  record.problem = row.reason;
  return false;
}

// From the weakest up.
function commandsOn(name, p) {
  const commands = [];
  for (let i = 0; i < p.steps; ++i) commands.push(bench.predict(name, i / (p.steps - 1)));
  return commands;
}

// The largest strength, 0 to 1, that the device can give and the limits let through.
function strongestOn(name, p) {
  const allowed = commandsOn(name, p).map((each) => each.not_applicable === null && !each.forbidden);
  return Math.max(0, allowed.lastIndexOf(true)) / (p.steps - 1);
}

// Where the impedance check alone breaks a limit, arming is what must be refused, and by a limit: arming that fails for
// another reason says nothing about the limits and stays this load's problem.
function askToArm(record, forbidden) {
  const armed = arms(record);
  bench.disarm();
  if (!armed && !record.limited) return;
  record.refusals.push({ what: "arming", forbidden: true, refused: !armed, predicted: forbidden,
    reason: armed ? "" : record.problem });
  delete record.problem;
}

function measureLoad(name, p, tolerances) {
  const record = newRecord(name);
  const commands = commandsOn(name, p);
  if (commands.every((command) => command.not_applicable !== null)) {
    record.not_applicable = commands[commands.length - 1].not_applicable;
    return record;
  }
  enterDmm(record, p);
  bench.fitLoad(name);
  if (commands[0].check_forbidden !== "") {
    askToArm(record, commands[0].check_forbidden);
    return record;
  }
  if (!arms(record)) return record;
  for (const command of commands) {
    if (command.not_applicable !== null) {
      record.undriven.push({ command_v: command.command_v, interval_s: command.interval_s, reason: command.not_applicable });
      continue;
    }
    const asked = bench.attempt(command);
    if (asked.refused || command.forbidden) {
      record.refusals.push({ command_v: command.command_v, interval_s: command.interval_s, forbidden: command.forbidden,
        refused: asked.refused, predicted: command.predicted, reason: asked.reason });
      continue;
    }
    deliver(record, command, p.trains);
    if (record.steps.length === 1 && !valueIsRight(record, tolerances)) break;
  }
  bench.disarm();
  return record;
}

// Three single pulses and a burst: the strongest that is allowed.
function burst(p) {
  const command = commandsOn("500 ohm", p).filter((each) => each.not_applicable === null && !each.forbidden).pop();
  if (command === undefined) return null;
  const record = newRecord("500 ohm");
  bench.fitLoad("500 ohm");
  if (!arms(record)) return null;
  bench.drive("manual", { roughness: command.roughness, pressure: command.pressure });
  bench.wait(1.2 * command.interval_s);
  const seconds = 2.5 * command.interval_s;
  const rate = Math.min(100e3, 500e3 / seconds);
  const captures = bench.capture({ trains: 1, rate_hz: rate, samples: Math.floor(rate * seconds),
    voltage_range_v: command.capture.voltage_range_v, current_range_ma: command.capture.current_range_ma,
    trigger_v: command.capture.trigger_v });
  bench.disarm();
  const name = "500 ohm, burst";
  keepBurst(name, captures);
  return { condition: name, label: "500 Ω, " + command.command_v.toFixed(0) + " V",
    settings: "burst of " + command.command_v.toFixed(0) + " V every " + command.interval_s + " s into 500 Ω, " +
      (rate / 1e3).toFixed(0) + " kS/s" };
}

function keepBurst(name, captures) {
  record.trial(name, { captures: captures.map((each) => each.capture) });
}

function tracingsOf(loads) {
  const out = [];
  for (const name of ["500 ohm", "2 kohm", "10 kohm"]) {
    const found = loads.filter((each) => each.name === name && each.steps.length > 0)[0];
    if (found === undefined) continue;
    const step = found.steps[found.steps.length - 1];
    const reading = step.reading;
    const width = reading.width_s === null ? "width not measured" : report.quantity(reading.width_s, "s") + " a phase";
    out.push({ condition: condition(name, step), label: written(name) + ", " + step.command_v.toFixed(0) + " V",
      settings: step.command_v.toFixed(0) + " V into " + written(name) + ", " + width + ", " + (step.rate_hz / 1e6).toFixed(0) + " MS/s" });
  }
  return out;
}

// The same limit from two documents is one row of the matrix; the table of sources has both.
function sameLimit(a, b) {
  const values = (line) => JSON.stringify(line.cells.map((cell) => cell && [cell.value, cell.verdict]));
  return a.title === b.title && a.limit === b.limit && a.unit === b.unit && values(a) === values(b);
}

// Every limit against every load: seventy rows that pass do not bury the three that nearly do not.
function limitsMatrix(found) {
  const rows = [];
  for (const line of found.matrix.lines) {
    const same = rows.filter((row) => sameLimit(row, line))[0];
    if (same === undefined) {
      rows.push(Object.assign({}, line, { set: undefined, sets: [line.set] }));
    } else {
      same.sets.push(line.set);
      if (line.compare === "<") same.compare = "<";
    }
  }
  return { kind: "matrix", caption: "Limits against loads, closest to a limit first", columns: found.matrix.loads, rows: rows };
}

function closest(found) {
  return limitsMatrix(found).rows.filter((line) => line.margin_pct !== null).slice(0, CRITICAL).map((line) => {
    const cell = line.cells.filter((each) => each !== null && each.load === line.worst_load)[0];
    return { requirement: line.title, load: line.worst_load, value: cell.value,
      expanded_uncertainty: cell.expanded_uncertainty, limit: line.limit, margin_pct: line.margin_pct, unit: line.unit,
      verdict: cell.verdict, remark: cell.note || "" };
  });
}

// An open or a short circuit is judged by its trip alone and has nothing to measure.
function loadsMatrix(found) {
  const loads = found.loads.filter((load) => load.commands_delivered > 0 || load.commands_refused > 0);
  const rows = [{ title: "Nominal |Z|", cells: loads.map((load) => ({ value: load.nominal_ohm, unit: "ohm" })) }];
  const U = (load, key) => (key === "measured_ohm" ? load.measured_expanded_ohm : load[key + "_expanded"]);
  for (const [title, key, unit] of MEASURED) {
    const cells = loads.map((load) => (U(load, key) === undefined ? { value: load[key] }
      : { value: load[key], expanded_uncertainty: U(load, key) }));
    // No record lasts for 1 s or 5 s.
    const over = loads.filter((load) => load.trains > 0).map((load) => load.trains);
    const note = / over \d s$/.test(title) && over.length > 0
      ? "from " + Math.min.apply(null, over) + " captured trains, repeated" : "";
    rows.push({ title: title, note: note, unit: unit, cells: cells });
  }
  rows.push({ title: "Verdict", cells: loads.map((load) => ({ text: load.verdict })) });
  return { kind: "matrix", caption: "What was measured into each load, the strongest command that the limits allow",
    columns: loads.map((load) => load.name), rows: rows };
}

// The outputs that are disclosed, each with the loads it is asked for.
function disclosed(found) {
  const outputs = found.disclosed.map((row) => row.output).filter((each, at, all) => all.indexOf(each) === at);
  const one = (row) => (row.value === null ? row.reason : report.quantity(row.value, row.unit, row.expanded_uncertainty)) + " into " + written(row.load);
  return outputs.map((output) => ({ output: output, commanded: "",
    measured: found.disclosed.filter((row) => row.output === output).map(one).join("; ") }));
}

// Where each limit comes from and how sure that is, once and not on every row.
function sources(found) {
  const rows = [];
  for (const line of found.matrix.lines) {
    const limit = line.title + (line.compare === "<" ? " < " : " ≤ ") + report.rounded(line.limit, line.unit, 3);
    const confidence = line.confidence || "our own";
    const same = rows.filter((row) => row.source === line.source && row.confidence === confidence)[0];
    if (same === undefined) rows.push({ requirement: limit, source: line.source, confidence: confidence });
    else same.requirement += "; " + limit;
  }
  return rows;
}

function refusals(found) {
  return found.rows.filter((row) => row.set === "gate").map((row) => ({ load: row.load, asked: row.title,
    would_be: row.source, verdict: row.verdict, reason: row.verdict === "refused as expected" ? "" : row.reason }));
}

function tables(found) {
  const trips = found.rows.filter((row) => row.set === "interlock").map((row) => ({ trip: row.title.replace("trip: ", ""),
    ended_after_s: row.value, verdict: row.verdict, reason: row.reason }));
  return [
    { caption: "Closest to their limits", rows: closest(found),
      columns: ["requirement", "load", "value", "expanded_uncertainty", "limit", "margin_pct", "unit", "verdict", "remark"] },
    limitsMatrix(found),
    loadsMatrix(found),
    { caption: "Output, as the FDA guidance asks", rows: found.described.concat(disclosed(found)),
      columns: ["output", "commanded", "measured"] },
    { caption: "Asked for and refused", rows: refusals(found), columns: ["load", "asked", "would_be", "verdict", "reason"] },
    { caption: "What must end output by itself", rows: trips, columns: ["trip", "ended_after_s", "verdict", "reason"] },
    { caption: "Where each limit comes from, and our confidence in it", rows: sources(found),
      columns: ["requirement", "source", "confidence"] },
  ];
}

// A voltage of known size, since a gain error that both channels share does not show in V/I.
function readAbsolute(p) {
  if (!(p.reference_v > 0)) return null;
  if (!(p.reference_u_pct > 0)) throw new Error("reference_u_pct is 0; above 0 is expected with a reference source");
  return bench.readReference(p.reference_v, p.reference_u_pct, p.amplitude_tolerance);
}

function write(found) {
  for (const table of tables(found)) {
    if (table.kind === "matrix") report.matrix(table.caption, table.columns, table.rows);
    else if (table.rows.length > 0) report.table(table.caption, table.rows, table.columns);
  }
}

// Three pulses on one time axis; a pulse and a burst have none in common.
function writeTracings(pulses, long) {
  const note = "From the baseline before the train; the strongest command that the limits allow.";
  if (pulses.length > 0) {
    report.figure("Single pulses", plot.tracings(pulses, pulses.map((each) => each.settings).join("; ") + ". " + note));
  }
  if (long !== null) report.figure("Burst", plot.tracings([long], long.settings + ". " + note));
}

function run(p) {
  // A reading is of its command, not of the way to it.
  bench.setEncoding({ amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });
  operator.wired();
  if (p.area > 0) bench.setElectrodeArea(p.area);
  const tolerances = { load_pct: p.load_tolerance, amplitude_pct: p.amplitude_tolerance,
    resistor_pct: p.resistor_tolerance, area_pct: p.area_tolerance };

  const absolute = readAbsolute(p);
  const loads = [], trips = [];
  let reference = null, open = null;
  const judge = () => analysis.loadSafety(loads, trips, Object.assign({ tolerances: tolerances },
    absolute === null ? {} : { absolute: absolute }, reference === null ? {} : { reference: reference }, open === null ? {} : { open_circuit: open }));
  const keep = () => {
    const found = judge();
    record.partial(found, tables(found));
    return found;
  };
  keep();

  // A reading of a known load comes first: instruments that cannot give it can judge nothing.
  reference = newRecord(p.reference);
  reference.reference = true;
  enterDmm(reference, p);
  bench.fitLoad(reference.name);
  if (arms(reference)) {
    const command = bench.predict(reference.name, 0);
    if (!bench.attempt(command).refused) deliver(reference, command, p.trains);
    bench.disarm();
  }
  let found = keep();
  const known = found.rows.filter((row) => row.item === "reference" || row.item === "time_reference");

  if (known.every((row) => row.verdict === "pass") && (absolute === null || absolute.passed)) {
    for (const each of progress(bench.loads, "Loads")) {
      if (each.kind === "open" || each.kind === "short") {
        trips.push(bench.tripWhenArming(each.name, "1 kohm"));
        loads.push(newRecord(each.name));
      } else {
        loads.push(measureLoad(each.name, p, tolerances));
      }
      keepLine(keep().loads.filter((line) => line.name === each.name)[0]);
    }
    for (const kind of progress(["open", "short", "intermittent"], "Trips")) {
      // The strongest trains for the open circuit: that is where the voltage is highest, and it is measured there.
      const strength = kind === "open" ? strongestOn("1 kohm", p) : 0;
      const trip = bench.tripWhileDelivering(kind, "1 kohm", 20, strength);
      trips.push(trip);
      if (kind === "open" && trip.captures !== undefined && trip.captures.length > 0) {
        open = { command_v: trip.command_v, interval_s: trip.interval_s, reading: measure.load(trip.captures, null, null, "voltage") };
        record.trial("open circuit, " + trip.command_v.toFixed(1) + " V", Object.assign({ command_v: trip.command_v }, open.reading));
      }
      keep();
    }
    trips.push(bench.tripBySilence("1 kohm", p.silence));
    found = keep();
    write(found);
    writeTracings(tracingsOf(loads), burst(p));
  } else {
    write(found);
  }
  return verdict(found);
}
