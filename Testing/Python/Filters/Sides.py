# SPDX-License-Identifier: BSD-3-Clause
# Proves that a volume whose file does not say where the sides of the patient are keeps that doubt:
# one warning where it meets something whose sides are known, in a comparison, a fit, a transform
# and a moved surface, and in what is saved of it. What agrees is silent, as is what is of no
# patient.
import warnings

import nibabel
import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, run_tests, scratch,
                                volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkPolyData  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter  # noqa: E402

SIDES = "left and right may be exchanged between them"
KNOWN = numpy.diag([2.0, 2.0, 2.0, 1.0])


def head(known, name="head.nii"):
    """A ball in a file, opened."""
    affine = KNOWN.copy()
    affine[:3, 3] = 5.0
    image = nibabel.Nifti1Image(numpy.pad(ball(), 2), affine)
    image.set_qform(affine, code=1)
    path = scratch(f"{'known' if known else 'unknown'}-{name}")
    image.to_filename(path)
    if not known:
        with open(path, "r+b") as file:
            file.seek(252)
            file.write(bytes(4))  # qform_code and sform_code
    return simple.NIFTIVolumeReader(FileName=path)


def said_by(step):
    with messages() as said:
        step()
    return said.text


def landmarks(name="points.csv"):
    path = scratch(name)
    with open(path, "w", encoding="ascii") as file:
        file.write("label,x,y,z\n" + "".join(
            f"{i},{x},{y},{z}\n" for i, (x, y, z) in enumerate(
                ((10, 12, 14), (30, 12, 20), (14, 40, 18), (22, 20, 44), (33, 35, 30)))))
    return path


def test_a_file_says_it_when_it_is_opened():
    for known in (True, False):
        text = said_by(lambda known=known: head(known).UpdatePipeline())
        assert ("does not say where the sides of the patient are" in text) != known, text


def test_a_comparison_of_known_and_unknown_sides():
    for volume_known, reference_known in ((True, True), (False, False), (True, False),
                                          (False, True)):
        one, other = head(volume_known), head(reference_known, "other.nii")
        one.UpdatePipeline(), other.UpdatePipeline()
        compared = simple.CompareVolumes(Input=one, Reference=other)
        text = said_by(compared.UpdatePipeline)
        assert (SIDES in text) == (volume_known != reference_known), text
        compared.SMProxy.UpdatePropertyInformation()
        assert (SIDES in compared.GetPropertyValue("Warning")) == (volume_known != reference_known)
        compared.ReferenceTranslation = [1, 2, 3]
        assert SIDES not in said_by(compared.UpdatePipeline), "it is said once"


def test_a_fit_of_landmarks_in_a_volume_of_unknown_sides():
    points = brainshift.read_points(landmarks())
    for known in (True, False):
        bent = simple.FreeFormDeformation(Input=head(known))
        for measured in (points, points.positions):
            found = brainshift.fit(bent, rest=points, measured=measured, by_order=True)
            assert (SIDES in found.warning) != known, found.warning
        assert found.warning.count("world axes") <= 1, found.warning
        found = brainshift.fit(bent, rest=points.positions, measured=points.positions + 1.0)
        assert SIDES not in found.warning, "numbers of a script are of the volume's world"


def test_a_transform_for_a_volume_of_unknown_sides():
    name = scratch("rigid.tfm")
    with open(name, "w", encoding="ascii") as file:
        file.write("#Insight Transform File V1.0\n#Transform 0\n"
                   "Transform: AffineTransform_double_3_3\n"
                   "Parameters: 1 0 0 0 1 0 0 0 1 3 0 0\nFixedParameters: 0 0 0\n")
    for known in (True, False):
        source = head(known)
        bent = simple.FreeFormDeformation(Input=source)
        brainshift.apply_transform(bent, name)
        assert (SIDES in said_by(bent.UpdatePipeline)) != known
        compared = simple.CompareVolumes(Input=source, Reference=source)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            brainshift.apply_transform(compared, name)
            brainshift.save_transform(compared, scratch("saved.tfm"))
        words = [str(warning.message) for warning in caught]
        assert len(words) == (0 if known else 2), words
        assert all(SIDES in word for word in words), words


