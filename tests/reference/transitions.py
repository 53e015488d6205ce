"""transitions.py RUN.json FOLDER - steps from train to train, times until complete and verdict of a transitions run."""
import json
import sys

import numpy as np

from captures import agree, captures_of, fail, train_in

CARRIED = 0.25  # just-noticeable differences


def amplitude_jnd(a, b):
    return abs(np.log(a / b)) / np.log(1.1)


def interval_jnd(a, b):
    return abs(np.log(a / b)) / np.log(1.16)


def fewest(change):
    """The fewest trains of steps of at most 2 differences, and the least time, by counting steps one by one."""
    ratio = 1.16**2
    steps = max(1, int(np.ceil(amplitude_jnd(change["from_v"], change["to_v"]) / 2 - 1e-9)))
    before, after, since = change["from_s"], change["to_s"], change["since_onset_s"]
    if after < before:
        intervals = [max(before / ratio, after, since)]
        # At once, since more than the new interval has passed: in time for it, when the next one can be the new one.
        at_once = since >= intervals[0] and intervals[0] / ratio <= after * (1 + 1e-12)
        while not at_once and intervals[-1] > after * (1 + 1e-12):
            intervals.append(max(intervals[-1] / ratio, after))
        intervals += [after] * (steps - len(intervals))
    else:
        intervals = [after]
        while intervals[0] / ratio > before * (1 + 1e-12):
            intervals.insert(0, intervals[0] / ratio)
        intervals = [before] * (steps - len(intervals)) + intervals
    return len(intervals), max(0, sum(intervals) - since)


def check_change(change):
    """Recomputes one change from its trains; returns its largest steps."""
    name, trains = change["name"], change["onsets"]
    amplitudes = [change["before_v"][-1]] + [train["amplitude_v"] for train in trains]
    intervals = [train["interval_s"] for train in trains]
    largest = [0, 0]
    for k, train in enumerate(trains):
        agree(name + ", step of amplitude", train["amplitude_jnd"], amplitude_jnd(amplitudes[k + 1], amplitudes[k]), 1e-6)
        if k > 0:
            agree(name + ", interval", intervals[k], train["after_step_s"] - trains[k - 1]["after_step_s"], 1e-7)
            agree(name + ", step of interval", train["interval_jnd"], interval_jnd(intervals[k], intervals[k - 1]), 1e-6)
        largest = [max(largest[0], train["amplitude_jnd"]), max(largest[1], train["interval_jnd"])]
    # Complete with the train that is near to the new state and followed by the new interval.
    gain = change["before_v"][-1] / change["from_v"]
    complete = None
    for k in range(len(trains) - 1):
        near = interval_jnd(intervals[k], change["to_s"]) <= CARRIED or (
            k == 0 and change["since_onset_s"] >= change["to_s"] and trains[0]["after_step_s"] <= 0.05)
        if near and amplitude_jnd(amplitudes[k + 1] / gain, change["to_v"]) <= CARRIED and \
                interval_jnd(intervals[k + 1], change["to_s"]) <= CARRIED:
            complete = (trains[k]["after_step_s"], k + 1)
            break
    agree(name + ", complete", change["complete_s"], complete[0] if complete else None, 1e-9)
    agree(name + ", trains", change["trains"], complete[1] if complete else None, 0)
    trains_needed, least = fewest(change)
    agree(name + ", fewest trains", change["fewest_trains"], trains_needed, 0)
    agree(name + ", least time", change["fastest_complete_s"], least, 1e-6)
    return largest


def check_captures(changes, folder):
    """The kept records: the train that carries a change and the one before it."""
    files = captures_of(folder)
    count = 0
    for number, change in enumerate(changes, 1):
        read = [train_in(path) for path in files.get(number, [])]
        wanted = [v for v in change["before_v"][-1:] + [train["amplitude_v"] for train in change["onsets"]] if v]
        for _, amplitude in read:
            if not min(abs(amplitude - v) for v in wanted) <= 2e-3 * amplitude + 0.02:
                fail("%s: a capture shows %.4f V, which no train was reported with" % (change["name"], amplitude))
            count += 1
    return count


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        sys.exit(2)
    results = json.load(open(sys.argv[1]))["results"]
    judged = results["changes"]
    steps = results["steps"] + results["jumps"]
    largest, late, beyond = {}, set(), set()
    for change in steps:
        here = check_change(change)
        largest[change["name"]] = np.maximum(largest.get(change["name"], [0, 0]), here)
        if change["complete_s"] <= judged["complete_limit_s"]:
            continue
        needed, least = fewest(change)
        if least > judged["complete_limit_s"] and not judged["seconds_alone"] and change["trains"] <= needed:
            beyond.add(change["name"])
        else:
            late.add(change["name"])
    for movement in results["movements"]:
        trains = movement["onsets"]
        here = [0, 0]
        for k in range(1, len(trains)):
            here[0] = max(here[0], amplitude_jnd(trains[k]["amplitude_v"], trains[k - 1]["amplitude_v"]))
            if k > 1:
                here[1] = max(here[1], interval_jnd(trains[k]["interval_s"], trains[k - 1]["interval_s"]))
        largest[movement["name"]] = here
    for group in judged["groups"]:
        agree(group["name"] + ", largest step of amplitude", group["amplitude_jnd"], largest[group["name"]][0], 1e-6)
        agree(group["name"] + ", largest step of interval", group["interval_jnd"], largest[group["name"]][1], 1e-6)
        if (group["out_of_reach"] > 0) != (group["name"] in beyond) and group["name"] not in late:
            fail(group["name"] + ": what is out of reach is reported otherwise")
    # 2 sqrt 2 s, s pooled over trains of one command, and what the oscilloscope states of both amplitudes of a step.
    stated = 0
    for change in [c for c in steps if c["name"] == judged["groups"][0]["name"]]:
        before = change["before_v"][-1]
        for train in change["onsets"]:
            stated = max(stated, train["amplitude_u_v"] * np.hypot(1 / train["amplitude_v"], 1 / before))
            before = train["amplitude_v"]
    squares = freedom = 0
    for change in steps:
        v = np.array([x for x in change["before_v"] if x is not None])
        if len(v) > 1:
            squares += (len(v) - 1) * (v.std(ddof=1) / v.mean()) ** 2
            freedom += len(v) - 1
    u = 2 * np.sqrt(2 * squares / freedom + stated**2) / np.log(1.1)
    agree("uncertainty of a step", judged["groups"][0]["amplitude_u_jnd"], u, 1e-9)
    worst = [max(group[key] for group in judged["groups"]) for key in ("amplitude_jnd", "interval_jnd")]
    passes = worst[0] + u <= 2 and worst[1] + judged["groups"][0]["interval_u_jnd"] <= 2 and not late
    if (judged["verdict"] == "pass") != passes:
        fail("changes: verdict %s, largest steps %s, late %s" % (judged["verdict"], worst, sorted(late)))
    read = check_captures(steps, sys.argv[2])
    print("agrees: %d changes and %d movements, %d captures read, largest steps %.3f and %.3f, verdict %s"
          % (len(steps), len(results["movements"]), read, worst[0], worst[1], judged["verdict"]))


main()
