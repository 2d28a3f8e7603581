# SPDX-License-Identifier: BSD-3-Clause
"""Saves volumes, lattices and displacement fields, loads the latter, reads a DICOM patient."""

from .arguments import vector


def _write(writer, name):
    """Runs a writer proxy, and raises an error with the reason if it made no file."""
    writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    problem = writer.GetPropertyValue("Problem")
    if problem:
        raise OSError(f"{name} was not written: {problem}")


def figures_of(source):
    """A filter after its update and that of the figures that it reports."""
    source.UpdatePipeline()
    source.SMProxy.UpdatePropertyInformation()
    return source


def reason_of(reader):
    """Why a reader of BrainShift read nothing in its last run: a sentence, or empty."""
    reader.SMProxy.UpdatePropertyInformation()
    return reader.GetPropertyValue("Problem")


def require_read(reader, active):
    """Reads. If nothing was read, deletes the reader, makes the former source active again and
    raises `ValueError` with the reason."""
    from paraview import simple

    reader.UpdatePipeline()
    problem = reason_of(reader)
    if problem:
        simple.Delete(reader)
        simple.SetActiveSource(active)
        raise ValueError(problem)


def _world(world):
    """The word of the writers' property for "RAS", "LPS" or None; another raises an error."""
    if world not in (None, "RAS", "LPS"):
        raise ValueError(f"world is {world!r}; it must be \"RAS\", \"LPS\" or None")
    return world or "As The Volume Says"


def save_lattice(filter, name):
    """Save the control points of a Free-Form Deformation. Strokes and Strength are in them.

    A mask is not: the filter that loads them needs the same Mask, MaskLabels, MaskGrowth and
    Feather, and warns if it has others. `save_field` saves a deformation with its mask.

    - `filter`: a Free-Form Deformation.
    - `name`: path of the file to write, an image file that ends in `.vti`.
    """
    from paraview import simple

    lattice = simple.DeformationLattice(Input=filter)
    try:
        simple.SaveData(name, proxy=lattice)
    finally:
        simple.Delete(lattice)


def load_lattice(filter, name):
    """Load a file of `save_lattice` as the base lattice of a Free-Form Deformation.

    The filter takes the density and the kernel that the file was saved with. Its strokes add to
    the lattice of the file. It keeps its own mask, and warns if the file was saved with another.

    - `filter`: a Free-Form Deformation.
    - `name`: path of the file.

    Returns the reader of the file, a ParaView source.

    Raises `ValueError` with the reason if the file does not hold a lattice. The filter stays as it
    was.
    """
    from paraview import simple

    active = simple.GetActiveSource()
    reader = simple.XMLImageDataReader(FileName=[name])
    reader.UpdatePipeline()
    information = reader.GetDataInformation()
    arrays = information.GetPointDataInformation()
    components = [arrays.GetArrayInformation(i).GetNumberOfComponents()
                  for i in range(arrays.GetNumberOfArrays())]
    if 3 not in components:
        found = information.GetNumberOfPoints()
        simple.Delete(reader)
        simple.SetActiveSource(active)
        reason = ("it has no point array of 3 components" if found else
                  "it does not exist, is damaged, or is no image file (.vti) of VTK")
        raise ValueError(f"{name} is no lattice: {reason}")
    low_x, high_x, low_y, high_y, low_z, high_z = information.GetExtent()
    kernel = information.GetFieldDataInformation().GetArrayInformation("FFDKernel")
    filter.Lattice = reader
    filter.LatticeDimensions = [high_x - low_x + 1, high_y - low_y + 1, high_z - low_z + 1]
    number = -1 if kernel is None else int(kernel.GetComponentRange(0)[0])
    if number >= 0:  # else the lattice takes any
        filter.Kernel = number
    return reader


