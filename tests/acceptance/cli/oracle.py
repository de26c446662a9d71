"""The definition of VOXELIZE and of the statistics, in exact integers and fractions, as slow as it is plain."""
import math
from fractions import Fraction
from itertools import product


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def voxels(triangle, dims):
    """Voxels of the survey whose closed unit cube meets the closed triangle; lattice units of 1/256 voxel."""
    a, b, c = triangle
    edges = [tuple(q - p for p, q in zip(u, v)) for u, v in ((a, b), (b, c), (c, a))]
    units = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    axes = units + [cross(edges[0], edges[1])] + [cross(e, u) for e in edges for u in units]
    # A degenerate triangle is a segment or a point: the axes in its plane complete the test.
    axes += [cross(cross(edges[0], edges[1]), e) for e in edges]
    longest = max(edges, key=lambda e: dot(e, e))
    axes += [cross(longest, cross(longest, u)) for u in units] + [longest]
    axes = [x for x in axes if any(x)]
    found = []
    ranges = []
    for axis in range(3):
        low = min(p[axis] for p in triangle)
        high = max(p[axis] for p in triangle)
        ranges.append(range(max(0, -((128 - low) // 256)), min(dims[axis] - 1, (high + 128) // 256) + 1))
    for voxel in product(*ranges):
        centre = tuple(256 * x for x in voxel)
        for axis in axes:
            reach = 128 * sum(map(abs, axis))
            at = [dot(axis, p) - dot(axis, centre) for p in triangle]
            if min(at) > reach or max(at) < -reach:
                break
        else:
            found.append(voxel)
    return found


class Volume:
    def __init__(self, values, dims):
        self.values, self.dims = values, dims
        self.largest = max((abs(v) for v in values if not math.isnan(v)), default=0.0)

    def at(self, i, j, k):
        if not (0 <= i < self.dims[0] and 0 <= j < self.dims[1] and 0 <= k < self.dims[2]):
            return math.nan
        return self.values[(i * self.dims[1] + j) * self.dims[2] + k]


def discontinuity(found, volume):
    # Multiples of 2^-40 of 81 max|V|^2, ties to even.
    scale = 0.0 if volume.largest == 0 else 2.0**40 / (81 * (volume.largest * volume.largest))
    num_sum = den_sum = 0
    for i, j, k in found:
        if math.isnan(volume.at(i, j, k)):
            continue
        total = squares = 0.0
        count = 0
        for di in (-1, 0, 1):
            for dj in (-1, 0, 1):
                value = volume.at(i + di, j + dj, k)
                if not math.isnan(value):
                    total += value
                    squares += value * value
                    count += 1
        if count < 4:
            continue
        num_sum += round(total * total * scale)
        den_sum += round(count * squares * scale)
    return None if den_sum == 0 else float(1 - Fraction(num_sum, den_sum))


def statistics(triangle, volume):
    found = voxels(triangle, volume.dims)
    values = [v for v in (volume.at(*p) for p in found) if not math.isnan(v)]
    n = len(values)
    result = {"count": n, "nulls": len(found) - n}
    if n:
        s1 = sum(map(Fraction, values))
        s2 = sum(Fraction(v) ** 2 for v in values)
        result["mean"] = float(s1 / n)
        result["variance"] = float((n * s2 - s1 * s1) / (n * (n - 1))) if n > 1 else 0.0
        result["min"], result["max"] = min(values), max(values)
    result["discontinuity"] = discontinuity(found, volume)
    return result
