# SPDX-License-Identifier: BSD-3-Clause
"""Writes the results: tables on screen, JSON and a plot on disk."""

import json
import os
import platform

from measure import rendering_threads
from paraview.simple import GetParaViewSourceVersion
from plot import plot, plot_volumes
from targets import OF_STORES, OF_VOLUMES, TARGETS


def header(window):
    """Ratios move fourfold with the version of Mesa, so it belongs to every number."""
    capabilities = dict(line.split(":", 1) for line in window.ReportCapabilities().splitlines()
                        if line.startswith("OpenGL") and ":" in line)
    return {"ParaView": GetParaViewSourceVersion().split()[-1],
            "vendor": capabilities["OpenGL vendor string"].strip(),
            "renderer": capabilities["OpenGL renderer string"].strip(),
            "OpenGL": capabilities["OpenGL version string"].strip(),
            "machine": platform.machine(), "processors": os.cpu_count(),
            "renderingThreads": rendering_threads(),
            "loadBefore": os.getloadavg()[0]}


def _number(value, width, digits=1):
    return f"{'-':>{width}}" if value is None else f"{value:>{width}.{digits}f}"


def _ratio(above, below):
    return above / max(below, 1e-9) if above is not None and below is not None else None


ALL_TARGETS = {**TARGETS, **OF_VOLUMES, **OF_STORES}


class Report:
    """Prints as it goes, since a full run takes long, and keeps everything for the file."""

    def __init__(self, about):
        self.results = {"about": about, "targets": [], "groups": [], "facts": []}
        for name, value in about.items():
            print(f"{name:>18}  {value}")

    def case(self, text):
        print(f"\n== {text} ==", flush=True)

    def group(self, kind, title, case, times):
        """Rows of one comparison; the first is ours, and the others are compared with it. `kind`:
        what is measured, the same at every size."""
        first = next(iter(times.values()))
        print(f"\n{title:<54}{'ms, median':>11}{'min..max':>18}{'rounds':>7}{'CPU':>9}{'quiet':>9}"
              f"{'/ first':>9}{'quiet':>8}")
        rows = {}
        for name, time in times.items():
            row = time.summary()
            row["ratio"] = _ratio(row["median"], first.median())
            row["quietRatio"] = _ratio(row["quiet"], first.quiet())
            rows[name] = row
            spread = f"{row['min']:.1f}..{row['max']:.1f}"
            print(f"  {name:<52}{row['median']:>11.1f}{spread:>18}{row['rounds']:>7}"
                  f"{_number(row['cpu'], 9)}{_number(row['quiet'], 9)}"
                  f"{_number(row['ratio'], 9, 2)}{_number(row['quietRatio'], 8, 2)}", flush=True)
        self.results["groups"].append({"kind": kind, "title": title, **case, "rows": rows})
        return rows

    def fact(self, text, **values):
        print(f"  {text}", flush=True)
        self.results["facts"].append({"text": text, **values})

    def target(self, key, value, quiet=None, window=None, volume=None):
        """What the table of targets shows for one of them; of the reference case or a volume."""
        target = ALL_TARGETS[key]
        quantity = (f"{volume}: " if volume else "") + target.quantity
        quantity += f", {window}x{window}" if window else ""
        self.results["targets"].append({
            "key": key, "volume": volume, "window": window, "quantity": quantity,
            "against": target.against, "unit": target.unit,
            "measured": value, "quiet": quiet, "least": target.least, "goal": target.goal,
            "verdict": target.verdict(value),
            "quietVerdict": None if quiet is None else target.verdict(quiet)})

    def targets(self):
        order = list(ALL_TARGETS)
        self.results["targets"].sort(key=lambda row: order.index(row["key"]))
        print(f"\n{'quantity':<70}{'at least':>10}{'goal':>8}{'measured':>12}  {'holds':<7}"
              f"{'quiet':>9}  {'holds':<7}against")
        for row in self.results["targets"]:
            print(f"{row['quantity']:<70}{row['least']:>10g}{row['goal']:>8g}"
                  f"{row['measured']:>9.2f}{row['unit']:<3}  {row['verdict']:<7}"
                  f"{_number(row['quiet'], 9, 2)}  {row['quietVerdict'] or '-':<7}{row['against']}",
                  flush=True)

    def worst(self):
        """Names, of each quantity, the row that is least above its floor."""
        print("\nworst rows")
        for key, target in ALL_TARGETS.items():
            rows = [row for row in self.results["targets"] if row["key"] == key]
            if rows:
                def margin(row, target=target):
                    value = row["measured"] if row["quiet"] is None else row["quiet"]
                    return target.margin(value)

                row = min(rows, key=margin)
                self.fact(f"{row['quantity']}: {margin(row):.2f} times the floor",
                          worst=key, volume=row["volume"], window=row["window"],
                          margin=margin(row))

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        file = os.path.join(folder, "benchmark.json")
        with open(file, "w", encoding="utf-8") as output:
            json.dump(self.results, output, indent=1)
        print(f"\n{file}")
        if self.results["targets"] and self.results["targets"][0]["volume"]:
            picture = os.path.join(folder, "floors.png")
            plot_volumes(self.results["targets"], picture)
            print(picture)
            return
        if not self.results["groups"]:
            return
        picture = os.path.join(folder, "time-against-size.png")
        print(picture if plot(self.results["groups"], picture)
              else "No plot: only one size was measured")
