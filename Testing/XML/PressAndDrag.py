# SPDX-License-Identifier: BSD-3-Clause
"""What PressAndDrag.xml asks ParaView's window, and afterwards whether all of it held."""
import json
import os

import brainshift
import test_hand as hand
from paraview import simple

TOOLS = {"Move": brainshift.MOVE, "Soft": brainshift.SOFT, "Stamp": brainshift.STAMP}
told = {"checks": 0, "failures": []}


def told_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "PressAndDrag.json")


def deformation():
    return simple.FindSource("bent")


def open_head():
    head = simple.NIFTIVolumeReader(FileName=os.path.join(
        os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz"))
    bent = simple.FreeFormDeformation(registrationName="bent", Input=head)
    view = simple.GetActiveViewOrCreate("RenderView")
    simple.Show(bent, view)
    simple.SetActiveSource(bent)
    simple.Render(view)
    view.CameraFocalPoint = (-309, 22, 477)
    view.CameraPosition = (-500, 500, 580)
    view.CameraViewUp = (0, 0, 1)
    simple.Render(view)


def take(tool):
    hand.setting("tool", getattr(hand, tool))


def turn_wheel(clicks):
    width, height = simple.GetActiveView().ViewSize
    hand.wheel([width // 2, height // 2], clicks)


def has(count, last):
    numbers = list(deformation().Strokes)
    tools = numbers[::brainshift.NUMBERS_PER_STROKE]
    told["checks"] += 1
    if len(tools) != count or tools[-1] != TOOLS[last]:
        told["failures"].append(f"{tools} after {told['checks']} checks, not {count} to a {last}")


def save():
    with open(told_file(), "w", encoding="utf-8") as file:
        json.dump(told, file)


def main():
    with open(told_file(), encoding="utf-8") as file:
        window = json.load(file)
    assert not window["failures"], window["failures"]
    assert window["checks"] == 11, window


if __name__ == "__main__":
    main()
