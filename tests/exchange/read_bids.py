"""read_bids.py EXPORT EXPECTED HDF5: compares a BIDS export with what was recorded, by pandas, and with the HDF5 export of
the same session, by h5py; then both of BIDS's validators look at it."""
import gzip
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import h5py
import numpy
import pandas

warnings.simplefilter("ignore")  # pandas 3 calls round_trip the default that it was not before
export, expected, hdf5 = Path(sys.argv[1]), Path(sys.argv[2]), h5py.File(sys.argv[3])
drawn = json.loads((expected / "expected.json").read_text())
UNITS = {"m/s2": "m/s^2"}
STEM = "sub-sim_task-separability_"
beh, nibs = export / "sub-sim/beh", export / "sub-sim/nibs"


def table(path):
    """Reads a table as pandas does; each column is described, and the marks stand beside."""
    raw = path.read_bytes()
    assert b"\r" not in raw and raw.endswith(b"\n"), path
    frame = pandas.read_csv(path, sep="\t", na_values=["n/a"], keep_default_na=False, float_precision="round_trip")
    about = json.loads(path.with_suffix(".json").read_text())
    for column in frame.columns:
        assert about[column]["Description"], (path, column)
        # To BIDS, what has a unit is a number, and so every number has one.
        if not frame[column].isna().all() and column != "captures":  # lists, here of one
            assert ("Units" in about[column]) == (frame[column].dtype.kind in "if"), (path, column)
    assert about["Simulated"] is True and "uncalibrated R" in about["Marks"], path
    return frame, about


def same(a, b):
    """Equal in every bit; not a number is absent."""
    a, b = numpy.asarray(a, float), numpy.asarray(b, float)
    return a.shape == b.shape and bool(numpy.all((a.view("u8") == b.view("u8")) | (numpy.isnan(a) & numpy.isnan(b))))


description = json.loads((export / "dataset_description.json").read_text())
assert description["Name"].endswith("(simulated)") and description["BIDSVersion"] == "1.11.1"
assert description["Simulated"] is True and "uncalibrated R" in description["Marks"]
assert description["Session"]["chain_head"] == hdf5.attrs["chain_head"].decode()
assert re.fullmatch("[0-9a-f]{40}", description["NIBSBIDS"]["Commit"]) and description["NIBSBIDS"]["Version"]
assert "SIMULATED" in (export / "README").read_text()
people, _ = table(export / "participants.tsv")
assert list(people["participant_id"]) == ["sub-sim"] and people["species"].isna().all()

# Streams: each recorded sample stands at the row nearest to its stamp, and nothing else stands anywhere.
report = json.loads((expected / "report.json").read_text())
left = {each["what"] for each in report["left_out"]}
assert {"captures", "records"} <= left
said = {stream["name"]: stream for stream in report["streams"]}
for stream in drawn["streams"]:
    name, columns = stream["name"], stream["columns"]
    path = beh / f"{STEM}recording-{name.replace('-', '')}_physio.tsv.gz"
    if name in left:
        assert not path.exists() and name not in said
        continue
    packed = path.read_bytes()
    assert packed[:4] == b"\x1f\x8b\x08\x00" and packed[4:8] == b"\0\0\0\0", "no name and the date 0"
    about = json.loads(path.with_suffix("").with_suffix(".json").read_text())
    assert about["Columns"] == columns and about["Simulated"] is True
    for column, unit in zip(columns, stream["units"]):
        assert about[column]["Units"] == UNITS.get(unit, unit) and about[column]["Description"]
    rows = [line.split("\t") for line in gzip.decompress(packed).decode().splitlines()]
    assert all(len(row) == len(columns) for row in rows)
    grid = numpy.array([[math.nan if cell == "n/a" else float(cell) for cell in row] for row in rows]).reshape(-1, len(columns))
    recorded = numpy.fromfile(expected / (name + ".f64")).reshape(-1, 1 + len(columns))
    rate, start = about["SamplingFrequency"], about["StartTime"]
    assert rate > 0 and len(recorded) == stream["samples"]
    if len(recorded) == 0:
        assert len(grid) == 0
        continue
    stamps = hdf5["streams"][name]["time"][:]
    assert start == stamps[0] and len(stamps) == len(recorded)
    slots = numpy.floor((stamps - start) * rate + 0.5).astype(int)
    kept, last, dropped = {}, -1, 0
    for slot, values in zip(slots, recorded[:, 1:]):
        if slot < max(last, 0):
            dropped += 1
            continue
        dropped += slot in kept
        kept[slot], last = values, slot
    assert dropped == said[name]["dropped"] <= 0.01 * len(recorded), (name, dropped)
    assert len(grid) == last + 1
    repeated = 0
    for k, row in enumerate(grid):
        if k in kept:
            assert same(row, kept[k]), (name, k)
        elif not numpy.isnan(row).all():
            repeated += 1
            assert k - 1 in kept and k + 1 in kept and same(row, kept[k - 1]), (name, k)
    assert repeated <= said[name]["repeated"]
    for column, count in zip(said[name]["channels"], numpy.isnan(recorded[:, 1:]).sum(axis=0)):
        assert column["absent"] == count and column["exact"] is True

