// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangleMeshAlgorithm
 * @brief   Superclass of this module's filters, which decides how they run, fail and stop
 *
 * An error ends the run with vtkErrorMacro, an error code and empty outputs. The code is
 * vtkErrorCode::UserError if the user can correct the input or a property, and
 * vtkErrorCode::UnknownError if the solver failed or memory ran out. GetErrorParameter() and its
 * companions return the error in parts, for programs that have their own names for the properties.
 *
 * An abort (SetAbortExecute(1), for example in a progress observer) empties the outputs without an
 * error. Call Modified() to run the filter again; the flag need not be reset. VTK before 9.3 resets
 * it when an execution starts; later versions, and ParaView from 5.11 on, leave that to the caller,
 * so there the filter does it.
 *
 * Output port 0 is a vtkPolyData; all further ports are vtkTables.
 */
#ifndef vtkTriangleMeshAlgorithm_h
#define vtkTriangleMeshAlgorithm_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <functional> // for the body of Run
#include <string>     // for the parts of an error

namespace spectralwatermark
{
struct Failure;
} // namespace spectralwatermark

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkTriangleMeshAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkTriangleMeshAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Get the error of the last run in parts: the property at fault ("" if it is the mesh), the
   * reason, and what the user can do (may be ""). All are "" after a run without an error. The text
   * of the error event is "<parameter>: <reason>; <advice>".
   */
  const char* GetErrorParameter() const { return this->ErrorParameter.c_str(); }
  const char* GetErrorReason() const { return this->ErrorReason.c_str(); }
  const char* GetErrorAdvice() const { return this->ErrorAdvice.c_str(); }
  ///@}

protected:
  vtkTriangleMeshAlgorithm();
  ~vtkTriangleMeshAlgorithm() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /**
   * Runs the body of RequestData and turns exceptions into errors and aborts as described above.
   * Returns the value that RequestData returns. A request for one of several pieces, as in parallel
   * runs, is an error, because the filters need the whole mesh.
   */
  int Run(vtkInformationVector* outputs, const std::function<void()>& body);

  /**
   * Resets the results of an earlier run. Run() calls this before the body, and again if the body
   * failed or was aborted.
   */
  virtual void ResetResults() {}

private:
  vtkTriangleMeshAlgorithm(const vtkTriangleMeshAlgorithm&) = delete;
  void operator=(const vtkTriangleMeshAlgorithm&) = delete;

  int Fail(unsigned long code, const spectralwatermark::Failure& failure);

  std::string ErrorParameter;
  std::string ErrorReason;
  std::string ErrorAdvice;
};

#endif
