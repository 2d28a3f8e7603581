# SPDX-License-Identifier: BSD-3-Clause
"""Writes the report of a case: one page that a colleague reads without ParaView."""

import base64
import datetime
import os
from html import escape

from . import scenes
from .casesources import paths_of
from .drawing import png
from .figures import _strength_kept, _versions
from .files import figures_of
from .fitting import Fit, away_from_fit, rigid_of
from .grids import sheet_left_out
from .maps import rest_from_deformed
from .rolefiles import files_of, hash_of, is_dicom, is_store
from .roles import ROLES, ending
from .steps import strokes_of

NOTICE = "Research software, not for clinical use."

_UNKNOWN = "not known"

#: Sizes of pictures, pixels.
_WIDE, _SQUARE = (760, 600), (480, 480)

_STYLE = """
:root { color-scheme: light dark; --ink: #1d232b; --soft: #57606b; --line: #d5dae0;
  --ground: #ffffff; --card: #f5f7f9; --warn: #8a4b00; --warnground: #fff4e2; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e9ed; --soft: #a2abb5; --line: #3a424c;
  --ground: #14181d; --card: #1e242b; --warn: #ffc777; --warnground: #3a2a10; } }
@media print { :root { color-scheme: light; --ink: #000000; --soft: #444444; --line: #bbbbbb;
  --ground: #ffffff; --card: #ffffff; --warn: #6b3a00; --warnground: #ffffff; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 1.5rem; background: var(--ground);
  color: var(--ink); font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.6rem; border-bottom: 1px solid var(--line);
  padding-bottom: 0.25rem; break-after: avoid; }
p { margin: 0.4rem 0; }
.soft { color: var(--soft); }
.notice, .warning { border: 1px solid var(--warn); background: var(--warnground);
  color: var(--warn); border-radius: 6px; padding: 0.5rem 0.8rem; margin: 0.8rem 0; }
.notice { font-weight: 600; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr));
  gap: 0.8rem; margin: 1rem 0; }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: 6px;
  padding: 0.6rem 0.8rem; break-inside: avoid; }
.tile b { display: block; font-size: 1.4rem; font-variant-numeric: tabular-nums; }
table { width: 100%; border-collapse: collapse; font-size: 0.92rem; }
th, td { text-align: left; padding: 0.35rem 0.8rem 0.35rem 0; vertical-align: top;
  border-bottom: 1px solid var(--line); }
th { color: var(--soft); font-weight: 600; }
tr { break-inside: avoid; }
td.number { white-space: nowrap; font-variant-numeric: tabular-nums; }
td.hash { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 0.75rem;
  overflow-wrap: anywhere; }
.pictures { display: grid; gap: 0.8rem; }
.two { grid-template-columns: repeat(2, 1fr); } .three { grid-template-columns: repeat(3, 1fr); }
figure { margin: 0 0 0.9rem; break-inside: avoid; }
figure img { width: 100%; display: block; background: #000000; border-radius: 4px; }
figcaption { font-size: 0.85rem; color: var(--soft); margin-top: 0.25rem; }
.key { display: inline-block; width: 0.9em; height: 0.9em; border-radius: 2px;
  vertical-align: -0.08em; margin-right: 0.3em; }
@media (max-width: 40rem) { .two, .three { grid-template-columns: 1fr; } }
@page { size: A4; margin: 16mm 14mm; }
@media print { body { padding: 0; max-width: none; font-size: 10pt; } h2 { margin-top: 1.2rem; }
  .tile b { font-size: 1.15rem; }
  .tiles { grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); }
  th, td { padding-top: 0.25rem; padding-bottom: 0.25rem; }
  tbody tr:first-child { break-after: avoid; } tbody tr:last-child { break-before: avoid; }
  .two { width: 74%; } .three { width: 84%; } /* or pages end with large gaps */
  figure { margin-bottom: 0.4rem; } }
"""


# Numbers ------------------------------------------------------------------------------------------


