"""Naive twins of markermend.numerics: one sample, one window, one frame at a time, with dense matrices."""

import numpy as np
from scipy.linalg import null_space


def runs(signal):
    """Intervals of samples that are not NaN, found one sample at a time."""
    found, start = [], None
    for n in range(len(signal) + 1):
        missing = n == len(signal) or np.isnan(signal[n])
        if missing and start is not None:
            found.append((start, n))
            start = None
        elif not missing and start is None:
            start = n
    return found


def under_element(signal, size, best):
    """The least or greatest (`best`) value under a window, never beyond the sample's own valid run."""
    out = np.full(len(signal), np.nan)
    for start, stop in runs(signal):
        for n in range(start, stop):
            out[n] = best(signal[max(start, n - size // 2) : min(stop, n + size // 2 + 1)])
    return out


def moving_median(signal, window):
    """Median of a window, the run's first and last sample standing in beyond its ends."""
    out = np.full(len(signal), np.nan)
    for start, stop in runs(signal):
        for n in range(start, stop):
            around = [signal[min(max(k, start), stop - 1)] for k in range(n - window // 2, n + window // 2 + 1)]
            out[n] = np.median(around)
    return out


def block_tridiagonal(diagonal, below, right):
    """Solution, blocks of the inverse on and below the diagonal, and log-determinant, by the dense matrix."""
    blocks, size = right.shape
    dense = np.zeros((blocks, size, blocks, size))
    for t in range(blocks):
        dense[t, :, t] = diagonal[t]
    for t in range(blocks - 1):
        dense[t + 1, :, t], dense[t, :, t + 1] = below[t], below[t].T
    dense = dense.reshape(blocks * size, -1)
    inverse = np.linalg.inv(dense).reshape(blocks, size, blocks, size)
    solution = np.linalg.solve(dense, right.reshape(-1)).reshape(blocks, size)
    on = np.array([inverse[t, :, t] for t in range(blocks)])
    under = np.array([inverse[t + 1, :, t] for t in range(blocks - 1)]).reshape(-1, size, size)
    return solution, on, under, np.linalg.slogdet(dense)[1]


def tyler(residual, *, size, order, shrinkage, iterations):
    """Tyler's M-estimator of the covariance of windows (size, size), window by window, without polynomials."""
    basis = null_space(np.vander(np.linspace(-1, 1, size), order + 1).T)
    windows = []
    for marker in range(residual.shape[1]):
        for start in range(len(residual) - size + 1):
            for axis in range(3):
                window = basis.T @ residual[start : start + size, marker, axis]
                if np.isfinite(window).all() and window.any():
                    windows.append(window)
    scatter = np.eye(size - order - 1)
    for _ in range(iterations):
        inverse, total = np.linalg.inv(scatter), np.zeros_like(scatter)
        for window in windows:
            total += np.outer(window, window) / (window @ inverse @ window)
        scatter = total / np.trace(total) * len(total) + shrinkage * np.eye(len(total))
    return basis @ scatter @ basis.T


def autocovariance(residual, lags):
    """Mean product over all pairs of known samples, lag by lag."""
    out = []
    for lag in lags:
        products = [
            (residual[i] * residual[i + lag]).mean()
            for i in range(len(residual) - lag)
            if np.isfinite(residual[i]).all() and np.isfinite(residual[i + lag]).all()
        ]
        out.append(np.mean(products) if products else np.nan)
    return np.array(out)


def matern(covariance, lag):
    """The smooth part of a covariance function at one lag, s, with the kernels written out."""
    total, count = 0.0, len(covariance.scales_s)
    for k, scale in enumerate(covariance.scales_s):
        order3, order5 = np.sqrt(3) * abs(lag) / scale, np.sqrt(5) * abs(lag) / scale
        total += covariance.weights[1 + k] * (1 + order3) * np.exp(-order3)
        total += covariance.weights[1 + count + k] * (1 + order5 + order5**2 / 3) * np.exp(-order5)
    return total


def conditional_gaussian(covariance, observed, values, targets):
    """Mean (n, axes) and variance (n,) of the joint Gaussian of observations and targets, given the observations."""
    times = np.concatenate([observed, targets])
    joint = np.array([[matern(covariance, a - b) for b in times] for a in times])
    known = np.arange(len(times)) < len(observed)
    between = joint[np.ix_(known, known)] + covariance.weights[0] * np.eye(len(observed))
    gain = joint[np.ix_(~known, known)] @ np.linalg.inv(between)
    variance = np.diag(joint[np.ix_(~known, ~known)] - gain @ joint[np.ix_(known, ~known)]) + covariance.weights[0]
    return gain @ values, variance


def pulse_statistic(window, pulse, covariance, rate):
    """Height of a pulse beside a constant by generalised least squares in one window (n, axes), over its deviation."""
    size = len(window)
    smooth = np.array([[matern(covariance, (i - j) / rate) for j in range(size)] for i in range(size)])
    noise = covariance.noise + 1e-5 * (smooth[0, 0] + covariance.noise)
    precision = np.linalg.inv(smooth + noise * np.eye(size))
    design = np.stack([pulse, np.ones(size)], axis=1)
    spread = np.linalg.inv(design.T @ precision @ design)
    height = (spread @ design.T @ precision @ window)[0]
    return np.linalg.norm(height) / np.sqrt(spread[0, 0])


def normal_density(samples, bandwidth, point):
    """A kernel density estimate at one point: the mean of the normal densities about the samples."""
    normal = [np.exp(-0.5 * ((point - s) / bandwidth) ** 2) / (bandwidth * np.sqrt(2 * np.pi)) for s in samples]
    return sum(normal) / len(samples)


def kabsch(points, template):
    """Rotations (frames, 3, 3) and origins (frames, 3) that carry a template onto points, frame by frame by SVD."""
    rotations = []
    for frame in points:
        left, _, right = np.linalg.svd((frame - frame.mean(axis=0)).T @ template)
        sign = np.sign(np.linalg.det(left @ right))
        rotations.append(left @ np.diag([1, 1, sign]) @ right)
    return np.array(rotations), np.array([frame.mean(axis=0) for frame in points])


def complete_matrix(matrix, rank, iterations):
    """Missing entries from the truncated singular value decomposition, again and again, from straight lines on."""
    missing = np.isnan(matrix)
    filled = matrix.copy()
    for column, absent in zip(filled.T, missing.T, strict=True):
        column[absent] = np.interp(np.flatnonzero(absent), np.flatnonzero(~absent), column[~absent])
    for _ in range(iterations):
        mean = filled.mean(axis=0)
        left, sizes, right = np.linalg.svd(filled - mean, full_matrices=False)
        approximation = mean + left[:, :rank] * sizes[:rank] @ right[:rank]
        filled[missing] = approximation[missing]
    return filled


def scaled_conjugate_gradient(value, gradient, start, *, iterations, rest, probe):
    """Scaled conjugate gradient for one function, in the steps and the names of Moller 1993."""
    w = np.array(start, float)
    r = p = -gradient(w)
    scale, raised, success, delta = 1e-6, 0.0, True, 0.0
    for k in range(1, iterations + 1):
        if np.abs(r).max() <= rest:
            break
        square = p @ p
        if success:
            sigma = probe / np.sqrt(square)
            delta = p @ ((gradient(w + sigma * p) - gradient(w)) / sigma)
        delta += (scale - raised) * square
        if delta <= 0:
            raised = 2 * (scale - delta / square)
            delta = -delta + scale * square
            scale = raised
        mu = p @ r
        alpha = mu / delta
        comparison = 2 * delta * (value(w) - value(w + alpha * p)) / mu**2
        if comparison >= 0:
            w = w + alpha * p
            new = -gradient(w)
            raised, success = 0.0, True
            turned = new + (new @ new - new @ r) / mu * p
            p = new if k % len(w) == 0 or turned @ new <= 0 else turned
            r = new
            if comparison >= 0.75:
                scale /= 4
        else:
            raised, success = scale, False
        if comparison < 0.25:
            scale += delta * (1 - comparison) / square
    return w


def pulse_height(signal, shape, regressors, scale, covariance, step_s, *, intercept_std, jitter):
    """Height of a pulse and its deviation, by dense generalised least squares; None where it is hardly known."""
    known = [n for n in range(len(signal)) if not np.isnan(signal[n]).any()]
    if (shape[known] ** 2).sum() < 0.8 * (shape**2).sum():
        return None
    design = regressors[known] - regressors[known].mean(axis=0)
    total = np.zeros((len(known), len(known)))
    for i, one in enumerate(known):
        for j, other in enumerate(known):
            own = covariance(np.array([abs(one - other) * step_s]))[0]
            if one == other:
                own += covariance.noise + jitter * covariance(np.zeros(1))[0] + 1e-9
            total[i, j] = own * scale[one] * scale[other] + design[i] @ design[j] + intercept_std**2
    centred = signal[known] - np.median(signal[known], axis=0)
    weights = np.linalg.solve(total, shape[known])
    information = weights @ shape[known]
    return weights @ centred / information, 1 / np.sqrt(information)


def band_pass(values, band_hz, rate, half_length):
    """Each sample on its own: the ideal filter under a Hamming window, over the run extended by its point reflection."""
    lags = np.arange(-half_length, half_length + 1)
    low, high = (2 * f / rate * np.sinc(2 * f / rate * lags) for f in band_hz)
    taps = (high - low) * np.hamming(len(lags))
    middle = sum(band_hz) / 2
    taps /= np.sum(taps * np.cos(2 * np.pi * middle / rate * lags))
    out = np.full(len(values), np.nan)
    known = [i for i in range(len(values)) if not np.isnan(values[i])]
    for i in known:
        start = stop = i
        while start - 1 in known:
            start -= 1
        while stop + 1 in known:
            stop += 1
        if stop + 1 - start <= len(lags) or min(i - start, stop - i) < half_length // 2:
            continue
        total = 0.0
        for lag, weight in zip(lags, taps, strict=True):
            j = i + lag
            if j < start:
                total += weight * (2 * values[start] - values[2 * start - j])
            elif j > stop:
                total += weight * (2 * values[stop] - values[2 * stop - j])
            else:
                total += weight * values[j]
        out[i] = total
    return out


def symmetric_smoothing(values, window):
    """A moving median, then a moving mean, sample by sample; windows shrink near NaN and the ends, below two on a side they do nothing."""
    missing = [-1, *np.flatnonzero(np.isnan(values).any(axis=1)).tolist(), len(values)]
    for pick in (np.median, np.mean):
        out = values.copy()
        for n in range(len(values)):
            reach = min(abs(n - place) for place in missing) - 1
            half = min(reach, window // 2)
            if half >= 0 and (half == window // 2 or half >= 2):
                out[n] = pick(values[n - half : n + half + 1], axis=0)
        values = out
    return values
