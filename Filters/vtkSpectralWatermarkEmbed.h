// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkEmbed
 * @brief   Hides a message in a triangle mesh
 *
 * Scheme Robust, the default: the filter moves the points along their normals and then reads the
 * message back blind. Of all displacements that give the carriers the values of the message, it
 * takes the smallest in root mean square over the surface, and it makes the mark as robust as
 * MaximumDistortion allows. GetDistortion() returns the distortion, GetMargin() how firmly the
 * weakest carrier holds its bit.
 *
 * Scheme PaperSlots: the filter embeds a bit in one magnitude of each slot (paper, eqs. 10 and 11),
 * and repeats this with the changed mesh's own basis until the message is read back blind (paper,
 * 2.3). Only the change of the spectrum is transformed back and added to the points, so that no
 * detail is lost. The first iteration uses a basis on the input (vtkManifoldHarmonics, lumped, with
 * at least as many harmonics as the slots need).
 *
 * Both schemes verify the mesh exactly as a detector will find it: with points rounded to their
 * output precision, and with polygons triangulated by their new corners.
 *
 * Output port 0 is the marked mesh: the input's cells and attributes, the new points, and the point
 * data `GeometricDistortion` (double: the displacement of each point as a fraction of the input's
 * bounding-box diagonal). The arrays of a basis are removed, because they no longer fit. Points
 * used by no polygon do not move; points at the same place stay together.
 *
 * Output port 1 is a vtkTable. For Robust it has a row per iteration, about points that are not
 * rounded yet and in the input's triangles: `Iteration` (0: the input), `Distortion` (percent of
 * the diagonal), `LargestError` (of a carrier, in steps of its quantisation; over 0.25 it reads
 * another bit). For PaperSlots it has a row per iteration and slot: `Iteration`, `Slot` and
 * `Component` (1-based), `Magnitude`, `Average`, `Deviation` (length^2), `BitWanted`, `BitRead`.
 * Its field data has the values of the getters of the same names: `Converged`, `Distortion`,
 * `Margin`, `Capacity`, `ExtractedMessage`.
 *
 * If the embedding does not converge (PaperSlots: within MaximumNumberOfIterations), the output is
 * the mesh that read the most bits right, GetConverged() is 0, GetExtractedMessage() is what that
 * mesh reads, and a vtkWarningMacro says so. This is not an error. Narrow slots and symmetric
 * models often need a larger TurbulenceFactor.
 *
 * The errors (vtkErrorMacro, an error code, empty outputs) are those of vtkManifoldHarmonics. It is
 * also an error if the message is empty without a secret key, or has characters other than 0 and 1;
 * if a key file cannot be used; if there are more bits than the mesh can carry, or than
 * MaximumDistortion or the memory allows; if the slots contradict each other or reach into the
 * constant harmonics; or, with Robust, if the surface encloses no volume.
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
   * Set/Get the bits to embed (the paper's "key"), as characters 0 and 1. Default "" for Robust and
   * "10110" for PaperSlots. With a secret key, an empty message stands for NumberOfBits bits
   * derived from the key, so that there is nothing else to remember. Without one, it is an error.
   * In PaperSlots n bits need FirstComponent - 1 + n SlotSize harmonics.
   */
  void SetMessage(const char* message);
  const char* GetMessage() const;
  ///@}

  ///@{
  /**
   * Set/Get the paper's extraction threshold: PaperSlots stops as soon as this many bits are read
   * back right. Default 0: all; so does a number beyond the message's. Robust always requires all.
   */
  vtkSetClampMacro(RequiredBits, int, 0, VTK_INT_MAX);
  vtkGetMacro(RequiredBits, int);
  ///@}

  ///@{
  /**
   * Set/Get the number of iterations after which PaperSlots gives up. Default 20, at least 1.
   */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Set/Get how far Robust may move the surface: the largest root mean square displacement over the
   * surface, in percent of the bounding-box diagonal. Default 0.07; positive, at most 100. The mark
   * is made as robust as this allows.
   */
  vtkSetClampMacro(MaximumDistortion, double, VTK_DBL_MIN, 100.0);
  vtkGetMacro(MaximumDistortion, double);
  ///@}

  ///@{
  /**
   * Set/Get whether Robust measures GetCapacity(). Default off, because it takes as long as several
   * embeddings of that many bits, and one of hundreds of bits takes a minute.
   */
  vtkSetMacro(ReportCapacity, bool);
  vtkGetMacro(ReportCapacity, bool);
  vtkBooleanMacro(ReportCapacity, bool);
  ///@}

  ///@{
  /**
   * Set/Get the precision of the output points, a vtkAlgorithm::DesiredOutputPrecision. Default
   * DEFAULT_PRECISION: the input's. Choose SINGLE_PRECISION if the mesh will be written to a file
   * format that stores floats, so that the mesh in the file is the one that was verified.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  /**
   * Get whether the embedding succeeded, 1 or 0. PaperSlots: at least RequiredBits bits of the
   * output were read back right. Robust: the whole message was read back right, its check holds,
   * and the distortion is at most MaximumDistortion.
   */
  vtkGetMacro(Converged, int);

  /**
   * Get the distortion that Robust caused, in the unit of MaximumDistortion; 0 for PaperSlots.
   */
  vtkGetMacro(Distortion, double);

  /**
   * Get how firmly the weakest carrier of Robust holds its bit, from 0 (at the border to the other
   * bit) to 1 (in the middle of its cell); 0 for PaperSlots.
   */
  vtkGetMacro(Margin, double);

  /**
   * Get the number of bits that Robust can embed in this mesh within MaximumDistortion, whatever
   * the message, at most 1024 (a few more may fit). 0 unless ReportCapacity is on, and for
   * PaperSlots. The longer a message, the less it survives.
   */
  vtkGetMacro(Capacity, int);

  /**
   * Get the number of times that the output's points were changed.
   */
  vtkGetMacro(NumberOfIterationsUsed, int);

  /**
   * Get the number of bases that the last update computed. PaperSlots: one per iteration, and one
   * for the input unless it has a usable basis. Robust: 0.
   */
  vtkGetMacro(NumberOfEigensolves, int);

  /**
   * Get the message that is read blind from the output; "" after an error or an abort.
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