def _number(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value != value:  # NaN
        return _UNKNOWN
    return f"{value:.2f}" if isinstance(value, float) else str(value)


def _with_unit(value, unit):
    text = _number(value)
    return text if text == _UNKNOWN else f"{text} {unit}".strip()


def _measured_rows(measure, name):
    """Rows of a Trace Distance without and with the deformation."""
    rows = []
    for label, key, meaning in (
            ("in the mean", "Mean", "Signed distance to the cortex, positive outside of it."),
            ("RMS", "RMS", "Root mean square distance to the cortex."),
            ("95th percentile", "Percentile95", "95 % of the points are nearer to the cortex.")):
        rows.append((f"{name}, {label}", key, "mm", meaning))
    return [(f"{name} that count", "Count", "",
             "Points outside of the cavity with a position.")] + rows


def _distances(case):
    """Rows of distances: figure, before, after, unit, meaning."""
    rows = []
    for measure, name, reason in case.measures():
        if reason:  # the warnings say it
            continue
        wanted = _measured_rows(measure, name)
        with _strength_kept(case.bent):
            case.bent.Strength = 0.0
            figures_of(measure)
            before = [getattr(measure, key) for _, key, _, _ in wanted]
        figures_of(measure)
        rows += [(label, old, getattr(measure, key), unit, meaning)
                 for (label, key, unit, meaning), old in zip(wanted, before)]
    errors = case.landmark_errors()
    if errors is not None:
        meaning = "Distance of landmarks from their measured positions."
        if rigid_of(case.bent.Lattice) is not None:
            meaning += (" With the deformation, after the rigid motion of the fit, which pictures "
                        "and exported files lack.")
        if case.landmarks_fitted_before():
            meaning += " A fit before the refinement used them, so no accuracy follows."
        elif case.fits_landmarks():
            meaning += " The fit used them, so this is smaller than elsewhere."
        rows += [("Landmarks, in the mean", float(errors.before.mean()), errors.mean, "mm",
                  meaning),
                 ("Landmarks, at most", float(errors.before.max()), errors.largest, "mm",
                  "The landmark that is farthest off.")]
    return rows


def left_out_mean(fit):
    """Mean leave-one-out error (mm) of the landmarks of a Fit; None without them or a Fit."""
    if fit is None or not fit.filter.RestLandmarks:
        return None
    known = fit.left_out_of_used
    return float(known.mean()) if len(known) else None


def _fit_rows(case):
    """Rows of the fit: figure, value, unit, meaning; and the fit or None."""
    import numpy

    source = case.fit_source()
    if source is None:
        return [], None
    fit = Fit(source)
    rows = []
    pairs = "contacts of grids" if case.fits_contacts() else "landmarks"
    for residuals, name in ((fit.landmark_residuals, pairs), (fit.pull_residuals, "pulls"),
                            (fit.trace_residuals, "points of the cortex")):
        known = residuals[numpy.isfinite(residuals)]
        if len(known):
            rows.append((f"Residual of {len(known)} {name}, RMS",
                         float(numpy.sqrt((known ** 2).mean())), "mm",
                         "What the fit leaves at the points that it used."))
    rows += _left_out_rows(case, fit)
    rows += [("Deviation in the slices' middle", _deviation_in_middle(case, fit), "mm",
              "Uncertainty of the tissue's position along an axis, one standard deviation; within "
              "2.8 times as much with 95 %. Strokes and Strength add the distance to the fit."),
             ("Share", fit.share, "", "Fraction of the fit that tissue allows without folding."),
             ("Calibration", fit.calibration, "",
              "Factor on uncertainties that the leave-one-out errors ask for."),
             ("Anchors", int(source.GetPropertyValue("AnchorCount")), "",
              "Points that hold the cortex away from the opening.")]
    return rows, fit


def _deviation_in_middle(case, fit):
    """Standard deviation (mm) of the tissue that is drawn in the middle of the slices. NaN if the
    fit says nothing of this deformation.

    A hand is no measurement: where it takes tissue elsewhere than the fit, the distance counts.
    """
    import numpy

    with scenes.evidence_on(case.bent) as is_known:
        if not is_known:
            return float("nan")
        rest = rest_from_deformed(case.bent, [list(scenes.focus_of(case))])
        away = away_from_fit(case.bent, fit, rest)
        return float(numpy.hypot(fit.deviation(rest), away / numpy.sqrt(3.0))[0])


def _left_out_rows(case, fit):
    """The row of the leave-one-out error, if one is known."""
    if not case.fits_contacts():
        left_out = None if case.landmarks_fitted_before() else left_out_mean(fit)
        return [] if left_out is None else [
            ("Leave-one-out error, mean", left_out, "mm",
             "Error at landmarks that the fit did not use, each in turn.")]
    error = sheet_left_out(case.part("at_rest"))  # which made the positions at rest of the fit
    return [] if error is None else [
        ("Leave-one-out error of the sheet, mean", error, "mm",
         "Distance of contacts from where all others of the grids predict them.")]


def _deformation_rows(case):
    bent = figures_of(case.bent)
    on, off = strokes_of(bent)
    return [("Largest displacement", float(bent.MaximumDisplacement), "mm",
             "Of the points that carry the deformation, in the whole volume."),
            ("Smallest Jacobian determinant", float(bent.MinimumJacobian), "",
             "Local change of volume: 1 keeps it, 0 or less is a fold."),
            ("Strokes by hand", on, "", "Edits on top of the fit."),
            *([("Strokes that are switched off", off, "", "They do not count.")] if off else []),
            ("Shortened strokes", int(bent.ShortenedStrokes), "",
             "Strokes that the fold guard reduced.")]


def _resection_rows(found):
    """Rows of the resection: figure, value, unit, meaning."""
    def interval(ends):
        return f"{ends[0]:.2f} to {ends[1]:.2f}" if ends else "not known"
    percent = f"{100 * found.level:.0f} %"
    return [("Tumour before", found.before, "ml", "Volume of the labels at rest."),
            ("Removed", found.removed, "ml", "Tumour that came to lie in the cavity."),
            (f"Removed, {percent} interval", interval(found.removed_interval), "ml",
             "Volumes that the measurements allow."),
            ("Left", found.left, "ml", "The rest, measured at rest; with an interval it is "
             "corrected for the bias of a deformation that is a little off."),
            (f"Left, {percent} interval", interval(found.left_interval), "ml",
             f"Volumes under {found.fields} deformations that the fit allows; {found.folded} that "
             "fold were left out. Errors of the outlines are not in it."),
            ("Left by the deformation as it is", found.left_by_fit, "ml",
             "What the pictures and the labels show, without the correction."),
            ("The same in the bent brain", found.left_after, "ml",
             "There the tissue may be squeezed or stretched."),
            ("Left of before", 100.0 * found.left / found.before, "%", "")]


def _warnings(case):
    found = [sentence if sentence.endswith(".") else f"{sentence}."
             for _, sentence in case.doubts()]
    if case.resection is not None and case.resection.reason:
        found.append(f"Resection: {case.resection.reason}.")
    return list(dict.fromkeys(found))  # a moved cavity concerns two steps


def _settings(case):
    """Rows of name and value."""
    bent = case.bent
    ball = case.opening_ball()
    opening = ("a mask" if case.part("opening") is not None else
               f"centre {', '.join(f'{x:.1f}' for x in ball[0])} mm, radius {ball[1]:.1f} mm"
               if ball else "around the measured points")
    cortex = ("the brain" if case.brain is not None else
              "none" if case.surface_level is None else f"scalars from {case.surface_level:g} on")
    moment = (f"{case.moment or 'the first'}, at {case.minutes:g} min" if len(case.moments) > 1
              else "the only one")
    rows = [("Moment of the surgery", moment),
            ("Lattice", " x ".join(str(side) for side in bent.LatticeDimensions)
             + " control points"),
            ("Kernel", str(bent.GetProperty("Kernel").GetData())), ("Samples", bent.Samples),
            ("Strength", f"{bent.Strength:g}"), ("Guard folding", bool(bent.GuardFolding)),
            ("Held outside of the brain", bent.Mask is not None),
            ("Mask growth", "as the feather needs" if bent.MaskGrowth < 0 else
             f"{bent.MaskGrowth:g} mm"),
            ("Feather", f"{bent.Feather:g} mm"), ("Cortex", cortex), ("Opening", opening),
            ("Landmarks judge only", bool(case.landmarks_judge))]
    for role in ("brain", "tumour", "cavity"):
        labels = getattr(case, f"{role}_labels")
        rows.append((f"Labels of the {role}", ", ".join(map(str, labels)) or "all above 0"))
    return rows


# Files --------------------------------------------------------------------------------------------


def _kind(path, files):
    """What lies at a path, without names."""
    end, count = ending(path), f"{len(files)} file{'s' if len(files) != 1 else ''}"
    if is_store(path):
        return "OME-Zarr store"
    if not end and any(map(is_dicom, files)):
        return f"DICOM series of {count}"
    return ", ".join(filter(None, (end, count))) if files != [path] else end or "file"


def _about_files(path, listed):
    """What lies at a path, its size and its hash."""
    kind = ending(path) or "file"
    if not os.path.exists(path):
        return kind, "", "the file is not on this machine"
    try:
        files = files_of(path, listed)
        if not files:
            return "0 files", "", "the folder has no files"
        return _kind(path, files), _size(sum(map(os.path.getsize, files))), hash_of(path, listed)
    except OSError as error:
        return kind, "", f"it cannot be read: {error.strerror}"


def _size(count):
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.1f} kB"


