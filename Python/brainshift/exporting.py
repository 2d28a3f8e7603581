# SPDX-License-Identifier: BSD-3-Clause
"""Writes what a case found to files, beside those of other cases."""

import itertools
import os

from .casesources import kept, stem

#: The names of the cases that wrote files in this process, by paths.
_writers = {}


class Exports:
    """The files of a `Case`, which derives from this."""

    @kept
    def export(self, folder):
        """Write the bent volume, the displacement field and, after `resect`, the tumour's labels.

        Files that another case wrote there in this session stay: the new names get a number.

        - `folder`: path of the folder. It is made if it is missing.

        Returns the paths of the files.
        """
        from paraview import simple

        from .files import save_field, save_volume
        from .views import world_axes

        os.makedirs(folder, exist_ok=True)
        files = self._names_of_files(os.path.join(folder, stem(self.volume) + self.moment_ending()))
        baked = simple.BakeDeformation(Input=self.bent, Interpolation="Cubic")
        try:
            save_volume(baked, files["bent"])
        finally:
            simple.Delete(baked)
        save_field(self.bent, files["field"], world=world_axes(self.volume) or "RAS")
        written = [files["bent"], files["field"]]
        if self.known_resection() is not None:
            for frame in ("rest", "deformed"):
                written.append(files[f"tumour_{frame}"])
                self.resection.save(written[-1], frame, world_axes(self.volume))
        _writers.update((os.path.realpath(file), self.name) for file in written)
        self.exported = written
        return written

    def _names_of_files(self, name):
        """The paths that begin with a name, or it and a number, of which no other case wrote one:
        a dict by what they hold."""
        for beginning in itertools.chain([name], (f"{name}_{i}" for i in itertools.count(2))):
            files = {what: f"{beginning}_{what}.nii.gz"
                     for what in ("bent", "field", "tumour_rest", "tumour_deformed")}
            paths = [os.path.realpath(file) for file in files.values()]
            if not any(_writers.get(path, self.name) != self.name and os.path.exists(path)
                       for path in paths):
                return files
        raise AssertionError("there are always more numbers")
