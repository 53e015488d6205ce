"""Separability of two sets of trials, by numpy and scipy. tests/analysis reads it.

The trials are those of tests/analysis/SyntheticTrials.h, made here a second time: no random generator, so that both
have the same digits. Conditions smooth-low, smooth-high, rough-low, rough-high are 0 to 3.
"""
import numpy as np
from scipy import stats

from figures import keep

WEBER = (0.10, 0.16)  # amplitude, interval
FLOOR = 1e-3  # of the pooled mean: what trials that state no uncertainty are taken to be uncertain by
FOLDS = 10


def wave(i, k):
    return np.sqrt(2) * np.sin(2 * np.pi * ((i + 1) * 0.6180339887498949 * (k + 1) % 1.0))


def trials_of(amplitude, interval_s, amplitude_sd, interval_sd_s, repeats):
    rows, conditions = [], []
    for i in range(repeats):
        for c in range(4):
            u = wave(i, c)
            v = 0.5 * u + np.sqrt(0.75) * wave(i, c + 4)
            rows.append([amplitude[c] + amplitude_sd * u, interval_s[c] + interval_sd_s * v])
            conditions.append(c)
    return np.array(rows), np.array(conditions)


def spread_of(x, conditions):
    """Means of the conditions, and the covariance within them."""
    means = np.array([x[conditions == c].mean(axis=0) for c in range(4)])
    residuals = x - means[conditions]
    covariance = residuals.T @ residuals / (len(x) - 4)
    floor = FLOOR * x.mean(axis=0)
    covariance[[0, 1], [0, 1]] = np.maximum(covariance[[0, 1], [0, 1]], floor**2)
    return means, covariance


def confusion_of(x, conditions):
    """Linear discriminant, even priors; the i-th trial of a condition is judged by those of the other folds."""
    place = np.array([np.sum(conditions[:i] == c) for i, c in enumerate(conditions)])
    fold = place % FOLDS
    confusion = np.zeros((4, 4), dtype=int)
    for f in range(FOLDS):
        means, covariance = spread_of(x[fold != f], conditions[fold != f])
        for i in np.flatnonzero(fold == f):
            scores = [m @ np.linalg.solve(covariance, x[i]) - m @ np.linalg.solve(covariance, m) / 2 for m in means]
            confusion[conditions[i], int(np.argmax(scores))] += 1
    return confusion


def judged(x, conditions):
    means, covariance = spread_of(x, conditions)
    pairs = []
    for a in range(4):
        for b in range(a + 1, 4):
            d = means[a] - means[b]
            jnd = np.abs(np.log(means[a] / means[b])) / np.log1p(WEBER)
            pairs.append(
                {
                    "a": a,
                    "b": b,
                    "mahalanobis": np.sqrt(d @ np.linalg.solve(covariance, d)),
                    "amplitude_jnd": jnd[0],
                    "interval_jnd": jnd[1],
                }
            )
    variation = [x[conditions == c].std(axis=0, ddof=1) / means[c] for c in range(4)]
    confusion = confusion_of(x, conditions)
    right = stats.binomtest(int(np.trace(confusion)), len(x)).proportion_ci(0.95, "wilson")
    return {
        "pairs": pairs,
        "amplitude_variation": [v[0] for v in variation],
        "interval_variation": [v[1] for v in variation],
        "confusion": confusion.tolist(),
        "accuracy": {"low": right.low, "high": right.high},
    }


def figures():
    apart = trials_of([10, 10, 40, 40], [2, 0.5, 2, 0.5], 0.3, 0.01, 25)
    overlapping = trials_of([10, 10.5, 11, 11.5], [2, 1.9, 2.1, 2.0], 0.4, 0.08, 23)
    return {"apart": judged(*apart), "overlapping": judged(*overlapping)}


keep(__file__, figures)