def _files(case, names):
    """Rows of role, name, bytes and hash. Without `names` a file is called by its kind only."""
    rows = []
    for role in (*ROLES, "measured"):
        source = case.part(role)
        paths = paths_of(source) if source is not None else {}
        for path, listed in paths.items():
            if role == "measured" and path in paths_of(case.part("landmarks")):
                continue  # one file with both
            kind, size, found = _about_files(path, listed)
            name = os.path.basename(os.path.normpath(path))
            if names and ending(path) != kind != "file":
                name += f" ({kind})"
            rows.append(("landmarks, measured" if role == "measured" else role,
                         name if names else kind, size, found))
    return rows


def _patient(case):
    """Name and number of the patient of a DICOM volume, or an empty text."""
    from .files import dicom_patient

    try:
        texts = dicom_patient(case.volume)
    except (TypeError, ValueError):
        return ""
    return ", ".join(text for text in texts.values() if text)


# The page -----------------------------------------------------------------------------------------


def _table(header, rows, classes=()):
    lines = ["<table><thead><tr>", *(f"<th>{escape(name)}</th>" for name in header),
             "</tr></thead><tbody>"]
    for row in rows:
        cells = (f'<td class="{classes[i] if i < len(classes) else ""}">{escape(_number(cell))}'
                 "</td>" for i, cell in enumerate(row))
        lines.append("<tr>" + "".join(cells) + "</tr>")
    return "".join([*lines, "</tbody></table>"])


