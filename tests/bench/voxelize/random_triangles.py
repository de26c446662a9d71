"""Prints N random triangles of a mean area in voxels^2, uniform in orientation, as `footwall bench voxelize` reads them.

python3 random_triangles.py [N [MEAN_AREA [SEED]]]    (default 512 10000 2007)
"""
import math
import random
import sys

count, mean_area, seed = (type_(text) for type_, text in zip((int, float, int), (sys.argv[1:] + ["512", "10000", "2007"][len(sys.argv) - 1:])))
source = random.Random(seed)


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def triangle():
    """A random shape without slivers, on a random plane, of area 0.5 to 1.5 times the mean."""
    while True:
        angles = sorted(source.uniform(0, 2 * math.pi) for _ in range(3))
        gaps = [angles[1] - angles[0], angles[2] - angles[1], 2 * math.pi - angles[2] + angles[0]]
        if min(gaps) > 0.5:
            break
    a = unit([source.gauss(0, 1) for _ in range(3)])
    b = [source.gauss(0, 1) for _ in range(3)]
    along = sum(x * y for x, y in zip(a, b))
    b = unit([y - along * x for x, y in zip(a, b)])
    area = 0.5 * abs(sum(math.sin(g) for g in gaps))
    size = math.sqrt(mean_area * source.uniform(0.5, 1.5) / area)
    centre = [source.uniform(0, 100) + 3 * size for _ in range(3)]
    return [centre[k] + size * (math.cos(t) * a[k] + math.sin(t) * b[k]) for t in angles for k in range(3)]


for _ in range(count):
    print(",".join(f"{x:.4f}" for x in triangle()))
