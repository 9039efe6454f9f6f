"""Executes the notebooks of examples/python and compares their output with the stored output.

    notebook_test.py            exit 1 when one fails or its output differs
    notebook_test.py --update   stores the new output
"""
import argparse
import os
import pathlib
import sys
import tempfile

import nbclient
import nbformat

ROOT = pathlib.Path(__file__).resolve().parents[2]


def shown(cell):
    """The output of a cell as text: a kernel may send it in pieces."""
    return "".join(output.get("text") or "".join(output.get("data", {}).get("text/plain", "")) for output in cell.get("outputs", []))


def clean(notebook):
    """The notebook without the parts that differ from run to run."""
    for cell in notebook.cells:
        cell.metadata.clear()
        if cell.cell_type == "code":
            cell.execution_count = None
            for output in cell.outputs:
                if "execution_count" in output:
                    output["execution_count"] = None
    notebook.metadata["language_info"] = {"name": "python"}
    return notebook


def execute(path):
    """The notebook with its new output; the exception of a cell that fails."""
    notebook = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:  # the kernel's files
        os.environ.update({"IPYTHONDIR": folder, "JUPYTER_RUNTIME_DIR": folder, "DSDPV1_ROOT": str(ROOT)})
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute(cwd=str(path.parent))
    return clean(notebook)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--update", action="store_true", help="stores what they show now")
    update, different = parser.parse_args().update, 0
    for path in sorted((ROOT / "examples" / "python").glob("*.ipynb")):
        stored, now = nbformat.read(path, as_version=4), execute(path)
        if update:
            nbformat.write(now, path)
            continue
        for number, (one, other) in enumerate(zip(stored.cells, now.cells)):
            if shown(one) != shown(other):
                print(f"{path.relative_to(ROOT)}: cell {number} shows {shown(other)!r}, stored is {shown(one)!r}")
                different = 1
    return different


if __name__ == "__main__":
    sys.exit(main())
