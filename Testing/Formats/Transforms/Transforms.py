# SPDX-License-Identifier: BSD-3-Clause
# Proves with programs of others that transforms mean here what they mean there: the same points go
# to the same places within 0.01 mm, for files of ITK, ANTs and elastix that are read, and for ours
# that are written. No number is symmetric, so a wrong sign of LPS or RAS shows.
import glob
import os
import re
import shutil
import struct

import numpy
from brainshift_testing import (
    assert_says, load_plugin, messages, on_server, run_tests, scratch, server_finds_plugin, volume)
from outside_testing import (
    FLIP, itk_text, mapped_by_parameters, mapped_outside, numbers, of_itk_text, parameter_file, run,
    write, write_hdf5, write_image, write_matlab)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    CompareVolumes, FreeFormDeformation, InvertDisplacementField, OpenDataFile, TransformReader)

NEAR = 0.01  # mm
POINTS = numpy.random.default_rng(5).uniform((-60, -30, 5), (10, 45, 70), (200, 3))  # RAS, mm
CENTRE = (11.0, -7.0, 25.0)
MATRIX = (1.1, 0.07, -0.03, -0.05, 0.93, 0.11, 0.02, -0.08, 1.04)
SHIFT = (3.0, -8.0, 5.5)
#: Type, parameters, fixed parameters, and what it is here.
LINEAR = (
    ("AffineTransform", (*MATRIX, *SHIFT), CENTRE, "affine"),
    ("MatrixOffsetTransformBase", (*MATRIX, *SHIFT), CENTRE, "affine"),
    ("Euler3DTransform", (0.3, -0.2, 0.5, *SHIFT), CENTRE, "rigid"),
    ("Euler3DTransform", (0.3, -0.2, 0.5, *SHIFT), (*CENTRE, 1.0), "rigid"),
    ("Similarity3DTransform", (0.2, -0.1, 0.3, *SHIFT, 1.2), CENTRE, "affine"),
    ("TranslationTransform", SHIFT, (), "rigid"),
)
RIGID, SIMILAR = LINEAR[2], LINEAR[4]
#: Points that stay in the volume.
INNER = numpy.random.default_rng(6).uniform((-45, -15, 22), (-5, 25, 52), (200, 3))
#: A volume over the points, RAS.
BOX = volume(numpy.zeros((21, 21, 21), numpy.float32), origin=(-70.0, -40.0, 0.0),
             spacing=(4.5, 4.75, 4.0))


def largest(found, right):
    return numpy.linalg.norm(found - right, axis=1).max()


def raises(error, words, call, *arguments, **options):
    try:
        call(*arguments, **options)
    except error as found:
        assert words in str(found), (words, found)
    else:
        raise AssertionError(f"no {error.__name__} says {words}")


def spline(seed=3):
    """A B-spline around the points, in ITK's form."""
    coefficients = numpy.random.default_rng(seed).uniform(-4, 4, (3, 8, 9, 10))
    return "BSplineTransform", coefficients, (
        10, 9, 8, -40, -75, -20, 16, 17, 18, 1, 0, 0, 0, 1, 0, 0, 0, 1)


def test_itk_linear_transforms():
    for kind, parameters, fixed, what in LINEAR:
        name = write("linear.tfm", itk_text((kind, parameters, fixed)))
        transform = brainshift.read_transform(name)
        right = mapped_outside(POINTS, (kind, parameters, fixed))
        matrix = transform.moving_from_fixed
        assert transform.kind == what, (kind, transform.kind)
        assert largest(transform.map(POINTS), right) < NEAR, kind
        assert largest(POINTS @ matrix[:3, :3].T + matrix[:3, 3], right) < NEAR, kind
        assert largest(right, POINTS) > 1.0, kind
        old = write("old.tfm", itk_text((kind, parameters, fixed)).replace("\n", "\r"))
        assert largest(brainshift.read_transform(old).map(POINTS), right) < NEAR, kind
    # A versor is a similarity of scale 1, without the scale.
    versor = write("versor.tfm", itk_text(("VersorRigid3DTransform", SIMILAR[1][:6], CENTRE)))
    transform = brainshift.read_transform(versor)
    right = mapped_outside(POINTS, (SIMILAR[0], (*SIMILAR[1][:6], 1.0), CENTRE))
    assert transform.kind == "rigid" and largest(transform.map(POINTS), right) < NEAR


