// What the finger feels drives a massager in place of the electrodes, until the recording ends.
protocol({
  title: "Massager in place of electrodes",
  purpose: "Feel texture as strength and pressure as pace on a massager, and record both.",
  kind: "massager",
  needs: ["sensor", "massager"],
  view: "none",
  parameters: {
    duration: {
      label: "Duration, where the sensor does not end by itself",
      unit: "s",
      min: 0.1,
      max: 86400,
      value: 30,
    },
  },
});

function run(p) {
  bench.drive("sensor");
  bench.arm();

  const begin = bench.time;
  const states = bench.watch(p.duration);
  bench.disarm();

  report.figure("Roughness, pressure and amplitude", plot.timeline(states));
  return verdict(bench.totals(begin));
}
