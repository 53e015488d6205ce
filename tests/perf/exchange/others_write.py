"""others_write.py FORMAT ARRAYS OUT: writes the arrays of a session with pandas, h5py or pyEDFlib, waits for the disk,
and prints the seconds and the processor's seconds that it took. ARRAYS has arrays.json and, of each stream, NAME.f64."""
import json
import os
import sys
import time
from pathlib import Path

import numpy

form, folder, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
streams = json.loads((folder / "arrays.json").read_text())
arrays = [numpy.fromfile(folder / (each["name"] + ".f64")).reshape(-1, 1 + len(each["columns"])) for each in streams]
columns = [[numpy.ascontiguousarray(column) for column in array.T] for array in arrays]


def write_csv():
    for stream, array in zip(streams, arrays):
        frame = pandas.DataFrame(array, columns=["time_s", *stream["columns"]])
        frame.to_csv(out / (stream["name"] + ".csv"), index=False)


def write_hdf5():
    with h5py.File(out, "w", libver=("earliest", "v108")) as file:
        for stream, values in zip(streams, columns):
            group = file.create_group("streams/" + stream["name"])
            for name, column in zip(["time", *stream["columns"]], values):
                group.create_dataset(name, data=column, chunks=(min(65536, len(column)),), shuffle=True,
                                     compression="gzip", compression_opts=4, fletcher32=True)


def write_edf():
    heads, signals = [], []
    bits = 24 if form == "bdf" else 16
    for stream, values in zip(streams, columns):
        for name, column in zip(stream["columns"], values[1:]):
            heads.append({"label": name, "dimension": stream["unit"], "sample_frequency": stream["rate_hz"],
                          "physical_min": numpy.floor(column.min()), "physical_max": numpy.ceil(column.max()) + 1,
                          "digital_min": -2 ** (bits - 1), "digital_max": 2 ** (bits - 1) - 1,
                          "transducer": "", "prefilter": ""})
            signals.append(column)
    kind = pyedflib.FILETYPE_BDFPLUS if form == "bdf" else pyedflib.FILETYPE_EDFPLUS
    with pyedflib.EdfWriter(str(out), len(signals), file_type=kind) as file:
        file.setSignalHeaders(heads)
        file.writeSamples(signals)


if form == "csv":
    import pandas
    out.mkdir()
    write = write_csv
elif form == "hdf5":
    import h5py
    write = write_hdf5
else:
    import pyedflib
    write = write_edf
begun, begun_cpu = time.perf_counter(), time.process_time()
write()
for path in [out, *out.glob("*")] if out.is_dir() else [out]:
    descriptor = os.open(path, os.O_RDONLY)
    os.fsync(descriptor)
    os.close(descriptor)
print(time.perf_counter() - begun, time.process_time() - begun_cpu)
