# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel lists the layers of a segmentation whose segments overlap, shows the chosen
one after Apply, as one step of undo, and lists nothing for a volume without layers.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import numpy
import test_hand as hand
import volume_files
import window_testing as window
from brainshift_testing import scratch, voxels
from paraview import simple

SEGMENTS = ({"ID": "a", "Name": "skull", "LabelValue": 5, "Layer": 0},
            {"ID": "b", "Name": "vessel", "LabelValue": 7, "Layer": 1})


def open_file(name, content):
    """Opens a file and shows it, and its properties in the panel."""
    source = simple.OpenDataFile(volume_files.write(scratch(name), content))
    simple.Show(source, simple.GetActiveViewOrCreate("RenderView"))
    simple.SetActiveSource(source)
    simple.Render()
    hand.wait(300)
    return source


def values(source):
    return set(numpy.unique(voxels(source)))


def choose_a_layer():
    layers = numpy.zeros((2, 4, 5, 6), "uint8")
    layers[0, 1:, :, :], layers[1, :, 2:, :] = 5, 7
    content = volume_files.segmentation(layers, numpy.eye(4), SEGMENTS)
    source = open_file("layers.seg.nrrd", content)
    assert hand.is_visible("Layer") and values(source) == {0, 5}
    assert hand.choose("Layer", "2: vessel")
    assert values(source) == {0, 5}, "not applied yet"
    assert hand.click("Accept")
    hand.wait(200)
    assert values(source) == {0, 7}
    window.action("Undo")
    assert values(source) == {0, 5}
    window.action("Redo")
    assert values(source) == {0, 7}
    simple.Delete(source)


def nothing_to_choose():
    content = volume_files.nrrd(volume_files.numbered((4, 5, 6)), numpy.eye(4))
    source = open_file("plain.nrrd", content)
    assert not hand.is_visible("Layer")
    simple.Delete(source)


window.main("LayersByHand", [(choose_a_layer,), (nothing_to_choose,)])
