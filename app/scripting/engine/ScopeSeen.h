// ScopeSeen.h - the accuracy that the oscilloscope stated in all captures given to the script: the basis of the run's
// figures. The program writes it into the results; a script cannot state it instead (hazard H9).
//
// Thread-safety: none, like ScriptSession, which owns this.
#pragma once

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/devices/Device.h"
#include "core/measure/Capture.h"
#include "core/results/ResultBasis.h"

namespace tacto {

/// Returns the device as instrument of a run.
[[nodiscard]] InstrumentSeen instrumentOf(const DeviceIdentity& device);

class ScopeSeen {
public:
    void add(const Capture& capture);
    /// Sets the result of an absolute reference, written as a sentence.
    void setAbsolute(std::string text) { absolute_ = std::move(text); }
    [[nodiscard]] bool any() const noexcept { return !channels_.empty(); }
    /// True if every record so far stated the tolerance of its time stamp; true before the first record.
    [[nodiscard]] bool stampsStated() const noexcept { return !std::isnan(stamp_s_); }

    /// Returns a row per channel of `scope`, with the largest value of all captures; null if one capture does not state
    /// it.
    [[nodiscard]] nlohmann::json rows(const DeviceIdentity& scope) const;
    /// Returns sentences that say what the absolute voltage scale is based on, and what is not stated.
    [[nodiscard]] std::vector<std::string> restsOn() const;

private:
    std::map<std::string, ChannelSeen> channels_;
    double timeBase_ = 0, stamp_s_ = 0;
    std::string notStated_;
    std::string absolute_;
};

}  // namespace tacto
