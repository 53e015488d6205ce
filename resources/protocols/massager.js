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

const MOST_STATES = 2000;

function run(p) {
  bench.drive("sensor");
  bench.arm();

  // A long run is shown more coarsely, so that the figure stays readable and the memory flat.
  const begin = bench.time;
  let states = [];
  let step = 0.05;
  const duration = bench.replayed ? Infinity : p.duration;
  while (!bench.finished && bench.time - begin < duration) {
    bench.wait(Math.min(step, Math.max(0.001, duration - (bench.time - begin))));
    states[states.length] = bench.live();
    if (states.length >= MOST_STATES) {
      states = states.filter((state, index) => index % 2 === 1);
      step *= 2;
    }
  }
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
  report.table("Totals", [totals]);
  return verdict(Object.assign({ verdict: null }, totals));
}
