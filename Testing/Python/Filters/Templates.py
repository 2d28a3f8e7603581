# SPDX-License-Identifier: BSD-3-Clause
# Proves that a file in the space of a template keeps that word, in what is baked and saved of it,
# and that one warning says so where it meets something in the scanner's space or in that of another
# template: a reference or a surface. Opening it is silent.
import nibabel
import numpy
from brainshift_testing import (ball, load_plugin, messages, output, run_tests, scratch)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

WORDS = "they fit each other only if they were registered"
NAMES = {0: None, 1: None, 2: None, 3: "Talairach", 4: "MNI 152", 5: "not named"}


def template_of(source):
    word = output(source).GetFieldData().GetAbstractArray("Template")
    return word.GetValue(0) if word else None


def head(sform, qform=0):
    """A ball in a file with these codes, opened without a word."""
    image = nibabel.Nifti1Image(ball(), numpy.diag([2.0, 2.0, 2.0, 1.0]))
    image.set_sform(image.affine, code=sform)
    image.set_qform(image.affine, code=qform)
    path = scratch(f"head-{sform}-{qform}.nii")
    image.to_filename(path)
    source = simple.NIFTIVolumeReader(FileName=path)
    assert not said_by(source.UpdatePipeline)
    return source


def said_by(step):
    with messages() as said:
        step()
    return said.text


def surface(space):
    """A triangle in GIFTI, opened."""
    intents, arrays = nibabel.nifti1.intent_codes.niistring, []
    for numbers, intent in ((numpy.array([[9, 9, 9], [20, 9, 9], [9, 20, 9]], "f4"), 1008),
                            (numpy.array([[0, 1, 2]], "i4"), 1009)):
        arrays.append(nibabel.gifti.GiftiDataArray(
            numbers, intent=intents[intent],
            coordsys=nibabel.gifti.GiftiCoordSystem(space, space)))
    path = scratch(f"{space}.surf.gii")
    nibabel.save(nibabel.gifti.GiftiImage(darrays=arrays), path)
    return simple.SurfaceReader(FileName=path)


def test_the_code_that_counts_names_the_template():
    for code, name in NAMES.items():
        if code:
            assert template_of(head(code)) == name, code
            assert template_of(head(0, code)) == name, code
    assert template_of(head(1, 4)) is None
    assert template_of(head(4, 1)) == "MNI 152"


def test_what_is_made_of_a_template_is_in_its_space():
    for code in (1, 3, 4, 5):
        bent = simple.FreeFormDeformation(Input=head(code))
        baked = simple.BakeDeformation(Input=bent)
        assert template_of(bent) == template_of(baked) == NAMES[code]
        name = scratch("saved.nii")
        brainshift.save_volume(baked, name)
        header = nibabel.load(name).header
        assert int(header["sform_code"]) == int(header["qform_code"]) == code


def test_a_reference_in_another_space_is_told():
    spaces = (1, 3, 4, 5)
    for volume in spaces:
        for reference in spaces:
            one, other = head(volume), head(reference)
            text = said_by(simple.CompareVolumes(Input=one, Reference=other).UpdatePipeline)
            is_told = volume != reference and (1 in (volume, reference) or
                                               5 not in (volume, reference))
            assert (WORDS in text) == is_told, (volume, reference, text)
    text = said_by(simple.CompareVolumes(Input=head(1), Reference=head(4)).UpdatePipeline)
    assert ("the reference is in the space of a template (MNI 152) and the volume is in no "
            "template's") in text, text


def test_a_surface_in_a_template_is_told():
    for space, name in (("SCANNER_ANAT", None), ("TALAIRACH", "Talairach"), ("MNI_152", "MNI 152")):
        triangle = surface(f"NIFTI_XFORM_{space}")
        assert not said_by(triangle.UpdatePipeline)
        assert template_of(triangle) == name
        for code in (1, 3, 4):
            bent = simple.FreeFormDeformation(Input=head(code))
            bent.UpdatePipeline()
            text = said_by(simple.DeformGeometry(Input=triangle, Deformation=bent).UpdatePipeline)
            assert (WORDS in text) == (name not in (None, NAMES[code])), (space, code, text)


run_tests(globals())
