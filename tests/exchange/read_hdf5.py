"""read_hdf5.py EXPORT EXPECTED: compares an HDF5 export with what was recorded, by h5py, and opens it with xarray."""
import json
import sys
from pathlib import Path

import h5py
import numpy
import xarray

export, expected = Path(sys.argv[1]), Path(sys.argv[2])
drawn = json.loads((expected / "expected.json").read_text())
file = h5py.File(export)
assert set(file) >= {"streams", "captures", "trials", "trains", "events"}
text = {name: value.decode() for name, value in file.attrs.items() if isinstance(value, bytes)}
assert file.attrs["simulated"] == 1 and "uncalibrated R" in text["marks"].split("; ")
assert {"title", "program", "wall_start", "session", "chain_head"} <= set(text)
assert json.loads(text["about"])["chain_head"] == text["chain_head"]
assert set(file["streams"]) == {stream["name"] for stream in drawn["streams"]}
for stream in drawn["streams"]:
    group = file["streams"][stream["name"]]
    assert set(group) == {"time", *stream["columns"]}
    recorded = numpy.fromfile(expected / (stream["name"] + ".f64")).reshape(-1, 1 + len(stream["columns"]))
    for i, column in enumerate(["time", *stream["columns"]]):
        data = group[column]
        assert data.dtype == "<f8" and data.shape == (stream["samples"],)
        if i == 0:  # a session keeps stamps within 1 ns of a straight line as that line
            assert numpy.all(numpy.abs(data[:] - recorded[:, 0]) <= 1.000001e-9), stream["name"]
        else:
            assert data[:].tobytes() == recorded[:, i].tobytes(), (stream["name"], column)
        assert data.shuffle and data.compression == "gzip" and data.compression_opts == 4 and data.fletcher32
        assert data.attrs["units"].decode() == (["s"] + stream["units"])[i] and data.attrs["simulated"] == 1
        assert column == "time" or list(data.dims[0].keys()) == ["time"] or data.dims[0][0] == group["time"]
    if "R" in group:
        assert group["R"].attrs["calibrated"] == 0
    frame = xarray.open_dataset(export, group="streams/" + stream["name"], engine="h5netcdf").to_dataframe()
    assert len(frame) == stream["samples"] and list(frame.columns) == sorted(stream["columns"], key=list(frame.columns).index)
table = xarray.open_dataset(export, group="trials", engine="h5netcdf").to_dataframe()
assert list(table["condition"]) == [trial[2] for trial in drawn["trials"]]
assert list(table["trial"]) == [trial[1] for trial in drawn["trials"]]
assert list(table["captures"]) == [str(trial[1]) for trial in drawn["trials"]]
events = file["events"]
assert [(t, name.decode(), json.loads(details)) for t, name, details in
        zip(events["time"], events["event"], events["details"])] == [tuple(event) for event in drawn["events"]]
assert [outcome.decode() for outcome in file["trains"]["outcome"]][2:] == ["voided", "failed", "delivered", "refused"]
for i in range(1, 6):
    capture = file["captures"][f"trial-{i:04}-{i:05}"]
    assert capture["voltage"].dtype == "<f4" and capture["current"].attrs["lsb"] == 0.001
    assert capture.attrs["rate_hz"] == 1e6 and capture.attrs["told"] == 10.25 + i
    assert abs(capture["time"][1] - capture["time"][0] - 1e-6) < 1e-12
    assert list(capture["voltage"].attrs["range"]) == [-50, 50]