def test_itk_spline_and_composite():
    """Of a composite, the last member meets points first."""
    for name, members in (
            ("spline.tfm", (spline(),)),
            ("composite.tfm", (LINEAR[0][:3], RIGID[:3], spline()))):
        whole = members if len(members) == 1 else (("CompositeTransform", None, None), *members)
        transform = brainshift.read_transform(write(name, itk_text(*whole)))
        assert transform.kind == "nonlinear" and transform.moving_from_fixed is None
        right = mapped_outside(POINTS, *reversed(members))
        assert largest(transform.map(POINTS), right) < NEAR, name


def files_of_ants():
    """A warp, an affine transform and both as one file, as antsRegistration writes them."""
    import nibabel
    z, y, x = numpy.mgrid[:25, :24, :23]
    sides, origin, spacing = (23, 24, 25), (-30.0, -70.0, -15.0), (5.0, 5.5, 6.0)  # LPS
    vectors = numpy.stack((3 * numpy.sin(x / 5.0 + y / 9.0), 4 * numpy.cos(z / 6.0),
                           -5 * numpy.sin(y / 7.0 - x / 8.0)), axis=-1).astype("f4")
    affine = numpy.diag((*(FLIP * spacing), 1.0))
    affine[:3, 3] = FLIP * origin
    warp = nibabel.Nifti1Image(vectors.transpose(2, 1, 0, 3)[:, :, :, None], affine)
    warp.header.set_intent(1007)
    nibabel.save(warp, scratch("ants1Warp.nii.gz"))
    kind, parameters, fixed = LINEAR[0][:3]
    write_matlab(scratch("ants0GenericAffine.mat"), (kind, parameters, fixed))
    write_hdf5(scratch("antsComposite.h5"), ("CompositeTransform", None, None),
               (kind, parameters, fixed),
               ("DisplacementFieldTransform", vectors.ravel(),
                (*sides, *origin, *spacing, 1, 0, 0, 0, 1, 0, 0, 0, 1)), spelling="Tranform")
    field = write_image("warp.mha", vectors, origin, spacing)
    return scratch("ants1Warp.nii.gz"), scratch("ants0GenericAffine.mat"), scratch(
        "antsComposite.h5"), field


def test_files_of_ants():
    warp, affine, composite, field = files_of_ants()
    right = mapped_outside(POINTS, field, LINEAR[0][:3])
    assert largest(right, POINTS) > 1.0
    for files in ((warp, affine), composite):
        found = brainshift.read_transform(files).map(POINTS)
        assert largest(found, right) < NEAR, (files, largest(found, right))
    found = brainshift.read_transform(affine).map(POINTS)
    assert largest(found, mapped_outside(POINTS, LINEAR[0][:3])) < NEAR
    # The picture that ANTs would make: each drawn point shows what the chain takes it to.
    for kernel, files in (("Catmull-Rom", (warp, affine)), ("B-Spline", composite)):
        bent = FreeFormDeformation(Input=BOX, Kernel=kernel, LatticeDimensions=(41, 41, 41))
        error = brainshift.apply_transform(bent, files)
        away = largest(brainshift.rest_from_deformed(bent, INNER),
                       mapped_outside(INNER, field, LINEAR[0][:3]))
        print(f"lattice: {error:.3f} mm between control points, {away:.3f} mm at the points")
        assert 0.0 < error and away < 0.2, (files, error, away)


def test_files_of_elastix():
    turn = (0.96, -0.28, 0, 0.28, 0.96, 0, 0, 0, 1)
    kind, coefficients, fixed = spline(4)
    turned = (kind, coefficients, (*fixed[:9], *turn))
    for members in ((RIGID[:3],), (LINEAR[3][:3],), (SIMILAR[:3],), (turned,),
                    (RIGID[:3], spline(4))):
        name = parameter_file("from_elastix.txt", *members)
        found, right = brainshift.read_transform(name).map(POINTS), mapped_outside(POINTS, *members)
        assert largest(right, POINTS) > 1.0
        assert largest(found, right) < NEAR, (name, largest(found, right))


