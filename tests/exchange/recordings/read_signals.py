"""read_signals.py FILE EXPECTED REPORT: compares an XDF, EDF or BDF export with what was recorded (EXPECTED/NAME.f64:
rows of time and channels) by pyxdf with its defaults, or by pyEDFlib and edfio. REPORT is the export's JSON."""
import json
import sys
from pathlib import Path

import numpy as np

file, expected = Path(sys.argv[1]), Path(sys.argv[2])
drawn = json.loads((expected / "expected.json").read_text())
report = json.loads(Path(sys.argv[3]).read_text())
left_out = {each["what"] for each in report["left_out"]}
written = {stream["name"]: stream for stream in report["streams"]}
STAMP = 1.000001e-9  # a session keeps stamps within 1 ns of a straight line as that line


def recorded(stream):
    return np.fromfile(expected / (stream["name"] + ".f64")).reshape(-1, 1 + len(stream["columns"]))


def same(a, b):
    return np.asarray(a, float).tobytes() == np.asarray(b, float).tobytes()


def check_xdf():
    import pyxdf

    streams, header = pyxdf.load_xdf(str(file))
    exact, _ = pyxdf.load_xdf(str(file), dejitter_timestamps=False)
    info = header["info"]
    assert info["simulated"] == ["1"] and info["datetime"] == ["2026-11-20T14:03:05Z"], info
    assert "uncalibrated R" in info["marks"][0].split("; ") and info["program"][0].startswith("Tactoscope")
    assert json.loads(info["about"][0])["chain_head"] == info["chain_head"][0] == report["chain_head"]
    named = {s["info"]["name"][0]: s for s in streams}
    stamps = {s["info"]["name"][0]: s["time_stamps"] for s in exact}
    assert list(named) == [s["name"] for s in drawn["streams"]] + ["trains", "events", "records"], list(named)
    for stream in drawn["streams"]:
        theirs, ours = named[stream["name"]], recorded(stream)
        info = theirs["info"]
        assert info["channel_format"] == ["double64"] and info["type"][0] in stream["name"]
        channels = info["desc"][0]["channels"][0]["channel"]
        assert [c["label"][0] for c in channels] == stream["columns"]
        assert [c["unit"][0] for c in channels] == stream["units"]
        assert len(theirs["time_stamps"]) == stream["samples"] == int(theirs["footer"]["info"]["sample_count"][0])
        if not stream["samples"]:
            continue
        assert same(theirs["time_series"], ours[:, 1:]), stream["name"]
        assert np.all(np.abs(stamps[stream["name"]] - ours[:, 0]) <= STAMP), stream["name"]
        declared = float(info["nominal_srate"][0])
        # What is not regular declares no rate, so that readers leave its stamps alone.
        steps = np.diff(ours[:, 0])
        moved = np.abs(theirs["time_stamps"] - ours[:, 0]).max()
        if declared == 0:
            assert moved <= STAMP, (stream["name"], moved)
        elif len(steps):
            assert steps.min() > 0.49 / declared and steps.max() < 1.51 / declared, stream["name"]
        assert (declared == 0) == (not stream["regular"]), (stream["name"], declared, stream["regular"])
    trains = named["trains"]
    labels = [c["label"][0] for c in trains["info"]["desc"][0]["channels"][0]["channel"]]
    told = trains["time_series"][:, labels.index("told_v")]
    assert list(told) == [t[1] for t in drawn["trains"]] and trains["info"]["nominal_srate"] == ["0"]
    assert np.allclose(trains["time_stamps"], [t[0] for t in drawn["trains"]], atol=1e-6)
    events = named["events"]
    assert events["info"]["type"] == ["Markers"] and len(events["info"]["desc"][0]["channels"][0]["channel"]) == 1
    texts = [e[0] for e in events["time_series"]]
    assert texts[: len(report["marks"])] == report["marks"], texts[:5]
    for t, volts in drawn["trains"]:
        i = texts.index(f"train {volts:.4g} V")
        assert abs(events["time_stamps"][i] - t) < 1e-6
    for t, number, condition in drawn["trials"]:
        assert abs(events["time_stamps"][texts.index(f"trial {number} {condition}")] - t) < 1e-6
    assert "interlock armed" in texts
    records = [json.loads(r[0]) for r in named["records"]["time_series"]]
    assert len([r for r in records if r["kind"] == "command"]) == len(drawn["trains"])
    assert len([r for r in records if r["kind"] == "trial"]) == len(drawn["trials"])


