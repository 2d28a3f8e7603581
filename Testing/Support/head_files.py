# SPDX-License-Identifier: BSD-3-Clause
"""The test's head, coarse and in whole numbers, as files of all formats and of several axes.

A head is an array indexed [i, j, k] and the 4 x 4 affine from indices to RAS mm."""

import os
import shutil

import dicom_testing
import minc_files
import nibabel
import numpy
import volume_files
from brainshift_testing import data, output, scratch, volume
from vtkmodules.vtkCommonCore import vtkStringArray

STEP = 3  # voxels of the file to one of the coarse head
RESCALED = 300.0  # the highest number, so that all formats hold it

#: Orders of axes and directions along which the head's voxels may lie: for each new axis, the old
#: one, and whether it runs backwards. The first and the last mirror the grid.
ORDERS = {"to the left": ((0, True), (1, False), (2, False)),
          "sagittal slices": ((1, True), (2, True), (0, False)),
          "coronal slices": ((0, True), (2, True), (1, False))}

#: A grid that is tilted by 16 degrees. The numbers of all formats hold it exactly, but those of
#: FreeSurfer: its files have directions apart from spacings, as float32.
OBLIQUE = numpy.array(((1232.0, 24.0, 210.0, -45184.0), (24.0, 1218.0, -280.0, 15936.0),
                       (-210.0, 280.0, 1200.0, 54016.0), (0.0, 0.0, 0.0, 512.0))) / 512.0


def head():
    """The coarse head as a NIfTI file would have it."""
    image = nibabel.load(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
    voxels = numpy.asarray(image.dataobj)[::STEP, ::STEP, ::STEP]
    voxels = numpy.rint(voxels * (RESCALED / voxels.max())).astype(numpy.int16)
    return voxels, image.affine @ numpy.diag((STEP, STEP, STEP, 1.0))


def reordered(voxels, affine, order):
    """The same head with its voxels in another order."""
    old_from_new = numpy.zeros((4, 4))
    old_from_new[3, 3] = 1.0
    for new, (old, backwards) in enumerate(order):
        old_from_new[old, new] = -1.0 if backwards else 1.0
        old_from_new[old, 3] = voxels.shape[old] - 1.0 if backwards else 0.0
    turned = voxels.transpose([old for old, _ in order])
    turned = turned[tuple(slice(None, None, -1 if back else 1) for _, back in order)]
    return numpy.ascontiguousarray(turned), affine @ old_from_new


def source_of(voxels, affine, world="RAS"):
    """A ParaView source with the head's grid as it is, and with named world axes."""
    spacing = numpy.linalg.norm(affine[:3, :3], axis=0)
    source = volume(voxels.transpose(2, 1, 0), affine[:3, 3], spacing,
                    (affine[:3, :3] / spacing).ravel())
    word = vtkStringArray()
    word.SetName("WorldAxes")
    word.InsertNextValue(world)
    output(source).GetFieldData().AddArray(word)
    source.MarkModified(source.SMProxy)
    source.UpdatePipeline()
    return source


def new_folder(name):
    path = scratch(name)
    shutil.rmtree(path, ignore_errors=True)
    return path


def by_nibabel(ending, make):
    def write(voxels, affine):
        name = scratch("head_by_nibabel" + ending)
        make(voxels, affine).to_filename(name)
        return name
    return write


def nifti(voxels, affine):
    image = nibabel.Nifti1Image(voxels, affine)
    image.set_sform(affine, 1)
    return image


def by_hand(ending, make):
    def write(voxels, affine):
        return volume_files.write(scratch("head_by_hand" + ending), make(voxels, affine))
    return write


def by_pydicom(voxels, affine):
    """Slices along the last axis, whose direction the standard takes from the other two."""
    spacing = numpy.linalg.norm(affine[:3, :3], axis=0)
    lps = volume_files.TO_LPS @ affine
    path = dicom_testing.folder("head")
    return dicom_testing.write_slices(
        path, voxels.transpose(2, 1, 0), (lps[:3, 0] / spacing[0], lps[:3, 1] / spacing[1]),
        spacing[:2], lps[:3, 2], lps[:3, 3])


def by_libminc(voxels, affine):
    return minc_files.write(scratch("head.mnc"), voxels, affine, kind=minc_files.INTEGER)


def by_us(ending):
    import brainshift

    def write(voxels, affine):
        name = scratch("head_by_us" + ending)
        brainshift.save_volume(source_of(voxels, affine), name)
        return name
    return write


def by_our_dicom(voxels, affine):
    import brainshift
    scan = os.path.join(by_pydicom(voxels[:, :, :2], affine), "IM0001.dcm")
    folder = new_folder("head_by_us")
    brainshift.save_dicom(source_of(voxels, affine), folder, scan)
    return folder


def writers():
    """How the head becomes a file, by a name: functions of voxels and affine that return a file."""
    return {"NIfTI by nibabel": by_nibabel(".nii", nifti), "NIfTI by us": by_us(".nii.gz"),
            "NRRD by hand": by_hand(".nrrd", volume_files.nrrd), "NRRD by us": by_us(".nrrd"),
            "MHA by hand": by_hand(".mha", volume_files.meta_image), "MHA by us": by_us(".mha"),
            "DICOM by pydicom": by_pydicom, "DICOM by us": by_our_dicom,
            "MGZ by nibabel": by_nibabel(".mgz", nibabel.MGHImage),
            "MINC by libminc": by_libminc}
