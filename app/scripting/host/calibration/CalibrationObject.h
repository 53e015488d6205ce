// CalibrationObject.h - the functions of the object "calibration"; CalibrationObject.cpp says what each takes and
// returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"
#include "core/encoding/CalibratedQuantity.h"

namespace tacto::host::calibration {

using Json = nlohmann::json;

/// The range over which a quantity is calibrated, as the settings of a call state it.
struct LevelRange {
    LevelRange(const Arguments& from, const CalibratedQuantity& of)
        : low(from.number("settings." + key(of, "min"))), high(from.number("settings." + key(of, "max"))) {}
    /// Its member of the settings: "width_max_us" for `end` "max".
    [[nodiscard]] static std::string key(const CalibratedQuantity& of, std::string_view end) {
        return fmt::format("{}_{}_{}", of.id, end, of.setting);
    }
    [[nodiscard]] double at(double share) const { return low + share * (high - low); }

    double low, high;
};

HostCall readKnownLoad, warmUp, beginLevels, readLevel;                               // Levels.cpp
HostCall checkRanges, knownRanges, judge, timeBase, checkVerdict, stimulatorVerdict;  // Stimulator.cpp
HostCall knownWeight, weighings, sensorVerdict;                                       // Fingertip.cpp

}  // namespace tacto::host::calibration
