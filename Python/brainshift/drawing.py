# SPDX-License-Identifier: BSD-3-Clause
"""Draws into pictures, and makes the contents of picture files, without any pipeline.

Pictures are arrays of bytes, indexed [row from below, column, rgb].
"""

from html import escape

BLUE, ORANGE = (0, 90, 181), (220, 109, 0)  # told apart by the colour-blind, too
GREY, INK = "#8c8c8c", "#222222"

#: Difference of brightness (0 to 1) that has full colour.
FULL_DIFFERENCE = 0.5

#: Height of letters and distance of the scale bar from the lower edge, fractions of the height.
LETTERS, FROM_EDGE = 0.03, 0.035

#: Middle of the scale bar, fraction of the width: the lower edge has a letter of the patient's
#: sides in its middle, a colour scale right of it, and the axes at its left end.
BAR_MIDDLE = 0.34

#: Brightness (0 to 255) from which a ground gets a black scale bar.
BRIGHT_GROUND = 150


def as_image(pixels):
    """A vtkImageData of a picture."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData

    height, width, _ = pixels.shape
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    flat = numpy.ascontiguousarray(pixels, numpy.uint8).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    return image


def png(pixels, texts):
    """The bytes of a PNG file of a picture, with texts under keys."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGWriter

    writer = vtkPNGWriter()
    writer.SetInputData(as_image(pixels))
    for key, text in texts.items():
        # PNG's simple text has no more letters
        writer.AddText(key, text.encode("ascii", "backslashreplace").decode("ascii"))
    writer.WriteToMemoryOn()
    writer.Write()
    return vtk_to_numpy(writer.GetResult()).tobytes()


def colored_difference(before, after):
    """White where two pictures are equal, orange where `after` is brighter, blue where darker."""
    import numpy

    change = (after.astype(float).mean(axis=2) - before.astype(float).mean(axis=2)) / 255.0
    fraction = numpy.clip(numpy.abs(change) / FULL_DIFFERENCE, 0.0, 1.0)[:, :, None]
    colors = numpy.where(change[:, :, None] > 0, ORANGE, BLUE)
    return numpy.rint((1 - fraction) * 255 + fraction * colors).astype(numpy.uint8)


def _letters(text, height):
    """The fraction of each pixel that a text covers, 0 to 1, indexed [row from below, column]."""
    import vtkmodules.vtkRenderingFreeType  # noqa: F401 without it there are no letters
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer

    look = vtkTextProperty()
    look.SetFontSize(max(height, 8))
    look.SetColor(1.0, 1.0, 1.0)
    image, used = vtkImageData(), [0, 0]
    vtkTextRenderer.GetInstance().RenderString(look, text, image, used, 72)
    width, rows, _ = image.GetDimensions()
    covered = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, width, -1)[:, :, 3]
    return covered[:used[1], :used[0]] / 255.0


def _grown(mask, by):
    """A mask that is dilated by `by` pixels. Its shape does not change."""
    import numpy

    result = mask.copy()
    for down in range(-by, by + 1):
        for right in range(-by, by + 1):
            result = numpy.maximum(result, numpy.roll(mask, (down, right), axis=(0, 1)))
    return result


