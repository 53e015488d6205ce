"""separability.py RUN.json FOLDER - trials, distances, bounds, confusion and verdict of a separability run."""
import json
import sys

import numpy as np
from scipy import stats

from captures import agree, captures_of, fail, train_in

WEBER = {"amplitude": 0.10, "interval": 0.16}


def check_trials(trials, folder):
    files = captures_of(folder)
    if len(files) != len(trials):
        fail("%d trials were reported, captures of %d are there" % (len(trials), len(files)))
    for number, trial in enumerate(trials, 1):
        measured = [train_in(path) for path in files[number]]
        agree("trial %d, amplitude" % number, trial["amplitude_v"], np.mean([a for _, a in measured]),
              2e-3 * trial["amplitude_v"] + 0.02)
        agree("trial %d, interval" % number, trial["interval_s"], np.mean(np.diff([t for t, _ in measured])), 3e-6)


def root_mean_square(values):
    return np.sqrt(np.mean(np.square(values)))


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        sys.exit(2)
    results = json.load(open(sys.argv[1]))["results"]
    trials = results["trials"]
    check_trials(trials, sys.argv[2])

    names = [condition["name"] for condition in results["conditions"]]
    label = np.array([names.index(trial["condition"]) for trial in trials])
    x = np.array([[trial["amplitude_v"], trial["interval_s"]] for trial in trials])
    known = all(trial[key] is not None for trial in trials for key in ("amplitude_u_v", "interval_u_s", "time_base_u"))
    if not known:
        if results["verdict"] == "pass" or any(pair["mahalanobis"] is not None for pair in results["pairs"]):
            fail("an uncertainty is unknown, and yet it passes or a distance is given")
        print("agrees: an uncertainty is unknown, nothing passes")
        return
    u = np.array([[t["amplitude_u_v"], np.hypot(t["interval_u_s"], t["time_base_u"] * t["interval_s"])] for t in trials])
    # A gain and a time base are the same in all trials and divide out of a ratio.
    gain = np.array([(t.get("amplitude_gain_u") or 0) * t["amplitude_v"] for t in trials])
    own = np.array([[np.sqrt(max(0, t["amplitude_u_v"] ** 2 - g**2)), t["interval_u_s"]] for t, g in zip(trials, gain)])
    floor = np.array([root_mean_square(u[:, 0]), root_mean_square(u[:, 1])])
    agree("floor of amplitude", results["floor"]["amplitude_v"], floor[0], 1e-9)
    agree("floor of interval", results["floor"]["interval_s"], floor[1], 1e-12)

    def covariance(x, label):
        means = np.array([x[label == c].mean(0) for c in range(len(names))])
        residual = x - means[label]
        s = residual.T @ residual / (len(x) - len(names))
        s[np.diag_indices(2)] = np.maximum(np.diag(s), floor**2)
        return means, s

    means, s = covariance(x, label)
    sd = np.array([x[label == c].std(0, ddof=1) for c in range(len(names))])
    n = np.bincount(label)
    open_or_failed = []
    for condition, c in zip(results["conditions"], range(len(names))):
        for axis, key in enumerate(("amplitude", "interval")):
            variation = sd[c, axis] / means[c, axis]
            agree(names[c] + " " + key + " variation", condition[key + "_variation"], variation, 1e-9)
            low, high = variation * np.sqrt((n[c] - 1) / stats.chi2.ppf([0.95, 0.05], n[c] - 1))
            agree(names[c] + " " + key + " variation, low", condition[key + "_variation_low"], low, 1e-9)
            agree(names[c] + " " + key + " variation, high", condition[key + "_variation_high"], high, 1e-9)
            if not high <= 0.05:
                open_or_failed.append(names[c] + " varies")
    for pair in results["pairs"]:
        a, b = names.index(pair["a"]), names.index(pair["b"])
        d = means[a] - means[b]
        distance = np.sqrt(d @ np.linalg.solve(s, d))
        agree(pair["a"] + " and " + pair["b"], pair["mahalanobis"], distance, 1e-6 * distance)
        reached = False
        for axis, key in enumerate(("amplitude", "interval")):
            jnd = abs(np.log(means[a, axis] / means[b, axis])) / np.log1p(WEBER[key])
            agree(pair["a"] + " and " + pair["b"] + " " + key, pair[key + "_jnd"], jnd, 1e-9)
            scatter = np.array([sd[c, axis] ** 2 / n[c] / means[c, axis] ** 2 for c in (a, b)])
            shared = sum((root_mean_square(own[label == c, axis]) / means[c, axis]) ** 2 for c in (a, b))
            total = scatter.sum() + shared
            with np.errstate(divide="ignore"):
                freedom = total**2 / sum(scatter[i] ** 2 / (n[c] - 1) for i, c in enumerate((a, b)))
            reach = stats.t.ppf(0.95, freedom) * np.sqrt(total) / np.log1p(WEBER[key])
            agree(pair["a"] + " and " + pair["b"] + " " + key + ", low", pair[key + "_jnd_low"], max(0, jnd - reach), 1e-6)
            agree(pair["a"] + " and " + pair["b"] + " " + key + ", high", pair[key + "_jnd_high"], jnd + reach, 1e-6)
            reached = reached or jnd - reach >= 5
        if not reached:
            open_or_failed.append(pair["a"] + " and " + pair["b"] + " are near")

    folds = min(10, n.min())
    fold = np.zeros(len(x), dtype=int)
    for c in range(len(names)):
        fold[label == c] = np.arange(n[c]) % folds
    confusion = np.zeros((len(names), len(names)), dtype=int)
    for f in range(folds):
        m, cov = covariance(x[fold != f], label[fold != f])
        for i in np.flatnonzero(fold == f):
            scores = [m[c] @ np.linalg.solve(cov, x[i]) - m[c] @ np.linalg.solve(cov, m[c]) / 2 for c in range(len(names))]
            confusion[label[i], int(np.argmax(scores))] += 1
    if confusion.tolist() != results["confusion"]:
        fail("confusion: reported %s, recomputed %s" % (results["confusion"], confusion.tolist()))
    low = stats.binomtest(int(np.trace(confusion)), len(x)).proportion_ci(0.95, "wilson").low
    agree("accuracy, low", results["accuracy"]["low"], low, 1e-9)
    if not low >= 0.95:
        open_or_failed.append("accuracy")
    if (results["verdict"] == "pass") != (not open_or_failed):
        fail("verdict %s, and %s" % (results["verdict"], open_or_failed or "nothing speaks against a pass"))
    print("agrees: %d trials from their captures, %d pairs, verdict %s" % (len(x), len(results["pairs"]), results["verdict"]))


main()
