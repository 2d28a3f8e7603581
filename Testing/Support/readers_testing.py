# SPDX-License-Identifier: BSD-3-Clause
"""What tests of readers on servers and on several MPI ranks share: files of all formats, and what
is read from them. As a script of pvbatch, this module writes the answers into the file that it is
given."""

import os
import shutil
import sys

import dicom_testing
import minc_files
import nibabel
import numpy
import outside_testing
import volume_files
import zarr_files
from brainshift_testing import data, messages
from paraview import servermanager, simple

AFFINE = volume_files.tilted(list(volume_files.turns())[29])
SHAPE = (7, 6, 5)
#: Readers of the images in the folder of files, and their names there.
IMAGES = {"volume.nii": "NIFTIVolumeReader", "volume.nrrd": "NRRDVolumeReader",
          "volume.mha": "MHAVolumeReader", "volume.mgz": "MGHVolumeReader",
          "volume.mnc": "MINCVolumeReader", "sheared.nrrd": "NRRDVolumeReader",
          "stack.zarr": "OMEZarrReader", "slices": "DICOMFileReader",
          "field.nrrd": "DisplacementFieldReader", "spline.tfm": "TransformReader"}
POINTS = numpy.random.default_rng(4).uniform((-60, -40, 10), (20, 40, 70), (50, 3))
SECOND = "2, Neck, CT, 6 x 5 x 3, 2024-02-29"


def spline():
    """A B-spline of ITK over the landmarks: it has points of its own."""
    coefficients = numpy.random.default_rng(3).uniform(-4, 4, (3, 8, 9, 10))
    return "BSplineTransform", coefficients, (
        10, 9, 8, -40, -75, -20, 16, 17, 18, 1, 0, 0, 0, 1, 0, 0, 0, 1)


def write_dicom(path):
    """Two series in one folder: five slices at two points in time, and three slices."""
    os.makedirs(path)

    def at_time(seconds):
        def change(image, _):
            image.AcquisitionTime = f"1015{seconds:02d}"
        return change

    def other(image, _):
        image.SeriesInstanceUID = "1.2.3.4.6"
        image.SeriesNumber = 2
        image.SeriesDescription = "Neck"

    oblique = dicom_testing.OBLIQUE
    for step in range(2):
        dicom_testing.write_slices(path, dicom_testing.numbered(5, start=500 * step), axes=oblique,
                                   change=at_time(10 * step), start=100 * step)
    dicom_testing.write_slices(path, dicom_testing.numbered(3, start=2000), change=other,
                               start=200)


