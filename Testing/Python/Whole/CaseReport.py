# SPDX-License-Identifier: BSD-3-Clause
# Proves that the report of a case is one page that needs nothing else: its pictures are inside and
# differ as they must, its figures are those of the case, hashes are those of the files, and it
# names no patient unless asked.
import base64
import hashlib
import os
import re
import shutil
from html.parser import HTMLParser

import numpy
from brainshift_testing import assert_says, load_plugin, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import reporting, scenes  # noqa: E402
from brainshift.drawing import ORANGE  # noqa: E402
from paraview import simple  # noqa: E402
from patient_testing import TOP, make_patient  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

FOLDER = scratch("Doe^John")
ROLES = {"volume": "sub-1_T1w.nii.gz", "brain": "sub-1_brainmask.nii.gz",
         "tumour": "sub-1_Tumor.nii.gz", "traces": "pointer.csv", "landmarks": "targets.csv",
         "cavity": "cavity.nii.gz"}
VOID = {"meta", "img", "br"}


def fitted():
    simple.ResetSession()
    load_plugin()
    make_patient(FOLDER)
    case = brainshift.Case(**{role: f"{FOLDER}/{name}" for role, name in ROLES.items()},
                           opening=(TOP, 27.0))
    case.landmarks_judge = True
    case.run("Fit")
    case.run("Judge")
    case.resect(fields=50)
    case.run("Export", folder=scratch("exported"))
    return case


def text_of(file):
    with open(file, encoding="utf-8") as opened:
        return opened.read()


class Balanced(HTMLParser):
    """Raises an error where tags do not match."""

    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, (tag, self.getpos())


def pictures(page):
    """All pictures, indexed [row from below, column, colour]."""
    found = []
    for data in re.findall(r"data:image/png;base64,([^\"]+)", page):
        with open(scratch("one.png"), "wb") as file:
            file.write(base64.b64decode(data))
        reader = vtkPNGReader()
        reader.SetFileName(scratch("one.png"))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        scalars = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        found.append(scalars.reshape(height, width, -1)[:, :, :3].astype(int))
    return found


def test_one_page_has_all_of_it():
    case = fitted()
    views = len(simple.GetRenderViews())
    sources = sorted(name for name, _ in simple.GetSources())
    page = text_of(brainshift.report(case, scratch("report.html")))
    assert sorted(name for name, _ in simple.GetSources()) == sources
    assert len(simple.GetRenderViews()) == views
    assert case.fit_source().Evidence == 0, "the fit is as it was"
    Balanced().feed(page)
    assert not re.search(r"(src|href)=\"(?!data:)", page), "the page needs another file"
    assert "<script" not in page
    assert page.count("Research software, not for clinical use") == 2
    assert_says(page, "prefers-color-scheme: dark", "@page { size: A4", "Resection", "Evidence",
                "Measurements", "Settings", "Versions", f"{case.resection.left:.2f} ml",
                f"{case.trace_distance.RMS:.2f} mm", "90 % interval")
    for name in ROLES.values():
        with open(f"{FOLDER}/{name}", "rb") as file:
            assert hashlib.sha256(file.read()).hexdigest() in page, name
        assert name not in page, "a name of a file may name the patient"
    words = re.sub(r"data:[^\"]+", "", page)
    assert "Doe" not in words and FOLDER not in words
    assert "sub-1" not in words, "the names of exported files have that of the volume"
    assert_says(words, "4 files", "<td class=\"\">yes</td>")
    place = brainshift.rest_from_deformed(case.bent, [scenes.focus_of(case)])
    deviation = brainshift.Fit(case.fit_source()).deviation(place)[0]
    assert_says(words, f">{deviation:.2f} mm<")
    named = brainshift.report(case, scratch("names.html"), names=True)
    assert_says(text_of(named), *ROLES.values())


