"""Cameras, in the frame that pictures are made in: metres east, north and up from the survey's centre."""
import dataclasses

import numpy

from .errors import Error

FILL = 0.86           # of the picture's width or height, at zoom 1
CONE_DEGREES = 28.0   # that fills the lesser of width and height
ROUND = (1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0)


class Scene:
    """From indices to scene metres. exaggeration: of heights (None: so that the box is about 0.6 as high as long).
    velocity: m/s, of a time survey (None: 1 ms is drawn as 1 m)."""

    def __init__(self, survey, exaggeration=None, velocity=None):
        self.survey = survey
        self.velocity = 2000.0 if velocity is None or survey.domain != "time" else float(velocity)
        self.exaggeration = 1.0
        self.exaggeration = self._pleasing() if exaggeration is None else float(exaggeration)

    def of_world(self, world):
        """(..., 3) X, Y, z -> (..., 3) metres east, north, up."""
        centre = self.survey.world_of((numpy.array(self.survey.shape) - 1) / 2)
        metres = self.survey.metres_of(numpy.asarray(world, dtype=float) - centre, self.velocity)
        return metres * numpy.array([1, 1, -self.exaggeration])

    def of_index(self, index):
        """(..., 3) i, j, k -> (..., 3) metres."""
        return self.of_world(self.survey.world_of(index))

    def corners(self):
        """(8, 3): of the voxels' box; bit 0 of the row is the far inline end, bit 1 crossline, bit 2 sample."""
        ends = numpy.array([[(row >> axis & 1) * self.survey.shape[axis] - 0.5 for axis in range(3)]
                            for row in range(8)])
        return self.of_index(ends)

    def placement(self, origin):
        """(linear (3, 3), shift (3,)): a volume that begins at index `origin`, from its indices to metres."""
        origin = numpy.asarray(origin, dtype=float)
        shift = self.of_index(origin)
        return (self.of_index(origin + numpy.eye(3)) - shift).T, shift

    def _pleasing(self):
        corners = self.corners()
        side = [numpy.linalg.norm(corners[row] - corners[0]) for row in (1, 2, 4)]
        wanted = 0.6 * max(side[:2]) / side[2]
        return min((1.0, *ROUND), key=lambda step: abs(numpy.log(step / wanted)))


@dataclasses.dataclass(frozen=True)
class Camera:
    """Where a picture is seen from: Camera(azimuth, elevation, zoom), or Camera.look_at(eye, target, up).

    azimuth: degrees, 0 looks north, clockwise. elevation: degrees above the horizon. zoom: 1 fits the survey's
    box. eye, target: metres east, north, up from the survey's centre.
    """
    azimuth: float = 30.0
    elevation: float = 25.0
    zoom: float = 1.0
    perspective: bool = True
    exaggeration: float = None
    velocity: float = None
    eye: tuple = None
    target: tuple = None
    up: tuple = (0.0, 0.0, 1.0)

    @classmethod
    def look_at(cls, eye, target, up=(0.0, 0.0, 1.0), **how):
        return cls(eye=tuple(map(float, eye)), target=tuple(map(float, target)), up=tuple(map(float, up)), **how)

    def view(self, survey, width, height):
        """What a picture of this size takes: a View."""
        if width < 1 or height < 1:
            raise Error("usage", f"a picture of {width} x {height} pixels cannot be drawn")
        scene = Scene(survey, self.exaggeration, self.velocity)
        if self.eye is not None:
            return self._towards(scene, width / height)
        return self._around(scene, width / height)

    def _around(self, scene, aspect):
        if not abs(self.elevation) <= 90 or not 0 < self.zoom < numpy.inf or not numpy.isfinite(self.azimuth):
            raise Error("usage", "a camera cannot look from there", "elevation is -90 to 90 degrees, zoom above 0")
        azimuth, elevation = numpy.radians([self.azimuth, self.elevation])
        forward = numpy.array([numpy.sin(azimuth) * numpy.cos(elevation), numpy.cos(azimuth) * numpy.cos(elevation),
                               -numpy.sin(elevation)])
        right = numpy.array([numpy.cos(azimuth), -numpy.sin(azimuth), 0.0])
        up = numpy.cross(right, forward)
        corners = scene.corners()
        centre = corners.mean(axis=0)
        radius = max(1e-6, numpy.linalg.norm(corners - centre, axis=1).max())
        distance = radius / numpy.sin(numpy.radians(CONE_DEGREES / 2))
        eye = centre - forward * distance
        along = (corners - eye) @ forward if self.perspective else numpy.ones(8)
        at = numpy.stack([(corners - eye) @ right / along, (corners - eye) @ up / along])
        half = numpy.maximum((at.max(axis=1) - at.min(axis=1)) / 2, 1e-12)
        scale = FILL * self.zoom * min(aspect / half[0], 1 / half[1])
        return View(scene, right, up, forward, eye, self.perspective, scale, aspect,
                    (at.max(axis=1) + at.min(axis=1)) / 2, distance - 2 * radius, distance + 3 * radius)

    def _towards(self, scene, aspect):
        eye, target, up = (numpy.array(place) for place in (self.eye, self.target, self.up))
        far = numpy.linalg.norm(target - eye)
        across = numpy.cross(target - eye, up)
        size = numpy.linalg.norm(across)
        if not (numpy.isfinite(far) and far > 0 and size > 1e-9 * far * numpy.linalg.norm(up)):
            raise Error("usage", "a camera cannot look there",
                        "eye and target are two places, up is not along the view")
        forward, right = (target - eye) / far, across / size
        half = numpy.tan(numpy.radians(CONE_DEGREES / 2))
        scale = 1 / (half if self.perspective else half * far) * min(1.0, aspect)
        corners = scene.corners()
        along = (corners - eye) @ forward
        box = max(1e-6, numpy.linalg.norm(corners - corners[0], axis=1).max())
        farthest = max(far, along.max()) + box
        nearest = along.min() - box / 2
        if self.perspective:
            nearest = max(nearest, farthest * 1e-3)
        return View(scene, right, numpy.cross(right, forward), forward, eye, self.perspective, scale, aspect,
                    numpy.zeros(2), nearest, farthest)


class View:
    """A camera with its picture's size: `scene`, the unit vectors `right`, `up`, `forward`, `eye`, `perspective`, and
    `matrix`, (4, 4) from scene metres to OpenGL clip space."""

    def __init__(self, scene, right, up, forward, eye, perspective, scale, aspect, middle, nearest, farthest):
        self.scene, self.right, self.up, self.forward, self.eye = scene, right, up, forward, eye
        self.perspective = perspective

        def row(axis, constant):
            return numpy.append(axis, constant - axis @ eye)

        depth = farthest - nearest
        if perspective:
            rows = [row((right - forward * middle[0]) * (scale / aspect), 0),
                    row((up - forward * middle[1]) * scale, 0),
                    row(forward * ((farthest + nearest) / depth), -2 * farthest * nearest / depth), row(forward, 0)]
        else:
            rows = [row(right * (scale / aspect), -middle[0] * scale / aspect), row(up * scale, -middle[1] * scale),
                    row(forward * (2 / depth), -(farthest + nearest) / depth), numpy.array([0.0, 0, 0, 1])]
        self.matrix = numpy.array(rows)
