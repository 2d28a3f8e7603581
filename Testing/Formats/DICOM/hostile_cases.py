# SPDX-License-Identifier: BSD-3-Clause
"""Cases of DICOM files that are made to harm (hostile_files.py).

Each case takes one pattern, with other sizes, and in half of the cases spoils one more thing. A
case is good if BrainShift refuses the file with a sentence. A pattern that a reader may pass over,
such as a drawing that is not shown, must leave the numbers as they are.
"""

import os
import shutil

from dicom_cases import spoiled
from hostile_files import PATTERNS, REFUSED, deflate_bomb, outcome, same_numbers


class Cases:
    """Reads one hostile file for each case."""

    def __init__(self, folder):
        self.folder = os.path.join(folder, "hostile")

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        path = os.path.join(self.folder, "image.dcm")
        # The bomb takes a second to make and to refuse.
        pattern = random.choice(PATTERNS)
        pattern = random.choice(PATTERNS) if pattern is deflate_bomb else pattern
        data = pattern(random, path)
        isWhole = random.random() < 0.5
        data = data if isWhole else spoiled(random, data)
        with open(path, "wb") as file:
            file.write(data)
        numbers, said = outcome(path)
        if numbers is None:
            named = f"{pattern.__name__}: no image and no error"
            return "refused" if "error" in said.lower() else f"misplaced: {named}"
        if not isWhole:
            return "told" if said else "taken"
        if pattern in REFUSED:
            return f"misplaced: {pattern.__name__} was read"
        return "same" if same_numbers(path, numbers) else f"misplaced: {pattern.__name__}"
