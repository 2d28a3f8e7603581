# SPDX-License-Identifier: BSD-3-Clause
"""Feeds BrainShift spoiled files, properties and fields, and counts what goes wrong.

    ./brainshift fuzz [--count N] [--seed S] [--kind KIND] [--limit SECONDS]

N cases of each kind run in processes of their own: a crash costs one case. It exits with 1 if a
case ended its process, ran out of time, moved a voxel without a word or left a wrong picture
behind. A case is made from the seed, its kind and its number alone, so `--first` repeats it.
"""

import argparse
import collections
import glob
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading

HERE = os.path.dirname(os.path.abspath(__file__))
#: The folders of the formats, and those of their cases: a kind is a file KIND_cases.py.
FORMATS = sorted(glob.glob(os.path.join(HERE, "..", "Formats", "*", "")))
KINDS = sorted(os.path.basename(path)[:-len("_cases.py")] for folder in [HERE, *FORMATS]
               for path in glob.glob(os.path.join(folder, "*_cases.py")))
#: What a case must not do. A worker names the last two itself.
FAULTS = ("crash", "hang", "misplaced", "stuck")
STARTS_WITHIN = 300.0  # seconds for ParaView to start, whatever the limit of a case


def arguments(words):
    parser = argparse.ArgumentParser(prog="./brainshift fuzz", description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=1000, help="cases of each kind; default 1000")
    parser.add_argument("--seed", type=int, default=1, help="default 1")
    parser.add_argument("--first", type=int, default=0, help="number of the first case; default 0")
    parser.add_argument("--kind", choices=KINDS, action="append", help="default: all")
    parser.add_argument("--keep", metavar="FOLDER", help="where to keep the files of each case")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds a case may take; 120")
    return parser.parse_args(words)


class Worker:
    """A process that runs cases, and the lines that it prints."""

    def __init__(self, kind, options, first, end, folder):
        pvpython = os.environ.get("BRAINSHIFT_PVPYTHON") or shutil.which("pvpython")
        paths = [HERE, os.path.join(HERE, "..", "Support"), *FORMATS,
                 os.environ.get("PYTHONPATH", "")]
        self.errors = open(os.path.join(folder, "stderr.txt"), "w", encoding="utf-8")
        self.process = subprocess.Popen(
            [pvpython, os.path.join(HERE, "worker.py"), kind, str(options.seed), str(first),
             str(end), folder, *([options.keep] if options.keep else [])],
            stdout=subprocess.PIPE, stderr=self.errors, text=True, errors="replace",
            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)})
        self.lines = queue.Queue()
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self):
        for line in self.process.stdout:
            self.lines.put(line)
        self.lines.put(None)

    def line(self, seconds):
        """The next line; None at the end. Raises queue.Empty if none comes in time."""
        return self.lines.get(timeout=seconds)

    def last_words(self):
        """The end of what the process said."""
        with open(self.errors.name, encoding="utf-8", errors="replace") as said:
            return " | ".join(said.read().splitlines()[-2:])[-200:]

    def end(self):
        self.process.kill()
        self.process.wait()
        self.errors.close()
        return self.process.returncode


def run_some(kind, options, first, end, folder):
    """Runs cases until one ends or blocks the worker. Yields (number, result)."""
    worker = Worker(kind, options, first, end, folder)
    current, upcoming, waits = None, first, STARTS_WITHIN
    try:
        while (line := worker.line(waits)) is not None:
            word, _, rest = line.strip().partition(" ")
            if word == "case":
                current, waits = int(rest), options.limit
            elif word == "done":
                number, _, result = rest.partition(" ")
                yield int(number), result
                current, upcoming = None, int(number) + 1
        if current is not None or upcoming < end and worker.process.wait() != 0:
            yield upcoming, f"crash: {worker.last_words()}"
    except queue.Empty:
        yield upcoming, "hang"
    finally:
        worker.end()


def run_kind(kind, options, folder):
    """The number of cases by their result, and the findings."""
    counts, findings = collections.Counter(), []
    number, end = options.first, options.first + options.count
    while number < end:
        for number, result in run_some(kind, options, number, end, folder):
            word = result.partition(":")[0]
            counts[word] += 1
            if word in FAULTS or word == "accepted":
                findings.append((number, result))
        number += 1
    return counts, findings


def main(words):
    options = arguments(words)
    faults = 0
    for kind in options.kind or KINDS:
        with tempfile.TemporaryDirectory(prefix="brainshift-fuzz-") as folder:
            counts, findings = run_kind(kind, options, folder)
        said = ", ".join(f"{word} {count}" for word, count in sorted(counts.items()))
        print(f"{kind}: {sum(counts.values())} cases of seed {options.seed}: {said}", flush=True)
        for word in FAULTS:
            print(f"  {word}: {counts[word]}")
            faults += counts[word]
        for number, result in findings:
            print(f"  case {number}: {result}")
            print(f"    again: ./brainshift fuzz --kind {kind} --seed {options.seed} "
                  f"--first {number} --count 1")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
