"""Still pictures of the documentation, drawn by matplotlib. What a page of the program draws needs none."""

import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLOURS = ["#0072b2", "#c65200", "#00805c", "#b1407f", "#8a7a00", "#6a4fc4", "#a8281c", "#3c434b"]


def pyplot():
    """Matplotlib, set up to write reproducible SVG files."""
    import matplotlib  # only here: a test imports all validations

    matplotlib.use("svg")
    from matplotlib import pyplot as plots

    matplotlib.rcParams.update({"svg.hashsalt": "vitrel", "svg.fonttype": "none", "font.size": 10})
    return plots


def save_figure(figure, folder, name):
    """Writes docs/<folder>/<name>.svg and closes the figure."""
    write_figure(figure, ROOT / "docs" / folder / f"{name}.svg")


def write_figure(figure, file):
    """Writes an SVG file and closes the figure."""
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, metadata={"Date": None}, dpi=100)
    pyplot().close(figure)
