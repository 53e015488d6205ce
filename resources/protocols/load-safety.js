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

// From a multimeter, where the technician has one at hand.
function enterValue(load, p) {
  if (!p.dmm) return;
  const key = load.name.replace(/[^a-z0-9]+/gi, "-");
  const range = { unit: "ohm", min: 0.1, max: 1e7 };
  load.dmm_ohm = operator.enter("dmm-" + key, "Multimeter reading of " + load.name, range);
  load.dmm_u_ohm = operator.enter("dmm-u-" + key, "Its uncertainty (95 %)", { unit: "ohm", min: 0, max: 1e6 }) / 2;
  load.serial = operator.enter("serial-" + key, "Serial number or mark of " + load.name, { text: true });
}

function newLoad(name) {
  return { name: name, steps: [], refusals: [], undriven: [] };
}

// One command: what the limits forbid must be refused, what they allow is read and becomes a trial.
function give(load, command, p, mark) {
  const given = loads.give(command, p.trains);
  load[given.list].push(given.entry);
  if (given.list !== "steps") return;
  const of = mark ? { type: "reference" } : { type: "command", load: load.name };
  const trial = Object.assign(of, { command_v: command.command_v }, given.entry.reading);
  record.trial((mark || "") + given.entry.condition, trial);
}

// A reading of a known load comes first: instruments that cannot give it can judge nothing.
function measureKnownLoad(p) {
  const load = newLoad(p.reference);
  enterValue(load, p);
  bench.fitLoad(load.name);
  load.problem = loads.arm(load.name);
  if (load.problem === "") give(load, loads.commands(load.name, p.steps)[0], p, "reference ");
  bench.disarm();
  return load;
}

// Its value is verified first: nothing else is asked of a load that is not what it should be.
function measureLoad(name, p, tolerances) {
  const load = newLoad(name);
  const commands = loads.commands(name, p.steps);
  if (commands.every((command) => command.not_applicable !== null)) {
    load.not_applicable = commands[commands.length - 1].not_applicable;
    return load;
  }
  enterValue(load, p);
  bench.fitLoad(name);
  if (commands[0].check_forbidden !== "") return Object.assign(load, loads.askToArm(commands[0]));
  load.problem = loads.arm(name);
  if (load.problem !== "") return load;
  for (const command of commands) {
    give(load, command, p);
    if (load.steps.length === 1) load.problem = analysis.loadValue(load, tolerances);
    if (load.problem !== "") break;
  }
  bench.disarm();
  return load;
}

// What a load has come to is at once a row of the session, and of the window.
function checkLoads(p, made, keep) {
  for (const each of progress(bench.loads, "Loads")) {
    const endsOutput = each.kind === "open" || each.kind === "short";
    if (endsOutput) made.trips.push(bench.tripWhenArming(each.name, "1 kohm"));
    made.loads.push(endsOutput ? newLoad(each.name) : measureLoad(each.name, p, made.tolerances));
    const line = keep().loads.find((load) => load.name === each.name);
    record.trial(line.name, Object.assign({}, line, { type: "load", load: line.name }));
  }
}

// What must end the output by itself, provoked while trains run; into an open circuit the strongest, whose voltage is
// measured there.
function checkTrips(p, made, keep) {
  const strongest = loads.strongest("1 kohm", p.steps);
  for (const kind of progress(["open", "short", "intermittent"], "Trips")) {
    const strength = kind === "open" && strongest !== null ? strongest.strength : 0;
    const trip = bench.tripWhileDelivering(kind, "1 kohm", 20, strength);
    made.trips.push(trip);
    if (kind === "open" && trip.captures.length > 0) {
      const reading = measure.load(trip.captures, null, null, "voltage");
      made.open_circuit = { command_v: trip.command_v, interval_s: trip.interval_s, reading: reading };
      const name = "open circuit, " + trip.command_v.toFixed(1) + " V";
      record.trial(name, Object.assign({ command_v: trip.command_v }, reading));
    }
    keep();
  }
  made.trips.push(bench.tripBySilence("1 kohm", p.silence));
}

// The strongest trains that the limits allow, for the report.
function captureBurst(p) {
  const strongest = loads.strongest("500 ohm", p.steps);
  if (strongest === null) return null;
  bench.fitLoad("500 ohm");
  if (loads.arm("500 ohm") !== "") return null;
  const burst = Object.assign(loads.burst(strongest), { load: "500 ohm", condition: "500 ohm, burst" });
  bench.disarm();
  record.trial(burst.condition, { captures: burst.captures.map((each) => each.capture) });
  return burst;
}

function run(p) {
  // A reading is of its command, not of the way to it.
  bench.setEncoding({ amplitude_ratio_per_train: 0, amplitude_slew_v_per_s: 0, interval_ratio_per_train: 0 });
  operator.wired();
  if (p.area > 0) bench.setElectrodeArea(p.area);

  const made = { loads: [], trips: [], tolerances: { load_pct: p.load_tolerance, amplitude_pct: p.amplitude_tolerance,
    resistor_pct: p.resistor_tolerance, area_pct: p.area_tolerance } };
  const keep = () => {
    const found = analysis.loadSafety(made.loads, made.trips, { tolerances: made.tolerances, absolute: made.absolute,
      reference: made.reference, open_circuit: made.open_circuit });
    record.partial(found);
    return found;
  };

  // A gain error that both channels share does not show in V/I: a voltage of known size, where there is one.
  if (p.reference_v > 0) {
    if (!(p.reference_u_pct > 0)) throw new Error("reference_u_pct is 0; above 0 is expected with a reference source");
    made.absolute = bench.readReference(p.reference_v, p.reference_u_pct, p.amplitude_tolerance);
  }
  keep();
  made.reference = measureKnownLoad(p);
  let found = keep();
  const references = found.rows.filter((row) => row.item === "reference" || row.item === "time_reference");
  const known = references.every((row) => row.verdict === "pass") && (!made.absolute || made.absolute.passed);
  if (known) {
    checkLoads(p, made, keep);
    checkTrips(p, made, keep);
    found = keep();
  }
  report.loadSafety(found);
  if (known) report.loadTracings(made.loads, captureBurst(p));
  return verdict(found);
}
