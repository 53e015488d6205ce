"""record_lsl.py PROGRAM FOLDER SEED: runs `live` for some seconds with --lsl and --lsl-markers, records its streams with
pylsl and sends it markers; then compares what came with the session's export, as pyxdf reads it. Prints one JSON value.

TACTOSCOPE_LSL and LSLAPICFG are set by the caller, so that nothing leaves this computer."""
import json
import math
import random
import subprocess
import sys
import threading
import time
from pathlib import Path

import pylsl
import pylsl.util
import pyxdf

program, folder, seed = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])
random.seed(seed)
NAMES = ["Tactoscope-markers", "Tactoscope-frames", "Tactoscope-trains"]
SENT_AS = "Task \u00e4"
got = {name: [] for name in NAMES}
about = {}
ended = threading.Event()


def record(name):
    found = []
    while not found and not ended.is_set():
        found = pylsl.resolve_byprop("name", name, timeout=3)
    if not found:
        return
    inlet = pylsl.StreamInlet(found[0], max_buflen=360, recover=False)
    info = inlet.info(timeout=5)
    desc, channels = info.desc(), []
    node = desc.child("channels").child("channel")
    while not node.empty():
        channels.append([node.child_value("label"), node.child_value("unit"), node.child_value("type")])
        node = node.next_sibling("channel")
    about[name] = {"type": info.type(), "rate": info.nominal_srate(), "format": info.channel_format(),
                   "channels": channels, "session": desc.child_value("session"),
                   "simulated": desc.child_value("simulated"), "source_id": info.source_id()}
    try:
        while True:
            sample, stamp = inlet.pull_sample(timeout=0.5)
            if sample is not None:
                got[name].append((stamp, sample))
            elif ended.is_set():
                return
    except pylsl.util.LostError:
        return


recorders = [threading.Thread(target=record, args=(name,)) for name in NAMES]
outlet = pylsl.StreamOutlet(pylsl.StreamInfo(SENT_AS, "Markers", 1, 0, "string", f"task-{seed}"))
for each in recorders:
    each.start()
run = subprocess.Popen([program, "run", "live", "--device", "recording:" + sys.argv[4], "--device", "sim:", "--realtime",
                        "--lsl", "--lsl-markers", SENT_AS, "--out", str(folder / "out"), "--report", "none", "--json"],
                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
notes = []
if outlet.wait_for_consumers(20):
    time.sleep(2)  # so that the clocks of the two programs are compared
    texts = ["begin", "trial 1 \u00b5", "x" * 500, "tab\there", "", "\u202eturned"]
    random.shuffle(texts)
    for text in texts:
        stamp = pylsl.local_clock()
        outlet.push_sample([text], stamp)
        notes.append((stamp, text))
        time.sleep(random.uniform(0.01, 0.2))
    for i in range(200):  # a flood: at most 20 a second are taken
        outlet.push_sample([f"flood {i}"], pylsl.local_clock())
out, err = run.communicate(timeout=120)
ended.set()
for each in recorders:
    each.join()
result = json.loads(out)
subprocess.run([program, "export", result["session"], "--format", "xdf", "--out", str(folder / "s.xdf")], check=True,
               stdout=subprocess.DEVNULL)
streams, _ = pyxdf.load_xdf(str(folder / "s.xdf"), synchronize_clocks=False, dejitter_timestamps=False)
exported = {s["info"]["name"][0]: s for s in streams}


def exported_channels(stream):
    listed = stream["info"]["desc"][0]["channels"][0]["channel"]
    return [[c["label"][0], c["unit"][0] or "", c["type"][0]] for c in listed]


def equal(a, b):
    return a == b or (isinstance(a, float) and math.isnan(a) and math.isnan(b))


said = {"about": about, "tally": result["lsl"], "stderr": err, "exit": run.returncode, "streams": {}}
offsets = []
for ours, name in (("frames", NAMES[1]), ("trains", NAMES[2]), ("events", NAMES[0])):
    theirs = exported[ours]
    rows = [(float(t), [x if isinstance(x, str) else float(x) for x in row])
            for t, row in zip(theirs["time_stamps"], theirs["time_series"])]
    if ours == "events":  # in the order of their times there, live in that of the rows; marks are known at the end only
        came = sorted(got[name], key=lambda row: row[0])
        rows = [row for row in rows if row[0] > 0]
    else:
        came = got[name]
    # Recording begins with the first sample that reached pylsl: the last ones must be equal, one for one.
    tail = rows[len(rows) - len(came):] if came else []
    bad = sum(1 for (_, a), (_, b) in zip(came, tail) if not all(equal(x, y) for x, y in zip(a, b)))
    if ours == "events":  # equal moments may stand in another order
        bad = len(came) - sum(1 for (_, a) in came if [a[0]] in [b for _, b in tail])
    steps = [a[0] - b[0] for a, b in zip(came, tail)]
    offsets += steps
    said["streams"][ours] = {"came": len(came), "exported": len(rows), "unequal": bad,
                             "channels_equal": ours == "events" or about[name]["channels"] == exported_channels(theirs)}
said["spread_s"] = max(offsets) - min(offsets) if offsets else None
middle = sorted(offsets)[len(offsets) // 2] if offsets else 0
records = [(t, json.loads(row[0])) for t, row in zip(exported["records"]["time_stamps"], exported["records"]["time_series"])]
marks = [(float(t), r["details"]) for t, r in records if r["name"] == "operator mark"]
said["marks"] = [{"t": t, **details} for t, details in marks]
first = [m for m in marks if not m[1]["text"].startswith("flood")]
sent = [n for n in notes if n[1] != ""]
said["notes_sent"] = [text for _, text in sent]
said["notes_came"] = [m[1]["text"] for m in first]
said["notes_off_s"] = max((abs(t + middle - stamp) for (t, _), (stamp, _) in zip(first, sent)), default=None)
said["stored"] = next(r["details"] for _, r in records if r["name"] == "lsl")
print(json.dumps(said))