def write_files(folder):
    """Files of all formats, written by others than us."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)

    def path(name):
        return os.path.join(folder, name)

    voxels = volume_files.numbered(SHAPE)
    sheared = AFFINE + 0.2 * numpy.outer(AFFINE[:, 0], (0, 1, 0, 0))
    volume_files.write(path("sheared.nrrd"), volume_files.nrrd(voxels, sheared))
    nibabel.Nifti1Image(voxels, AFFINE).to_filename(path("volume.nii"))
    volume_files.write(path("volume.nrrd"), volume_files.nrrd(voxels, AFFINE))
    volume_files.write(path("volume.mha"), volume_files.meta_image(voxels, AFFINE))
    nibabel.MGHImage(voxels, AFFINE).to_filename(path("volume.mgz"))
    minc_files.write(path("volume.mnc"), voxels.astype("float32"), AFFINE)
    write_dicom(path("slices"))
    zarr_files.write_array(path("stack.zarr"), "0", voxels.T, chunks=(2, 3, 2))
    zarr_files.describe(path("stack.zarr"), [zarr_files.level("0", [2, 3, 4], [5, 6, 7])])
    vectors = numpy.random.default_rng(9).uniform(-3, 3, (5, 6, 7, 3)).astype("<f4")
    header = ("NRRD0004\ntype: float\ndimension: 4\nsizes: 3 7 6 5\nkinds: vector domain domain "
              "domain\nspace: left-posterior-superior\nspace directions: none (9,0,0) (0,8,0) "
              "(0,0,7)\nspace origin: (-60,-40,10)\nendian: little\nencoding: raw\n\n")
    volume_files.write(path("field.nrrd"), header.encode() + vectors.tobytes())
    volume_files.write(path("spline.tfm"), outside_testing.itk_text(spline()).encode())
    shutil.copy(data("afids-colin27", "sub-Colin27_afids.fcsv"), path("landmarks.fcsv"))
    return folder


def rows(source, time=None):
    """Places of all points on all ranks with their numbers, sorted: a row for each. Ranks share the
    points between their pieces of an image, so the same row counts once."""
    points = simple.MaskPoints(  # ParaView brings no images together
        Input=source, MaximumNumberofPoints=10 ** 6, OnRatio=1)
    points.UpdatePipeline(*([] if time is None else [time]))
    whole = servermanager.Fetch(points)
    simple.Delete(points)
    arrays = whole.GetPointData()
    array = arrays.GetScalars() or arrays.GetVectors() or arrays.GetArray(0)
    found = numpy.array([[*whole.GetPoint(i), *array.GetTuple(i)]
                         for i in range(whole.GetNumberOfPoints())])
    return numpy.unique(numpy.round(found, 5), axis=0)


def told(source):
    """What ParaView knows of all ranks: cells, which no two pieces of an image share, and bounds;
    and the range of each component."""
    information = source.GetDataInformation()
    arrays = information.GetPointDataInformation()
    ranges = [arrays.GetArrayInformation(i).GetComponentRange(0)
              for i in range(arrays.GetNumberOfArrays())
              if arrays.GetArrayInformation(i).GetNumberOfComponents() == 1]
    return numpy.array([information.GetNumberOfCells(), *information.GetBounds(),
                        *numpy.ravel(ranges)])


def opened(name, kind):
    reader = simple.OpenDataFile(name)
    assert reader is not None, f"no reader for {name}"
    assert reader.GetXMLName() == kind, (name, reader.GetXMLName())
    reader.UpdatePipeline()
    return reader


def answer_images(found, folder):
    for name, kind in IMAGES.items():
        reader = opened(os.path.join(folder, name), kind)
        found[name], found[name + " told"] = rows(reader), told(reader)
        simple.Delete(reader)


def answer_series(found, folder):
    """Points in time, and the other series, as the panel chooses it."""
    reader = opened(os.path.join(folder, "slices"), "DICOMFileReader")
    found["times"] = numpy.array(reader.TimestepValues)
    found["later"] = rows(reader, reader.TimestepValues[1])
    offered = list(reader.GetProperty("Series").Available)
    assert len(offered) == 2 and offered[1] == SECOND, offered
    assert list(reader.GetProperty("SeriesList")) == offered
    reader.Series = SECOND
    reader.UpdatePipeline()
    found["other series"], found["other series told"] = rows(reader), told(reader)
    simple.Delete(reader)


def answer_points(found, folder):
    import brainshift
    reader = opened(os.path.join(folder, "landmarks.fcsv"), "LandmarkReader")
    found["landmarks"] = numpy.array([reader.GetDataInformation().GetNumberOfPoints()])
    simple.Delete(reader)
    points = brainshift.read_points(os.path.join(folder, "landmarks.fcsv"))
    found["positions"] = points.positions
    assert len(set(points.labels)) == len(points.labels) == 32, points.labels


def answer_transforms(found, folder):
    """A map, a volume that it bends, and landmarks that go along, into a file."""
    import brainshift
    name = os.path.join(folder, "spline.tfm")
    found["mapped"] = brainshift.read_transform(name).map(POINTS)
    volume = opened(os.path.join(folder, "volume.nrrd"), "NRRDVolumeReader")
    bent = simple.FreeFormDeformation(Input=volume, LatticeDimensions=[9, 9, 9])
    found["largest error"] = numpy.array([brainshift.apply_transform(bent, name)])
    found["bent"] = brainshift.rest_from_deformed(bent, POINTS)
    out = os.path.join(folder, "mapped.csv")
    brainshift.map_points(os.path.join(folder, "landmarks.fcsv"), out, bent)
    found["points in a file"] = brainshift.read_points(out).positions
    field = simple.DisplacementFieldReader(FileName=os.path.join(folder, "field.nrrd"))
    bent.Lattice = simple.InvertDisplacementField(Input=field)
    found["bent by a field"] = brainshift.rest_from_deformed(bent, POINTS)


def answer_written(found, folder):
    """Volumes and series that leave, and come in again."""
    import brainshift
    volume = opened(os.path.join(folder, "volume.mha"), "MHAVolumeReader")
    for ending in ("nii.gz", "nrrd", "mha"):
        name = os.path.join(folder, "out." + ending)
        brainshift.save_volume(volume, name)
        found["written " + ending] = rows(simple.OpenDataFile(name))
    series = os.path.join(folder, "out")
    shutil.rmtree(series, ignore_errors=True)
    brainshift.save_dicom(volume, series, os.path.join(folder, "slices"))
    found["written series"] = rows(opened(series, "DICOMFileReader"))
    found["files of the series"] = numpy.array([len(os.listdir(series))])


#: An input that all ranks make together. Before the second piece it puts a file in the place of the
#: finest level, which the first rank writes.
TOGETHER = """
import os, shutil
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
output.VTKObject.ShallowCopy(inputs[0].VTKObject)
if ranks.GetLocalProcessId() == 0 and os.path.isdir(LEVEL):
    shutil.rmtree(LEVEL)
    open(LEVEL, "w").close()
