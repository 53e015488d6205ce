#!/usr/bin/python3
"""Computes the figures of `tactoscope-cli run variation` again, from the participants in its JSON.

    variation.py PATH/TO/tactoscope-cli     runs it with several settings
    variation.py RESULT.json                one result of --json

Nothing is taken over but the participants that were drawn, their settings and the definitions (science.md sections 4,
10, 11 and 12). Exit code 0: all agree; 1: some do not; 2: usage; 77: numpy or scipy is missing.
"""
import json
import subprocess
import sys
import tempfile
import warnings

try:
    import numpy as np
    from scipy import optimize, special, stats
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

phi = stats.norm.cdf
warnings.filterwarnings("ignore", message="divide by zero encountered in _binom_pdf")  # of scipy 1.10, at p = 1
TEXTURE_HIGH = np.array([False, False, True, True])   # smooth-low, smooth-high, rough-low, rough-high
PRESSURE_HIGH = np.array([False, True, False, True])


class Checks:
    def __init__(self):
        self.done, self.wrong = 0, 0

    def that(self, name, holds, shown=""):
        self.done += 1
        if not holds:
            self.wrong += 1
            print(f"  DISAGREES  {name} {shown}")

    def same(self, name, found, expected, relative=1e-6, absolute=1e-9):
        found = np.array([np.nan if x is None else x for x in np.ravel(np.array(found, dtype=object))], dtype=float)
        expected = np.ravel(np.array(expected, dtype=float))
        good = found.shape == expected.shape and np.allclose(found, expected, relative, absolute, equal_nan=True)
        self.that(name, good, "" if good else f"program {found[:6]}, here {expected[:6]}")

    def spread(self, name, found, values, middle="value"):
        values = np.array(values, dtype=float)
        wanted = np.percentile(values, [50, 5, 95]) if len(values) else [np.nan] * 3
        self.same(name, [found[middle], found["low"], found["high"]], wanted)


def columns(people):
    return {key: np.array(values, dtype=object if key == "outcome" else float) for key, values in people.items()}


def too_strong_from(model, who, median):
    """Where the median person's lies between two thresholds, on a logarithmic scale."""
    names = ["detection_ma", "attention_ma", "intolerance_ma"]
    at = [np.log(model[name]["median"]) for name in names]
    if np.log(median) >= at[2]:
        return who["intolerance_ma"] * median / model["intolerance_ma"]["median"]
    own = np.log([who[name] for name in names])
    return np.array([np.exp(np.interp(np.log(median), at, person)) for person in own.T])


def delivery(result, who, levels, limit):
    """Commands, currents and who gets what, with `limit` mA per person as too strong."""
    model, (low, high) = result["model"], result["range_v"]
    z = who["series_ohm"] + who["parallel_ohm"] * (
        1 - np.exp(-model["width_us"] * 1e-6 / (who["parallel_ohm"] * who["capacitance_nf"] * 1e-9)))
    least, most = np.full(z.shape, low), np.full(z.shape, high)
    if levels == "personal":
        least = np.maximum(low, model["above_detection"] * who["detection_ma"] * z / 1e3)
        most = np.minimum(high, model["below_discomfort"] * limit * z / 1e3)
    ranged = least < most
    command = np.where(TEXTURE_HIGH, most[:, None], least[:, None])
    current = 1e3 * command / z[:, None]
    interval = np.where(PRESSURE_HIGH, 0.5, 2.0) * np.ones_like(command)
    # No limit set can refuse these: charge-balanced 2 x width every 0.5 s at the most current in the loads permitted.
    rms = current.max() * np.sqrt(2 * model["width_us"] * 1e-6 / 0.5)
    assert rms < 10, "the RMS limit would refuse, which is not computed here"
    in_range = (z >= model["load_low_ohm"]) & (z <= model["load_high_ohm"])
    refused = ranged[:, None] & (~in_range[:, None] | (current > limit[:, None]))
    presented = ranged[:, None] & ~refused
    felt = presented & (current >= who["detection_ma"][:, None])
    return dict(z=z, ranged=ranged, command=command, current=current, interval=interval, refused=refused,
                presented=presented, felt=felt, served=felt.all(axis=1), complete=presented.all(axis=1), in_range=in_range)