def test_a_matrix_of_flirt_between_images_of_unknown_sides():
    name = scratch("flirt.mat")
    with open(name, "w", encoding="ascii") as file:
        file.write("1 0 0 2\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
    for known in (True, False):
        image = head(known, "image.nii").FileName
        for volume_known in (True, False):
            source = head(volume_known)
            source.UpdatePipeline()
            bent = simple.FreeFormDeformation(Input=source)
            text = said_by(lambda: (
                brainshift.apply_transform(bent, name, fixed_image=image, moving_image=image,
                                           program="fsl"), bent.UpdatePipeline()))
            assert text.count(SIDES) == (known != volume_known), (known, volume_known, text)
            compared = simple.CompareVolumes(Input=source, Reference=source)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                brainshift.apply_transform(compared, name, fixed_image=image, moving_image=image,
                                           program="fsl")
            assert len(caught) == (known != volume_known), [str(one.message) for one in caught]


def test_a_surface_and_traces_of_known_sides():
    for known in (True, False):
        bent = simple.FreeFormDeformation(Input=head(known))
        points = simple.LandmarkReader(FileName=landmarks())
        moved = simple.DeformGeometry(Input=points, Deformation=bent)
        assert (SIDES in said_by(moved.UpdatePipeline)) != known
        distance = simple.TraceDistance(Input=points, Deformation=bent, Threshold=0.5)
        assert (SIDES in said_by(distance.UpdatePipeline)) != known


def model(space):
    """A triangle in .vtp with the word by which 3D Slicer names its axes, opened."""
    word = vtkStringArray()
    word.SetName("SPACE")
    word.InsertNextValue(space)
    triangle = vtkPolyData()
    triangle.SetPoints(vtkPoints())
    triangle.AllocateExact(1, 3)
    for point in ((9, 9, 9), (20, 9, 9), (9, 20, 9)):
        triangle.GetPoints().InsertNextPoint(point)
    triangle.InsertNextCell(5, 3, (0, 1, 2))
    triangle.GetFieldData().AddArray(word)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(scratch(f"{space}.vtp"))
    writer.SetInputData(triangle)
    writer.Write()
    return simple.XMLPolyDataReader(FileName=writer.GetFileName())


def test_a_model_of_slicer_in_other_axes():
    bent = simple.FreeFormDeformation(Input=head(True))
    bent.UpdatePipeline()
    for space in ("RAS", "LPS"):
        source = model(space)
        for step in (simple.DeformGeometry(Input=source, Deformation=bent),
                     simple.TraceDistance(Input=source, Deformation=bent)):
            text = said_by(step.UpdatePipeline)
            assert (SIDES in text) == (space == "LPS"), (space, text)
            assert ("by its field array SPACE) are LPS" in text) == (space == "LPS"), text


TEXTS = {  # a triangle, and where each format has its comment
    "vtk": "# vtk DataFile Version 4.2\n3D Slicer output. SPACE={}\nASCII\nDATASET POLYDATA\n"
           "POINTS 3 float\n9 9 9 20 9 9 9 20 9\nPOLYGONS 1 4\n3 0 1 2\n",
    "ply": "ply\nformat ascii 1.0\ncomment 3D Slicer output. SPACE={}\nelement vertex 3\n"
           "property float x\nproperty float y\nproperty float z\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "9 9 9\n20 9 9\n9 20 9\n3 0 1 2\n",
    "stl": "solid 3D Slicer output. SPACE={}\nfacet normal 0 0 1\nouter loop\nvertex 9 9 9\n"
           "vertex 20 9 9\nvertex 9 20 9\nendloop\nendfacet\nendsolid\n",
    "obj": "# 3D Slicer output. SPACE={}\nv 9 9 9\nv 20 9 9\nv 9 20 9\nf 1 2 3\n"}


def test_a_model_of_slicer_that_says_it_in_a_comment():
    """In each format, behind another filter too; silent once it was turned around."""
    bent = simple.FreeFormDeformation(Input=head(True))
    bent.UpdatePipeline()
    for ending, text in TEXTS.items():
        for space in ("RAS", "LPS", "elsewhere"):
            name = scratch(f"model-{space} \u00e4.{ending}")
            with open(name, "w", encoding="ascii") as file:
                file.write(text.format(space))
            source = simple.OpenDataFile(name)
            turned = simple.Transform(Input=source, Transform="Transform")
            turned.Transform.Rotate = [0, 0, 180]
            smaller = simple.Elevation(Input=source)
            for step, warns in (
                    (simple.DeformGeometry(Input=source, Deformation=bent), True),
                    (simple.DeformGeometry(Input=smaller, Deformation=bent), True),
                    (simple.DeformGeometry(Input=turned, Deformation=bent), False),
                    (simple.TraceDistance(Input=source, Deformation=bent), True),
                    (simple.FitDeformation(Input=bent.Input, Traces=source, Threshold=0.5), True)):
                said = said_by(step.UpdatePipeline)
                expected = space == "LPS" and warns
                assert (SIDES in said) == expected, (ending, space, step, said)
                assert ("the word SPACE in its file) are LPS" in said) == expected, said


def test_a_field_of_unknown_sides_says_so_and_is_known_again():
    for ending in (".nii", ".nii.gz", ".mha", ".nrrd"):
        for known in (True, False):
            bent = simple.FreeFormDeformation(
                Input=head(known), Strokes=brainshift.soft((25, 25, 25), (2, 0, 0), 12))
            name = scratch(f"field-{known}{ending}")
            text = said_by(lambda: brainshift.save_field(bent, name))
            assert ("world axes of the input are unknown" in text) != known, (ending, text)
            loaded = []
            text = said_by(lambda: loaded.append(brainshift.load_field(name)))
            assert ("does not say where the sides" in text) != known, (ending, text)
            other = simple.FreeFormDeformation(Input=head(known), Lattice=loaded[0])
            assert SIDES not in said_by(other.UpdatePipeline), (ending, known)
            if ".nii" in ending:
                codes = nibabel.load(name).header
                assert (int(codes["sform_code"]) > 0) == known, "the grid begins at 0 0 0"


def test_worlds_that_contradict_are_said():
    bent = simple.FreeFormDeformation(Input=head(True))
    text = said_by(lambda: brainshift.save_field(bent, scratch("lps.nii"), world="LPS"))
    assert_says(text, "world axes of the input are RAS, but World is LPS")


def test_nifti_without_a_transform_has_no_codes():
    """Where the voxels lie along the axes from 0 0 0 on, as NIfTI has them without a transform;
    elsewhere the transform is written, so that voxels keep their positions."""
    for origin, code in (((0.0, 0.0, 0.0), 0), ((1.0, 2.0, 3.0), 2)):
        name = scratch("codes.nii")
        source = volume(ball(), origin=origin)
        said_by(lambda: brainshift.save_volume(source, name))
        header = nibabel.load(name).header
        assert (int(header["sform_code"]), int(header["qform_code"])) == (code, 0), origin
        back = simple.NIFTIVolumeReader(FileName=name)
        back.UpdatePipeline()
        found = servermanager.Fetch(back)
        assert numpy.allclose(found.GetOrigin(), origin), found.GetOrigin()


def test_data_of_no_patient_are_silent():
    one, other = volume(ball()), volume(ball())
    compared = simple.CompareVolumes(Input=one, Reference=other)
    assert "world axes" not in said_by(compared.UpdatePipeline)
    bent = simple.FreeFormDeformation(Input=one)
    found = brainshift.fit(bent, rest=numpy.eye(3) * 9 + 8, measured=numpy.eye(3) * 9 + 9)
    assert "world axes" not in found.warning, found.warning


run_tests(globals())