def test_names_in_files_of_elastix_are_of_their_folder_first():
    """Two patients have files of the same names, and BrainShift was started in the folder of the
    wrong one. Only what the right folder lacks comes from there, and a warning names it."""
    right, wrong = scratch("right_patient"), scratch("wrong_patient")
    for folder, shift in ((right, 1.0), (wrong, 50.0)):
        os.makedirs(os.path.join(folder, "first"), exist_ok=True)
        for name in ("first/0.txt", "beside.txt"):
            shutil.copy(parameter_file("0.txt", ("TranslationTransform", (shift, 0, 0), ())),
                        os.path.join(folder, name))
    shutil.copy(os.path.join(wrong, "beside.txt"), os.path.join(wrong, "only.txt"))
    before = os.getcwd()
    os.chdir(wrong)
    try:
        for initial, x in (("first/0.txt", 1.0), ("beside.txt", 1.0), ("./gone/beside.txt", 1.0),
                           (os.path.join(wrong, "beside.txt"), 50.0), ("only.txt", 50.0)):
            with open(parameter_file("1.txt", ("TranslationTransform", (0, 2.0, 0), ()))) as file:
                text = file.read().replace("NoInitialTransform", initial)
            name = os.path.join(right, "1.txt")
            with open(name, "w") as file:
                file.write(text)
            with messages() as said:
                found = brainshift.read_transform(name).map(POINTS) - POINTS
            assert numpy.allclose(found, (-x, -2.0, 0.0)), (initial, found[0])
            warned = os.path.join(wrong, "only.txt") in said.text
            assert warned == (initial == "only.txt") and (warned or not said.text), said.text
    finally:
        os.chdir(before)


def test_hdf5_of_elastix():
    """A B-spline that elastix found, in its own text and in HDF5 with ITK's names.

    Debian 13's elastix also writes ITK's files itself, but for the reason in outside_testing.py
    with the numbers of a new B-spline: 4 x 4 x 4 zeros. They prove that ITK's layout is read. Where
    that is mended they take points to the same places."""
    z, y, x = numpy.mgrid[:16, :16, :16] * 8.0
    images = [write_image(f"elastix_{i}.mha",
                          100.0 * numpy.exp(-((x - at) ** 2 + (y - 60) ** 2 + (z - 58) ** 2) / 900),
                          (-20, -60, -20), (8, 8, 8)) for i, at in enumerate((58, 66))]
    lines = ['(Transform "BSplineTransform")', '(Registration "MultiResolutionRegistration")',
             '(Metric "AdvancedMeanSquares")', '(Optimizer "RegularStepGradientDescent")',
             '(Interpolator "LinearInterpolator")', '(ImageSampler "Full")',
             "(NumberOfResolutions 1)", '(ResampleInterpolator "FinalLinearInterpolator")',
             '(Resampler "DefaultResampler")', '(FixedImagePyramid "FixedSmoothingImagePyramid")',
             "(MaximumNumberOfIterations 20)", "(MaximumStepLength 4.0)",
             '(MovingImagePyramid "MovingSmoothingImagePyramid")', '(WriteResultImage "false")',
             "(FinalGridSpacingInPhysicalUnits 24 24 24)", '(HowToCombineTransforms "Compose")',
             '(AutomaticTransformInitialization "false")']
    texts, found = [], []
    for ending in ("", "h5", "tfm"):
        folder = scratch("elastix_" + ending)
        os.makedirs(folder, exist_ok=True)
        more = [f'(ITKTransformOutputFileNameExtension "{ending}")'] if ending else []
        run(os.environ["BRAINSHIFT_ELASTIX"], "-f", images[0], "-m", images[1],
            "-p", write("register.txt", "\n".join(lines + more)), "-out", folder)
        texts.append(os.path.join(folder, "TransformParameters.0.txt"))
        found += glob.glob(os.path.join(folder, "*." + ending)) if ending else []
    right = mapped_by_parameters(POINTS, texts[0])
    assert largest(right, POINTS) > 0.5 and len(found) == 2, found
    with open(texts[0]) as file:
        entries = dict(re.findall(r"^\((\w+) (.*)\)$", file.read(), re.MULTILINE))
    fixed = [float(word) for name in ("Size", "Origin", "Spacing", "Direction")
             for word in entries["Grid" + name].split()]
    copy = scratch("spline.h5")
    write_hdf5(copy, ("BSplineTransform", [float(word) for word in
                                           entries["TransformParameters"].split()], fixed))
    for name in (texts[0], copy):
        assert largest(brainshift.read_transform(name).map(POINTS), right) < NEAR, name
    for name in found:
        transform = brainshift.read_transform(name)
        there = transform.map(POINTS)
        away = min(largest(there, POINTS), largest(there, right))
        assert transform.kind == "nonlinear" and away < NEAR, (name, transform.kind, away)


