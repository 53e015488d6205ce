"""oracle.py xdf|edf FOLDER SEED COUNT: writes COUNT random files and, beside each, what pyxdf, or pyEDFlib and edfio,
read in it: FILE.json."""
import gzip
import json
import logging
import random
import struct
import sys
import warnings
from pathlib import Path

import numpy as np

warnings.filterwarnings("ignore")
logging.disable(logging.CRITICAL)


def plain(values):
    return [[None if v != v else float(v) for v in row] for row in values]


# XDF -------------------------------------------------------------------------------------------------------------------
KINDS = {"int8": "b", "int16": "h", "int32": "i", "int64": "q", "float32": "f", "double64": "d", "string": ""}


def length(n, r):
    sizes = [s for s, top in ((1, 255), (4, 2**32 - 1), (8, 2**64 - 1)) if n <= top]
    size = r.choice(sizes)
    return bytes([size]) + n.to_bytes(size, "little")


def chunk(tag, content, r):
    return length(len(content) + 2, r) + struct.pack("<H", tag) + content


def value(kind, r):
    if kind == "string":
        text = "".join(r.choice("ab ü≤") for _ in range(r.randrange(300 if r.random() < 0.02 else 9))).encode()
        return length(len(text), r) + text
    if kind in ("float32", "double64"):
        return struct.pack("<" + KINDS[kind], float("nan") if r.random() < 0.02 else r.gauss(0, 1000))
    top = min(2 ** (8 * struct.calcsize(KINDS[kind]) - 1), 2**53)
    return struct.pack("<" + KINDS[kind], r.randrange(-top, top))


def write_xdf(path, r):
    out = [b"XDF:", chunk(1, b"<?xml version=\"1.0\"?><info><version>1.0</version></info>", r)]
    todo = []
    for number in r.sample(range(1, 2**32 - 1), r.randrange(1, 5)):
        kind = r.choice(list(KINDS))
        rate = r.choice([0, 10, 62.86, 148.31, 2200])
        channels = r.randrange(1, 6)
        labels = "" if r.random() < 0.3 else "<channels>" + "".join(
            f"<channel><label>c{i}&amp;</label><unit>mN</unit></channel>" for i in range(channels)) + "</channels>"
        header = (f"<?xml version=\"1.0\"?><info><name>S{number}</name><type>T</type><channel_count>{channels}"
                  f"</channel_count><nominal_srate>{rate}</nominal_srate><channel_format>{kind}</channel_format>"
                  f"<desc>{labels}</desc></info>")
        out.append(chunk(2, struct.pack("<I", number) + header.encode(), r))
        t, step, stamped = r.uniform(0, 1e5), 1 / rate if rate else 0.01, r.random()
        begin, count = t, 0
        for _ in range(r.randrange(0, 6)):
            samples = b""
            n = r.randrange(0, 60)
            for i in range(n):
                t += step + (r.gauss(0, step / 20) if r.random() < 0.9 else r.uniform(0, 2))
                with_stamp = count == 0 or r.random() < stamped
                samples += (b"\x08" + struct.pack("<d", t)) if with_stamp else b"\x00"
                samples += b"".join(value(kind, r) for _ in range(channels))
                count += 1
            todo.append(chunk(3, struct.pack("<I", number) + length(n, r) + samples, r))
        drift, offset = r.gauss(0, 2e-5), r.uniform(-1e5, 1e5)
        for i in range(r.choice([0, 1, 2, 30])):
            at = begin + 5 * i + r.uniform(0, 0.1)
            slip = r.uniform(0.001, 0.02) if r.random() < 0.05 else r.gauss(0, 3e-5)
            todo.append(chunk(4, struct.pack("<Idd", number, at, offset + drift * (at - begin) + slip), r))
    # Chunks of a stream keep their order, streams mix.
    order = [struct.unpack_from("<I", c, 1 + c[0] + 2)[0] for c in todo]
    queues = {n: [c for c, m in zip(todo, order) if m == n] for n in set(order)}
    r.shuffle(order)
    for number in order:
        out.append(queues[number].pop(0))
        if r.random() < 0.1:
            out.append(chunk(5, bytes.fromhex("43A546DCCBF5410FB30ED5467383CBE4"), r))
        if r.random() < 0.1:
            out.append(chunk(r.randrange(7, 60000), r.randbytes(r.randrange(40)), r))
    content = b"".join(out)
    if path.suffix != ".xdf":  # in one member, or in two
        cut = r.choice([0, r.randrange(len(content))])
        content = gzip.compress(content[:cut], r.randrange(10)) * (cut > 0) + gzip.compress(content[cut:], r.randrange(10))
    path.write_bytes(content)


