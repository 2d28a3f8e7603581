# SPDX-License-Identifier: BSD-3-Clause
# Proves that a state file, a script and a saved lattice of version 0.1 load with every setting, and
# with the control points that they had; and that the picture is that of the pipeline made anew, to
# the bit.
import gzip
import shutil

import numpy
from brainshift_testing import (assert_says, data, load_plugin, messages, output, picture,
                                run_tests, scratch)
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()

SETTINGS = {"LatticeDimensions": [5, 6, 7], "Kernel": "B-Spline", "Samples": 3, "MaskLabels": [1],
            "MaskGrowth": 1.5, "Feather": 3.0}


def run_script():
    """The functions of the old script."""
    name, functions = data("old-files", "pipeline.py"), {}
    with open(name, encoding="utf-8") as file:
        exec(compile(file.read(), name, "exec"), functions)
    return functions


def displacements(proxy):
    return vtk_to_numpy(output(proxy).GetPointData().GetArray("Displacement"))


def expect_near_to_file(proxy, name):
    """Control points of a file of version 0.1, to what another processor may round."""
    file = simple.XMLImageDataReader(FileName=[data("old-files", name)])
    expected = displacements(file)
    assert numpy.abs(expected).max() > 1.0, "nothing to compare"
    assert numpy.allclose(displacements(proxy), expected, rtol=0, atol=1e-5)


def expect_settings(bent):
    for proxy in (bent, bent.Lattice):
        for name, expected in SETTINGS.items():
            value = proxy.GetPropertyValue(name)
            assert (list(value) if isinstance(expected, list) else value) == expected, (name, value)
        assert proxy.Mask == simple.FindSource("Tissue")
    assert list(bent.Lattice.Base.LatticeDimensions) == SETTINGS["LatticeDimensions"]


def made_anew():
    """The picture of the script, with the control points of version 0.1."""
    simple.ResetSession()
    load_plugin()
    functions = run_script()
    with messages() as said:
        bent = functions["make_pipeline"]()
        view = functions["make_view"](bent)
        # The script leaves it to ParaView, which begins with "Lab" since version 6.
        simple.GetColorTransferFunction("RTData").ColorSpace = "Diverging"
        image = picture(view)
    assert "fitted for" not in said.text, said.text
    expect_settings(bent)
    expect_near_to_file(simple.DeformationLattice(Input=bent), "bent.vti")
    expect_near_to_file(bent.Lattice, "fitted.vti")
    assert (image.max(axis=2) > 0.02).mean() > 0.1, "nothing to compare"
    return image


def expect_same(found, expected):
    assert numpy.array_equal(found, expected), f"{(found != expected).any(axis=2).sum()} differ"


def test_a_script_and_a_state_file_of_the_old_version():
    expected = made_anew()
    simple.ResetSession()
    load_plugin()
    state = scratch("OldFiles-unpacked.pvsm")
    with gzip.open(data("old-files", "pipeline.pvsm.gz")) as packed, open(state, "wb") as file:
        shutil.copyfileobj(packed, file)
    with messages() as said:
        simple.LoadState(state)
        view = simple.GetActiveViewOrCreate("RenderView")
        found = picture(view)
    assert "fitted for" not in said.text, said.text
    bent = simple.FindSource("Bent")
    expect_settings(bent)
    expect_same(found, expected)
    # Saved and loaded by the present version it is the same again.
    name = scratch("OldFiles.pvsm")
    simple.SaveState(name)
    simple.ResetSession()
    load_plugin()
    simple.LoadState(name)
    expect_settings(simple.FindSource("Bent"))
    expect_same(picture(simple.GetActiveViewOrCreate("RenderView")), expected)


def test_a_saved_lattice_of_the_old_version_is_judged_by_its_text():
    expected = made_anew()
    bent, view = simple.FindSource("Bent"), simple.GetActiveViewOrCreate("RenderView")
    file = simple.XMLImageDataReader(FileName=[data("old-files", "fitted.vti")])
    assert output(file).GetFieldData().GetAbstractArray("FittedFor").IsA("vtkStringArray")
    fit = displacements(bent.Lattice)
    with messages() as said:
        bent.Lattice = file
        found = picture(view)
    assert "fitted for" not in said.text, said.text
    if numpy.array_equal(displacements(file), fit):  # the processor that wrote the file
        expect_same(found, expected)
    assert numpy.abs(found - expected).mean() < 1e-3
    for name, value, fitted, here in (
            ("Samples", 2, "Samples 3", "Samples 2"),
            ("Kernel", "Catmull-Rom", "Kernel B-Spline", "Kernel Catmull-Rom"),
            ("Feather", 1.0, "a mask that lets", "a mask that lets"),
            ("Mask", None, "a mask that lets", "no mask")):
        former = bent.Mask if name == "Mask" else SETTINGS[name]
        with messages() as said:
            setattr(bent, name, value)
            bent.UpdatePipeline()
        assert_says(said.text, f"was fitted for {fitted}")
        assert_says(said.text, f"This deformation has {here}")
        with messages() as said:
            setattr(bent, name, former)
            bent.UpdatePipeline()
        assert "fitted for" not in said.text, (name, said.text)


run_tests(globals())
