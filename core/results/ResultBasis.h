// ResultBasis.h - what the results of a run rest on: the checks of what is known, and the instruments. Each member is
// described once, as in ResultRecord.h.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Statistics.h"
#include "core/results/ResultTable.h"

namespace tacto {

/// How far the reading of something known is off, judged with its uncertainty. NaN: not known.
struct ReferenceCheck {
    [[nodiscard]] bool passed() const noexcept { return verdict == "pass"; }

    double deviation_pct = kNaN, expanded_pct = kNaN;
    double allowed_pct = kNaN;
    std::string_view verdict = "not evaluated";
};

template <class Record>
class ResultRecord;
[[nodiscard]] const ResultRecord<ReferenceCheck>& referenceCheckRecord();

struct KnownLoadCheck : ReferenceCheck {
    double load_ohm = kNaN;
    double measured_ohm = kNaN, expanded_ohm = kNaN;
    std::string reason = {};  ///< why it did not pass
};
[[nodiscard]] nlohmann::json toJson(const KnownLoadCheck& check);
[[nodiscard]] std::vector<std::string> knownLoadMembers();
/// Returns the check as a table of a script's report, without the reason.
[[nodiscard]] nlohmann::json knownLoadTable(const KnownLoadCheck& check);

/// The reading of a voltage of known size.
struct AbsoluteCheck : ReferenceCheck {
    double reference_v = kNaN, reference_u_pct = kNaN;
    double measured_v = kNaN, expanded_v = kNaN;
    std::string text = {};  ///< what was read and judged, as a sentence
};
[[nodiscard]] nlohmann::json toJson(const AbsoluteCheck& check);
[[nodiscard]] std::vector<std::string> absoluteMembers();

/// What an oscilloscope states of a channel, in the channel's unit where a name has none. NaN: not stated.
struct ChannelSeen {
    std::string name = {}, unit = {};
    double gain_pct = 0, offset = 0, lsb = 0, probe_pct = 0, linearity = 0;
    double timeBase_ppm = 0, stamp_s = 0;
    std::string statedBy = {};
};
struct InstrumentSeen {
    std::string_view role = {};
    std::string name = {}, serial = {};
    bool simulated = false;
    std::optional<ChannelSeen> channel = {};
};
[[nodiscard]] nlohmann::json toJson(const InstrumentSeen& instrument);
/// Returns the columns of instruments whose accuracy is not stated.
[[nodiscard]] std::vector<ResultColumn> instrumentColumns();

}  // namespace tacto
