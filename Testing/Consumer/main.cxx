// SPDX-License-Identifier: BSD-3-Clause
#include <vtkFieldData.h>
#include <vtkManifoldHarmonics.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <cstdlib>
#include <iostream>

// The second eigenvalue of the unit sphere is 2.
int main()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputConnection(sphere->GetOutputPort());
  harmonics->SetNumberOfHarmonics(4);
  harmonics->Update();
  vtkDataArray* values = harmonics->GetOutput()->GetFieldData()->GetArray("Eigenvalues");
  if (values == nullptr)
  {
    return EXIT_FAILURE;
  }
  const double second = values->GetComponent(1, 0);
  std::cout << "second eigenvalue of the unit sphere: " << second << "\n";
  return second > 1.98 && second < 2.02 ? EXIT_SUCCESS : EXIT_FAILURE;
}
