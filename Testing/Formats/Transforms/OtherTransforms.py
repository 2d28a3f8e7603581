# SPDX-License-Identifier: BSD-3-Clause
# Proves that transforms of FreeSurfer, the MNI, FSL, SPM, old ITK and Slicer take points where
# these programs take them, within 0.001 mm. Real files are compared with the same transform in
# another format, with libminc and with scipy; others with numpy, by the formulas of their programs.
import json
import os
import subprocess
import warnings

import minc_files
import nibabel
import numpy
from brainshift_testing import assert_says, data, load_plugin, messages, run_tests, scratch
from outside_testing import FLIP, itk_text, numbers, write, write_hdf5
from scipy.interpolate import RBFInterpolator
from scipy.spatial.transform import Rotation

load_plugin()
import brainshift  # noqa: E402 after the plugin

NEAR = 1e-3  # mm
RANDOM = numpy.random.default_rng(43)
POINTS = RANDOM.uniform((-60, -70, -30), (60, 45, 70), (200, 3))  # RAS, mm
CENTRE = numpy.array((11.0, -7.0, 25.0))
SHIFT = numpy.array((3.0, -8.0, 5.5))


def largest(found, right):
    return numpy.linalg.norm(numpy.asarray(found) - right, axis=1).max()


def refuses(words, *arguments, **options):
    try:
        brainshift.read_transform(*arguments, **options)
    except OSError as found:
        assert words in str(found), (words, str(found))
    else:
        raise AssertionError(f"nothing says {words}")


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def places_of_voxels(affine, sides):
    indices = numpy.moveaxis(numpy.indices(sides), 0, -1)
    return moved(affine, indices.reshape(-1, 3)).reshape(*sides, 3)


def real(*path):
    return data("transforms", *path)


# FreeSurfer ---------------------------------------------------------------------------------------


def test_lta_leads_as_its_twin_in_itk():
    """The same maps of fMRIPrep, by bbregister, mri_robust_register and lta_convert: voxels to
    voxels, RAS to RAS and as ITK's. Without a mistake of direction they differ by their digits."""
    worst = 0.0
    for name in ("from-fsnative_to-bold", "from-scanner_to-bold", "from-fsnative_to-scanner",
                 "from-scanner_to-fsnative"):
        right = brainshift.read_transform(real("nitransforms", name + "_mode-image.tfm"))
        for end in ("_mode-image.lta", "_mode-image_type-ras2ras.lta"):
            file = real("nitransforms", name + end)
            if os.path.exists(file):
                found = brainshift.read_transform(file)
                away = largest(found.map(POINTS), right.map(POINTS))
                back = largest(found.map(right.map(POINTS)), POINTS)
                assert away < NEAR and back > 1e-2, (file, away, back)
                worst = max(worst, away)
    one, other = (brainshift.read_transform(real("nitransforms", f"bold-to-t1w{end}.lta"))
                  for end in ("", ".v2v"))
    away = largest(one.map(POINTS), other.map(POINTS))
    print(f"LTA and ITK: up to {max(worst, away):.6f} mm apart")
    assert away < NEAR and largest(one.map(POINTS), POINTS) > 1.0


def test_lta_of_nitransforms_leads_from_the_moving_image_as_freesurfer_does():
    """NiTransforms calls the fixed image src, and its matrix leads from dst to src. Its own test
    makes this pair of a map and, for FreeSurfer's format, of the inverse of that map."""
    itk = brainshift.read_transform(real("nitransforms", "affine-RAS.itk.tfm"))
    found = brainshift.read_transform(real("nitransforms", "affine-RAS.fs.lta"))
    away, same = (largest(found.map(points), right) for points, right in (
        (itk.map(POINTS), POINTS), (POINTS, itk.map(POINTS))))
    assert away < NEAR and same > 1.0, (away, same)


