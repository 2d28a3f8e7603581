# SPDX-License-Identifier: BSD-3-Clause
"""The steps of a case: what each lacks, and what it found."""

import collections
import os

from .casesources import doubt_about_files
from .files import figures_of, reason_of
from .fitting import Fit, is_kind, rigid_of
from .grids import sheet_left_out
from .lineage import compared_by, differences, is_fitted, landmarks_fitted_by
from .registering import refined_by
from .roles import ROLES

STEPS = ("Look", "Measure", "Fit", "By hand", "Refine", "Judge", "Export")

Step = collections.namedtuple("Step", "name state lacks found")
Step.__doc__ = """A step of a case.

- `name`: Look, Measure, Fit, By hand, Refine, Judge or Export
- `state`: `"done"`, `"ready"`, or `"lacks"` if something is missing
- `lacks`: what is missing, or an empty text
- `found`: what it found, in a line with units, and why that may be wrong, also of a result that
  is left while something is missing; or an empty text
"""

#: Numbers of a stroke; the last one says whether it is on.
_NUMBERS_PER_STROKE = 14

#: Of landmarks that say nothing about the accuracy of a refinement.
_USED_BEFORE = ("A fit before the refinement used the landmarks, so no accuracy follows from them: "
                "judge by others")

#: The least Jacobian determinant that the fold guard allows.
SMALLEST_DETERMINANT = 0.1

_TRUST = {"good": "Its checks found no fault.", "doubtful": "The result is doubtful.",
          "failed": "The result failed its checks.", "unchecked": "The result was not checked."}


def _joined(line, sentences):
    """A line with those sentences that it does not have yet."""
    new = [sentence for sentence in sentences if sentence.rstrip(".") not in line]
    parts = [part for part in (line, *new) if part]
    return ". ".join([*(part.rstrip(".") for part in parts[:-1]), *parts[-1:]])


def strokes_of(bent):
    """How many strokes of a deformation are on, and how many are switched off."""
    switches = list(bent.Strokes)[_NUMBERS_PER_STROKE - 1::_NUMBERS_PER_STROKE]
    on = sum(switch != 0.0 for switch in switches)
    return on, len(switches) - on


def _cost(value):
    return "not known" if value is None else f"{value:.3f}"


