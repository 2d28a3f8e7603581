# SPDX-License-Identifier: BSD-3-Clause
"""Opens the sample head, ready to be deformed."""

import os

#: Environment variable that names the folder of the sample data; the launcher sets it.
DATA = "BRAINSHIFT_DATA"
HEAD, MASK = "seg3d_mr_t1.nii.gz", "seg3d_brainmask.nii.gz"


def open_sample():
    """Open the sample head, an MR with a brain mask, and show it ready to be deformed.

    The head shows as Deformed Volume in the active view. The mask is its Segmentation, so that the
    look Brain is offered.

    Returns the Free-Form Deformation.

    Raises `FileNotFoundError` if the sample data is not there. `./brainshift` sets its path;
    otherwise the environment variable `BRAINSHIFT_DATA` names the folder `Testing/Data`. Raises
    `ValueError` with the reason if it cannot be read.
    """
    from paraview import simple

    from .files import reason_of
    from .looks import look

    folder = os.path.join(os.environ.get(DATA, ""), "seg3d-utah")
    files = [os.path.join(folder, name) for name in (HEAD, MASK)]
    missing = [file for file in files if not os.path.exists(file)]
    if missing:
        raise FileNotFoundError(f"there is no sample {missing[0]}; {DATA} must name its folder")
    head, mask = (simple.NIFTIVolumeReader(registrationName=name, FileName=file)
                  for name, file in zip(("Sample head", "Sample brain mask"), files))
    for reader in (head, mask):
        reader.UpdatePipeline()
        problem = reason_of(reader)
        if problem:
            simple.Delete(mask)
            simple.Delete(head)
            raise ValueError(problem)
    bent = simple.FreeFormDeformation(registrationName="Bent head", Input=head, Segmentation=mask)
    view = simple.GetActiveViewOrCreate("RenderView")
    shown = simple.Show(bent, view, "UniformGridRepresentation")
    shown.SetRepresentationType("Deformed Volume")
    look(shown, "Skin", view)
    shown.SetScalarBarVisibility(view, False)
    simple.SetActiveSource(bent)
    simple.Render(view)
    return bent
