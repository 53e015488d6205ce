"""Figures of identification sessions and of few people by numpy and scipy. tests/analysis reads them.

Answers are listed as they were given, block by block; nothing is drawn at random.
"""
import itertools

import numpy as np
from scipy import optimize, special, stats

from figures import keep

LABELS = ["smooth-low", "smooth-high", "rough-low", "rough-high"]
COLUMNS = LABELS + ["none", "not-sure"]
FEATURES = {"texture": 0, "pressure": 1}
# All right, nearly, unevenly presented, guessed, one answer only, a label that was never presented, single trials.
TABLES = [
    [[20, 0, 0, 0, 0, 0], [0, 20, 0, 0, 0, 0], [0, 0, 20, 0, 0, 0], [0, 0, 0, 20, 0, 0]],
    [[22, 0, 1, 0], [0, 22, 0, 0], [0, 1, 21, 1], [0, 0, 0, 22]],
    [[35, 0, 1, 0], [0, 27, 0, 0], [2, 0, 16, 0], [0, 0, 0, 9]],
    [[5, 5, 6, 4], [4, 6, 5, 5], [6, 4, 4, 6], [5, 5, 5, 5]],
    [[10, 0], [10, 0]],
    [[12, 3, 1], [0, 0, 0], [2, 1, 9]],
    [[1, 0, 0], [0, 2, 0], [0, 1, 1]],
    [[3, 1], [0, 1]],
]


def session():
    """Five blocks of 16 trials and 2 catch trials. Every 5th answer is the neighbour, every 17th "none", every 23rd "not
    sure", so that early blocks differ from late ones; the catch trials are answered "none" but for two."""
    trials = []
    index = 0
    for block in range(1, 6):
        order = [(3 * i * i + i + block) % 4 for i in range(16)]
        for place, condition in enumerate(order):
            if place in (5, 11):
                answer = "rough-low" if (block, place) in ((2, 5), (4, 11)) else "none"
                trials.append({"block": block, "condition": "catch", "response": answer})
            index += 1
            answer = LABELS[condition]
            if index % 5 == 0 and block < 4 or index % 11 == 0:
                answer = LABELS[(condition + 1 + index % 2) % 4]
            if index % 17 == 0:
                answer = "none"
            if index % 23 == 0:
                answer = "not-sure"
            trials.append({"block": block, "condition": LABELS[condition], "response": answer})
    return trials


def wilson(k, n):
    interval = stats.binomtest(int(k), int(n)).proportion_ci(0.95, "wilson")
    return {"value": k / n, "low": interval.low, "high": interval.high}


def exact(k, n):
    interval = stats.binomtest(int(k), int(n)).proportion_ci(0.95, "exact")
    return {"k": int(k), "n": int(n), "value": k / n, "low": interval.low, "high": interval.high}


def entropy(counts):
    return stats.entropy(np.asarray(counts, dtype=float).ravel(), base=2)


def without(row, trials):
    """The mean entropy of a row with so many of its trials left out, over every choice of them."""
    answers = np.repeat(np.arange(len(row)), row)
    kept = [np.delete(answers, list(left)) for left in itertools.combinations(range(len(answers)), trials)]
    return np.mean([entropy(np.bincount(answers, minlength=len(row))) if len(answers) else 0 for answers in kept])