def check_edf():
    missing = []  # annotations of absent stretches
    import edfio
    import pyedflib

    bdf = file.suffix == ".bdf"
    theirs = (edfio.read_bdf if bdf else edfio.read_edf)(file)
    assert theirs.recording.equipment_code == "Tactoscope_0.0.0-test_SIMULATED", theirs.recording
    assert theirs.recording.additional == (report["chain_head"][:16],)
    assert str(theirs.startdate) == "2026-11-20" and str(theirs.starttime) == "14:03:05"
    reader = pyedflib.EdfReader(str(file))
    assert reader.getFileDuration() * 1 >= max(recorded(s)[:, 0].max() for s in drawn["streams"] if s["samples"])
    labels = reader.getSignalLabels()
    notes = list(zip(*reader.readAnnotations()))
    texts = [n[2] for n in notes]
    assert all(len(text.encode()) <= 40 for text in texts)
    assert texts[: len(report["marks"])] == [m[:40] for m in report["marks"]], texts
    for t, volts in drawn["trains"]:
        i = texts.index(f"train {volts:.4g} V")
        assert abs(notes[i][0] - t) < 1.01e-4, (notes[i], t)
    for stream in drawn["streams"]:
        if stream["name"] in left_out:
            continue
        about = written[stream["name"]]
        ours = recorded(stream)
        dropped, repeated = 0, 0
        for c, column in enumerate(stream["columns"]):
            label = column.replace(stream["kind"], stream["name"], 1) if stream["name"] != stream["kind"] else column
            i = labels.index(label if len(label) <= 16 else label[:14] + "~1")
            assert reader.getPhysicalDimension(i) == stream["units"][c]
            assert reader.getPrefilter(i) == "digital minimum = absent"
            rate = theirs.signals[i].sampling_frequency
            digital = reader.readSignal(i, digital=True)
            values = reader.readSignal(i)
            assert np.allclose(values, theirs.signals[i].data, rtol=1e-9, atol=1e-9)
            absent = digital == reader.getDigitalMinimum(i)
            slots = np.round(ours[:, 0] * rate).astype(int)
            last = {}  # of two samples in a slot the later stays
            for k, slot in enumerate(slots):
                last[slot] = k
            dropped = len(slots) - len(last)
            kept = sorted(last.items())
            # A slot left out where the clock slipped holds the sample before.
            there = dict(kept)
            for (a, i0), (b, i1) in zip(kept, kept[1:]):
                if b == a + 2 and ours[i1, 0] - ours[i0, 0] < 1.5 / stream["rate"]:
                    there[a + 1] = i0
            repeated = len(there) - len(kept)
            step = about["channels"][c]["step"]
            exact = about["channels"][c]["exact"]
            for slot, k in there.items():
                value = ours[k, 1 + c]
                if np.isnan(value):
                    assert absent[slot], (column, slot)
                else:
                    error = abs(values[slot] - value)
                    assert not absent[slot] and error <= (0 if exact else 0.5000001 * step) + 1e-9 * abs(value), (
                        column, slot, values[slot], value, step)
            empty = np.ones(len(digital), bool)
            empty[list(there)] = False
            assert absent[empty].all(), column
        assert about["dropped"] == dropped and about["repeated"] == repeated, (about, dropped, repeated)
        if stream["samples"]:
            error = max(abs(slot / rate - ours[k, 0]) for slot, k in kept)
            assert abs(about["time_error_max_s"] - error) < 1e-8 and error <= 0.5 / rate + 1e-8 , (about["time_error_max_s"], error, rate, stream["name"])
        # Each stretch of over a second without samples has its annotation.
        edges = np.concatenate([[0], ours[:, 0]])
        if len(stream["columns"]) == 1 and not np.isnan(ours[:, 1:]).any():
            for begin, end in zip(edges[:-1], edges[1:]):
                if end - begin > 1 + 3 / rate and not any(
                        n[2] == f"absent {stream['name']}" and abs(n[0] - begin) < 2 / rate for n in notes):
                    missing.append((stream["name"], begin, end))
    # A file holds 64 annotations a record; how many had no room is said.
    no_room = sum(int(what.split()[0]) for what in left_out if what.endswith(" annotations"))
    assert len(missing) <= no_room and (not missing or len(notes) >= 64), (missing, no_room, notes)
    assert set(written) | left_out >= {s["name"] for s in drawn["streams"]}


check_xdf() if file.suffix == ".xdf" else check_edf()
