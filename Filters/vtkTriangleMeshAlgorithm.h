// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangleMeshAlgorithm
 * @brief   Superclass of this module's filters: how they run, fail and stop
 *
 * Bad input is answered with vtkErrorMacro, an error code and empty outputs: vtkErrorCode::UserError
 * where the user can correct it, vtkErrorCode::UnknownError where the solver failed or memory ran out.
 * The error is also there in parts, for programs that put their own name to a property.
 *
 * An abort (SetAbortExecute(1), as from a progress observer) empties the outputs without an error. The
 * flag is reset when the filter has stopped, whichever VTK runs it: VTK before 9.3 resets it at the
 * start of every execution, later versions and ParaView from 5.11 on leave that to the caller. Call
 * Modified() to run the filter again.
 *
 * Output port 0 is vtkPolyData; further ports are vtkTable.
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
   * The error of the last run in parts: the property at fault ("" where none is, but the mesh), what is
   * wrong, and what the user can do (may be ""). All are "" after a run without an error. The text of the
   * error event is "<parameter>: <reason>; <advice>".
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
   * Runs what RequestData does and turns what it throws into VTK's terms, as the class says; returns
   * what RequestData returns. Several pieces asked for, as in parallel runs, are an error: the filters
   * need the whole mesh.
   */
  int Run(vtkInformationVector* outputs, const std::function<void()>& body);

  /**
   * Forgets the results of an earlier run. Run() calls it before the body, and after one that failed or
   * was aborted.
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