def save_field(filter, name, direction="Backward", spacing=None, world="RAS"):
    """Save the displacement field of a Free-Form Deformation for another program.

    - `filter`: a Free-Form Deformation.
    - `name`: path of the file to write. It ends in `.nii`, `.nii.gz`, `.mha`, `.mhd` or `.nrrd`.
      The file records the direction.
    - `direction`: `"Backward"`, the default, is the direction with which ITK, ANTs, elastix
      and Slicer resample images.
      `"Forward"` maps the rest frame to the deformed frame.
    - `spacing`: three numbers in mm, the distances between samples along the axes of the volume.
      The default, `None`, takes the points of the volume itself.
    - `world`: `"RAS"`, the default, or `"LPS"`, the world axes of the volume. A warning says if the
      volume carries none, which the file notes, or others.

    The new file takes the place of an old one only when the disk holds all of it.

    Raises `OSError` with the reason if the file is not written, and `ValueError` if `spacing` does
    not have three finite numbers.
    """
    from paraview import servermanager, simple

    grid = {} if spacing is None else {
        "SampleGrid": "Given Spacing", "Spacing": list(vector("spacing", spacing))}
    field = simple.DeformationField(Input=filter, Direction=direction, **grid)
    try:
        writer = servermanager.writers.DisplacementFieldWriter(
            Input=field, FileName=name, World=world)
        _write(writer, name)
    finally:
        simple.Delete(field)


def load_field(name, direction="As Stored In The File", world="RAS"):
    """Load a displacement field to be the `Lattice` of a Free-Form Deformation.

    It reads files of ANTs, elastix, NiftyReg, Slicer and `save_field`. Registration programs write
    backward fields. A backward field is inverted on its own points.

    - `name`: path of the file.
    - `direction`: `"As Stored In The File"`, the default. `"Forward"` or `"Backward"`
      overrides the file.
    - `world`: `"RAS"`, the default, or `"LPS"`, the world axes of the volume to deform.

    Returns a ParaView source with a forward field in mm.

    Raises `ValueError` with the reason if the file is not a displacement field, or if some of its
    points have no finite number.
    """
    from paraview import simple

    active = simple.GetActiveSource()
    reader = simple.DisplacementFieldReader(FileName=name, Direction=direction, World=world)
    require_read(reader, active)
    gap = reader.GetPropertyValue("Gap")
    if gap:
        simple.Delete(reader)
        simple.SetActiveSource(active)
        raise ValueError(f"Displacement field {name} has {gap}; a deformation needs all of them. "
                         "apply_transform needs those inside the volume")
    leads = reader.GetDataInformation().GetFieldDataInformation().GetArrayInformation(
        "DisplacementDirection")
    if leads.GetStringValue(0) == "forward":
        return reader
    return simple.InvertDisplacementField(Input=reader)


def save_volume(source, name, array=None, world=None):
    """Save a volume for another program, with its position, axes and data type.

    - `source`: a ParaView source of an image, such as Bake Deformation. A Free-Form Deformation
      is saved as it was loaded; bake it to save it deformed.
    - `name`: path of the file to write, on the machine that computes. It ends in `.nii`,
      `.nii.gz`, `.mha`, `.mhd` or `.nrrd`.
    - `array`: name of the point array to write. The default, `None`, takes the active scalars.
    - `world`: `"RAS"` or `"LPS"`, the world axes of the volume. The default, `None`, takes
      those that are attached to the volume. Without them the volume is written as RAS, with a
      warning.

    Integers of 8 bytes become integers of 4 bytes if all values fit. The new file replaces an old
    one only when the disk holds all of it.

    Raises `OSError` with the reason if the file is not written, and `ValueError` if `world` is
    another word.
    """
    from paraview import servermanager

    writer = servermanager.writers.MedicalVolumeWriter(
        Input=source, FileName=name, PointArray=array or "", World=_world(world))
    _write(writer, name)


