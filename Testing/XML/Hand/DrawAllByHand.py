# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the status bar offers to draw all voxels of a volume that is drawn coarser, that its
button saves an OME-Zarr image and draws from it, bent as before, in one step to undo, that the
cross beside the progress bar stops it, and that what is not written changes nothing.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import os
import re
import shutil
import time

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift import pyramids
from brainshift_testing import messages, scratch, server, server_finds_plugin
from paraview import simple

BUTTON, DIALOG = "BrainShiftDrawAll", "BrainShiftPyramidDialog"
scene = {}


def head():
    """A file of a ball with waves of five voxels on it."""
    import nibabel

    z, y, x = numpy.mgrid[0:144, 0:160, 0:176].astype(float)
    away = numpy.sqrt((x - 88) ** 2 + (y - 80) ** 2 + (z - 72) ** 2)
    waves = 1.5 * (numpy.sin(1.25 * x) + numpy.sin(1.25 * y) + numpy.sin(1.25 * z))
    values = (1000 * numpy.clip((36 + waves - away) / 6 + 0.5, 0, 1)).astype("int16")
    file = scratch("head.nii")
    nibabel.save(nibabel.Nifti1Image(values.T, numpy.diag((0.5, 0.5, 0.5, 1.0))), file)
    return file


def limit(view, display):
    """MiB for all else and most of the voxels."""
    display.MemoryLimit = 0.01
    with messages() as said:
        simple.Render(view)
    total, corrections = (float(re.search(words, said.text).group(1)) for words in (
        r"needs ([\d.]+) MiB", r"corrections of it ([\d.]+)"))
    return total - corrections - 0.5


def show(file):
    simple.OpenDataFile(file)
    simple.SetActiveSource(list(simple.GetSources().values())[-1])
    bent = window.bend()
    view = simple.GetActiveView()
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    display.VolumeNormalTexture = "On the fly"
    simple.ColorBy(display, ("POINTS", "Intensity"))
    simple.GetOpacityTransferFunction("Intensity").Points = [440, 0, 0.5, 0, 460, 1, 0.5, 0]
    bent.Strokes = brainshift.soft((30.0, 40.0, 36.0), (0, 0, 3), 12.0)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(400)
    scene.update(bent=bent, view=view, display=display, volume=bent.Input,
                 strokes=list(bent.Strokes))


def is_offered():
    return hand.is_visible(BUTTON)


def a_volume_that_fits_is_offered_nothing():
    show(head())
    assert not is_offered()


def a_volume_that_is_too_large_is_offered_its_image():
    display = scene["display"]
    display.MemoryLimit = limit(scene["view"], display)
    simple.Render(scene["view"])
    window.until(is_offered, "the button comes")
    assert brainshift.gpu(display)["gpuVoxelsPerTexel"] > 1
    assert "Draw All Voxels" in hand.label("BrainShiftStatusWarning")


def nothing_changed(why):
    assert scene["bent"].Input == scene["volume"], why
    assert list(scene["bent"].Strokes) == scene["strokes"], why
    assert is_offered(), why


def cancel_changes_nothing():
    hand.answer(DIALOG, "Cancel")
    assert hand.click(BUTTON)
    nothing_changed("canceled")


def the_cross_stops_it():
    pressed, watch = [], pyramids._watch

    def press_the_cross(writer, _):
        own = writer.GetClientSideObject()

        def press(*_):
            time.sleep(0.02)  # ParaView tells its window of progress a few times in a second
            if not pressed and hand.click("AbortButton"):
                pressed.append(own.GetProgress())
        own.AddObserver("ProgressEvent", press)
    pyramids._watch = press_the_cross
    window.forget_undo()
    try:
        hand.answer_path(DIALOG, scratch("stopped.ome.zarr"))
        assert hand.click(BUTTON)
    finally:
        pyramids._watch = watch
    assert pressed and pressed[0] < 1.0, pressed
    nothing_changed("stopped")
    assert not window.undo_labels(), window.undo_labels()


def the_button_draws_all_voxels():
    """At the proposed path, beside the file."""
    shutil.rmtree(scratch("head.ome.zarr"), ignore_errors=True)
    window.forget_undo()
    hand.answer(DIALOG, "OK")
    assert hand.click(BUTTON)
    bent, display = scene["bent"], scene["display"]
    assert bent.Input.SMProxy.GetXMLName() == "OMEZarrReader"
    assert bent.Input.FileName == scratch("head.ome.zarr")
    assert list(bent.Strokes) == scene["strokes"]
    assert scene["volume"] in simple.GetSources().values()

    def is_complete():
        now = brainshift.gpu(display)
        return now["gpuBricks"] > 8 and now["gpuBricksWanted"] == 0
    window.until(is_complete, "bricks come")
    now = brainshift.gpu(display)
    assert now["gpuVoxelsPerTexel"] == 1 and now["gpuBricksLackRoom"] == 0, now
    window.until(lambda: not is_offered(), "the button goes")


def it_is_one_step():
    bent = scene["bent"]
    assert window.undo_labels() == ["Draw all voxels"], window.undo_labels()
    reader = bent.Input.FileName
    window.action("Undo")
    assert bent.Input == scene["volume"]
    window.until(is_offered, "the button comes again")
    window.action("Redo")
    assert bent.Input.FileName == reader
    window.until(lambda: not is_offered(), "the button goes again")


def a_server_writes_it(port):
    hand.reset_session()
    simple.Connect("localhost", port)
    hand.wait(200)
    assert simple.servermanager.ActiveConnection.IsRemote()
    show(scratch("head.nii"))
    a_volume_that_is_too_large_is_offered_its_image()
    path = scratch("server.ome.zarr")
    shutil.rmtree(path, ignore_errors=True)
    hand.answer_path(DIALOG, path)
    assert hand.click(BUTTON)
    assert scene["bent"].Input.FileName == path and os.path.isdir(path)
    window.until(lambda: brainshift.gpu(scene["display"])["gpuBricks"] > 8, "bricks come")
    window.until(lambda: not is_offered(), "the button goes")
    scene.clear()  # or Python asks the server to let them go when there is none any more
    simple.Disconnect()
    hand.wait(300)


def play():
    yield a_volume_that_fits_is_offered_nothing,
    yield a_volume_that_is_too_large_is_offered_its_image,
    yield cancel_changes_nothing,
    yield the_cross_stops_it,
    yield the_button_draws_all_voxels,
    yield it_is_one_step,
    with server(server_finds_plugin()) as (port, _):
        yield a_server_writes_it, port


if __name__ == "__main__":
    window.main("DrawAllByHand", play())
