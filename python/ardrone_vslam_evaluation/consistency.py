# SPDX-License-Identifier: BSD-3-Clause
"""Does the covariance tell the truth? NEES with its chi-square bounds, NIS."""

import math

import numpy as np

# What three coordinates exceed as seldom as one exceeds 3 sigma, in 0.27 % of the poses; as in tools/trajectory/metrics.hpp.
NEES_3_SIGMA = 14.156
DEGREES = 3


def gamma_share(a, x):
    """Regularised lower incomplete gamma function P(a, x): by its series, or its continued fraction (Lentz)."""
    if x <= 0:
        return 0.0
    front = math.exp(a * math.log(x) - x - math.lgamma(a))
    if x < a + 1:
        term = total = 1 / a
        k = a
        while abs(term) > 1e-16 * abs(total):
            k += 1
            term *= x / k
            total += term
        return front * total
    tiny = 1e-300
    b = x + 1 - a
    c, d = 1 / tiny, 1 / b
    fraction = d
    for i in range(1, 100000):
        numerator = -i * (i - a)
        b += 2
        d = 1 / (numerator * d + b or tiny)
        c = numerator / c + b or tiny
        fraction *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return 1 - front * fraction


def chi_square_quantile(share, degrees):
    """Below which `share` of a chi-square variable with so many degrees of freedom lies, by bisection."""
    low, high = 0.0, degrees + 10 * math.sqrt(2 * degrees) + 50
    for _ in range(200):
        middle = 0.5 * (low + high)
        if gamma_share(0.5 * degrees, 0.5 * middle) < share:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def bounds_95(degrees):
    return chi_square_quantile(0.025, degrees), chi_square_quantile(0.975, degrees)


def nees_of(estimate, truth):
    """Of each position; NaN where the covariance cannot be inverted. None when there are no covariances."""
    if estimate.covariances_m2 is None:
        return None
    errors = (estimate.positions_m - truth.positions_m)[:, :, None]
    values = np.full(len(estimate), np.nan)
    is_definite = np.isfinite(estimate.covariances_m2).all(axis=(1, 2))
    is_definite[is_definite] = np.linalg.eigvalsh(estimate.covariances_m2[is_definite]).min(axis=1) > 0
    if is_definite.any():
        solved = np.linalg.solve(estimate.covariances_m2[is_definite], errors[is_definite])
        values[is_definite] = (errors[is_definite] * solved).sum(axis=(1, 2))
    return values


def summary_of_nees(values):
    """None when there is no value."""
    values = values[np.isfinite(values)]
    if not len(values):
        return None
    low, high = bounds_95(DEGREES)
    mean_low, mean_high = bounds_95(DEGREES * len(values))
    return {"expected": DEGREES, "mean": values.mean(), "median": np.median(values), "poses": len(values),
            "bounds_95": [low, high], "inside_95": np.mean((values >= low) & (values <= high)),
            "inside_3_sigma": np.mean(values <= NEES_3_SIGMA),
            # Of independent poses; those of one run are not, so an honest filter's mean may lie outside.
            "mean_bounds_95": [mean_low / len(values), mean_high / len(values)]}


def is_after_first_fix(values):
    """fix_nis begins with 1, before it knows anything."""
    return np.cumsum(np.isfinite(values) & (values != 1)) > 0


def summary_of_nis(values):
    """Of the fixes' mean squared deviations over the expected ones (fix_nis), 1 is honest. None before the first fix."""
    values = values[is_after_first_fix(values) & np.isfinite(values)]
    if not len(values):
        return None
    return {"expected": 1, "mean": values.mean(), "median": np.median(values), "p95": np.percentile(values, 95),
            "frames": len(values)}
