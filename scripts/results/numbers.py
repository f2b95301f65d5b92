# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Intervals and fits, and how they are written."""
import math
import random

Z = 1.959964
# 97.5 % points of Student's t, from one degree of freedom on.
STUDENT = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)
NONE = "-"


def wilson(count, cases):
    """The 95 % interval of a share of at least one case."""
    share = count / cases
    scale = 1 + Z * Z / cases
    middle = (share + Z * Z / (2 * cases)) / scale
    half = Z * math.sqrt(share * (1 - share) / cases + Z * Z / (4 * cases * cases)) / scale
    return max(0.0, middle - half), min(1.0, middle + half)


def upper_bound(count, cases, confidence=0.95):
    """The exact one-sided bound of a share (Clopper and Pearson): fewer cases would be as rare."""
    if count >= cases:
        return 1.0

    def seldom(probability):
        """Whether at most `count` of the cases are that improbable."""
        logs = (math.lgamma(cases + 1) - math.lgamma(k + 1) - math.lgamma(cases - k + 1)
                + k * math.log(probability) + (cases - k) * math.log1p(-probability)
                for k in range(count + 1))  # fmt: skip
        return sum(map(math.exp, logs)) < 1 - confidence

    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if seldom(middle) else (middle, high)
    return high


def bootstrap(blocks, draws=10000):
    """The 95 % interval of a share whose cases hang together in blocks of (count, cases)."""
    chance = random.Random(1)
    shares = []
    for _ in range(draws):
        drawn = chance.choices(blocks, k=len(blocks))
        shares.append(sum(count for count, _ in drawn) / sum(cases for _, cases in drawn))
    shares.sort()
    return shares[int(0.025 * draws)], shares[int(0.975 * draws) - 1]


def share(count, cases):
    """A share with its interval, for shares that are usually near 1."""
    if not cases:
        return NONE
    low, high = wilson(count, cases)
    return f"{count / cases:.3f} ({low:.2f}-{high:.2f})"


def rare(count, cases):
    """A count with its share and interval in per cent, for what should not happen."""
    if not cases:
        return NONE
    low, high = wilson(count, cases)
    return f"{count} = {100 * count / cases:.2f} % ({100 * low:.2f}-{100 * high:.2f})"


def number(value, decimals):
    return NONE if value is None else f"{value:.{decimals}f}"


def times(value):
    """A ratio with two digits or more."""
    return NONE if value is None else f"{value:.0f}" if value >= 10 else f"{value:.1f}"


def fit_exponent(points):
    """Slope of log y over log x and half of its 95 % interval, None of two points."""
    xs = [math.log(x) for x, _ in points]
    ys = [math.log(max(y, 1e-12)) for _, y in points]
    x_mean = sum(xs) / len(xs)
    y_mean = sum(ys) / len(ys)
    spread = sum((x - x_mean) ** 2 for x in xs)
    slope = sum((x - x_mean) * (y - y_mean) for x, y in zip(xs, ys)) / spread
    if len(points) < 3:
        return slope, None
    residuals = sum((y - y_mean - slope * (x - x_mean)) ** 2 for x, y in zip(xs, ys))
    freedom = len(points) - 2
    student = STUDENT[min(freedom, len(STUDENT)) - 1]
    return slope, student * math.sqrt(residuals / freedom / spread)


def exponent(points):
    if len({x for x, _ in points}) < 2:
        return NONE
    slope, half = fit_exponent(points)
    if half is None:
        return f"{slope:.2f}"
    return f"{slope:.2f} ({slope - half:.2f} to {slope + half:.2f})"