def _values(rows):
    """A table of figures with unit and meaning."""
    shown = [(name, _with_unit(value, unit), meaning)
             for name, value, unit, meaning in rows]
    return _table(("Figure", "Value", "Meaning"), shown, ("", "number", "soft"))


def _image(pixels, caption, key=""):
    data = base64.b64encode(png(pixels, {})).decode()
    return (f'<figure><img alt="{escape(caption)}" src="data:image/png;base64,{data}">'
            f"<figcaption>{key}{escape(caption)}</figcaption></figure>")


def _row(kind, images):
    return f'<div class="pictures {kind}">' + "".join(images) + "</div>"


def _tiles(case, fit, distances):
    found = []
    resection = case.resection
    if resection is not None:
        ends = resection.left_interval
        found.append(("Tumour left", f"{resection.left:.1f} ml",
                      f"of {resection.before:.1f} ml" + (
                          f"; {100 * resection.level:.0f} % interval {ends[0]:.1f} to "
                          f"{ends[1]:.1f} ml" if ends else "; no interval")))
    used_before = case.landmarks_fitted_before()
    is_left_out = case.fits_landmarks() and not used_before
    left_out = left_out_mean(fit) if is_left_out else None
    bent = figures_of(case.bent)
    for name, before, after, unit, _ in distances:
        if name == "Landmarks, in the mean" and left_out is not None:
            found.append(("Landmarks left out, in the mean", f"{left_out:.2f} {unit}",
                          f"{before:.2f} {unit} without the deformation"))
        elif name == "Landmarks, in the mean" and used_before:
            continue  # no accuracy follows from them
        elif name.endswith(", RMS") or name == "Landmarks, in the mean":
            found.append((name, _with_unit(after, unit),
                          f"{_with_unit(before, unit)} without the deformation"))
    found.append(("Largest displacement", f"{float(bent.MaximumDisplacement):.1f} mm",
                  f"smallest Jacobian determinant {float(bent.MinimumJacobian):.2f}"))
    return '<div class="tiles">' + "".join(
        f'<div class="tile"><span class="soft">{escape(title)}</span><b>{escape(value)}</b>'
        f'<span class="soft">{escape(note)}</span></div>'
        for title, value, note in found) + "</div>"


def _key(color, text):
    return (f'<span class="key" style="background: rgb{color}"></span>{escape(text)}&ensp;')


