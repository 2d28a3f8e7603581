# SPDX-License-Identifier: BSD-3-Clause
"""Proves that File > Open of a scene of 3D Slicer puts its things into the pipeline by their names,
bent as in Slicer, in one step to undo, and leaves no source for the scene itself; that what is not
opened is a warning; and that a file that is no scene leaves the pipeline as it was.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import output, scratch
from paraview import simple
from slicer_testing import TURN, Written, of_rows, write_nrrd
from vtkmodules.util.numpy_support import vtk_to_numpy

PLACES = numpy.array(((1.0, 2.0, 3.0), (-4.0, 15.0, 6.0)))


def names():
    return sorted(name for name, _ in simple.GetSources())


def a_scene_opens():
    scene = Written("by hand")
    write_nrrd(scene.path("head.nrrd"), numpy.arange(1000, dtype="i2").reshape(10, 10, 10),
               (0, 0, 0), numpy.eye(3))
    scene.linear("Turn", TURN)
    scene.stored("Volume", "Head", "head.nrrd", above="Turn")
    scene.landmarks("Marks", PLACES, above="Turn")
    scene.node("Sequence", "S", name="S")
    hand.forget_messages()
    hand.open_file(scene.written())
    window.until(lambda: "Marks" in names() and "Head" in names(), "the scene opens")
    assert names() == ["Head", "Marks", "Marks at rest"], names()
    assert any("Sequence 'S' is not opened" in line for line in hand.messages()[0])
    found = simple.FindSource("Marks")
    places = vtk_to_numpy(output(found).GetPoints().GetData())
    assert numpy.abs(places - of_rows(TURN, PLACES)).max() < 1e-3


def opening_is_one_step():
    labels = window.undo_labels()
    assert labels[:2] == ["First look", "Open scene"], labels
    window.action("Undo")
    window.action("Undo")
    window.until(lambda: not names(), "the things of the scene are gone")
    window.action("Redo")
    window.action("Redo")
    window.until(lambda: names() == ["Head", "Marks", "Marks at rest"], "they are there again")


def no_scene_leaves_all_as_it_was():
    before = names()
    with open(scratch("damaged.mrml"), "w") as file:
        file.write("<MRML><Volume ")
    hand.forget_messages()
    hand.open_file(scratch("damaged.mrml"))
    window.until(lambda: "no good XML" in " ".join(hand.messages()[0]), "the reason is told")
    assert names() == before, names()


def play():
    yield (a_scene_opens,)
    yield (opening_is_one_step,)
    yield (no_scene_leaves_all_as_it_was,)


if __name__ == "__main__":
    window.main("SceneByHand", play())
