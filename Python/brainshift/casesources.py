# SPDX-License-Identifier: BSD-3-Clause
"""Sources of the pipeline as a case sees them: their marks, names, kinds and inputs."""

import functools
import hashlib
import itertools
import json
import os
import time

from .rolefiles import files_of
from .roles import ending, open_file

#: Annotations of proxies, which state files keep: `MARK` + role + "." + name of the case; at the
#: Free-Form Deformation `SETTING` + name, a setting as JSON, and `RESULT` + name, a result and the
#: state of the case that it is of; `OPENED` at sources that a case opened itself, and `NAME` the
#: name that it gave them.
MARK, SETTING, OPENED = "BrainShift.Case.", "BrainShift.CaseSetting.", "BrainShift.CaseOpened"
RESULT, NAME = "BrainShift.CaseResult.", "BrainShift.CaseName"

#: Properties of readers that name files or folders.
FILE_PROPERTIES = ("FileName", "FileNames")

#: By path, and whether it is listed: until when it is not looked at again, and what was found. See
#: `_written_each`.
_seen = {}

#: By the number of a source that reads files: when it was set or reloaded last, which makes it read
#: headers, and when they were written then.
_read = {}

#: Roles that points have. All others are volumes.
POINT_ROLES = ("traces", "landmarks", "measured", "electrodes")


def sources():
    """All sources of the pipeline."""
    from paraview import simple

    return list(simple.GetSources().values())


def sources_with(annotation):
    """The sources of the pipeline that have an annotation. Only these get their Python object,
    which takes far longer than the search: a case asks for its parts a hundred times."""
    from paraview import servermanager

    found, iterator = {}, servermanager.vtkSMProxyIterator()
    iterator.SetSession(servermanager.ActiveConnection.Session)
    iterator.SetModeToOneGroup()
    iterator.Begin("sources")
    while not iterator.IsAtEnd():
        proxy = iterator.GetProxy()
        if proxy.HasAnnotation(annotation):
            found[proxy.GetGlobalID()] = servermanager._getPyProxy(proxy)
        iterator.Next()
    return list(found.values())


def free_name(name):
    """A name that no source of the pipeline has."""
    from paraview import simple

    taken = {known for known, _ in simple.GetSources()}
    others = (f"{name} {number}" for number in itertools.count(2))
    return next(each for each in itertools.chain([name], others) if each not in taken)


def name_of(source):
    """The name of a source in the pipeline; empty if it has none."""
    from paraview import servermanager

    return servermanager.ProxyManager().GetProxyName("sources", source.SMProxy) or ""


def result_name(source, what):
    """The name of what was made of a source, as in the window: "T1 fit"."""
    return free_name(f"{name_of(source)} {what}".strip())


def stem(source):
    """The name of a source's file without its ending, or the name of the source."""
    for name in FILE_PROPERTIES:
        value = getattr(source, name, None)
        if value:
            path = value if isinstance(value, str) else value[0]
            base = os.path.basename(os.path.normpath(path))
            return base[:len(base) - len(ending(path))] if ending(path) else base
    return name_of(source) or "volume"


def give_name(source, name=None):
    """Gives a source a name, if no other has it, and keeps it at the source. Without a name: the
    one that it was given before, or that of its file."""
    from paraview import simple

    proxy = source.SMProxy
    kept_name = proxy.GetAnnotation(NAME) if proxy.HasAnnotation(NAME) else stem(source)
    free = free_name(name or kept_name)
    simple.RenameSource(free, source)
    if name:
        proxy.SetAnnotation(NAME, free)


def opened(path, role, **properties):
    """A source of a file that the case deletes when it has no role any more."""
    from paraview import simple

    source = open_file(path, **properties)
    try:
        require_kind(source, role)
    except ValueError:
        simple.Delete(source)
        raise
    source.SMProxy.SetAnnotation(OPENED, "1")
    return source


