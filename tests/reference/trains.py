"""The fewest trains and the least time that a change takes when no train may differ from the one before by more than
two just-noticeable differences: all ways over a fine grid of intervals. tests/encoding reads it.

A train's interval is the time since the train before; intervals and amplitudes stay between the two ends. What had
passed at the step is part of the first train's interval. A change has arrived with the train at the new amplitude and
interval; a first train that comes at once, since the new interval has passed already, counts where the next may come at
the new interval (core/encoding/StepResponse.h).
"""
import numpy as np

from figures import keep

STEP = 2 * np.log(1.16)  # of the logarithm of the interval, a train
AMPLITUDE_STEP = 2 * np.log(1.1)


def pace(since, before, after):
    """`before` and `after` are [V, s]."""
    ends = sorted([before[1], after[1]])
    multiples = np.exp(STEP * np.arange(-1000, 1001) / 100)
    grid = np.unique(np.concatenate([start * multiples for start in (*ends, max(since, 1e-3))] + [ends]))
    grid = grid[(grid >= ends[0]) & (grid <= ends[1])]
    near = np.abs(np.log(grid[:, None] / grid[None, :])) <= STEP + 1e-9
    begin, end = np.argmin(np.abs(grid - before[1])), np.argmin(np.abs(grid - after[1]))
    trains_of_amplitude = np.ceil(abs(np.log(after[0] / before[0])) / AMPLITUDE_STEP - 1e-9)
    if after[1] < since <= before[1] and trains_of_amplitude <= 1:
        if all(abs(np.log(since / interval)) <= STEP for interval in (before[1], after[1])):
            return {"since": since, "before": before, "after": after, "trains": 1, "complete_s": 0.0}
    # The time to a train at each interval, after 1, 2, ... trains.
    least = np.where(near[begin] & (grid >= since - 1e-12), grid, np.inf)
    trains = 1
    while trains < trains_of_amplitude or not np.isfinite(least[end]):
        least = grid + np.where(near, least[None, :], np.inf).min(axis=1)
        trains += 1
    return {"since": since, "before": before, "after": after, "trains": trains, "complete_s": least[end] - since}


def figures():
    return {
        "pace": [
            pace(0, [10, 2], [40, 2]),
            pace(0.4, [10, 0.5], [40, 0.5]),
            pace(0, [25, 2], [25, 0.5]),  # a press
            pace(0, [25, 0.5], [25, 2]),  # and its release
            pace(0.4, [25, 0.8], [25, 0.5]),  # 0.594 s come first,
            pace(0.6, [25, 0.8], [25, 0.5]),  # unless that much has passed already
            pace(0.1, [10, 0.5], [12, 0.5]),
            pace(0.1, [10, 1], [12.1, 0.8]),
        ]
    }


keep(__file__, figures)