def test_matrix_of_niftyreg_is_ras():
    matrix = numpy.eye(4)
    matrix[:3, :3], matrix[:3, 3] = numpy.reshape(MATRIX, (3, 3)), SHIFT
    name = write("niftyreg.txt", "\n".join(numbers(row) for row in matrix))
    raises(OSError, "name the program", brainshift.read_transform, name)
    raises(ValueError, "'niftyreg'", brainshift.read_transform, name, program="elastix")
    transform = brainshift.read_transform(name, program="niftyreg")
    assert numpy.abs(transform.moving_from_fixed - matrix).max() < 1e-12
    bent = FreeFormDeformation(Input=BOX)
    raises(OSError, "name the program", brainshift.apply_transform, bent, name)
    brainshift.apply_transform(bent, name, program="NiftyReg")
    right = transform.map(INNER)
    assert largest(right, INNER) > 1.0
    assert largest(brainshift.rest_from_deformed(bent, INNER), right) < 0.01
    lps = brainshift.read_transform(name, world="LPS", program="niftyreg").map(POINTS * FLIP) * FLIP
    assert largest(lps, transform.map(POINTS)) < 1e-9


def nifti(name, sides, spacing, axes, origin):
    import nibabel
    affine = numpy.eye(4)
    affine[:3, :3], affine[:3, 3] = numpy.array(axes) * spacing, origin
    nibabel.save(nibabel.Nifti1Image(numpy.zeros(sides, numpy.int16), affine), scratch(name))
    return scratch(name), affine


def test_matrix_of_fsl_needs_both_images():
    """FSL counts mm from the first voxel; x runs backward where the file is right-handed."""
    fixed, fixed_affine = nifti("fsl_fixed.nii", (30, 40, 50), (2, 1.5, 1.2),
                                numpy.diag((-1, 1, 1)), (20, -31, 7))
    moving, moving_affine = nifti("fsl_moving.nii", (21, 33, 44), (1.1, 1.3, 2.2),
                                  numpy.eye(3), (-40, -20, 3))
    name = write("flirt.mat", "0.8 -0.6 0 5\n0.6 0.8 0 -3\n0 0 1 9\n0 0 0 1\n")
    raises(OSError, "name the program", brainshift.read_transform, name)
    raises(OSError, "name the fixed image", brainshift.read_transform, name, program="fsl")
    raises(OSError, "name the moving image", brainshift.read_transform, name, fixed_image=fixed)
    transform = brainshift.read_transform(name, fixed_image=fixed, moving_image=moving)
    other = write("flirt.txt", "0.8 -0.6 0 5\n0.6 0.8 0 -3\n0 0 1 9\n0 0 0 1\n")
    same = brainshift.read_transform(other, fixed_image=fixed, moving_image=moving)
    assert numpy.array_equal(same.moving_from_fixed, transform.moving_from_fixed), "any ending"
    voxel = numpy.array((4.0, 9.0, 25.0))  # of the moving image, which is right-handed
    in_fsl = numpy.array(((20 - voxel[0]) * 1.1, voxel[1] * 1.3, voxel[2] * 2.2))
    there = numpy.array((0.8 * in_fsl[0] - 0.6 * in_fsl[1] + 5,
                         0.6 * in_fsl[0] + 0.8 * in_fsl[1] - 3, in_fsl[2] + 9))
    in_fixed = fixed_affine[:3, :3] @ (there / (2, 1.5, 1.2)) + fixed_affine[:3, 3]
    in_moving = moving_affine[:3, :3] @ voxel + moving_affine[:3, 3]
    away = largest(transform.map(in_fixed[None]), in_moving[None])
    assert away < 1e-4, away  # the files hold single precision


