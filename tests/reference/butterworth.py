"""Coefficients of the band-pass of science.md section 2.1 by scipy. tests/dsp reads them."""
from scipy.signal import butter

from figures import keep


def designed(low, high, rate):
    b, a = butter(2, [low, high], "bandpass", fs=rate)
    return {"low": low, "high": high, "rate": rate, "b0": b[0], "a": a[1:].tolist()}


def figures():
    return {"filters": [designed(*band) for band in ((5, 1000, 4000), (5, 990, 2200), (5, 45, 100), (5, 1000, 20000))]}


keep(__file__, figures)
