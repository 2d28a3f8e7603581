# SPDX-License-Identifier: BSD-3-Clause
"""What a refinement was made of, and which landmarks fits before it used.

Annotations keep it, and state files keep these. Lineage.cxx in the window writes the same.
"""

import json
import os
import uuid

#: Annotations: of a source what tells it from others, as its number does within a session; and of
#: the lattice of a refinement the landmarks at rest that fits before it used.
_IDENTITY, _FITTED = "BrainShift.Identity", "BrainShift.Fitted"


def identity(source):
    """What a source is known by later: an identity, which it gets now, and its file, texts."""
    if source is None:
        return []
    proxy = source.SMProxy
    if not proxy.HasAnnotation(_IDENTITY):
        proxy.SetAnnotation(_IDENTITY, uuid.uuid4().hex)
    files = getattr(source, "FileName", None) or getattr(source, "FileNames", None) or ""
    return [proxy.GetAnnotation(_IDENTITY), files if isinstance(files, str) else files[0]]


def _is_same(one, other):
    """Whether two sources have the same data: the same source, with its file if that only moved to
    another folder; or one file that was opened again."""
    if not (one and other):
        return not one and not other
    same_name = os.path.basename(one[1]) == os.path.basename(other[1])
    return one[0] == other[0] and same_name or bool(one[1]) and one[1] == other[1]


def landmarks_fitted_by(lattice):
    """The landmarks at rest that a lattice, or the fits that it began from, used: a list of
    identities."""
    found = []
    while lattice is not None:
        if lattice.SMProxy.HasAnnotation(_FITTED):
            found += json.loads(lattice.SMProxy.GetAnnotation(_FITTED))
        rest = getattr(lattice, "RestLandmarks", None)
        found += [identity(rest)] if rest else []
        lattice = getattr(lattice, "Base", None)
    return found


def keep_fitted(lattice, landmarks):
    """Keeps the landmarks at a lattice that has no fit any more."""
    lattice.SMProxy.SetAnnotation(_FITTED, json.dumps(landmarks))


def is_fitted(rest, landmarks):
    """Whether landmarks at rest are among those of `landmarks_fitted_by`."""
    return any(_is_same(identity(rest), one) for one in landmarks)


def compared_by(bent, comparison):
    """What a refinement of a deformation by a Compare Volumes is made of, as JSON keeps it."""
    return {"volume": identity(bent.Input), "reference": identity(comparison.Reference),
            "cavity": identity(comparison.Cavity),
            "pose": [*comparison.ReferenceTranslation, *comparison.ReferenceRotation],
            "labels": [float(label) for label in comparison.CavityLabels]}


def differences(former, now):
    """What a refinement was made of that is another now: a list of words."""
    found = [f"another {name}" for name in ("volume", "reference", "cavity")
             if not _is_same(former[name], now[name])]
    if any(abs(a - b) > 1e-6 for a, b in zip(former["pose"], now["pose"])):
        found.append("another position of the reference")
    if former["cavity"] and now["cavity"] and former["labels"] != now["labels"]:
        found.append("other labels of the cavity")
    return found