ranks.Barrier()
"""


def answer_stopped(found, folder):
    """A store whose writing fails on the first rank: the others ask for no piece more."""
    store = os.path.join(folder, "stopped.zarr")
    shutil.rmtree(store, ignore_errors=True)
    level = repr(os.path.join(store, "0"))
    together = simple.ProgrammableFilter(Input=simple.Wavelet(WholeExtent=[0, 9, 0, 9, 0, 199]),
                                         Script=TOGETHER.replace("LEVEL", level))
    writer = servermanager.writers.OMEZarrWriter(Input=together, FileName=store, MemoryLimit=0.0)
    with messages():
        writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    found["stopped"] = numpy.array([float("entry '0/" in writer.GetPropertyValue("Problem"))])


def refusal(call, *arguments):
    try:
        call(*arguments)
    except (OSError, ValueError) as error:
        return str(error)
    return ""


def refusals(folder):
    """Points that readers find in a file that is not there, and what else says that it is not. It
    is an error on every rank, and nobody may wait for another."""
    import brainshift
    missing = os.path.join(folder, "missing")
    points = []
    for kind in ("DICOMVolumeReader", "NIFTIVolumeReader", "NRRDVolumeReader",
                 "DisplacementFieldReader"):
        reader = getattr(simple, kind)(FileName=missing)
        reader.UpdatePipeline()
        points.append(reader.GetDataInformation().GetNumberOfPoints())
        simple.Delete(reader)
    return points, [refusal(brainshift.read_points, missing + ".fcsv"),
                    refusal(brainshift.read_transform, missing + ".tfm")]


def answers(folder):
    """All answers by name. Files are written into the folder, too."""
    found = {}
    answer_images(found, folder)
    answer_series(found, folder)
    answer_points(found, folder)
    answer_transforms(found, folder)
    answer_written(found, folder)
    answer_stopped(found, folder)
    return found


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=simple.__dict__)
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=True, ns=simple.__dict__)
    numpy.savez(sys.argv[1], **answers(sys.argv[2]))
