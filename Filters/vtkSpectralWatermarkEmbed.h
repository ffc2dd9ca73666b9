// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkEmbed
 * @brief   Hides a message in a triangle mesh
 *
 * Scheme Robust, the default: moves the points along their normals by the smallest displacement, in
 * root mean square over the surface, that puts all carriers where the message wants them, as firmly
 * as MaximumDistortion allows, and reads the result blind. GetDistortion() tells what was spent,
 * GetMargin() how firmly the weakest carrier holds.
 *
 * Scheme PaperSlots: embeds a bit into one magnitude of each slot (paper, eqs. 10 and 11) and repeats
 * with the changed mesh's own basis until the message is read back blind (paper, 2.3). Only the
 * change of the spectrum is transformed back and added to the points, so that no detail is lost.
 *
 * In both, what is checked is the mesh exactly as a detector will find it: with points rounded to
 * their output precision, and polygons triangulated anew, as their corners moved.
 *
 * Output port 0: the marked mesh, with the input's cells and attributes, the new points, and
 * point data `GeometricDistortion` (double: each point's displacement as a fraction of the
 * input's bounding-box diagonal). Arrays of a basis are left out: it no longer fits. Points used
 * by no polygon do not move; points at the same place stay together.
 *
 * Output port 1: a vtkTable with a row per iteration: `Iteration` (0: the input), `Distortion`
 * (percent of the diagonal), `LargestError` (of a carrier, in steps of its quantisation; over 0.25
 * reads another bit), of points that are not rounded yet, in the input's triangles; for PaperSlots a row per iteration and slot: `Iteration`, `Slot` and
 * `Component` (1-based), `Magnitude`, `Average`, `Deviation` (length^2), `BitWanted`, `BitRead`.
 *
 * Its field data has what the getters of the same names tell: `Converged`, `Distortion`, `Margin`,
 * `Capacity`, `ExtractedMessage`.
 *
 * PaperSlots: a basis on the input (vtkManifoldHarmonics, lumped, at least as many harmonics as the slots
 * need) serves the first iteration.
 *
 * Not converged (PaperSlots: after MaximumNumberOfIterations): the output is the mesh that read the most bits
 * right, GetConverged() is 0, GetExtractedMessage() is what it reads, and a vtkWarningMacro says
 * so. This is no error. In PaperSlots narrow slots and symmetric models often need a larger TurbulenceFactor.
 *
 * Errors (vtkErrorMacro, an error code, empty outputs): as for vtkManifoldHarmonics; an empty
 * message without a secret key, or one with characters other than 0 and 1; a key file that cannot
 * be used; more bits than the mesh can carry, or than MaximumDistortion or memory allows; slots that contradict
 * each other or reach into the constant harmonics; with Robust, a surface that encloses no volume.
 *
 * @code{.cpp}
 * vtkNew<vtkSpectralWatermarkEmbed> embed;
 * embed->SetInputConnection(reader->GetOutputPort());
 * embed->SetSecretKeyFile("my.key"); // the message is derived from it
 * embed->Update();
 * if (!embed->GetConverged()) { ... }
 * @endcode
 *
 * @sa
 * vtkSpectralWatermarkDetect vtkMeshDistortion
 */
#ifndef vtkSpectralWatermarkEmbed_h
#define vtkSpectralWatermarkEmbed_h

#include "vtkSpectralWatermarkAlgorithm.h"

#include <string> // for Message

class vtkTable;

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkSpectralWatermarkEmbed
  : public vtkSpectralWatermarkAlgorithm
{
public:
  static vtkSpectralWatermarkEmbed* New();
  vtkTypeMacro(vtkSpectralWatermarkEmbed, vtkSpectralWatermarkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the bits to embed (the paper's "key"), a string of 0 and 1. Default "" for Robust and
   * "10110" for PaperSlots. Empty with a secret key: NumberOfBits bits derived from the key, so that
   * there is nothing else to remember. Empty without one: an error. n bits in PaperSlots need
   * FirstComponent - 1 + n SlotSize harmonics.
   */
  void SetMessage(const char* message);
  const char* GetMessage() const;
  ///@}

  ///@{
  /**
   * Set/Get the paper's extraction threshold: PaperSlots stops as soon as that many bits are read
   * back right. Default 0: all. More than there are bits means all. Robust always wants all.
   */
  vtkSetClampMacro(RequiredBits, int, 0, VTK_INT_MAX);
  vtkGetMacro(RequiredBits, int);
  ///@}

  ///@{
  /**
   * Set/Get after how many iterations PaperSlots gives up. Default 20, at least 1.
   */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Set/Get how far Robust may move the surface: the root mean square of the displacement over the
   * surface, in percent of the bounding box's diagonal. Default 0.07, positive. The mark is made as
   * robust as that allows.
   */
  vtkSetClampMacro(MaximumDistortion, double, VTK_DBL_MIN, 100.0);
  vtkGetMacro(MaximumDistortion, double);
  ///@}

  ///@{
  /**
   * Set/Get whether Robust measures GetCapacity(). Default off: it takes as long as several embeddings
   * of as many bits, and those of hundreds of bits take a minute each.
   */
  vtkSetMacro(ReportCapacity, bool);
  vtkGetMacro(ReportCapacity, bool);
  vtkBooleanMacro(ReportCapacity, bool);
  ///@}

  ///@{
  /**
   * Set/Get the precision of the output points, a vtkAlgorithm::DesiredOutputPrecision. Default
   * DEFAULT_PRECISION: the input's. Choose SINGLE_PRECISION when the mesh goes to a file format
   * that stores floats, so that what was verified is what the file holds.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  /**
   * Get whether at least RequiredBits bits of the output were read back right; for Robust, whether
   * the whole message was, blind, and its check holds.
   */
  vtkGetMacro(Converged, int);

  /**
   * Get what Robust spent of MaximumDistortion, in the same unit; 0 for PaperSlots.
   */
  vtkGetMacro(Distortion, double);

  /**
   * Get how firmly the weakest carrier of Robust holds its bit: 1 in the middle of its cell, 0 at
   * the border to the other bit. 0 for PaperSlots.
   */
  vtkGetMacro(Margin, double);

  /**
   * Get how many bits Robust would embed in this mesh within MaximumDistortion, whatever the message,
   * at most 1024 (a few more may fit); 0 unless ReportCapacity is on, and for PaperSlots. The longer a
   * message, the less it survives.
   */
  vtkGetMacro(Capacity, int);

  /**
   * Get how many times the output's points were changed.
   */
  vtkGetMacro(NumberOfIterationsUsed, int);

  /**
   * Get how many bases the last update computed: for PaperSlots one per iteration, and one for the
   * input unless it brought its own; 0 for Robust.
   */
  vtkGetMacro(NumberOfEigensolves, int);

  /**
   * Get what the output reads, blind; "" after an error or an abort.
   */
  const char* GetExtractedMessage() const { return this->ExtractedMessage.c_str(); }

protected:
  vtkSpectralWatermarkEmbed();
  ~vtkSpectralWatermarkEmbed() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSpectralWatermarkEmbed(const vtkSpectralWatermarkEmbed&) = delete;
  void operator=(const vtkSpectralWatermarkEmbed&) = delete;

  void ResetResults() override;
  void EmbedInSlots(vtkPolyData* input, vtkPolyData* output, vtkTable* table);
  void EmbedRobust(vtkPolyData* input, vtkPolyData* output, vtkTable* table);
  std::string WantedMessage(const spectralwatermark::SecretKey* key) const;
  void WarnUnlessConverged(const std::string& wanted);

  std::string Message;
  bool MessageIsSet = false;
  int RequiredBits = 0;
  int MaximumNumberOfIterations = 20;
  double MaximumDistortion = 0.07;
  bool ReportCapacity = false;
  int Capacity = 0;
  int OutputPointsPrecision = DEFAULT_PRECISION;

  double Distortion = 0.0;
  double Margin = 0.0;
  int Converged = 0;
  int NumberOfIterationsUsed = 0;
  int NumberOfEigensolves = 0;
  std::string ExtractedMessage;
};

#endif
