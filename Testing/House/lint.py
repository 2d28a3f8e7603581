# SPDX-License-Identifier: BSD-3-Clause
"""What ./brainshift lint runs over the tracked files: python3 lint.py CHECKOUT BUILD [CHECK…]

    house     the checks of check_house.py, and that each of them can fail
    format    clang-format would write no C++ file in another way
    spelling  codespell knows no better word
    tidy      clang-tidy finds nothing; reads headers that the build wrote

Without a CHECK, all of them, the quick ones first. It ends with the names of those that failed.
"""

import pathlib
import subprocess
import sys
import time

from written import SKIPPED

HERE = pathlib.Path(__file__).resolve().parent


def scripts(checkout, build):
    """For each check the scripts that it runs, with their arguments."""
    return {
        "house": [["check_house.py", checkout], ["seen_to_fail.py"]],
        "format": [["written.py", checkout, "format", "clang-format"]],
        "spelling": [["written.py", checkout, "spelling", "codespell"]],
        "tidy": [["tidy.py", checkout, build, "clang-tidy"]],
    }


def passes(name, commands):
    """Whether all scripts of a check pass. One that is skipped says why, and passes."""
    start = time.monotonic()
    python = [sys.executable, "-B"]
    ended = [subprocess.run([*python, HERE / script, *arguments], check=False).returncode
             for script, *arguments in commands]
    result = "failed" if any(code not in (0, SKIPPED) for code in ended) else (
        "skipped" if SKIPPED in ended else "passed")
    print(f"lint: {name} {result} in {time.monotonic() - start:.0f} s", flush=True)
    return result != "failed"


def main():
    checks = scripts(*sys.argv[1:3])
    wanted = sys.argv[3:] or list(checks)
    unknown = sorted(set(wanted) - set(checks))
    if unknown:
        sys.exit(f"lint: there is no check {', '.join(unknown)}; there are {', '.join(checks)}")
    failed = [name for name in wanted if not passes(name, checks[name])]
    if failed:
        sys.exit(f"lint: failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