def answers(result, who, given):
    """Probability of each answer: the four points are a rectangle, so each is a product over the two dimensions."""
    model, sigma = result["model"], result["model"]["noise_jnd"]
    wa, wt = np.log1p(who["weber_amplitude"]), np.log1p(who["weber_interval"])
    x, y = np.log(given["current"]) / wa[:, None], np.log(given["interval"]) / wt[:, None]
    threshold = np.log(who["detection_ma"]) / wa
    mid_x, mid_y = (x[:, 0] + x[:, 2]) / 2, (y[:, 0] + y[:, 1]) / 2
    table = np.zeros((len(wa), 4, 5))
    for i in range(4):
        above_mid = phi((x[:, i] - np.maximum(mid_x, threshold)) / sigma)
        felt = phi((x[:, i] - threshold) / sigma)
        short = phi((mid_y - y[:, i]) / sigma)
        for j in range(4):
            p = (above_mid if TEXTURE_HIGH[j] else felt - above_mid) * (short if PRESSURE_HIGH[j] else 1 - short)
            if model["guess"] == "uniform":
                p = p + (1 - felt) / 4
            table[:, i, j] = (1 - who["lapse"]) * p + who["lapse"] / 4
        if model["guess"] == "none":
            table[:, i, 4] = (1 - who["lapse"]) * (1 - felt)
    return table


def information(table):
    p = table / table.sum()
    independent = p.sum(axis=1, keepdims=True) * p.sum(axis=0, keepdims=True)
    return float((p[p > 0] * np.log2(p[p > 0] / independent[p > 0])).sum())


def corrected_information(counts):
    """By jackknives: of second order for the answers of each condition, of first order for all answers."""
    h = lambda p: -special.xlogy(p, p) / np.log(2)
    counts = counts[counts.sum(axis=1) > 0]
    each = counts.sum(axis=1, keepdims=True)
    weight, share = each / each.sum(), counts / each
    overall = (weight * share).sum(axis=0)

    def without(trials):
        """Each count's part of the entropy of its row with so many trials left out, on average."""
        left = np.arange(trials + 1)[:, None, None]
        chance = stats.hypergeom.pmf(left, each, counts, trials)
        return (chance * h(np.maximum(counts - left, 0) / (each - trials))).sum(axis=0)

    rows = (each**2 * without(0) - 2 * (each - 1.0) ** 2 * without(1) + (each - 2.0) ** 2 * without(2)) / 2
    total = h(overall).sum()
    bits = total - (weight * rows).sum()
    for s, r in np.argwhere(counts > 0):
        fewer = (counts[s] - np.eye(counts.shape[1])[r]) / (each[s] - 1)
        less = h(np.maximum(overall + weight[s] * (fewer - share[s]), 0)).sum()
        bits += (each[s, 0] - 1) * share[s, r] * (total - less)
    return np.clip(bits, 0, min(h(weight).sum(), np.log2(counts.shape[1])))


def wilson(k, n):
    z = stats.norm.ppf(0.975)
    middle, half = k / n + z * z / (2 * n), z * np.sqrt(k / n * (1 - k / n) / n + z * z / (4 * n * n))
    return (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)


