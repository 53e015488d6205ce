"""Reads a run's captures and measures a train in them: plateau of the leading phase, onset at half of it."""
import glob
import os
import re
import sys

import numpy as np


def fail(sentence):
    print("DISAGREES: " + sentence)
    sys.exit(1)


def agree(what, reported, computed, tolerance):
    """`tolerance` is absolute. None stands for what is not known."""
    if reported is None or computed is None:
        if reported is None and computed is None:
            return
        fail("%s: reported %s, recomputed %s" % (what, reported, computed))
    if not abs(reported - computed) <= tolerance:
        fail("%s: reported %.9g, recomputed %.9g, tolerance %.2g" % (what, reported, computed, tolerance))


def captures_of(folder):
    """{trial number: [file, ...]} in the order in which they were taken."""
    found = {}
    for path in sorted(glob.glob(os.path.join(folder, "captures", "*.csv"))):
        match = re.match(r"trial-(\d+)-(\d+)\.csv$", os.path.basename(path))
        if match:
            found.setdefault(int(match.group(1)), []).append(path)
    return found


def train_in(path):
    """(onset in s, amplitude in V) of the first pulse of a record."""
    table = np.genfromtxt(path, delimiter=",", names=True, dtype=float)
    time, voltage = table["time_s"], table["voltage_v"]
    rest = np.median(voltage[: max(10, len(voltage) // 20)])
    voltage = voltage - rest
    above = np.flatnonzero(np.abs(voltage) > 0.5 * np.max(np.abs(voltage)))
    first = above[0]
    same = np.sign(voltage[first])
    end = first
    while end + 1 < len(voltage) and voltage[end + 1] * same > 0.5 * np.max(np.abs(voltage)):
        end += 1
    width = end - first + 1
    plateau = np.mean(np.abs(voltage[first + int(0.3 * width) : first + int(0.9 * width)]))
    # The 50 % instant, by a straight line between the samples beside it.
    low, high = abs(voltage[first - 1]), abs(voltage[first])
    step = time[first] - time[first - 1]
    onset = time[first - 1] + step * (0.5 * plateau - low) / (high - low)
    return onset, plateau