def test_matrix_of_fsl_scales_by_pixdim_and_not_by_the_sform():
    """As FSL's newimage does: an affine sform, and images without sform and qform."""
    affine = numpy.array(((-1.08, 0.05, 0, 90), (0.04, 1.12, 0.1, -120), (0, -0.1, 1.05, -70),
                          (0, 0, 0, 1)))
    bare = numpy.diag((2.0, 1.5, 1.2, 1.0))
    matrix = numpy.array(((0.99, 0.1, 0, 4), (-0.1, 0.99, 0, 5), (0, 0, 1, 6), (0, 0, 0, 1)))
    name = write("sheared.mat", "\n".join(" ".join(map(str, row)) for row in matrix))
    frames = {}
    for case, world, pixdim, code in (("affine", affine, (1, -1, 1), 4),
                                      ("none", bare, (2, 1.5, 1.2), 0),
                                      ("unsized", affine, (1, 0, 1), 4)):
        image = nifti(f"fsl_{case}.nii", (10, 12, 14), (1, 1, 1), numpy.eye(3), (0, 0, 0))[0]
        with open(image, "r+b") as file:
            file.seek(80)
            file.write(struct.pack("<3f", *pixdim))
            file.seek(252)
            file.write(struct.pack("<2h", 0, code))
            file.seek(280)
            file.write(struct.pack("<12f", *world[:3].ravel()))
        frames[case] = image, world @ numpy.diag([*(1 / numpy.abs(pixdim)), 1]) \
            if all(pixdim) else None  # both are left-handed for FSL
    points = numpy.array(((50.0, -40.0, 30.0), (0.0, 0.0, 0.0)))
    for fixed, moving in (("affine", "none"), ("none", "affine"), ("none", "none")):
        (fixed_image, from_fixed), (moving_image, from_moving) = frames[fixed], frames[moving]
        found = brainshift.read_transform(name, fixed_image=fixed_image, moving_image=moving_image)
        right = from_moving @ numpy.linalg.inv(matrix) @ numpy.linalg.inv(from_fixed)
        away = largest(found.map(points), points @ right[:3, :3].T + right[:3, 3])
        assert away < 1e-4, (fixed, moving, away)
    raises(OSError, "has the pixdim[2] 0, by which FSL scales", brainshift.read_transform, name,
           fixed_image=frames["unsized"][0], moving_image=frames["none"][0])


def test_files_of_points_go_through_transforms_and_back():
    """As transformix takes them; labels go along, and the file has axes of its own."""
    warp, affine, _, field = files_of_ants()
    name = write("grid.tfm", itk_text(spline()))
    table = write("before.csv", "label,r,a,s\n" + "".join(
        f"p{i},{','.join(repr(float(x)) for x in point)}\n" for i, point in enumerate(INNER)))
    for transform, members in (
            (affine, (LINEAR[0][:3],)), (name, (spline(),)),
            ((warp, affine), (field, LINEAR[0][:3])),
            (brainshift.read_transform(name), (spline(),))):
        there, back = scratch("there.mrk.json"), scratch("back.csv")
        count = brainshift.map_points(table, there, transform=transform)
        assert count == len(INNER)
        found, right = brainshift.read_points(there), mapped_outside(INNER, *members)
        assert largest(right, INNER) > 1.0
        assert largest(found.positions, right) < NEAR, (transform, largest(found.positions, right))
        assert found.labels[:2] == ["p0", "p1"] and len(found.labels) == count
        brainshift.map_points(there, back, transform=transform, direction="backward")
        again = brainshift.read_points(back)
        assert largest(again.positions, INNER) < NEAR, (transform, largest(again.positions, INNER))
        assert again.labels == found.labels


def field_with_gap(name, gap):
    """A field that takes points 10 mm to the right, without numbers where x (RAS) is in a range."""
    voxels = numpy.zeros((11, 12, 12, 3))
    voxels[..., 0] = -10.0
    x = 30.0 - 10.0 * numpy.arange(12)
    voxels[:, :, (x >= gap[0]) & (x <= gap[1])] = numpy.nan
    return write_image(name, voxels, (-30.0, -60.0, -10.0), (10.0, 10.0, 10.0))


