"""Real slides by numpy and scipy, as science.md section 2 defines their features. tests/dsp and tests/acquisition read it.

The recordings are in ../shared/data, which is not a part of the tree.
"""
import numpy as np
from scipy.signal import butter, sosfilt, sosfilt_zi

from figures import keep, shared


def columns_of(relative):
    return np.loadtxt(shared(relative), delimiter=",", skiprows=1, ndmin=2).T


def rate_of(t):
    return (len(t) - 1) / (t[-1] - t[0])


def biotac(name):
    t, x = columns_of("biotac/%s/vibration.csv" % name)
    force_t, force = columns_of("biotac/%s/force.csv" % name)
    taxel_t = columns_of("biotac/%s/taxels.csv" % name)[0]
    fs = rate_of(t)
    top = 0.45 * fs  # below 2 kHz / 0.9
    sos = butter(2, [5, top], "bandpass", fs=fs, output="sos")
    y = sosfilt(sos, x, zi=sosfilt_zi(sos) * x[0])[0] / np.maximum(np.interp(t, force_t, force), 0.1)
    window, hop = int(np.floor(0.064 * fs + 0.5)), int(np.floor(0.016 * fs + 0.5))
    hann = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(window) / window)
    f = np.fft.rfftfreq(window, 1 / fs)
    whole, rough = (f >= 5) & (f <= top), (f >= 200) & (f <= top)
    h, h_abs, pressure_pa = [], [], []
    for first in range(0, len(y) - window + 1, hop):
        s = 2 * np.abs(np.fft.rfft(y[first : first + window] * hann)) ** 2 / (fs * np.sum(hann**2))
        h.append(s[rough].sum() / s[whole].sum())
        h_abs.append(s[rough].sum() * fs / window)
        pressure_pa.append(np.interp(t[0] + (first + window / 2) / fs, force_t, force) / 1e-4)
    return {
        "name": name,
        "rate_hz": fs,
        "taxel_rate_hz": rate_of(taxel_t),
        "frames": len(h),
        "h": np.mean(h),
        "h_sd": np.std(h, ddof=1),
        "h_abs": np.mean(h_abs),
        "pressure_pa": np.mean(pressure_pa),
    }


def taxels_of(name):
    table = columns_of("fabric_slide/%s.csv" % name)
    return table[0] / 1e3, table[3:].T  # ms, two proximities, 16 taxels


def fabric(name):
    t, c = taxels_of(name)
    begin = t < t[0] + 0.25
    floor = 3 * c[begin].mean(axis=1).std()
    u = np.maximum(c - c[begin].mean(axis=0), 0)
    recent = np.array([u[(t > now - 0.25) & (t <= now)].mean(axis=0) for now in t])
    mean = u.mean(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        static, dynamic = u.var(axis=1) / mean**2, (u - recent).var(axis=1) / mean**2
    present = (mean >= floor) & (mean > 0)
    return {
        "name": name,
        "frames": len(t),
        "present": int(np.sum(present & (static > 0))),
        "v_static": static[present & (static > 0)].mean(),
        "v_dynamic": dynamic[present & (dynamic > 0)].mean(),
    }


def grating(speed_mmps):
    """Spatial period of the 2 mm board: speed over the frequency at which the taxels have most power, Hann window."""
    t, c = taxels_of("Board2mm_F120_V-%dmmps_0" % speed_mmps)
    hann = 0.5 - 0.5 * np.cos(2 * np.pi * (t - t[0]) / (t[-1] - t[0]))
    f = np.arange(0.15 * speed_mmps, 0.45 * speed_mmps, 0.0005 * speed_mmps)
    spectrum = np.exp(-2j * np.pi * np.outer(f, t - t[0])) @ ((c - c.mean(axis=0)) * hann[:, None])
    power = np.sum(np.abs(spectrum) ** 2, axis=1)
    return {"speed_mmps": speed_mmps, "taxel_rate_hz": rate_of(t), "period_mm": speed_mmps / f[np.argmax(power)]}


def stick():
    t = columns_of("hapmat/Fabric.csv")[0]
    fs = rate_of(t)
    window, hop = int(np.floor(0.064 * fs + 0.5)), int(np.floor(0.016 * fs + 0.5))
    return {"samples": len(t), "rate_hz": fs, "frames": (len(t) - window) // hop + 1}


def figures():
    return {
        "biotac": [biotac(name) for name in ("mat1_1", "mat6_1", "mat11_1", "mat16_1")],
        "fabric": [fabric(name) for name in ("Linen_F150_V20mmps_0", "Board2mm_F120_V-5mmps_0")],
        "grating": [grating(speed) for speed in (5, 10, 20, 30)],
        "stick": stick(),
    }


keep(__file__, figures)
