# SPDX-License-Identifier: Apache-2.0
"""Two sets of pictures of one scene, each rendered several times with seeds of its own: do their expectations agree?"""
import math

import numpy

FALSE_ALARMS = 1e-4  # of each family of tests
FLOATS = 2e-5  # relative difference that float arithmetic and sums of pixels are granted


def beta_fraction(a, b, x):
    """The continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method."""
    tiny = 1e-300
    c, d = 1.0, 1 / (1 - (a + b) * x / (a + 1) or tiny)
    value = d
    for m in range(1, 500):
        even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        for coefficient in (even, odd):
            d = 1 / (1 + coefficient * d or tiny)
            c = 1 + coefficient / c or tiny
            value *= c * d
        if abs(c * d - 1) < 1e-14:
            break
    return value


def incomplete_beta(a, b, x):
    """Regularised, I_x(a, b)."""
    if x <= 0 or x >= 1:
        return float(x >= 1)
    front = math.exp(
        math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    )
    if x < (a + 1) / (a + b + 2):
        return front * beta_fraction(a, b, x) / a
    return 1 - front * beta_fraction(b, a, 1 - x) / b


def student(t, freedom):
    """P(|T| > t) of Student's distribution."""
    return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t))


def welch(ours, theirs):
    """(difference of means, its standard error, two-sided p) of two lists of replicates. Welch's t.

    Where neither side has noise, p is None if they agree as far as float arithmetic goes, and 0 if not.
    """
    difference = float(ours.mean() - theirs.mean())
    parts = [float(side.var(ddof=1)) / len(side) for side in (ours, theirs)]
    variance, granted = sum(parts), FLOATS * max(abs(float(ours.mean())), abs(float(theirs.mean())))
    if math.sqrt(variance) <= granted:
        return difference, math.sqrt(variance), None if abs(difference) <= 4 * granted else 0.0
    freedom = variance**2 / sum(part**2 / (len(side) - 1) for part, side in zip(parts, (ours, theirs)))
    return difference, math.sqrt(variance), student(abs(difference) / math.sqrt(variance), freedom)


def tiles(pictures, edge):
    """Means over the channels of squares of `edge` pixels. [replicate, y, x, channel] -> [replicate, tile]."""
    count, height, width, channels = pictures.shape
    parted = pictures.reshape(count, height // edge, edge, width // edge, edge, channels)
    return parted.mean(axis=(2, 4, 5)).reshape(count, -1)


def uniformity(values):
    """p that numbers in [0, 1] are uniform: Kolmogorov and Smirnov, with Stephens's correction for few of them."""
    ordered, count = numpy.sort(values), len(values)
    above = float((numpy.arange(1, count + 1) / count - ordered).max())
    below = float((ordered - numpy.arange(count) / count).max())
    scaled = max(above, below) * (math.sqrt(count) + 0.12 + 0.11 / math.sqrt(count))
    if scaled < 0.3:  # the series does not converge, and p is 1 to five digits
        return 1.0
    return min(1.0, 2 * sum((-1) ** (k - 1) * math.exp(-2 * (k * scaled) ** 2) for k in range(1, 101)))


def sidak(p, count):
    """p of the smallest of `count` independent ones."""
    return -math.expm1(count * math.log1p(-p)) if p < 1 else 1.0


def judge(ours, theirs, edge, independent=True):
    """Prints what differs. @param ours, theirs [replicate, y, x, channel]. @param independent whether tiles are: else
    their p need not be uniform. @return whether the two agree."""
    families = []
    print(f"  image mean      {'tyndall':>12} {'mitsuba':>12} {'difference':>11} {'std. error':>11}        p")
    for channel, name in enumerate("RGB"):
        means = [side[..., channel].mean(axis=(1, 2)) for side in (ours, theirs)]
        difference, error, p = welch(*means)
        scale = max(abs(float(means[1].mean())), 1e-300)
        values = f"{means[0].mean():12.6g} {means[1].mean():12.6g}"
        relative = f"{difference / scale:+11.4%} {error / scale:11.4%}"
        print(f"    {name}             {values} {relative}  {'no noise' if p is None else format(p, '8.4f')}")
        families.append(("image mean", 1.0 if p is None else sidak(p, 3)))
    found = [welch(a, b)[2] for a, b in zip(tiles(ours, edge).T, tiles(theirs, edge).T)]
    noisy = numpy.array([p for p in found if p is not None])
    if len(noisy):
        bins = numpy.histogram(noisy, bins=10, range=(0, 1))[0]
        smallest, even = sidak(float(noisy.min()), len(noisy)), uniformity(noisy)
        print(f"  {len(noisy)} of {len(found)} tiles of {edge}x{edge} have noise; tenths of p: {' '.join(map(str, bins))}")
        note = "" if independent else ", not judged: the tiles share noise"
        print(f"  smallest p {noisy.min():.2g} (Sidak {smallest:.3g}), uniform (Kolmogorov-Smirnov): p = {even:.3g}{note}")
        families += [("a tile", smallest)] + [("uniformity of the tiles' p", even)] * independent
    failed = sorted({name for name, p in families if p < FALSE_ALARMS})
    print(f"  {'DIFFERS: ' + ', '.join(failed) if failed else 'agrees'}")
    return not failed
