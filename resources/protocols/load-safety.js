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
    steps: { label: "Commands per load", type: "integer", min: 2, max: 11, value: 4 },
    area: { label: "Smallest electrode (0: profile)", unit: "cm2", min: 0, max: 1000, value: 0 },
    dmm: { label: "Enter multimeter readings", type: "boolean", value: false },
    load_tolerance: { label: "Tolerance of a load's value", unit: "%", min: 0.1, max: 15, value: 5 },
    amplitude_tolerance: { label: "Amplitude over the command", unit: "%", min: 0.1, max: 20, value: 2 },
    silence: { label: "Heartbeat withheld for", unit: "s", min: 0.5, max: 10, value: 1.5 },
    reference: {
      label: "Known load, measured first",
      type: "choice",
      choices: { "500 ohm": "500 ohm", "1 kohm": "1 kohm", "2 kohm": "2 kohm" },
      value: "1 kohm",
    },
  },
});

const LOAD_COLUMNS = ["name", "serial", "nominal_ohm", "measured_ohm", "peak_v", "peak_ma", "rms_train_ma", "rms_1s_ma",
  "rms_5s_ma", "charge_uc", "net_charge_uc", "energy_mj", "power_density_w_cm2", "verdict"];
const ROW_COLUMNS = ["title", "load", "value", "expanded_uncertainty", "limit", "unit", "verdict"];

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

function captureAs(command, trains, range_ma) {
  const options = command.capture;
  return bench.capture({ trains: trains, rate_hz: options.rate_hz, samples: options.samples, trigger_v: options.trigger_v,
    voltage_range_v: options.voltage_range_v, current_range_ma: range_ma });
}

// Two trains, so that there is an interval to measure, after one that brings the output to its level. A refusal of
// what no limit forbids is kept as such; anything else ends the run.
function deliver(record, command) {
  const refusedBefore = bench.live().trains_refused;
  let reading = null;
  try {
    bench.drive("manual", { roughness: command.roughness, pressure: command.pressure });
    do bench.wait(1.2 * command.interval_s);
    while (Math.abs(bench.live().amplitude_v - command.command_v) > 1e-6);
    const captures = captureAs(command, 2, command.capture.current_range_ma);
    // Where current settles far below a charging spike, it is read in a range of its own.
    reading = command.fine_range_ma !== null ? measure.load(captures, captureAs(command, 2, command.fine_range_ma)) : measure.load(captures);
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
    deliver(record, command);
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
  return { condition: name, label: "500 ohm, " + command.command_v.toFixed(0) + " V",
    settings: "burst of " + command.command_v.toFixed(0) + " V every " + command.interval_s + " s into 500 ohm, " +
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
    const width = reading.width_s === null ? "width not measured" : (1e6 * reading.width_s).toFixed(1) + " us per phase";
    out.push({ condition: condition(name, step), label: name + ", " + step.command_v.toFixed(0) + " V",
      settings: "single pulse of " + step.command_v.toFixed(0) + " V into " + name + ", " + width + ", " +
        (step.rate_hz / 1e6).toFixed(1) + " MS/s" });
  }
  return out;
}

function byTitle(rows) {
  const titles = rows.map((row) => row.title).filter((title, i, all) => all.indexOf(title) === i);
  return titles.reduce((sorted, title) => sorted.concat(rows.filter((row) => row.title === title)), []);
}

// Where each limit comes from, once, and not on every row.
function sources(rows) {
  const said = [];
  for (const row of rows) {
    const text = row.title + ": " + row.source;
    if (row.source && row.set !== "gate" && row.set !== "interlock" && !said.includes(text)) said.push(text);
  }
  return said.length === 0 ? "" : "Sources of the limits. " + said.join("; ") + ".";
}

function tables(found) {
  // By requirement, so that a page shows one of them over all loads.
  const of = (set) => byTitle(found.rows.filter((row) => row.set === set));
  return [
    { caption: "Loads", rows: found.loads, columns: LOAD_COLUMNS },
    { caption: "Outputs that the FDA guidance asks to be stated", rows: found.disclosed,
      columns: ["output", "load", "value", "expanded_uncertainty", "plus_minus_pct", "unit", "reason"] },
    { caption: "IEC 60601-2-10", rows: of("iec-60601-2-10"), columns: ROW_COLUMNS },
    { caption: "FDA guidance", rows: of("fda-pms"), columns: ROW_COLUMNS },
    { caption: "The paper: up to 40 V, below 10 mA RMS over 5 s", rows: of("paper"), columns: ROW_COLUMNS },
    { caption: "The laboratory's own", rows: of("laboratory"), columns: ROW_COLUMNS },
    { caption: "Asked for and refused", rows: of("gate"), columns: ["load", "title", "source", "verdict", "reason"] },
    { caption: "What must end output by itself", rows: of("interlock"), columns: ["title", "value", "unit", "verdict", "reason"] },
    { caption: "Worst case over the permitted loads, extrapolated", rows: byTitle(found.worst_case.rows), columns: ROW_COLUMNS },
  ];
}

function run(p) {
  operator.wired();
  if (p.area > 0) bench.setElectrodeArea(p.area);
  const tolerances = { load_pct: p.load_tolerance, amplitude_pct: p.amplitude_tolerance };

  const loads = [], trips = [];
  let reference = null;
  const judge = () => analysis.loadSafety(loads, trips, reference === null ? { tolerances: tolerances }
    : { reference: reference, tolerances: tolerances });
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
    if (!bench.attempt(command).refused) deliver(reference, command);
    bench.disarm();
  }
  let found = keep();
  const known = found.rows.filter((row) => row.item === "reference")[0];

  if (known.verdict === "pass") {
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
      trips.push(bench.tripWhileDelivering(kind, "1 kohm", 20));
      keep();
    }
    trips.push(bench.tripBySilence("1 kohm", p.silence));
    found = keep();
    const tracings = tracingsOf(loads);
    const long = burst(p);
    if (long !== null) tracings.push(long);
    // A figure each: a pulse and a burst have no time axis in common.
    for (const tracing of tracings) report.figure("Tracing: " + tracing.settings, plot.tracings([tracing],
      "From the baseline before the train; the strongest command that the limits allow."));
  }
  for (const table of tables(found)) report.table(table.caption, table.rows, table.columns);
  const from = sources(found.rows.concat(found.worst_case.rows));
  if (from !== "") report.text(from);
  if (found.reasons.length > 0) report.text(found.reasons.slice(0, 12).join(". ") + ".");
  return verdict(found);
}
