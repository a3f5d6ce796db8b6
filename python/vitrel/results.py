"""Tables of results: arrays with errors and units."""

import json
from collections.abc import Mapping
from typing import NamedTuple, Optional

import numpy


class Column(NamedTuple):
    """One quantity, one value for each row of its table."""

    name: str
    unit: str  #: "1" for pure numbers
    value: numpy.ndarray
    error: Optional[numpy.ndarray]  #: standard errors, NaN where unknown; None if the column has none
    labels: list  #: what the values 0, 1, 2 … stand for, if they are codes

    def __array__(self, dtype=None):
        return numpy.asarray(self.value, dtype=dtype)


class Table(Mapping):
    """Columns by name.

    >>> msd = run.analyze()["displacements_all"]
    >>> msd["time"].value, msd["msd"].value, msd["msd"].error
    """

    def __init__(self, name, description, columns):
        self.name, self.description = name, description
        self._columns = {column.name: column for column in columns}

    def __getitem__(self, name):
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        rows = len(next(iter(self._columns.values())).value) if self._columns else 0
        return f"<Table {self.name}: {rows} rows of {', '.join(self)}>"

    def to_pandas(self):
        """A pandas.DataFrame; errors are columns `name_error`."""
        import pandas

        data = {}
        for column in self.values():
            data[column.name] = column.value
            if column.error is not None:
                data[f"{column.name}_error"] = column.error
        return pandas.DataFrame(data)

    def plot(self, *columns, axes=None):
        """Draws these columns, or the second one, against the first; returns the matplotlib axes."""
        from matplotlib import pyplot

        if axes is None:
            axes = pyplot.figure(layout="constrained").add_subplot()
        names = list(self)
        x = self[names[0]]
        for name in columns or names[1:2]:
            y = self[name]
            axes.errorbar(x.value, y.value, yerr=y.error, label=name, marker="o", markersize=3, linewidth=1)
        axes.set(xlabel=_with_unit(x), ylabel=_with_unit(self[name]) if len(columns) < 2 else "")
        if numpy.all(numpy.asarray(x.value)[1:] > 0) and x.name == "time":
            axes.set_xscale("log")
        if len(columns) > 1:
            axes.legend(frameon=False)
        return axes


def _with_unit(column):
    return column.name if column.unit == "1" else f"{column.name} / {column.unit}"


class Results(Mapping):
    """All tables of an analysis by name, and its summary."""

    def __init__(self, summary, tables):
        self.summary = json.loads(summary)
        self._tables = {name: Table(name, description, [Column(*column) for column in columns])
                        for name, description, columns in tables}

    def __getitem__(self, name):
        return self._tables[name]

    def __iter__(self):
        return iter(self._tables)

    def __len__(self):
        return len(self._tables)

    def __repr__(self):
        return f"<Results: {', '.join(self)}>"
