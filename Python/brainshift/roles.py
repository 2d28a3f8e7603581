# SPDX-License-Identifier: BSD-3-Clause
"""Sorts the files of a folder into the roles of a case, by kind, name and content."""

import collections
import os
import re

from .images import Labels, fetched

#: The roles of a case, in the order in which they are shown.
ROLES = ("volume", "brain", "tumour", "traces", "opening", "landmarks", "electrodes", "reference",
         "cavity")

#: Roles of files: landmarks may come as two files, at rest and measured.
FILE_ROLES = (*ROLES, "measured")

#: Endings of files with points, and of volumes.
POINTS = (".mrk.json", ".fcsv", ".tag", ".csv", ".tsv")
VOLUMES = (".nii", ".nii.gz", ".mha", ".mhd", ".nrrd", ".nhdr", ".mgz", ".mgh", ".mnc", ".mif",
           ".mif.gz", ".vti")

#: Words of names and the roles they mean, the first that matches counts. A word is a part of the
#: name between signs, digits and changes of case.
_POINT_WORDS = (
    ("landmarks", "landmark landmarks fiducial fiducials pairs tags"),
    ("electrodes", "electrode electrodes contact contacts ecog ieeg grid strip eeg"),
    ("traces", "trace traces traced pointer surface cortex"))
_VOLUME_WORDS = (
    ("cavity", "cavity resection resected"),
    ("opening", "opening craniotomy bone flap"),
    ("tumour", "tumour tumor lesion glioma gtv metastasis meningioma"),
    ("brain", "brain brainmask bet skullstrip mask parenchyma"),
    ("reference", "post postop postoperative intraop intraoperative ius us ioct after during "
                  "reference followup"),
    ("volume", "pre preop preoperative before mr mri t1 t1w t2 t2w flair ct head anat mprage"))

#: Beginnings of words of columns: of landmarks at rest, and of measured ones.
_REST_WORDS = ("rest", "pre", "before", "fixed", "source")
_MEASURED_WORDS = ("meas", "post", "intra", "after", "moving", "target", "during")

#: Words of names of files of measured landmarks.
_MEASURED_FILES = ("measured post postop postoperative intraop intraoperative during after us ius "
                   "moving")

#: Whole words of columns of measured landmarks.
_MEASURED_SHORT = ("us", "ius")

#: Files beside the data that have no role.
_ASIDE = ("coordsystem", "dataset_description", "participants", "manifest", "channels", "events")

#: How the reason begins if a name says the role.
_BY_NAME = "its name has the word"

#: Ends of the volume (ml) of a brain, and the most different values that a label map has.
_BRAIN_ML = (600.0, 2200.0)
_MOST_LABELS = 64

Proposed = collections.namedtuple("Proposed", "role file reason")


def ending(path):
    """The ending of a file of points or of a volume, or an empty text."""
    name = os.path.basename(path).lower()
    return next((end for end in sorted(POINTS + VOLUMES, key=len, reverse=True)
                 if name.endswith(end)), "")


def _words(path):
    name = os.path.basename(path)
    name = name[:len(name) - len(ending(path))]
    weighted = re.findall(r"(?:^|[^A-Za-z0-9])([Tt][12][Ww]?)(?=[^A-Za-z0-9]|$)", name)
    parts = re.split(r"[^A-Za-z]+", re.sub(r"([a-z])([A-Z])", r"\1 \2", name))
    return [word.lower() for word in [*parts, *weighted] if word]


def _by_words(path, table):
    """The first role of a table that a word of the name means, and the word."""
    words = _words(path)
    for role, known in table:
        found = next((word for word in words if word in known.split()), None)
        if found:
            return role, f"{_BY_NAME} {found}"
    return None, ""


def column_sets(path):
    """The sets of three columns of a table that hold positions: a list of lists of names."""
    return [columns for _, columns in _sets_by_axes(path)]


def _sets_by_axes(path):
    """The sets of columns of a table that hold positions: pairs of axes and three names.

    The names of a set differ in one letter, x, y, z or r, a, s or l, p, s, at their start or end
    or as a word of their own.
    """
    with open(path, encoding="utf-8-sig", errors="replace") as file:
        header = next((line for line in file if line.strip() and not line.startswith("#")), "")
    names = [name.strip().strip('"') for name in re.split(r"[,;\t]", header)]
    sets = collections.OrderedDict()
    for axes in ("xyz", "ras", "lps"):
        for name in names:
            for where, axis in enumerate(axes):
                for rest in {re.sub(rf"(?i)(^|[_ .:-]){axis}([_ .:-]|$)", r"\1*\2", name),
                             re.sub(rf"(?i)^{axis}(?=\d*$)", "*", name)} - {name}:
                    sets.setdefault((axes, rest.lower()), [None] * 3)[where] = name
    return [(axes, found) for (axes, _), found in sets.items() if all(found)]


