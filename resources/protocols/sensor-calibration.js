// What does this fingertip read on surfaces that somebody else has measured?
//
// Rest, reference surfaces slid over again and again, known weights. Definitions: science.md section 2.6.
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
    contact_area_cm2: { label: "Contact area under a weight (0: not known)", unit: "cm2", min: 0, max: 100, value: 1 },
    store: { label: "Keep the result as a profile", type: "boolean", value: false },
  },
});

const SURFACE_COLUMNS = ["name", "ra_um", "rz_um", "slides", "h", "v", "R", "R_sd", "force_n"];

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
    record.partial(results, [{ caption: "Slides", rows: results.slides }]);
    bench.lift();
  }
}

// Up and down, again and again: what stays behind when weight is taken off shows as hysteresis.
function weigh(p, results) {
  const masses = parts(p.weights_g).map((text) => numberIn(text, "a weight in g"));
  if (masses.length === 0) return [];
  masses.sort((a, b) => a - b);
  const steps = [];
  for (let repeat = 1; repeat <= p.weight_repeats; ++repeat) {
    for (const mass of masses) steps.push({ mass, direction: "up", repeat });
    for (const mass of masses.slice().reverse()) steps.push({ mass, direction: "down", repeat });
  }
  const readings = [];
  for (const step of progress(steps, "Weights")) {
    const reading = bench.measureWeight(step.mass, { gravity_m_s2: p.gravity_m_s2 });
    readings.push(Object.assign(reading, { direction: step.direction, repeat: step.repeat }));
    record.trial("weight " + step.mass + " g", reading);
    results.weights = readings;
    record.partial(results, [
      { caption: "Weights", rows: readings, columns: ["mass_g", "reference_n", "force", "direction", "repeat"] },
    ]);
  }
  bench.lift();
  return readings;
}

function scaleOf(name, readings, tolerance_pct) {
  try {
    return analysis.sensorScale(readings, { name, tolerance_pct });
  } catch (error) {
    return { scale: null, reason: error.message };
  }
}

function forceScale(p, weights, results) {
  const at = (w) => ({ commanded: w.reference_n, measured: w.force, direction: w.direction });
  if (weights.length === 0) return { scale: null, reason: "no weights were given; force was not evaluated" };
  if (weights[0].force === null) return { scale: null, reason: "this fingertip has no force sensor; force was not evaluated" };
  const force = scaleOf("force", weights.map(at), p.weight_tolerance_pct);
  force.unit = weights[0].force_unit;
  return force;
}

function taxelScales(p, weights) {
  if (weights.length === 0 || weights[0].taxels.length === 0) return [];
  if (!(p.contact_area_cm2 > 0)) {
    return weights[0].taxels.map((_, index) => ({
      taxel: index + 1, scale: null, offset_pa: null, reason: "the contact area is not known; no pressure to compare with",
    }));
  }
  const out = [];
  for (let k = 0; k < weights[0].taxels.length; ++k) {
    const readings = weights.map((w) => ({
      commanded: w.reference_n / (p.contact_area_cm2 * 1e-4),
      measured: w.taxels[k],
      direction: w.direction,
    }));
    const found = scaleOf("taxel " + (k + 1), readings, p.weight_tolerance_pct);
    out.push({
      taxel: k + 1,
      unit: weights[0].taxel_unit,
      scale: found.scale,
      scale_expanded_uncertainty: found.scale === null ? null : found.scale_expanded_uncertainty,
      offset_pa: found.scale === null ? null : found.offset,
      offset_expanded_uncertainty_pa: found.scale === null ? null : found.offset_expanded_uncertainty,
      residual_max_pct_fs: found.scale === null ? null : found.residual_max_pct_fs,
      reason: found.reason || null,
    });
  }
  return out;
}

function show(estimate, digits) {
  const one = (value) => (value === null ? "–" : value.toPrecision(digits));
  return one(estimate.value) + " (95 %: " + one(estimate.low) + " to " + one(estimate.high) + ")";
}