def information(counts):
    """What answers tell of stimuli, bits. Trials are left out one by one, nothing by a closed form; the spread by
    derivatives from differences."""
    counts = np.asarray(counts, dtype=int)
    counts = counts[counts.sum(1) > 0]
    n, each = counts.sum(), counts.sum(1)
    weight, columns = each / n, counts.shape[1]
    shares = counts / each[:, None]
    told = lambda p: entropy(weight @ p) - sum(w * entropy(row) for w, row in zip(weight, p))
    value, spread = entropy(weight @ shares), 0
    for s, (row, m) in enumerate(zip(counts, each)):
        if m == 1:
            value -= weight[s] * entropy(row)
            continue
        left, changes = [], []
        for trial in np.repeat(np.arange(columns), row):
            fewer = shares.copy()
            fewer[s] = (row - np.eye(columns)[trial]) / (m - 1)
            left.append(entropy(weight @ fewer))
            changes.append(told(fewer))
        value += (m - 1) * (entropy(weight @ shares) - np.mean(left))
        spread += (m - 1) * np.var(changes)
        whole, one = entropy(row), without(row, 1)
        two = without(row, 2) if m > 2 else 0
        value -= weight[s] * (m**2 * whole - 2 * (m - 1) ** 2 * one + (m - 2) ** 2 * two) / 2
    more = (counts + 2 * weight @ shares) / (each + 2)[:, None]
    overall = weight @ more
    derivative, step = np.zeros_like(more), 1e-6
    for s, r in np.argwhere(more > 0):
        # Shares of a row stay 1 in sum; complex steps have no rounding.
        moved = more.astype(complex)
        moved[s] *= 1 - 1j * step
        moved[s, r] += 1j * step
        felt = lambda p: np.sum(p[p.real > 0] * np.log2(p[p.real > 0]))
        bits = sum(w * felt(row) for w, row in zip(weight, moved)) - felt(weight @ moved)
        derivative[s, r] = bits.imag / step
    first = sum(np.sum(p * d**2) / m for p, d, m in zip(more, derivative, each))
    likeness = np.sum(weight[:, None] * (more[:, overall > 0] ** 2 / overall[overall > 0])) - 1
    freedom = (len(counts) - 1) * (np.sum(overall > 0) - 1) + likeness
    reach = stats.norm.ppf(0.975) * np.sqrt(max(first, spread) + freedom / (2 * n**2 * np.log(2) ** 2))
    most = min(entropy(weight), np.log2(columns))
    return dict(zip(("value", "low", "high"), np.clip([value, value - reach, value + reach], 0, most)))


def table_figures(counts):
    """Mutual information as the sum of two entropies less that of both together."""
    counts = np.asarray(counts)
    n, hits, r = int(counts.sum()), int(np.trace(counts)), len(counts)
    it = entropy(counts.sum(0)) + entropy(counts.sum(1)) - entropy(counts)
    corrected = information(counts)
    return {
        "n": n,
        "hits": hits,
        "accuracy": wilson(hits, n),
        "p_chance": stats.binom.sf(hits - 1, n, 1 / r),
        "it_bits": it,
        "it_bias_bits": it - corrected["value"],
        "it_corrected_bits": corrected["value"],
        "it_corrected_low_bits": corrected["low"],
        "it_corrected_high_bits": corrected["high"],
    }


def feature(counts, part):
    values = list(dict.fromkeys(label.split("-")[part] for label in LABELS))
    merged = np.zeros((2, 4), dtype=int)
    for i, presented in enumerate(LABELS):
        for j, answered in enumerate(COLUMNS):
            column = values.index(answered.split("-")[part]) if j < 4 else j - 2
            merged[values.index(presented.split("-")[part]), column] += counts[i, j]
    hit, false_alarm = ((merged[row, 0] + 0.5) / (merged[row, :2].sum() + 1) for row in (0, 1))
    z = stats.norm.ppf([hit, false_alarm])
    return {
        **table_figures(merged),
        "values": values,
        "confusion": merged.tolist(),
        "d_prime": z[0] - z[1],
        "criterion": -z.sum() / 2,
    }


def logistic(points):
    """Slope and its profile-likelihood interval, [x, n, hits] a point."""
    x, n, hits = np.asarray(points, dtype=float).T

    def minus(intercept, slope):
        z = intercept + slope * x
        return np.sum(hits * np.logaddexp(0, -z) + (n - hits) * np.logaddexp(0, z))

    def profile(slope):
        return optimize.minimize_scalar(lambda a: minus(a, slope), bracket=(-1, 1), tol=1e-15).fun

    # Newton's method on both parameters, to more digits than a search for the minimum has.
    beta = np.zeros(2)
    design = np.column_stack([np.ones_like(x), x])
    for _ in range(100):
        p = special.expit(design @ beta)
        beta = beta + np.linalg.solve(design.T @ (design * (n * p * (1 - p))[:, None]), design.T @ (hits - n * p))
    least = minus(*beta)
    beyond = lambda slope: 2 * (profile(slope) - least) - stats.chi2.ppf(0.95, 1)
    ends = [optimize.brentq(beyond, beta[1], beta[1] + side * 20 / np.ptp(x), xtol=1e-14) for side in (-1, 1)]
    return {"points": points, "value": beta[1], "low": ends[0], "high": ends[1]}


def sequence(trials):
    after = {"same": [0, 0], "other": [0, 0]}
    for before, trial in zip(trials, trials[1:]):
        if "catch" in (before["condition"], trial["condition"]) or before["block"] != trial["block"]:
            continue
        kind = after["same" if before["condition"] == trial["condition"] else "other"]
        kind[0] += 1
        kind[1] += trial["condition"] == trial["response"]
    return {kind: {"n": n, "hits": hits} for kind, (n, hits) in after.items()}


