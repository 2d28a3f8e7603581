# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces and streamlines as files that nibabel writes, in volumes that lie anyhow.

Where tkRAS lies in the scanner's RAS is nibabel's answer: vox2ras and vox2ras_tkr of a volume.
"""

import nibabel
import numpy
from brainshift_testing import assert_says, messages, output
from nibabel import gifti, streamlines
from vtkmodules.util.numpy_support import vtk_to_numpy

#: A tetrahedron, mm, counter-clockwise from outside.
POINTS = numpy.array([[10.0, -20.0, 30.0], [40.5, -21.0, 29.0], [12.0, 15.25, 28.0],
                      [11.0, -5.0, 61.125]])
TRIANGLES = numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def turned(random):
    """A matrix of a rotation."""
    q, _ = numpy.linalg.qr(random.normal(size=(3, 3)))
    return q * numpy.sign(numpy.linalg.det(q))


def volumes():
    """Volumes as FreeSurfer's headers place them: conformed, oblique, uneven, in other orders."""
    random = numpy.random.default_rng(11)
    conformed = numpy.array([[-1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]])
    orders = [(conformed, (8, 8, 8), (1, 1, 1))]
    orders += [(turned(random) @ conformed, (8, 6, 10), (1.0, 0.5, 2.5)) for _ in range(4)]
    orders += [(turned(random), (7, 9, 5), (0.9, 1.1, 3.0)) for _ in range(3)]
    for axes, shape, sizes in orders:
        affine = numpy.eye(4)
        affine[:3, :3] = axes * sizes
        affine[:3, 3] = random.uniform(-90, 90, 3)
        yield nibabel.MGHImage(numpy.zeros(shape, numpy.uint8), affine)


def scanner_from_surface(image):
    """4 x 4: tkRAS of a volume to the scanner's RAS, by nibabel."""
    return image.header.get_vox2ras() @ numpy.linalg.inv(image.header.get_vox2ras_tkr())


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def geometry(image, valid="1  # volume info valid"):
    """What FreeSurfer writes after the triangles, for nibabel."""
    header = image.header
    return {"head": [2, 0, 20], "valid": valid, "filename": "orig.mgz",
            "volume": numpy.array(image.shape[:3]), "voxelsize": header["delta"],
            "xras": header["Mdc"][0], "yras": header["Mdc"][1], "zras": header["Mdc"][2],
            "cras": header["Pxyz_c"]}


def write_surface(name, info=None, points=POINTS, triangles=TRIANGLES):
    nibabel.freesurfer.write_geometry(name, points, triangles, "created by a test", info)
    return name


def data_array(values, intent, **named):
    return gifti.GiftiDataArray(numpy.ascontiguousarray(values), intent=intent, **named)


def gifti_arrays(system=None, encoding="GIFTI_ENCODING_B64GZ", **named):
    """The arrays of points and triangles."""
    points = data_array(POINTS.astype(numpy.float32), "NIFTI_INTENT_POINTSET",
                        encoding=encoding, coordsys=system, **named)
    triangles = data_array(TRIANGLES.astype(numpy.int32), "NIFTI_INTENT_TRIANGLE",
                           encoding=encoding, **named)
    return [points, triangles]


def write_gifti(name, arrays, **named):
    nibabel.save(gifti.GiftiImage(darrays=arrays, **named), name, mode="force")
    return name


def write_tracts(name, lines, image, **named):
    """Streamlines in RAS mm. A .trk file keeps them in the voxels of an image."""
    tractogram = streamlines.Tractogram(lines, affine_to_rasmm=numpy.eye(4), **named)
    header = {"voxel_to_rasmm": image.affine.astype(numpy.float32),
              "voxel_sizes": nibabel.affines.voxel_sizes(image.affine).astype(numpy.float32),
              "dimensions": image.shape[:3],
              "voxel_order": "".join(nibabel.aff2axcodes(image.affine))}
    streamlines.save(tractogram, name, header=header if name.endswith(".trk") else None)
    return name


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def triangles_of(data):
    return vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def lines_of(data):
    """The points of each line."""
    ends = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    ids = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    points = points_of(data)
    return [points[ids[first:end]] for first, end in zip(ends, ends[1:])]


def read_by(reader, name, words=(), **named):
    """What a reader makes of a file, and says: all of the words, or nothing."""
    with messages() as said:
        data = output(reader(FileName=name, **named))
    assert_says(said.text, *words)
    assert words or not said.text, said.text
    return data


def refusal_by(reader, name, **named):
    """The one sentence with which a reader refuses a file. Nothing comes out."""
    with messages() as said:
        data = output(reader(FileName=name, **named))
    assert data.GetNumberOfPoints() == 0 and "ERROR" in said.text, (name, said.text)
    sentence = said.text.split("): ", 1)[1].splitlines()[0]
    assert sentence.endswith(".") and len(sentence) < 600, said.text
    return sentence
