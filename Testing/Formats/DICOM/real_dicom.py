# SPDX-License-Identifier: BSD-3-Clause
"""Compares a DICOM series with the NIfTI file that another program made of it.

    pvpython Testing/Formats/DICOM/real_dicom.py DICOM NIFTI [--series PART]

DICOM is a folder or a file, NIFTI a file of dcm2niix, PART a part of the series' name. nibabel
reads the NIfTI. It prints the farthest distance of a corner, and how voxels differ. The public
repositories neurolabusc/dcm_qa_enh, dcm_qa_sag and dcm_qa_ct hold such pairs in In and Ref. Run it
where BRAINSHIFT_PLUGIN names the plugin and PYTHONPATH this folder and Support, as ctest does.
"""

import argparse
import os

import nibabel
import numpy
from brainshift_testing import load_plugin, output
from dicom_testing import corners, places, scalars
from paraview import simple


def differences(reader, nifti, volume=0):
    """Of the corners of the file: the largest distance in mm to the nearest voxel of the reader's
    image. Of all voxels: the factor between the numbers, and the largest difference that is left as
    a share of the range."""
    affine = nifti.affine
    voxels = nifti.get_fdata().reshape(nifti.shape[:3] + (-1,))[..., volume]
    shown = places(output(reader))
    farthest = 0.0
    for corner in corners(voxels.T.shape):
        right = (affine @ [*corner, 1.0])[:3]
        farthest = max(farthest, numpy.linalg.norm(shown - right, axis=1).min())
    index = numpy.linalg.solve(affine, numpy.c_[shown, numpy.ones(len(shown))].T)[:3]
    index = numpy.rint(index).astype(int)
    assert numpy.all((index >= 0) & (index.T < voxels.shape).T), "the grids differ"
    right, read = voxels[tuple(index)], scalars(reader).astype(float)
    factor = (right @ read) / (right @ right)
    left = numpy.abs(read - factor * right).max() / numpy.ptp(read)
    return farthest, factor, left


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dicom")
    parser.add_argument("nifti")
    parser.add_argument("--series", default="")
    arguments = parser.parse_args()
    load_plugin()
    reader = simple.DICOMVolumeReader(FileName=os.path.abspath(arguments.dicom))
    names = list(reader.GetProperty("SeriesList"))
    print("\n".join(names))
    reader.Series = next(name for name in names if arguments.series in name)
    farthest, factor, left = differences(reader, nibabel.load(arguments.nifti))
    print(f"{reader.Series}: corners within {farthest:.2g} mm; numbers times {factor:.6g}, "
          f"then within {100 * left:.2g} % of their range")


if __name__ == "__main__":
    main()
