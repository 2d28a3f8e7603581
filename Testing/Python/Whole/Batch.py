# SPDX-License-Identifier: BSD-3-Clause
# Proves that a batch does every case of a manifest in a process of its own, that one that fails
# or cannot be read stops no other, that a second run does what is missing or has other files, and
# that a folder without a manifest gets one to correct and runs nothing.
import csv
import json
import os
import shutil

from brainshift_testing import assert_says, load_plugin, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.batching import _kept, _plan  # noqa: E402
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
    assert rows[0]["doubts"].split(" | ") == list(done["first"].doubts) != [], rows[0]
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


def test_a_case_that_cannot_be_read_stops_no_other():
    """And what a case wrote must still be there for it to be kept."""
    cohort, name = scratch("unreadable"), "50 % #1"
    shutil.rmtree(cohort, ignore_errors=True)
    os.makedirs(cohort)
    os.symlink("/proc/self/mem", os.path.join(cohort, "head.mhd"))  # opens, but cannot be read
    volume = os.path.join(FOLDER, "first", "sub-1_T1w.nii.gz")
    with open(os.path.join(cohort, "manifest.json"), "w", encoding="utf-8") as file:
        json.dump([{"name": "broken", "volume": "head.mhd"}, {"name": name, "volume": volume}],
                  file)
    steps, results = ("Export", "Report"), os.path.join(cohort, "results")
    for state in ("done", "kept"):
        broken, whole = brainshift.batch(cohort, steps, progress=lambda *_: None)
        assert (broken.state, whole.state) == ("failed", state), (broken, whole)
        assert_says(broken.problem, "Input/output error")
    with open(os.path.join(results, "index.html"), encoding="utf-8") as file:
        assert_says(file.read(), 'href="50%20%25%20%231/report.html"', "2 cases, 1 failed")
    planned = _plan({"name": name, "volume": volume}, steps)
    for output in ("report.html", "files/sub-1_T1w_bent.nii.gz"):
        path = os.path.join(results, name, output)
        os.rename(path, path + ".away")
        assert _kept(planned, whole.folder) is None, output
        os.rename(path + ".away", path)
        assert _kept(planned, whole.folder).state == "kept", output


def write_all(texts):
    """Writes files of a folder: a dictionary of texts by name."""
    for name, text in texts.items():
        os.makedirs(os.path.dirname(scratch(name)), exist_ok=True)
        with open(scratch(name), "w", encoding="latin-1") as file:
            file.write(text)


def test_all_files_that_are_read_count():
    """A key changes with voxels beside a header, slices and chunks below a folder, slices beside
    the one that was opened, and what says the unit of a table."""
    shutil.rmtree(scratch("keys"), ignore_errors=True)
    roles = {"volume": "head.mhd", "brain": "brain.nhdr", "tumour": "slices.mhd",
             "opening": "numbered.mha", "cavity": "pair.hdr", "reference": "store.ome.zarr",
             "traces": "medium", "electrodes": "sub-1_space-X_electrodes.tsv",
             "landmarks": "series/1.dcm"}
    slice_of_dicom = 128 * "\0" + "DICM"
    write_all({f"keys/{name}": text for name, text in {
        "head.mhd": "NDims = 3\n\nElementDataFile = a head.raw\n", "brain.nhdr":
        "NRRD0004\nData File: brain.raw\n", "slices.mhd":
        "ElementDataFile = LIST\none.raw\ntwo.raw\n",
        "numbered.mha": "ElementDataFile = n%02d.raw 3 9 3\n", "pair.hdr": "",
        "series/1.dcm": slice_of_dicom, "sub-1_space-X_electrodes.tsv": "x\ty\tz\n"}.items()})
    case = {"name": "a", **{role: scratch(f"keys/{name}") for role, name in roles.items()}}
    counting = ("a head.raw", "brain.raw", "one.raw", "two.raw", "n03.raw", "n09.raw", "pair.img",
                "store.ome.zarr/.zattrs", "store.ome.zarr/0/0/1/2", "medium/p1/st1/se1/im1",
                "series/2.dcm", "sub-1_coordsystem.json", "sub-1_space-X_coordsystem.json")
    keys = {_plan(case, STEPS).key}
    for count, name in enumerate(counting, 2):
        write_all({f"keys/{name}": "22"})
        planned = _plan(case, STEPS)
        keys.add(planned.key)
        assert len(keys) == count, name
    size = planned.bytes
    write_all({f"keys/{name}": "" for name in (
        "n04.raw", "other.raw", "medium/.DS_Store", "series/.notes", "sub-2_coordsystem.json",
        "sub-1_coordsystem.json")})
    assert _plan(case, STEPS) == planned, "these are not read"
    write_all({"keys/store.ome.zarr/0/0/1/2": "22222"})
    assert _plan(case, STEPS).bytes > size


def test_wrong_manifests_and_steps_are_refused():
    refused(["Paint", "Report"], lambda: brainshift.batch(FOLDER, ["Paint"]))
    for rows, words in (("name,colour\na,red\n", ["colour", "no role"]),
                        ("name,volume\na,x.nii\na,y.nii\n", ["case 2", "'a'"]),
                        ("name,volume\n../a,x.nii\n", ["case 1", "../a"])):
        with open(scratch("wrong.csv"), "w", encoding="utf-8") as file:
            file.write(rows)
        refused(words, lambda: brainshift.batch(FOLDER, STEPS, manifest=scratch("wrong.csv")))


run_tests(globals())