def lta(kind, matrix, src, dst, note=""):
    """An LTA between two images: a pair of an affine and sides each, or None."""
    text = f"{note}type      = {kind}\nnxforms   = 1\nmean = 0 0 0\nsigma = 1\n1 4 4\n"
    text += "".join(numbers(row) + "\n" for row in matrix)
    for name, image in (("src", src), ("dst", dst)):
        text += f"{name} volume info\n"
        if image is None:
            text += "valid = 0  # volume info invalid\n"
            continue
        affine, sides = image
        sizes = numpy.linalg.norm(affine[:3, :3], axis=0)
        axes = affine[:3, :3] / sizes
        centre = affine @ (*(numpy.array(sides) / 2.0), 1.0)
        text += ("valid = 1  # volume info valid\nfilename = some file.mgz\n"
                 f"volume = {sides[0]} {sides[1]} {sides[2]}\nvoxelsize = {numbers(sizes)}\n"
                 f"xras = {numbers(axes[:, 0])}\nyras = {numbers(axes[:, 1])}\n"
                 f"zras = {numbers(axes[:, 2])}\ncras = {numbers(centre[:3])}\n")
    return text + "subject bert\nfscale 0.1\n"


def image(name, sides, axes, sizes, origin):
    """A NIfTI file: its name, affine and sides."""
    affine = numpy.eye(4)
    affine[:3, :3], affine[:3, 3] = numpy.array(axes) * sizes, origin
    nibabel.save(nibabel.Nifti1Image(numpy.zeros(sides, numpy.int16), affine), scratch(name))
    return scratch(name), affine, sides


def turned(angles):
    return Rotation.from_euler("xyz", angles).as_matrix()


def rigid():
    matrix = numpy.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turned((0.2, -0.3, 0.1)), SHIFT
    return matrix


def test_images_say_which_end_of_an_lta_they_are():
    src, src_affine, src_sides = image("lta_src.nii", (30, 40, 50), turned((0, 0, 0.1)),
                                       (2, 1.5, 1.25), (-20, -31, 7))
    dst, dst_affine, dst_sides = image("lta_dst.nii", (21, 33, 44), numpy.diag((-1, 1, 1)),
                                       (1.1, 1.3, 2.2), (40, -20, 3))
    other = image("lta_other.nii", (21, 33, 45), numpy.eye(3), (1, 1, 1), (0, 0, 0))[0]
    matrix = rigid()
    ends = (src_affine, src_sides), (dst_affine, dst_sides)
    file = write("given.lta", lta(1, matrix, *ends))
    forward, back = moved(matrix, POINTS), moved(numpy.linalg.inv(matrix), POINTS)
    for right, options in ((back, {}), (back, {"fixed_image": dst}), (back, {"moving_image": src}),
                           (forward, {"fixed_image": src}), (forward, {"moving_image": dst}),
                           (forward, {"fixed_image": src, "moving_image": dst})):
        found = brainshift.read_transform(file, **options).map(POINTS)
        assert largest(found, right) < 1e-9, options
    refuses("neither has the voxels", file, fixed_image=other)
    refuses("one end with the voxels of both", file, fixed_image=dst, moving_image=dst)
    ofvoxels = numpy.linalg.inv(dst_affine) @ matrix @ src_affine
    found = brainshift.read_transform(write("voxels.lta", lta(0, ofvoxels, *ends))).map(POINTS)
    assert largest(found, back) < 1e-4  # the images hold float32
    note = "# LTA-array file created by NiTransforms\n"
    for right, options in ((back, {}), (back, {"fixed_image": src}), (back, {"moving_image": dst}),
                           (forward, {"fixed_image": dst})):
        found = brainshift.read_transform(write("ni.lta", lta(1, matrix, *ends, note)), **options)
        assert largest(found.map(POINTS), right) < 1e-9, options


def test_lta_that_is_refused():
    matrix = rigid()
    good = lta(1, matrix, None, None)
    assert brainshift.read_transform(write("good.lta", good)).kind == "rigid"
    for words, text in (
            ("type 14", lta(14, matrix, None, None)), ("no valid src", lta(0, matrix, None, None)),
            ("(nxforms)", good.replace("nxforms   = 1", "nxforms = 2")),
            ("no whole matrix", good[:good.index("0.0 0.0 0.0 1.0")]),
            ("must have 4 numbers", good.replace("1 4 4\n", "1 4 4\n1 2 3\n")),
            ("last row", lta(1, matrix + numpy.eye(4)[3], None, None)),
            ("inverse", lta(1, matrix * (1, 0, 1, 1), None, None)),
            ("twice", good.replace("mean = 0 0 0", "type = 1"))):
        refuses(words, write("bad.lta", text))