def require_kind(source, role):
    """Raises `ValueError` if the data of a source cannot have a role."""
    source.UpdatePipeline()
    kind, wanted = (("vtkPointSet", "points") if role in POINT_ROLES else
                    ("vtkImageData", "a volume"))
    if not source.GetDataInformation().DataSetTypeIsA(kind):
        data = source.GetDataInformation().GetPrettyDataTypeString()
        raise ValueError(f"{role} must be {wanted}; {stem(source)} is {data}")


def marks(source):
    """The roles of a source in cases, and the names of the cases: a list of pairs."""
    proxy = source.SMProxy
    keys = [proxy.GetAnnotationKeyAt(i) for i in range(proxy.GetNumberOfAnnotations())]
    return [tuple(key[len(MARK):].split(".")) for key in keys if key.startswith(MARK)]


def settings_at(bent):
    """The settings of a case that its Free-Form Deformation keeps."""
    proxy = bent.SMProxy
    keys = [proxy.GetAnnotationKeyAt(i) for i in range(proxy.GetNumberOfAnnotations())]
    return {key[len(SETTING):]: json.loads(proxy.GetAnnotation(key)) for key in keys
            if key.startswith(SETTING)}


def upstream(source):
    """A source and those that it is made of, as far as a case opened them."""
    found = []
    while source is not None and source.SMProxy.HasAnnotation(OPENED):
        found.append(source)
        source = getattr(source, "Input", None)
    return found


def properties_of(proxy, kind):
    """The properties of a proxy that are of a VTK class."""
    iterator = proxy.NewPropertyIterator()
    iterator.UnRegister(None)
    iterator.Begin()
    while not iterator.IsAtEnd():
        if iterator.GetProperty().IsA(kind):
            yield iterator.GetProperty()
        iterator.Next()


def _proxies_in(proxy):
    """The properties of a proxy that have proxies, and these: pairs of a property and a list."""
    for value in properties_of(proxy, "vtkSMProxyProperty"):
        yield value, [value.GetProxy(i) for i in range(value.GetNumberOfProxies())]


def _reached(source, next_of):
    """The proxies that a source leads to, by their numbers: its own, and those that `next_of` tells
    for each."""
    found, waiting = {}, [source.SMProxy]
    while waiting:
        proxy = waiting.pop()
        if proxy is not None and proxy.GetGlobalID() not in found:
            found[proxy.GetGlobalID()] = proxy
            waiting += next_of(proxy)
    return found


def inputs_of(source):
    """All proxies that a source is made of, by their numbers, and the source itself."""
    return _reached(source, lambda proxy: [
        each for _, proxies in _proxies_in(proxy) for each in proxies])


def all_values_of(proxies):
    """What sources, and all that they are made of, were told: a list of what `values_of` returns,
    each once."""
    from paraview import servermanager

    found = {}
    for source in proxies:
        found.update(inputs_of(source))
    return [values_of(servermanager._getPyProxy(proxy)) for proxy in found.values()]


def values_of(source):
    """What a source was told, to see whether it changed: its identity, its properties, and when its
    files were written."""
    found = [source.SMProxy.GetGlobalIDAsString()]
    for name in source.ListProperties():
        own = source.SMProxy.GetProperty(name)
        if own is None or own.GetInformationOnly() or name == "Evidence":  # which moves nothing
            continue
        value = source.GetPropertyValue(name)
        if own.IsA("vtkSMProxyProperty"):
            value = [own.GetProxy(i) and own.GetProxy(i).GetGlobalIDAsString()
                     for i in range(own.GetNumberOfProxies())]
        found.append((name, str(value)))
        if name.endswith(FILE_PROPERTIES):
            found.append((f"{name} written", _written_each(_list_of(value))))
    return found


def _list_of(value):
    return [value] if isinstance(value, str) else list(value or ())


def paths_of(source):
    """The paths of the files of a source, or of those that its data are made of, and whether a
    reader has more than this one: a dict."""
    return {path: len(paths) > 1 for _, paths in _readers_and_paths(source) for path in paths}


