# SPDX-License-Identifier: BSD-3-Clause
# Proves that a batch does every case of a manifest in a process of its own, that one that fails
# stops no other, that a second run does only what is missing, and that a folder without a manifest
# gets one to correct and runs nothing.
import csv
import os
import shutil

from brainshift_testing import assert_says, load_plugin, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.batching import _key  # noqa: E402
from patient_testing import make_patient, refused  # noqa: E402

FOLDER = scratch("cohort")
STEPS = ("Fit", "Judge", "Resect", "Export")


def table():
    with open(os.path.join(FOLDER, "results", "cases.csv"), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run(steps=STEPS):
    told = []
    done = brainshift.batch(FOLDER, steps, progress=lambda *one: told.append(one))
    assert [(count, total) for _, count, total in told] == [
        (i + 1, len(done)) for i in range(len(done))], told
    return {one.name: one for one in done}


def test_a_folder_without_a_manifest_gets_one():
    shutil.rmtree(FOLDER, ignore_errors=True)
    for name in ("first", "second"):
        make_patient(os.path.join(FOLDER, name))
    refused(["no manifest", "manifest.csv", "2 cases"], lambda: brainshift.batch(FOLDER, STEPS))
    assert not os.path.exists(os.path.join(FOLDER, "results"))
    with open(os.path.join(FOLDER, "manifest.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["name"] for row in rows] == ["first", "second"]
    assert rows[0]["tumour"] == os.path.join("first", "sub-1_Tumor.nii.gz"), rows[0]


def test_one_failure_stops_no_other():
    with open(os.path.join(FOLDER, "second", "pointer.csv"), "w", encoding="utf-8") as file:
        file.write("x,y,z\n1,2\n")
    done = run()
    assert done["first"].state == "done", done
    assert done["second"].state == "failed" and "pointer.csv" in done["second"].problem, done
    rows = table()
    assert [row["state"] for row in rows] == ["done", "failed"]
    assert 0.0 < float(rows[0]["tumour left (ml)"]) < float(rows[0]["tumour before (ml)"])
    assert os.path.exists(os.path.join(done["first"].folder, "files", "sub-1_T1w_bent.nii.gz"))
    with open(os.path.join(FOLDER, "results", "index.html"), encoding="utf-8") as file:
        assert_says(file.read(), "2 cases, 1 failed", "pointer.csv", "not for clinical use")


def test_a_second_run_does_what_is_missing():
    for file in ("report.html", os.path.join("files", "old.nii.gz")):
        os.makedirs(os.path.dirname(os.path.join(FOLDER, "results", "second", file)), exist_ok=True)
        with open(os.path.join(FOLDER, "results", "second", file), "w", encoding="utf-8"):
            pass
    shutil.copy(os.path.join(FOLDER, "first", "pointer.csv"), os.path.join(FOLDER, "second"))
    before = os.path.getmtime(os.path.join(FOLDER, "results", "first", "result.json"))
    done = run()
    assert [done[name].state for name in ("first", "second")] == ["kept", "done"], done
    assert os.path.getmtime(os.path.join(FOLDER, "results", "first", "result.json")) == before
    assert table()[0]["tumour left (ml)"] == table()[1]["tumour left (ml)"]
    assert all(row["landmarks mean (mm)"] == "" for row in table()), "the fit used them"
    assert all(float(row["landmarks left out, mean (mm)"]) > 0.0 for row in table())
    assert not os.path.exists(os.path.join(FOLDER, "results", "second", "report.html"))
    assert "old.nii.gz" not in os.listdir(os.path.join(FOLDER, "results", "second", "files"))


def test_a_case_that_takes_too_long_is_ended():
    tables = []
    done = brainshift.batch(FOLDER, STEPS, out=scratch("short"), timeout=0.2, processes=1,
                            progress=lambda *_: tables.append(
                                os.path.exists(scratch("short/cases.csv"))))
    assert [one.state for one in done] == ["failed", "failed"] and all(tables), (done, tables)
    assert_says(done[0].problem, "0.2 s")
    refused(["timeout"], lambda: brainshift.batch(FOLDER, STEPS, timeout=0))


def test_voxels_beside_a_header_count():
    case = {"name": "a", "volume": scratch("head.mhd"), "brain": scratch("brain.nhdr"),
            "tumour": scratch("slices.mhd")}
    for name, text in (("head.mhd", "NDims = 3\nElementDataFile = head.raw\n"),
                       ("brain.nhdr", "NRRD0004\ndata file: brain.raw\n"),
                       ("slices.mhd", "ElementDataFile = LIST\none.raw\ntwo.raw\n"),
                       ("head.raw", "1"), ("brain.raw", "1"), ("one.raw", "1"), ("two.raw", "1")):
        with open(scratch(name), "w", encoding="utf-8") as file:
            file.write(text)
    keys = {_key(case, STEPS)}
    for count, name in enumerate(("head.raw", "brain.raw", "one.raw", "two.raw"), 2):
        with open(scratch(name), "w", encoding="utf-8") as file:
            file.write("22")
        keys.add(_key(case, STEPS))
        assert len(keys) == count, name


def test_wrong_manifests_and_steps_are_refused():
    refused(["Paint", "Report"], lambda: brainshift.batch(FOLDER, ["Paint"]))
    for rows, words in (("name,colour\na,red\n", ["colour", "no role"]),
                        ("name,volume\na,x.nii\na,y.nii\n", ["case 2", "'a'"]),
                        ("name,volume\n../a,x.nii\n", ["case 1", "../a"])):
        with open(scratch("wrong.csv"), "w", encoding="utf-8") as file:
            file.write(rows)
        refused(words, lambda: brainshift.batch(FOLDER, STEPS, manifest=scratch("wrong.csv")))


run_tests(globals())