# MNI ----------------------------------------------------------------------------------------------


#: Runs in a process of its own: libminc and the HDF4 of ParaView have functions of one name.
LIBMINC = """
import ctypes, ctypes.util, json, sys
file, points = json.load(sys.stdin)
library = ctypes.CDLL(ctypes.util.find_library("minc2"))
number, pointer = ctypes.c_double, ctypes.POINTER(ctypes.c_double)
library.general_transform_point.argtypes = [ctypes.c_void_p, *[number] * 3, *[pointer] * 3]
transform = ctypes.create_string_buffer(1 << 16)
assert library.input_transform_file(file.encode(), transform) == 0, file
found = []
for point in points:
    to = [number() for _ in range(3)]
    library.general_transform_point(transform, *point, *map(ctypes.byref, to))
    found.append([one.value for one in to])
print("found", json.dumps(found))
"""


def mapped_by_libminc(file, points):
    """Maps points as the MNI's own programs do."""
    done = subprocess.run(["/usr/bin/python3", "-c", LIBMINC], capture_output=True, text=True,
                          input=json.dumps([file, numpy.asarray(points).tolist()]))
    assert done.returncode == 0, done.stderr[-2000:]
    return numpy.array(json.loads(done.stdout.split("found ")[1]))


LINEAR = """Transform_Type = Linear;
Linear_Transform =
 1.1 0.07 -0.03 3
 -0.05 0.93 0.11 -8
 0.02 -0.08 1.04 5.5;
"""


def grid_volume(name, isFirst=False):
    """A MINC2 file of displacements with slices from front to back, x from right to left."""
    affine = numpy.array(((0, 0, -5.0, 62), (0, 6.0, 0, -75), (5.5, 0, 0, -35), (0, 0, 0, 1)))
    z, y, x = numpy.mgrid[:21, :22, :25]
    vectors = numpy.stack((3 * numpy.sin(x / 5.0 + y / 9.0), 4 * numpy.cos(z / 6.0),
                           -3 * numpy.sin(y / 7.0 - x / 8.0)), axis=-1)
    minc_files.write_vectors(scratch(name), vectors, affine, isFirst)


def xfm(name, *parts):
    return write(name, "MNI Transform File\n%a comment; with = signs\n\n" + "\n".join(parts))


def test_xfm_leads_as_libminc_leads_it():
    """libminc maps from the source (moving) to the target (fixed), and BrainShift back."""
    inside = RANDOM.uniform((-40, -55, -15), (40, 30, 45), (200, 3))
    grid_volume("made_grid_0.mnc")
    grid = "Transform_Type = Grid_Transform;\nDisplacement_Volume = made_grid_0.mnc;\n"
    inverted = grid.replace(";\n", ";\nInvert_Flag = True;\n", 1)
    grid_volume("first_grid_0.mnc", isFirst=True)
    first = grid.replace("made", "first")
    for name, parts in (("linear", (LINEAR,)), ("two", (LINEAR, LINEAR)), ("grid", (grid,)),
                        ("both", (LINEAR, grid)), ("first", (first,)), ("inverse", (inverted,)),
                        ("all", (grid, LINEAR, inverted))):
        file = xfm(name + ".xfm", *parts)
        transform = brainshift.read_transform(file)
        away = largest(transform.map(mapped_by_libminc(file, inside)), inside)
        print(f"{name}.xfm: {away:.6f} mm")
        assert away < NEAR and largest(transform.map(inside), inside) > 1.0, (name, away)


