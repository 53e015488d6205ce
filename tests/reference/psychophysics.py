"""QUEST+, the weighted staircase and predicted against observed, by numpy. tests/analysis/psychophysics reads it.

QUEST+ is written as Watson describes it (Journal of Vision 17(3):10, 2017): the expected entropy of the posterior, from
both posteriors of each level. Answers come from a Weibull function at a sequence without a random generator.
"""
import itertools

import numpy as np
from scipy import stats

from figures import keep

SLOPES = np.array([2.0, 4.0, 8.0, 16.0])


def chance(i):
    """Evenly spread between 0 and 1, of the i-th trial from 0."""
    return (i + 1) * 0.6180339887498949 % 1.0


def probability_right(x, alpha, beta, lapse=0.02):
    return 0.5 + (0.5 - lapse) * (1 - np.exp(-(10 ** (beta * (x - alpha) / 20))))


def entropy(p):
    p = p[p > 0]
    return -np.sum(p * np.log(p))


def quest_plus(step, levels, felt, answers, prior=None, prior_sd=4.0, first=None, least=24, most=40, enough=0.8):
    """`answers` takes a trial's number from 0 and its level in dB."""
    db = 20 * np.log10(step * np.arange(1, levels + 1))
    centre = 20 * np.log10(felt)
    alphas = centre + np.arange(-24, 19) * 0.5
    mean = 20 * np.log10(prior) if prior else centre - 1
    posterior = np.outer(stats.norm.pdf(alphas, mean, prior_sd), np.ones(4))
    posterior /= posterior.sum()
    estimate = first or felt
    asked, right = [], []
    while True:
        marginal = posterior.sum(axis=1)
        mu = np.sum(marginal * alphas)
        sd = np.sqrt(np.sum(marginal * (alphas - mu) ** 2))
        if len(asked) >= most or (len(asked) >= least and sd <= enough):
            break
        if asked:
            estimate = 10 ** (mu / 20)
        number = len(asked) + 1
        allowed = [k for k in range(levels) if levels == 1 or len(asked) < 3 or set(asked[-3:]) != {k}]
        if number == 1 or number % 8 == 0:
            away = [abs(step * (k + 1) - 1.5 * estimate) for k in allowed]
        else:
            away = []
            for k in allowed:
                p = probability_right(db[k], alphas[:, None], SLOPES[None, :])
                yes, no = posterior * p, posterior * (1 - p)
                away.append(yes.sum() * entropy(yes / yes.sum()) + no.sum() * entropy(no / no.sum()))
        k = min(one for one, a in zip(allowed, away) if a <= min(away) + 1e-9)
        correct = bool(answers(len(asked), db[k]))
        asked.append(k)
        right.append(correct)
        p = probability_right(db[k], alphas[:, None], SLOPES[None, :])
        posterior = posterior * (p if correct else 1 - p)
        posterior /= posterior.sum()
    below = np.concatenate([[0], np.cumsum(marginal)])
    edges = np.concatenate([alphas - 0.25, [alphas[-1] + 0.25]])
    low, high = np.interp([0.025, 0.975], below, edges)
    return {
        "step": step,
        "levels": levels,
        "felt": felt,
        "prior": prior or 0,
        "prior_sd_db": prior_sd,
        "first": first or 0,
        "least": least,
        "most": most,
        "asked": [k + 1 for k in asked],
        "right": right,
        "posterior": marginal,
        "estimate": 10 ** (mu / 20),
        "low": 10 ** (low / 20),
        "high": 10 ** (high / 20),
        "sd_db": sd,
        "slope": np.sum(posterior * SLOPES[None, :]),
        # That alpha exceeds 0.9 times the estimate.
        "above": 1 - np.interp(mu + 20 * np.log10(0.9), edges, below),
    }


def weibull(alpha, beta):
    return lambda i, x: chance(i) < probability_right(x, 20 * np.log10(alpha), beta)


def staircase(step, levels, felt, alpha, beta):
    """Levels as whole numbers of the device's steps."""
    unit = max(1, int(np.floor(0.05 * felt / step + 1e-9)))
    at = min(max(int(np.ceil(1.5 * felt / step - 0.5 - 1e-9)), 1), levels)
    asked, right, reversals, moves, in_a_row = [], [], [], [], 0
    while len(reversals) < 8 and len(asked) < 60:
        correct = bool(weibull(alpha, beta)(len(asked), 20 * np.log10(step * at)))
        asked.append(at)
        right.append(correct)
        in_a_row = in_a_row + 1 if correct else 0
        if correct and in_a_row < 2:
            continue
        in_a_row = 0
        move = -1 if correct else 2
        if moves and (moves[-1] > 0) != (move > 0):
            reversals.append(at)
        moves.append(move)
        at = min(max(at + move * unit * (2 if len(reversals) < 2 else 1), 1), levels)
    return {
        "step": step,
        "levels": levels,
        "felt": felt,
        "asked": asked,
        "right": right,
        "reversals": reversals,
        "estimate": step * np.mean(reversals[-6:]),
    }


def g_of(counts, probabilities):
    expected = np.sum(counts) * np.array(probabilities)
    return 2 * sum(n * np.log(n / e) for n, e in zip(counts, expected) if n > 0)


def fit_of_a_row(counts, probabilities):
    """Exactly, over every table with as many trials."""
    total = sum(counts)
    g = g_of(counts, probabilities)
    larger = equal = 0.0
    for first, second in itertools.product(range(total + 1), repeat=2):
        table = [first, second, total - first - second]
        if table[2] < 0:
            continue
        weight = stats.multinomial.pmf(table, total, probabilities)
        other = g_of(table, probabilities)
        if abs(other - g) < 1e-9:
            equal += weight
        elif other > g:
            larger += weight
    return {"counts": counts, "probabilities": probabilities, "g": g, "larger": larger, "equal": equal}


def figures():
    return {
        "quest_plus": [
            quest_plus(0.5, 30, 4.5, weibull(3.7, 8)),
            quest_plus(0.5, 22, 2.5, weibull(3.4, 3)),
            quest_plus(0.02, 50, 0.24, weibull(0.2, 11)),
            quest_plus(0.5, 30, 4.5, weibull(4.6, 11), prior=3.9, prior_sd=2.5, first=3.9, least=12, most=12),
            quest_plus(0.5, 20, 4.0, lambda i, x: True),
            quest_plus(0.5, 20, 4.0, lambda i, x: False),
            quest_plus(0.5, 20, 4.0, lambda i, x: i % 2 == 0),
            quest_plus(2.0, 2, 3.0, weibull(3.0, 8)),
        ],
        "staircase": [
            staircase(0.5, 30, 4.5, 3.7, 8),
            staircase(0.5, 30, 1.5, 1.3, 5),
            staircase(0.01, 1000, 4.0, 3.5, 11),
            staircase(0.5, 6, 3.0, 2.9, 3),
        ],
        "fit": [
            fit_of_a_row([9, 2, 1], [0.6, 0.3, 0.1]),
            fit_of_a_row([5, 6, 1], [0.6, 0.3, 0.1]),
            fit_of_a_row([20, 0, 0], [0.97, 0.02, 0.01]),
        ],
    }


def plain(value):
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(one) for one in value]
    return value.item() if isinstance(value, np.generic) else value


keep(__file__, lambda: plain(figures()))