def read_xdf(path):
    import pyxdf

    streams, _ = pyxdf.load_xdf(str(path), dejitter_timestamps=False)
    return [{"id": s["info"]["stream_id"], "name": s["info"]["name"][0], "count": len(s["time_stamps"]),
             "t": [float(t) for t in s["time_stamps"]],
             "values": [] if s["info"]["channel_format"][0] == "string" else plain(s["time_series"])}
            for s in streams]


# EDF and BDF -----------------------------------------------------------------------------------------------------------
def write_edf(path, r):
    import pyedflib

    bdf = path.suffix == ".bdf"
    top = 2**23 if bdf else 2**15
    n = r.randrange(1, 7)
    record_s = r.choice([0.1, 0.5, 1, 2, 10])
    writer = pyedflib.EdfWriter(str(path), n, pyedflib.FILETYPE_BDFPLUS if bdf else pyedflib.FILETYPE_EDFPLUS)
    writer.setDatarecordDuration(record_s)
    records, pieces, rates = r.randrange(1, 5), [], []
    for i in range(n):
        low = r.choice([-top, -top, r.randrange(-top, top - 1)])
        high = r.choice([top - 1, r.randrange(low + 1, top)])
        perRecord = r.choice([1, 10, 62, 200, 1000])
        rates.append(perRecord / record_s)
        writer.setSignalHeader(i, {
            "label": f"sig {r.randrange(100)}", "dimension": r.choice(["uV", "g", "mN", "", "m/s2"]),
            "sample_frequency": perRecord / record_s, "physical_min": r.choice([-1.0, 0.5, -200, 1000]),
            "physical_max": r.choice([2.0, 0.25, 1.5e4, -3]), "digital_min": low, "digital_max": high,
            "transducer": "", "prefilter": ""})
        pieces.append([np.array([r.randrange(low, high + 1) for _ in range(perRecord)], np.int32)
                       for _ in range(records)])
    for record in range(records):
        writer.blockWriteDigitalSamples(np.concatenate([pieces[i][record] for i in range(n)]))
    for _ in range(r.randrange(3)):
        writer.writeAnnotation(r.uniform(0, 1), -1, "note")
    writer.close()


def read_edf(path):
    import edfio
    import pyedflib

    theirs = (edfio.read_bdf if path.suffix == ".bdf" else edfio.read_edf)(path)
    with pyedflib.EdfReader(str(path)) as reader:
        signals = []
        for i, signal in enumerate(theirs.signals):
            data = reader.readSignal(i)
            assert np.allclose(data, signal.data, rtol=1e-9, atol=1e-9), path
            signals.append({"label": reader.getLabel(i), "unit": reader.getPhysicalDimension(i),
                            "rate": float(signal.sampling_frequency), "values": [float(v) for v in data]})
    return signals


if __name__ == "__main__":
    which, folder, seed, count = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    for i in range(count):
        r = random.Random(1000 * seed + i)
        if which == "xdf":
            file = folder / f"{i}{r.choice(['.xdf', '.xdfz', '.xdf.gz'])}"
            write_xdf(file, r)
            read = read_xdf(file)
        else:
            file = folder / f"{i}.{r.choice(['edf', 'bdf'])}"
            write_edf(file, r)
            read = read_edf(file)
        Path(f"{file}.json").write_text(json.dumps(read))