def test_positions_that_no_point_reaches_are_told():
    """The MNI's cubic displacements jump within a cell of the edge, where they become linear."""
    affine = numpy.array(((0, 0, -5.0, 62), (0, 6.0, 0, -75), (5.5, 0, 0, -35), (0, 0, 0, 1)))
    vectors = RANDOM.uniform(-1.5, 1.5, (21, 22, 25, 3))
    minc_files.write_vectors(scratch("rough_grid_0.mnc"), vectors, affine)
    file = xfm("rough.xfm", "Transform_Type = Grid_Transform;\n"
               "Displacement_Volume = rough_grid_0.mnc;\n")
    transform = brainshift.read_transform(file)
    points = RANDOM.uniform((54, -55, -15), (59, 30, 45), (400, 3))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found = transform.map(points)  # the inverse of what the file has
    back = numpy.linalg.norm(transform.map_back(found) - points, axis=1)
    missed = int((back > 1e-3).sum())
    assert missed > 0, "the field has no jump"
    [warning] = told
    assert_says(str(warning.message), f"{missed} of 400 points miss their positions by up to",
                f"{back.max():.2g} mm")


def test_xfm_that_is_refused():
    for words, text in (
            ("Thin_Plate", "Transform_Type = Thin_Plate_Spline_Transform;\nPoints = 1;"),
            ("12, in 3 rows", "Transform_Type = Linear;\nLinear_Transform = 1 2 3;"),
            ("no entry Linear_Transform", "Transform_Type = Linear;"),
            ("before its first", "Linear_Transform = 1 2 3;"),
            ("Invert_Flag perhaps", LINEAR + "Invert_Flag = perhaps;"),
            ("twice", LINEAR + "Linear_Transform = 1;"), ("knows Transform", LINEAR + "A = 1;"),
            ("0 transforms", ""), ("Displacement_Volume", "Transform_Type = Grid_Transform;\n"
                                   "Displacement_Volume = nowhere.mnc;")):
        refuses(words, xfm("bad.xfm", text))


def test_what_is_doubtful_of_a_displacement_volume_is_said():
    """A file without a step along z counts 1 mm there: its field is squeezed."""
    import h5py
    grid_volume("stepless_grid_0.mnc")
    file = xfm("stepless.xfm", "Transform_Type = Grid_Transform;\n"
               "Displacement_Volume = stepless_grid_0.mnc;\n")
    with messages() as said:
        brainshift.read_transform(file)
    assert not said.text, said.text
    with h5py.File(scratch("stepless_grid_0.mnc"), "a") as stored:
        del stored["minc-2.0/dimensions/zspace"].attrs["step"]
    with messages() as said:
        brainshift.read_transform(file)
    assert_says(said.text, "stepless_grid_0.mnc has no step along zspace, which counts as 1")


# ITK and Slicer -----------------------------------------------------------------------------------


def versor(vector):
    return Rotation.from_quat((*vector, numpy.sqrt(1.0 - numpy.dot(vector, vector)))).as_matrix()


def test_old_linear_types_of_itk():
    """By the formulas of ITK's sources: ScaleVersor3D and ScaleSkewVersor3D add, Compose
    multiplies."""
    vector, scales = (0.2, -0.1, 0.3), (1.2, 0.9, 1.1)
    rotation = versor(vector)
    skews = numpy.array(((0, 0.02, -0.03), (0.04, 0, 0.05), (-0.01, 0.06, 0)))
    six = skews[~numpy.eye(3, dtype=bool)]
    above = numpy.array(((1, 0.02, -0.03), (0, 1, 0.05), (0, 0, 1)))
    added = rotation + numpy.diag(scales) - numpy.eye(3)
    quaternion = Rotation.from_matrix(rotation).as_quat()
    for kind, parameters, linear in (
            ("Rigid3DTransform", (*rotation.ravel(), *SHIFT), rotation),
            ("QuaternionRigidTransform", (*quaternion, *SHIFT), rotation),
            ("ScaleVersor3DTransform", (*vector, *SHIFT, *scales), added),
            ("ScaleSkewVersor3DTransform", (*vector, *SHIFT, *scales, *six), added + skews),
            ("ComposeScaleSkewVersor3DTransform", (*vector, *SHIFT, *scales, 0.02, -0.03, 0.05),
             rotation @ numpy.diag(scales) @ above)):
        right = ((POINTS * FLIP - CENTRE) @ linear.T + CENTRE + SHIFT) * FLIP
        h5 = scratch("old.h5")
        write_hdf5(h5, (kind, parameters, CENTRE))
        for file in (write("old.tfm", itk_text((kind, parameters, CENTRE))), h5):
            found = brainshift.read_transform(file)
            assert largest(found.map(POINTS), right) < 1e-9, kind
        assert (found.kind == "rigid") == (linear is rotation), kind
    refuses("length 1.1", write("long.tfm", itk_text(
        ("QuaternionRigidTransform", (*(quaternion * 1.1), *SHIFT), CENTRE))))
    refuses("no rotation", write("skew.tfm", itk_text(
        ("Rigid3DTransform", (*added.ravel(), *SHIFT), CENTRE))))


