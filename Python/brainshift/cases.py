# SPDX-License-Identifier: BSD-3-Clause
"""A case: files or sources by their roles, and the pipeline that they make."""

import json
import os
import uuid

from .arguments import positive, vector
from .casesources import (
    MARK, OPENED, RESULT, SETTING, all_values_of, digest_of, doubt_about_files, free_name,
    give_name, inputs_of, kept, marks, opened, require_kind, result_name, settings_at, sources,
    sources_with, stem, upstream)
from .exporting import Exports
from .files import reason_of
from .fitting import Fit, _shared, forget_former, is_kind, is_unused, own
from .grids import shapes_of
from .moments import SHARED, Moments
from .resecting import Resections
from .roles import FILE_ROLES, ROLES, ending, holds_both, landmark_columns, paired, proposed
from .steps import Steps
from .timing import TimedTraces

#: Parts of the pipeline that a case makes, beside the sources of its roles.
_OF_FIT = ("joined", "at_rest")
_OF_TRACES = ("timed", "cloud")
_MADE = ("resected", "trace_distance", "contact_distance", "comparison", *_OF_FIT, *_OF_TRACES,
         "bent")


class _Role:
    """A role as an attribute of a case."""

    def __init__(self, name):
        self.name = name

    def __get__(self, case, kind=None):
        return self if case is None else case._role(self.name)

    def __set__(self, case, value):
        case._set_role(self.name, value)


class _Setting:
    """A setting of a case, kept at its Free-Form Deformation."""

    def __init__(self, default, check):
        self.default, self.check = default, check

    def __set_name__(self, owner, name):
        self.name = name

    def __get__(self, case, kind=None):
        return self if case is None else case._setting(self.name, self.default)

    def __set__(self, case, value):
        value = self.check(self.name, value)
        for one in case.moments if self.name in SHARED else [case]:
            one._keep(self.name, value)
            one._wire()


class _Result:
    """A result that a case forgets as soon as what it was found from is another. State files keep
    texts, numbers, and lists and dictionaries of them."""

    def __init__(self, default, lasts=True):
        self.default, self.lasts = default, lasts

    def __set_name__(self, owner, name):
        self.name = name

    def __get__(self, case, kind=None):
        if case is None:
            return self
        now = case._state()
        state, value = case._results.get(self.name, (now if self.lasts else None, self.default))
        if state != now or not self.lasts or case.bent is None:
            return value if state == now else self.default
        told = case.bent.SMProxy.GetAnnotation(RESULT + self.name)
        state, value = json.loads(told) if told else (None, None)
        return value if state == digest_of(now) else self.default

    def __set__(self, case, value):
        now = case._state()
        case._results[self.name] = now, value
        if self.lasts and case.bent is not None:
            case.bent.SMProxy.SetAnnotation(
                RESULT + self.name, json.dumps([digest_of(now), value]))


def _labels(name, values):
    labels = [int(value) for value in values]
    if labels != list(values):
        raise ValueError(f"{name} is {values}; labels are whole numbers")
    return labels


def _brain_label(name, values):
    labels = _labels(name, values)
    if len(labels) > 1:
        raise ValueError(f"{name} is {values}; give one label, or a mask as the brain: the cortex "
                         "of several labels is not known")
    return labels


def _level(name, value):
    import math

    if value is not None and not math.isfinite(float(value)):
        raise ValueError(f"{name} is {value}; it must be a finite number or None")
    return None if value is None else float(value)