def test_a_field_with_gaps_is_refused_or_named():
    whole, half = field_with_gap("whole.mha", (99, 99)), field_with_gap("half.mha", (-99, -31))
    places = numpy.array([(-45.0, 10.0, 40.0), (-30.0, 10.0, 40.0), (0.0, 10.0, 40.0)])
    right = places + (10.0, 0, 0)
    assert largest(brainshift.read_transform(whole).map(places), right) < NEAR
    found = brainshift.read_transform(half).map(places)
    assert numpy.isnan(found[0]).all() and largest(found[1:], right[1:]) < NEAR, (
        "a point of the field has its own number, whatever its neighbours have")
    # Forward, the lattice needs a number at each control point.
    bent = FreeFormDeformation(Input=BOX)
    with messages():
        raises(ValueError, "half.mha has no finite number at", brainshift.apply_transform, bent,
               half, direction="forward")
    assert bent.Lattice is None
    with messages() as said:
        brainshift.apply_transform(bent, whole, direction="forward")
    assert "no finite number" not in said.text
    assert largest(brainshift.deformed_from_rest(bent, places), right) < NEAR
    # Backward, the inverse is found beside the gap, and the gap is named.
    bent = FreeFormDeformation(Input=BOX)
    with messages() as said:
        brainshift.apply_transform(bent, half)
    assert_says(said.text, "half.mha has no finite number at", "of 6859 points, from -70 -40 0 to",
                "the tissue there stays")
    moved = brainshift.deformed_from_rest(bent, places[2:])
    assert largest(moved, places[2:] - (10.0, 0, 0)) < 0.1, moved


def test_points_that_map_to_no_number_are_refused_by_name():
    half = field_with_gap("half.mha", (-99, -31))
    for label, words in (("tip", "point 1 (tip)"), ("", "point 1 has")):
        name = write("gap.csv", f"label,r,a,s\n{label},-60,10,40\nother,0,10,40\n")
        for ending in (".mrk.json", ".fcsv", ".tag", ".csv", ".tsv"):
            for direction in ("forward", "backward"):
                out = scratch("gap_out" + ending)
                if os.path.exists(out):
                    os.remove(out)
                with messages():
                    raises(OSError, words, brainshift.map_points, name, out, transform=half,
                           direction=direction)
                assert not os.path.exists(out)
    name = write("gap.csv", "label,r,a,s\nother,0,10,40\n")
    assert brainshift.map_points(name, scratch("gap_out.csv"), transform=half) == 1


def test_points_and_transforms_that_do_not_fit():
    name = write("linear.tfm", itk_text(LINEAR[0][:3]))
    table = write("before.csv", "label,r,a,s\np,1,2,3\n")
    out = scratch("never.csv")
    bent = FreeFormDeformation(Input=BOX)
    raises(ValueError, "both given", brainshift.map_points, table, out, bent, transform=name)
    raises(OSError, "does not exist", brainshift.map_points, table, out, transform="none.tfm")
    raises(ValueError, "files is empty", brainshift.map_points, table, out, transform=[])
    lps = brainshift.read_transform(name, world="LPS")
    raises(ValueError, "world='LPS'", brainshift.map_points, table, out, transform=lps)
    assert not os.path.exists(out)


def test_rigid_goes_into_a_comparison_and_out():
    name = write("rigid.tfm", itk_text(RIGID[:3]))
    right = mapped_outside(POINTS, RIGID[:3])
    compare = CompareVolumes(Input=BOX, Reference=BOX)
    for direction in ("backward", "forward"):
        assert brainshift.apply_transform(compare, name, direction) == 0.0
        out = scratch("rigid_out.tfm")
        brainshift.save_transform(compare, out, direction)
        assert largest(mapped_outside(POINTS, of_itk_text(out)), right) < NEAR
        # Where the reference is drawn, by the picture's grid: its first point.
        compare.UpdatePipeline()
        grid = compare.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetArray(
            "ReferenceGrid")
        drawn, loaded = numpy.array([grid.GetValue(i) for i in range(3, 6)]), (-70.0, -40.0, 0.0)
        start, end = (drawn, loaded) if direction == "backward" else (loaded, drawn)
        found = mapped_outside(numpy.array([start]), RIGID[:3])[0]
        assert numpy.linalg.norm(found - end) < NEAR, direction
    affine = write("affine.tfm", itk_text(LINEAR[0][:3]))
    raises(ValueError, "must be rigid", brainshift.apply_transform, compare, affine)


