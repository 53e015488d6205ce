// What does this fingertip read on surfaces measured by a profilometer?
//
// Rest, known weights, reference surfaces slid over again and again. The scales of force and taxels are put into use
// before the surfaces are read, so that these are read as they will be. Definitions: science.md sections 2.6 and 12.
protocol({
  title: "Sensor calibration",
  purpose: "Gives roughness R its scale on this rig, and force and taxels their units",
  needs: ["sensor"],
  parameters: {
    smooth: { label: "Smooth reference", type: "text", value: "plastic" },
    smooth_ra_um: { label: "Ra of the smooth reference, by profilometer", unit: "um", min: 0.001, max: 1000, value: 1.6 },
    smooth_rz_um: { label: "Rz of the smooth reference (0: not stated)", unit: "um", min: 0, max: 10000, value: 11 },
    smooth_file: { label: "Or its profilometer CSV", type: "text", value: "" },
    rough: { label: "Rough reference", type: "text", value: "P120" },
    rough_ra_um: { label: "Ra of the rough reference, by profilometer", unit: "um", min: 0.001, max: 1000, value: 42 },
    rough_rz_um: { label: "Rz of the rough reference (0: not stated)", unit: "um", min: 0, max: 10000, value: 290 },
    rough_file: { label: "Or its profilometer CSV", type: "text", value: "" },
    more: {
      label: "Further surfaces: NAME RA RZ in um, or NAME FILE.csv; separated by ;",
      type: "text",
      value: "paper 3 21; P400 12 84; denim 24 165; P60 91 600",
    },
    slides: { label: "Slides over each surface", type: "integer", min: 3, max: 50, value: 5 },
    speed_mm_s: { label: "Sliding speed", unit: "mm/s", min: 5, max: 500, value: 50 },
    force_n: { label: "Normal force while sliding", unit: "N", min: 0.15, max: 20, value: 1 },
    duration_s: { label: "Duration of a slide", unit: "s", min: 1, max: 60, value: 4 },
    weights_g: { label: "Weights, in g, separated by ; (empty: none)", type: "text", value: "20; 50; 100; 200; 500" },
    weight_repeats: { label: "Repeats of each weight, each way", type: "integer", min: 1, max: 20, value: 3 },
    weight_tolerance_pct: { label: "Tolerance of the weights", unit: "%", min: 0, max: 10, value: 0.1 },
    gravity_m_s2: { label: "Local gravity", unit: "m/s2", min: 9.7, max: 9.9, value: 9.80665 },
    // Sea level: 9.780 m/s2 at the equator, 9.832 m/s2 at the poles (WGS 84).
    gravity_tolerance_pct: { label: "Uncertainty of local gravity, ± (0: not known)", unit: "%", min: 0, max: 1, value: 0.27 },
    contact_area_cm2: { label: "Contact area under a weight (0: not known)", unit: "cm2", min: 0, max: 100, value: 1 },
    contact_area_tolerance_pct: { label: "Uncertainty of the contact area, ± (0: not known)", unit: "%", min: 0, max: 90, value: 0 },
    reference_tolerance_pct: { label: "Known-reference check, ±", unit: "%", min: 0.1, max: 50, value: 10 },
    store: { label: "Keep the result as a profile", type: "boolean", value: false },
  },
});

const SLIDE_COLUMNS = ["material", "h", "h_abs", "v_static", "v_dynamic", "force_n", "sliding_frames"];
const SURFACE_COLUMNS = ["name", "ra_um", "rz_um", "slides", "h", "v", "R", "R_sd", "R_expanded_uncertainty", "force_n"];

function parts(text) {
  return text.split(";").map((part) => part.trim()).filter((part) => part !== "");
}

function numberIn(text, what) {
  const value = Number(text.replace(",", "."));
  if (!(value > 0)) throw new Error(what + " is " + text + "; a number above 0 is expected");
  return value;
}