def _pictures(case, fit):
    """The sections with pictures: title and HTML."""
    position = scenes.focus_of(case)
    before, after = scenes.before_and_after(case, _WIDE)
    sections = [("Before and after", _row("two", [
        _image(before, "As loaded"), _image(after, "Bent, from the same side")]))]
    with_letters = "seen from the feet, from the front and from the left"
    for title, strength in (("Slices as loaded", 0.0), ("Slices, bent", None)):
        shown = scenes.slices(case, position, _SQUARE, strength=strength)
        sections.append((title, _row("three", [
            _image(pixels, f"{plane.capitalize()}") for plane, pixels in shown.items()])
            + f'<p class="soft">Through {", ".join(f"{x:.1f}" for x in position)} mm; '
              f"{with_letters}.</p>"))
    if case.resection is not None:
        shown = scenes.tumour_after(case, position, _SQUARE)
        key = "<p>" + _key(scenes.ORANGE, "tumour left") + _key(
            scenes.BLUE, "removed: tumour in the cavity") + "</p>"
        sections.append(("Tumour left", _row("three", [
            _image(pixels, plane.capitalize()) for plane, pixels in shown.items()]) + key))
    traced = scenes.traces(case, _WIDE)
    if traced is not None:
        sections.append(("Measured points", _row("two", [
            _image(pixels, f"Distance of points to the cortex {when}: green above it, purple below")
            for pixels, when in zip(traced, ("as loaded", "as bent"))])))
    if fit is not None:
        sections += _evidence(case, position)
    return sections


def _evidence(case, position):
    """The section with the uncertainty of the fit, if the bent volume has one."""
    with scenes.evidence_on(case.bent) as is_known:
        if not is_known:
            return []
        shown = scenes.slices(case, position, _SQUARE, evidence=True)
    return [("Evidence", _row("three", [
        _image(pixels, plane.capitalize()) for plane, pixels in shown.items()])
        + '<p class="soft">How far the position of the tissue is known, one standard deviation '
          "along an axis, in the colours of the legend in the pictures.</p>")]


def _sections(case, names):
    distances = _distances(case)
    fit_rows, fit = _fit_rows(case)
    yield "", _tiles(case, fit, distances) + "".join(
        f'<p class="warning">{escape(text)}</p>' for text in _warnings(case))
    yield "Steps", _table(("Step", "State", "Found or missing"), [
        (step.name, step.state, f"{len(case.exported)} files"
         if step.name == "Export" and case.exported and not names
         else ". ".join(filter(None, (step.lacks, step.found))))
        for step in case.steps])
    yield from _pictures(case, fit)
    if case.resection is not None:
        yield "Resection", _values(_resection_rows(case.resection))
    if distances:
        rows = [(name, _with_unit(old, unit), _with_unit(new, unit), meaning)
                for name, old, new, unit, meaning in distances]
        yield "Measurements", _table(("Figure", "As loaded", "Bent", "Meaning"), rows,
                                     ("", "number", "number", "soft"))
    if fit_rows:
        yield "Fit", _values(fit_rows)
    yield "Deformation", _values(_deformation_rows(case))
    yield "Settings", _table(("Setting", "Value"), _settings(case))
    yield "Files", _table(("Role", "File", "Size", "SHA-256"), _files(case, names),
                          ("", "", "number", "hash")) + (
        "" if names else '<p class="soft">Names of files are left out, for they may name the '
                         "patient.</p>")
    yield "Versions", _table(("Program", "Version"), [row[:2] for row in _versions()])


def report(case, file, title="Case report", names=False):
    """Write the report of a case: one page of HTML with its pictures inside.

    A browser shows it without ParaView or a network, light or dark as the reader likes, and prints
    it on A4. It has pictures before and after, slices with letters, the measured points, the
    evidence and the tumour that is left, tables of figures with unit and meaning, warnings,
    settings, versions, and size and SHA-256 of each file. What the case does not have is left out.

    - `case`: a `Case` with a volume. Call `case.resect` before for its volumes.
    - `file`: path of the page to write, usually `.html`. An old one is replaced.
    - `title`: of the page. Default: Case report. Keep names of patients out of it.
    - `names`: True shows the names of files, and the patient of a DICOM volume. The default,
      `False`, shows neither.

    Returns the path.

    Raises `ValueError` if the case has no volume, and `OSError` if the file is not written.
    """
    if case.bent is None:
        raise ValueError("the case has no volume; a report needs one")
    case.known_resection()
    with scenes.nothing_else_changes():
        sections = list(_sections(case, names))
    now = datetime.datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z")
    patient = _patient(case) if names else ""
    page = [
        "<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body>",
        f'<h1>{escape(title)}</h1><p class="soft">'
        + (f"{escape(patient)} · " if patient else "") + f"{escape(now)}</p>",
        f'<p class="notice">{NOTICE}</p>']
    for heading, content in sections:
        page.append("<section>" + (f"<h2>{escape(heading)}</h2>" if heading else "") + content
                    + "</section>")
    page.append(f'<p class="soft">{NOTICE}</p></body></html>\n')
    path = os.fspath(file)
    with open(path, "w", encoding="utf-8") as opened:
        opened.write("\n".join(page))
    return path
