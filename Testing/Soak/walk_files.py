# SPDX-License-Identifier: BSD-3-Clause
"""The files that the random walk opens: one small head in world millimetres, as volumes of unlike
grids, axes, types and formats, its labels, a later and a moved head, three moments, and lists of
landmarks."""
import os
import shutil

import dicom_testing
import minc_files
import nibabel
import numpy
import volume_files

#: Axes of the voxels as columns, and spacing (mm).
UPRIGHT = numpy.diag((2.0, 2.5, 4.0))
TURNED = volume_files.tilted(numpy.diag((2.6, 2.2, 3.0, 1.0)))[:3, :3]
SAGITTAL = numpy.array(((0.0, 0.0, 2.5), (2.2, 0.0, 0.0), (0.0, 2.8, 0.0)))
HALF = numpy.array((26.0, 32.0, 28.0))  # mm, of the head
SHIFT = numpy.array((2.0, -1.5, 1.0))  # mm, of the moved head
LANDMARKS = numpy.array(((12.0, 10, 8), (-14, 12, -6), (4, -16, 10), (-9, -11, 14), (11, 17, -8)))


def radius(places):
    """Of the ellipsoid through each place (mm) around the head's; 1 is the skin."""
    return numpy.linalg.norm(places / HALF, axis=-1)


def head(places):
    """Intensities: air, skin, bone, brain with smooth folds and two cavities."""
    far = radius(places)
    x, y, z = numpy.moveaxis(places, -1, 0)
    folds = 60 * numpy.sin(x / 4.1) * numpy.cos(y / 5.3) * numpy.sin(z / 4.7 + 0.5)
    value = numpy.where(far < 0.8, 420 + folds, numpy.where(far < 0.9, 120, 300))
    for middle in ((8.0, 6, 4), (-8, 6, 4)):
        value = numpy.where(numpy.linalg.norm(places - middle, axis=-1) < 6, 180, value)
    return numpy.where(far < 1, value, 0.0)


def labels(places):
    """1 brain, 2 bone, 5 a cavity."""
    far = radius(places)
    found = numpy.where(far < 0.8, 1, numpy.where(far < 0.9, 2, 0))
    return numpy.where(numpy.linalg.norm(places - (8.0, 6, 4), axis=-1) < 6, 5, found)


def grid(axes, shape):
    """The affine (to RAS mm) of a grid around the head, and the places of its voxels."""
    affine = numpy.eye(4)
    affine[:3, :3] = axes
    affine[:3, 3] = -axes @ ((numpy.array(shape) - 1) / 2)
    index = numpy.stack(numpy.meshgrid(*map(numpy.arange, shape), indexing="ij"), axis=-1)
    return affine, index @ axes.T + affine[:3, 3]


def fiducials(points):
    """The text of a list of landmarks of 3D Slicer."""
    rows = [f"vtkMRMLMarkupsFiducialNode_{i},{x},{y},{z},0,0,0,1,1,1,0,P-{i},,"
            for i, (x, y, z) in enumerate(points)]
    return "\n".join(["# Markups fiducial file version = 4.11", "# CoordinateSystem = RAS",
                      "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID",
                      *rows, ""])


def write_volumes(path):
    affine, places = grid(UPRIGHT, (30, 30, 18))
    nibabel.Nifti1Image(head(places).astype("int16"), affine).to_filename(path("head.nii.gz"))
    moved = head(places - SHIFT).astype("float32")
    volume_files.write(path("moved.mha"), volume_files.meta_image(moved, affine, packed=True))
    moments = numpy.stack([head(places - step * SHIFT) for step in range(3)], axis=-1)
    nibabel.Nifti1Image(moments.astype("int16"), affine).to_filename(path("moments.nii"))
    affine, places = grid(TURNED, (24, 34, 24))
    oblique = head(places).astype("float32")
    volume_files.write(path("oblique.nrrd"), volume_files.nrrd(oblique, affine, encoding="gzip"))
    affine, places = grid(SAGITTAL, (32, 22, 24))
    nibabel.MGHImage(head(places).astype("float32"), affine).to_filename(path("sagittal.mgz"))
    minc_files.write(path("head.mnc"), head(places).astype("float32"), affine)
    affine, places = grid(numpy.eye(3) * 3.0, (20, 24, 22))
    volume_files.write(path("labels.nrrd"),
                       volume_files.nrrd(labels(places).astype("uint8"), affine))
    os.makedirs(path("scan"))
    dicom_testing.write_slices(
        path("scan"), numpy.moveaxis(head(places), 2, 0).transpose(0, 2, 1).astype("int16"),
        spacing=(3.0, 3.0), step=3.0, origin=(-affine[0, 3] - 57, -affine[1, 3] - 69, affine[2, 3]))


def write(folder):
    """Writes all; returns the paths of volumes, of label maps and of lists of landmarks."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)

    def path(name):
        return os.path.join(folder, name)

    write_volumes(path)
    for name, points in (("before.fcsv", LANDMARKS), ("after.fcsv", LANDMARKS + SHIFT)):
        volume_files.write(path(name), fiducials(points).encode())
    volumes = ["head.nii.gz", "oblique.nrrd", "moved.mha", "sagittal.mgz", "head.mnc",
               "moments.nii", "scan"]
    return [path(name) for name in volumes], [path("labels.nrrd")], [
        path("before.fcsv"), path("after.fcsv")]
