"""recompute_trains.py EXPORT: computes every train of a BIDS export again, from its files alone and by the formulas of
science.md section 4, and what was measured of trials from what was measured of their trains; only Python's own library.
Prints how many trains it computed, how many of them the fingertip drove, and how many trials it compared."""
import bisect
import csv
import gzip
import json
import math
import sys
from pathlib import Path

export = Path(sys.argv[1])
(nibs,) = export.glob("sub-*/nibs/*_nibs.tsv")
about = json.loads(nibs.with_suffix(".json").read_text())


def value(cell):
    return math.nan if cell == "n/a" else float(cell)


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))


trains = rows_of(nibs)
events = {row["event_id"]: row for row in rows_of(next(export.glob("sub-*/beh/*[!n]_events.tsv")))}
frames = []  # time, contact, R, P
for path in export.glob("sub-*/beh/*_recording-frames_physio.tsv.gz"):
    grid = json.loads(path.with_suffix("").with_suffix(".json").read_text())
    columns = [grid["Columns"].index(name) for name in ("contact", "R", "P")]
    for k, line in enumerate(gzip.open(path, "rt")):
        cells = line.rstrip("\n").split("\t")
        frames.append([grid["StartTime"] + k / grid["SamplingFrequency"]] + [value(cells[c]) for c in columns])


def curve(kind, x, begin, end):
    kind, beta = kind
    if kind == "linear":
        return begin + (end - begin) * x
    if kind == "logarithmic":
        return begin * (end / begin) ** x
    return begin + (end - begin) * x ** (1 / beta)


def within(wanted, before, ratio):
    return min(max(wanted, before / ratio), before * ratio) if ratio > 1 and before > 0 else wanted


def after(t):
    return bisect.bisect(frames, t, key=lambda frame: frame[0])


def pulled_off(since, until):
    """Whether the finger left between two trains, after which the output starts again and never above what is wanted."""
    return any(contact != 1 or math.isnan(R) for _, contact, R, _ in frames[after(since):after(until)])


changes = [(-math.inf, about["EncodingProfile"])]
changes += [(each["time_s"], each["profile"]) for each in about["EncodingProfileChanges"]]
last, computed, felt = None, 0, 0
for train in trains:
    onset, R, P = (value(train[name]) for name in ("onset", "roughness", "pressure"))
    if train["driven_by"] not in ("sensor", "manual"):
        continue
    profile = [each for since, each in changes if since <= onset][-1]["encoding"]
    for_amplitude, for_interval = (R, P) if profile["assignment"] == "texture_to_amplitude" else (P, R)
    pressed = [0.0 if math.isnan(x) else x for x in (for_amplitude, for_interval)]
    A = curve((profile["amplitude_curve"], profile["amplitude_beta"]), pressed[0], profile["amplitude_min_v"],
              profile["amplitude_max_v"])
    T = curve((profile["interval_curve"], profile["interval_beta"]), pressed[1], profile["interval_max_s"],
              profile["interval_min_s"])
    wanted = A, T
    goes_on = last and onset - last[0] <= 2 * profile["interval_max_s"]
    if goes_on:
        if profile["amplitude_slew_v_per_s"] > 0:
            most = profile["amplitude_slew_v_per_s"] * (onset - last[0])
            A = min(max(A, last[1] - most), last[1] + most)
        A = within(A, last[1], profile["amplitude_ratio_per_train"])
        T = within(T, last[2], profile["interval_ratio_per_train"])
        if train["driven_by"] == "sensor" and pulled_off(last[0], onset):
            A, T = min(A, wanted[0]), max(T, wanted[1])
    assert abs(A - value(train["encoded_voltage"])) <= 1e-9 * A, (train, A, wanted, last)
    assert abs(T - value(train["commanded_interval"])) <= 1e-6 * T, (train, T, wanted, last)
    # What the device was sent: A, held for the load, as A or A / |Z|, on the device's step.
    held = value(train["held_voltage"]) * (1 - value(train["rounded_by"]))
    assert profile["hold"] == "voltage" and abs(value(train["held_voltage"]) - A) <= 1e-9 * A
    sent = value(train["base_voltage_intensity"])
    assert math.isnan(sent) or abs(sent - held) <= 1e-9 * held, train
    # The gate let it pass.
    assert 0 < value(train["nearest_limit_share"]) <= 1 + 1e-9 and " of " in train["nearest_limit"], train
    # Its cause is one of the frames, the newest that had these values.
    if train["driven_by"] == "sensor":
        t = value(train["frame_time"])
        at = after(t + 0.5 / grid["SamplingFrequency"]) - 1
        assert abs(frames[at][0] - t) <= grid["MaxTimeError"] + 1e-9 and t <= onset <= t + 0.15, train
        assert frames[at][2] == R and (frames[at][3] == P or math.isnan(P) and math.isnan(frames[at][3])), train
        felt += 1
    # A late train counts as if it had been asked for as long an interval.
    late = onset - last[0] - T if goes_on else 0
    T = min(max(T + late, T), max(T, profile["interval_max_s"]))
    last = onset, A, T
    computed += 1
    assert events[train["event_id"]]["outcome"] == train["status"]

# The oscilloscope: a trial's numbers, which were computed while it ran, are the means of those of its captures.
compared = 0
for trial in rows_of(next(export.glob("sub-*/beh/*_beh.tsv"))):
    numbers = [f"-{int(each):05}" for each in trial.get("captures", "").split()]
    seen = [train for train in trains if train["capture"][-6:] in numbers]
    for name, mean_of in (("amplitude_v", "scope_voltage"), ("amplitude_ma", "scope_current"), ("width_s", "scope_width"),
                          ("charge_uc", "scope_charge"), ("interval_s", "scope_interval")):
        values = [value(train[mean_of]) for train in (seen[:-1] if name == "interval_s" else seen)]
        if numbers:
            assert values and abs(sum(values) / len(values) / float(trial[name]) - 1) < 1e-6, (trial, name, values)
            assert all(0 < value(train[mean_of + "_u"]) < 0.02 * value(train[mean_of]) for train in seen[:1])
    compared += bool(numbers)
print(computed, felt, compared)
