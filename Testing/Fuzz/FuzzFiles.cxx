// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a mesh file. The readers that stand between files and VTK are in Python: files.py calls
// them, and the lines that run there are what libFuzzer takes for coverage.
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace
{

constexpr unsigned Counters = 1U << 16;
__attribute__((section("__libfuzzer_extra_counters"))) std::uint8_t LineCounters[Counters];

PyObject* Run = nullptr;
PyObject* TracedFiles = nullptr; // a tuple

[[noreturn]] void Fail()
{
  PyErr_Print();
  std::abort();
}

// The number of a file in TracedFiles, from 1, or 0 for another file.
unsigned FileNumber(PyObject* name)
{
  const Py_ssize_t count = PyTuple_GET_SIZE(TracedFiles);
  for (Py_ssize_t i = 0; i < count; ++i)
  {
    if (PyTuple_GET_ITEM(TracedFiles, i) == name)
    {
      return static_cast<unsigned>(i) + 1;
    }
  }
  return 0;
}

// Counts pairs of lines that run after each other.
int Trace(PyObject*, PyFrameObject* frame, int what, PyObject*)
{
  static unsigned last = 0;
  if (what != PyTrace_LINE)
  {
    return 0;
  }
  PyCodeObject* code = PyFrame_GetCode(frame);
  if (const unsigned file = FileNumber(code->co_filename))
  {
    // No file is as long as 512 lines, so each line has a number of its own.
    const unsigned line = 512U * file + static_cast<unsigned>(PyFrame_GetLineNumber(frame));
    ++LineCounters[(last * 4099U + line) % Counters];
    last = line;
  }
  Py_DECREF(code);
  return 0;
}

void Start()
{
  Py_InitializeEx(0);
  PyRun_SimpleString("import sys; sys.path[:0] = [" FUZZ_PYTHON_PATHS "]");
  PyObject* module = PyImport_ImportModule("files");
  if (module == nullptr)
  {
    Fail();
  }
  Run = PyObject_GetAttrString(module, "run");
  TracedFiles = PyObject_GetAttrString(module, "TRACED_FILES");
  Py_DECREF(module);
  PyEval_SetTrace(&Trace, nullptr);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (Run == nullptr)
  {
    Start();
  }
  PyObject* result = PyObject_CallFunction(Run, "y#", reinterpret_cast<const char*>(data),
    static_cast<Py_ssize_t>(size));
  if (result == nullptr)
  {
    Fail();
  }
  Py_DECREF(result);
  return 0;
}
