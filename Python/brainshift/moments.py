# SPDX-License-Identifier: BSD-3-Clause
"""The moments of a surgery: cases of one volume, each with its own deformation, as time steps."""

import math

from .casesources import free_name, kept, stem

#: Settings of a case that its next moment begins with.
_KEPT = ("surface_level", "holds_outside", "mask_growth", "brain_labels", "tumour_labels",
         "landmarks_judge", "opening_ball", "traces_by_time", "trace_start")

#: What a view shows of a case.
_SHOWN = ("bent", "comparison", "resected", "traces", "timed", "electrodes",
          "trace_distance", "contact_distance")

#: Settings that belong to roles of all moments.
SHARED = ("holds_outside", "mask_growth", "brain_labels", "tumour_labels")

#: Frames of an animation from one moment to the next.
_FRAMES = 20


class Moments:
    """The moments of a `Case`, which derives from this."""

    @property
    def moment(self):
        """The name of the moment of surgery that the case is of; an empty text by default. No two
        moments of a surgery have one name."""
        return self._setting("moment", "")

    @moment.setter
    def moment(self, name):
        if str(name) == self.moment:
            return
        self._require_new(name, [case for case in self.moments if case != self])
        self._keep("moment", str(name))
        if self.bent is not None:
            from paraview import simple

            simple.RenameSource(free_name(self._bent_name()), self.bent)

    @staticmethod
    def _require_new(name, cases):
        """Raises `ValueError` if one of the cases has that name of a moment."""
        if str(name) and any(case.moment == str(name) for case in cases):
            raise ValueError(f"another moment has the name {str(name)!r} already; give each moment "
                             "its own name")

    @property
    def minutes(self):
        """The time of the moment in minutes, on ParaView's clock. Default 0."""
        return self._setting("minutes", 0.0)

    @minutes.setter
    def minutes(self, value):
        value = float(value)
        if not math.isfinite(value):
            raise ValueError(f"minutes is {value}; it must be a finite number")
        taken = [case for case in self.moments if case != self and case.minutes == value]
        if taken:
            raise ValueError(f"minutes is {value:g}, which is the time of another moment"
                             + (f", {taken[0].moment!r}" if taken[0].moment else "")
                             + "; give each moment its own time")
        self._keep("minutes", value)
        self._wire()
        self._rewire_times()

    @property
    def moments(self):
        """The moments of the surgery, a list of `Case` by their times; this one among them."""
        group = self.part("moments")
        cases = [self] if group is None else [
            case for case in type(self).all() if group.SMProxy.HasAnnotation(case._key("moments"))]
        return sorted(cases, key=lambda case: case.minutes)

    @kept
    def begin_moment(self, name, minutes=None):
        """Begin another moment of the same surgery.

        The moment is a case with the same volume, brain, tumour, opening and landmarks at rest. It
        begins without a deformation, and has traces, electrodes, measured landmarks, a reference
        and a cavity of its own. The source "moments" has all moments as time steps. Between two
        moments tissue moves along straight lines, which nothing measured.

        - `name`: for example "after resection"
        - `minutes`: time of the moment. Default `None`: 30 minutes after the last one.

        Returns the `Case` of the moment.

        Raises `ValueError` without a volume, or if another moment has this time or name.
        """
        if self.lacks_bent():
            raise ValueError(f"a moment lacks {self.lacks_bent()}")
        former = self.moments
        self._require_new(name, former)
        minutes = former[-1].minutes + 30.0 if minutes is None else float(minutes)
        if not math.isfinite(minutes) or any(case.minutes == minutes for case in former):
            raise ValueError(f"minutes is {minutes:g}; it must be a finite number, and the time of "
                             "no other moment")
        case = type(self)()
        case._settings = {key: self._setting(key) for key in _KEPT
                          if self._setting(key) is not None}
        case._settings.update(moment=str(name), minutes=minutes)
        case.volume = self.volume
        case._take_lattice_of(self.bent)
        for role in ("brain", "tumour"):
            setattr(case, role, self.part(role))
        if self.part("opening") is not None:
            case.opening = self.part("opening")
        if self.part("landmarks") is not None:
            case.landmarks = self.part("landmarks"), None
        self._gather([*former, case])
        if self.traces_by_time:
            case.traces = self.traces
            case._rewire_times()
        return case

    @kept
    def show_moments(self, view=None, look=None):
        """Show the moments as time steps in a render view, in place of the bent volumes.

        ParaView's time goes to this moment. Play then shows the way from moment to moment.

        - `view`, `look`: see `show`

        Returns the representation. Raises `ValueError` if there is one moment only.
        """
        from paraview import simple

        group = self.part("moments")
        if group is None:
            raise ValueError("the case has one moment only; begin_moment adds another")
        view = view or simple.GetActiveViewOrCreate("RenderView")
        for case in self.moments:
            for source in filter(None, (case.bent, case.part("resected"))):
                simple.Hide(source, view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        scene.PlayMode = "Sequence"
        scene.NumberOfFrames = _FRAMES * (len(self.moments) - 1) + 1
        scene.AnimationTime = self.minutes
        return self._shown(group, view, look)

    def hide_other_moments(self, view):
        """Hide the other moments in a render view, with their points and comparisons."""
        self.hide_others(view, self.moments)

    def hide_others(self, view, cases):
        """Hide other cases in a render view, with their points, comparisons and moments."""
        from paraview import simple

        own = [self.part(part) for part in _SHOWN]
        for source in (case.part(part) for case in cases if case != self
                       for part in (*_SHOWN, "moments")):
            if source is not None and source not in own:
                simple.Hide(source, view)

    def moment_ending(self):
        """What tells the files of a moment from those of others; empty for the only one."""
        moments = self.moments
        if len(moments) < 2:
            return ""
        own = self._words_of_moment()
        is_twice = sum(case._words_of_moment().lower() == own.lower() for case in moments) > 1
        minutes = f"{self.minutes:.10g}min"
        return f"_{own}_{minutes}" if own and is_twice else f"_{own or minutes}"

    def _words_of_moment(self):
        """The name of the moment as names of files have it. Some disks know no capitals."""
        return "".join(letter if letter.isalnum() else "-" for letter in self.moment)

    def _bent_name(self):
        return f"{stem(self.volume)} bent" + (f", {self.moment}" if self.moment else "")

    def _gather(self, cases):
        """Makes the time steps agree with the cases. One case needs none."""
        from paraview import simple

        group = self.part("moments")
        cases = sorted(cases, key=lambda case: case.minutes)
        if len(cases) < 2:
            if group is not None:
                simple.Delete(group)
            return
        values = {"Input": [case.bent for case in cases],
                  "Times": [case.minutes for case in cases]}
        if group is None:
            group = simple.Moments(
                registrationName=free_name(f"{stem(self.volume)} moments"), **values)
        else:
            self._set(group, values)
        for case in cases:
            group.SMProxy.SetAnnotation(case._key("moments"), "1")

    def _leave_moments(self):
        """Takes the case out of the moments."""
        group = self.part("moments")
        if group is not None:
            rest = [case for case in self.moments if case != self]
            rest[0]._gather(rest)
            if rest[0].part("moments") is not None:
                group.SMProxy.RemoveAnnotation(self._key("moments"))
            for case in rest if self.traces_by_time else ():
                case._wire()  # the points of the moment are those of the one before it

    def _wire_moments(self):
        """Makes the time steps follow the case: another volume is no moment of this surgery."""
        if self.part("moments") is None:
            return
        others = [case for case in self.moments if case != self]
        if any(case.volume == self.volume for case in others):
            self._gather(self.moments)
        else:
            self._leave_moments()