def groups(accuracies):
    """Above 100 people, 100 groups of similar ones: how the program searches."""
    ordered, n = np.sort(accuracies), len(accuracies)
    if n <= 100:
        return ordered
    return np.array([ordered[g * n // 100:(g + 1) * n // 100].mean() for g in range(100)])


def reaching(people, n, holds):
    k = np.arange(n + 1)
    low, high = wilson(k, n)
    good = holds(low, high)
    return float(np.mean([stats.binom.pmf(k, n, p)[good].sum() for p in people]))


def fewest(people, step, most, assurance, holds):
    """The smallest multiple of `step` that is enough together with every larger one up to `most`."""
    n = -(-most // step) * step
    if reaching(people, n, holds) < assurance:
        return None
    while n > step and reaching(people, n - step, holds) >= assurance:
        n -= step
    return n


def check_trials(check, needed, accuracies):
    people, mean = groups(accuracies), [accuracies.mean()]
    width, assurance, chance = needed["width"], needed["assurance"], needed["chance"]
    rho = float(accuracies.var() / (mean[0] * (1 - mean[0])))
    check.same("pooled: rho", needed["pooled"]["rho"], rho)
    certain = next(n for n in range(1, 20000) if np.subtract(*wilson((n + 1) // 2, n)[::-1]) <= width)
    aims = {"for_width": (certain, lambda low, high: high - low <= width), "above_chance": (400, lambda low, high: low > chance)}
    for aim, (most, holds) in aims.items():
        alone = fewest(people, 4, most, assurance, holds)
        check.that(f"trials of one person, {aim}", needed["per_participant"][aim] == alone,
                   f"program {needed['per_participant'][aim]}, here {alone}")
        independent = fewest(mean, 1, most, assurance, holds)
        pooled, n = needed["pooled"][aim], needed["pooled"]["participants"]
        each = next((m for m in range(4, 20001, 4) if n * m / (1 + (m - 1) * rho) >= independent - 1e-9), None)
        check.that(f"pooled, {aim}", pooled["per_participant"] == each, f"program {pooled}, here {each}")
        check.that(f"people at least, {aim}", pooled["participants_least"] == int(independent * rho) + 1)
    for point in needed["curve"]:
        check.same(f"width after {point['trials']} trials", [point["width"][k] for k in ("value", "low", "high")],
                   widths(people, point["trials"]), 1e-9)


def widths(people, n):
    k = np.arange(n + 1)
    low, high = wilson(k, n)
    mass = np.mean([stats.binom.pmf(k, n, p) for p in people], axis=0)
    order = np.argsort(high - low, kind="stable")
    total = np.cumsum(mass[order])
    return [(high - low)[order][np.searchsorted(total, q - 1e-12)] for q in (0.5, 0.05, 0.95)]


def check_pilots(check, result, accuracies):
    for pilot in result["pilots"]:
        n, trials = pilot["people"], pilot["trials"]
        start = next(k for k in range(trials + 2) if stats.binom.sf(k - 1, trials, 0.25) <= 0.05)
        above = stats.binom.sf(start - 1, trials, accuracies).sum() / result["participants"]

        def prevalence(k):
            """The lower end of the shortest interval that holds 95 %, where the density is as high as at the upper."""
            posterior = stats.beta(k + 1, n - k + 1)
            theta = lambda q: posterior.ppf(posterior.cdf(0.05) + q * posterior.sf(0.05))
            slope = lambda q: posterior.logpdf(theta(q)) - posterior.logpdf(theta(q + 0.95))
            below = 0.05 if k == n else optimize.brentq(slope, 0, 0.05 - 1e-9, xtol=1e-15) if slope(0) < 0 else 0
            return (theta(below) - 0.05) / 0.95

        check.that(f"pilot of {n}: above chance from", pilot["right_from"] == start)
        check.same(f"pilot of {n}", [pilot[k] for k in ("all_served", "all_above_chance", "prevalence_all", "prevalence_but_one")],
                   [(len(accuracies) / result["participants"]) ** n, above ** n, prevalence(n), prevalence(n - 1)], 1e-8)
        check.same(f"pilot of {n}: width", [pilot["width"][k] for k in ("value", "low", "high")],
                   widths(groups(accuracies), trials), 1e-9)


def check_draws(check, result, who):
    """Kolmogorov and Smirnov against what is stated: the seed is fixed, so it holds or it does not."""
    model = result["model"]
    tau = model["strength_duration_us"]
    scale = (1 + tau / model["width_us"]) / (1 + tau / model["threshold_width_us"])
    larger = (model["electrode_area_cm2"] or model["skin_area_cm2"]) / model["skin_area_cm2"]
    times = {"detection_ma": scale, "attention_ma": scale, "intolerance_ma": scale, "parallel_ohm": 1 / larger,
             "capacitance_nf": larger}
    for name in ("detection_ma", "attention_ma", "intolerance_ma", "series_ohm", "parallel_ohm", "capacitance_nf",
                 "weber_amplitude", "weber_interval"):
        stated = stats.norm(np.log(model[name]["median"] * times.get(name, 1)), np.log(model[name]["spread"]))
        p = stats.kstest(np.log(who[name]), stated.cdf).pvalue
        check.that(f"{name} is drawn as stated", p > 1e-3, f"p = {p:.2g}")
    check.that("lapses are drawn as stated",
               stats.kstest(who["lapse"], stats.uniform(0, model["lapse_most"]).cdf).pvalue > 1e-3)
    found = np.corrcoef(np.log(who["detection_ma"]), np.log(who["intolerance_ma"]))[0, 1]
    check.that("thresholds are correlated as stated", abs(np.arctanh(found) - np.arctanh(model["threshold_correlation"]))
               < 4 / np.sqrt(len(who["lapse"]) - 3), f"{found:.3f}")
    check.that("thresholds are in order", np.all(who["detection_ma"] < who["attention_ma"])
               and np.all(who["attention_ma"] < who["intolerance_ma"]))
    check.same("too strong from", who["discomfort_ma"], too_strong_from(model, who, model["discomfort_ma"]))


def check_delivery(check, part, who, given, name):
    """`part` holds the counts: the results themselves, or their other_levels."""
    check.same(f"{name}: |Z|", who["impedance_ohm"], given["z"])
    seen = given["ranged"] & given["in_range"]
    check.same(f"{name}: commands", who["command_v"][seen], given["command"][seen])
    check.same(f"{name}: currents", who["current_ma"][seen], given["current"][seen])
    check.same(f"{name}: intervals", who["interval_s"][seen], given["interval"][seen])
    check.that(f"{name}: presented", np.array_equal(who["outcome"] == "presented", given["presented"]))
    check.that(f"{name}: felt", np.array_equal(who["felt"].astype(bool), given["felt"]))
    served, complete, refused = given["served"], given["complete"], given["refused"].any(axis=1)
    expected = {"served": served, "complete": complete, "participants_refused": refused,
                "participants_not_feeling": complete & ~served, "participants_without_range": ~served & ~refused & ~complete}
    for key, group in expected.items():
        check.that(f"{name}: {key}", part[key] == group.sum(), f"program {part[key]}, here {group.sum()}")
    for i, condition in enumerate(part["conditions"]):
        shown = given["presented"][:, i]
        current = np.where(seen, given["current"][:, i], 0)
        counts = [shown.sum(), given["refused"][:, i].sum(), (shown & ~given["felt"][:, i]).sum(), given["felt"][:, i].sum(),
                  (seen & (current >= who["attention_ma"])).sum(), (current > who["discomfort_ma"]).sum(),
                  (current > who["intolerance_ma"]).sum()]
        keys = ("presented", "refused", "not_felt", "counted", "draws_attention", "too_strong", "not_tolerated")
        check.same(f"{name}: {condition['name']}", [condition[k] for k in keys], counts)
        check.spread(f"{name}: {condition['name']} current", condition["current_ma"], current[shown])


def check_result(check, result):
    who, other = columns(result["people"]), columns(result["other_levels"]["people"])
    assert len(who["lapse"]) == result["participants"], "more participants than the JSON holds one by one"
    given = delivery(result, who, result["levels"], who["discomfort_ma"])
    check_draws(check, result, who)
    check_delivery(check, result, who, given, result["levels"])
    levels = result["other_levels"]["levels"]
    check_delivery(check, result["other_levels"], other, delivery(result, other, levels, other["discomfort_ma"]), levels)

    served = given["served"]
    wa, wt = np.log1p(who["weber_amplitude"]), np.log1p(who["weber_interval"])
    amplitude, interval = np.log(given["current"]) / wa[:, None], np.log(given["interval"]) / wt[:, None]
    clear, k = served.copy(), 0
    for a in range(4):
        for b in range(a + 1, 4):
            both, pair = given["felt"][:, a] & given["felt"][:, b], result["separability"][k]
            da, dt = np.abs(amplitude[:, a] - amplitude[:, b]), np.abs(interval[:, a] - interval[:, b])
            check.that(f"pair {k}: participants", pair["participants"] == both.sum())
            for key, distance in (("jnd", np.hypot(da, dt)), ("amplitude_jnd", da), ("interval_jnd", dt)):
                check.spread(f"pair {k}: {key}", pair[key], distance[both])
            clear &= (da >= 5) | (dt >= 5)
            k += 1
    check.same("clearly separable", [result["clearly_separable"], result["clearly_separable_share"]], [clear.sum(), clear.mean()])

    table = answers(result, who, given)
    accuracy = np.trace(table[:, :, :4], axis1=1, axis2=2) / 4
    check.same("accuracy of each", who["accuracy"][given["complete"]], accuracy[given["complete"]], 1e-8)
    check.spread("accuracy", result["accuracy"], accuracy[served], "median")
    check.spread("accuracy of whom all is presented to", result["presented_accuracy"], accuracy[given["complete"]], "median")
    check.spread("information", result["information_bits"], [information(t) for t in table[served]], "median")

    confusion = np.array(result["confusion"])
    check.that("confusion: trials", confusion.sum() == served.sum() * 4 * result["model"]["trials"])
    if served.sum() > 0:
        n = confusion.sum()
        check.same("pooled accuracy", result["pooled_accuracy"], np.trace(confusion[:, :4]) / n)
        check.same("pooled information", result["it_bits"], information(confusion.astype(float)))
        # n² times an entropy loses digits.
        check.same("corrected", result["it_corrected_bits"], corrected_information(confusion), 1e-14 * confusion.sum(1).max() ** 2)
        check.same("its bias", result["it_bias_bits"], result["it_bits"] - result["it_corrected_bits"])
        p = table[served]
        sd = np.sqrt(result["model"]["trials"] * (p * (1 - p)).sum(axis=0))
        far = np.abs(confusion - result["model"]["trials"] * p.sum(axis=0)) / np.maximum(sd, 1)
        check.that("confusion is sampled from these probabilities", far.max() < 4.5, f"{far.max():.1f} s.d.")
        check.same("accuracies", result["accuracies"], np.sort(accuracy[served]), 1e-8)
        check_trials(check, result["trials_needed"], accuracy[served])
        check_pilots(check, result, accuracy[served])
    else:
        check.that("no accuracy without the served", result["accuracy"]["median"] is None and result["trials_needed"] is None
                   and not result["pilots"])

    for row in result["readings"]:
        limit = too_strong_from(result["model"], who, row["median_ma"])
        fixed, own = (delivery(result, who, levels, limit) for levels in ("profile", "personal"))
        check.same(f"too strong from {row['median_ma']} mA",
                   [row["fixed_served"], row["fixed_refused"], row["fixed_not_feeling"], row["personal_served"]],
                   [fixed["served"].sum(), fixed["refused"].any(axis=1).sum(), (fixed["complete"] & ~fixed["served"]).sum(),
                    own["served"].sum()])
        right = np.trace(answers(result, who, own)[:, :, :4], axis1=1, axis2=2) / 4
        check.spread(f"too strong from {row['median_ma']} mA: accuracy", row["accuracy"], right[own["served"]], "median")
    check.that("the headline says how many are served",
               f"serves {result['profile_served']} of {result['participants']}" in result["reasons"][0])
    for name, part in ((result["levels"], result), (levels, result["other_levels"])):
        key = "profile_served" if name == "profile" else "personal_served"
        check.that(key, result[key] == part["served"])
    check_bench(check, result["bench"])


def check_bench(check, bench):
    """The same Monte Carlo with draws of its own: quantiles agree within their standard errors."""
    draw, n = np.random.default_rng(1), 200_000
    even = lambda half: draw.uniform(-half, half, n)
    gain, offset, load, scope, scope_offset, clock = even(0.02), even(0.1), even(0.05), even(0.005), even(0.001), even(1e-4)
    for i, condition in enumerate(bench["conditions"]):
        volts = 40 if TEXTURE_HIGH[i] else 10
        amplitude = (1 + scope) * ((1 + gain) * volts + offset) * (1 + load) + scope_offset * 2 * volts
        interval = (1 + clock) * (0.5 if PRESSURE_HIGH[i] else 2.0) + even(1e-5)
        for key, values in (("amplitude_v", amplitude), ("interval_s", interval)):
            for name, q in (("value", 0.5), ("low", 0.05), ("high", 0.95)):
                wanted, near = np.quantile(values, q), np.quantile(values, [q - 0.02, q + 0.02])
                error = np.sqrt(q * (1 - q) / bench["draws"]) * (near[1] - near[0]) / 0.04
                check.that(f"bench: {condition['name']} {key} {name}", abs(condition[key][name] - wanted) < 5 * error,
                           f"program {condition[key][name]}, here {wanted}")


def run(program, settings, seed):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", "variation", "--json", "--out", folder, "--seed", str(seed)]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        return json.loads(done.stdout)["results"]


SETTINGS = [([], 1), (["levels=profile"], 1), (["discomfort=13.8"], 1), (["levels=profile", "discomfort=13.8"], 1),
            (["discomfort=6.9", "participants=150"], 2), (["area=4", "participants=1000", "trials=5"], 3),
            (["guess=uniform", "weber_spread=1.6", "lapse=20", "width=20", "pilot=24"], 4),
            (["levels=profile", "detection=20", "attention=30", "discomfort=60", "intolerance=60"], 5)]


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    wrong = 0
    if sys.argv[1].endswith(".json"):
        with open(sys.argv[1]) as file:
            results = [(sys.argv[1], json.load(file)["results"])]
    else:
        results = ((f"seed {seed} {' '.join(settings)}", run(sys.argv[1], settings, seed)) for settings, seed in SETTINGS)
    for name, result in results:
        check = Checks()
        check_result(check, result)
        print(f"{name}: {check.done - check.wrong} of {check.done} figures agree; fixed range serves "
              f"{result['profile_served']}, own range {result['personal_served']} of {result['participants']}")
        wrong += check.wrong
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
