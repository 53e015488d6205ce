// Is what the stimulator delivers into resistors and a skin equivalent within every limit?
//
// Each load of the bench set in turn: its value is verified first, then the commands are given from the weakest up and
// judged on what the oscilloscope saw. What the limits forbid is asked for and must be refused; an open or short
// circuit, a loose contact and a silent control loop must end the output by themselves.
protocol({
  title: "Resistor-load safety check",
  purpose: "Does the stimulator keep every limit on known loads, and does it stop when it must?",
  kind: "load-safety",
  needs: ["stimulator", "oscilloscope"],
  parameters: {
    area: {
      label: "Smallest electrode's area (0: profile)",
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
    reference_v: { label: "Reference source on the oscilloscope (0: none)", unit: "V", min: 0, max: 500, step: "reference", value: 0 },
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

// A load as people write it.
function written(load) {
  return load.replace(/ohm/g, "Ω").replace(/\|\|/g, "∥");
}

function newLoad(name) {
  return { name: name, steps: [], refusals: [], undriven: [] };
}

// The resistor's own value, from a multimeter, where the technician has one at hand.
function enterDmm(load, p) {
  if (!p.dmm) return;
  const key = load.name.replace(/[^a-z0-9]+/gi, "-");
  load.dmm_ohm = operator.enter("dmm-" + key, "Multimeter reading of " + load.name, { unit: "ohm", min: 0.1, max: 1e7 });
  const expanded = operator.enter("dmm-u-" + key, "Its uncertainty (95 %)", { unit: "ohm", min: 0, max: 1e6 });
  load.dmm_u_ohm = expanded / 2;
  load.serial = operator.enter("serial-" + key, "Serial number or mark of " + load.name, { text: true });
}

// A voltage of known size, since a gain error that both channels share does not show in V/I.
function readAbsolute(p) {
  if (!(p.reference_v > 0)) return undefined;
  if (!(p.reference_u_pct > 0)) throw new Error("reference_u_pct is 0; above 0 is expected with a reference source");
  return bench.readReference(p.reference_v, p.reference_u_pct, p.amplitude_tolerance);
}

// What is wrong with one load ends that load; a fault or a stop ends the run.
function arms(load) {
  try {
    bench.arm({ load: load.name });
    return true;
  } catch (error) {
    if (bench.live().state !== "disarmed") throw error;
    load.problem = error.message;
    load.limited = error.limit === true;
    return false;
  }
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

function captureAs(command, trains, range_ma, how) {
  const options = command.capture;
  return bench.capture(Object.assign({ trains: trains, rate_hz: options.rate_hz, trigger_v: options.trigger_v,
    voltage_range_v: options.voltage_range_v, current_range_ma: range_ma }, how || { samples: options.samples }));
}

// Several trains, so that there is an interval and a spread to measure, after one that brings the output to its level.
// A refusal of what no limit forbids is kept as such; anything else ends the run.
function deliver(load, command, trains) {
  const refusedBefore = bench.live().trains_refused;
  let reading = null;
  try {
    bench.drive("manual", { roughness: command.roughness, pressure: command.pressure });
    do bench.wait(1.2 * command.interval_s);
    while (Math.abs(bench.live().amplitude_v - command.command_v) > 1e-6);
    const captures = captureAs(command, trains, command.capture.current_range_ma);
    // Two trains in one load, for an oscilloscope that does not state how good its time stamps are.
    const rhythm = captures[0].stamp_tolerance_s === null
      ? captureAs(command, 2, command.capture.current_range_ma, { intervals: true }) : null;
    // Where current settles far below a charging spike, it is read in a range of its own.
    const fine = command.fine_range_ma !== null ? captureAs(command, trains, command.fine_range_ma) : null;
    reading = measure.load(captures, fine, rhythm);
  } catch (error) {
    if (bench.live().trains_refused === refusedBefore || bench.live().state === "faulted") throw error;
    load.refusals.push({ command_v: command.command_v, interval_s: command.interval_s, forbidden: false, refused: true,
      predicted: "", reason: error.message });
  }
  bench.drive("off");
  if (reading === null) return;
  load.steps.push({ command_v: command.command_v, interval_s: command.interval_s, rate_hz: command.capture.rate_hz,
    reading: reading });
  record.trial((load.reference ? "reference " : "") + condition(load.name, command),
    Object.assign({ command_v: command.command_v }, load.reference ? {} : { load: load.name }, reading));
}

function condition(name, command) {
  return name + ", " + command.command_v.toFixed(1) + " V";
}

// The value of a load, judged alone: nothing else is asked of one that is not what it should be.
function valueIsRight(load, tolerances) {
  const rows = analysis.loadSafety([load], [], { tolerances: tolerances }).rows;
  const row = rows.filter((each) => each.load === load.name && each.item === "load_value")[0];
  if (row.verdict === "pass") return true;
  load.problem = row.reason;
  return false;
}

// Where the impedance check alone breaks a limit, arming is what must be refused, and by a limit: arming that fails for
// another reason says nothing about the limits and stays this load's problem.
function askToArm(load, forbidden) {
  const armed = arms(load);
  bench.disarm();
  if (!armed && !load.limited) return;
  load.refusals.push({ what: "arming", forbidden: true, refused: !armed, predicted: forbidden,
    reason: armed ? "" : load.problem });
  delete load.problem;
}

function measureLoad(name, p, tolerances) {
  const load = newLoad(name);
  const commands = commandsOn(name, p);
  if (commands.every((command) => command.not_applicable !== null)) {
    load.not_applicable = commands[commands.length - 1].not_applicable;
    return load;
  }
  enterDmm(load, p);
  bench.fitLoad(name);
  if (commands[0].check_forbidden !== "") {
    askToArm(load, commands[0].check_forbidden);
    return load;
  }
  if (!arms(load)) return load;
  for (const command of commands) {
    if (command.not_applicable !== null) {
      load.undriven.push({ command_v: command.command_v, interval_s: command.interval_s, reason: command.not_applicable });
      continue;
    }
    const asked = bench.attempt(command);
    if (asked.refused || command.forbidden) {
      load.refusals.push({ command_v: command.command_v, interval_s: command.interval_s, forbidden: command.forbidden,
        refused: asked.refused, predicted: command.predicted, reason: asked.reason });
      continue;
    }
    deliver(load, command, p.trains);
    if (load.steps.length === 1 && !valueIsRight(load, tolerances)) break;
  }
  bench.disarm();
  return load;
}

// A reading of a known load comes first: instruments that cannot give it can judge nothing.
function measureKnownLoad(p) {
  const known = newLoad(p.reference);
  known.reference = true;
  enterDmm(known, p);
  bench.fitLoad(known.name);
  if (!arms(known)) return known;
  const command = bench.predict(known.name, 0);
  if (!bench.attempt(command).refused) deliver(known, command, p.trains);
  bench.disarm();
  return known;
}

function isKnown(found) {
  const rows = found.rows.filter((row) => row.item === "reference" || row.item === "time_reference");
  return rows.every((row) => row.verdict === "pass");
}

// Each load of the bench set; what a load has come to is at once a row of the session, and of the window.
function checkLoads(p, made, keep) {
  for (const each of progress(bench.loads, "Loads")) {
    if (each.kind === "open" || each.kind === "short") {
      made.trips.push(bench.tripWhenArming(each.name, "1 kohm"));
      made.loads.push(newLoad(each.name));
    } else {
      made.loads.push(measureLoad(each.name, p, made.tolerances));
    }
    const line = keep().loads.filter((load) => load.name === each.name)[0];
    record.trial(line.name, Object.assign({ load: line.name, load_verdict: line.verdict }, line));
  }
}

// What must end the output by itself, provoked while trains run.
function checkTrips(p, made, keep) {
  for (const kind of progress(["open", "short", "intermittent"], "Trips")) {
    // The strongest trains for the open circuit: that is where the voltage is highest, and it is measured there.
    const trip = bench.tripWhileDelivering(kind, "1 kohm", 20, kind === "open" ? strongestOn("1 kohm", p) : 0);
    made.trips.push(trip);
    if (kind === "open" && trip.captures !== undefined && trip.captures.length > 0) {
      const reading = measure.load(trip.captures, null, null, "voltage");
      made.open_circuit = { command_v: trip.command_v, interval_s: trip.interval_s, reading: reading };
      record.trial("open circuit, " + trip.command_v.toFixed(1) + " V", Object.assign({ command_v: trip.command_v }, reading));
    }
    keep();
  }
  made.trips.push(bench.tripBySilence("1 kohm", p.silence));
}

// Three single pulses and a burst: the strongest that is allowed.
function burst(p) {
  const command = commandsOn("500 ohm", p).filter((each) => each.not_applicable === null && !each.forbidden).pop();
  if (command === undefined) return null;
  bench.fitLoad("500 ohm");
  if (!arms(newLoad("500 ohm"))) return null;
  bench.drive("manual", { roughness: command.roughness, pressure: command.pressure });
  bench.wait(1.2 * command.interval_s);
  const seconds = 2.5 * command.interval_s;
  const rate = Math.min(100e3, 500e3 / seconds);
  const captures = bench.capture({ trains: 1, rate_hz: rate, samples: Math.floor(rate * seconds),
    voltage_range_v: command.capture.voltage_range_v, current_range_ma: command.capture.current_range_ma,
    trigger_v: command.capture.trigger_v });
  bench.disarm();
  const name = "500 ohm, burst";
  record.trial(name, { captures: captures.map((each) => each.capture) });
  return { condition: name, label: "500 Ω, " + command.command_v.toFixed(0) + " V",
    settings: "burst of " + command.command_v.toFixed(0) + " V every " + command.interval_s + " s into 500 Ω, " +
      (rate / 1e3).toFixed(0) + " kS/s" };
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

  const made = { loads: [], trips: [], tolerances: { load_pct: p.load_tolerance, amplitude_pct: p.amplitude_tolerance,
    resistor_pct: p.resistor_tolerance, area_pct: p.area_tolerance } };
  const judge = () => analysis.loadSafety(made.loads, made.trips, { tolerances: made.tolerances, absolute: made.absolute,
    reference: made.reference, open_circuit: made.open_circuit });
  const keep = () => {
    const found = judge();
    record.partial(found);
    return found;
  };

  made.absolute = readAbsolute(p);
  keep();
  made.reference = measureKnownLoad(p);
  let found = keep();
  if (!isKnown(found) || (made.absolute !== undefined && !made.absolute.passed)) {
    report.loadSafety(found);
    return verdict(found);
  }
  checkLoads(p, made, keep);
  checkTrips(p, made, keep);
  found = keep();
  report.loadSafety(found);
  writeTracings(tracingsOf(made.loads), burst(p));
  return verdict(found);
}