def test_lists_without_a_composite_are_refused():
    """A list may be one map for each volume of a series; only an old B-spline names its bulk."""
    refuses("does not say how they follow", real("nitransforms", "itktflist.tfm"))
    refuses("does not say how they follow", real("slicer-transforms", "rotationAndAffine.tfm"))
    affine = ("AffineTransform", (*numpy.eye(3).ravel(), *SHIFT), CENTRE)
    spline = ("BSplineDeformableTransform", numpy.zeros(3 * 64),
              (4, 4, 4, 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0, 0, 0, 1))
    refuses("only its bulk after it", write("order.tfm", itk_text(affine, spline)))
    refuses("only its bulk after it", write("three.tfm", itk_text(spline, affine, affine)))


def spline_weights(t):
    return numpy.array(((1 - t) ** 3, 3 * t ** 3 - 6 * t ** 2 + 4,
                        -3 * t ** 3 + 3 * t ** 2 + 3 * t + 1, t ** 3)) / 6.0


def spline_sum(coefficients, at):
    """Cubic B-splines at grid coordinates; coefficients [z, y, x, component]. 0 outside."""
    found = numpy.zeros((len(at), 3))
    sides = numpy.array(coefficients.shape[2::-1])
    for n, place in enumerate(at):
        if (place < 1.0).any() or (place > sides - 2.0).any():
            continue
        cell = numpy.minimum(numpy.floor(place).astype(int), sides - 3)
        x, y, z = (spline_weights(place[i] - cell[i]) for i in range(3))
        i, j, k = cell - 1
        block = coefficients[k:k + 4, j:j + 4, i:i + 4]
        found[n] = numpy.einsum("k,j,i,kjic->c", z, y, x, block)
    return found


def test_slicers_old_spline_has_its_bulk_added():
    """Slicer's own file of ITK 3: y = bulk(x) + spline(x), and not one after the other."""
    file = real("slicer-transforms", "Bspline-f-m.tfm")
    with open(file) as text:
        first = text.read().split("#Transform 1")[0]
    lines = dict(line.split(":", 1) for line in first.splitlines() if ":" in line)
    parameters, fixed = (numpy.array(lines[key].split(), float)
                         for key in ("Parameters", "FixedParameters"))
    sides = fixed[:3].astype(int)
    coefficients = parameters.reshape(3, *sides[::-1]).transpose(1, 2, 3, 0)
    points = RANDOM.uniform((-130, -200, -200), (130, 200, 200), (300, 3))
    lps = points * FLIP
    bulk = numpy.array(((0.8, 0.1, 0.1), (0.15, 0.7, 0.05), (0.14, 0.04, 0.9)))
    bend = spline_sum(coefficients, (lps - fixed[3:6]) / fixed[6:9])
    right = (lps @ bulk.T + (10, -5, 7) + bend) * FLIP
    transform = brainshift.read_transform(file)
    away = largest(transform.map(points), right)
    print(f"old B-spline with bulk: {away:.9f} mm")
    inside = numpy.linalg.norm(bend, axis=1) > 0.5
    assert away < 1e-6 and 20 < inside.sum() < 300, (away, inside.sum())
    alone = scratch("alone.h5")
    write_hdf5(alone, ("BSplineDeformableTransform", parameters, fixed))
    assert largest(brainshift.read_transform(alone).map(points), (lps + bend) * FLIP) < 1e-6


