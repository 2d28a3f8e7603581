# SPDX-License-Identifier: BSD-3-Clause
# Proves that a filter that is asked for one piece of two, as on two MPI ranks, gives the numbers of
# the whole image there, and that Bake Deformation refuses an input that is not whole.
import numpy
from brainshift_testing import assert_says, load_plugin, messages, run_tests, scratch
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, CompareVolumes, DeformationField,  # noqa: E402
                             DeformationLattice, FreeFormDeformation, InvertDisplacementField,
                             OpenDataFile, PolyPointSource, SaveData, TraceDistance, Wavelet)

SIDE = 10
EXTENT = [-SIDE, SIDE, -SIDE, SIDE, -SIDE, SIDE]
PIECES = 2
STROKES = brainshift.soft((0, 0, 0), (3, -2, 1.5), 15.0)


def wavelet_file():
    """A volume in a file: its reader, like most, delivers the piece that it is asked for."""
    name = scratch("pieces.vti")
    SaveData(name, Wavelet(WholeExtent=EXTENT))
    return name


FILE = wavelet_file()


def volume():
    return OpenDataFile(FILE)


def bent(**properties):
    return FreeFormDeformation(Input=volume(), Strokes=STROKES, **properties)


def arrays_of(image):
    """All point arrays, indexed [z, y, x, component]."""
    sides = tuple(reversed(image.GetDimensions()))
    data = image.GetPointData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).reshape(sides + (-1,)).copy()
            for i in range(data.GetNumberOfArrays())}


def fields_of(image):
    fields = image.GetFieldData()
    return {fields.GetArrayName(i): vtk_to_numpy(fields.GetArray(i)).copy()
            for i in range(fields.GetNumberOfArrays()) if fields.GetArray(i) is not None}


def piece_of(proxy, number):
    """The output of a filter nobody asked for anything before."""
    proxy.UpdateVTKObjects()
    filter = proxy.GetClientSideObject()
    filter.UpdatePiece(number, PIECES, 0)
    return filter.GetOutputDataObject(0)


def assert_pieces_are_the_whole(make):
    """Both pieces, each of a new pipeline, hold the numbers of the whole, and together all of it"""
    proxy = make()
    proxy.UpdatePipeline()
    image = proxy.GetClientSideObject().GetOutputDataObject(0)
    whole, start = arrays_of(image), image.GetExtent()[0::2]
    covered = numpy.zeros(tuple(reversed(image.GetDimensions())), int)
    assert whole, "nothing to compare"
    for number in range(PIECES):
        piece = piece_of(make(), number)
        low = [first - begin for first, begin in zip(piece.GetExtent()[0::2], start)]
        part = tuple(slice(low[axis], low[axis] + piece.GetDimensions()[axis])
                     for axis in (2, 1, 0))
        covered[part] += 1
        assert set(arrays_of(piece)) == set(whole), set(arrays_of(piece))
        for name, numbers in arrays_of(piece).items():
            different = numpy.abs(numbers - whole[name][part]).max()
            assert different < 1e-6, (name, number, different)
    assert covered.min() > 0, "points in no piece"
    assert covered.mean() < 1.5, "each piece is the whole"


def test_bake():
    for interpolation in ("Nearest", "Linear", "Cubic"):
        assert_pieces_are_the_whole(
            lambda: BakeDeformation(Input=bent(), Interpolation=interpolation))


def test_deformation_field():
    for direction in ("Forward", "Backward"):
        assert_pieces_are_the_whole(
            lambda: DeformationField(Input=bent(), Direction=direction))


def test_invert():
    def inverse():
        return InvertDisplacementField(Input=DeformationField(Input=bent(), Direction="Forward"))

    assert_pieces_are_the_whole(inverse)
    directions = [fields_of(piece_of(inverse(), number)) for number in range(PIECES)]
    whole = inverse()
    whole.UpdatePipeline()
    expected = fields_of(whole.GetClientSideObject().GetOutputDataObject(0))
    assert all(set(found) == set(expected) for found in directions), (directions, expected)


def test_lattice():
    assert_pieces_are_the_whole(lambda: DeformationLattice(Input=bent()))


def lattice_of(image):
    return fields_of(image)["FFDDisplacements"]


def test_side_inputs_of_free_form_deformation():
    def with_sides():
        return bent(Lattice=DeformationField(Input=bent(), Direction="Forward"), Mask=volume(),
                    Segmentation=volume(), Feather=3.0)

    whole = with_sides()
    whole.UpdatePipeline()
    expected = fields_of(whole.GetClientSideObject().GetOutputDataObject(0))
    assert numpy.abs(expected["FFDDisplacements"]).max() > 1.0
    for number in range(PIECES):
        found = fields_of(piece_of(with_sides(), number))
        assert set(found) == set(expected), set(found) ^ set(expected)
        for name, numbers in expected.items():
            assert found[name].shape == numbers.shape, (name, found[name].shape, numbers.shape)
            assert numpy.abs(found[name].astype(float) - numbers).max() < 1e-6, name


def test_reference_of_compare_volumes():
    def compared():
        return CompareVolumes(Input=bent(), Reference=volume(), Cavity=volume())

    whole = compared()
    whole.UpdatePipeline()
    expected = fields_of(whole.GetClientSideObject().GetOutputDataObject(0))
    for number in range(PIECES):
        found = fields_of(piece_of(compared(), number))
        assert {name: numbers.shape for name, numbers in found.items()} == {
            name: numbers.shape for name, numbers in expected.items()}


def distances_of(points, number=None):
    trace = TraceDistance(Input=points, Deformation=bent(), SurfaceBy="Threshold",
                          Threshold=220.0)
    if number is None:
        trace.UpdatePipeline()
    else:
        piece_of(trace, number)
    result = trace.GetClientSideObject().GetOutputDataObject(0).GetPointData()
    return vtk_to_numpy(result.GetArray("DistanceToCortex")).copy()


def test_trace_distance():
    places = [float(mm) for mm in numpy.random.default_rng(3).uniform(-9, 9, 60)]
    expected = distances_of(PolyPointSource(Points=places))
    assert expected.min() < -0.5 and expected.max() > 0.5, expected
    found = distances_of(PolyPointSource(Points=places), 0)  # this source gives the first piece all
    assert numpy.abs(found - expected).max() < 1e-6, numpy.abs(found - expected).max()


def test_bake_refuses_a_part():
    whole = bent()
    whole.UpdatePipeline()
    part = vtkImageData()
    part.DeepCopy(whole.GetClientSideObject().GetOutputDataObject(0))
    extent = list(part.GetExtent())
    producer = vtkTrivialProducer()
    producer.SetOutput(part)
    producer.SetWholeExtent(extent)
    part.Crop([*extent[:5], 0])
    bake = BakeDeformation(Input=whole).GetClientSideObject()
    bake.SetInputConnection(producer.GetOutputPort())
    with messages() as said:
        bake.UpdatePiece(0, 1, 0)
    assert_says(said.text, "21 x 21 x 11 points", "21 x 21 x 21 points")


run_tests(globals())
