"""Executes a notebook in the present folder: ``python execute.py NOTEBOOK.ipynb OUT.ipynb``."""

import sys

import nbformat
from nbclient import NotebookClient

source, target = sys.argv[1:]
notebook = nbformat.read(source, 4)
NotebookClient(notebook, timeout=600, kernel_name="python3", record_timing=False).execute()
for cell in notebook.cells:
    if cell.cell_type == "code":
        # Bars of progress and warnings of graphics belong to the machine.
        cell.outputs = [out for out in cell.outputs if out.get("name") != "stderr"]
nbformat.write(notebook, target)
