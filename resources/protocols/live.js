// What the finger feels drives the stimulator, until the recording ends.
protocol({
  title: "Live drive",
  purpose: "Drive the stimulator from a sliding finger, and record both.",
  kind: "live",
  needs: ["sensor", "stimulator"],
  view: "none",
  parameters: {
    duration: {
      label: "Duration, where the sensor does not end by itself",
      unit: "s",
      min: 0.1,
      max: 86400,
      value: 30,
    },
    load: { label: "Load", unit: "ohm", min: 1, max: 1e6, value: 1e3 },
  },
});

function run(p) {
  bench.drive("sensor");
  bench.arm({ load: p.load });

  const begin = bench.time;
  const states = bench.watch(p.duration);
  bench.disarm();

  report.figure("Roughness, pressure and amplitude", plot.timeline(states));
  report.figure("Exposure against limits", plot.exposure());
  return verdict(bench.totals(begin));
}