def plates(sources, targets, points):
    """scipy's thin plates of the distance with an affine map, in LPS."""
    return RBFInterpolator(sources, targets, kernel="linear", degree=1)(points * FLIP) * FLIP


def test_slicers_thin_plates():
    """Slicer's own file, from its parameters (source landmarks) to its fixed ones (targets)."""
    import h5py
    file = real("slicer-transforms", "TpsTransform.h5")
    with h5py.File(file) as stored:
        group = stored["TransformGroup/0"]
        sources = group["TranformParameters"][()].reshape(-1, 3)
        targets = group["TranformFixedParameters"][()].reshape(-1, 3)
    transform = brainshift.read_transform(file)
    away = largest(transform.map(POINTS), plates(sources, targets, POINTS))
    at_landmarks = largest(transform.map(sources * FLIP), targets * FLIP)
    print(f"thin plates: {away:.9f} mm, {at_landmarks:.9f} mm at landmarks")
    assert transform.kind == "nonlinear" and away < NEAR and at_landmarks < 1e-6
    many = RANDOM.uniform(-80, 80, (60, 3))
    away = RANDOM.normal(0, 3, (60, 3))
    kind = "ThinPlateSplineKernelTransform"
    text = write("plates.tfm", itk_text((kind, many, many + away)))
    found = brainshift.read_transform(text)
    assert largest(found.map(POINTS), plates(many, many + away, POINTS)) < 1e-6
    inverse = brainshift.read_transform(write("turned.tfm", itk_text(
        ("Inverse" + kind, many, many + away))))
    assert largest(inverse.map(found.map(POINTS)), POINTS) < NEAR
    flat = many * (1, 1, 0)
    refuses("in one plane", write("flat.tfm", itk_text((kind, flat, many))))
    refuses("at one place", write("same.tfm", itk_text(
        (kind, [*many, many[0]], [*many, many[1]]))))
    refuses("from 4 to 2000", write("few.tfm", itk_text((kind, many[:3], many[:3]))))
    refuses("must be as many", write("odd.tfm", itk_text((kind, many, many[:9]))))


# FSL ----------------------------------------------------------------------------------------------


def fsl_frame(affine, sides, sizes):
    """World from FSL's mm."""
    voxel = numpy.diag((*(1.0 / numpy.array(sizes)), 1.0))
    if numpy.linalg.det(affine[:3, :3]) > 0:
        voxel[0, 0], voxel[0, 3] = -voxel[0, 0], sides[0] - 1
    return affine @ voxel


def pair(hand):
    fixed = image(f"fnirt_ref_{hand}.nii", (24, 26, 22),
                  turned((0.1, 0, 0.2)) @ numpy.diag((hand, 1, 1)), (4, 5, 4.5),
                  (-hand * 50, -70, -30))
    moving = image(f"fnirt_in_{hand}.nii", (30, 40, 50),
                   turned((0, 0.1, -0.1)) @ numpy.diag((-hand, 1, 1)), (3, 2.5, 2),
                   (hand * 45, -60, -35))
    return fixed, moving


def warp(name, vectors, affine, intent, components=4, called=""):
    """Numbers [x, y, z, 3] as FSL stores them: in dim[4], or dim[5]. called: the intent's name."""
    stored = vectors if components == 4 else vectors[:, :, :, None]
    file = nibabel.Nifti1Image(stored.astype("f4"), affine)
    file.header.set_intent(intent, name=called, allow_unknown=True) if intent else None
    nibabel.save(file, scratch(name))
    return scratch(name)


def inner(affine, sides, count=200):
    """Points of an image, RAS."""
    return moved(affine, RANDOM.uniform(1, numpy.array(sides) - 2, (count, 3)))


def linear_between(vectors, at):
    from scipy.ndimage import map_coordinates
    return numpy.stack([map_coordinates(vectors[..., i], at.T, order=1) for i in range(3)], axis=1)


