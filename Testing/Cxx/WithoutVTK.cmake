# Test programs of what knows no VTK: they would not link if it did. Testing/Portable builds them
# with other compilers.

# The core.
brainshift_add_gtest(DeformationTest
  SOURCES
    Deformation/ControlPointsTest.cxx
    Deformation/DensityTest.cxx
    Deformation/FieldChangeTest.cxx
    Deformation/FoldGuardTest.cxx
    Deformation/JacobianBoundTest.cxx
    Deformation/JacobianTest.cxx
    Deformation/KernelsTest.cxx
    Deformation/LatticeTest.cxx
    Deformation/MaskWeightsTest.cxx
    Deformation/OffsetFieldTest.cxx
    Deformation/ParallelTest.cxx
    Deformation/PointMapTest.cxx
    Deformation/ReplayTest.cxx
    Deformation/SegmentFractionsTest.cxx
    Deformation/StrokeTest.cxx
  LIBRARIES
    BrainShiftDeformation
    BrainShiftThreadLoop)

# The fit.
brainshift_add_gtest(FitTest
  SOURCES
    Fit/FitBaseTest.cxx
    Fit/FitLatticeTest.cxx
    Fit/FitTest.cxx
    Fit/LandmarkMatchTest.cxx
    Fit/PairDoubtsTest.cxx
    Fit/ProcessTest.cxx
    Fit/TraceFitTest.cxx
  LIBRARIES
    BrainShiftDeformation
    BrainShiftThreadLoop
    BrainShiftFit)

# Grids of electrodes.
brainshift_add_gtest(ElectrodesTest
  SOURCES
    Electrodes/ContactArraysTest.cxx
    Electrodes/RealContactsTest.cxx
    Electrodes/SheetFitTest.cxx
  LIBRARIES
    BrainShiftDeformation
    BrainShiftElectrodes
    BrainShiftFit
    BrainShiftThreadLoop)

# The registration.
brainshift_add_gtest(RegisterTest
  SOURCES
    Register/AlignmentTest.cxx
    Register/BeamTest.cxx
    Register/BlockCheckTest.cxx
    Register/RefinementTest.cxx
    Register/SimilarityTest.cxx
    Register/StartsTest.cxx
    Register/StiffnessTest.cxx
    Register/SweepTest.cxx
    Register/TrustTest.cxx
    Register/UltrasoundSightTest.cxx
    Register/UltrasoundTest.cxx
    Register/VolumeTest.cxx
  LIBRARIES
    BrainShiftDeformation
    BrainShiftThreadLoop
    BrainShiftFit
    BrainShiftRegister)