def analysed():
    trials = session()
    counts = np.zeros((4, 6), dtype=int)
    blocks = {}
    catches = [trial for trial in trials if trial["condition"] == "catch"]
    for trial in trials:
        if trial in catches:
            continue
        counts[LABELS.index(trial["condition"]), COLUMNS.index(trial["response"])] += 1
        n, hits = blocks.get(trial["block"], (0, 0))
        blocks[trial["block"]] = (n + 1, hits + (trial["condition"] == trial["response"]))
    alarms = sum(trial["response"] in LABELS for trial in catches)
    return {
        "trials": trials,
        "labels": LABELS,
        "columns": COLUMNS,
        "confusion": counts.tolist(),
        **table_figures(counts),
        **{name: feature(counts, part) for name, part in FEATURES.items()},
        "catch": exact(alarms, len(catches)),
        "blocks": [{"block": block, "n": n, "hits": hits} for block, (n, hits) in blocks.items()],
        "shares": [{"n": int(n), **wilson(n, counts.sum())} for n in counts.sum(0)],
        "learning": logistic([[block, n, hits] for block, (n, hits) in blocks.items()]),
        "sequence": sequence(trials),
    }


def newcombe(a, m, b, n):
    """Method 10 of Newcombe 1998, Stat Med 17:873."""
    p, q = wilson(a, m), wilson(b, n)
    d = p["value"] - q["value"]
    return {
        "a": a, "m": m, "b": b, "n": n, "value": d,
        "low": d - np.sqrt((p["value"] - p["low"]) ** 2 + (q["high"] - q["value"]) ** 2),
        "high": d + np.sqrt((p["high"] - p["value"]) ** 2 + (q["value"] - q["low"]) ** 2),
    }


def ratio(a, spread_a, b, spread_b):
    """a/b of two log-normal estimates, by the quantiles of its own distribution; spreads are of the logarithms."""
    estimate = lambda median, spread: [median, *stats.lognorm.ppf([0.025, 0.975], spread, scale=median)]
    quotient = stats.lognorm(np.sqrt(spread_a**2 + spread_b**2), scale=a / b)
    return {"a": estimate(a, spread_a), "b": estimate(b, spread_b), "value": quotient.median(),
            "low": quotient.ppf(0.025), "high": quotient.ppf(0.975)}


def prevalence(k, n):
    """The shortest interval that holds 95 % of Beta(k + 1, n - k + 1) cut off below 0.05, searched on its quantiles."""
    beta = stats.beta(k + 1, n - k + 1)
    share = lambda p: (beta.ppf(beta.cdf(0.05) + p * (1 - beta.cdf(0.05))) - 0.05) / 0.95
    width = lambda below: share(min(1, below + 0.95)) - share(below)
    below = min(np.linspace(0, 0.05, 1001), key=width)
    step = 0.05 / 1000
    if 0 < below < 0.05:
        # Where the density is the same at both ends.
        slope = lambda p: beta.pdf(0.05 + 0.95 * share(p)) - beta.pdf(0.05 + 0.95 * share(p + 0.95))
        below = optimize.brentq(slope, below - step, below + step, xtol=1e-16)
    return {"k": k, "n": n, "value": max(0, (k / n - 0.05) / 0.95), "low": share(below),
            "high": 1 if k == n else share(below + 0.95)}


def figures():
    return {
        "session": analysed(),
        "exact": [exact(*kn) for kn in ((0, 10), (4, 5), (5, 5), (3, 3), (1, 1), (7, 40))],
        "newcombe": [newcombe(*case) for case in ((68, 80, 56, 80), (56, 70, 48, 80), (9, 10, 3, 10), (10, 10, 0, 20))],
        "ratios": [ratio(3, 0.09, 2, 0.12), ratio(0.22, 0.05, 0.31, 0.2), ratio(4.1, 0.08, 4.1, 0.08)],
        "prevalence": [prevalence(*kn) for kn in ((4, 5), (5, 5), (3, 3), (2, 5), (0, 3), (1, 3), (1, 20), (19, 20))],
        "information": [{"counts": counts, **information(counts)} for counts in TABLES],
        "logistic": [
            logistic([[0, 80, 50], [3, 80, 61], [10, 80, 70]]),
            logistic([[1, 16, 12], [2, 16, 13], [3, 16, 11], [4, 16, 12], [5, 16, 13]]),
        ],
    }


keep(__file__, figures)
