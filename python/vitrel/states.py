"""Configurations of particles."""

import contextlib
import functools
import os
import pathlib
import re
import tempfile
from typing import Iterator, Optional, Tuple, Union, Unpack

import numpy

from . import _vitrel
from .arrays import real
from .parameters import Import
from .progress import listener
from .settings import PrepareSettings, assignments


class State:
    """Particles in a periodic box: ellipses in the plane, or ellipsoids in space.

    Arrays are views, which cannot be written; a changed state is made from arrays (`State.from_arrays`).

    Attributes
    ----------
    position, velocity : numpy.ndarray, shape (N, D)
        The box is centred at the origin, and positions are inside; `unwrapped` has those that do not jump.
    angle : numpy.ndarray, shape (N,)
        Of the first semi-axis, in radians, unwrapped; in the plane.
    orientation : numpy.ndarray, shape (N, 4)
        Quaternions w, x, y, z from the axes of the body to those of space; in space.
    angular_velocity : numpy.ndarray, shape (N,) or (N, 3)
    semi_axes : numpy.ndarray, shape (N, D)
    mass, species : numpy.ndarray, shape (N,)
        Species are numbers in `species_names`.
    box : numpy.ndarray, shape (D,)
    """

    _ARRAYS = ("position", "image", "velocity", "angular_velocity", "mass", "species", "semi_axes", "angle", "orientation",
               "box", "species_names", "time")

    def __init__(self, state, parameters="", file=None):
        self._state, self.parameters, self._file = state, parameters, file

    def __getstate__(self):
        return self._state, self.parameters

    def __setstate__(self, state):
        self._state, self.parameters = state

    def __eq__(self, other):
        """Whether all numbers are the same to the last bit."""
        return (isinstance(other, State) and type(self._state) is type(other._state)
                and self._state.__getstate__() == other._state.__getstate__())

    __hash__ = None

    @classmethod
    def from_arrays(cls, position, semi_axes, box, *, angle=None, orientation=None, mass=None, velocity=None,
                    angular_velocity=None, species=None, time=0.0):
        """A state of these particles; arrays as the attributes of the class, `species` names.

        One shape, mass or species may stand for those of all. Positions may be anywhere. Without masses particles have
        the mass a b (in space a b c).
        """
        position = real("position", position)
        if position.ndim != 2 or position.shape[1] not in (2, 3):
            raise _vitrel.UserError(f"position has the shape {position.shape}, but must have (N, 2) in the plane, (N, 3) in space")
        count, dimension = position.shape
        rows = functools.partial(_rows, count, dimension)
        if isinstance(species, str):
            species = [species] * count
        turns = () if dimension == 2 else (3,)
        state = _vitrel.state_from_arrays(
            dimension, position, _rows(None, dimension, "box", box, (dimension,)), rows("semi_axes", semi_axes, (dimension,)),
            rows("angle", angle, ()), rows("orientation", orientation, (4,)), rows("mass", mass, ()),
            rows("velocity", velocity, (dimension,)), rows("angular_velocity", angular_velocity, turns),
            None if species is None else list(map(str, species)), float(time))
        return cls(state)

    def __getattr__(self, name):
        if name in State._ARRAYS:
            return getattr(self._state, name)
        raise AttributeError(f"State has no attribute '{name}'")

    def __dir__(self):
        return [*super().__dir__(), *(name for name in State._ARRAYS if hasattr(self._state, name))]

    def __len__(self):
        return len(self._state)

    def __repr__(self):
        return f"<State: {len(self)} particles in {self.dimension} dimensions, packing fraction {self.packing_fraction:.6g}>"

    @property
    def dimension(self):
        return self.position.shape[1]

    @property
    def packing_fraction(self):
        return self._state.packing_fraction()

    @property
    def unwrapped(self):
        """Positions that do not jump by box lengths, shape (N, D)."""
        return self.position + self.image * self.box

    def check(self):
        """The exact check: `overlaps`, pairs (M, 2) of particles that overlap, and `smallest_gap`."""
        return self._state.check()

    def write(self, path, overwrite=False):
        """Writes the state.

        Parameters
        ----------
        path : path
            The suffix says the format: .h5, which `vitrel run --from` and `vitrel.read` take, or one of `Run.export`.
        overwrite : bool
            Replaces a file that exists; of .h5.
        """
        path = pathlib.Path(path)
        if path.suffix in ("", ".h5", ".h5md", ".hdf5"):
            self._state.write(os.fspath(path), self.parameters, overwrite)
            return
        if overwrite:
            raise _vitrel.UserError("overwrite is for .h5; files in other formats must not exist")
        with start_file(self) as file:
            export_file(file, path, self.dimension)

    def shrunk(self):
        """The same with semi-axes so small that no particles overlap."""
        return prepare(start=self, shrink=True, quiet=True)

    def _colours(self, colour):
        """Red, green and blue from 0 to 255, shape (N, 3)."""
        if colour is None or isinstance(colour, str):
            return _vitrel.particle_colours(self._state, "orientation" if colour == "angle" else colour or "")
        numbers = real("colour", colour)
        if numbers.shape != (len(self),) or not numpy.isfinite(numbers).all():
            raise _vitrel.UserError(f"colour must be a name or an array of finite numbers of the shape ({len(self)},)")
        return _vitrel.number_colours(numbers)

    def picture(self, colour=None, *, width=1000, azimuth=304, elevation=24, whole=False):
        """A picture as `vitrel picture` draws it: red, green and blue from 0 to 255, an array of the shape (height, width, 3).

        Parameters
        ----------
        colour : str or array of one number for each particle
            "orientation", "species", "size", in the plane "psi6", or numbers, from dark blue to yellow. By default the
            orientation, or the species if all particles are round.
        width : int
            In pixels.
        azimuth, elevation : float
            Where the camera is, in degrees; in space.
        whole : bool
            Every particle once and whole, not all images cut at the faces of the box; in space.
        """
        if not 2 <= width <= 20000:
            raise _vitrel.UserError(f"width is {width}, but must be between 2 and 20000 pixels")
        view = () if self.dimension == 2 else (azimuth, elevation, whole)
        return _vitrel.picture(self._state, self._colours(colour), width, *view)

    def draw(self, axes=None, colour=None, **view):
        """Draws the state with its periodic images; returns the matplotlib axes.

        Ellipses are vectors, and ellipsoids a `picture`, which says what `colour` may be and what else there is for space.
        """
        from matplotlib import collections, pyplot

        if axes is None:
            axes = pyplot.figure(figsize=(6, 6), layout="constrained").add_subplot()
        if self.dimension == 3:
            axes.imshow(self.picture(colour, **view))
            axes.set_axis_off()
            return axes
        if view:
            raise _vitrel.UserError(f"{', '.join(view)}: for states in space; in the plane, ellipses are vectors")
        shifts = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        centres = numpy.concatenate([self.position + numpy.asarray(shift) * self.box for shift in shifts])
        reach = numpy.tile(self.semi_axes[:, 0], len(shifts))
        near = (numpy.abs(centres) < self.box / 2 + reach[:, None]).all(axis=1)
        times = len(shifts)
        ellipses = collections.EllipseCollection(
            2 * numpy.tile(self.semi_axes[:, 0], times)[near], 2 * numpy.tile(self.semi_axes[:, 1], times)[near],
            numpy.degrees(numpy.tile(self.angle, times)[near]), units="xy", offsets=centres[near],
            offset_transform=axes.transData, facecolors=numpy.tile(self._colours(colour) / 255, (times, 1))[near],
            edgecolors="black", linewidths=0.3)
        axes.add_collection(ellipses)
        half = self.box / 2
        axes.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]), aspect="equal", xticks=[], yticks=[])
        return axes


