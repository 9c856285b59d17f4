#!/usr/bin/env python3
"""Reads a folder of VTK files through VTK.

    pip install vtk
    cargo run -p sph-io --example write_sample -- DIR
    python3 crates/sph-io/tests/read_back.py DIR

The folder of the example holds `expected.json` and the written numbers as text: files and arrays
are compared with both. Any other folder with a `fields.pvd`, such as that of a run, is held against
its own list: every file can be read, its time is the listed one, its arrays are finite, and the
particles keep their number and their arrays.

Exits with 1 on any difference and on any complaint of VTK.
"""

import csv
import json
import math
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkOutputWindow
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

complaints = []


def complain(text):
    complaints.append(text)
    print(f"FAIL {text}")


def check(holds, text):
    if not holds:
        complain(text)


def observer(where):
    def on_event(_object, event, message=""):
        complain(f"{where}: VTK says {event}: {message.strip()}")

    on_event.CallDataType = "string0"
    return on_event


def read(path):
    # What several ranks wrote together is a list of files.
    shared = Path(path).suffix == ".pvtu"
    reader = vtkXMLPUnstructuredGridReader() if shared else vtkXMLUnstructuredGridReader()
    check(reader.CanReadFile(str(path)), f"{path}: VTK cannot read this file")
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, observer(path))
    reader.SetFileName(str(path))
    reader.Update()
    check(reader.GetErrorCode() == 0, f"{path}: VTK error code {reader.GetErrorCode()}")
    return reader.GetOutput()


def check_arrays(where, data, expected):
    names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
    check(names == set(expected), f"{where}: arrays {sorted(names)}, not {sorted(expected)}")
    for name in names & set(expected):
        components, unit = expected[name]
        array = data.GetArray(name)
        found = array.GetNumberOfComponents()
        check(found == components, f"{where}: {name} has {found} components, not {components}")
        values = vtk_to_numpy(array).ravel()
        check(all(map(math.isfinite, values)), f"{where}: {name} is not finite everywhere")
        key = vtkDataArray.UNITS_LABEL()
        info = array.GetInformation()
        label = info.Get(key) if info.Has(key) else ""
        check(label == unit, f"{where}: unit of {name} is '{label}', not '{unit}'")


def check_file(folder, entry):
    where = entry["file"]
    grid = read(folder / where)
    for what, found in (("points", grid.GetNumberOfPoints()), ("cells", grid.GetNumberOfCells())):
        check(found == entry[what], f"{where}: {found} {what}, not {entry[what]}")
    check_arrays(where, grid.GetPointData(), entry["point_arrays"])
    check_arrays(where, grid.GetCellData(), entry["cell_arrays"])
    time = grid.GetFieldData().GetArray("TimeValue")
    check(time is not None, f"{where}: no TimeValue")
    if time is not None:
        check(time.GetValue(0) == entry["time"], f"{where}: time is {time.GetValue(0)}")
    if grid.GetNumberOfCells() > 0:
        cell = grid.GetCell(grid.GetNumberOfCells() - 1)
        last = max(cell.GetPointId(i) for i in range(cell.GetNumberOfPoints()))
        check(last < grid.GetNumberOfPoints(), f"{where}: a cell uses point {last}")
    return grid


def check_dump(grid, path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))[1:]
    array = grid.GetPointData().GetArray("velocity")
    if array is None:
        return complain(f"{path}: the file has no velocity to compare with")
    values = vtk_to_numpy(array)
    check(len(rows) == len(values), f"{path}: {len(rows)} rows for {len(values)} points")
    differing = sum(
        [float(cell) for cell in row] != list(found) for row, found in zip(rows, values)
    )
    check(differing == 0, f"{path}: {differing} rows differ from the file")


def read_list(folder):
    listed = [
        (entry.get("file"), float(entry.get("timestep")), entry.get("name"), entry.get("part"))
        for entry in ElementTree.parse(folder / "fields.pvd").getroot().iter("DataSet")
    ]
    for file, *_ in listed:
        check((folder / file).is_file(), f"fields.pvd lists {file}, which is not there")
    return listed


def check_list(folder, expected):
    listed = read_list(folder)
    wanted = [(entry["file"], entry["time"]) for entry in expected]
    check([entry[:2] for entry in listed] == wanted, f"fields.pvd lists {listed}")
    parts = {}
    for _, _, name, part in listed:
        check(parts.setdefault(name, part) == part, f"part number of {name} changes")
    check(len(set(parts.values())) == len(parts), f"part numbers are shared: {parts}")


def shape_of(grid):
    """Numbers of points and cells, names and components of the arrays."""
    shape = [grid.GetNumberOfPoints(), grid.GetNumberOfCells()]
    for data in (grid.GetPointData(), grid.GetCellData()):
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        shape.append({array.GetName(): array.GetNumberOfComponents() for array in arrays})
    return shape


def check_sample(folder):
    expected = json.loads((folder / "expected.json").read_text())
    check(len(expected) > 0, "nothing to check")
    dumps = 0
    for entry in expected:
        grid = check_file(folder, entry)
        dump = folder / (Path(entry["file"]).stem + ".velocity.csv")
        if dump.exists():
            check_dump(grid, dump)
            dumps += 1
    check(dumps > 0, "no array was compared with a dump")
    check_list(folder, expected)
    print(f"{len(expected)} files read, {dumps} compared, {len(complaints)} complaints")


def check_run(folder):
    listed = read_list(folder)
    check(len({time for _, time, *_ in listed}) > 1, "fewer than two output times")
    shapes = {}
    for file, time, name, _ in listed:
        grid = read(folder / file)
        found = grid.GetFieldData().GetArray("TimeValue")
        check(found is not None and found.GetValue(0) == time, f"{file}: its time is not {time}")
        shape = shape_of(grid)
        check(shape[0] > 0, f"{file}: no points")
        check(shapes.setdefault(name, shape) == shape, f"{file}: {shape} is not {shapes[name]}")
        check(math.isfinite(grid.GetLength()), f"{file}: a position is not finite")
        for data in (grid.GetPointData(), grid.GetCellData()):
            for i in range(data.GetNumberOfArrays()):
                values = vtk_to_numpy(data.GetArray(i)).ravel()
                what = f"{file}: {data.GetArrayName(i)}"
                check(all(map(math.isfinite, values)), f"{what} is not finite everywhere")
    print(f"{len(listed)} files of a run read, {len(complaints)} complaints")


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    folder = Path(sys.argv[1])
    vtkOutputWindow.GetInstance().AddObserver("ErrorEvent", observer("VTK"))
    if (folder / "expected.json").exists():
        check_sample(folder)
    else:
        check_run(folder)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