function writeScales(p, results) {
  const force = results.force;
  if (force.scale !== null) {
    report.table("Force against weights (reading in " + force.unit + ")", force.levels, [
      "commanded", "n", "mean", "mean_up", "mean_down", "s", "residual",
    ]);
    report.text(
      "Force: " + force.scale.toPrecision(5) + " ± " + force.scale_expanded_uncertainty.toPrecision(2) + " N per " + force.unit +
        ", offset " + force.offset.toPrecision(3) + " ± " + force.offset_expanded_uncertainty.toPrecision(2) +
        " N (95 %); hysteresis " + force.hysteresis_pct_fs.toPrecision(2) + " % and repeatability " +
        force.repeatability_pct_fs.toPrecision(2) + " % of the largest weight.",
    );
  } else {
    report.text("Force: " + force.reason + ".");
  }
  if (results.taxels.length === 0) return;
  report.table("Taxels against force over the contact area of " + p.contact_area_cm2 + " cm²", results.taxels);
  report.text(
    "A taxel's scale is in Pa per unit of its reading and takes the weight as spread evenly over the contact area; it " +
      "holds for a contact of that shape.",
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
  for (const warning of found.warnings) report.text("Note: " + warning + ".");
}

function run(p) {
  const surfaces = surfacesOf(p);
  const results = { sensor: bench.sensorStreams };
  results.surfaces = surfaces.map((s) => ({ name: s.name, ra_um: s.ra_um, rz_um: s.rz_um, source: s.source }));
  report.table("Surfaces, as the profilometer describes them", results.surfaces, ["name", "ra_um", "rz_um", "source"]);
  record.partial(results);

  const rest = bench.measureRest({ duration_s: 3 });
  results.rest = rest;
  record.measurement("fingertip at rest", rest);
  record.partial(results);

  const weights = weigh(p, results);
  results.force = forceScale(p, weights, results);
  results.taxels = taxelScales(p, weights);
  record.measurement("force and taxels", { force: results.force, taxels: results.taxels });
  record.partial(results);

  slideOver(p, surfaces, rest, results);
  const found = analysis.sensorCalibration(surfaces, rest);
  record.measurement("sensor calibration", found);
  Object.assign(results, found);
  results.surfaces = found.surfaces.map((row, k) => Object.assign({ source: surfaces[k].source }, row));
  record.partial(results);

  writeSurfaces(found);
  writeScales(p, results);
  report.table("Slides", results.slides, ["material", "h", "h_abs", "v_static", "v_dynamic", "force_n", "sliding_frames"]);
  report.table("At rest, nothing touched", [
    { acceleration_mean_square: rest.mean_square, unit: "(" + rest.unit + ")²", taxel_floor: rest.taxel_floor, taxel_baselines: rest.taxel_baseline.length },
  ]);

  results.profile = null;
  if (found.accepted) {
    const options = { store: p.store };
    if (p.contact_area_cm2 > 0) options.contact_area_cm2 = p.contact_area_cm2;
    results.profile = record.sensorProfile(found, options);
    record.event("sensor calibrated", { name: results.profile.name, file: results.profile.file });
    report.text(
      "The profile \"" + results.profile.name + "\" holds the scales" +
        (results.profile.file === null ? "; it is in the session and was not kept as a file." : " and is kept as " + results.profile.file + "."),
    );
  } else {
    report.text("Refused: " + found.reasons.join("; ") + ". The profile stays as it was, and R uncalibrated or as calibrated before.");
  }
  for (const one of [results.force].concat(results.taxels)) {
    // What was asked for and does not follow the weights is a fault of the fingertip.
    if (one.scale !== null || weights.length === 0 || !(one.reason || "").includes("does not follow")) continue;
    results.verdict = "fail";
    results.reasons = results.reasons.concat([one.reason]);
  }
  return verdict(results);
}
