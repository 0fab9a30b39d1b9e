# SPDX-License-Identifier: BSD-3-Clause
"""The frequency of a ringing signal."""
import numpy as np


def find_frequency(times, values, low, high):
    """Where the spectrum of a uniformly sampled signal (Hann's window) is largest between two
    frequencies [Hz]; by a parabola through three points of its logarithm, padded eightfold."""
    values = np.asarray(values) - np.polyval(np.polyfit(times, values, 5), times)
    size = 8 * len(values)
    spectrum = np.log(np.abs(np.fft.rfft(values * np.hanning(len(values)), size)) + 1e-300)
    rates = np.fft.rfftfreq(size, times[1] - times[0])
    inside = np.flatnonzero((rates > low) & (rates < high))
    i = inside[np.argmax(spectrum[inside])]
    a, b, c = spectrum[i - 1 : i + 2]
    return float(rates[i] + 0.5 * (a - c) / (a - 2 * b + c) * (rates[1] - rates[0]))
