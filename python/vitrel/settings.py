"""From keyword arguments to keys of the parameter file (docs/parameters.md)."""

import sys

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
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value)


def overrides(section, settings):
    """Assignments of keys: short names, keys of `section`, and any key with two underscores for every dot."""
    lines = []
    for name, value in settings.items():
        if value is None:
            continue
        if name == "size_spread":
            name = "species__0__size"
            value = {"distribution": "gaussian", "mean": 1.0, "standard_deviation": float(value)}
        key = SHORT.get(name) or (name.replace("__", ".") if "__" in name else f"{section}.{name}")
        lines.append(f"{key}={toml(value)}")
    return lines


def listener(quiet):
    """The callbacks of a piece of work: lines about its steps, and its progress, on a terminal."""
    if quiet or not sys.stderr.isatty():
        return None, None

    def say(line):
        print(f"\r\033[K{line}", file=sys.stderr)

    def show(fraction, quantity, value):
        print(f"\r\033[K{100 * fraction:5.1f} %  {quantity} {value:.6g}", end="", file=sys.stderr, flush=True)

    return say, show
