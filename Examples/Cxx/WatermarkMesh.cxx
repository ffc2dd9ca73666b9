// SPDX-License-Identifier: BSD-3-Clause
// Marks a PLY mesh, reads the mark back from the file that was written, and says what it cost.
//
//   WatermarkMesh IN.ply OUT.ply [BITS]
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    std::cerr << "usage: " << argv[0] << " IN.ply OUT.ply [BITS]\n";
    return EXIT_FAILURE;
  }
  const char* message = argc > 3 ? argv[3] : "10110";

  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputConnection(reader->GetOutputPort());
  embed->SetMessage(message);
  // PLY stores floats: have the mark verified on the points as the file will hold them.
  embed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  embed->Update();
  if (!embed->GetConverged())
  {
    std::cerr << "the mark could not be embedded completely; nothing was written\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkPLYWriter> writer;
  writer->SetInputConnection(embed->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write())
  {
    return EXIT_FAILURE;
  }

  vtkNew<vtkPLYReader> copy;
  copy->SetFileName(argv[2]);
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetInputConnection(copy->GetOutputPort());
  detect->SetNumberOfBits(static_cast<int>(std::string(message).size()));
  detect->Update();

  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputConnection(0, reader->GetOutputPort());
  distortion->SetInputConnection(1, embed->GetOutputPort());
  distortion->Update();

  std::cout << "embedded " << message << " in " << embed->GetNumberOfIterationsUsed()
            << " iterations, read back " << detect->GetExtractedMessage() << "\n"
            << "mean displacement: " << 100.0 * distortion->GetGeomDiff()
            << " % of the bounding-box diagonal, visible distortion (MSDM2): "
            << distortion->GetMSDM2() << "\n";
  return detect->GetExtractedMessage() == std::string(message) ? EXIT_SUCCESS : EXIT_FAILURE;
}