function fromFile(name, path) {
  const read = bench.profilometer(path);
  return { name, ra_um: read.ra_um, rz_um: read.rz_um, source: path };
}

function reference(p, which) {
  const name = p[which].trim();
  if (p[which + "_file"] !== "") return fromFile(name, p[which + "_file"]);
  const rz_um = p[which + "_rz_um"] > 0 ? p[which + "_rz_um"] : null;
  return { name, ra_um: p[which + "_ra_um"], rz_um, source: "typed in" };
}

function furtherSurface(text) {
  const words = text.split(/\s+/);
  const name = words[0];
  if (words.length === 2 && !/^[0-9]/.test(words[1])) return fromFile(name, words[1]);
  if (words.length < 2 || words.length > 3) {
    throw new Error("more has \"" + text + "\"; NAME RA RZ in um or NAME FILE.csv is expected");
  }
  const rz_um = words.length === 3 ? numberIn(words[2], "Rz of " + name) : null;
  return { name, ra_um: numberIn(words[1], "Ra of " + name), rz_um, source: "typed in" };
}

// All of it is read before anything moves: a typing error must not cost an hour of sliding.
function surfacesOf(p) {
  const surfaces = [reference(p, "smooth"), reference(p, "rough")].concat(parts(p.more).map(furtherSurface));
  for (const surface of surfaces) {
    if (surface.rz_um !== null && !(surface.rz_um >= surface.ra_um)) {
      throw new Error("Rz of " + surface.name + " is " + surface.rz_um + " um; at least its Ra, " + surface.ra_um + " um, is expected");
    }
    if (surfaces.filter((other) => other.name === surface.name).length > 1) {
      throw new Error(surface.name + " is named twice; each surface once is expected");
    }
    surface.slides = [];
  }
  if (!(surfaces[1].ra_um > surfaces[0].ra_um)) {
    throw new Error("Ra of the rough reference is " + surfaces[1].ra_um + " um; more than the smooth one's, " + surfaces[0].ra_um + " um, is expected");
  }
  return surfaces;
}

function withoutTrack(slide) {
  const out = Object.assign({}, slide);
  delete out.track;
  return out;
}

function slidesTable(surfaces) {
  const rows = [];
  for (const surface of surfaces) for (const slide of surface.slides) rows.push(withoutTrack(slide));
  return rows;
}

function massesOf(p) {
  const masses = parts(p.weights_g).map((text) => numberIn(text, "a weight in g"));
  masses.sort((a, b) => a - b);
  if (masses.length === 1 || masses.some((mass, k) => k > 0 && mass === masses[k - 1])) {
    throw new Error("weights_g is " + p.weights_g + "; two or more different weights, or none, are expected");
  }
  return masses;
}

function slideOver(p, surfaces, rest, results) {
  const order = random.blocks(surfaces.map((surface, index) => index), p.slides);
  for (const index of progress(order, "Slides")) {
    const surface = surfaces[index];
    const slide = bench.measureSlide(surface.name, rest, {
      speed_mm_s: p.speed_mm_s,
      force_n: p.force_n,
      duration_s: p.duration_s,
    });
    surface.slides.push(slide);
    record.trial(surface.name, withoutTrack(slide));
    results.slides = slidesTable(surfaces);
    keep(results);
    bench.lift();
  }
}

// What stands if the run ends early.
function keep(results) {
  const tables = [];
  if (results.weights) {
    tables.push({ caption: "Weights", rows: results.weights, columns: ["mass_g", "reference_n", "force", "direction", "repeat"] });
  }
  if (results.slides) {
    tables.push({ caption: "Slides", rows: results.slides, columns: SLIDE_COLUMNS });
  }
  record.partial(results, tables);
}

function setUp(p, surfaces) {
  if (bench.devices.every((device) => device.simulated)) {
    report.text("Set-up: the simulated fingertip on the simulated surfaces.");
    return;
  }
  operator.confirm(
    "setup",
    "The fingertip is mounted as in use, the surfaces (" + surfaces.map((s) => s.name).join(", ") + ") are clean, and " +
      "the Ra and Rz given are of these very specimens",
  );
}

