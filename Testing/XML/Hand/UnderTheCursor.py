# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the status line says what lies under the cursor, in slices and in 3D, in four views
and in a view of its own: the position in both frames, the value of the nearest voxel, the label and
its name, how far the tissue moved and how its volume changed, each as DeformGeometry and the voxels
say; the letters of the patient's sides where the axes are known; and nothing where nothing is
known. And that slices of the volume as loaded follow those of the bent one to the same tissue, and
back.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import re

import brainshift
import numpy
import test_hand as hand
import volume_files
import window_testing as window
from brainshift_testing import scratch, volume
from paraview import simple

MIDDLE = numpy.array((20.0, 30.0, 24.0))
SHAPE = (49, 61, 41)  # z, y, x
AWAY = numpy.array((-30.0, -40.0, 5.0))  # of the first voxel, so that coordinates have both signs
SLICES = ("axial", "coronal", "sagittal")
LABELS = {"R": 1, "L": -1, "A": 1, "P": -1, "S": 1, "I": -1}  # signs along RAS

scene = {}


def pattern():
    """Every voxel has a number of its own; bright everywhere, so that rays end at the face."""
    return (1000.0 + numpy.arange(numpy.prod(SHAPE)).reshape(SHAPE)).astype(numpy.int32)


def halves():
    """Label 3 where z is small, 0 elsewhere."""
    labels = numpy.zeros(SHAPE, numpy.uint8)
    labels[:24] = 3
    return labels


def set_up():
    source = volume(pattern(), origin=AWAY)
    strokes = brainshift.soft(MIDDLE + AWAY, (4, 2, -1), 22)
    scene["bent"] = simple.FreeFormDeformation(registrationName="bent", Input=source,
                                               Strokes=strokes, LatticeDimensions=[11, 16, 13])
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(scene["bent"], view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "Intensity"))
    simple.GetOpacityTransferFunction("Intensity").Points = [0, 1, 0.5, 0, 2e5, 1, 0.5, 0]
    simple.ResetCamera(view)
    simple.Render(view)
    simple.SetActiveSource(scene["bent"])
    scene["views"] = {"alone": view}
    simple.Render(view)
    line_at(middle_of(view))
    hand.wait(500)  # the panel is filled, and the view finds its size


def line():
    hand.wait(250)  # the line waits for more to happen
    return hand.label("BrainShiftCursor")


def line_at(pixel, tries=10):
    """The line over a pixel. The window may hear that the screen's own cursor left the view, on a
    busy machine late: so two moves, and again while the line is empty."""
    for _ in range(tries):
        hand.hover([pixel[0] + 1, pixel[1]])
        hand.wait(100)
        hand.hover(pixel)
        if line():
            break
    return line()


