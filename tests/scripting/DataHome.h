// DataHome.h - gives each test its own folder for the data that the program keeps about devices.
//
// Thread-safety: the test's own thread.
#pragma once

#include <cstdlib>
#include <gtest/gtest.h>

#include "tests/support/Support.h"

namespace tacto::test {

class DataHome : public testing::Test {
protected:
    DataHome() { ::setenv("XDG_DATA_HOME", folder_.path().c_str(), 1); }
    ~DataHome() override { ::unsetenv("XDG_DATA_HOME"); }
    DataHome(const DataHome&) = delete;
    DataHome& operator=(const DataHome&) = delete;

    const ScratchDir folder_;
};

}  // namespace tacto::test