def test_lattice_goes_out_and_comes_back():
    bent = FreeFormDeformation(Input=BOX, Kernel="B-Spline", LatticeDimensions=(7, 8, 9))
    bent.Strokes = brainshift.soft((-30, 5, 30), (6, -4, 9), 45) + brainshift.soft(
        (-10, 25, 50), (-5, 3, 2), 40)
    out = scratch("lattice_out.tfm")
    brainshift.save_transform(bent, out, direction="forward")
    right = brainshift.deformed_from_rest(bent, POINTS)
    assert largest(right, POINTS) > 2.0
    assert largest(mapped_outside(POINTS, of_itk_text(out)), right) < NEAR
    again = FreeFormDeformation(Input=BOX, Kernel="B-Spline", LatticeDimensions=(7, 8, 9))
    error = brainshift.apply_transform(again, out, direction="forward")
    assert error < 1e-4, error
    assert largest(brainshift.deformed_from_rest(again, POINTS), right) < 1e-3
    # A backward file of the same lattice bends the other way round.
    error = brainshift.apply_transform(again, out, direction="backward")
    away = largest(brainshift.rest_from_deformed(again, POINTS), right)
    assert away < 1.5 * error + NEAR, (away, error)
    raises(ValueError, "no B-spline", brainshift.save_transform, bent, out)
    bent.Kernel = "Catmull-Rom"
    raises(ValueError, "Catmull-Rom", brainshift.save_transform, bent, out, direction="forward")


def test_field_goes_out_in_both_directions():
    bent = FreeFormDeformation(Input=BOX)
    bent.Strokes = brainshift.soft((-30, 5, 30), (6, -4, 9), 45)
    nodes = numpy.array((-70.0, -40.0, 0.0)) + numpy.random.default_rng(2).integers(
        3, 17, (50, 3)) * (4.5, 4.75, 4.0)  # of the field, which is trilinear between them
    for direction, ours in (("backward", brainshift.rest_from_deformed),
                            ("forward", brainshift.deformed_from_rest)):
        out = scratch(f"field_{direction}.mha")
        brainshift.save_transform(bent, out, direction)
        right = ours(bent, nodes)
        assert largest(right, nodes) > 1.0
        assert largest(mapped_outside(nodes, out), right) < NEAR, direction


def test_reader_opens_files_as_fields():
    name = write("open_me.tfm", itk_text(spline()))
    reader = OpenDataFile(name)
    assert reader.SMProxy.GetXMLName() == "TransformReader"
    assert reader.Volume is None
    reader.OutputDirection = "Backward"
    reader.UpdatePipeline()
    image = reader.GetClientSideObject().GetOutputDataObject(0)
    x, y, z = image.GetDimensions()  # the outermost points lie where ITK's spline ends
    kept = [image.ComputePointId(index) for index in
            numpy.random.default_rng(8).integers(1, (x - 1, y - 1, z - 1), (100, 3)).tolist()]
    places = numpy.array([image.GetPoint(i) for i in kept])
    moved = places + [image.GetPointData().GetVectors().GetTuple(i) for i in kept]
    assert largest(moved, mapped_outside(places, spline())) < NEAR
    # Inverted here point by point, and by the filter that iterates on its own points.
    bent = FreeFormDeformation(Input=BOX, Lattice=InvertDisplacementField(Input=reader))
    again = FreeFormDeformation(Input=BOX, Lattice=TransformReader(FileName=name, Volume=BOX))
    apart = largest(*(brainshift.deformed_from_rest(one, POINTS) for one in (bent, again)))
    assert apart < 1.0, apart


