"""Arrays that functions are given."""

from typing import Any, Tuple

import numpy

from ._vitrel import UserError


def real(name: str, values: Any) -> numpy.ndarray:
    """The values as doubles. UserError, with the name of the argument, if they are not real numbers."""
    try:
        array = numpy.asarray(values)
        if array.dtype.kind in "biufO":
            return numpy.asarray(array, dtype=float)
        kind = f"values of the type {array.dtype}"
    except (TypeError, ValueError, OverflowError):
        kind = f"the contents of this {type(values).__name__}"
    raise UserError(f"{name} must be real numbers, not {kind}")


def real_rows(name: str, values: Any, entry: Tuple[int, ...]) -> numpy.ndarray:
    """The same, if the last dimensions are those of an entry."""
    array = real(name, values)
    if array.shape[array.ndim - len(entry):] != entry:
        raise UserError(f"{name} has the shape {array.shape}, but must have ({', '.join(map(str, ('N', *entry)))}) or {entry}")
    return array