def _rows(count, dimension, name, values, shape):
    """An array with an entry of this shape for every particle, of which one may stand for all."""
    if values is None:
        return None
    array = real(name, values)
    wanted = shape if count is None else (count, *shape)
    try:
        if array.ndim in (len(shape), len(wanted)) or array.ndim == 0:
            return numpy.broadcast_to(array, wanted)
    except ValueError:
        pass
    one = "" if count is None else f", or {shape} for all" if shape else ", or be one number for all"
    place = "the plane" if dimension == 2 else "space"
    raise _vitrel.UserError(f"{name} has the shape {array.shape}, but must have {wanted}{one}: positions are those of {place}")


def export_file(source, path, dimension, format=None, frames=None, shrink=None, voxels=None, images=False, imports=()):
    """Writes a run or state on file in another format, by default the one that the suffix names."""
    suffix = pathlib.Path(path).suffix.lstrip(".")
    name, formats = format or {"dat": "xytheta"}.get(suffix, suffix), _vitrel.export_formats(dimension)
    if name not in formats:
        place = "the plane" if dimension == 2 else "space"
        raise _vitrel.UserError(f"{path}: '{name}' is no format for states in {place}; possible are {', '.join(formats)}")
    _vitrel.export_file(source, path, name, frames, shrink, voxels, images, imports)