def _readers_and_paths(source):
    """The readers of the data of a source, and their paths: a list of pairs."""
    from paraview import servermanager

    def paths_in(proxy):
        reader = servermanager._getPyProxy(proxy)
        return _list_of(next((getattr(reader, name) for name in FILE_PROPERTIES
                              if getattr(reader, name, None)), None))

    reached = _reached(source, lambda proxy: [] if paths_in(proxy) else _data_of(proxy))
    found = [(servermanager._getPyProxy(proxy), paths_in(proxy)) for proxy in reached.values()]
    return [(reader, paths) for reader, paths in found if paths]


def _data_of(proxy):
    """The inputs of a filter; of a deformation the volume alone, for the rest only bends it."""
    is_bent = proxy.GetXMLName() == "FreeFormDeformation"
    return [each for value, proxies in _proxies_in(proxy) for each in proxies
            if value.IsA("vtkSMInputProperty") and not (is_bent and value.GetXMLName() != "Input")]


def doubt_about_files(source):
    """A sentence without names, which reports show, if the files of a source, or of those that its
    data are made of, were written, or went away, after their headers were read; else empty, as for
    files on a server. The first call takes them as they are. Another time step reads more of the
    files, and no header."""
    return next(filter(None, (_doubt_about_reader(reader, paths)
                              for reader, paths in _readers_and_paths(source))), "")


def _doubt_about_reader(reader, paths):
    """See `doubt_about_files`."""
    algorithm = reader.GetClientSideObject()
    if algorithm is None:
        return ""
    when = algorithm.GetMTime()
    written = _written_each(paths)
    former, then = _read.setdefault(reader.SMProxy.GetGlobalID(), (when, written))
    if former != when:  # it reads them again
        _read[reader.SMProxy.GetGlobalID()], then = (when, written), written
    if _reads_folders(reader):  # files that are new were not read
        names = [{name for name, *_ in before} for before in then]
        written = [[each for each in now if each[0] in known]
                   for now, known in zip(written, names)]
    if written == then:
        return ""
    if any(before and not now for now, before in zip(written, then)):
        return "its file is gone; what is shown was read before"
    return ("its file was written after it was read: choose it again, or press F5 (File > Reload "
            "Files)")


def digest_of(state):
    """A text for a state of a case, the same once a state file brought it back, if no file was
    written since: `values_of` sources first, which have other numbers then, and anything else."""
    sources_of, *others = state
    text = repr([values[1:] for values in sources_of] + others)
    for i, values in enumerate(sources_of):
        text = text.replace(f"'{values[0]}'", f"'#{i}'")
    return hashlib.sha256(text.encode()).hexdigest()


def _reads_folders(source):
    """Whether a source reads the whole folder of a file."""
    return source.SMProxy.GetXMLName().startswith("DICOM")


def _written_each(paths):
    """For each path when the files that are read for it were written, and their sizes: pairs by
    name. Empty if there is none, as on a server.

    The answer is kept for 20 times as long as it took: a folder may have thousands of files.
    """
    return [_written(path, len(paths) > 1) for path in paths]


def _written(path, listed):
    """See `_written_each`."""
    asked = time.monotonic()
    until, found = _seen.get((path, listed), (asked, None))
    if asked >= until:
        found = sorted(filter(None, map(_stat_of, _files_at(path, listed))))
        now = time.monotonic()
        _seen[path, listed] = now + 20.0 * (now - asked), found
    return found


def _files_at(path, listed):
    """The files that are read for a path; itself if that cannot be seen."""
    try:
        return files_of(path, listed)
    except OSError:  # deleted meanwhile
        return [path]


def _stat_of(file):
    try:
        known = os.stat(file)
    except OSError:  # deleted meanwhile
        return None
    return file, known.st_mtime_ns, known.st_size


def kept(function):
    """Runs a method and makes the former source active again."""
    @functools.wraps(function)
    def run(*arguments, **named):
        from paraview import simple

        active = simple.GetActiveSource()
        try:
            return function(*arguments, **named)
        finally:
            simple.SetActiveSource(active)
    return run
