"""Two hard bodies, for arrays of pairs at once."""

import os
from typing import NamedTuple, Optional

import numpy

from . import _vitrel
from .arrays import real, real_rows
from .toml import toml


class Bodies:
    """N ellipses or ellipsoids in free flight.

    Every array may be that of a single body, without the first dimension: all N are then alike.

    Parameters
    ----------
    semi_axes : array_like, shape (N, 2) or (N, 3)
        In the plane in descending order. Two numbers are ellipses, three are ellipsoids.
    position : array_like, shape (N, 2) or (N, 3)
    angle : array_like, shape (N,), optional
        Of the first semi-axis, in radians; of ellipses.
    orientation : array_like, shape (N, 4), optional
        Unit quaternions w, x, y, z from the axes of the body to those of space; of ellipsoids.
    velocity : array_like, shape (N, 2) or (N, 3), optional
    angular_velocity : array_like, shape (N,) or (N, 3), optional
        In the axes of space.
    """

    def __init__(self, semi_axes, position, *, angle=0.0, orientation=(1.0, 0.0, 0.0, 0.0), velocity=None,
                 angular_velocity=None):
        semi_axes = numpy.atleast_1d(real("semi_axes", semi_axes))
        self.dimension = semi_axes.shape[-1]
        if self.dimension not in (2, 3):
            raise _vitrel.UserError("semi_axes must be two numbers, of ellipses, or three, of ellipsoids")
        in_plane = self.dimension == 2
        still = numpy.zeros(self.dimension)
        at_rest = numpy.zeros(() if in_plane else 3)
        rows = {"semi_axes": semi_axes, "position": position, **({"angle": angle} if in_plane else {"orientation": orientation}),
                "velocity": still if velocity is None else velocity,
                "angular_velocity": at_rest if angular_velocity is None else angular_velocity}
        entries = [still.shape, still.shape, () if in_plane else (4,), still.shape, at_rest.shape]
        arrays = [real_rows(name, values, entry) for (name, values), entry in zip(rows.items(), entries)]
        counts = [array.shape[:array.ndim - len(entry)] for array, entry in zip(arrays, entries)]
        try:
            count = numpy.broadcast_shapes((1,), *counts)
        except ValueError:
            shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(rows, arrays))
            raise _vitrel.UserError(f"all arrays must be for the same number of bodies, but their shapes are: {shapes}") from None
        kind = _vitrel.Ellipses if in_plane else _vitrel.Ellipsoids
        self._bodies = kind(*(numpy.broadcast_to(array, count + entry) for array, entry in zip(arrays, entries)))

    def __len__(self):
        return len(self._bodies)


def _both(*bodies):
    for given in bodies:
        if not isinstance(given, Bodies):
            raise _vitrel.UserError(f"one and two must be objects of vitrel.Bodies, not {type(given).__name__}")
    return [given._bodies for given in bodies]


def overlap(one: Bodies, two: Bodies, box: Optional[numpy.ndarray] = None) -> numpy.ndarray:
    """Whether each pair overlaps, by the exact criterion; a touch is no overlap.

    Parameters
    ----------
    one, two : Bodies
        As many of both.
    box : array_like, shape (2,) or (3,), optional
        Lengths of a periodic box: any image of the second body counts.

    Returns
    -------
    numpy.ndarray of bool, shape (N,)
    """
    return _vitrel.overlap(*_both(one, two), box)


class Gap(NamedTuple):
    """Distances of surfaces. Normal and points are NaN where the bodies overlap."""

    gap: numpy.ndarray  #: (N,), minus the depth if the bodies overlap
    normal: numpy.ndarray  #: (N, D), unit vectors from the first body to the second
    point_1: numpy.ndarray  #: (N, D), the closest point of the first body
    point_2: numpy.ndarray  #: (N, D), the closest point of the second body


def gap(one: Bodies, two: Bodies, box: Optional[numpy.ndarray] = None) -> Gap:
    """The distance of the surfaces of each pair, to rounding; arguments as of `overlap`."""
    return Gap(*_vitrel.gap(*_both(one, two), box))


class Contact(NamedTuple):
    """First contacts. Normal and point are NaN where there is none."""

    time: numpy.ndarray  #: (N,), infinite if there is none before the horizon, NaN if the bodies overlap at the start
    normal: numpy.ndarray  #: (N, D), unit vectors from the first body to the second
    point: numpy.ndarray  #: (N, D)


def first_contact(one: Bodies, two: Bodies, horizon: float, box: Optional[numpy.ndarray] = None) -> Contact:
    """When each pair touches first in free flight, up to `horizon`; other arguments as of `overlap`."""
    return Contact(*_vitrel.first_contact(*_both(one, two), box, horizon))


class Restitution(NamedTuple):
    """The restitution matrix of soft spheres: how distance, angle, time and rate change in a collision."""

    distance: numpy.ndarray  #: (N,), ε_r, the distance of the centres at the end over that at first contact
    angle: numpy.ndarray  #: (N,), ε_φ, the angle by which the line of centres turns, rad
    duration: numpy.ndarray  #: (N,), ε_t, the duration in units of the time scale of the force
    rate: numpy.ndarray  #: (N,), ε_ṙ < 0, the normal speed at the end over that at first contact
    time: numpy.ndarray  #: (N,), the duration in seconds


def restitution(speed, impact_parameter=0.0, second_radius=None, file=None, **contact) -> Restitution:
    """Integrates collisions of two soft spheres.

    Parameters
    ----------
    speed : array_like, shape (N,)
        Of the relative velocity of the centres at first contact, m/s.
    impact_parameter : array_like, shape (N,), optional
        Over the sum of the radii; 0 is head-on, 1 grazing.
    second_radius : array_like, shape (N,), optional
        m, of the same density; by default that of the first sphere.
    file : path, optional
        A parameter file with `[dynamics.contact]`.
    **contact
        Keys of `[dynamics.contact]`: the material.
    """
    named = {"speed": speed, "impact_parameter": impact_parameter, "second_radius": second_radius}
    given = [real(name, values) for name, values in named.items() if values is not None]
    rows = numpy.broadcast_arrays(numpy.zeros(1), *given)[1:]
    radii = rows[2] if second_radius is not None else None
    lines = [f"{key.replace('__', '.')}={toml(value)}" for key, value in contact.items()]
    return Restitution(*_vitrel.restitution("" if file is None else os.fspath(file), lines, rows[0], rows[1], radii).T)