def test_the_pictures_show_what_they_say():
    page = text_of(scratch("report.html"))
    shown = pictures(page)
    assert len(shown) == 2 + 3 + 3 + 3 + 2 + 3, len(shown)
    for before, after in ((0, 1), (2, 5), (11, 12)):
        assert shown[before].max() > 100, "a picture is black"
        assert numpy.abs(shown[before] - shown[after]).mean() > 0.2, (before, after)
    for picture in (shown[0], shown[1], shown[11], shown[12]):  # the scale bar is below the tissue
        height, width, _ = picture.shape
        drawn = picture.max(axis=2) > 40
        beside = numpy.r_[0:int(0.15 * width), int(0.55 * width):int(0.85 * width)]
        assert not drawn[:int(0.1 * height), beside].any(), "tissue beside the scale bar"
        tissue = drawn[int(0.11 * height):, :int(0.89 * width)]
        sides = [numpy.ptp(numpy.flatnonzero(tissue.any(axis=axis))) for axis in (0, 1)]
        assert sides[0] > 0.8 * width or sides[1] > 0.8 * height, (sides, width, height)
    # The tumour: orange where it is left, blue where it was removed.
    red, green, blue = numpy.concatenate(shown[8:11]).transpose(2, 0, 1)
    is_left = (red > 1.3 * green) & (green > 1.3 * blue) & (red > 0.5 * ORANGE[0])
    assert is_left.sum() > 50 and ((blue > red + 40) & (blue > green + 20)).sum() > 50
    # Points below the cortex are purple, and large enough for print.
    red, green, blue = shown[11].transpose(2, 0, 1)
    purple = ((blue > green + 60) & (red > green + 30)).sum()
    assert purple > 4500, purple
    for picture, plain in zip(shown[13:16], shown[5:8]):
        assert numpy.abs(picture - plain).mean() > 1.0, "no evidence is drawn"


def test_the_deviation_is_of_what_is_drawn():
    """Strokes and Strength take tissue away from the fit, and count as in the pictures; a fit for
    other settings says nothing."""
    simple.ResetSession()
    load_plugin()
    case = brainshift.Case(volume=f"{FOLDER}/sub-1_T1w.nii.gz", traces=f"{FOLDER}/pointer.csv",
                           brain=f"{FOLDER}/sub-1_brainmask.nii.gz")
    case.run("Fit")
    fit, place = brainshift.Fit(case.fit_source()), numpy.array([scenes.focus_of(case)])

    def shown():
        rows, _ = reporting._fit_rows(case)
        return next((value, reporting._values([(name, value, *rest)])) for name, value, *rest in
                    rows if name == "Deviation in the slices' middle")

    def expect(rest, away):
        value, page = shown()
        deviation = numpy.hypot(fit.deviation(rest)[0], away / numpy.sqrt(3.0))
        assert abs(value - deviation) < 0.01, (value, deviation)
        assert_says(page, f"{deviation:.2f} mm")
    expect(brainshift.rest_from_deformed(case.bent, place), 0.0)
    case.bent.Strength = 0.0
    sunk = numpy.linalg.norm(fit.measured_from_rest(place) - place)
    assert sunk > 2.0, sunk
    expect(place, sunk)
    case.bent.Strength = 1.0
    assert reporting._evidence(case, place[0])
    case.bent.Samples = 2
    _, page = shown()
    assert_says(page, ">not known<")
    assert reporting._evidence(case, place[0]) == []
    assert case.fit_source().Evidence == 0