class Case(Steps, Moments, TimedTraces, Resections, Exports):
    """A patient: what is known, by roles, and the pipeline that it makes.

        case = brainshift.Case(volume="T1.nii.gz", brain="mask.nii.gz", traces="trace.csv")
        case.run("Fit")
        print(case)

    Each role is a path, a ParaView source or `None`. It can be given in any order and changed at
    any time: `case.traces = "second.csv"`. The pipeline then follows; it is ParaView's own, so it
    can be edited, and state files keep it and the roles (`Case.of`).

    - `volume`: the volume before surgery
    - `brain`: a mask or labels of the brain. It is the segmentation, the cortex of fits and
      distances, and the mask of the deformation: tissue away from it is held (`holds_outside`).
    - `tumour`: labels of the tumour in the frame of the volume
    - `traces`: points that were traced on the cortex
    - `opening`: a mask of the opening of the skull, or its centre and radius in mm
    - `landmarks`: a file with the positions at rest and measured (an MNI tag file of two volumes,
      or a table with two sets of columns), or a pair of files or sources: at rest, measured
    - `electrodes`: contacts on the cortex. The fit takes those of grids to the tissue under their
      sheet (Electrode Grids), those of strips as traced points, and leaves others out.
    - `reference`: a volume during or after surgery
    - `cavity`: a mask of the removed tissue, drawn in the reference

    Settings, all readable and changeable:

    - `surface_level`: the scalar of the volume at the cortex, if there is no brain. Default `None`.
    - `holds_outside`: whether tissue outside of the brain is held. Default True.
    - `mask_growth`: distance in mm by which the brain grows before displacements fade. Default -1:
      as the feather needs, so that all of the brain moves by the whole displacement.
    - `brain_labels`, `tumour_labels`, `cavity_labels`: the labels that count; of the brain one at
      most. Default: all above 0.
    - `landmarks_judge`: True keeps the landmarks out of the fit, so that they judge it. Default
      False.

    A case is of one moment of a surgery: `moment` is its name and `minutes` its time.
    `begin_moment` begins another one, and `moments` lists them.

    Attributes to read: `bent`, the Free-Form Deformation; `comparison`, a Compare Volumes;
    `trace_distance` and `contact_distance`, Trace Distances; each is `None` while its roles are
    missing. `proposal` is the result of `from_folder`, and `resection` that of the last `resect`.
    It is `None` again, and what Judge and Export found is forgotten, once a role, a setting or the
    deformation is another.

    Raises `TypeError` for an unknown role, and `ValueError` or `FileNotFoundError` with the reason
    if a file cannot be read. The role then stays as it was.
    """

    volume, brain, tumour, traces, opening, landmarks, electrodes, reference, cavity = (
        _Role(role) for role in ROLES)
    surface_level = _Setting(None, _level)
    holds_outside = _Setting(True, lambda name, value: bool(value))
    mask_growth = _Setting(-1.0, lambda name, value: float(value))
    brain_labels = _Setting([], _brain_label)
    tumour_labels = _Setting([], _labels)
    cavity_labels = _Setting([], _labels)
    landmarks_judge = _Setting(False, lambda name, value: bool(value))
    resection, judged = _Result(None, lasts=False), _Result(None)
    exported, reported = _Result(()), _Result("")
    _left, _left_by = _Result(""), _Result({})  # of resect: its line and its settings

    def __init__(self, **roles):
        unknown = sorted(set(roles) - set(ROLES))
        if unknown:
            raise TypeError(f"Case has no role {unknown[0]!r}; it has {', '.join(ROLES)}")
        self._begin(uuid.uuid4().hex[:12])
        for role in ROLES:
            if roles.get(role) is not None:
                setattr(self, role, roles[role])

    def _begin(self, name):
        self._name = name
        self._settings = {}  # until there is a deformation to keep them
        self._loose, self._unnamed = [], []  # sources of former roles; new ones and their names
        self.proposal = []
        self._results = {}  # by name: the state that each belongs to, and the result

    @classmethod
    def of(cls, source):
        """Find the case that a source belongs to, for example after a state was loaded.

        - `source`: the source of any role, or the Free-Form Deformation.

        Returns a `Case`, the first of several. Raises `ValueError` if the source belongs to none.
        """
        found = marks(source)
        if not found:
            raise ValueError("the source belongs to no case")
        return cls._named(found[0][1])

    @classmethod
    def _named(cls, name):
        case = cls.__new__(cls)
        case._begin(name)
        return case

    @classmethod
    def all(cls):
        """All cases of the session, a list in the order in which they got a volume."""
        numbers = {}
        for source in sources():
            for role, name in marks(source):  # the names of cases are in no order
                number = role != "bent", source.SMProxy.GetGlobalID()
                numbers[name] = min(numbers.get(name, number), number)
        return [cls._named(name) for name in sorted(numbers, key=numbers.get)]

    @classmethod
    def from_folder(cls, folder):
        """Sort the files of a folder into roles, by kind, name and content, and propose them.

        Nothing is opened for the case. Look at `proposal`, a list of `role`, `file` and `reason`,
        and then call `accept`.

        - `folder`: path of a folder. Its subfolders count if they are DICOM series.

        Returns a `Case` without roles.

        Raises `FileNotFoundError` if there is no such folder.
        """
        case = cls()
        case.proposal = proposed(os.fspath(folder))
        return case

    def accept(self, **changes):
        """Take the proposal of `from_folder` over, with changes.

        - `changes`: roles and what they are instead of the proposal; `None` leaves a role out.
          `measured` is the file of the measured landmarks, if `landmarks` has those at rest alone.

        Returns the case.
        """
        unknown = sorted(set(changes) - set(FILE_ROLES))
        if unknown:
            raise TypeError(f"Case has no role {unknown[0]!r}; it has {', '.join(FILE_ROLES)}")
        files = {each.role: each.file for each in self.proposal if each.role}
        roles = paired({**files, **changes}, self.part("landmarks"))
        for role in ROLES:
            if roles.get(role) is not None:
                setattr(self, role, roles[role])
        return self

    # Parts ------------------------------------------------------------------------------------

    name = property(lambda self: self._name, doc="Tells cases apart. State files keep it.")

    def __eq__(self, other):
        return isinstance(other, Case) and self._name == other._name

    def __hash__(self):
        return hash(self._name)

    def part(self, role):
        """The source with a role, or a made part of the pipeline; None if there is none.

        Raises `ValueError` if a state of the case was loaded beside it.
        """
        found = sources_with(self._key(role))
        if len(found) > 1 and role != "fit":  # a refinement may have replaced a fit
            raise ValueError("the session has this case twice, for a state of it was loaded beside "
                             "it: delete one, or reset the session before a state is loaded")
        return found[0] if found else None

    def _key(self, role):
        return f"{MARK}{role}.{self._name}"

    def _state(self):
        """What results depend on: roles, settings and the deformation as they are."""
        roles = [self.part(role) for role in (*ROLES, "measured")]
        parts = [self.part(part) for part in ("bent", "comparison", "at_rest", "timed")]
        bent = self.bent
        parts.append(bent.Lattice if bent else None)
        settings = [getattr(self, name) for name, kind in vars(Case).items()
                    if isinstance(kind, _Setting)]
        values = {each[0]: each for each in [
            *all_values_of(filter(None, roles + parts))]}
        return list(values.values()), settings, self.opening_ball()

    bent = property(lambda self: self.part("bent"))
    comparison = property(lambda self: self.part("comparison"))
    trace_distance = property(
        lambda self: None if self.traced is None else self.part("trace_distance"))
    contact_distance = property(lambda self: self.part("contact_distance"))

    def _setting(self, name, default=None):
        bent, key = self.bent, SETTING + name
        if bent is None:
            return self._settings.get(name, default)
        return (json.loads(bent.SMProxy.GetAnnotation(key)) if bent.SMProxy.HasAnnotation(key)
                else default)

    def _keep(self, name, value):
        if self.bent is None:
            self._settings[name] = value
        else:  # alone, for undo takes it back there
            self.bent.SMProxy.SetAnnotation(SETTING + name, json.dumps(value))

    def _role(self, role):
        if role == "landmarks":
            pair = self.part("landmarks"), self.part("measured")
            return pair if any(pair) else None
        if role == "opening" and self.part("opening") is None:
            return self.opening_ball()
        return self.part(role)

    def opening_ball(self):
        ball = self._setting("opening_ball")
        return (tuple(ball[0]), ball[1]) if ball else None

    @kept
    def _set_role(self, role, value):
        from paraview import simple

        if role == "opening" and isinstance(value, (tuple, list)):
            centre, radius = value
            ball = list(vector("opening", centre)), positive("opening", radius)
            self._forget("opening")
            self._keep("opening_ball", ball)
        elif role == "landmarks":
            rest, measured = self._landmark_pair(value)
            self._refuse_loop("landmarks", rest)
            self._refuse_loop("measured", measured)
            self._take("landmarks", rest, "landmarks at rest")
            self._take("measured", measured, "measured landmarks")
        else:
            names = {"traces": "traced points", "electrodes": "contacts"}
            source = self._source_of(value, role)
            self._refuse_loop(role, source)
            if role == "traces" and self.traces_by_time:
                self._require_stamps(source)
            self._take(role, source, names.get(role))
            if role == "opening":
                self._keep("opening_ball", None)
        self._wire()
        for source, name in self._unnamed:  # now former sources have given their names back
            give_name(source, name)
        self._unnamed = []
        shared = ("brain", "tumour", *(["traces"] if self.traces_by_time else []))
        for case in self.moments if role in shared else ():
            if case != self:
                case._take(role, self.part(role))
                case._wire()

    def makes(self, source, role):
        """Whether a source is made of what the case makes of that role."""
        cases = self.moments if role == "brain" else [self]  # the brain is that of all moments
        parts = {"tumour": (), "reference": ("comparison",)}.get(
            role, ("bent", "joined", "at_rest", "moments"))
        made = [case.part(part) for case in cases for part in parts]
        made += [case.fit_source() for case in cases if parts[1:]]
        made += [case.part("timed") for case in self.moments if role == "traces"]
        inputs = inputs_of(source)
        return any(part.SMProxy.GetGlobalID() in inputs for part in made if part)

    def _refuse_loop(self, role, source):
        if source is not None and self.makes(source, role):
            raise ValueError(f"{role} must not be made of the bent volume or its fit, which depend "
                             f"on it; {stem(source)} is")

    @staticmethod
    def _source_of(value, role):
        """The source of a role: a file is opened."""
        if isinstance(value, (str, os.PathLike)):
            return opened(value, role)
        if value is not None:
            require_kind(value, role)
        return value

    @staticmethod
    def _landmark_pair(value):
        """Sources of the landmarks at rest and measured."""
        if isinstance(value, (str, os.PathLike)) and os.path.isfile(value) and holds_both(value):
            path = os.fspath(value)
            if ending(path) == ".tag":
                return (opened(path, "landmarks", Volume=1),
                        opened(path, "measured", Volume=2))
            return tuple(opened(path, "landmarks", PositionColumns=columns)
                         for columns in landmark_columns(path))
        pair = value if isinstance(value, (tuple, list)) else (value, None)
        return tuple(Case._source_of(one, role)
                     for one, role in zip(pair, ("landmarks", "measured")))

    def _forget(self, role, keep=None):
        """Takes a role from its source, unless that is the one to keep."""
        former = self.part(role)
        if former is not None and (keep is None or former.SMProxy is not keep.SMProxy):
            former.SMProxy.RemoveAnnotation(self._key(role))
            self._loose += [source for source in upstream(former) if not marks(source)]

    def _take(self, role, source, name=None):
        """Gives a role to a source, and a name to one that the case opened."""
        self._forget(role, keep=source)
        if source is not None:
            if source.SMProxy.HasAnnotation(OPENED) and not marks(source):  # it is new
                self._unnamed.append((source, name or stem(source)))
            source.SMProxy.SetAnnotation(self._key(role), "1")
            doubt_about_files(source)  # from now on

    def _delete_loose(self):
        """Deletes sources of former roles that nothing uses, and then those that these used."""
        from paraview import simple

        self._loose = [source for source in self._loose if not marks(source)]
        while unused := next(filter(is_unused, self._loose), None):
            self._loose.remove(unused)
            simple.Delete(unused)
            del unused  # it uses its input as long as Python holds it
        self._loose = []

    # The pipeline -----------------------------------------------------------------------------

    def _made(self, part, kind, name, **inputs):
        """A part of the pipeline: made if it is missing, with these inputs; deleted if one of them
        is missing."""
        from paraview import simple

        source = self.part(part)
        if any(value is None for value in inputs.values()):
            if source is not None and part in (*_OF_FIT, *_OF_TRACES):  # which uses it still
                source.SMProxy.RemoveAnnotation(self._key(part))
                self._loose.append(source)
            elif source is not None:
                simple.Delete(source)
            return None
        if source is None:
            source = getattr(simple, kind)(registrationName=free_name(name), **inputs)
            source.SMProxy.SetAnnotation(self._key(part), "1")
            return source
        self._set(source, inputs)
        return source

    @kept
    def _wire(self):
        """Makes the pipeline agree with roles and settings. Nothing that agrees is touched."""
        volume = self.volume
        former = self.bent
        if volume is None:
            if former is not None:
                self._settings = settings_at(former)
            self._leave_moments()
            for part in ("fit", *_MADE):
                self._made(part, "", "", Input=None)
        bent = self._made("bent", "FreeFormDeformation", self._bent_name() if volume else "",
                          Input=volume)
        if bent is not None:
            for key, value in self._settings.items() if former is None else ():
                bent.SMProxy.SetAnnotation(SETTING + key, json.dumps(value))
            self._limit(bent)
            self._wire_times()
            fit = self.fit_source()
            if fit is not None and fit.SMProxy.HasAnnotation(self._key("fit")):
                self._set(fit, {"Input": volume, **_shared(bent), "Mask": bent.Mask,
                                **self._measurements()})
            elif any(self.part(part) for part in _OF_FIT):
                self._measurements()
            self._distances(bent)
            self._wire_resection()  # before a comparison goes
            comparison = self._made("comparison", "CompareVolumes", "comparison", Input=bent,
                                    Reference=self.reference)
            if comparison is not None:
                self._set(comparison, {"Cavity": self.cavity, "CavityLabels": self.cavity_labels})
            self._wire_resection()
            self._wire_moments()
        self._delete_loose()

    @staticmethod
    def _set(source, values):
        """Sets properties that are not so yet."""
        for name, value in values.items():
            present = getattr(source, name)
            is_source = value is None or hasattr(value, "SMProxy")
            same = (present == value if is_source else
                    list(present) == list(value) if isinstance(value, (list, tuple)) else
                    source.GetPropertyValue(name) == value)
            if not same:
                setattr(source, name, value)

    def _take_lattice_of(self, other):
        """Gives the deformation the control points of another one."""
        self._set(self.bent, {**_shared(other), "Inverse": other.Inverse})

    def _limit(self, bent):
        """What is drawn and what may move."""
        held = self.brain if self.holds_outside else None
        self._set(bent, {"Segmentation": self.brain, "Mask": held, "MaskLabels": self.brain_labels,
                         "MaskGrowth": self.mask_growth})

    def cortex(self):
        """The properties that define the cortex; empty if nothing does."""
        if self.brain is not None:
            labels = self.brain_labels
            if len(labels) == 1:
                return {"Segmentation": self.brain, "SurfaceBy": "Label", "Label": labels[0]}
            return {"Segmentation": self.brain, "SurfaceBy": "Threshold", "Threshold": 0.5}
        if self.surface_level is not None:
            return {"Segmentation": None, "SurfaceBy": "Threshold",
                    "Threshold": self.surface_level}
        return {}

    def _distances(self, bent):
        from paraview import servermanager

        cortex = self.cortex()
        grids = self.part("at_rest")
        contacts = self.electrodes
        if contacts is not None and grids is not None:  # those that the fit takes to the cortex
            contacts = servermanager.OutputPort(grids, 1)
        # One that is there stays without points, with its displays: a wrong time is soon corrected.
        traced = self.traces_now() if self.part("trace_distance") else self.traced
        for part, points, name in (("trace_distance", traced, "trace distance"),
                                   ("contact_distance", contacts, "contact distance")):
            measure = self._made(part, "TraceDistance", name, Input=points if cortex else None,
                                 Deformation=bent)
            if measure is not None:
                self._set(measure, {**cortex, "Cavity": self.cavity,
                                    "CavityLabels": self.cavity_labels})

    def _grids(self, ball):
        """An Electrode Grids of the electrodes, or None."""
        cortex = self.cortex()
        surface = cortex.pop("Segmentation", None) or self.volume
        former = self.part("at_rest")
        contacts = former.Input if former is not None else None
        grids = self._made("at_rest", "ElectrodeGrids", "contacts at rest",
                           Input=self.electrodes if cortex else None, Cortex=surface)
        if grids is not None and contacts != self.electrodes:  # else a user's own shapes stay
            self._set(grids, {"ContactGroups": [], "Shapes": [], **shapes_of(self.electrodes)})
        if grids is not None:
            self._set(grids, {**cortex, "Opening": self.part("opening"),
                              "OpeningCentre": list(ball[0]), "OpeningRadius": float(ball[1])})
        return grids

    def _on_cortex(self, grids):
        """The source of all points that lie on the cortex."""
        from paraview import servermanager

        contacts = servermanager.OutputPort(grids, 1) if grids is not None else None
        points = [source for source in (self.traced, contacts) if source is not None]
        if len(points) < 2:
            self._made("joined", "", "", Input=None)
            return points[0] if points else None
        return self._made("joined", "AppendDatasets", "traced points and contacts", Input=points)

    def _measurements(self):
        """The inputs of a fit."""
        rest, measured = self.landmarks or (None, None)
        if self.landmarks_judge or not (rest and measured):
            rest = measured = None
        ball = self.opening_ball() or ((0.0, 0.0, 0.0), 0.0)
        grids = self._grids(ball)
        if grids is not None and rest is None:
            rest, measured = grids, self.electrodes
        return {"RestLandmarks": rest, "MeasuredLandmarks": measured,
                "Traces": self._on_cortex(grids),
                "Opening": self.part("opening"), "OpeningCentre": list(ball[0]),
                "OpeningRadius": float(ball[1]), "Cavity": self.cavity,
                "CavityLabels": self.cavity_labels, **self.cortex()}

    def fit_source(self):
        """The fit that bends the volume, or None."""
        lattice = self.bent.Lattice if self.bent else None
        return lattice if is_kind(lattice, "FitDeformation") else None

    def fits_landmarks(self):
        """Whether the fit uses the landmarks, so that they do not judge it."""
        fit, rest = self.fit_source(), self.part("landmarks")
        return fit is not None and rest is not None and fit.RestLandmarks == rest

    # Actions ----------------------------------------------------------------------------------

    @kept
    def show(self, view=None, look=None):
        """Show the bent volume in a render view, with a look.

        - `view`: a render view. The default, `None`, is the active one, or a new one.
        - `look`: a name of `brainshift.looks`. The default, `None`, is Brain if there is a brain.
        """
        from paraview import simple

        view = view or simple.GetActiveViewOrCreate("RenderView")
        self.hide_other_moments(view)
        if self.part("resected") is not None:  # which shows the same volume
            simple.Hide(self.part("resected"), view)
        return self._shown(self.bent, view, look)

    @staticmethod
    def _shown(source, view, look):
        from paraview import simple

        from .looks import look as set_look, looks

        shown = simple.Show(source, view, "UniformGridRepresentation")
        shown.SetRepresentationType("Deformed Volume")
        names = looks(shown)
        wanted = look or ("Brain" if "Brain" in names else names[0] if names else None)
        if wanted:
            set_look(shown, wanted, view)
        shown.SetScalarBarVisibility(view, False)
        return shown

    @kept
    def fit(self):
        """Fit the deformation to traces, electrodes and landmarks, as `brainshift.fit` does.

        The fit keeps following the roles: other traces are fitted at the next update.

        Returns a `Fit`. Raises `ValueError` with the reason if it fails; the case stays as it was.
        """
        from paraview import simple

        bent, former = self.bent, self.bent.Lattice
        base = former.Base if is_kind(former, "FitDeformation") else former
        begun = [part for part in _OF_FIT if self.part(part) is None]
        values = {name: value for name, value in self._measurements().items() if value is not None}
        source = own(simple.FitDeformation(
            Input=bent.Input, **_shared(bent), **values, **({"Base": base} if base else {})))
        source.UpdatePipeline()
        grids = self.part("at_rest")
        problem = (grids is not None and reason_of(grids)) or reason_of(source)
        if problem:
            simple.Delete(source)
            for part in begun:
                self._made(part, "", "", Input=None)
        self._delete_loose()
        if problem:
            raise ValueError(problem)
        source.SMProxy.SetAnnotation(self._key("fit"), "1")
        bent.Lattice = source
        forget_former(former)
        simple.RenameSource(result_name(bent.Input, "fit"), source)
        self._distances(bent)
        return Fit(source)

    @kept
    def refine(self, **settings):
        """Refine the deformation by the reference: see `brainshift.refine` for the settings."""
        from .registering import refine

        return refine(self.bent, self.comparison, **settings)

    def __repr__(self):
        roles = ", ".join(role for role in ROLES if getattr(self, role) is not None) or "no role"
        lines = [f"  {step.name}: {step.state}"
                 + (f", {step.lacks}" if step.lacks else "")
                 + (f": {step.found}" if step.found else "")
                 for step in self.steps]
        if self.resection is not None:
            lines.append(f"  {self.resection}")
        moment = f" of {self.moment or 'the moment'} at {self.minutes:g} min"
        of = moment if len(self.moments) > 1 else ""
        return "\n".join([f"Case{of} with {roles}", *lines])
