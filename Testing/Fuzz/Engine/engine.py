# SPDX-License-Identifier: BSD-3-Clause
"""Runs libFuzzer on each parser, and reports how much of the formats it reached.

    ./brainshift fuzz --engine libfuzzer [--count N] [--seed S] [--kind PARSER]

N cases of each parser run under the address and undefined-behaviour sanitizers. A case begins with
files of Testing/Data and those of ./brainshift fuzz, and with what earlier runs found, which the
build folder keeps. It exits with 1 if a parser crashed, took too long or too much memory, or threw
anything but a refusal; then the folder `findings` has a file with the case.
"""

import argparse
import collections
import glob
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
LONGEST = 1 << 17  # bytes of a case: a mosaic of Testing/Data has 108206
SECONDS, MEMORY_MB = 25, 3000  # of one case, that is not slow but stuck
MOST_FINDINGS = 5  # of a parser: those that follow are often the same

#: The names of files that a parser begins with. All others take the ending of their name.
SEEDS = {"dicom": r"\.dcm$", "like": r"\.dcm$", "metaimage": r"\.mha$", "metaimagefield": r"\.mha$",
         "mgh": r"\.mgh$", "minc1": r"\.mnc$", "minc2": r"\.mnc$",
         "hdf5": r"\.h5$", "nifti": r"\.nii(\.gz)?$",
         "niftifield": r"\.nii(\.gz)?$", "fslwarp": r"\.nii(\.gz)?$", "spmwarp": r"\.nii(\.gz)?$",
         "nrrd": r"\.nrrd$", "nrrdfield": r"\.nrrd$", "omezarr": r"\.zarr\.files$",
         "trx": r"\.trx\.files$", "zip": r"\.(zip|trx|mrb)$", "deflated": r"\.deflated$",
         "jpeg": r"\.jpeg$", "jpeg2000": r"\.jpeg2000$", "jpegls": r"\.jpegls$", "rle": r"\.rle$",
         "freesurfer": r"\.pial$", "gifti": r"\.gii$", "mrtrix": r"\.tck$", "trackvis": r"\.trk$",
         "elastix": r"\.txt$", "itktext": r"\.tfm$", "lta": r"\.lta$", "matlab": r"\.mat$",
         "xfm": r"\.xfm$", "fcsv": r"\.fcsv$", "markups": r"\.mrk\.json$",
         "table": r"\.(csv|tsv)$", "tag": r"\.tag$", "message": r"\.message$",
         "session": r"\.session$"}


def arguments(words):
    parser = argparse.ArgumentParser(prog="./brainshift fuzz --engine libfuzzer",
                                     description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=1000, help="cases of each parser; 1000")
    parser.add_argument("--seed", type=int, default=1, help="default 1")
    parser.add_argument("--kind", choices=sorted(SEEDS), action="append", help="default: all")
    return parser.parse_args(words)


def gather(folder):
    """Puts the files that parsers begin with into a folder for each; whole or not at all."""
    from seeds import gathered
    for old in glob.glob(os.path.join(os.path.dirname(folder), "seeds*")):
        shutil.rmtree(old)  # made of other cases
    with tempfile.TemporaryDirectory(dir=os.path.dirname(folder)) as place:
        for parser in SEEDS:
            os.makedirs(os.path.join(place, "all", parser))
        for name, data in gathered():
            for parser in SEEDS:
                if re.search(SEEDS[parser], name) and len(data) <= LONGEST:
                    path = os.path.join(place, "all", parser, hashlib.sha1(data).hexdigest())
                    with open(path, "wb") as file:
                        file.write(data)
        os.rename(os.path.join(place, "all"), folder)