def test_fnirt_field_needs_the_moving_image():
    for hand in (-1, 1):
        (ref, ref_affine, sides), (source, in_affine, in_sides) = pair(hand)
        ref_frame = fsl_frame(ref_affine, sides, (4, 5, 4.5))
        in_frame = fsl_frame(in_affine, in_sides, (3, 2.5, 2))
        x, y, z = numpy.mgrid[:24, :26, :22]
        vectors = numpy.stack((9 * numpy.sin(x / 5.0 + y / 9.0) + 3, 8 * numpy.cos(z / 6.0),
                               -7 * numpy.sin(y / 7.0 - x / 8.0)), axis=-1)
        places = moved(numpy.linalg.inv(ref_frame) @ ref_affine,
                       numpy.stack((x, y, z), axis=-1).reshape(-1, 3)).reshape(*sides, 3)
        points = inner(ref_affine, sides)
        at = moved(numpy.linalg.inv(ref_affine), points)
        fsl = moved(numpy.linalg.inv(ref_frame), points) + linear_between(vectors, at)
        right = moved(in_frame, fsl)
        for name, stored in (("relative", vectors), ("absolute", vectors + places)):
            file = warp(f"fnirt_{name}.nii.gz", stored, ref_affine, 2006)
            for options in ({}, {"fixed_image": ref}):
                found = brainshift.read_transform(file, moving_image=source, **options).map(points)
                assert largest(found, right) < NEAR, (hand, name, largest(found, right))
        assert largest(right, points) > 5.0
        refuses("name the moving image", file)
        refuses("name the image of fnirt's --ref", file, moving_image=source, fixed_image=source)


def test_fnirt_coefficients_need_both_images():
    for knots in ((4, 5, 30), (4, 5, 3)):  # the first has 3 coefficients along an axis
        fnirt_coefficients(numpy.array(knots))
    file = scratch("fnirt_coefficients.nii.gz")
    (ref, _, _), (source, _, _) = pair(-1)
    refuses("name the fixed image", file, moving_image=source)
    refuses("name the moving image", file, fixed_image=ref)
    refuses("was made for a fixed image", file, fixed_image=source, moving_image=source)
    (right_handed, _, _), _ = pair(1)
    refuses("right-handed", file, fixed_image=right_handed, moving_image=source)


