// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpectralWatermarkAlgorithm
 * @brief   What embedding and detection must agree on: scheme, slots and carriers
 *
 * Superclass of vtkSpectralWatermarkEmbed and vtkSpectralWatermarkDetect. A mark is read with the
 * properties it was embedded with.
 *
 * Scheme PaperSlots (paper, 2.2.3 and 3.2.1): bit i lives in slot i, the SlotSize components from
 * FirstComponent + i SlotSize on. In each slot one component, the carrier, is compared with the
 * average of reference components around it.
 *
 * @sa
 * vtkSpectralWatermarkEmbed vtkSpectralWatermarkDetect
 */
#ifndef vtkSpectralWatermarkAlgorithm_h
#define vtkSpectralWatermarkAlgorithm_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

namespace spectralwatermark
{
struct SlotOptions;
}

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkSpectralWatermarkAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkSpectralWatermarkAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Watermarking schemes. This version has one, the paper's.
   */
  enum SchemeType
  {
    PaperSlots = 0
  };

  ///@{
  /**
   * Set/Get the scheme. Default PaperSlots (0). Another value is an error when the filter runs.
   */
  vtkSetMacro(Scheme, int);
  vtkGetMacro(Scheme, int);
  void SetSchemeToPaperSlots() { this->SetScheme(PaperSlots); }
  const char* GetSchemeAsString() const;
  ///@}

  /**
   * Slot divisions (paper, 3.2.1). Normal: the references are positions 1 to SlotSize - 1 without
   * the carrier's. InterleavedNarrow: the carrier's two neighbours.
   */
  enum SlotDivisionType
  {
    Normal = 0,
    InterleavedNarrow = 1
  };

  ///@{
  /**
   * Set/Get which components of a slot the carrier is compared with. Default Normal.
   */
  vtkSetClampMacro(SlotDivision, int, Normal, InterleavedNarrow);
  vtkGetMacro(SlotDivision, int);
  void SetSlotDivisionToNormal() { this->SetSlotDivision(Normal); }
  void SetSlotDivisionToInterleavedNarrow() { this->SetSlotDivision(InterleavedNarrow); }
  const char* GetSlotDivisionAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the first component of the first slot, 1-based as in the paper (component 1 is the
   * constant harmonic). Default 21, at least 2. Slots that reach into the constant harmonics (one
   * per component of the mesh) are an error.
   */
  vtkSetClampMacro(FirstComponent, int, 2, VTK_INT_MAX / 2);
  vtkGetMacro(FirstComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the number of components of a slot, each of which holds one bit. Default 10, at
   * least 4.
   */
  vtkSetClampMacro(SlotSize, int, 4, 1000000);
  vtkGetMacro(SlotSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the carrier's place in its slot, 1-based. Default 5; 2 to SlotSize - 1, anything else
   * is an error when the filter runs.
   */
  vtkSetMacro(CarrierPosition, int);
  vtkGetMacro(CarrierPosition, int);
  ///@}

protected:
  vtkSpectralWatermarkAlgorithm();
  ~vtkSpectralWatermarkAlgorithm() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /**
   * The properties above for the Core; throws when the scheme is unknown.
   */
  void GetSlotOptions(spectralwatermark::SlotOptions& options) const;

private:
  vtkSpectralWatermarkAlgorithm(const vtkSpectralWatermarkAlgorithm&) = delete;
  void operator=(const vtkSpectralWatermarkAlgorithm&) = delete;

  int Scheme = PaperSlots;
  int SlotDivision = Normal;
  int FirstComponent = 21;
  int SlotSize = 10;
  int CarrierPosition = 5;
};

#endif
