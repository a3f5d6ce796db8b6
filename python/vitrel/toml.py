"""Tables of the parameter file as Python objects, and as TOML text."""

from __future__ import annotations

import dataclasses
import difflib
import functools
import json
import keyword
import os
import re
import tomllib
import typing
from typing import Any, Callable, ClassVar, Iterable, Iterator, Mapping, Optional, Sequence, TypeVar, Union

from numpy.typing import NDArray

from ._vitrel import UserError

Array = NDArray[Any]
Numbers = Union[Sequence[float], Array]
Keys = Mapping[str, Any]
Table = TypeVar("Table", bound="Setting")


def toml(value: Any) -> str:
    """A value as TOML text."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value if abs(value) < 2**63 else float(value))
    if isinstance(value, Setting):
        value = value.to_dict()
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(str(key))} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return "[" + ", ".join(map(toml, value)) + "]"
    raise TypeError(f"{value!r} cannot be the value of a parameter; numbers, strings, sequences and mappings can")


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def suggestion(name: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown name: the nearest that is known, if there is one."""
    nearest = difflib.get_close_matches(name, known, 1)
    return f"; did you mean '{nearest[0]}'?" if nearest else ""


def unexpected(function: str, name: str, known: Iterable[str]) -> TypeError:
    """What Python says of an unknown keyword argument, with the nearest that is known."""
    return TypeError(f"{function}() got an unexpected keyword argument '{name}'{suggestion(name, known)}")


class Setting:
    """A table of the parameter file, with its keys as attributes. Values that are the default are left to it."""

    _form: ClassVar[Optional[tuple[str, str]]] = None  # the key and the word that select this form of the table

    def __new__(cls, **settings: Any) -> Any:
        for name in settings:
            if name not in cls.__annotations__:
                raise unexpected(cls.__name__, name, members(cls))
        return super().__new__(cls)

    def to_dict(self) -> dict[str, Any]:
        """The keys of the parameter file."""
        found: dict[str, Any] = dict([self._form] if self._form else [])
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if type(value) is not type(field.default) or value != field.default:
                found[field.name.removesuffix("_")] = value
        return found

    def to_toml(self) -> str:
        """The keys as lines of TOML."""
        return "".join(f"{key} = {toml(value)}\n" for key, value in self.to_dict().items())

    @classmethod
    def from_dict(cls: type[Table], keys: Keys) -> Table:
        """The table with these keys of the parameter file."""
        form, given = cls._form, dict(keys)
        if form and given.pop(form[0], form[1]) != form[1]:
            raise UserError(f"{form[0]} is {keys[form[0]]!r}, but that of {cls.__name__} is {form[1]!r}")
        known = members(cls)
        return cls(**{name: objects(value, known.get(name)) for name, value in python_names(given)})

    @classmethod
    def from_toml(cls: type[Table], text: str) -> Table:
        """The table with the keys in this TOML text."""
        return cls.from_dict(tomllib.loads(text))


def python_name(key: str) -> str:
    """The key, or with an underscore what Python itself knows: `import_`, `from_`."""
    return key + "_" if keyword.iskeyword(key) else key


def python_names(keys: Keys) -> Iterator[tuple[str, Any]]:
    return ((python_name(key), value) for key, value in keys.items())


def tables(hint: Any) -> Iterator[Any]:
    """The classes of tables in a type."""
    if isinstance(hint, type) and (typing.is_typeddict(hint) or issubclass(hint, Setting)):
        yield hint
    for part in typing.get_args(hint):
        yield from tables(part)


def _members(hint: Any) -> dict[str, Any]:
    """The keys of all tables in a type, with their types."""
    found: dict[str, Any] = {}
    for table in tables(hint):
        found |= typing.get_type_hints(table)
        if form := getattr(table, "_form", None):
            found[form[0]] = str
    found.pop("_form", None)
    return found


members: Callable[[Any], dict[str, Any]] = functools.cache(_members)


def objects(value: Any, hint: Any) -> Any:
    """Tables in a value of a parameter file as the classes that the type names."""
    if isinstance(value, list):
        return [objects(item, hint) for item in value]
    if not isinstance(value, dict):
        return value
    for table in tables(hint):
        if typing.is_typeddict(table):
            return {name: objects(item, members(table).get(name)) for name, item in python_names(value)}
        if table._form is None or value.get(table._form[0]) == table._form[1]:
            return table.from_dict(value)
    return value