# Trials and events against the session and the HDF5 export.
trials, _ = table(beh / f"{STEM}beh.tsv")
assert list(trials.columns[:3]) == ["trial", "trial_type", "time"] and not {"onset", "duration"} & set(trials.columns)
for row, (t, number, condition, amplitude, pulses) in zip(trials.to_dict("records"), drawn["trials"], strict=True):
    assert row["time"] == t and row["trial"] == number and row["trial_type"] == condition
    assert same(row["amplitude_v"], math.nan if amplitude is None else amplitude) and row["pulses"] == pulses
    assert row["warnings"] == "one, two; three"
events, _ = table(beh / f"{STEM}acq-session_events.tsv")
assert list(events.columns[:3]) == ["onset", "duration", "trial_type"]
for row, (t, name, details) in zip(events.to_dict("records"), drawn["events"], strict=True):
    assert row["onset"] == t and row["trial_type"] == name and json.loads(row["details"]) == details
trains, about = table(beh / f"{STEM}events.tsv")
assert list(trains.columns[:3]) == ["onset", "duration", "trial_type"] and trains["onset"].is_monotonic_increasing
both = hdf5["trains"]
order = numpy.argsort(both["time"][:], kind="stable")
assert same(trains["onset"], both["time"][:][order])
assert list(trains["outcome"].fillna("")) == [both["outcome"][i].decode() for i in order]
for name in ("roughness", "pressure", "command_v", "told_v", "told_ma", "read_back_v", "interval_s"):
    assert same(trains[name], both[name][:][order]), name
assert list(trains["reason"].fillna("")) == [both["reason"][i].decode() for i in order]

# What was put out: delivered, failed and checks, each in the events, and the amplitude that the device was sent.
out, about = table(nibs / f"{STEM}stimsys-tes_nibs.tsv")
assert about["StimulationSystem"].startswith("tes") and len(about["ElectrodeSet"]) == 2
known = trains.set_index("event_id")
assert list(out["status"]) == ["delivered", "delivered", "failed", "delivered"]
for row in out.to_dict("records"):
    train = known.loc[row["event_id"]]
    assert same(row["onset"], train["onset"]) and same(row["base_voltage_intensity"], train["told_v"])
    assert same(row["encoded_voltage"], train["command_v"]) and same(row["roughness"], train["roughness"])
(measured,) = about["Thresholds"]
assert measured["estimate"]["value"] == 2.5 and about["PersonalRange"] == "unknown"
for row in out.to_dict("records"):
    later = row["onset"] >= measured["time_s"]
    assert same(row["threshold_reference_current"], 2.5 if later else math.nan)
    assert (row["threshold_type"] == "sensation") == later
assert {stimulus["StimID"] for stimulus in about["StimulusSet"]} >= set(out["stim_id"])
assert about["Particulars"]["ElectrodeMaterial"] == "unknown"

if len(sys.argv) > 4:  # the validator, as a program, which reads nothing below /dev, where tests may write
    with tempfile.TemporaryDirectory(dir=sys.prefix) as place:
        copied = Path(shutil.copytree(export, Path(place) / "out"))
        validate = [sys.argv[4], str(copied), "--format", "json", "--max-rows", "-1"]
        ran = subprocess.run(validate, capture_output=True, text=True)
        assert ran.stdout.startswith("{"), f"the validator ended with {ran.returncode}: {ran.stdout} {ran.stderr}"
        errors = [issue for issue in json.loads(ran.stdout)["issues"]["issues"] if issue["severity"] == "error"]
        assert ran.returncode == 0 and not errors, errors
        # It does look: an event without its onset is an error.
        path = copied / "sub-sim/beh" / f"{STEM}events.tsv"
        path.write_text(path.read_text().replace("onset\t", "begun\t", 1))
        ran = subprocess.run(validate, capture_output=True, text=True)
        assert ran.returncode != 0 and ran.stdout.startswith("{") and "error" in ran.stdout, ran.stderr
