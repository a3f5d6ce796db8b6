"""Tables of results: arrays with errors and units, and the charts that show them."""

import functools
import html
import json
import math
import re
from collections.abc import Mapping
from typing import Dict, Iterable, Iterator, List, Optional, TypeVar

import numpy

from . import _vitrel
from .toml import suggestion

_ROWS_SHOWN = 10  # of a table, in a notebook


class Column:
    """One quantity, one value for each row of its table.

    Attributes
    ----------
    name : str
    unit : str
        "1" for pure numbers.
    value : numpy.ndarray, shape (rows,)
    error : numpy.ndarray, shape (rows,), or None
        Standard errors, NaN where unknown; None if the column has none.
    labels : list of str
        What the values 0, 1, 2 … stand for, if they are codes.
    table : Table
    """

    def __init__(self, name, unit, value, error=None, labels=()):
        self.name, self.unit, self.value, self.error, self.labels = name, unit, value, error, list(labels)
        self.table: Optional["Table"] = None

    def __array__(self, dtype=None, copy=None):
        array = numpy.asarray(self.value, dtype=dtype)
        return array.copy() if copy else array

    def __len__(self) -> int:
        return len(self.value)

    def __getitem__(self, rows):
        return self.value[rows]

    def __repr__(self) -> str:
        return f"<Column {self.name} / {self.unit}: {self.value!r}>"

    @property
    def texts(self) -> List[Optional[str]]:
        """What the codes stand for, None where a code is not known."""
        return [self.labels[int(code)] if code == code else None for code in self.value]

    def to_pandas(self):
        """A pandas.Series over the first column of the table."""
        return self.table.to_pandas().set_index(next(iter(self.table)))[self.name]

    def plot(self, axes=None, **style):
        """Draws the column as `Table.plot` does."""
        return self.table.plot(self.name, axes=axes, **style)


_Item = TypeVar("_Item", Column, "Table")


class _ByName(Mapping[str, _Item]):
    """What is found by its attribute `name`, in the order given."""

    def __init__(self, items: Iterable[_Item]):
        self._items: Dict[str, _Item] = {item.name: item for item in items}

    def __getitem__(self, name: str) -> _Item:
        if name not in self:
            raise KeyError(f"{name!r} is none of {', '.join(self)}{suggestion(str(name), self)}")
        return self._items[name]

    def __contains__(self, name: object) -> bool:
        return name in self._items

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def _ipython_key_completions_(self) -> List[str]:
        return list(self)


class Table(_ByName[Column]):
    """Columns by name.

    >>> msd = run.results["displacements_all"]
    >>> msd["time"].value, msd["msd"].value, msd["msd"].error
    """

    def __init__(self, name, description, columns, dimension=2):
        self.name, self.description, self.dimension = name, description, dimension
        self.results: Optional["Results"] = None
        super().__init__(columns)
        for column in columns:
            column.table = self

    def __repr__(self) -> str:
        return f"<Table {self.name}: {self._rows} rows of {', '.join(self)}>"

    @property
    def _rows(self) -> int:
        return len(next(iter(self.values()))) if self else 0

    def _repr_html_(self) -> str:
        """The first rows, with errors."""
        names = [f"{column.name} / {column.unit}" if column.unit not in ("", "1") else column.name for column in self.values()]
        rows = [[_cell(column, row) for column in self.values()] for row in range(min(_ROWS_SHOWN, self._rows))]
        more = self._rows - len(rows)
        return (f"<p><b>{html.escape(self.name)}</b>: {html.escape(self.description)}</p>" + _html_table(names, rows)
                + (f"<p>… and {more} more rows</p>" if more else ""))

    def to_pandas(self):
        """A pandas.DataFrame. Errors are columns `name_error`; codes are their labels."""
        import pandas

        data = {}
        for column in self.values():
            data[column.name] = column.texts if column.labels else column.value
            if column.error is not None:
                data[f"{column.name}_error"] = column.error
        return pandas.DataFrame(data)

    def plot(self, *columns, x: Optional[str] = None, axes=None, **style):
        """Draws columns with their errors, with the axes that the report page gives them.

        Parameters
        ----------
        *columns : str
            By default the second column of the table.
        x : str, optional
            The abscissa; by default the first column of the table.
        axes : matplotlib.axes.Axes, optional
        **style
            Of matplotlib's `errorbar`.

        Returns
        -------
        matplotlib.axes.Axes
        """
        names = list(self)
        columns = columns or tuple(names[1:2])
        found = {name: of_column[0] for name in columns if (of_column := charts(self, name))}
        chart = next(iter(found.values()), None)
        if chart is None:
            chart = Chart(self, {"symbol": columns[0] if len(columns) == 1 else "", "x": names[0], "xSymbol": names[0]}, {})
        elif not chart.labels.keys() >= set(columns):  # they come from several charts, so each has its own symbol
            chart = Chart(self, {**chart.description, "symbol": ""},
                          {name: found[name].description["symbol"] if name in found else name for name in columns})
        if x is not None:
            chart = Chart(self, {**chart.description, "x": x, "xSymbol": x, "logX": False}, chart.labels)
        return chart.plot(axes, columns, **style)

    def _study(self):
        """Of jobs of a sweep: the column that charts run along, and those that tell curves apart."""
        provenance = self.results.provenance if self.results else {}
        return provenance.get("axis", "packing_fraction"), [name for name in provenance.get("series", "").split(",") if name]


