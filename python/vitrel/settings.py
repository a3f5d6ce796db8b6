"""From keyword arguments to keys of the parameter file (docs/parameters.md), and from its messages to words of Python."""

import contextlib
import inspect
import re
import tomllib
from typing import Any, Callable, Dict, Iterator, List, Mapping, Sequence, TypedDict, Union

from . import parameters
from ._vitrel import FileError, InvariantError, UserError
from .toml import Keys, members, objects, python_name, toml, unexpected


Drawn = Union[float, parameters.Gaussian, parameters.Lognormal, parameters.Uniform, parameters.PowerLaw, Keys, None]


class Shape(TypedDict, total=False):
    """Keys of the first species, which is the only one unless `species` is given, and `size_spread`, the relative width
    of a Gaussian distribution of sizes."""

    aspect_ratio: Drawn
    aspect_ratios: Union[Sequence[Any], None]
    size: Drawn
    size_spread: Union[float, None]
    first_semi_axis: Drawn
    semi_axes: Union[Sequence[Any], None]
    mass: Union[float, None]
    initial_temperature: Union[float, None]


class Sections(TypedDict, total=False):
    """Sections of the parameter file, by their names."""

    system: parameters.System
    species: Sequence[Union[parameters.Species, Keys]]
    prepare: parameters.Prepare
    dynamics: parameters.Dynamics
    analysis: parameters.Analysis
    import_: parameters.Import
    sweep: parameters.Sweep


class ParameterFile(Sections, total=False):
    """A whole parameter file."""

    output: parameters.Output


class PrepareSettings(parameters.Prepare, parameters.System, Shape, parameters.Output, Sections, total=False):
    """Keys of the sections [prepare], [system] and [output], of the first species, and all sections."""


class RunSettings(parameters.Dynamics, parameters.System, Shape, parameters.Output, parameters.Prepare, Sections, total=False):
    """Keys of the sections [dynamics], [system], [output] and [prepare], of the first species, and all sections."""


class SweepSettings(RunSettings, parameters.Sweep, total=False):
    """Those of `run`, and keys of the section [sweep]."""


class AnalysisSettings(parameters.Analysis, Sections, total=False):
    """Keys of the section [analysis], and all sections."""


# The sections whose keys need no prefix, for each function. The first section that has the key counts.
_RUN = ("dynamics", "system", "species", "output", "prepare")
_SECTIONS = {
    "prepare": ("prepare", "system", "species", "output"), "run": _RUN, "sweep": (*_RUN, "sweep"), "analyze": ("analysis",),
    "load": ("import_",), "read": ("import_",),
}


def _misspelt(parts: Sequence[str], hint: Any) -> List[str]:
    """All names that the first unknown part of a nested key might have been meant to be; none if every part is known."""
    for k, part in enumerate(parts):
        if part.isdigit():
            continue
        known = members(hint)
        if part not in known:
            return ["__".join([*parts[:k], name, *parts[k + 1:]]) for name in known]
        hint = known[part]
    return []


def _key(function: Callable[..., Any], name: str) -> str:
    """The dotted key that a keyword argument stands for, which has two underscores for every dot."""
    parts, candidates = [python_name(part) for part in name.split("__")], list(inspect.signature(function).parameters)
    for section in (*_SECTIONS[function.__name__], ""):
        misspelt = _misspelt(parts, members(ParameterFile)[section] if section else ParameterFile)
        if not misspelt:
            path = [section, "0", *parts] if section == "species" else [section, *parts] if section else parts
            return ".".join(part.removesuffix("_") for part in path)
        candidates += misspelt
    raise unexpected(function.__name__, name, [*candidates, "size_spread"])


def _values(function: Callable[..., Any], settings: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Dotted keys and values; of a whole section one by one, so that the others stay as they are."""
    for name, value in settings.items():
        if name == "size_spread" and "species" in _SECTIONS[function.__name__]:
            name, value = "size", None if value is None else parameters.Gaussian(mean=1.0, standard_deviation=value)
        key = _key(function, name)
        if key in ("sweep.grid", "sweep.together") and isinstance(value, Mapping):
            if twice := sorted(settings.keys() & value.keys()):
                raise UserError(f"{twice[0]} runs through the values of {name}; leave out one of the two")
            value = {inner if "." in inner else _key(function, inner): items for inner, items in value.items()}
        if python_name(key) in members(ParameterFile) and isinstance(value, Mapping):
            yield from _values(function, {f"{key}__{inner}": item for inner, item in value.items()})
        elif value is not None:
            yield key, value


def _words(message: str, function: Callable[..., Any], by_species: bool) -> str:
    """The message with arguments in the place of keys of the parameter file."""

    def argument(match: re.Match[str]) -> str:
        parts = match[2].split(".")
        if not match[1] and _misspelt([python_name(part) for part in parts], ParameterFile):
            return match[0]  # it is the name of a file
        known = _SECTIONS[function.__name__]
        if parts[:2] == ["species", "0"] and "species" in known and not by_species:
            parts = parts[2:]
        elif parts[0] != "species" and python_name(parts[0]) in known:
            parts = parts[1:]
        return re.sub(r"\.(\d+)", r"[\1]", ".".join(parts))

    sections = "|".join(name.removesuffix("_") for name in members(ParameterFile))
    message = re.sub(r"; write \[\[.*\]\]$", "", message)
    return re.sub(rf"\[*(?:(key ')|')?\b((?:{sections})(?:\.\w+)+)'?\]*", argument, message)


@contextlib.contextmanager
def assignments(function: Callable[..., Any], settings: Mapping[str, Any]) -> Iterator[List[str]]:
    """Assignments of keys of the parameter file from the keyword arguments of a function.

    An unknown argument is a TypeError. Errors of what is done with the assignments are put in the words of Python.
    """
    lines = [f"{key}={toml(value)}" for key, value in _values(function, settings)]
    try:
        yield lines
    except (UserError, FileError, InvariantError) as error:
        message = str(error).replace("--shrink", "shrink=True")
        for place in [*(f"--set {line}: " for line in lines), "parameters: "]:
            if message.startswith(place):
                message = _words(message.removeprefix(place), function, "species" in settings)
        if message == str(error):
            raise
        raise type(error)(message) from None


def from_toml(text: str) -> Dict[str, Any]:
    """The sections of a parameter file as keyword arguments, with objects for the tables in them.

    >>> vitrel.prepare(**vitrel.from_toml("[[prepare.stage]]\\nmethod = 'insert'\\npacking_fraction = 0.5"))
    """
    if not isinstance(text, str):
        raise UserError(f"text must be a string, not {type(text).__name__}")
    found: Dict[str, Any] = objects(tomllib.loads(text), ParameterFile)
    return found


def to_toml(sections: Mapping[str, Any]) -> str:
    """A parameter file with these sections, as `from_toml` gives them.

    >>> vitrel.to_toml({"prepare": {"stage": [vitrel.Insert(packing_fraction=0.5)]}})
    '[prepare]\\nstage = [{ method = "insert", packing_fraction = 0.5 }]\\n'
    """
    if not isinstance(sections, Mapping):
        raise UserError(f"sections must be a mapping, not {type(sections).__name__}")
    text = "".join(f"{name} = {toml(rows)}\n" for name, rows in sections.items() if not isinstance(rows, Mapping))
    for name, keys in sections.items():
        if isinstance(keys, Mapping):
            text += f"[{name.removesuffix('_')}]\n" + "".join(f"{key} = {toml(value)}\n" for key, value in keys.items())
    return text
