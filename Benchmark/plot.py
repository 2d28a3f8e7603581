# SPDX-License-Identifier: BSD-3-Clause
"""Draws time against size, and speed beside floors, with VTK's charts, which every ParaView has."""

import numpy
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 draws charts
import vtkmodules.vtkRenderingFreeType  # noqa: F401 writes on them
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartMatrix, vtkChartXY
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkTable, vtkVector2f, vtkVector2i
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

# Colours that people who cannot tell red from green can tell apart.
COLORS = ((0, 90, 180), (230, 130, 0), (0, 150, 110), (190, 60, 140), (110, 110, 110))
TITLES = {"frame": "same step", "own": "default steps", "equal error": "equal error"}
CHART_WIDTH, CHART_HEIGHT = 560, 430  # pixels


def _lines(groups):
    """{kind: {row: [(voxels, ms)]}} of what was measured at several sizes alike."""
    window = groups[0]["window"]
    lines = {}
    for group in groups:
        if group["lattice"] == groups[0]["lattice"] and group["window"] == window:
            for name, row in group["rows"].items():
                points = lines.setdefault(group["kind"], {}).setdefault(name, {})
                points[group["voxels"]] = row["median"]
    for kind in lines:
        lines[kind] = {name: sorted(points.items()) for name, points in lines[kind].items()
                       if len(points) > 1}
    return {kind: rows for kind, rows in lines.items() if rows}


def _chart(kind, rows):
    chart = vtkChartXY()
    chart.SetTitle(kind)
    chart.SetShowLegend(True)
    chart.GetLegend().SetHorizontalAlignment(0)  # left
    times = [ms for points in rows.values() for _, ms in points]
    for (name, points), color in zip(rows.items(), COLORS):
        table = vtkTable()
        for title, column in (("voxels", 0), (name, 1)):
            array = numpy_to_vtk(numpy.array([float(point[column]) for point in points]), deep=True)
            array.SetName(title)
            table.AddColumn(array)
        line = chart.AddPlot(vtkChart.LINE)
        line.SetInputData(table, 0, 1)
        line.SetLabel(name)
        line.SetColor(*color, 255)
        line.SetWidth(2.0)
        line.SetMarkerStyle(4)  # circles
    for axis, title in ((vtkAxis.BOTTOM, "voxels"), (vtkAxis.LEFT, "ms, median")):
        chart.GetAxis(axis).SetTitle(title)
        chart.GetAxis(axis).SetLogScale(True)
    # Room above for the legend.
    left = chart.GetAxis(vtkAxis.LEFT)
    left.SetBehavior(vtkAxis.FIXED)
    left.SetRange(0.5 * min(times), 30.0 * max(times))
    return chart


def plot(groups, file):
    """Draws into a PNG file. False if only one size was measured."""
    lines = _lines(groups)
    if not lines:
        return False
    _draw([_chart(kind, of_kind) for kind, of_kind in lines.items()], file)
    return True


def _bars(targets, prefix):
    """One chart: how many times as fast as stock, for each volume and size; a line is the floor."""
    rows = {key: [row for row in targets if row["key"] == f"{prefix} {key}"]
            for key in ("opaque", "translucent")}
    names = [f"{row['volume']} {row['window']}" for row in rows["opaque"]]
    chart = vtkChartXY()
    chart.SetTitle(TITLES[prefix])
    chart.SetShowLegend(True)
    places = vtkDoubleArray()
    labels = vtkStringArray()
    for number, name in enumerate(names):
        places.InsertNextValue(number)
        labels.InsertNextValue(name)
    table = vtkTable()
    columns = {"volume": numpy.arange(len(names), dtype=float)}
    for key, of_key in rows.items():
        columns[key] = numpy.array([row["measured"] if row["quiet"] is None else row["quiet"]
                                    for row in of_key])
        columns[f"floor, {key}"] = numpy.full(len(names), float(of_key[0]["least"]))
    for title, values in columns.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(title)
        table.AddColumn(array)
    for number, title in enumerate(columns):
        if number > 0:
            plot_of = chart.AddPlot(vtkChart.LINE if title.startswith("floor") else vtkChart.BAR)
            plot_of.SetInputData(table, 0, number)
            plot_of.SetLabel(title)
            plot_of.SetColor(*COLORS[(number - 1) // 2], 255)
            plot_of.SetWidth(2.0)
    bottom = chart.GetAxis(vtkAxis.BOTTOM)
    bottom.SetTitle("")
    bottom.SetCustomTickPositions(places, labels)
    bottom.GetLabelProperties().SetOrientation(60)
    bottom.GetLabelProperties().SetJustificationToRight()
    left = chart.GetAxis(vtkAxis.LEFT)
    left.SetTitle("times as fast as ParaView's Volume")
    left.SetBehavior(vtkAxis.FIXED)
    left.SetRange(0.0, 1.4 * max(values.max() for title, values in columns.items()
                                 if title != "volume"))
    return chart


def plot_volumes(targets, file):
    """Draws speeds beside stock of the volumes of floors.py into a PNG file."""
    _draw([_bars(targets, prefix) for prefix in TITLES], file, 180)


def _draw(charts, file, below=60):
    """Charts side by side, at most three in a row, as a PNG file. `below`: pixels for labels."""
    columns = min(len(charts), 3)
    rows = -(-len(charts) // columns)
    matrix = vtkChartMatrix()
    matrix.SetSize(vtkVector2i(columns, rows))
    matrix.SetBorders(90, below, 20, 40)  # left, bottom, right, top: room for the axes' titles
    matrix.SetGutter(vtkVector2f(100, 90))
    for number, chart in enumerate(charts):
        place = vtkVector2i(number % columns, rows - 1 - number // columns)  # counted from below
        matrix.SetChart(place, chart)
    view = vtkContextView()
    view.GetRenderWindow().SetOffScreenRendering(1)
    view.GetRenderWindow().SetSize(columns * CHART_WIDTH, rows * CHART_HEIGHT)
    view.GetScene().AddItem(matrix)
    view.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(view.GetRenderWindow())
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()
