# SPDX-License-Identifier: BSD-3-Clause
"""Runs many cases, each in a process of its own, and writes their table and index page."""

import collections
import csv
import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from html import escape
from urllib.parse import quote

from .rolefiles import files_of
from .roles import FILE_ROLES, proposed

#: What `batch` can do with a case, in the order in which it does it.
BATCH_STEPS = ("Fit", "Refine", "Judge", "Resect", "Export", "Report")

#: Names of files in the output: of each case, and of all.
RESULT, LOG, PAGE, TABLE, INDEX = "result.json", "log.txt", "report.html", "cases.csv", "index.html"
EXPORTED = "files"

#: Names that a manifest may have, in this order.
MANIFESTS = ("manifest.json", "manifest.csv")

#: Memory (bytes) that a case is expected to need, without its volumes, and how many times the
#: bytes of its files; packed files hold about a third.
_LEAST_BYTES, _BYTES_PER_BYTE = 1.5e9, 20.0

#: Figures of the table, with units.
FIGURES = ("traced points RMS (mm)", "contacts RMS (mm)", "landmarks mean (mm)",
           "landmarks left out, mean (mm)", "largest displacement (mm)",
           "smallest Jacobian determinant", "tumour before (ml)", "tumour left (ml)",
           "left, from (ml)", "left, to (ml)")

_PAUSE_S = 0.2

#: Time (s) that a process gets to end before it is killed.
_PATIENCE_S = 10.0

_STYLE = """:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; margin: 0 auto; max-width: 80rem;
  padding: 1.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 0.4rem 0.8rem 0.4rem 0; border-bottom: 1px solid #8888;
  vertical-align: top; }
.failed { font-weight: 600; }
@page { size: A4 landscape; margin: 14mm; }"""

#: A case to run, the key that its result gets, and the memory (bytes) that it is expected to need.
_Planned = collections.namedtuple("_Planned", "case key bytes")

Done = collections.namedtuple("Done", "name state seconds problem figures folder doubts")
Done.__doc__ = """A case of a batch.

- `name`: as in the manifest
- `state`: `"done"`, `"failed"`, or `"kept"` if an earlier run did it already
- `seconds`: time that it took, of the clock
- `problem`: why it failed, or an empty text
- `figures`: dictionary of numbers, see the table
- `folder`: path of its results
- `doubts`: why figures may be wrong, a list of sentences, see `Case.doubts`
"""


