"""Runs a notebook of the manual as Jupyter does, in a temporary folder: run_notebook.py NOTEBOOK. The programs are those of
PATH, the Python package is that of PYTHONPATH. Notebooks are kept without outputs.
"""

import sys
import tempfile

import nbformat
from nbclient import NotebookClient


def main():
    notebook = nbformat.read(sys.argv[1], as_version=4)
    for number, cell in enumerate(notebook.cells):
        if cell.get("outputs") or cell.get("execution_count"):
            sys.exit(f"{sys.argv[1]}: cell {number} has outputs; clear them before the notebook is committed")
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if output.get("name") == "stderr":
                sys.exit(f"{sys.argv[1]}: a reader would see this:\n{output.text}")


if __name__ == "__main__":
    main()
