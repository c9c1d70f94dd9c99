"""Executes every notebook of a folder, each in a fresh kernel; a cell that raises ends with its error."""

import sys
import tempfile
from pathlib import Path

import nbclient
import nbformat

notebooks = sorted(Path(sys.argv[1]).glob("*.ipynb"))
assert notebooks, f"no notebooks in {sys.argv[1]}"
for path in notebooks:
    notebook = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
    shown = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert shown, f"{path} shows nothing"
    print(f"{path.name}: {len(notebook.cells)} cells, {len(shown)} outputs")
