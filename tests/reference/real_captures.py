"""Real oscilloscope records measured by numpy alone, with the definitions of science.md section 8. tests/measure reads it.

The baseline is the mean of the lower state's samples within 3 standard deviations, a plateau the mean from 30 to 90 % of
its pulse. Instants are found by a straight line between samples, at half of the pulse's own plateau.
The records are in ../shared/data, which is not a part of the tree.
"""
import numpy as np

from figures import keep, shared


def columns_of(relative, header, count):
    table = np.genfromtxt(shared("scope/" + relative), delimiter=",", skip_header=header, usecols=range(1, count + 1))
    return table.reshape(-1, count).T


def states_of(x):
    middle = (x.min() + x.max()) / 2
    for _ in range(20):
        low, high = np.median(x[x < middle]), np.median(x[x >= middle])
        middle = (low + high) / 2
    rest = x[x < middle]
    for _ in range(30):
        rest = rest[np.abs(rest - rest.mean()) <= 3 * rest.std()]
    return rest.mean(), rest.std(), middle, high - low


def edges_of(x, middle, step):
    """(first sample beyond, +1 or -1) with a hysteresis of four tenths of the step."""
    high, edges = x[0] > middle, []
    for i, value in enumerate(x):
        if (value < middle - 0.2 * step) if high else (value > middle + 0.2 * step):
            high = not high
            edges.append((i, 1 if high else -1))
    return edges


def crossing(x, i, level, sign):
    """Where x passes the level on the way to sample i, in samples."""
    while i > 0 and (x[i - 1] - level) * sign >= 0:
        i -= 1
    return i - 1 + (level - x[i - 1]) / (x[i] - x[i - 1])


def measured(x, dt):
    baseline, noise, middle, step = states_of(x)
    edges = edges_of(x, middle, step)
    onset, width, amplitude, charge = [], [], [], []
    for (rise, sign), (fall, _) in zip(edges, edges[1:]):
        if sign < 0:
            continue
        level = middle
        for _ in range(5):
            begin, end = crossing(x, rise, level, 1), crossing(x, fall, level, -1)
            length = end - begin
            top = x[int(np.ceil(begin + 0.3 * length)) : int(np.floor(begin + 0.9 * length)) + 1].mean()
            level = (baseline + top) / 2
        onset.append(begin * dt)
        width.append(length * dt)
        amplitude.append(top - baseline)
        # With its edges: a fifth of its width to each side.
        charge.append(np.sum(x[max(0, int(begin - 0.2 * length)) : int(end + 0.2 * length) + 1] - baseline) * dt)
    interval = np.diff(onset)
    return {
        "edges": len(edges),
        "first_edge": edges[0][1],
        "pulses": len(width),
        "noise": noise,
        "amplitude_mean": np.mean(amplitude),
        "width_median_s": np.median(width),
        "width_mean_s": np.mean(width),
        "interval_median_s": np.median(interval),
        "interval_mean_s": np.mean(interval),
        "charge_median": np.median(charge),
    }


def figures():
    data, clock = columns_of("mdo4104c/RTC.csv", 21, 2)
    calibrator = columns_of("rigol_DS2072A-1.csv", 2, 2)
    ringing = columns_of("rigol_DS1102E-B.csv", 2, 1)[0]
    return {
        "bus_data": measured(data, 20e-9),
        "bus_clock": measured(clock, 20e-9),
        "calibrator": [measured(channel, 5e-6) for channel in calibrator],
        "ringing": measured(ringing, 20e-9),
    }


keep(__file__, figures)
