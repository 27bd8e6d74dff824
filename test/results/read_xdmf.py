"""Reads result.xdmf and surface.xdmf and compares what they show with result.h5.

First every reference of the file is followed with h5py, then VTK's two readers
are asked. They are in ParaView's VTK (package python3-paraview), not in Debian's
python3-vtk9: exit code 77 where they are missing.
"""
import sys
import xml.etree.ElementTree

import h5py
import numpy as np


def leaves(data):
    """(name, data set) of every block."""
    if not data.IsA("vtkCompositeDataSet"):
        return [("", data)]
    found = []
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        block = iterator.GetCurrentDataObject()
        if block is not None and block.GetNumberOfPoints():
            name = ""
            if iterator.HasCurrentMetaData():
                name = iterator.GetCurrentMetaData().Get(vtkCompositeDataSet.NAME()) or ""
            found.append((name, block))
        iterator.GoToNextItem()
    return found


def compare(reader_class, path, result, cells, fields):
    reader = reader_class()
    reader.SetFileName(path)
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = [information.Get(key, i) for i in range(information.Length(key))]
    names = sorted(result["frames"])
    expected_times = [result["frames"][name].attrs["time"] for name in names]
    assert np.allclose(times, expected_times, rtol=1e-12, atol=0), (times, expected_times)
    for name, time in zip(names, times):
        frame = result["frames"][name]
        reader.UpdateTimeStep(time)
        blocks = leaves(reader.GetOutputDataObject(0))
        present = [i for i in sorted(frame["tools"]) if frame["tools"][i].attrs["present"] and "points" in frame["tools"][i]]
        assert len(blocks) == 1 + len(present), (name, [n for n, _ in blocks])
        blank = blocks[0][1]
        assert blank.GetNumberOfCells() == len(result[cells])
        last = len(result[cells]) - 1
        corners = [blank.GetCell(last).GetPointId(k) for k in range(result[cells].shape[1])]
        assert corners == list(result[cells][last]), corners
        assert np.array_equal(vtk_to_numpy(blank.GetPoints().GetData()), frame["positions"][:].astype(
            vtk_to_numpy(blank.GetPoints().GetData()).dtype))
        for field in fields:
            shown = vtk_to_numpy(blank.GetCellData().GetArray(field))
            assert np.array_equal(shown, frame[field][:]), (reader_class.__name__, name, field)
        for field in ("velocities", "contact_pressure", "contact_gap", "contact_slip", "thickness", "thinning", "limit_ratio"):
            assert np.array_equal(vtk_to_numpy(blank.GetPointData().GetArray(field)), frame[field][:]), (reader_class.__name__, name, field)
        for index, (_, tool) in zip(present, blocks[1:]):
            assert tool.GetNumberOfCells() == len(result["tools"][index]["facets"])
            assert set(vtk_to_numpy(tool.GetCellData().GetArray("body"))) == {-1 - int(index)}
            assert np.allclose(vtk_to_numpy(tool.GetPoints().GetData()), frame["tools"][index]["points"][:], rtol=1e-6)
    print(reader_class.__name__, "shows", len(names), "frames as in the file")


def check_references(path, result):
    """Every data item names a data set of the size and the type that it states."""
    items = xml.etree.ElementTree.parse(path).getroot().findall(".//DataItem")
    assert items
    for item in items:
        file_name, name = item.text.split(":")
        assert file_name == "result.h5", file_name
        data = result[name]
        assert tuple(int(n) for n in item.get("Dimensions").split()) == data.shape, name
        assert {"Int": "i", "Float": "f"}[item.get("NumberType")] == data.dtype.kind, name
        assert int(item.get("Precision")) == data.dtype.itemsize, name


def main():
    directory = sys.argv[1]
    with h5py.File(directory + "/result.h5", "r") as result:
        for file in ("result.xdmf", "surface.xdmf"):
            check_references(f"{directory}/{file}", result)
        for reader in (vtkXdmfReader, vtkXdmf3Reader):
            compare(reader, directory + "/result.xdmf", result, "topology/elements", ("plastic_strain", "stress", "mises", "volume_ratio", "damage"))
            compare(reader, directory + "/surface.xdmf", result, "topology/surface", ("surface_strain", "surface_strain_minor", "membrane_strain", "membrane_strain_minor"))


try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
    from vtkmodules.vtkIOXdmf3 import vtkXdmf3Reader
except ImportError:
    with h5py.File(sys.argv[1] + "/result.h5", "r") as opened:
        for name in ("result.xdmf", "surface.xdmf"):
            check_references(f"{sys.argv[1]}/{name}", opened)
    sys.exit(77)
main()