def fuzzed(build, parser, options, found):
    """Runs the cases of one parser. The number that ran, and the findings as sentences."""
    corpus, findings = (os.path.join(build, folder, parser) for folder in ("corpus", "findings"))
    for folder in (corpus, findings):
        os.makedirs(folder, exist_ok=True)
    done, sentences, seed = 0, [], options.seed
    while done < options.count and len(sentences) < MOST_FINDINGS:
        made = subprocess.run(
            [os.path.join(build, "bin", "fuzz_" + parser), f"-runs={options.count - done}",
             f"-seed={seed}", f"-max_len={LONGEST}", f"-timeout={SECONDS}",
             f"-rss_limit_mb={MEMORY_MB}", "-print_final_stats=1", "-verbosity=1",
             f"-artifact_prefix={findings}/", corpus, found],
            env={**os.environ, "LLVM_PROFILE_FILE": os.devnull},
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
        said = made.stderr.decode(errors="replace")
        ran = re.findall(r"stat::number_of_executed_units: (\d+)", said) or re.findall(
            r"^#(\d+)", said, re.MULTILINE)
        done += max(1, int(ran[-1]) if ran else 0)
        if made.returncode == 0:
            break
        seed += 1
        sentences.append(finding_of(said))
    return done, sentences


def finding_of(said):
    """What a sanitizer or libFuzzer reports of a case, in one line, and the path of the case."""
    words = re.findall(r"^(?:SUMMARY|.*runtime error|terminate called|  what\(\)).*", said,
                       re.MULTILINE)
    place = re.findall(r"Test unit written to (.*)", said)
    ours = re.findall(r"#\d+ \S+ in (\S+) .*/(?:Formats|Common|Tracking)/(\S+:\d+)", said)[:2]
    return " | ".join([*words[:3], *(" ".join(frame) for frame in ours), *place[-1:]])[:600]


def covered(build, parsers, seeds):
    """Runs all that is kept once more, and counts regions and lines: {file: (lines, of them)}."""
    counts = os.path.join(build, "counts")
    os.makedirs(counts, exist_ok=True)
    for old in glob.glob(os.path.join(counts, "*")):
        os.remove(old)
    for parser in parsers:
        folders = [os.path.join(build, "corpus", parser), os.path.join(seeds, parser)]
        subprocess.run(
            [os.path.join(build, "bin", "fuzz_" + parser), "-runs=0", f"-timeout={SECONDS}",
             f"-rss_limit_mb={MEMORY_MB}", f"-max_len={LONGEST}", *folders],
            env={**os.environ, "LLVM_PROFILE_FILE": os.path.join(counts, f"{parser}-%m.profraw")},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    merged = os.path.join(counts, "all.profdata")
    subprocess.run(["llvm-profdata", "merge", "--sparse", "-o", merged,
                    *glob.glob(os.path.join(counts, "*.profraw"))], check=True)
    library = sorted(glob.glob(os.path.join(build, "**", "libvtkBrainShiftFormats*.so"),
                               recursive=True))[0]
    programs = [f"--object={os.path.join(build, 'bin', 'fuzz_' + parser)}" for parser in parsers]
    said = subprocess.run(["llvm-cov", "export", "--summary-only", f"--instr-profile={merged}",
                           library, *programs], check=True, capture_output=True)
    for file in json.loads(said.stdout)["data"][0]["files"]:
        lines = file["summary"]["lines"]
        yield os.path.relpath(file["filename"], ROOT), lines["covered"], lines["count"]


def report(found):
    """Prints the lines that were reached, by folder."""
    reached, of = collections.Counter(), collections.Counter()
    for name, covered_lines, lines in found:
        folder = os.path.dirname(name)
        if name.endswith(".cxx") and folder.startswith(("Formats", "Tracking")):
            for key in (folder, "all"):
                reached[key] += covered_lines
                of[key] += lines
    for folder in sorted(of):
        print(f"lines of {folder}: {reached[folder]} of {of[folder]} "
              f"({100 * reached[folder] / of[folder]:.0f} %)")


def main(build, words):
    from seeds import digest
    options = arguments(words)
    parsers = options.kind or sorted(SEEDS)
    programs = {os.path.basename(path)[5:] for path in glob.glob(
        os.path.join(build, "bin", "fuzz_*"))}
    if programs != set(SEEDS):
        sys.exit(f"Parsers.h and engine.py differ in {sorted(programs ^ set(SEEDS))}")
    seeds = os.path.join(build, f"seeds-{digest()}")
    if not os.path.isdir(seeds):
        gather(seeds)
    faults = total = 0
    with tempfile.TemporaryDirectory(prefix="brainshift-fuzz-") as folder:
        os.environ["TMPDIR"] = folder
        for parser in parsers:
            done, sentences = fuzzed(build, parser, options, os.path.join(seeds, parser))
            total, faults = total + done, faults + len(sentences)
            print(f"{parser}: {done} cases of seed {options.seed}, {len(sentences)} findings",
                  flush=True)
            for sentence in sentences:
                print(f"  {sentence}", flush=True)
        print(f"all: {total} cases, {faults} findings")
        report(covered(build, parsers, seeds))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