def middle_of(view, right=0, up=0):
    width, height = view.ViewSize
    return [width // 2 + right, height // 2 + up]


def place_in(text):
    """RAS or x y z coordinates."""
    parts = re.findall(r"([RLAPSIxyz]) (-?[\d.]+)", text)
    assert len(parts) == 3, text
    return numpy.array([LABELS.get(letter, 1) * float(number) for letter, number in parts])


def told(text):
    """The numbers of a line."""
    place, *others = text.split(" \u00b7 ")
    numbers = {"place": place_in(place)}
    for part in others:
        name, number = part.split(" ", 1)
        numbers[name] = (place_in(number) if name == "before"
                         else float(re.sub("[^-.0-9]", "", number)))
    return numbers


def share_of_volume(rest):
    """The Jacobian determinant, from differences."""
    step = 0.01
    ends = numpy.concatenate([rest + step * numpy.eye(3), rest - step * numpy.eye(3)])
    moved = brainshift.deformed_from_rest(scene["bent"], ends)
    return numpy.linalg.det((moved[:3] - moved[3:]) / (2 * step))


def check(name, pixel, text):
    """The line against the pick, the map of points and the voxels."""
    view = scene["views"][name]
    display = simple.GetDisplayProperties(scene["bent"], view)
    tissue = numpy.array(brainshift.pick(display, view, *pixel))
    rest = brainshift.rest_from_deformed(scene["bent"], tissue[None])[0]
    numbers = told(text)
    assert numpy.abs(numbers["place"] - tissue).max() <= 0.051, (text, tissue)
    assert numpy.abs(numbers["before"] - rest).max() <= 0.051, (text, rest)
    voxel = (rest - AWAY)[::-1]
    if numpy.abs(voxel - numpy.floor(voxel) - 0.5).min() > 0.02:  # else between two voxels
        nearest = numpy.clip(numpy.round(voxel).astype(int), 0, numpy.array(SHAPE) - 1)
        expected = pattern()[tuple(nearest)]
        assert numbers["intensity"] == expected, (text, voxel, expected)
    assert abs(numbers["moved"] - numpy.linalg.norm(tissue - rest)) <= 0.051, (text, rest)
    assert abs(numbers["volume"] - 100 * share_of_volume(rest)) <= 0.6, (text, rest)
    return numbers


def in_3d():
    text = line_at(middle_of(scene["views"]["alone"], 8, 11))
    assert text.startswith("x "), ("nobody knows the sides", text)
    check("alone", middle_of(scene["views"]["alone"], 8, 11), text)
    assert line_at((2, 2), 1) == "", "no tissue there"


def nearest_of_two_volumes():
    """Of two volumes under the cursor, the line describes the one that is nearer to the camera."""
    view, bent = scene["views"]["alone"], scene["bent"]
    before, focus = numpy.array(view.CameraPosition), numpy.array(view.CameraFocalPoint)
    nearer = (before - focus) / numpy.linalg.norm(before - focus)
    view.CameraPosition = focus + 300 * nearer
    for way, expected in ((90, True), (-90, False)):
        other = volume(pattern() + 300000, origin=AWAY + way * nearer)
        display = simple.Show(other, view, "UniformGridRepresentation")
        display.SetRepresentationType("Deformed Volume")
        simple.ColorBy(display, ("POINTS", "Intensity"))
        simple.SetActiveSource(bent)
        simple.Render(view)
        pixel = middle_of(view, 8, 11)
        assert brainshift.pick(display, view, *pixel), "the cursor is over this one"
        numbers = told(line_at(pixel))
        assert (numbers["intensity"] > 3e5) == expected, (way, numbers)
        simple.Delete(other)
    view.CameraPosition = before
    simple.Render(view)


def four_views():
    scene["views"] = brainshift.four_views(scene["bent"])
    display = simple.GetDisplayProperties(scene["bent"], scene["views"]["axial"])
    display.SlicePosition = list(MIDDLE + AWAY + (1.3, -2.2, 0.4))
    simple.RenderAllViews()
    hand.wait(200)
    for name in (*SLICES, "volume"):
        pixel = middle_of(scene["views"][name], 7, 5)
        hand.over(scene["views"][name])
        text = line_at(pixel)
        numbers = check(name, pixel, text)
        assert name == "volume" or numbers["moved"] > 1.0, ("the stroke is there", text)
        assert line_at((1, 1), 1) == "", name
    hand.over()


def letters_where_known():
    view = scene["views"]["axial"]
    display = simple.GetDisplayProperties(scene["bent"], view)
    pixel = middle_of(view, 20, -30)
    hand.over(view)
    for world, signs in (("RAS", (1, 1, 1)), ("LPS", (-1, -1, 1))):
        display.WorldAxes = world
        simple.RenderAllViews()
        text = line_at(pixel)
        place = place_in(text.split(" \u00b7 ")[0])
        tissue = brainshift.pick(display, view, *pixel)
        assert text[0] in "RL" and numpy.abs(place * signs - tissue).max() <= 0.051, (text, tissue)
    display.WorldAxes = "From the data"
    simple.RenderAllViews()
    hand.over()


def labels():
    view = scene["views"]["sagittal"]
    scene["bent"].Segmentation = volume(halves(), origin=AWAY)
    simple.RenderAllViews()
    hand.wait(100)
    hand.over(view)
    for up, expected in ((-60, "label 3"), (60, None)):
        text = line_at(middle_of(view, 0, up))
        assert text, "tissue is there"
        found = [part for part in text.split(" \u00b7 ") if part.startswith("label")]
        assert found == ([expected] if expected else []), (up, text)
    scene["bent"].Segmentation = None
    simple.RenderAllViews()
    display = simple.GetDisplayProperties(scene["bent"], view)
    value = told(line_at(middle_of(view, 0, 40)))["intensity"]
    colors = display.LookupTable
    colors.InterpretValuesAsCategories = 1
    colors.Annotations = [f"{value:.0f}", "Precuneus"]
    simple.RenderAllViews()
    assert "label Precuneus" in line(), "the name that the colour map gives"
    colors.InterpretValuesAsCategories = 0
    simple.RenderAllViews()
    hand.over()


def label_at(up):
    """What the line says of the label, above the middle of the sagittal slice."""
    text = line_at(middle_of(scene["views"]["sagittal"], 0, up))
    assert text, "tissue is there"
    return [part for part in text.split(" \u00b7 ") if part.startswith("label")]


def named(voxels, name, *segments):
    """A file of labels as 3D Slicer names them; voxels: z, y, x."""
    lines = [f"Segment{i}_{key}:={value}" for i, (number, words) in enumerate(segments)
             for key, value in (("ID", f"S{i}"), ("Name", words), ("LabelValue", number))]
    affine = numpy.eye(4)
    affine[:3, 3] = AWAY
    file = volume_files.write(scratch(name), volume_files.nrrd(voxels.T, affine, more=lines))
    return simple.NRRDVolumeReader(FileName=file)


def names_of_a_segmentation():
    """Long names are cut, and the background has no name."""
    view = scene["views"]["sagittal"]
    labels = halves()
    labels[-8:] = 9
    hand.over(view)
    long = "left \u00e4rea " + 80 * "x"
    for words, told_as in (("<b>gyrus</b>  of &amp;", "<b>gyrus</b> of &amp;"),
                           (long, long[:60] + "\u2026")):
        scene["bent"].Segmentation = named(labels, "named.seg.nrrd", (0, "nothing"), (3, words))
        simple.RenderAllViews()
        hand.wait(100)
        assert label_at(-60) == [f"label {told_as} (3)"], label_at(-60)
    assert label_at(30) == [], "the background"
    nameless = [label_at(up) for up in range(60, 200, 10) if line_at(middle_of(view, 0, up), 1)]
    assert ["label 9"] in nameless, nameless
    scene["bent"].Segmentation = None
    simple.RenderAllViews()
    hand.over()


def names_of_a_label_map():
    """The volume itself names its values, which count before those of a segmentation."""
    source = named(halves(), "map.seg.nrrd", (3, "gyrus"))
    before = scene["bent"].Input
    scene["bent"].Input = source
    scene["bent"].Segmentation = named(halves() + 2, "other.seg.nrrd", (2, "air"), (5, "head"))
    simple.RenderAllViews()
    hand.wait(100)
    hand.over(scene["views"]["sagittal"])
    assert (label_at(-60), label_at(60)) == (["label gyrus (3)"], ["label air (2)"])
    hand.over()
    scene["bent"].Segmentation = None
    scene["bent"].Input = before
    simple.RenderAllViews()


def never_stale():
    view = scene["views"]["coronal"]
    pixel = middle_of(view, 5, 9)
    hand.over(view)
    before = line_at(pixel)
    assert "moved 0.0" not in before and "moved" in before, before
    scene["bent"].Strokes = []
    simple.RenderAllViews()
    straight = line()
    assert "moved 0.0 mm" in straight and "volume 100 %" in straight, "without a move of the mouse"
    scene["bent"].Strokes = brainshift.soft(MIDDLE + AWAY, (-4, 2, -1), 22)
    scene["bent"].UpdatePipeline()
    assert line() == "", "the picture shows the tissue before"
    simple.RenderAllViews()
    again = line()
    assert "moved" in again and again not in (straight, before), again
    hand.drag(middle_of(view), middle_of(view, 4, 0))
    assert line_at(pixel)
    hand.over(scene["views"]["axial"])
    assert line_at((1, 1), 1) == "", "another view, and no tissue"
    hand.over()


def bring_slices(view, pixel):
    hand.over(view)
    hand.hover(pixel)
    hand.press(pixel, hand.SHIFT)
    hand.release(pixel, hand.SHIFT)
    hand.over()
    hand.wait(100)


def same_tissue_in_the_unbent_volume():
    """Where the slices meet, in a view of the bent volume and in one of the volume as loaded."""
    axial = scene["views"]["axial"]
    bent = simple.GetDisplayProperties(scene["bent"], axial)
    unbent = simple.Show(scene["bent"].Input, axial, "UniformGridRepresentation")
    unbent.SetRepresentationType("Deformed Slices")
    unbent.ShowSagittal = unbent.ShowCoronal = bent.Visibility = 0
    unbent.SlicePosition = list(bent.SlicePosition)
    simple.RenderAllViews()
    coronal = scene["views"]["coronal"]
    bring_slices(coronal, middle_of(coronal, 6, -7))
    place = numpy.array(bent.SlicePosition)
    rest = brainshift.rest_from_deformed(scene["bent"], place[None])[0]
    assert numpy.linalg.norm(place - rest) > 1.0, (place, rest)
    assert numpy.abs(rest - list(unbent.SlicePosition)).max() < 1e-3, (rest, unbent.SlicePosition)
    bring_slices(axial, middle_of(axial, -8, 4))
    rest = numpy.array(unbent.SlicePosition)
    place = brainshift.deformed_from_rest(scene["bent"], rest[None])[0]
    assert numpy.abs(place - list(bent.SlicePosition)).max() < 1e-3, (place, bent.SlicePosition)
    simple.Delete(unbent)
    bent.Visibility = 1
    simple.RenderAllViews()


def not_bent():
    view = scene["views"]["axial"]
    simple.HideAll(view)
    source = scene["bent"].Input
    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    display.SlicePosition = list(MIDDLE + AWAY)
    simple.Render(view)
    hand.over(view)
    numbers = told(line_at(middle_of(view, 3, 3)))
    assert set(numbers) == {"place", "intensity"}, numbers
    simple.Hide(source, view)
    simple.Render(view)
    assert line() == "", "nothing is shown"
    hand.over()


window.main("UnderTheCursor", [
    (set_up,), (in_3d,), (nearest_of_two_volumes,), (four_views,), (letters_where_known,),
    (labels,), (names_of_a_segmentation,), (names_of_a_label_map,), (never_stale,),
    (same_tissue_in_the_unbent_volume,), (not_bent,)])