// Before anything is believed: the largest weight must read as what it is. In counts it is not known what it should read;
// then it must stand out from rest.
function checkReference(p, rest, masses) {
  const check = { mass_g: null, reference_n: null, measured: null, deviation_pct: null, allowed_pct: p.reference_tolerance_pct, passed: null };
  if (masses.length === 0 || rest.force.n === 0) return check; // not evaluated: no weight, or no force sensor
  const reading = bench.measureWeight(Math.max(...masses), { gravity_m_s2: p.gravity_m_s2 });
  check.mass_g = reading.mass_g;
  check.reference_n = reading.reference_n;
  const used = reading.force_in_use, idle = rest.force_in_use;
  check.measured = used === null || used.mean === null || idle === null || idle.mean === null ? null : used.mean - idle.mean;
  check.unit = used === null ? null : used.unit;
  if (check.measured === null) check.passed = false;
  else if (check.unit === "N") {
    check.deviation_pct = 100 * Math.abs(check.measured / reading.reference_n - 1);
    check.passed = check.deviation_pct <= p.reference_tolerance_pct;
  } else check.passed = Math.abs(check.measured) > 5 * rest.force.sd;
  record.measurement("known-reference check", check);
  return check;
}

// Up and down, again and again: what stays behind when weight is taken off shows as hysteresis.
function weigh(p, masses, results) {
  const weighed = [];
  const steps = [];
  for (let repeat = 1; repeat <= p.weight_repeats; ++repeat) {
    for (const mass of masses) steps.push({ mass, direction: "up", repeat });
    for (const mass of masses.slice().reverse()) steps.push({ mass, direction: "down", repeat });
  }
  if (steps.length === 0) return weighed;
  results.weights = [];
  for (const step of progress(steps, "Weights")) {
    const reading = bench.measureWeight(step.mass, { gravity_m_s2: p.gravity_m_s2 });
    weighed.push({ reading, direction: step.direction });
    results.weights.push(Object.assign({}, reading, { direction: step.direction, repeat: step.repeat }));
    record.trial("weight " + step.mass + " g", results.weights[results.weights.length - 1]);
    keep(results);
  }
  bench.lift();
  return weighed;
}

// What one repeat cannot tell is not known, and is not 0.
function digitsOf(value, digits) {
  return value === null || value === undefined ? "–" : value.toPrecision(digits);
}

function show(estimate, digits) {
  const one = (value) => digitsOf(value, digits);
  return one(estimate.value) + " (95 %: " + one(estimate.low) + " to " + one(estimate.high) + ")";
}

function toleranceOf(percent) {
  return percent > 0 ? "± " + percent + " %" : "not known";
}

