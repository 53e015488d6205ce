// SessionSummary.h - a session as a line of a list: what is known about it at a glance.
//
// Thread-safety: pure but for the file that is read.
#pragma once

#include <filesystem>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

struct SessionSummary {
    std::string wallStart;  ///< ISO 8601 UTC
    std::string protocol;   ///< empty: opened by hand
    std::vector<std::string> devices;
    std::string verdict;  ///< the last verdict; empty: none
    SessionLabels labels;
    double duration_s = 0;
    bool simulated = false;
    bool closed = false;  ///< ended in order
    bool faulted = false;
    bool operator==(const SessionSummary&) const = default;
};

/// Read from the session itself. Errors: as SessionReader.
[[nodiscard]] Result<SessionSummary> summarise(const std::filesystem::path& session);

/// Whether another program has the session open, and so is recording it where it has no end mark.
[[nodiscard]] bool openElsewhere(const std::filesystem::path& session);

[[nodiscard]] std::string toJsonText(const SessionSummary& summary);
/// Errors: ParseError for what is not a summary.
[[nodiscard]] Result<SessionSummary> summaryFrom(std::string_view json);

}  // namespace tacto
