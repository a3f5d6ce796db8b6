"""From keyword arguments to keys of the parameter file (docs/parameters.md)."""

import sys

SECTIONS = {"system", "species", "prepare", "dynamics", "output", "analysis", "import", "sweep"}

# Short names of keys that every study sets.
SHORT = {
    "particles": "system.particles", "packing_fraction": "system.packing_fraction", "dimension": "system.dimension",
    "seed": "system.seed", "aspect_ratio": "species.0.aspect_ratio", "semi_axes": "species.0.semi_axes",
    "samples": "output.samples", "correlations": "output.correlations",
}


def toml(value):
    """A value as TOML text."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return f'"{escaped}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{toml(str(key))} = {toml(item)}" for key, item in value.items()) + " }"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value)


def key_of(section, name):
    """The dotted key that a keyword argument stands for, which has two underscores for every dot."""
    first, *others = name.split("__")
    if first in SHORT:
        first = SHORT[first]
    elif first not in SECTIONS:
        first = f"{section}.{first}"
    return ".".join([first, *others])


def overrides(section, settings):
    """Assignments of keys: short names, keys of `section`, and keys that begin with any section."""
    lines = []
    for name, value in settings.items():
        if value is None:
            continue
        if name == "size_spread":
            name, value = "species__0__size", {"distribution": "gaussian", "mean": 1.0, "standard_deviation": float(value)}
        lines.append(f"{key_of(section, name)}={toml(value)}")
    return lines


class _Line:
    """The last line of the terminal, taken off again when the work ends."""

    def __init__(self, stream):
        self._stream = stream

    def say(self, line):
        print(f"\r\033[K{line}", file=self._stream)

    def show(self, fraction, quantity, value):
        print(f"\r\033[K{100 * fraction:5.1f} %  {quantity} {value:.6g}", end="", file=self._stream, flush=True)

    def close(self):
        print("\r\033[K", end="", file=self._stream, flush=True)


class _Nothing:
    def close(self):
        pass


def listener(quiet):
    """The callbacks of a piece of work, on a terminal: lines about its steps, its progress, and what is closed at its end."""
    if quiet or not sys.stderr.isatty():
        return None, None, _Nothing()
    line = _Line(sys.stderr)
    return line.say, line.show, line