class Steps:
    """The steps of a `Case`, which derives from this."""

    @property
    def steps(self):
        """The steps of the case, a list of `Step`: what each lacks, and what it found."""
        found, doubts = [], self.doubts()
        for name in STEPS:
            lacks, line = getattr(self, "_step_" + name.lower().replace(" ", "_"))()
            state = "lacks" if lacks else "done" if line else "ready"
            why = [sentence for step, sentence in doubts
                   if step == name and sentence != f"No {lacks}"]
            found.append(Step(name, state, lacks, _joined(line, why)))
        return found

    def lacks_bent(self):
        """What is missing if there is no bent volume; an empty text if there is one."""
        if self.bent is not None:
            return ""
        return "a volume" if self.volume is None else "its bent volume: choose the volume again"

    def _step_look(self):
        volume = self.volume
        if self.lacks_bent():
            return self.lacks_bent(), ""
        volume.UpdatePipeline()  # after a state was loaded it has no extent yet
        information = volume.GetDataInformation()
        low_x, high_x, low_y, high_y, low_z, high_z = information.GetExtent()
        sides = high_x - low_x + 1, high_y - low_y + 1, high_z - low_z + 1
        bounds = information.GetBounds()
        spans = [(bounds[2 * i + 1] - bounds[2 * i]) for i in range(3)]
        return "", (" x ".join(str(side) for side in sides) + " voxels, "
                    + " x ".join(f"{span:.0f}" for span in spans) + " mm")

    def _step_measure(self):
        if self.lacks_bent():
            return self.lacks_bent(), ""
        lines, reasons = [], []
        for measure, name, reason in self.measures():
            reasons.append(reason)
            if not reason:
                points = (self.traces_now() if measure == self.trace_distance else
                          self.electrodes)
                total = points.GetDataInformation().GetNumberOfPoints()
                mean = round(measure.Mean, 2) + 0.0  # never -0.00
                lines.append(f"{measure.Count} of {total} {name.lower()} count, {measure.RMS:.2f} "
                             f"mm from the cortex (RMS), {mean:+.2f} mm in the mean")
        errors = self.landmark_errors()
        if errors is not None:
            lines.append(f"{len(errors.errors)} landmarks, {errors.mean:.2f} mm in the mean, "
                         f"{errors.largest:.2f} mm at most")
        if lines or any(reasons):  # the doubts say why one failed
            return "", "; ".join(lines)
        if self.lacks_traced():
            return self.lacks_traced(), ""
        if self.traces is None and self.electrodes is None:
            return "traces, electrodes, or landmarks with both positions", ""
        return "a brain, or a surface_level", ""

    def measures(self):
        """The Trace Distances of the case, updated: triples of the filter, what its points are, and
        why it measured nothing, a sentence, or an empty text."""
        for measure, name in ((self.trace_distance, "Traced points"),
                              (self.contact_distance, self.name_of_contacts())):
            if measure is not None:
                yield measure, name, reason_of(figures_of(measure))

    def name_of_contacts(self):
        """What the contacts are whose distance is measured. Before a fit no one asked which of them
        belong to depth shafts, which lie below the cortex."""
        return "Contacts" if self.part("at_rest") else "Contacts of grids and shafts alike"

    def _is_reference_moved(self):
        moved = self.comparison
        return moved is not None and any([*moved.ReferenceTranslation, *moved.ReferenceRotation])

    def _cavity_doubt(self):
        """A sentence if points are left out by a cavity whose reference was moved; else empty."""
        if self.cavity is None or not self._is_reference_moved():
            return ""
        return ("The reference was moved, and its cavity with it, but points are left out by the "
                "cavity as its file has it: align first and save the cavity where it belongs, or "
                "leave the cavity out")

    def landmark_errors(self):
        """Errors of the landmarks now, mm; None without pairs or if none match.

        The rigid motion of a fit to landmarks alone counts as part of the deformation.
        """
        from .judging import TargetErrors, tre
        from .points import read_from

        rest, measured = self.landmarks or (None, None)
        if not (rest and measured):
            return None
        rest, measured = read_from(rest), read_from(measured)
        try:
            found = tre(self.bent, rest, measured)
            rigid = rigid_of(self.bent.Lattice)
            if rigid is None:
                return found
            rotation, shift = rigid[:3, :3], rigid[:3, 3]
            moved = measured._replace(positions=(measured.positions - shift) @ rotation)
            within = tre(self.bent, rest, moved)  # the errors are as long in this frame
            return TargetErrors(within.errors, found.before, found.names, found.unpaired)
        except ValueError:
            return None

    def _step_fit(self):
        points = self.traced is not None or self.electrodes is not None
        pair = all(self.landmarks or (None,)) and not self.landmarks_judge
        if self.lacks_bent():
            return self.lacks_bent(), ""
        if not (points or pair):
            return self.lacks_traced() or "traces, electrodes, or landmarks with both positions", ""
        if points and not self.cortex():
            return "a brain, or a surface_level", ""
        fit = self.fit_source()
        if fit is None:
            return "", ""
        figures_of(fit)
        return "", reason_of(fit) or self._words_of_fit(Fit(fit))

    def _words_of_fit(self, fit):
        """The line of a fit. Contacts of grids have no leave-one-out error of the fit, for they
        made their own positions at rest; nor have landmarks that its base was fitted to."""
        if not self.fits_contacts():
            return fit.line("landmarks", None if self.landmarks_fitted_before() else fit.left_out())
        error = sheet_left_out(self.part("at_rest"))
        return fit.line("contacts of grids", None if error is None else
                        f"leave-one-out error of the sheet {error:.2f} mm (mean)")

    def fits_contacts(self):
        """Whether the fit takes contacts of grids to the tissue under them, and no landmarks."""
        fit, grids = self.fit_source(), self.part("at_rest")
        return fit is not None and grids is not None and fit.RestLandmarks == grids

    def landmarks_fitted_before(self):
        """Whether a fit before a refinement used the landmarks, so that nothing judges by them."""
        rest, bent = self.part("landmarks"), self.bent
        if rest is None or bent is None:
            return False
        fit = self.fit_source()
        return is_fitted(rest, landmarks_fitted_by(fit.Base if fit else bent.Lattice))

    def _step_by_hand(self):
        if self.lacks_bent():
            return self.lacks_bent(), ""
        bent = figures_of(self.bent)
        on, off = strokes_of(bent)
        if not on:
            return "", f"no stroke counts, {off} are switched off" if off else ""
        return "", (f"{on} strokes" + (f", and {off} that are switched off" if off else "")
                    + f", largest displacement {bent.MaximumDisplacement:.1f} mm, "
                    f"smallest Jacobian determinant {bent.MinimumJacobian:.2f}")

    def _step_refine(self):
        if self.lacks_bent() or self.reference is None:
            return self.lacks_bent() or "a reference", ""
        if not is_kind(self.bent.Lattice, "RefinedLattice"):
            return "", ""
        bent = figures_of(self.bent)
        found = (f"largest displacement {bent.MaximumDisplacement:.1f} mm, smallest Jacobian "
                 f"determinant {bent.MinimumJacobian:.2f}")
        by = refined_by(self.bent.Lattice)
        if by and not self._refined_otherwise(by):
            found += (f"; {'finished' if by['finished'] else 'stopped'} after {by['steps']} steps, "
                      f"cost {_cost(by['before'])} before, {_cost(by['cost'])} now (0: the volumes "
                      f"match). {_TRUST[by['trust']]}")
        return "", found

    def _refined_otherwise(self, by):
        """What the refinement was made of that is another now, or gone; an empty text if nothing.

        - `by`: a result of `refined_by`
        """
        if not by.get("of"):  # an older state file
            return ""
        if self.comparison is None:
            return "a reference that was taken away"
        return ", ".join(differences(by["of"], compared_by(self.bent, self.comparison)))

    def doubtful(self):
        """The names of the steps that may have found something wrong: what they found says why."""
        return {step for step, _ in self.doubts()}

    def doubts(self):
        """Why steps may have found something wrong: a list of pairs, a step's name and a sentence.

        A doubt about the reference belongs to Refine, also before it is done.
        """
        if self.lacks_bent():
            return []
        found = [*self._doubts_about_files(), *self._doubts_about_points(),
                 *self._doubts_about_fit(), *self._doubts_about_reference(),
                 *self._doubts_about_tissue(), self._doubt_about_landmarks(),
                 self._doubt_about_frames()]
        return [(step, sentence) for step, sentence in found if sentence]

    def _doubts_about_files(self):
        for role in (*ROLES, "measured"):
            source = self.part(role)
            doubt = doubt_about_files(source) if source is not None else ""
            yield "Look", doubt and f"{role.capitalize()}: {doubt}"

    def _doubts_about_points(self):
        if self.lacks_traced():
            yield "Measure", f"No {self.lacks_traced()}"
        strays = self.of_no_moment()
        if strays:
            yield "Measure", (f"{strays} traced points belong to no moment: they are of before the "
                              "first, or have no time stamp")
        for _, name, reason in self.measures():
            yield "Measure", reason and f"{name} are not measured: {reason}"
        if self.trace_distance or self.contact_distance:
            yield "Measure", self._cavity_doubt()

    def _doubts_about_fit(self):
        fit = self.fit_source()
        if fit is None:
            return
        if not self.cortex() and (self.traced is not None or self.electrodes is not None):
            yield "Fit", ("The cortex of the fit was taken away: what bends the volume is not what "
                          "a new fit would find. Choose a brain, or set surface_level")
        known = Fit(figures_of(fit))
        yield "Fit", reason_of(fit)
        yield "Fit", self._doubt_about_motion(known)
        if known.warning or known.share < 1.0:
            yield "Fit", known.warning or f"The fold guard applied {100 * known.share:.3g} % of it"
        grids = self.part("at_rest")
        if grids is not None:
            yield "Fit", figures_of(grids).GetPropertyValue("Warning")
        if self.traced is not None or self.electrodes is not None:
            yield "Fit", self._cavity_doubt()

    def _doubt_about_motion(self, fit):
        """A sentence if a fit has a rigid motion that moves the volume; else empty."""
        import numpy

        if rigid_of(fit.filter) is None:
            return ""
        bounds = numpy.reshape(self.bent.GetDataInformation().GetBounds(), (3, 2))
        middle = bounds.mean(axis=1)
        moved = fit.rigid[:3, :3] @ middle + fit.rigid[:3, 3] - middle
        return (f"The fit also found a rigid motion: {numpy.linalg.norm(moved):.1f} mm at the "
                f"middle of the volume and {fit.degrees:.1f} degrees. Errors of landmarks count "
                "it, but it is not in the deformation, so pictures and exported files lack it. "
                "Align the measured landmarks with the volume first, or move what is exported by "
                "it")

    def _doubt_about_frames(self):
        """Landmarks that were measured in a reference stay where they are when that is moved."""
        is_doubtful = self._is_reference_moved() and all(self.landmarks or (None,))
        return "Judge", is_doubtful and (
            "The reference was moved, the measured landmarks were not: if they were measured in "
            "it, their errors are wrong. Move them by the matrix of the alignment, or save the "
            "reference where it belongs and measure them there")

    def _doubt_about_landmarks(self):
        """Landmarks that the deformation did not use may be no nearer than without it."""
        if not all(self.landmarks or (None,)):
            return "Judge", ""
        if self.landmarks_fitted_before():
            return "Judge", _USED_BEFORE
        errors, fit = self.landmark_errors(), self.fit_source()
        if errors is None:
            return "Judge", ""
        before = float(errors.before.mean())
        if self.fits_landmarks():
            left_out = Fit(fit).left_out_of_used
            return "Fit", (f"Landmarks that are left out are no nearer than without the fit: "
                           f"{left_out.mean():.2f} mm in the mean, {before:.2f} mm without it. "
                           "Between landmarks the fit may do harm"
                           if len(left_out) and left_out.mean() >= before else "")
        return "Judge", (f"The landmarks are farther off than without the deformation: "
                         f"{errors.mean:.2f} mm in the mean, {before:.2f} mm without it"
                         if errors.mean > before + 1e-6 else "")

    def _doubts_about_reference(self):
        if self.comparison is not None:
            yield "Refine", figures_of(self.comparison).GetPropertyValue("Warning")
        by = refined_by(self.bent.Lattice)
        other = self._refined_otherwise(by)
        if other:
            yield "Refine", (f"The refinement was made with {other}: its checks say nothing of "
                             "what is there now. Refine again")
        elif by.get("warning") or by.get("trust") in ("doubtful", "failed"):
            yield "Refine", by.get("warning") or _TRUST[by["trust"]]

    def _doubts_about_tissue(self):
        """A fold belongs to the step that changed the deformation last."""
        bent = figures_of(self.bent)
        step = ("By hand" if strokes_of(bent)[0] else
                "Refine" if is_kind(bent.Lattice, "RefinedLattice") else
                "Fit" if self.fit_source() is not None else "Look")
        if bent.MinimumJacobian < SMALLEST_DETERMINANT:
            yield step, ("Tissue is compressed to less than a tenth, or folds: the smallest "
                         f"Jacobian determinant is {bent.MinimumJacobian:.2f}")

    def _step_judge(self):
        if not all(self.landmarks or (None,)) or self.lacks_bent():
            return self.lacks_bent() or "landmarks with both positions", ""
        return "", "" if self.judged is None else self.judged

    def _step_export(self):
        return self.lacks_bent(), (
            f"{len(self.exported)} files: " + ", ".join(
                os.path.basename(file) for file in self.exported) if self.exported else "")

    def judge(self):
        """Judge the deformation by the landmarks, and keep the line as what Judge found.

        Landmarks that the fit used are judged by leaving them out, others by their errors now. From
        those that a fit before a refinement used, no accuracy follows.
        """
        fit, errors = self.fit_source(), self.landmark_errors()
        if self.landmarks_fitted_before():
            self.judged = _USED_BEFORE + ("" if errors is None else (
                f". They are off by {errors.mean:.2f} mm in the mean, {errors.largest:.2f} mm at "
                f"most, of {len(errors.errors)} landmarks"))
        elif self.fits_landmarks():
            known = Fit(fit).left_out_of_used
            self.judged = (f"leave-one-out error {known.mean():.2f} mm in the mean, "
                           f"{known.max():.2f} mm at most, of {len(known)} landmarks"
                           if len(known) else "no landmark is constrained by the others")
        else:
            if errors is None:
                raise ValueError("no landmark has a partner")
            self.judged = repr(errors).removeprefix("TargetErrors: ")
        return self.judged

    def run(self, step, **settings):
        """Do a step.

        - `step`: `"Look"`, `"Measure"`, `"Fit"`, `"Refine"`, `"Judge"` or `"Export"`. By hand is
          not one that a script does: set `case.bent.Strokes`.
        - `settings`: of `show` (Look), `brainshift.refine` (Refine), and `folder` (Export)

        Returns the `Step` afterwards.

        Raises `ValueError` if the step lacks something, or with the reason if it fails. The case
        then stays as it was.
        """
        actions = {"Look": self.show, "Measure": lambda: None, "Fit": self.fit,
                   "Refine": self.refine, "Judge": self.judge, "Export": self.export}
        if step not in actions:
            raise ValueError(f"step is {step!r}; it must be one of {', '.join(actions)}")
        present = self.steps[STEPS.index(step)]
        if present.state == "lacks":
            raise ValueError(f"{step} lacks {present.lacks}")
        actions[step](**settings)
        return self.steps[STEPS.index(step)]