def _rank(columns):
    """-1 if the names of columns say that they are at rest, 1 if measured, 0 if neither or both."""
    words = [word.lower() for name in columns
             for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+", name)]
    numbers = {re.sub(r"\D", "", name) for name in columns}
    is_rest = any(word.startswith(_REST_WORDS) for word in words) or numbers == {"1"}
    is_measured = numbers == {"2"} or any(
        word.startswith(_MEASURED_WORDS) or word in _MEASURED_SHORT for word in words)
    return int(is_measured) - int(is_rest)


def landmark_columns(path):
    """The two `column_sets` of a table of landmarks: at rest, measured, as their names say.

    Raises `ValueError` if they do not say which is which: another space, such as MNI, or another
    scan is no measurement of the same landmarks, and the order of columns says nothing.
    """
    sets = column_sets(path)
    first, second = map(_rank, sets)
    if first == second:
        names = " or ".join(", ".join(columns) for columns in sets)
        raise ValueError(f"{os.path.basename(path)} does not say whether {names} are the landmarks "
                         "at rest: call their columns x_rest, ... and x_measured, ..., or leave "
                         "one set out")
    return sets if first < second else sets[::-1]


def _says_which(path):
    """Whether a file with two sets of positions says which are at rest."""
    return ending(path) == ".tag" or len(set(map(_rank, column_sets(path)))) == 2


def holds_both(path):
    """Whether a file of landmarks has the positions at rest and the measured ones: why, or an empty
    text."""
    if ending(path) == ".tag":
        with open(path, encoding="utf-8", errors="replace") as file:
            is_pair = re.search(r"Volumes\s*=\s*2", file.read(4096))
            return "it has the points of two volumes" if is_pair else ""
    is_pair = ending(path) in (".csv", ".tsv") and len(column_sets(path)) == 2
    return "it has two sets of positions" if is_pair else ""


def paired(files, rest=None):
    """Files by role as a case takes them: landmarks at rest and measured are a pair.

    - `rest`: the landmarks at rest that the case has, for measured ones that come alone

    Raises `ValueError` if the file of the landmarks has the measured ones, too.
    """
    roles = {role: file for role, file in files.items() if role != "measured"}
    measured, given = files.get("measured"), files.get("landmarks")
    if measured is None or isinstance(given, (tuple, list)):
        return roles
    if isinstance(given, (str, os.PathLike)) and os.path.isfile(given) and (
            holds_both(given) and _says_which(given)):
        raise ValueError(f"{os.path.basename(given)} has both positions of landmarks, and "
                         f"{os.path.basename(measured)} is given as the measured ones: leave one "
                         "of them out")
    roles["landmarks"] = given if given is not None else rest, measured
    return roles


def _points_role(path):
    """The role of a file of points, and why; None if nothing says one."""
    both, (role, reason) = holds_both(path), _by_words(path, _POINT_WORDS)
    if both and (_says_which(path) or role in (None, "landmarks")):
        return ("landmarks", both) if _says_which(path) else (None, (
            f"{both}, and its columns do not say which are at rest: call them x_rest, ... and "
            "x_measured, ..., or leave one set out"))
    word = next((word for word in _words(path) if word in _MEASURED_FILES.split()), None)
    if role == "landmarks" and word:
        return "measured", f"{reason} and the word {word}"
    if role or ending(path) not in (".csv", ".tsv"):
        return role, reason
    return ("traces", "it is a table of positions") if column_sets(path) else (None, "")


def _labels_role(path):
    """The role of a volume whose name says none, by its values, and why."""
    from paraview import simple

    active, source = simple.GetActiveSource(), None
    try:
        source = open_file(path)
        return _role_of_image(fetched(source))
    except (ValueError, RuntimeError) as error:
        return None, f"it cannot be read: {error}"
    finally:
        if source is not None:
            simple.Delete(source)
        simple.SetActiveSource(active)


def _role_of_image(image):
    """The role of an image by its values, and why."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy

    scalars = image.GetPointData().GetScalars() or image.GetPointData().GetArray(0)
    values = numpy.unique(vtk_to_numpy(scalars)) if scalars else numpy.empty(0)
    if len(values) > _MOST_LABELS or not numpy.array_equal(values, numpy.rint(values)):
        return "volume", "it has grey values"
    labels = Labels(image)
    ml = float(labels.inside.sum()) * labels.voxel / 1000.0
    if _BRAIN_ML[0] <= ml <= _BRAIN_ML[1]:
        return "brain", f"its labels have {ml:.0f} ml, as a brain"
    return ("tumour", f"its labels have {ml:.1f} ml") if ml < _BRAIN_ML[0] else (None, "")


def _is_series(path):
    """Whether a folder has DICOM files."""
    if not os.path.isdir(path):
        return False
    for name in sorted(os.listdir(path))[:3]:
        file = os.path.join(path, name)
        if os.path.isfile(file):
            with open(file, "rb") as opened:
                if opened.read(132)[128:] == b"DICM":
                    return True
    return False


def _role_of(path):
    if ending(path) in POINTS:
        return _points_role(path)
    role, reason = _by_words(path, _VOLUME_WORDS)
    later = dict(_VOLUME_WORDS)["reference"].split()
    word = next((word for word in _words(path) if word in later), None)
    if role in ("tumour", "brain") and word:  # these belong to the volume before surgery
        return None, f"{reason} and the word {word}, so it may be of the reference"
    return (role, reason) if role else _labels_role(path)


def _may_have_role(path):
    name = os.path.basename(os.path.normpath(path))
    is_aside = any(word in name.lower() for word in _ASIDE)
    return not (name.startswith(".") or is_aside) and (ending(path) or _is_series(path))


def proposed(paths):
    """What each of some files may be: a list of Proposed, the role None where nothing says one.

    A role is given once, to the first file in the order of names, and rather by a name than by
    values; `reason` says what spoke for it, or who has the role already.

    - `paths`: a folder, whose files count, or a list of files and folders of DICOM
    """
    if isinstance(paths, str):
        paths = [paths]
    if len(paths) == 1 and os.path.isdir(paths[0]) and not _is_series(paths[0]):
        paths = [os.path.join(paths[0], name) for name in os.listdir(paths[0])]
    found, taken = [], {}
    said = {path: _role_of(path) for path in sorted(paths) if _may_have_role(path)}
    for path, (role, reason) in sorted(
            said.items(), key=lambda one: not one[1][1].startswith(_BY_NAME)):
        name = os.path.basename(os.path.normpath(path))
        if role == "volume" and "volume" in taken and "grey" in reason:
            role, reason = "reference", "it is the second volume with grey values"
        if role in taken:
            role, reason = None, f"{taken[role]} is the {role} already; {reason}"
        if role:
            taken[role] = name
        found.append(Proposed(role, path, reason or "nothing says what it is"))
    return sorted(found, key=lambda one: one.file)


def reader_of(path, **properties):
    """A ParaView source of a file, which has not read it. Raises `FileNotFoundError`, and
    `ValueError` if the format is not known."""
    from paraview import servermanager, simple

    path = os.fspath(path)
    if not (os.path.exists(path) or servermanager.ActiveConnection.IsRemote()):
        raise FileNotFoundError(f"there is no {path}")
    if ending(path) in POINTS or path.lower().endswith(".json"):
        source = simple.LandmarkReader(FileName=path, **properties)
    elif path.lower().endswith((".nii", ".nii.gz", ".hdr", ".img", ".hdr.gz", ".img.gz")):
        source = simple.NIFTIVolumeReader(FileName=path)
    elif path.rstrip("/").lower().endswith(".zarr"):
        source = simple.OMEZarrReader(FileName=path)
    elif os.path.isdir(path):
        source = simple.DICOMVolumeReader(FileName=path)
    else:
        try:
            source = simple.OpenDataFile(path)
        except RuntimeError:  # no reader was found
            source = None
    if source is None:
        raise ValueError(f"{path} has a format that ParaView does not read")
    return source


def open_file(path, **properties):
    """A ParaView source of a file. Raises `FileNotFoundError` or `ValueError` with the reason."""
    from paraview import simple

    from .files import reason_of

    source = reader_of(path, **properties)
    source.UpdatePipeline()
    problem = reason_of(source) if source.SMProxy.GetProperty("Problem") else ""
    if problem or source.GetDataInformation().GetNumberOfPoints() == 0:
        simple.Delete(source)
        raise ValueError(problem or f"{path} holds no data")
    return source