def write_manifest(folder, file):
    """Writes a manifest with what each subfolder's files may be, to be corrected by hand."""
    rows = []
    for name in sorted(os.listdir(folder)):
        path = os.path.join(folder, name)
        if os.path.isdir(path) and not name.startswith("."):
            found = {each.role: os.path.relpath(each.file, folder)
                     for each in proposed(path) if each.role}
            if found:
                rows.append({"name": name, **found})
    with open(file, "w", newline="", encoding="utf-8") as opened:
        writer = csv.DictWriter(opened, ("name", *FILE_ROLES), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return len(rows)


def _is_ball(value):
    return isinstance(value, (list, tuple)) and len(value) == 2 and isinstance(
        value[0], (list, tuple))


def _absolute(value, folder):
    """A path, or a list of paths, from the folder of the manifest. A ball stays."""
    if isinstance(value, str):
        return os.path.normpath(os.path.join(folder, value))
    return value if _is_ball(value) else [_absolute(one, folder) for one in value]


def read_manifest(file):
    """The cases of a manifest: a list of dictionaries with `name` and roles, paths absolute.

    Raises `ValueError` with the row if a name is missing, repeated or no name of a folder, or if a
    column is no role.
    """
    folder = os.path.dirname(os.path.abspath(file))
    with open(file, newline="", encoding="utf-8-sig") as opened:
        rows = json.load(opened) if file.lower().endswith(".json") else list(
            csv.DictReader(opened))
    cases, seen = [], set()
    for number, row in enumerate(rows, 1):
        name = str(row.get("name") or "").strip()
        if not name or name != os.path.basename(name) or name in (".", "..") or name in seen:
            raise ValueError(f"{file}: case {number} has the name {name!r}; each needs one of its "
                             "own, without slashes")
        unknown = sorted(set(row) - {"name", *FILE_ROLES}, key=str)
        if unknown:
            raise ValueError(
                f"{file}: {unknown[0]!r} is no role; roles are {', '.join(FILE_ROLES)}")
        seen.add(name)
        cases.append({"name": name, **{role: _absolute(row[role], folder)
                                       for role in FILE_ROLES if row.get(role)}})
    return cases


def _files(case):
    """All files that are read for a case."""
    for role in FILE_ROLES:
        value = case.get(role)
        for path in [value] if isinstance(value, str) else value or []:
            if isinstance(path, str):
                yield from files_of(path)


def _plan(case, steps):
    """A case whose key changes with it, its files and the steps. Raises `OSError` if its files
    cannot be read."""
    from .version import VERSION

    known = [(path, os.path.getsize(path), os.path.getmtime(path))
             for path in _files(case) if os.path.exists(path)]
    text = json.dumps([case, list(steps), known, VERSION], sort_keys=True)
    size = sum(each for _, each, _ in known)
    return _Planned(case, hashlib.sha256(text.encode()).hexdigest(),
                    _LEAST_BYTES + _BYTES_PER_BYTE * size)


def _bytes_free():
    """Memory that the machine can still give, or None if it does not say."""
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return 1024.0 * float(line.split()[1])
    except OSError:
        pass
    return None


def _program():
    """The path of pvpython."""
    beside = os.path.join(os.path.dirname(sys.executable), "pvpython")
    found = os.environ.get("BRAINSHIFT_PVPYTHON") or shutil.which("pvpython") or (
        beside if os.path.exists(beside) else None)
    if found is None:
        raise FileNotFoundError("there is no pvpython in the path; BRAINSHIFT_PVPYTHON may name it")
    return found


class _Running:
    """A process that does one case."""

    def __init__(self, planned, steps, folder):
        self.case, self.folder, self.begun = planned.case, folder, time.monotonic()
        self.bytes = planned.bytes
        os.makedirs(folder, exist_ok=True)
        self.result = os.path.join(folder, RESULT)
        for former in (RESULT, PAGE):  # of other files or steps
            if os.path.exists(os.path.join(folder, former)):
                os.remove(os.path.join(folder, former))
        shutil.rmtree(os.path.join(folder, EXPORTED), ignore_errors=True)
        job = {"case": planned.case, "steps": list(steps), "folder": folder, "key": planned.key}
        worker = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worker.py")
        path = os.pathsep.join([os.path.dirname(os.path.dirname(worker)),
                                os.environ.get("PYTHONPATH", "")])
        with open(os.path.join(folder, LOG), "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [_program(), worker, json.dumps(job)], stdout=log, stderr=subprocess.STDOUT,
                env={**os.environ, "PYTHONPATH": path})

    def stop(self):
        """Ends the process."""
        self.process.terminate()
        try:
            self.process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def ended(self, timeout=None):
        """What came of it, or None while it runs. After `timeout` (s) it is ended."""
        seconds = time.monotonic() - self.begun
        is_late = self.process.poll() is None and timeout is not None and seconds > timeout
        if is_late:
            self.stop()
        if self.process.poll() is None:
            return None
        result = _read(self.result)
        if result is None and is_late:
            result = {"problem": f"it was ended after {timeout:g} s; see {LOG}", "figures": {}}
        elif result is None:
            problem = f"the process ended with {self.process.returncode}; see {LOG}"
            result = {"problem": problem, "figures": {}}
        state = "failed" if result["problem"] else "done"
        return Done(self.case["name"], state, seconds, result["problem"], result["figures"],
                    self.folder, result.get("doubts", []))


def _read(file):
    """A result, or None if there is none that is whole."""
    try:
        with open(file, encoding="utf-8") as opened:
            return json.load(opened)
    except (OSError, ValueError):
        return None


def _kept(planned, folder):
    """The result of an earlier run with the same files and steps that did not fail and whose
    outputs are still there, or None."""
    result = _read(os.path.join(folder, RESULT))
    if result is None or result["problem"] or result["key"] != planned.key:
        return None
    outputs = result.get("outputs")
    if outputs is None or not all(os.path.exists(os.path.join(folder, name)) for name in outputs):
        return None
    return Done(planned.case["name"], "kept", 0.0, "", result["figures"], folder,
                result.get("doubts", []))


def _fits(running, planned, most):
    """Whether one more case may start: one always may."""
    free = _bytes_free()
    if not running:
        return True
    if len(running) >= most or free is None:
        return len(running) < most
    young = sum(one.bytes for one in running if time.monotonic() - one.begun < 10.0)
    return free - young > planned.bytes  # young ones have not taken theirs yet


def _write_table(done, folder):
    with open(os.path.join(folder, TABLE), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("name", "state", "seconds", *FIGURES, "problem", "doubts"))
        for one in done:
            writer.writerow((one.name, one.state, f"{one.seconds:.1f}",
                             *(one.figures.get(name, "") for name in FIGURES), one.problem,
                             " | ".join(one.doubts)))


def _write_index(done, folder, count):
    from .reporting import NOTICE

    head = "".join(f"<th>{escape(name)}</th>"
                   for name in ("case", "state", *FIGURES, "problem", "doubts"))
    rows = []
    for one in done:
        page = os.path.join(one.folder, PAGE)
        name = escape(one.name)
        if one.state != "failed" and os.path.exists(page):  # it may be of an earlier run
            link = escape(quote(os.path.relpath(page, folder).replace(os.sep, "/")))
            name = f'<a href="{link}">{name}</a>'
        figures = (one.figures.get(name) for name in FIGURES)
        cells = "".join("<td>" + ("" if value is None else f"{value:.2f}") + "</td>"
                        for value in figures)
        rows.append(f'<tr class="{one.state}"><td>{name}</td><td>{one.state}</td>{cells}'
                    f"<td>{escape(one.problem)}</td>"
                    f"<td>{'<br>'.join(escape(doubt) for doubt in one.doubts)}</td></tr>")
    failed = sum(one.state == "failed" for one in done)
    heading = f"{count} cases" if len(done) == count else f"{len(done)} of {count} cases so far"
    with open(os.path.join(folder, INDEX), "w", encoding="utf-8") as file:
        file.write(
            '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" '
            f'content="width=device-width, initial-scale=1"><title>Cases</title><style>{_STYLE}'
            f"</style></head><body><h1>{heading}, {failed} failed</h1>"
            f'<p><strong>{NOTICE}</strong></p><div class="wide"><table><thead><tr>{head}</tr>'
            f"</thead><tbody>{''.join(rows)}</tbody></table></div></body></html>\n")


def _told(progress, done, count):
    line = f"{count[0]} of {count[1]}: {done.name} {done.state}" + (
        f" in {done.seconds:.0f} s" if done.state == "done" else "") + (
        f", {done.problem}" if done.problem else "")
    if progress is None:
        print(line, flush=True)
    else:
        progress(done, *count)


def _write(done, out, count):
    """Writes the table and the index page of so many cases."""
    _write_table(done, out)
    _write_index(done, out, count)


def _run_all(cases, steps, out, most, timeout, progress):
    """Runs what is not done yet, and writes after each case what is known. Returns the results in
    the order of the cases."""
    results, waiting, running = {}, [], []

    def end(done):
        results[done.name] = done
        _write([results[case["name"]] for case in cases if case["name"] in results], out,
               len(cases))
        _told(progress, done, (len(results), len(cases)))

    def fail(case, error):
        end(Done(case["name"], "failed", 0.0, str(error), {}, os.path.join(out, case["name"]), []))
    for case in cases:
        try:
            planned = _plan(case, steps)
        except OSError as error:
            fail(case, error)
            continue
        kept = _kept(planned, os.path.join(out, case["name"]))
        if kept:
            end(kept)
        else:
            waiting.append(planned)
    try:
        while waiting or running:
            while waiting and _fits(running, waiting[0], most):
                planned = waiting.pop(0)
                try:
                    running.append(_Running(planned, steps,
                                            os.path.join(out, planned.case["name"])))
                except OSError as error:
                    fail(planned.case, error)
            for one in list(running):
                done = one.ended(timeout)
                if done:
                    running.remove(one)
                    end(done)
            time.sleep(_PAUSE_S if running else 0.0)
    finally:
        for one in running:  # interrupted
            one.stop()
    return [results[case["name"]] for case in cases]


def batch(folder, steps=("Fit", "Judge", "Resect", "Export", "Report"), manifest=None, out=None,
          processes=None, progress=None, timeout=None):
    """Run many cases, several at a time, each in a process of its own.

    A case that fails does not stop the others: its line says why, and `log.txt` in its folder has
    what its process wrote. A second run does only what is missing, failed, or has other files or
    steps; so an interrupted run goes on where it was.

    - `folder`: path of a folder with a manifest, `manifest.csv` or `manifest.json`: a table with
      the column `name` and one column for each role, or a list of such dictionaries. Paths start
      from the manifest's folder. Without a manifest, what the files of each subfolder may be is
      written into `manifest.csv`, and nothing runs: correct it, and call `batch` again.
    - `steps`: some of Fit, Refine, Judge, Resect, Export and Report. What a case has no data for is
      left out: Judge without landmarks, Resect without a tumour and a cavity, Refine without a
      reference. Default: all but Refine.
    - `manifest`: path of the manifest. The default, `None`, is the one in the folder.
    - `out`: path of the folder for the results. The default, `None`, is `results` in the folder. It
      gets a folder for each case, the table `cases.csv` and the page `index.html`.
    - `processes`: most processes at a time. The default, `None`, is the number of cores. Fewer run
      if the machine has too little free memory for all.
    - `progress`: is called with a `Done`, the number of finished cases and the number of all. The
      default, `None`, prints a line for each.
    - `timeout`: longest time (s) for a case, above 0. One that takes longer is ended and failed.
      The default, `None`, sets no limit.

    Returns a list of `Done`, in the order of the manifest.

    Raises `ValueError` if the manifest had to be written or is wrong, a step is unknown, or the
    timeout is not above 0, and `FileNotFoundError` if there is no folder.
    """
    unknown = [step for step in steps if step not in BATCH_STEPS]
    if unknown:
        raise ValueError(f"step is {unknown[0]!r}; it must be one of {', '.join(BATCH_STEPS)}")
    if timeout is not None and not timeout > 0.0:
        raise ValueError(f"timeout is {timeout}; it must be above 0 s")
    folder = os.path.abspath(os.fspath(folder))
    names = [os.path.join(folder, name) for name in MANIFESTS]
    manifest = manifest or next((name for name in names if os.path.exists(name)), None)
    if manifest is None:
        count = write_manifest(folder, names[-1])
        raise ValueError(f"{folder} had no manifest. What its files may be is in {names[-1]}, "
                         f"{count} cases: check it, then call batch again")
    cases = read_manifest(os.fspath(manifest))
    out = os.path.abspath(os.fspath(out)) if out else os.path.join(folder, "results")
    os.makedirs(out, exist_ok=True)
    most = max(1, int(processes or os.cpu_count() or 1))
    ordered = [step for step in BATCH_STEPS if step in steps]
    done = _run_all(cases, ordered, out, most, timeout, progress)
    _write(done, out, len(cases))
    return done
