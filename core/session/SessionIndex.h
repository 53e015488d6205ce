// SessionIndex.h - summaries of sessions that were read before, so that thousands are listed at once.
//
// A cache and nothing else. A summary counts as long as its session has the size and the time of change that it had
// when it was read, journal included; a row that was altered is read again; an index that is missing, damaged or of
// another version is rebuilt, and without one every session is read. What a session says is asked of the session:
// read() corrects the index.
//
// Thread-safety: any thread, several programs; each call opens the index for itself.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

// A session as a line of a list: what is known about it at a glance.

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

/// Whether another program has the session open, and so, if it has no end mark, is recording it.
[[nodiscard]] bool openElsewhere(const std::filesystem::path& session);

[[nodiscard]] std::string toJsonText(const SessionSummary& summary);
/// Errors: ParseError for any other text.
[[nodiscard]] Result<SessionSummary> summaryFrom(std::string_view json);

struct ListedSession {
    std::filesystem::path path;
    std::uintmax_t bytes = 0;  ///< journal included
    SessionSummary summary;
    std::string problem;  ///< why it cannot be read; empty when it can
};

class SessionIndex {
public:
    /// `file` need not be there; its folder is made when needed.
    explicit SessionIndex(std::filesystem::path file) : file_(std::move(file)) {}

    /// The sessions in the order of `sessions`, without missing ones. `going` is called after each one that had to be
    /// read, with how many are done, and says whether to continue: what was read until then is kept.
    [[nodiscard]] std::vector<ListedSession> list(const std::vector<std::filesystem::path>& sessions,
                                                  const std::function<bool(std::size_t done)>& going) const;
    /// Reads the session itself and corrects the index.
    [[nodiscard]] ListedSession read(const std::filesystem::path& session) const;

private:
    std::filesystem::path file_;
};

}  // namespace tacto