function writeScales(p, results) {
  const force = results.force;
  if (force.scale !== null) {
    if (force.unit === "N") {
      report.figure("Force against weights", plot.calibration(Object.assign({}, force, { quantity: "force", offset: force.offset_reading })));
    }
    const rows = force.levels.map((level) => ({
      weight_n: level.commanded, n: level.n, mean: level.mean, mean_up: level.mean_up, mean_down: level.mean_down, s: level.s, residual: level.residual,
    }));
    report.table("Force against weights (reading in " + force.unit + ")", rows, [
      "weight_n", "n", "mean", "mean_up", "mean_down", "s", "residual",
    ]);
    report.text(
      "Force: " + digitsOf(force.scale, 5) + " ± " + digitsOf(force.scale_expanded_uncertainty, 2) + " N per " + force.unit +
        ", offset " + digitsOf(force.offset, 3) + " ± " + digitsOf(force.offset_expanded_uncertainty, 2) +
        " N (95 %); hysteresis " + digitsOf(force.hysteresis_pct_fs, 2) + " % and repeatability " +
        digitsOf(force.repeatability_pct_fs, 2) + " % of the largest weight.",
    );
  } else {
    report.text("Force: " + force.reason + ".");
  }
  if (results.taxels.length === 0) return;
  const unit = results.taxels[0].unit || "unit";
  report.table(
    p.contact_area_cm2 > 0
      ? "Taxels against force over the contact area of " + p.contact_area_cm2 + " cm² (scale in Pa per " + unit + ")"
      : "Taxels",
    results.taxels.map((t) => ({
      taxel: t.taxel, scale: t.scale, "scale U": t.scale_expanded_uncertainty, offset_pa: t.offset_pa,
      U_pa: t.offset_expanded_uncertainty_pa, residual_max_pct_fs: t.residual_max_pct_fs, remark: t.reason,
    })),
    ["taxel", "scale", "scale U", "offset_pa", "U_pa", "residual_max_pct_fs", "remark"],
  );
  report.text(
    "A taxel's scale takes the weight as spread evenly over the contact area; it " +
      "holds for a contact of that shape. Its U holds the tolerances of the weights (± " + p.weight_tolerance_pct + " %), of local gravity (" +
      toleranceOf(p.gravity_tolerance_pct) + ") and of the contact area (" + toleranceOf(p.contact_area_tolerance_pct) +
      "); where one is not known there is no U.",
  );
}

function writeSurfaces(found) {
  report.table("Surfaces, under the scale that was found", found.surfaces, SURFACE_COLUMNS);
  const rows = [];
  for (const key of ["h", "h_abs", "v_static", "v_dynamic"]) {
    const distance = found.d_prime.all[key];
    if (distance !== null) rows.push(Object.assign({ of: "log10 " + key }, distance));
  }
  if (found.d_prime.R !== null) rows.push(Object.assign({ of: "R" }, found.d_prime.R));
  report.table("Distance of the two references, in d′ with its 95 % interval", rows, ["of", "value", "low", "high", "told_apart"]);
  report.text(
    "d′ is the difference of the means over the pooled standard deviation of single slides; the interval is from the " +
      "non-central t distribution. Two surfaces are told apart when its lower end is at least 1, the customary " +
      "threshold at which one slide over each names the rougher in 76 % of cases; otherwise the calibration is refused.",
  );
  const rank = found.spearman;
  report.text(
    rank === null
      ? "Spearman's rank correlation of R against Ra: not evaluated; five or more surfaces of known Ra are wanted."
      : "Spearman's rank correlation of R against Ra over " + rank.n + " surfaces: " + show(rank, 3) +
          (rank.ties ? ", equal values sharing their ranks" : "") + "." + (rank.note ? " Note: " + rank.note + "." : ""),
  );
  if (rank !== null && bench.devices.every((device) => device.simulated)) {
    report.text("On the simulated fingertip the ranking holds by construction: the relief of its surfaces follows their Ra.");
  }
  report.text(found.known_limit);
  const u = found.uncertainty_R;
  report.text(
    u === null
      ? "The uncertainty of R was not evaluated."
      : "U of R for one slide (95 %, k = " + u.coverage_factor.toPrecision(3) + "): " + u.smooth.toPrecision(2) + " at R 0, " +
          u.middle.toPrecision(2) + " at R 0.5, " + u.rough.toPrecision(2) + " at R 1, from the repeatability of the slides (s = " +
          u.slide_sd.toPrecision(2) + ") and of the two references' means.",
  );
  for (const warning of found.warnings) report.text("Note: " + warning + ".");
}

