# SPDX-License-Identifier: BSD-3-Clause
"""Traces of all moments in one source: which points belong to a moment, by their time stamps."""

import math

from .casesources import OPENED, kept, marks, stem

#: Units of time stamps, and how many a minute has.
UNITS = {"s": 60.0, "ms": 60000.0, "min": 1.0}

#: The point array of time stamps, as Landmark Reader calls it.
_STAMPS = "Time"

#: The annotation of sources that chose the points of a moment, and are its own traces now.
_PARTED = "BrainShift.CaseParted"


class TimedTraces:
    """The traces of a `Case`, which derives from this, at its moment."""

    @property
    def traces_by_time(self):
        """Whether the traces are those of all moments, which their time stamps tell apart.

        The unit of the stamps, `"s"`, `"ms"` or `"min"`. A point belongs to the last moment that
        began at or before its stamp. Default: an empty text; each moment has traces of its own.
        Set back to empty, each moment keeps the points that it had as traces of its own.
        """
        return self._setting("traces_by_time", "")

    @traces_by_time.setter
    def traces_by_time(self, unit):
        unit = unit or ""
        if unit not in ("", *UNITS):
            raise ValueError(f"traces_by_time is {unit!r}; it must be one of {', '.join(UNITS)}, "
                             "or empty")
        if unit:
            self._share("traces_by_time", unit, self._only_traces())
        elif self.traces_by_time:
            self._part_traces()

    @property
    def trace_start(self):
        """The time stamp at minute 0 of ParaView's clock, in the unit of the stamps. Default 0."""
        return self._setting("trace_start", 0.0)

    @trace_start.setter
    def trace_start(self, stamp):
        stamp = float(stamp)
        if not math.isfinite(stamp):
            raise ValueError(f"trace_start is {stamp}; it must be a finite number")
        self._share("trace_start", stamp, self.traces)

    @property
    def traced(self):
        """The traced points of this moment, a source; `None` if there are none."""
        timed = self.part("timed")
        if timed is None:
            return self.traces
        timed.UpdatePipeline()
        return timed if timed.GetDataInformation().GetNumberOfPoints() else None

    def traces_now(self):
        """The source of the traced points of this moment, also if it has no point; else `None`."""
        timed = self.part("timed")
        return self.traces if timed is None else timed

    def has_stamps(self):
        """Whether the traces have time stamps."""
        traces = self.traces
        return traces is not None and _stamps_of(traces) is not None

    @staticmethod
    def _require_stamps(traces):
        """Raises `ValueError` if there are traces without time stamps, and lets go of their source
        if a case opened it and has no use for it."""
        from paraview import simple

        if traces is None or _stamps_of(traces) is not None:
            return
        name = stem(traces)
        if traces.SMProxy.HasAnnotation(OPENED) and not marks(traces):
            simple.Delete(traces)
        raise ValueError(f"the points of {name} have no time stamps, a point array {_STAMPS}: name "
                         "a column of its file time, or give each moment traces of its own")

    def lacks_traced(self):
        """What is missing if no point was traced at this moment; else an empty text."""
        if self.traces is None or self.traced is not None:
            return ""
        stamps = _stamps_of(self.traces)
        if stamps is None:
            return f"time stamps of the traces, the point array {_STAMPS}"
        low, high = stamps.GetRange(0)
        return (f"traced points of this moment, which goes from {self._stamp():.10g} "
                f"{self.traces_by_time} on: the time stamps are {low:.10g} to {high:.10g} "
                f"{self.traces_by_time}; trace_start is the stamp at minute 0")

    def of_no_moment(self):
        """How many traced points belong to no moment: they are of before the first, or have no
        time stamp."""
        if self.part("timed") is None:
            return 0
        counts = []
        parts = [case.part("timed") for case in self.moments]
        for source in [self.traces, *(part for part in parts if part is not None)]:
            source.UpdatePipeline()
            counts.append(source.GetDataInformation().GetNumberOfPoints())
        return counts[0] - sum(counts[1:])

    def _only_traces(self):
        """The traces of all moments; None if none has any. Raises `ValueError` if two moments have
        different ones, or they have no time stamps."""
        given = [(case, _whole(case.traces)) for case in self.moments if case.traces is not None]
        for case, traces in given:
            if traces != given[0][1]:
                name = repr(case.moment) if case.moment else "without a name"
                raise ValueError(f"the moment {name} has traces of its own, {stem(case.traces)}: "
                                 "take them away first, for one source has the traces of all "
                                 "moments by time")
        traces = given[0][1] if given else None
        self._require_stamps(traces)
        return traces

    @kept
    def _part_traces(self):
        """Makes the points of each moment traces of its own."""
        cases = self.moments
        for case, points in [(case, case.traced) for case in cases]:
            made = [case.part(part) for part in ("timed", "cloud") if points is not None]
            for part, source in zip(("timed", "cloud"), made):
                source.SMProxy.RemoveAnnotation(case._key(part))
            case._take("traces", points)
            for source in made:
                source.SMProxy.SetAnnotation(OPENED, "1")  # it goes when it has no role any more
                source.SMProxy.SetAnnotation(_PARTED, "1")
        for case in cases:
            case._keep("traces_by_time", "")
        for case in cases:
            case._wire()

    @kept
    def _share(self, name, value, traces):
        """Keeps a setting of all moments, and their traces if they go by time."""
        cases = self.moments
        for case in cases:
            case._keep(name, value)
        for case in cases if self.traces_by_time and traces is not None else ():
            case._take("traces", traces)
        for case in cases:
            case._wire()

    def _stamp(self):
        """The time stamp at which the moment begins."""
        return self.trace_start + self.minutes * UNITS[self.traces_by_time]

    def _wire_times(self):
        """Makes the points of the moment agree with its time and that of the next one."""
        traces = self.traces if self.traces_by_time else None
        name = f"{stem(traces)}{f', {self.moment}' if self.moment else ''}" if traces else ""
        cloud = self._made("cloud", "ConvertToPointCloud", f"{name}, points", Input=traces)
        if cloud is not None:  # a cell of several points goes through a threshold whole or not
            self._set(cloud, {"CellGenerationMode": "Vertex cells"})
        timed = self._made("timed", "Threshold", name, Input=cloud)
        if timed is None:
            return
        later = [case for case in self.moments if case.minutes > self.minutes]
        # The last moment has no end. A number for it would be beyond the panel's sliders.
        start = self._stamp()
        end = math.nextafter(later[0]._stamp(), -math.inf) if later else start
        self._set(timed, {"Scalars": ["POINTS", _STAMPS],
                          "ThresholdMethod": "Between" if later else "Above Upper Threshold",
                          "LowerThreshold": start, "UpperThreshold": end})

    def _rewire_times(self):
        """Makes the points of other moments agree with the time of this one."""
        if self.traces_by_time:
            for case in self.moments:
                if case != self:
                    case._wire()


def _whole(traces):
    """The traces of all moments that those of one were taken from; else the traces themselves."""
    while traces.SMProxy.HasAnnotation(_PARTED):
        traces = traces.Input
    return traces


def _stamps_of(source):
    """What is known of the time stamps of points; None if they have none."""
    source.UpdatePipeline()  # after a state was loaded nothing is known yet
    return source.PointData.GetArray(_STAMPS)