def test_bad_files_end_in_a_sentence():
    good = itk_text(LINEAR[0][:3])
    for text, words in (
            ("hello", "is no transform"),
            ("", "is no transform"),
            ("#Insight Transform File V1.0\n", "holds no transform"),
            (good.replace("AffineTransform", "TpsTransform"), "does not know"),
            (good.replace("_3_3", "_2_2"), "does not know"),
            (good.replace("Parameters: 1.1", "Parameters: one"), "no numbers"),
            (good.replace("Parameters: 1.1", "Parameters: nan"), "not finite"),
            (good.replace("Parameters: 1.1", "Parameters:"), "11 parameters"),
            (itk_text(("AffineTransform", (0,) * 12, CENTRE)), "without an inverse"),
            (itk_text(("BSplineTransform", (0,) * 12, (9e9,) * 18)), "each side must have"),
            (itk_text(("BSplineTransform", (0,) * 12, (30000, 30000, 30000, 0, 0, 0, 1, 1, 1, 1, 0,
                                                       0, 0, 1, 0, 0, 0, 1))), "12 parameters"),
            ('(Transform "WeirdTransform")', "does not know"),
            ('(Transform "EulerTransform")\n(HowToCombineTransforms "Compose")\n'
             '(InitialTransformParameterFileName "no.txt")', "does not exist"),
            ('(Transform "EulerTransform")\n(HowToCombineTransforms "Compose")\n'
             '(InitialTransformParameterFileName "bad.txt")', "more than 32")):
        raises(OSError, words, brainshift.read_transform, write("bad.txt", text))
    raises(OSError, "does not exist", brainshift.read_transform, scratch("none.tfm"))
    _, affine, composite, _ = files_of_ants()
    import h5py
    gap = scratch("gap.h5")
    with h5py.File(composite) as whole, h5py.File(gap, "w") as file:
        for source, target in (("0", "0"), ("1", "2")):
            whole.copy(f"TransformGroup/{source}", file.require_group("TransformGroup"), target)
    raises(OSError, "without a gap", brainshift.read_transform, gap)
    # A volume with the ending of a field: the reason is that of the field's reader.
    scalars = write_image("scalars.mha", numpy.zeros((4, 4, 4), "f4"), (0, 0, 0), (1, 1, 1))
    raises(OSError, "is a field that cannot be read", brainshift.read_transform, scalars)
    for name, ending in ((affine, ".mat"), (composite, ".h5")):
        with open(name, "rb") as file:
            whole = file.read()
        for part in (0.3, 0.9):
            short = scratch("short" + ending)
            with open(short, "wb") as file:
                file.write(whole[:int(part * len(whole))])
            raises(OSError, "Transform file", brainshift.read_transform, short)
    name = write("linear.tfm", good)
    raises(ValueError, "direction is", brainshift.apply_transform, BOX, name, "sideways")
    raises(ValueError, "must be a Free-Form Deformation", brainshift.apply_transform, BOX, name)


def test_hdf5_leads_to_no_other_file():
    """A link, or numbers outside the file, could read any file that the user may read."""
    import h5py
    whole = scratch("whole.h5")
    write_hdf5(whole, LINEAR[0][:3])
    group = "TransformGroup/0"
    for name, words in (("linked", "as a link"), ("soft", "as a link"), ("group", "as a link"),
                        ("outside", "in another file"), ("virtual", "in another file")):
        other = scratch(f"{name}.h5")
        shutil.copy(whole, other)
        with h5py.File(other, "a") as file:
            members = file[group]
            numbers = members["TransformParameters"][...]
            if name == "group":
                del file[group]
                file[group] = h5py.ExternalLink("whole.h5", group)
                continue
            members.move("TransformParameters", "Kept")
            if name == "linked":
                members["TransformParameters"] = h5py.ExternalLink(
                    "whole.h5", f"{group}/TransformParameters")
            elif name == "soft":
                members["TransformParameters"] = h5py.SoftLink("Kept")
            elif name == "outside":
                members.create_dataset("TransformParameters", numbers.shape, numbers.dtype,
                                       external=[(whole, 0, numbers.nbytes)])
            else:
                layout = h5py.VirtualLayout(numbers.shape, numbers.dtype)
                layout[:] = h5py.VirtualSource(whole, f"{group}/TransformParameters", numbers.shape)
                members.create_virtual_dataset("TransformParameters", layout)
        raises(OSError, words, brainshift.read_transform, other)


def test_points_go_through_transforms_on_a_server():
    """Last, for it ends the session that the others use."""
    name = write("grid.tfm", itk_text(spline()))
    table, there = write("before.csv", "label,r,a,s\np,-30,5,30\n"), scratch("there.tag")
    right = mapped_outside(numpy.array([(-30.0, 5.0, 30.0)]), spline())

    def mapped():
        brainshift.map_points(table, there, transform=name)
        return brainshift.read_points(there).positions
    assert largest(on_server(mapped, **server_finds_plugin()), right) < NEAR


run_tests(globals())
