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

  const last = bench.live();
  report.figure("Roughness, pressure and amplitude", plot.timeline(states));
  const totals = {
    duration_s: bench.time - begin,
    bursts_delivered: last.trains_delivered,
    trains_skipped: last.trains_skipped,
    samples_lost: last.samples_lost,
    gaps: last.gaps,
  };
  return verdict(Object.assign({ verdict: null }, totals));
}
