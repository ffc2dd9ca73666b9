// SPDX-License-Identifier: BSD-3-Clause
// Marks a PLY mesh with bits of a secret key, detects the mark in the file that was written, and
// prints the distortion.
//
//   WatermarkMesh IN.ply OUT.ply KEYFILE
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    std::cerr << "usage: " << argv[0] << " IN.ply OUT.ply KEYFILE\n";
    return EXIT_FAILURE;
  }
  const char* keyFile = argv[3];
  if (std::string(argv[1]) == argv[2])
  {
    std::cerr << "the original would be replaced: name another file\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputConnection(reader->GetOutputPort());
  embed->SetSecretKeyFile(keyFile); // the message is derived from it
  // PLY stores floats, so the filter verifies the mark on points in single precision.
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
  if (!writer->Write() || !std::ifstream(argv[2]))
  {
    std::cerr << argv[2] << " could not be written\n";
    return EXIT_FAILURE;
  }

  vtkNew<vtkPLYReader> copy;
  copy->SetFileName(argv[2]);
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetInputConnection(copy->GetOutputPort());
  detect->SetSecretKeyFile(keyFile);
  detect->UseDerivedMessageOn();
  detect->Update();
  if (detect->GetErrorCode() != 0)
  {
    return EXIT_FAILURE; // no verdict: VTK has printed the error
  }

  vtkNew<vtkMeshDistortion> distortion;
  distortion->SetInputConnection(0, reader->GetOutputPort());
  distortion->SetInputConnection(1, embed->GetOutputPort());
  distortion->Update();

  std::cout << (detect->GetDetected() ? "mine" : "not mine") << ", p-value " << detect->GetPValue()
            << "\nthe surface moved by " << 100.0 * distortion->GetMRMS()
            << " % of the bounding-box diagonal (MRMS), visible distortion (MSDM2): "
            << distortion->GetMSDM2() << "\n";
  return detect->GetDetected() ? EXIT_SUCCESS : EXIT_FAILURE;
}