class Chart:
    """Curves of one table that belong together, as the report page shows them.

    Attributes
    ----------
    heading : str
    table : Table
    labels : dict
        Columns and the names of their curves.
    """

    def __init__(self, table, description, labels):
        self.table, self.description, self.labels = table, description, labels

    @property
    def heading(self) -> str:
        return self.description["heading"]

    def __repr__(self) -> str:
        return f"<Chart {self.heading}: {', '.join(self.labels)} of {self.table.name}>"

    def plot(self, axes=None, columns=None, **style):
        """Draws all curves, or these columns; returns the matplotlib axes.

        `style` is of matplotlib's `errorbar`. A `label` is that of the only curve, or comes before those of several.
        """
        axes = _axes(axes)
        label_of_all = style.pop("label", None)
        x = self.table[self.description["x"]]
        columns = columns or list(self.labels)
        curves = [(name, *curve) for name in columns for curve in self._curves(name)]
        for name, label, rows in curves:
            column = self.table[name]
            if label_of_all is not None:
                label = label_of_all if len(curves) == 1 else f"{label_of_all}, {label}"
            axes.errorbar(numpy.asarray(x.texts if x.labels else x.value)[rows], column.value[rows],
                          yerr=None if column.error is None else numpy.nan_to_num(column.error[rows], posinf=0), label=label,
                          **{"marker": "o", "markersize": 3, "linewidth": 1, **style})
        for level in self.description.get("levels", []):
            axes.axhline(level, color="0.6", linewidth=0.8, zorder=0)
        symbol = self.description["symbol"]
        axes.set(xlabel=self._label(self.description["xSymbol"], x.unit),
                 ylabel=self._label(symbol, self.table[columns[0]].unit) if symbol else "")
        self._scale(axes)
        if len(curves) > 1 or label_of_all is not None:
            axes.legend(frameon=False)
        return axes

    def _curves(self, name):
        """Labels and rows: one curve, or of a sweep one for every combination of what tells curves apart."""
        series = self.table._study()[1] if self.description.get("section") == "study" else []
        rows = {}
        for row in range(len(self.table[name])):
            texts = [f"{key} = {column.texts[row] if column.labels else format(column.value[row], 'g')}"
                     for key, column in ((key, self.table[key]) for key in series)]
            rows.setdefault(", ".join(texts), []).append(row)
        return [(label or self.labels.get(name, name), chosen) for label, chosen in rows.items()]

    def _label(self, symbol, unit):
        unit = _vitrel.unit_name(unit, self.table.dimension)
        return f"{symbol} / {unit}" if unit else symbol

    def _scale(self, axes):
        if self.description.get("logX"):
            axes.set_xscale("log")
        scale = self.description.get("scale")
        if scale == "logarithmic":
            axes.set_yscale("log")
        elif scale in ("fromZero", "aroundOne"):
            axes.set_ylim(bottom=0, auto=True)  # because the next curve may be higher