def fnirt_coefficients(knots):
    """Writes coefficients as FNIRT does, and compares what is read with their sum."""
    (ref, ref_affine, sides), (source, in_affine, in_sides) = pair(-1)
    ref_frame = fsl_frame(ref_affine, sides, (4, 5, 4.5))
    in_frame = fsl_frame(in_affine, in_sides, (3, 2.5, 2))
    count = -(-(numpy.array(sides) + 1) // knots) + 2  # as FNIRT makes them
    coefficients = RANDOM.uniform(-6, 6, (*count, 3))
    ref_from_in = numpy.eye(4)
    ref_from_in[:3, :3], ref_from_in[:3, 3] = turned((0.05, -0.1, 0.02)) * 1.05, (4, -3, 6)
    file = nibabel.Nifti1Image(coefficients.astype("f4"), None)
    header = file.header
    header.set_intent(2007, allow_unknown=True)
    header["intent_p1"], header["intent_p2"], header["intent_p3"] = 4, 5, 4.5
    header.set_zooms((*knots, 1))
    header.set_sform(ref_from_in, 1)
    header["qform_code"], header["qoffset_x"], header["qoffset_y"], header["qoffset_z"] = (
        1, *sides)
    nibabel.save(file, scratch("fnirt_coefficients.nii.gz"))
    voxels = RANDOM.uniform(0, numpy.array(sides) - 1, (300, 3))
    voxels[:100] = numpy.array(sides) - 1 - voxels[:100] / 8  # behind the last coefficients, too
    points = moved(ref_affine, voxels)
    fsl = moved(numpy.linalg.inv(ref_frame), points)
    at = fsl / (4, 5, 4.5) / knots + 1  # FNIRT's first coefficient is before its first voxel
    stored = coefficients.astype("f4").transpose(2, 1, 0, 3).astype(float)
    around = numpy.pad(stored, (*[(3, 3)] * 3, (0, 0)))  # there are none around them
    bend = spline_sum(around, at + 3)
    right = moved(in_frame, moved(numpy.linalg.inv(ref_from_in), fsl) + bend)
    found = brainshift.read_transform(
        scratch("fnirt_coefficients.nii.gz"), fixed_image=ref, moving_image=source).map(points)
    print(f"FNIRT coefficients: {largest(found, right):.6f} mm")
    assert largest(found, right) < NEAR and numpy.linalg.norm(bend, axis=1).max() > 1.0


def contradictory(name):
    """Gives a NIfTI file a qform that mirrors its sform. Returns its name."""
    file = nibabel.load(name)
    stored = nibabel.Nifti1Image(numpy.asanyarray(file.dataobj), None, file.header)
    stored.header.set_sform(file.affine, 1)
    stored.header.set_qform(file.affine @ numpy.diag((-1, 1, 1, 1)), 1)
    nibabel.save(stored, scratch("contradictory_" + os.path.basename(name)))
    return scratch("contradictory_" + os.path.basename(name))


def test_what_is_doubtful_of_images_of_fsl_is_said():
    """Each image and each field whose qform mirrors its sform is named; coefficients are not, whose
    header has other numbers in these places, nor are images without a fault."""
    (ref, affine, sides), (source, _, _) = pair(-1)
    field = warp("doubtful.nii", RANDOM.uniform(-3, 3, (*sides, 3)), affine, 2006)
    fnirt_coefficients(numpy.array((4, 5, 3)))
    coefficients = scratch("fnirt_coefficients.nii.gz")
    matrix = write("doubtful.mat", numbers(numpy.eye(4)))
    for file in (field, coefficients, matrix):
        for images in ((ref, source), (contradictory(ref), source), (ref, contradictory(source))):
            with messages() as said:
                brainshift.read_transform(file, fixed_image=images[0], moving_image=images[1])
            wrong = [name for name in images if "contradictory" in name]
            assert_says(said.text, *(f"{name} has a qform that mirrors" for name in wrong))
            assert wrong or not said.text, (file, said.text)
    with messages() as said:
        brainshift.read_transform(contradictory(field), moving_image=source)
    assert_says(said.text, "contradictory_doubtful.nii has a qform that mirrors")
    positions = warp("doubtful_y.nii", places_of_voxels(affine, sides), affine, 0)
    with messages() as said:
        brainshift.read_transform(contradictory(positions), program="spm")
    assert_says(said.text, "contradictory_doubtful_y.nii has a qform that mirrors")


def test_spm_positions_on_request():
    (_, affine, sides), _ = pair(1)
    x, y, z = numpy.mgrid[:24, :26, :22]
    places = places_of_voxels(affine, sides)
    vectors = numpy.stack((9 * numpy.sin(x / 5.0), 8 * numpy.cos(z / 6.0), y / 3.0), axis=-1)
    points = inner(affine, sides)
    at = moved(numpy.linalg.inv(affine), points)
    right = points + linear_between(vectors, at)
    for components in (4, 5):
        file = warp("y_plain.nii", places + vectors, affine, 0, components)
        refuses("SPM as its program" if components == 5 else "3 components", file)
        found = brainshift.read_transform(file, program="spm").map(points)
        assert largest(found, right) < NEAR, largest(found, right)
    file = warp("y_named.nii", places + vectors, affine, 1007, 5, called="Mapping")
    assert largest(brainshift.read_transform(file, program="spm").map(points), right) < NEAR
    for name in ("", "NREG_TRANS"):
        file = warp("y_itk.nii", vectors, affine, 1007, 5, called=name)
        refuses(f"1007 with the name '{name}'", file, program="SPM")
    refuses("intent 1006", warp("y_other.nii", vectors, affine, 1006, 5), program="SPM")
    velocities = numpy.stack((numpy.sin(x), numpy.cos(z), numpy.sin(y)), axis=-1)
    for flow in (velocities, numpy.zeros(vectors.shape)):
        refuses("do not grow along its voxels", warp("u_flow.nii", flow, affine, 0, 5),
                program="SPM")
    refuses("SPM writes none as text", write("sixteen.txt", numbers(numpy.eye(4))), program="spm")


run_tests(globals())