def with_scale_bar(pixels, scale):
    """A copy of a picture with a scale bar at its lower edge, left of the middle, and its label.

    The bar is white with a black rim, or the other way round on a bright ground. `scale`: its
    length in `pixels` and its `label`.
    """
    import numpy

    height, width, _ = pixels.shape
    mask = numpy.zeros((height, width))
    length, thickness = round(scale["pixels"]), max(3, height // 150)
    middle = round(BAR_MIDDLE * width)
    left, bottom = max(middle - length // 2, 0), max(4, round(FROM_EDGE * height))
    mask[bottom:bottom + thickness, left:left + length] = 1.0
    letters = _letters(scale["label"], round(LETTERS * height))
    rows, columns = letters.shape
    above, start = bottom + 2 * thickness, max(middle - columns // 2, 0)
    columns = min(columns, width - start)
    mask[above:above + rows, start:start + columns] = letters[:, :columns]
    rim = _grown(mask, max(1, height // 400))[:, :, None]
    bright = pixels[bottom:above + rows, left:left + length].mean() > BRIGHT_GROUND
    ink = 1 - mask if bright else mask
    return numpy.rint(pixels * (1 - rim) + 255 * ink[:, :, None] * rim).astype(numpy.uint8)


def _rebinned(histogram, width):
    """Counts of a histogram (width of its bins, counts) in as many bins of a width.

    All widths are powers of two in mm, and all bins are symmetric about 0.
    """
    own, *counts = histogram
    result = [0.0] * len(counts)
    for i, count in enumerate(counts):
        if count:
            middle = (i + 0.5 - len(counts) / 2) * own
            result[int(middle // width) + len(counts) // 2] += count
    return result


def _hex(color):
    return "#{:02x}{:02x}{:02x}".format(*color)


def _text(x, y, text, anchor="start"):
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}">{escape(text)}</text>'


class _Plot:
    """The area of an SVG plot, in its units, and the style of its bars."""

    LEFT, TOP, ACROSS, DOWN = 70.0, 50.0, 660.0, 300.0
    BOTTOM = TOP + DOWN
    LOOKS = {"after": f'fill="{_hex(BLUE)}" fill-opacity="0.75"',
             "before": f'fill="{GREY}" fill-opacity="0.4" stroke="{INK}"'}

    def __init__(self, width, bins, most):
        self.width, self.bins, self.most = width, bins, most
        self.column = self.ACROSS / bins

    def bars(self, name, counts):
        """One rectangle for each bin that is not empty."""
        lines = [f'<g id="{name}" {self.LOOKS[name]}>']
        for i, count in enumerate(counts):
            if count:
                high = self.DOWN * count / self.most
                lines.append(
                    f'<rect x="{self.LEFT + i * self.column:.2f}" y="{self.BOTTOM - high:.2f}" '
                    f'width="{self.column:.2f}" height="{high:.2f}">'
                    f"<title>{count:g} points</title></rect>")
        return [*lines, "</g>"]

    def axes(self):
        """Lines, marks in mm and numbers of points."""
        lines = [f'<path d="M{self.LEFT} {self.BOTTOM}h{self.ACROSS}M{self.LEFT} {self.TOP}'
                 f'v{self.DOWN}" stroke="{INK}" fill="none"/>']
        for quarter in (-2, -1, 0, 1, 2):
            x = self.LEFT + self.ACROSS * (0.5 + quarter / 4)
            lines.append(f'<path d="M{x} {self.BOTTOM}v6" stroke="{INK}"/>')
            lines.append(_text(x, self.BOTTOM + 24, f"{quarter * self.width * self.bins / 4:g}",
                               "middle"))
        return [*lines, _text(self.LEFT - 8, self.TOP + 5, f"{self.most:g}", "end"),
                _text(self.LEFT - 8, self.BOTTOM, "0", "end"),
                _text(self.LEFT, 30, "number of points"),
                _text(self.LEFT + self.ACROSS / 2, self.BOTTOM + 50,
                      "distance to the cortex (mm), positive outside", "middle")]

    def legend(self, row, name, figures):
        y = self.BOTTOM + 90 + 26 * row
        return [f'<rect x="{self.LEFT}" y="{y - 12}" width="16" height="14" {self.LOOKS[name]}/>',
                _text(self.LEFT + 26, y, f"{name}: {figures}")]


def histogram_svg(before, after, texts):
    """An SVG file of the distances to the cortex before and after.

    - `before`, `after`: a histogram and one line of its figures. A histogram has the width of its
      bins in mm, then counts.
    - `texts`: settings, which the file carries as its description.
    """
    bins, width = len(after[0]) - 1, max(before[0][0], after[0][0]) or 1.0
    counts = {"after": _rebinned(after[0], width), "before": _rebinned(before[0], width)}
    plot = _Plot(width, bins, max(*counts["after"], *counts["before"], 1.0))
    settings = escape("\n".join(f"{name}: {value}" for name, value in texts.items()))
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="800" height="480" '
             'viewBox="0 0 800 480" font-family="sans-serif" font-size="14">',
             "<title>Distances of the traced points to the cortex</title>",
             f"<desc>{settings}</desc>", '<rect width="800" height="480" fill="white"/>']
    for name, own in counts.items():
        lines += plot.bars(name, own)
    lines += plot.axes() + plot.legend(0, "before", before[1]) + plot.legend(1, "after", after[1])
    return "\n".join([*lines, "</svg>", ""])