def charts(table, column=None):
    """The charts of a table; only those that show this column, if there is one."""
    found = []
    for description in _descriptions(table.dimension):
        if not _is_of(table.name, description):
            continue
        labels = _labels(table, description)
        if description["section"] == "study":
            axis = table._study()[0]
            description = {**description, "x": axis, "xSymbol": axis.replace("_", " ")}
        if labels and description["x"] in table and (column is None or column in labels):
            found.append(Chart(table, description, labels))
    return found


@functools.lru_cache(maxsize=None)
def _descriptions(dimension):
    return json.loads(_vitrel.charts(dimension))


def plain_columns(dimension):
    """Names of the columns that charts of a run show, but for those with numbers in them."""
    return sorted({curve["column"] for description in _descriptions(dimension) if description["section"] != "study"
                   for curve in description["curves"] if curve["column"].isidentifier()})


def _is_of(table, description):
    """Charts of studies show one number of every job of a sweep, or its average over seeds."""
    if description["section"] == "study":
        return table in ("runs", "seeds")
    name = description["table"]
    return table.startswith(name + "_") if description["hasGroups"] else table == name


def _labels(table, description):
    """Columns of the chart, and what their curves are called; `#` stands for a number, `*` for a text."""
    labels = {}
    for curve in description["curves"]:
        pattern = re.escape(curve["column"]).replace(r"\#", r"(\d+)").replace(r"\*", "(.+)")
        for name in table:
            if match := re.fullmatch(pattern, name):
                text = _placeholder(table, description, match[1]) if match.groups() else ""
                labels.setdefault(name, re.sub("[#*]", text, curve["label"]))
    return labels


def _placeholder(table, description, text):
    """What a number in the name of a column stands for: a wave number or a waiting time."""
    if not text.isdecimal():
        return text.replace("_", "–")
    numbers = description["numbers"]
    found = table.results and numbers and table.results.get(numbers["table"])
    if not found or "index" not in found:
        return text.translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
    row = list(found["index"].value).index(int(text))
    column = found[numbers["column"] if numbers["column"] in found else "q"]
    return f"{numbers['symbol']} = {column.value[row]:.3g}"


def _axes(axes):
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.figure(layout="constrained").add_subplot()


class Results(_ByName[Table]):
    """Tables by name.

    Attributes
    ----------
    summary : dict
        Averages, with errors `name_error`, and verdicts.
    provenance : dict
        Where the results come from, and what was left out.
    """

    def __init__(self, summary, tables: List[Table], provenance=None):
        self.summary, self.provenance = summary, dict(provenance or {})
        super().__init__(tables)
        for table in tables:
            table.results = self

    def __repr__(self) -> str:
        return f"<Results: {', '.join(self)}>"

    def _repr_html_(self) -> str:
        return _html_table(["table", "rows", "what it has"], [[name, str(table._rows), html.escape(table.description)]
                                                              for name, table in self.items()])

    @property
    def charts(self) -> List[Chart]:
        """All charts of the report page for which there are tables; of a sweep through seeds those of the averages."""
        return [chart for table in self.values() if not (table.name == "runs" and "seeds" in self) for chart in charts(table)]

    def find(self, name: str):
        """The table of this name, or else the first column of this name in any table; KeyError if there is neither."""
        if name in self:
            return self[name]
        for table in self.values():
            if name in table and len(table) > 1 and table.name != "summary":
                return table[name]
        raise KeyError(name)


def _cell(column, row):
    """As text: a value with its error, or what its code stands for."""
    if column.labels:
        return html.escape(column.texts[row] or "")
    error = math.nan if column.error is None else column.error[row]
    return f"{column.value[row]:.6g}" + (f" ± {error:.2g}" if error == error else "")


def _html_table(head, rows):
    """Of cells that are HTML."""
    def line(cells, kind):
        return "<tr>" + "".join(f"<{kind}>{cell}</{kind}>" for cell in cells) + "</tr>"

    return f"<table><thead>{line(head, 'th')}</thead><tbody>{''.join(line(row, 'td') for row in rows)}</tbody></table>"


def tables_of(tables, dimension):
    """From what the compiled module gives."""
    return [Table(name, description, [Column(*column) for column in columns], dimension)
            for name, description, columns in tables]
