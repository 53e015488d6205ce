// What does this fingertip read on surfaces measured by a profilometer?
//
// Rest, known weights, reference surfaces slid over again and again. The scales of force and taxels are put into use
// before the surfaces are read, so that these are read as they will be. Definitions: science.md sections 2.6 and 12.
protocol({
  title: "Sensor calibration",
  purpose: "Gives roughness R its scale on this rig, and force and taxels their units",
  kind: "sensor-calibration",
  needs: ["sensor"],
  view: "slides",
  parameters: {
    smooth: { label: "Smooth reference", type: "text", step: "reference", value: "plastic" },
    smooth_ra_um: {
      label: "Ra of the smooth reference, by profilometer",
      unit: "um",
      min: 0.001,
      max: 1000,
      step: "reference",
      value: 1.6,
    },
    smooth_rz_um: {
      label: "Rz of the smooth reference",
      zero: "not stated",
      unit: "um",
      min: 0,
      max: 10000,
      step: "reference",
      value: 11,
    },
    smooth_file: { label: "Or its profilometer CSV", type: "file", step: "reference", value: "" },
    rough: { label: "Rough reference", type: "text", step: "reference", value: "P120" },
    rough_ra_um: {
      label: "Ra of the rough reference, by profilometer",
      unit: "um",
      min: 0.001,
      max: 1000,
      step: "reference",
      value: 42,
    },
    rough_rz_um: {
      label: "Rz of the rough reference",
      zero: "not stated",
      unit: "um",
      min: 0,
      max: 10000,
      step: "reference",
      value: 290,
    },
    rough_file: { label: "Or its profilometer CSV", type: "file", step: "reference", value: "" },
    more: {
      step: "reference",
      label: "Further surfaces: NAME RA RZ in um, or NAME FILE.csv; separated by ;",
      type: "text",
      value: "paper 3 21; P400 12 84; denim 24 165; P60 91 600",
    },
    slides: { label: "Slides over each surface", type: "integer", min: 3, max: 50, value: 5 },
    speed_mm_s: { label: "Sliding speed", unit: "mm/s", min: 5, max: 500, value: 50 },
    force_n: { label: "Normal force while sliding", unit: "N", min: 0.15, max: 20, value: 1 },
    duration_s: { label: "Duration of a slide", unit: "s", min: 1, max: 60, value: 4 },
    weights_g: {
      label: "Weights, in g, separated by ; (empty: none)",
      type: "text",
      step: "reference",
      value: "20; 50; 100; 200; 500",
    },
    weight_repeats: { label: "Repeats of each weight, each way", type: "integer", min: 1, max: 20, value: 3 },
    weight_tolerance_pct: {
      label: "Tolerance of the weights",
      unit: "%",
      min: 0,
      max: 10,
      step: "reference",
      value: 0.1,
    },
    gravity_m_s2: { label: "Local gravity", unit: "m/s2", min: 9.7, max: 9.9, step: "reference", value: 9.80665 },
    // Sea level: 9.780 m/s2 at the equator, 9.832 m/s2 at the poles (WGS 84).
    gravity_tolerance_pct: {
      label: "Uncertainty of local gravity, ±",
      zero: "not known",
      unit: "%",
      min: 0,
      max: 1,
      step: "reference",
      value: 0.27,
    },
    contact_area_cm2: {
      label: "Contact area under a weight",
      zero: "not known",
      unit: "cm2",
      min: 0,
      max: 100,
      value: 1,
    },
    contact_area_tolerance_pct: {
      label: "Uncertainty of the contact area, ±",
      zero: "not known",
      unit: "%",
      min: 0,
      max: 90,
      value: 0,
    },
    reference_tolerance_pct: {
      label: "Known-reference check, ±",
      unit: "%",
      min: 0.1,
      max: 50,
      step: "reference",
      value: 10,
    },
    store: { label: "Keep the result as a profile", type: "boolean", value: false },
  },
});

// All of it is read before anything moves: a typing error must not cost an hour of sliding.
function surfacesOf(p) {
  const reference = (which) => ({
    name: p[which],
    ra_um: p[which + "_ra_um"],
    rz_um: p[which + "_rz_um"],
    file: p[which + "_file"],
  });
  const surfaces = bench.surfaces(reference("smooth"), reference("rough"), p.more);
  return surfaces.map((surface) => Object.assign(surface, { slides: [] }));
}

function setUp(surfaces) {
  if (bench.devices.every((device) => device.simulated)) {
    report.text("Set-up: the simulated fingertip on the simulated surfaces.");
    return;
  }
  operator.confirm(
    "setup",
    "The fingertip is mounted as in use, the surfaces (" + surfaces.map((s) => s.name).join(", ") +
      ") are clean, and the Ra and Rz given are of these very specimens",
  );
}

function readRest(results, name) {
  results.rest = bench.measureRest({ duration_s: 3 });
  record.measurement(name, results.rest);
}

