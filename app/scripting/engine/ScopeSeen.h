// ScopeSeen.h - what the oscilloscope of a run stated of itself, over all captures that the script was given: what the
// run's figures rest on. The program writes it into the results; a script cannot say it in its place (hazard H9).
//
// Thread-safety: none; as ScriptSession, which holds it.
#pragma once

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/devices/Device.h"
#include "core/measure/Capture.h"

namespace tacto {

class ScopeSeen {
public:
    void add(const Capture& capture);
    /// Sets the result of an absolute reference, as a sentence.
    void setAbsolute(std::string text) { absolute_ = std::move(text); }
    [[nodiscard]] bool any() const noexcept { return !channels_.empty(); }
    /// Whether every record so far stated how good its time stamp is; true before the first.
    [[nodiscard]] bool stampsStated() const noexcept { return !std::isnan(stamp_s_); }

    /// A row per channel: {"name", "serial", "channel", "unit", "gain_pct", "offset", "lsb", "probe_pct",
    /// "linearity", "timebase_ppm", "stamp_s", "stated_by"}: the largest of all captures, null where one does not state
    /// it.
    [[nodiscard]] nlohmann::json rows(const DeviceIdentity& scope) const;
    /// What the absolute scale of the voltage rests on, and what is not stated, in sentences.
    [[nodiscard]] std::vector<std::string> restsOn() const;

private:
    struct Channel {
        std::string unit;
        double gain = 0, offset = 0, lsb = 0, probe = 0, linearity = 0;
        std::string statedBy;
    };
    std::map<std::string, Channel> channels_;
    double timeBase_ = 0, stamp_s_ = 0;
    std::string notStated_;
    std::string absolute_;
};

}  // namespace tacto
