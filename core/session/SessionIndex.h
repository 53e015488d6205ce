// SessionIndex.h - a cache of summaries of sessions, so that a list of thousands of sessions appears at once.
//
// A summary is valid as long as its session and its journal have the size and the time of change that they had when the
// session was read. A session whose row in the index was altered is read again. An index that is missing, damaged or of
// another version is rebuilt; if there can be none, every session is read. read() corrects the index.
//
// Thread-safety: any thread, several programs; each call opens the index for itself.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

// A session as one line of a list.

struct SessionSummary {
    std::string wallStart;  ///< ISO 8601 UTC
    std::string protocol;   ///< empty: a session without a script
    std::vector<std::string> devices;
    std::string verdict;  ///< the last verdict; empty: none
    SessionLabels labels;
    double duration_s = 0;
    bool simulated = false;
    bool closed = false;  ///< ended in order
    bool faulted = false;
    bool operator==(const SessionSummary&) const = default;
};

/// Reads the summary from the session itself. Errors: as SessionReader.
[[nodiscard]] Result<SessionSummary> summarise(const std::filesystem::path& session);

/// Whether another program has the session open; if the session has no end mark, that program is recording it.
[[nodiscard]] bool openElsewhere(const std::filesystem::path& session);

[[nodiscard]] std::string toJsonText(const SessionSummary& summary);
/// Errors: ParseError for any text that is not a summary.
[[nodiscard]] Result<SessionSummary> summaryFrom(std::string_view json);

struct ListedSession {
    std::filesystem::path path;
    std::uintmax_t bytes = 0;  ///< includes the journal
    SessionSummary summary;
    std::string problem;  ///< why the session cannot be read; empty if it can be read
};

class SessionIndex {
public:
    /// `file` need not exist; its folder is created when needed.
    explicit SessionIndex(std::filesystem::path file) : file_(std::move(file)) {}

    /// Lists the sessions in the order of `sessions`, without missing ones. After each session that had to be read,
    /// calls `going` with the number done; false ends the list early. The index keeps what was read until then.
    [[nodiscard]] std::vector<ListedSession> list(const std::vector<std::filesystem::path>& sessions,
                                                  const std::function<bool(std::size_t done)>& going) const;
    /// Reads the session itself and corrects its summary in the index.
    [[nodiscard]] ListedSession read(const std::filesystem::path& session) const;

private:
    std::filesystem::path file_;
};

}  // namespace tacto
