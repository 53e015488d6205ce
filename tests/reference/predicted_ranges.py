"""Whom a personal range serves where thresholds are known, by numpy. tests/analysis/psychophysics reads it.

The population and the rules are those of pilot.md, sections 4 and 8, over people of its own random numbers.
"""
import numpy as np
from scipy.stats import norm

from figures import keep

PEOPLE = 100_000
STEP_MA, CAP_MA, CEILING_V = 0.5, 15.0, 40.0
MEDIANS_MA = np.array([3.5, 6.9, 13.8])


def spread(random, median, factor):
    return median * np.exp(np.log(factor) * random.standard_normal(PEOPLE))


def people(random, too_strong_ma, weber):
    series, parallel, farad = spread(random, 200, 1.5), spread(random, 1e4, 1.5), spread(random, 50e-9, 1.3)
    width_s = 200e-6
    impedance = series + parallel * (1 - np.exp(-width_s / (parallel * farad)))
    weiss = (1 + 151 / 200) / (1 + 151 / 150)
    shared = np.sqrt(0.8) * random.standard_normal((PEOPLE, 1))
    own = weiss * MEDIANS_MA * 1.4 ** (shared + np.sqrt(0.2) * random.standard_normal((PEOPLE, 3)))
    own.sort(axis=1)
    low = 0 if too_strong_ma < MEDIANS_MA[1] else 1
    share = np.log(too_strong_ma / MEDIANS_MA[low]) / np.log(MEDIANS_MA[low + 1] / MEDIANS_MA[low])
    too_strong = own[:, low] * (own[:, low + 1] / own[:, low]) ** share
    return (impedance, own[:, 0], too_strong, spread(random, weber, 1.25), spread(random, 0.16, 1.25),
            0.06 * random.random(PEOPLE))


def ranges(too_strong_ma, weber):
    random = np.random.default_rng(20261123)
    impedance, detection, too_strong, amplitude, interval, lapse = people(random, too_strong_ma, weber)
    ceiling = np.floor(np.minimum(1e3 * CEILING_V / impedance, CAP_MA) / STEP_MA + 1e-9) * STEP_MA
    low = np.ceil(1.25 * detection / STEP_MA - 1e-9) * STEP_MA
    high = np.floor(np.minimum(0.8 * too_strong, ceiling) / STEP_MA + 1e-9) * STEP_MA
    usable = high - low >= 2 * STEP_MA - 1e-9
    low, high, detection = low[usable], high[usable], detection[usable]
    jnd, noise = np.log(1 + amplitude[usable]), 1.0
    half = np.log(high / low) / jnd / 2
    unfelt = norm.cdf(np.log(detection / low) / jnd / noise)
    named = norm.cdf(half / noise)
    in_time = norm.cdf(np.log(4) / np.log(1 + interval[usable]) / 2 / noise)
    guessed = lapse[usable]
    accuracy = (1 - guessed) * in_time * ((named - unfelt) + named) / 2 + guessed / 4
    return {"too_strong_ma": too_strong_ma, "weber": weber, "usable": float(usable.mean()),
            "median": float(np.median(accuracy)), "low": float(np.percentile(accuracy, 5)),
            "high": float(np.percentile(accuracy, 95))}


keep(__file__, lambda: {"people": PEOPLE,
                        "known": [ranges(6.9, 0.10), ranges(9.8, 0.10), ranges(13.8, 0.10), ranges(9.8, 0.20)]})
