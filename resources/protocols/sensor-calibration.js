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

function run(p) {
  // All that the operator says of surfaces and weights is read before anything moves; then the fingertip at rest.
  const surfaces = bench.sensorCalibration.begin(p);
  if (!bench.sensorCalibration.knownWeight()) return verdict(bench.sensorCalibration.conclude());

  // Each weight up and down, again and again: the scales of force and taxels, in use before the surfaces are read.
  if (p.weights_g.trim() !== "") {
    for (const step of progress(bench.sensorCalibration.weighings, "Weights")) bench.sensorCalibration.weigh(step);
  }
  bench.sensorCalibration.scale();

  // Over each surface again and again, in random order.
  for (const surface of progress(random.blocks(surfaces, p.slides), "Slides")) bench.sensorCalibration.slide(surface);
  return verdict(bench.sensorCalibration.conclude());
}