# Bright is dark at time 1. A display follows the range of the data, so that brighter would not do.
INVERTED = """
from vtkmodules.vtkImagingCore import vtkImageShiftScale
asked = self.GetOutputInformation(0)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
scaled = vtkImageShiftScale()
scaled.SetInputData(self.GetInputDataObject(0, 0))
scaled.SetShift(-318.0 * asked.Get(Pipeline.UPDATE_TIME_STEP()))
scaled.SetScale(1.0 - 2.0 * asked.Get(Pipeline.UPDATE_TIME_STEP()))
scaled.Update()
self.GetImageDataOutput().ShallowCopy(scaled.GetOutput())
"""
HAS_TIMES = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
self.GetOutputInformation(0).Set(Pipeline.TIME_STEPS(), [0.0, 1.0], 2)
self.GetOutputInformation(0).Set(Pipeline.TIME_RANGE(), [0.0, 1.0], 2)
"""


def test_pictures_are_of_the_time_that_is_shown():
    simple.ResetSession()
    load_plugin()
    times = simple.ProgrammableFilter(
        Input=simple.Wavelet(WholeExtent=[-15, 15] * 3), OutputDataSetType="vtkImageData",
        Script=INVERTED, RequestInformationScript=HAS_TIMES)
    case = brainshift.Case(volume=times)
    found = []
    for time in (0.0, 1.0, 0.0):
        simple.GetTimeKeeper().Time = time
        found.append(scenes.before_and_after(case, (120, 120))[1].astype(int))
    assert numpy.array_equal(found[0], found[2])
    assert abs(found[1] - found[0]).max(axis=2).mean() > 10, "the second is another"


def test_hashes_are_of_all_that_is_read():
    """The hash and the size of a row change with voxels beside a header, slices and chunks, the
    hash with their names, too; the row says what they are."""
    shutil.rmtree(scratch("hashed"), ignore_errors=True)
    part = 128 * b"\0" + b"DICM"
    files = {"head.mhd": b"ElementDataFile = head.raw\n", "head.raw": b"1",
             "medium/st1/1": part, "medium/st2/2": part, "series/1.dcm": part,
             "series/2.dcm": part, "store.zarr/zarr.json": b"{}", "store.zarr/0/c/0/0": b"1",
             "empty/.DS_Store": b"",
             "times.pvd": b"<DataSet timestep='0' file=\"parts &amp; more/a.pvti\"/>",
             "parts & more/a.pvti": b"<Piece Extent='0 1' Source='1.vti'/>",
             "parts & more/1.vti": b"1"}
    for name, content in files.items():
        os.makedirs(os.path.dirname(scratch(f"hashed/{name}")), exist_ok=True)
        with open(scratch(f"hashed/{name}"), "wb") as file:
            file.write(content)

    def row(name, listed=False):
        return reporting._about_files(scratch(f"hashed/{name}"), listed)
    for name, kind, other in (
            ("head.mhd", ".mhd, 2 files", "head.raw"),
            ("times.pvd", "3 files", "parts & more/1.vti"),
            ("medium", "DICOM series of 2 files", "medium/st2/2"),
            ("series/1.dcm", "DICOM series of 2 files", "series/2.dcm"),
            ("store.zarr", "OME-Zarr store", "store.zarr/0/c/0/0"),
            ("store.zarr/zarr.json", "OME-Zarr store", "store.zarr/0/c/0/0")):
        before = row(name)
        assert before[0] == kind, before
        with open(scratch(f"hashed/{other}"), "ab") as file:
            file.write(2000 * b"2")
        after = row(name)
        assert before[1] != after[1] and before[2] != after[2], (name, before, after)
    found = row("medium")[2]
    os.rename(scratch("hashed/medium/st2/2"), scratch("hashed/medium/st2/3"))
    assert row("medium")[2] != found, "a name changed"
    lines = "".join(f"{hashlib.sha256(content).hexdigest()}  {name}\n" for name, content in (
        ("1.dcm", part), ("2.dcm", part + 2000 * b"2")))  # as sha256sum prints them
    assert row("series")[2] == row("series/1.dcm")[2] == hashlib.sha256(lines.encode()).hexdigest()
    alone = hashlib.sha256(part).hexdigest()  # its reader names each slice
    assert row("series/1.dcm", listed=True)[2] == alone
    assert_says(" ".join(row("empty") + row("none.nii")), "has no files", "not on this machine")


def test_a_case_with_less_has_a_shorter_page():
    simple.ResetSession()
    load_plugin()
    brainshift.save_volume(brainshift.Case(volume=f"{FOLDER}/sub-1_T1w.nii.gz").volume,
                           scratch("local.mhd"))
    with open(scratch("local.mhd"), "rb") as file:
        header, voxels = file.read().split(b"LOCAL\n", 1)
    for name, content in (("short.mhd", header + b"short.raw\n"), ("short.raw", voxels)):
        with open(scratch(name), "wb") as file:
            file.write(content)
    case = brainshift.Case(volume=scratch("short.mhd"))
    page = text_of(brainshift.report(case, scratch("short.html")))
    assert_says(page, ".mhd, 2 files", reporting.hash_of(scratch("short.mhd")))
    Balanced().feed(page)
    assert "Resection" not in page and "Evidence" not in page
    assert len(pictures(page)) == 8
    case.landmarks = f"{FOLDER}/targets.csv"
    fit = case.fit()
    tiles = "".join(reporting._tiles(case, fit, reporting._distances(case)))
    assert_says(tiles, "Landmarks left out, in the mean", f"{reporting.left_out_mean(fit):.2f} mm")
    try:
        brainshift.report(brainshift.Case(), scratch("none.html"))
    except ValueError as error:
        assert_says(str(error), "no volume")
    else:
        raise AssertionError("a case without a volume has a report")


run_tests(globals())
