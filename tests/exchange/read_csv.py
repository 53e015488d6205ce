"""read_csv.py EXPORT EXPECTED: compares a CSV export with what was recorded, by Python's own reader."""
import csv
import json
import math
import struct
import sys
from pathlib import Path

export, expected = Path(sys.argv[1]), Path(sys.argv[2])
drawn = json.loads((expected / "expected.json").read_text())
UNITS = {"1": "", "m/s2": "_m_s2", "Pa": "_pa", "count": "_count", "N": "_n"}


def rows_of(name):
    raw = (export / name).read_bytes()
    assert b"\r" not in raw and not raw.startswith(b"\xef\xbb\xbf") and raw.endswith(b"\n"), name
    with open(export / name, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file, strict=True))
    assert all(len(row) == len(rows[0]) for row in rows), name
    assert rows[0][0] == "time_s" and rows[0][-1] == "simulated", rows[0]
    assert all(row[-1] == "1" for row in rows[1:]), name
    assert not rows[0][0].startswith("#")
    return rows


def same(cell, value):
    if math.isnan(value):
        return cell == ""
    return struct.pack("<d", float(cell)) == struct.pack("<d", value) and len(cell) <= len(repr(value))


def is_time(cell, t):
    """A session keeps stamps within 1 ns of a straight line as that line."""
    return abs(float(cell) - t) <= 1.000001e-9 and len(cell) <= len(repr(float(cell)))


for stream in drawn["streams"]:
    name, columns = stream["name"], stream["columns"]
    rows = rows_of(name + ".csv")
    heading = ["time_s"]
    for column, unit in zip(columns, stream["units"]):
        heading.append(column if column.endswith(UNITS[unit]) else column + UNITS[unit])
        if column == "R":
            heading.append("R_calibrated")
    assert rows[0] == heading + ["simulated"], (rows[0], heading)
    raw = (expected / (name + ".f64")).read_bytes()
    values = list(struct.iter_unpack("<" + "d" * (1 + len(columns)), raw))
    assert len(rows) - 1 == len(values) == stream["samples"], name
    kept = [i for i, column in enumerate(heading) if column != "R_calibrated"]
    for row, recorded in zip(rows[1:], values):
        assert is_time(row[0], recorded[0]), (name, row, recorded)
        assert all(same(row[i], value) for i, value in zip(kept[1:], recorded[1:])), (name, row, recorded)
        if "R_calibrated" in heading:
            assert row[heading.index("R_calibrated")] == "0"

rows = rows_of("trials.csv")
assert rows[0][:3] == ["time_s", "trial", "condition"]
for row, (t, number, condition, amplitude, pulses) in zip(rows[1:], drawn["trials"], strict=True):
    cells = dict(zip(rows[0], row))
    assert same(cells["time_s"], t) and cells["trial"] == str(number) and cells["condition"] == condition
    assert same(cells["amplitude_v"], math.nan if amplitude is None else amplitude)
    assert cells["pulses"] == str(pulses) and cells["captures"] == str(number) and cells["warnings"] == "one, two; three"

rows = rows_of("events.csv")
assert rows[0] == ["time_s", "event", "details", "simulated"]
for row, (t, name, details) in zip(rows[1:], drawn["events"], strict=True):
    assert same(row[0], t) and row[1] == name and json.loads(row[2]) == details

rows = rows_of("trains.csv")
assert rows[0] == ("time_s,outcome,roughness,pressure,command_v,told_v,told_ma,read_back_v,read_back_ma,interval_s,"
                   "impedance_ohm,imbalance,reason,simulated").split(",")
trains = [dict(zip(rows[0], row)) for row in rows[1:]]
assert [train["outcome"] for train in trains] == ["delivered", "delivered", "voided", "failed", "delivered", "refused"]
for i, train in enumerate(trains[:5], 1):
    assert float(train["command_v"]) == 10 + i and float(train["told_v"]) == 10.25 + i
    assert float(train["read_back_v"]) == 10.5 + i and float(train["roughness"]) == 0.1 * i and train["told_ma"] == ""
assert trains[3]["reason"] == "unplugged" and "at most 30 V" in trains[5]["reason"]

about = json.loads((export / "session.json").read_text())
assert about["simulated"] is True and "uncalibrated R" in about["marks"]
assert [(s["name"], s["samples"], len(s["channels"])) for s in about["streams"]] == \
    [(s["name"], s["samples"], len(s["columns"])) for s in drawn["streams"]]
assert sorted(p.name for p in (export / "captures").glob("*.csv")) == [f"trial-{i:04}-{i:05}.csv" for i in range(1, 6)]
