# SPDX-License-Identifier: BSD-3-Clause
"""Draws time against size with VTK's charts, which every ParaView has."""

import numpy
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 draws charts
import vtkmodules.vtkRenderingFreeType  # noqa: F401 writes on them
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartMatrix, vtkChartXY
from vtkmodules.vtkCommonDataModel import vtkTable, vtkVector2f, vtkVector2i
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

# Colours that people who cannot tell red from green can tell apart.
COLORS = ((0, 90, 180), (230, 130, 0), (0, 150, 110), (190, 60, 140), (110, 110, 110))
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
    columns = min(len(lines), 3)
    rows = -(-len(lines) // columns)
    matrix = vtkChartMatrix()
    matrix.SetSize(vtkVector2i(columns, rows))
    matrix.SetBorders(90, 60, 20, 40)  # left, bottom, right, top: room for the axes' titles
    matrix.SetGutter(vtkVector2f(100, 90))
    for number, (kind, of_kind) in enumerate(lines.items()):
        place = vtkVector2i(number % columns, rows - 1 - number // columns)  # counted from below
        matrix.SetChart(place, _chart(kind, of_kind))
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
    return True