Start = Union[State, str, "os.PathLike[str]", None]
Path = Union[str, "os.PathLike[str]"]


@contextlib.contextmanager
def start_file(start: Start) -> Iterator[Optional[str]]:
    """The file of a state to start from, for as long as it is needed; None if there is none."""
    if not isinstance(start, State):
        yield None if start is None else os.fspath(start)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "state.h5")
        start.write(path)
        try:
            yield path
        except (_vitrel.UserError, _vitrel.FileError, _vitrel.InvariantError) as error:
            raise type(error)(re.sub(rf"(--from )?{re.escape(path)}", "start", str(error))) from None


def start_and_parameters(start: Start, file: Optional[Path]) -> Tuple[Start, str]:
    """What is called `start` may be the parameter file. Its path is empty if there is none."""
    if start is None or isinstance(start, State) or not os.fspath(start).endswith(".toml"):
        return start, "" if file is None else os.fspath(file)
    if file is not None:
        raise TypeError("start is a parameter file, and so is file; give one of them")
    return None, os.fspath(start)


def prepare(start: Start = None, file: Optional[Path] = None, *, shrink: bool = False, threads: int = 1, quiet: bool = False,
            **settings: Unpack[PrepareSettings]) -> State:
    """Prepares a state.

    Parameters
    ----------
    start : State or path, optional
        A state to start from, instead of inserting particles; or a parameter file, whose name ends with .toml.
    file : path, optional
        A parameter file; without one, all keys have their defaults.
    shrink : bool
        Shrinks that state until no particles overlap.
    **settings
        Keys of the parameter file (`vitrel.settings.PrepareSettings`): those of `[prepare]`, `[system]` and `[output]`
        (`vitrel.parameters.Prepare`, …), those of the one species, such as `aspect_ratio`, `semi_axes`, `size` and
        `size_spread` (the standard deviation of a Gaussian distribution), and any other by a mapping for its section or
        with two underscores for every dot: ``prepare(dynamics={"duration": 10})``, ``prepare(dynamics__duration=10)``.

    Returns
    -------
    State
    """
    say, show, end = listener(quiet)
    start, file = start_and_parameters(start, file)
    with start_file(start) as path, contextlib.closing(end), assignments(prepare, settings) as lines:
        state, parameters = _vitrel.prepare(file, lines, path, shrink, threads, say, show)
    return State(state, parameters)


def read(path: Path, frame: int = -1, **settings: Unpack[Import]) -> State:
    """A state from a file of any format that `vitrel prepare --from` reads; of a trajectory this frame.

    `settings` are keys of `[import]` (`vitrel.parameters.Import`), for files of other programs:
    ``read("state.csv", length_unit=1e-6)``.
    """
    with assignments(read, settings) as lines:
        frames = _vitrel.Frames(os.fspath(path), lines)
        return State(frames[frame if frame >= 0 else len(frames) + frame], frames.parameters)
