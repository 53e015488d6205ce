// CalibrationLab.h - a store of calibrations for one test, and calibrations to put into it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>

#include "core/calibration/CalibrationStore.h"
#include "tests/gui/OwnDataHome.h"
#include "tests/gui/Person.h"
#include "tests/support/Support.h"

namespace tacto::test {

inline CalibrationDate daysFromNow(int days) {
    return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()) + std::chrono::days(days);
}

/// A calibration of the simulated bench's stimulator.
inline StoredCalibration calibration(int madeDaysAgo, int validForDays) {
    StoredCalibration c;
    c.serial = "SIM-1";
    c.device = "simulated stimulator";
    c.unit = "V";
    c.amplitude = {{1.0123, -0.05, 10, 40}, 0.8};
    c.interval = {{1.00002, -1e-6, 0.5, 2}, 0.006};
    c.phaseWidth = {{1.0004, 0.31e-6, 100e-6, 400e-6}, 0.12};
    c.gap = {{0.9996, -0.2e-6, 100e-6, 400e-6}, 0.14};
    c.made = daysFromNow(-madeDaysAgo);
    c.validUntil = daysFromNow(validForDays - madeDaysAgo);
    c.simulated = true;
    c.session = "run.tacto";
    c.sessionHead = std::string(64, '0');
    c.readings = 440;
    c.instruments = {{"oscilloscope X", "O-7", daysFromNow(validForDays - madeDaysAgo), 0.01, "the instrument"}};
    return c;
}

inline void store(const StoredCalibration& one) {
    auto opened = CalibrationStore::open(calibrationFile());
    ASSERT_TRUE(opened.has_value()) << opened.error().message;
    const auto added = opened->add(one);
    ASSERT_TRUE(added.has_value()) << added.error().message;
}

}  // namespace tacto::test