function run(p) {
  const surfaces = surfacesOf(p);
  const masses = massesOf(p);
  setUp(p, surfaces);
  const results = { sensor: bench.sensorStreams, instruments: bench.devices };
  results.surfaces = surfaces.map((s) => ({ name: s.name, ra_um: s.ra_um, rz_um: s.rz_um, source: s.source }));
  report.table("Surfaces, as the profilometer describes them", results.surfaces, ["name", "ra_um", "rz_um", "source"]);
  keep(results);

  let rest = bench.measureRest({ duration_s: 3 });
  results.rest = rest;
  record.measurement("fingertip at rest", rest);
  keep(results);

  results.reference = checkReference(p, rest, masses);
  report.table("Known-reference check", [results.reference]);
  keep(results);
  if (results.reference.passed === false) {
    const read = results.reference;
    results.verdict = "indeterminate";
    results.reasons = [
      "the known-reference check failed: " + (read.measured === null ? "nothing" : read.measured.toPrecision(4) + " " + read.unit) +
        " was read under " + read.reference_n.toPrecision(4) + " N; nothing was calibrated",
    ];
    return verdict(results);
  }

  const weights = weigh(p, masses, results);
  const scales = analysis.fingertipScales(weights, {
    tolerance_pct: p.weight_tolerance_pct,
    gravity_tolerance_pct: p.gravity_tolerance_pct,
    contact_area_cm2: p.contact_area_cm2,
    contact_area_tolerance_pct: p.contact_area_tolerance_pct,
  });
  results.force = scales.force;
  results.taxels = scales.taxels;
  results.scaled = { force: false, taxels: false };
  record.measurement("force and taxels", { force: results.force, taxels: results.taxels });
  keep(results);

  if (weights.length > 0) {
    results.scaled = bench.useFingertipScales(scales);
    rest = bench.measureRest({ duration_s: 3 });
    results.rest = rest;
    record.measurement("fingertip at rest, scaled", rest);
  }
  slideOver(p, surfaces, rest, results);
  const found = analysis.sensorCalibration(surfaces, rest);
  record.measurement("sensor calibration", found);
  Object.assign(results, found);
  results.surfaces = found.surfaces.map((row, k) => Object.assign({ source: surfaces[k].source }, row));
  keep(results);

  writeSurfaces(found);
  writeScales(p, results);
  report.table("Slides", results.slides, SLIDE_COLUMNS);
  const taxels = results.sensor.find((stream) => stream.kind === "taxels");
  if (taxels) report.table(
    "Taxels at rest, nothing touched (" + rest.taxel_unit + ")",
    rest.taxel_baseline.map((baseline, k) => ({ taxel: k + 1, baseline, floor: rest.taxel_floor })),
    ["taxel", "baseline", "floor"],
  );
  if (rest.mean_square !== null) {
    report.text("Acceleration at rest, 5 Hz to 1 kHz: mean square " + rest.mean_square.toPrecision(3) + " (" + rest.unit + ")².");
  }

  results.profile = null;
  if (found.accepted) {
    const options = { store: p.store };
    if (p.contact_area_cm2 > 0) options.contact_area_cm2 = p.contact_area_cm2;
    results.profile = record.sensorProfile(found, options);
    results.reasons = [
      surfaces[0].name + " and " + surfaces[1].name + " are told apart: d′ of R is " + show(found.d_prime.R, 3) + ", at least 1 is wanted",
    ];
    record.event("sensor calibrated", { name: results.profile.name, file: results.profile.file });
    report.text(
      "The profile \"" + results.profile.name + "\" holds the scales" +
        (results.profile.file === null ? "; it is in the session and was not kept as a file." : " and is kept as " + results.profile.file + "."),
    );
  } else {
    report.text("Refused: " + found.reasons.join("; ") + ". The profile stays as it was.");
  }
  if (results.force.asked && results.verdict === "pass") {
    results.verdict = "indeterminate";
    results.reasons = [results.force.reason].concat(results.reasons);
  }
  for (const one of [results.force].concat(results.taxels)) {
    // What was asked for and does not follow the weights is a fault of the fingertip.
    if (one.scale !== null || weights.length === 0 || !(one.reason || "").includes("does not follow")) continue;
    results.verdict = "fail";
    results.reasons = [one.reason].concat(results.reasons);
  }
  return verdict(results);
}
