// SessionReader.h - reads a session file. Never changes the file.
//
// Without its key, the rows of a sealed session (SealedRow.h) are marked as sealed and hold only what they show;
// reading data that is fully hidden (samples, captures) fails as Unsupported.
//
// If a crash cut a session off (a *-wal file lies next to it), everything committed before the crash is read. The
// reader does not judge the file; verifySession() does (SessionVerify.h).
//
// Thread-safety: one caller at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/measure/Capture.h"
#include "core/session/RowSeal.h"
#include "core/session/SessionTypes.h"

namespace tacto {

/// A stream for drawing, whatever its length.
struct StreamOutline {
    SampleBlock samples;
    std::int64_t oneIn = 1;  ///< of so many chunks, one was read
};

class SessionReader {
public:
    /// Errors: NotFound; Unsupported for a file that is not a session or comes from a newer program; ParseError for a
    /// session that is too damaged to open, or that `seal` does not open; Io.
    [[nodiscard]] static Result<SessionReader> open(const std::filesystem::path& path,
                                                    std::shared_ptr<const RowSeal> seal = nullptr);
    /// Opens a damaged session to read what can be read: rows that cannot are left out, samples that cannot are left
    /// out too, and so are those that do not match their checksum. Errors: as open().
    [[nodiscard]] static Result<SessionReader> openDamaged(const std::filesystem::path& path,
                                                           std::shared_ptr<const RowSeal> seal = nullptr);
    SessionReader(SessionReader&&) noexcept;
    SessionReader& operator=(SessionReader&&) noexcept;
    ~SessionReader();

    /// Whether the session's rows are sealed (SealedRow.h).
    [[nodiscard]] bool sealed() const noexcept;
    /// Whether rows are sealed and no key was given; about() then lacks parameters, seed and profile.
    [[nodiscard]] bool locked() const noexcept;
    [[nodiscard]] const SessionAbout& about() const noexcept;
    /// True if the session was closed in order; false after a crash, or while the session is still being written.
    [[nodiscard]] bool closed() const noexcept;
    /// The hash of the recording's last row, 64 hexadecimal digits. Annotations, which follow the recording's end, do
    /// not change this hash.
    [[nodiscard]] const std::string& chainHead() const noexcept;
    /// The hash of row `seq`, in the form of chainHead(). Errors: NotFound; Io.
    [[nodiscard]] Result<std::string> hashOf(std::int64_t seq) const;
    /// Checks the hash chain of all rows, but not the samples (verifySession() does). Errors: ParseError naming the row
    /// that is missing or was altered; Io.
    [[nodiscard]] Result<void> checkChain() const;
    /// When the recording's last row was written; this gives the session's duration.
    [[nodiscard]] Instant lastAt() const noexcept;
    /// The labels as entered before the session began, with later changes. A sealed note reads "sealed". Errors: as the
    /// lists below.
    [[nodiscard]] Result<SessionLabels> labels() const;

    // Each list is in the order of writing. Errors: ParseError naming the row; Io.
    [[nodiscard]] Result<std::vector<SessionRow>> events() const;
    [[nodiscard]] Result<std::vector<SessionRow>> commands() const;
    /// Calls `visit` for each command whose name is `wanted`: a list of hours of trains would take too much memory.
    [[nodiscard]] Result<void> forEachCommand(const std::function<void(const SessionRow&)>& visit,
                                              const std::function<bool(std::string_view name)>& wanted = {}) const;
    [[nodiscard]] Result<std::vector<SessionRow>> measurements() const;
    [[nodiscard]] Result<std::vector<SessionRow>> log() const;
    /// The `body` of each row is the item that reportItem() was given.
    [[nodiscard]] Result<std::vector<SessionRow>> reportItems() const;
    [[nodiscard]] Result<std::vector<SessionTrial>> trials() const;
    [[nodiscard]] Result<std::vector<SessionVerdict>> verdicts() const;

    [[nodiscard]] Result<std::vector<SessionCaptureInfo>> captures() const;
    /// Errors: NotFound; ParseError if the samples cannot be unpacked.
    [[nodiscard]] Result<Capture> capture(std::int64_t seq) const;

    [[nodiscard]] Result<std::vector<SessionStreamInfo>> streams() const;
    /// Returns all samples of a stream. Errors: NotFound; ParseError.
    [[nodiscard]] Result<SampleBlock> samples(int stream) const;
    /// Reads chunk by chunk, for sessions larger than memory. `visit` returns false to stop.
    [[nodiscard]] Result<void> forEachChunk(int stream, const std::function<bool(const SampleBlock&)>& visit) const;
    /// The stamps alone: values are read only where they are packed together.
    [[nodiscard]] Result<void> forEachStamps(int stream,
                                             const std::function<bool(std::span<const double>)>& visit) const;
    /// Returns all samples of a stream; or, if they have more than `most` values, those of one chunk in so many that
    /// they have about `most`, with a row of NaN between.
    [[nodiscard]] Result<StreamOutline> outline(int stream, std::uint64_t most) const;

    /// Returns all that the same seed must reproduce, one line per row, with samples as hexadecimal digests; without
    /// wall time, paths, versions, annotations and the chain. Equal texts mean equal runs.
    [[nodiscard]] Result<std::string> reproducibleText() const;

private:
    struct State;
    explicit SessionReader(std::unique_ptr<State> state);
    [[nodiscard]] static Result<SessionReader> open(const std::filesystem::path& path,
                                                    std::shared_ptr<const RowSeal> seal, bool damaged);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