// Before anything is believed: the largest weight must read as what it is.
function checkReference(p, rest, masses) {
  const weighs = masses.length > 0 && rest.force.n > 0;
  const reading = weighs ? bench.measureWeight(Math.max(...masses), { gravity_m_s2: p.gravity_m_s2 }) : null;
  const known = calibration.knownWeight(reading, rest, p.reference_tolerance_pct, {
    weight_tolerance_pct: p.weight_tolerance_pct,
    gravity_tolerance_pct: p.gravity_tolerance_pct,
  });
  if (weighs) record.measurement("known-reference check", known.check);
  return known;
}

// Each weight up and down, again and again.
function weigh(p, masses, results) {
  if (masses.length === 0) return [];
  const weighed = [];
  results.weights = [];
  for (const step of progress(calibration.weighings(masses, p.weight_repeats), "Weights")) {
    const reading = bench.measureWeight(step.mass_g, { gravity_m_s2: p.gravity_m_s2 });
    const row = Object.assign({}, reading, { direction: step.direction, repeat: step.repeat });
    weighed.push({ reading, direction: step.direction });
    results.weights.push(row);
    record.trial("weight " + step.mass_g + " g", row);
    record.partial(results);
  }
  bench.lift();
  return weighed;
}

// Weights become the scales of force and taxels, which are put into use before the surfaces are read.
function scaleFingertip(p, weighed, results) {
  const known = {
    tolerance_pct: p.weight_tolerance_pct,
    gravity_tolerance_pct: p.gravity_tolerance_pct,
    contact_area_cm2: p.contact_area_cm2,
    contact_area_tolerance_pct: p.contact_area_tolerance_pct,
  };
  const scales = analysis.fingertipScales(weighed, known);
  Object.assign(results, { force: scales.force, taxels: scales.taxels, scaled: { force: false, taxels: false } });
  record.measurement("force and taxels", { force: results.force, taxels: results.taxels });
  record.partial(results);
  if (weighed.length > 0) {
    results.scaled = bench.useFingertipScales(scales);
    readRest(results, "fingertip at rest, scaled");
  }
  const force = scales.force;
  if (force.unit === "N" && force.scale !== null) {
    report.figure("Force against weights",
      plot.calibration(Object.assign({}, force, { quantity: "force", offset: force.offset_reading })));
  }
}

// Over each surface again and again, in random order.
function slideOver(p, surfaces, results) {
  const rest = results.rest;
  const how = { speed_mm_s: p.speed_mm_s, force_n: p.force_n, duration_s: p.duration_s };
  const rows = surfaces.map(() => []);
  for (const index of progress(random.blocks(surfaces.map((surface, k) => k), p.slides), "Slides")) {
    const surface = surfaces[index];
    const slide = bench.measureSlide(surface.name, rest, how);
    surface.slides.push(slide);
    rows[index].push(slide);
    record.trial(surface.name, slide);
    results.slides = [].concat(...rows);
    record.partial(results);
    bench.lift();
  }
}

// What was found becomes a profile, unless the references cannot be told apart.
function keepProfile(p, found, results) {
  results.profile = null;
  if (!found.accepted) {
    report.text("Refused: " + found.reasons.join("; ") + ". The profile stays as it was.");
    return;
  }
  const area = p.contact_area_cm2 > 0 ? { contact_area_cm2: p.contact_area_cm2 } : {};
  results.profile = record.sensorProfile(found, Object.assign({ store: p.store }, area));
  const { name, file } = results.profile;
  record.event("sensor calibrated", { name: name, file: file });
  report.text("The profile \"" + name + "\" holds the scales" +
    (file === null ? "; it is in the session and was not kept as a file." : " and is kept as " + file + "."));
}

function run(p) {
  const surfaces = surfacesOf(p);
  const masses = bench.weights(p.weights_g);
  setUp(surfaces);
  const results = { sensor: bench.sensorStreams, instruments: bench.devices };
  results.surfaces = surfaces.map((s) => ({ name: s.name, ra_um: s.ra_um, rz_um: s.rz_um, source: s.source }));
  record.partial(results);

  readRest(results, "fingertip at rest");
  record.partial(results);
  const reference = checkReference(p, results.rest, masses);
  results.reference = reference.check;
  record.partial(results);
  if (reference.check.passed === false) {
    return verdict(Object.assign(results, { verdict: "indeterminate", reasons: [reference.reason] }));
  }

  const weighed = weigh(p, masses, results);
  scaleFingertip(p, weighed, results);
  slideOver(p, surfaces, results);
  const found = analysis.sensorCalibration(surfaces, results.rest);
  record.measurement("sensor calibration", found);
  Object.assign(results, found);
  results.surfaces = found.surfaces.map((row, k) => Object.assign({ source: surfaces[k].source }, row));
  record.partial(results);

  if (!found.spearman) {
    report.text("Spearman's rank correlation of R against Ra: not evaluated; five or more surfaces of known Ra are " +
      "wanted.");
  } else if (bench.devices.every((device) => device.simulated)) {
    report.text("On the simulated fingertip the ranking holds by construction: the relief of its surfaces follows " +
      "their Ra.");
  }
  keepProfile(p, found, results);
  return verdict(Object.assign(results, calibration.sensorVerdict(results, weighed.length > 0)));
}