def dicom_patient(reader):
    """Read the name, number, birth date and sex of the patient of a DICOM series.

    BrainShift shows these texts nowhere else, and never writes them to a state, trace, volume or
    picture. The function reads the first file of the series again, on the machine that has it.

    - `reader`: a DICOM Volume Reader.

    Returns a dictionary of texts: `name` (family and given name with `^` between, as in the file),
    `number`, `birth_date` (as 1970-01-31) and `sex` (M, F or O). A text is empty if the file
    does not have it.

    Raises `TypeError` if `reader` is no DICOM Volume Reader, and `ValueError` with the reason if it
    has read no series.
    """
    if reader.SMProxy.GetXMLName() not in ("DICOMVolumeReader", "DICOMFileReader"):
        raise TypeError(f"reader is a {reader.SMProxy.GetXMLName()}; it must be a DICOM Volume "
                        "Reader")
    reader.UpdatePipelineInformation()
    problem = reason_of(reader)
    if problem:
        raise ValueError(problem)
    report = reader.SMProxy.GetSessionProxyManager().NewProxy("misc", "DICOMPatientReport")
    report.UnRegister(None)  # Python holds it, and no state knows it
    report.PrototypeOn()  # a question is no step to undo
    report.GetProperty("Source").AddProxy(reader.SMProxy)
    report.UpdateVTKObjects()
    report.InvokeCommand("Read")
    report.UpdatePropertyInformation()
    return {key: report.GetProperty(name).GetElement(0) or "" for key, name in (
        ("name", "Name"), ("number", "Number"), ("birth_date", "BirthDate"), ("sex", "Sex"))}


def save_dicom(source, folder, like, array=None, world=None):
    """Save a volume as a DICOM series of its own, one file for each slice.

    The series belongs to the study of the patient's scan and keeps its frame of reference, so
    navigation shows both at the same position. Its images are marked as derived. Their description
    reads: research, not for clinical use.

    - `source`: a ParaView source of an image with one component, such as Bake Deformation.
    - `folder`: path of the folder to make, on the machine that computes. It must be new or empty.
    - `like`: path of a DICOM file of the patient's scan, or of a folder with one. The series takes
      its patient, study, frame of reference and modality.
    - `array`: name of the point array to write. The default, `None`, takes the active scalars.
    - `world`: `"RAS"` or `"LPS"`, the world axes of the volume. The default, `None`, takes
      those that are attached to the volume. Without them nothing is written.

    Values that are no integers, or do not fit into 16 bits, are rounded to 65536 steps between the
    lowest and the highest. The folder is written whole or not at all.

    Raises `OSError` with the reason if it is not written, and `ValueError` if `world` is another
    word.
    """
    from paraview import servermanager

    writer = servermanager.writers.MedicalSeriesWriter(
        Input=source, FileName=folder, Like=like, PointArray=array or "", World=_world(world))
    _write(writer, folder)


def save_segmentation(source, file, like, array=None, world=None):
    """Save labels as one DICOM segmentation (SEG) in the study of the patient's scan.

    Each value above 0 becomes a segment with the name, the colour and the coded terms that the
    volume carries. Frames lie in the planes of the scan's images and refer to them. Patient, study
    and frame of reference are those of the scan. The description reads: research, not for clinical
    use.

    - `source`: a ParaView source of an image with one component, such as the labels of a tumour, or
      Bake Deformation of labels. Values are whole numbers from 0 to 65535.
    - `file`: path of the file, on the machine that computes. It must end in `.seg.dcm`.
    - `like`: path of a DICOM file of the patient's scan, or of a folder with one.
    - `array`: name of the point array to write. The default, `None`, takes the active scalars.
    - `world`: `"RAS"` or `"LPS"`, the world axes of the volume. The default, `None`, takes
      those that are attached to the volume. Without them nothing is written.

    Segments are numbered from 1 on without gaps, as DICOM wants; a warning says so if labels get
    other numbers.

    Raises `OSError` with the reason if it is not written, and `ValueError` if `world` is another
    word or `file` has another ending.
    """
    from paraview import servermanager

    if not file.lower().endswith(".seg.dcm"):
        raise ValueError(f"file is {file!r}; the name of a segmentation must end in .seg.dcm")
    writer = servermanager.writers.MedicalSeriesWriter(
        Input=source, FileName=file, Like=like, PointArray=array or "", World=_world(world))
    _write(writer, file)
