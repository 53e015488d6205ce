"""Pulses into loads, integrated numerically by scipy. tests/electrode, tests/safety and tests/drivers read it.

The load is R_s + (R_p parallel C); a pulse is a list of pieces (source, level, seconds). A voltage source sets v, a current
source sets i, and a source in high impedance lets the capacitor alone.
"""
import numpy as np
from scipy.integrate import solve_ivp

from figures import keep

BENCH = (200.0, 10e3, 50e-9)


class Course:
    """v and i of a load, piece after piece, from a discharged capacitor."""

    def __init__(self, load):
        self.load, self.vc, self.t, self.pieces = load, 0.0, 0.0, []

    def at(self, source, level, vc):
        rs = self.load[0]
        if source == "voltage":
            return level + 0 * vc, (level - vc) / rs
        i = (level if source == "current" else 0) + 0 * vc
        return vc + i * rs, i

    def add(self, source, level, seconds):
        _, rp, c = self.load

        def slope(_, state):
            v, i = self.at(source, level, state[0])
            return [(i - state[0] / rp) / c, i, v * i]

        span = [0, seconds]
        found = solve_ivp(slope, span, [self.vc, 0, 0], method="LSODA", rtol=1e-11, atol=1e-15, dense_output=True)
        v, i = self.at(source, level, found.y[0])
        self.pieces.append({"t": self.t, "seconds": seconds, "v": v, "i": i, "charge": found.y[1][-1], "to": found.sol})
        self.vc, self.t = found.y[0][-1], self.t + seconds
        return self


def biphasic(source, level, gap, gap_s, width=200e-6, load=BENCH):
    course = Course(load).add(source, level, width)
    if gap_s > 0:
        course.add(gap, 0, gap_s)
    return course.add(source, -level, width)


def peak_ma(piece):
    return 1e3 * np.max(np.abs(piece["i"]))


def peaks():
    high_impedance = biphasic("voltage", 40, "high impedance", 100e-6).pieces
    no_gap = biphasic("voltage", 40, "", 0).pieces
    zero = biphasic("voltage", 40, "voltage", 100e-6).pieces
    return {
        "leading_ma": peak_ma(high_impedance[0]),
        "second_ma_high_impedance": peak_ma(high_impedance[2]),
        "second_ma_no_gap": peak_ma(no_gap[1]),
        "second_ma_zero": peak_ma(zero[2]),
    }


def net_charge():
    """What a voltage source that lets go after the pulse leaves, of the charge of its leading phase."""
    pieces = biphasic("voltage", 40, "high impedance", 100e-6).pieces
    return sum(piece["charge"] for piece in pieces) / pieces[0]["charge"]


def impedance(source, level):
    """|v / i| at the end of a leading phase of 200 us."""
    piece = Course(BENCH).add(source, level, 200e-6).pieces[0]
    return piece["v"][-1] / piece["i"][-1]


def worst_second_of_energy():
    """The most that any second of a train takes from its source: 45 pulses of a current source that holds 0 V between."""
    level, width, rate, pulses = 1.8292333e-3, 50.557e-3, 8.792792654, 45
    course = Course((881.776, 51376.9, 1634.4147e-9))
    for _ in range(pulses):
        course.add("current", level, width).add("current", -level, width)
        course.add("voltage", 0, 1 / rate - 2 * width)
    t, taken = [np.zeros(1)], [np.zeros(1)]
    for piece in course.pieces:
        within = np.linspace(0, piece["seconds"], 400)[1:]
        t.append(piece["t"] + within)
        taken.append(taken[-1][-1] + piece["to"](within)[2])
    t, taken = np.concatenate(t), np.concatenate(taken)
    begins = np.concatenate([t, t - 1])  # of seconds that begin, and of those that end, at any of the moments
    seconds = np.interp(begins + 1, t, taken) - np.interp(begins, t, taken)
    return {
        "amplitude_ma": level * 1e3,
        "width_us": width * 1e6,
        "rate_hz": rate,
        "pulses": pulses,
        "load": {"series_ohm": course.load[0], "parallel_ohm": course.load[1], "capacitance_f": course.load[2]},
        "energy_j": np.max(seconds),
    }


def figures():
    return {
        "bench_load_40_v": peaks(),
        "bench_load_net_charge": net_charge(),
        "bench_load_impedance_ohm": {"voltage": impedance("voltage", 40), "current": impedance("current", 4e-3)},
        "worst_second": worst_second_of_energy(),
    }


keep(__file__, figures)
