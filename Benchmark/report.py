# SPDX-License-Identifier: BSD-3-Clause
"""What was measured: a table on screen, JSON and a plot on disk."""

import json
import os
import platform

from measure import rendering_threads
from paraview.simple import GetParaViewSourceVersion


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


class Report:
    """Prints as it goes, since a full run takes long, and keeps everything for the file."""

    def __init__(self, about):
        self.results = {"about": about, "groups": [], "facts": []}
        for name, value in about.items():
            print(f"{name:>18}  {value}")

    def case(self, text):
        print(f"\n== {text} ==", flush=True)

    def group(self, title, case, times):
        """Rows of one comparison; the first is ours, and the others are compared with it."""
        first = next(iter(times.values()))
        print(f"\n{title:<54}{'ms, median':>11}{'min..max':>18}{'CPU':>9}{'quiet':>9}{'/ first':>9}"
              f"{'quiet':>8}")
        rows = {}
        for name, time in times.items():
            row = time.summary()
            row["ratio"] = row["median"] / first.median()
            row["quietRatio"] = row["quiet"] / max(first.quiet(), 1e-9)
            rows[name] = row
            spread = f"{row['min']:.1f}..{row['max']:.1f}"
            print(f"  {name:<52}{row['median']:>11.1f}{spread:>18}"
                  f"{row['cpu']:>9.1f}{row['quiet']:>9.1f}"
                  f"{row['ratio']:>8.2f}x{row['quietRatio']:>7.2f}x", flush=True)
        self.results["groups"].append({"title": title, **case, "rows": rows})

    def fact(self, text, **values):
        print(f"  {text}", flush=True)
        self.results["facts"].append({"text": text, **values})

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        file = os.path.join(folder, "benchmark.json")
        with open(file, "w", encoding="utf-8") as output:
            json.dump(self.results, output, indent=1)
        print(f"\n{file}")
        self._plot(os.path.join(folder, "time-against-size.png"))

    def _plot(self, file):
        """Median against voxels, one line for each row that was measured at several sizes."""
        lines = {}
        for group in self.results["groups"]:
            if group["lattice"] == 19 and group["window"] == self.results["groups"][0]["window"]:
                for name, row in group["rows"].items():
                    key = (group["title"], name)
                    lines.setdefault(key, []).append((group["voxels"], row["median"]))
        lines = {key: sorted(points) for key, points in lines.items() if len(points) > 1}
        if not lines:
            print("No plot: only one size was measured")
            return
        try:
            import matplotlib
            matplotlib.use("Agg")
            from matplotlib import pyplot
        except ImportError:
            print("No plot: this Python has no matplotlib (Debian: python3-matplotlib)")
            return
        titles = list(dict.fromkeys(title for title, _ in lines))
        figure, axes = pyplot.subplots(1, len(titles), figsize=(5 * len(titles), 5), squeeze=False)
        for axis, title in zip(axes[0], titles):
            for (of, name), points in lines.items():
                if of == title:
                    axis.loglog(*zip(*points), marker="o", label=name)
            axis.set(title=title, xlabel="voxels", ylabel="ms, median")
            axis.legend(fontsize=7)
        figure.tight_layout()
        figure.savefig(file, dpi=100)
        print(file)
