// Readers.h - a Python with pyxdf, pyEDFlib and edfio.
//
// Thread-safety: as PythonEnvironment.h.
#pragma once

#include "tests/support/PythonEnvironment.h"

namespace tacto::test {

[[nodiscard]] inline std::optional<std::string> pythonWithReaders() {
    return pythonWith("signals", "pyxdf, pyedflib, edfio", "pyxdf==1.17.5 pyEDFlib==0.1.42 edfio==0.4.18");
}

}  // namespace tacto::test
