// SessionReader.h - gives back what a session file holds. Never changes the file.
//
// A reader without the key of a sealed session (SealedRow.h) returns its rows, marked as sealed, with what they show;
// what stays hidden entirely (samples, captures) is refused as Unsupported.
//
// A session that was cut off by a crash (a *-wal file beside it) is read with what was committed before the cut.
// Reading does not judge: that is verifySession(), SessionVerify.h.
//
// Thread-safety: one caller at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/measure/Capture.h"
#include "core/session/RowSeal.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionReader {
public:
    /// Errors: NotFound; Unsupported for a file that is not a session or was made by a newer program; ParseError for
    /// one that is damaged beyond opening, or that `seal` does not open; Io.
    [[nodiscard]] static Result<SessionReader> open(const std::filesystem::path& path,
                                                    std::shared_ptr<const RowSeal> seal = nullptr);
    SessionReader(SessionReader&&) noexcept;
    SessionReader& operator=(SessionReader&&) noexcept;
    ~SessionReader();

    /// Whether its rows are sealed (SealedRow.h).
    [[nodiscard]] bool sealed() const noexcept;
    /// True when its rows are sealed and no key was given: about() lacks parameters, seed and profile then.
    [[nodiscard]] bool locked() const noexcept;
    [[nodiscard]] const SessionAbout& about() const noexcept;
    /// True when the session was closed in order; false after a crash, or while it is still being written.
    [[nodiscard]] bool closed() const noexcept;
    /// The hash of the recording's last row, 64 hexadecimal digits. Annotations, which come after its end, leave it as
    /// it is.
    [[nodiscard]] const std::string& chainHead() const noexcept;
    /// The hash of row `seq`, as chainHead(). Errors: NotFound; Io.
    [[nodiscard]] Result<std::string> hashOf(std::int64_t seq) const;
    /// Follows the chain over all rows. What samples hold is for verifySession(). Errors: ParseError naming the row
    /// that is missing or was altered; Io.
    [[nodiscard]] Result<void> checkChain() const;
    /// When the recording's last row was written, which tells how long the session is.
    [[nodiscard]] Instant lastAt() const noexcept;
    /// The labels as entered before it began, with later changes; the note reads "sealed" where they are. Errors: as
    /// the lists.
    [[nodiscard]] Result<SessionLabels> labels() const;

    // Each list is in the order written. Errors: ParseError naming the row; Io.
    [[nodiscard]] Result<std::vector<SessionRow>> events() const;
    [[nodiscard]] Result<std::vector<SessionRow>> commands() const;
    /// Calls it row by row: hours of trains take more memory than there should be.
    [[nodiscard]] Result<void> forEachCommand(const std::function<void(const SessionRow&)>& visit) const;
    [[nodiscard]] Result<std::vector<SessionRow>> measurements() const;
    [[nodiscard]] Result<std::vector<SessionRow>> log() const;
    /// `body` of each row is the item as it was given.
    [[nodiscard]] Result<std::vector<SessionRow>> reportItems() const;
    [[nodiscard]] Result<std::vector<SessionTrial>> trials() const;
    [[nodiscard]] Result<std::vector<SessionVerdict>> verdicts() const;

    [[nodiscard]] Result<std::vector<SessionCaptureInfo>> captures() const;
    /// Errors: NotFound; ParseError when the samples do not unpack.
    [[nodiscard]] Result<Capture> capture(std::int64_t seq) const;

    [[nodiscard]] Result<std::vector<SessionStreamInfo>> streams() const;
    /// All samples of a stream at once. Errors: NotFound; ParseError.
    [[nodiscard]] Result<SampleBlock> samples(int stream) const;
    /// Chunk by chunk, for sessions larger than memory. `visit` returns false to end early.
    [[nodiscard]] Result<void> forEachChunk(int stream, const std::function<bool(const SampleBlock&)>& visit) const;

    /// Everything that the same seed must reproduce, a line per row, samples included as hexadecimal digests: wall
    /// time, paths, versions, annotations and the chain itself left out. Two runs are the same when these texts are.
    [[nodiscard]] Result<std::string> reproducibleText() const;

private:
    struct State;
    explicit SessionReader(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
