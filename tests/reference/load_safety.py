"""load_safety.py RUN.json FOLDER - figures, uncertainties and verdicts of a load-safety run with a voltage source."""
import glob
import json
import os
import re
import sqlite3
import sys

import numpy as np

from captures import agree, captures_of, fail

DRAWS = 200_000
RANDOM = np.random.default_rng(1)


def header_of(path):
    """What the file says of its instrument, in the line after the column names."""
    with open(path, encoding="utf-8") as file:
        file.readline()
        return json.loads(file.readline().removeprefix("# tactoscope "))


def train_of(path):
    """One train: plateau, end current, width, onset, charge, energy, squares, from the baseline before it."""
    table = np.genfromtxt(path, delimiter=",", names=True, dtype=float)
    t, dt = table["time_s"], np.median(np.diff(table["time_s"]))
    v, i = (table[name] for name in ("voltage_v", "current_a"))
    top = np.max(np.abs(v))
    first = np.flatnonzero(np.abs(v) > 0.5 * top)[0]
    quiet = max(8, first - int(5e-6 / dt) - 2)
    noise = np.std(v[:quiet]), np.std(i[:quiet])
    v, i = v - np.mean(v[:quiet]), i - np.mean(i[:quiet])
    sign = np.sign(v[first])

    def crossing(k, level):  # between k - 1 and k
        a, b = sign * v[k - 1], sign * v[k]
        return t[k - 1] + dt * (level - a) / (b - a)

    end = first
    while sign * v[end] > 0.5 * top:
        end += 1
    plateau = np.mean(sign * v[first + int(0.3 * (end - first)): first + int(0.9 * (end - first))])
    onset, end_s = crossing(first, plateau / 2), crossing(end, plateau / 2)
    width = end_s - onset
    late = (t >= onset + 0.80 * width) & (t < onset + 0.97 * width)
    leading = (t >= onset) & (t < end_s)
    after = slice(quiet, None)
    return {"amplitude_v": plateau, "amplitude_ma": 1e3 * abs(np.mean(i[late])), "width_s": width, "onset_s": onset,
            "charge_uc": 1e6 * abs(np.sum(i[leading]) * dt), "energy_mj": 1e3 * np.sum(v[after] * i[after]) * dt,
            "squares": np.sum(i[after] ** 2 - noise[1] ** 2) * dt, "peak_v": np.max(np.abs(v[after])),
            "late": np.count_nonzero(late), "noise_v": noise[0], "dt": dt}


def half_interval(rectangles, normals, scatter, n):
    """95 % of the sum, by drawing: half-widths, standard deviations, s of n readings."""
    total = np.zeros(DRAWS)
    for half in rectangles:
        total += half * RANDOM.uniform(-1, 1, DRAWS)
    for sigma in normals:
        total += sigma * RANDOM.standard_normal(DRAWS)
    if n > 1:
        total += scatter / np.sqrt(n) * RANDOM.standard_t(n - 1, DRAWS)
    return np.quantile(np.abs(total), 0.95)


def check_trial(name, measured, paths):
    trains = [train_of(path) for path in paths]
    header = header_of(paths[0])
    if not header["simulated"]:
        fail(name + ": the header does not say that it is simulated")
    volts = header["channels"][0]
    mean = lambda key: float(np.mean([train[key] for train in trains]))
    for key, tolerance in (("amplitude_v", 1e-3), ("amplitude_ma", 2e-3), ("width_s", 1e-3), ("charge_uc", 3e-3),
                           ("energy_mj", 3e-3)):
        if measured[key] is None:
            continue
        largest = max(train[key] for train in trains)
        computed = largest if key in ("charge_uc", "energy_mj") else mean(key)
        agree(name + ", " + key, measured[key], computed, tolerance * computed)
    onsets = np.array([train["onset_s"] for train in trains])
    interval = float(np.min(np.diff(onsets)))
    agree(name + ", interval", measured["interval_s"], interval, 2e-7)
    if measured["rms_5s_ma"] is not None:
        squares = max(train["squares"] for train in trains)
        count = np.ceil(5 / interval - 0.01)
        computed = 1e3 * np.sqrt(count * squares / 5)
        agree(name + ", RMS over 5 s", measured["rms_5s_ma"], computed, 5e-3 * computed)
    # U of the amplitude, from what the header states and the trains show.
    plateau = mean("amplitude_v")
    s = float(np.std([train["amplitude_v"] for train in trains], ddof=1))
    step = volts["lsb"] / np.sqrt(12) * np.sqrt(2)  # of two levels, as a rectangle of the same s
    computed = half_interval([volts["gain_tolerance"] * plateau, volts["linearity_tolerance"],
                              volts["probe_tolerance"] * plateau, step * np.sqrt(3)],
                             [trains[0]["noise_v"] / np.sqrt(trains[0]["late"])], s, len(trains))
    agree(name + ", U of the amplitude", measured["amplitude_v_expanded"], computed, 0.03 * computed)


def judged(value, expanded, limit, strict):
    if value is None or expanded is None:
        return "not evaluated"
    keeps = (lambda x: x < limit) if strict else (lambda x: x <= limit)
    if keeps(value + expanded):
        return "pass"
    return "indeterminate" if keeps(value - expanded) else "fail"


def check_rows(results):
    order = ["fail", "indeterminate", "not evaluated"]
    worst = 3
    for row in results["rows"] + results["worst_case"]["rows"]:
        verdict = row["verdict"]
        if verdict in order:
            worst = min(worst, order.index(verdict))
        special = row["set"] in ("gate", "interlock") or row["limit"] is None or row["basis"] == "commanded"
        if special or verdict in ("attention", "not applicable") or row["item"] == "imbalance":
            continue
        expected = judged(row["value"], row["expanded_uncertainty"], row["limit"], "paper" in row["set"] and
                          row["item"].startswith("rms"))
        if verdict != expected:
            fail("%s on %s: %s, recomputed %s" % (row["title"], row["load"], verdict, expected))
    expected = ["fail", "indeterminate", "indeterminate", "pass"][worst]
    if results["verdict"] != expected:
        fail("the verdict is %s, recomputed %s" % (results["verdict"], expected))


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        sys.exit(2)
    with open(sys.argv[1], encoding="utf-8") as file:
        results = json.load(file)["results"]
    check_rows(results)
    session = sqlite3.connect(glob.glob(os.path.join(sys.argv[2], "*.tacto"))[0])
    files = {int(re.search(r"-(\d+)\.csv$", path).group(1)): path
             for paths in captures_of(sys.argv[2]).values() for path in paths}
    checked = 0
    for (name, body) in session.execute("SELECT name, body FROM entries WHERE kind = 'trial'"):
        measured = json.loads(body).get("measured", {})
        paths = [files[number] for number in measured.get("captures", []) if number in files]
        resistor = re.match(r"(reference )?[\d.]+ k?ohm, [\d.]+ V$", name)
        if not resistor or measured.get("amplitude_v_expanded") is None or len(paths) < 2:
            continue
        check_trial(name, measured, paths)
        checked += 1
    if checked == 0:
        fail("no trial on a resistor was found")
    print("agrees: %d rows, %d trials on resistors" % (len(results["rows"]), checked))


main()
